#!/usr/bin/env python3
"""Compiled kernels that are kept: a later start gives the same picture without compiling, and whatever happens to the
files of the two caches, ours and PoCL's, changes no picture and ends no program."""
import concurrent.futures
import glob
import os
import random
import shutil
import struct
import subprocess
import tempfile
import unittest

from support.program import PROGRAM

SCENE = "tests/scenes/many_lights.json"
HEAD = "<8sQQQ"  # of a kept file: magic, sources, size, checksum


def checksum(data):
    """hash_bytes of src/opencl/kernel_cache.c."""
    value = (14695981039346656037 ^ len(data)) * 1099511628211 % 2**64
    for at in range(0, len(data), 8):
        value = (value ^ int.from_bytes(data[at:at + 8], "little")) * 1099511628211 % 2**64
        value ^= value >> 32
    return value


def render(caches, name="picture.png", **settings):
    """The bytes of a picture made with the caches in that folder."""
    picture = os.path.join(caches, name)
    environment = dict(os.environ, RECTRAY_CACHE_DIR=os.path.join(caches, "rectray"),
                       POCL_CACHE_DIR=os.path.join(caches, "pocl"))
    environment.pop("POCL_WORK_GROUP_SPECIALIZATION", None)
    environment.update(settings)
    words = [PROGRAM, "render", SCENE, "--size", "64x48", "--sampling", "uniform:1", "--kernel", "plain", "-o", picture]
    run = subprocess.run(words, env=environment, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        raise AssertionError(f"exit status {run.returncode}: {run.stderr}")
    with open(picture, "rb") as file:
        return file.read()


def code_files(caches):
    """The machine code that PoCL has unpacked of trimmed binaries: a small letter ends the folder's name."""
    return [name for name in glob.glob(os.path.join(caches, "pocl", "*", "*", "*", "*", "*.so"))
            if name.split(os.sep)[-4][-1].islower()]


class WarmStartTest(unittest.TestCase):
    """Each test begins with the caches that a first start has left."""

    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.first = os.path.join(cls.holder.name, "first")
        os.makedirs(os.path.join(cls.first, "pocl"))
        cls.picture = render(cls.first)

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    def setUp(self):
        self.caches = os.path.join(self.holder.name, self.id())
        shutil.copytree(self.first, self.caches)
        self.kept = glob.glob(os.path.join(self.caches, "rectray", "*.kernel"))[0]

    def tearDown(self):
        shutil.rmtree(self.caches)

    def check_warm(self, **settings):
        """The same picture, and the kept file is not made anew."""
        before = os.stat(self.kept).st_ino
        self.assertEqual(render(self.caches, **settings), self.picture)
        self.assertEqual(os.stat(self.kept).st_ino, before)

    def test_later_starts_should_not_compile(self):
        self.check_warm()
        self.check_warm()

    def test_warm_start_should_do_without_what_pocl_has_in_its_cache(self):
        shutil.rmtree(os.path.join(self.caches, "pocl"))
        os.mkdir(os.path.join(self.caches, "pocl"))
        self.check_warm()

    def test_binaries_of_the_tried_driver_alone_should_be_trimmed(self):
        devices = subprocess.run([PROGRAM, "devices", "0"], capture_output=True, text=True, check=True).stdout
        self.check_warm()
        self.assertEqual(len(code_files(self.caches)), "driver 3.1+debian" in devices, devices)

    def test_damaged_code_of_a_trimmed_binary_should_not_be_used(self):
        self.check_warm()
        for name in code_files(self.caches):
            with open(name, "rb") as file:
                code = file.read()
            for damaged in (b"", code[:len(code) // 2], bytes(len(code)), code + b"!"):
                with open(name, "wb") as file:
                    file.write(damaged)
                self.check_warm()

    def test_trimmed_binary_should_not_be_used_where_pocl_is_told_otherwise(self):
        for settings in ({"POCL_WORK_GROUP_SPECIALIZATION": "1"}, {"POCL_KERNEL_CACHE": "0"}):
            self.assertEqual(render(self.caches, **settings), self.picture)
        self.assertEqual(code_files(self.caches), [])

    def test_starts_at_the_same_time_should_not_disturb_one_another(self):
        with concurrent.futures.ThreadPoolExecutor(8) as pool:
            for picture in pool.map(lambda i: render(self.caches, f"{i}.png"), range(8)):
                self.assertEqual(picture, self.picture)

    def test_warm_start_should_work_where_pocl_cannot_unpack(self):
        self.check_warm()
        for name in code_files(self.caches):
            folder = os.path.dirname(name)
            shutil.rmtree(folder)
            with open(folder, "w", encoding="ascii"):
                pass
        self.check_warm()

    def test_kept_file_should_be_made_anew_when_it_is_damaged(self):
        with open(self.kept, "rb") as file:
            whole = file.read()
        random.seed(1)
        at = random.randrange(32, len(whole))
        for damaged in (whole[:at], whole[:at] + bytes([whole[at] ^ 1 << random.randrange(8)]) + whole[at + 1:]):
            with open(self.kept, "wb") as file:
                file.write(damaged)
            self.assertEqual(render(self.caches), self.picture)
            with open(self.kept, "rb") as file:
                self.assertEqual(file.read(), whole)

    def test_kept_file_of_a_foreign_driver_should_be_made_anew(self):
        with open(self.kept, "rb") as file:
            head, foreign = file.read(32), b"\x7fELF, but of another driver"
        magic, sources, _, _ = struct.unpack(HEAD, head)
        with open(self.kept, "wb") as file:
            file.write(struct.pack(HEAD, magic, sources, len(foreign), checksum(foreign)) + foreign)
        self.assertEqual(render(self.caches), self.picture)


if __name__ == "__main__":
    unittest.main()
