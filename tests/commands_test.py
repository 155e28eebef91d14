#!/usr/bin/env python3
"""The program from outside: exit statuses, what goes to which stream, and that docs/commands.md tells the options."""
import collections
import glob
import json
import os
import re
import shutil
import struct
import subprocess
import unittest

from support.program import PROGRAM, SCENE, CommandTest, png_pixels


with open(PROGRAM, "rb") as program:
    SANITIZED = b"__asan_init" in program.read()


class ExitStatus(CommandTest):
    def test_help_and_version_are_data(self):
        for words in (["--help"], ["-h"], ["--version"], ["render", "--help"], ["check", "-V"]):
            out, err = self.run_program(*words)
            self.assertTrue(out)
            self.assertEqual(err, "")

    def test_version_names_the_program(self):
        self.assertRegex(self.run_program("--version")[0], rb"^rectray \d+\.\d+")

    def test_every_command_has_help_of_at_most_100_columns(self):
        for line in self.run_program("--help")[0].decode().splitlines():
            self.assertLessEqual(len(line), 100)
            match = re.match(r"  (\w+) ", line)
            if match:
                out = self.run_program(match[1], "--help")[0].decode()
                self.assertIn(f"usage: rectray {match[1]}", out)
                self.assertLessEqual(max(map(len, out.splitlines())), 100)

    def test_a_wrong_command_line_is_2(self):
        for words in ([], ["paint"], ["render"], ["render", "scene.json", "--size", "8"], ["check", "scene.json", "-o"],
                      ["compare", "a.png"], ["devices", "x"], ["render", "--backend", "cuda", "scene.json"]):
            out, err = self.run_program(*words, status=2)
            self.assertEqual(out, b"")
            self.assertIn("rectray: ", err)

    def test_no_command_shows_the_usage_on_stderr(self):
        self.assertIn("usage: rectray COMMAND", self.run_program(status=2)[1])

    def test_a_wrong_scene_is_1_and_the_message_begins_with_its_place(self):
        self.put("bad.json", '{\n  "camera": 7 }')
        for command in ("render", "cast", "check"):
            out, err = self.run_program(command, "bad.json", status=1)
            self.assertEqual(out, b"")
            self.assertRegex(err, r"^bad\.json:\d+:\d+: ")
        self.assertIn("missing.json", self.run_program("check", "missing.json", status=1)[1])
        self.assertEqual(self.files(), ["bad.json"])


class Render(CommandTest):
    def test_the_reference_says_beforehand_that_it_will_take_long(self):
        process = self.start("render", "scene.json", "-b", "reference", "--size", "4000x4000", "--grid", "16", "-o",
                             "a.png")
        line = process.stderr.readline().decode()
        process.kill()
        process.communicate()
        self.assertRegex(line, r"^rectray: note: the reference will take about \d+ s for this picture")
        self.assertEqual(self.render("-o", "a.png")[1].count("\n"), 1)

    def test_the_picture_is_named_after_the_scene_in_the_working_directory(self):
        os.mkdir(self.path("work"))
        out, err = subprocess.Popen([PROGRAM, "render", "../scene.json", "-b", "reference"], cwd=self.path("work"),
                                    stdout=subprocess.PIPE, stderr=subprocess.PIPE).communicate()
        self.assertEqual(os.listdir(self.path("work")), ["scene.png"])
        self.assertEqual(out, b"")
        self.assertIn("scene.png: 8 x 6 pixels", err.decode())

    def test_the_same_bytes_to_a_file_and_to_stdout_each_time_on_any_threads(self):
        self.render("-o", "a.png")
        expected = self.bytes_of("a.png")
        self.assertEqual(struct.unpack(">8s4x4sIIBB", expected[:26]), (b"\x89PNG\r\n\x1a\n", b"IHDR", 8, 6, 8, 2))
        for threads in ("1", "2", "7"):
            out, err = self.render("-o", "-", "--threads", threads)
            self.assertEqual(out, expected)
            self.assertEqual(err, "")

    def test_the_options_override_the_scene(self):
        out, _ = self.render("-o", "-", "--size", "3x5")
        self.assertEqual(struct.unpack(">II", out[16:24]), (3, 5))
        stats = json.loads(self.render("--size", "3x5", "--grid", "4", "--stats=json")[0])
        self.assertEqual(stats["rays"]["primary"], 3 * 5 * 16)

    def test_adaptive_sampling_is_chosen_by_the_scene_or_the_command_line(self):
        def refined(*words):
            stats = json.loads(self.render("--size", "3x5", *words, "--stats=json")[0])
            return stats["rays"]["primary"], stats["pixels"]["refined"]
        rays, pixels = refined("--sampling", "adaptive:3")
        self.assertTrue(0 < pixels)
        self.assertEqual(rays, 15 + 8 * pixels)
        rays, again = refined("--sampling", "adaptive")
        self.assertEqual(again, pixels)
        self.assertEqual(rays, 15 + 16 * pixels)
        self.assertEqual(refined("--sampling", "adaptive:3", "--grid", "2"), (60, 0))
        self.assertEqual(refined("--grid", "2", "--sampling", "uniform:1"), (15, 0))

    def test_maps_show_what_pixels_cost_and_meet(self):
        for kind in ("rays", "time", "depth", "normal", "face", "tests"):
            _, err = self.render("--map", kind, "map.png", "--size", "5x4")
            self.assertIn("map.png: ", err)
            pixels = png_pixels(self.bytes_of("map.png"))
            self.assertEqual((len(pixels), len(pixels[0])), (4, 5))
            self.assertGreater(len(set(sum(pixels, []))), 1, kind)
        scale = self.render("--map", "rays", "map.png", "--sampling", "adaptive:2")[1]
        self.assertRegex(scale, r"rays per pixel, from [1-9]\d* \(black\) to [1-9]\d* \(white\)")

    def test_a_mark_is_drawn_around_a_pixel_and_its_neighbours_are_printed(self):
        self.render("-o", "plain.png", "--size", "96x60")
        plain = png_pixels(self.bytes_of("plain.png"))
        for column, row in ((0, 0), (50, 31), (95, 59)):
            _, err = self.render("-o", "a.png", "--size", "96x60", "--mark", f"{column},{row}")
            marked = png_pixels(self.bytes_of("a.png"))
            self.assertNotEqual(marked, plain)
            self.assertNotIn("\n\n", "\n" + err)
            around = {(x, y): plain[y][x] for y in range(row - 1, row + 2) for x in range(column - 1, column + 2)
                      if 0 <= x < 96 and 0 <= y < 60}
            printed = re.findall(r"\((\d+), (\d+)\) = \((\d+), (\d+), (\d+)\)", err)
            self.assertEqual({(int(x), int(y)): tuple(map(int, rgb)) for x, y, *rgb in printed}, around)
            self.assertEqual({at: marked[at[1]][at[0]] for at in around}, around)
        self.render("-o", "a.png", "--mark", "3,3", "-q")  # too small for a magnified part
        self.assertIn("--mark 8,0 is outside", self.run_program("render", "scene.json", "--mark", "8,0", status=2)[1])

    def test_maps_of_tests_can_be_set_side_by_side(self):
        def bright(*words):
            err = self.render("--map", "tests", "map.png", "--size", "16x12", *words)[1]
            low, high = re.search(r"tested per pixel, from (\S+) \(black\) to (\S+) \(white\)", err).groups()
            return float(low), float(high), sum(map(sum, sum(png_pixels(self.bytes_of("map.png")), [])))
        low, high, _ = bright("--accel", "none")
        self.assertTrue(0 < low < high)
        stats = json.loads(self.render("--size", "16x12", "--accel", "none", "--stats=json")[0])
        self.assertTrue(low <= stats["tests"]["face"] / 192 <= high)
        scale = ("--map-scale", f"{low:g}:{100 * high:g}")
        self.assertEqual(bright("--accel", "none", *scale)[:2], (low, 100 * high))
        self.assertLess(bright("--accel", "none", *scale)[2], bright("--accel", "none")[2])
        for text, *words in (["two numbers above 0", "--map-scale", "5:2"],
                             ["two numbers above 0", "--map-scale", "0:2"],
                             ["two numbers above 0", "--map-scale", "5"], ["needs --map", "--map-scale", "1:2"]):
            self.assertIn(text, self.run_program("render", "scene.json", *words, status=2)[1])

    def test_maps_that_cannot_be_are_refused(self):
        for text, *words in (["needs --backend reference", "time", "map.png"], ["the name of a file", "rays"],
                             ["the name of a file", "rays", "-q"],
                             ["'colour': expected rays, time", "colour", "map.png"],
                             ["would replace the picture", "rays", "a.png", "-o", "a.png"],
                             ["would replace the scene", "rays", "scene.json"]):
            self.assertIn(text, self.run_program("render", "scene.json", "--map", *words, status=2)[1])

    def test_quiet_says_nothing(self):
        self.assertEqual(self.render("-q"), (b"", ""))

    def test_options_without_effect_are_told_of(self):
        for words in (["--lanes", "8"], ["--device", "0"], ["--kernel", "plain"], ["--precision", "float"]):
            self.assertIn(f"note: {words[0]}", self.render(*words)[1])
        self.assertNotIn("note", self.render("--precision", "double")[1])

    def test_stats_go_to_stdout_or_where_the_picture_does_not(self):
        keys = ["phases_ms", "rays", "skipped", "pixels", "tests", "faces", "lights", "device", "backend", "precision",
                "lanes",
                "accel", "build_options", "device_memory_bytes", "peak_memory_bytes"]
        stats = json.loads(self.render("--stats=json")[0])
        self.assertEqual(sorted(stats), sorted(keys))
        words = ["-b", "opencl", "--kernel", "plain"]
        plain = json.loads(self.render("--stats=json", *words)[0])
        self.assertEqual(list(plain)[-2:], ["kernel", "arithmetic"])
        self.assertEqual((plain["kernel"], plain["arithmetic"]), ("plain", "exact"))
        self.assertIn("plain, exact arithmetic", self.render("--stats", *words)[0].decode())
        self.assertEqual(sorted(stats["phases_ms"]), sorted(["parse", "build", "device", "compile", "upload", "trace",
                                                             "readback", "encode", "total"]))
        self.assertEqual((stats["faces"], stats["lights"], stats["rays"]["primary"]), (2, 1, 48))
        self.assertEqual((stats["backend"], stats["precision"]), ("reference", "double"))
        self.assertGreaterEqual(stats["phases_ms"]["total"], stats["phases_ms"]["trace"])
        out, err = self.render("-o", "-", "--stats=json")
        self.assertEqual(out[:4], b"\x89PNG")
        self.assertEqual(json.loads(err)["faces"], 2)
        self.assertIn(b"primary rays", self.render("--stats")[0])

    @unittest.skipIf(SANITIZED, "a sanitizer takes memory of its own")
    def test_memory_is_told_beforehand(self):
        if platform() != "Portable Computing Language": # other drivers take more, or less, for themselves
            self.skipTest("the driver's own memory is counted as PoCL's")
        self.run_program("generate", "city", "--size", "20000", "-o", "city.json")
        words = ["render", "city.json", "--size", "64x48", "-q", "-o", "a.png", "--stats=json"]
        self.run_program(*words) # compiling a kernel takes memory, too
        taken = json.loads(self.run_program(*words)[0])["peak_memory_bytes"]
        told = json.loads(self.run_program("check", "--json", "city.json")[0])["needs"]["memory_bytes"]
        self.assertLess(abs(taken - told), 0.3 * told)

    def test_work_that_may_be_skipped_is_done_on_demand(self):
        some, none = (json.loads(self.run_program("render", "scene.json", "-o", "a.png", "--stats=json", *words)[0])
                      for words in ([], ["--no-skip", "all"]))
        self.assertGreater(sum(some["skipped"].values()), 0)
        self.assertEqual(sum(none["skipped"].values()), 0)

    def test_a_shift_moves_the_points_of_textbook_arithmetic(self):
        for name, shift in (("a.png", []), ("b.png", ["--shift", "1e-5"]), ("c.png", ["--shift", "0.3"])):
            self.run_program("render", os.path.abspath("scenes/cornell.json"), "--size", "24x24", "--sampling",
                             "uniform:1", "--kernel", "plain", "--arithmetic", "textbook", *shift, "-o", name)
        self.assertEqual(self.bytes_of("a.png"), self.bytes_of("b.png"))
        self.assertNotEqual(self.bytes_of("a.png"), self.bytes_of("c.png"))

    def test_choices_that_do_not_go_together_are_refused_with_the_way_out(self):
        plain, textbook = ["--kernel", "plain"], ["--arithmetic", "textbook"]
        reference = ["--backend", "reference", *textbook]
        for text, *words in (["use --sampling uniform:N or --kernel packet", *plain, "--sampling", "adaptive"],
                             ["leave out --lanes, or use --kernel packet", *plain, "--lanes", "4"],
                             ["add --kernel plain", *textbook],
                             ["--shift needs --arithmetic textbook", "--shift", "0.1"],
                             ["--shift needs --arithmetic textbook", *plain, "--shift", "0.1"],
                             ["leave out --arithmetic textbook", *plain, *textbook, "--map", "rays", "map.png"],
                             ["leave out --accel, or use --kernel plain", *reference, "--accel", "bvh"],
                             ["use --sampling uniform:N", *reference, "--sampling", "adaptive"],
                             ["expected a number from 0 to 1e6", *plain, *textbook, "--shift", "-1"],
                             ["expected a number from 0 to 1e6", *plain, *textbook, "--shift", "1e7"],
                             ["expected auto, packet, plain or gpu", "--kernel", "fast"],
                             ["expected exact or textbook", "--arithmetic", "rounded"]):
            self.assertIn(text, self.run_program("render", "scene.json", *words, status=2)[1])
        self.assertIn("cast takes no --kernel", self.run_program("cast", "scene.json", *plain, status=2)[1])

    def test_the_reference_s_textbook_arithmetic_is_double_or_float(self):
        for words, precision in (([], "double"), (["-p", "float"], "float"), (["-p", "double"], "double")):
            out, err = self.render("--arithmetic", "textbook", *words, "--stats=json")
            self.assertEqual(json.loads(out)["precision"], precision)
            self.assertNotIn("note", err)

    def test_both_backends_agree_on_a_plain_scene(self):
        self.render("-o", "a.png")
        self.run_program("render", "scene.json", "--precision", "double", "-o", "b.png")
        self.run_program("compare", "a.png", "b.png")


class Kernels(CommandTest):
    def test_they_are_read_from_the_folder_that_is_named(self):
        with_folder = dict(os.environ, RECTRAY_KERNELS=self.path("nowhere"))
        _, err = self.run_program("render", "scene.json", status=3, env=with_folder)
        self.assertIn("nowhere/tile/render.cl: cannot be opened", err)

    def test_no_folder_is_named_by_an_empty_name(self):
        self.run_program("render", "scene.json", env=dict(os.environ, RECTRAY_KERNELS=""))

    def test_one_that_does_not_compile_is_3_and_its_file_and_line_are_told(self):
        shutil.copytree("kernels", self.path("kernels"))
        with open(self.path("kernels/packet/intersect.cl"), "r+", encoding="utf-8") as file:
            lines = file.read().splitlines()
            file.write("\nthis is no kernel;\n")
        for words in (["render", "scene.json", "-o", "a.png"], ["cast", "scene.json"]):
            _, err = self.run_program(*words, text_in="0 0 0 1 1 1\n", status=3,
                                      env=dict(os.environ, RECTRAY_KERNELS=self.path("kernels")))
            self.assertRegex(err, r"(?m)^rectray: the kernels do not compile for \S.*; the compiler says:$")
            self.assertIn(f"packet/intersect.cl:{len(lines) + 2}:", err)
        self.assertEqual(self.files(), ["kernels"])

    def test_an_edit_of_the_plain_kernel_shows_in_the_picture(self):
        shutil.copytree("kernels", self.path("kernels"))
        with open(self.path("kernels/plain.cl"), "r+", encoding="utf-8") as file:
            text = file.read()
            file.seek(0)
            self.assertEqual(text.count("l_dot_n * diffuse"), 1)
            file.write(text.replace("l_dot_n * diffuse", "0.5f * l_dot_n * diffuse"))
        for name, kernels in (("as-it-is.png", ""), ("edited.png", self.path("kernels"))):
            self.run_program("render", os.path.abspath("scenes/gallery.json"), "--size", "32x24", "--grid", "1",
                             "--kernel", "plain", "-o", name, env=dict(os.environ, RECTRAY_KERNELS=kernels))
        as_it_is, edited = (sum(png_pixels(self.bytes_of(name)), []) for name in ("as-it-is.png", "edited.png"))
        changed = sum(a != b for a, b in zip(as_it_is, edited))
        self.assertGreater(changed, len(as_it_is) / 2)

    def test_a_change_of_the_lights_formula_shows_with_and_without_a_classification_of_tiles(self):
        scene, size = os.path.abspath("scenes/cornell.json"), ("--size", "160x120", "--sampling", "uniform:1")
        self.run_program("render", scene, *size, "-o", "before.png")
        shutil.copytree("kernels", self.path("kernels"))
        with open(self.path("kernels/packet/light.cl"), "r+", encoding="utf-8") as file:
            text, term = file.read(), "terms.exponent = material[MATERIAL_EXPONENT];"
            self.assertEqual(text.count(term), 1)
            file.seek(0)
            file.write(text.replace(term, term.replace("= ", "= 3 * ")))
        changed = dict(os.environ, RECTRAY_KERNELS=self.path("kernels"))
        self.run_program("render", scene, *size, "-o", "a.png", env=changed)
        self.run_program("render", scene, *size, "--no-skip", "whole_tile", "-o", "b.png", env=changed)
        pictures = [open(self.path(name), "rb").read() for name in ("before.png", "a.png", "b.png")]
        self.assertNotEqual(pictures[0], pictures[1])
        self.assertEqual(pictures[1], pictures[2])

    def test_only_the_one_that_runs_is_compiled_and_once(self):
        self.put("rays", "0 0 5 0 0 -1\n")
        for name, *words in (("render", "render", "scene.json", "--grid", "1", "-o", "a.png"),
                             ("render_adaptive", "render", "scene.json", "--sampling", "adaptive:4", "-o", "a.png"),
                             ("render", "render", "scene.json", "--kernel", "plain", "--grid", "1", "-o", "a.png"),
                             ("cast", "cast", "scene.json", "--rays", "rays")):
            cache = self.path("cache-of-" + name + words[2])
            self.run_program(*words, env=dict(os.environ, RECTRAY_CACHE_DIR="", POCL_CACHE_DIR=cache))
            compiled = [file for _, _, files in os.walk(cache) for file in files if file.endswith(".so")]
            if compiled: # else the driver is not PoCL
                self.assertEqual(compiled, [name + ".so"])

    def test_they_are_kept_where_that_is_possible_and_made_anew_elsewhere(self):
        self.put("file", "not a folder")
        homeless = {key: value for key, value in os.environ.items()
                    if key not in ("HOME", "XDG_CACHE_HOME", "RECTRAY_CACHE_DIR")}
        # the driver's own, already filled
        homeless.setdefault("POCL_CACHE_DIR", os.path.expanduser("~/.cache/pocl/kcache"))
        for environment in (homeless, dict(homeless, HOME=self.path("file")), dict(homeless, XDG_CACHE_HOME="/proc"),
                            dict(homeless, RECTRAY_CACHE_DIR="/proc"), # which nobody may write to
                            dict(homeless, RECTRAY_CACHE_DIR=self.path("file")),
                            dict(homeless, RECTRAY_CACHE_DIR="/proc/rectray")):
            _, err = self.run_program("render", "scene.json", "-o", "a.png", "--progress", "always", env=environment)
            self.assertIn("compiling the kernels", err)
            self.assertEqual(self.files(), ["a.png", "file"])


def platform():
    """That of the first device; "" where there is none."""
    told = subprocess.run([PROGRAM, "devices"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False).stdout
    name = re.search(r"(?m)^   platform +(.+)$", told.decode())
    return name[1] if name else ""


@unittest.skipUnless(os.path.exists("/proc/self/task") and os.cpu_count() > 1 and
                     os.sched_getaffinity(0) == set(range(os.cpu_count())), "needs Linux and more than one processor")
class Threads(CommandTest):
    def setUp(self):
        super().setUp()
        if platform() != "Portable Computing Language": # other drivers place their threads as they like
            print(f"SKIPPED: threads that stay on their processors: that is PoCL's, and the platform is {platform()}")
            self.skipTest("needs PoCL")

    def processors_of_threads(self, *words, **environment):
        """What the threads of a render, seen again and again until it ends, may run on for most of their lives. Two
        kinds do not count: threads that live for less than a tenth of its time, for those that build the tree are sent
        to their processors and let go; and the first thread, which the driver sends round to look at the processors."""
        seen, lives, looks = collections.Counter(), collections.Counter(), 0
        child = subprocess.Popen([PROGRAM, "render", "scene.json", "-q", "-o", "a.png", *words], cwd=self.folder,
                                 env={**os.environ, **environment})
        while child.poll() is None:
            looks += 1
            for thread in set(glob.glob(f"/proc/{child.pid}/task/*")) - {f"/proc/{child.pid}/task/{child.pid}"}:
                try:
                    with open(thread + "/status", encoding="ascii") as status:
                        seen[thread, re.search(r"Cpus_allowed_list:\t(\S+)", status.read())[1]] += 1
                        lives[thread] += 1
                except OSError:
                    pass # it has just ended
        self.assertEqual(child.returncode, 0)
        return {on for (thread, on), times in seen.items() if 10 * times >= looks and 2 * times >= lives[thread]}

    def test_each_stays_on_a_processor_where_all_are_used(self):
        self.run_program("render", "scene.json", "-o", "a.png") # the kernels are compiled now, if they were not
        each = {str(i) for i in range(os.cpu_count())}
        picture = ["-s", "3000x3000", "--grid", "4"] # takes longer than to begin, however busy the machine is
        self.assertLessEqual(each, self.processors_of_threads(*picture))
        for words, environment in ((["--threads", "1"], {}), ([], {"POCL_AFFINITY": "0"})):
            self.assertFalse(each & self.processors_of_threads(*picture, *words, **environment))


class Generate(CommandTest):
    def test_the_same_scene_goes_to_stdout_and_to_a_file(self):
        for kind, size, faces in (("menger", 1, 72), ("city", 3, 24), ("grid", 4, 16)):
            out, _ = self.run_program("generate", kind, "--size", str(size))
            self.run_program("generate", kind, "--size", str(size), "-o", "new.json")
            self.assertEqual(self.bytes_of("new.json"), out)
            self.assertRegex(self.run_program("check", "new.json")[0].decode(), rf"(?m)^  faces +{faces}$")
        self.assertIn("cannot write missing/a.json", self.run_program("generate", "grid", "--size", "2", "-o",
                                                                      "missing/a.json", status=3)[1])

    def test_a_seed_gives_the_same_city_each_time(self):
        first, again, other = (self.run_program("generate", "city", "--size", "3", "--seed", seed)[0] for seed in "112")
        self.assertEqual(first, again)
        self.assertNotEqual(first, other)

    def test_a_size_is_asked_for_and_judged_by_the_kind(self):
        self.assertIn("generate menger needs --size N: ", self.run_program("generate", "menger", status=2)[1])
        self.assertIn("--size '9': generate menger expects ",
                      self.run_program("generate", "menger", "--size", "9", status=2)[1])
        self.assertIn("no kind of scene 'mengor'; did you mean 'menger'?",
                      self.run_program("generate", "mengor", "--size", "1", status=2)[1])
        self.assertIn("no kind of scene 'sphere': menger, city and grid are known",
                      self.run_program("generate", "sphere", "--size", "1", status=2)[1])


class Check(CommandTest):
    def test_adaptive_rays_are_estimated_from_some_pixels(self):
        for size in ((30, 20), (320, 240)):
            scene = {**SCENE, "screen": {"columns": size[0], "rows": size[1]}, "sampling": {"adaptive": 8}}
            self.put("adaptive.json", json.dumps(scene))
            needs = json.loads(self.run_program("check", "adaptive.json", "--json")[0])["needs"]
            out, _ = self.run_program("render", "adaptive.json", "-b", "reference", "-o", "a.png", "--stats=json")
            rays = json.loads(out)["rays"]["primary"]
            self.assertEqual(needs["primary_rays_estimated_from"], min(size[0] * size[1], 4096))
            self.assertLess(abs(needs["primary_rays"] - rays), 0.05 * rays if size[0] > 30 else 1)
            self.assertGreater(rays, size[0] * size[1])
            self.assertIn(b"estimated from", self.run_program("check", "adaptive.json")[0])

    def test_lights_that_need_no_shadow_rays_are_told(self):
        dark = {"position": [1000, 0, 5], "diffuse": [0, 0, 0], "specular": [0, 0, 0]}
        lights = [{"position": [1000, 0, 5]}] + [{**dark, **more}
                                                 for more in ({}, {"ambient": [0, 0, 0]}, {"ambient": [0, 0, 0]})]
        black, mirror = "2 of the lights: black", {"reflection": 0.5}
        for rule, material, told in (("black", {}, [black + "\n"]),
                                     ("black", mirror, [black + ", though a path goes on from where they reach\n"]),
                                     ("ambient", mirror,
                                      [black + "\n", "shadow rays to 1 of the lights: their ambient"])):
            self.put("scene.json", json.dumps({**SCENE, "lights": lights, "shading": {"shadow": rule},
                                               "materials": {"pink": {"diffuse": [1, 1, 1], **material}}}))
            out = self.run_program("check", "scene.json")[0].decode()
            for words in told:
                self.assertIn("  " + words, out)


class Devices(CommandTest):
    def test_they_are_numbered(self):
        self.assertRegex(self.run_program("devices")[0].decode(), r"^0: ")

    def test_without_any_it_is_3_and_the_reference_still_works(self):
        nowhere = dict(os.environ, OCL_ICD_VENDORS=self.path("nowhere"))
        for words in (["devices"], ["render", "scene.json", "-o", "a.png"], ["cast", "scene.json"]):
            out, err = self.run_program(*words, text_in="0 0 0 1 1 1\n", status=3, env=nowhere)
            self.assertEqual(out.count(b"\n"), words[0] == "cast") # the table's head
            self.assertRegex(err, r"\Arectray: no OpenCL platform was found; install one [^\n]*\n\Z")
            self.assertEqual(self.files(), [])
        self.render(env=nowhere)

    def test_a_device_that_is_not_there_is_an_error(self):
        self.assertIn("99", self.run_program("render", "scene.json", "--device", "99", status=2)[1])


class KernelFiles(CommandTest):
    def test_exported_kernels_make_the_same_picture(self):
        out, _ = self.run_program("kernels", "--export", "mine")
        names = self.run_program("kernels")[0].decode().split()
        self.assertEqual(out, b"")
        found = {os.path.relpath(os.path.join(place, name), self.path("mine"))
                 for place, _, files in os.walk(self.path("mine")) for name in files}
        self.assertEqual(found, set(names))
        for name in names:
            with open(os.path.join("kernels", name), "rb") as file:
                self.assertEqual(self.bytes_of(f"mine/{name}"), file.read())
        self.run_program("render", "scene.json", "-k", "plain", "-o", "a.png")
        self.run_program("render", "scene.json", "-k", "plain", "-o", "b.png",
                         env={**os.environ, "RECTRAY_KERNELS": self.path("mine")})
        self.assertEqual(self.bytes_of("a.png"), self.bytes_of("b.png"))

    def test_no_folder_is_written_over(self):
        os.mkdir(self.path("mine"))
        self.assertIn("there already", self.run_program("kernels", "--export", "mine", status=2)[1])


class Documentation(unittest.TestCase):
    def test_the_page_and_the_help_name_the_same_options(self):
        with open("docs/commands.md", encoding="utf-8") as file:
            page = file.read()
        sections = dict(re.findall(r"^## rectray (\w+)\n(.*?)(?=^## |\Z)", page, re.M | re.S))
        out = subprocess.run([PROGRAM, "--help"], capture_output=True, text=True, check=True).stdout
        commands = re.findall(r"^  (\w+) ", out, re.M)
        self.assertEqual(list(sections), commands)
        for command in commands:
            shown = subprocess.run([PROGRAM, command, "--help"], capture_output=True, text=True, check=True).stdout
            options = re.findall(r"^  (?:-(\w), |    )--([\w-]+)(?:\[=| |$)", shown, re.M)
            rows = re.findall(r"^\| `(?:-(\w), )?--([\w-]+)", sections[command], re.M)
            common = [("h", "help"), ("V", "version")]
            self.assertEqual(rows, [option for option in options if option not in common], command)


if __name__ == "__main__":
    unittest.main(verbosity=2)
