"""The exercises: each stub fails at its first test, our own function passes, and each wrong solution fails at the test
and with the words that its first line names. What the runs say, and how they end."""
import concurrent.futures
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from support.program import PROGRAM

ROOT = Path(__file__).resolve().parent.parent
TESTS = ROOT / "tests" / "exercises"
RUN = [sys.executable, str(TESTS / "run")]
BUILD = os.path.dirname(PROGRAM)
NUMBERS = [int(path.parent.name) for path in sorted(TESTS.glob("*/exercise.json"))]
LIMIT = "2"  # seconds of processor time


def about(number):
    return json.loads((TESTS / f"{number:02}" / "exercise.json").read_text(encoding="utf-8"))


def ours(number):
    """The file of ours that the exercise replaces."""
    named = about(number)
    return ROOT / named.get("ours", "src/" + named.get("replaces", ""))


def wrong(number):
    return sorted((TESTS / f"{number:02}" / "wrong").iterdir())


def solution_of(number, path, folder):
    """The file of a solution. An edit is made of ours: its lines say what is replaced by what."""
    if not path or path.suffix != ".edit":
        return path
    _, old, new = path.read_text(encoding="utf-8").splitlines()
    text = ours(number).read_text(encoding="utf-8")
    assert text.count(old[2:]) == 1, f"{path}: {old}"
    made = Path(folder) / (path.stem + ours(number).suffix)
    made.write_text(text.replace(old[2:], new[2:]), encoding="utf-8")
    return made


def run(number, *words):
    """The exit status, and what it says."""
    with tempfile.TemporaryDirectory() as folder:
        out = subprocess.run([*RUN, str(number), *words, "--folder", folder], cwd=ROOT, check=False, text=True,
                             capture_output=True, env={**os.environ, "BUILD": BUILD, "LC_ALL": "C.UTF-8"})
    return out.returncode, out.stdout, out.stderr


def run_json(number, *words):
    status, out, said = run(number, *words, "--json", "--limit", LIMIT)
    return status, json.loads(out) if out else said


def code_lines(path):
    """The lines without comments, blanks and blank lines."""
    text = re.sub(r"/\*.*?\*/", "", path.read_text(encoding="utf-8"), flags=re.S)
    return [line.strip() for line in text.splitlines() if line.strip()]


class Exercises(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        """All solutions at once, on all processors."""
        jobs = [(number, None) for number in NUMBERS]
        jobs += [(number, path) for number in NUMBERS for path in (ours(number), *wrong(number))]
        with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            files = [solution_of(*job, folder) for job in jobs]
            results = pool.map(lambda job, file: run_json(job[0], *([str(file)] if file else [])), jobs, files)
            cls.results = dict(zip(jobs, results))

    def test_there_are_folders_for_each(self):
        self.assertGreaterEqual(len(NUMBERS), 1)
        for number in NUMBERS:
            folders = list((ROOT / "docs" / "exercises").glob(f"{number:02}-*/README.md"))
            self.assertEqual(len(folders), 1, number)

    def test_each_stub_fails_at_its_first_test(self):
        for number in NUMBERS:
            with self.subTest(number):
                status, result = self.results[number, None]
                self.assertEqual((status, result["status"]), (1, "failed"), result)
                self.assertEqual(result["failure"]["test"], result["tests"][0]["name"])
                self.assertNotIn("slip", result["failure"])

    def test_the_stub_of_the_kernel_is_ours_but_for_the_student_s_lines(self):
        stub = code_lines(ROOT / "docs/exercises/10-kernel/kernel.cl")
        ours = code_lines(ROOT / "kernels/plain.cl")
        empty = ["return (Ray){(wide3)0, (wide3)0, 0};", "return (real3)0;", "picture[3 * place + i] = 0;",
                 "return total;"]
        self.assertEqual([line for line in stub if line not in ours and line not in empty], [])

    def test_our_own_functions_pass(self):
        for number in NUMBERS:
            with self.subTest(number):
                status, result = self.results[number, ours(number)]
                self.assertEqual((status, result["status"]), (0, "passed"), result)
                self.assertTrue(all(test["passed"] for test in result["tests"]))
                if result["picture"]:
                    self.assertEqual(result["picture"]["differing"], 0)

    def test_each_wrong_solution_fails_where_and_as_it_says(self):
        for number in NUMBERS:
            self.assertGreaterEqual(len(wrong(number)), 5)
            for path in wrong(number):
                with self.subTest(str(path.relative_to(TESTS))):
                    first = path.read_text(encoding="utf-8").split("\n", 1)[0]
                    test, words = re.fullmatch(r"/\* Fails at (\w+): (.*)\. \*/", first).groups()
                    status, result = self.results[number, path]
                    self.assertEqual(status, 1, result)
                    failure = result["failure"]
                    self.assertEqual(failure["test"], test, failure)
                    self.assertIn(words, failure.get("slip", "") + failure.get("crash", ""))

    def test_each_failure_names_a_pixel_and_its_command(self):
        for (number, path), (_, result) in self.results.items():
            failure = result["failure"]
            if failure and "value" in failure and about(number).get("replaces"):
                with self.subTest(f"{number} {path}"):
                    self.assertIn(" ".join(["rectray trace", failure["scene"]]), failure["command"])
                    self.assertTrue((ROOT / failure["scene"]).is_file())


class Runs(unittest.TestCase):
    def put(self, text):
        self.addCleanup((holder := tempfile.TemporaryDirectory()).cleanup)
        path = Path(holder.name) / "mine.c"
        path.write_text(text, encoding="utf-8")
        return str(path)

    def solution(self, lines):
        return self.put('#include "trace/textbook_real.h"\n'
                        f"static bool inside_edges(const Face *face, Real3 n, Hit *hit)\n{{\n{lines}\n}}\n")

    def test_a_stub_that_is_wrong_is_told_with_its_numbers(self):
        status, out, _ = run(3)
        self.assertEqual(status, 1)
        self.assertIn("  FAIL  A point in the middle of a square\n", out)
        self.assertIn("    returned  nothing: it was not filled in\n    expected  6\n", out)
        self.assertIn("N.(e x c) = (0, 0, 1).((4, 0, 0) x (2.5, 1.5, 0)) = (0, 0, 1).(0, 0, 6) = 6", out)
        self.assertIn("build/rectray trace docs/exercises/03-inside/scene.json --pixel 3,3 -v\n", out)

    def test_the_trace_that_it_names_has_the_number(self):
        out = subprocess.run([PROGRAM, "trace", "docs/exercises/03-inside/scene.json", "--pixel", "3,3", "-v"],
                             cwd=ROOT, check=True, text=True, capture_output=True).stdout
        self.assertIn("N.(e x c):  +6  +6  +10  +10", out)

    def test_a_mistake_of_c_is_told_with_the_student_s_own_line(self):
        path = self.solution("    return hit->ege[0];")
        status, out, _ = run(3, path)
        self.assertEqual(status, 2)
        self.assertIn(f"{path}:4:17: error: ‘Hit’ has no member named ‘ege’".replace("‘", "'").replace("’", "'"),
                      out.replace("‘", "'").replace("’", "'"))
        self.assertLess(out.count("\n"), 30)

    def test_a_function_that_is_not_there_is_told(self):
        status, out, _ = run(3, self.put('#include "trace/textbook_real.h"\n'))
        self.assertEqual(status, 2)
        self.assertIn("inside_edges", out)
        self.assertIn("The tests call `inside_edges` as docs/exercises/03-inside/inside.c declares it.", out)
        self.assertEqual(run(3, self.solution("    return helper();"))[0], 2)

    def test_warnings_of_the_student_s_file_are_told_and_no_others(self):
        _, result = run_json(3, self.solution("    int unused = 1;\n    return false;"))
        self.assertIn("mine.c:4:9: warning: unused variable", result["compiler"][0])
        self.assertFalse([line for line in result["compiler"] if "tests/exercises" in line])

    def test_a_wild_pointer_is_a_message_with_test_and_input(self):
        _, result = run_json(3, self.solution("    Hit *nowhere = 0;\n    return nowhere->t > 0 || face || n.x > 0;"))
        self.assertEqual(result["status"], "crashed")
        self.assertRegex(result["failure"]["crash"], r"null pointer.*mine\.c, line 5")
        self.assertEqual(result["failure"]["test"], "middle_of_a_square")
        self.assertIn({"name": "hit->p", "value": "(-4.5, 2.5, 0)"}, result["failure"]["input"])

    def test_a_call_of_itself_without_end_is_told(self):
        # The stack may end as the function begins, or at the call.
        _, result = run_json(3, self.solution("    return !inside_edges(face, n, hit);"))
        self.assertRegex(result["failure"]["crash"], r"^it calls itself without end \(.*mine\.c, line [34]\)$")

    def test_an_infinite_number_is_not_taken_for_ours(self):
        path = self.solution("    hit->edges = face->vertex_count + (n.x > 0);\n    for (int k = 0; k < 4; k++)\n"
                             "        hit->edge[k] = HUGE_VAL;\n    return true;")
        failure = run_json(3, path)[1]["failure"]
        self.assertEqual((failure["value"], failure["returned"], failure["expected"]), ("hit->edge[0]", "inf", "6"))

    def test_a_walk_may_round_otherwise_than_ours(self):
        text = (TESTS / "09" / "wrong" / "limit_excluded.c").read_text(encoding="utf-8")
        between = r"interval_common\(part, interval_between\(.*\)\);"
        first, second = "{part.enter, fmin(part.leave, t)}", "{fmax(part.enter, t), part.leave}"
        for before, after in (
                ("part.enter >= way->limit", "part.enter > way->limit"),
                ("Interval low = " + between, "double t = ((double)node->split - o) / r;\n"
                 f"    Interval before = {first}, behind = {second}, low = r < 0 ? behind : before;"),
                ("Interval high = " + between, "Interval high = r < 0 ? before : behind;")):
            text, count = re.subn(before, after, text)
            self.assertEqual(count, 1, before)
        status, result = run_json(9, self.put(text))
        self.assertEqual((status, result["status"]), (0, "passed"), result)

    def test_output_without_end_is_told(self):
        path = self.put('#include "trace/textbook_real.h"\n#include <stdio.h>\n'
                        "static bool inside_edges(const Face *face, Real3 n, Hit *hit)\n"
                        '{\n    for (;;)\n        puts("here");\n}\n')
        self.assertIn("it prints or writes without end", run_json(3, path)[1]["failure"]["crash"])

    def test_what_it_prints_is_shown(self):
        path = self.put('#include "trace/textbook_real.h"\n#include <stdio.h>\n'
                        "static bool inside_edges(const Face *face, Real3 n, Hit *hit)\n"
                        '{\n    printf("edges: %d\\n", face->vertex_count);\n    return false;\n}\n')
        self.assertIn("It printed:\n\n    edges: 4\n", run(3, path)[1])

    def test_usage(self):
        for words, said in ((["99"], "there is no exercise 99"), (["3", "nowhere.c"], "There is no file nowhere.c.")):
            out = subprocess.run([*RUN, *words], cwd=ROOT, check=False, text=True, capture_output=True)
            self.assertEqual(out.returncode, 2)
            self.assertIn(said, out.stderr)
        self.assertEqual(subprocess.run(RUN, cwd=ROOT, check=False, capture_output=True).returncode, 2)


if __name__ == "__main__":
    unittest.main(verbosity=2)
