"""Checks of the source tree: check.py SUBJECT ROOT.

layers   a folder of lib/, tools/ or viewer/ includes only from itself and from folders before it; tools and
         viewer include public headers of lib/ alone; private names begin with sli_; and the README
         of lib/ and that of viewer/ have a line for each folder
table    lib/README.md has a line for each public header, and no other
sources  lib/CMakeLists.txt names every source of lib/
headers  every public header compiles alone, as C11 and as C++
used     what a private header declares serves more than the one source that has it
silent   the library prints nothing of its own accord, and reads nothing from the environment
format   every source is laid out as .clang-format says
doxygen  the API reference (lib/Doxyfile) has a text for every public function, type and macro
versions packages, their changelogs and the programs' metadata say the version of version.h
packages a library that is installed is in a Debian package, which has the SONAME's number in its name; and the
         document of the packages has all options of CMake
formats  a reader of maps (lib/io/io.c) has a fuzzer, a row in the test of memory that fails, and its endings in
         FORMATS.md
tidy     clang-tidy finds nothing (.clang-tidy) in what was built in --build; a minute or two

Prints each fault as FILE:LINE: what; exits 0 without faults, 1 with, 77 when it cannot tell.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

# The stages, in order. Data goes one way: each knows those before it and nothing of those after it.
FOLDERS = ["base", "geometry", "json", "map", "space", "space/faults", "effects", "stab",
           "cell_to_cell", "cell_to_cell/search", "cell_to_cell/sweep", "cell_to_cell/explain",
           "sight", "world", "bake", "analysis/visibility_graph", "analysis/axial", "analysis/placement",
           "analysis/reach", "analysis/rooms", "analysis/route", "analysis/set_sight",
           "study/generate", "study/from_region", "study/walk", "study/view_cells",
           "io", "runtime", "draw"]
# The folders of the command, in order, too.
COMMAND_FOLDERS = ["system", "arguments", "inputs", "reports", "studies", "commands"]
# Those of the viewer, in order, each with those that it may include from beside itself.
VIEWER_FOLDERS = {"ui": [], "document": ["ui"], "plan": ["ui", "document"], "lessons": ["ui", "document", "plan"],
                  "panes": ["ui", "document", "plan", "lessons"], "dialogs": ["ui", "document"],
                  "app": ["ui", "document", "plan", "lessons", "panes", "dialogs"]}
# Used by games with no other part of the library beside it.
ALONE = {"runtime"}
# Of that, what the library has in common with it: parts that include nothing, and the whole.
SHARED = ("runtime/parts/box_envelope.h", "runtime/parts/box_sector.h",
          "runtime/parts/box_sieve.h", "runtime/parts/pairs.h", "runtime/sightline_runtime.h")
# Public headers that are not named after their folder.
HEADERS = {"context": "base", "earth": "geometry", "measures": "base", "support": "base", "version": "base",
           "import": "map", "storeys": "map",
           "faults": "space/faults", "outline": "space",
           "dual": "stab", "glpk": "stab", "solvers": "stab",
           "doors": "cell_to_cell", "explain": "cell_to_cell", "pvs": "cell_to_cell",
           "steps": "cell_to_cell",
           "explored": "sight", "mirrored": "sight", "moving": "sight", "overlay": "sight", "query": "sight",
           "region": "sight", "sees": "sight", "view": "sight",
           "explained": "bake",
           "axial": "analysis/axial", "vga": "analysis/visibility_graph",
           "art_gallery": "analysis/placement", "coverage": "analysis/placement",
           "place": "analysis/placement", "place_area": "analysis/placement",
           "place_proof": "analysis/placement",
           "building_route": "analysis/route", "path": "analysis/route", "path_parts": "analysis/placement",
           "reach": "analysis/reach", "rooms": "analysis/rooms",
           "exposure": "analysis/set_sight", "set_sight": "analysis/set_sight",
           "set_cover": "analysis/placement", "viewpoint": "analysis/placement",
           "from_region": "study/from_region", "generate": "study/generate",
           "view_cells": "study/view_cells", "walk": "study/walk"}
# For users: it includes the others, and no part of the library includes it.
ALL_HEADERS = "sightline"
# Other versions lay out a few things differently.
FORMAT_VERSION = TIDY_VERSION = 14
CANNOT_TELL = 77

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.MULTILINE)


class CannotTell(Exception):
    pass


def includes(path):
    """(line, how, name) of each include, how being '"' or '<'."""
    text = path.read_text(encoding="utf-8")
    for found in INCLUDE.finditer(text):
        yield text.count("\n", 0, found.start(1)) + 1, found[1], found[2]


def sources(root, folders, endings):
    for folder in folders:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in endings and path.is_file():
                yield path


def library_sources(root, folders, endings):
    """Without examples: programs of their own, which include what their users do and print."""
    return (path for path in sources(root, folders, endings) if "examples" not in path.parts)


def header_folder(name):
    """The folder that a public header belongs to; None for none."""
    name = HEADERS.get(name, name)
    return name if name in FOLDERS else None


def folder_of(name):
    """The folder of FOLDERS that a path of lib lies in, the innermost one; else its first part."""
    around = [folder for folder in FOLDERS if name.startswith(folder + "/")]
    return max(around, key=len, default=pathlib.PurePosixPath(name).parts[0])


def public_header(name):
    """The name of a public header without its path and ending; None for other includes."""
    path = pathlib.PurePosixPath(name)
    return path.stem if path.parts[0] == "sightline" and len(path.parts) == 2 else None


def include_fault(owner, how, name):
    """What is wrong with an include in a file of the folder `owner`; None for nothing."""
    public = public_header(name)
    if public is None and how == "<":
        return None
    if public == ALL_HEADERS:
        return f"{name} is for users of the library"
    used = header_folder(public) if public else folder_of(name)
    if used not in FOLDERS:
        return f'"{name}" is in no folder of lib; say folder/file.h or sightline/file.h'
    if owner in ALONE:
        return None if used == owner else f"{owner}/ includes from no other folder, but {name}"
    if used in ALONE and used != owner and not name.startswith(SHARED):
        return f"{used}/ stands alone, but {owner}/ includes {name}"
    if FOLDERS.index(used) > FOLDERS.index(owner) and not name.startswith(SHARED):
        return f"{owner}/ comes before {used}/ and must not include {name}"
    return None


def check_layers(root):
    lib = root / "lib"
    there = set()
    for path in library_sources(root, ["lib"], {".c", ".h"}):
        name = path.relative_to(lib).as_posix()
        if name.startswith(("include/", "bindings/")):
            continue
        folder = folder_of(name)
        there.add(folder)
        if folder not in FOLDERS:
            yield f"lib/{name}: unknown to check.py: give its folder a place in FOLDERS"
            continue
        for line, how, used in includes(path):
            fault = include_fault(folder, how, used)
            if fault:
                yield f"{path.relative_to(root)}:{line}: {fault}"
    for path in sorted((lib / "include/sightline").glob("*.h")):
        if path.stem == ALL_HEADERS:
            continue
        owner = header_folder(path.stem)
        if owner is None:
            yield f"{path.relative_to(root)}: whose header is it? Name it in HEADERS of check.py"
            continue
        for line, how, name in includes(path):
            fault = include_fault(owner, how, name)
            if how == '"' and not public_header(name):
                fault = f"a public header includes {name}, which is not installed"
            if fault:
                yield f"{path.relative_to(root)}:{line}: {fault}"
    for path in sources(root, ["tools", "viewer"], {".c", ".h"}):
        lines = path.read_text(encoding="utf-8").splitlines()
        for line, how, name in includes(path):
            if how == '"' and folder_of(name) in FOLDERS and "// private" not in lines[line - 1]:
                yield (f"{path.relative_to(root)}:{line}: {name} is private to lib; a lesson that shows "
                       "the library's inside says so behind it: // private: why")
    yield from check_command_layers(root)
    yield from check_viewer_layers(root)
    yield from check_names(root)
    yield from check_map_of_the_house(root, "lib", [name for name in FOLDERS if name in there])


def check_command_layers(root):
    for path in sources(root, ["tools"], {".c", ".h"}):
        owner = path.parent.name
        if owner not in COMMAND_FOLDERS:
            yield f"{path.relative_to(root)}: its folder is none of {', '.join(COMMAND_FOLDERS)}"
            continue
        for line, _, name in includes(path):
            used = pathlib.PurePosixPath(name).parts[0]
            if used in COMMAND_FOLDERS[COMMAND_FOLDERS.index(owner) + 1:]:
                yield f"{path.relative_to(root)}:{line}: {owner}/ comes before {used}/ and must not include {name}"


def check_viewer_layers(root):
    there = set()
    for path in sources(root, ["viewer"], {".c", ".h"}):
        owner = path.parent.name
        if owner not in VIEWER_FOLDERS:
            yield f"{path.relative_to(root)}: its folder is none of {', '.join(VIEWER_FOLDERS)}"
            continue
        there.add(owner)
        for line, _, name in includes(path):
            used = pathlib.PurePosixPath(name).parts[0]
            if used in VIEWER_FOLDERS and used not in [owner, *VIEWER_FOLDERS[owner]]:
                yield f"{path.relative_to(root)}:{line}: {owner}/ knows nothing of {used}/ and must not include {name}"
    if there:
        yield from check_map_of_the_house(root, "viewer", [name for name in VIEWER_FOLDERS if name in there])


def check_names(root):
    """What a private header declares begins with sli_, so that a reader sees what is public."""
    for path in sorted((root / "lib").rglob("*.h")):
        if {"include", "bindings"} & set(path.parts):  # for others
            continue
        if folder_of(path.relative_to(root / "lib").as_posix()) not in set(FOLDERS) - ALONE:
            continue
        text = path.read_text(encoding="utf-8")
        for declared in DECLARATION.finditer(text):
            if text[declared.start()] != " " and not declared[1].startswith("sli_"):
                line = text.count("\n", 0, declared.start(1)) + 1
                yield f"{path.relative_to(root)}:{line}: {declared[1]}: a private name begins with sli_"


def check_map_of_the_house(root, house, there):
    """The README of a house has a line for each folder that is there, in their order."""
    text = (root / house / "README.md").read_text(encoding="utf-8")
    told = re.findall(r"^\| `([a-z_/]+)/`", text, re.MULTILINE)
    if told != there:
        yield f"{house}/README.md: tells of {told}, but {house}/ has {there}"


def check_table(root):
    """lib/README.md has a line for each public header."""
    there = {path.name for path in (root / "lib/include/sightline").glob("*.h")}
    text = (root / "lib/README.md").read_text(encoding="utf-8")
    told = set(re.findall(r"^\| \[`(\w+\.h)`\]\(include/sightline/", text, re.MULTILINE))
    for name in sorted(there - told):
        yield f"lib/README.md: no line for the public header {name}"
    for name in sorted(told - there):
        yield f"lib/README.md: a line for {name}, which is no public header"


def check_sources(root):
    lib = root / "lib"
    text = re.sub(r"#[^\n]*", "", (lib / "CMakeLists.txt").read_text(encoding="utf-8"))
    told = set(re.findall(r"[\w/]+\.c\b", text))
    there = {path.relative_to(lib).as_posix() for path in library_sources(root, ["lib"], {".c"})}
    for name in sorted(there - told):
        yield f"lib/CMakeLists.txt: does not name {name}"
    for name in sorted(told - there):
        yield f"lib/CMakeLists.txt: names {name}, which is not there"


COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
DECLARATION = re.compile(r"^(?!static|typedef)[\w ]+[ *](sli?_\w+)\([^;{]*\);", re.MULTILINE)


def check_used(root):
    texts = {path: COMMENT.sub("", path.read_text(encoding="utf-8"))
             for path in sources(root, ["lib", "tools", "viewer", "tests"], {".c", ".h"})}
    users = {}
    for path, text in texts.items():
        for name in re.findall(r"\bsli?_\w+", text):
            users.setdefault(name, []).append(path)
    for path in sorted((root / "lib").rglob("*.h")):
        if {"include", "bindings"} & set(path.parts):  # for others
            continue
        for declared in DECLARATION.finditer(texts[path]):
            where = users[declared[1]]
            if where.count(path) == 1 and len(set(where)) <= 2:
                yield (f"{path.relative_to(root)}: {declared[1]} is used by one source alone: "
                       "make it static there")


PRINTS = re.compile(r"\b(?:v?printf|puts|putchar|perror|getenv)\s*\(")


def check_silent(root):
    for path in library_sources(root, ["lib"], {".c", ".h"}):
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            if found := PRINTS.search(line):
                yield f"{path.relative_to(root)}:{number}: {found[0]}...) in the library"


# Where the version stands besides version.h: what CMake does not write.
VERSIONS = {
    "lib/CHANGELOG.md": r"^## (\d\S*?),",
    "lib/bindings/foundry/module.json": r'"version": "([^"]*)"',
    "lib/bindings/js/package.json": r'"version": "([^"]*)"',
    "lib/bindings/qgis/metadata.txt": r"^version=(\S*)",
    "tools/packages/conan/conanfile.py": r'version = "([^"]*)"',
    "tools/packages/debian/changelog": r"^sightline \((\S*)\)",
    "tools/packages/vcpkg/vcpkg.json": r'"version": "([^"]*)"',
    "viewer/desktop/io.github.sightline.View.metainfo.xml": r'<release version="([^"]*)"',
}


def check_versions(root):
    header = (root / "lib/include/sightline/version.h").read_text(encoding="utf-8")
    version = ".".join(re.search(rf"#define SL_VERSION_{part} +(\d+)", header)[1]
                       for part in ("MAJOR", "MINOR", "PATCH"))
    for name, pattern in VERSIONS.items():
        told = re.search(pattern, (root / name).read_text(encoding="utf-8"), re.MULTILINE)
        if not told or told[1] != version:
            yield f"{name}: says {told[1] if told else 'nothing'}, version.h says {version}"


def check_packages(root):
    debian, document = root / "tools/packages/debian", "tools/packages/README.md"
    header = (root / "lib/include/sightline/version.h").read_text(encoding="utf-8")
    major = re.search(r"#define SL_VERSION_MAJOR +(\d+)", header)[1]
    control = (debian / "control").read_text(encoding="utf-8")
    packed = ""
    for package in re.findall(r"^Package: (lib\S*)$", control, re.MULTILINE):
        if package.endswith("-dev"):
            continue
        if not re.search(rf"\D{major}$", package):
            yield f"{debian.relative_to(root)}/control: {package} has libraries whose SONAME ends with {major}"
        packed += (debian / f"{package}.install").read_text(encoding="utf-8")
    lists = [root / "CMakeLists.txt", *sorted((root / "lib/cmake").glob("*.cmake"))]
    for folder in ("lib", "tools", "viewer", "tests"):
        lists += sorted((root / folder).rglob("CMakeLists.txt"))
    texts = "".join(path.read_text(encoding="utf-8") for path in lists)
    libraries = re.findall(r"^ *(?:sightline_library|add_library)\((sightline\w*)(?= | SHARED)(?! INTERFACE| STATIC)",
                           "\n".join(path.read_text(encoding="utf-8") for path in lists
                                     if path.parent.name in ("lib", "level")), re.MULTILINE)
    libraries += ["sightline_" + part for part in re.findall(r"^ *sightline_part_library\((\w+) ", texts, re.MULTILINE)]
    for library in libraries:
        if f"/lib{library}.so.*\n" not in packed:
            yield f"{debian.relative_to(root)}: lib{library}.so.* is in no package"
    options = re.findall(r"^ *(?:option|set)\((SIGHTLINE_[A-Z_]+) \".*\"(?: O| \$| CACHE)", texts, re.MULTILINE)
    options += ["SIGHTLINE_" + part for part in re.findall(r"^sightline_part\((\w+) ", texts, re.MULTILINE)]
    told = (root / document).read_text(encoding="utf-8")
    for option in options:
        if f"`{option}`" not in told:
            yield f"{document}: no word of {option}"


# Readers without a fuzzer of their own.
NOT_FUZZED = {"world": "its maps are files beside it"}


def check_formats(root):
    table = root / "lib/io/io.c"
    fuzzers = "".join(path.read_text(encoding="utf-8") for path in sorted((root / "tests/fuzz").glob("fuzz_*.c")))
    memory, document = "tests/unit/test_one_failure_study.c", "lib/io/FORMATS.md"
    rows = (root / memory).read_text(encoding="utf-8")
    told = (root / document).read_text(encoding="utf-8")
    text = table.read_text(encoding="utf-8")
    for endings, reader in re.findall(r'\.endings = "([^"]*)",.*?\.read = sli_map_read_(\w+)', text, re.DOTALL):
        if reader not in NOT_FUZZED and not re.search(rf"\bsli_map_read_{reader}\b", fuzzers):
            yield f"tests/fuzz: no fuzzer calls sli_map_read_{reader}"
        if not re.search(rf"^SEED\({reader}[,_].*\n", rows, re.MULTILINE):
            yield f"{memory}: no SEED({reader}, ...), a file of tests/fuzz/seeds"
        for ending in endings.split():
            if f"`{ending}`" not in told:
                yield f"{document}: no word of {ending}"


def check_headers(root, compilers):
    include = root / "lib/include"
    if not compilers:
        raise CannotTell("no compiler given")
    with tempfile.TemporaryDirectory() as scratch:
        for language, compiler, flags in compilers:
            for path in sorted((include / "sightline").glob("*.h")):
                name = path.relative_to(include).as_posix()
                # Twice: the guard is tested too. The function keeps the file from being empty.
                unit = pathlib.Path(scratch) / f"alone.{language}"
                unit.write_text(f'#include "{name}"\n' * 2 + "int main(void) { return 0; }\n")
                command = [compiler, *flags, "-Wall", "-Wextra", "-Wpedantic", "-Werror",
                           "-fsyntax-only", f"-I{include}", str(unit)]
                done = subprocess.run(command, stderr=subprocess.PIPE, text=True)
                if done.returncode:
                    yield f"{path.relative_to(root)}: not alone as {flags[0][5:]}:\n{done.stderr}"


def clang_tool(name, wanted):
    """The path of a clang tool of the wanted version."""
    program = shutil.which(f"{name}-{wanted}") or shutil.which(name)
    if not program:
        raise CannotTell(f"{name} is not here")
    version = subprocess.run([program, "--version"], stdout=subprocess.PIPE, text=True).stdout
    if not re.search(rf"version {wanted}\.", version):
        raise CannotTell(f"{name} {wanted} is asked for; here is {version.strip()}")
    return program


def check_format(root):
    program = clang_tool("clang-format", FORMAT_VERSION)
    files = [str(path) for path in
             sources(root, ["lib", "tools", "viewer", "tests"], {".c", ".h", ".cpp"})]
    done = subprocess.run([program, "--style=file", "--dry-run", "--Werror", *files],
                          stderr=subprocess.PIPE, text=True)
    seen = set()
    for name, line in re.findall(r"^(\S.*?):(\d+):\d+: error", done.stderr, re.MULTILINE):
        if name not in seen:
            seen.add(name)
            yield f"{pathlib.Path(name).relative_to(root)}:{line}: clang-format -i would change it"
    if done.returncode and not seen:
        yield done.stderr


def check_tidy(root, build):
    program = clang_tool("clang-tidy", TIDY_VERSION)
    database = pathlib.Path(build or "nowhere", "compile_commands.json")
    if not database.exists():
        raise CannotTell(f"there is no {database}: configure first, and name the folder by --build")
    folders = [(root / folder).resolve() for folder in ("lib", "tools", "viewer")]
    entries = json.loads(database.read_text(encoding="utf-8"))
    files = sorted({entry["file"] for entry in entries
                    if any(folder in pathlib.Path(entry["file"]).parents for folder in folders)})

    def tidy(file):
        command = [program, "-p", str(database.parent), "--quiet", file]
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        return done.returncode, done.stdout, done.stderr

    seen = set()
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for file, (status, stdout, stderr) in zip(files, pool.map(tidy, files)):
            found = re.findall(r"^(/.*?):(\d+:\d+): (?:error|warning): (.*)$", stdout, re.MULTILINE)
            for name, place, what in found:
                path = pathlib.Path(name).resolve().relative_to(root.resolve())
                if (path, place, what) not in seen:
                    seen.add((path, place, what))
                    yield f"{path}:{place}: {what}"
            if status and not found:
                yield f"{file}: clang-tidy ended with {status}:\n{stdout}{stderr}"


# What may go without a text of its own: fields, and values of enums.
NEEDS_NO_TEXT = re.compile(r"Member .+ \((?:variable|enumvalue|enumeration value)\) of ")


def check_doxygen(root):
    program = shutil.which("doxygen")
    if not program:
        raise CannotTell("doxygen is not here")
    with tempfile.TemporaryDirectory() as scratch:
        text = (root / "lib/Doxyfile").read_text(encoding="utf-8")
        text += f"\nOUTPUT_DIRECTORY = {scratch}\nWARN_IF_UNDOCUMENTED = YES\n"
        done = subprocess.run([program, "-"], input=text, cwd=root, stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, text=True)
    seen = set()
    for line in done.stderr.splitlines():
        found = re.match(r"(/.*?):(\d+): (?:warning|error): (.*)", line)
        if not found or NEEDS_NO_TEXT.match(found[3]) or line in seen:
            continue
        seen.add(line)
        # The filter of the Doxyfile puts a line before the others.
        path = pathlib.Path(found[1]).resolve().relative_to(root.resolve())
        yield f"{path}:{int(found[2]) - 1}: {found[3]}"
    if done.returncode:
        yield f"doxygen ended with {done.returncode}:\n{done.stderr}"


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("subject", choices=["layers", "table", "sources", "used", "silent", "headers", "format",
                                            "doxygen", "versions", "packages", "formats", "tidy"])
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("--cc", help="C compiler, for headers")
    parser.add_argument("--cxx", help="C++ compiler, for headers")
    parser.add_argument("--build", help="folder of a build, for tidy")
    options = parser.parse_args()
    if options.subject == "headers":
        compilers = [("c", options.cc, ["-std=c11"]), ("cpp", options.cxx, ["-std=c++11"])]
        missing = [flags[0][5:] for _, program, flags in compilers
                   if not (program and shutil.which(program))]
        compilers = [each for each in compilers if each[2][0][5:] not in missing]
        found = check_headers(options.root, compilers)
    else:
        missing = []
        check = {"layers": check_layers, "table": check_table, "sources": check_sources, "used": check_used,
                 "silent": check_silent, "format": check_format,
                 "doxygen": check_doxygen, "versions": check_versions,
                 "packages": check_packages, "formats": check_formats,
                 "tidy": lambda root: check_tidy(root, options.build)}
        found = check[options.subject](options.root)
    try:
        faults = list(found)
    except CannotTell as reason:
        print(f"{options.subject}: cannot tell: {reason}")
        return CANNOT_TELL
    for fault in faults:
        print(fault)
    if missing and not faults:
        print(f"{options.subject}: no compiler for {', '.join(missing)}")
        return CANNOT_TELL
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
