"""maps/FORMAT.md says what the readers of map text and of ASCII plans do.

Its table of statements is that of lib/map/map_text.c. Each example is read and baked. Each message in
its tables of errors is what the program says.

test_map_format.py PROGRAM
"""
import json
import pathlib
import re

import sandbox

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOCUMENT = (ROOT / "maps" / "FORMAT.md").read_text(encoding="utf-8")
READER = (ROOT / "lib/map/map_text.c").read_text(encoding="utf-8")
ENDINGS = {"sightline": "map", "plan": "txt"}
# What `info --json` counts of a statement.
COUNTS = {"wall": "walls", "walls": "walls", "solid": "walls", "open": "walls", "door": "doors",
          "mirror": "mirrors", "oneway": "oneways", "seam": "seams", "range": "range",
          "start": "starts", "path": "paths", "object": "objects"}


def statements():
    """Keyword and form of each row of the reader's table."""
    table = READER.split("static const statement statements[] = {")[1].split("\n};")[0]
    return re.findall(r'\{"(\w+)", "([^"]+)"', table)


def blocks(text):
    """Language and content of each block of code."""
    return re.findall(r"^```(\w*)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


def sections():
    """The text of each section, by its heading."""
    parts = re.split(r"^#{2,3} (.*)\n", DOCUMENT, flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2]))


def error_rows(heading):
    """What is written and what is said of it, from the table of a section."""
    return re.findall(r"^\| `([^`]+)` \| `([^`]+)` \|$", sections()[heading], re.MULTILINE)


class MapFormat(sandbox.ProgramTest):
    def run_on(self, name, text, *arguments):
        self.box.path(name).write_text(text, encoding="utf-8")
        return self.box.run(list(arguments))

    def info(self, name, text):
        result = self.run_on(name, text, "info", name, "--json")
        self.assertEqual(result.status, 0, text + result.stderr)
        return json.loads(result.stdout)

    def test_statements_are_those_of_the_reader(self):
        rows = re.findall(r"^\| \[`(\w+)`\]\(#(\w+)\) \| `([^`]+)` \|", DOCUMENT, re.MULTILINE)
        self.assertGreater(len(statements()), 10)
        self.assertEqual([(word, form.replace("\\|", "|")) for word, _, form in rows], statements())
        self.assertEqual([word for word, _, _ in rows], [link for _, link, _ in rows])

    def test_each_statement_has_a_section_with_an_example(self):
        for word, form in statements():
            section = sections()[word]
            self.assertIn(f"`{form}`", section)
            examples = [text for kind, text in blocks(section) if kind == "sightline"]
            self.assertTrue(examples, word)
            for text in examples:
                self.assertRegex(text, rf"(?m)^{word} ")
                if word in COUNTS:
                    self.assertGreater(self.info("example.map", text)[COUNTS[word]], 0, text)

    def test_examples_can_be_baked(self):
        seen = 0
        for kind, text in blocks(DOCUMENT):
            if kind not in ENDINGS:
                continue
            name = f"example{seen}.{ENDINGS[kind]}"
            self.info(name, text)
            result = self.box.run(["bake", name, "-o", name + ".slv", "--check", "--quiet"])
            self.assertEqual(result.status, 0, text + result.stderr)
            seen += 1
        self.assertGreaterEqual(seen, len(statements()) + 2)

    def test_map_text_is_refused_as_told(self):
        rows = error_rows("Errors")
        self.assertGreaterEqual(len(rows), 10)
        for line, message in rows:
            text = f"sightline 1\nwalls 0 0 9 0 9 9 0 9 0 0\n{line}\n"
            self.check_refusal("bad.map", text, 3, message)

    def test_files_are_refused_as_told(self):
        rows = error_rows("Errors of a whole file")
        self.assertGreaterEqual(len(rows), 3)
        for lines, message in rows:
            text = lines.replace("\\n", "\n") + "\n"
            self.check_refusal("bad.map", text, text.rstrip("\n").count("\n") + 1, message)

    def test_plans_are_refused_as_told(self):
        rows = error_rows("Errors of a plan")
        self.assertGreaterEqual(len(rows), 2)
        for line, message in rows:
            self.check_refusal("bad.txt", f"#####\n{line}\n#####\n", 2, message)

    def check_refusal(self, name, text, line, message):
        result = self.run_on(name, text, "bake", name, "-o", "bad.slv")
        self.assertEqual(result.status, 2, text)
        self.assertEqual(result.stderr, f"sightline: {name}:{line}: {message}\n")

    def test_numbers_of_the_plan_are_as_told(self):
        """The plan and the map text beside it are one map."""
        section = blocks(sections()["The same plan as map text"])
        plan, text = (dict(section)[kind] for kind in ("plan", "sightline"))
        self.run_on("a.txt", plan, "convert", "a.txt", "-o", "a.map", "--quiet")
        self.assertEqual(self.box.path("a.map").read_text(encoding="utf-8"), text)


if __name__ == "__main__":
    sandbox.main()
