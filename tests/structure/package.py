"""tools/package.sh packs the same files from a clone and from a release archive, and builds no tests for
what is installed: package.py ROOT

Programs that print the files in place of building stand on the PATH. Exits 77 where ROOT is no clone.
"""
import os
import pathlib
import subprocess
import sys
import tempfile

CANNOT_TELL = 77
ROOT = pathlib.Path(sys.argv[1]).resolve()
DEBIAN = "tools/packages/debian/"


def package(tree, kind, folder, programs):
    environment = dict(os.environ, PATH=f"{programs}:{os.environ['PATH']}")
    return subprocess.run(["sh", tree / "tools/package.sh", kind, folder], env=environment,
                          stdout=subprocess.PIPE, check=True, text=True).stdout.splitlines()


def packed(tree, folder, programs):
    return {line[2:] for line in package(tree, "deb", folder, programs) if line.startswith("./")}


def main():
    if not (ROOT / ".git").exists():
        return CANNOT_TELL
    names = subprocess.run(["git", "-C", ROOT, "ls-files", "-z"], stdout=subprocess.PIPE, check=True,
                           text=True).stdout.strip("\0").split("\0")
    expected = {name.replace(DEBIAN, "debian/", 1) for name in names}
    with tempfile.TemporaryDirectory() as folder:
        programs, archive = pathlib.Path(folder, "programs"), pathlib.Path(folder, "archive")
        programs.mkdir()
        for name in ("dpkg-buildpackage", "dh", "dh_python3", "doxygen"):
            (programs / name).write_text("#!/bin/sh\nfind . -type f\n")
            (programs / name).chmod(0o755)
        for name in ("cmake", "cpack", "lintian"):
            (programs / name).write_text('#!/bin/sh\necho "$@"\n')
            (programs / name).chmod(0o755)
        built = package(ROOT, "tarball", folder + "/tarball", programs)
        if not any("-DSIGHTLINE_TESTS=OFF" in line for line in built):
            print(f"the archive's build has tests: {built}")
            return 1
        archive.mkdir()
        subprocess.run(["tar", "-c", "--null", "-T", "-", "-f", folder + "/tar"], cwd=ROOT, check=True,
                       input="\0".join(names), text=True)
        subprocess.run(["tar", "-x", "-f", folder + "/tar"], cwd=archive, check=True)
        (archive / "build").mkdir()
        (archive / "build/made").touch()
        for tree, where in ((ROOT, folder + "/of_clone"), (archive, archive / "packages")):
            differ = packed(tree, where, programs) ^ expected
            if differ:
                print(f"{tree}: not packed, or not of the sources: {sorted(differ)[:5]}")
                return 1
    return 0


sys.exit(main())
