#!/usr/bin/env python3
"""`rectray trace` from outside: its JSON keeps to the schema and holds all that a pixel's colour is made of, its OBJ
and SVG are read back, and every mistake gets its message and its exit status."""
import base64
import fcntl
import glob
import json
import math
import os
import pty
import random
import re
import struct
import termios
import unittest
import xml.etree.ElementTree

import jsonschema

from support.program import PROGRAM, SOAK, CommandTest, png_pixels

HERE = os.getcwd()
SCENES = sorted(glob.glob(os.path.join(HERE, "tests/scenes/walkthrough/*.json")))


# --- Vectors ---

def add(a, b):
    return [x + y for x, y in zip(a, b)]


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def times(s, a):
    return [s * x for x in a]


def filtered(a, b):
    return [x * y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(a):
    length = math.sqrt(dot(a, a))
    return [x / length for x in a] if length > 0 else a


class Story:
    """Makes the colour anew from what the JSON says of camera, faces, lights and materials, and holds every sum,
    product and direction on the way against what it says of those."""

    def __init__(self, document, test):
        self.test = test
        self.scene = document["scene"]
        # positions are rounded in the file's coordinates
        self.close = max(1e-12, 1e-15 * max(map(abs, self.scene["centre"])))
        samples, self.told = [], False
        for event in document["events"]:
            handler = getattr(self, event["event"].replace(" ", "_"), None)
            if event["event"] == "sample":
                self.told = event["told"]
            if event["event"] == "path end":
                samples.append(self.total if self.told else event["colour"])
            if handler and (self.told or event["event"] == "pixel"):
                handler(event)
        average = [sum(sample[k] for sample in samples) / len(samples) for k in range(3)]
        self.rgb = [math.floor(255 * min(max(c, 0), 1) + 0.5) for c in average]
        self.near(average, document["events"][-1]["average"])
        test.assertEqual(len(samples), self.scene["grid"] ** (1 if self.scene["adaptive"] else 2))

    def near(self, a, b, tolerance=1e-9):
        for x, y in zip(a, b):
            self.test.assertLessEqual(abs(x - y), (tolerance + self.close * 1e3) * max(1, abs(y)))

    def sample(self, event):
        r = add(add(event["distance_f"], times(event["x"], self.scene["r"])), times(event["y"], self.scene["u"]))
        self.near(r, event["r"])
        self.near(minus(event["q"], event["c"]), event["r"])
        self.total, self.weight = [0, 0, 0], 1
        self.origin, self.direction = event["c"], event["r"]

    def hit(self, event):
        self.n, self.point, self.illumination = event["normal"], event["point"], [0, 0, 0]
        v = event["vertices"]
        self.v0 = v[0]
        last = v[3] if len(v) == 4 else v[0]
        a, b = minus(v[2], v[0]), minus(last, v[1])
        plane = unit([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])
        self.near(plane, event["plane_normal"], 1e-6)
        n = event["plane_normal"]
        self.near([dot(n, self.direction)], [event["n_dot_r"]])
        self.near([dot(n, minus(self.origin, v[0]))], [event["n_dot_o_plus_d"]], 1e-8)
        self.near([-event["n_dot_o_plus_d"] / event["n_dot_r"]], [event["t"]], 1e-7)
        self.near(add(self.origin, times(event["t"], self.direction)), self.point)
        for edge, value, sign in zip(event["edges"], event["edge_values"], event["edge_signs"]):
            e, c = edge["e"], edge["c"]
            cross = [e[1] * c[2] - e[2] * c[1], e[2] * c[0] - e[0] * c[2], e[0] * c[1] - e[1] * c[0]]
            self.near([dot(n, cross)], [value], 1e-7)
            self.test.assertEqual(sign, (value > 0) - (value < 0))
            self.test.assertGreaterEqual(sign, 0)

    def light(self, event):
        self.near(unit(minus(event["position"], self.point)), event["l"])
        self.near([dot(self.n, minus(event["position"], self.v0))], [event["height"]], 1e-6)
        self.near([dot(self.n, event["l"])], [event["n_dot_l"]], 1e-6)

    def terms(self, event):
        l, v, n = event["l"], event["v"], self.n
        to_camera = self.scene["viewer"] == "camera"
        viewer = minus(self.scene["camera"], self.point) if to_camera else times(-1, self.direction)
        self.near(unit(viewer), v)
        h = unit(add(l, v))
        shine = max(dot(n, h), 0) ** (event["shininess"] / 4)
        parts = [filtered(event["ka"], event["ia"])]
        if not event["ambient_only"]:
            parts.append(times(max(dot(l, n), 0), filtered(event["kd"], event["id"])))
            parts.append(times(shine, filtered(event["ks"], event["is"])))
        for part in parts:
            self.illumination = add(self.illumination, part)

    def shaded(self, event):
        self.near(self.illumination, event["illumination"])
        self.near([self.weight], [event["weight"]])
        self.total = add(self.total, times(self.weight, self.illumination))
        self.near(self.total, event["total"])

    def reflected(self, event):
        r = unit(self.direction)
        self.direction = minus(r, times(2 * dot(r, self.n), self.n))
        self.near(self.direction, event["direction"])
        self.direction, self.origin = event["direction"], event["origin"]
        self.weight *= event["reflection"]

    def miss(self, event):
        self.total = add(self.total, times(self.weight, self.scene["background"]))


class Json(CommandTest):
    @classmethod
    def setUpClass(cls):
        with open("docs/walkthrough.schema.json", encoding="utf-8") as file:
            schema = json.load(file)
        jsonschema.Draft202012Validator.check_schema(schema)
        cls.validator = jsonschema.Draft202012Validator(schema)

    def trace(self, scene, column, row, *words):
        out, _ = self.run_program("trace", scene, "--pixel", f"{column},{row}", "--format", "json", *words)
        return json.loads(out)

    def test_with_a_tree_it_keeps_to_the_schema_and_counts_its_nodes(self):
        for accel in ("bvh", "kdtree"):
            for scene in SCENES:
                document = self.trace(scene, 1, 1, "--accel", accel)
                self.validator.validate(document)
                tally, met = None, 0
                for event in document["events"] + [{"event": "tally"}]:
                    if event["event"] == "tally":
                        self.assertEqual(met, tally["nodes"]["met"] if tally and "nodes" in tally else 0)
                        tally, met = event, 0
                    met += event["event"] == "node"

    def test_the_json_alone_makes_the_pixel_of_the_picture(self):
        for scene in SCENES:
            self.run_program("render", scene, "--backend", "reference", "-o", "a.png", "--quiet")
            picture = png_pixels(self.bytes_of("a.png"))
            size = len(picture) * len(picture[0])
            for k in range(0, size, 1 + size // 40):
                row, column = divmod(k, len(picture[0]))
                with self.subTest(f"rectray trace {scene} --pixel {column},{row} --format json"):
                    document = self.trace(scene, column, row, *(["--verbose"] if k % 2 else []))
                    self.assertEqual(tuple(Story(document, self).rgb), picture[row][column])
                    self.assertEqual(tuple(document["events"][-1]["rgb"]), picture[row][column])

    def test_the_json_holds_all_that_a_colour_is_made_of_in_every_scene(self):
        grazing = {os.path.join(HERE, "tests/scenes/eye_on_a_plane.json")} # t is made of what rounding left
        for scene in sorted({*glob.glob(os.path.join(HERE, "tests/scenes/*.json"))} - grazing):
            with open(scene, encoding="utf-8") as file:
                screen = json.load(file)["screen"]
            columns, rows = int(screen["columns"]), int(screen["rows"])
            for k in range(columns * rows // 7, columns * rows, 1 + columns * rows // 3):
                row, column = divmod(k, columns)
                with self.subTest(f"rectray trace {scene} --pixel {column},{row} --format json"):
                    document = self.trace(scene, column, row)
                    self.assertEqual(Story(document, self).rgb, document["events"][-1]["rgb"])

    def test_it_keeps_to_the_schema(self):
        for scene in SCENES:
            for words in ((), ("--verbose", "--accel", "bvh"), ("--verbose", "--accel", "kdtree")):
                for pixel in ((0, 0), (1, 1), (10, 11)):
                    if pixel[0] > 1 and not re.search("black|ambient", scene):
                        continue
                    errors = list(self.validator.iter_errors(self.trace(scene, *pixel, *words)))
                    self.assertEqual([error.message for error in errors], [])

    def test_the_schema_refuses_what_it_does_not_describe(self):
        document = self.trace(SCENES[1], 3, 12, "--verbose", "--accel", "bvh")
        events = {event["event"]: event for event in document["events"]}
        self.assertGreater(len(events), 10)
        for kind, event in events.items():
            for change in ("none", "less", "more", "other"):
                broken = dict(event)
                if change == "less":
                    del broken["event"]
                if change == "more":
                    broken["no such member"] = 1
                if change == "other":
                    broken["event"] = "hits"
                some = {**document, "events": [document["events"][0], broken, document["events"][-1]]}
                self.assertEqual(self.validator.is_valid(some), change == "none", (kind, change))

    def test_every_number_keeps_17_digits(self):
        out, _ = self.run_program("trace", SCENES[0], "--pixel", "7,5", "--format", "json")
        numbers = re.findall(r"[-+]?\d+\.\d+(?:e[-+]?\d+)?", out.decode())
        self.assertGreater(len(numbers), 50)
        for number in numbers:
            self.assertEqual("%.17g" % float(number), number)


class Pieces(CommandTest):
    def test_a_cut_face_says_which_piece_is_hit(self):
        words = ("trace", os.path.join(HERE, "tests/scenes/polygons.json"), "--pixel", "20,12", "-q")
        self.assertIn("The nearest is piece 1 of 5 of face 0, wall with a window/0, material wall:",
                      " ".join(self.run_program(*words, "-v")[0].decode().split()))
        events = json.loads(self.run_program(*words, "--format", "json")[0])["events"]
        hit = next(event for event in events if event["event"] == "hit")
        self.assertEqual((hit["face"], hit["piece"], hit["pieces"]), (0, 1, 5))
        svg = self.run_program(*words, "--format", "svg")[0]
        self.assertIn(b">P1: piece 1 of 5 of face 0, wall with.../0, of wall, with weight 1<", svg)
        words = ("trace", os.path.join(HERE, "scenes/original.json"), "--pixel", "40,36", "--format", "json")
        self.assertNotIn(b'"piece"', self.run_program(*words)[0])


class Drawings(CommandTest):
    def test_the_obj_names_vertices_that_are_there(self):
        for scene in SCENES:
            out, _ = self.run_program("trace", scene, "--pixel", "1,1", "--format", "obj", "--with-scene")
            vertices, groups = 0, set()
            for line in out.decode().splitlines():
                word, _, rest = line.partition(" ")
                if word == "v":
                    self.assertTrue(all(math.isfinite(float(x)) for x in rest.split()))
                    self.assertEqual(len(rest.split()), 3)
                    vertices += 1
                elif word in ("l", "f"):
                    indices = [int(x) for x in rest.split()]
                    self.assertEqual(len(indices) == 2, word == "l")
                    self.assertTrue(all(1 <= k <= vertices for k in indices))
                elif word == "g":
                    groups.add(rest)
                else:
                    self.assertIn(word, ("#", "usemtl"))
            self.assertTrue(any(name.startswith("primary") for name in groups), groups)

    def test_the_obj_has_the_boxes_of_a_tree(self):
        for accel in ("bvh", "kdtree"):
            words = ("trace", SCENES[1], "--pixel", "3,12", "--accel", accel, "--format")
            lines = self.run_program(*words, "obj", "--with-scene")[0].decode().splitlines()
            nodes = [event for event in json.loads(self.run_program(*words, "json")[0])["events"]
                     if event["event"] == "node"]
            entered = {event["node"] for event in nodes if event["entered"]}
            passed = {event["node"] for event in nodes} - entered
            self.assertEqual(lines.count("g node_entered"), len(entered))
            self.assertEqual(lines.count("g node_passed"), len(passed))
            self.assertTrue(entered and passed)
            for line in lines:
                if line.startswith("g "):
                    self.assertEqual(len(line.split()), 2, line)
            at = next(k for k, line in enumerate(lines) if line.startswith("# node 0, "))
            corners = [[float(x) for x in line.split()[1:]] for line in lines[at + 1:at + 9]]
            root = next(event for event in nodes if event["node"] == 0)
            self.assertEqual((corners[0], corners[7]), (root["low"], root["high"]))

    def test_the_obj_shows_the_path_of_the_json(self):
        words = ("trace", SCENES[1], "--pixel", "3,12", "--format")
        out, _ = self.run_program(*words, "obj")
        events = json.loads(self.run_program(*words, "json")[0])["events"]
        lines = out.decode().splitlines()

        def ends(group):
            at = lines.index("g " + group)
            return [[float(x) for x in line.split()[1:]] for line in lines[at + 1:at + 3]]

        hits = [event for event in events if event["event"] == "hit"]
        self.assertGreater(len(hits), 1)
        self.assertEqual(ends("primary"), [events[0]["c"], hits[0]["point"]])
        self.assertEqual(ends("reflected_to_P2"), [hits[0]["shifted"], hits[1]["point"]])
        for k, hit in enumerate(hits, 1):
            self.assertEqual(ends(f"shifted_P{k}"), [hit["point"], hit["shifted"]])
            self.assertEqual(ends(f"normal_P{k}")[0], hit["point"])
        step = 0
        for i, event in enumerate(events):
            step = event.get("step", step)
            if event["event"] == "light end" and event["verdict"] != "behind face":
                light = [e for e in events[:i] if e["event"] == "light"][-1]
                blocked = "_blocked" if event["verdict"] == "blocked" else ""
                self.assertEqual(ends(f"shadow_P{step}_light_{event['light']}{blocked}"),
                                 [light["shadow_origin"], light["position"]])

    def test_the_scene_in_the_obj_is_the_scene(self):
        self.run_program("trace", SCENES[1], "--pixel", "1,1", "--format", "obj", "--with-scene", "-o", "scene.obj")
        with open(SCENES[1], encoding="utf-8") as file:
            scene = json.load(file)
        scene["objects"] = [{"name": "all", "material": "matt", "obj": "scene.obj"}]
        self.put("again.json", json.dumps(scene))

        def faces(path):
            rows = self.run_program("check", path, "--geometry")[0].decode().splitlines()
            return [re.findall(r"[-+]?0x\S+", row)[-12:] for row in rows if row.startswith("face ")]

        original = faces(SCENES[1])
        self.assertGreater(len(original), 5)
        self.assertEqual(faces("again.json"), original)

    def test_the_svg_is_well_formed_and_shows_two_titled_views(self):
        for scene in SCENES:
            for pixel in ("0,0", "1,1"):
                out, _ = self.run_program("trace", scene, "--pixel", pixel, "--format", "svg")
                root = xml.etree.ElementTree.fromstring(out)
                name = "{http://www.w3.org/2000/svg}"
                self.assertEqual(root.tag, name + "svg")
                titles = [e.text for e in root.iter(name + "text") if e.get("class") == "title"]
                self.assertEqual(len(set(titles)), 3)
                ticks = [e.text for e in root.iter(name + "text") if e.get("class") == "tick"]
                self.assertTrue(all(a != b for a, b in zip(ticks, ticks[1:])), ticks)  # also far from the origin
                self.assertTrue(all(title.startswith("seen from") for title in titles[:2]))
                self.assertTrue(titles[2].startswith("the picture on its screen"))
                labels = [e.text for e in root.iter(name + "text") if e.get("class") == "label"]
                self.assertTrue(any("C" in label for label in labels))
                self.assertNotIn(b"nan", out)

    def test_the_svg_says_names_in_xml(self):
        with open(self.path("scene.json"), encoding="utf-8") as file:
            scene = json.load(file)
        scene["objects"][0]["name"] = "<tile> & 'pane' \"1\""
        self.put("odd <&> name.json", json.dumps(scene))
        out, _ = self.run_program("trace", "odd <&> name.json", "--pixel", "4,3", "--format", "svg")
        text = " ".join(e.text or "" for e in xml.etree.ElementTree.fromstring(out).iter())
        self.assertIn("odd <&> name.json", text)
        self.assertIn("<tile> & 'pane' \"1\"/0", text)

    def test_the_svg_is_not_mirrored_against_the_picture(self):
        """A face on the left of the picture is on the left of the view from the front, wherever the camera looks."""
        for z, x in ((4, -1), (-4, 1)):  # along -z, -x is left; along +z, +x is
            tile = [[x - 0.2, -0.2, 0], [x + 0.2, -0.2, 0], [x + 0.2, 0.2, 0], [x - 0.2, 0.2, 0]]
            self.put("scene.json", json.dumps({
                "camera": {"position": [0, 0, z], "look_at": [0, 0, 0]},
                "screen": {"columns": 9, "rows": 9, "width": 1},
                "materials": {"m": {}}, "lights": [{"position": [0, 5, z]}],
                "objects": [{"material": "m", "vertices": tile, "faces": [[0, 1, 2, 3]]}]}))
            svg = self.run_program("trace", "scene.json", "--face", "objects[0]", "--format", "svg")[0].decode()
            root = xml.etree.ElementTree.fromstring(svg)
            labels = {}
            for e in root.iter("{http://www.w3.org/2000/svg}text"):
                if e.get("class") == "label":
                    labels.setdefault(e.text, float(e.get("x")))
            column = int(re.search(r"Pixel \((\d+)", svg)[1])
            self.assertLess(column, 4)
            titles = [e.text for e in root.iter("{http://www.w3.org/2000/svg}text") if e.get("class") == "title"]
            self.assertIn(titles[0], ("seen from above", "seen from the front"))
            self.assertLess(labels["P1"], labels["C"])

    def test_the_svg_shows_leaving_rays_lights_and_close_hits(self):
        original = os.path.join(HERE, "scenes/original.json")
        svg = self.run_program("trace", original, "--pixel", "40,36", "--format", "svg")[0].decode()
        self.assertIn(">out</text>", svg)
        self.assertIn("light 0</text>", svg)
        gallery = os.path.join(HERE, "scenes/gallery.json")
        svg = self.run_program("trace", gallery, "--pixel", "900,380", "--format", "svg")[0].decode()
        self.assertEqual(svg.count("class='frame'"), 5)
        self.assertEqual(svg.count("class='zoom'"), 2)
        self.assertIn("url(#to4)", svg)
        plain = self.run_program("trace", gallery, "--pixel", "965,320", "--format", "svg")[0].decode()
        self.assertEqual(plain.count("class='frame'"), 3)
        for light in range(3):
            self.assertIn(f"light {light}", plain)

    def test_the_picture_stands_on_its_screen(self):
        """The matrix places it on the screen's outline, not mirrored, and the point Q on its pixel."""
        original, gallery = (os.path.join(HERE, f"scenes/{name}.json") for name in ("original", "gallery"))
        for scene, pixel, as_in_svg in ((original, (13, 50), ()), (original, (70, 5), ()),
                                        (gallery, (900, 380), ("--size=128x72", "--grid=2"))):
            words = ("trace", scene, "--pixel", "%d,%d" % pixel, "--format")
            svg = self.run_program(*words, "svg")[0].decode()
            image = re.search(r"<image [^>]*matrix\(([^)]*)\)' href='data:image/png;base64,([^']*)'", svg)
            a, b, c, d, e, f = map(float, image[1].split())
            self.assertGreater(a * d - b * c, 0)
            self.assertGreater(min(a, d), 0)
            panel = svg[svg.index("the picture on its screen"):]
            outline = re.search(r"class='screen' d='M([^Z]*)Z", panel)[1]
            corners = [tuple(map(float, corner.split())) for corner in outline.split("L")]
            for corner, (x, y) in zip(corners, ((0, 0), (1, 0), (1, 1), (0, 1))):
                self.assertAlmostEqual(corner[0], a * x + c * y + e, delta=0.2)
                self.assertAlmostEqual(corner[1], b * x + d * y + f, delta=0.2)
            sample = json.loads(self.run_program(*words, "json")[0])["scene"]
            columns, rows = (sample[key] for key in ("columns", "rows"))
            x, y = (pixel[0] + 0.5) / columns, (pixel[1] + 0.5) / rows
            q = re.findall(r"<circle cx='([^']*)' cy='([^']*)'", panel)[1]  # after C
            self.assertAlmostEqual(float(q[0]), a * x + c * y + e, delta=0.5)
            self.assertAlmostEqual(float(q[1]), b * x + d * y + f, delta=0.5)
            self.run_program("render", scene, "-b", "reference", "-q", "-o", "a.png", *as_in_svg)
            self.assertEqual(png_pixels(base64.b64decode(image[2])), png_pixels(self.bytes_of("a.png")))

    def test_faces_that_rays_meet_are_whole_or_marked_where_they_are_cut(self):
        words = ("trace", os.path.join(HERE, "scenes/original.json"), "--pixel", "40,36", "--format", "svg")
        svg = self.run_program(*words)[0].decode()
        self.assertIn("goes on beyond", svg)  # the floor is 400 long
        zigzags = re.findall(r"class='hit cut' d='M([^']*)'", svg)
        for zigzag in zigzags[:-1]:  # the last one is the legend's
            points = [tuple(map(float, point.split())) for point in zigzag.split("L")]
            on_an_edge = [min(abs(x - 60), abs(x - 535), abs(x - 605), abs(x - 1080), abs(y - 90), abs(y - 500)) < 0.1
                          for x, y in points]
            self.assertTrue(all(on_an_edge[::2]), zigzag)
        self.assertGreater(len(zigzags), 3)
        scene = os.path.join(HERE, "scenes/gallery.json")
        svg = self.run_program("trace", scene, "--pixel", "965,320", "--format", "svg")[0].decode()
        self.assertNotIn(" cut'", svg.split("</style>", 2)[2])
        met = re.findall(r"class='(?:hit|blocker)' d='M([^Z]*)Z", svg)
        self.assertEqual(len(met), 6)  # two hits and the ceiling, in two views
        for face in met:
            for x, y in (map(float, point.split()) for point in face.split("L")):
                self.assertTrue(60 <= x <= 535 or 605 <= x <= 1080, face)
                self.assertTrue(90 <= y <= 500, face)

    def test_the_svg_draws_the_boxes_of_a_tree(self):
        words = ("trace", SCENES[1], "--pixel", "3,12", "--format")
        for accel in ("bvh", "kdtree"):
            events = json.loads(self.run_program(*words, "json", "-a", accel)[0])["events"]
            entered = {event["node"] for event in events if event["event"] == "node" and event["entered"]}
            passed = {event["node"] for event in events if event["event"] == "node"} - entered
            svg = self.run_program(*words, "svg", "-a", accel)[0].decode()
            views = svg.count("class='frame'") - 1  # the last one is the screen
            self.assertEqual(svg.count("<rect class='entered'"), views * len(entered))
            self.assertEqual(svg.count("<rect class='passed'"), views * len(passed))
        self.assertNotIn("<rect class='entered'", self.run_program(*words, "svg")[0].decode())

    def test_blocked_shadow_rays_are_dashed(self):
        for row in range(15):
            events = json.loads(self.run_program("trace", SCENES[1], "--pixel", f"8,{row}",
                                                 "--format", "json")[0])["events"]
            blocked = sum(event.get("verdict") == "blocked" for event in events)
            svg = self.run_program("trace", SCENES[1], "--pixel", f"8,{row}", "--format", "svg")[0].decode()
            self.assertEqual(svg.count("<path class='blocked' d='M"), 2 * blocked + 1)  # two views and the legend
        self.assertIn("stroke-dasharray", svg)


class Options(CommandTest):
    def test_the_scene_can_be_overridden_as_in_render(self):
        words = ("--size", "4x4", "--grid", "2", "--bounces", "0")
        self.render("-o", "a.png", *words)
        picture = png_pixels(self.bytes_of("a.png"))
        for sample in ("0,0", "1,1"):
            out, _ = self.run_program("trace", "scene.json", "--pixel", "2,1", "--sample", sample, *words)
            self.assertEqual(out.decode().splitlines()[-1], f"Pixel (2, 1) = {picture[1][2]}")
            self.assertIn(f"sample ({sample.replace(',', ', ')})", out.decode())

    def test_adaptive_sampling_tells_why_and_the_samples_that_count(self):
        words = ("--size", "16x12", "--sampling", "adaptive:3")
        self.run_program("render", SCENES[1], "-b", "reference", "-o", "a.png", *words)
        picture = png_pixels(self.bytes_of("a.png"))
        reasons = {}
        for pixel in range(192):
            column, row = pixel % 16, pixel // 16
            out, _ = self.run_program("trace", SCENES[1], "--pixel", f"{column},{row}", "--format", "json", *words)
            walk = json.loads(out)
            first = walk["events"][0]
            samples = [event for event in walk["events"] if event["event"] == "sample"]
            self.assertEqual(len(samples), 8 if first["refined"] else 1)
            self.assertEqual(tuple(walk["events"][-1]["rgb"]), picture[row][column])
            reasons[first["reason"]] = (column, row)
        self.assertLessEqual({"same", "edge"}, set(reasons))
        for reason, sample, words_told in (("same", "1,2", "which alone makes the pixel"),
                                           ("edge", "1,5", "needs more than the ray through its centre")):
            column, row = reasons[reason]
            out, _ = self.run_program("trace", SCENES[1], "--pixel", f"{column},{row}", "--sample", sample, *words)
            self.assertIn(words_told, " ".join(out.decode().split()))
            self.assertEqual(out.decode().splitlines()[-1], f"Pixel ({column}, {row}) = {picture[row][column]}")

    def test_adaptive_sampling_names_the_face_and_the_light(self):
        """A tile before a wall: its border passes through pixels whose centres are on the wall, its shadow is left of
        it."""
        def square(name, half, z):
            return {"name": name, "material": "red", "faces": [[0, 1, 2, 3]],
                    "vertices": [[-half, -half, z], [half, -half, z], [half, half, z], [-half, half, z]]}
        material = {"ambient": [0.1, 0, 0], "diffuse": [0.7, 0, 0], "specular": [1, 1, 1], "shininess": 400}
        self.put("scene.json", json.dumps({
            "camera": {"position": [0, 0, 4], "look_at": [0, 0, 0]}, "screen": {"columns": 16, "rows": 12},
            "lights": [{"position": [2, 3, 3]}], "materials": {"red": material},
            "objects": [square("wall", 9, -1), square("tile", 0.45, 0)]}))
        for pixel, why in (("7,5", "an edge of the face tile/0, which the centre meets at P1, may cross it"),
                           ("5,7", "at P1 the shadow of tile/0 in light 0 may end in it"),
                           ("0,0", "at P1 the brightness by light 0 changes unevenly over it")):
            out = self.run_program("trace", "scene.json", "--pixel", pixel, "--sampling", "adaptive:2")[0].decode()
            self.assertIn(f"needs more than the ray through its centre: {why}.", " ".join(out.split()))
        self.put("scene.json", self.bytes_of("scene.json").decode().replace("0.45", "0.6"))
        out = self.run_program("trace", "scene.json", "--pixel", "6,5", "--sampling", "adaptive:2")[0].decode()
        self.assertIn("another face, tile/0, may show in it, which the centre passes before P1.", " ".join(out.split()))

    def test_marks_at_one_place_share_a_label(self):
        """A ray that two mirrors send to and fro."""
        def wall(name, z):
            return {"name": name, "material": "m", "faces": [[0, 1, 2, 3]],
                    "vertices": [[-9, -9, z], [9, -9, z], [9, 9, z], [-9, 9, z]]}
        self.put("scene.json", json.dumps({
            "camera": {"position": [0, 0, 1], "look_at": [0, 0, 0]}, "screen": {"columns": 3, "rows": 3},
            "lights": [{"position": [0.2, 0.3, 1]}], "materials": {"m": {"diffuse": [0.7, 0, 0], "reflection": 0.9}},
            "objects": [wall("back", 0), wall("front", 2)]}))
        for bounces, labels in (("4", ["P1, P3, P5", "P2, P4"]),
                                ("40", ["P1, P3, P5, P7, P9...", "P2, P4, P6, P8, P10..."])):
            svg = self.run_program("trace", "scene.json", "--pixel", "1,1", "--format", "svg",
                                   "--bounces", bounces)[0].decode()
            for label in labels:
                views = svg.split("the picture on its screen")[0]
                self.assertEqual(views.count(f">{label}</text>"), 2, label) # in either view

    def test_a_sample_that_adaptive_sampling_left_out_is_refused(self):
        words = ("--size", "160x90", "--sampling", "adaptive:6")
        gallery = os.path.abspath("scenes/gallery.json")
        refined = None
        for column in range(0, 160, 3):
            out, _ = self.run_program("trace", gallery, "--pixel", f"{column},70", "--format", "json", *words)
            events = json.loads(out)["events"]
            taken = [(event["i"], event["j"]) for event in events if event["event"] == "sample"]
            if len(taken) > 1: # each column has one, and so has each row
                self.assertEqual([i for i, _ in taken], list(range(16)))
                self.assertEqual(sorted(j for _, j in taken), list(range(16)))
                refined = column
        pixel = ("trace", gallery, "--pixel", f"{refined},70", *words)
        _, err = self.run_program(*pixel, "--sample", "1,0", status=2)
        self.assertIn(f"--sample 1,0: adaptive sampling traces one sample in each column of pixel {refined},70, "
                      "in column 1 that of row 13", err)
        out, _ = self.run_program(*pixel, "--sample", "1,13")
        self.assertIn("the average of 16 samples, one in each column and each row of a grid of 16 x 16",
                      " ".join(out.decode().split()))

    def test_verbose_lists_every_face(self):
        out, _ = self.run_program("trace", SCENES[1], "--pixel", "3,12", "--verbose")
        short, _ = self.run_program("trace", SCENES[1], "--pixel", "3,12")
        self.assertGreater(len(out.splitlines()), len(short.splitlines()) + 150)
        for verdict in ("behind", "outside edge", "beyond light", "nearest", "left by ray"):
            self.assertIn(verdict, out.decode())

    def test_a_tree_is_told_where_one_is_asked_for(self):
        for accel in ("bvh", "kdtree"):
            out, _ = self.run_program("trace", SCENES[1], "--pixel", "3,12", "--accel", accel)
            self.assertIn("tree nodes whose boxes are tested", " ".join(out.decode().split()))
            every, _ = self.run_program("trace", SCENES[1], "--pixel", "3,12", "--accel", accel, "--verbose")
            self.assertRegex(every.decode(), r"node \d+: entered, from t = [^;]*;[^;]*\sa\sleaf\sof\s\d+\sface")
            self.assertRegex(every.decode(), r"node \d+: missed: leaves [xyz] at t =\s\S+, enters [xyz] at t =")
            plain, _ = self.run_program("trace", SCENES[1], "--pixel", "3,12")
            self.assertEqual(out.splitlines()[-1], plain.splitlines()[-1])
            self.assertNotIn("node", plain.decode())

    def test_a_file_gets_what_standard_output_would(self):
        for form in ("text", "json", "obj", "svg"):
            out, err = self.run_program("trace", "scene.json", "--pixel", "4,3", "--format", form)
            self.assertEqual(err, "")
            self.run_program("trace", "scene.json", "--pixel", "4,3", "-f", form, "-o", "walk")
            self.assertEqual(self.bytes_of("walk"), out)

    def test_colour_is_for_terminals_that_want_it(self):
        self.assertIn(b"\033[", self.on_terminal(TERM="xterm"))
        self.assertIn(b"\033[", self.on_terminal(TERM="xterm", NO_COLOR=""))
        self.assertNotIn(b"\033", self.on_terminal(TERM="xterm", NO_COLOR="1"))
        self.assertNotIn(b"\033", self.on_terminal(TERM="dumb"))
        self.assertNotIn(b"\033", self.run_program("trace", "scene.json", "--pixel", "4,3")[0])
        self.assertIn(b"\033[48;5;", self.on_terminal(TERM="xterm", COLORTERM=""))
        self.assertIn(b"\033[48;2;", self.on_terminal(TERM="xterm", COLORTERM="truecolor"))

    def test_colour_can_be_asked_for_and_refused(self):
        self.assertIn(b"\033[", self.run_program("trace", "scene.json", "--pixel", "4,3", "--color", "always")[0])
        self.assertNotIn(b"\033", self.on_terminal("--color=never", TERM="xterm"))

    def on_terminal(self, *words, size=(0, 0), **changes):
        """What a terminal of that many rows and columns shows; 0 rows: it does not say."""
        environment = {key: value for key, value in os.environ.items()
                       if key not in ("NO_COLOR", "TERM", "COLORTERM", "PAGER", "LESS")}
        master, slave = pty.openpty()
        fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", *size, 0, 0))
        process = self.start("trace", "scene.json", "--pixel", "4,3", *words, stdout=slave,
                             env={**environment, **changes})
        os.close(slave)
        out = b""
        while True:
            try:
                block = os.read(master, 65536)
            except OSError:  # Linux: the other end is closed
                break
            if not block:
                break
            out += block
        os.close(master)
        process.stderr.close()
        self.assertEqual(process.wait(), 0)
        return out

    def test_a_long_text_goes_through_the_pager_of_a_low_terminal(self):
        paged = "sed s/^/PAGED/"
        low, high = (24, 80), (400, 80)
        self.assertIn(b"PAGED\033[1mPixel (4, 3)", self.on_terminal(size=low, PAGER=paged, TERM="xterm"))
        for words, size, pager in (((), high, paged), (("--no-pager",), low, paged), (("--summary",), low, paged),
                                   ((), (0, 0), paged), ((), low, ""), ((), low, "cat"),
                                   ((), low, "a-pager-that-is-not-there 2>/dev/null")):
            out = self.on_terminal(*words, size=size, PAGER=pager, TERM="xterm")
            self.assertNotIn(b"PAGED", out)
            self.assertIn(b"Pixel (4, 3) = ", out)
        out, _ = self.run_program("trace", "scene.json", "--pixel", "4,3", env={**os.environ, "PAGER": paged})
        self.assertNotIn(b"PAGED", out)

    def test_lines_are_as_wide_as_the_terminal_or_as_asked_for(self):
        def widest(out):
            return max(map(len, out.decode().splitlines()))
        self.assertLessEqual(widest(self.on_terminal(size=(400, 80), TERM="dumb")), 80)
        self.assertLessEqual(widest(self.on_terminal(size=(400, 40), TERM="dumb")), 80)
        self.assertIn(widest(self.on_terminal(size=(400, 130), TERM="dumb")), range(101, 131))
        self.assertIn(widest(self.on_terminal("--width", "90", size=(400, 130), TERM="dumb")), range(81, 91))
        for words, columns in (((), 100), (("--width=80",), 80), (("--width=160",), 160)):
            out, _ = self.run_program("trace", "scene.json", "--pixel", "4,3", *words)
            self.assertLessEqual(widest(out), columns)
        out, _ = self.run_program("trace", "scene.json", "--pixel", "4,3", "--width", "79", status=2)

    def test_the_summary_says_of_each_light_what_the_events_do(self):
        for name, pixels in (("cornell", ("238,370", "162,441")), ("gallery", ("900,380", "766,423"))):
            for pixel in pixels:
                scene = os.path.join(HERE, f"scenes/{name}.json")
                document = json.loads(self.run_program("trace", scene, "--pixel", pixel, "-f", "json")[0])
                ends = [event for event in document["events"] if event["event"] == "light end"]
                said = [light for hit in document["summary"]["hits"] for light in hit["lights"]]
                self.assertEqual([(light["light"], light["verdict"]) for light in said],
                                 [(end["light"], end["verdict"]) for end in ends])
                faces = [light["blocker"] for light in said if light["verdict"] == "blocked"]
                self.assertEqual(faces, [f"{end['object']}/{end['face_in_object']}" for end in ends
                                         if end["verdict"] == "blocked"])
                self.assertTrue(faces)

    def test_no_word_of_a_real_scene_is_broken_at_any_width(self):
        """The words of 80, 100 and 120 columns are those of 160. Names in tables may be cut, and then end in dots."""
        def words_of(text):
            return {word for word in text.split() if re.search("[a-z]", word) and "..." not in word
                    and not re.search(r"\d", word)}
        for name, pixels in (("original", ("40,36", "70,3")), ("cornell", ("162,441", "300,100")),
                             ("gallery", ("900,380", "965,320")), ("mirrors", ("320,180",))):
            scene = os.path.join(HERE, f"scenes/{name}.json")
            for pixel in pixels:
                for more in ((), ("--accel=kdtree", "--verbose"), ("--arithmetic=textbook", "--grid=1")):
                    texts = {width: self.run_program("trace", scene, "--pixel", pixel, f"--width={width}", *more)[0]
                             .decode() for width in (80, 100, 120, 160)}
                    for width, text in texts.items():
                        with self.subTest(f"rectray trace {scene} --pixel {pixel} --width {width} {' '.join(more)}"):
                            self.assertLessEqual(max(map(len, text.splitlines())), width)
                            self.assertEqual(words_of(text) - words_of(texts[160]), set())

    def test_the_summary_has_names_whole_where_there_is_room(self):
        scene = os.path.join(HERE, "scenes/gallery.json")
        for width in (80, 100, 160):
            out = self.run_program("trace", scene, "--pixel", "802,403", "--summary", f"--width={width}")[0].decode()
            lines = out.splitlines()
            self.assertLessEqual(len(lines), 20)
            self.assertLessEqual(max(map(len, lines)), width)
            self.assertNotIn("...", out)
            self.assertIn("camera -> P1 star/30 -> P2 mirror/0 -> P3 mirror: frame/8", lines)
            self.assertEqual(" ".join(out.split()).count("light 1 blocked by plinth of the star/1"), 2)
        out = self.run_program("trace", scene, "--pixel", "67,54", "--size=96x72", "--summary", "--width=80")[0]
        self.assertIn("\nP3  plinth of the star/1  1.085 ", out.decode())

    def test_long_names_are_cut_between_characters(self):
        with open(os.path.join(HERE, "scenes/original.json"), encoding="utf-8") as file:
            document = json.load(file)
        for object_, name in zip(document["objects"], ("\u7acb\u65b9\u4f53" * 11, "\u5e8a" * 60, "\U0001f4d0" * 60)):
            object_["name"] = name
        self.put("named.json", json.dumps(document))
        for pixel in ("40,36", "70,3"):
            for width in (80, 160):
                out = self.run_program("trace", "named.json", "--pixel", pixel, f"--width={width}")[0].decode()
                self.assertLessEqual(out.splitlines().index("Step by step"), 22)

    def test_the_summary_is_short_and_ends_with_the_bytes_of_the_picture(self):
        """Of pixels all over three scenes; with RECTRAY_SOAK of a thousand."""
        longest = 0
        for name, count in (("original", 40), ("cornell", 12), ("gallery", 12)):
            scene = os.path.join(HERE, f"scenes/{name}.json")
            words = ("--size", "160x120")
            self.run_program("render", scene, "-b", "reference", "-o", "a.png", "-q", *words)
            picture = png_pixels(self.bytes_of("a.png"))
            chosen = random.Random(name)
            for _ in range(count * (16 if SOAK else 1)):
                column, row = chosen.randrange(160), chosen.randrange(120)
                out = self.run_program("trace", scene, "--pixel", f"{column},{row}", "--summary", "--width=80",
                                       *words)[0].decode()
                lines = out.splitlines()
                longest = max(longest, len(lines))
                self.assertTrue(lines[0].startswith(f"Pixel ({column}, {row}) of "))
                self.assertEqual(lines[-1], f"Pixel ({column}, {row}) = {picture[row][column]}")
                around = [tuple(map(int, bytes_)) for bytes_ in
                          re.findall(r"\((\d+), (\d+), (\d+)\)", "\n".join(lines[1:lines.index("")]))]
                self.assertEqual(around, [picture[y][x] for y in range(row - 1, row + 2)
                                          for x in range(column - 1, column + 2) if 0 <= x < 160 and 0 <= y < 120])
                whole = self.run_program("trace", scene, "--pixel", f"{column},{row}", "--width=80", *words)[0]
                self.assertTrue(whole.decode().startswith(out))
        self.assertLessEqual(longest, 20)


class Choosing(CommandTest):
    SCENE = os.path.join(HERE, "scenes/gallery.json")

    def found(self, *words, scene=None):
        """The pixel that a search finds, and its summary."""
        out, err = self.run_program("trace", scene or self.SCENE, "--summary", "--format", "json", *words)
        column, row = map(int, re.match(r"rectray: --pixel (\d+),(\d+) shows it\n$", err).groups())
        document = json.loads(out)
        self.assertEqual((document["pixel"]["column"], document["pixel"]["row"]), (column, row))
        return document["summary"]

    def test_a_face_is_found_directly_or_in_a_mirror(self):
        small = ("--size", "160x90")
        self.assertEqual(self.found("--face", "far wall/0", *small)["hits"][0]["face"], "far wall/0")
        self.assertTrue(self.found("--face", "star", *small)["hits"][0]["face"].startswith("star/"))
        faces = [hit["face"] for hit in self.found("--face", "star/32", *small)["hits"]]
        self.assertIn("star/32", faces[1:])

    def test_a_blocked_light_a_mirror_and_the_dark_are_found(self):
        small = ("--size", "160x90", "--sampling", "uniform:1")
        for light in range(3):
            summary = self.found("--light-blocked", str(light), *small)
            self.assertEqual(summary["hits"][0]["lights"][light]["verdict"], "blocked")
        self.assertGreaterEqual(len(self.found("--mirror-depth", "2", *small)["hits"]), 3)
        both = self.found("--light-blocked", "0", "--mirror-depth", "2", *small)
        self.assertEqual(both["hits"][0]["lights"][0]["verdict"], "blocked")
        self.run_program("render", self.SCENE, "-b", "reference", "-o", "a.png", "-q", *small)
        least = min(sum(pixel) for line in png_pixels(self.bytes_of("a.png")) for pixel in line)
        self.assertLessEqual(sum(self.found("--darkest", *small)["rgb"]), least + 2)

    def test_no_neighbour_of_the_darkest_is_darker(self):
        """Also in a picture that is searched in steps, whose pixels at edges are the average of several rays."""
        for words in ((), ("--face", "star")):
            out, _ = self.run_program("trace", self.SCENE, "--summary", "--darkest", *words)
            title, *rows = out.decode().split("\n\n")[0].splitlines()
            around = [sum(map(int, bytes_)) for bytes_ in re.findall(r"\((\d+), (\d+), (\d+)\)", "\n".join(rows))]
            self.assertEqual(len(around), 9)
            if not words:  # a neighbour of the star's may show something else
                self.assertGreaterEqual(min(around), around[4] - 1)
            self.assertLess(around[4], 170)

    def test_what_is_nowhere_is_told(self):
        small = ("trace", self.SCENE, "--size", "64x36")
        for message, *words in (("no object has that name; `rectray check`", "--face", "nobody/3"),
                                ("no object has that name; did you mean 'far wall'?", "--face", "fare wall/0"),
                                ("no object has that name; did you mean 'stripes: frame'?", "--face", "stripes: fram"),
                                ("the last face of that object is 0", "--face", "far wall/99"),
                                ("the last face of that object is 0", "--face", "far wall/99999999999999999999"),
                                ("the scene has 3 lights", "--light-blocked", "3"),
                                ("no pixel shows that", "--mirror-depth", "60"),
                                ("look for one", "--darkest", "--pixel", "1,1")):
            self.assertIn(message, self.run_program(*small, *words, status=2)[1])

    def test_a_face_after_others_that_are_left_out_keeps_its_number(self):
        with open(os.path.join(HERE, "scenes/original.json"), encoding="utf-8") as file:
            document = json.load(file)
        document["objects"] = [{"name": "m", "material": "purple", "obj": "m.obj"}]
        self.put("m.json", json.dumps(document))
        self.put("m.obj", "v -3 3 4\nv 3 3 4\nv 3 8 4\nv -3 8 4\n" + "f 1 1 2\n" * 5 + "f 1 2 3 4\n")
        words = ("trace", "m.json", "--summary", "--face")
        self.assertIn("camera -> P1 m/5", self.run_program(*words, "m/5")[0].decode())
        self.assertIn("no pixel shows that", self.run_program(*words, "m/4", status=2)[1])
        self.assertIn("the last face of that object is 5", self.run_program(*words, "m/6", status=2)[1])

    def test_several_pixels_are_told_one_after_another(self):
        one = [self.run_program("trace", "scene.json", "--pixel", pixel)[0] for pixel in ("4,3", "1,2")]
        both, _ = self.run_program("trace", "scene.json", "--pixel", "4,3", "--pixel", "1,2")
        self.assertEqual(both, b"\n".join(one))
        out, _ = self.run_program("trace", "scene.json", "--pixel", "4,3", "--pixel", "1,2", "-f", "json")
        told = [(walk["pixel"]["column"], walk["pixel"]["row"]) for walk in json.loads(out)]
        self.assertEqual(told, [(4, 3), (1, 2)])
        for form in ("svg", "obj"):
            self.assertIn("shows one pixel", self.run_program("trace", "scene.json", "--pixel", "4,3", "--pixel", "1,2",
                                                              "-f", form, status=2)[1])

    def test_a_difference_tells_where_the_paths_part(self):
        original = os.path.join(HERE, "scenes/original.json")

        def diff(*pixels, scene=original):
            words = [word for pixel in pixels for word in ("--pixel", pixel)]
            return self.run_program("trace", scene, *words, "--diff", "--width=80")[0].decode()
        out = diff("40,36", "42,36")
        self.assertIn("They part at P2: the first one hits cube1/4, the second one leaves the scene.", out)
        self.assertRegex(out, r"bytes +\(97, 74, 97\) +\(67, 67, 67\)")
        self.assertNotRegex(out, "(?m)^P1 light 0  ")
        self.assertLessEqual(max(map(len, out.splitlines())), 80)
        self.assertIn("They take the same path, and the same lights reach it.", diff("40,36", "40,36"))
        self.assertEqual(len(diff("40,36", "40,36").splitlines()), 3)
        self.assertEqual(diff("40,36", "42,36", "0,0").count("They part at"), 2)
        events = [json.loads(self.run_program("trace", original, "--pixel", pixel, "-f", "json")[0])["events"]
                  for pixel in ("40,36", "42,36")]
        rows = [re.split("  +", row) for row in out.splitlines()[3:]]
        q = [next(event["q"] for event in side if event["event"] == "sample") for side in events]
        self.assertEqual(rows[0], ["Q", *("(" + ", ".join(f"{x:.4g}" for x in side) + ")" for side in q)])
        hits = [[event for event in side if event["event"] == "hit"] for side in events]
        points = ["(" + ", ".join(f"{x:.4g}" for x in side[0]["point"]) + ")" for side in hits]
        self.assertIn(["P1 at", *points], rows)
        self.assertNotIn("P1", [row[0] for row in rows])  # the same face
        self.assertIn(["P2", "cube1/4", "none: out of the scene"], rows)
        self.assertIn(["P2 light 0", "reaches it", "-"], rows)
        self.assertTrue(all(a != b for _, a, b in rows))
        lights = diff("300,300", "256,470", scene=os.path.join(HERE, "scenes/cornell.json"))
        self.assertIn("They part at", lights)
        for words in (("--pixel", "1,1"), ("--pixel", "1,1", "--pixel", "2,2", "-f", "json")):
            _, err = self.run_program("trace", original, "--diff", *words, status=2)
            self.assertIn("--diff needs --pixel twice", err)


class Rounding(CommandTest):
    """`--arithmetic textbook`: what textbook arithmetic finds, beside what is exactly so."""
    TEXTBOOK = ("--arithmetic", "textbook")
    UNIFORM = ("--sampling", "uniform")
    LESSONS = sorted(glob.glob(os.path.join(HERE, "scenes/lessons/*.json")))

    @classmethod
    def setUpClass(cls):
        with open("docs/rounding.schema.json", encoding="utf-8") as file:
            schema = json.load(file)
        jsonschema.Draft202012Validator.check_schema(schema)
        cls.validator = jsonschema.Draft202012Validator(schema)

    def trace(self, scene, column, row, *words):
        out, _ = self.run_program("trace", scene, "--pixel", f"{column},{row}", *self.TEXTBOOK, "-f", "json", *words)
        document = json.loads(out)
        self.validator.validate(document)
        return document

    def pictures(self, scene, precision):
        for name, words in (("exact.png", ()), ("textbook.png", (*self.TEXTBOOK, "--precision", precision))):
            self.run_program("render", scene, "-b", "reference", "-q", "-o", name, *self.UNIFORM, *words)
        return png_pixels(self.bytes_of("textbook.png")), png_pixels(self.bytes_of("exact.png"))

    def test_both_bytes_are_those_of_the_pictures_and_a_part_explains_the_difference(self):
        chosen = random.Random(7)
        for scene in self.LESSONS + SCENES:
            for precision in ("float", "double"):
                textbook, exact = self.pictures(scene, precision)
                places = [(x, y) for y in range(len(exact)) for x in range(len(exact[0]))]
                apart = [(x, y) for x, y in places if textbook[y][x] != exact[y][x]]
                for x, y in chosen.sample(places, 3) + chosen.sample(apart, min(4, len(apart))):
                    with self.subTest(scene=scene, precision=precision, pixel=(x, y)):
                        document = self.trace(scene, x, y, "--precision", precision, *self.UNIFORM)
                        self.assertEqual(tuple(document["textbook"]["rgb"]), textbook[y][x])
                        self.assertEqual(tuple(document["exact"]["rgb"]), exact[y][x])
                        if scene in self.LESSONS and max(abs(a - b) for a, b in zip(textbook[y][x], exact[y][x])) > 8:
                            self.assertIn("part", document)
                        self.told(document, scene, precision)

    def told(self, document, scene, precision):
        """The place where they part is the first one where the lists differ."""
        found, right = document["textbook"]["hits"], document["exact"]["hits"]
        part = None
        for k, (a, b) in enumerate(zip(found, right)):
            lights = [i for i, (x, y) in enumerate(zip(a.get("lights", []), b.get("lights", [])))
                      if x["verdict"] != y["verdict"]]
            if a["face"] != b["face"]:
                part = (k + 1, None)
            elif lights:
                part = (k + 1, lights[0])
            if part:
                break
        told = document.get("part")
        self.assertEqual((told["hit"], told.get("light")) if told else None, part)
        text, _ = self.run_program("trace", scene, "--pixel", f"{document['column']},{document['row']}",
                                   *self.TEXTBOOK, "--precision", precision, *self.UNIFORM)
        words = " ".join(text.decode().split())
        for key in ("textbook", "exact") if told else ():
            self.assertIn(" ".join(told[key].split()), words)
        self.assertEqual("Here the two part." in words, bool(told))

    def test_double_shows_hardly_any_fault_where_float_shows_many(self):
        scene = os.path.join(HERE, "scenes/lessons/acne.json")
        self.assertIn("part", self.trace(scene, 95, 151))
        self.assertNotIn("part", self.trace(scene, 95, 151, "--precision", "double"))

    def test_a_larger_shift_cures_acne_and_its_height_is_told(self):
        scene = os.path.join(HERE, "scenes/lessons/acne.json")
        hit = self.trace(scene, 95, 151, "--shift", "0.01")["textbook"]["hits"][0]
        self.assertEqual(hit["lights"][0]["verdict"], "reaches")
        self.assertAlmostEqual(hit["above"], 0.01, delta=1e-4)

    def test_the_steps_have_the_numbers_of_the_exact_walkthrough(self):
        words = ("trace", os.path.join(HERE, "scenes/original.json"), "--pixel", "40,36")
        exact, textbook = (self.run_program(*words, *more)[0].decode() for more in ((), self.TEXTBOOK))
        steps = re.findall(r"(?m)^Step \d.*", textbook)
        self.assertEqual(len(steps), 11)
        self.assertEqual(steps, re.findall(r"(?m)^Step \d.*", exact))

    def test_every_step_has_the_textbook_s_numbers_and_the_exact_ones(self):
        words = ("trace", os.path.join(HERE, "scenes/lessons/far.json"), "--pixel", "110,191", *self.TEXTBOOK)
        text = self.run_program(*words, "--width", "160")[0].decode()
        document = self.trace(words[1], 110, 191)
        steps = dict(re.findall(r"(?ms)^Step \d+\. ([^\n,]*)(.*?)(?=^Step|\Z)", text))
        for heading, rows in (("The primary ray", "R"), ("The nearest face along the ray", "t"),
                              ("The nearest face along the ray", "P1'"), ("Light 0 at P1", "L0"),
                              ("What P1 adds to the pixel", "adds"), ("The sum", "sum")):
            with self.subTest(heading, rows=rows):
                found, right = re.search(rf"(?m)^    {rows} +textbook  (.*)\n +exact     (.*)", steps[heading]).groups()
                self.assertNotEqual(found, re.sub(r", \S+ apart$", "", right))
        step = steps["The nearest face along the ray"]
        d, distance = (float(re.search(rf"(?m)^    {name}\b.* = (\S+)$", step)[1]) for name in ("D", r"N\.O \+ D"))
        n_dot_r = float(re.search(r"(?m)^    N\.R .* = (\S+)$", step)[1])
        self.assertGreater(abs(d), 1000 * abs(distance)) # what is left of two large numbers
        self.assertAlmostEqual(-distance / n_dot_r, document["textbook"]["hits"][0]["t"], delta=1e-4)
        self.assertIn("Exactly it is (146, 140, 126).", text)

    def test_the_paths_go_on_where_the_textbook_s_does(self):
        """A light that only one of them finds decides whether a path goes on where "shadow" is "black"."""
        with open(os.path.join(HERE, "scenes/lessons/acne.json"), encoding="utf-8") as file:
            acne = json.load(file)
        acne.setdefault("shading", {})["shadow"] = "black"
        for material in acne["materials"].values():
            material["reflection"] = 0.5
        self.put("mirrors.json", json.dumps(acne))
        text = self.run_program("trace", "mirrors.json", "--pixel", "9,225", *self.TEXTBOOK)[0].decode()
        self.assertIn("The path ended here: no light reaches P1", text)
        self.assertIn("Exactly the path goes on from P1.", text)

    def test_verbose_lists_every_face_that_the_textbook_tests(self):
        words = ("trace", os.path.join(HERE, "scenes/lessons/acne.json"), "--pixel", "9,225", *self.TEXTBOOK)
        short, long = (self.run_program(*words, *more)[0].decode() for more in ((), ("--verbose",)))
        rows = re.compile(r"(?m)^ +\d+  \S.*(?:behind|outside edge \d|nearest|in the way)$")
        self.assertEqual([len(rows.findall(text)) for text in (short, long)], [2, 8])

    def test_several_pixels_are_told_one_after_another(self):
        words = ("trace", "scene.json", *self.TEXTBOOK)
        one = [self.run_program(*words, "--pixel", pixel)[0] for pixel in ("4,3", "1,2")]
        self.assertEqual(self.run_program(*words, "--pixel", "4,3", "--pixel", "1,2")[0], b"\n".join(one))
        both = json.loads(self.run_program(*words, "--pixel", "4,3", "--pixel", "1,2", "-f", "json")[0])
        self.assertEqual([(walk["column"], walk["row"]) for walk in both], [(4, 3), (1, 2)])

    def test_the_summary_is_the_beginning_of_the_text(self):
        words = ("trace", os.path.join(HERE, "scenes/lessons/acne.json"), "--pixel", "95,151", *self.TEXTBOOK)
        whole, short = self.run_program(*words)[0], self.run_program(*words, "--summary")[0]
        self.assertTrue(whole.startswith(short) and len(short) < len(whole))
        self.assertIn(b"= (26, 26, 26) in textbook arithmetic, (144, 138, 124) exactly\n", short)

    def test_a_file_gets_what_standard_output_would(self):
        for form in ("text", "json"):
            words = ("trace", "scene.json", "--pixel", "4,3", *self.TEXTBOOK, "--format", form)
            self.run_program(*words, "-o", "walk")
            self.assertEqual(self.bytes_of("walk"), self.run_program(*words)[0])

    def test_what_the_text_has_not_is_refused(self):
        for message, words in (("is told with --format text or json, not svg", ("-f", "svg")),
                               ("leave out --arithmetic textbook", ("--diff", "--pixel", "1,2")),
                               ("is told with --format text or json, not obj", ("-f", "obj")),
                               ("textbook arithmetic has no tree", ("--accel", "bvh")),
                               ("textbook arithmetic has no adaptive sampling", ("--sampling", "adaptive:2"))):
            out, err = self.run_program("trace", "scene.json", "--pixel", "4,3", *self.TEXTBOOK, *words, status=2)
            self.assertEqual(out, b"")
            self.assertIn(message, err)
        _, err = self.run_program("trace", "scene.json", "--pixel", "4,3", "--shift", "1", status=2)
        self.assertIn("--shift needs --arithmetic textbook", err)
        _, err = self.run_program("trace", "scene.json", "--pixel", "4,3", "--precision", "double")
        self.assertIn("note: --precision does nothing", err)


class Mistakes(CommandTest):
    def assert_usage(self, message, *words):
        out, err = self.run_program("trace", "scene.json", *words, status=2)
        self.assertEqual(out, b"")
        self.assertIn(message, err)
        self.assertEqual(err.count("\n"), 1)

    def test_a_pixel_must_be_given_and_be_in_the_picture(self):
        self.assert_usage("trace needs --pixel COLUMN,ROW")
        self.assert_usage("--pixel 8,0 is outside the picture, whose pixels are 0,0 to 7,5", "--pixel", "8,0")
        self.assert_usage("--pixel 0,6 is outside the picture", "--pixel", "0,6")
        for value in ("1", "1,", ",1", "1,2,3", "-1,0", "1x2", "a,b", "", " 1,2", "99999,0"):
            self.assert_usage(f"--pixel '{value}': expected two whole numbers", f"--pixel={value}")

    def test_a_sample_must_be_in_the_grid(self):
        self.assert_usage("--sample 1,0 is outside the grid, whose samples are 0,0 to 0,0", "--pixel", "1,1",
                          "--sample", "1,0")
        self.assert_usage("--sample 0,2 is outside the grid, whose samples are 0,0 to 1,1", "--pixel", "1,1",
                          "--grid", "2",
                          "--sample", "0,2")

    def test_a_format_must_be_one_there_is(self):
        self.assert_usage("--format 'xml': expected text, json, obj or svg", "--pixel", "1,1", "--format", "xml")

    def test_an_option_that_the_format_cannot_use_is_told(self):
        _, err = self.run_program("trace", "scene.json", "--pixel", "1,1", "--with-scene")
        self.assertIn("--with-scene does nothing with --format text", err)
        _, err = self.run_program("trace", "scene.json", "--pixel", "1,1", "--format", "obj", "--summary")
        self.assertIn("--summary does nothing with --format obj", err)
        _, err = self.run_program("trace", "scene.json", "--pixel", "1,1", "--format", "svg", "--verbose")
        self.assertIn("--verbose does nothing with --format svg", err)

    def test_a_file_that_cannot_be_written_is_3(self):
        os.mkdir(self.path("folder"))
        for form in ("text", "json", "obj", "svg"):
            for output in ("folder", "missing/a", "scene.json/a"):
                _, err = self.run_program("trace", "scene.json", "--pixel", "1,1", "-f", form, "-o", output, status=3)
                self.assertIn(f"cannot write {output}: ", err)
        if os.path.exists("/dev/full"):
            _, err = self.run_program("trace", "scene.json", "--pixel", "1,1", "-o", "/dev/full", status=3)
            self.assertIn("cannot write /dev/full: No space left", err)
            with open("/dev/full", "wb") as full:
                _, err = self.run_program("trace", "scene.json", "--pixel", "1,1", status=3, stdout=full)
            self.assertIn("cannot write to standard output: ", err)

    def test_the_scene_is_not_overwritten(self):
        before = self.bytes_of("scene.json")
        self.assert_usage("would replace the scene itself", "--pixel", "1,1", "-o", "scene.json")
        self.assertEqual(self.bytes_of("scene.json"), before)

    def test_a_scene_that_is_wrong_is_1(self):
        self.put("bad.json", "{")
        for scene in ("bad.json", "missing.json"):
            out, err = self.run_program("trace", scene, "--pixel", "0,0", status=1)
            self.assertEqual(out, b"")
            self.assertTrue(err.startswith(scene))


if __name__ == "__main__":
    unittest.main(verbosity=2)
