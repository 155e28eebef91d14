"""Pictures in every format: the file's ending decides, the values are the same, compare reads all of them."""
import math
import struct
import unittest

from support.pictures import pfm_values, png_16_bits, ppm_values
from support.program import CommandTest, png_pixels


class Formats(CommandTest):
    def rendered(self, name, *words):
        self.render("-o", name, *words)
        return self.bytes_of(name)

    def test_the_values_are_the_same_in_every_format(self):
        png = [value for row in png_pixels(self.rendered("a.png")) for pixel in row for value in pixel]
        columns, rows, largest, ppm = ppm_values(self.rendered("a.ppm"))
        linear = [value for row in pfm_values(self.rendered("a.pfm")) for value in row]
        fine = png_16_bits(self.rendered("fine.png", "--depth", "16"))
        self.assertEqual((columns, rows, largest), (8, 6, 255))
        self.assertEqual(list(ppm), png)
        self.assertEqual(list(ppm_values(self.rendered("fine.ppm", "--depth", "16"))[3]), fine)
        self.assertTrue(any(value > 0 for value in linear))
        for byte, word, value in zip(png, fine, linear):
            clamped = min(max(value, 0), 1)
            self.assertLessEqual(abs(clamped * 255 - byte), 0.5 + 1e-4)
            self.assertLessEqual(abs(clamped * 65535 - word), 0.5 + 1e-2)

    def test_a_pfm_is_not_clamped(self):
        scene = self.bytes_of("scene.json").decode()
        self.put("scene.json", scene.replace('"lights": [{', '"lights": [{"diffuse": [9, 9, 9], '))
        values = [value for row in pfm_values(self.rendered("a.pfm")) for value in row]
        self.assertGreater(max(values), 1.5)

    def test_the_kernel_writes_what_the_reference_writes(self):
        self.run_program("render", "scene.json", "-p", "double", "-o", "kernel.pfm")
        self.rendered("reference.pfm")
        for row, other in zip(pfm_values(self.bytes_of("kernel.pfm")), pfm_values(self.bytes_of("reference.pfm"))):
            for a, b in zip(row, other):
                self.assertTrue(math.isclose(a, b, rel_tol=1e-6, abs_tol=1e-9))

    def test_the_format_overrides_the_ending(self):
        self.assertEqual(self.rendered("a.jpg", "--format", "ppm"), self.rendered("b.ppm"))
        self.assertEqual(self.render("-o", "-", "--format", "pfm")[0], self.rendered("b.pfm"))
        self.assertEqual(self.render("-o", "-")[0], self.rendered("b.PNG"))

    def test_another_ending_is_an_error_that_lists_them(self):
        for words in (["-o", "a.jpg"], ["-o", "a.exr"], ["-o", "a.png", "--map", "rays", "b.gif"]):
            _, err = self.render(*words, status=2)
            self.assertIn("pictures end in .png, .ppm or .pfm", err)
        self.assertEqual(self.files(), [])

    def test_what_does_not_go_together(self):
        for words, message in ((["-o", "a.pfm", "--depth", "16"], "32-bit floats"),
                               (["-o", "a.pfm", "--mark", "1,1"], "8 bits"),
                               (["-o", "a.png", "--map", "rays", "b.pfm"], "a map has 8 bits")):
            self.assertIn(message, self.render(*words, status=2)[1])
        self.assertEqual(self.files(), [])

    def test_a_full_disk_is_told_in_every_format(self):
        for name in ("ppm", "pfm"):
            self.assertIn("No space left", self.render("-o", "/dev/full", "--format", name, status=3)[1])


class Compare(CommandTest):
    def test_png_and_ppm_are_compared_by_their_pixels(self):
        for name in ("a.png", "a.ppm"):
            self.render("-o", name)
        self.render("-o", "fine.ppm", "--depth", "16")
        self.run_program("compare", "a.png", "a.ppm")
        self.run_program("compare", "a.ppm", "fine.ppm", "--tolerance", "1")
        self.put("comment.ppm", "P6 # a comment\n1 # columns\n1\n255\nabc")
        self.run_program("compare", "comment.ppm", "comment.ppm")

    def test_pfm_are_compared_in_linear_colours(self):
        self.render("-o", "a.pfm")
        out, _ = self.run_program("compare", "a.pfm", "a.pfm")
        self.assertRegex(out.decode(), r"rmse +0\n")
        head = b"PF\n1 1\n-1.0\n"
        for name, values in (("b.pfm", (0, 0, 1)), ("c.pfm", (0, 0, 4))):
            with open(self.path(name), "wb") as file:
                file.write(head + struct.pack("<3f", *values))
        with open(self.path("d.pfm"), "wb") as file:  # the other order of bytes
            file.write(b"PF\n1 1\n1.0\n" + struct.pack(">3f", 0, 0, 1))
        out, _ = self.run_program("compare", "b.pfm", "c.pfm", status=1)
        self.assertAlmostEqual(float(out.split()[1]), math.sqrt(3))
        self.run_program("compare", "b.pfm", "d.pfm")

    def test_what_cannot_be_compared(self):
        self.render("-o", "a.png")
        self.render("-o", "a.pfm")
        self.assertIn("compare it with a PFM", self.run_program("compare", "a.png", "a.pfm", status=1)[1])
        self.assertIn("8 bits", self.run_program("compare", "a.pfm", "a.pfm", "--tolerance", "1", status=2)[1])

    def test_damaged_pictures(self):
        cases = (("a.ppm", "P6\n2 2\n255\nabc", "ends too early"), ("b.ppm", "P6\n0 2\n255\n", "head"),
                 ("c.ppm", "P6\n99999 2\n255\n", "too many"), ("d.ppm", "P5\n1 1\n255\na", "neither"),
                 ("a.pfm", "PF\n2 2\n-1.0\nabc", "ends too early"), ("b.pfm", "PF\n2\n", "head"),
                 ("c.pfm", "PF\n99999 1\n-1.0\n", "too many"), ("d.pfm", "PF\n1 1\n0\nabc", "head"))
        for name, text, message in cases:
            self.put(name, text)
            self.assertRegex(self.run_program("compare", name, name, status=1)[1], f"^{name}: .*{message}")


class Maps(CommandTest):
    def test_as_many_as_are_asked_for(self):
        self.render("-o", "a.png", "--map", "rays", "rays.png", "--map", "depth", "depth.png", "--map", "face",
                    "face.ppm")
        self.assertEqual(self.files(), ["a.png", "depth.png", "face.ppm", "rays.png"])
        self.render("-o", "b.png", "--map", "depth", "alone.png")
        self.assertEqual(self.bytes_of("depth.png"), self.bytes_of("alone.png"))

    def test_no_two_into_one_file(self):
        _, err = self.render("-o", "a.png", "--map", "rays", "m.png", "--map", "depth", "m.png", status=2)
        self.assertIn("two maps are to be m.png", err)
        self.assertEqual(self.files(), [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
