"""The house stands as docs/architecture.md says. Its folders are floors: a file includes only from its own folder and
from the folders before it in the lists below. Its modules, each a NAME.h with its NAME.c, form no circle."""
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGE = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")

# The folders from the ground up; "" is the top of the tree.
FLOORS = {
    "src": ["base", "json", "scene", "reader", "trace", "opencl", "picture", "walkthrough", "library", "grade", "page",
            "bench", "command", ""],
    "kernels": ["shared", "plain", "gpu", "pairs", "packet", "tile", "adaptive", ""],
}

# Folders that do not know each other, although one stands before the other.
APART = {("json", "scene"), ("opencl", "picture"), ("opencl", "walkthrough"), ("picture", "walkthrough"),
         ("tile", "adaptive"),
         ("plain", "packet"), ("plain", "tile"), ("plain", "adaptive"),
         ("gpu", "packet"), ("gpu", "tile"), ("gpu", "adaptive"),
         ("pairs", "packet"), ("pairs", "tile"), ("pairs", "adaptive")}

# What an included name stands for that the host chooses: opencl_sources.h.
CHOICES = {"TREE": ["packet/bvh.cl", "packet/kdtree.cl", "packet/all_faces.cl"],
           "BEAM_TREE": ["adaptive/beam_bvh.cl", "adaptive/beam_kdtree.cl", "adaptive/beam_all_faces.cl"],
           "PLAIN_TREE": ["plain/bvh.cl", "plain/kdtree.cl", "plain/all_faces.cl"],
           "GPU_TREE": ["gpu/bvh.cl", "gpu/kdtree.cl", "gpu/all_faces.cl"],
           "ARITHMETIC": ["plain/exact_arithmetic.cl", "plain/textbook_arithmetic.cl"],
           "PLAIN": ["plain.cl", "pairs.cl"],
           "FOLLOW": ["follow_plain.cl", "follow_pairs.cl"]}


def sources(top):
    """Each file of the tree `top`, by its path in it, with the paths of the files of that tree that it includes."""
    found = {}
    for path in sorted((ROOT / top).rglob("*.*")):
        text = path.read_text(encoding="utf-8")
        included = re.findall(r'^#include "([^"]+)"', text, re.M)
        for name in re.findall(r"^#include (\w+)$", text, re.M):
            included += CHOICES[name]
        folder = str(path.parent.relative_to(ROOT / top))
        name = str(path.relative_to(ROOT / top))
        beside = "" if folder == "." else f"{folder}/"
        found[name] = [beside + other if "/" not in other else other for other in included]
    return found


def folder_of(name):
    return name.rpartition("/")[0]


def modules(top):
    """Each module of the tree `top` with the modules that its files include. NAME.h and NAME.c are one; kernels stand
    alone."""
    def module_of(name):
        return re.sub(r"\.[hc]$", "", name)

    found = {}
    for name, included in sources(top).items():
        others = found.setdefault(module_of(name), set())
        others.update(module_of(other) for other in included if module_of(other) != module_of(name))
    return {name: sorted(others) for name, others in found.items()}


def calls(top):
    """Each module with those whose functions it names: a header may declare what other modules define."""
    texts = {}
    for path in sorted((ROOT / top).rglob("*.c")):
        without_comments = re.sub(r"/\*.*?\*/", "", path.read_text(encoding="utf-8"), flags=re.S)
        texts[str(path.relative_to(ROOT / top).with_suffix(""))] = without_comments
    homes = {function: name for name, text in texts.items()
             for function in re.findall(r"^(?!static|typedef)\w[\w *]*?[ *](\w+)\([^;{}]*\)\s*\{", text, re.M)}
    return {name: sorted({homes[word] for word in re.findall(r"\b[a-z]\w+(?=[(,);])", text) if word in homes} - {name})
            for name, text in texts.items()}


def find_circle(included):
    """A list of modules each of which needs the next one, and the last the first; None if there is none."""
    done, way = set(), []

    def visit(name):
        if name in way:
            return way[way.index(name):]
        if name in done:
            return None
        way.append(name)
        for other in included.get(name, []):
            circle = visit(other)
            if circle:
                return circle
        done.add(way.pop())
        return None

    for name in included:
        circle = visit(name)
        if circle:
            return circle
    return None


def declared(header):
    """The functions that a header of src/ declares, and the types."""
    text = re.sub(r"/\*.*?\*/|^#.*?(?<!\\)$", "", header.read_text(encoding="utf-8"), flags=re.S | re.M)
    functions = re.findall(r"^(?!typedef)\w[\w *]*?[ *](\w+)\(", text, re.M)
    types = re.findall(r"^\} (\w+);", text, re.M) + re.findall(r"^typedef (?:struct|enum) (\w+) ", text, re.M)
    return functions, types


# Words that formulas begin with: they are the book's, not the file's.
FORMULAS = {"scene/geometry.h": {"plane", "point"}, "scene/light.h": {"illuminate", "colour"},
            "trace/textbook_real.h": {"rounded", "doubles", "add", "subtract", "scale", "divide", "multiply", "dot",
                                      "cross", "unit", "at", "vertex"},
            "trace/textbook_record.h": {"record", "test", "end"},
            "trace/textbook_camera.h": {"camera"}, "trace/textbook_plane.h": {"meets"},
            "trace/textbook_inside.h": {"inside"}, "trace/textbook_face.h": {"hits"},
            "trace/textbook_nearest.h": {"nearest"}, "trace/textbook_shadow.h": {"place", "face"},
            "trace/textbook_light.h": {"illumination"}, "trace/textbook_mirror.h": {"mirrored"}}


class Names(unittest.TestCase):
    def headers(self):
        return {str(path.relative_to(ROOT / "src")): path for path in sorted((ROOT / "src").rglob("*.h"))}

    def test_a_header_s_guard_is_its_name(self):
        for name, path in self.headers().items():
            self.assertIn(f"#ifndef RECTRAY_{path.stem.upper()}_H\n", path.read_text(encoding="utf-8"), name)

    def test_a_function_begins_as_its_file_or_as_a_type_of_it(self):
        for name, path in self.headers().items():
            functions, types = declared(path)
            self.assertTrue(functions or types or "extern" in path.read_text(encoding="utf-8"), name)
            file_word = path.stem.partition("_")[0]
            words = {file_word, file_word.removesuffix("s")} | FORMULAS.get(name, set())
            words |= {re.match(r"[A-Z][a-z0-9]*", kind)[0].lower() for kind in types}
            for function in functions:
                self.assertIn(function.partition("_")[0], words, f"{function} in src/{name}")


class Parameters(unittest.TestCase):
    MOST = 8

    def definitions(self):
        """Each function that a source of src/ defines: its place, its name, how many parameters it takes."""
        for path in sorted((ROOT / "src").rglob("*.c")):
            text = re.sub(r"/\*.*?\*/|^#.*?(?<!\\)$", "", path.read_text(encoding="utf-8"), flags=re.S | re.M)
            for name, parameters in re.findall(r"^\w[\w *]*?[ *](\w+)\(([^;{}]*)\)\s*\{", text, re.M):
                outside = re.sub(r"\([^()]*\)", "", parameters)
                yield path.name, name, 1 + outside.count(",")

    def test_no_function_takes_more_than_eight(self):
        found = list(self.definitions())
        self.assertGreater(len(found), 800)
        self.assertEqual([each for each in found if each[2] > self.MOST], [])


class Architecture(unittest.TestCase):
    def test_every_folder_has_its_floor(self):
        for top, floors in FLOORS.items():
            self.assertEqual(sorted({folder_of(name) for name in sources(top)} | {""}), sorted(floors))

    def test_page_names_the_folders_in_their_order(self):
        for top, floors in FLOORS.items():
            section = PAGE.split(f"## The floors of `{top}/`")[1].split("\n## ")[0]
            self.assertEqual(re.findall(r"^\| `(\w+)/` \|", section, re.M), [folder for folder in floors if folder])

    def test_no_file_includes_from_a_folder_above_its_own(self):
        for top, floors in FLOORS.items():
            for name, included in sources(top).items():
                for other in included:
                    if other.startswith("kernels/"):
                        continue
                    here, there = folder_of(name), folder_of(other)
                    self.assertIn(there, floors, f"{top}/{name} includes {other}")
                    self.assertLessEqual(floors.index(there), floors.index(here), f"{top}/{name} includes {other}")
                    self.assertNotIn((there, here), APART, f"{top}/{name} includes {other}")

    def test_no_modules_include_each_other_in_a_circle(self):
        for top in FLOORS:
            self.assertIsNone(find_circle(modules(top)))

    def test_no_modules_call_each_other_in_a_circle(self):
        self.assertIsNone(find_circle(calls("src")))

    def test_threads_are_known_to_one_file(self):
        knowing = [path.name for path in sorted((ROOT / "src").rglob("*.[ch]"))
                   if re.search(r"#include <(pthread|threads)\.h>|pthread_mutex|pthread_create",
                                path.read_text(encoding="utf-8"))]
        self.assertEqual(knowing, ["parallel.c"])

    def test_host_includes_of_the_kernels_only_what_both_share(self):
        for name, included in sources("src").items():
            for other in included:
                if other.startswith("kernels/"):
                    self.assertRegex(other, r"^kernels/shared/\w+\.h$", f"src/{name}")

    def test_every_included_kernel_file_is_there(self):
        found = sources("kernels")
        for name, included in found.items():
            for other in included:
                self.assertIn(other, found, f"kernels/{name} includes {other}")


if __name__ == "__main__":
    unittest.main()
