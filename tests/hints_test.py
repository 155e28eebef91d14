#!/usr/bin/env python3
"""Hints: what `check` and `render` tell of scenes that are valid and hopeless, and that other scenes have none."""
import copy
import glob
import json
import os
import unittest

from support.program import CommandTest

HERE = os.getcwd()

BASE = {
    "camera": {"position": [0, 2, 6], "look_at": [0, 1, 0]},
    "screen": {"columns": 8, "rows": 6, "width": 1.2},
    "lights": [{"position": [3, 5, 4]}],
    "materials": {"a": {"ambient": [0.1, 0.1, 0.1], "diffuse": [0.6, 0.6, 0.6]}, "b": {"diffuse": [0.6, 0.1, 0.1]}},
    "objects": [
        {"name": "floor", "material": "a", "vertices": [[-3, 0, -3], [-3, 0, 3], [3, 0, 3], [3, 0, -3]],
         "faces": [[0, 1, 2, 3]]},
        {"name": "table", "material": "b", "box": {"min": [-1, 0, -1], "max": [1, 1, 1]}}]}


def quad(name, material, height, size):
    return {"name": name, "material": material, "faces": [[0, 1, 2, 3]],
            "vertices": [[-size, height, 0], [-size, height, size], [size, height, size], [size, height, 0]]}


class Hints(CommandTest):
    def hints_of(self, change, name="scene.json"):
        scene = copy.deepcopy(BASE)
        change(scene)
        self.put(name, json.dumps(scene))
        hints = json.loads(self.run_program("check", name, "--json")[0])["hints"]
        text = self.run_program("check", name)[0].decode()
        told = text.partition("\nhints\n")[2].splitlines()
        self.assertEqual([line.strip() for line in told], [hint["text"] for hint in hints])
        return [(hint["kind"], hint["text"]) for hint in hints]

    def rendered(self):
        """What each backend tells of scene.json: the same."""
        told = [self.run_program("render", "scene.json", "-b", backend, "-o", "x.png")[1].splitlines()[:-1]
                for backend in ("reference", "opencl")]
        self.assertEqual(*told)
        return told[0]

    def test_a_box_on_a_floor_in_a_room_has_none(self):
        self.assertEqual(self.hints_of(lambda scene: None), [])
        self.assertEqual(self.rendered(), [])
        room = {"name": "room", "material": "a", "box": {"min": [-8, 0, -8], "max": [8, 8, 8]}}
        against_the_wall = {"name": "box", "material": "b", "box": {"min": [-2, 0, -8], "max": [2, 2, -7]}}
        self.assertEqual(self.hints_of(lambda scene: scene["objects"].extend([room, against_the_wall])), [])

    def test_faces_in_one_plane_that_overlap(self):
        hints = self.hints_of(lambda scene: scene["objects"].append(quad("carpet", "b", 0, 2)))
        self.assertEqual(hints, [("same-plane", "faces 0, floor/0, and 7, carpet/0, overlap in one plane: the first is "
                                  "seen, or rounding decides")])
        for other in (quad("carpet", "a", 0, 2), quad("carpet", "b", 0.001, 2)):
            self.assertEqual(self.hints_of(lambda scene: scene["objects"].append(other)), [])
        beside = quad("beside", "b", 0, 3)
        beside["vertices"] = [[3, 0, -3], [3, 0, 3], [5, 0, 3], [5, 0, -3]]
        self.assertEqual(self.hints_of(lambda scene: scene["objects"].append(beside)), [])
        both = [quad("rug", "b", 0, 2), quad("carpet", "b", 0, 2)]
        self.assertIn("(the first of 2 such pairs)", self.hints_of(lambda scene: scene["objects"].extend(both))[0][1])

    def test_colours_to_255(self):
        hints = self.hints_of(lambda scene: scene["materials"]["b"].update(diffuse=[51, 90, 178]))
        self.assertEqual(hints, [("colour", 'material "b": diffuse [51, 90, 178] looks like 0 to 255, but 1 is full '
                                  "strength; divide by 255")])
        hints = self.hints_of(lambda scene: scene.update(shading={"background": [0, 128, 255]}))
        self.assertEqual(hints[0][1],
                         "the background [0, 128, 255] looks like 0 to 255, but 1 is full strength; divide by 255")
        self.assertEqual(self.hints_of(lambda scene: scene["materials"]["b"].update(diffuse=[1, 2, 3])), [])

    def test_a_light_in_a_box(self):
        hints = self.hints_of(lambda scene: scene["lights"].append({"position": [0, 0.5, 0]}))
        self.assertEqual(hints, [("light-in-box", 'light 1 at (0, 0.5, 0) is shut in the box "table"')])
        self.assertEqual(self.rendered(), [])
        hints = self.hints_of(lambda scene: scene["lights"][0].update(position=[0, 0.5, 0]))
        self.assertEqual([kind for kind, _ in hints], ["light-in-box", "black"])
        self.assertEqual(self.rendered(),
                         ["rectray: note: the picture is black: no light reaches what the camera sees"])
        self.assertEqual(self.run_program("render", "scene.json", "-q", "-b", "reference", "-o", "x.png")[1], "")
        one_sided = lambda scene: (scene["lights"][0].update(position=[0, 0.5, 0]),
                                   scene["objects"][1].update(sided="front"))
        self.assertEqual(self.hints_of(one_sided), [])

    def test_a_light_behind_every_face(self):
        below = lambda scene: (scene["objects"].pop(), scene["lights"][0].update(position=[1, -5, 0]))
        self.assertEqual([kind for kind, _ in self.hints_of(below)], ["light-behind", "black"])
        self.assertEqual(self.hints_of(lambda scene: scene["lights"][0].update(position=[1, -5, 9])), [])  # the front
        all_below = lambda scene: (below(scene), scene["camera"].update(position=[0, -2, 6], look_at=[0, -1, 0]))
        self.assertEqual(self.hints_of(all_below), [])

    def test_a_camera_that_sees_no_face(self):
        away = lambda scene: (scene["camera"].update(look_at=[0, 2, 12]),
                              scene.update(shading={"background": [0, 0, 1]}))
        self.assertEqual([kind for kind, _ in self.hints_of(away)], ["no-face-seen"])
        self.assertEqual(self.rendered(), ["rectray: note: the camera sees no face: all are behind it, beside the "
                                           "picture or edge on"])
        aside = lambda scene: scene["camera"].update(look_at=[6, 2, 5])
        self.assertEqual([kind for kind, _ in self.hints_of(aside)], ["no-face-seen", "black"])

    def test_everything_black(self):
        for change, why in ((lambda scene: scene.update(lights=[]), "there is no light"),
                            (lambda scene: scene.update(materials={"a": {}, "b": {}}), "no material has a colour")):
            self.assertEqual(self.hints_of(change), [("black", "the picture is black: " + why)])
            self.assertEqual(self.rendered(), ["rectray: note: the picture is black: " + why])

    def test_what_is_called_black_is_black(self):
        """In no scene of the tests `check` says so of a picture that has a colour."""
        for path in sorted(glob.glob(os.path.join(HERE, "tests/scenes/*.json"))):
            hints = json.loads(self.run_program("check", path, "--json")[0])["hints"]
            if any(hint["kind"] == "black" for hint in hints):
                self.run_program("render", path, "-q", "-b", "reference", "-o", "x.ppm")
                self.assertEqual(set(self.bytes_of("x.ppm").split(b"\n", 3)[3]), {0}, path)


if __name__ == "__main__":
    unittest.main()
