"""What each library links: links.py PART=FILE... ; PART is core, analysis, io, study, glpk or draw.

The core links the C library, the mathematics library and threads, nothing else. Every other part
links the core's and exactly the packages of the table below. Prints each fault; exits 0 without
faults, 1 with, 77 where readelf is not here.
"""
import re
import shutil
import subprocess
import sys

PACKAGES = {
    "core": set(),
    "analysis": set(),
    "io": {"libxml2", "libjansson", "libpng", "libyaml", "libz", "libzstd"},
    "study": set(),
    "glpk": {"libglpk"},
    "draw": {"libcairo", "libpangocairo", "libpango", "libgobject", "libglib"},
}
# Any library may link these.
ALWAYS = {"libc", "libm", "libpthread", "ld", "libsightline"}
CANNOT_TELL = 77


def plain_name(file_name):
    """libpng16.so.16 and libpng-1.6.so are libpng; ld-linux-x86-64.so.2 is ld."""
    name = re.sub(r"\.so\b.*", "", file_name)
    name = re.sub(r"-.*", "", name)
    return re.sub(r"^libpng\d+$", "libpng", name)


def linked(path):
    text = subprocess.run(["readelf", "-d", path], stdout=subprocess.PIPE, check=True,
                          universal_newlines=True).stdout
    return {plain_name(name) for name in re.findall(r"\(NEEDED\).*\[(.+)\]", text)}


def faults(part, found):
    for name in sorted(found - ALWAYS - PACKAGES[part]):
        yield f"{part} links {name}, which it must not"
    for name in sorted(PACKAGES[part] - found):
        yield f"{part} does not link {name}: take it out of the table"


def main():
    if not shutil.which("readelf"):
        print("readelf is not here")
        return CANNOT_TELL
    # That a fault would be found.
    assert len(list(faults("core", {"libc", "libz"}))) == 1
    assert len(list(faults("draw", {"libc"}))) == len(PACKAGES["draw"])
    found = []
    for argument in sys.argv[1:]:
        part, path = argument.split("=", 1)
        found += faults(part, linked(path))
    print("\n".join(found) or "as the table says")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
