#!/usr/bin/env python3
"""render --part K/N and join: the whole is the undivided picture's file, and what does not fit is refused by name."""
import json
import os
import subprocess
import unittest
import zlib

from support.pictures import ppm_values
from support.program import PROGRAM, CommandTest, png_pixels

with open(PROGRAM, "rb") as program:
    SANITIZED = b"__asan_init" in program.read()


def chunks_of(png):
    """The names and contents of a PNG's chunks."""
    at = 8
    while at < len(png):
        length = int.from_bytes(png[at:at + 4], "big")
        yield png[at + 4:at + 8], png[at + 8:at + 8 + length]
        at += length + 12


def note_of(png):
    texts = [content for name, content in chunks_of(png) if name == b"tEXt"]
    assert len(texts) == 1
    keyword, text = texts[0].split(b"\0")
    assert keyword == b"rectray part"
    return text.decode()


def with_note(png, text):
    """The PNG with another text in its chunk."""
    made = png[:8]
    for name, content in chunks_of(png):
        if name == b"tEXt":
            content = b"rectray part\0" + text.encode()
        body = name + content
        made += len(content).to_bytes(4, "big") + body + zlib.crc32(body).to_bytes(4, "big")
    return made


class PartTest(CommandTest):
    def put_bytes(self, name, data):
        with open(self.path(name), "wb") as file:
            file.write(data)

    def parts(self, count, *words, prefix=""):
        names = []
        for k in range(1, count + 1):
            names.append(f"{prefix}{k}.png")
            self.render("--part", f"{k}/{count}", "-o", names[-1], "-q", *words)
        return names

    def join(self, *names, status=0):
        return self.run_program("join", *names, status=status)

    def refused(self, *names):
        """The message of a join that fails; nothing is written."""
        before = self.files()
        _, err = self.join(*names, "-o", "whole.png", status=1)
        self.assertEqual(self.files(), before)
        return err.rstrip("\n")


class Joining(PartTest):
    def test_the_whole_is_the_undivided_picture_s_file(self):
        for words in ([], ["--depth", "16"], ["-s", "20x100"], ["-s", "13x77", "--sampling", "adaptive:2"]):
            self.render("-o", "undivided.png", *words)
            for count in (1, 2, 3, 6):
                _, err = self.join(*reversed(self.parts(count, *words)), "-o", "joined.png")
                self.assertEqual(self.bytes_of("joined.png"), self.bytes_of("undivided.png"), (words, count))
            self.assertRegex(err, r"^joined.png: \d+ x \d+ pixels of 6 parts\n$")

    def test_the_kernel_s_parts_make_the_kernel_s_picture(self):
        words = ("scene.json", "-s", "60x150", "-q")
        self.run_program("render", *words, "-o", "undivided.png")
        names = []
        for k in range(1, 5):
            names.append(f"{k}.png")
            self.run_program("render", *words, "--part", f"{k}/4", "-o", names[-1])
        self.join(*names, "-o", "joined.png", "-q")
        self.assertEqual(self.bytes_of("joined.png"), self.bytes_of("undivided.png"))

    def test_parts_of_parts_fit_too(self):
        halves, quarters = self.parts(2, "-s", "8x256"), self.parts(4, "-s", "8x256", prefix="q")
        self.render("-s", "8x256", "-o", "undivided.png")
        self.join(halves[0], quarters[2], quarters[3], "-o", "joined.png")
        self.assertEqual(self.bytes_of("joined.png"), self.bytes_of("undivided.png"))

    def test_other_formats_and_standard_output(self):
        names = self.parts(3, "--depth", "16")
        self.render("-o", "undivided.ppm", "--depth", "16")
        self.join(*names, "-o", "joined.ppm")
        self.assertEqual(ppm_values(self.bytes_of("joined.ppm")), ppm_values(self.bytes_of("undivided.ppm")))
        out, err = self.join(*names, "-o", "-")
        self.render("-o", "undivided.png", "--depth", "16")
        self.assertEqual((out, err), (self.bytes_of("undivided.png"), ""))
        _, err = self.join(*names, "-o", "joined.pfm", status=2)
        self.assertEqual(err, "rectray: joined.pfm: parts have 8 or 16 bits a channel; choose .png or .ppm\n")

    def test_how_the_work_is_done_does_not_matter(self):
        self.render("-o", "undivided.png")
        self.render("--part", "1/2", "-o", "a.png", "-t", "1", "-a", "bvh")
        self.render("--part", "2/2", "-o", "b.png", "-t", "2", "-a", "none")
        self.join("a.png", "b.png", "-o", "joined.png")
        self.assertEqual(self.bytes_of("joined.png"), self.bytes_of("undivided.png"))

    @unittest.skipIf(SANITIZED, "a sanitizer takes memory of its own")
    def test_no_picture_is_ever_in_memory(self):
        for k in (1, 2):
            self.run_program("render", "scene.json", "-s", "6000x2000", "--part", f"{k}/2", "-o", f"{k}.png", "-q")
        process = self.start("join", "1.png", "2.png", "-o", "joined.png", "-q")
        _, status, usage = os.wait4(process.pid, 0)
        process.communicate()
        self.assertEqual(status, 0)
        self.assertLess(usage.ru_maxrss, 32000)  # KiB, Python's own at its start among them; the picture is 36 MB more


class Parts(PartTest):
    def test_a_part_tells_its_place(self):
        self.render("--part", "2/3", "-s", "8x100", "-o", "a.png")
        self.assertRegex(note_of(self.bytes_of("a.png")), r"^part 2/3, from row 32 of 100, hash [0-9a-f]{16}$")

    def test_an_undivided_picture_has_no_such_chunk(self):
        self.render("-o", "a.png")
        self.assertEqual({name for name, _ in chunks_of(self.bytes_of("a.png"))}, {b"IHDR", b"IDAT", b"IEND"})

    def test_parts_are_blocks_where_there_are_enough(self):
        sizes = [len(png_pixels(self.bytes_of(name))) for name in self.parts(3, "-s", "8x200")]
        self.assertEqual(sizes, [64, 64, 72])
        sizes = [len(png_pixels(self.bytes_of(name))) for name in self.parts(4, "-s", "8x10")]
        self.assertEqual(sizes, [2, 3, 2, 3])

    def test_a_part_has_a_name_of_its_own(self):
        self.render("--part", "2/3")
        self.assertEqual(self.files(), ["scene.2-of-3.png"])

    def test_the_hash_is_that_of_scene_and_settings(self):
        def hash_of(*words):
            self.render("--part", "1/2", "-o", "a.png", "-q", *words)
            return note_of(self.bytes_of("a.png")).split()[-1]

        same = {hash_of(), hash_of("-t", "1"), hash_of("-a", "bvh"), hash_of("--set", "camera.up=[0, 1, 0]")}
        self.assertEqual(len(same), 1)
        others = [hash_of("--set", change) for change in (
            "camera.position[0]=1000.25", "screen.width=1.5", "lights[0].position[2]=6", "lights[0].diffuse=[0, 1, 1]",
            "materials.pink.reflection=0.5", "materials.pink.shininess=3", "shading.viewer=ray",
            "shading.background=[1, 0, 0]", "objects[0].vertices[0][1]=0.5", "objects[1].sided=both",
            'materials={"pink": {}, "unused \\"one\\"": {}}')]
        others += [hash_of("-s", "8x7"), hash_of("-g", "2"), hash_of("--sampling", "adaptive:2"),
                   hash_of("--bounces", "2"), hash_of("--arithmetic", "textbook"),
                   hash_of("--arithmetic", "textbook", "--shift", "1e-4"),
                   hash_of("--arithmetic", "textbook", "-p", "float")]
        self.assertEqual(len({*others, *same}), len(others) + 1)

    def test_the_hash_is_that_of_the_kernels(self):
        def hash_of(*words):
            self.run_program("render", "scene.json", "--part", "1/2", "-o", "a.png", "-q", *words, env=environ)
            return note_of(self.bytes_of("a.png")).split()[-1]

        environ = os.environ
        for kernel, file in (("plain", "plain.cl"), ("packet", "packet/light.cl"), ("auto", "tile/render.cl")):
            own = hash_of("--kernel", kernel)
            self.run_program("kernels", "--export", kernel)
            environ = dict(os.environ, RECTRAY_KERNELS=self.path(kernel))
            self.assertEqual(hash_of("--kernel", kernel), own)
            with open(self.path(os.path.join(kernel, file)), "a", encoding="utf-8") as text:
                text.write("/* mine */\n")
            self.assertNotEqual(hash_of("--kernel", kernel), own)
            environ = os.environ

    def test_what_makes_no_sense_is_refused(self):
        for words, message in (
            (["--region", "0,0,1x1"], "--region does not go with --part: a part is a band of the whole picture"),
            (["--mark", "0,0"], "--mark does not go with --part: join the parts first"),
            (["--map", "face", "f.png"], "--map does not go with --part: draw the map in a run without --part"),
            (["-o", "a.ppm"], "a part is a PNG, which tells its place; `rectray join` writes other formats"),
            (["-s", "9x1"], "--part 1/2: more parts than rows, of which there are 1"),
        ):
            _, err = self.render("--part", "1/2", *words, status=2)
            self.assertEqual(err, f"rectray: {message}\n")
        for wrong in ("0/2", "3/2", "1", "1/", "/2", "1/2/3", "-1/2", "1/16385"):
            _, err = self.render("--part", wrong, status=2)
            self.assertEqual(err, f"rectray: --part '{wrong}': expected a part and how many there are, such as 3/8\n")
        self.assertEqual(self.files(), [])


class Refusals(PartTest):
    def test_missing_parts(self):
        names = self.parts(3, "-s", "8x96")
        for left_out, rows in ((1, "0 to 31"), (2, "32 to 63"), (3, "64 to 95")):
            given = [name for name in names if name != f"{left_out}.png"]
            self.assertEqual(self.refused(*given),
                             f"{given[0]}: part {left_out}/3 of its picture is missing (rows {rows} are); render it "
                             f"with --part {left_out}/3, or name its file")

    def test_doubled_and_overlapping_parts(self):
        names = self.parts(2)
        self.render("--part", "2/3", "-o", "other.png")
        self.assertEqual(self.refused(*names, names[1]), "2.png: is part 2/2, as 2.png is; leave one of them out")
        self.assertEqual(self.refused(*names, "other.png"),
                         "other.png: is part 2/3, and has rows that 1.png, part 1/2, has, too; leave one of them out")

    def test_parts_of_other_pictures(self):
        names = self.parts(2)
        cure = "render both from the same scene, with the same options and the same version of rectray"
        for words in (["--set", "camera.position[0]=1000.25"], ["-g", "2"], ["-s", "9x6"], ["-s", "8x7"]):
            self.render("--part", "2/2", "-o", "b.png", *words)
            self.assertEqual(self.refused(names[0], "b.png"), f"b.png: a part of another picture than 1.png; {cure}")
        self.render("--part", "2/2", "-o", "b.png", "--depth", "16")
        self.assertEqual(self.refused(names[0], "b.png"),
                         "b.png: has 16 bits a channel, and 1.png has 8; render both with the same --depth")

    def test_files_that_are_no_parts(self):
        names = self.parts(2)
        self.render("-o", "undivided.png")
        self.put("text.png", "no picture")
        whole = self.bytes_of(names[1])
        self.put_bytes("short.png", whole[:-20])
        note = note_of(whole)
        self.assertEqual(self.refused(names[0], "undivided.png"),
                         "undivided.png: a picture that is no part of one: only `render --part K/N` makes parts")
        self.assertIn("text.png: damaged PNG: ", self.refused(names[0], "text.png"))
        self.assertIn("; render this part again", self.refused(names[0], "text.png"))
        self.assertIn("short.png: damaged PNG: ", self.refused(names[0], "short.png"))
        self.assertIn("nix.png: cannot be read: No such file", self.refused(names[0], "nix.png"))
        for wrong in (note.replace("2/2", "3/2"), note.replace("row 3", "row 4"), note.replace("of 6", "of 99999"),
                      note.replace("row 3", "row -3"), note + " ", note[:-1], "", "part 1/1", note * 99):
            self.put_bytes("wrong.png", with_note(whole, wrong))
            self.assertEqual(self.refused(names[0], "wrong.png"),
                             "wrong.png: what it tells of its place is not what `render --part K/N` writes; render "
                             "this part again", wrong)

    def test_the_output_is_asked_for_and_spares_the_parts(self):
        names = self.parts(2)
        _, err = self.join(*names, status=2)
        self.assertEqual(err, "rectray: join needs the name of the whole picture; give -o FILE\n")
        _, err = self.join(*names, "-o", "2.png", status=2)
        self.assertEqual(err, "rectray: the picture 2.png would replace one of its parts; choose another -o\n")


class Frames(PartTest):
    def test_with_frames_a_part_is_a_range_of_them(self):
        scene = json.loads(self.bytes_of("scene.json"))
        scene["animation"] = {"frames": 7, "fps": 5, "camera": [
            {"frame": 0, "position": [1000.5, 0.5, 1], "look_at": [1000.5, 0.5, 0]},
            {"frame": 6, "position": [1000.5, 0.5, 2], "look_at": [1000.5, 0.5, 0]}]}
        self.put("scene.json", json.dumps(scene))
        self.render("--frames", "all", "-o", "whole-%d.png", "-q")
        for k in (1, 2, 3):
            before = len(self.files())
            self.render("--frames", "all", "--part", f"{k}/3", "-o", "part-%d.png", "-q")
            self.assertEqual(len(self.files()), before + (2, 2, 3)[k - 1])
        for frame in range(7):
            self.assertEqual(self.bytes_of(f"part-{frame}.png"), self.bytes_of(f"whole-{frame}.png"))
        _, err = self.render("--frames", "2-4", "--part", "1/4", "-o", "x-%d.png", status=2)
        self.assertEqual(err, "rectray: --part 1/4: more parts than frames, of which there are 3\n")

    def test_a_region_of_frames_is_checked(self):
        scene = json.loads(self.bytes_of("scene.json"))
        scene["animation"] = {"frames": 2, "fps": 5, "camera": [{"frame": 0, "position": [1000.5, 0.5, 1]}]}
        self.put("scene.json", json.dumps(scene))
        _, err = self.render("--frames", "all", "--region", "0,0,9x1", "-o", "x-%d.png", status=2)
        self.assertIn("--region reaches beyond the picture", err)
        self.render("--frames", "all", "--region", "0,0,3x1", "-o", "x-%d.png")
        _, err = self.render("--frames", "all", "--region", "0,0,3x1", "-o", "x-%d.png", "--resume")
        self.assertIn("0 frames of 3 x 1 pixels", err)


SCRIPTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "docs", "cluster")

# Stands for GNU parallel: the last argument is the command, and {} in it a line of the input. There are no options.
PARALLEL = """#!/bin/bash
for last; do :; done
while read -r line; do sh -c "${last//'{}'/$line}" || exit; done
"""


class Scripts(PartTest):
    """What the scripts for clusters do beside the nodes that die in test-cluster."""

    def setUp(self):
        super().setUp()
        scene = json.loads(self.bytes_of("scene.json"))
        scene["animation"] = {"frames": 5, "camera": [{"frame": 0, "position": [1000.5, 0.5, 1]}]}
        self.put("scene.json", json.dumps(scene))
        self.put("parallel", PARALLEL)
        os.chmod(self.path("parallel"), 0o755)

    def run_script(self, *words):
        environ = dict(os.environ, RECTRAY=PROGRAM, PATH=f"{self.path('.')}:{os.environ['PATH']}")
        done = subprocess.run(words, cwd=self.path("."), env=environ, stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_parallel_takes_options_or_none(self):
        script = os.path.join(SCRIPTS, "parallel.sh")
        for name, words in (("plain", []), ("other", ["--set", "shading.background=[0, 0, 1]"])):
            self.run_script(script, "hosts.txt", "2", "frames", "scene.json", f"{name}/%d.png", *words)
            self.assertEqual(sorted(os.listdir(self.path(name))), [f"{k}.png" for k in range(5)])
            self.run_script(script, "hosts.txt", "2", "parts", "scene.json", f"{name} parts", *words)
            self.render("-o", "whole.png", *words)
            self.assertEqual(self.bytes_of(f"{name} parts.png"), self.bytes_of("whole.png"))

    def test_make_makes_lost_frames_again(self):
        words = ["make", "-f", os.path.join(SCRIPTS, "Makefile"), "film", "SCENE=scene.json", "N=2", "OUT=made",
                 f"RECTRAY={PROGRAM}"]
        self.run_script(*words)
        kept = {name: self.bytes_of(f"made/{name}") for name in os.listdir(self.path("made"))}
        self.assertEqual(len(kept), 5)
        os.remove(self.path("made/0001.png"))
        os.truncate(self.path("made/0003.png"), 0)
        self.run_script(*words)
        self.assertEqual({name: self.bytes_of(f"made/{name}") for name in os.listdir(self.path("made"))}, kept)


if __name__ == "__main__":
    unittest.main()
