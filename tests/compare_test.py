#!/usr/bin/env python3
"""`compare` against figures worked out here, on pictures made here."""
import math
import re
import struct
import unittest
import zlib

from support.program import CommandTest


def png(columns, rows, pixels, color_type=2):
    """A PNG of 8-bit samples, made here."""
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    row = len(pixels) // rows
    raw = b"".join(b"\0" + bytes(pixels[i * row:(i + 1) * row]) for i in range(rows))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", columns, rows, 8, color_type, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b""))


class Compare(CommandTest):
    A = [10, 20, 30, 40, 50, 60, 70, 80, 90, 100, 110, 120]

    def setUp(self):
        super().setUp()
        b = self.A.copy()
        b[0] += 3
        b[4] -= 1
        for name, data in (("a.png", png(2, 2, self.A)), ("b.png", png(2, 2, b)), ("c.png", png(4, 1, self.A)),
                           ("rgba.png", png(2, 2, [x for i in range(4) for x in self.A[3 * i:3 * i + 3] + [i]], 6))):
            with open(self.path(name), "wb") as file:
                file.write(data)

    def test_figures(self):
        out, err = self.run_program("compare", "a.png", "b.png", status=1)
        rows = {line.split()[0]: line.split()[1:] for line in out.decode().splitlines() if line.strip()}
        self.assertEqual(rows["red"], ["3", "0.750000"])
        self.assertEqual(rows["green"], ["1", "0.250000"])
        self.assertEqual(rows["blue"], ["0", "0.000000"])
        self.assertEqual(rows["rmse"], ["%.6f" % math.sqrt(10 / 12)])
        self.assertEqual(rows["psnr"], ["%.2f" % (10 * math.log10(255 ** 2 / (10 / 12))), "dB"])
        self.assertEqual(rows["differing"][:4], ["2", "of", "4", "pixels"])
        self.assertIn("a.png and b.png differ by up to 3 of 255, 0 is tolerated", err)

    def test_equal_pictures_are_0(self):
        out, err = self.run_program("compare", "a.png", "rgba.png")
        self.assertIn("psnr      infinite", out.decode())
        self.assertEqual(err, "")

    def test_the_tolerance_is_the_largest_difference_allowed(self):
        self.run_program("compare", "a.png", "b.png", "--tolerance", "3")
        self.run_program("compare", "a.png", "b.png", "--tolerance", "2", status=1)
        self.assertEqual(self.run_program("compare", "-q", "a.png", "b.png", "--tolerance", "3"), (b"", ""))

    def test_the_picture_of_the_differences(self):
        self.run_program("compare", "a.png", "b.png", "-o", "diff.png", status=1)
        with open(self.path("expected.png"), "wb") as file:
            file.write(png(2, 2, [255, 0, 0, 0, 85, 0] + [0] * 6))
        self.run_program("compare", "diff.png", "expected.png")
        out, err = self.run_program("compare", "a.png", "b.png", "-o", "-", "--tolerance", "9")
        self.assertEqual(out, self.bytes_of("diff.png"))
        self.assertIn("rmse", err)

    def test_the_heatmap_is_black_where_they_are_equal_and_brighter_for_more(self):
        greys = [x for i in (0, 1, 2, 8, 30, 100, 255) for x in (0, i, i // 2)]
        for name, data in (("black.png", [0] * 21), ("greys.png", greys)):
            with open(self.path(name), "wb") as file:
                file.write(png(7, 1, data))
        out, _ = self.run_program("compare", "black.png", "greys.png", "--heatmap", "heat.png", "--tolerance", "255")
        self.assertIn("heatmap   black 0, violet 1, ", out.decode())
        self.run_program("compare", "heat.png", "heat.png")
        rows = zlib.decompress(re.search(b"IDAT(.*)....IEND", self.bytes_of("heat.png"), re.S)[1][:-4])
        pixels = [rows[i:i + 3] for i in range(1, 22, 3)]
        bright = [0.30 * r + 0.59 * g + 0.11 * b for r, g, b in pixels]
        self.assertEqual((pixels[0], pixels[6]), (b"\0\0\0", b"\xff\xff\xff"))
        self.assertGreater(bright[1], 50)
        self.assertEqual(bright, sorted(set(bright)))
        out, err = self.run_program("compare", "black.png", "greys.png", "--heatmap", "-", "-o", "diff.png", status=1)
        self.assertEqual(out, self.bytes_of("heat.png"))
        self.assertIn("heatmap", err)

    def test_the_two_pictures_of_the_differences_have_two_names(self):
        self.assertIn("both cannot be x.png",
                      self.run_program("compare", "a.png", "b.png", "-o", "x.png", "--heatmap", "x.png", status=2)[1])
        self.assertIn("both cannot be -",
                      self.run_program("compare", "a.png", "b.png", "-o", "-", "--heatmap", "-", status=2)[1])

    def test_pictures_that_cannot_be_compared_are_1(self):
        self.assertIn("2 x 2 pixels", self.run_program("compare", "a.png", "c.png", status=1)[1])
        self.assertIn("neither a PNG nor a PPM", self.run_program("compare", "a.png", "scene.json", status=1)[1])
        for name in ("missing.png", "."):
            self.assertRegex(self.run_program("compare", name, "a.png", status=1)[1], rf"^{name}: cannot be read: ")


if __name__ == "__main__":
    unittest.main(verbosity=2)
