#!/usr/bin/env python3
"""The page, in a real browser, from a file: its pictures, walkthroughs and messages are the program's, byte for byte,
and it does what docs/page.md says. Without browser or page only what needs neither is tested, and the rest is said to
be skipped.
SHOTS=folder keeps screenshots."""

import base64
import glob
import json
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "support"))
from browser import Browser, find_browser
from program import CommandTest, PROGRAM, png_pixels

PAGE = os.path.abspath("build/rectray.html")
LIMIT = 1 << 20
# A pixel is told before the picture is done.
SHOWN = "typeof page !== 'undefined' && page.walk || (document.body || {dataset: {}}).dataset.state === 'failed'"
SETTLED = "['done', 'failed'].includes((document.body || {dataset: {}}).dataset.state)"
SCENES = sorted(glob.glob("scenes/*.json"))
LESSONS = sorted(glob.glob("scenes/lessons/*.json"))
TEST_SCENES = sorted(glob.glob("tests/scenes/*.json"))
BAD_SCENES = sorted(glob.glob("tests/scenes/bad/*.json"))
GALLERY = "#scene=scenes/gallery.json&size=320x180&grid=1"

missing = "" if find_browser() else "no browser here"
if not os.path.exists(PAGE):
    missing = "the page is not built"

# Walkthroughs in 17 digits part by a unit of the last one where the C library takes another way to a power.
PLAIN_POW = {**os.environ, "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2,-FMA_Usable,-AVX2_Usable"}


def rectray(*words, env=None):
    """The program's standard output, and its standard error."""
    done = subprocess.run(
        [PROGRAM, *words], capture_output=True, stdin=subprocess.DEVNULL, timeout=120, env=env
    )
    return done.stdout, done.stderr.decode()


def rendered(*words):
    """The bytes of the picture that the reference makes: 3 a pixel."""
    picture, _ = rectray("render", *words, "--backend", "reference", "--quiet", "-o", "-")
    return flat(picture)


def flat(png):
    return b"".join(bytes(value for pixel in row for value in pixel) for row in png_pixels(png))


def read(path):
    with open(path, "rb") as file:
        return file.read()


class Sources(unittest.TestCase):
    """What the page is made of, without a browser."""

    def test_steps_name_functions_and_sections_that_are_there(self):
        table = read("src/walkthrough/walkthrough_step.c").decode()
        named = re.findall(r'"(\w+) ([a-z]+/\w+\.c)"', table)
        self.assertGreater(len(named), 15)
        for function, path in named:
            self.assertRegex(read("src/" + path).decode(), rf"(?m)^[a-zA-Z].*\b{function}\(", path)
        sections = re.findall(r"(?m)^## (\d+)\. ", read("docs/algorithm.md").decode())
        for group in re.findall(r"\.sections = \{([\d, ]+)\}", table):
            for number in group.split(", "):
                self.assertIn(number, sections)

    def test_every_script_is_in_the_page_once(self):
        listed = re.search(r'scripts="([^"]*)"', read("src/page/build.sh").decode()).group(1).split()
        self.assertEqual(
            sorted(listed), sorted(os.path.basename(path)[:-3] for path in glob.glob("src/page/*.js"))
        )

    @unittest.skipUnless(os.path.exists(PAGE), "the page is not built")
    def test_page_is_small_and_whole(self):
        self.assertLess(os.path.getsize(PAGE), LIMIT)
        page = read(PAGE).decode()
        film = '<a href="../docs/images/turntable.gif">' # a link fetches nothing until it is followed
        self.assertTrue(film in page and os.path.exists("build/" + film[9:-2]))
        page = page.replace(film, "")
        self.assertNotRegex(page, r"(?m)^@[A-Z]+@$")
        outside = re.findall(r"""(?:src|href)=["'](?!data:)[^"']+|https?://(?!www\.w3\.org/)[^\s"'<)]+""", page)
        self.assertEqual(outside, [])


class Explore(CommandTest):
    """rectray explore, without a browser."""

    def setUp(self):
        super().setUp()
        _, self.refusal = rectray(
            "explore", os.path.join(self.folder, "scene.json"), "-o", os.path.join(self.folder, "x.html")
        )

    def need_page(self):
        if "built without the page" in self.refusal:
            self.skipTest("this program was built without the page")

    def test_a_program_without_the_page_says_how_it_comes_in(self):
        if "built without the page" not in self.refusal:
            self.skipTest("this program has the page")
        self.assertIn("`make page`", self.refusal)

    def test_page_has_the_scenes_name_and_holds_its_files(self):
        self.need_page()
        self.run_program("explore", "scene.json", "--quiet")
        page = self.bytes_of("scene.html").decode()
        self.assertIn('data-file="scene.json"', page)
        self.assertIn(base64.b64encode(self.bytes_of("scene.json")).decode(), page)

    def test_a_wrong_scene_makes_no_page(self):
        self.need_page()
        self.put("wrong.json", "{}")
        _, err = self.run_program("explore", "wrong.json", status=1)
        self.assertTrue(err.startswith("wrong.json:1:"), err)
        self.assertNotIn("wrong.html", self.files())

    def test_a_large_scene_is_refused_with_the_limit(self):
        self.need_page()
        scene = json.loads(self.bytes_of("scene.json"))
        scene["//"] = "x" * (21 << 20)
        self.put("large.json", json.dumps(scene))
        _, err = self.run_program("explore", "large.json", status=1)
        self.assertIn("20 MB", err)
        self.assertNotIn("large.html", self.files())

    def test_a_pixel_outside_is_refused(self):
        self.need_page()
        _, err = self.run_program("explore", "scene.json", "--pixel", "8,0", status=2)
        self.assertIn("0,0 to 7,5", err)

    def test_open_calls_xdg_open(self):
        self.need_page()
        self.put("xdg-open", '#!/bin/sh\necho "$1" >opened\n')
        os.chmod(self.path("xdg-open"), 0o755)
        path = self.folder + ":" + os.environ["PATH"]
        self.run_program(
            "explore", "scene.json", "--open", "-o", "p.html", "-q", env={**os.environ, "PATH": path}
        )
        self.assertEqual(self.bytes_of("opened"), b"p.html\n")
        _, err = self.run_program("explore", "scene.json", "--open", "-o", "-", status=2)
        self.assertIn("--open", err)

    def test_names_that_could_end_a_tag_stay_names(self):
        self.need_page()
        name = 'a&"<script>.json'
        self.put(name, self.bytes_of("scene.json").decode())
        self.run_program("explore", name, "-o", "odd.html", "--quiet")
        page = self.bytes_of("odd.html").decode()
        self.assertIn('data-file="a&amp;&quot;&lt;script>.json"', page)
        self.assertIn('"scene":"a&\\"\\u003cscript>.json"', page)


@unittest.skipIf(missing, missing)
class InBrowser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = Browser(find_browser())
        cls.value, cls.wait = cls.browser.value, cls.browser.wait

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()

    def setUp(self):
        self.browser.resize(1366, 768)

    def tearDown(self):
        # Screenshots and this suite read pixels back, and the browser says that it is slow.
        loud = [
            complaint
            for complaint in self.browser.complaints()
            if not re.search("GPU stall|Multiple readback operations", str(complaint))
        ]
        self.assertEqual(loud, [])
        asked = [url for url in self.browser.requests() if not re.match(r"(file|blob|data|about):", url)]
        self.assertEqual(asked, [])
        if os.environ.get("SHOTS"):
            self.browser.screenshot(os.path.join(os.environ["SHOTS"], self.id().split(".")[-1] + ".png"))

    def open(self, fragment="", path=PAGE):
        self.browser.events.clear()
        self.browser.open("about:blank")
        self.browser.open("file://" + path + fragment)
        self.wait(SHOWN)
        self.assertEqual(self.value("$('error').textContent"), "")

    def give_files(self, paths):
        """Puts files into the page, as if it had been made with them."""
        files = {path: base64.b64encode(read(path)).decode() for path in paths}
        self.value(
            f"void Object.entries({json.dumps(files)}).forEach(([name, text]) => page.files.set(name, bytesOf(text)))"
        )

    def pixels(self, canvas="picture"):
        self.wait(SETTLED)
        return base64.b64decode(self.value(f"""(() => {{
            const c = $('{canvas}'), d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
            let s = '';
            for (let i = 0; i < d.length; i += 4) s += String.fromCharCode(d[i], d[i + 1], d[i + 2]);
            return btoa(s);
        }})()"""))

    def middle_of(self, name):
        return self.value(f"""(() => {{
            $('{name}').scrollIntoView({{block: 'center'}});
            const b = $('{name}').getBoundingClientRect();
            return [b.left + b.width / 2, b.top + b.height / 2];
        }})()""")

    def address(self):
        """What the page's address comes to within a moment."""
        return self.value("(writeNow(), location.hash)")

    def told(self):
        """The walkthrough as the page's elements have it."""
        return self.value(
            """$('head').textContent + '\\n' + [...$('steps').children].map(fold =>
            `\\n${fold.querySelector('summary').textContent}\\n\\n` + fold.querySelector('pre').textContent)
            .join('\\n') + '\\n'"""
        )

    # --- The same truth ---

    def test_pictures_are_the_references(self):
        self.open(GALLERY)
        self.give_files([*TEST_SCENES, *glob.glob("tests/scenes/models/*")])
        self.value("setGrid(0)")
        for scene in [*SCENES, *LESSONS, *TEST_SCENES]:
            with self.subTest(scene):
                self.assertTrue(self.value(f"openScene('{scene}', {{size: [64, 48]}})"))
                self.wait(SETTLED)
                self.assertTrue(self.pixels() == rendered(scene, "--size", "64x48"), scene)

    def test_rays_per_pixel_are_the_references(self):
        self.open("#scene=scenes/cornell.json&size=48x48&grid=4")
        self.assertTrue(self.pixels() == rendered("scenes/cornell.json", "--size", "48x48", "--grid", "4"))

    def test_textbook_arithmetic_is_the_programs(self):
        self.open("#scene=tests/none.json")
        scene = "tests/scenes/eye_on_a_plane.json"
        self.give_files([scene])
        for word, precision in (("textbook", "double"), ("float", "float")):
            self.value(f"openScene('{scene}', {{size: [64, 48], pixel: [20, 20]}}), setArithmetic('{word}')")
            self.wait(SETTLED)
            want = rendered(
                scene, "--size", "64x48", "--grid", "1", "--arithmetic", "textbook", "--precision", precision
            )
            self.assertTrue(self.pixels() == want, word)
            at = 3 * (20 * 64 + 20)
            self.assertIn(" ".join(map(str, want[at : at + 3])), self.value("$('answer').innerText"))
            self.assertIn("arithmetic=" + word, self.address())
        self.value("setArithmetic('exact')")

    def test_textbook_stands_beside_the_exact_walkthrough(self):
        self.open("#scene=scenes/lessons/acne.json&size=80x60&grid=1&pixel=30,46&arithmetic=float")
        words = "trace scenes/lessons/acne.json --size 80x60 --grid 1 --pixel 30,46 --arithmetic textbook"
        want = rectray(*words.split(), "--precision", "float")[0].decode()
        self.assertEqual(self.value("page.tracer.trace(30, 46, 'textbook')"), want)
        steps = self.value("JSON.parse(page.tracer.trace(30, 46, 'textbook-steps'))")
        self.assertEqual(steps["head"] + "".join(step["text"] for step in steps["steps"]), want)
        said = self.value("$('answer').querySelector('.textbook pre').textContent").split()
        self.assertIn(" ".join(said), " ".join(want.split()))
        self.assertIn("They part at P1", " ".join(said))
        # The step where they part is marked, and has both.
        marked = self.value("[...document.querySelectorAll('.tag')].map(tag => tag.closest('.step').dataset.number)")
        self.assertEqual(marked, ["3"])
        self.value("$('answer').querySelector('.textbook button').click()")
        self.assertEqual(self.value("page.step"), 3)
        self.assertIn("Here the two part.", self.value("document.querySelector('.step.now .textbook').textContent"))
        self.assertIn("Nothing is in the way", self.value("document.querySelector('.step.now .exact').textContent"))
        self.assertEqual(self.value("document.querySelectorAll('.step .textbook').length"), 5)
        self.value("setArithmetic('exact')")
        self.assertEqual(self.value("document.querySelectorAll('.textbook').length"), 0)

    def test_maps_are_the_programs(self):
        size = ["--size", "120x68", "--grid", "1", "--quiet", "--backend", "reference", "-o", os.devnull]
        self.open("#scene=scenes/gallery.json&size=120x68&grid=1")
        self.wait(SETTLED)
        kinds = ("rays", "depth", "normal", "face", "tests")
        with tempfile.TemporaryDirectory() as folder:
            files = {kind: os.path.join(folder, kind + ".png") for kind in kinds}
            maps = [word for kind in kinds for word in ("--map", kind, files[kind])]
            rectray("render", "scenes/gallery.json", *size, *maps)
            for kind in kinds:
                with self.subTest(kind):
                    self.value(f"chooseMap('{kind}')")
                    self.wait("!$('map').hidden")
                    self.assertTrue(self.pixels("map") == flat(read(files[kind])))

    def test_messages_are_the_programs(self):
        self.open(GALLERY)
        self.give_files(
            [
                *BAD_SCENES,
                *glob.glob("tests/scenes/bad/*.obj"),
                *glob.glob("tests/scenes/bad/*.mtl"),
                *glob.glob("tests/scenes/models/*"),
            ]
        )
        told = self.value(f"""{json.dumps(BAD_SCENES)}.map(path => {{
            try {{ page.tracer.open(path); return ''; }} catch (error) {{ return error.message; }} }})""")
        self.assertGreater(len(told), 150)
        for scene, message in zip(BAD_SCENES, told):
            with self.subTest(scene):
                self.assertEqual(message, rectray("check", scene)[1].rstrip("\n"))

    def test_walkthroughs_are_the_programs(self):
        self.open(GALLERY)
        chance = random.Random(7)
        for scene in SCENES:
            self.value(f"openScene('{scene}', {{size: [160, 120]}})")
            for _ in range(25):
                column, row = chance.randrange(160), chance.randrange(120)
                want, _ = rectray(
                    "trace", scene, "--size", "160x120", "--grid", "1", "--pixel", f"{column},{row}"
                )
                with self.subTest(scene, pixel=(column, row)):
                    text, steps = self.value(
                        f"""(() => {{ const walk = readWalk([{column}, {row}], 100);
                        return [page.tracer.trace({column}, {row}),
                                plain(walk.head + walk.steps.map(step => step.text).join(''))]; }})()"""
                    )
                    self.assertEqual(text, want.decode())
                    # Between the first line and the steps is the summary; after the last line stands its colour.
                    first, rest = steps.rstrip().split("\n", 1)
                    self.assertTrue(want.decode().startswith(first + "\n"), steps)
                    self.assertTrue(want.decode().rstrip().endswith(rest), steps)

    def test_json_is_the_programs_to_the_last_digit(self):
        self.open(GALLERY)
        for pixel in ("120,90", "225,95", "40,150"):
            want, _ = rectray(
                "trace",
                "scenes/gallery.json",
                "--size",
                "320x180",
                "--grid",
                "1",
                "--format",
                "json",
                "--pixel",
                pixel,
                env=PLAIN_POW,
            )
            self.assertEqual(self.value(f"page.tracer.trace({pixel}, 'json')"), want.decode())

    # --- Choosing a pixel ---

    def test_a_click_tells_the_pixel(self):
        self.open(GALLERY)
        x, y, scale = self.value("""(() => { const b = $('picture').getBoundingClientRect();
            return [b.left, b.top, b.width / 320]; })()""")
        self.browser.click(round(x + 225.5 * scale), round(y + 95.5 * scale))
        self.assertEqual(self.value("String(page.pixel)"), "225,95")
        words = "trace scenes/gallery.json --pixel 225,95 --size 320x180 --grid 1 --width".split()
        want, _ = rectray(*words, str(self.value("columnsOfText()")))
        self.assertEqual(
            [line.rstrip() for line in self.told().splitlines()],
            [want.decode().splitlines()[0]]
            + [line.rstrip() for line in want.decode().split("Step by step\n\n")[1].splitlines()],
        )
        self.assertEqual(self.value("$('answer-title').textContent"), want.decode().splitlines()[-1])
        self.assertEqual(
            self.value("document.querySelector('.path').textContent"),
            "camera → P1 mirror/0 → P2 star/32 → P3 far wall/0",
        )
        self.assertIn("pixel=225,95", self.address())
        labels = self.value("[...document.querySelectorAll('.label.of-hit')].map(l => l.textContent)")
        self.assertEqual(sorted(labels), ["P1", "P2", "P3"])

    def test_answer_has_the_sums_of_the_walkthrough(self):
        self.open(GALLERY + "&pixel=225,95")
        walk = self.value("page.walk")
        for channel in range(3):
            parts = [hit["contribution"][channel] for hit in walk["hits"]]
            self.assertAlmostEqual(sum(parts), walk["sum"][channel], 14)
            self.assertEqual(walk["rgb"][channel], int(255 * min(max(walk["sum"][channel], 0), 1) + 0.5))
        self.assertEqual(self.value("document.querySelectorAll('.hit').length"), len(walk["hits"]))
        self.assertEqual(self.value("document.querySelectorAll('.light').length"), 3 * len(walk["hits"]))

    def test_arrows_move_the_pixel(self):
        self.open(GALLERY + "&pixel=100,50")
        for key, shift, pixel in (
            ("ArrowRight", False, "101,50"),
            ("ArrowDown", False, "101,51"),
            ("ArrowLeft", True, "91,51"),
            ("ArrowUp", True, "91,41"),
        ):
            self.browser.key(key, shift)
            self.assertEqual(self.value("String(page.pixel)"), pixel)

    def test_a_key_that_is_held_does_not_flood_the_address(self):
        # A browser that was asked too often complains, which tearDown sees.
        self.open("#scene=scenes/mirrors.json&size=300x20&grid=1&pixel=0,10")
        self.value("(() => { for (let k = 0; k <= 250; k++) page.pixel = [k, 10], writeLink(); })()")
        self.wait("location.hash.includes('pixel=250,10')")

    def test_magnifier_shows_the_picture(self):
        self.open(GALLERY + "&pixel=225,95")
        self.wait(SETTLED)
        self.browser.key("v")
        cells = self.value(
            "[...document.querySelectorAll('#values-table td')]"
            ".map(cell => cell.innerText.trim().split(/\\s+/).map(Number))"
        )
        self.assertEqual(len(cells), 81)
        self.assertEqual(cells[40], self.value("page.walk.rgb"))
        self.assertEqual(cells[0], self.value("pixelColour(221, 91)"))
        self.value("$('values').close()")

    # --- Steps ---

    def test_space_plays_the_steps(self):
        self.open(GALLERY + "&pixel=225,95")
        opened = (
            "[...$('steps').children].filter(fold => fold.open).map(fold => Number(fold.dataset.number)).join()"
        )
        bold = (
            "linesOfPixel().filter(line => weightOf(line) === 2).map(line => line.kind + ':' + line.hit).join()"
        )
        self.value("document.activeElement.blur()")
        for _ in range(3):
            self.browser.key(" ")
        self.assertEqual(self.value(opened), "3")
        self.browser.key(" ", shift=True)
        self.assertEqual(self.value(opened), "2")
        self.assertIn("step=2", self.address())
        self.assertEqual(self.value("page.walk.steps[1].kind"), "nearest")
        self.assertEqual(self.value(bold), "0:1,4:1")
        self.browser.key("Escape")
        self.assertEqual(self.value("page.step"), 0)

    def test_a_link_leads_to_a_step_of_a_pixel(self):
        self.open("#scene=scenes/original.json&size=80x60&grid=1&pixel=40,36&step=3")
        self.assertEqual(self.value("$('answer-title').textContent"), "Pixel (40, 36) = (97, 74, 97)")
        self.assertEqual(self.value("document.querySelector('.step.now').dataset.number"), "3")
        self.assertTrue(self.value("document.querySelector('.step.now').open"))
        self.assertEqual(
            self.address(), "#scene=scenes/original.json&size=80x60&grid=1&pixel=40,36&step=3"
        )

    def test_a_link_leads_to_a_scene_of_any_name(self):
        self.open("#scene=scenes/original.json&size=40x30&grid=1")
        name = "my/a + b & #c 100%.json"
        self.value(f"page.files.set({json.dumps(name)}, fileOf('scenes/original.json')), openScene({json.dumps(name)})")
        self.wait("location.hash.includes('text=')")
        link = self.address()
        self.open(link)
        self.assertEqual(self.value("page.path"), name)

    def test_sections_of_the_algorithm_open(self):
        self.open(GALLERY + "&pixel=225,95&step=2")
        self.value("document.querySelector('.step.now .link').click()")
        self.assertTrue(self.value("$('section').open"))
        self.assertEqual(self.value("$('section-title').textContent"), "3. The plane hit")
        self.assertGreater(self.value("$('section-text').querySelectorAll('p').length"), 4)
        self.assertGreater(self.value("$('section-text').querySelector('img').naturalWidth"), 100)

    def test_a_pinned_pixel_is_compared(self):
        self.open("#scene=scenes/cornell.json&size=200x200&grid=1&pixel=20,100")
        self.browser.key("p")
        self.assertTrue(self.value("$('steps').checkVisibility()"))
        self.browser.key("ArrowRight")
        self.assertFalse(self.value("$('steps').checkVisibility()"))
        first = self.value("$('differences-first').textContent")
        self.assertEqual(first, "They take the same path, and the same lights reach it.")
        self.value("choosePixel(100, 150)")
        first = self.value("$('differences-first').textContent")
        want, _ = rectray(
            *"trace scenes/cornell.json --size 200x200 --grid 1 --diff --pixel 20,100 --pixel 100,150".split()
        )
        self.assertIn(first, want.decode())
        self.assertTrue(first.startswith("They part at P1: the first one hits left wall/0, the second"), first)
        table = self.value("$('differences-table').textContent").split()
        self.assertEqual(table, want.decode().split("\n\n")[1].split())
        shown = self.value(
            "[...document.querySelectorAll('.difference[open] td')].map(cell => cell.textContent).join('\\n')"
        )
        self.assertIn("left wall", shown)
        self.assertIn("short block", shown)
        self.browser.key("p")
        self.assertTrue(self.value("$('differences-part').hidden"))

    # --- In space ---

    def drawn(self):
        self.wait(SETTLED)
        return self.value("(() => { view.draw(); return view.canvas.toDataURL(); })()")

    def colours_in_space(self):
        return self.value("""(() => { view.draw(); const c = document.createElement('canvas');
            Object.assign(c, {width: view.canvas.width, height: view.canvas.height});
            const g = c.getContext('2d'); g.drawImage(view.canvas, 0, 0);
            return new Set(new Uint32Array(g.getImageData(0, 0, c.width, c.height).data.buffer)).size; })()""")

    def test_view_in_space_is_as_large_as_the_scene(self):
        # One in millionths, behind a screen at 1; one in hundreds.
        for scene in ("lessons/leak", "cornell"):
            self.open(f"#scene=scenes/{scene}.json&size=40x40&grid=1&pixel=20,20")
            self.assertGreater(self.colours_in_space(), 100, scene)

    def test_view_in_space_turns_by_dragging(self):
        self.open("#scene=scenes/cornell.json&size=100x100&grid=1&pixel=50,50")
        before, turn = self.drawn(), self.value("view.turn")
        self.browser.drag(*self.middle_of("space"), 100, 30)
        self.assertAlmostEqual(self.value("view.turn"), turn - 0.8, 6)
        self.assertNotEqual(self.drawn(), before)
        distance = self.value("view.distance")
        self.browser.mouse("mouseWheel", *self.middle_of("space"), deltaX=0, deltaY=-200)
        self.wait(f"view.distance < {distance}")

    def test_view_in_space_turns_by_keyboard(self):
        self.open("#scene=scenes/cornell.json&size=40x40&grid=1&pixel=20,20")
        self.value("$('space').focus()")
        turn, tilt, distance = self.value("[view.turn, view.tilt, view.distance]")
        for key in ("ArrowRight", "ArrowUp", "+"):
            self.browser.key(key)
        self.assertAlmostEqual(self.value("view.turn"), turn - 0.1, 6)
        self.assertAlmostEqual(self.value("view.tilt"), tilt + 0.1, 6)
        self.assertAlmostEqual(self.value("view.distance"), 0.85 * distance, 6)
        self.assertEqual(self.value("String(page.pixel)"), "20,20")

    def test_all_is_reached_by_the_tab_key(self):
        self.open("#scene=scenes/cornell.json&size=40x40&grid=1&pixel=20,20")
        wanted = set(self.value(
            """[...document.querySelectorAll('button, select, input, summary, canvas[tabindex]')]
            .filter(e => e.checkVisibility()).map(e => e.id || e.textContent.slice(0, 20))"""
        ))
        reached = set()
        self.value("document.activeElement.blur()")
        for _ in range(len(wanted) + 12):
            self.browser.key("Tab")
            reached.add(self.value("(e => e.id || e.textContent.slice(0, 20))(document.activeElement)"))
        self.assertEqual(wanted - reached, set())

    def test_two_fingers_come_nearer(self):
        self.open("#scene=scenes/cornell.json&size=100x100&grid=1&pixel=50,50")
        x, y = self.middle_of("space")
        distance, turn = self.value("view.distance"), self.value("view.turn")
        apart = [[(x - d, y), (x + d, y)] for d in (30, 40, 50, 60)]
        self.browser.fingers(*apart)
        self.wait(f"view.distance < {0.6 * distance}")
        self.assertAlmostEqual(self.value("view.distance"), distance / 2, 6)
        self.assertEqual(self.value("view.turn"), turn)
        self.browser.fingers([(x, y)], [(x + 50, y)])
        self.wait(f"view.turn < {turn}")

    def test_a_double_click_centres_what_is_there(self):
        self.open("#scene=scenes/cornell.json&size=100x100&grid=1&pixel=50,50")
        self.value("view.lookFrom(view.camera, view.lookAt)")
        x, y = (round(middle) + 30 for middle in self.middle_of("space"))
        ahead = self.value(f"(b => view.pick({x} - b.left, {y} - b.top))($('space').getBoundingClientRect())")
        self.browser.double_click(x, y)
        self.assertLess(self.value(f"vec.length(vec.sub(view.target, {ahead})) / view.size"), 1e-9)

    def test_view_looks_along_the_ray(self):
        self.open("#scene=scenes/cornell.json&size=100x100&grid=1&pixel=50,70")
        self.browser.key("l")
        apart = self.value(
            "vec.length(vec.sub(view.eye(), linesOfPixel()[0].from)) / view.size"
        )
        self.assertLess(apart, 1e-5)

    def test_tested_faces_are_shown_with_their_verdicts(self):
        self.open("#scene=scenes/cornell.json&size=100x100&grid=1&pixel=50,70&step=2")
        before = self.drawn()
        self.value("$('tested').click()")
        self.assertNotEqual(self.drawn(), before)
        counts = [int(n) for n in re.findall(r"\d+", self.value("$('tested-key').textContent"))]
        self.assertEqual(sum(counts), self.value("page.tracer.value('faces')"))

    def test_nodes_of_a_tree_are_shown_as_the_walkthrough_counts_them(self):
        pixel = ["--size", "320x180", "--grid", "1", "--pixel", "225,95", "--accel", "bvh"]
        self.open("#scene=scenes/gallery.json&size=320x180&grid=1&pixel=225,95&step=2")
        before = self.drawn()
        self.value("$('tree').value = 'bvh', $('tree').dispatchEvent(new Event('change'))")
        self.assertNotEqual(self.drawn(), before)
        counts = [int(n) for n in re.findall(r"\d+", self.value("$('nodes-key').textContent"))]
        told, _ = rectray("trace", "scenes/gallery.json", *pixel, "--format", "json")
        events = json.loads(told)["events"]
        ends = next(k for k, event in enumerate(events) if event["event"] == "hit")
        nodes = [event for event in events[:ends] if event["event"] == "node"]
        self.assertEqual(sum(counts), len(nodes))
        # Each in its turn, in the words of the walkthrough.
        verbose, _ = rectray("trace", "scenes/gallery.json", *pixel, "--verbose")
        said = " ".join(verbose.decode().split())
        words = self.value("nodesOfStep().map(node => node.words)")
        self.assertEqual(len(words), len(nodes))
        for node, told in zip(nodes, words):
            self.assertTrue(told.startswith(f"node {node['node']}: "), told)
            self.assertIn(told, said)
        shown = set()
        for k in (0, 1, 2):
            self.browser.key("n")
            self.assertEqual(self.value("$('node-number').textContent"), f"{k + 1} of {len(nodes)} nodes")
            self.assertEqual(self.value("$('node-words').textContent"), words[k])
            shown.add(self.drawn())
        self.assertGreater(len(shown), 1)
        for _ in range(4):  # past the first one all are shown, then the last one
            self.browser.key("n", shift=True)
        self.assertEqual(self.value("$('node-number').textContent"), f"{len(nodes)} of {len(nodes)} nodes")
        self.browser.key("n")
        self.assertEqual(self.value("$('node-number').textContent"), f"all {len(nodes)} nodes")
        self.value("$('tree').value = 'none', $('tree').dispatchEvent(new Event('change'))")
        self.assertEqual(self.drawn(), before)

    def test_a_search_in_a_tree_is_told_as_the_program_tells_it(self):
        self.open("#scene=scenes/gallery.json&size=320x180&grid=1&pixel=225,95&tree=kdtree")
        self.assertEqual(self.value("$('tree').value"), "kdtree")
        self.assertIn("tree nodes", self.value("$('steps').textContent"))
        for tree in self.value("[...$('tree').options].map(option => option.value)"):
            with self.subTest(tree):
                words = "trace scenes/gallery.json --size 320x180 --grid 1 --pixel 225,95 --accel".split()
                self.value(f"setTree('{tree}')")
                self.assertEqual(self.value("page.tracer.trace(225, 95)"), rectray(*words, tree)[0].decode())

    def test_labels_do_not_overlap(self):
        self.open("#scene=scenes/cornell.json&size=100x100&grid=1&pixel=50,70")
        self.assertEqual(
            self.value(
                """(() => { const boxes = [...document.querySelectorAll('.label')].map(l => l.getBoundingClientRect());
            return boxes.filter((a, i) => boxes.some((b, j) => j > i && a.left < b.right && b.left < a.right &&
                                                     a.top < b.bottom &&
                                                     b.top < a.bottom)).length; })()"""
            ),
            0,
        )
        self.assertGreater(self.value("document.querySelectorAll('.label').length"), 4)

    def test_without_webgl2_the_programs_drawing_stands_in(self):
        script = self.browser.call(
            "Page.addScriptToEvaluateOnNewDocument",
            source="""
            const get = HTMLCanvasElement.prototype.getContext;
            HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
                return kind === 'webgl2' ? null : get.call(this, kind, ...more); };""",
        )
        try:
            self.open(GALLERY + "&pixel=225,95")
        finally:
            self.browser.call("Page.removeScriptToEvaluateOnNewDocument", identifier=script["identifier"])
        self.wait("$('plans').querySelector('img').naturalWidth > 500")
        self.assertIn("WebGL2", self.value("$('space-note').textContent"))

    # --- The scene file ---

    def type_scene(self, old, new):
        self.value(
            f"""(() => {{ $('source').value = $('source').value.replace({json.dumps(old)}, {json.dumps(new)});
            $('source').dispatchEvent(new Event('input')); }})()"""
        )

    def test_a_mistake_is_told_while_one_types(self):
        self.open("#scene=scenes/original.json&size=40x30&grid=1&pixel=20,18")
        before = self.pixels()
        self.type_scene('"purple", "sided"', '"purpel", "sided"')
        self.wait("!$('message').hidden")
        with tempfile.TemporaryDirectory() as folder:
            os.mkdir(os.path.join(folder, "scenes"))
            with open(os.path.join(folder, "scenes/original.json"), "wb") as file:
                file.write(read("scenes/original.json").replace(b'"purple", "sided"', b'"purpel", "sided"'))
            want = subprocess.run(
                [PROGRAM, "check", "scenes/original.json"], cwd=folder, capture_output=True
            ).stderr.decode()
        self.assertEqual(self.value("$('message').textContent").split("\n"), want.rstrip("\n").split("\n"))
        self.assertTrue(self.pixels() == before)
        self.type_scene('"purpel"', '"purple"')
        self.wait("$('message').hidden")
        self.assertEqual(self.value("String(page.pixel)"), "20,18")

    def test_an_edit_renders_at_once(self):
        self.open("#scene=scenes/original.json&size=40x30&grid=1&pixel=20,18")
        before, job = self.pixels(), self.value("pool.job")
        self.type_scene('"diffuse": [2.1, 0, 2.1]', '"diffuse": [0, 2.1, 0]')
        self.wait(f"pool.job > {job}")
        self.wait(SETTLED)
        self.assertFalse(self.pixels() == before)

    def dropped(self, *paths):
        self.browser.drop(paths, 300, 200)
        self.wait("page.path.endsWith('obj.json')")
        self.wait(SETTLED)
        self.assertEqual(self.value("$('message').textContent"), "")
        size = self.value("`${page.columns}x${page.rows}`")
        self.assertTrue(self.pixels() == rendered("tests/scenes/obj.json", "--size", size, "--grid", "1"))

    def test_own_scenes_and_models_are_dropped(self):
        self.open(GALLERY)
        self.dropped("tests/scenes/obj.json", *glob.glob("tests/scenes/models/*"))

    def test_a_folder_is_dropped(self):
        self.open(GALLERY)
        with tempfile.TemporaryDirectory() as folder:
            os.makedirs(os.path.join(folder, "own/models"))
            for path in ["tests/scenes/obj.json", *glob.glob("tests/scenes/models/*")]:
                shutil.copy(path, os.path.join(folder, "own", os.path.relpath(path, "tests/scenes")))
            self.dropped(os.path.join(folder, "own"))
        self.assertEqual(self.value("page.path"), "own/obj.json")
        self.assertIn("Its models are not in it", self.value("$('link-note').textContent"))

    # --- An edited scene in the address ---

    def test_the_address_holds_an_edited_scene(self):
        self.open("#scene=scenes/original.json&size=40x30&grid=1&pixel=20,18")
        self.assertNotIn("text=", self.address())
        before = self.pixels()
        self.type_scene('"diffuse": [2.1, 0, 2.1]', '"diffuse": [0, 2.1, 0]')
        self.wait("location.hash.includes('text=gzip.')")
        self.wait(SETTLED)
        edited, link = self.pixels(), self.address()
        self.assertIn("The address holds this edited scene", self.value("$('link-note').textContent"))
        self.open(link)
        self.wait("location.hash.includes('text=')")
        self.assertTrue(self.pixels() == edited)
        self.assertIn('"diffuse": [0, 2.1, 0]', self.value("$('source').value"))
        self.value("$('restore').click()")
        self.wait("!location.hash.includes('text=')")
        self.wait(SETTLED)
        self.assertTrue(self.pixels() == before)
        self.assertTrue(self.value("$('link-note').hidden && $('restore').hidden"))

    def test_an_address_that_was_cut_says_so(self):
        self.open("#scene=scenes/original.json&size=40x30&grid=1&text=gzip.H4sIAAAA")
        self.assertIn("a part of it is missing", self.value("$('message').textContent"))
        self.assertTrue(self.pixels() == rendered("scenes/original.json", "--size", "40x30", "--grid", "1"))

    def test_a_scene_too_large_for_the_address_is_refused_with_the_limit(self):
        self.open("#scene=scenes/original.json&size=40x30&grid=1&pixel=20,18")
        chance = random.Random(3)
        noise = "".join(chance.choice("abcdefghijklmnopqrstuvwxyz0123456789") for _ in range(60000))
        scene = {**json.loads(read("scenes/original.json")), "//": noise}
        self.value(f"$('source').value = {json.dumps(json.dumps(scene))}, edited()")
        self.wait("!$('link-note').hidden")
        self.assertIn("32.0 KB are the limit", self.value("$('link-note').textContent"))
        self.assertNotIn("text=", self.address())

    # --- Forms ---

    def test_narrow_windows_show_picture_answer_and_steps_below_each_other(self):
        # A phone, and a laptop at 200 %.
        for width, height in ((390, 844), (683, 384)):
            self.browser.resize(width, height)
            self.open(GALLERY + "&pixel=225,95&arithmetic=float")
            tops = self.value("['picture', 'answer', 'steps'].map(id => $(id).getBoundingClientRect().top)")
            self.assertEqual(tops, sorted(tops))
            self.assertLessEqual(self.value("document.documentElement.scrollWidth"), width)

    def test_no_text_is_smaller_than_12_pixels(self):
        for width, height in ((1366, 768), (390, 844)):
            self.browser.resize(width, height)
            self.open(GALLERY + "&pixel=225,95&step=2")
            small = self.value(
                """[...document.querySelectorAll('body *')].filter(e => e.getClientRects().length &&
                [...e.childNodes].some(n => n.nodeType === 3 && n.data.trim()) &&
                parseFloat(getComputedStyle(e).fontSize) < 12)
                .map(e => e.outerHTML.slice(0, 80))"""
            )
            self.assertEqual(small, [])

    def test_controls_have_names(self):
        self.open(GALLERY)
        nameless = self.value(
            """[...document.querySelectorAll('button, input, select, textarea, canvas[tabindex]')].filter(e =>
            !(e.labels && e.labels.length) && !e.getAttribute('aria-label') && !e.textContent.trim())
            .map(e => e.outerHTML.slice(0, 80))"""
        )
        self.assertEqual(nameless, [])

    def test_hand_out_has_two_pages(self):
        for scene, pixel, act in (
            ("gallery", "225,95", ""),
            ("mirrors", "270,90", "$('open-all').click()"),
            ("cornell", "100,100", "$('verbose').click(), $('open-all').click()"),
            ("lessons/acne", "120,140", "setArithmetic('float')"),
        ):
            self.open(f"#scene=scenes/{scene}.json&size=320x180&grid=1&pixel={pixel}")
            self.value(act or "0")
            self.wait(SETTLED)
            self.assertEqual(len(re.findall(rb"/Type\s*/Page\b", self.browser.print())), 2, scene)
            self.value("layOut()")
            sheets = self.value(
                """(document.documentElement.classList.add('measuring'),
                [...document.querySelectorAll('.sheet')].map(s => [s.scrollHeight - s.clientHeight, s.textContent]))"""
            )
            self.value("document.documentElement.classList.remove('measuring')")
            self.assertEqual([over for over, _ in sheets], [0, 0], scene)
            text = "\n".join(words for _, words in sheets)
            printed = {int(n) for n in re.findall(r"Step (\d+)\.", text)}
            left = re.search(r"Left out: steps? ([\d, to]+)\.", text)
            for first, last in re.findall(r"(\d+)(?: to (\d+))?", left.group(1) if left else ""):
                printed |= set(range(int(first), int(last or first) + 1))
            self.assertEqual(printed, set(range(1, self.value("page.walk.steps.length") + 1)), scene)
            self.assertIn(f"--pixel {pixel}", text)

    def test_a_path_of_very_many_hits_is_printed_on_two_pages(self):
        self.open("#scene=scenes/mirrors.json&size=40x30&grid=1&pixel=20,15")
        self.value("page.walk.hits = Array(60).fill(page.walk.hits[0]), showAnswer(), layOut()")
        sheet = self.value(
            """(document.documentElement.classList.add('measuring'), (s => [s.scrollHeight - s.clientHeight,
            s.textContent])(document.querySelector('.sheet')))"""
        )
        self.value("document.documentElement.classList.remove('measuring')")
        self.assertEqual(sheet[0], 0)
        self.assertRegex(sheet[1], r"\d+ more are left out\.")

    # --- rectray explore ---

    def test_a_page_of_ones_own_scene_with_a_model(self):
        with tempfile.TemporaryDirectory() as folder:
            os.makedirs(os.path.join(folder, "work/models"))
            for path in ["tests/scenes/obj.json", *glob.glob("tests/scenes/models/*")]:
                with open(os.path.join(folder, "work", os.path.relpath(path, "tests/scenes")), "wb") as file:
                    file.write(read(path))
            for words in (
                ["work/obj.json"],
                ["../" + os.path.basename(folder) + "/work/obj.json"],
                [folder + "/work/obj.json"],
            ):
                done = subprocess.run(
                    [
                        PROGRAM,
                        "explore",
                        *words,
                        "-o",
                        "out.html",
                        "--size",
                        "64x48",
                        "--grid",
                        "2",
                        "--pixel",
                        "30,20",
                    ],
                    cwd=folder,
                    capture_output=True,
                )
                if b"built without the page" in done.stderr:
                    self.skipTest("this program was built without the page")
                self.assertEqual(done.returncode, 0, done.stderr)
                with self.subTest(words):
                    self.open(path=os.path.join(folder, "out.html"))
                    self.assertTrue(
                        self.pixels() == rendered("tests/scenes/obj.json", "--size", "64x48", "--grid", "2")
                    )
                    self.assertEqual(self.value("String(page.pixel)"), "30,20")
                    want = subprocess.run(
                        [PROGRAM, "trace", *words, "--size", "64x48", "--grid", "2", "--pixel", "30,20"],
                        cwd=folder,
                        capture_output=True,
                    ).stdout.decode()
                    self.assertEqual(self.value("page.tracer.trace(30, 20)"), want)


if __name__ == "__main__":
    if missing:
        print(
            f"SKIPPED: the page in a browser: {missing}; `make test-page` sets up what it needs",
            file=sys.stderr,
        )
    unittest.main()
