"""Spelling of documents, comments and help: spelling.py ROOT [PROGRAM]

aspell knows the words of English. words.txt beside this file has the project's own: names, terms, formats.
With PROGRAM its help counts as well, and a word there that no text has is a fault.
Exit status 77 where there is no aspell.
"""
import pathlib
import re
import shutil
import subprocess
import sys

OWN = pathlib.Path(__file__).with_name("words.txt")


def prose_of_markdown(text):
    text = re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL)
    text = re.sub(r"`[^`]*`", " ", text)
    return re.sub(r"\]\([^)]*\)", "]", text)


def prose_of_c(text):
    comments = re.findall(r"/\*.*?\*/|//[^\n]*", text, re.DOTALL)
    kept = [each for each in comments if not re.match(r"///?\s{4,}", each)]  # examples in code
    return re.sub(r"`[^`]*`|'[^'\s]+'|\"[^\"\n]*\"", " ", "\n".join(kept))


def help_pages(program):
    """What `--help all` of each command prints."""
    def run(*arguments):
        return subprocess.run([program, *arguments], text=True, capture_output=True, check=True).stdout

    yield run("--help")
    for line in run("--help", "words").splitlines():
        yield run(line.split("\t")[0], "--help", "all")


def prose_of_help(page):
    """Without examples, names of options and of what they take, and the first column of tables."""
    page = page.split("\nexamples:\n")[0]
    page = re.sub(r"^usage:.*$|^  (?:-\w, )?--\S+(?: \S+)?|^  \S+", " ", page, flags=re.MULTILINE)
    return re.sub(r"'[^'\n]*'", " ", page)


def words(prose):
    """Words with the line's other text gone: no identifiers, numbers or options."""
    prose = re.sub(r"--?[\w-]+|\S*[_/\\<>=@#$%^*{}()\[\].]+\w\S*|\b\w*\d\w*\b", " ", prose)
    return {re.sub(r"'s?$", "", each) for each in re.findall(r"(?<![\w-])[A-Za-z][a-z']{2,}(?![\w-]*[A-Z_\d])", prose)}


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    if not shutil.which("aspell"):
        print("skipped: there is no aspell")
        return 77
    own = {line.strip() for line in OWN.read_text(encoding="utf-8").splitlines()} - {""}
    found = {}
    for path in sorted(root.rglob("*")):
        name = path.relative_to(root)
        if name.parts[0] in ("build", "out", ".git") or path.suffix not in (".md", ".c", ".h"):
            continue
        text = path.read_text(encoding="utf-8")
        for word in words(prose_of_markdown(text) if path.suffix == ".md" else prose_of_c(text)):
            found.setdefault(word, name)
    for page in help_pages(sys.argv[2]) if len(sys.argv) > 2 else []:
        for word in words(prose_of_help(page)):
            found.setdefault(word, "--help")
    ask = subprocess.run(["aspell", "list", "--lang=en", "--encoding=utf-8"], input="\n".join(found),
                         text=True, capture_output=True, check=True)
    wrong = sorted(set(ask.stdout.split()) - own, key=str.lower)
    idle = sorted(own - set(found), key=str.lower) if len(sys.argv) > 2 else []
    for word in wrong:
        print(f"{found.get(word, '?')}: {word}")
    for word in idle:
        print(f"{OWN.name}: no text has the word {word}: take it out")
    if not found:
        print("there is no text")
    return 1 if wrong or idle or not found else 0


if __name__ == "__main__":
    sys.exit(main())
