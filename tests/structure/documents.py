"""The documents, held against the tree: documents.py SUBJECT ROOT [FOLDER_OF_THE_COMMAND]

run    every command of a block `sh` runs, in a folder that has maps/ and the maps beside the document. They are
       commands of `sightline`. Other blocks say what becomes of them: `sh not-run` (it needs files that are not
       here, or takes long), `sh run-by-ci`, `sh run-by-test` (a test of its own runs it).
links  every link to a file or to a heading leads somewhere.
options  every option that a text names in code is one: of the command that stands before it, or of any program here.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

# Run by a test of their own, with what their text says beside the commands.
ELSEWHERE = {"maps/FORMAT.md"}
# Of esbuild, valgrind and sbatch.
FOREIGN = {"--bundle", "--tool", "--toggle-collect", "--separate-threads", "--fair-sched", "--branch-sim", "--cache-sim",
           "--array"}
OPTION = r"(?<![\w-])--[a-z][\w-]*"


def texts(root, *endings):
    for path in sorted(root.rglob("*")):
        name = path.relative_to(root)
        if path.suffix in endings and name.parts[0] not in ("build", "out", ".git"):
            yield name, path.read_text(encoding="utf-8")


def documents(root):
    return texts(root, ".md")


def commands(text):
    """The commands of the blocks that are run, with lines joined that end in a backslash."""
    for block in re.findall(r"^```sh\n(.*?)^```", text, re.MULTILINE | re.DOTALL):
        for line in block.replace("\\\n", " ").split("\n"):
            if line and not line.startswith("#"):
                yield line


def run(root, command):
    path = f"{command}{os.pathsep}{os.environ['PATH']}"
    count = 0
    for name, text in documents(root):
        lines = [] if name.as_posix() in ELSEWHERE or name.parts[0] == ".github" else list(commands(text))
        if not lines:
            continue
        with tempfile.TemporaryDirectory() as scratch:
            if name.parent.name != "maps":
                for each in (root / name.parent).glob("*.map"):
                    shutil.copy(each, scratch)
            (pathlib.Path(scratch) / "maps").symlink_to(root / "maps")
            for line in lines:
                print(f"{name}: {line}", flush=True)
                if not line.startswith("sightline "):
                    yield f"{name}: mark the block as not-run, run-by-ci or run-by-test: {line}"
                    continue
                count += 1
                done = subprocess.run(line, shell=True, cwd=scratch, env={**os.environ, "PATH": path},
                                      stdout=subprocess.DEVNULL, check=False)
                if done.returncode:
                    yield f"{name}: exit status {done.returncode}: {line}"
    if not count:
        yield "no document has a line to run"


def anchor(heading):
    """The anchor of a heading, as GitHub makes it."""
    plain = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
    return re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")


def without_code(text):
    return re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL)


def links(root):
    headings = {name: {anchor(each) for each in re.findall(r"^#+ (.*)", without_code(text), re.MULTILINE)}
                for name, text in documents(root)}
    count = 0
    for name, text in documents(root):
        for target in re.findall(r"\]\(\s*([^)\s]+)\s*\)", without_code(text)):
            if re.match(r"[a-z]+:", target):
                continue
            count += 1
            file, _, part = target.partition("#")
            path = (root / name.parent / file).resolve() if file else root / name
            if not path.exists():
                yield f"{name}: no file at {target}"
            elif part and path.suffix == ".md" and part not in headings[path.relative_to(root)]:
                yield f"{name}: no heading at {target}"
    if not count:
        yield "no document has a link"


def command_options(folder):
    """By command: its options, as its help lists them."""
    def first_words(*arguments):
        done = subprocess.run([folder / "sightline", *arguments, "--help", "words"], text=True,
                              capture_output=True, check=True)
        return {line.split("\t")[0] for line in done.stdout.splitlines()}

    return {name: first_words(name) for name in first_words() if not name.startswith("-")}


def options(root, folder):
    of_commands = command_options(folder)
    anywhere = FOREIGN.union(*of_commands.values(), {"--help", "--version"})
    for _, text in texts(root, ".py", ".sh", ".js", ".mjs", ".c", ".json"):
        anywhere |= set(re.findall(OPTION, text))
    count = 0
    for name, text in documents(root):
        if name.name == "CHANGELOG.md":  # it names what is gone
            continue
        for span in re.findall(r"`([^`]*)`", without_code(text)):
            command = re.match(r"(?:sightline )?([a-z]+)(?= )", span)
            known = of_commands.get(command[1], anywhere) if command else anywhere
            for option in re.findall(OPTION, span):
                count += 1
                if option not in known:
                    yield f"{name}: there is no option {option}: {span}"
    if not count:
        yield "no document names an option"


def main():
    subject, root = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    if subject == "links":
        faults = list(links(root))
    else:
        faults = list({"run": run, "options": options}[subject](root, pathlib.Path(sys.argv[3]).resolve()))
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
