"""make install and make uninstall: what lies where, and that the installed program, its manual and its kernels work."""
import os
import re
import subprocess
import tempfile
import unittest

from support.program import PROGRAM


def make(folder, target):
    subprocess.run(["make", "--no-print-directory", "-s", target, f"DESTDIR={folder}", "PREFIX=/usr",
                    f"BUILD={os.path.dirname(PROGRAM)}"], check=True, capture_output=True)


def files_below(folder):
    return [os.path.join(place, name) for place, _, names in os.walk(folder) for name in names]


with open(PROGRAM, "rb") as program:
    SANITIZED = b"__asan_init" in program.read()


@unittest.skipIf(SANITIZED, "a sanitizer's library wants a sanitizer's program")
class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.share = os.path.join(cls.holder.name, "usr", "share")
        make(cls.holder.name, "install")

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    def test_every_command_has_a_page(self):
        out = subprocess.run([PROGRAM, "help"], capture_output=True, text=True, check=True).stdout
        pages = {f"rectray-{name}.1" for name in re.findall(r"^  (\w+) ", out, re.M)} | {"rectray.1"}
        self.assertEqual(set(os.listdir(os.path.join(self.share, "man", "man1"))), pages)
        self.assertEqual(os.listdir(os.path.join(self.share, "man", "man5")), ["rectray-scene.5"])

    def test_no_file_is_empty(self):
        for path in files_below(self.holder.name):
            self.assertGreater(os.path.getsize(path), 0, path)

    def test_links_of_the_readme_are_there(self):
        docs = os.path.join(self.share, "doc", "rectray")
        with open(os.path.join(docs, "README.md"), encoding="utf-8") as file:
            links = re.findall(r"\]\((docs/[^)#]+)", file.read())
        self.assertTrue(links)
        for link in links:
            self.assertTrue(os.path.exists(os.path.join(docs, link)), link)

    def test_the_installed_program_renders_with_the_installed_kernels(self):
        program = os.path.join(self.holder.name, "usr", "bin", "rectray")
        picture = os.path.join(self.holder.name, "a.png")
        scene = os.path.join(self.share, "rectray", "scenes", "original.json")
        run = subprocess.run([program, "render", scene, "--size", "8x6", "-k", "plain", "-o", picture],
                             env={**os.environ, "RECTRAY_KERNELS": os.path.join(self.share, "rectray", "kernels")},
                             capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stderr)
        os.remove(picture)


    def test_a_program_is_built_with_the_installed_library(self):
        lib = os.path.join(self.holder.name, "usr", "lib")
        env = {**os.environ, "PKG_CONFIG_LIBDIR": os.path.join(lib, "pkgconfig"),
               "PKG_CONFIG_SYSROOT_DIR": self.holder.name}
        flags = subprocess.run(["pkg-config", "--cflags", "--libs", "rectray"], env=env, capture_output=True, text=True,
                               check=True).stdout.split()
        with open("docs/library.md", encoding="utf-8") as file:
            source = re.search(r"```c\n(.*?)```", file.read(), re.S)[1]
        example = os.path.join(self.holder.name, "example")
        run = subprocess.run(["cc", "-x", "c", "-", *flags, f"-Wl,-rpath,{lib}", "-o", example], input=source,
                             text=True, capture_output=True, check=False)
        self.assertEqual(run.returncode, 0, run.stderr)
        picture = subprocess.run([example, "scenes/original.json"], capture_output=True, check=True).stdout
        self.assertTrue(picture.startswith(b"P6\n64 48\n255\n"))
        os.remove(example)


@unittest.skipIf(SANITIZED, "as above")
class Uninstall(unittest.TestCase):
    def test_it_removes_every_file(self):
        with tempfile.TemporaryDirectory() as folder:
            make(folder, "install")
            self.assertGreater(len(files_below(folder)), 50)
            make(folder, "uninstall")
            self.assertEqual(files_below(folder), [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
