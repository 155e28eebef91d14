#!/usr/bin/env python3
"""Renders COUNT random scenes on both backends and compares (scenes.py makes them, compare.c judges): scene SEED, SEED + 1, ...
A scene that fails stays in FOLDER, as it was made and reduced to what the failure needs. The last line sums up:
"N passed, N failed".
Usage: run.py COMPARE FOLDER COUNT SEED    COMPARE: the program built from compare.c"""
import copy
import json
import os
import random
import subprocess
import sys

import scenes

LANES, ACCELS = [1, 4, 8, 16], ["none", "bvh", "kdtree"]


def good(verdict, generator):
    """In a scene snapped to a lattice whole rows of rays may run along an edge, and float rounds them to either side: there
    any number of pixels beside edges may be off. Where faces lie on one another, float may see the one or the other."""
    return verdict[0] == "equal" or (
        verdict[0] == "float" and (generator.tied or (generator.snapped and verdict[3] == "0")))


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
    """Copies of a JSON value, each without one element or member; the outermost first."""
    if isinstance(value, (dict, list)):
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
    """Takes away what can go while the verdict stays of its kind. Leaves the smallest
    scene in NAME.json, and returns its verdict."""
    scene, found = json.loads(text), True
    still = lambda smaller, parts: kind_of(comparer.verdict(name, json.dumps(smaller), parts, build)) == kind
    while found:
        found = False
        for smaller in cuts(scene):
            if still(smaller, files):
                scene, found = smaller, True
                break
        for file in [] if found else files:
            lines = files[file].splitlines()
            for i in range(len(lines)):
                fewer = files | {file: "\n".join(lines[:i] + lines[i + 1:])}
                if still(scene, fewer):
                    files, found = fewer, True
                    break
    return comparer.verdict(name, json.dumps(scene, indent=1), files, build)


def explain(comparer, seed, name, build, verdict):
    path = os.path.join(comparer.folder, name + ".json")
    print(f"scene {seed} at {build[0]} lanes, --accel {build[1]}: {' '.join(verdict)}")
    print(f"    again: make random-scenes COUNT=1 SEED={seed}")
    if verdict[0] in ("double", "float"):
        column, row = verdict[1:3] if verdict[0] == "double" else verdict[4:6]
        precision = f"--precision {verdict[0]} --lanes {build[0]} --accel {build[1]}"
        print(f"    rectray render {path} {precision} -o opencl.png; rectray render {path} -b reference -o reference.png")
        print(f"    rectray trace {path} --pixel {column},{row}")


def try_scene(comparer, seed):
    """Returns whether the scene has exact coincidences, its pixels, and those off in float; None where it fails."""
    name = f"scene-{seed}"
    generator = scenes.Generator(seed, name)
    text, files = generator.scene(), generator.files
    rng = random.Random(-1 - seed)
    build = rng.choice(LANES), rng.choice(ACCELS)
    verdict = comparer.verdict(name, text, files, build)
    if good(verdict, generator):
        for file in [name + ".json", *files]:
            os.remove(os.path.join(comparer.folder, file))
        return generator.snapped or generator.tied, int(verdict[1]), int(verdict[2])
    explain(comparer, seed, name, build, verdict)
    if verdict[0] != "failed":
        reduced = f"scene-{seed}-reduced"
        files = {file.replace(name, reduced): content.replace(name, reduced) for file, content in files.items()}
        verdict = reduce(comparer, reduced, text.replace(name, reduced), files, build, kind_of(verdict))
        print("  reduced:")
        explain(comparer, seed, reduced, build, verdict)
    return None


def main(program, folder, count, seed):
    os.makedirs(folder, exist_ok=True)
    comparer = Comparer(program, folder)
    passed, pixels, off = 0, [0, 0], [0, 0]
    for i in range(seed, seed + count):
        result = try_scene(comparer, i)
        if result:
            exact = result[0]
            passed += 1
            pixels[exact] += result[1]
            off[exact] += result[2]
    print(f"{count} scenes, {sum(pixels)} pixels, equal in double. Off by more than 1/255 in float: {off[0]} of {pixels[0]} "
          f"pixels, and beside edges and on faces that rays meet exactly {off[1]} of {pixels[1]}")
    print(f"{passed} passed, {count - passed} failed")
    return passed < count


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])))
