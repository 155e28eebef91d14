"""rectray bench: its JSON has its keys, its tables go between the marks. No time decides a test."""
import json
import os
import subprocess
import tempfile
import unittest

RECTRAY = os.environ["RECTRAY"]
SCENE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "scenes", "minimal.json")
MARKS = ("<!-- bench: made by `make bench-peers`, from here -->\n", "<!-- bench: to here -->\n")
PHASES = {"parse", "build", "device", "compile", "upload", "trace", "readback", "encode", "total", "wall"}


class Bench(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def write_page(self, text):
        with open(os.path.join(self.folder.name, "page.md"), "w") as page:
            page.write(text)
        return "page.md"

    def read(self, name):
        with open(os.path.join(self.folder.name, name)) as page:
            return page.read()

    def bench(self, *words, status=0):
        done = subprocess.run([RECTRAY, "bench", *words, "--size=8x6", "--grid=1", "--repeats=1", "--quiet"],
                              cwd=self.folder.name, capture_output=True, text=True)
        self.assertEqual(done.returncode, status, done.stderr)
        return done

    def test_json_holds_every_figure_and_tables_replace_what_stands_between_the_marks(self):
        page = self.write_page("before\n" + MARKS[0] + "stale words\n" + MARKS[1] + "after\n")
        result = json.loads(self.bench(SCENE, "--json", "-o", page).stdout)
        self.assertEqual(set(result), {"processor", "cores", "load", "repeats", "scenes", "scaling", "processes"})
        scene = result["scenes"][0]
        self.assertEqual((scene["scene"], scene["columns"], scene["rows"], scene["grid"]), ("minimal.json", 8, 6, 1))
        self.assertEqual(scene["rays"]["primary"], 48)
        self.assertIsNone(scene["peer"])
        for key in ("faces", "lights", "trace_ms", "fastest_ms", "slowest_ms", "primary_ms", "unmirrored_ms", "build_ms"):
            self.assertGreaterEqual(scene[key], 0, key)
        process = result["processes"][0]
        self.assertEqual(set(process["cold_ms"]), PHASES)
        self.assertEqual(set(process["warm_ms"]), PHASES)
        self.assertGreater(process["peak_memory_bytes"], 0)
        self.assertIsNone(process["povray_ms"])

        text = self.read(page)
        self.assertTrue(text.startswith("before\n" + MARKS[0]))
        self.assertTrue(text.endswith(MARKS[1] + "after\n"))
        self.assertNotIn("stale words", text)
        self.assertIn("| minimal.json |", text)

    def test_a_page_without_marks_stays_as_it_is(self):
        page = self.write_page("words\n")
        self.assertIn("missing", self.bench(SCENE, "-o", page, status=1).stderr)
        self.assertEqual(self.read(page), "words\n")

    def test_a_wrong_scene_and_no_scene_are_refused(self):
        self.bench("missing.json", status=1)
        self.assertIn("--ladder", self.bench(status=2).stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
