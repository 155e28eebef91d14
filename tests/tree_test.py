#!/usr/bin/env python3
"""`rectray tree` from outside: its table is what its drawing has, its steps name the plane that the walkthrough meets,
and docs/trees.md quotes what the program prints."""
import json
import os
import re
import shlex
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree

from support.program import PROGRAM, CommandTest

HERE = os.getcwd()
GALLERY = os.path.join(HERE, "scenes/gallery.json")
ORIGINAL = os.path.join(HERE, "scenes/original.json")


def rows_of(text):
    """The rows of the table, by their labels: the values of the trees."""
    rows = {}
    for line in text.splitlines():
        match = re.match(r"\s*(.*?)\s{2,}([\d.]+)(?:\s+([\d.]+)\s+([\d.]+))?(?: \w+)?$", line)
        if match:
            rows[match[1]] = [float(value) for value in match.groups()[1:] if value]
    return rows


class Table(CommandTest):
    def test_it_counts_the_boxes_that_the_model_has(self):
        all_trees = rows_of(self.run_program("tree", GALLERY)[0].decode())
        for k, accel in enumerate(("kdtree", "bvh", "lbvh")):
            one = rows_of(self.run_program("tree", GALLERY, "--accel", accel)[0].decode())
            for label, values in one.items():
                if label != "building it took":
                    self.assertEqual(values, [all_trees[label][k]], label)
            self.run_program("tree", GALLERY, "-a", accel, "-o", "tree.obj")
            model = self.bytes_of("tree.obj").decode()
            levels = [int(level) for level in re.findall(r"(?m)^g level_(\d+)$", model)]
            self.assertEqual(len(levels), one["nodes"][0])
            self.assertEqual(max(levels), one["depth"][0])
            self.assertEqual(model.count(", a leaf"), one["leaves"][0])
            self.assertEqual(one["nodes"][0], 2 * one["leaves"][0] - 1)
            sizes = {int(label): values[0] for label, values in one.items() if label.isdigit()}
            self.assertEqual(sum(sizes.values()), one["leaves"][0])
            self.assertEqual(sum(size * count for size, count in sizes.items()), one["faces in leaves"][0])
        self.assertEqual(all_trees["faces in leaves"][1:], [572, 572])
        self.assertGreater(all_trees["faces in leaves"][0], 572)

    def test_the_expected_numbers_are_those_of_the_surfaces(self):
        """The sums over the boxes of the model, each with the chance that a line through the first one meets it."""
        for accel, step in (("kdtree", 1), ("bvh", 0.5), ("lbvh", 0.5)):
            table = rows_of(self.run_program("tree", GALLERY, "--accel", accel)[0].decode())
            self.run_program("tree", GALLERY, "-a", accel, "-o", "tree.obj")
            areas, leaves = [], []
            for group in self.bytes_of("tree.obj").decode().split("\ng level_")[1:]:
                corners = [[float(x) for x in line.split()[1:]] for line in group.splitlines() if line.startswith("v ")]
                x, y, z = (abs(b - a) for a, b in zip(corners[0], corners[7]))
                areas.append(x * y + y * z + z * x)
                leaves.append(", a leaf" in group)
            chances = [area / areas[0] for area in areas]
            self.assertAlmostEqual(sum(chances), table["nodes met"][0], 2)
            inner = step * sum(chance for chance, leaf in zip(chances, leaves) if not leaf)
            self.assertAlmostEqual(inner + table["faces tested"][0], table["SAH cost, in face tests"][0], 1)

    def test_a_large_scene_of_few_rays_is_sorted(self):
        """Which tree is built shows in --stats only: the picture is the same with each of them."""
        self.run_program("generate", "city", "--size", "1000", "-o", "city.json", "-q")
        render = ["render", "city.json", "-q", "--sampling", "uniform:1", "--stats=json", "-o"]
        for size, chosen in (("320x240", "lbvh"), ("640x640", "bvh")):
            for name, *words in (("auto",), ("lbvh", "-a", "lbvh"), ("bvh", "-a", "bvh"), ("kdtree", "-a", "kdtree")):
                stats = json.loads(self.run_program(*render, name + ".png", "--size", size, *words)[0])
                self.assertEqual(stats["accel"], chosen if name == "auto" else name)
                self.assertEqual(self.bytes_of(name + ".png"), self.bytes_of("auto.png"), name)

    def test_what_cannot_be_is_refused(self):
        for message, *words in (("expected kdtree, bvh or lbvh", "--accel", "none"),
                                ("lbvh tries none", "--accel", "lbvh", "--step", "1"),
                                ("ends in .svg or .obj", "-o", "tree.png"),
                                ("a whole number from 1 to 1000", "--step", "0")):
            self.assertIn(message, self.run_program("tree", GALLERY, *words, status=2)[1])
        self.put("scene.svg", self.bytes_of("scene.json").decode())
        self.assertIn("would replace the scene", self.run_program("tree", "scene.svg", "-o", "scene.svg", status=2)[1])
        empty = json.loads(self.bytes_of("scene.json"))
        empty["objects"] = []
        self.put("empty.json", json.dumps(empty))
        self.assertIn("no tree", self.run_program("tree", "empty.json", status=1)[1])


class Steps(CommandTest):
    def test_the_cheapest_plane_is_the_one_that_cuts(self):
        for accel in ("kdtree", "bvh"):
            out = self.run_program("tree", GALLERY, "-a", accel, "--step", "40")[0].decode()
            steps = out.split("Step ")[1:]
            self.assertEqual(len(steps), 40)
            for step in steps:
                faces = int(re.search(r": (\d+) face", step)[1])
                tried = re.findall(r"(?m)^ +(\S+) +(\d+) +(\d+) +(\S+)( +cheapest)?$", step)
                cheapest = [row for row in tried if row[4]]
                self.assertLessEqual(len(cheapest), 1)
                for row in tried:
                    self.assertGreaterEqual(int(row[1]) + int(row[2]), faces)
                    self.assertGreaterEqual(float(row[3]), float(cheapest[0][3]))
                split = re.search(r"into node \d+ \((\d+) faces?\) and node \d+ \((\d+) faces?\)", step)
                if split and "set apart" not in step:
                    self.assertEqual(split.groups(), cheapest[0][1:3])
                elif not split:
                    self.assertIn("becomes a leaf", step)
            if accel == "kdtree":
                plane = re.search(r"Cut by the plane ([xyz]) = (\S+),", steps[0])
                text = self.run_program("trace", GALLERY, "--pixel", "9,9", "-a", accel, "-v")[0].decode()
                self.assertIn(f"cut by {plane[1]} = {plane[2]} at", " ".join(text.split()))

    def test_the_cheapest_cost_is_the_formula_s(self):
        """step + (A1 n1 + A2 n2) / A, with half a face test for a step of the hierarchy and one for the k-d tree's."""
        node = re.compile(r"Node (\d+), on level \d+: (\d+) faces in \(([^)]*)\) to \(([^)]*)\)")

        def part_of(words):
            low, high = ([float(x) for x in point.split(", ")] for point in words[2:])
            x, y, z = (b - a for a, b in zip(low, high))
            return x * y + y * z + z * x, int(words[1])
        for accel, step in (("bvh", 0.5), ("kdtree", 1)):
            for scene in (GALLERY, ORIGINAL):
                out = self.run_program("tree", scene, "-a", accel, "--step", "3")[0].decode()
                whole, low, high = (part_of(words) for words in node.findall(out))
                cheapest = float(re.search(r"(?m)(\S+)  cheapest$", out)[1])
                if high[1] and low[1] and "set apart" not in out.split("Step 2")[0]:
                    cost = step + (low[0] * low[1] + high[0] * high[1]) / whole[0]
                    self.assertAlmostEqual(cheapest, cost, delta=1e-4 * cost)

    def test_every_plane_is_listed_where_all_are_wanted(self):
        row = re.compile(r"(?m)^ +(\S+) +(\d+) +(\d+) +(\S+)( +cheapest)?$")
        for accel in ("kdtree", "bvh"):
            words = ("tree", GALLERY, "-a", accel, "--step", "6")
            few, many = (self.run_program(*words, *more)[0].decode() for more in ((), ("--verbose",)))
            self.assertIn("the 8 cheapest:", few)
            self.assertNotIn("the 8 cheapest:", many)
            for step, whole in zip(few.split("Step ")[1:], many.split("Step ")[1:]):
                shown, tried = row.findall(step), row.findall(whole)
                counts = [int(count) for count in re.findall(r"(?m)^    [xyz]: (\d+) plane", whole)]
                self.assertEqual(len(tried), sum(counts))
                self.assertLessEqual(set(shown), set(tried))
                self.assertEqual([plane for plane in shown if plane[4]], [plane for plane in tried if plane[4]])
                self.assertEqual(len(shown), sum(min(count, 8) for count in counts))


class Drawing(CommandTest):
    def rectangles_of(self, scene, accel):
        self.run_program("tree", scene, "-a", accel, "-o", "tree.svg")
        root = xml.etree.ElementTree.fromstring(self.bytes_of("tree.svg"))
        return list(root.iter("{http://www.w3.org/2000/svg}rect"))

    def test_the_svg_is_well_formed_and_has_a_rectangle_for_each_node_in_each_panel(self):
        """The boxes of the original scene lie close together on a large floor: they are shown once more."""
        for scene, panels in ((ORIGINAL, 4), (GALLERY, 2)):
            for accel, column in (("kdtree", 0), ("bvh", 0)):
                nodes = rows_of(self.run_program("tree", scene, "-a", accel)[0].decode())["nodes"][column]
                rectangles = self.rectangles_of(scene, accel)
                boxes = [e for e in rectangles if e.get("class", "").startswith("level")]
                self.assertEqual(len(boxes), panels * nodes)
                self.assertEqual(len([e for e in rectangles if e.get("class") == "zoom"]), panels - 2)

    def test_a_crowd_of_small_leaves_fills_a_panel_of_its_own(self):
        self.run_program("generate", "city", "--size", "30", "-o", "city.json")
        for accel in ("kdtree", "bvh"):
            rectangles = self.rectangles_of("city.json", accel)
            zooms = [e for e in rectangles if e.get("class") == "zoom"]
            papers = [e for e in rectangles if e.get("class") == "paper"]
            self.assertEqual((len(zooms), len(papers)), (2, 4))
            for zoom, paper in zip(zooms, papers):  # before, it is this small
                self.assertLess(float(zoom.get("width")), float(paper.get("width")) / 3)


class Chapter(unittest.TestCase):
    """In docs/trees.md a block after "```console" holds a command, and the block after it lines of what it prints."""

    def test_its_numbers_are_the_program_s(self):
        with open("docs/trees.md", encoding="utf-8") as file:
            page = file.read()
        blocks = re.findall(r"^```console\n\$ ([^\n]*)\n```\n+```text\n(.*?)^```", page, re.M | re.S)
        self.assertGreater(len(blocks), 3)
        for command, shown in blocks:
            words = shlex.split(command)
            printed = subprocess.run([PROGRAM, *words[1:]], capture_output=True, encoding="utf-8", check=True).stdout
            for line in shown.splitlines():
                if line != "..." and " ms" not in line:
                    with self.subTest(command):
                        self.assertIn(line, printed.splitlines())

    def test_its_tests_per_ray_are_those_of_the_statistics(self):
        """Of the scenes that are quick: those of scenes/, and two that are generated."""
        with open("docs/trees.md", encoding="utf-8") as file:
            table = file.read().split("tests per ray:")[1].split("\n\n")[0]
        rows = {row[1]: row[2:-1] for row in (re.split(r" *\| *", line) for line in table.splitlines()[3:])}
        generated = {"menger-2": ("menger", "2"), "city-1k": ("city", "1000")}
        checked = [*(name for name in rows if os.path.exists(f"scenes/{name}.json")), *generated]
        self.assertEqual(len(checked), 6)
        with tempfile.TemporaryDirectory() as folder:
            for name in checked:
                scene = f"scenes/{name}.json"
                if name in generated:
                    kind, size = generated[name]
                    scene = f"{folder}/{name}.json"
                    subprocess.run([PROGRAM, "generate", kind, "--size", size, "-o", scene], check=True)
                trees = [self.per_ray(scene, accel) for accel in ("kdtree", "bvh")]
                self.assertEqual(rows[name][2:], [f"{count:.2f}" for tree in trees for count in tree], name)
                if name not in generated:
                    self.assertEqual(rows[name][1], f"{self.per_ray(scene, 'none', '80x45')[1]:.2f}", name)

    @staticmethod
    def per_ray(scene, accel, size="480x270"):
        """Boxes and faces tested for each ray."""
        words = ("-b", "reference", "--grid", "1", "--size", size, "--accel", accel, "--stats", "-q", "-o", "/dev/null")
        stats = subprocess.run([PROGRAM, "render", scene, *words], capture_output=True, encoding="utf-8", check=True)
        counts = {label: int(count) for label, count in re.findall(r"(?m)^(\w+ \w+) +(\d+)$", stats.stdout)}
        rays = counts["primary rays"] + counts["shadow rays"] + counts["reflected rays"]
        return counts["box tests"] / rays, counts["face tests"] / rays


if __name__ == "__main__":
    unittest.main(verbosity=2)
