#!/usr/bin/env python3
"""render --region: what it writes beside the pixels, which tests/test_region.c compares, and what it refuses."""
import json
import unittest

from support.pictures import pfm_values, png_16_bits, ppm_values
from support.program import CommandTest, png_pixels


def cut(rows, column, row, columns, count):
    return [line[column:column + columns] for line in rows[row:row + count]]


class Regions(CommandTest):
    def pictured(self, name, *words):
        self.render("-o", name, "-q", *words)
        return self.bytes_of(name)

    def test_every_format_has_the_pixels_of_the_whole(self):
        region = ("--region", "3,1,4x5")
        whole = png_pixels(self.pictured("a.png"))
        self.assertEqual(png_pixels(self.pictured("b.png", *region)), cut(whole, 3, 1, 4, 5))
        columns, rows, _, values = ppm_values(self.pictured("b.ppm", *region))
        self.assertEqual((columns, rows), (4, 5))
        self.assertEqual(list(values), [v for line in cut(whole, 3, 1, 4, 5) for pixel in line for v in pixel])
        fine = png_16_bits(self.pictured("a16.png", "--depth", "16"))
        fine = [fine[row * 24:row * 24 + 24] for row in range(6)]
        expected = [v for line in cut(fine, 9, 1, 12, 5) for v in line]
        self.assertEqual(png_16_bits(self.pictured("b16.png", "--depth", "16", *region)), expected)
        linear = pfm_values(self.pictured("a.pfm"))
        self.assertEqual(pfm_values(self.pictured("b.pfm", *region)), cut(linear, 9, 1, 12, 5))

    def test_maps_are_cut_out_too(self):
        region = ("--region", "2,2,5x3", "-o", "part.png")
        for kind, *scale in (["normal"], ["face"], ["tests", "--map-scale", "1:100"],
                             ["depth", "--map-scale", "0.5:4"]):
            self.render("--map", kind, "whole-map.png", "-o", "whole.png", *scale)
            self.render("--map", kind, "part-map.png", *region, *scale)
            whole = png_pixels(self.bytes_of("whole-map.png"))
            self.assertEqual(png_pixels(self.bytes_of("part-map.png")), cut(whole, 2, 2, 5, 3), kind)

    def test_a_map_has_the_scale_of_its_region(self):
        _, all_of_it = self.render("--map", "depth", "m.png", "-o", "a.png")
        _, middle = self.render("--map", "depth", "m.png", "-o", "a.png", "--region", "3,2,2x2")
        self.assertNotEqual(all_of_it.split("from")[1].split("\n")[0], middle.split("from")[1].split("\n")[0])

    def test_a_mark_counts_in_the_whole_picture(self):
        _, whole = self.render("--mark", "4,3", "-o", "a.png")
        _, part = self.render("--mark", "4,3", "-o", "b.png", "--region", "3,2,4x3")
        self.assertEqual(part.splitlines()[:3], whole.splitlines()[:3])
        _, err = self.render("--mark", "2,3", "-o", "c.png", "--region", "3,2,4x3", status=2)
        self.assertEqual(err, "rectray: --mark 2,3 is outside the region, whose pixels are 3,2 to 6,4\n")

    def test_the_message_tells_the_size_of_the_file(self):
        _, err = self.render("-o", "a.png", "--region", "3,2,4x3")
        self.assertIn("a.png: 4 x 3 pixels in", err)

    def test_statistics_count_what_was_traced(self):
        out, _ = self.render("-o", "a.png", "--region", "3,2,4x3", "--stats=json")
        self.assertEqual(json.loads(out)["rays"]["primary"], 12)

    def test_progress_reaches_the_end(self):
        _, err = self.render("-o", "a.png", "--region", "0,4,8x2", "--progress", "always")
        self.assertIn("100 %", err)

    def test_a_region_of_one_colour_is_no_reason_for_a_hint(self):
        _, err = self.render("-o", "a.png", "--region", "0,0,1x1")
        self.assertEqual(len(err.splitlines()), 1, err)

    def test_the_size_is_that_of_the_option(self):
        self.render("-o", "a.png", "-s", "80x60", "--region", "40,30,40x30")
        self.assertEqual(len(png_pixels(self.bytes_of("a.png"))), 30)

    def test_regions_beyond_the_picture_are_refused(self):
        for region, message in (
            ("3,2,6x4", "--region reaches beyond the picture of 8 x 6 pixels; from 3,2 on there are 5x4"),
            ("3,2,5x5", "--region reaches beyond the picture of 8 x 6 pixels; from 3,2 on there are 5x4"),
            ("8,2,1x1", "--region begins at 8,2, outside the picture, whose pixels are 0,0 to 7,5"),
            ("0,6,1x1", "--region begins at 0,6, outside the picture, whose pixels are 0,0 to 7,5"),
        ):
            _, err = self.render("-o", "a.png", "--region", region, status=2)
            self.assertEqual(err, f"rectray: {message}\n")
        for wrong in ("", "1,2", "1,2,3", "1,2,0x3", "1,2,3x0", "-1,2,3x4", "1,2,3x4x5", "16384,0,1x1", "1,2,16385x1"):
            _, err = self.render("-o", "a.png", "--region", wrong, status=2)
            self.assertIn("expected a corner and a size in pixels, such as 320,240,64x48", err)
        self.assertEqual(self.files(), [])


if __name__ == "__main__":
    unittest.main()
