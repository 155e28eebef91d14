#!/usr/bin/env python3
"""What `rectray trace` prints, kept as text, so that a change in its wording shows in review: tests/golden/*.txt, and
docs/walkthrough.md, a chapter around such output. Both begin with the command that printed them.

    python3 tests/golden_test.py --renew (make golden) writes them anew; the difference is then git's to show.

In the chapter a block after "```console" holds the command, and blocks after "```text" hold whole steps of its output,
in order. Functions that it names, `like_this` in `src/file.c`, must be there."""
import glob
import os
import re
import shlex
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.path.abspath(os.environ.get("RECTRAY", "build/rectray"))
CHAPTER = "docs/walkthrough.md"
# Drawings, each by the command that its page gives: `rectray ... -o PATH`.
DRAWINGS = {"docs/images/walkthrough-gallery.svg": CHAPTER, "docs/images/trees-kdtree.svg": "docs/trees.md",
            "docs/images/trees-bvh.svg": "docs/trees.md"}
GOLDEN = sorted(glob.glob("tests/golden/*.txt"))


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def output_of(command):
    """What the command prints; it begins with `rectray` and names files from the top folder."""
    words = shlex.split(command)
    assert words[0] == "rectray", command
    return subprocess.run([PROGRAM, *words[1:]], capture_output=True, encoding="utf-8", check=True).stdout


def golden_text(path):
    command = read(path).split("\n", 1)[0].removeprefix("$ ")
    return f"$ {command}\n{output_of(command)}"


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
            self.assertEqual(read(path) == drawing_text(path), True, f"{path}: `make golden` renews it")

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


if __name__ == "__main__":
    if sys.argv[1:] == ["--renew"]:
        renew()
    else:
        unittest.main(verbosity=2)
