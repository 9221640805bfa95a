"""The binary interface of the shared libraries, against the one stored in abi.txt: functions, and the
sizes and members of what they take. Programs built before a change must run after it, or the version says
that they do not. While the changelog has the major version as unreleased, its interface may change.

abi.py FOLDER           compare the libraries in FOLDER, built with -g
abi.py FOLDER --store   write abi.txt; refused where the version does not say what the change is

Needs abidw (Debian: abigail-tools); without it, and off x86-64, it ends with status 77.
"""
import argparse
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
STORED = pathlib.Path(__file__).with_name("abi.txt")
LIBRARIES = ["sightline", "sightline_analysis", "sightline_io", "sightline_study", "sightline_draw", "sightline_glpk",
             "sightline_level"]
SKIPPED = 77


def version():
    """Within which interfaces stay: the major one, CMake's SOVERSION."""
    text = (ROOT / "lib/include/sightline/version.h").read_text()
    return re.search(r"#define SL_VERSION_MAJOR +(\d+)", text).group(1)


def released():
    """Whether programs may count on the interface of this major version (STABILITY.md)."""
    text = (ROOT / "lib/CHANGELOG.md").read_text(encoding="utf-8")
    return not re.search(rf"^## {version()}\.0\.0, unreleased$", text, re.MULTILINE)


class Library:
    """What abidw says of a library, as lines."""

    def __init__(self, path):
        done = subprocess.run(["abidw", "--headers-dir", ROOT / "lib/include", "--drop-private-types",
                               "--no-show-locs", path],
                              stdout=subprocess.PIPE, check=True)
        tree = xml.etree.ElementTree.fromstring(done.stdout)
        self.types = {item.get("id"): item for item in tree.iter()
                      if item.get("id") and item.tag != "subrange"}
        # A name that is only declared in one file may be defined in another.
        self.defined = {item.get("name"): item for item in self.types.values()
                        if item.tag in ("class-decl", "union-decl") and
                        not item.get("is-declaration-only")}
        self.lines, self.told = [], set()
        # Not each has an elf-symbol-id: some stand only as another file declares them.
        functions = {item.get("name"): item for item in tree.iter("function-decl")}
        for name in sorted(symbol.get("name") for symbol in tree.iter("elf-symbol")
                           if symbol.get("type") == "func-type"):
            self.lines.append(self.signature(functions[name], name))

    def signature(self, function, name):
        given = function.find("return")
        taken = ["..." if item.get("is-variadic") else self.name(item.get("type-id"))
                 for item in function.findall("parameter")]
        return f"{self.name(given.get('type-id'))} {name}({', '.join(taken)})"

    def name(self, number):
        """Of a type; what it consists of goes into the lines."""
        item = self.types[number]
        if item.tag == "pointer-type-def":
            inner = self.types[item.get("type-id")]
            if inner.tag == "function-type":
                return self.signature(inner, "(*)")
            return self.name(item.get("type-id")) + " *"
        if item.tag == "qualified-type-def":
            marks = [mark for mark in ("const", "volatile", "restrict") if item.get(mark) == "yes"]
            inner = self.types[item.get("type-id")]
            name = self.name(item.get("type-id"))
            return (f"{name} {' '.join(marks)}" if inner.tag == "pointer-type-def"
                    else f"{' '.join(marks)} {name}")
        if item.tag == "array-type-def":
            lengths = "".join(f"[{part.get('length')}]" for part in item.findall("subrange"))
            return self.name(item.get("type-id")) + lengths
        if item.tag == "function-type":
            return self.signature(item, "()")
        if item.tag == "typedef-decl":
            inner = self.types[item.get("type-id")]
            # What the C library calls its numbers is its own affair.
            if inner.tag == "typedef-decl" and inner.get("name").startswith("__"):
                return item.get("name")
            self.tell(inner, item.get("name"))
            return item.get("name")
        if item.get("is-anonymous") and item.tag in ("class-decl", "union-decl"):
            return "{" + ", ".join(self.members(item)) + "}"
        self.tell(item, item.get("name"))
        return item.get("name")

    def members(self, item):
        for member in item.findall("data-member"):
            field = member.find("var-decl")
            at = int(member.get("layout-offset-in-bits", 0)) / 8
            yield f"{field.get('name')}: {self.name(field.get('type-id'))} at {at:g}"

    def tell(self, item, name):
        if item.tag in ("class-decl", "union-decl"):
            item = self.defined.get(item.get("name"), item)
            if name in self.told or not name.startswith("sl_"):
                return
            self.told.add(name)
            if item.get("is-declaration-only"):
                return
            self.lines.append(f"{name}: {int(item.get('size-in-bits')) // 8} bytes")
            self.lines += [f"{name}.{member}" for member in self.members(item)]
        elif item.tag == "enum-decl":
            if name in self.told:
                return
            self.told.add(name)
            self.lines += [f"{name}: {choice.get('name')} = {choice.get('value')}"
                           for choice in item.findall("enumerator")]
        elif item.tag in ("typedef-decl", "pointer-type-def", "function-type", "array-type-def",
                          "qualified-type-def"):
            if name in self.told:
                return
            self.told.add(name)
            self.lines.append(f"{name}: is {self.name(item.get('id'))}")


def interface(folder):
    lines = []
    for name in LIBRARIES:
        path = folder / f"lib{name}.so"
        if path.exists():
            lines += [line for line in Library(path).lines if line not in lines]
    return sorted(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--store", action="store_true")
    options = parser.parse_args()
    if not shutil.which("abidw") or platform.machine() != "x86_64":
        print("abidw is not here (package abigail-tools), or this is no x86-64: not compared")
        return SKIPPED
    if not (options.folder / "libsightline.so").exists():
        parser.error(f"{options.folder} has no libsightline.so: build with -DBUILD_SHARED_LIBS=ON")
    now = interface(options.folder)
    old_version, *old = STORED.read_text().splitlines() if STORED.exists() else ["version none"]
    gone = [line for line in old if line not in set(now)]
    new = [line for line in now if line not in set(old)]
    raised = old_version != f"version {version()}"
    for sign, lines in (("-", gone), ("+", new)):
        for line in lines:
            print(sign, line)
    if gone and not raised and released():
        print(f"programs built for version {version()} would break: raise SL_VERSION in version.h, "
              "or keep what they use")
        return 1
    if options.store:
        STORED.write_text("\n".join([f"version {version()}", *now]) + "\n")
        return 0
    if gone or new or raised:
        print(f"the interface has changed: store it, python3 {sys.argv[0]} {options.folder} --store")
        return 1
    print(f"{len(now)} lines of the binary interface are as stored, version {version()}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
