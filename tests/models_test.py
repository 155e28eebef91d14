#!/usr/bin/env python3
"""Models as people have them. Each folder of tests/models/ holds scene.json, its models and libraries, and

- says: what `rectray check` says on standard error, in that folder: notes or an error; without it, nothing;
- expected.json: a scene of plain models with the same picture, byte for byte.

The program runs in that folder. To add one, add its folder. To run one:
python3 tests/models_test.py Models.test_the_folder_NAME"""
import json
import subprocess
import tempfile
import unittest
from pathlib import Path

from support.program import PROGRAM

FOLDERS = sorted(path for path in (Path(__file__).resolve().parent / "models").iterdir() if path.is_dir())


def run(folder, *words):
    """The exit status and the messages."""
    done = subprocess.run([PROGRAM, *words], cwd=folder, capture_output=True, text=True)
    return done.returncode, done.stderr


def picture(folder, scene):
    with tempfile.TemporaryDirectory() as holder:
        path = Path(holder) / "picture.png"
        status, messages = run(folder, "render", scene, "-q", "-b", "reference", "-t", "1", "-o", path)
        return path.read_bytes() if status == 0 else messages


class Models(unittest.TestCase):
    maxDiff = None

    def try_folder(self, folder):
        says = folder / "says"
        wanted = says.read_text(encoding="utf-8") if says.exists() else ""
        is_good = not wanted or ": note: " in wanted
        self.assertEqual(run(folder, "check", "scene.json"), (0 if is_good else 1, wanted))
        if (folder / "expected.json").exists():
            expected = picture(folder, "expected.json")
            self.assertIsInstance(expected, bytes, expected)
            self.assertEqual(picture(folder, "scene.json"), expected)


class Names(unittest.TestCase):
    """Faces of models with named parts."""
    SCENE = "tests/scenes/obj.json"

    def output(self, *words):
        return subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=True).stdout

    def test_a_face_has_the_name_of_its_part(self):
        text = self.output("trace", self.SCENE, "--face", "house: roof/6", "--summary", "-q")
        self.assertIn("camera -> P1 house: roof/6\n", text)
        for name, found in (("house: walls", "house: walls/"), ("second house: roof", "...: roof/"),
                            ("house/6", "house: roof/6")):
            self.assertIn(found, self.output("trace", self.SCENE, "--face", name, "--summary", "-q"), name)

    def test_the_json_names_object_and_part(self):
        pixel = json.loads(self.output("trace", self.SCENE, "--face", "house: roof/6", "-f", "json", "-q"))
        hits = [event for event in pixel["events"] if event["event"] == "hit"]
        self.assertEqual([hits[0][key] for key in ("object", "part", "face_in_object")], ["house", "roof", 6])

    def test_check_lists_the_parts(self):
        self.assertIn("6 named parts of models", self.output("check", self.SCENE))
        parts = json.loads(self.output("check", self.SCENE, "--json"))["holds"]["parts"]
        one = [("walls", 4), ("roof", 4), ("floor", 1)]
        self.assertEqual([(part["object"], part["name"], part["faces_traced"]) for part in parts],
                         [("house", *part) for part in one] + [("second house", *part) for part in one])

    def test_a_nameless_object_has_its_files_name(self):
        scene = "tests/models/parts-of-a-nameless-object/scene.json"
        text = self.output("trace", scene, "--face", "model.obj: roof", "--summary", "-q")
        self.assertIn("P1  model.obj: roof/5", text)

    def test_one_name_for_all_is_none(self):
        self.assertEqual(json.loads(self.output("check", "scenes/gallery.json", "--json"))["holds"]["parts"], [])


def test_of(folder):
    return lambda self: self.try_folder(folder)


for path in FOLDERS:
    setattr(Models, "test_the_folder_" + path.name.replace("-", "_"), test_of(path))

if __name__ == "__main__":
    unittest.main()
