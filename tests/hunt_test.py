"""Bug hunts: each fault shows in the picture and in the walkthrough of its pixel, and can be mended. Three of them
here, all of them in `make soak`."""
import contextlib
import io
import os
import shutil
import subprocess
import unittest

from exercises import hunt
from support.program import PROGRAM, SOAK, png_pixels

HUNTS = hunt.read_hunts()
SEEDS = range(1, len(HUNTS) + 1) if SOAK else (1, 2, 6)
USUAL = os.path.join(hunt.TOP, "build", "rectray")


def read(path):
    with open(path, "rb") as file:
        return file.read()


def quietly(function, *arguments):
    """What it prints."""
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        function(*arguments)
    return out.getvalue()


class List(unittest.TestCase):
    def test_each_seed_has_another_hunt(self):
        names = [hunt.hunt_of(seed)["hunt"] for seed in range(1, len(HUNTS) + 1)]
        self.assertGreaterEqual(len(names), 20)
        self.assertEqual(len(set(names)), len(names))
        self.assertEqual(hunt.hunt_of(len(HUNTS) + 1), hunt.hunt_of(1))

    def test_each_is_a_fault_of_the_list_in_a_scene_that_is_there(self):
        os.chdir(hunt.TOP)
        for each in HUNTS:
            with self.subTest(each["hunt"]):
                file, before, _ = hunt.mutant_of(each)
                self.assertEqual(read(file).decode().count(before), 1)
                self.assertTrue(os.path.isfile(each["scene"]))
                self.assertGreater(len(each["why"]), 100)
                self.assertIn("step", each["formula"])


@unittest.skipUnless(os.path.samefile(PROGRAM, USUAL) if os.path.exists(USUAL) else False,
                     "a hunt copies the usual build, in build/")
class Hunts(unittest.TestCase):
    def setUp(self):
        os.chdir(hunt.TOP)

    def check(self, seed):
        each, folder = hunt.hunt_of(seed), f"build/hunt/{seed}"
        told = quietly(hunt.hand_out, seed)
        for name in ("README.txt", "apart.png", "right.png", "faulty.png", "right.txt", "faulty.txt"):
            self.assertTrue(os.path.isfile(f"{folder}/{name}"), name)
        self.assertNotIn(each["hunt"], told)
        column, row = each["pixel"]
        right, faulty = (png_pixels(read(f"{folder}/{name}.png")) for name in ("right", "faulty"))
        self.assertNotEqual(right[row][column], faulty[row][column])
        self.assertNotEqual(read(f"{folder}/right.txt"), read(f"{folder}/faulty.txt"))

        file, before, after = hunt.mutant_of(each)
        answer = quietly(hunt.answer, seed)
        line = int(answer.split("\n")[0].rsplit("line ", 1)[1])
        self.assertIn(f"{file}, line", answer)
        self.assertIn(after, read(f"{folder}/tracer/{file}").decode().split("\n")[line - 1])
        return f"{folder}/tracer", f"{folder}/tracer/{file}", before, after, each

    def test_each_shows_in_the_picture_and_in_the_walkthrough(self):
        for seed in SEEDS:
            with self.subTest(seed=seed):
                tracer, *_ = self.check(seed)
                times = {os.stat(os.path.join(place, name)).st_mtime_ns
                         for place, _, names in os.walk(f"{tracer}/src") for name in names}
                self.assertEqual(len(times), 1, "the changed file's time must not tell")
                shutil.rmtree(os.path.dirname(tracer))

    def test_a_mended_tracer_makes_the_right_picture(self):
        seed = SEEDS[0]
        tracer, path, before, after, each = self.check(seed)
        text = read(path).decode()
        with open(path, "w", encoding="utf-8") as out:
            out.write(text.replace(after, before))
        subprocess.run(["make", "-s", "-C", tracer, "MAKEFLAGS="], check=True, capture_output=True)
        mended = os.path.join(os.path.dirname(tracer), "mended.png")
        hunt.make_picture(f"{tracer}/build/rectray", each, mended)
        self.assertEqual(read(mended), read(os.path.join(os.path.dirname(tracer), "right.png")))
        shutil.rmtree(os.path.dirname(tracer))

    def test_a_seed_that_is_none_is_refused(self):
        out = subprocess.run(["tests/exercises/hunt.py", "plant", "x"], capture_output=True, text=True, check=False)
        self.assertEqual(out.returncode, 1)
        self.assertIn("SEED=N", out.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
