"""The list of mutants is up to date: each names a file, a piece of a line that stands there exactly once, and a test
that there is. `make mutants` tries them."""
import re
import unittest
from pathlib import Path

from mutants.run import read_list

ROOT = Path(__file__).resolve().parent.parent
MUTANTS = read_list(ROOT / "tests" / "mutants" / "list")


def stress_tests():
    main = (ROOT / "tests" / "stress" / "main.c").read_text(encoding="utf-8")
    return re.findall(r'(?m)^    \{\d+, "([a-z-]+)"', main)


class Mutants(unittest.TestCase):
    def test_their_names_differ(self):
        names = [name for name, *_ in MUTANTS]
        self.assertGreater(len(names), 50)
        self.assertEqual(sorted(names), sorted(set(names)))

    def test_each_changes_a_line_that_is_there_once(self):
        for name, file, _, before, after in MUTANTS:
            with self.subTest(name):
                self.assertTrue((ROOT / file).is_file(), f"{file} is not there")
                self.assertEqual((ROOT / file).read_text(encoding="utf-8").count(before), 1, f"in {file}: {before}")
                self.assertNotEqual(before, after)

    def test_each_names_a_test_that_is_there(self):
        known = {f"stress:{name}" for name in stress_tests()}
        known |= {path.stem for path in (ROOT / "tests").glob("test_*.c")}
        for path in (ROOT / "tests").glob("*_test.py"):
            parts = re.findall(r"(?m)^class (\w+)", path.read_text(encoding="utf-8"))
            known |= {f"{path.stem}:{part}" for part in parts}
        for name, _, test, *_ in MUTANTS:
            with self.subTest(name):
                self.assertIn(test, known)


if __name__ == "__main__":
    unittest.main(verbosity=2)
