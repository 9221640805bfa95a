"""Each check of check.py lets a good tree pass and finds the one fault of a bad one."""
import argparse
import pathlib
import sys
import tempfile
import unittest

import check

HEADER = "#ifndef {0}_H\n#define {0}_H\n{1}\n#endif\n"
GOOD = {
    "lib/README.md": "| `base/` | one |\n| `map/` | two |\n| `space/` | three |\n",
    "lib/CMakeLists.txt": "set(x base/a.c map/m.c # map/no.c\n space/s.c)\n",
    "lib/base/a.c": '#include "sightline/context.h"\n#include <stdio.h>\n',
    "lib/map/m.c": '#include "base/a.h"\n#include "sightline/map.h"\n',
    "lib/space/s.c": '#include "map/m.h"\n#include "sightline/space.h"\n#include "space/t.h"\n',
    "lib/include/sightline/sightline.h": HEADER.format("ALL", '#include "sightline/space.h"'),
    "lib/include/sightline/context.h": HEADER.format("CONTEXT", "typedef int sl_number;"),
    "lib/include/sightline/map.h": HEADER.format("MAP", '#include "sightline/context.h"'),
    "lib/include/sightline/space.h":
        HEADER.format("SPACE", '#include "sightline/map.h"\nsl_number sl_get(void);'),
    ".clang-format": "BasedOnStyle: LLVM\n",
}
COMPILERS = []


class CheckTest(unittest.TestCase):
    def faults(self, checker, changed, *more):
        """The faults of the good tree with some files changed."""
        with tempfile.TemporaryDirectory() as scratch:
            root = pathlib.Path(scratch)
            for name, text in {**GOOD, **changed}.items():
                path = root / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            return list(checker(root, *more))

    def assert_one(self, faults, *words):
        self.assertEqual(len(faults), 1, faults)
        for word in words:
            self.assertIn(word, faults[0])

    def layers(self, name, text):
        return self.faults(check.check_layers, {name: text})

    def test_good_tree(self):
        self.assertEqual(self.faults(check.check_layers, {}), [])
        self.assertEqual(self.faults(check.check_sources, {}), [])
        self.assertEqual(self.faults(check.check_headers, {}, COMPILERS), [])

    def test_private_include_of_a_later_stage(self):
        faults = self.layers("lib/map/m.c", '\n#include "space/x.h"\n')
        self.assert_one(faults, "lib/map/m.c:2", "space/x.h")
        self.assert_one(self.layers("lib/base/b.h", '# include "map/m.h"\n'), "lib/base/b.h:1")

    def test_private_include_of_an_application(self):
        self.assert_one(self.layers("tools/system/t.c", '#include "base/a.h"\n'), "tools/system/t.c:1", "private")
        self.assertEqual(self.layers("tools/system/t.c", '#include "base/a.h" // private: a lesson\n'), [])
        self.assertEqual(self.viewer("ui/v.c", '#include "sightline/map.h"\n#include "ui/v.h"\n'), [])

    def test_folders_in_folders(self):
        readme = {"lib/README.md": GOOD["lib/README.md"] + "| `cell_to_cell/search/` | four |\n"}
        later = {"lib/cell_to_cell/search/s.c": '#include "cell_to_cell/sweep/x.h"\n', **readme}
        self.assert_one(self.faults(check.check_layers, later), "comes before cell_to_cell/sweep/")
        earlier = {"lib/cell_to_cell/search/s.c": '#include "cell_to_cell/x.h"\n#include "base/a.h"\n', **readme}
        self.assertEqual(self.faults(check.check_layers, earlier), [])

    def test_folders_of_the_command(self):
        self.assert_one(self.layers("tools/inputs/i.c", '#include "reports/r.h"\n'), "before reports/")
        self.assertEqual(self.layers("tools/reports/r.c", '#include "inputs/i.h"\n'), [])
        self.assert_one(self.layers("tools/t.c", ""), "none of")

    def viewer(self, name, text, folders=None):
        rows = "".join(f"| `{folder}/` | one |\n" for folder in folders or [name.split("/")[0]])
        return self.faults(check.check_layers, {f"viewer/{name}": text, "viewer/README.md": rows})

    def test_folders_of_the_viewer(self):
        self.assert_one(self.viewer("panes/p.c", '#include "app/app.h"\n'), "viewer/panes/p.c:1", "nothing of app/")
        self.assert_one(self.viewer("dialogs/d.c", '#include "plan/view.h"\n'), "nothing of plan/")
        self.assertEqual(self.viewer("app/a.c", '#include "panes/p.h"\n#include "app/a.h"\n'), [])
        self.assert_one(self.viewer("v.c", "", ["ui"]), "none of")
        self.assert_one(self.viewer("ui/u.c", "", ["ui", "document"]), "viewer/README.md", "tells of")

    def test_private_name_that_looks_public(self):
        self.assert_one(self.layers("lib/base/b.h", "int sl_get(int i);\n"), "lib/base/b.h:1", "sl_get")
        self.assertEqual(self.layers("lib/base/b.h", "int sli_get(int i);\n"), [])

    def test_public_include_of_a_later_stage(self):
        self.assert_one(self.layers("lib/map/m.c", '#include "sightline/space.h"\n'), "space/")
        self.assert_one(self.layers("lib/map/m.c", "#include <sightline/pvs.h>\n"), "cell_to_cell/")
        self.assert_one(self.layers("lib/space/s.c", '#include "sightline/glpk.h"\n'), "stab/")

    def test_include_of_all_headers(self):
        faults = self.layers("lib/space/s.c", '#include "sightline/sightline.h"\n')
        self.assert_one(faults, "for users")

    def test_include_of_nowhere(self):
        self.assert_one(self.layers("lib/space/s.c", '#include "s.h"\n'), "in no folder")
        self.assert_one(self.layers("lib/space/s.c", '#include "../map/m.h"\n'), "in no folder")

    def test_public_headers(self):
        public = "lib/include/sightline/"
        self.assert_one(self.layers(public + "map.h", '#include "sightline/space.h"\n'), "map.h:1")
        self.assert_one(self.layers(public + "space.h", '#include "base/a.h"\n'), "not installed")
        self.assert_one(self.layers(public + "cake.h", ""), "whose header")

    def test_declared_for_one_source(self):
        header = "int sl_one(int a,\n           int b);\n/// Not sl_two.\nvoid sl_two(void);\n"
        used = {"lib/map/m.h": header, "lib/map/m.c": "int sl_one(int a, int b) {}",
                "lib/map/n.c": "sl_one(1, 2); sl_two();", "lib/space/s.c": "void sl_two(void) {}"}
        self.assertEqual(self.faults(check.check_used, used), [])
        self.assert_one(self.faults(check.check_used, {**used, "lib/map/n.c": "// sl_one\nsl_two();"}),
                        "lib/map/m.h", "sl_one")
        deeper = {"lib/map/in/i.h": "int sli_in(void);", "lib/map/in/i.c": "int sli_in(void) {}"}
        self.assert_one(self.faults(check.check_used, deeper), "lib/map/in/i.h", "sli_in")

    def test_runtime_stands_alone(self):
        readme = {"lib/README.md": GOOD["lib/README.md"] + "| `runtime/` | four |\n"}
        source = '#include "runtime/r.h"\n#include "sightline/runtime.h"\n'
        alone = {"lib/runtime/r.c": source, **readme}
        self.assertEqual(self.faults(check.check_layers, alone), [])
        uses = {"lib/runtime/r.c": '#include "base/a.h"\n', **readme}
        self.assert_one(self.faults(check.check_layers, uses), "from no other folder")
        used = {**alone, "lib/draw/d.c": '#include "runtime/r.h"\n',
                "lib/README.md": readme["lib/README.md"] + "| `draw/` | five |\n"}
        self.assert_one(self.faults(check.check_layers, used), "stands alone")

    def test_folders_and_their_readme(self):
        other_order = "| `map/` |\n| `base/` |\n| `space/` |\n"
        self.assert_one(self.layers("lib/README.md", other_order), "README")
        self.assert_one(self.layers("lib/stab/s.c", ""), "README")
        self.assert_one(self.layers("lib/cake/c.c", ""), "cake")

    def test_table_of_headers(self):
        names = ["context", "map", "sightline", "space"]
        lines = [f"| [`{name}.h`](include/sightline/{name}.h) | what |\n" for name in names]
        self.assertEqual(self.faults(check.check_table, {"lib/README.md": "".join(lines)}), [])
        self.assert_one(self.faults(check.check_table, {"lib/README.md": "".join(lines[1:])}),
                        "no line", "context.h")
        more = "".join(lines) + lines[0].replace("context", "gone")
        self.assert_one(self.faults(check.check_table, {"lib/README.md": more}), "gone.h")

    def test_sources(self):
        self.assert_one(self.faults(check.check_sources, {"lib/map/no.c": ""}), "map/no.c")
        one_more = {"lib/CMakeLists.txt": "base/a.c map/m.c space/s.c x.c"}
        self.assert_one(self.faults(check.check_sources, one_more), "x.c")

    def test_silence(self):
        self.assertEqual(self.faults(check.check_silent, {"lib/map/m.c": "snprintf(fprintf("}), [])
        loud = self.faults(check.check_silent, {"lib/map/m.c": '\n    printf("here")'})
        self.assert_one(loud, "lib/map/m.c:2", "printf")

    def test_versions(self):
        told = {"lib/CHANGELOG.md": "# Changes\n\n## Unreleased\n\n## 1.2.3, 2026-01-01\n\n## 1.2.2, 2025-01-01\n",
                "lib/bindings/foundry/module.json": '{"version": "1.2.3"}',
                "lib/bindings/qgis/metadata.txt": "[general]\nname=Sightline\nversion=1.2.3\n",
                "lib/bindings/js/package.json": '{"version": "1.2.3"}',
                "tools/packages/conan/conanfile.py": '    version = "1.2.3"\n',
                "tools/packages/debian/changelog": "sightline (1.2.3) unstable; urgency=medium\n",
                "tools/packages/vcpkg/vcpkg.json": '{"version": "1.2.3"}',
                "viewer/desktop/io.github.sightline.View.metainfo.xml": '<release version="1.2.3"/>',
                "lib/include/sightline/version.h": "".join(
                    f"#define SL_VERSION_{part} {number}\n"
                    for number, part in enumerate(("MAJOR", "MINOR", "PATCH"), 1))}
        self.assertEqual(self.faults(check.check_versions, told), [])
        for name in check.VERSIONS:
            with self.subTest(name):
                text = told[name].replace("1.2.3", "1.2.4")
                self.assert_one(self.faults(check.check_versions, {**told, name: text}), name, "1.2.4")
                self.assert_one(self.faults(check.check_versions, {**told, name: "\n"}), name, "nothing")

    def test_packages(self):
        tree = {"CMakeLists.txt": 'option(SIGHTLINE_FAST "fast" OFF)\nset(SIGHTLINE_DIR "" CACHE STRING "where")\n',
                "lib/CMakeLists.txt": "sightline_library(sightline sightline SOURCES a)\n"
                                      "  sightline_part_library(io SOURCES b)\n",
                "lib/bindings/level/CMakeLists.txt": "add_library(sightline_level SHARED c)\n",
                "lib/cmake/P.cmake": 'sightline_part(IO "formats" ZLIB)\n',
                "lib/include/sightline/version.h": "#define SL_VERSION_MAJOR 3\n",
                "tools/packages/README.md": "`SIGHTLINE_FAST`, `SIGHTLINE_DIR`, `SIGHTLINE_IO`",
                "tools/packages/debian/control": "Package: libsightline3\n\nPackage: libsightline-dev\n",
                "tools/packages/debian/libsightline3.install": "".join(
                    f"usr/lib/*/lib{name}.so.*\n" for name in ("sightline", "sightline_io", "sightline_level"))}
        self.assertEqual(self.faults(check.check_packages, tree), [])
        faults = self.faults(check.check_packages, {**tree, "lib/include/sightline/version.h":
                                                    "#define SL_VERSION_MAJOR 4\n"})
        self.assert_one(faults, "control", "libsightline3", "4")
        install = "tools/packages/debian/libsightline3.install"
        for name in "sightline", "sightline_io", "sightline_level":
            less = tree[install].replace(f"usr/lib/*/lib{name}.so.*\n", "")
            self.assert_one(self.faults(check.check_packages, {**tree, install: less}), f"lib{name}.so")
        for name in "SIGHTLINE_FAST", "SIGHTLINE_DIR", "SIGHTLINE_IO":
            told = tree["tools/packages/README.md"].replace(f"`{name}`", "")
            faults = self.faults(check.check_packages, {**tree, "tools/packages/README.md": told})
            self.assert_one(faults, "README.md", name)

    def test_formats(self):
        tree = {"lib/io/io.c": '{.name = "a",\n .endings = ".a .b",\n .what = "x",\n .read = sli_map_read_a},\n',
                "lib/io/FORMATS.md": "## A: `.a`, `.b`\n", "tests/fuzz/fuzz_a.c": "fuzz_read(sli_map_read_a);\n",
                "tests/unit/test_one_failure_study.c": 'SEED(a, "x.a")\n'}
        self.assertEqual(self.faults(check.check_formats, tree), [])
        for name, word in (("lib/io/FORMATS.md", ".b"), ("tests/fuzz/fuzz_a.c", "sli_map_read_a"),
                           ("tests/unit/test_one_failure_study.c", "SEED(a,")):
            less = {**tree, name: tree[name].replace("b", "c").replace("_a)", "_c)").replace("(a,", "(c,")}
            self.assert_one(self.faults(check.check_formats, less), word)

    def test_headers(self):
        def faults(text):
            changed = {"lib/include/sightline/draw.h": text}
            return self.faults(check.check_headers, changed, COMPILERS)
        not_alone = faults(HEADER.format("DRAW", "sl_number sl_draw(void);"))
        self.assertEqual(len(not_alone), len(COMPILERS), not_alone)
        no_guard = faults("struct sl_picture { int a; };\n")
        self.assertEqual(len(no_guard), len(COMPILERS), no_guard)
        not_for_plus = faults(HEADER.format("DRAW", "extern int new;"))
        self.assertEqual(len(not_for_plus), len(COMPILERS) - 1, not_for_plus)

    def test_format(self):
        try:
            self.assertEqual(self.faults(check.check_format, {"lib/map/m.c": "int a;\n"}), [])
        except check.CannotTell as reason:
            self.skipTest(str(reason))
        faults = self.faults(check.check_format, {"lib/map/m.c": "int  a ;\n"})
        self.assert_one(faults, "lib/map/m.c:1")

    def test_doxygen(self):
        doxyfile = pathlib.Path(__file__).resolve().parents[2] / "lib/Doxyfile"
        tree = {"lib/Doxyfile": doxyfile.read_text(encoding="utf-8"), "lib/runtime/r.h": "",
                "lib/include/sightline/context.h": "/// Numbers.\n\n/// One.\ntypedef int sl_number;\n",
                "lib/include/sightline/map.h": "/// A map.\n\n/// It.\nstruct sl_map { int a; };\n",
                "lib/include/sightline/space.h": "/// A space.\n\n/// Gets it.\nint sl_get(void);\n"}
        try:
            self.assertEqual(self.faults(check.check_doxygen, tree), [])
        except check.CannotTell as reason:
            self.skipTest(str(reason))
        name = "lib/include/sightline/space.h"
        faults = self.faults(check.check_doxygen, {**tree, name: "/// A space.\n\nint sl_get(void);\n"})
        self.assert_one(faults, name + ":3", "sl_get")
        name = "lib/include/sightline/map.h"
        faults = self.faults(check.check_doxygen, {**tree, name: "/// A map.\n\nstruct sl_map { int a; };\n"})
        self.assert_one(faults, name + ":3", "sl_map")


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--cc")
    parser.add_argument("--cxx")
    options, rest = parser.parse_known_args()
    if options.cc:
        COMPILERS.append(("c", options.cc, ["-std=c11"]))
    if options.cxx and not options.cxx.endswith("NOTFOUND"):
        COMPILERS.append(("cpp", options.cxx, ["-std=c++11"]))
    unittest.main(argv=[sys.argv[0], *rest])
