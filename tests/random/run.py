#!/usr/bin/env python3
"""Renders COUNT random scenes on both backends and compares (scenes.py makes them, compare.c judges). Their seeds are
SEED, SEED + 1, ... A scene that fails stays in FOLDER, as it was made and reduced to what the failure needs.
The last line sums up: "N passed, N failed".
Usage: run.py COMPARE FOLDER COUNT SEED [KERNEL]    COMPARE: the program built from compare.c
KERNEL: plain or gpu, for that kernel alone"""
import copy
import itertools
import json
import os
import random
import subprocess
import sys

import scenes

# What the kernels can be built for: each takes seconds to compile, once.
BUILDS = [(lanes, accel) for lanes in (1, 4, 8, 16) for accel in ("none", "bvh")] + [(8, "kdtree"), (16, "kdtree")]
PLAIN_BUILDS = [("plain", accel) for accel in ("none", "bvh", "kdtree")]
GPU_BUILDS = [("gpu", accel) for accel in ("none", "bvh", "kdtree")]
ADAPTIVE_BUILDS = [(8, "bvh"), (16, "none")]


def good(verdict, generator):
    """In a scene snapped to a lattice whole rows of rays may run along an edge, and float rounds them to either side:
    there any number of pixels beside edges may be off. Where faces lie on one another, float may see the one or the
    other. Of extreme numbers a float keeps too few digits."""
    return verdict[0] == "equal" or (
        verdict[0] == "float" and (generator.tied or generator.extreme or (generator.snapped and verdict[3] == "0")))


def kind_of(verdict):
    return verdict[0], verdict[0] == "float" and verdict[3] != "0"


class Comparer:
    def __init__(self, program, folder):
        self.folder = folder
        self.process = subprocess.Popen([program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def put(self, name, text):
        with open(os.path.join(self.folder, name), "w", encoding="utf-8", newline="") as file:
            file.write(text)

    def verdict(self, name, text, files, build):
        """What compare.c says of a scene, in words."""
        for file, content in files.items():
            self.put(file, content)
        self.put(name + ".json", text)
        try:
            self.process.stdin.write(f"{os.path.join(self.folder, name)}.json {build[0]} {build[1]}\n")
            self.process.stdin.flush()
            answer = self.process.stdout.readline()
        except BrokenPipeError:
            answer = ""
        if not answer:
            sys.exit(f"{name}: the comparing program died with status {self.process.wait()}")
        return answer.split()


def cuts(value):
    """Copies of a JSON value, each without one element or member; the outermost first. Lists of numbers stay whole."""
    if isinstance(value, dict) or (isinstance(value, list) and not isinstance(next(iter(value), 0), (int, float))):
        keys = list(value) if isinstance(value, dict) else range(len(value) - 1, -1, -1)
        for key in keys:
            smaller = copy.copy(value)
            del smaller[key]
            yield smaller
        for key in keys:
            for inner in cuts(value[key]):
                smaller = copy.copy(value)
                smaller[key] = inner
                yield smaller


def reduce(comparer, name, text, files, build, kind):
    """Takes away what can go while the verdict stays of its kind. Leaves the smallest scene in NAME.json, and
    returns its verdict."""
    scene, found = json.loads(text), True
    still = lambda smaller, parts: kind_of(comparer.verdict(name, json.dumps(smaller), parts, build)) == kind
    while found:
        found, place = False, 0
        while smaller := next(itertools.islice(cuts(scene), place, None), None):
            if still(smaller, files):
                scene, found = smaller, True
            else:
                place += 1
        for file in files:
            line = 0
            while line < len(lines := files[file].splitlines()):
                fewer = files | {file: "\n".join(lines[:line] + lines[line + 1:])}
                if still(scene, fewer):
                    files, found = fewer, True
                else:
                    line += 1
    return comparer.verdict(name, json.dumps(scene, indent=1), files, build)


def explain(comparer, seed, name, build, verdict):
    path = os.path.join(comparer.folder, name + ".json")
    kernel = "--sampling uniform --kernel plain" if build[0] == "plain" else f"--lanes {build[0]}"
    print(f"scene {seed} with {kernel} --accel {build[1]}: {' '.join(verdict)}")
    print(f"    again: make random-scenes COUNT=1 SEED={seed}")
    if verdict[0] in ("double", "float", "tree", "whole"):
        column, row = verdict[4:6] if verdict[0] == "float" else verdict[1:3]
        how = {"tree": "-b reference", "whole": f"--no-skip whole_tile --lanes {build[0]}"}.get(
            verdict[0], f"--precision {verdict[0]} {kernel}")
        print(f"    rectray render {path} {how} --accel {build[1]} -o found.png")
        print(f"    rectray render {path} -b reference --accel none -o expected.png")
        print(f"    rectray trace {path} --pixel {column},{row}")


def try_scene(comparer, seed, kernel):
    """Returns whether float may be off in the scene, its pixels, and those off in float; None where it fails."""
    name = f"scene-{seed}"
    generator = scenes.Generator(seed, name)
    text, files = generator.scene(), generator.files
    builds = {"plain": PLAIN_BUILDS, "gpu": GPU_BUILDS}.get(
        kernel, ADAPTIVE_BUILDS if generator.adaptive else BUILDS + PLAIN_BUILDS)
    build = random.Random(-1 - seed).choice(builds)
    verdict = comparer.verdict(name, text, files, build)
    if good(verdict, generator):
        for file in [name + ".json", *files]:
            os.remove(os.path.join(comparer.folder, file))
        return generator.snapped or generator.tied or generator.extreme, int(verdict[1]), int(verdict[2])
    explain(comparer, seed, name, build, verdict)
    if verdict[0] != "failed":
        reduced = f"scene-{seed}-reduced"
        files = {file.replace(name, reduced): content.replace(name, reduced) for file, content in files.items()}
        verdict = reduce(comparer, reduced, text.replace(name, reduced), files, build, kind_of(verdict))
        print("  reduced:")
        explain(comparer, seed, reduced, build, verdict)
    return None


def main(program, folder, count, seed, kernel=None):
    os.makedirs(folder, exist_ok=True)
    comparer = Comparer(program, folder)
    passed, pixels, off = 0, [0, 0], [0, 0]
    for i in range(seed, seed + count):
        result = try_scene(comparer, i, kernel)
        if result:
            may = result[0]
            passed += 1
            pixels[may] += result[1]
            off[may] += result[2]
    print(f"{count} scenes, {sum(pixels)} pixels, equal in double and through trees. Off by more than 1/255 in float: "
          f"{off[0]} of {pixels[0]} pixels, and where it may be {off[1]} of {pixels[1]}")
    print(f"{passed} passed, {count - passed} failed")
    return passed < count


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4]), *sys.argv[5:]))
