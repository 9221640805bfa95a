"""What the runtime's header promises: runtime.py SUBJECT ROOT [--command SIGHTLINE].

compile  it compiles without a warning as C99, C11, C++11 and C++17 by every compiler that is here, and
         needs nothing from outside but memcpy, memset and memcmp; clang in the place of
         Microsoft's compiler reads it and the library's headers without what only gcc knows
example  the program in its README compiles as it stands there, and runs
sizes    no test: bytes of its compiled code, as CSV

Exits 0 without faults, 1 with, 77 when it cannot tell.
"""
import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

CANNOT_TELL = 77
IMPLEMENTATION = ('#define SIGHTLINE_RUNTIME_IMPLEMENTATION\n#include "sightline_runtime.h"\n'
                  '#include "sightline_runtime.h"\n')
LANGUAGES = [("c", "c99", ["gcc", "clang"]), ("c", "c11", ["gcc", "clang"]),
             ("cpp", "c++11", ["g++", "clang++"]), ("cpp", "c++17", ["g++", "clang++"])]
# More than the project's own: what games are compiled with.
WARNINGS = ["-pedantic-errors", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion",
            "-Wsign-conversion", "-Wdouble-promotion", "-Wcast-qual", "-Wundef", "-Wvla",
            "-Wpointer-arith", "-Wformat=2", "-Werror"]
# What the programs in the README print, in their order: cells to draw, boxes that move.
EXAMPLES = [r"^[1-9]\d* cells to draw", r"^1 box in sight: the crate$"]
# What a compiler may call for copies in C without any library.
FREE = {"memcpy", "memset", "memcmp", "memmove", "bcmp"}


def run(command):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def compilers():
    for language, standard, programs in LANGUAGES:
        for program in filter(shutil.which, programs):
            yield language, standard, program


def check_compile(root, scratch):
    nm = shutil.which("nm")
    for language, standard, program in compilers():
        for text, what in ((IMPLEMENTATION, "implementation"),
                           ("#define SL_RUNTIME_WITHOUT_OLD_FILES\n" + IMPLEMENTATION, "without old files"),
                           ('#include "sightline_runtime.h"\nint nothing;\n', "declarations")):
            unit, made = scratch / f"unit.{language}", scratch / "unit.o"
            unit.write_text(text)
            done = run([program, f"-std={standard}", *WARNINGS, "-O2", f"-I{root / 'lib/runtime'}",
                        "-c", str(unit), "-o", str(made)])
            if done.returncode:
                yield f"{program} -std={standard}, {what}:\n{done.stdout}"
            elif nm:
                wanted = set(re.findall(r"\bU _?(\w+)", run([nm, "-u", str(made)]).stdout))
                foreign = {name for name in wanted - FREE if not name.startswith("_")}
                if foreign:
                    yield f"{program} -std={standard}, {what}: needs {', '.join(sorted(foreign))}"


# Headers of the C library, as far as ours need them: Microsoft's own are not here.
OF_MICROSOFT = {"string.h": "void *memcpy(void *, const void *, size_t);\nvoid *memset(void *, int, size_t);\n"
                            "int memcmp(const void *, const void *, size_t);\n",
                "stdio.h": "typedef struct file FILE;\n"}
MICROSOFT = ["--target=x86_64-pc-windows-msvc", "-fms-compatibility", "-fmsc-version=1930", "-fsyntax-only",
             "-Wall", "-Wextra", "-Wpedantic", "-Wgnu", "-Wvla", "-Wconversion", "-Werror"]


def check_microsoft(root, scratch):
    headers = [path.relative_to(root / "lib/include").as_posix()
               for path in sorted((root / "lib/include/sightline").glob("*.h"))]
    texts = {"the runtime header": IMPLEMENTATION,
             "the library's headers": "".join(f'#include "{name}"\n' for name in headers)}
    for name, text in OF_MICROSOFT.items():
        (scratch / name).write_text(
            "#include <stddef.h>\n#ifdef __cplusplus\nextern \"C\" {\n#endif\n" + text +
            "#ifdef __cplusplus\n}\n#endif\n")
    for language, standard, program in compilers():
        for what, text in texts.items() if program.startswith("clang") and standard != "c99" else ():
            unit = scratch / f"unit.{language}"
            unit.write_text(text)
            done = run([program, f"-std={standard}", *MICROSOFT, f"-isystem{scratch}", f"-I{root / 'lib/runtime'}",
                        f"-I{root / 'lib/include'}", str(unit)])
            if done.returncode:
                yield f"{program} -std={standard} for Microsoft, {what}:\n{done.stdout}"


def check_example(root, scratch, command):
    readme = (root / "lib/runtime/README.md").read_text(encoding="utf-8")
    programs = re.findall(r"^```c\n(.*?)^```", readme, re.MULTILINE | re.DOTALL)
    if len(programs) != len(EXAMPLES):
        yield f"lib/runtime/README.md: {len(programs)} programs, where {len(EXAMPLES)} are looked for"
        return
    bake = re.search(r"^sightline (bake .*)", readme, re.MULTILINE)[1].split()
    bake = [str(root / each) if each.startswith("maps/") else each for each in bake]
    shutil.copy(root / "lib/runtime/sightline_runtime.h", scratch)
    level = scratch / bake[-1]
    bake[-1] = str(level)
    for program, wanted in zip(programs, EXAMPLES):
        (scratch / "example.c").write_text(program)
        for line in ([command, *bake],
                     ["cc", *WARNINGS, str(scratch / "example.c"), "-o", str(scratch / "example")],
                     [str(scratch / "example"), str(level)]):
            done = run(line)
            if done.returncode:
                yield f"{' '.join(line)}:\n{done.stdout}"
                return
        print(done.stdout)
        if not re.search(wanted, done.stdout, re.MULTILINE):
            yield f"the example does not print {wanted}:\n{done.stdout}"


def print_sizes(root, scratch):
    print("compiler,standard,optimisation,code_and_constants,data")
    (scratch / "unit.c").write_text(IMPLEMENTATION)
    for program in filter(shutil.which, ["gcc", "clang"]):
        for optimisation in ("-Os", "-O2"):
            made = scratch / "unit.o"
            subprocess.run([program, "-std=c99", optimisation, f"-I{root / 'lib/runtime'}", "-c",
                            str(scratch / "unit.c"), "-o", str(made)], check=True)
            text, data, bss = run(["size", str(made)]).stdout.splitlines()[1].split()[:3]
            print(f"{program},c99,{optimisation},{text},{int(data) + int(bss)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("subject", choices=["compile", "example", "sizes"])
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("--command", help="the sightline command, for example")
    options = parser.parse_args()
    if not list(compilers()) or (options.subject == "example" and not shutil.which("cc")):
        print("no compiler is here")
        return CANNOT_TELL
    with tempfile.TemporaryDirectory() as directory:
        scratch = pathlib.Path(directory)
        if options.subject == "sizes":
            print_sizes(options.root, scratch)
            return 0
        faults = [*check_compile(options.root, scratch), *check_microsoft(options.root, scratch)] \
            if options.subject == "compile" else list(check_example(options.root, scratch, options.command))
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
