"""Scenes through pipes: standard input, named pipes, models beside them, and pipes that never end."""
import json
import os
import resource
import subprocess
import threading
import unittest

from support.program import PROGRAM, SCENE, SOAK, CommandTest

with open(PROGRAM, "rb") as file:
    SANITIZED = b"__asan_init" in file.read()

SQUARE = "v 1000 0 0\nv 1001 0 0\nv 1001 1 0\nv 1000 1 0\nf 1 2 3 4\n"


def without_times(text):
    return [line for line in text.splitlines() if not line.endswith(b" ms")]


class Pipe(CommandTest):
    def test_a_scene_from_standard_input_is_the_scene(self):
        self.render("-o", "file.png")
        self.run_program("render", "-", "-b", "reference", "-o", "pipe.png", text_in=json.dumps(SCENE))
        self.assertEqual(self.bytes_of("pipe.png"), self.bytes_of("file.png"))
        for words in (["check", "-"], ["trace", "-", "--pixel", "4,3"], ["tree", "-"]):
            out, _ = self.run_program(*words, text_in=json.dumps(SCENE))
            expected, _ = self.run_program(words[0], "scene.json", *words[2:])
            self.assertEqual(without_times(out.replace(b"<stdin>", b"scene.json")), without_times(expected))

    def test_a_generated_scene_is_rendered_at_once(self):
        scene = self.run_program("generate", "menger", "--size", "2")[0].decode()
        self.run_program("render", "-", "-b", "reference", "--size", "8x6", "-o", "a.png", text_in=scene)
        self.assertEqual(self.files(), ["a.png"])

    def test_a_named_pipe_waits_for_its_writer(self):
        os.mkfifo(self.path("pipe"))
        def write():
            self.put("pipe", json.dumps(SCENE))
        writer = threading.Timer(0.2, write)
        writer.start()
        out, _ = self.run_program("check", "pipe")
        writer.join()
        self.assertEqual(out.replace(b"pipe:", b"scene.json:"), self.run_program("check", "scene.json")[0])

    def test_models_count_from_the_working_directory(self):
        os.mkdir(self.path("models"))
        self.put("models/square.obj", SQUARE)
        scene = {**SCENE, "objects": [{"material": "pink", "obj": "models/square.obj"}]}
        out, _ = self.run_program("check", "-", text_in=json.dumps(scene))
        self.assertRegex(out.decode(), r"faces +1\n")

    def test_mistakes_have_their_place(self):
        _, err = self.run_program("check", "-", status=1, text_in='{\n  "camera": 7 }')
        self.assertRegex(err, r"^<stdin>:\d+:\d+: ")
        self.assertRegex(self.run_program("check", "-", status=1, text_in="")[1], r"^<stdin>:1:1: ")

    def test_a_picture_needs_a_name(self):
        _, err = self.run_program("render", "-", status=2, text_in=json.dumps(SCENE))
        self.assertIn("give -o FILE", err)

    def test_what_reads_twice_wants_a_file(self):
        for words in (["bench", "-"], ["bench", "kernels", "-"], ["explore", "-"]):
            self.assertIn("more than once", self.run_program(*words, status=2)[1])
        self.assertIn("give --rays FILE", self.run_program("cast", "-", status=2)[1])

    def check_within(self, source, memory):
        """What check says of the scene on its standard input, with so many bytes of address space."""
        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
        return subprocess.run([PROGRAM, "check", "-"], stdin=source, capture_output=True, text=True, preexec_fn=limit,
                              check=False)

    @unittest.skipIf(SANITIZED, "a sanitizer's own address space is larger")
    def test_a_pipe_without_end_is_refused(self):
        """1 GiB is the limit; an address space of half of it makes the same point sooner."""
        source = subprocess.Popen(["yes", "[1,1],"], stdout=subprocess.PIPE)
        process = self.check_within(source.stdout, 2 ** 29)
        source.stdout.close()
        source.wait()
        self.assertEqual(process.returncode, 3)
        self.assertIn("out of memory (<stdin>)", process.stderr)

    @unittest.skipIf(SANITIZED, "as above")
    def test_a_large_file_is_refused_unread(self):
        self.put("large.json", "{}")
        os.truncate(self.path("large.json"), 2 ** 31)
        with open(self.path("large.json"), "rb") as source:
            process = self.check_within(source, 2 ** 28)
        self.assertEqual(process.returncode, 1)
        self.assertEqual(process.stderr, "<stdin>: is too large: more than 1073741824 bytes\n")

    @unittest.skipUnless(SOAK and not SANITIZED, "some ten seconds and 1 GiB of memory, in make soak")
    def test_two_gibibytes_through_a_pipe_are_refused_at_one(self):
        source = subprocess.Popen("yes '[1,1],' | head -c 2147483648", shell=True, stdout=subprocess.PIPE)
        process = self.check_within(source.stdout, 2 ** 30 + 2 ** 28)
        source.stdout.close()
        source.wait()
        self.assertEqual(process.returncode, 1)
        self.assertEqual(process.stderr, "<stdin>: is too large: more than 1073741824 bytes\n")


if __name__ == "__main__":
    unittest.main(verbosity=2)
