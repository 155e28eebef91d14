#!/usr/bin/env python3
"""Notes: what reading a scene has to say without refusing it, on standard error, in `check` and in its JSON."""
import json
import unittest

import jsonschema

from support.program import SCENE, CommandTest

with open("docs/check.schema.json", encoding="utf-8") as file:
    SCHEMA = json.load(file)
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)

MODEL = "v 1000 0 -1\nv 1001 0 -1\nv 1001 1 -1\nf 1 2 3\nl 1 2\nl 2 3\n"
NOTE = "model.obj:5: note: 2 lines without width are left out, the first at line 5\n"


class Notes(CommandTest):
    def setUp(self):
        super().setUp()
        self.put("model.obj", MODEL)
        self.put("noted.json", json.dumps(SCENE | {"objects": [{"material": "pink", "obj": "model.obj"}]}))

    def test_each_command_that_reads_a_scene_tells_them(self):
        self.put("rays", "1000.5 0.5 5 0 0 -1\n")
        for words in (["render", "-b", "reference", "-o", "x.png"], ["trace", "--pixel", "3,3"], ["tree"],
                      ["cast", "-b", "reference", "-r", "rays"], ["check"], ["check", "--geometry"]):
            with self.subTest(words):
                self.assertIn(NOTE, self.run_program(words[0], "noted.json", *words[1:])[1])

    def test_a_measurement_tells_them_once(self):
        for words in (["kernels", "noted.json"], ["error", "noted.json"]):
            with self.subTest(words):
                err = self.run_program("bench", *words, "--repeats=1", "--size=8x6")[1]
                self.assertEqual(err, "measuring noted\n" + NOTE)
                self.assertEqual(self.run_program("bench", *words, "--repeats=1", "--size=8x6", "-q")[1], "")

    def test_quiet_keeps_them_back(self):
        for command in ("check", "tree"):
            self.assertEqual(self.run_program(command, "noted.json", "-q")[1], "")

    def test_strict_makes_errors_of_them(self):
        out, err = self.run_program("check", "noted.json", "--strict", status=1)
        self.assertEqual(out, b"")
        self.assertEqual(err, NOTE.replace("note: ", "") + "Without --strict this is a note.\n")
        self.assertEqual(self.run_program("check", "noted.json", "--strict", "-q", status=1)[1], err)
        self.run_program("render", "noted.json", "--strict", "-o", "x.png", status=1)
        self.assertNotIn("x.png", self.files())
        self.run_program("check", "scene.json", "--strict")

    def test_verbose_tells_each_place(self):
        out, err = self.run_program("check", "noted.json", "-v")
        self.assertEqual(err, "".join(f"model.obj:{line}: note: a line without width is left out\n" for line in (5, 6)))
        self.assertIn(b"a valid scene", out)

    def test_a_note_of_one_place_has_no_number(self):
        self.put("model.obj", MODEL.replace("l 2 3\n", ""))
        self.assertEqual(self.run_program("check", "noted.json")[1],
                         "model.obj:5: note: a line without width is left out\n")


class Json(CommandTest):
    def document(self, *words, status=0):
        document = json.loads(self.run_program("check", *words, "--json", status=status)[0])
        VALIDATOR.validate(document)
        return document

    def test_the_schema_is_one(self):
        jsonschema.Draft202012Validator.check_schema(SCHEMA)

    def test_it_tells_what_the_text_tells(self):
        document = self.document("scene.json")
        self.assertTrue(document["valid"])
        self.assertEqual(document["notes"], [])
        self.assertEqual(document["holds"] | {"camera": 0, "centre": 0},
                         {"columns": 8, "rows": 6, "grid": 1, "adaptive": False, "camera": 0, "lights": 1, "parts": [],
                          "materials": 2, "objects": 2, "faces": 2, "faces_traced": 2, "triangles": 1, "one_sided": 1,
                          "reflecting": 0, "shadow": "black", "viewer": "camera", "max_bounces": 5, "centre": 0})
        self.assertEqual(document["holds"]["camera"], {"position": [1000.5, 0.5, 1], "look_at": [1000.5, 0.5, 0]})
        self.assertGreater(document["needs"]["memory_bytes"], 1e6)
        self.assertEqual(document["needs"] | {"memory_bytes": 0},
                         {"primary_rays": 48, "primary_rays_estimated_from": 0, "shadow_rays_of_a_point": 1,
                          "reflections_of_a_ray": 0, "memory_bytes": 0})
        self.assertEqual(document["can_skip"]["materials"], ["unused \"one\""])
        self.assertTrue(document["can_skip"]["reflected_rays"] and document["can_skip"]["specular"])

    def test_notes_have_their_places(self):
        self.put("model.obj", MODEL)
        self.put("noted.json", json.dumps(SCENE | {"objects": [{"material": "pink", "obj": "model.obj"}]}))
        note = {"kind": "lines", "file": "model.obj", "count": 2, "line": 5, "text": NOTE.split("note: ")[1].rstrip()}
        self.assertEqual(self.document("noted.json")["notes"], [note])
        places = [{"line": 5, "count": 1}, {"line": 6, "count": 1}]
        self.assertEqual(self.document("noted.json", "-v")["notes"], [note | {"places": places}])
        refused = self.document("noted.json", "--strict", status=1)
        self.assertIn("model.obj:5: 2 lines", refused["error"])

    def test_a_scene_that_is_refused_is_told_with_the_message(self):
        self.put("bad.json", "{}")
        out, err = self.run_program("check", "bad.json", "--json", status=1)
        document = json.loads(out)
        VALIDATOR.validate(document)
        self.assertEqual((document["valid"], document["error"]), (False, err.rstrip("\n")))

    def test_the_schema_refuses_what_it_does_not_describe(self):
        document = self.document("scene.json")
        for change in ({"valid": False}, {"more": 1}, {"holds": {}}, {"notes": [{"kind": "lines"}]}, {"check": 2}):
            self.assertFalse(VALIDATOR.is_valid(document | change), change)


if __name__ == "__main__":
    unittest.main()
