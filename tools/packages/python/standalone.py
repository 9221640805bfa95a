"""A wheel that needs no library of the system but those that every Linux has:

    python3 tools/packages/python/standalone.py WHEEL FOLDER

What auditwheel does, for machines that cannot have it: needed libraries that the policy of manylinux (PEP 600) does not
name go into sightline.libs/ with their licences, and the tag says the newest glibc that a symbol asks for. patchelf,
readelf and objdump are needed, and for the licences Debian's /usr/share/doc. Prints the path of the new wheel.
"""
import base64
import hashlib
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

# Libraries that the policy lets be used from the system, as far as ours can need them.
OF_THE_SYSTEM = re.compile(r"(lib(c|m|pthread|dl|rt|stdc\+\+|gcc_s)\.so\.|ld-linux)")
LIBS = "sightline.libs"
DATE = (1980, 1, 1, 0, 0, 0)  # the same bytes at any time


def run(*command):
    return subprocess.run([str(word) for word in command], check=True, stdout=subprocess.PIPE, text=True).stdout


def needed(library):
    return re.findall(r"\(NEEDED\).*\[(.+)\]", run("readelf", "-d", library))


def found(library):
    """Where the loader finds what a library needs, by name; all that its own libraries need, too."""
    return {name: pathlib.Path(path).resolve()
            for name, path in re.findall(r"^\s*(\S+) => (/\S+)", run("ldd", library), re.MULTILINE)
            if not OF_THE_SYSTEM.match(name)}


def licence(path):
    """The file that says under what terms a library of Debian may be passed on."""
    package = run("dpkg-query", "-S", f"*/{path.name}").split(":")[0]  # /lib and /usr/lib are one folder
    return package, pathlib.Path("/usr/share/doc", package, "copyright")


def gather(main, target):
    """Copies what `main` needs beside it, and lets each find the others there."""
    others = found(main)
    target.mkdir()
    for name, path in others.items():
        shutil.copy(path, target / name)
        package, terms = licence(path)
        shutil.copy(terms, target / f"LICENCE.{package}")
    run("patchelf", "--force-rpath", "--set-rpath", f"$ORIGIN/../{LIBS}", main)
    for name in others:
        run("patchelf", "--force-rpath", "--set-rpath", "$ORIGIN", target / name)
    libraries = [main, *(target / name for name in others)]
    missing = {name for library in libraries for name in needed(library)
               if name not in others and not OF_THE_SYSTEM.match(name)}
    if missing:
        sys.exit(f"standalone: not found: {', '.join(sorted(missing))}")
    return libraries


def newest_glibc(libraries):
    return max((int(major), int(minor)) for library in libraries
               for major, minor in re.findall(r"GLIBC_(\d+)\.(\d+)", run("objdump", "-T", library)))


def record_line(name, data):
    digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(data)}\n"


def write(tree, path):
    info = next(tree.glob("*.dist-info"))
    record, lines = info / "RECORD", []
    record.unlink()
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as wheel:
        for file in sorted(p for p in tree.rglob("*") if p.is_file()):
            name, data = file.relative_to(tree).as_posix(), file.read_bytes()
            entry = zipfile.ZipInfo(name, DATE)
            entry.external_attr = (0o100755 if ".so" in file.name else 0o100644) << 16
            wheel.writestr(entry, data, zipfile.ZIP_DEFLATED)
            lines.append(record_line(name, data))
        name = record.relative_to(tree).as_posix()
        wheel.writestr(zipfile.ZipInfo(name, DATE), "".join(lines) + f"{name},,\n", zipfile.ZIP_DEFLATED)


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: standalone.py WHEEL FOLDER")
    wheel, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    with tempfile.TemporaryDirectory() as scratch:
        tree = pathlib.Path(scratch, "tree")
        with zipfile.ZipFile(wheel) as archive:
            archive.extractall(tree)
        libraries = gather(tree / "sightline/libsightline_python.so", tree / LIBS)
        version = "_".join(str(number) for number in newest_glibc(libraries))
        machine = re.search(r"-linux_(\w+)\.whl$", wheel.name)[1]
        tag = f"manylinux_{version}_{machine}"
        about = next(tree.glob("*.dist-info")) / "WHEEL"
        about.write_text(about.read_text().replace(f"linux_{machine}", tag))
        path = folder / wheel.name.replace(f"linux_{machine}", tag)
        write(tree, path)
    print(path)


main()
