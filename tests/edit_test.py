"""Options that change the scene: the result is that of a file in which the change was typed."""
import json
import unittest

from support.program import SCENE, CommandTest


class Edit(CommandTest):
    def assert_same(self, words, **changes):
        """The scene with the options is the changed scene, in a picture and in what check tells."""
        self.put("changed.json", json.dumps({**SCENE, **changes}))
        self.render("-o", "a.png", *words)
        self.run_program("render", "changed.json", "-b", "reference", "-o", "b.png")
        self.assertEqual(self.bytes_of("a.png"), self.bytes_of("b.png"))
        out, _ = self.run_program("check", "scene.json", *words)
        expected, _ = self.run_program("check", "changed.json")
        self.assertEqual(out, expected.replace(b"changed.json", b"scene.json"))

    def test_the_camera(self):
        camera = {"position": [1000.2, 0.4, 2], "look_at": [1000.5, 0.6, 0], "up": [1, 0.5, 0]}
        self.assert_same(["--camera", "1000.2,0.4,2", "--look-at", "1000.5,0.6,0", "--up", "1,0.5,0"], camera=camera)

    def test_a_light(self):
        self.assert_same(["--light", "0=1000,0,3"], lights=[{"position": [1000, 0, 3]}])

    def test_any_value(self):
        self.assert_same(["--set", "screen.columns=16", "--set", "shading.max_bounces=2", "--set",
                          "shading.background=[0,0,1]"], screen={"columns": 16, "rows": 6},
                         shading={"max_bounces": 2, "background": [0, 0, 1]})
        self.assert_same(["--set", "shading.viewer=ray"], shading={"viewer": "ray"})
        materials = {**SCENE["materials"], "pink": {"ambient": [0.1, 0, 0.1], "diffuse": [0.7, 1, 0.7]}}
        self.assert_same(["--set", "materials.pink.diffuse[1]=1"], materials=materials)

    def test_every_reading_command_takes_them(self):
        for words in (["trace", "scene.json", "--pixel", "1,1"], ["check", "scene.json"], ["tree", "scene.json"]):
            self.run_program(*words, "--set", "shading.max_bounces=1")
        self.run_program("cast", "scene.json", "-b", "reference", "--set", "shading.max_bounces=1", text_in="")

    def test_the_file_stays_as_it_is(self):
        before = self.bytes_of("scene.json")
        self.render("-o", "a.png", "--set", "screen.columns=16")
        self.assertEqual(self.bytes_of("scene.json"), before)

    def test_a_scene_from_a_pipe(self):
        self.run_program("render", "-", "-b", "reference", "-o", "a.png", "--set", "screen.columns=3",
                         text_in=json.dumps(SCENE))
        self.assertEqual(self.bytes_of("a.png")[16:20], b"\0\0\0\3")

    def test_mistakes_name_the_option(self):
        _, err = self.run_program("check", "scene.json", "--set", "screen.columns=0", status=1)
        self.assertRegex(err, r"^scene.json:1:\d+: screen.columns: must be from 1 to 16384, not 0\n.*\n.*\n"
                              r"read with --set screen.columns=0\n$")
        _, err = self.run_program("check", "scene.json", "--set", "camera.up=[0,0,1]", "--light", "7=1,2,3", status=2)
        self.assertEqual(err, "rectray: --light 7=1,2,3: lights has no [7]\n")
        for words in (["--set", "x"], ["--set", "=1"], ["--camera", "1,2"], ["--light", "1,2,3"], ["--up", "a,b,c"]):
            self.assertIn(words[0], self.run_program("check", "scene.json", *words, status=2)[1])

    def test_a_long_mistake_keeps_its_reason(self):
        _, err = self.run_program("check", "scene.json", "--set", "a." * 40000 + "a=1", status=2)
        self.assertRegex(err, r"^rectray: --set (a\.){100}\.\.\.: a path has at most 64 steps\n$")

    def test_a_broken_file_is_told_before_the_path(self):
        self.put("broken.json", '{"camera": }')
        self.assertRegex(self.run_program("check", "broken.json", "--set", "x.y=1", status=1)[1], "^broken.json:1:12: ")


if __name__ == "__main__":
    unittest.main(verbosity=2)
