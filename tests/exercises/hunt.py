#!/usr/bin/env python3
"""Bug hunts: plants one small fault in a copy of the tracer, and hands out what a hunter needs.

Usage: hunt.py plant SEED      copy, build, pictures and walkthroughs in build/hunt/SEED/
       hunt.py answer SEED     file, line, fault, and why it shows at that pixel
The hunts are in tests/exercises/hunts, their faults in tests/mutants/list. `make hunt SEED=3` calls this.
"""
import glob
import os
import shutil
import subprocess
import sys
import textwrap

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from mutants.run import read_list  # noqa: E402

TOP = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
MUTANTS = os.path.join(TOP, "tests", "mutants", "list")
COPIED = ["Makefile", "src", "kernels", "scenes", ".ci", "tests/scenes"]
BUILT = ["src", "kernel_sources.c", "kernel_sources.o", "page_template.c", "page_template.o", "rectray-parts.a",
         "rectray", ".libraries-found"]
STRIDE = 7  # seeds that follow each other shall not bring faults that do

README = """\
Bug hunt {seed}
{line}

Somebody changed one line of this tracer. Find it.

    right.png, right.txt      the picture, and the walkthrough of pixel ({column}, {row}), as they should be
    faulty.png, faulty.txt    the same by the changed tracer
    apart.png                 where the pictures differ, from black to white
    tracer/                   the changed tracer: read it, mend it, build it

{arithmetic}

1. Look at the pictures. Say in words what is wrong, and where: in shadows, on edges, in mirrors, everywhere?
2. Read both walkthroughs of the pixel side by side. Find the first number that differs. Which formula makes it,
   and from which numbers? All numbers before it are right, so the fault is in this formula.
3. Find the line that computes it. docs/algorithm.md has the formulas. The comments of tracer/src/ name its steps.
4. Mend the line, build, and look:

    make -C {folder}/tracer
    {folder}/tracer/build/rectray render {scene} -o {folder}/mended.png {render}
    build/rectray compare {folder}/mended.png {folder}/right.png

   Your own walkthrough of another pixel:

    {folder}/tracer/build/rectray trace {scene} {trace} --pixel {column},{row}

5. Say why the fault shows at this pixel, and name a pixel where it does not show, although the line runs there.

`make hunt-answer SEED={seed}` tells. A diff of tracer/ against the sources of the repository tells, too: it would be
no hunt.
"""
ARITHMETIC = {
    "exact": "The pictures are made by the reference tracer. The line is in src/trace/reference.c, src/scene/geometry.c\n"
             "or src/scene/light.c.",
    "textbook": "The pictures are made by textbook arithmetic. The line is in one of the files src/trace/textbook*. The\n"
                "walkthroughs put the exact numbers beside the textbook's: they are right in both."}


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def read_hunts(path=os.path.join(os.path.dirname(os.path.abspath(__file__)), "hunts")):
    """[{"hunt": name of the mutant, "scene", "options", "pixel": (column, row), "why"}]"""
    hunts = []
    for block in read(path).split("\n\n"):
        lines = [line for line in block.splitlines() if line and not line.startswith("#")]
        if not lines:
            continue
        hunt = {}
        for line in lines:
            word, _, rest = line.partition(" ")
            hunt[word] = f"{hunt[word]} {rest}" if word in hunt else rest
        hunt["scene"], _, hunt["options"] = hunt["scene"].partition(" ")
        hunt["pixel"] = tuple(map(int, hunt["pixel"].split(",")))
        hunts.append(hunt)
    return hunts


def hunt_of(seed):
    hunts = read_hunts()
    return hunts[(seed - 1) * STRIDE % len(hunts)]


def mutant_of(hunt):
    """(file, right piece of a line, faulty piece)"""
    for name, file, _, before, after in read_list(MUTANTS):
        if name == hunt["hunt"]:
            return file, before, after
    sys.exit(f"hunt: tests/mutants/list has no fault {hunt['hunt']}")


def arithmetic_of(hunt):
    return "textbook" if "textbook" in mutant_of(hunt)[0] else "exact"


def words_of(hunt):
    """The options of render and of trace beside the scene's."""
    own = hunt["options"].split()
    if arithmetic_of(hunt) == "textbook":
        own += ["--arithmetic", "textbook", "-p", "double"]
    return ["-b", "reference", *own], own


def copy_tracer(folder):
    shutil.rmtree(folder, ignore_errors=True)
    for name in COPIED + glob.glob("tests/**/*.mk", recursive=True):
        os.makedirs(os.path.dirname(f"{folder}/{name}"), exist_ok=True)
        subprocess.run(["cp", "-Rp", name, f"{folder}/{name}"], check=True)
    os.makedirs(f"{folder}/build")
    commits = [name for name in os.listdir("build") if name.startswith(".commit-")]
    for name in BUILT + commits:
        if os.path.exists(f"build/{name}"):
            subprocess.run(["cp", "-Rp", f"build/{name}", f"{folder}/build/{name}"], check=True)


def level_times(folder):
    """One time for all files: the changed one is not the newest, and nothing waits to be built."""
    now = os.stat(f"{folder}/Makefile").st_mtime_ns
    for place, _, names in os.walk(folder):
        for name in names:
            os.utime(os.path.join(place, name), ns=(now, now))


def plant(hunt, folder):
    """Puts the fault into the copy, and builds it."""
    file, before, after = mutant_of(hunt)
    copy_tracer(folder)
    path = f"{folder}/{file}"
    text = read(path)
    if text.count(before) != 1:
        sys.exit(f"hunt: {file} has changed: tests/mutants/list no longer fits it")
    with open(path, "w", encoding="utf-8") as out:
        out.write(text.replace(before, after))
    build = subprocess.run(["make", "-s", "-C", folder, "build/rectray", "WERROR=", "MAKEFLAGS="],
                           capture_output=True, text=True, check=False)
    if build.returncode != 0:
        sys.exit(f"hunt: the copy does not build:\n{build.stderr}")
    level_times(folder)


def make_picture(program, hunt, out):
    subprocess.run([program, "render", hunt["scene"], *words_of(hunt)[0], "-q", "-o", out], check=True)


def make_walkthrough(program, hunt, out):
    pixel = ",".join(map(str, hunt["pixel"]))
    subprocess.run([program, "trace", hunt["scene"], *words_of(hunt)[1], "--pixel", pixel, "-o", out], check=True)


def hand_out(seed):
    hunt, folder = hunt_of(seed), f"build/hunt/{seed}"
    plant(hunt, f"{folder}/tracer")
    for name, program in (("right", "build/rectray"), ("faulty", f"{folder}/tracer/build/rectray")):
        make_picture(program, hunt, f"{folder}/{name}.png")
        make_walkthrough(program, hunt, f"{folder}/{name}.txt")
    subprocess.run(["build/rectray", "compare", f"{folder}/right.png", f"{folder}/faulty.png", "-q", "--heatmap",
                    f"{folder}/apart.png"], check=False, capture_output=True)
    render, trace = map(" ".join, words_of(hunt))
    column, row = hunt["pixel"]
    text = README.format(seed=seed, line="=" * len(f"Bug hunt {seed}"), column=column, row=row, folder=folder,
                         scene=hunt["scene"], render=render, trace=trace, arithmetic=ARITHMETIC[arithmetic_of(hunt)])
    with open(f"{folder}/README.txt", "w", encoding="utf-8") as out:
        out.write(text)
    print(text)
    print(f"All of it is in {folder}/, this text in {folder}/README.txt")


def answer(seed):
    hunt = hunt_of(seed)
    file, before, after = mutant_of(hunt)
    text = read(file)
    line = text[:text.index(before)].count("\n") + 1
    start = text.rindex("\n", 0, text.index(before)) + 1
    whole = text[start:text.index("\n", text.index(before))].strip()
    print(f"Bug hunt {seed}: {file}, line {line}\n")
    print(f"    right     {whole}\n    faulty    {whole.replace(before, after)}\n")
    print(f"The formula: {hunt['formula']}\n")
    print(textwrap.fill(hunt["why"], 100))
    print(f"\nThe fault is called {hunt['hunt']} in tests/mutants/list.")


def main():
    if len(sys.argv) != 3 or sys.argv[1] not in ("plant", "answer") or not sys.argv[2].isdigit() \
            or int(sys.argv[2]) < 1:
        sys.exit("usage: make hunt SEED=N, or make hunt-answer SEED=N, with N = 1, 2, 3 ...")
    os.chdir(TOP)
    (hand_out if sys.argv[1] == "plant" else answer)(int(sys.argv[2]))


if __name__ == "__main__":
    main()
