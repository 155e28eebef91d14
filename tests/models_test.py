#!/usr/bin/env python3
"""Models as people have them. Each folder of tests/models/ holds scene.json, its models and libraries, and

- says: what `rectray check` says on standard error, in that folder: notes or an error; without it, nothing;
- expected.json: a scene of plain models with the same picture, byte for byte.

To add one, add its folder. To run one: python3 tests/models_test.py Models.test_the_folder_NAME"""
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


def test_of(folder):
    return lambda self: self.try_folder(folder)


for path in FOLDERS:
    setattr(Models, "test_the_folder_" + path.name.replace("-", "_"), test_of(path))

if __name__ == "__main__":
    unittest.main()
