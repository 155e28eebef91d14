#!/usr/bin/env python3
"""What a command answers to files that are no files, to crowds of things, to the largest pictures and to scenes without
sense: a picture, or one message of a few lines and status 1; soon, and with memory in proportion. What one text can
have wrong is in tests/test_hostile.c and tests/scenes/bad/; `make soak` adds the largest cases."""
import json
import os
import re
import shutil
import signal
import struct
import subprocess
import time
import unittest
import xml.etree.ElementTree
import zlib

from support.program import PROGRAM, SCENE, SOAK, CommandTest

with open(PROGRAM, "rb") as program:
    SANITIZED = b"__asan_init" in program.read()

MIB = 1 << 20
QUAD = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"


def scene(**changes):
    """The common scene with other members."""
    return json.dumps({**SCENE, **changes})


def pixels_of(png):
    """The rows of an 8-bit RGB picture without filters, as ours are."""
    columns, rows = struct.unpack(">II", png[16:24])
    data, at = b"", 8
    while at < len(png):
        size, kind = struct.unpack(">I4s", png[at:at + 8])
        data += png[at + 8:at + 8 + size] if kind == b"IDAT" else b""
        at += size + 12
    data = zlib.decompress(data)
    return [data[row * (3 * columns + 1) + 1:(row + 1) * (3 * columns + 1)] for row in range(rows)]


class HostileTest(CommandTest):
    def measured(self, *words, status=0, seconds=60, **options):
        """Runs a command; returns stderr and the most memory that it held, in bytes."""
        options.setdefault("stdout", subprocess.DEVNULL)
        process = subprocess.Popen([options.pop("program", PROGRAM), *words], cwd=self.folder, stdin=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, **options)
        old = signal.signal(signal.SIGALRM, lambda *_: process.kill())
        signal.alarm(seconds)
        err = process.stderr.read().decode(errors="surrogateescape")
        process.stderr.close()
        _, ended, usage = os.wait4(process.pid, 0)
        signal.alarm(0)
        signal.signal(signal.SIGALRM, old)
        process.returncode = os.waitstatus_to_exitcode(ended)
        self.assertEqual(process.returncode, status, f"rectray {' '.join(map(str, words))}\n{err}")
        return err, usage.ru_maxrss * 1024

    def refused(self, *words, **options):
        """One message, soon, in little memory; returns its first line."""
        given = self.files()
        err, peak = self.measured(*words, status=1, seconds=20, **options)
        self.assertLess(len(err), 5000)
        self.assertLessEqual(err.count("\n"), 3)
        if not SANITIZED:
            self.assertLess(peak, 64 * MIB)
        self.assertEqual(self.files(), given)
        return err.split("\n")[0]

    def put_model(self, name, lines, **changes):
        """scene.json with one object that is the model."""
        if lines is not None:
            self.put(name, lines)
        self.put("scene.json", scene(objects=[{"material": "pink", "obj": name}], **changes))


class Files(HostileTest):
    def test_a_model_that_is_no_file(self):
        os.mkdir(self.path("folder.obj"))
        os.mkfifo(self.path("pipe.obj"))
        os.symlink("loop.obj", self.path("loop.obj"))
        for name, reason in (("folder.obj", "is a folder, not a file"), ("pipe.obj", "is a pipe, not a file"),
                             ("/dev/zero", "is a device, not a file"), ("/dev/tty", "cannot be opened|is a device"),
                             ("loop.obj", "cannot be opened: Too many levels"),
                             ("", "must be the name of a file"),
                             ("missing.obj", "cannot be opened: No such file"), ("scene.json/x", "Not a directory")):
            self.put_model(name, None)
            self.assertRegex(self.refused("check", "scene.json"), reason)

    def test_a_library_that_is_no_file(self):
        os.mkdir(self.path("folder.mtl"))
        os.mkfifo(self.path("pipe.mtl"))
        for name in ("folder.mtl", "pipe.mtl", ".", "/dev/zero"):
            self.put_model("m.obj", f"# a model\nmtllib {name}\n" + QUAD + "f 1 2 3 4\n")
            err, _ = self.measured("check", "scene.json")
            self.assertEqual(err, f'm.obj:2: note: a material library is not there: "{name}"; faces get the materials '
                             "of the scene\n")

    def test_a_scene_and_rays_that_are_no_file(self):
        for words in (["check", "/dev/zero"],
                      ["check", "."], ["cast", "scene.json", "--rays", "."], ["compare", ".", "."],
                      ["compare", "scene.json", "scene.json"]):
            self.refused(*words)

    def test_a_file_that_may_not_be_read(self):
        """As another user, where we are root."""
        shutil.copy(PROGRAM, self.path("rectray"))
        os.chmod(self.folder, 0o755)
        self.put_model("m.obj", QUAD + "f 1 2 3 4\n")
        other = {"user": 65534, "group": 65534, "extra_groups": []} if os.geteuid() == 0 else {}
        self.measured("check", "scene.json", program=self.path("rectray"), **other)
        for name, place in (("m.obj", r"scene\.json:1:\d+: objects\[0\]\.obj: m\.obj"), ("scene.json", r"scene\.json")):
            os.chmod(self.path(name), 0)
            line = self.refused("check", "scene.json", program=self.path("rectray"), **other)
            self.assertRegex(line, f"^{place}: cannot be opened: Permission denied$")
            os.chmod(self.path(name), 0o644)

    def test_a_model_cut_at_every_byte(self):
        """Each is a scene or refused; the command's messages say the line."""
        with open("tests/scenes/models/house.obj", encoding="utf-8") as file:
            model = file.read()
        shutil.copy("tests/scenes/models/house.mtl", self.folder)
        for cut in range(0, len(model), 1 if SOAK else 23):
            self.put_model("m.obj", model[:cut])
            process = self.start("check", "-q", "scene.json")
            err = process.communicate(timeout=20)[1].decode()
            self.assertIn(process.returncode, (0, 1))
            self.assertRegex(err, r"^(m\.obj(:\d+)?: .+\n)?$")

    def test_references_past_the_vertices(self):
        for face in ("f 1 2 5", "f -5 1 2", "f 1 2 99999999999999999999", "f 1 2 -99999999999999999999",
                     "f 1 2 2147483648",
                     "f 1 2 -2147483649", "f 0 1 2"):
            self.put_model("m.obj", QUAD + face + "\n")
            self.assertRegex(self.refused("check", "scene.json"),
                             "^m.obj:5: (vertex -?[0-9]+ does not exist|\"0\" is not)")

    def test_models_and_libraries_in_odd_encodings(self):
        quad = QUAD + "f 1 2 3 4\n"
        self.put_model("m.obj", None)
        with open(self.path("m.obj"), "w", encoding="utf-16") as file:
            file.write(quad)
        self.assertRegex(self.refused("check", "scene.json"), "^m.obj:1: is UTF-16; .*$")
        self.put_model("m.obj", "mtllib m.mtl\n" + quad)
        with open(self.path("m.mtl"), "w", encoding="utf-16") as file:
            file.write("newmtl pink\n")
        self.assertRegex(self.refused("check", "scene.json"), r"^m\.obj:1: mtllib: m\.mtl:1: is UTF-16; .*$")
        self.put_model("m.obj", quad.replace("\n", "\r\n"))
        self.measured("check", "scene.json")

    def test_a_model_of_one_endless_line(self):
        self.put_model("m.obj", "v" + " 0" * MIB)
        self.assertIn("m.obj:1: the line is longer than 1048576 bytes", self.refused("check", "scene.json"))


class Texts(HostileTest):
    """What test_hostile.c asks of the reader, asked of the command: its message and its status."""

    def assert_refused(self, text, line):
        with open(self.path("scene.json"), "wb") as file:
            file.write(text if isinstance(text, bytes) else text.encode())
        self.assertRegex(self.refused("check", "scene.json"), f"^scene.json:{line}$")

    def test_a_scene_cut_at_every_byte(self):
        whole = scene()
        for cut in range(0, len(whole), 1 if SOAK else 31):
            self.assert_refused(whole[:cut], r"\d+:\d+: .+")

    def test_nesting_without_end(self):
        for opening, column in (("[", 65), ('{"a":', 321)):
            self.assert_refused(opening * 100000, f"1:{column}: lists and objects are nested more than 64 deep")
        self.assert_refused('{"objects":' + "[" * 100000 + "]" * 100000 + "}", "1:75: lists and objects are nested .*")

    def test_names_of_a_million_characters(self):
        name = "x" * 1000000
        box = {"material": "pink", "box": {"min": [1000, 0, 0], "max": [1001, 1, 1]}}
        self.assert_refused(scene(**{name: 1}), r'\d+:\d+: \["x+\.\.\."\]: unknown key; .*')
        self.assert_refused(scene(objects=[{**box, "material": name}]),
                            r'\d+:\d+: objects\[0\]\.material: .*"x+\.\.\." does not exist')
        self.assert_refused(scene(objects=[{"material": "pink", "obj": name}]),
                            r'\d+:\d+: .*"x+\.\.\.": cannot be opened: File name too long')
        self.put("scene.json", scene(objects=[{**box, "name": name}], materials={"pink": {}, name: {}}))
        self.measured("render", "scene.json", "-q", "-b", "reference", "-o", "a.png")
        out, _ = self.run_program("trace", "scene.json", "--pixel", "4,3")
        self.assertIn(b"xxx", out)
        self.assertLess(len(out), 100000)

    def test_numbers(self):
        text = scene(camera={"position": ["NUMBER", 0, 5], "look_at": [0, 0, 0]}, objects=[])
        for number in ("-0", "1e-320", "-4.9e-324", "1E+2"):
            self.put("scene.json", text.replace('"NUMBER"', number))
            self.measured("render", "scene.json", "-q", "-b", "reference", "-o", "a.png")
        for number, reason in (("1e999", "the number is too large .*"), ("-1e999", "the number is too large .*"),
                               ("0x10", "not a number of JSON .*"), ("007", "not a number of JSON .*"),
                               ("1e", "not a number of JSON .*"),
                               ("1" * 1000000, "a number of more than 63 characters"),
                               ("NaN", "expected a value .*"), ("1e300", "camera.*")):
            os.path.exists(self.path("a.png")) and os.remove(self.path("a.png"))
            self.assert_refused(text.replace('"NUMBER"', number), rf"1:\d+: {reason}")

    def test_bytes(self):
        whole = scene().encode()
        for text, line in ((b"", "1:1: .*"), (b"\0" * 1000, "1:1: a NUL byte; .*"),
                           (whole + b"\0", r"1:\d+: a NUL byte; .*"),
                           (b"\xef\xbb\xbf" + whole, "1:1: starts with a byte order mark; .*"),
                           (whole.decode().encode("utf-16"), "1:1: .*UTF-16.*"),
                           (whole.replace(b"tile", b"\\ud800"), r"1:\d+: half a surrogate pair; .*"),
                           (whole.replace(b"tile", b"\\udc00\\ud800"), r"1:\d+: half a surrogate pair; .*"),
                           (whole.replace(b"tile", b"\xed\xa0\x80"), r"1:\d+: .*UTF-8.*"),
                           (whole.replace(b'"lights"', b'"camera"'),
                            r"1:\d+: camera: the key stands twice in this object; .*")):
            self.assert_refused(text, line)
        self.put("scene.json", json.dumps(SCENE, indent=1).replace("\n", "\r\n"))
        self.measured("render", "scene.json", "-q", "-b", "reference", "-o", "a.png")
        crlf = self.bytes_of("a.png")
        self.put("scene.json", scene())
        self.measured("render", "scene.json", "-q", "-b", "reference", "-o", "a.png")
        self.assertEqual(self.bytes_of("a.png"), crlf)


class Names(HostileTest):
    def test_names_that_are_not_utf8_give_json_and_xml_all_the_same(self):
        folder, name = os.fsencode(self.folder), b"caf\xe9.json"
        self.put_model("m.obj", None)
        os.rename(self.path("scene.json"), os.path.join(folder, name))
        with open(self.path("m.obj"), "wb") as file:
            file.write(QUAD.replace("v 0", "v 1000").replace("v 1 ", "v 1001 ").encode() +
                       b"mtllib m.mtl\nusemtl caf\xe9 \xc2\x9b\nf 1 2 3 4\n")
        with open(self.path("m.mtl"), "wb") as file:
            file.write(b"newmtl caf\xe9 \xc2\x9b\nKd 1 1 1\n")
        for form in ("json", "svg", "text"):
            out = subprocess.run([PROGRAM, "trace", name, "--pixel", "3,3", "--format", form], cwd=self.folder,
                                 capture_output=True, check=True).stdout
            text = out.decode() # fails where it is not UTF-8
            self.assertIn("caf?", text)
            if form == "json":
                self.assertEqual(json.loads(text)["scene"]["file"], "caf?.json")
            if form == "svg":
                xml.etree.ElementTree.fromstring(out)
        out = subprocess.run([PROGRAM, "check", "--geometry", name], cwd=self.folder, capture_output=True,
                             check=True).stdout
        self.assertIn("caf? \x9b", [json.loads(line.split(" ", 2)[2]) for line in out.decode().splitlines()
                                     if line.startswith("material")])

    def test_no_name_steers_the_terminal(self):
        for name in ("\x1b[31mred", "\x9b31m", "a\x07b", "a\x7fb"):
            self.put("scene.json", scene(objects=[{"material": name, "box": {"min": [0, 0, 0], "max": [1, 1, 1]}}]))
            self.assertNotRegex(self.refused("check", "scene.json"), "[\x00-\x08\x0b-\x1f\x7f-\x9f]")
            self.put_model(name, None)
            self.assertNotRegex(self.refused("check", "scene.json"), "[\x00-\x08\x0b-\x1f\x7f-\x9f]")


class Crowds(HostileTest):
    def render_both(self):
        for words in (["-b", "reference", "-o", "a.png"], ["--precision", "double", "-o", "b.png"], ["-o", "c.png"]):
            self.measured("render", "scene.json", "-q", *words)
        self.run_program("compare", "a.png", "b.png")
        self.run_program("compare", "a.png", "c.png", "--tolerance", "1")

    def test_a_thousand_lights(self):
        lights = [{"position": [1000 + i % 10, i // 10 % 10, 2 + i // 100], "diffuse": [0.001, 0.001, 0.002]}
                  for i in range(1000)]
        self.put("scene.json", scene(lights=lights))
        self.render_both()

    def test_ten_thousand_materials(self):
        count = 10000
        materials = {f"m{i}": {"diffuse": [i / count, 1 - i / count, 0.5]} for i in range(count)}
        faces = [{"vertices": [4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3], "material": f"m{i}"} for i in range(count)]
        vertices = [[1000 + (i % 100 + x) / 100, (i // 100 + y) / 100, 0] for i in range(count)
                    for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
        self.put("scene.json", scene(materials=materials, objects=[{"vertices": vertices, "faces": faces}]))
        self.render_both()

    def test_ten_thousand_materials_and_a_wrong_one(self):
        materials = {f"m{i}": {} for i in range(10000)}
        self.put("scene.json",
                 scene(materials=materials,
                       objects=[{"material": "m10000", "box": {"min": [0, 0, 0], "max": [1, 1, 1]}}]))
        self.assertRegex(self.refused("check", "scene.json"), 'the material "m10000" does not exist; did you mean "m')

    def test_a_hundred_thousand_objects(self):
        box = {"material": "pink", "box": {"min": [0, 0, 0], "max": [1, 1, 1]}}
        self.put("scene.json", scene(objects=[box] * 100000))
        self.measured("check", "scene.json")

    def put_faces(self, side):
        """A model of side x side quads."""
        with open(self.path("m.obj"), "w", encoding="ascii") as file:
            for j in range(side + 1):
                file.write("".join(f"v {1000 + i} {j} 0\n" for i in range(side + 1)))
            for j in range(side):
                row = range(j * (side + 1) + 1, j * (side + 1) + 1 + side)
                file.write("".join(f"f {i} {i + 1} {i + side + 2} {i + side + 1}\n" for i in row))
        self.put_model("m.obj", None)

    @unittest.skipIf(SANITIZED, "the sanitizers have memory of their own")
    def test_memory_grows_with_the_faces_as_the_page_says(self):
        """docs/scene-format.md states the bytes of a face, for loading and for rendering."""
        with open("docs/scene-format.md", encoding="utf-8") as file:
            stated = {match[0]: int(match[1])
                      for match in re.findall(r"^\| `(rectray [^`]+)` \| (\d+) \|$", file.read(), re.M)}
        self.assertEqual(len(stated), 4)
        sides = (1000, 3163) if SOAK else (450, 800)
        peaks = []
        for side in sides:
            self.put_faces(side)
            peaks.append({command: self.measured(*command.replace("SCENE", "scene.json").split()[1:], "-q",
                                                 seconds=900)[1]
                          for command in stated})
        for command, bytes_per_face in stated.items():
            measured = (peaks[1][command] - peaks[0][command]) / (sides[1] ** 2 - sides[0] ** 2)
            self.assertLess(measured, bytes_per_face * 1.1, command)


class Pictures(HostileTest):
    def rows_of(self, *words):
        self.measured("render", "scene.json", "-q", "-o", "a.png", *words)
        return pixels_of(self.bytes_of("a.png"))

    def assert_all_pixels(self, colour):
        for backend in ("reference", "opencl"):
            self.assertEqual(set(b"".join(self.rows_of("-b", backend))), set(colour))

    def test_no_faces(self):
        self.put("scene.json", scene(objects=[], shading={"background": [1, 1, 1]}))
        self.assert_all_pixels([255])

    def test_no_lights(self):
        self.put("scene.json", scene(lights=[]))
        self.assert_all_pixels([0])

    def test_nothing_at_all(self):
        self.put("scene.json", json.dumps({key: SCENE[key] for key in ("camera", "screen")}))
        self.assert_all_pixels([0])

    def test_the_camera_inside_a_wall(self):
        """In the plane of a face, within it, looking along it and through it: the face itself is not seen."""
        for look_at in ([1000.5, 0.9, 0], [1000.5, 0.5, 5], [1000.5, 0.5, -5]):
            camera = {"position": [1000.5, 0.5, 0], "look_at": look_at, "up": [1, 0, 0]}
            self.put("scene.json",
                     scene(camera=camera, objects=SCENE["objects"][:1], shading={"background": [1, 1, 1]}))
            self.assert_all_pixels([255])

    def test_a_view_without_direction(self):
        for camera, reason in (({"position": [1, 2, 3], "look_at": [1, 2, 3]},
                                "camera.look_at: the camera looks at its own position"),
                               ({"position": [0, 0, 5], "look_at": [0, 0, 0], "up": [0, 0, -3]},
                                'camera.up: "up" is parallel to the view'),
                               ({"position": [0, 5, 0], "look_at": [0, 0, 0]}, 'camera: the view is parallel to "up"'),
                               ({"position": [0, 0, 5], "look_at": [0, 0, 0], "up": [0, 0, 0]},
                                'camera.up: "up" has no direction')):
            self.put("scene.json", scene(camera=camera))
            self.assertIn(reason, self.refused("render", "scene.json"))

    @unittest.skipIf(SANITIZED, "the sanitizers have memory of their own")
    def test_a_picture_takes_little_memory_of_any_size(self):
        """Rendered by bands: 64 MiB more than a tiny one at most. libpng's own share is within."""
        self.put("scene.json", scene(objects=[]))
        for backend in ("reference", "opencl"):
            tiny = self.measured("render", "scene.json", "-q", "-b", backend, "-o", "a.png", "-s", "16x16")[1]
            for size in ("16384x16384", "16384x4096", "1x16384") if SOAK else ("16384x256", "2048x2048", "1x16384"):
                peak = self.measured("render", "scene.json", "-q", "-b", backend, "-o", "a.png", "-s", size,
                                     seconds=1200)[1]
                self.assertLess(peak - tiny, 64 * MIB, f"{backend}, {size}")
            columns, rows = struct.unpack(">II", self.bytes_of("a.png")[16:24])
            self.assertEqual((columns, rows), (1, 16384))


if __name__ == "__main__":
    unittest.main(verbosity=2)
