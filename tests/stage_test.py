"""A model without a scene is shown on a stage: whole, on its floor, from any folder; and the scene can be had."""
import json
import os
import unittest

from support.program import CommandTest, png_pixels

CUBE = ("v 5 5 5\nv 6 5 5\nv 6 6 5\nv 5 6 5\nv 5 5 6\nv 6 5 6\nv 6 6 6\nv 5 6 6\n"
        "f 1 2 3 4\nf 5 6 7 8\nf 1 2 6 5\nf 4 3 7 8\nf 1 4 8 5\nf 2 3 7 6\n")


class Stage(CommandTest):
    def setUp(self):
        super().setUp()
        os.mkdir(self.path("models"))
        self.put("models/cube.obj", CUBE)

    def scene(self, *words):
        return json.loads(self.run_program("render", "models/cube.obj", "--stage", *words)[0])

    def test_the_scene_is_the_one_that_is_rendered(self):
        self.run_program("render", "models/cube.obj", "-b", "reference", "--size", "40x30", "--grid", "1")
        self.put("stage.json", json.dumps(self.scene()))
        self.run_program("render", "stage.json", "-b", "reference", "--size", "40x30", "--grid", "1", "-o", "b.png")
        self.assertEqual(self.bytes_of("cube.png"), self.bytes_of("b.png"))
        self.assertGreater(len({pixel for row in png_pixels(self.bytes_of("b.png")) for pixel in row}), 20)

    def test_the_model_is_whole_in_the_picture_and_stands_on_the_floor(self):
        for stretch in ("1,1,1", "20,1,1", "1,20,1", "1,1,20", "0.01,0.01,0.01"):
            factors = list(map(float, stretch.split(",")))
            scaled = "".join("v " + " ".join(str(float(x) * f) for x, f in zip(line.split()[1:], factors)) + "\n"
                             if line.startswith("v ") else line + "\n" for line in CUBE.splitlines())
            self.put("models/cube.obj", scaled)
            self.run_program("render", "models/cube.obj", "-b", "reference", "--size", "80x60", "--grid", "1", "--map",
                             "face", "face.png", "-o", "a.png")
            out = self.run_program("trace", "models/cube.obj", "--face", "cube.obj", "--size", "80x60", "--grid", "1",
                                   "--format", "json")[0]
            self.assertTrue(json.loads(out))
            rows = png_pixels(self.bytes_of("face.png"))
            floor = rows[59][40]
            border = {pixel for pixel in rows[0] + rows[59] + [row[0] for row in rows] + [row[79] for row in rows]}
            self.assertLessEqual(border, {floor, (0, 0, 0)}, stretch)
            low = min(y for _, y, _ in self.scene()["objects"][1]["vertices"])
            self.assertLess(low, 5 * factors[1])
            self.assertGreater(low, 5 * factors[1] - 0.1 * max(factors))

    def test_it_can_be_changed_and_checked(self):
        self.assertIn(b"7 \n".strip(), self.run_program("check", "models/cube.obj")[0])
        self.run_program("render", "models/cube.obj", "-b", "reference", "--size", "8x6", "-o", "a.png", "--set",
                         "objects[0].transform=[{\"scale\": 2}]")

    def test_mistakes(self):
        self.assertIn("missing.obj: cannot be opened", self.run_program("render", "missing.obj", status=1)[1])
        self.assertIn("does not end in .obj", self.run_program("render", "scene.json", "--stage", status=2)[1])
        self.put("bad.obj", "v 0 0 0\nf 1 2 3\n")
        self.assertIn("bad.obj:2: ", self.run_program("render", "bad.obj", status=1)[1])

    def test_a_pixel_as_an_operand_gets_a_hint(self):
        _, err = self.run_program("trace", "scene.json", "10,10", status=2)
        self.assertIn("did you mean --pixel 10,10?", err)


if __name__ == "__main__":
    unittest.main(verbosity=2)
