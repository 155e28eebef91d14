"""The house stands as docs/architecture.md says: every source file has its place there, and no file includes from a
floor above its own. Files that share the first word of their names are parts of one room."""
import re
import unittest
from fnmatch import fnmatch
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGE = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
SOURCES = sorted((ROOT / "src").glob("*.[ch]"))
KERNELS = sorted((ROOT / "kernels").iterdir())


def floors():
    """The floor that each header states, by the name that it shares with its .c file."""
    stated = {}
    for header in (ROOT / "src").glob("*.h"):
        floor = re.search(r"\bFloor (\d)\b", header.read_text(encoding="utf-8"))
        if floor:
            stated[header.stem] = int(floor.group(1))
    return stated


def room_of(stem):
    return stem.split("_")[0]


def floor_of(path, includes, stated):
    """A file without a header of its own, such as a command's, stands where the headers of its room do that it includes;
    main.c, on top of all, has none: None."""
    if path.stem in stated:
        return stated[path.stem]
    return max((stated[name] for name in includes if room_of(name) == room_of(path.stem)), default=None)


class Architecture(unittest.TestCase):
    def test_page_names_every_source(self):
        named = set(re.findall(r"`([\w.*]+)`", PAGE))
        for path in SOURCES:
            # A group of files such as image_read.c and image_write.c may share a header that is named by its parts.
            known = any(fnmatch(path.stem, name) or path.name == name or name.startswith(path.stem + "_")
                        for name in named)
            self.assertTrue(known, f"docs/architecture.md does not name src/{path.name}")

    def test_page_names_every_kernel(self):
        for path in KERNELS:
            self.assertTrue(f"`{path.name}`" in PAGE, f"docs/architecture.md does not name kernels/{path.name}")

    def test_page_names_no_file_that_is_gone(self):
        stems = {path.stem for path in SOURCES}
        names = {path.name for path in SOURCES + KERNELS}
        table = PAGE[PAGE.index("| what |"):PAGE.index("A name without")]
        for name in re.findall(r"`([\w.]+)`", table):
            self.assertTrue(name in stems or name in names, f"docs/architecture.md names src/{name}, which is not there")

    def test_every_header_states_its_floor(self):
        missing = {path.stem for path in SOURCES if path.suffix == ".h"} - set(floors())
        self.assertEqual(missing, set())

    def test_no_file_includes_from_above(self):
        stated = floors()
        for path in SOURCES:
            includes = re.findall(r'#include "(\w+)\.h"', path.read_text(encoding="utf-8"))
            floor = floor_of(path, includes, stated)
            for included in includes:
                if floor is not None and included in stated and room_of(included) != room_of(path.stem):
                    self.assertLessEqual(stated[included], floor, f"src/{path.name} includes {included}.h")


if __name__ == "__main__":
    unittest.main()
