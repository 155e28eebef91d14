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
from support.program import PROGRAM  # noqa: E402
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


class Plan(unittest.TestCase):
    """docs/course.md: its commands work, its pixels are there, its figures and exercises, too."""
    TEXT = (ROOT / "docs" / "course.md").read_text(encoding="utf-8")

    def test_each_command_works(self):
        blocks = re.findall(r"(?ms)^ *```sh\n(.*?)^ *```", self.TEXT)
        commands = [line.strip() for block in blocks for line in re.sub(r"\\\n *", "", block).splitlines()]
        self.assertGreater(len(commands), 20)
        with tempfile.TemporaryDirectory() as folder:
            for name in ("scenes", "docs", "kernels"):
                (Path(folder) / name).symlink_to(ROOT / name)
            for command in commands:
                with self.subTest(command):
                    self.assertTrue(command.startswith("build/rectray "), command)
                    out = subprocess.run(command.replace("build/rectray", PROGRAM, 1), shell=True, cwd=folder,
                                         capture_output=True, text=True, check=False)
                    self.assertEqual(out.returncode, 0, out.stderr)

    def test_what_it_makes_can_be_made(self):
        targets = set(re.findall(r"`make ([a-z-]+)", self.TEXT))
        self.assertGreaterEqual(targets, {"figures", "page", "exercise", "hunt", "hunt-answer", "solution"})
        told = subprocess.run(["make", "-s", "help"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
        for target in targets:
            self.assertRegex(told, rf"(?m)^ +make {target} ", target)

    def test_each_pixel_of_the_page_is_in_its_picture(self):
        addresses = re.findall(r"#scene=([\w/.]+)&size=(\d+)x(\d+)&grid=1&pixel=(\d+),(\d+)", self.TEXT)
        self.assertGreaterEqual(len(addresses), 2)
        for scene, columns, rows, column, row in addresses:
            self.assertTrue((ROOT / scene).is_file(), scene)
            self.assertTrue(int(column) < int(columns) and int(row) < int(rows))

    def test_the_figures_of_a_week_are_in_that_week(self):
        rows = re.findall(r"(?m)^\| (\d+) \| [^|]* \| ([^|]*) \|", self.TEXT)
        self.assertEqual([int(week) for week, _ in rows], list(range(1, 11)))
        known = {(week, re.sub(r"(-textbook|-exact|-apart)?\..*", "", name)) for week, name, *_ in figures.FIGURES}
        for week, names in rows:
            for name in names.replace(" and three more", "").strip().split(", "):
                for one in name.split(" and "):
                    self.assertIn((int(week), one), known)


if __name__ == "__main__":
    unittest.main(verbosity=2)
