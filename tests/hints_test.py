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
    "screen": {"columns": 40, "rows": 30, "width": 1.2},
    "lights": [{"position": [3, 5, 4]}],
    "materials": {"a": {"ambient": [0.1, 0.1, 0.1], "diffuse": [0.6, 0.6, 0.6]}, "b": {"diffuse": [0.6, 0.1, 0.1]}},
    "objects": [
        {"name": "floor", "material": "a", "vertices": [[-3, 0, -3], [-3, 0, 3], [3, 0, 3], [3, 0, -3]],
         "faces": [[0, 1, 2, 3]]},
        {"name": "table", "material": "b", "box": {"min": [-1, 0, -1], "max": [1, 1, 1]}}]}


def quad(name, material, height, size):
    return {"name": name, "material": material, "faces": [[0, 1, 2, 3]],
            "vertices": [[-size, height, 0], [-size, height, size], [size, height, size], [size, height, 0]]}


CUBE = "".join(f"v {x} {y} {z}\n" for x in (-1, 1) for y in (0, 2) for z in (-1, 1)) + (
    "f 1 2 4\nf 1 4 3\nf 5 7 8\nf 5 8 6\nf 1 5 6\nf 1 6 2\nf 3 4 8\nf 3 8 7\nf 1 3 7\nf 1 7 5\nf 2 6 8\nf 2 8 4\n")


def walls(low, high):
    """A room of six objects."""
    quads = ((0, 2, 6, 4), (1, 3, 7, 5), (0, 1, 5, 4), (2, 3, 7, 6), (0, 1, 3, 2), (4, 5, 7, 6))
    corners = [[high if i >> axis & 1 else low for axis in range(3)] for i in range(8)]
    return [{"name": f"wall {i}", "material": "a", "vertices": [corners[k] for k in quad], "faces": [[0, 1, 2, 3]]}
            for i, quad in enumerate(quads)]


class Hints(CommandTest):
    def hints_of(self, change, name="scene.json"):
        """The kinds and texts; checks that the text has them with their places in the file."""
        scene = copy.deepcopy(BASE)
        change(scene)
        self.put(name, json.dumps(scene, indent=1))
        hints = json.loads(self.run_program("check", name, "--json")[0])["hints"]
        text = self.run_program("check", name)[0].decode()
        told = text.partition("\nhints\n")[2].splitlines()
        place = lambda hint: f"{name}:{hint['line']}:{hint['column']}: " if "line" in hint else ""
        self.assertEqual([line.strip() for line in told], [place(hint) + hint["text"] for hint in hints])
        self.paths = [hint.get("path") for hint in hints]
        return [(hint["kind"], hint["text"]) for hint in hints]

    def kinds_of(self, change):
        return [kind for kind, _ in self.hints_of(change)]

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

    def test_colours_of_lights_and_of_models(self):
        hints = self.hints_of(lambda scene: scene["lights"][0].update(diffuse=[255, 244, 200]))
        self.assertEqual(hints, [("colour", "light 0: diffuse [255, 244, 200] looks like 0 to 255, but 1 is full "
                                  "strength; divide by 255")])
        self.assertEqual(self.paths, ["lights[0].diffuse"])
        self.assertEqual(self.hints_of(lambda scene: scene["lights"][0].update(diffuse=[40.5, 40, 40])), [])
        self.assertEqual(self.hints_of(lambda scene: scene["lights"][0].update(diffuse=[10, 10, 10])), [])
        self.assertIn("specular [9, 255, 255]",
                      self.hints_of(lambda scene: scene["materials"]["b"].update(specular=[9, 255, 255]))[0][1])
        self.put("cube.mtl", "newmtl red\nKd 255 0 0\n")
        self.put("cube.obj", "mtllib cube.mtl\nusemtl red\n" + CUBE)
        hints = self.hints_of(lambda scene: scene.update(objects=[{"obj": "cube.obj"}]))
        self.assertEqual([hint[1][:43] for hint in hints], ['material "red": diffuse [255, 0, 0] looks l'])
        self.assertEqual(self.paths, [None])

    def test_a_light_in_a_box(self):
        hints = self.hints_of(lambda scene: scene["lights"].append({"position": [0, 0.5, 0]}))
        self.assertEqual(hints, [("light-in-box", 'light 1 at (0, 0.5, 0) is shut in the box "table"')])
        self.assertEqual(self.paths, ["lights[1].position"])
        self.assertEqual(self.rendered(), [])
        hints = self.hints_of(lambda scene: scene["lights"][0].update(position=[0, 0.5, 0]))
        self.assertEqual([kind for kind, _ in hints], ["light-in-box", "black"])
        self.assertEqual(self.rendered(),
                         ["rectray: note: the picture is black: no light reaches what the camera sees"])
        self.assertEqual(self.run_program("render", "scene.json", "-q", "-b", "reference", "-o", "x.png")[1], "")
        one_sided = lambda scene: (scene["lights"][0].update(position=[0, 0.5, 0]),
                                   scene["objects"][1].update(sided="front"))
        self.assertEqual(self.kinds_of(one_sided), ["light-hidden", "black"])  # rays enter the box, none leaves it

    def test_a_light_in_a_model(self):
        self.put("cube.obj", CUBE)
        lamp = {"name": "lamp", "material": "a", "obj": "cube.obj"}
        inside = lambda scene: (scene["objects"].pop(), scene["objects"].append(lamp),
                                scene["lights"][0].update(position=[0, 1, 0]))
        self.assertEqual(self.hints_of(inside)[0],
                         ("light-in-box", 'light 0 at (0, 1, 0) is shut in the closed object "lamp"'))
        self.put("cube.obj", CUBE.replace("f 1 2 4\n", "f 4 2 1\n"))  # wound the other way
        self.assertEqual(self.kinds_of(inside), ["light-in-box", "black"])
        self.put("cube.obj", CUBE.replace("f 3 8 7\n", ""))  # open on top
        self.assertEqual(self.kinds_of(inside), ["light-hidden", "black"])
        self.assertEqual(self.kinds_of(lambda scene: (inside(scene), scene["camera"].update(position=[0, 9, 1]))), [])

    def test_a_light_outside_the_room_that_the_camera_is_in(self):
        outside = lambda scene: scene["lights"][0].update(position=[0, 20, 0])
        room = {"name": "room", "material": "a", "box": {"min": [-8, 0, -8], "max": [8, 8, 8]}}
        hints = self.hints_of(lambda scene: (outside(scene), scene["objects"].append(room)))
        self.assertEqual(hints[0], ("light-out-of-box", 'light 0 at (0, 20, 0) is outside the box "room", and the '
                                    "camera is in it"))
        hints = self.hints_of(lambda scene: (outside(scene), scene.update(objects=walls(-8, 8))))
        self.assertEqual(hints[0], ("light-hidden", "light 0 at (0, 20, 0) reaches nothing that the camera sees: "
                                    "wall 3/0 is in the way"))
        self.assertEqual([kind for kind, _ in hints], ["light-hidden", "black"])
        self.assertEqual(self.hints_of(lambda scene: scene.update(objects=walls(-8, 8))), [])

    def test_a_light_behind_every_face(self):
        below = lambda scene: (scene["objects"].pop(), scene["lights"][0].update(position=[1, -5, 0]))
        self.assertEqual(self.kinds_of(below), ["light-behind", "black"])
        self.assertEqual(self.hints_of(lambda scene: scene["lights"][0].update(position=[1, -1, 9])), [])  # the front
        all_below = lambda scene: (below(scene), scene["camera"].update(position=[0, -2, 6], look_at=[0, -1, 0]))
        self.assertEqual(self.hints_of(all_below), [])

    def test_a_light_behind_a_box(self):
        self.put("cube.obj", CUBE)
        self.put("mixed.obj", CUBE.replace("f 1 2 4\n", "f 4 2 1\n"))
        models = [{"material": "a", "obj": name} for name in ("cube.obj", "mixed.obj")]
        for thing in (BASE["objects"][1], *models):
            below = lambda scene: (scene.update(objects=[thing]), scene["lights"][0].update(position=[0, -4, 0]),
                                   scene["camera"].update(position=[0, 3, 6]))
            self.assertEqual(self.kinds_of(below), ["light-behind", "black"])
            above = lambda scene: (below(scene), scene["lights"][0].update(position=[0, 4, 0]))
            self.assertEqual(self.hints_of(above), [])

    def test_a_model_on_a_floor_does_not_overlap_it(self):
        self.put("cube.obj", CUBE)
        cube = {"material": "b", "obj": "cube.obj"}
        self.assertEqual(self.hints_of(lambda scene: (scene["objects"].pop(), scene["objects"].append(cube))), [])

    def test_a_camera_that_sees_no_face(self):
        away = lambda scene: (scene["camera"].update(look_at=[0, 2, 12]),
                              scene.update(shading={"background": [0, 0, 1]}))
        self.assertEqual(self.kinds_of(away), ["no-face-seen"])
        self.assertEqual(self.rendered(), ["rectray: note: the camera sees no face: all are behind it, beside the "
                                           "picture or edge on; it is at (0, 2, 6) and looks at (0, 2, 12)"])
        aside = lambda scene: scene["camera"].update(look_at=[6, 2, 5])
        self.assertEqual(self.kinds_of(aside), ["no-face-seen", "black"])
        self.assertEqual(self.paths, ["camera.position"] * 2)
        corner = {"material": "a", "vertices": [[-9, 2.5, 0], [-2.5, 9, 0], [-9, 9, 0]], "faces": [[0, 1, 2]]}
        beside = lambda scene: (scene.update(objects=[corner]), scene["camera"].update(position=[0, 0, 6]))
        self.assertEqual(self.kinds_of(beside), ["no-face-seen", "black"])

    def test_a_scene_smaller_than_a_pixel(self):
        far = lambda scene: scene["camera"].update(position=[0, 2, 6e4])
        self.assertEqual(self.hints_of(far)[0], ("tiny", "all that the camera sees is less than a pixel wide or high: "
                                                 "it may be too far away; it is at (0, 2, 60000) and looks at "
                                                 "(0, 1, 0)"))
        self.assertIn("less than a pixel", self.rendered()[0])
        along = lambda scene: (scene["objects"].pop(), scene["camera"].update(position=[0, 0.001, 60]))
        self.assertEqual(self.kinds_of(along)[0], "tiny")
        near = lambda scene: scene["camera"].update(position=[0, 2, 12])
        self.assertEqual(self.hints_of(near), [])

    def test_everything_black(self):
        differ = "the materials reflect nothing of what the lights have: compare their colours"
        none, red, dark = [0, 0, 0], [1, 0, 0], [1e-4] * 3
        for change, why in ((lambda scene: scene.update(lights=[]), "there is no light"),
                            (lambda scene: scene.update(materials={"a": {}, "b": {}}), "no material has a colour"),
                            (lambda scene: scene["lights"][0].update(ambient=none, diffuse=none), differ),
                            (lambda scene: (scene["lights"][0].update(ambient=red, diffuse=red, specular=red),
                                            scene["materials"].update(a={"diffuse": [0, 1, 0]}, b={})), differ),
                            (lambda scene: scene["lights"][0].update(ambient=none, diffuse=none, specular=none),
                             "the colours of all lights are black"),
                            (lambda scene: scene["lights"][0].update(ambient=none, diffuse=dark),
                             "all colours are so dark that they are rounded to black; 1 is full strength")):
            self.assertEqual(self.hints_of(change), [("black", "the picture is black: " + why)])
            self.assertEqual(self.rendered(), ["rectray: note: the picture is black: " + why])

    def test_a_pipe_or_a_changed_scene_has_no_places(self):
        self.hints_of(lambda scene: scene.update(lights=[]))
        for words in (["--camera", "0,3,6"], ["--set", "screen.columns=9"]):
            text = self.run_program("check", "scene.json", *words)[0].decode()
            self.assertIn("\nhints\n  the picture is black: there is no light\n", text)

    def test_what_is_called_black_is_black(self):
        """In no scene of the tests `check` says so of a picture that has a colour."""
        for path in sorted(glob.glob(os.path.join(HERE, "tests/scenes/*.json"))):
            hints = json.loads(self.run_program("check", path, "--json")[0])["hints"]
            if any(hint["kind"] == "black" for hint in hints):
                self.run_program("render", path, "-q", "-b", "reference", "-o", "x.ppm")
                self.assertEqual(set(self.bytes_of("x.ppm").split(b"\n", 3)[3]), {0}, path)


if __name__ == "__main__":
    unittest.main()
