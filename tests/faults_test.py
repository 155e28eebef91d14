#!/usr/bin/env python3
"""Memory that runs out at the N-th allocation, and OpenCL calls that fail at the N-th, for every N: the program does
its work all the same, or says in one message what failed, leaves no file, frees everything and exits with 3.
tests/faults/ has the two libraries that fail on command; `make soak` tries real scenes too."""
import glob
import os
import re
import tempfile
import unittest

from support.program import PROGRAM, SOAK, CommandTest

FAULTS = os.path.join(os.path.dirname(PROGRAM), "faults")

# AddressSanitizer wants to be loaded first, but works as well behind a library that passes everything on. It finds
# leaks itself; what passes between it and its own copies of strdup and the like cannot be counted.
with open(PROGRAM, "rb") as program:
    SANITIZED = b"__asan_init" in program.read()

MODEL = ("mtllib Model.mtl none.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0 1 1 1\no square\nusemtl late\nf 1 2 3 4\nv 0 1 0\n"
         "o half\nusemtl red\nf 1 2 3\nusemtl pink\nf 1 2 3\nl 1 2\nmtllib model.mtl\n")
LIBRARY = "newmtl red\nKd 1 0 0\nKs 1 1 1\nillum 3\nmap_Kd x.png\nd 0.5\nnewmtl red\nnewmtl late\nKa 1 1 1\n"


class FaultTest(CommandTest):
    """Runs a command again and again under a library that lets its N-th call fail."""

    def faulty(self, library, words, text_in=None, **settings):
        """Runs under the library; returns exit status, stdout, stderr and the words of the library's closing line."""
        log = self.path(".log")
        environment = dict(os.environ, LD_PRELOAD=os.path.join(FAULTS, library), FAULT_LOG=log,
                           **{key: str(value) for key, value in settings.items()})
        if SANITIZED:
            environment["ASAN_OPTIONS"] = environment.get("ASAN_OPTIONS", "") + ":verify_asan_link_order=0"
        process = self.start(*words, env=environment, stdin=-1)
        out, err = process.communicate(text_in.encode() if text_in else None, timeout=120)
        self.assertTrue(os.path.exists(log), f"it ended without its closing line: {process.returncode}, {err.decode()}")
        with open(log, encoding="ascii") as file:
            told = file.read().split()
        os.remove(log)
        return process.returncode, out, err.decode(), told

    def without_files(self):
        """The names and contents of what the command has written, which is removed."""
        written = {name: self.bytes_of(name) for name in self.files() if name not in self.given}
        for name in written:
            os.remove(self.path(name))
        return written

    def check_every_fault(self, library, words, message, text_in=None, **settings):
        """Lets the first call fail, then the second, and so on; returns how many there were."""
        self.given = self.files()
        expected = self.faulty(library, words, text_in, **settings)
        files = self.without_files()
        self.assertEqual(expected[0], 0, expected[2])
        calls = int(expected[3][0])
        self.assertGreater(calls, 0)
        for at in range(1, calls + 1):
            for on in (0, 1) if SOAK else (0,):
                with self.subTest(command=" ".join(words), FAULT_AT=at, FAULT_ON=on):
                    status, out, err, told = self.faulty(library, words, text_in, FAULT_AT=at, FAULT_ON=on, **settings)
                    written = self.without_files()
                    if status != 0:
                        self.assertEqual(status, 3, err)
                        self.assertRegex(err, message)
                        self.assertLessEqual(written.items(), files.items()) # each is whole, or not there
                    elif told[2:] and told[2].endswith("Info"):
                        # a device that does not tell what it is, is used all the same
                        self.assertEqual(list(written), list(files))
                    else:
                        self.assertEqual((self.timeless(out), written), (self.timeless(expected[1]), files))
                    if self.counts_what_is_left(library, settings):
                        self.assertEqual(told[1], "0", "objects or blocks that were not given back")
        return calls

    @staticmethod
    def counts_what_is_left(library, settings):
        return library != "memory.so" or not (SANITIZED or "FAULT_CALLER" in settings)

    @staticmethod
    def timeless(out):
        """The output without what differs from run to run."""
        return re.sub(rb'"(phases_ms":\{[^}]*\}|peak_memory_bytes":\d+)', b"", out)


class Memory(FaultTest):
    MESSAGE = r"(?i)\A[^\n]*: [^\n]*(out of|insufficient|cannot allocate) memory[^\n]*\n\Z"

    def every(self, *words, text_in=None, **settings):
        return self.check_every_fault("memory.so", words, self.MESSAGE, text_in, **settings)

    def test_check(self):
        self.every("check", "scene.json")
        self.every("check", "scene.json", "--geometry")

    def test_reading_a_model(self):
        self.put("model.obj", MODEL)
        self.put("model.mtl", LIBRARY)
        self.put("model.json", """{"camera": {"position": [0, 0, 1], "look_at": [0, 0, 0]},
            "screen": {"columns": 4, "rows": 3}, "lights": [], "materials": {"pink": {}}, "objects": [
            {"material": "pink", "obj": "model.obj", "transform": [{"scale": 2}]},
            {"material": "pink", "box": {"min": [2, 2, 2], "max": [3, 3, 3]}}]}""")
        self.every("check", "model.json", "-q")

    def test_render(self):
        for accel in ("none", "bvh", "kdtree", "lbvh"):
            self.every("render", "scene.json", "-b", "reference", "--threads", "1", "--accel", accel, "--quiet",
                       "--stats=json", "-o", "a.png")
        self.every("render", "scene.json", "-b", "reference", "--threads", "1", "--quiet", "-o", "-")

    def test_a_map(self):
        self.every("render", "scene.json", "-b", "reference", "--threads", "1", "-q", "--sampling", "adaptive:2",
                   "-o", "a.png",
                   "--map", "rays", "map.png")

    def test_generate(self):
        for kind, size in (("menger", "1"), ("city", "3"), ("grid", "3")):
            self.every("generate", kind, "--size", size, "-o", "new.json")

    def test_threads(self):
        # The C library keeps what it allocated for a thread.
        self.every("render", "scene.json", "-b", "reference", "--threads", "3", "-q", "-o", "a.png", FAULT_CALLER="own")

    def test_trace(self):
        for form in ("text", "json", "obj", "svg"):
            self.every("trace", "scene.json", "--pixel", "4,3", "--format", form, "-o", "a.txt")

    def test_cast(self):
        self.every("cast", "scene.json", "-b", "reference", text_in="1000.5 0.5 1 0 0 -1\n0 0 0 1 1 1\n")

    def test_compare(self):
        self.render("-o", "a.png")
        self.render("-o", "b.png")
        self.every("compare", "a.png", "b.png", "-o", "c.png")

    def test_our_part_of_opencl(self):
        """What a driver makes of memory that runs out is its own affair."""
        for words in ([], ["--sampling", "adaptive:2"], ["--accel", "bvh"], ["--accel", "kdtree"]):
            self.every("render", "scene.json", "--quiet", "-o", "a.png", *words, FAULT_CALLER="own")
        self.every("cast", "scene.json", text_in="1000.5 0.5 1 0 0 -1\n", FAULT_CALLER="own")
        self.every("devices", FAULT_CALLER="own")

    @unittest.skipUnless(SOAK, "only in the soak")
    def test_real_scenes(self):
        for scene in ("scenes/original.json", "tests/scenes/split.json", "tests/scenes/obj.json"):
            scene = os.path.abspath(scene)
            self.every("check", scene)
            self.every("check", scene, "--geometry")
            self.every("render", scene, "-b", "reference", "--threads", "1", "--size", "9x9", "-q", "-o", "a.png")
            for form in ("text", "json", "obj", "svg"):
                self.every("trace", scene, "--pixel", "40,40", "--format", form, "--verbose", "-q", "-o", "a.txt")


class Opencl(FaultTest):
    MESSAGE = r"\Arectray: (OpenCL: cl\w+ failed with -5, CL_OUT_OF_RESOURCES\n|no OpenCL platform was found|" \
              r"the kernels do not compile for |the device \S.* has no double precision)"

    def every(self, *words, text_in=None, **settings):
        """With kept kernels; in the soak also without."""
        with tempfile.TemporaryDirectory() as kept:
            self.run_program(*words, text_in=text_in, env=dict(os.environ, RECTRAY_CACHE_DIR=kept))
            for cache in (kept, "") if SOAK else (kept,):
                self.check_every_fault("opencl.so", words, self.MESSAGE, text_in, RECTRAY_CACHE_DIR=cache, **settings)

    def test_no_call_is_forgotten(self):
        with open("tests/faults/opencl.c", encoding="utf-8") as file:
            known = set(re.findall(r"\bcl[A-Z]\w+", file.read()))
        for path in glob.glob("src/**/*.c", recursive=True):
            with open(path, encoding="utf-8") as file:
                self.assertLessEqual(set(re.findall(r"\bcl[A-Z]\w+(?=\()", file.read())), known, path)

    def test_devices(self):
        self.every("devices")

    def test_render(self):
        for words in ([], ["--sampling", "adaptive:2"], ["--kernel", "gpu", "--grid", "1"],
                      ["--kernel", "gpu", "--sampling", "adaptive:2"]):
            self.every("render", "scene.json", "--quiet", "-o", "a.png", *words)

    def test_render_without_kept_kernels(self):
        self.check_every_fault("opencl.so", ["render", "scene.json", "--quiet", "-o", "a.png"], self.MESSAGE,
                               RECTRAY_CACHE_DIR="")

    def test_cast(self):
        self.every("cast", "scene.json", text_in="1000.5 0.5 1 0 0 -1\n")

    def test_a_platform_without_devices(self):
        for words in (["devices"], ["render", "scene.json", "-o", "a.png"], ["cast", "scene.json"]):
            status, out, err, _ = self.faulty("opencl.so", words, "0 0 0 1 1 1\n", FAULT_DEVICES=0)
            self.assertEqual((status, out.count(b"\n")), (3, words[0] == "cast")) # the table's head
            self.assertIn("rectray: OpenCL is installed but offers no device; install one", err)
            self.assertEqual(self.files(), [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
