#!/usr/bin/env python3
"""`rectray grade`: what docs/grading.md says. The tracer of that page is right; with a slip put into it, `grade` names
the slip. What is read is judged strictly where it must be, and passed over where it may be."""
import json
import os
import re
import subprocess
import sys
import unittest
from pathlib import Path

import jsonschema

from support.program import PROGRAM, CommandTest

ROOT = Path(__file__).resolve().parent.parent
TRACER = ROOT / "docs" / "grading" / "tracer.py"
TEXT = TRACER.read_text(encoding="utf-8")
PAGE = (ROOT / "docs" / "grading.md").read_text(encoding="utf-8")

# A slip: a scene and a pixel that show it, what of the tracer's text becomes what, and values of the scene that are
# changed before. It must be among the slips that are named.
PLANTED = {
    "pixel-corner": ("original", 36, 34, [("(column + 0.5)", "column"), ("(row + 0.5)", "row")]),
    "pixels-less-one": ("original", 40, 36, [
        ("(column + 0.5) / columns", "column / (columns - 1)"),
        ("(row + 0.5) / rows", "row / (rows - 1)")]),
    "upside-down": ("mirrors", 300, 200, [("y = (0.5 - (row + 0.5) / rows)", "y = ((row + 0.5) / rows - 0.5)")]),
    "mirror-image": ("original", 40, 36, [
        ('cross(f, camera.get("up", [0, 1, 0]))', 'cross(camera.get("up", [0, 1, 0]), f)'),
        ("u = cross(r, f)", "u = cross(f, r)")]),
    "column-for-row": ("original", 40, 36, [
        ("def primary_ray(scene, column, row):", "def primary_ray(scene, row, column):")]),
    "aspect-forgotten": ("original", 40, 36, [('screen.get("height", width * rows / columns)', "width")]),
    "aspect-inverted": ("original", 40, 36, [
        ('screen.get("height", width * rows / columns)', "width * columns / rows")]),
    "height-not-read": ("original", 40, 36, [
        ('screen.get("height", width * rows / columns)', "width * rows / columns")]),
    "view-halved": ("original", 36, 34, [("scale(x, r)), scale(y, u))\n", "scale(x / 2, r)), scale(y / 2, u))\n")]),
    "view-doubled": ("original", 40, 36, [("scale(x, r)), scale(y, u))\n", "scale(2 * x, r)), scale(2 * y, u))\n")]),
    "distance-forgotten": ("highlight_in_a_mirror", 28, 21, [('scale(screen["distance"], f)', "f")]),
    "forward-not-unit": ("mirrors", 300, 200, [
        ('f = unit(sub(camera["look_at"], camera["position"]))', 'f = sub(camera["look_at"], camera["position"])')]),
    "up-as-given": ("mirrors", 300, 200, [("u = cross(r, f)", 'u = camera.get("up", [0, 1, 0])')]),
    "right-not-unit": ("mirrors", 300, 200, [
        ('r = unit(cross(f, camera.get("up", [0, 1, 0])))', 'r = cross(f, camera.get("up", [0, 1, 0]))')]),
    "camera-at-origin": ("original", 40, 36, [('return camera["position"], add', "return [0, 0, 0], add")]),
    "direction-unit": ("original", 40, 36, [
        ('add(add(scale(screen["distance"], f), scale(x, r)), scale(y, u))',
         'unit(add(add(scale(screen["distance"], f), scale(x, r)), scale(y, u)))')]),
    "direction-backwards": ("cornell", 200, 200, [
        ('add(add(scale(screen["distance"], f), scale(x, r)), scale(y, u))',
         'scale(-1, add(add(scale(screen["distance"], f), scale(x, r)), scale(y, u)))')]),
    "t-sign": ("cornell", 200, 200, [("t = -dot(n, sub(o, v[0])) / n_r", "t = dot(n, sub(o, v[0])) / n_r")]),
    "n-dot-r-sign": ("mirrors", 320, 180, [("n_r = dot(n, r)", "n_r = -dot(n, r)")]),
    "d-sign": ("original", 40, 36, [("t = -dot(n, sub(o, v[0])) / n_r", "t = -dot(n, add(o, v[0])) / n_r")]),
    "d-forgotten": ("original", 20, 50, [("t = -dot(n, sub(o, v[0])) / n_r", "t = -dot(n, o) / n_r")]),
    "behind-counts": ("facing_mirrors", 27, 20, [("    if t <= 0:\n        return None\n", "")]),
    "t-without-sign": ("original", 40, 36, [
        ("t = -dot(n, sub(o, v[0])) / n_r", "t = abs(dot(n, sub(o, v[0])) / n_r)")]),
    "one-sided-ignored": ("one_sided", 49, 20, [("if n_r == 0 or (one_sided and n_r > 0)", "if n_r == 0")]),
    "one-sided-reversed": ("original", 40, 36, [("one_sided and n_r > 0", "one_sided and n_r < 0")]),
    "all-one-sided": ("highlight_in_a_mirror", 28, 21, [("(one_sided and n_r > 0)", "n_r > 0")]),
    "outside-counts": ("mirrors", 320, 180, [("cross(e, c)) < 0", "cross(e, c)) > 0")]),
    "edges-by-ray": ("highlight_in_a_mirror", 28, 21, [
        ("if dot(n, cross(e, c)) < 0", "if -n_r * dot(n, cross(e, c)) < 0")]),
    "last-edge-forgotten": ("original", 45, 40, [
        ("for k in range(len(v)):\n        e", "for k in range(len(v) - 1):\n        e")]),
    "first-edge-forgotten": ("original", 40, 36, [
        ("for k in range(len(v)):\n        e", "for k in range(1, len(v)):\n        e")]),
    "half-a-quad": ("facing_mirrors", 40, 15, [
        ("    for k in range(len(v)):\n        e", "    v = v[:3]\n    for k in range(3):\n        e")]),
    "whole-plane": ("original", 40, 36, [("cross(e, c)) < 0", "cross(e, c)) < 0 and False")]),
    "farthest": ("cornell", 320, 380, [("return min([", "return max([")]),
    "last-face": ("cornell", 320, 380, [
        ("return min([(t, k) for t, k in hits if t is not None], default=(None, None))",
         "return ([(None, None)] + [(t, k) for t, k in hits if t is not None])[-1]")]),
    "first-face": ("cornell", 320, 380, [
        ("return min([(t, k) for t, k in hits if t is not None], default=(None, None))",
         "return ([(t, k) for t, k in hits if t is not None] + [(None, None)])[0]")]),
    "shadow-beyond-light": ("cornell", 200, 200, [("t is not None and t < 1", "t is not None")]),
    "no-shadows": ("cornell", 100, 450, [('return "blocked" if any(', 'return "reaches" if any(')]),
    "shadow-unit-t": ("cornell", 100, 450, [
        ('hit_face(face, start, sub(light["position"], start))',
         'hit_face(face, start, unit(sub(light["position"], start)))')]),
    "shadow-backwards": ("mirrors", 200, 100, [
        ('hit_face(face, start, sub(light["position"], start))',
         'hit_face(face, start, sub(start, light["position"]))')]),
    "shadow-to-position": ("facing_mirrors", 40, 15, [
        ('hit_face(face, start, sub(light["position"], start))', 'hit_face(face, start, light["position"])')]),
    "shadow-not-shifted": ("cornell", 320, 380, [("SHIFT = 1e-9", "SHIFT = 0")]),
    "shift-inwards": ("facing_mirrors", 27, 20, [("SHIFT = 1e-9", "SHIFT = -1e-9")]),
    "normal-not-turned": ("highlight_in_a_mirror", 28, 21, [("n = scale(-1, n) if dot(n, r) > 0 else n", "n = n")]),
    "normal-turned-away": ("original", 40, 36, [("if dot(n, r) > 0 else n", "if dot(n, r) < 0 else n")]),
    "normal-not-unit": ("original", 40, 36, [("unit(cross(a, b))", "cross(a, b)")]),
    "light-behind-counts": ("original", 20, 50, [
        ('    if dot(n, sub(light["position"], p)) <= 0:\n        return "behind face"\n', "")]),
    "phong": ("original", 36, 34, [("s = max(0, dot(n, h))", "s = max(0, dot(sub(scale(2 * dot(l, n), n), l), v))")]),
    "phong-undivided": ("highlight_in_a_mirror", 28, 21, [
        ("s = max(0, dot(n, h))", "s = max(0, dot(sub(scale(2 * dot(l, n), n), l), v))"),
        ('(material["shininess"] / 4)', 'material["shininess"]')]),
    "alpha-undivided": ("background", 40, 15, [('(material["shininess"] / 4)', 'material["shininess"]')]),
    "no-exponent": ("original", 40, 36, [(' ** (material["shininess"] / 4)', "")]),
    "h-not-unit": ("original", 40, 36, [("h = unit(add(l, v))", "h = add(l, v)")]),
    "h-halved": ("background", 27, 20, [("h = unit(add(l, v))", "h = scale(0.5, add(l, v))")]),
    "h-difference": ("original", 40, 36, [("h = unit(add(l, v))", "h = unit(sub(l, v))")]),
    "l-dot-h": ("original", 40, 36, [("s = max(0, dot(n, h))", "s = max(0, dot(l, h))")]),
    "light-colour-forgotten": ("cornell", 350, 300, [
        ('"specular": [1, 1, 1], **light}', '"specular": [1, 1, 1], "position": light["position"]}')]),
    "light-diffuse-forgotten": ("cornell", 350, 300, [
        ('mul(material["diffuse"], light["diffuse"])', 'material["diffuse"]')]),
    "light-specular-forgotten": ("cornell", 320, 380, [
        ('mul(material["specular"], light["specular"])', 'material["specular"]')]),
    "light-ambient-forgotten": ("cornell", 350, 300, [
        ('mul(material["ambient"], light["ambient"])', 'material["ambient"]')]),
    "ambient-missing": ("original", 40, 36, [
        ("return add(add(ambient, diffuse), specular) if reaches else ambient",
         "return add(diffuse, specular) if reaches else [0, 0, 0]")]),
    "diffuse-missing": ("original", 40, 36, [("add(add(ambient, diffuse), specular)", "add(ambient, specular)")]),
    "specular-missing": ("highlight_in_a_mirror", 42, 16, [
        ("add(add(ambient, diffuse), specular)", "add(ambient, diffuse)")]),
    "no-cosine": ("original", 40, 36, [("scale(max(0, dot(l, n)), ", "scale(1, ")]),
    "diffuse-not-clamped": ("original", 20, 50, [
        ('    if dot(n, sub(light["position"], p)) <= 0:\n        return "behind face"\n', ""),
        ("scale(max(0, dot(l, n)), ", "scale(dot(l, n), ")]),
    "highlight-not-clamped": ("original", 40, 36, [("s = max(0, dot(n, h))", "s = dot(n, h)")],
                              {"materials.purple.shininess": 4}),
    "fading-light": ("original", 40, 36, [
        ('l = unit(sub(light["position"], p))',
         'way = sub(light["position"], p)\n                l, far = unit(way), 1 / dot(way, way)\n                '
         'light = {**light, "diffuse": scale(far, light["diffuse"]), "specular": scale(far, light["specular"])}')]),
    "l-not-unit": ("original", 40, 36, [('l = unit(sub(light["position"], p))', 'l = sub(light["position"], p)')]),
    "v-not-unit": ("original", 40, 36, [("else unit(sub(eye, p))", "else sub(eye, p)")]),
    "v-backwards": ("original", 40, 36, [("else unit(sub(eye, p))", "else unit(sub(p, eye))")]),
    "viewer-rule": ("facing_mirrors", 40, 15, [('rules["viewer"] == "ray"', 'rules["viewer"] != "ray"')]),
    "shadow-rule": ("original", 20, 50, [
        ('**scene.get("shading", {})}',
         '**scene.get("shading", {})}; rules["shadow"] = "black" if rules["shadow"] == "ambient" else "ambient"')]),
    "lit-in-shadow": ("cornell", 100, 450, [('verdict == "reaches"))', "True))")]),
    "last-light-only": ("cornell", 350, 300, [("i = add(i, illuminate(", "i = (illuminate(")]),
    "dark-goes-on": ("original", 20, 50, [('(rules["shadow"] == "black" and "reaches" not in verdicts) or ', "")]),
    "reflection-of-primary": ("original", 40, 36, [
        ("eye, colour, weight, hits = o, [0, 0, 0], 1, []",
         "eye, colour, weight, hits, first = o, [0, 0, 0], 1, [], unit(r)"),
        ("sub(r1, scale(2 * dot(r1, n), n))",
         "sub(first, scale(2 * dot(first, n), n))")]),
    "reflection-sign": ("facing_mirrors", 27, 20, [("sub(r1, scale(2 *", "add(r1, scale(2 *")]),
    "reflection-once": ("facing_mirrors", 27, 20, [("scale(2 * dot(r1", "scale(dot(r1")]),
    "reflection-back": ("facing_mirrors", 27, 20, [("sub(r1, scale(2 * dot(r1, n), n))", "scale(-1, r1)")]),
    "reflection-straight-on": ("facing_mirrors", 27, 20, [("sub(r1, scale(2 * dot(r1, n), n))", "r1")]),
    "reflection-not-unit": ("original", 40, 36, [
        ("unit(r)\n        v = scale(-1, r1)", "r\n        v = scale(-1, unit(r1))")]),
    "reflection-origin": ("mirrors", 320, 180, [("o, r = start, sub", "o, r = o, sub")]),
    "no-reflection": ("facing_mirrors", 27, 20, [('rules["max_bounces"] + 1', "1")]),
    "weight-squared": ("mirrors", 300, 200, [
        ('weight *= material["reflection"]', 'weight *= material["reflection"] ** 2')]),
    "weight-forgotten": ("original", 40, 36, [('weight *= material["reflection"]', "weight *= 1")]),
    "weight-not-accumulated": ("facing_mirrors", 40, 15, [
        ('weight *= material["reflection"]', 'weight = material["reflection"]')]),
    "weight-of-the-rest": ("mirrors", 300, 200, [
        ('weight *= material["reflection"]', 'weight *= 1 - material["reflection"]')]),
    "mixed": ("mirrors", 300, 200, [
        ("        colour = add(colour, scale(weight, i))",
         '        i = scale(1 - material["reflection"], i)\n        colour = add(colour, scale(weight, i))')]),
    "bounce-too-many": ("facing_mirrors", 30, 14, [('rules["max_bounces"] + 1', 'rules["max_bounces"] + 2')],
                        {"shading.max_bounces": 1}),
    "bounce-too-few": ("facing_mirrors", 30, 14, [('rules["max_bounces"] + 1', 'rules["max_bounces"]')],
                       {"shading.max_bounces": 1}),
    "bounces-unlimited": ("facing_mirrors", 30, 14, [('rules["max_bounces"] + 1', "65")],
                          {"shading.max_bounces": 1}),
    "every-face-mirrors": ("cornell", 350, 300, [(' or material["reflection"] == 0', "")]),
    "background-unweighted": ("mirrors", 300, 200, [('scale(weight, rules["background"])', 'rules["background"]')]),
    "background-forgotten": ("mirrors", 300, 200, [('scale(weight, rules["background"])', "[0, 0, 0]")]),
    "last-hit-only": ("facing_mirrors", 27, 20, [
        ("colour = add(colour, scale(weight, i))", "colour = scale(weight, i)")]),
    "not-clamped": ("bright", 20, 31, [
        ("math.floor(255 * min(max(c, 0), 1) + 0.5)", "math.floor(255 * c + 0.5) % 256")]),
    "gamma": ("original", 40, 36, [("min(max(c, 0), 1) + 0.5", "min(max(c, 0), 1) ** (1 / 2.2) + 0.5")]),
    "gamma-root": ("original", 40, 36, [("min(max(c, 0), 1) + 0.5", "min(max(c, 0), 1) ** 0.5 + 0.5")]),
    "bytes-cut-off": ("original", 40, 36, [("min(max(c, 0), 1) + 0.5", "min(max(c, 0), 1)")]),
    "times-256": ("mirrors", 300, 200, [
        ("math.floor(255 * min(max(c, 0), 1) + 0.5)", "min(255, math.floor(256 * min(max(c, 0), 1)))")]),
    "blue-first": ("mirrors", 300, 200, [('for c in answer["colour"]]', 'for c in answer["colour"][::-1]]')]),
    "bytes-to-1": ("original", 40, 36, [("math.floor(255 * min(max(c, 0), 1) + 0.5)", "min(max(c, 0), 1)")]),
    "colours-to-255": ("original", 40, 36, [
        ('"contribution": scale(weight, i)', '"contribution": scale(255 * weight, i)')]),
    "edges-skip-one": ("mirrors", 300, 200, [("e, c = sub(v[(k + 1) % len(v)]", "e, c = sub(v[(k + 2) % len(v)]")]),
    "one-sided-left-out": ("original", 40, 36, [("(one_sided and n_r > 0)", "one_sided")]),
    "point-minus": ("original", 40, 36, [("p = add(o, scale(t, r))\n        n", "p = sub(o, scale(t, r))\n        n")]),
    "origin-forgotten": ("original", 40, 36, [("p = add(o, scale(t, r))\n        n", "p = scale(t, r)\n        n")]),
    "last-of-equal": ("same_place", 16, 6, [
        ("(t, k) for t, k in hits if t is not None]",
         "(t, k) for t, k in hits[::-1] if t is not None and t == min(s for s, _ in hits if s is not None)][:1]")]),
    "shadow-t-distance": ("cornell", 200, 200, [
        ("t < 1 for t", 't < math.dist(light["position"], start) for t')]),
    "shadow-only-beyond": ("cornell", 200, 200, [("t < 1 for t", "t > 1 for t")]),
    "normal-not-turned-for-light": ("highlight_in_a_mirror", 28, 21, [
        ("light_verdict(faces, light, n, p, start) for", "light_verdict(faces, light, faces[k][2], p, start) for")]),
    "alpha-halved": ("original", 40, 36, [('(material["shininess"] / 4)', '(material["shininess"] / 2)')]),
    "h-is-l": ("original", 40, 36, [("h = unit(add(l, v))", "h = l")]),
    "light-colour-diffuse": ("many_lights", 27, 20, [
        ('light["ambient"])', 'light["diffuse"])'), ('light["specular"])', 'light["diffuse"])')]),
    "ks-forgotten": ("highlight_in_a_mirror", 28, 21, [
        ('mul(material["specular"], light["specular"])', 'light["specular"]')]),
    "diffuse-both-sides": ("original", 20, 50, [
        ('    if dot(n, sub(light["position"], p)) <= 0:\n        return "behind face"\n', ""),
        ("max(0, dot(l, n))", "abs(dot(l, n))")]),
    "diffuse-negated": ("original", 40, 36, [("max(0, dot(l, n))", "max(0, -dot(l, n))")]),
    "diffuse-of-viewer": ("original", 40, 36, [("max(0, dot(l, n))", "max(0, dot(v, n))")]),
    "highlight-both-sides": ("original", 40, 36, [("max(0, dot(n, h))", "abs(dot(n, h))")],
                             {"materials.purple.shininess": 4}),
    "highlight-cosine": ("original", 40, 36, [("scale(s, mul", "scale(s * max(0, dot(l, n)), mul")]),
    "l-backwards": ("original", 40, 36, [
        ('l = unit(sub(light["position"], p))', 'l = unit(sub(p, light["position"]))')]),
    "ambient-once": ("many_lights", 27, 20, [
        ("add(i, illuminate(material,",
         'add(i, illuminate({**material, "ambient": [0, 0, 0]} if light in lights[1:] else material,')]),
    "reflection-along-normal": ("original", 40, 36, [("sub(r1, scale(2 * dot(r1, n), n))", "n")]),
    "weight-unused": ("original", 40, 36, [("scale(weight, i)", "i")]),
    "weight-halved": ("original", 40, 36, [
        ('weight *= material["reflection"]', 'weight *= material["reflection"] / 2')],
                      {"materials.grey.reflection": 0.8}),
    "own-light-reflected": ("original", 40, 36, [("scale(weight, i)", 'scale(weight * material["reflection"], i)')]),
    "tone-mapped": ("original", 40, 36, [("min(max(c, 0), 1)", "c / (1 + c)")]),
    "hue-kept": ("bright", 20, 31, [("min(max(c, 0), 1)", 'c / max(1, *answer["colour"])')]),
}

# Scenes that the tracer can read, and pixels of them that show much.
RIGHT = [("original", 40, 36), ("original", 20, 50), ("original", 10, 35), ("mirrors", 300, 200), ("cornell", 320, 380),
         ("cornell", 200, 200), ("background", 20, 31), ("bright", 27, 20), ("doll_house", 20, 20),
         ("face_materials", 20, 31),
         ("far_away", 20, 20), ("highlight_in_a_mirror", 28, 21), ("many_lights", 27, 20), ("one_sided", 27, 20),
         ("shadow_ambient", 20, 31), ("shadow_black", 20, 31), ("triangles", 27, 20), ("viewer_camera", 20, 31),
         ("viewer_ray", 20, 31)]


def scene_path(name):
    own = ROOT / "scenes" / f"{name}.json"
    return own if own.exists() else ROOT / "tests" / "scenes" / f"{name}.json"


def read_scene(name, changes=None):
    scene = json.loads(scene_path(name).read_text(encoding="utf-8"))
    for path, value in (changes or {}).items():
        *way, last = path.split(".")
        part = scene
        for key in way:
            part = part[key]
        part[last] = value
    return scene


def planted(edits):
    text = TEXT
    for before, after in edits:
        assert before in text, before
        text = text.replace(before, after)
    return text


def walkthrough(text, scene, column, row):
    """What the tracer with this text writes of a pixel. It runs in here, which is sooner than a process."""
    names = {}
    exec(compile(text.split("SCENE = ")[0], "tracer", "exec"), names)  # pylint: disable=exec-used
    summary = names["pixel"](scene, names["read_faces"](scene), column, row)
    return {"pixel": {"column": column, "row": row}, "summary": summary}


def sources():
    return "".join(path.read_text(encoding="utf-8") for path in sorted((ROOT / "src" / "grade").glob("slips_*.c")))


def schema(name):
    text = (ROOT / "docs" / f"{name}.schema.json").read_text(encoding="utf-8")
    return jsonschema.Draft202012Validator(json.loads(text))


class GradeTest(CommandTest):
    def grade(self, scene, document, *words, status=0):
        """The grade of a document, as JSON; `scene` is the name of one."""
        text = document if isinstance(document, str) else json.dumps(document)
        out, err = self.run_program("grade", str(scene_path(scene)), "-", "--json", *words, status=status, text_in=text)
        return json.loads(out), err

    def refuse(self, document, *words, status=1):
        """The message about a document that cannot be read."""
        text = document if isinstance(document, str) else json.dumps(document)
        out, err = self.run_program("grade", "scene.json", "-", *words, status=status, text_in=text)
        self.assertEqual(out, b"")
        return err


class Example(GradeTest):
    def test_it_is_as_short_as_the_page_says(self):
        lines = TEXT.splitlines()
        self.assertIn(f"A tracer in {(len(lines) // 10) * 10} lines", PAGE)
        self.assertLessEqual(len(lines), 120)
        self.assertLessEqual(max(map(len, lines)), 120)

    def test_its_walkthroughs_are_ours(self):
        for name, column, row in RIGHT:
            with self.subTest(f"{name} {column},{row}"):
                document = walkthrough(TEXT, read_scene(name), column, row)
                schema("given").validate(document)
                found, _ = self.grade(name, document, "--grid", "1")
                self.assertTrue(found["same"])
                self.assertNotIn("difference", found)
                self.assertEqual(found["causes"], [])
                schema("grade").validate(found)

    def test_it_writes_walkthroughs_and_pictures(self):
        path = str(scene_path("original"))
        out = subprocess.run([sys.executable, TRACER, path, "40", "36"], capture_output=True, check=True).stdout
        self.assertTrue(self.grade("original", out.decode())[0]["same"])
        with open(self.path("mine.ppm"), "wb") as file:
            subprocess.run([sys.executable, TRACER, path], stdout=file, check=True)
        out, _ = self.run_program("grade", path, "--picture", "mine.ppm")
        self.assertIn(b"The same: every pixel", out)

    def test_the_page_shows_what_is_printed(self):
        blocks = re.findall(r"```text\n(They differ.*?)```", PAGE, re.S)
        scene, path = read_scene("original"), "scenes/original.json"
        self.put("mine.json", json.dumps(walkthrough(planted(PLANTED["h-not-unit"][3]), scene, 40, 36)))
        out = subprocess.run([PROGRAM, "grade", path, self.path("mine.json")], cwd=ROOT, capture_output=True,
                             check=False)
        self.assertEqual(out.stdout.decode().replace(self.path("mine.json"), "mine.json"), blocks[0])
        self.put("tracer.py", planted(PLANTED["upside-down"][3]))
        with open(self.path("mine.ppm"), "wb") as file:
            subprocess.run([sys.executable, self.path("tracer.py"), scene_path("original")], stdout=file, check=True)
        out = subprocess.run([PROGRAM, "grade", path, "--picture", self.path("mine.ppm")], cwd=ROOT,
                             capture_output=True, check=False)
        self.assertEqual(out.returncode, 1)
        self.assertEqual(out.stdout.decode().replace(self.path("mine.ppm"), "mine.ppm"), blocks[1])

    def test_the_page_s_document_is_right(self):
        document = json.loads(re.search(r"```json\n(\{\n.*?)```", PAGE, re.S)[1])
        schema("given").validate(document)
        self.assertTrue(self.grade("original", document)[0]["same"])


class Slips(GradeTest):
    def test_each_that_is_put_into_the_tracer_is_named(self):
        for name, (scene, column, row, edits, *changes) in PLANTED.items():
            changes = changes[0] if changes else {}
            with self.subTest(name):
                document = walkthrough(planted(edits), read_scene(scene, changes), column, row)
                words = [word for path, value in changes.items() for word in ("--set", f"{path}={value}")]
                found, err = self.grade(scene, document, "--grid", "1", *words, status=1)
                schema("grade").validate(found)
                self.assertIn(name, [cause["slip"] for cause in found["causes"]])
                self.assertIn("is not what", err)

    def test_the_page_lists_all_with_the_program_s_words(self):
        inside = re.findall(r'\{"([\w-]+)",\s*"((?:[^"\\]|\\.)*)"', sources())
        inside = [(name, title.replace('\\"', '"')) for name, title in inside]
        rows = re.findall(r"(?m)^\| `([\w-]+)` \| (.*) \|$", PAGE)
        self.assertGreater(len(rows), 100)
        self.assertEqual(sorted(rows), sorted(inside))
        self.assertEqual(set(PLANTED) - {name for name, _ in inside}, set())

    def test_where_to_read_is_there(self):
        places = set(re.findall(r'"(\w+\.md#[\w-]+)"', sources()))
        self.assertGreater(len(places), 8)
        for place in places:
            page, _, anchor = place.partition("#")
            heads = re.findall(r"(?m)^#+ (.*)$", (ROOT / "docs" / page).read_text(encoding="utf-8"))
            anchors = {re.sub(r"[^\w -]", "", head.lower()).replace(" ", "-") for head in heads}
            self.assertIn(anchor, anchors, place)

    def test_the_first_difference_is_told_with_both_values(self):
        document = walkthrough(TEXT, read_scene("original"), 40, 36)
        document["summary"]["hits"][1]["lights"][0]["verdict"] = "blocked"
        found, _ = self.grade("original", document, status=1)
        difference = found["difference"]
        self.assertEqual((difference["hit"], difference["event"], difference["member"]), (2, "light end", "verdict"))
        self.assertEqual((difference["expected"], difference["given"]), ("reaches", "blocked"))
        self.assertEqual(difference["after"], 4)

    def test_what_no_slip_explains_is_measured(self):
        document = walkthrough(TEXT, read_scene("original"), 40, 36)
        document["summary"]["hits"][0]["t"] *= 7
        self.put("mine.json", json.dumps(document))
        out, _ = self.run_program("grade", str(scene_path("original")), "mine.json", status=1)
        self.assertIn("none of the slips", out.decode())
        self.assertIn("Given is 7 times what is expected.", out.decode())

    def test_one_ray_where_the_scene_asks_for_several_is_a_slip(self):
        found, _ = self.grade("grid", walkthrough(TEXT, read_scene("grid"), 2, 43), status=1)
        self.assertIn("one-sample", [cause["slip"] for cause in found["causes"]])

    def test_two_slips_are_taken_one_after_the_other(self):
        edits = PLANTED["alpha-undivided"][3] + PLANTED["weight-squared"][3]
        found, _ = self.grade("original", walkthrough(planted(edits), read_scene("original"), 40, 36), status=1)
        causes = {cause["slip"]: cause for cause in found["causes"]}
        self.assertIn("alpha-undivided", causes)
        self.assertFalse(causes["alpha-undivided"]["whole"])


class Pictures(GradeTest):
    """Small ones, so that the tracer in Python makes them soon."""

    def draw(self, edits, name="original"):
        scene = read_scene(name)
        scene["screen"].update(columns=24, rows=18)
        self.put("small.json", json.dumps(scene))
        self.put("tracer.py", planted(edits))
        with open(self.path("mine.ppm"), "wb") as file:
            subprocess.run([sys.executable, self.path("tracer.py"), self.path("small.json")], stdout=file, check=True)

    def grade_picture(self, *words, status=1):
        out, _ = self.run_program("grade", "small.json", "--picture", "mine.ppm", "--json", *words, status=status)
        found = json.loads(out)
        schema("grade").validate(found)
        return found

    def test_the_slip_of_a_picture_is_named(self):
        for name in ("upside-down", "no-cosine", "gamma", "aspect-forgotten"):
            with self.subTest(name):
                self.draw(PLANTED[name][3])
                found = self.grade_picture()
                self.assertIn(name, [cause["slip"] for cause in found["causes"]])
                self.assertGreaterEqual(found["causes"][0]["explained"], found["tried"] - 2)  # some lie on an edge

    def test_the_first_pixel_is_in_the_first_tile(self):
        self.draw([])
        data = bytearray(self.bytes_of("mine.ppm"))
        head = len(data) - 24 * 18 * 3
        for column, row in ((17, 0), (3, 12), (5, 9), (2, 17)):  # of the first tile the one at (5, 9) comes first
            data[head + 3 * (24 * row + column)] ^= 128
        with open(self.path("mine.ppm"), "wb") as file:
            file.write(data)
        found = self.grade_picture()
        self.assertEqual(found["differing"], 4)
        self.assertEqual(found["first"]["pixel"], {"column": 5, "row": 9})
        self.assertEqual(found["first"]["tile"], {"column": 0, "row": 0})
        self.assertEqual(abs(found["first"]["given"][0] - found["first"]["expected"][0]), 128)
        self.assertTrue(self.grade_picture("--tolerance", "128", status=0)["same"])

    def test_one_of_another_size_is_refused_with_the_way_out(self):
        self.draw([])
        _, err = self.run_program("grade", str(scene_path("original")), "--picture", "mine.ppm", status=2)
        self.assertIn("say --size 24x18", err)
        self.run_program("grade", str(scene_path("original")), "--picture", "mine.ppm", "--size", "24x18", "--quiet")


class Reading(GradeTest):
    def test_our_own_walkthroughs_are_the_same(self):
        for words in ([], ["--summary"], ["--accel", "bvh", "--verbose"]):
            out, _ = self.run_program("trace", str(scene_path("gallery")), "--pixel", "965,320", "-f", "json", *words)
            found, _ = self.grade("gallery", out.decode())
            self.assertTrue(found["same"], words)
            self.assertGreater(found["events"], 10)

    def test_events_are_taken_with_the_members_that_they_have(self):
        events = [{"event": "hit", "object": "floor", "face_in_object": 5, "distance": 3.22668},
                  {"event": "terms", "light": 0, "n_dot_h": 0.754367, "mine": "whatever"},
                  {"event": "hit", "face": 4, "point": [-0.441242, 4.46385, 0.39277]}]
        document = {"events": events}
        self.assertTrue(self.grade("original", document, "--pixel", "40,36", status=1)[0]["difference"])
        events.append({"event": "terms", "light": 0, "l_dot_n": 0.0151841, "n_dot_h": 0})
        self.assertTrue(self.grade("original", document, "--pixel", "40,36")[0]["same"])
        events[1]["n_dot_h"] = 0.7551
        found, _ = self.grade("original", document, "--pixel", "40,36", status=1)
        self.assertEqual(found["difference"]["member"], "n_dot_h")
        self.assertTrue(self.grade("original", document, "--pixel", "40,36", "--tolerance", "0,1e-3")[0]["same"])

    def test_hits_are_asked_for(self):
        found, _ = self.grade("original", {"summary": {"hits": []}}, "--pixel", "40,36", status=1)
        self.assertEqual((found["difference"]["event"], found["difference"]["given"]), ("hit", "nothing more"))
        self.assertIn("a hit of floor/5, t = 2.18077", found["difference"]["expected"])

    def test_of_several_samples_one_is_asked_for(self):
        for sample in ("0,0", "2,1"):
            out, _ = self.run_program("trace", str(scene_path("grid")), "--pixel", "2,43", "--sample", sample,
                                      "-f", "json")
            self.assertTrue(self.grade("grid", out.decode())[0]["same"])
        out, _ = self.run_program("trace", str(scene_path("gallery")), "--pixel", "640,100", "-f", "json")
        self.assertTrue(self.grade("gallery", out.decode())[0]["same"])

    def test_a_verdict_may_be_a_yes_or_no(self):
        document = {"summary": {"hits": [{"face": "floor/5", "t": 2.18077, "lights": [{"light": 0, "reaches": True}]},
                                         {"face": "cube1/4", "t": 1.99623}]}}
        found, _ = self.grade("original", document, "--pixel", "40,36", status=1)
        self.assertEqual(found["difference"]["event"], "light end")  # the second hit has none
        document["summary"]["hits"][1]["lights"] = [{"light": 0, "reaches": True}]
        self.assertTrue(self.grade("original", document, "--pixel", "40,36")[0]["same"])

    def test_what_cannot_be_read_is_told_with_its_place(self):
        hit = {"face": "tile/0", "t": 1}
        for document, message in (
                ("[1", "<stdin>:1:3: "),
                ([], "is a list; a walkthrough is one object"),
                ({}, "needs \"summary\" with its \"hits\", or \"events\""),
                ({"summary": {}}, "summary: needs \"hits\""),
                ({"summary": {"hits": [{"t": 1}]}}, "summary.hits[0]: needs \"face\""),
                ({"summary": {"hits": [{"face": [1], "t": 1}]}}, "summary.hits[0].face: must be a face's number"),
                ({"summary": {"hits": [{"face": 1}]}}, "summary.hits[0]: needs \"t\""),
                ({"summary": {"hits": [hit, 3]}}, "summary.hits[1]: must be an object, not a number"),
                ({"summary": {"hits": [{**hit, "t": "1"}]}}, "summary.hits[0].t: must be a number, not a string"),
                ({"summary": {"hits": [{**hit, "lights": [{"light": 0}]}]}}, "lights[0]: needs \"verdict\""),
                ({"summary": {"hits": [{**hit, "lights": [{"light": 0, "verdict": "yes"}]}]}},
                 "lights[0].verdict: must be \"behind face\" or \"blocked\" or \"reaches\", not \"yes\""),
                ({"events": [{}]}, "events[0]: needs \"event\""),
                ({"events": [{"event": "hitt"}]}, "there is no event \"hitt\"; did you mean \"hit\"?"),
                ({"events": [{"event": "shaded"}]}, "events[0]: needs \"contribution\""),
                ({"walkthrough": 2, "events": []}, "walkthrough: must be from 1 to 1, not 2")):
            with self.subTest(message):
                self.assertIn(message, self.refuse(document, "--pixel", "4,3"))

    def test_the_pixel_must_be_said_once(self):
        document = {"summary": {"hits": []}}
        self.assertIn("say --pixel COLUMN,ROW", self.refuse(document, status=2))
        document["pixel"] = {"column": 4, "row": 3}
        self.assertIn("tells of pixel 4,3", self.refuse(document, "--pixel", "4,2", status=2))
        document["pixel"] = {"column": 8, "row": 3}
        self.assertIn("outside the picture", self.refuse(document, status=2))

    def test_something_is_asked_for(self):
        self.assertIn("grade needs a walkthrough", self.run_program("grade", "scene.json", status=2)[1])
        self.assertIn("leave out the walkthrough",
                      self.run_program("grade", "scene.json", "a.json", "--picture", "b.png", status=2)[1])
        for value in ("x", "-1", "1,", "1,2,3", "nan"):
            self.assertIn("expected one or two numbers",
                          self.run_program("grade", "scene.json", "a.json", f"--tolerance={value}", status=2)[1])


if __name__ == "__main__":
    os.chdir(ROOT)
    unittest.main(verbosity=2)
