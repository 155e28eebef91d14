#!/usr/bin/env python3
"""Pictures appear whole or not at all, whatever stops the program; progress shows only where it should."""
import os
import pty
import resource
import signal
import stat
import subprocess
import time
import unittest
from random import Random

from support.program import PROGRAM, SOAK, CommandTest


class Output(CommandTest):
    def test_an_output_that_cannot_be_written_is_3_and_leaves_nothing(self):
        os.mkdir(self.path("folder.png"))
        for output in ("folder.png", "missing/a.png", "scene.json/a.png"):
            _, err = self.render("-o", output, status=3)
            self.assertIn(f"cannot write {output}", err)
        self.assertEqual(self.files(), ["folder.png"])

    def test_a_full_disk_is_3(self):
        if os.path.exists("/dev/full"):
            self.assertIn("No space left", self.render("-o", "/dev/full", status=3)[1])
            self.assertTrue(stat.S_ISCHR(os.stat("/dev/full").st_mode))
            with open("/dev/full", "wb") as full:
                self.assertIn("No space left", self.render("-o", "-", status=3, stdout=full)[1])
                for words in (["check", "scene.json"], ["--help"], ["devices"]):
                    self.assertIn("No space left", self.run_program(*words, status=3, stdout=full)[1])

    def test_a_file_that_grows_too_large_is_3_and_goes(self):
        self.put("a.png", "old")

        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (20, 20))
        self.assertIn("File too large", self.render("-o", "a.png", status=3, preexec_fn=limit)[1])
        self.assertEqual(self.files(), ["a.png"])
        self.assertEqual(self.bytes_of("a.png"), b"old")

    def test_words_that_do_not_fit_are_3_and_go_too(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (20, 20))
        for words in (["trace", "scene.json", "--pixel", "1,2"], ["generate", "city", "--size", "9"]):
            self.put("a.txt", "old")
            err = self.run_program(*words, "-o", "a.txt", status=3, preexec_fn=limit)[1]
            self.assertIn("cannot write a.txt: File too large", err)
            self.assertEqual(self.files(), ["a.txt"])
            self.assertEqual(self.bytes_of("a.txt"), b"old")

    def test_a_read_only_picture_is_kept(self):
        nobody = {"user": 65534} if os.geteuid() == 0 else {} # root may write everything
        self.put("a.png", "old")
        os.chmod(self.path("a.png"), 0o444)
        os.chmod(self.folder, 0o777)
        try:
            err = self.render("-o", "a.png", status=3, **nobody)[1]
        except PermissionError:
            self.skipTest("the program is where only root may go")
        self.assertIn("Permission denied", err)
        os.chmod(self.folder, 0o555)
        self.assertIn("Permission denied", self.render("-o", "b.png", status=3, **nobody)[1])
        os.chmod(self.folder, 0o755)
        self.assertEqual(self.files(), ["a.png"])

    def test_the_scene_is_never_replaced(self):
        before = self.bytes_of("scene.json")
        self.render("-o", "./scene.json", status=2)
        self.assertEqual(self.bytes_of("scene.json"), before)

    def test_a_closed_stdout_is_told_of_and_gets_nothing_else(self):
        def close():
            os.close(1)
        for words in (["render", "scene.json", "-b", "reference", "-o", "-"], ["check", "scene.json"], ["--version"]):
            self.assertIn("Bad file descriptor", self.run_program(*words, status=3, preexec_fn=close)[1])
        self.render("-o", "a.png", preexec_fn=close)
        self.assertEqual(self.bytes_of("a.png"), self.render("-o", "-")[0])

    def test_a_reader_that_goes_away_ends_the_program_as_it_ends_cat(self):
        read, write = os.pipe()
        os.close(read)
        for words in (["render", "scene.json", "-b", "reference", "-o", "-"], ["check", "scene.json"],
                      ["trace", "scene.json", "--pixel", "1,1"], ["generate", "menger", "--size", "2"], ["--help"]):
            _, err = self.run_program(*words, status=-signal.SIGPIPE, stdout=write)
            self.assertEqual(err, "")
        os.close(write)
        self.assertEqual(self.files(), [])

    def test_a_caller_that_ignores_the_signal_is_told(self):
        read, write = os.pipe()
        os.close(read)
        _, err = self.run_program("check", "scene.json", status=3, stdout=write, restore_signals=False)
        self.assertIn("Broken pipe", err)
        os.close(write)

    def test_a_lost_reader_of_the_messages_keeps_the_picture(self):
        read, write = os.pipe()
        os.close(read)
        process = self.start("render", "scene.json", "-b", "reference", "-o", "a.png", stderr=write)
        process.communicate()
        os.close(write)
        self.assertEqual(process.returncode, 0)
        self.assertEqual(self.files(), ["a.png"])


class Interrupt(CommandTest):
    def interrupted(self, number, *words):
        """Starts a rendering that takes minutes, stops it when its file is there, returns stderr."""
        process = self.start("render", "scene.json", "-o", "a.png", "--size", "6000x6000", "--grid", "16", *words,
                             preexec_fn=lambda: signal.signal(number, signal.SIG_DFL))  # the caller may ignore it
        deadline = time.time() + 60
        while not any(name.endswith(".part") for name in os.listdir(self.folder)) and time.time() < deadline:
            time.sleep(0.01)
        time.sleep(0.3)
        self.assertIsNone(process.poll())
        process.send_signal(number)
        _, err = process.communicate(timeout=20)
        self.assertEqual(process.returncode, 128 + number)
        return err.decode()

    def test_a_signal_removes_the_unfinished_picture(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            err = self.interrupted(number, "--backend", "reference", "--quiet")
            self.assertEqual(err, "rectray: interrupted; the picture was not written\n")
            self.assertEqual(self.files(), [])

    def test_a_signal_keeps_the_old_picture(self):
        self.put("a.png", "old")
        self.interrupted(signal.SIGINT)
        self.assertEqual(self.files(), ["a.png"])
        self.assertEqual(self.bytes_of("a.png"), b"old")

    def test_nohup_is_respected(self):
        def ignore():
            signal.signal(signal.SIGHUP, signal.SIG_IGN)
        process = self.start("render", "scene.json", "--size", "900x900", "-b", "reference", "-o", "a.png",
                             preexec_fn=ignore)
        time.sleep(0.1)
        process.send_signal(signal.SIGHUP)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 0)
        self.assertEqual(self.files(), ["a.png"])


class Killed(CommandTest):
    TIMES = 200 if SOAK else 12

    def check_kills(self, *words):
        """Kills renderings at random times: what has the picture's name is the old picture whole, or the new one."""
        words = ["render", "scene.json", "-q", "-o", "a.png", *words]
        start = time.monotonic()
        self.run_program(*words)
        duration = time.monotonic() - start
        whole = self.bytes_of("a.png")
        random = Random(1)
        seen = set()
        for _ in range(self.TIMES):
            self.put("a.png", "old")
            process = self.start(*words)
            time.sleep(random.uniform(0, 1.1 * duration))
            process.kill()
            process.communicate()
            self.assertIn(self.bytes_of("a.png"), (b"old", whole))
            seen.add(self.bytes_of("a.png"))
            for name in self.files(): # a killed program cannot remove what it was writing
                self.assertRegex(name, r"\A(a\.png|\.rectray-\d+-\d+\.part)\Z")
                os.remove(self.path(name))
        self.assertGreaterEqual(len(seen), 2 if SOAK else 1)

    def test_the_old_picture_is_whole_or_the_new_one(self):
        self.check_kills("-b", "reference", "--size", "300x300", "--threads", "1")

    def test_the_same_with_opencl(self):
        self.check_kills("--size", "2000x2000")


class TinyFileSystem(CommandTest):
    """A file system of 16 KiB, where a user may mount one in a name space of his own."""
    INSIDE = """mount -t tmpfs -o size=16k tmpfs "$1" && cd "$1" && echo old > a.png || exit 77
                "$2" render "$3" -q --size 400x400 -b "$4" -o a.png; echo $?
                "$2" trace "$3" --pixel 4,3 --verbose --format svg -o b.svg; echo $?
                ls -A; cat a.png"""

    def test_a_full_one_keeps_the_old_picture_and_gets_no_other(self):
        for backend in ("reference", "opencl"):
            os.mkdir(self.path(backend))
            process = subprocess.run(["unshare", "-rm", "sh", "-c", self.INSIDE, "sh", self.path(backend), PROGRAM,
                                      os.path.abspath("scenes/gallery.json"), backend], capture_output=True, text=True)
            if process.returncode in (1, 77):
                self.skipTest("mounting is not allowed here")
            self.assertEqual(process.stdout, "3\n3\na.png\nold\n", process.stderr)
            self.assertEqual(process.stderr.count("No space left on device"), 2)


class Progress(CommandTest):
    def test_it_is_off_where_stderr_is_no_terminal(self):
        self.assertNotIn("rays/s", self.render()[1])
        self.assertNotIn("rays/s", self.render("--progress", "never")[1])

    def test_it_is_shown_when_asked_for_and_wiped(self):
        err = self.render("--progress", "always", "-q")[1]
        self.assertRegex(err, r"^\r\d+ %, [\d.]+ million rays/s, \d+:\d\d left *\r +\r$")

    def test_it_is_on_on_a_terminal(self):
        ours, theirs = pty.openpty()
        process = self.start("render", "scene.json", "-b", "reference", "--size", "700x700", "--grid", "4",
                             stdout=subprocess.DEVNULL, stderr=theirs)
        os.close(theirs)
        seen = b""
        try:
            while chunk := os.read(ours, 4096):
                seen += chunk
        except OSError: # the other side is closed
            pass
        self.assertEqual(process.wait(), 0)
        self.assertIn(b"rays/s", seen)
        os.close(ours)


if __name__ == "__main__":
    unittest.main(verbosity=2)
