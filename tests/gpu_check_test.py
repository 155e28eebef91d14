"""`make gpu-check` in so short a time that nothing is done, and with a program that fails: the results are written all
the same, and tell what is missing."""
import json
import os
import shutil
import subprocess
import sys
import unittest

from support.program import PROGRAM, CommandTest

SHIM = os.path.join(os.path.dirname(PROGRAM), "shims", "opencl_device.so")
ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


class GpuCheck(CommandTest):
    def check_gpu(self, seconds, program):
        done = subprocess.run([sys.executable, os.path.join(ROOT, "tests/gpu/check.py"), "--seconds", seconds, "--pose",
                               SHIM, "--out", self.path("found"), program], capture_output=True, check=False,
                              cwd=ROOT, timeout=60)
        self.assertEqual(done.returncode, 1)
        with open(self.path("found.md"), encoding="utf-8") as file:
            text = file.read()
        with open(self.path("found.json"), encoding="utf-8") as file:
            return json.load(file), text

    def test_what_did_not_fit_is_told(self):
        found, text = self.check_gpu("2", PROGRAM)
        for left_out in ("devices --check", "cornell, GPU", "cornell, reference", "menger-3, the scene"):
            self.assertIn(f"{left_out}: the 2 seconds are over", found["missing"])
            self.assertIn(f"missing: {left_out}: ", text)

    def test_a_program_that_fails_is_told(self):
        found, text = self.check_gpu("30", shutil.which("false"))
        for name in ("devices --check", "original, GPU", "original, reference"):
            self.assertIn(f"missing: {name}: status 1, it tells nothing\n", text)
        self.assertEqual((found["check"], found["ladder"]), (None, []))


if __name__ == "__main__":
    unittest.main()
