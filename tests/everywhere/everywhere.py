#!/usr/bin/env python3
"""The same bytes everywhere: builds the core for other machines and compares what it computes.

    python3 tests/everywhere/everywhere.py [TARGET...] [--build DIR] [--install] [--quick] [--tests NAMES]

For each target it builds the library and `same_bytes`. Every corpus map is baked there, and generated
ones too. One hash stands for the bytes of a baked file, one for the answers of the runtime header.
They must be those of this machine's gcc. The unit tests run where Debian has the packages that they
need for that machine. Other machines are emulated (qemu-user, Wine, node).

On Windows the command is tried too: windows.py. --quick compiles with -O1, and runs no unit tests but
those that are named.

Without a target all of them are tried. One whose compiler or emulator is missing is skipped, and
says so; --install asks apt-get for them first (as root). The exit status is 0 when all agree, 77 when
nothing could be tried, else 1.
"""
import argparse
import hashlib
import os
import re
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import windows

SOURCE = Path(__file__).resolve().parents[2]
LIBRARIES = ["libcmocka-dev", "libgmp-dev", "libjansson-dev", "libpng-dev", "libxml2-dev",
             "libyaml-dev", "libzstd-dev", "zlib1g-dev"]
# The part of their random inputs that unit tests try under qemu.
SEEDS = "/5"


@dataclass
class Target:
    """A compiler with its flags, and how its programs run here."""
    name: str
    compiler: str
    flags: str = ""
    system: str = ""          # CMAKE_SYSTEM_NAME, empty for this machine
    processor: str = ""
    emulator: tuple = ()
    debian: str = ""          # Debian's name of the machine, for the libraries of the unit tests
    folder: str = ""          # where Debian keeps them, below usr/lib
    release: str = ""         # of Debian, where this machine's own does not know that machine yet
    ending: str = ""          # of programs
    packages: tuple = ()
    options: tuple = ()


def linux(name, triple, debian, qemu="", release=""):
    return Target(name, f"{triple}-gcc", "", "Linux", name, (f"qemu-{qemu or name}", "-L", f"/usr/{triple}"), debian,
                  triple, release, packages=(f"gcc-{triple}", f"libc6-dev-{debian}-cross", "qemu-user"))


# Not by gcc -m32, whose package Debian does not install beside the other compilers.
I386_LOADER = "/usr/i686-linux-gnu/lib/ld-linux.so.2"  # this machine's own processor


def i386(name, flags, debian=""):
    return Target(name, "i686-linux-gnu-gcc", f"{flags} -msse2 -mfpmath=sse".strip(), "Linux", "i386",
                  (I386_LOADER, "--library-path", "/usr/i686-linux-gnu/lib"), debian, "i386-linux-gnu",
                  packages=("gcc-i686-linux-gnu", "libc6-dev-i386-cross"))


WASI = ("node", "--no-warnings", str(SOURCE / "tests" / "everywhere" / "wasi.mjs"))


TARGETS = [
    Target("gcc-O0", "gcc", "-O0"),
    Target("gcc-O1", "gcc", "-O1"),
    Target("gcc-O3", "gcc", "-O3"),
    Target("gcc-O3-native", "gcc", "-O3 -march=native"),
    Target("clang-O0", "clang", "-O0", packages=("clang",)),
    Target("clang-O2", "clang", "-O2", packages=("clang",)),
    Target("clang-O3-native", "clang", "-O3 -march=native", packages=("clang",)),
    # A number that changes where it is stored ends the program. Unsigned ones wrap on purpose: hashes,
    # random numbers, and the limbs of exact arithmetic.
    Target("sanitized", "clang", "-O1 -fsanitize=undefined,integer -fno-sanitize-recover=all "
           "-fno-sanitize=unsigned-integer-overflow,unsigned-shift-base", packages=("clang", "libclang-rt-dev")),
    i386("i386", "", "i386"),
    i386("i386-O0", "-O0"),
    i386("i386-O3-native", "-O3 -march=native"),
    linux("aarch64", "aarch64-linux-gnu", "arm64"),
    linux("armhf", "arm-linux-gnueabihf", "armhf", "arm"),
    linux("riscv64", "riscv64-linux-gnu", "riscv64", release="sid"),
    linux("ppc64el", "powerpc64le-linux-gnu", "ppc64el", "ppc64le"),
    linux("s390x", "s390x-linux-gnu", "s390x"),
    Target("musl", "musl-gcc", packages=("musl-tools",), options=("-DSIGHTLINE_IO=OFF",)),
    Target("windows", "x86_64-w64-mingw32-gcc", "", "Windows", "x86_64", ("wine",), ending=".exe",
           packages=("gcc-mingw-w64-x86-64", "wine", "wine64")),
    Target("wasm", "clang", "-O2", "WASI", "wasm32", WASI, ending=".wasm",
           packages=("clang", "lld", "wasi-libc", "libclang-rt-dev-wasm32", "nodejs"),
           options=(f"-DCMAKE_TOOLCHAIN_FILE={SOURCE / 'lib' / 'cmake' / 'wasi.cmake'}",
                    f"-DCMAKE_C_COMPILER={shutil.which('clang')}", "-DSIGHTLINE_WASM=ON", "-DCMAKE_C_FLAGS_RELEASE=-DNDEBUG")),
]
REFERENCE = Target("gcc", "gcc", "-O2")


class Failure(Exception):
    """A step that did not do what it should."""


def run(command, log, **more):
    """Runs a command with its output in a log file; Failure where it ends with another status than 0."""
    with open(log, "ab") as out:
        out.write(("$ " + " ".join(map(str, command)) + "\n").encode())
        out.flush()
        if subprocess.run(command, stdout=out, stderr=out, stdin=subprocess.DEVNULL, **more).returncode:
            last = Path(log).read_text(errors="replace").splitlines()[-12:]
            raise Failure(f"{command[0]} failed; the end of {log}:\n    " + "\n    ".join(last))


def missing_tools(target):
    wanted = [target.compiler, "cmake", "ninja", *target.emulator[:1]]
    return [tool for tool in wanted if not shutil.which(tool)]


def can_compile(target, folder):
    """Whether the compiler has what a program of its target needs, such as libraries for -m32."""
    source = folder / "try.c"
    source.write_text("#include <stdio.h>\nint main(void) { return puts(\"\") < 0; }\n")
    command = [target.compiler, *target.flags.split(), str(source), "-o", str(folder / "try")]
    return subprocess.run(command, capture_output=True).returncode == 0


# ---- Libraries of another machine, in a folder of their own ----

def fetch_libraries(target, folder):
    """Unpacks the development packages of a Debian machine below folder/root; None where they are
    not to be had. Nothing of this machine's own packages changes."""
    root = folder / "root"
    if (root / "done").exists():
        return root
    lists = Path("/etc/apt/sources.list.d/debian.sources")
    if not shutil.which("apt-get") or not lists.exists():
        return None
    state = folder / "apt"
    for part in ("lists/partial", "archives/partial", "sources"):
        (state / part).mkdir(parents=True, exist_ok=True)
    sources = lists.read_text()
    if target.release:
        sources = re.sub(r"(?m)^Suites:.*", f"Suites: {target.release}", sources.split("\n\n")[0])
    (state / "sources" / lists.name).write_text(sources)
    options = {"Dir::State::lists": state / "lists", "Dir::State::status": "/dev/null",
               "Dir::Cache": state, "Dir::Cache::archives": state / "archives",
               "Dir::Etc::sourceparts": state / "sources", "Dir::Etc::sourcelist": "/dev/null",
               "APT::Architecture": target.debian, "APT::Architectures": target.debian,
               "APT::Sandbox::User": "root", "Debug::NoLocking": 1}
    apt = ["apt-get", "-q", "-y"] + [f"-o{name}={value}" for name, value in options.items()]
    log = folder / "apt.log"
    try:
        run([*apt, "update"], log)
    except Failure:
        pass  # a mirror that is just being renewed; older lists may do
    try:
        run([*apt, "--no-install-recommends", "--download-only", "install", *LIBRARIES], log)
    except Failure as failure:
        print(f"{target.name}: without unit tests: {failure}", file=sys.stderr)
        return None
    root.mkdir(exist_ok=True)
    # The compiler brings its own C library; but libraries of a later release need a later one to run.
    own = ("libc6-", "libc-", "linux-libc-") if target.release else ("libc6", "libc-")
    for package in sorted((state / "archives").glob("*.deb")):
        if not package.name.startswith(own):
            run(["dpkg", "-x", str(package), str(root)], log)
    if not (root / "lib").exists():
        (root / "lib").symlink_to("usr/lib")
    for link in root.rglob("*.so"):  # absolute links would lead to this machine's own files
        if link.is_symlink() and os.readlink(link).startswith("/"):
            there = root / os.readlink(link)[1:]
            link.unlink()
            link.symlink_to(os.path.relpath(there, link.parent))
    (root / "done").touch()
    return root


# ---- Building and running ----

def configure(target, folder, root):
    build = folder / ("build" if root else "core")  # apart: CMake keeps which libraries it found
    command = ["cmake", "-S", str(SOURCE), "-B", str(build), "-G", "Ninja",
               f"-DCMAKE_C_COMPILER={target.compiler}", "-DCMAKE_BUILD_TYPE=Release",
               "-DSIGHTLINE_EVERYWHERE=ON",
               "-DSIGHTLINE_GLPK=OFF", "-DSIGHTLINE_DRAW=OFF", "-DSIGHTLINE_VIEWER=OFF",
               "-DSIGHTLINE_INSTALL=OFF", "-DSIGHTLINE_WERROR=ON", *target.options]
    if "-O" in target.flags:
        command.append("-DCMAKE_C_FLAGS_RELEASE=-DNDEBUG")
    if shutil.which("ccache"):
        command.append("-DCMAKE_C_COMPILER_LAUNCHER=ccache")
    environment = dict(os.environ)
    flags = target.flags
    if target.system and target.system != "WASI":
        command += [f"-DCMAKE_SYSTEM_NAME={target.system}", f"-DCMAKE_SYSTEM_PROCESSOR={target.processor}",
                    "-DCMAKE_CROSSCOMPILING_EMULATOR=" + ";".join(emulator(target, root))]
        if root:
            libraries = root / "usr/lib" / target.folder
            flags += f" -isystem {root}/usr/include/{target.folder}"
            environment |= {"PKG_CONFIG_LIBDIR": f"{libraries}/pkgconfig:{root}/usr/share/pkgconfig",
                            "PKG_CONFIG_SYSROOT_DIR": str(root)}
            command += [f"-DCMAKE_FIND_ROOT_PATH={root}", "-DCMAKE_FIND_ROOT_PATH_MODE_PROGRAM=NEVER",
                        "-DCMAKE_FIND_ROOT_PATH_MODE_LIBRARY=ONLY",
                        "-DCMAKE_FIND_ROOT_PATH_MODE_INCLUDE=ONLY",
                        f"-DCMAKE_LIBRARY_ARCHITECTURE={target.folder}",
                        f"-DCMAKE_EXE_LINKER_FLAGS=-L{libraries} "
                        f"-Wl,-rpath-link,{libraries}:{root}/lib/{target.folder}" +
                        (" -Wl,--allow-shlib-undefined" if target.release else "")]
    parts = "ON" if root else "OFF"
    command += [f"-DSIGHTLINE_IO={parts}", f"-DSIGHTLINE_TESTS={parts}", "-DSIGHTLINE_PYTHON=OFF"]
    run([*command, f"-DCMAKE_C_FLAGS={flags}"], folder / "build.log", env=environment)
    return build


def chosen_tests(wanted):
    """ctest's options for the unit tests of these names; all where none are named."""
    return ["-R", f"^test_({wanted})$" if wanted else "^test_"]


def build_targets(target, build, folder, root, wanted=""):
    """What runs afterwards, and no more."""
    programs = ["same_bytes"]
    if target.system == "Windows":
        programs.append("sightline_command")
    if root:
        listed = subprocess.run(["ctest", "--test-dir", str(build), "-N", *chosen_tests(wanted)],
                                capture_output=True, text=True, check=True).stdout
        programs += [line.split()[-1] for line in listed.splitlines() if ": test_" in line]
    run(["cmake", "--build", str(build), "--target", *programs], folder / "build.log")


def emulator(target, root):
    """What runs a program; the loader itself is told where libraries lie."""
    if root and target.release:
        return (*target.emulator[:2], str(root))
    if root and target.emulator[:1] == (I386_LOADER,):
        libraries = f"{target.emulator[2]}:{root}/usr/lib/{target.folder}:{root}/lib/{target.folder}"
        return (*target.emulator[:2], libraries)
    return target.emulator


def library_path(target, root):
    if not root:
        return {}
    return {"QEMU_SET_ENV": f"LD_LIBRARY_PATH={root}/usr/lib/{target.folder}:"
                            f"{root}/lib/{target.folder}"}


def hashes(target, build, corpus, root):
    program = build / "tests" / "everywhere" / f"same_bytes{target.ending}"
    environment = dict(os.environ, WINEDEBUG="-all", **library_path(target, root))
    done = subprocess.run([*emulator(target, root), str(program), *map(str, corpus)], capture_output=True,
                          text=True, env=environment, cwd=build)  # where it writes its file
    if done.returncode:
        raise Failure(f"{program} ended with {done.returncode}: {done.stderr[-600:]}")
    return done.stdout.replace("\r", "")


def unit_tests(target, build, folder, root, wanted):
    """How many unit tests passed, of how many."""
    command = ["ctest", "--test-dir", str(build), *chosen_tests(wanted), "--timeout", "3600",
               "-j", str(os.cpu_count())]
    environment = dict(os.environ, **library_path(target, root))
    if target.emulator[0].startswith("qemu"):
        environment.setdefault("SIGHTLINE_SEEDS", SEEDS)
    done = subprocess.run(command, capture_output=True, text=True, env=environment)
    (folder / "tests.log").write_text(done.stdout + done.stderr)
    summary = [line for line in done.stdout.splitlines() if "tests passed" in line]
    if not summary:
        raise Failure(f"no test ran: see {folder / 'tests.log'}")
    for line in done.stdout.splitlines():
        if "***" in line:
            print(f"{target.name}: {' '.join(line.split()[3:])}", file=sys.stderr)
    failed, total = int(summary[0].split("passed, ")[1].split()[0]), int(summary[0].split()[-1])
    return total - failed, total


def compare(expected, got):
    """(What the table says, whether all is the same): a map is a line, the same on both sides."""
    wanted, lines = expected.splitlines(), got.splitlines()
    if [line.split()[-1] for line in wanted] != [line.split()[-1] for line in lines]:
        return "not the same maps", False
    same = sum(a == b for a, b in zip(wanted, lines))
    return f"{same} of {len(wanted)} same", same == len(wanted) > 0


def self_test():
    """What is not the same is found."""
    good = "9 ab cd a.map\n8 ef 01 b.map\n"
    assert compare(good, good) == ("2 of 2 same", True)
    for bad in (good.replace("ab", "aa"), good.replace("01", "02"), good.replace("9", "8")):
        assert compare(good, bad) == ("1 of 2 same", False)
    for bad in ("", good[:14], good + "1 2 3 c.map\n", good.replace("b.map", "c.map")):
        assert not compare(good, bad)[1]
    assert not compare("", "")[1]


def try_target(target, base, corpus, expected, arguments):
    """A row of the table: its cells, and whether all is well (None: skipped)."""
    folder = base / target.name
    folder.mkdir(parents=True, exist_ok=True)
    missing = missing_tools(target)
    if missing or not (target.system or can_compile(target, folder)):
        what = ", ".join(missing) or f"libraries for {target.flags}"
        return [target.name, target.compiler, target.flags, "skipped", f"not here: {what}"], None
    root = fetch_libraries(target, folder) if target.debian and (arguments.tests or not arguments.quick) \
        else None
    build = configure(target, folder, root)
    build_targets(target, build, folder, root, arguments.tests)
    got = hashes(target, build, corpus, root)
    text, same = compare(expected, got)
    (folder / "hashes.txt").write_text(got)
    passed, total = unit_tests(target, build, folder, root, arguments.tests) if root else (0, 0)
    if target.system == "Windows":
        passed, total = windows.run_all(build / "tools" / "sightline.exe", folder, SOURCE)
    tests = f"{passed} of {total}" if total else "none"
    return [target.name, version(target.compiler), target.flags, tests, text], \
        same and passed == total


def version(compiler):
    first = subprocess.run([compiler, "--version"], capture_output=True, text=True).stdout.splitlines()
    number = re.search(r"\b\d+(\.\d+)?", first[0])
    return f"{'clang' if 'clang' in first[0] else 'gcc'} {number.group() if number else ''}".strip()


def processor_time():
    """What compilers and programs that ended took, in seconds."""
    times = os.times()
    return times.children_user + times.children_system


def install(targets):
    packages = sorted({package for target in targets for package in target.packages})
    subprocess.run(["apt-get", "install", "-q", "-y", "--no-install-recommends", *packages], check=True)


def parse():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    names = [target.name for target in TARGETS]
    parser.add_argument("target", nargs="*", help="of " + ", ".join(names))
    parser.add_argument("--build", default=str(SOURCE / "build" / "everywhere"), metavar="DIR")
    parser.add_argument("--install", action="store_true", help="install compilers and emulators")
    parser.add_argument("--quick", action="store_true", help="-O1, and no unit tests but those named")
    parser.add_argument("--self-test", action="store_true", help="tries that a difference is found")
    parser.add_argument("--tests", default="", metavar="NAMES", help="unit tests: a regular expression")
    arguments = parser.parse_args()
    unknown = [name for name in arguments.target if name not in names]
    if unknown:
        parser.error(f"unknown target {unknown[0]}: there are {', '.join(names)}")
    return arguments


def main():
    arguments = parse()
    if arguments.self_test:
        self_test()
        return 0
    base = Path(arguments.build).resolve()
    wanted = [t for t in TARGETS if not arguments.target or t.name in arguments.target]
    for target in [REFERENCE, *wanted] if arguments.quick else []:
        if target.system != "WASI":
            target.flags = f"{target.flags} -O1".strip()
    if arguments.install:
        install(wanted)
    corpus = sorted([*SOURCE.glob("maps/*.map"), *SOURCE.glob("maps/*/*.map"),
                     *SOURCE.glob("tests/cases/*.map")])
    (base / REFERENCE.name).mkdir(parents=True, exist_ok=True)
    build = configure(REFERENCE, base / REFERENCE.name, None)
    build_targets(REFERENCE, build, base / REFERENCE.name, None)
    expected = hashes(REFERENCE, build, corpus, None)
    lines = expected.splitlines()
    print(f"{len(lines)} lines of {len(corpus)} maps by {version('gcc')}; all of it as one hash: "
          f"{hashlib.sha256(expected.encode()).hexdigest()[:16]}\n", flush=True)
    print("| target | compiler | flags | unit tests | hashes |\n| --- | --- | --- | --- | --- |", flush=True)
    results = []
    for target in wanted:
        start, begun = time.time(), processor_time()
        try:
            row, good = try_target(target, base, corpus, expected, arguments)
        except Failure as failure:
            row, good = [target.name, target.compiler, target.flags, "failed", "failed"], False
            print(failure, file=sys.stderr)
        results.append(good)
        print("| " + " | ".join(row) + " |", flush=True)
        print(f"{target.name}: {time.time() - start:.0f} s, of processors {processor_time() - begun:.0f} s", file=sys.stderr, flush=True)
    if all(good is None for good in results):
        return 77
    return 1 if False in results else 0


if __name__ == "__main__":
    sys.exit(main())
