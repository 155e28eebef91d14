"""rectray bench: its JSON has its keys, its tables go between the marks. No time decides a test."""
import csv
import json
import os
import resource
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
import unittest.mock

from support.program import PROGRAM as RECTRAY, SOAK

SCENE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "scenes", "minimal.json")
MARKS = ("<!-- bench: made by `make bench-peers`, from here -->\n", "<!-- bench: to here -->\n")
PHASES = {"parse", "build", "device", "compile", "upload", "trace", "readback", "encode", "total", "wall"}


class BenchTest(unittest.TestCase):
    """Each test runs in a folder of its own."""

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

    def bench(self, *words, status=0, grid=1):
        """Runs it in the test's folder, and checks that its temporary files are gone."""
        temporary = os.path.join(self.folder.name, "temporary")
        os.makedirs(temporary, exist_ok=True)
        done = subprocess.run([RECTRAY, "bench", *words, "--size=8x6", f"--grid={grid}", "--repeats=1",
                               "--quiet"],
                              cwd=self.folder.name, capture_output=True, text=True,
                              env=dict(os.environ, TMPDIR=temporary))
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertEqual(os.listdir(temporary), [])
        os.rmdir(temporary)
        return done

    def files(self):
        return sorted(os.listdir(self.folder.name))


class Speed(BenchTest):
    def test_json_holds_every_figure_and_tables_replace_what_stands_between_the_marks(self):
        page = self.write_page("before\n" + MARKS[0] + "stale words\n" + MARKS[1] + "after\n")
        result = json.loads(self.bench(SCENE, "--json", "-o", page).stdout)
        self.assertEqual(set(result), {"processor", "cores", "load", "repeats", "scenes", "scaling", "processes",
                                       "curve"})
        scene = result["scenes"][0]
        self.assertEqual((scene["scene"], scene["columns"], scene["rows"], scene["grid"]), ("minimal.json", 8, 6, 1))
        self.assertEqual(scene["rays"]["primary"], 48)
        self.assertIsNone(scene["peer"])
        for key in ("faces", "lights", "trace_ms", "fastest_ms", "slowest_ms", "primary_ms", "unmirrored_ms",
                    "build_ms"):
            self.assertGreaterEqual(scene[key], 0, key)
        self.assertGreater(scene["device_bytes"], 0)
        self.assertEqual(set(scene["skipped"]), {"mirrors", "tree", "whole_tile"})
        for kind in scene["skipped"].values():
            self.assertGreater(kind["count"], 0)
            self.assertGreater(kind["done_ms"], 0)
            self.assertTrue(kind["same_picture"])
        process = result["processes"][0]
        self.assertEqual(set(process["cold_ms"]), PHASES)
        self.assertEqual(set(process["warm_ms"]), PHASES)
        self.assertGreater(process["peak_memory_bytes"], 0)
        self.assertEqual(process["faces"], scene["faces"])
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

    def test_a_page_that_is_not_there_is_made_and_renewed(self):
        for words in ([SCENE], ["kernels", SCENE]):
            with self.subTest(words):
                self.bench(*words, "-o", "new.md")
                first = self.read("new.md").splitlines()
                self.assertRegex(first[0], "^<!-- bench.*: made by .* from here -->$")
                self.assertRegex(first[-1], "^<!-- bench.*: to here -->$")
                self.assertIn("minimal", "".join(first[1:-1]))
                self.bench(*words, "-o", "new.md")
                self.assertEqual(len(self.read("new.md").splitlines()), len(first))
                self.assertIn("minimal", self.bench(*words, "-o", "-").stdout)
                self.assertEqual(self.files(), ["new.md"])
                os.remove(os.path.join(self.folder.name, "new.md"))
        self.assertIn("nowhere/new.md", self.bench("missing.json", "-o", "nowhere/new.md", status=3).stderr)

    def test_a_wrong_scene_and_no_scene_are_refused(self):
        self.bench("missing.json", status=1)
        self.bench("error", "missing.json", status=1)
        for words in ([], ["error"]):
            message = self.bench(*words, status=2).stderr
            self.assertIn("--ladder", message)
            self.assertIn("rectray bench error", message)
        self.assertEqual(self.files(), [])

    def test_whole_processes_have_the_settings_that_were_asked_for(self):
        """Each of the three leaves another picture of this lesson."""
        lesson = os.path.abspath("scenes/lessons/light_in_the_plane.json")
        pictures = set()
        for words in ([], ["--kernel=plain", "--arithmetic=textbook", "--precision=double", "--accel=none"],
                      ["--kernel=plain", "--arithmetic=textbook", "--precision=double", "--shift=0", "--threads=1"]):
            with self.subTest(words):
                self.bench(lesson, "--folder", "files", *words)
                made = os.path.join(self.folder.name, "files", "picture.png")
                wanted = os.path.join(self.folder.name, "wanted.png")
                subprocess.run([RECTRAY, "render", lesson, *words, "--size=8x6", "--grid=1", "-q", "-o", wanted],
                               check=True)
                with open(made, "rb") as ours, open(wanted, "rb") as theirs:
                    picture = ours.read()
                    self.assertEqual(picture, theirs.read())
                pictures.add(picture)
        self.assertEqual(len(pictures), 3)

    def test_files_go_to_the_folder_that_was_chosen(self):
        self.bench(SCENE)
        self.assertEqual(self.files(), [])
        self.bench(SCENE, "--folder", "deep/er")
        self.assertIn("picture.png", os.listdir(os.path.join(self.folder.name, "deep", "er")))
        self.write_page("a file, not a folder")
        self.assertIn("page.md", self.bench(SCENE, "--folder", "page.md/x", status=3).stderr)

    def test_what_stops_it_leaves_no_temporary_folder(self):
        """Neither ^C, which a terminal sends to all, nor SIGKILL for it alone: a rendering that was begun may end
        first."""
        for number, send in ((signal.SIGINT, os.killpg), (signal.SIGTERM, os.killpg), (signal.SIGKILL, os.kill)):
            process = subprocess.Popen([RECTRAY, "bench", SCENE, "--repeats=99", "--quiet"], cwd=self.folder.name,
                                       stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, start_new_session=True,
                                       env=dict(os.environ, TMPDIR=self.folder.name),
                                       preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
            self.wait_for(lambda: self.files() != [])
            time.sleep(0.2)
            self.assertIsNone(process.poll())
            send(process.pid, number)
            err = process.communicate(timeout=20)[1]
            if number == signal.SIGKILL:
                self.assertEqual(process.returncode, -number)
            else:
                self.assertEqual((process.returncode, err), (128 + number, b"rectray: interrupted\n"))
            self.wait_for(lambda: self.files() == [])

    def test_what_it_cannot_start_is_told(self):
        def few_files():
            resource.setrlimit(resource.RLIMIT_NOFILE, (4, 4))
        for message, options in (("cannot start sh: No such file", {"PATH": "/nowhere"}),
                                 ("cannot make a pipe: Too many open files", {}),
                                 ("cannot make the temporary folder ", {"TMPDIR": "/nowhere"})):
            done = subprocess.run([RECTRAY, "bench", SCENE], cwd=self.folder.name, capture_output=True, text=True,
                                  env={**os.environ, "TMPDIR": self.folder.name, **options},
                                  preexec_fn=None if options else few_files)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (3, 1), done.stderr)
            self.assertIn("rectray: " + message, done.stderr)
            self.assertEqual(self.files(), [])

    def wait_for(self, condition):
        deadline = time.monotonic() + 60
        while not condition() and time.monotonic() < deadline:
            time.sleep(0.01)
        self.assertTrue(condition(), self.files())


class Peer(BenchTest):
    """A peer of a few lines of shell, which answers as tests/peers/ do: bench starts whatever is at its place."""

    HELLO = json.dumps({"peer": "sham", "rays": {"primary": 48, "shadow": 9, "reflection": 0}, "build_ms": 3,
                        "modes": {"primary": "packets of 16", "shadow": "single rays", "reflection": "unused"},
                        "build_bytes": 640, "share_inside_embree": 0.75})
    SERVE = "while read -r line; do echo 2.5; done"

    FINISH = f'{RECTRAY} render "$1" --size "$3" --grid "$5" -b reference -q -o "$8"'

    def peer(self, hello=HELLO, serve=SERVE, finish=FINISH):
        os.makedirs(os.path.join(self.folder.name, "build", "peers"), exist_ok=True)
        path = os.path.join(self.folder.name, "build", "peers", "embree")
        with open(path, "w") as script:
            script.write(f"#!/bin/sh\necho '{hello}'\n{serve}\n{finish}\n")
        os.chmod(path, 0o755)

    def test_its_figures_stand_beside_ours(self):
        self.peer()
        page = self.write_page(MARKS[0] + MARKS[1])
        peer = json.loads(self.bench(SCENE, "--json", "-o", page).stdout)["scenes"][0]["peer"]
        self.assertEqual((peer["name"], peer["trace_ms"], peer["build_ms"]), ("sham", 2.5, 3))
        self.assertEqual((peer["differing_pixels"], peer["pixels_off_by_more_than_1"]), (0, 0))
        table = self.read(page)
        self.assertRegex(table, r"\| minimal\.json \| .* 2\.50 \| .* 25 % \| 0, 0 \|")
        self.assertIn("| packets of 16; single rays; none |", table)
        self.assertIn("The geometric mean of the ratios is **", table)

    @unittest.skipUnless(SOAK, "only in the soak")
    def test_pixels_that_differ_are_counted(self):
        self.peer(finish=self.FINISH.replace('"$1"', Error.SCENE))
        peer = json.loads(self.bench(SCENE, "--json").stdout)["scenes"][0]["peer"]
        self.assertGreater(peer["differing_pixels"], 0)
        self.assertLessEqual(peer["pixels_off_by_more_than_1"], peer["differing_pixels"])

    @unittest.skipUnless(SOAK, "only in the soak")
    def test_one_that_fails_is_told_of(self):
        for fault, message in (({"hello": "no JSON"}, "does not answer"), ({"serve": "exit 0"}, "has ended"),
                               ({"finish": "exit 1"}, "failed"), ({"finish": ""}, "peer.png: cannot be read")):
            self.peer(**fault)
            self.assertIn(message, self.bench(SCENE, status=1 if "peer.png" in message else 3).stderr)


@unittest.skipUnless(SOAK, "only in the soak")
class Ladder(BenchTest):
    def test_every_rung_is_measured_and_the_plots_get_their_columns(self):
        os.symlink(os.path.abspath("scenes"), os.path.join(self.folder.name, "scenes"))
        table = self.bench("--ladder", "--folder", "files").stdout
        for name in ("original", "cornell", "mirrors", "gallery", "menger-2", "menger-4", "city-1k", "city-200k"):
            self.assertIn(f"| {name} |", table)
        with open(os.path.join(self.folder.name, "files", "ladder.dat")) as file:
            self.assertEqual(len(file.readlines()), 11)
        with open(os.path.join(self.folder.name, "files", "scaling.dat")) as file:
            self.assertEqual(len(file.readlines()), 12)
        with open(os.path.join(self.folder.name, "files", "process.dat")) as file:
            faces = [int(line.split()[1]) for line in file.readlines()[1:]]
        self.assertEqual(faces, [12, 102, 1002, 10002, 100002, 1000002, 10000002])


class Error(BenchTest):
    """Time against error: what must hold whatever the times."""

    SCENE = os.path.join(os.path.dirname(SCENE), "many_lights.json")
    LESSON = os.path.join(os.path.dirname(SCENE), "..", "..", "scenes", "lessons", "camera_in_the_plane.json")
    MARKS = ("<!-- bench error: made by `make bench-error`, from here -->\n", "<!-- bench error: to here -->\n")

    def setUp(self):
        super().setUp()
        page = self.write_page("before\n" + self.MARKS[0] + "stale\n" + self.MARKS[1] + "after\n")
        self.bench("error", self.SCENE, self.LESSON, "--folder", "files", "-o", page)
        with open(os.path.join(self.folder.name, "files", "arithmetic.csv"), newline="") as file:
            self.arithmetic = {(row["scene"], row["choice"]): row for row in csv.DictReader(file)}
        with open(os.path.join(self.folder.name, "files", "error-many_lights.csv"), newline="") as file:
            self.rows = {row["choice"]: row for row in csv.DictReader(file)}
        self.page = self.read(page)

    def rmse(self, name):
        return float(self.rows[name]["rmse"])

    def test_everything(self):
        """One measurement, several looks at it: it takes seconds."""
        with self.subTest("every choice is there"):
            for grid in (1, 2, 3, 4, 6, 8, 12, 16):
                for way in ("float", "double", "reference"):
                    self.assertEqual(int(self.rows[f"{way}, grid {grid}"]["primary"]), 48 * grid * grid)
                    if grid > 1:
                        self.assertLessEqual(int(self.rows[f"{way}, adaptive {grid}"]["primary"]),
                                             48 * (max(4 * grid, grid * grid // 2) + 1))
            for way in ("textbook", "exact"):
                for precision in ("float", "double"):
                    for grid in (1, 2, 4, 8):
                        row = self.rows[f"plain/{way}/{precision}, grid {grid}"]
                        self.assertEqual((row["kernel"], row["arithmetic"], row["precision"]),
                                         ("plain", way, precision))
                        self.assertEqual(int(row["primary"]), 48 * grid * grid)
            for more in ("0 bounces", "accel none", "accel kdtree", "accel bvh"):
                self.assertIn(f"float, grid 4, {more}", self.rows)
        with self.subTest("the double kernel is as far from the truth as the reference, float hardly farther"):
            for grid in (1, 2, 3, 4, 6, 8, 12, 16):
                exact = self.rmse(f"reference, grid {grid}")
                self.assertAlmostEqual(self.rmse(f"double, grid {grid}"), exact, delta=1e-6 * exact)
                self.assertAlmostEqual(self.rmse(f"float, grid {grid}"), exact, delta=1e-3 * exact)
        with self.subTest("more rays come closer to the truth, whose own error is far below"):
            self.assertLess(self.rmse("float, grid 16"), self.rmse("float, grid 4"))
            self.assertLess(self.rmse("float, grid 4"), self.rmse("float, grid 1"))
            self.assertLess(3 * float(self.rows["float, grid 1"]["truth_error"]), self.rmse("float, grid 16"))
        with self.subTest("adaptive, each backend gives the other's pixels"):
            for grid in (2, 3, 4, 6, 8, 12, 16):
                exact = self.rmse(f"reference, adaptive {grid}")
                self.assertAlmostEqual(self.rmse(f"double, adaptive {grid}"), exact, delta=1e-6 * exact)
                self.assertAlmostEqual(self.rmse(f"float, adaptive {grid}"), exact, delta=1e-2 * exact)
        with self.subTest("fewer bounces are farther"):
            self.assertGreater(self.rmse("float, grid 4, 0 bounces"), 2 * self.rmse("float, grid 4"))
        with self.subTest("what is dominated names what is faster and as close, and what is not is on the front"):
            for row in self.rows.values():
                better = [other for other in self.rows.values() if float(other["trace_ms"]) < float(row["trace_ms"])
                          and float(other["rmse"]) <= 1.00999 * float(row["rmse"])]
                if row["on_front"] == "1":
                    self.assertEqual(better, [])
                else:
                    by = self.rows[row["better"]]
                    self.assertLessEqual(float(by["trace_ms"]), float(row["trace_ms"]))
                    self.assertLessEqual(float(by["rmse"]), 1.01001 * float(row["rmse"]))
        with self.subTest("the tables are in the page"):
            self.assertTrue(self.page.startswith("before\n" + self.MARKS[0]))
            self.assertTrue(self.page.endswith(self.MARKS[1] + "after\n"))
            self.assertNotIn("stale", self.page)
            for name in self.rows:
                self.assertIn(f"| {name} |", self.page)
        with self.subTest("the plain kernel is as far from the truth as packets are"):
            for grid in (1, 2, 4, 8):
                exact = self.rmse(f"reference, grid {grid}")
                self.assertAlmostEqual(self.rmse(f"plain/exact/double, grid {grid}"), exact, delta=1e-6 * exact)
                self.assertAlmostEqual(self.rmse(f"plain/exact/float, grid {grid}"), exact, delta=1e-3 * exact)
        with self.subTest("what exact arithmetic buys: a lesson's fault, in either precision"):
            ways = ["plain/textbook/float", "plain/exact/float", "plain/textbook/double", "plain/exact/double",
                    "packet/exact/float", "packet/exact/double"]
            for scene in ("many_lights", "camera_in_the_plane"):
                rows = [self.arithmetic[scene, way] for way in ways]
                off = [int(row["pixels_off"]) for row in rows]
                fault = scene == "camera_in_the_plane"
                self.assertEqual([count > 0 for count in off], [fault, False, fault, False, False, False])
                self.assertEqual([float(row["rmse"]) > 1e-3 for row in rows], [count > 0 for count in off])
                self.assertLess(float(rows[3]["rmse"]), 1e-15)
                self.assertRegex(self.page, rf"(?m)^\| {scene} \| 8 x 6 \| [\d.]+ \| [\d.]+ \| [\d.]+ \|")
        with self.subTest("what it sweeps itself is not asked for"):
            for words in (("-p", "float"), ("--kernel", "plain"), ("--arithmetic", "textbook")):
                self.assertIn("measures both", self.bench("error", self.SCENE, *words, status=2).stderr)
            self.assertIn("CSV", self.bench("error", self.SCENE, "--json", status=2).stderr)


class Kernels(BenchTest):
    """The ladder of kernels: what must hold whatever the times."""

    SCENE = os.path.join(os.path.dirname(SCENE), "many_lights.json")
    MARKS = ("<!-- bench kernels: made by `make bench-kernels`, from here -->\n", "<!-- bench kernels: to here -->\n")

    def rows(self, scene):
        with open(os.path.join(self.folder.name, "files", f"kernels-{scene}.tsv"), newline="") as file:
            return list(csv.DictReader(file, delimiter="\t"))

    def test_every_row_is_measured_and_compared_with_the_row_that_it_improves(self):
        page = self.write_page("before\n" + self.MARKS[0] + "stale\n" + self.MARKS[1] + "after\n")
        self.bench("kernels", self.SCENE, "--precision=double", "--folder", "files", "-o", page)
        rows = self.rows("many_lights")
        self.assertEqual([(row["backend"], row["kernel"], row["accel"], row["lanes"], row["tiles"], row["against"])
                          for row in rows],
                         [("reference", "", "none", "0", "0", "0"), ("reference", "", "none", "0", "0", "1"),
                          ("opencl", "plain", "none", "1", "0", "2"), ("opencl", "plain", "kdtree", "1", "0", "3"),
                          ("opencl", "plain", "bvh", "1", "0", "4"), ("opencl", "packet", "bvh", "1", "0", "5"),
                          ("opencl", "packet", "bvh", "4", "0", "6"), ("opencl", "packet", "bvh", "8", "0", "7"),
                          ("opencl", "packet", "bvh", "16", "0", "8"), ("opencl", "packet", "bvh", "4", "1", "7"),
                          ("opencl", "packet", "bvh", "8", "1", "8"), ("opencl", "packet", "bvh", "16", "1", "9")])
        text = self.read(page)
        for row in rows:
            with self.subTest(row["name"]):
                before = [other for other in rows if other["row"] == row["against"]]
                self.assertEqual((row["runs"], row["differing"]), ("1", "0"), "in double all pictures are the same")
                self.assertAlmostEqual(float(row["ratio"]),
                                       float(before[0]["trace_ms"]) / float(row["trace_ms"]) if before else 0,
                                       delta=0.01 * float(row["ratio"]) + 0.01)
                self.assertIn(f"| {row['row']} | {row['name']} |", text)
        for tested in ("face_tests", "box_tests"):
            counts = [int(row[tested]) for row in rows]
            self.assertTrue(counts[0] == counts[1] == counts[2], "without a tree, each ray meets each face")
            self.assertTrue(all((count > 0) == (tested == "face_tests" or row["accel"] != "none")
                                for count, row in zip(counts, rows)))
        self.assertGreater(int(rows[2]["face_tests"]), int(rows[4]["face_tests"]))
        self.assertTrue(text.startswith("before\n" + self.MARKS[0]))
        self.assertTrue(text.endswith(self.MARKS[1] + "after\n"))
        self.assertNotIn("stale", text)

    def test_classes_of_tiles_change_what_is_tested(self):
        self.bench("kernels", self.SCENE, "--folder", "files")
        rows = {(row["kernel"], row["lanes"], row["tiles"]): row["face_tests"] for row in self.rows("many_lights")}
        self.assertNotEqual([rows["packet", lanes, "0"] for lanes in ("4", "8", "16")],
                            [rows["packet", lanes, "1"] for lanes in ("4", "8", "16")])

    def test_a_kernel_with_another_picture_is_told_of(self):
        mine = os.path.join(self.folder.name, "mine")
        shutil.copytree("kernels", mine)
        with open(os.path.join(mine, "plain.cl")) as file:
            kernel = file.read()
        with open(os.path.join(mine, "plain.cl"), "w") as file:
            file.write(kernel.replace("sum / (real)(grid * grid)", "(real3)1 - sum / (real)(grid * grid)"))
        with unittest.mock.patch.dict(os.environ, RECTRAY_KERNELS=mine):
            text = self.bench("kernels", self.SCENE, "--precision=double", "--folder", "files").stdout
        for row in self.rows("many_lights"):
            differs = row["kernel"] == "plain"
            self.assertEqual((int(row["differing"]) > 0, int(row["off_by_more_than_1"]) > 0), (differs, differs))
        self.assertRegex(text, r"plain, bvh .* \d+ pixels differ, \d+ by more than 1 \|")

    def test_rows_without_a_tree_that_take_minutes_are_left_out(self):
        with open(os.path.join(self.folder.name, "grid.json"), "w") as scene:
            subprocess.run([RECTRAY, "generate", "grid", "--size", "300"], stdout=scene, check=True)
        text = self.bench("kernels", "grid.json", "--folder", "files", grid=16).stdout
        self.assertEqual([row["runs"] for row in self.rows("grid")], ["0"] * 3 + ["1"] * 9)
        self.assertEqual(text.count("| left out |"), 3)

    def test_what_it_sweeps_itself_is_not_asked_for(self):
        self.assertIn("needs scenes", self.bench("kernels", status=2).stderr)
        self.bench("kernels", "missing.json", status=1)
        for option in ("--ladder", "--json", "--kernel=plain", "--arithmetic=textbook", "--accel=bvh", "--lanes=4"):
            self.assertIn(f"takes no {option.split('=')[0]}:",
                          self.bench("kernels", self.SCENE, option, status=2).stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
