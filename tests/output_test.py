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

from program import CommandTest


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

    def test_a_reader_that_goes_away_is_3(self):
        read, write = os.pipe()
        os.close(read)
        self.assertIn("Broken pipe", self.render("-o", "-", status=3, stdout=write)[1])
        self.assertIn("Broken pipe", self.run_program("check", "scene.json", status=3, stdout=write)[1])
        os.close(write)


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
            err = self.interrupted(number, "--backend", "reference")
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
