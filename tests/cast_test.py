#!/usr/bin/env python3
"""The numbers that programs read: `cast`, and `check --geometry` as docs/commands.md gives its format."""
import json
import math
import os
import signal
import struct
import subprocess
import unittest

from support.program import SCENE, CommandTest


class Cast(CommandTest):
    HEADER = "ray,face,t,px,py,pz,nx,ny,nz"

    def cast(self, text, *words, status=0):
        out, err = self.run_program("cast", "scene.json", *words, text_in=text, status=status)
        lines = out.decode().splitlines()
        self.assertEqual(lines[0], self.HEADER)
        return [line.split(",") for line in lines[1:]], err

    def test_rays_with_commas_are_told_of_blanks(self):
        for line in ("1000,0.5,5,0,0,-1", "1000, 0.5, 5, 0, 0, -1", "1000,25 0 5 0 0 -1"):
            self.assertIn("is not a finite number; blanks separate the numbers, and a point their fractions",
                          self.cast(line + "\n", "-b", "reference", status=1)[1])

    def test_hits_and_misses_on_both_backends(self):
        rays = "1000.25 0.5 2 0 0 -1\n\n1000.75 0.25 -1 0 0 4\n1000.75 0.25 1 0 0 1\n1000.75 0.25 -1 0.0 0 -0.5\n"
        for words in (["-b", "reference"], ["--precision", "double"], []):
            rows, err = self.cast(rays, *words)
            self.assertEqual(err, "")
            self.assertEqual([row[:2] for row in rows], [["0", "0"], ["1", "0"], ["2", "-1"], ["3", "1"]])
            numbers = [[float(x) for x in row[2:]] for row in rows if row[1] != "-1"]
            self.assertEqual(numbers[0], [2, 1000.25, 0.5, 0, 0, 0, 1])
            self.assertEqual(numbers[1], [0.25, 1000.75, 0.25, 0, 0, 0, -1]) # from behind: N turned to the ray
            self.assertEqual(numbers[2], [2, 1000.75, 0.25, -2, 0, 0, 1])
            self.assertEqual(rows[2][2:], [""] * 7)
            self.assertNotIn("-0", ",".join(rows[0]))

    def test_one_sided_faces_let_rays_through_from_behind(self):
        self.assertEqual(self.cast("1000.75 0.25 -5 0 0 1\n", "-b", "reference")[0][0][:3], ["0", "0", "5"])

    def test_directions_of_any_length(self):
        for scale in (1e-50, 1e-3, 3.0, 1e50):
            for words in (["-b", "reference"], ["--precision", "double"], ["--precision", "float"]):
                rows, _ = self.cast(f"1000.25 0.5 2 0 0 {-scale!r}\n", *words)
                self.assertTrue(math.isclose(float(rows[0][2]) * scale, 2, rel_tol=1e-6), rows)

    def test_numbers_have_17_digits(self):
        rows, _ = self.cast("1000.1 0.3 2 0.01 0.01 -3\n", "-b", "reference")
        t = float(rows[0][2])
        self.assertEqual(t, 2 / 3)
        self.assertEqual(float(rows[0][3]), 1000.1 + t * 0.01)
        self.assertEqual(repr(t), repr(float("%.17g" % t)))

    def test_rays_come_from_a_file_or_a_pipe(self):
        self.put("rays.txt", "1000.25 0.5 2 0 0 -1")
        self.assertEqual(len(self.cast("", "--rays", "rays.txt", "-b", "reference")[0]), 1)
        os.mkfifo(self.path("pipe"))
        writer = subprocess.Popen(["sh", "-c", f"cat {self.path('rays.txt')} > {self.path('pipe')}"])
        self.assertEqual(len(self.cast("", "-r", "pipe", "-b", "reference")[0]), 1)
        writer.wait()
        self.assertEqual(self.cast("", "--rays", "-", "-b", "reference")[0], [])

    def test_any_number_of_rays(self):
        count = 300001
        rows, _ = self.cast("1000.25 0.5 2 0 0 -1\n" * count, "-b", "reference")
        self.assertEqual(len(rows), count)
        self.assertEqual(rows[-1][:3], [str(count - 1), "0", "2"])
        self.assertEqual([row[0] for row in rows], [str(i) for i in range(count)])

    def test_bad_rays_are_told_with_their_line(self):
        good = "0 0 0 0 0 1\n"
        for bad in ("1 2 3 4 5", "1 2 3 4 5 6 7", "1 2 3 4 5 x", "1 2 3 4 5 1e999", "1 2 3 4 5 nan", "1 2 3 0 0 0",
                    "1,2,3,4,5,6", "1 2 3 4 5 0x1", "1e30 0 0 0 0 1", "0 0 0 0 1e-200 1", "\0"):
            _, err = self.cast(good + bad + "\n" + good, "-b", "reference", status=1)
            self.assertRegex(err, r"^standard input:2: ")
        self.put("rays.txt", "1 2\n")
        self.assertRegex(self.cast("", "--rays", "rays.txt", status=1)[1], r"^rays.txt:1: ")
        for name in ("missing.txt", "."):
            _, err = self.run_program("cast", "scene.json", "-b", "reference", "--rays", name, status=1)
            self.assertRegex(err, rf"^{name}: cannot be ")

    def test_stats_do_not_mix_with_the_hits(self):
        rows, err = self.cast("1000.25 0.5 2 0 0 -1\n" * 3, "-b", "reference", "--stats=json")
        self.assertEqual(len(rows), 3)
        self.assertEqual(json.loads(err)["rays"]["primary"], 3)

    def test_an_early_end_of_the_reader_stops_it(self):
        self.put("rays.txt", "1000.25 0.5 2 0 0 -1\n" * 200000)
        process = self.start("cast", "scene.json", "-b", "reference", "--rays", "rays.txt")
        process.stdout.readline()
        process.stdout.close()
        err = process.stderr.read().decode()
        process.stderr.close()
        self.assertEqual(process.wait(timeout=60), -signal.SIGPIPE)
        self.assertEqual(err, "")


class Check(CommandTest):
    def test_it_tells_what_the_scene_holds_needs_and_can_skip(self):
        out = self.run_program("check", "scene.json")[0].decode()
        self.assertIn("scene.json: a valid scene", out)
        self.assertIn("8 x 6 pixels", out)
        self.assertRegex(out, r"faces +2\n")
        self.assertRegex(out, r"1 of them triangles")
        self.assertRegex(out, r"primary rays +48\n")
        self.assertIn("reflected rays: no face reflects", out)
        self.assertIn('material "unused "one"": no face has it', out)
        self.assertEqual(self.run_program("check", "-q", "scene.json"), (b"", ""))

    def test_a_name_cannot_write_on_the_terminal(self):
        scene = dict(SCENE, materials=dict(SCENE["materials"], **{"red\x1b[31m\n": {}}))
        self.put("named.json", json.dumps(scene))
        self.assertIn('material "red?[31m?": no', self.run_program("check", "named.json")[0].decode())

    def test_geometry_gives_every_face_exactly(self):
        """Reads the format as docs/commands.md says."""
        lines = self.run_program("check", "scene.json", "--geometry")[0].decode().splitlines()
        self.assertEqual(lines[0], "# rectray geometry 1")
        centre, names, faces = None, {"object": [], "material": []}, []
        for line in lines[1:]:
            keyword, rest = line.split(" ", 1)
            if keyword == "centre":
                centre = [float.fromhex(word) for word in rest.split()]
            elif keyword in names:
                index, name = rest.split(" ", 1)
                self.assertEqual(int(index), len(names[keyword]))
                names[keyword].append(json.loads(name))
            else:
                self.assertEqual(keyword, "face")
                number, thing, material, sides, count, *numbers = rest.split()
                numbers = [float.fromhex(word) for word in numbers]
                for x in numbers:
                    self.assertEqual(x, struct.unpack("f", struct.pack("f", x))[0])
                corners = [[numbers[3 * k + i] + centre[i] for i in range(3)] for k in range(int(count))]
                self.assertEqual(len(numbers), 3 * int(count))
                faces.append((int(number), names["object"][int(thing)], names["material"][int(material)], sides,
                              corners))
        self.assertEqual(names["material"], ["pink", 'unused "one"'])
        for face, thing, sides, i in zip(faces, SCENE["objects"], ("both", "front"), range(2)):
            corners = [[float(x) for x in vertex] for vertex in thing["vertices"]]
            self.assertEqual(face, (i, thing["name"], "pink", sides, corners))
        self.assertEqual(len(faces), 2)


if __name__ == "__main__":
    unittest.main(verbosity=2)
