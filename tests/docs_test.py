#!/usr/bin/env python3
"""Do the pages name what is there? Files, functions, links with their anchors, and drawings of docs/*.md and README.md.

In a page write `function` in `src/folder/file.c`; the names of several functions may stand before one file."""
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from support.program import PROGRAM

PAGES = ["README.md", "tests/exercises/README.md", *sorted(glob.glob("docs/*.md")),
         *sorted(glob.glob("docs/exercises/**/*.md", recursive=True))]
CODE = ["Makefile", *glob.glob("src/**/*.[ch]", recursive=True), *glob.glob("kernels/**/*.*", recursive=True)]
PATH = r"(?:src|kernels|tests|docs|scenes)/[\w./-]+"
sys.path.insert(0, "docs/plots")
sys.dont_write_bytecode = True


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def prose(page):
    """The page without its blocks of output and code."""
    return re.sub(r"^```.*?^```$", "", read(page), flags=re.M | re.S)


def anchors_of(page):
    """Those that are written out, and those that GitHub makes of headings: small letters, hyphens for spaces."""
    headings = re.findall(r"(?m)^#+ (.*)$", prose(page))
    made = [re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings]
    return {*made, *re.findall(r'<a id="([^"]+)">', prose(page))}


def links_of(page):
    return re.findall(r"\]\(([^)\s]+)\)", prose(page))


def named_in(page):
    """Pairs of a name and the file that it is said to be in: `one`, `two` in `src/file.c`."""
    for names, path in re.findall(rf"((?:`\w+`(?:,\s+|\s+and\s+)?)+)\s+in\s+`({PATH}\.(?:c|h|cl|py))`", prose(page)):
        for name in re.findall(r"`(\w+)`", names):
            yield name, path


def is_in(name, path):
    """A C file has to define it, as a function, a table, a macro or a type; in others it is one of the words."""
    forms = rf"\w[^\n;=]*\b{name}[(\[]", rf"#define {name}\b", rf"(?:typedef )?(?:struct|enum) {name}\b", rf"}} {name};"
    if not path.endswith(".c"):
        forms = (rf".*\b{name}\b",)
    return any(re.search("^" + form, read(path), re.M) for form in forms)


class Pages(unittest.TestCase):
    def test_there_are_some(self):
        self.assertGreater(len(PAGES), 8)

    def test_links_lead_somewhere(self):
        for page in PAGES:
            for link in links_of(page):
                if re.match(r"[a-z]+:", link):
                    continue
                with self.subTest(page=page, link=link):
                    path, _, anchor = link.partition("#")
                    target = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page
                    self.assertTrue(os.path.exists(target), f"{page}: {link}: no such file")
                    if anchor:
                        self.assertIn(anchor, anchors_of(target), f"{page}: {link}: no such heading")

    def test_files_that_they_name_are_there(self):
        for page in PAGES:
            for path in re.findall(rf"`({PATH})`", prose(page)):
                if not re.search("NAME|NN", path):  # such a path stands for many
                    with self.subTest(page=page, path=path):
                        self.assertTrue(os.path.exists(path), f"{page}: {path}: no such file")

    def test_functions_that_they_name_are_there(self):
        found = 0
        for page in PAGES:
            for name, path in named_in(page):
                found += 1
                with self.subTest(page=page, name=name, path=path):
                    self.assertTrue(os.path.exists(path), f"{page}: {path}: no such file")
                    self.assertTrue(is_in(name, path), f"{page}: {name} is not in {path}")
        self.assertGreater(found, 50)


class Examples(unittest.TestCase):
    def test_numbers_of_the_algorithm_are_those_of_the_walkthrough(self):
        blocks = "".join(re.findall(r"(?ms)^```text\n(.*?)^```", read("docs/algorithm.md")))
        numbers = re.findall(r"\d+\.\d{4,}", blocks)
        self.assertGreater(len(numbers), 30)
        self.assertEqual(set(numbers) - set(re.findall(r"\d+\.\d+", read("docs/walkthrough.md"))), set())


class Version(unittest.TestCase):
    def test_the_changelog_begins_with_the_version_and_its_date(self):
        version = subprocess.run([PROGRAM, "--version"], capture_output=True, text=True, check=True).stdout.split()[1]
        page = subprocess.run([PROGRAM, "help", "--as", "man"], capture_output=True, text=True, check=True).stdout
        date = re.match(r'\.TH "rectray" 1 "(\d{4}-\d\d-\d\d)" "rectray ' + re.escape(version), page)[1]
        self.assertEqual(re.search(r"(?m)^## (.*)$", read("docs/CHANGELOG.md"))[1], f"{version} ({date})")


class PlainKernel(unittest.TestCase):
    """docs/kernel.md quotes the plain kernel, and changes it."""

    def blocks(self, kind):
        return re.findall(rf"(?ms)^```{kind}\n(.*?)^```", read("docs/kernel.md"))

    def test_what_is_quoted_stands_in_the_kernel(self):
        kernels = "".join(map(read, ["kernels/plain.cl", *glob.glob("kernels/plain/*.cl")]))
        self.assertGreater(len(self.blocks("c")), 10)
        for block in self.blocks("c"):
            with self.subTest(block.split("\n")[0]):
                self.assertIn(block, kernels)

    def test_it_is_as_short_and_as_flat_as_it_says(self):
        """At most 300 lines, and six calls from `render` down to the test of a face's edges, in either arithmetic."""
        for arithmetic in ("textbook", "exact"):
            files = ["kernels/plain.cl", "kernels/plain/scene.cl", f"kernels/plain/{arithmetic}_arithmetic.cl"]
            text = "".join(map(read, files))
            if arithmetic == "textbook":
                self.assertLessEqual(text.count("\n"), 300)
            bodies = dict(re.findall(r"(?ms)^(?:static|kernel) [^;\n=]*?\b(\w+)\([^;{}]*\)\n\{\n(.*?)^\}", text))
            self.assertGreater(len(bodies), 12)

            def longest(name):
                """Of the ways down from this function: calls, -1 where none ends in a test of edges."""
                if name == "inside_edges" or "vec3_cross(e, c)" in bodies[name]:
                    return 0
                below = [longest(other) for other in set(re.findall(r"\b(\w+)\(", bodies[name])) & set(bodies)]
                return max([calls + 1 for calls in below if calls >= 0], default=-1)

            self.assertEqual(longest("render"), 6, arithmetic)

    def test_the_host_does_there_what_is_said(self):
        """The call of OpenCL by which each of the host's functions does what the page says of it."""
        page = read("docs/kernel.md").split("## plain.cl line by line")[0]
        calls = {"Platform": ("list_devices", "clGetPlatformIDs"), "Device": ("list_add_platform", "clGetDeviceIDs"),
                 "Context": ("open_context", "clCreateContext"), "Queue": ("open_context", "clCreateCommandQueue"),
                 "Buffer": ("make_buffer", "clCreateBuffer"), "Program": ("build_program", "clBuildProgram"),
                 "Kernel": ("opencl_kernel", "clSetKernelArg"), "NDRange": ("opencl_run", "clEnqueueNDRangeKernel"),
                 "Work-group": ("opencl_run", "local")}
        points = dict(re.findall(r"(?ms)^- \*\*(.*?)\.\*\* (.*?)(?=^- \*\*|^\*\*)", page))
        for word, (function, call) in calls.items():
            with self.subTest(word):
                path = re.search(rf"`{function}`\s+(?:\([^)]*\)\s+)?(?:in|of)?\s*.*?`(src/opencl/\w+\.c)`",
                                 points[word], re.S)[1]
                body = re.search(rf"(?ms)^[^\n;]*\b{function}\([^;{{}}]*\)\n\{{\n(.*?)^\}}", read(path))[1]
                self.assertIn(call, body)

    def compile_with(self, line):
        """What the compiler says of the line after a hit was placed, in float; "" if nothing."""
        with tempfile.TemporaryDirectory() as folder:
            mine = os.path.join(folder, "mine")
            shutil.copytree("kernels", mine)
            kernel, place = read("kernels/plain.cl"), "        place_hit(scene, ray, &hit);\n"
            self.assertEqual(kernel.count(place), 1)
            with open(os.path.join(mine, "plain.cl"), "w", encoding="utf-8") as file:
                file.write(kernel.replace(place, place + line + "\n"))
            return subprocess.run([PROGRAM, "render", "scenes/original.json", "--kernel=plain", "--size=8x6", "-q",
                                   "-o", os.path.join(folder, "picture.png")], check=False, capture_output=True,
                                  encoding="utf-8", env={**os.environ, "RECTRAY_KERNELS": mine}).stderr

    def test_the_compiler_says_of_common_mistakes_what_the_page_says(self):
        page = " ".join(read("docs/kernel.md").split())
        vector = re.search(r"`(\(real3\)\(hit\.normal.*?)`", page)[1]
        told = re.findall(r'compiler says "(.*?)"', page)
        self.assertEqual(self.compile_with(f"total += 0.5f * {vector};"), "")
        for line, words in (("total += hit.normal;", told[0]), (f"total += 0.5 * {vector};", told[1])):
            with self.subTest(line):
                said = re.sub(r" \(.*\)", "", self.compile_with(line).split("error: ")[1])
                self.assertIn(words, said)

    def test_each_edit_compiles_and_shows(self):
        render = [PROGRAM, "render", "scenes/gallery.json", "--kernel=plain", "--size=32x18", "--grid=1", "-q", "-o"]
        self.assertEqual(len(self.blocks("diff")), 3)
        with tempfile.TemporaryDirectory() as folder:
            pictures = {subprocess.run([*render, "-"], check=True, capture_output=True).stdout}
            for number, block in enumerate(self.blocks("diff"), 1):
                lines = block.splitlines(keepends=True)
                before, after = ("".join(line[1:] for line in lines if line[0] in kept) for kept in (" -", " +"))
                with self.subTest(after):
                    mine = os.path.join(folder, str(number))
                    shutil.copytree("kernels", mine)
                    kernel = read("kernels/plain.cl")
                    self.assertEqual(kernel.count(before), 1)
                    with open(os.path.join(mine, "plain.cl"), "w", encoding="utf-8") as file:
                        file.write(kernel.replace(before, after))
                    pictures.add(subprocess.run([*render, "-"], check=True, capture_output=True,
                                                env={**os.environ, "RECTRAY_KERNELS": mine}).stdout)
                    self.assertEqual(len(pictures), 1 + number)


class Comments(unittest.TestCase):
    def test_pages_that_the_code_names_are_there(self):
        found = 0
        for path in CODE:
            for page, section in re.findall(r"(docs/[\w.-]+\.md)(?:, section (\d+))?", read(path)):
                found += 1
                with self.subTest(path=path, page=page):
                    self.assertTrue(os.path.exists(page), f"{path}: {page}: no such page")
                    if section:
                        self.assertRegex(read(page), rf"(?m)^## {section}\. ", f"{path}: {page}: no section {section}")
        self.assertGreater(found, 5)


class Drawings(unittest.TestCase):
    def test_each_is_what_its_script_draws(self):
        import algorithm
        import drawing
        import trees
        for page, drawings in (("algorithm", algorithm.DRAWINGS), ("trees", trees.DRAWINGS)):
            for name, draw in drawings.items():
                with self.subTest(name):
                    path = drawing.path_of(page, name)
                    self.assertEqual(read(path), draw().svg(), f"`python3 docs/plots/{page}.py` renews {path}")

    def test_each_is_on_its_page_and_small(self):
        for page, least, bytes_most in (("algorithm", 6, 8192), ("kernels", 6, 8192), ("trees", 3, 16384)):
            shown = set(links_of(f"docs/{page}.md"))
            drawn = glob.glob(f"docs/images/{page}-*.svg")
            self.assertGreaterEqual(len(drawn), least)
            for path in drawn:
                with self.subTest(path):
                    self.assertIn(os.path.relpath(path, "docs"), shown)
                    self.assertLess(os.path.getsize(path), bytes_most)


if __name__ == "__main__":
    unittest.main(verbosity=2)
