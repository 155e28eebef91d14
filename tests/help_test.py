"""The help: of every command, as text, as manual pages that man reads without a warning, and as completion that a real
bash carries out."""
import json
import os
import re
import shutil
import subprocess
import unittest

from support.program import PROGRAM, CommandTest


def help_of(*words):
    return subprocess.run([PROGRAM, "help", *words], capture_output=True, text=True, check=True).stdout


COMMANDS = re.findall(r"^  (\w+) ", help_of(), re.M)


class Text(CommandTest):
    def test_help_is_a_command_and_an_option(self):
        self.assertEqual(help_of().encode(), self.run_program("--help")[0])
        for command in COMMANDS:
            self.assertEqual(help_of(command).encode(), self.run_program(command, "--help")[0])

    def test_every_command_has_two_examples_that_its_options_allow(self):
        for command in COMMANDS:
            lines = re.findall(r"^  (\S.*)\n      \S", help_of(command).split("examples:\n")[1], re.M)
            self.assertEqual(len(lines), 2, command)
            for line in lines:
                words = [part for part in line.split("|") if "rectray" in part][0].split()
                self.assertEqual(words[1], command, line)
                out = self.run_program(*words[1:], "--help")[0].decode()  # reads the options, and does nothing
                self.assertIn(f"usage: rectray {command}", out)

    def test_an_unknown_command_is_an_error_that_names_the_nearest(self):
        self.assertIn("did you mean 'render'?", self.run_program("help", "rendr", status=2)[1])
        self.assertIn("leave out 'render'", self.run_program("help", "render", "--as", "bash", status=2)[1])


READERS = [words for words in (["mandoc", "-Tlint", "-Wwarning"], ["man", "--warnings", "-l", "-"])
           if shutil.which(words[0])]


class Manual(unittest.TestCase):
    def pages(self):
        return {"rectray": help_of("--as", "man"), **{name: help_of(name, "--as", "man") for name in COMMANDS}}

    def test_the_pages_tell_every_option_and_example(self):
        pages = self.pages()
        for command in COMMANDS:
            self.assertIn(rf"\-{command}", pages["rectray"])
            text = pages[command].replace("\\-", "-").replace("\\e", "\\").replace("\\&", "")
            shown = help_of(command)
            for option in re.findall(r"--([\w-]+)", shown.split("examples:")[0].split("options:")[1]):
                self.assertIn(f"--{option}", text)
            for line in re.findall(r"^  (\S.*)$", shown.split("examples:\n")[1], re.M):
                self.assertIn(line, text)

    @unittest.skipUnless(READERS, "neither mandoc nor man is installed")
    def test_readers_of_manuals_have_no_warning(self):
        pages = self.pages()
        with open("docs/rectray-scene.5", encoding="utf-8") as file:
            pages["rectray-scene"] = file.read()
        for reader in READERS:
            for name, page in pages.items():
                run = subprocess.run(reader, input=page, capture_output=True, text=True,
                                     env={**os.environ, "MANPAGER": "cat", "LC_ALL": "C.UTF-8"}, check=False)
                said = run.stderr + (run.stdout if reader[0] == "mandoc" else "")
                self.assertEqual(said, "", f"{name}, by {reader[0]}")
                self.assertEqual(run.returncode, 0, f"{name}, by {reader[0]}")

    def test_the_page_of_the_scene_file_names_every_key(self):
        with open("docs/scene.schema.json", encoding="utf-8") as file:
            parts = json.load(file)["$defs"]
        with open("docs/rectray-scene.5", encoding="utf-8") as file:
            words = set(re.findall(r"\w+", file.read()))
        keys = {key for part in parts.values() for key in part.get("properties", {}) if key.isidentifier()}
        self.assertGreater(len(keys), 30)
        self.assertEqual(keys - words, set())


def complete(*words):
    """What bash offers for the last word."""
    script = (help_of("--as", "bash") + '\nCOMP_WORDS=("$@"); COMP_CWORD=$(( $# - 1 )); _rectray\n'
              'printf "%s\\n" "${COMPREPLY[@]}"\n')
    run = subprocess.run(["bash", "--norc", "-c", script, "bash", "rectray", *words], capture_output=True, text=True,
                         check=True)
    return run.stdout.split()


@unittest.skipUnless(shutil.which("bash"), "bash is not installed")
class Bash(unittest.TestCase):
    def test_commands(self):
        self.assertEqual(complete("ren"), ["render"])
        self.assertEqual(set(complete("")), {*COMMANDS, "--help", "--version"})

    def test_options_are_those_of_the_command(self):
        for command in COMMANDS:
            shown = help_of(command).split("examples:")[0].split("options:")[1]
            expected = {f"--{name}" for name in re.findall(r"(?m)^  (?:-\w, |    )--([\w-]+)", shown)}
            self.assertEqual(set(complete(command, "--")), expected, command)

    def test_words_of_an_option(self):
        self.assertEqual(complete("render", "--precision", ""), ["float", "double"])
        self.assertEqual(complete("render", "-a", "k"), ["kdtree"])

    def test_files_are_left_to_bash(self):
        self.assertEqual(complete("render", ""), [])
        self.assertEqual(complete("render", "-o", ""), [])

    def test_other_shells_read_their_scripts(self):
        for shell, words in (("zsh", ["-n"]), ("fish", ["--no-execute"])):
            script = help_of("--as", shell)
            for command in COMMANDS:
                self.assertIn(command, script)
            if shutil.which(shell):
                subprocess.run([shell, *words], input=script, text=True, check=True)


if __name__ == "__main__":
    if not READERS:
        print("SKIPPED: the manual pages without a warning: neither mandoc nor man is installed")
    unittest.main(verbosity=2)
