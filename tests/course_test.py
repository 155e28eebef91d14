"""What lecturers are given beside the exercises: our own functions as solutions, and the figures of the slides."""
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TOOLS = ROOT / "tests" / "exercises"
sys.path.insert(0, str(TOOLS))
import figures  # noqa: E402
import solution  # noqa: E402

NUMBERS = [int(path.parent.name) for path in sorted(TOOLS.glob("[0-9]*/exercise.json"))]


class Solutions(unittest.TestCase):
    def test_each_is_our_own_function_as_it_stands(self):
        self.assertGreater(len(NUMBERS), 1)
        for number in NUMBERS:
            with self.subTest(number):
                out = subprocess.run([TOOLS / "solution.py", str(number)], check=True, capture_output=True, text=True,
                                     cwd=ROOT).stdout
                for file, names in solution.wanted(number):
                    text = (ROOT / file).read_text(encoding="utf-8")
                    for name in names:
                        self.assertIn(solution.definition_of(text, name)[1], out)
                        self.assertRegex(out, rf"\b{name}\(")
                        self.assertIn(solution.definition_of(text, name)[1], text)

    def test_each_has_a_body(self):
        for number in NUMBERS:
            for file, names in solution.wanted(number):
                text = (ROOT / file).read_text(encoding="utf-8")
                for name in names:
                    definition = solution.definition_of(text, name)[1]
                    self.assertEqual(definition.count("{"), definition.count("}"), name)
                    self.assertGreater(definition.count(";"), 0, name)

    def test_no_other_exercise_has_one(self):
        out = subprocess.run([TOOLS / "solution.py", "99"], check=False, capture_output=True, text=True)
        self.assertEqual((out.returncode, out.stdout), (1, ""))
        self.assertIn("no exercise 99", out.stderr)

    def test_the_repository_holds_no_others(self):
        """What an exercise calls ours is a file of the program, or calls the program's own functions."""
        for number in NUMBERS:
            about = json.loads((TOOLS / f"{number:02}" / "exercise.json").read_text(encoding="utf-8"))
            named = about.get("ours", "src/" + about.get("replaces", ""))
            text = (ROOT / named).read_text(encoding="utf-8")
            self.assertTrue(named.startswith(("src/", "kernels/")) or re.search(r'#include "src/|\bour_', text), named)


class Figures(unittest.TestCase):
    def test_each_has_a_name_of_its_own_and_a_source(self):
        names = [name for _, name, _, _ in figures.FIGURES]
        self.assertEqual(sorted(names), sorted(set(names)))
        self.assertGreater(len(names), 30)
        for week, name, words, source in figures.FIGURES:
            with self.subTest(name):
                self.assertTrue(0 <= week <= 10 and words)
                if isinstance(source, str):
                    self.assertTrue((ROOT / source).is_file(), source)
                    self.assertEqual(Path(source).suffix, Path(name).suffix)
                else:
                    self.assertIn("{out}", source)

    def test_each_command_of_a_drawing_is_one_that_works(self):
        for _, name, _, source in figures.FIGURES:
            if not isinstance(source, str) and name.endswith(".svg"):
                with self.subTest(name):
                    with tempfile.TemporaryDirectory() as folder:
                        out = Path(folder) / name
                        subprocess.run([figures.PROGRAM, *(word.format(out=out) for word in source)], cwd=ROOT,
                                       check=True, capture_output=True)
                        self.assertIn("<svg", out.read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
