"""The library: its examples run as they stand on the page, its errors are values, and nothing else is seen of it."""
import ctypes
import json
import math
import os
import re
import subprocess
import tempfile
import threading
import unittest

from support.program import PROGRAM

BUILD = os.path.dirname(PROGRAM)
SHARED = os.path.join(BUILD, "lib", "librectray.so")
STATIC = os.path.join(BUILD, "lib", "librectray.a")
with open("docs/library.md", encoding="utf-8") as page:
    EXAMPLES = dict(re.findall(r"```(c|python)\n(.*?)```", page.read(), re.S))
with open("src/library/rectray.h", encoding="utf-8") as header:
    FUNCTIONS = set(re.findall(r"\b(rectray_\w+)\(", header.read()))
with open(PROGRAM, "rb") as program:
    SANITIZED = b"__asan_init" in program.read()


class Error(ctypes.Structure):
    _fields_ = [("kind", ctypes.c_int), ("text", ctypes.c_char * 8192)]


class Hit(ctypes.Structure):
    _fields_ = [("face", ctypes.c_int), ("t", ctypes.c_double)]


class Settings(ctypes.Structure):
    _fields_ = [("reference", ctypes.c_int), ("in_double", ctypes.c_int), ("threads", ctypes.c_int),
                ("device", ctypes.c_int)]


BAND = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_int, ctypes.c_int, ctypes.POINTER(ctypes.c_ubyte))


@unittest.skipIf(SANITIZED, "a sanitizer wants to be linked into the program first")
class Library(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        subprocess.run(["make", "--no-print-directory", "-s", "library", f"BUILD={BUILD}"], check=True)
        cls.library = ctypes.CDLL(SHARED)
        for name in ("rectray_scene_load", "rectray_scene_parse", "rectray_trace"):
            getattr(cls.library, name).restype = ctypes.c_void_p

    def load(self, path):
        error = Error()
        scene = self.library.rectray_scene_load(path.encode(), ctypes.byref(error))
        self.assertTrue(scene, error.text)
        return ctypes.c_void_p(scene)

    def picture(self, scene, settings):
        rows = {}
        columns, count, error = ctypes.c_int(), ctypes.c_int(), Error()
        self.library.rectray_scene_size(scene, ctypes.byref(columns), ctypes.byref(count))

        def band(_, first, number, rgb):
            rows[first] = bytes(rgb[:number * columns.value * 3])
            return 1
        done = self.library.rectray_render(scene, ctypes.byref(settings), BAND(band), None, ctypes.byref(error))
        self.assertTrue(done, error.text)
        return b"".join(rows[first] for first in sorted(rows))

    def test_only_the_functions_of_the_header_are_seen(self):
        out = subprocess.run(["nm", "-D", "--defined-only", SHARED], capture_output=True, text=True, check=True).stdout
        self.assertEqual({line.split()[-1] for line in out.splitlines()}, FUNCTIONS)
        out = subprocess.run(["nm", "-g", "--defined-only", STATIC], capture_output=True, text=True, check=True).stdout
        self.assertEqual({line.split()[-1] for line in out.splitlines() if " " in line}, FUNCTIONS)

    def test_the_example_in_c(self):
        with tempfile.TemporaryDirectory() as folder:
            source, example = os.path.join(folder, "example.c"), os.path.join(folder, "example")
            with open(source, "w", encoding="utf-8") as file:
                file.write(EXAMPLES["c"])
            self.assertLessEqual(EXAMPLES["c"].count("\n"), 40)
            libraries = subprocess.run(["pkg-config", "--libs", "libpng", "libisal", "libcjson", "OpenCL"],
                                       capture_output=True, text=True, check=True).stdout.split()
            subprocess.run(["cc", "-std=c99", "-Wall", "-Werror", "-Isrc/library", source, STATIC, *libraries, "-lm",
                            "-pthread", "-o", example], check=True)
            run = subprocess.run([example, "scenes/original.json"], capture_output=True, check=True)
            picture = os.path.join(folder, "a.ppm")
            subprocess.run([PROGRAM, "render", "scenes/original.json", "-b", "reference", "--size", "64x48", "-q", "-o",
                            picture], check=True)
            with open(picture, "rb") as file:
                self.assertEqual(run.stdout, file.read())
            self.assertRegex(run.stderr.decode(), r"^below \(0, 9, 3\): face 11 at t = 5.18")
            run = subprocess.run([example, "missing.json"], capture_output=True, check=False)
            self.assertIn(b"missing.json: cannot be opened", run.stderr)

    def test_the_example_in_python(self):
        run = subprocess.run(["python3", "-c", EXAMPLES["python"], SHARED, "scenes/original.json"], capture_output=True,
                             text=True, check=False)
        self.assertRegex(run.stdout, r"^the pixel is \[\d+, \d+, \d+\]\n$", run.stderr)

    def test_a_header_for_cplusplus_too(self):
        with open("src/library/rectray.h", encoding="utf-8") as file:
            self.assertIn('extern "C" {', file.read())

    def test_pictures_of_both_backends_and_of_several_threads_are_the_same(self):
        scene = self.load("scenes/original.json")
        expected = self.picture(scene, Settings(reference=1))
        self.assertEqual(self.picture(scene, Settings(in_double=1)), expected)
        found = []
        threads = [threading.Thread(target=lambda: found.append(self.picture(scene, Settings(reference=1, threads=1))))
                   for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, 4 * [expected])
        self.library.rectray_scene_free(scene)

    def test_a_walkthrough_is_that_of_the_program(self):
        scene, error = self.load("scenes/original.json"), Error()
        text = ctypes.c_void_p(self.library.rectray_trace(scene, 40, 36, ctypes.byref(error)))
        walk = json.loads(ctypes.cast(text, ctypes.c_char_p).value)
        self.library.rectray_free(text)
        out = subprocess.run([PROGRAM, "trace", "scenes/original.json", "--pixel", "40,36", "--format", "json"],
                             capture_output=True, check=True).stdout
        expected = json.loads(out)
        self.assertEqual(walk["summary"]["rgb"], expected["summary"]["rgb"])
        self.assertEqual(walk["events"], expected["events"])
        self.assertFalse(self.library.rectray_trace(scene, 80, 0, ctypes.byref(error)))
        self.assertEqual((error.kind, error.text), (2, b"the pixel is outside the picture"))
        self.library.rectray_scene_free(scene)

    def test_rays_are_those_of_cast(self):
        scene = self.load("scenes/original.json")
        rays = (ctypes.c_double * 12)(0, 9, 3, 0, -1, 0, 0, 9, 3, 0, -1e9, 0)
        hits, error = (Hit * 2)(), Error()
        for settings in (Settings(reference=1), Settings(in_double=1)):
            self.assertTrue(self.library.rectray_cast(scene, ctypes.byref(settings), rays, ctypes.c_long(2), hits,
                                                      ctypes.byref(error)), error.text)
            out = subprocess.run([PROGRAM, "cast", "scenes/original.json", "-b", "reference"], input=b"0 9 3 0 -1 0\n",
                                 capture_output=True, check=True).stdout.split(b"\n")[1].split(b",")
            self.assertEqual((hits[0].face, hits[0].t), (int(out[1]), float(out[2])))
            self.assertAlmostEqual(hits[1].t * 1e9, hits[0].t)
        for place, value in ((4, 0), (4, 1e-70), (4, 1e70), (0, 1e13), (0, 1e-70), (4, math.nan), (0, math.inf)):
            wrong = (ctypes.c_double * 6)(0, 9, 3, 0, -1, 0)
            wrong[place] = value
            error = Error()
            done = self.library.rectray_cast(scene, None, wrong, ctypes.c_long(1), hits, ctypes.byref(error))
            self.assertEqual((done, error.kind), (0, 2), (place, value))
        self.library.rectray_scene_free(scene)

    def test_a_wrong_scene_is_told_with_its_place(self):
        error = Error()
        text = b'{\n  "camera": 7 }'
        self.assertFalse(self.library.rectray_scene_parse(b"mine.json", text, ctypes.c_long(len(text)),
                                                          ctypes.byref(error)))
        self.assertEqual(error.kind, 1)
        self.assertRegex(error.text, rb"^mine.json:\d+:\d+: ")

    def test_the_receiver_may_stop(self):
        scene, error = self.load("scenes/original.json"), Error()
        settings = Settings(reference=1)
        self.assertFalse(self.library.rectray_render(scene, ctypes.byref(settings), BAND(lambda *_: 0), None,
                                                     ctypes.byref(error)))
        self.assertIn(b"stopped", error.text)
        self.library.rectray_scene_free(scene)


if __name__ == "__main__":
    unittest.main(verbosity=2)
