"""Scenes that move: each frame is an ordinary scene, and a run of frames is those frames, also where it was stopped."""
import json
import math
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

from support.program import SCENE, CommandTest, png_pixels

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))

KEYS = [{"frame": 0, "position": [1000.5, 0.5, 1]}, {"frame": 4, "position": [1000.5, 0.7, 2]},
        {"frame": 6, "position": [1000.9, 0.5, 1.5]}]
MOVING = {**SCENE, "animation": {
    "frames": 8, "camera": KEYS,
    "lights": {"0": [{"frame": 0, "position": [1000, 0, 5]}, {"frame": 7, "position": [1001, 1, 5]}]},
    "objects": {"tile": [{"frame": 0, "transform": []}]}}}


def turned(angle):
    return [{"translate": [-1000.5, -0.5, 0]}, {"rotate": {"axis": [0, 1, 0], "degrees": angle}},
            {"translate": [1000.5, 0.5, 0]}]


class Films(CommandTest):
    def setUp(self):
        super().setUp()
        self.put("moving.json", json.dumps(MOVING, indent=1))

    def frame(self, scene, number, *words):
        """What `rectray frame` prints of a scene."""
        self.put("own.json", scene if isinstance(scene, str) else json.dumps(scene))
        return json.loads(self.run_program("frame", "own.json", str(number), *words)[0])

    @staticmethod
    def timeless(text):
        return re.sub(rb"(?m)^.* ms$", b"times", text)

    def moving(self, **animation):
        return {**SCENE, "animation": {"frames": 10, **animation}}

    def render_frames(self, *words, **options):
        return self.run_program("render", "moving.json", "--backend", "reference", "--frames", *words, **options)


class Frame(Films):
    def test_it_is_the_scene_without_its_animation(self):
        expected = {**SCENE, "camera": {**SCENE["camera"], "position": [1000.5, 0.6, 1.5]}}
        keys = [{"//": "a comment", "frame": 2, "position": [1000.5, 0.5, 1]},
                {"frame": 4, "position": [1000.5, 0.7, 2]}]
        self.assertEqual(self.frame(self.moving(camera=keys), 3), expected)
        self.assertEqual(self.frame(self.moving(), 3), SCENE)

    def test_the_text_stays_but_for_what_moves(self):
        text = '{\n  "animation": %s,\n  "//": "é",\n%s' % (
            json.dumps({"frames": 2, "camera": KEYS}), json.dumps(SCENE, indent=2)[1:])
        self.put("own.json", text)
        out, _ = self.run_program("frame", "own.json", "0")
        self.assertEqual(out.decode().split("\n")[1], '  "//": "é",')
        self.assertEqual(len(out.decode().split("\n")), len(text.split("\n")) - 1 - 4) # the position is on one line

    def test_a_key_may_be_written_with_escapes(self):
        text = json.dumps(self.moving(camera=KEYS)).replace('"animation"', '"anim\\u0061tion"')
        text = text.replace('"camera"', '"c\\u0061mera"')
        self.assertEqual(self.frame(text, 2), self.frame(self.moving(camera=KEYS), 2))

    def test_smooth_keys_follow_a_parabola(self):
        place = lambda t: [1000.5, 0.5 + t * t / 100, 1 + t - t * t / 25]
        keys = [{"frame": t, "interpolation": "smooth", "position": place(t)} for t in (0, 2, 9)]
        for t in range(10):
            camera = self.frame(self.moving(camera=keys), t)["camera"]
            for got, wanted in zip(camera["position"], place(t)):
                self.assertAlmostEqual(got, wanted, 12)
        keys = [{"frame": t, "position": place(t)} for t in (0, 2, 9)]
        smooth = self.frame(self.moving(camera=keys, interpolation="smooth"), 5)
        self.assertAlmostEqual(smooth["camera"]["position"][1], place(5)[1], 12)
        linear = self.frame(self.moving(camera=keys), 5)
        self.assertAlmostEqual(linear["camera"]["position"][1], (4 * place(2)[1] + 3 * place(9)[1]) / 7, 12)

    def test_a_rotation_moves_by_its_angle(self):
        keys = [{"frame": 0, "transform": turned(0)}, {"frame": 10, "transform": turned(720)}]
        scene = self.frame(self.moving(objects={"tile": keys}), 4)
        self.assertEqual(scene["objects"][0]["transform"], turned(288))
        self.assertEqual(scene["objects"][1], SCENE["objects"][1])

    def test_all_objects_of_a_name_move_and_unnamed_ones_by_their_number(self):
        scene = self.moving(objects={"twin": [{"frame": 0, "transform": turned(9)}],
                                     "objects[2]": [{"frame": 0, "transform": [{"scale": 2}]}]})
        scene["objects"] = [{**SCENE["objects"][0], "name": "twin"}, {**SCENE["objects"][1], "name": "twin"},
                            {"material": "pink", "box": {"min": [0, 0, 0], "max": [1, 1, 1]}, "transform": []}]
        moved = [each["transform"] for each in self.frame(scene, 0)["objects"]]
        self.assertEqual(moved, [turned(9), turned(9), [{"scale": 2}]])

    def test_a_light_moves_and_its_colours_stay_at_0_or_above(self):
        keys = [{"frame": t, "interpolation": "smooth", "position": [t, 0, 0], "diffuse": [c, 1, 0.2]}
                for t, c in ((0, 1), (4, 0), (8, 0), (9, 1))]
        light = self.frame(self.moving(lights={"0": keys}), 6)["lights"][0]
        self.assertAlmostEqual(light["position"][0], 6)
        self.assertEqual(light["diffuse"], [0, 1, 0.2])

    def test_an_orbit_turns_the_whole_camera(self):
        orbit = {"orbit": {"centre": [1000.5, 0, 0], "degrees": 360}}
        scene = self.moving(camera=orbit)
        scene["camera"] = {"position": [1000.5, 0.5, 1], "look_at": [1000.5, 0.25, 0.5]}
        self.assertEqual(self.frame(scene, 0)["camera"], scene["camera"])
        camera = self.frame(scene, 2)["camera"]
        sine, cosine = math.sin(0.4 * math.pi), math.cos(0.4 * math.pi)
        for got, wanted in zip(camera["position"] + camera["look_at"],
                               [1000.5 + sine, 0.5, cosine, 1000.5 + sine / 2, 0.25, cosine / 2]):
            self.assertAlmostEqual(got, wanted, 9)
        self.assertNotIn("up", camera)
        orbit["orbit"] |= {"axis": [0, 0, 1], "degrees": 900}
        camera = self.frame({**scene, "animation": {"frames": 10, "camera": orbit}}, 1)["camera"]
        self.assertEqual((camera["position"], camera["up"]), ([1000, 0, 1], [-1, 0, 0]))

    def test_a_number_reads_back_as_it_is(self):
        keys = [{"frame": 0, "position": [0.1, 1 / 3, 1e-300]}, {"frame": 3, "position": [0.2, 2 / 3, 3e-300]}]
        position = self.frame(self.moving(camera=keys), 1)["camera"]["position"]
        self.assertEqual(position, [(1 - 1 / 3) * a + 1 / 3 * b
                                    for a, b in zip(keys[0]["position"], keys[1]["position"])])

    def test_edits_of_the_animation_come_first_and_others_last(self):
        scene = self.moving(camera={"orbit": {"centre": [1000.5, 0, 0], "degrees": 360}})
        half = self.frame(scene, 2, "--set", "animation.frames=4")["camera"]["position"]
        self.assertEqual([round(x, 9) for x in half], [1000.5, 0.5, -1])
        self.assertEqual(self.frame(scene, 2, "--camera", "1,2,3")["camera"]["position"], [1, 2, 3])

    def test_a_file_and_a_pipe(self):
        self.run_program("frame", "moving.json", "3", "-o", "three.json")
        out, _ = self.run_program("frame", "-", "3", text_in=json.dumps(MOVING, indent=1))
        self.assertEqual(out, self.bytes_of("three.json"))
        _, err = self.run_program("frame", "moving.json", "3", "-o", "moving.json", status=2)
        self.assertIn("would replace the scene", err)

    def test_beside_its_models(self):
        os.mkdir(self.path("models"))
        for name in ("turntable.json", "models/star.obj", "models/star.mtl"):
            shutil.copy(os.path.join(ROOT, "scenes", name), self.path(name))
        os.mkdir(self.path("other"))
        self.run_program("frame", "../turntable.json", "30", "-o", "../thirty.json", cwd=self.path("other"))
        told, _ = self.run_program("check", "thirty.json")
        expected, _ = self.run_program("check", "turntable.json", "--frame", "30")
        self.assertEqual(told, expected.replace(b"turntable", b"thirty"))

    def test_what_does_not_exist(self):
        for number, reason in (("8", "there is no frame 8: those of moving.json are 0 to 7"),
                               ("-1", ""), ("1.5", "frame '1.5': expected a whole number from 0 to 999999")):
            self.assertIn(reason, self.run_program("frame", "moving.json", number, status=2)[1])
        _, err = self.run_program("check", "scene.json", "--frame", "0", status=2)
        self.assertEqual(err, 'rectray: there is no frame 0: scene.json has no "animation"\n')
        self.run_program("render", "scene.json", "--frames", "0-1", status=2)

    def test_a_light_has_one_name(self):
        for name in ("00", "01", " 0", "+0", "-1", "1", "0x0", "sun", ""):
            self.put("own.json", json.dumps(self.moving(lights={name: [{"frame": 0, "position": [1, 2, 3]}]})))
            self.assertIn("there is no such light", self.run_program("check", "own.json", status=1)[1], name)

    def test_a_fault_of_one_frame_names_it(self):
        keys = [{"frame": 0, "position": [1000.5, 0.5, 1]}, {"frame": 2, "position": [1000.5, 0.5, -1]}]
        self.put("own.json", json.dumps(self.moving(camera=keys)))
        self.run_program("check", "own.json")
        _, err = self.run_program("check", "own.json", "--frame", "1", status=1)
        self.assertRegex(err, r"^own.json:1:\d+: camera.look_at: the camera looks at its own position(.|\n)*"
                              r"\nread as frame 1\n$")

    def test_every_reading_command_takes_it(self):
        out, _ = self.run_program("frame", "moving.json", "5")
        self.put("five.json", out.decode())
        for words in (["trace", "{}", "--pixel", "3,3", "-f", "json"], ["check", "{}"], ["tree", "{}"]):
            told, _ = self.run_program(*[word.format("moving.json") for word in words], "--frame", "5")
            expected, _ = self.run_program(*[word.format("five.json") for word in words])
            self.assertEqual(self.timeless(told.replace(b"moving", b"five")), self.timeless(expected))


class Frames(Films):
    def single(self, frame, *words):
        """The picture of the scene that `rectray frame` prints."""
        self.run_program("frame", "moving.json", str(frame), "-o", "frame.json")
        self.run_program("render", "frame.json", "-q", "-o", "single.png", *(words or ("-b", "reference")))
        return self.bytes_of("single.png")

    def test_each_is_the_picture_of_its_scene(self):
        self.render_frames("2-6", "-o", "f%02d.png")
        names = [f"f{k:02d}.png" for k in range(2, 7)]
        self.assertEqual([name for name in self.files() if name.endswith(".png")], names)
        pictures = [self.bytes_of(name) for name in names]
        self.assertEqual(pictures, [self.single(k) for k in range(2, 7)])
        self.assertEqual(len(set(pictures)), 5)
        self.run_program("render", "moving.json", "-b", "reference", "--frame", "4", "-o", "four.png")
        self.assertEqual(self.bytes_of("four.png"), pictures[2])

    def test_on_a_device_too_where_camera_lights_and_objects_move(self):
        parts = {"camera": {"camera": KEYS}, "lights": {"lights": MOVING["animation"]["lights"]},
                 "objects": {"objects": {"tile": [{"frame": 0, "transform": turned(0)},
                                                  {"frame": 4, "transform": turned(80)}]}}}
        parts["all"] = parts["camera"] | parts["lights"] | parts["objects"]
        for name, part in parts.items():
            self.put("moving.json", json.dumps({**SCENE, "animation": {"frames": 5, **part}}))
            for words in ([], ["--size", "40x30", "--sampling", "adaptive:4"]):
                self.run_program("render", "moving.json", "--frames", "all", "-o", "d%d.png", *words)
                for frame in (0, 1, 4):
                    self.assertEqual(self.bytes_of(f"d{frame}.png"), self.single(frame, *words, "-b", "opencl"),
                                     f"{name} {words} frame {frame}")

    def test_what_was_left_out_for_one_frame_is_not_for_the_next(self):
        """The camera flies through a box, a one-sided face turns its back, a light goes black."""
        colours = {name: [1, 1, 1] for name in ("ambient", "diffuse", "specular")}
        black = dict.fromkeys(colours, [0, 0, 0])
        scene = {
            "animation": {"frames": 9, "camera": [{"frame": 0, "position": [0.3, 0.4, 6], "look_at": [0.3, 0.4, 0]},
                                                  {"frame": 8, "position": [0.3, 0.4, -6], "look_at": [0, 0, -9]}],
                          "lights": {"0": [{"frame": 0, "position": [3, 4, 5], **colours},
                                           {"frame": 8, "position": [-3, -4, -5], **black}]}},
            "camera": {"position": [0, 0, 6], "look_at": [0, 0, 0]}, "screen": {"columns": 48, "rows": 36},
            "lights": [{"position": [3, 4, 5]}, {"position": [0, 4, 5]}], "materials": SCENE["materials"],
            "objects": [{"material": "pink", "box": {"min": [-2, -2, -2], "max": [2, 2, 2]}},
                        {"material": "pink", "box": {"min": [-1, -1, -5], "max": [0, 0, -4]}},
                        {"material": "pink", "sided": "front", "faces": [[0, 1, 2, 3]],
                         "vertices": [[-3, -3, -8], [3, -3, -8], [3, 3, -8], [-3, 3, -8]]}]}
        self.put("moving.json", json.dumps(scene))
        for words in ([], ["--sampling", "adaptive:4"], ["--accel", "bvh", "--depth", "16"], ["--kernel", "gpu"],
                      ["--kernel", "gpu", "--sampling", "adaptive:4"]):
            self.run_program("render", "moving.json", "--frames", "all", "-o", "w%d.png", *words)
            for frame in (0, 3, 5, 8):
                self.assertEqual(self.bytes_of(f"w{frame}.png"), self.single(frame, *words), f"{words} {frame}")

    def test_all_rays_are_counted(self):
        words = ["--frames", "all", "-o", "o%d.png", "--stats=json"]
        one = json.loads(self.run_program("render", "moving.json", "--frame", "0", "-o", "o.png", "--stats=json")[0])
        many = json.loads(self.run_program("render", "moving.json", *words)[0])
        self.assertEqual(many["rays"]["primary"], 8 * one["rays"]["primary"])

    def test_the_pattern(self):
        self.render_frames("6-7", "-o", "a%%b-%d.ppm")
        self.render_frames("7-7")
        self.assertTrue({"a%b-6.ppm", "a%b-7.ppm", "moving-0007.png"} < set(self.files()))
        for pattern, reason in (("f.png", "one file for all frames"), ("f%s.png", "%s is no number"),
                                ("f%d%d.png", "twice"), ("f%5d.png", "%5 is no number"), ("%", "% is no number"),
                                ("f%%.png", "one file"), ("f%ld.png", "%l is no number"), ("-", "one file"),
                                ("f%0d.png", "%0 is no number")):
            self.assertIn(reason, self.render_frames("0-1", "-o", pattern, status=2)[1])
        self.assertIn("expected two whole numbers", self.render_frames("3-1", status=2)[1])
        self.assertIn("there is no frame 8", self.render_frames("0-8", "-o", "x%d.png", status=2)[1])
        self.assertNotIn("x0.png", self.files())

    def test_options_of_one_picture(self):
        for words in (["--frame", "1"], ["--map", "rays", "r.png"], ["--mark", "1,1"], ["--watch"]):
            self.assertIn(f"{words[0]} does not go with --frames", self.render_frames("0-1", *words, status=2)[1])
        self.assertIn("--frames", self.run_program("render", "moving.json", "--resume", status=2)[1])


class Resume(Films):
    def test_frames_that_are_there_stay(self):
        self.render_frames("all", "-o", "f%d.png")
        before = [self.bytes_of(f"f{k}.png") for k in range(8)]
        os.remove(self.path("f2.png"))
        for name, size in (("f3.png", 60), ("f4.png", len(before[4]) - 1), ("f5.png", 0)):
            os.truncate(self.path(name), size)
        with open(self.path("f6.png"), "ab") as file:
            file.write(b"\0")
        _, err = self.render_frames("all", "-o", "f%d.png", "--resume")
        self.assertRegex(err, r"^f%d.png: 5 frames of 8 x 6 pixels in .* s; 3 were there\n$")
        self.assertEqual([self.bytes_of(f"f{k}.png") for k in range(8)], before)
        _, err = self.render_frames("all", "-o", "f%d.png", "--resume", "--size", "16x12")
        self.assertIn("; 0 were there", err)

    def test_a_frame_with_a_wrong_byte_is_made_again(self):
        self.render_frames("0-1", "-o", "f%d.png")
        kept = self.bytes_of("f1.png")
        for place in (20, len(kept) // 2, len(kept) - 20, len(kept) - 1):
            with open(self.path("f1.png"), "wb") as file:
                file.write(kept[:place] + bytes([kept[place] ^ 1]) + kept[place + 1:])
            self.assertIn("; 1 were there", self.render_frames("0-1", "-o", "f%d.png", "--resume")[1])
            self.assertEqual(self.bytes_of("f1.png"), kept)

    def test_a_frame_without_pixels_is_made_again(self):
        self.render_frames("0-1", "-o", "f%d.png")
        kept = self.bytes_of("f1.png")
        with open(self.path("f1.png"), "wb") as file:
            file.write(kept[:33] + kept[-12:])  # the first chunk and the last
        self.assertIn("; 1 were there", self.render_frames("0-1", "-o", "f%d.png", "--resume")[1])
        self.assertEqual(self.bytes_of("f1.png"), kept)

    def test_a_pipe_is_no_frame_to_wait_for(self):
        os.mkfifo(self.path("f0.png"))
        process = self.start("render", "moving.json", "-b", "reference", "--frames", "0-0", "-o", "f%d.png", "--resume")
        with subprocess.Popen(["cat", self.path("f0.png")], stdout=subprocess.PIPE) as reader:
            try:
                self.assertEqual(reader.communicate(timeout=60)[0][:4], b"\x89PNG")
            finally:
                process.kill()
                reader.kill()
                process.communicate()

    def test_in_every_format(self):
        for words in (["f%d.ppm"], ["f%d.pfm"], ["g%d.png", "--depth", "16"], ["g%d.ppm", "--depth", "16"]):
            self.render_frames("0-1", "-o", *words)
            kept = self.bytes_of(words[0] % 1)
            os.truncate(self.path(words[0] % 1), len(kept) - 1)
            self.assertIn("; 1 were there", self.render_frames("0-1", "-o", *words, "--resume")[1])
            self.assertEqual(self.bytes_of(words[0] % 1), kept)

    def test_a_run_killed_at_any_moment_gives_the_same_files(self):
        words = ["all", "-o", "f%d.png", "--size", "200x150", "--grid", "2"]
        self.render_frames(*words)
        expected = {name: self.bytes_of(name) for name in self.files()}
        for name in expected:
            if name.endswith(".png"):
                os.remove(self.path(name))
        rng, kills, patience = random.Random(7), 0, 0.0
        while True:
            process = self.start("render", "moving.json", "--backend", "reference", "--frames", *words, "--resume")
            time.sleep(patience * rng.random())
            patience += 0.02
            if process.poll() is not None:
                break
            process.send_signal(rng.choice([signal.SIGKILL, signal.SIGKILL, signal.SIGTERM]))
            kills += 1
            process.communicate()
        process.communicate()
        self.assertEqual(process.returncode, 0)
        self.assertGreater(kills, 2)
        self.assertEqual({name: self.bytes_of(name) for name in self.files()}, expected)

    def test_what_another_run_is_writing_stays(self):
        self.put(".rectray-1-0.part", "left behind")
        process = self.start("render", "moving.json", "-b", "reference", "-o", "large.png", "-s", "400x300", "-g", "6")
        own = f".rectray-{process.pid}-0.part"
        while own not in self.files() and process.poll() is None:
            time.sleep(0.01)
        self.render_frames("0-0", "-o", "f%d.png", "--resume")
        self.assertNotIn(".rectray-1-0.part", self.files())
        process.communicate()
        self.assertEqual(process.returncode, 0)
        self.assertIn("large.png", self.files())


# Stands in for ffmpeg: the film is a line of its arguments, and then the bytes of the pipe.
STAND_IN = """#!%s
import json, sys
with open(sys.argv[-1].removeprefix("file:"), "wb") as film:
    film.write(json.dumps(sys.argv[1:]).encode() + b"\\n" + sys.stdin.buffer.read())
""" % sys.executable


class Film(Films):
    def setUp(self):
        super().setUp()
        os.mkdir(self.path("bin"))

    def with_ffmpeg(self, text):
        """The environment in which that is ffmpeg."""
        self.put("bin/ffmpeg", text)
        os.chmod(self.path("bin/ffmpeg"), 0o755)
        return {**os.environ, "PATH": self.path("bin")}

    def film(self, *words, **options):
        return self.run_program("render", "moving.json", "-b", "reference", *words, **options)

    def files_of_film(self):
        return [name for name in self.files() if name.startswith(".") or name.startswith("film")]

    def test_raw_frames_go_through_the_pipe(self):
        environment = self.with_ffmpeg(STAND_IN)
        self.render_frames("1-4", "-o", "f%d.png", "--size", "16x12")
        pixels = b"".join(bytes(pixel) for k in range(1, 5) for row in png_pixels(self.bytes_of(f"f{k}.png"))
                          for pixel in row)
        for ending in ("mp4", "webm", "gif", "MP4"):
            _, err = self.film("--frames", "1-4", "-o", f"film.{ending}", "--size", "16x12", env=environment)
            self.assertRegex(err, rf"^film.{ending}: 4 frames of 16 x 12 pixels in .* s\n$")
            arguments, data = self.bytes_of(f"film.{ending}").split(b"\n", 1)
            self.assertTrue(data == pixels, ending)
            words = " ".join(json.loads(arguments))
            self.assertIn("-f rawvideo -pixel_format rgb24 -video_size 16x12 -framerate 30 -i pipe:0 ", words)
            self.assertIn(f" -f {ending.lower()} file:/dev/fd/3", words)
        self.assertEqual([name for name in self.files() if name.startswith(".")], [])

    def test_all_frames_at_the_scene_s_pace(self):
        self.film("-o", "film.gif", "--set", "animation.fps=29.97", env=self.with_ffmpeg(STAND_IN))
        arguments, data = self.bytes_of("film.gif").split(b"\n", 1)
        self.assertEqual(len(data), 8 * 8 * 6 * 3)
        self.assertIn('"-framerate", "29.97"', arguments.decode())

    def test_without_ffmpeg(self):
        _, err = self.film("-o", "film.mp4", env={**os.environ, "PATH": self.path("bin")}, status=3)
        self.assertRegex(err, "^rectray: ffmpeg is not installed, which makes the film film.mp4; install it, or render")
        self.assertEqual(self.files_of_film(), [])

    def test_a_failure_of_ffmpeg_is_told_and_the_film_stays_as_it_was(self):
        self.put("film.mp4", "before")
        shell = "#!/bin/sh\necho 'no such encoder' >&2\necho half >&3\n" # 3: the film
        for rest in ("exit 3", "read -r line\nexit 4", "while read -r line; do :; done\nexit 5"):
            _, err = self.film("-o", "film.mp4", "--size", "400x300", env=self.with_ffmpeg(shell + rest), status=3)
            self.assertEqual(err, "rectray: ffmpeg could not make the film film.mp4: no such encoder\n")
            self.assertEqual(self.files_of_film(), ["film.mp4"])
            self.assertEqual(self.bytes_of("film.mp4"), b"before")

    def test_an_ffmpeg_that_writes_nothing_has_failed_whatever_it_says(self):
        self.put("film.mp4", "before")
        _, err = self.film("-o", "film.mp4", env=self.with_ffmpeg("#!/bin/sh\nwhile read -r line; do :; done\n"),
                           status=3)
        self.assertIn("could not make the film film.mp4: it made no film, and does not say why", err)
        self.assertEqual(self.bytes_of("film.mp4"), b"before")

    def test_a_fault_of_a_frame_ends_the_film(self):
        moving = self.moving(camera=[{"frame": 0, "position": [1000.5, 0.5, 1]},
                                     {"frame": 2, "position": [1000.5, 0.5, -1]}])
        self.put("moving.json", json.dumps(moving))
        _, err = self.film("-o", "film.mp4", env=self.with_ffmpeg(STAND_IN), status=1)
        self.assertIn("\nread as frame 1\n", err)
        self.assertEqual(self.files_of_film(), [])

    def test_a_film_that_is_stopped_is_not_there(self):
        words = ["render", "moving.json", "-b", "reference", "-o", "film.mp4", "--size", "900x600", "-g", "4"]
        process = self.start(*words, env=self.with_ffmpeg(STAND_IN))
        while not self.files_of_film() and process.poll() is None:
            time.sleep(0.01)
        process.terminate()
        process.communicate()
        self.assertEqual(process.returncode, 128 + signal.SIGTERM)
        time.sleep(0.3) # the stand-in comes to its end
        self.assertEqual(self.files_of_film(), [])

    def test_options_that_a_film_has_not(self):
        for words in (["--resume"], ["--depth", "16"], ["--format", "ppm"]):
            self.assertIn(words[0], self.film("-o", "film.mp4", *words, status=2)[1])
        _, err = self.run_program("render", "scene.json", "-o", "film.mp4", status=2)
        self.assertEqual(err, 'rectray: there are no frames: scene.json has no "animation"\n')

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_ffmpeg_makes_films_of_the_frames(self):
        for ending in ("mp4", "gif"):
            self.film("-o", f"film.{ending}", "--size", "30x20")
            decode = f"ffmpeg -loglevel error -i film.{ending} -f rawvideo -pix_fmt rgb24 -"
            raw = subprocess.run(decode.split(), cwd=self.folder, check=True, stdin=subprocess.DEVNULL,
                                 stdout=subprocess.PIPE)
            self.assertEqual(len(raw.stdout), 8 * 30 * 20 * 3, ending)


if __name__ == "__main__":
    unittest.main(verbosity=2)
