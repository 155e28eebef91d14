"""What the tests of the commands share: the program, a small scene, and a test case that runs the one on the other.
The program is $RECTRAY or build/rectray; each suite runs alone by: python3 tests/NAME_test.py [Class.test]"""
import json
import os
import struct
import subprocess
import tempfile
import unittest
import zlib

PROGRAM = os.path.abspath(os.environ.get("RECTRAY", "build/rectray"))

# Whether there are hours, not minutes: `make soak` sets it.
SOAK = os.environ.get("RECTRAY_SOAK") == "1"

# A unit square at z = 0 that faces a camera at z = 1, a light over it, a one-sided triangle 2 behind it; all moved
# by 1000 in x.
SCENE = {
    "camera": {"position": [1000.5, 0.5, 1], "look_at": [1000.5, 0.5, 0]},
    "screen": {"columns": 8, "rows": 6},
    "lights": [{"position": [1000.5, 0.5, 5]}],
    "materials": {"pink": {"ambient": [0.1, 0, 0.1], "diffuse": [0.7, 0, 0.7]}, "unused \"one\"": {}},
    "objects": [
        {"name": "tile", "material": "pink", "vertices": [[1000, 0, 0], [1001, 0, 0], [1001, 1, 0], [1000, 1, 0]],
         "faces": [[0, 1, 2, 3]]},
        {"name": "back wall", "material": "pink", "sided": "front",
         "vertices": [[1000, 0, -2], [1001, 0, -2], [1001, 1, -2]], "faces": [[0, 1, 2]]},
    ],
}


def png_pixels(data):
    """The rows of an 8-bit RGB picture, by the PNG specification, section 9."""
    columns, rows = struct.unpack(">II", data[16:24])
    raw, at = b"", 8
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        raw += data[at + 8:at + 8 + length] if kind == b"IDAT" else b""
        at += length + 12
    raw, stride, picture, above = zlib.decompress(raw), 3 * columns, [], bytes(3 * columns)
    for row in range(rows):
        start = row * (stride + 1)
        kind, line = raw[start], bytearray(raw[start + 1:start + 1 + stride])
        for i in range(stride):
            left, up, corner = (line[i - 3], above[i], above[i - 3]) if i >= 3 else (0, above[i], 0)
            estimate = left + up - corner
            paeth = min((abs(estimate - left), 0, left), (abs(estimate - up), 1, up),
                        (abs(estimate - corner), 2, corner))[2]
            line[i] = (line[i] + (0, left, up, (left + up) // 2, paeth)[kind]) % 256
        picture.append([tuple(line[i:i + 3]) for i in range(0, stride, 3)])
        above = line
    return picture


class CommandTest(unittest.TestCase):
    """Each test runs in a folder of its own, where scene.json is."""

    def setUp(self):
        self.holder = tempfile.TemporaryDirectory()
        self.folder = self.holder.name
        self.put("scene.json", json.dumps(SCENE))

    def tearDown(self):
        self.holder.cleanup()

    def path(self, name):
        return os.path.join(self.folder, name)

    def put(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def bytes_of(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def files(self):
        return sorted(name for name in os.listdir(self.folder) if name != "scene.json")

    def start(self, *words, **options):
        options.setdefault("stdin", subprocess.DEVNULL)
        options.setdefault("stdout", subprocess.PIPE)
        options.setdefault("stderr", subprocess.PIPE)
        return subprocess.Popen([PROGRAM, *words], **{"cwd": self.folder, **options})

    def run_program(self, *words, status=0, text_in=None, **options):
        """Runs `rectray WORDS`, checks its exit status, returns stdout (bytes) and stderr (str)."""
        if text_in is not None:
            options["stdin"] = subprocess.PIPE
        process = self.start(*words, **options)
        out, err = process.communicate(text_in.encode() if text_in is not None else None, timeout=120)
        err = (err or b"").decode()
        self.assertEqual(process.returncode, status, f"rectray {' '.join(words)}\n{err}")
        return out, err

    def render(self, *words, **options):
        return self.run_program("render", "scene.json", "--backend", "reference", *words, **options)
