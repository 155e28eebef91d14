"""The sources look alike: no line is longer than the 120 columns of .clang-format, and clang-format, where it is
installed, would change nothing. `make format` puts the C sources right."""
import re
import shutil
import subprocess
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
COLUMNS = 120
CLANG_FORMAT = "14"
C_FILES = sorted(path for top in ("src", "tests") for path in (ROOT / top).rglob("*.[ch]"))

# Texts that people write. Data is none: scenes, golden output, inputs of fuzzers, the list of mutants.
TEXTS = C_FILES + sorted(
    path for pattern in ("Makefile", "*.md", ".ci/*", "kernels/**/*", "docs/*.md", "docs/exercises/**/*.md",
                         "docs/exercises/**/*.c*", "tests/**/*.mk", "tests/**/*.cl", "tests/*.py", "tests/*.sh",
                         "tests/mutants/run.py", "tests/random/*.py", "tests/support/*", "tests/soak/*",
                         "tests/fuzz/run", "tests/exercises/run", "tests/exercises/*.md")
    for path in ROOT.glob(pattern) if path.is_file() and path.suffix != ".pyc")


def clang_format_version():
    """Its first number; None where there is no clang-format."""
    if not shutil.which("clang-format"):
        return None
    out = subprocess.run(["clang-format", "--version"], capture_output=True, text=True, check=True).stdout
    return re.search(r"version (\d+)", out)[1]


def may_be_long(path, line):
    """In a page the row of a table cannot be broken, nor can an address; `bench` writes each sentence as one line."""
    return path.suffix == ".md" and (line.startswith(("|", "Measured by `rectray bench")) or "://" in line)


class Style(unittest.TestCase):
    def test_no_line_is_too_long(self):
        self.assertGreater(len(TEXTS), 300)
        for path in TEXTS:
            lines = path.read_text(encoding="utf-8").split("\n")
            long = [str(i + 1) for i, line in enumerate(lines) if len(line) > COLUMNS and not may_be_long(path, line)]
            with self.subTest(str(path.relative_to(ROOT))):
                self.assertEqual(long, [], f"lines of more than {COLUMNS} columns")

    def test_no_line_ends_in_spaces_or_has_tabs_where_none_belong(self):
        for path in TEXTS:
            text = path.read_text(encoding="utf-8")
            with self.subTest(str(path.relative_to(ROOT))):
                self.assertEqual(re.findall(r"(?m)^.*[ \t]+$", text), [], "spaces at a line's end")
                if path.name != "Makefile" and path.suffix != ".mk":
                    self.assertNotIn("\t", text)

    @unittest.skipUnless(clang_format_version() == CLANG_FORMAT, f"clang-format {CLANG_FORMAT} is not installed")
    def test_clang_format_would_change_nothing(self):
        out = subprocess.run(["clang-format", "--dry-run", *map(str, C_FILES)], cwd=ROOT, capture_output=True,
                             text=True,
                             check=True).stderr
        files = sorted(set(re.findall(r"(?m)^(\S+?):\d+:\d+: warning", out)))
        self.assertEqual(files, [], "`make format` puts them right")


if __name__ == "__main__":
    unittest.main(verbosity=2)
