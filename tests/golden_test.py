#!/usr/bin/env python3
"""What `rectray trace` prints, kept as text, so that a change in its wording shows in review: tests/golden/*.txt, and
docs/walkthrough.md, a chapter around such output. Both begin with the command that printed them. docs/rounding.md has
the whole output of each block of commands, or some of its steps, and the pictures that they make.

    python3 tests/golden_test.py --renew (make golden) writes them anew; the difference is then git's to show.

In the chapter a block after "```console" holds the command, and blocks after "```text" hold whole steps of its output,
in order. Functions that it names, `like_this` in `src/file.c`, must be there."""
import base64
import glob
import hashlib
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

from support.program import png_pixels

PROGRAM = os.path.abspath(os.environ.get("RECTRAY", "build/rectray"))
CHAPTER = "docs/walkthrough.md"
LESSONS = "docs/rounding.md"
# Drawings, each by the command that its page gives: `rectray ... -o PATH`.
DRAWINGS = {"docs/images/walkthrough-gallery.svg": CHAPTER, "docs/images/trees-kdtree.svg": "docs/trees.md",
            "docs/images/trees-bvh.svg": "docs/trees.md"}
GOLDEN = sorted(glob.glob("tests/golden/*.txt"))


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def read_bytes(path):
    with open(path, "rb") as file:
        return file.read()


def output_of(command):
    """What the command prints; it begins with `rectray` and names files from the top folder."""
    words = shlex.split(command)
    assert words[0] == "rectray", command
    return subprocess.run([PROGRAM, *words[1:]], capture_output=True, encoding="utf-8", check=True).stdout


def golden_text(path):
    command = read(path).split("\n", 1)[0].removeprefix("$ ")
    return f"$ {command}\n{output_of(command)}"


def without_compression(svg):
    """The drawing with the pixels of its embedded picture, which libraries of several versions compress differently."""
    def pixels(match):
        return hashlib.sha256(repr(png_pixels(base64.b64decode(match.group(1)))).encode()).hexdigest()
    return re.sub(r"data:image/png;base64,([^']*)", pixels, svg)


def drawing_text(path):
    command = re.search(rf"`(rectray [^`]*) -o\s+{re.escape(path)}`", read(DRAWINGS[path])).group(1)
    with tempfile.TemporaryDirectory() as folder:
        output_of(f"{command} -o {folder}/drawing.svg")
        return read(f"{folder}/drawing.svg")


def parts_of(output):
    """The summary, what stands before the steps, the steps, each under its first line, and the last line of all."""
    parts = {}
    for part in re.split(r"\n(?=Step \d+\. |Step by step\n|Pixel \(.*\n\Z)", output):
        parts[part.split("\n", 1)[0]] = part.rstrip("\n")
    return parts


def chapter_text():
    """The chapter with each block of output written anew: the steps that it has now, by their headings."""
    parts = {}

    def part(heading):
        """By the heading without what may change in it: "Step 3", "Pixel (1, 2) of", "Pixel (1, 2) ="."""
        fixed = re.match(r"Step by step|Step \d+|Pixel \(.*?\) \S+", heading).group(0)
        same = re.compile(re.escape(fixed) + r"\b|" + re.escape(fixed) + " ")
        found = [text for line, text in parts.items() if same.match(line)]
        return found[0] if found else heading + "\n(no longer there)"

    def renewed(match):
        if match.group(1) == "console":
            parts.clear()
            parts.update(parts_of(output_of(match.group(2).strip().removeprefix("$ "))))
            return match.group(0)
        headings = re.findall(r"(?m)^(?:Step by step|Step \d+\. .*|Pixel \(.*\) of .*)", match.group(2))
        headings += re.findall(r"(?m)^Pixel .* = .*", match.group(2))[1 if "Pixel" in "".join(headings) else 0:]
        return "```text\n" + "\n\n".join(map(part, headings)) + "\n```\n"

    return re.sub(r"^```(console|text)\n(.*?)^```\n", renewed, read(CHAPTER), flags=re.M | re.S)


def run_lines(lines, folder):
    """What the commands print; `rectray compare` ends with 1 where pictures differ."""
    out = ""
    for line in lines.strip().split("\n"):
        words = shlex.split(line.removeprefix("$ "))
        run = subprocess.run([PROGRAM, *words[1:]], cwd=folder, capture_output=True, encoding="utf-8", check=False)
        assert run.returncode == 0 or (words[1] == "compare" and run.returncode == 1), line + run.stderr
        out += run.stdout
    return out


def lessons(folder):
    """The page with each block of output written anew. Its pictures, by their paths in docs/, are in the folder."""
    os.symlink(os.path.abspath("scenes"), os.path.join(folder, "scenes"))
    pictures = {}

    def steps_of(out, shown):
        """Of a block that begins with a step, the steps that it shows."""
        headings = re.findall(r"(?m)^Step \d+", shown) if shown.startswith("Step ") else []
        parts = parts_of(out)
        return "\n\n".join(next(parts[line] for line in parts if line.startswith(f"{heading}. "))
                           for heading in headings) or out

    def renewed(match):
        out = steps_of(run_lines(match.group(1), folder), match.group(2))
        if "--heatmap apart.png" in match.group(1):
            lesson = re.search(r"scenes/lessons/(\w+)\.json", match.group(1)).group(1)
            for name in ("textbook", "exact", "apart"):
                path = f"images/rounding-{lesson}-{name}.png"
                pictures[path] = os.path.join(folder, f"{lesson}-{name}.png")
                shutil.copy(os.path.join(folder, f"{name}.png"), pictures[path])
        return f"```console\n{match.group(1)}```\n\n```text\n{out.rstrip()}\n```\n"

    text = re.sub(r"^```console\n(.*?)^```\n\n```text\n(.*?)^```\n", renewed, read(LESSONS), flags=re.M | re.S)
    return text, pictures


class Golden(unittest.TestCase):
    maxDiff = None

    def test_there_are_some(self):
        self.assertGreater(len(GOLDEN), 3)

    def test_each_walkthrough_is_what_it_was(self):
        for path in GOLDEN:
            with self.subTest(f"{path}: `make golden` renews it, `git diff` shows how it changed"):
                self.assertEqual(golden_text(path), read(path))


class Chapter(unittest.TestCase):
    maxDiff = None

    def test_its_output_is_the_program_s(self):
        self.assertEqual(read(CHAPTER), chapter_text(), "`make golden` renews it")

    def test_the_drawings_are_the_program_s(self):
        for path in DRAWINGS:
            same = without_compression(read(path)) == without_compression(drawing_text(path))
            self.assertEqual(same, True, f"{path}: `make golden` renews it")

    def test_it_shows_a_whole_walkthrough(self):
        commands = re.findall(r"^```console\n\$ ([^\n]*)\n```\n(.*?)(?=^```console|\Z)", read(CHAPTER), re.M | re.S)
        self.assertGreaterEqual(len(commands), 2)
        command, rest = commands[0]
        shown = "\n\n".join(block.rstrip("\n") for block in re.findall(r"^```text\n(.*?)^```", rest, re.M | re.S))
        self.assertEqual(re.sub(r"\n+", "\n", shown), re.sub(r"\n+", "\n", output_of(command)).rstrip("\n"))

    def test_the_functions_that_it_names_are_there(self):
        named = re.findall(r"`(\w+)` in `(src/\w+/\w+\.[ch])`", read(CHAPTER))
        self.assertGreater(len(named), 10)
        for function, path in named:
            self.assertRegex(read(path), rf"(?m)^[^\s].*\b{function}\(.*\n\{{", f"{function} in {path}")


def numbers_of(text):
    return set(re.findall(r"\d+(?:\.\d+)?(?:e-?\d+)?", text))


class Lessons(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.text, cls.pictures = lessons(cls.holder.name)

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    def test_the_output_is_the_program_s(self):
        self.assertEqual(read(LESSONS), self.text, "`make golden` renews it")

    def test_there_is_a_lesson_for_each_scene_with_its_pictures(self):
        scenes = [os.path.basename(path)[:-5] for path in glob.glob("scenes/lessons/*.json")]
        self.assertEqual(len(self.pictures), 3 * len(scenes))
        for path, made in self.pictures.items():
            with self.subTest(f"docs/{path}: `make golden` renews it"):
                kept = read_bytes(f"docs/{path}")
                self.assertIn(f"]({path})", self.text)
                self.assertEqual(png_pixels(kept), png_pixels(read_bytes(made)))
                self.assertLess(len(kept), 40000)

    def test_every_lesson_has_its_pixel_its_cure_and_a_proof(self):
        for lesson in re.findall(r"(?ms)^## \d\. (.*?)(?=^## )", self.text):
            with self.subTest(lesson.split("\n")[0]):
                self.assertRegex(lesson, r"(?m)^    They part at P\d, .*\n    textbook: (?s:.)*?;\n    exactly: ")
                self.assertRegex(lesson, r"\*\*The cure\.\*\*(?s:.)*\]\(bounds\.md#[\w-]+\)")

    def test_every_number_of_the_prose_is_printed_or_in_a_scene(self):
        prose = re.sub(r"(?ms)^```.*?^```|\]\([^)]*\)|`[^`]*`|P\d|^## \d|^- .*?(?=^- |^$)", "", self.text)
        printed = "".join(re.findall(r"(?ms)^```text\n(.*?)^```", self.text))
        printed += "".join(map(read, glob.glob("scenes/lessons/*.json")))
        sizes = {re.sub(r"^[\d.]+e", "1e", number) for number in numbers_of(printed) if "e-" in number}
        missing = {number for number in numbers_of(prose) if number not in numbers_of(printed) | sizes}
        self.assertEqual(missing - {"0", "7", "16"}, set())


def renew_lessons():
    with tempfile.TemporaryDirectory() as folder:
        text, pictures = lessons(folder)
        for path, made in pictures.items():
            shutil.copy(made, f"docs/{path}")
    with open(LESSONS, "w", encoding="utf-8") as file:
        file.write(text)


def renew():
    for path in GOLDEN:
        text = golden_text(path)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
    for path in DRAWINGS:
        text = drawing_text(path)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
    text = chapter_text()
    with open(CHAPTER, "w", encoding="utf-8") as file:
        file.write(text)
    renew_lessons()


if __name__ == "__main__":
    if sys.argv[1:] == ["--renew"]:
        renew()
    else:
        unittest.main(verbosity=2)
