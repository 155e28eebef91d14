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

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
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

    def checked(self, model, library=None, status=0, **changes):
        """What `check` says of a model whose object has a material."""
        self.put("model.obj", model)
        if library is not None:
            self.put("model.mtl", library)
        object = {"material": "pink", "obj": "model.obj"} | changes
        self.put("scene.json", json.dumps(SCENE | {"objects": [object]}))
        return self.run_program("check", "scene.json", status=status)[1]

    def test_what_cannot_be_read_stops_only_a_model_that_uses_it(self):
        for line, reason in (("Kd 1 x 0", '"x" is not a finite number'),
                             ("Ks 1 nan 0", "Ks: nan is not from 0 to 1e+18"),
                             ("Ns -4", "Ns needs a number from 0 to 1e+18"),
                             ("Ka 1 2", "Ka needs three numbers, or one for a grey, not 2")):
            library = f"newmtl red\nKd 1 0 0\nnewmtl other\n{line}\nKa 0 0 0\n"
            model = "mtllib model.mtl\n" + TRIANGLE.replace("f ", "usemtl red\nf ")
            self.assertEqual(self.checked(model, library),
                             f"model.mtl:4: note: a material that no face has cannot be read: {reason}\n")
            self.assertEqual(self.checked(model.replace("red", "other"), library, status=1),
                             f"model.obj:1: mtllib: model.mtl:4: {reason}\n")

    def test_a_value_that_is_given_twice(self):
        model = "mtllib model.mtl\n" + TRIANGLE.replace("f ", "usemtl red\nf ")
        self.assertEqual(self.checked(model, "newmtl red\nKd 1 0 0\nNs 4\nKd 0 0 1\nnewmtl other\nNs 4\n"),
                         'model.mtl:4: note: a value of a material is given again, and the last one counts: "Kd"\n')

    def test_libraries_and_materials_without_a_name(self):
        told = ("model.obj:1: note: a material library is not there: mtllib without a file; faces get the materials of "
                "the scene\n")
        self.assertEqual(self.checked("mtllib\n" + TRIANGLE), told)
        model = "mtllib model.mtl\n" + TRIANGLE
        self.assertEqual(self.checked(model, "newmtl \nKd 1 0 0\n"),
                         "model.mtl:1: note: a line of an unknown kind is left out: newmtl without a name\n")
        self.put("scene.json", json.dumps(SCENE | {"objects": [{"obj": "model.obj"}]}))
        self.put("model.obj", "mtllib\n" + TRIANGLE)
        self.assertIn("the face has no material", self.run_program("check", "scene.json", status=1)[1])

    def test_a_model_without_faces_says_what_it_has(self):
        self.assertEqual(self.checked("v 0 0 0\nv 1 0 0\np 1\np 2\nface 1 2 3\n", status=1),
                         "model.obj: holds no face; 2 points without size are left out, the first at line 3, a line of "
                         'an unknown kind is left out: "face"\n')
        cloud = b"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n" \
            b"element tristrips 0\nproperty list int int vertex_indices\nend_header\n0 0 0\n"
        self.assertEqual(self.says(cloud), "model: this PLY file holds no face (a list vertex_indices); a line of an "
                         "unknown kind is left out: element tristrips\n")

    def test_faces_that_are_not_planar(self):
        bent = "v 0 0 0\nv 1 0 0\nv 1 1 0.01\nv 0 1 0\nf 1 2 3 4\n"
        self.assertEqual(self.checked(bent), "model.obj:5: note: a face is not planar, and is cut into pieces that "
                         'are; "nonplanar": "error" would refuse it, and "split" is silent\n')
        self.assertEqual(self.checked(bent, nonplanar="split"), "")
        self.assertRegex(self.checked(bent, nonplanar="error", status=1), "^model.obj:5: the face is not planar: ")

    def test_faces_of_two_vertices_have_no_area(self):
        told = '{} note: a face without area is left out; "degenerate": "error" would refuse it\n'
        model = TRIANGLE + "f 1 2\n"
        self.assertEqual(self.checked(model), told.format("model.obj:5:"))
        self.assertEqual(self.checked(model, status=1, degenerate="error"),
                         "model.obj:5: a face of 2 vertices; it needs at least 3\n")
        self.put("model.obj", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                 "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
                 "0 0 0\n1 0 0\n0 1 0\n2 0 1\n3 0 1 2\n")
        self.put("scene.json", json.dumps(SCENE | {"objects": [{"material": "pink", "obj": "model.obj"}]}))
        self.assertEqual(self.run_program("check", "scene.json")[1], told.format("model.obj:13:"))

    def test_a_bent_quad_that_crosses_itself_is_an_error(self):
        crossed = ("model.obj:5: the face crosses itself: its edges from vertex {} to {} and from {} to {} cross; list "
                   "its vertices in order around it\n")
        points = "v 0 0 0\nv 1 1 0.2\nv 1 0 0\nv 0 1 0\n"
        self.assertEqual(self.checked(points + "f 1 2 3 4\n", status=1), crossed.format(1, 2, 3, 4))
        self.assertEqual(self.checked(points + "f 1 4 2 3\n", nonplanar="split"), "")
        self.assertEqual(self.checked(points + "f 2 3 4 1\n", status=1, nonplanar="split"), crossed.format(3, 4, 1, 2))

    def test_long_numbers_of_vertices_are_told_as_they_are_written(self):
        for number in ("4294967297", "18446744073709551617", "-9223372036854775809"):
            self.assertEqual(self.checked(TRIANGLE.replace("3\n", number + "/1\n"), status=1),
                             f"model.obj:4: vertex {number} does not exist; 3 are defined above this line\n")

    def test_a_line_that_is_too_long(self):
        self.assertEqual(self.checked(TRIANGLE + "# " + (1 << 20) * "x", status=1),
                         "model.obj:5: the line is longer than 1048576 bytes, with the lines that continue it; make "
                         "several lines of it, or leave it out if it is a comment\n")

    def test_a_key_that_is_meant_to_name_a_model(self):
        for key in ("ply", "stl", "model", "Mesh"):
            self.put("scene.json", json.dumps(SCENE | {"objects": [{"material": "pink", key: "model.ply"}]}))
            self.assertIn(f': objects[0].{key}: unknown key; "obj" names a model, in OBJ, PLY or STL\n',
                          self.run_program("check", "scene.json", status=1)[1])

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

    def test_numbers_of_vertices_may_have_64_bits(self):
        for order, way in (("<", b"little"), (">", b"big")):
            header = (b"ply\nformat binary_%s_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                      b"property float z\nelement face 1\nproperty list uint64 int64 vertex_indices\n"
                      b"end_header\n") % way
            points = struct.pack(order + "9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
            with open(self.path("model.ply"), "wb") as file:
                file.write(header + points + struct.pack(order + "Q3q", 3, 0, 1, 2))
            self.put("scene.json", json.dumps(SCENE | {"objects": [{"material": "pink", "obj": "model.ply"}]}))
            self.assertIn(b"1 of them triangles", self.run_program("check", "scene.json")[0])
            self.assertEqual(self.says(header + points + struct.pack(order + "Q3q", 3, 0, 1, -2)),
                             "model: face 1: vertex -2 does not exist; there are 3\n")

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
