"""render --watch: a new picture after every change of what it is made of, and a message where that fails."""
import json
import os
import queue
import signal
import threading
import unittest

from support.program import SCENE, CommandTest

SQUARE = "v 1000 0 0\nv 1001 0 0\nv 1001 1 0\nv 1000 1 0\nf 1 2 3 4\n"


class WatchTest(CommandTest):
    def watch(self, *words, **options):
        self.process = self.start("render", "scene.json", "-b", "reference", "-o", "a.png", "--watch", *words,
                                  **options)
        self.lines = queue.Queue()
        def read():
            for line in self.process.stderr:
                self.lines.put(line.decode())
            self.lines.put("it ended; watching scene.json")
        self.reader = threading.Thread(target=read, daemon=True)
        self.reader.start()
        self.addCleanup(self.stop)
        return self.next()

    def stop(self):
        self.process.kill()
        self.process.wait()
        self.reader.join()
        self.process.stdout.close()
        self.process.stderr.close()

    def next(self):
        """What is said until the next wait."""
        said = ""
        while "watching scene.json" not in said:
            said += self.lines.get(timeout=30)
        self.assertNotIn("it ended", said)
        return said

class Watch(WatchTest):
    def picture_of(self, scene):
        self.put("other.json", json.dumps(scene))
        self.run_program("render", "other.json", "-b", "reference", "-o", "b.png")
        return self.bytes_of("b.png")

    def test_it_renders_at_once_and_after_each_change(self):
        self.assertIn("a.png: 8 x 6 pixels", self.watch())
        self.assertEqual(self.bytes_of("a.png"), self.picture_of(SCENE))
        changed = {**SCENE, "screen": {"columns": 9, "rows": 7}}
        self.put("scene.json", json.dumps(changed))
        self.assertIn("a.png: 9 x 7 pixels", self.next())
        self.assertEqual(self.bytes_of("a.png"), self.picture_of(changed))
        self.put("new.json", json.dumps(SCENE))  # as editors do: a new file under the old name
        os.rename(self.path("new.json"), self.path("scene.json"))
        self.assertIn("a.png: 8 x 6 pixels", self.next())
        self.process.send_signal(signal.SIGINT)
        self.assertEqual(self.process.wait(timeout=20), 128 + signal.SIGINT)

    def test_a_fault_is_told_and_the_old_picture_stays(self):
        self.watch()
        before = self.bytes_of("a.png")
        self.put("scene.json", '{"camera": 7}')
        self.assertRegex(self.next(), r"^scene.json:1:1: the key")
        self.assertEqual(self.bytes_of("a.png"), before)
        os.remove(self.path("scene.json"))
        self.assertIn("scene.json: cannot be opened", self.next())
        self.put("scene.json", json.dumps(SCENE))
        self.assertIn("a.png: 8 x 6 pixels", self.next())

    def test_a_file_that_is_written_in_pieces_ends_in_the_right_picture(self):
        self.watch()
        text = json.dumps({**SCENE, "screen": {"columns": 12, "rows": 5}})
        with open(self.path("scene.json"), "w", encoding="utf-8") as file:
            for part in (text[:100], text[100:200], text[200:]):
                file.write(part)
                file.flush()
                threading.Event().wait(0.03)
        while "12 x 5 pixels" not in self.next():
            pass  # a slow machine may see a part of it

    def test_models_are_watched_also_those_that_are_missing(self):
        scene = {**SCENE, "objects": [{"material": "pink", "obj": "square.obj"}]}
        self.put("scene.json", json.dumps(scene))
        self.assertIn("square.obj", self.watch())
        self.put("square.obj", SQUARE)
        said = self.next()
        while "8 x 6 pixels" not in said:
            said = self.next()
        self.put("square.obj", SQUARE + "f 1 2\n")
        self.assertRegex(self.next(), "square.obj:6: ")

    def test_libraries_of_models_are_watched(self):
        self.put("red.mtl", "newmtl red\nKa 1 0 0\n")
        self.put("square.obj", "mtllib red.mtl\n" + SQUARE.replace("f 1", "usemtl red\nf 1"))
        self.put("scene.json", json.dumps({**SCENE, "objects": [{"obj": "square.obj"}]}))
        self.watch()
        before = self.bytes_of("a.png")
        self.put("blue.mtl", "newmtl red\nKa 0 0 1\n")
        os.rename(self.path("blue.mtl"), self.path("red.mtl"))
        self.assertIn("8 x 6 pixels", self.next())
        self.assertNotEqual(self.bytes_of("a.png"), before)

    def test_what_cannot_be_watched(self):
        self.assertIn("needs a file", self.run_program("render", "-", "--watch", "-o", "a.png", status=2)[1])
        _, err = self.run_program("render", "scene.json", "--watch", "-o", "a.jpg", status=2)
        self.assertIn("pictures end in", err)


class Kernels(WatchTest):
    def test_kernel_files_are_watched(self):
        self.run_program("kernels", "--export", "mine")
        self.watch("-b", "opencl", "-k", "plain", env={**os.environ, "RECTRAY_KERNELS": self.path("mine")})
        before = self.bytes_of("a.png")
        with open(self.path("mine/plain.cl"), encoding="utf-8") as file:
            kernel = file.read()
        self.put("mine/plain.cl", "#error stop\n" + kernel)
        self.assertIn("stop", self.next())
        self.assertEqual(self.bytes_of("a.png"), before)
        self.put("mine/plain.cl", kernel)
        self.assertIn("8 x 6 pixels", self.next())


if __name__ == "__main__":
    unittest.main(verbosity=2)
