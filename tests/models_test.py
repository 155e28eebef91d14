#!/usr/bin/env python3
"""Models as people have them. Each folder of tests/models/ holds scene.json, its models and libraries, and

- says: what `rectray check` says on standard error, in that folder: notes or an error; without it, nothing;
- expected.json: a scene of plain models with the same picture, byte for byte.

The program runs in that folder. To add one, add its folder. To run one:
python3 tests/models_test.py Models.test_the_folder_NAME"""
import json
import math
import struct
import subprocess
import tempfile
import unittest
from pathlib import Path

from support.program import PROGRAM, SCENE, CommandTest

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
        for name, found in (("house: walls", "house: walls/"), ("second house: roof", "second house: roof/"),
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


class Formats(CommandTest):
    """Files of other formats, and broken ones."""

    def says(self, data, name="model"):
        with open(self.path(name), "wb") as file:
            file.write(data)
        scene = SCENE | {"objects": [{"material": "pink", "obj": name}]}
        self.put("scene.json", json.dumps(scene))
        out, err = self.run_program("check", "scene.json", status=1)
        self.assertEqual(out, b"")
        return err

    def test_a_foreign_file_is_named(self):
        for data, name in ((b"<!DOCTYPE html>\n<html>", "an HTML page"), (b"  <HTML><body>", "an HTML page"),
                           (b'\xef\xbb\xbf{"type": "CityJSON"}', "glTF or CityJSON"),
                           (b"glTF\x02\0\0\0", "binary glTF"),
                           (b"PK\x03\x04\x14\0", "3MF"), (b"Kaydara FBX Binary  \0", "an FBX file"),
                           (b"VOX \x96\0\0\0", "MagicaVoxel"), (b"OFF\n8 6 0\n", "an OFF file"),
                           (b"newmtl red\nKd 1 0 0\n", "a material library"), (b"#VRML V2.0 utf8", "a VRML file"),
                           (b'<?xml version="1.0"?>\n<COLLADA', "Collada"), (b"ISO-10303-21;", "STEP or IFC"),
                           (b"version https://git-lfs.github.com/spec/v1\noid sha256:0\n", "Git LFS"),
                           (b"404: Not Found", "no such file"), (b"\x1f\x8b\x08\0", "a gzip archive"),
                           (b"\x89PNG\r\n\x1a\n\0", "a PNG picture"), (b"  0\r\nSECTION\r\n", "a DXF file"),
                           (b"  0\nSECTION\n", "a DXF file")):
            for padded in (data, data.ljust(200, b"\0")):  # real ones have NULs within the first 84 bytes
                with self.subTest(padded):
                    self.assertRegex(self.says(padded), rf"^model: this is [^;]*{name}[^;]*; [^\n]+\n$")

    def test_what_a_library_asks_for_without_a_number_is_noted(self):
        self.put("model.obj", "mtllib model.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n")
        self.put("scene.json", json.dumps(SCENE | {"objects": [{"obj": "model.obj"}]}))
        for key in ("illum", "d", "Tr"):
            for value in ("", " x", " nan", " -1"):
                with self.subTest(key + value):
                    self.put("model.mtl", f"newmtl red\nKd 1 0 0\n{key}{value}\nnewmtl other\n{key}\n")
                    self.assertEqual(self.run_program("check", "scene.json")[1],
                                     "model.mtl:3: note: a line of an unknown kind is left out: "
                                     f"{key}, which needs a number from 0\n")

    def test_a_ply_file_may_begin_with_a_byte_order_mark(self):
        self.put("model.ply", "\ufeffply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                 "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                 "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
        self.put("scene.json", json.dumps(SCENE | {"objects": [{"material": "pink", "obj": "model.ply"}]}))
        self.assertIn(b"1 of them triangles", self.run_program("check", "scene.json")[0])

    def test_stl_words_may_be_capitals(self):
        self.put("model.stl", "SOLID X\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 0 1 0\n"
                 "ENDLOOP\nENDFACET\nENDSOLID X\n")
        self.put("scene.json", json.dumps(SCENE | {"objects": [{"material": "pink", "obj": "model.stl"}]}))
        self.assertIn(b"1 of them triangles", self.run_program("check", "scene.json")[0])

    def test_words_that_a_terminal_would_obey_are_not_told_as_they_are(self):
        self.put("model.obj", "mtllib model.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n")
        self.put("model.mtl", "newmtl red\nKd 1 0 0\n\033[2J\033 1\n")
        self.put("model.ply", "ply\nformat ascii 1.0\nelement \033[2J 0\nelement vertex 3\nproperty float x\n"
                 "property float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                 "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
        objects = [{"obj": "model.obj"}, {"material": "pink", "obj": "model.ply"}]
        self.put("scene.json", json.dumps(SCENE | {"objects": objects}))
        told = "note: a line of an unknown kind is left out:"
        self.assertEqual(self.run_program("check", "scene.json")[1],
                         f'model.mtl:3: {told} ?[2J? "1"\nmodel.ply:3: {told} element ?[2J\n')

    def test_a_name_that_is_empty(self):
        self.put("scene.json", json.dumps(SCENE | {"objects": [{"material": "pink", "obj": ""}]}))
        err = self.run_program("check", "scene.json", status=1)[1]
        self.assertIn('objects[0].obj: must be the name of a file, not ""\n', err)

    def test_broken_ply_files(self):
        header = b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        face = b"element face 1\nproperty list uchar int vertex_indices\nend_header\n"
        points = b"0 0 0\n1 0 0\n0 1 0\n"
        for data, message in ((header, "model:6: the header has no end"),
                              (b"ply\nformat ascii 2.0\n", 'model:2: "format ascii 2.0" is no line of a PLY header'),
                              (b"ply\nproperty float x\n", "model:2: a property of no element, or more than 64 of one"),
                              (b"ply\nelement vertex -1\n", 'model:2: "-1" is no number of elements'),
                              (header + b"property half w\n", 'model:7: the property "w" has an unknown type'),
                              (header + face + points, "model:13: the file ends before its elements do"),
                              (header + face + points + b"3 0 1 3\n", "model:13: vertex 3 does not exist; there are 3"),
                              (header + face + points + b"3 0 1 -1\n",
                               "model:13: vertex -1 does not exist; there are 3"),
                              (header + face + points + b"3 0 1 x\n", "model:13: a word that is no number"),
                              (header + face + b"0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n",
                               "model:13: vertex 2 of the face is not a finite number"),
                              (header + b"end_header\n" + points,
                               "model: this PLY file holds no face (a list vertex_indices)")):
            with self.subTest(data):
                self.assertEqual(self.says(data), message + "\n")

    def test_other_elements_of_ply_files_are_read_past(self):
        self.put("model.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                 "property float z\nelement edge 1\nproperty int vertex1\nproperty list uchar int more\n"
                 "element face 1\nproperty list uchar int vertex_indices\nproperty uchar red\nend_header\n"
                 "1000 0 0\n1001 0 0\n1000 1 0\n0 2 7 8\n3 0 1 2 255\n")
        self.put("scene.json", json.dumps(SCENE | {"objects": [{"material": "pink", "obj": "model.ply"}]}))
        out, err = self.run_program("check", "scene.json", "-v")
        self.assertEqual(err, "model.ply:7: note: a line of an unknown kind is left out: element edge\n"
                         "model.ply:12: note: a line of an unknown kind is left out: property red\n")
        self.assertIn(b"1 of them triangles", out)

    def test_what_follows_the_last_element_of_a_ply_file_is_noted(self):
        header = b"ply\nformat %s 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n" \
            b"element face 1\nproperty list uchar uchar vertex_indices\nend_header\n"
        text = header % b"ascii" + b"0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
        binary = header % b"binary_big_endian" + struct.pack(">9f4B", 0, 0, 0, 1, 0, 0, 0, 1, 0, 3, 0, 1, 2)
        self.put("scene.json", json.dumps(SCENE | {"objects": [{"material": "pink", "obj": "model.ply"}]}))
        told = "model.ply{}: note: a line of an unknown kind is left out: bytes behind the last element: 7\n"
        for data, line in ((text, None), (text + b"\r\n \0", None), (text + b"\n3 0 1 2", ":15"), (binary, None),
                           (binary + b"\n", None), (binary + b"3 0 1 2", "")):
            with self.subTest(data):
                with open(self.path("model.ply"), "wb") as file:
                    file.write(data)
                err = self.run_program("check", "scene.json")[1]
                self.assertEqual(err, "" if line is None else told.format(line))

    def test_broken_binary_files_name_the_element(self):
        header = (b"ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
                  b"property double z\nelement face 2\nproperty list uchar ushort vertex_index\nend_header\n")
        points = struct.pack("<9d", 0, 0, 0, 1, 0, 0, 0, 1, 0)
        face = struct.pack("<B3H", 3, 0, 1, 2)
        self.assertEqual(self.says(header + points[:-1]), "model: vertex 3: the file ends before its elements do\n")
        self.assertEqual(self.says(header + points + face + struct.pack("<B3H", 3, 0, 1, 7)),
                         "model: face 2: vertex 7 does not exist; there are 3\n")
        stl = b" " * 80 + struct.pack("<I", 1) + struct.pack("<12fH", *[0] * 3, 0, 0, 0, 1, 0, 0, 0, math.nan, 0, 0)
        self.assertEqual(self.says(stl), "model: face 1: vertex 3 of the face is not a finite number\n")
        self.assertRegex(self.says(stl[:-1].replace(b" ", b"\0")), "^model: is a binary file of no known format; ")

    def test_a_face_that_is_left_out_of_a_binary_file_has_its_number(self):
        faces = [struct.pack("<12fH", *[0] * 3, *points, 0) for points in ([0, 0, 0, 1, 0, 0, 0, 1, 0], [0] * 9)]
        with open(self.path("model.stl"), "wb") as file:
            file.write(b" " * 80 + struct.pack("<I", 2) + b"".join(faces))
        self.put("scene.json", json.dumps(SCENE | {"objects": [{"material": "pink", "obj": "model.stl"}]}))
        self.assertRegex(self.run_program("check", "scene.json")[1], r"^model\.stl: note: .*: face 2\b.*\n$")

    def test_broken_stl_files(self):
        facet = "solid x\nfacet normal 0 0 1\nouter loop\n"
        three = "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
        for text, message in ((facet + "vertex 0 0 0\nendloop\nendfacet\n", "6: a facet of 1 vertices; it needs 3"),
                              (facet + three + three, "7: a facet of more than 3 vertices"),
                              (facet + "vertex 0 0\n", "4: a vertex needs three coordinates, not 2"),
                              (facet + "face 1 2 3\n", '4: "face" is no word of STL (solid, facet, vertex, ...)'),
                              ("solid x\nendsolid x\n", " holds no face")):
            with self.subTest(text):
                self.assertEqual(self.says(text.encode()), f"model:{message}\n")


def test_of(folder):
    return lambda self: self.try_folder(folder)


for path in FOLDERS:
    setattr(Models, "test_the_folder_" + path.name.replace("-", "_"), test_of(path))

if __name__ == "__main__":
    unittest.main()
