#!/usr/bin/env python3
"""Writes the core library as two files, sightline.c and sightline.h: amalgamate.py FOLDER

The header is every public header of the core, in the order that they need each other. The source is
each source of the core with the private headers that it is the first to include. A name of one file
(static functions, types, constants) that another file has, too, is led by its file's name: `product`
of orient.c becomes `orient_product`. Macros of a file end with it. sightline.c sets what the library
needs of a compiler by itself, and refuses flags that would change signs: see `HEAD`.
"""
import re
import sys
from collections import Counter
from pathlib import Path

LIB = Path(__file__).resolve().parents[3] / "lib"
TOKEN = re.compile(r"""//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*'|[A-Za-z_]\w*|\.?\d[\w.]*(?:(?<=[eEpP])[+-]\w+)*"""
                   r"""|->|\.\.\.|\#\#|\n|[ \t]+|.""", re.S)
INCLUDE = re.compile(r'^#include "([^"]+)"[^\n]*\n', re.M)
GUARD = re.compile(r"^#ifndef (\w+_H)\n#define \1\n", re.M)
DIRECTIVE = re.compile(r"^[ \t]*#(?:[^\n\\]|\\.)*\n", re.M | re.S)
MACRO = re.compile(r"^#define (\w+)", re.M)
NAME = re.compile(r"[A-Za-z_]\w*$")
# Names that a system header has, which one file alone would not include.
SYSTEM = {"link", "write"}
# Text that a source has in its midst, and that stands on what is before it.
PART = re.compile(r'^#include "(runtime/parts/[^"]+)"[^\n]*\n', re.M)
WORDS = set("auto const double enum extern float inline int long register return short signed sizeof static struct "
            "typedef union unsigned void volatile char bool __attribute__ _Static_assert _Thread_local".split())
NOTICE = """\
/// Sightline %s: the core library in one %s, made from its sources.
///
///     gcc -O2 program.c sightline.c -pthread -lm
///
%s
"""
HEAD = """
#if !defined(__GNUC__)
#error "sightline.c: this is for gcc and clang"
#endif
#if !defined(__STDC_VERSION__) || __STDC_VERSION__ < 201112L
#error "sightline.c: compile it as C11 or later; C++ programs include sightline.h and link it"
#endif
// These flags round sums another way, so that exact signs and files would differ.
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || \\
    defined(__NO_SIGNED_ZEROS__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "sightline.c: compile it without -ffast-math, -Ofast and their parts"
#endif
// Nor is a multiply and an add made one. The vectorizer of gcc does it all the same.
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#pragma clang fp reassociate(off)
#else
#pragma GCC optimize("fp-contract=off", "no-tree-vectorize")
#endif
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"

#ifndef _XOPEN_SOURCE
#define _XOPEN_SOURCE 700
#endif
#ifndef _FILE_OFFSET_BITS
#define _FILE_OFFSET_BITS 64
#endif
#if defined(__MINGW32__) && !defined(__USE_MINGW_ANSI_STDIO)
#define __USE_MINGW_ANSI_STDIO 1
#endif
#include "sightline.h"
"""
TAIL = """
// --- What no macro tells: clang with -ffp-contract=fast contracts in spite of the pragma.

/// Ends a program that would compute other signs, before it begins.
__attribute__((constructor)) static void refuse_contraction(void) {
    const volatile double a = 1 + 0x1p-30, b = 1 - 0x1p-30, c = 1;
    const double x = a, y = b, z = c;
    if (x * y - z == 0) return;
    fputs("sightline.c: compiled with -ffp-contract=fast; compile it with -ffp-contract=off\\n", stderr);
    abort();
}
"""


def core_sources():
    """Paths below lib/, those of the core as CMake has them. Windows' own header defines short names, so it comes last."""
    listed = re.search(r"set\(core_sources(.*?)\)", (LIB / "CMakeLists.txt").read_text(), re.S).group(1)
    names = [name for name in listed.split() if name.endswith(".c")]
    names += ["base/file_posix.c", "base/memory_posix.c", "base/file_windows.c"]
    return sorted(names, key=lambda name: "<windows.h>" in (LIB / name).read_text())


def file_scope_names(text):
    """What a source declares at file scope: functions, variables, types, tags, constants of enumerations."""
    tokens = [token for token in TOKEN.findall(DIRECTIVE.sub("", text))
              if not token.isspace() and not token.startswith(("//", "/*"))]
    names, depth, braces, before = set(), 0, [], ""
    start, opened, typedef = True, "", False  # what the next brace opens
    declared = False  # the declaration at hand has its name
    for token, after in zip(tokens, tokens[1:] + [";"]):
        top = not braces and depth == 0
        if token == "{":
            braces.append(opened)
        elif token == "}":
            kind = braces.pop()
            if not braces and kind == "function":
                declared, opened, start = False, "", True
        elif token in "([":
            depth += 1
        elif token in ")]":
            depth -= 1
        if start and not braces and token != "}":
            opened, start, typedef = "", False, token == "typedef"
        if top and token in ("struct", "union", "enum"):
            opened = token
            if NAME.match(after):
                names.add(after)
        elif not braces and token == ")" and depth == 0:
            opened = "function"
        elif top and token == "=":
            opened = "value"
        if NAME.match(token) and token not in WORDS:
            if top and after in ("__attribute__" if typedef else "(", "=", "[", ";", ",") and not (declared and not typedef and before != ","):
                if not (before in ("struct", "union", "enum")):
                    names.add(token)
                    declared = True
            elif not braces and depth == 1 and before == "*" and after == ")" and typedef:
                names.add(token)
            elif braces == ["enum"] and before in ("{", ","):
                names.add(token)
        if top and token == ";":
            declared, opened, start = False, "", True
        before = token
    return names


def renamed(text, names):
    """The text with other names; members of structures keep theirs."""
    tokens, out, before, braces, kind = TOKEN.findall(text), [], "", [], ""
    for i, token in enumerate(tokens):
        if token.isspace() or token.startswith(("//", "/*")):
            out.append(token)
            continue
        if token in ("struct", "union"):
            kind = "members"
        elif token in (";", ")", "="):
            kind = ""
        elif token == "{":
            braces.append(kind)
            kind = ""
        elif token == "}":
            braces and braces.pop()
        if token in names and before not in (".", "->"):
            after = next((each for each in tokens[i + 1:] if not each.isspace()), "")
            if not (braces and braces[-1] == "members" and after in (";", ",", "[", ":")):
                token = names[token]
        out.append(token)
        before = token
    return "".join(out)


class Amalgamation:
    def __init__(self):
        self.taken, self.public = set(), []
        self.sources = {name: PART.sub(lambda found: (LIB / found.group(1)).read_text(), (LIB / name).read_text())
                        for name in core_sources()}

    def header(self, name):
        """The text of a header and of those that it is the first to include; "" if it was there before."""
        if name in self.taken:
            return ""
        self.taken.add(name)
        public = name.startswith("sightline/")
        path = LIB / "include" / name if public else LIB / name
        text = self.expanded(path.read_text())
        text = f"\n// --- {name}\n\n{text.strip()}\n"
        if public:
            self.public.append(text)
            return ""
        return text

    def expanded(self, text):
        return INCLUDE.sub(lambda found: self.header(found.group(1)), text)

    def write(self, folder):
        version = ".".join(re.findall(r"#define SL_VERSION_M?[A-Z]+ (\d+)",
                                      (LIB / "include/sightline/version.h").read_text()))
        licence = "\n".join(("/// " + line).rstrip() for line in (LIB.parent / "LICENSE").read_text().strip().split("\n"))
        shared = {name for header in LIB.rglob("*.h") for name in re.findall(r"\bSLI?_\w+|\bsli?_\w+", header.read_text())}
        own = {name: file_scope_names(text) - shared for name, text in self.sources.items()}
        often = Counter(each for names in own.values() for each in names)
        body = []
        for name, text in self.sources.items():
            stem = Path(name).stem
            text = renamed(text, {each: f"{stem}_{each}" for each in own[name] if often[each] > 1 or each in SYSTEM})
            macros = "".join(f"#undef {each}\n" for each in dict.fromkeys(MACRO.findall(text)))
            text = f"\n// --- {name}\n\n{self.expanded(text).strip()}\n{macros}"
            system = re.search("_(posix|windows)", name)
            if system:
                text = f"\n#{'ifdef' if system.group(1) == 'windows' else 'ifndef'} _WIN32{text}#endif\n"
            body.append(text)
        self.header("sightline/sightline.h")
        (folder / "sightline.h").write_text(NOTICE % (version, "header", licence) + "".join(self.public))
        (folder / "sightline.c").write_text(NOTICE % (version, "source", licence) + HEAD + "".join(body) + TAIL)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: amalgamate.py FOLDER")
    target = Path(sys.argv[1])
    target.mkdir(parents=True, exist_ok=True)
    Amalgamation().write(target)
