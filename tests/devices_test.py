"""Devices that are not here: tests/shims/opencl_device.c lets this one say that it has no double, that it is a GPU, or
that its compiler is another. The pictures must be right all the same, and where they are not without double, they must
be no worse than docs/devices.md says."""
import glob
import json
import os
import shutil
import subprocess
import unittest

from support.program import PROGRAM, SCENE, CommandTest, png_pixels

SHIM = os.path.join(os.path.dirname(PROGRAM), "shims", "opencl_device.so")
ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))

# Without double, packets of rays may be off in so many pixels, by so much: docs/devices.md.
LOST_BY_PACKETS = {"eye_on_a_plane": (33, 227)}

# See tests/faults_test.py.
with open(PROGRAM, "rb") as program:
    SANITIZED = b"__asan_init" in program.read()


def scenes():
    return sorted(glob.glob(os.path.join(ROOT, "tests/scenes/*.json")) + glob.glob(os.path.join(ROOT, "scenes/*.json")))


def name_of(scene):
    return os.path.splitext(os.path.basename(scene))[0]


def size_of(scene):
    """Small pictures, but those that are small already in their own size, which some are made for."""
    with open(scene, encoding="utf-8") as file:
        screen = json.load(file).get("screen", {})
    small = screen.get("columns", 640) * screen.get("rows", 480) <= 10000
    return [] if small else ["--size", "61x47", "--grid", "1"]


class ShimTest(CommandTest):
    references = {}

    def environment(self, **settings):
        environment = dict(os.environ, LD_PRELOAD=SHIM, **settings)
        if SANITIZED:
            environment["ASAN_OPTIONS"] = environment.get("ASAN_OPTIONS", "") + ":verify_asan_link_order=0"
        return environment

    def pixels(self, scene, *words, **settings):
        env = self.environment(**settings) if settings else None
        self.run_program("render", scene, "-q", "-o", "a.png", *(words or ()), env=env)
        return sum(png_pixels(self.bytes_of("a.png")), [])

    def log(self):
        with open(self.path("log"), encoding="utf-8") as file:
            return file.read().splitlines()

    def differences(self, scene, words, picture_words, **settings):
        """By how much each pixel is off the reference's, which is rendered once."""
        key = (scene, *words)
        if key not in self.references:
            self.references[key] = self.pixels(scene, *words, "--backend", "reference")
        expected = self.references[key]
        picture = self.pixels(scene, *words, *picture_words, **settings)
        self.assertEqual(len(expected), len(picture))
        return [max(abs(a - b) for a, b in zip(p, q)) for p, q in zip(expected, picture)]

    def check(self, scene, words, picture_words, bound, **settings):
        pixels, most = bound
        with self.subTest(scene=name_of(scene), words=picture_words, **settings):
            off = self.differences(scene, words, picture_words, **settings)
            self.assertLessEqual(sum(d > 1 for d in off), pixels)
            self.assertLessEqual(max(off), most)


class Gpu(ShimTest):
    def test_one_ray_per_item_renders_every_scene_right(self):
        for scene in scenes():
            self.check(scene, size_of(scene), [], (0, 1), SHIM_GPU="1")
            self.check(scene, size_of(scene), ["--precision", "double"], (0, 0), SHIM_GPU="1")

    def test_items_come_in_groups_of_64(self):
        out, _ = self.run_program("devices", env=self.environment(SHIM_GPU="1"))
        self.assertRegex(out.decode(), r"\A0: .* \(GPU\)\n(   .*\n)*   rays at once   1 in float, 1 in double\n")
        for words in ([], ["--sampling", "uniform:2"], ["--kernel", "plain", "--sampling", "uniform:1"],
                      ["--kernel", "packet", "--sampling", "adaptive:4"]):
            self.pixels("scene.json", *words, SHIM_GPU="1", SHIM_LOG=self.path("log"))
        launches = [line.split()[1:] for line in self.log() if line.startswith("LAUNCH")]
        self.assertGreaterEqual(len(launches), 3)
        for items, group in launches:
            self.assertEqual((int(items) % 64, group), (0, "64"))

    def launches(self, *words):
        """How many a picture of 1920x1080 takes on a fast device."""
        self.run_program("render", "scene.json", "-q", "-o", "a.png", "--size", "1920x1080", *words,
                         env=self.environment(SHIM_GPU="1", SHIM_SPEED="1000", SHIM_LOG=self.path("log")))
        return sum(line.startswith("LAUNCH") for line in self.log())

    def test_a_picture_takes_few_launches_on_a_fast_device(self):
        self.assertLessEqual(self.launches("--sampling", "uniform:1"), 8)

    def test_adaptive_sampling_takes_five_launches_a_band(self):
        launches = self.launches("--sampling", "adaptive:8")
        self.assertEqual(launches % 5, 0)
        self.assertLessEqual(launches, 5 + 5 * 5)  # the first five compile

    def kernel_used(self, *words, **settings):
        out, _ = self.run_program("render", "scene.json", "-q", "--stats=json", "-o", "a.png", *words,
                                  env=self.environment(**settings))
        return json.loads(out).get("kernel", "packet")

    def test_the_kernel_for_gpus_is_chosen_where_it_suits(self):
        uniform = ["--sampling", "uniform:1"]
        for words, kernel in ((uniform, "gpu"), (uniform + ["--lanes", "1"], "packet"),
                              (uniform + ["--kernel", "packet"], "packet"), (uniform + ["-p", "double"], "packet"),
                              (["--sampling", "adaptive:4"], "gpu"),
                              (["--sampling", "adaptive:4", "--lanes", "1"], "packet"),
                              (["--sampling", "adaptive:4", "-p", "double"], "packet")):
            self.assertEqual(self.kernel_used(*words, SHIM_GPU="1"), kernel, words)
        self.assertEqual(self.kernel_used(*uniform), "packet")
        self.assertEqual(self.kernel_used(*uniform, "--kernel", "gpu"), "gpu")

    def test_the_exact_pass_has_no_double_where_there_is_none(self):
        for scene in ("original", "cornell"):
            self.check(os.path.join(ROOT, f"scenes/{scene}.json"), ["--size", "61x47", "--grid", "1"], [], (0, 1),
                       SHIM_GPU="1", SHIM_NO_DOUBLE="1")


class NoDouble(ShimTest):
    SIZE = ["--size", "160x120", "--grid", "1"]

    def test_every_scene_is_right(self):
        for scene in scenes():
            self.check(scene, size_of(scene), [], (0, 1), SHIM_NO_DOUBLE="1")
        self.check(os.path.join(ROOT, "scenes/original.json"), self.SIZE, [], (0, 1), SHIM_NO_DOUBLE="1")

    def test_the_plain_kernel_and_adaptive_sampling_are_right(self):
        """Without a tree, so that each is compiled once."""
        for name in ("scenes/original", "tests/scenes/eye_on_a_plane", "tests/scenes/one_sided", "scenes/mirrors"):
            scene = os.path.join(ROOT, name + ".json")
            for sampling, kernel in (("uniform:1", ["--kernel", "plain"]), ("adaptive:4", [])):
                self.check(scene, ["--size", "61x47", "--sampling", sampling, "--accel", "none"], kernel, (0, 1),
                           SHIM_NO_DOUBLE="1")

    def test_packets_meet_their_bound(self):
        for scene in scenes():
            bound = LOST_BY_PACKETS.get(name_of(scene), (0, 1))
            self.check(scene, size_of(scene), ["--lanes", "1"], bound, SHIM_NO_DOUBLE="1")
        self.check(os.path.join(ROOT, "scenes/original.json"), self.SIZE, ["--lanes", "1"], (6, 19), SHIM_NO_DOUBLE="1")

    def test_the_kernel_with_an_exact_pass_is_chosen(self):
        for words, kernel in ((["uniform:1"], "gpu"), (["adaptive:4"], "gpu"),
                              (["uniform:1", "--lanes", "1"], "packet")):
            out, _ = self.run_program("render", "scene.json", "-q", "--stats=json", "-o", "a.png", "--sampling", *words,
                                      env=self.environment(SHIM_NO_DOUBLE="1"))
            self.assertEqual(json.loads(out).get("kernel", "packet"), kernel, words)

    def test_rays_are_cast_as_exactly_as_pairs_hold_them(self):
        """The eye is 1e-9 above the face, and the directions differ where a float ends."""
        scene = os.path.join(ROOT, "tests/scenes/eye_on_a_plane.json")
        eye, ahead = (2.672612419124244e-10, 5.345224838248488e-10, 8.017837257372733e-10), (2, -1, 0)
        up = (0.2672612419124244, 0.5345224838248488, 0.8017837257372732)
        rays = "".join(" ".join(repr(x) for x in (*eye, *(a + k * 1e-10 * u for a, u in zip(ahead, up)))) + "\n"
                       for k in range(-9, 10))
        found = [self.run_program("cast", scene, *words, text_in=rays, env=env)[0].decode().splitlines()[1:]
                 for words, env in ((["--backend", "reference"], None), ([], self.environment(SHIM_NO_DOUBLE="1")))]
        self.assertEqual([len(lines) for lines in found], [19, 19])
        self.assertEqual(sum(line.split(",")[1] == "0" for line in found[0]), 8)
        for expected, line in zip(*found):
            expected, line = expected.split(","), line.split(",")
            self.assertEqual(expected[:2], line[:2])
            if expected[1] == "0":
                self.assertAlmostEqual(float(line[2]) / float(expected[2]), 1, delta=1e-3)

    def test_adaptive_sampling_refines_what_the_reference_does_and_a_little_more(self):
        for scene in scenes():
            words = ["render", scene, "-q", "--sampling", "adaptive:4", "--size", "61x47", "--stats=json",
                     "-o", "a.png"]
            refined = [json.loads(self.run_program(*words, *more, env=env)[0])["pixels"]["refined"]
                       for more, env in ((["-b", "reference"], None), ([], self.environment(SHIM_NO_DOUBLE="1")))]
            with self.subTest(scene=name_of(scene)):
                self.assertGreaterEqual(refined[1], refined[0])
                if name_of(scene) not in LOST_BY_PACKETS:
                    self.assertLessEqual(refined[1], 1.15 * refined[0] + 50)

    def test_the_other_kernels_run(self):
        scene = os.path.join(ROOT, "tests/scenes/many_lights.json")
        for sampling, kernel in (("uniform:1", ["--kernel", "plain"]), ("adaptive:4", [])):
            self.check(scene, ["--size", "61x47", "--sampling", sampling], kernel, (0, 1), SHIM_NO_DOUBLE="1")
        for env in (None, self.environment(SHIM_NO_DOUBLE="1")):
            out, _ = self.run_program("cast", "scene.json", text_in="1000.5 .5 1 0 0 -1\n", env=env)
            self.assertEqual(out.splitlines()[1].split(b",")[:2], [b"0", b"0"])

    def test_rays_of_any_length_are_cast(self):
        rays = "0 0 9 0 0 -1e50\n1e-50 0 9 0 0 -1e-50\n1e11 3 9 -1e11 -3 -9.5\n0 0 9 0 1e-50 -1e-50\n"
        scene = os.path.join(ROOT, "tests/scenes/grid.json")
        expected, found = [self.run_program("cast", scene, *words, text_in=rays, env=env)[0].decode().splitlines()[1:]
                           for words, env in ((["--backend", "reference"], None),
                                              ([], self.environment(SHIM_NO_DOUBLE="1")))]
        self.assertEqual([line.split(",")[1] == "-1" for line in expected], [False, False, False, True])
        for one, other in zip(expected, found):
            self.assertEqual(one.split(",")[:2], other.split(",")[:2])
            if one.split(",")[1] != "-1":
                self.assertAlmostEqual(float(other.split(",")[2]) / float(one.split(",")[2]), 1, delta=1e-12)

    def test_double_is_refused_with_a_way_out(self):
        _, err = self.run_program("render", "scene.json", "-p", "double", "-o", "a.png", status=3,
                                  env=self.environment(SHIM_NO_DOUBLE="1"))
        self.assertRegex(err, r"has no double precision; use --precision float\n$")
        self.assertEqual(self.files(), [])


class StressWithoutDouble(ShimTest):
    def test_a_part_of_the_stress_suite_passes(self):
        """It finds its scenes from the top of the tree."""
        found = subprocess.run([os.path.join(os.path.dirname(PROGRAM), "stress"), "--scale", "0.0002"], cwd=ROOT,
                               env=self.environment(SHIM_NO_DOUBLE="1"), capture_output=True, text=True, check=False)
        self.assertEqual((found.returncode, found.stdout), (0, "20 passed, 0 failed\n"))


class Language(ShimTest):
    def test_older_than_1_2_is_an_error(self):
        for version, status in (("OpenCL C 1.1 old", 3), ("OpenCL C 1.0 ", 3), ("OpenCL C 1.2 fine", 0),
                                ("OpenCL C 3.0", 0), ("untold", 0)):
            for words in (["render", "scene.json", "-o", "a.png"], ["cast", "scene.json"]):
                _, err = self.run_program(*words, text_in="0 0 0 1 1 1\n", status=status,
                                          env=self.environment(SHIM_C_VERSION=version))
                if status:
                    self.assertIn(f"knows {version} only, and the kernels need OpenCL C 1.2; choose another", err)
                    self.assertIn("--backend reference", err)


class Compiler(ShimTest):
    GRID = os.path.join(ROOT, "tests/scenes/grid.json")

    def environment(self, **settings):
        """Nothing is kept from an earlier run, so that the compiler speaks."""
        return super().environment(RECTRAY_CACHE_DIR="", POCL_CACHE_DIR=self.path("cache"), SHIM_LOG=self.path("log"),
                                   **settings)

    def builds(self, no_double):
        """Commands, each of which builds another program."""
        self.put("rays", "0 0 9 0 0 -1\n")
        render, cast = ["render", self.GRID, "-o", "a.png"], ["cast", self.GRID, "--rays", "rays"]
        for kernel in (render, render + ["--sampling", "adaptive:4"], cast):
            for lanes in ("1", "16") if no_double else ("16",):
                yield kernel + ["--accel", "bvh", "--lanes", lanes]
        yield render + ["--kernel", "plain"]
        for sampling in ("uniform:1", "adaptive:4"):
            yield render + ["--kernel", "gpu", "--sampling", sampling]
        if no_double:
            yield cast
        if not no_double:
            yield render + ["--accel", "kdtree", "--precision", "double"]

    def test_it_has_nothing_to_say(self):
        for settings in ({"SHIM_NO_DOUBLE": "1"}, {}):
            for words in self.builds(bool(settings)):
                self.put("log", "")
                self.run_program(*words, status=3, env=self.environment(SHIM_BUILD="refused", **settings))
                built, *said = self.log()
                with self.subTest(words=words[2:], **settings):
                    self.assertTrue(built.startswith("BUILT -D"), built)
                    self.assertEqual(said, [])
                    self.assertNotIn("-cl-", built)  # such options loosen the arithmetic

    def test_one_that_refuses_prefetching_or_lacks_builtins_will_do(self):
        words = ["--accel", "bvh", "--lanes", "4"]
        expected = self.pixels(self.GRID, *words)
        for compiler in ("spirv", "bare"):
            self.assertEqual(self.pixels(self.GRID, *words, SHIM_COMPILER=compiler), expected)

    def test_every_kernel_of_lanes_says_so(self):
        """A compiler that puts work-items side by side wants to know that a work-item is wide already."""
        found = 0
        for name in glob.glob(os.path.join(ROOT, "kernels/*/*.cl")):
            with open(name, encoding="utf-8") as file:
                text = file.read()
            if "\nkernel " in text and "/pairs/" not in name:
                found += 1
                self.assertIn("\nkernel FULL_LANES\nvoid ", text, name)
        self.assertEqual(found, 4)


class Frames(ShimTest):
    def test_the_program_is_made_once_for_all_frames(self):
        keys = [{"frame": k, "position": [1000.5, 0.5, 1 + k]} for k in (0, 7)]
        self.put("moving.json", json.dumps({**SCENE, "animation": {"frames": 8, "camera": keys}}))
        env = self.environment(SHIM_LOG=self.path("log"))
        self.run_program("render", "moving.json", "-q", "--frames", "all", "-o", "f%d.png", env=env)
        log = [line.split()[0] for line in self.log()]
        self.assertEqual(log.count("BUILT"), 1)
        self.assertGreaterEqual(log.count("LAUNCH"), 8)


class Check(ShimTest):
    """`rectray devices --check`."""
    KERNELS = ["packet, float", "packet, double", "plain, float", "gpu, float", "adaptive, float",
               "gpu adaptive, float", "cast, float"]

    def check_device(self, *words, status=0, **options):
        out, err = self.run_program("devices", "--check", "--json", *words, status=status, **options)
        return json.loads(out), err

    def test_the_device_here_is_right(self):
        found, err = self.check_device("0")
        self.assertEqual(err, "")
        self.assertEqual((found["verdict"], found["wrong"], found["device"]["number"]), ("right", 0, 0))
        self.assertRegex(found["device"]["language"], r"^OpenCL C \d")
        kernels = [kernel for kernel in self.KERNELS for _ in range(2)]
        if not found["device"]["double"]:
            kernels = [kernel for kernel in kernels if "double" not in kernel]
        self.assertEqual([step["kernel"] for step in found["steps"]], kernels)
        self.assertEqual([step["scene"] for step in found["steps"]], ["room", "boxes"] * (len(kernels) // 2))
        for step in found["steps"]:
            self.assertTrue(step["right"] and step["ran"] and step["message"] == "", step)
            self.assertEqual(step["compared"], 64 * 48)
            self.assertTrue(step["compile_ms"] > 0 and step["trace_ms"] > 0, step)

    def test_text_has_a_row_for_each_step_and_a_verdict(self):
        out, _ = self.run_program("devices", "--check")
        *rows, last = out.decode().splitlines()
        self.assertEqual(last, "verdict: right")
        steps = [row for row in rows if " compiled in " in row]
        self.assertEqual(len(steps), 14)
        for step in steps:
            self.assertRegex(step, r" compiled in +\d+ ms, traced in +\d+\.\d ms, [01] of 3072 off$")
        self.assertTrue(any(row.startswith("0: ") for row in rows))

    def test_without_double_it_says_so(self):
        found, _ = self.check_device(env=self.environment(SHIM_NO_DOUBLE="1"))
        self.assertEqual((found["verdict"], found["device"]["double"]), ("right without double", False))
        self.assertEqual(len(found["steps"]), 12)

    def test_a_kernel_that_is_wrong_is_found(self):
        shutil.copytree(os.path.join(ROOT, "kernels"), self.path("kernels"))
        with open(self.path("kernels/plain.cl"), encoding="utf-8") as file:
            text = file.read()
        self.assertIn("floor(255 * ", text)
        self.put("kernels/plain.cl", text.replace("floor(255 * ", "floor(240 * "))
        found, err = self.check_device(status=3, env=dict(os.environ, RECTRAY_KERNELS=self.path("kernels")))
        self.assertEqual(found["verdict"], "wrong")
        for step in found["steps"]:
            if step["kernel"].startswith("gpu"):
                continue  # its exact pass, for a few pixels, is the plain kernel
            wrong = step["kernel"].startswith("plain")
            self.assertEqual(step["right"], not wrong, step)
            self.assertEqual(step["off"] > 1000 and 10 < step["most_off"] <= 15, wrong, step)
        self.assertRegex(err, r"^rectray: device 0 is wrong in [2-6] of 14 checks; docs/devices.md tells what to do")

    def test_a_compiler_that_fails_is_told_for_each_kernel(self):
        found, err = self.check_device(status=3, env=self.environment(SHIM_BUILD="refused"))
        self.assertEqual(found["wrong"], len(found["steps"]))
        for step in found["steps"]:
            self.assertFalse(step["ran"] or step["right"])
            self.assertIn("the kernels do not compile for ", step["message"])
        self.assertIn("is wrong in 14 of 14 checks", err)
        out, _ = self.run_program("devices", "--check", status=3, env=self.environment(SHIM_BUILD="refused"))
        self.assertEqual(out.count(b" FAILED: the kernels do not compile"), 14)
        self.assertIn(b"verdict: wrong in 14 of 14 checks", out)

    def test_devices_are_chosen_by_number(self):
        every, one = (self.run_program("devices", *words)[0].decode() for words in ([], ["0"]))
        self.assertTrue(every.startswith(one) and one.startswith("0: "))
        found = json.loads(self.run_program("devices", "--json")[0])["devices"]
        self.assertEqual([device["number"] for device in found], list(range(len(found))))
        for words in (["x"], ["-1"], ["9999"], ["99999"], ["--check", "9999"], ["0", "0"]):
            self.assertIn("devices", self.run_program("devices", *words, status=2)[1])


if __name__ == "__main__":
    unittest.main()
