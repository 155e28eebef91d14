"""The recipes of docs/architecture.md ("How to add") are whole: whoever leaves out one of the places that a recipe
names fails a test here, or in the suite that the recipe names."""
import json
import re
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "random"))

from architecture_test import sources
from scenes import Generator # pylint: disable=wrong-import-position

SEEDS = 300


def read(path):
    return (ROOT / path).read_text(encoding="utf-8")


def read_all(*patterns):
    return "".join(path.read_text(encoding="utf-8") for pattern in patterns for path in sorted(ROOT.glob(pattern)))


def body(path, function):
    """The text of a function, from its name to the brace that ends it."""
    return re.search(rf"\b{function}\([^;{{]*\n?{{.*?^}}", read(path), re.M | re.S)[0]


def members_of(document):
    """The names of all members in a document of JSON, however deep."""
    if isinstance(document, dict):
        return set(document).union(*map(members_of, document.values()))
    return set().union(*map(members_of, document)) if isinstance(document, list) else set()


def properties_of(schema):
    """The names of all members that a schema allows."""
    if isinstance(schema, dict):
        own = set(schema["properties"]) if isinstance(schema.get("properties"), dict) else set()
        return own.union(*map(properties_of, schema.values()))
    return set().union(*map(properties_of, schema)) if isinstance(schema, list) else set()


def random_scenes():
    return [json.loads(Generator(seed, "x").scene()) for seed in range(SEEDS)]


class Recipe(unittest.TestCase):
    def each(self, names, where, text, form=r"\b{}\b"):
        """Each name stands in the text, which is that of `where`."""
        self.assertGreater(len(names), 1)
        missing = [name for name in sorted(names) if not re.search(form.format(re.escape(name)), text)]
        self.assertEqual(missing, [], f"not in {where}")


class KeyOfTheFormat(Recipe):
    """Also a kind of object, which is a key of an object."""

    def setUp(self):
        self.keys = properties_of(json.loads(read("docs/scene.schema.json"))) - {"//", "$schema"}  # for editors

    def test_the_readers_know_those_of_the_schema(self):
        read_here = set(re.findall(r'\.name = "(\w+)"', read_all("src/reader/scene_*.c")))
        self.assertEqual(read_here, self.keys)

    def test_the_page_tells_of_each(self):
        self.each(self.keys, "docs/scene-format.md", read("docs/scene-format.md"), r'[`"]{}[`"]')

    def test_random_scenes_have_each(self):
        missing = self.keys - set().union(*map(members_of, random_scenes()))
        self.assertEqual(missing, set(), "tests/random/scenes.py makes none of them")

    def test_the_fuzzer_knows_each(self):
        self.each(self.keys, "tests/fuzz/scene.dict", read("tests/fuzz/scene.dict"), r'\\"{}\\"')


class MaterialProperty(Recipe):
    def setUp(self):
        struct = re.search(r"typedef struct Material \{(.*?)\} Material;", read("src/scene/scene.h"), re.S)[1]
        declared = re.findall(r"(?m)^    \w+ ([^*;]+);", struct)
        self.fields = {name for names in declared for name in names.split(", ")}

    def test_the_reader_fills_each(self):
        keys = set(re.findall(r'\.name = "(\w+)"', body("src/reader/scene_values.c", "read_material")))
        self.assertEqual(keys, self.fields)
        self.each(self.fields, "read_material", body("src/reader/scene_values.c", "read_material"), r"&material->{}\b")

    def test_the_reference_uses_each(self):
        self.each(self.fields, "src/scene/light.c and src/trace/reference.c",
                  read("src/scene/light.c") + read("src/trace/reference.c"), r"material->{}\b")

    def test_the_textbook_uses_each(self):
        self.each(self.fields, "src/trace/textbook_light.h and src/trace/textbook.c",
                  read("src/trace/textbook_light.h") + read("src/trace/textbook.c"), r"(material->|\]\.){}\b")

    def test_each_has_a_column_on_the_device(self):
        packed = body("src/opencl/device_scene.c", "pack_material")
        self.each(self.fields, "pack_material", packed, r"material->{}\b")
        columns = set(re.findall(r"\bMATERIAL_[A-Z]+", read("kernels/shared/layout.h"))) - {"MATERIAL_REALS"}
        self.each(columns, "pack_material", packed)
        self.each(columns, "kernels/plain.cl", read("kernels/plain.cl"))
        self.each(columns, "the fast kernels", read_all("kernels/packet/*.cl", "kernels/tile/*.cl"))

    def test_columns_do_not_overlap(self):
        columns = re.findall(r"MATERIAL_(\w+) = (\d+)", read("kernels/shared/layout.h"))
        packed = body("src/opencl/device_scene.c", "pack_material")
        begin = 0
        for name, number in columns:
            self.assertGreaterEqual(int(number), begin, f"MATERIAL_{name} begins inside the column before it")
            begin = int(number) + (3 if re.search(rf"put_vec3\(materials, row \+ MATERIAL_{name},", packed) else 1)

    def test_the_brightest_colour_takes_each_into_account(self):
        free = {"shininess"} # a highlight's power is at most 1
        self.each(self.fields - free, "adaptive_brightest", body("src/trace/adaptive.c", "adaptive_brightest"),
                  r"m->{}\b")

    def test_the_walkthrough_tells_of_each(self):
        for format_ in ("text", "json"):
            text = read_all(f"src/walkthrough/walkthrough_{format_}*.c")
            with self.subTest(format_): # an event has a copy of the reflection
                self.each(self.fields, f"src/walkthrough/walkthrough_{format_}*.c", text,
                          r"(material->|reflected\.){}\b")

    def test_a_scene_of_the_tests_uses_each(self):
        scenes = [json.loads(path.read_text(encoding="utf-8"))
                  for path in sorted((ROOT / "tests/scenes").glob("*.json"))]
        used = {key for scene in scenes for material in scene.get("materials", {}).values()
                if isinstance(material, dict) for key, value in material.items() if value not in (0, [0, 0, 0])}
        self.assertEqual(self.fields - used, set(), "tests/scenes/*.json use none of them")


class Option(Recipe):
    """That the page and the help name the same options: tests/commands_test.py."""

    def setUp(self):
        self.options = set(re.findall(r'(?m)^    \{"([\w-]+)", ', read("src/command/option_table.c")))
        self.assertGreater(len(self.options), 25)

    def test_the_fuzzer_knows_each(self):
        self.each(self.options, "tests/fuzz/options.dict", read("tests/fuzz/options.dict"), r'"--{}\\x0A"')

    def test_a_suite_gives_each(self):
        suites = read_all("tests/*_test.py", "tests/*_test.sh", "tests/test_*.c")
        shorts = dict(re.findall(r'(?m)^    \{"([\w-]+)", \'(\w)\'', read("src/command/option_table.c")))
        missing = [name for name in sorted(self.options) if not re.search(rf"--{name}\b", suites) and
                   not (name in shorts and re.search(rf"[\" ]-{shorts[name]}\b", suites))]
        self.assertEqual(missing, [], "no suite gives these options")


class KindOfNote(Recipe):
    def setUp(self):
        self.kinds = dict(re.findall(r'\[(NOTE_\w+)\] = \{"([\w-]+)"', read("src/reader/note_kinds.c")))

    def test_each_has_its_words(self):
        names = set(re.findall(r"(?m)^    (NOTE_\w+),", read("src/reader/note_kinds.h"))) - {"NOTE_NAMES"}
        self.assertEqual(names, set(self.kinds))

    def test_each_is_given_somewhere(self):
        code = re.sub(r"(?s)/\*.*?\*/", "", "".join(
            path.read_text(encoding="utf-8") for path in sorted((ROOT / "src").rglob("*.c"))
            if path.name != "note_kinds.c"))
        self.assertEqual([name for name in self.kinds if not re.search(rf"\b{name}\b", code)], [])

    def test_the_page_tells_of_each(self):
        first = re.findall(r"(?m)^\| (`.*?) \|", read("docs/scene-format.md").split("## Notes")[1])
        rows = [name for cell in first for name in re.findall(r"`([\w-]+)`", cell)]
        self.assertEqual(sorted(set(self.kinds.values()) - set(rows)), [])


class Command(Recipe):
    """That the page and the help name the same commands: tests/commands_test.py."""

    def setUp(self):
        self.commands = re.findall(r'(?m)^    \{"(\w+)", "', read("src/command/command_table.c"))
        self.assertGreater(len(self.commands), 5)

    def test_each_has_its_file(self):
        for name in self.commands:
            self.assertRegex(read(f"src/command/command_{name}.c"), rf"(?m)^bool command_{name}\(")
        self.each(self.commands, "src/command/command.h", read("src/command/command.h"), r"\bcommand_{}\(")

    def test_the_fuzzer_knows_each(self):
        self.each(self.commands, "tests/fuzz/options.dict", read("tests/fuzz/options.dict"), r'"{}\\x0A"')

    def test_a_suite_runs_each(self):
        self.each(self.commands, "tests/*_test.py", read_all("tests/*_test.py"), r'"{}"')


class Event(Recipe):
    """That the JSON keeps to its schema: tests/trace_test.py. A switch without a case for a kind does not compile."""

    def setUp(self):
        self.kinds = set(re.findall(r"(?m)^    (EVENT_\w+),", read("src/trace/recorder.h")))
        self.assertGreater(len(self.kinds), 10)

    def test_each_is_recorded(self):
        recorded = read("src/trace/reference.c") + read("src/walkthrough/walkthrough.c")
        self.each(self.kinds, "src/trace/reference.c", recorded, r"(RECORD\(tracer, |\.kind = ){}\b")

    def test_text_and_json_have_a_case_for_each(self):
        for path in ("src/walkthrough/walkthrough_text.c", "src/walkthrough/walkthrough_json_event.c"):
            switch = re.search(r"switch \(event->kind\) \{.*?^    \}", read(path), re.M | re.S)[0]
            self.each(self.kinds, path, switch, r"case {}:")
            self.assertEqual(switch.count("default:"), 0, f"{path}: the compiler could not tell which case is missing")

    def test_the_schema_describes_each(self):
        names = re.findall(r'"event": \{"const": "([\w ]+)"', read("docs/walkthrough.schema.json"))
        self.assertEqual({"EVENT_" + name.upper().replace(" ", "_") for name in names}, self.kinds)


class KernelFile(Recipe):
    """That an included file is there, and on a floor below: tests/architecture_test.py."""

    def setUp(self):
        self.roots = set(re.findall(r'"([\w/]+\.cl)"', body("src/opencl/opencl_program.c", "root_of")))
        self.assertGreater(len(self.roots), 2)

    def test_each_is_reached_from_a_kernel(self):
        included = sources("kernels")
        reached, waiting = set(), self.roots
        while waiting:
            reached |= waiting
            waiting = {file for name in waiting for file in included[name]} - reached
        self.assertEqual(set(included) - reached - {"embed.sh"}, set(), "no kernel includes these files")

    def test_each_root_is_expanded_by_a_suite(self):
        roots = re.search(r"ROOTS\[\] = \{(.*?)\}", read("tests/test_opencl_sources.c"), re.S)[1]
        self.assertEqual(set(re.findall(r'"(.*?)"', roots)), self.roots)


class SkippedWork(Recipe):
    def setUp(self):
        self.names = set(re.findall(r'\[SKIP_\w+\] = \{"(\w+)"', read("src/trace/skip.c")))

    def test_the_page_tells_of_each(self):
        self.each(self.names, "docs/commands.md", read("docs/commands.md"), r"(?m)^\| `{}` \|")


class Fuzzer(Recipe):
    """tests/fuzz/fuzz.h says what a target needs."""

    def test_each_target_has_its_inputs(self):
        targets = {path.stem.removeprefix("fuzz_") for path in (ROOT / "tests/fuzz").glob("fuzz_*.c")}
        self.each(targets, "FUZZ_TARGETS", read("tests/fuzz/fuzz.h"), r"\bX\({}\)")
        for name in targets:
            self.assertTrue(any((ROOT / "tests/fuzz" / name).iterdir()), name)


if __name__ == "__main__":
    unittest.main(verbosity=2)
