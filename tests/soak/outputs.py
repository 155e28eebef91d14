#!/usr/bin/env python3
"""Proves that a change of the source changes no byte of what the program says or draws.

    tests/soak/outputs.py PROGRAM [-o MANIFEST] [--quick]
    tests/soak/outputs.py --compare OLD NEW [--quick]

The first form runs PROGRAM over the scenes of the working directory and writes a manifest. A line of it is a run:
`sha256-of-all-outputs exit-status command-line`. The outputs are standard output, standard error and every file that
the run wrote. OLD and NEW are manifests or programs, in any mixture. The runs that differ are printed, and the exit
status is 1 if there are any. Start it in the same folder for both, so that both see the same scenes, and on the same
machine: what lanes suit the device and what `devices` says depends on it.

In the command lines OUT is the folder that the run writes to. IN holds what the runs read: scenes that the program
generated, pictures that it rendered, and lists of rays.

What may be different each time is made equal first: times, memory, the device's name and the build options. Counters
are compared. They do not depend on how many threads there are or which comes first: each is a sum of integers.
Pictures are compared as they were before compression: ISA-L compresses the same rows to other bytes in about one small
picture of a hundred, for what it finds depends on the addresses of its buffers.
`bench`, `--map time` and `--progress` measure time, so only their errors are compared."""
import argparse
import glob
import hashlib
import json
import os
import random
import re
import shlex
import signal
import subprocess
import sys
import tempfile
import time
import zlib
from itertools import product

SIZE = "64x48"
TIMEOUT = 300
ACCELS = ("none", "bvh", "kdtree")
SAMPLINGS = ("uniform", "adaptive:4")
SKIPS = ("light_behind", "light_ambient", "highlight", "weak_bounce", "empty_tile", "whole_tile", "back_face",
         "light_black", "idle_face", "mirrors", "tree")
QUICK_SCENES = ("cornell", "gallery", "mirrors", "original", "background", "doll_house", "facing_mirrors", "grid",
                "many_lights", "obj", "one_sided", "shadow_ambient", "shadow_black", "transforms", "refined")
GENERATED = (("city", 300), ("menger", 2), ("grid", 20))
COMMANDS = ("render", "trace", "cast", "check", "compare", "bench", "generate", "devices")
A_SCENE = "scenes/original.json"

# Command lines that are wrong, and scenes that are not there.
WRONG = (
    "", "paint", "rend", "render", "render a.json b.json", "check", "trace", "cast", "compare a.png", "generate",
    "devices 1", "--wrong", "-x", "render --wrong", "render -x", "--vers", "check missing.json", "render missing.json",
    "check .", "check --size 3x3 " + A_SCENE, "check --geometry=1 " + A_SCENE, "check -q missing.json",
    "render -o OUT/a.png --size 0x4 " + A_SCENE, "render -o OUT/a.png --size 4 " + A_SCENE,
    "render -o OUT/a.png --size 16385x4 " + A_SCENE, "render -o OUT/a.png --s 4x4 " + A_SCENE,
    "render -o OUT/a.png --grid 17 " + A_SCENE, "render -o OUT/a.png --grid two " + A_SCENE,
    "render -o OUT/a.png --sampling adaptive:99 " + A_SCENE, "render -o OUT/a.png --sampling fine " + A_SCENE,
    "render -o OUT/a.png --bounces 65 " + A_SCENE, "render -o OUT/a.png --bounces -1 " + A_SCENE,
    "render -o OUT/a.png --backend cuda " + A_SCENE, "render -o OUT/a.png --precision half " + A_SCENE,
    "render -o OUT/a.png --accel octree " + A_SCENE, "render -o OUT/a.png --lanes 2 " + A_SCENE,
    "render -o OUT/a.png --device 99 " + A_SCENE, "render -o OUT/a.png --no-skip tree,tea " + A_SCENE,
    "render -o OUT/a.png --threads 0 " + A_SCENE, "render -o OUT/a.png --stats=xml " + A_SCENE,
    "render -o OUT/a.png --progress often " + A_SCENE, "render -o OUT/a.png --map " + A_SCENE,
    "render -o OUT/a.png --map heat OUT/b.png " + A_SCENE, "render -o OUT/a.png --map time OUT/b.png " + A_SCENE,
    "render -o OUT/a.png --map rays OUT/a.png " + A_SCENE, "render -o OUT/missing/a.png --size 4x3 " + A_SCENE,
    "render -o OUT --size 4x3 " + A_SCENE, "render " + A_SCENE + " --output", "render " + A_SCENE + " -o",
    "render -o OUT/a.png --quiet=1 " + A_SCENE, "render -o OUT/a.png --size 4x3 -- " + A_SCENE + " -q",
    "render -b reference --lanes 4 --device 0 --precision float --no-skip all --size 4x3 -o OUT/a.png " + A_SCENE,
    "trace " + A_SCENE, "trace --pixel 3 " + A_SCENE, "trace --pixel 999,0 " + A_SCENE,
    "trace --pixel 3,4 --sample 1,1 " + A_SCENE, "trace --pixel 3,4 --format xml " + A_SCENE,
    "trace --pixel 3,4 --with-scene " + A_SCENE, "trace --pixel 3,4 --format svg --verbose " + A_SCENE,
    "trace --pixel 3,4 -o OUT/missing/a.txt " + A_SCENE, "cast --rays missing.txt " + A_SCENE,
    "cast --rays " + A_SCENE + " " + A_SCENE, "cast --rays . " + A_SCENE, "compare missing.png missing.png",
    "compare " + A_SCENE + " " + A_SCENE, "compare IN/a.png IN/b.png --tolerance 256", "compare IN/a.png IN/small.png",
    "compare IN/a.png missing.png", "compare IN/a.png IN/b.png -o OUT/missing/a.png", "generate cube --size 3",
    "generate mengor --size 1", "generate menger", "generate menger --size 9", "generate grid --size 0",
    "generate city --size 3 --seed -1", "generate grid --size 2 -o OUT/missing/a.json", "bench",
    "bench --json error " + A_SCENE, "bench --repeats 0 " + A_SCENE, "bench missing.json", "bench error",
)


def variants(quick):
    """Kernels to render with, as (precision, lanes, accel): each is compiled once, for its scenes follow each other."""
    if quick:
        return [(*kind, accel) for kind in (("float", 16), ("double", 8)) for accel in ("bvh", "none")]
    return [(*kind, accel) for kind in product(("float", "double"), (1, 4, 8, 16)) for accel in ACCELS]


def scenes_here(quick):
    """Every scene that is right, and generated ones, whose trees are deeper."""
    scenes = sorted(glob.glob("scenes/*.json")) + sorted(glob.glob("tests/scenes/*.json"))
    scenes += sorted(glob.glob("tests/scenes/walkthrough/*.json"))
    if not scenes:
        sys.exit("outputs.py: no scenes here; start it in the folder that has scenes/ and tests/scenes/")
    generated = [f"IN/{kind}.json" for kind, _ in GENERATED]
    if quick:
        return [scene for scene in scenes if os.path.basename(scene)[:-len(".json")] in QUICK_SCENES] + generated[:1]
    return scenes + generated


def render(scene, *words):
    """A scene of tests/scenes keeps its own size, which is small and often no multiple of a tile."""
    size = () if scene.startswith("tests/") else ("--size", SIZE)
    return ["render", scene, *size, *words, "-o", "OUT/a.png"]


def kernel(precision, lanes, accel):
    return ["--precision", precision, "--lanes", str(lanes), "--accel", accel]


def render_runs(scenes, quick):
    for precision, lanes, accel in variants(quick):
        for sampling in SAMPLINGS:
            for scene in scenes:
                yield render(scene, *kernel(precision, lanes, accel), "--sampling", sampling)
    for scene in scenes:
        for sampling in SAMPLINGS:
            yield render(scene, "--backend", "reference", "--sampling", sampling)
        yield render(scene)
        yield render(scene, "--sampling", "uniform:3", "--bounces", "2")
        yield render(scene, "--precision", "double", "--bounces", "0", "--quiet")
        for accel in () if quick else ACCELS:
            yield render(scene, "--backend", "reference", "--accel", accel)


def skip_runs(scenes, quick):
    for scene in scenes:
        for name in ("all",) if quick else SKIPS + ("all", "tree,mirrors"):
            yield render(scene, "--no-skip", name)
        yield render(scene, "--no-skip", "all", "--stats=json")


def stats_runs(scenes, quick):
    kernels = [("float", 16, accel) for accel in (("bvh", "none") if quick else ACCELS)]
    for words in kernels + [("double", 8, "bvh")]:
        for sampling in SAMPLINGS:
            for scene in scenes:
                yield render(scene, *kernel(*words), "--sampling", sampling, "--stats=json")
    for scene in scenes:
        yield render(scene, "--stats")
        yield render(scene, "--threads", "1", "--stats=json")
        yield render(scene, "--backend", "reference", "--stats=json")
        yield render(scene, "--backend", "reference", "--sampling", "adaptive:4", "--stats")
    yield ["render", A_SCENE, "--stats=json", "-o", "-"]


def map_runs(scenes, quick):
    for scene in scenes:
        for kind in ("rays", "depth", "normal", "face"):
            yield render(scene, "--map", kind, "OUT/map.png", "--backend", "reference")
        yield render(scene, "--map", "rays", "OUT/map.png", "--sampling", "adaptive:4")
        if not quick:
            yield render(scene, "--map", "rays", "OUT/map.png", "--accel", "kdtree", "--backend", "reference")


def trace_runs(scenes, quick):
    forms = [(), ("--verbose",), ("--format", "json"), ("--format", "json", "--verbose"), ("--format", "obj"),
             ("--format", "obj", "--with-scene"), ("--format", "svg")]
    for scene in scenes:
        for pixel in ("32,24", "20,33", "47,30"):
            start = ["trace", scene, "--size", SIZE, "--pixel", pixel]
            for accel in ("none", "bvh") if quick else ACCELS:
                for form in forms:
                    yield start + ["--sampling", "uniform:1", "--accel", accel, *form]
            yield start
            yield start + ["--sampling", "adaptive:4"]
            yield start + ["--sampling", "adaptive:4", "--format", "json"]
            yield start + ["--grid", "3", "--sample", "1,2", "--bounces", "1", "-o", "OUT/a.txt"]


def cast_runs(scenes, quick):
    kernels = [("float", 16, "bvh"), ("double", 8, "none")]
    if not quick:
        kinds = (("float", 16), ("float", 4), ("double", 8), ("double", 1))
        kernels = [(*kind, accel) for kind in kinds for accel in ACCELS]
    for words in kernels:
        for scene in scenes:
            yield ["cast", scene, *kernel(*words), "--rays", rays_of(scene)]
    for scene in scenes:
        for accel in ACCELS:
            yield ["cast", scene, "--backend", "reference", "--accel", accel, "--rays", rays_of(scene)]
        yield ["cast", scene, "--rays", rays_of(scene), "--stats=json"]


def check_runs(scenes, quick):
    for scene in scenes:
        yield ["check", scene]
        yield ["check", scene, "--geometry"]
    yield ["check", A_SCENE, "--quiet"]
    for scene in sorted(glob.glob("tests/scenes/bad/*")):
        yield ["check", scene]
        if not quick:
            yield render(scene, "--backend", "reference")
            yield ["trace", scene, "--pixel", "0,0"]
            yield ["cast", scene, "--backend", "reference"]


def other_runs(scenes, quick):
    for words in (["--help"], ["--version"], ["devices"], ["-h"], ["-V"]):
        yield words
    for command in COMMANDS:
        yield [command, "--help"]
        yield [command, "--version"]
    for words in WRONG:
        yield words.split()
    for kind, size in (("menger", 1), ("menger", 2), ("city", 10), ("city", 100), ("grid", 1), ("grid", 20)):
        yield ["generate", kind, "--size", str(size)]
        yield ["generate", kind, "--size", str(size), "--seed", "7", "-o", "OUT/a.json"]
    for pair in (["IN/a.png", "IN/b.png"], ["IN/b.png", "IN/a.png"], ["IN/a.png", "IN/a.png"]):
        for words in ([], ["--quiet"], ["--tolerance", "30"], ["--tolerance", "255"], ["-o", "-"], ["--heatmap", "-"],
                      ["-o", "OUT/a.png", "--heatmap", "OUT/b.png"]):
            yield ["compare", *pair, *words]


GROUPS = (other_runs, check_runs, trace_runs, map_runs, cast_runs, render_runs, stats_runs, skip_runs)


def rays_of(scene):
    return "IN/" + scene.replace("/", "-").replace("IN-", "") + ".rays"


def make_rays(scene_file, name):
    """Rays from about the camera to about the point it looks at, and from there in all directions.
    They are the same every time."""
    with open(scene_file, encoding="utf-8") as file:
        camera = json.load(file)["camera"]
    eye, aim = camera["position"], camera["look_at"]
    reach = sum((a - b) ** 2 for a, b in zip(eye, aim)) ** 0.5
    chance = random.Random(name)
    lines = []
    for number in range(200):
        start, spread = (eye, 0.5) if number % 2 == 0 else (aim, 3)
        origin = [a + chance.uniform(-0.2, 0.2) * reach for a in start]
        direction = [a + chance.uniform(-spread, spread) * reach - b for a, b in zip(aim, origin)]
        lines.append(" ".join(f"{value:.9g}" for value in origin + direction))
    return "\n".join(lines) + "\n"


class Runner:
    """Runs one program. Its folders have the same names for each program, and so have the command lines."""

    def __init__(self, program, holder):
        self.program = os.path.abspath(program)
        if not os.access(self.program, os.X_OK):
            sys.exit(f"outputs.py: {program} is no program")
        self.folders = {"IN": os.path.join(holder, "in"), "OUT": os.path.join(holder, "out")}
        for folder in self.folders.values():
            os.mkdir(folder)
        self.environment = {name: value for name, value in os.environ.items()
                            if name not in ("RECTRAY_KERNELS", "LANGUAGE", "NO_COLOR")}
        self.environment["LC_ALL"] = "C"

    def real(self, word):
        """The word with the folder that it names."""
        for name, folder in self.folders.items():
            if word == name or word.startswith(name + "/"):
                return folder + word[len(name):]
        return word

    def start(self, words):
        try:
            return subprocess.run([self.program, *map(self.real, words)], env=self.environment, timeout=TIMEOUT,
                                  stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        except subprocess.TimeoutExpired:
            return None

    def prepare(self, scenes):
        """Writes what the runs read. A program that fails here leaves a file out, and the runs that miss it differ."""
        for kind, size in GENERATED:
            self.start(["generate", kind, "--size", str(size), "-o", f"IN/{kind}.json"])
        for words in (["render", A_SCENE, "--backend", "reference", "--size", SIZE, "-o", "IN/a.png"],
                      ["render", A_SCENE, "--backend", "reference", "--size", SIZE, "--bounces", "0", "-o", "IN/b.png"],
                      ["render", A_SCENE, "--backend", "reference", "--size", "8x6", "-o", "IN/small.png"]):
            self.start(words)
        for scene in scenes:
            with open(self.real(rays_of(scene)), "w", encoding="ascii") as file:
                if os.path.exists(self.real(scene)):
                    file.write(make_rays(self.real(scene), scene))

    def plain(self, data):
        """An output without what differs from run to run and from place to place."""
        if data.startswith(b"\x89PNG"):
            return plain_picture(data)
        data = data.replace(self.program.encode(), b"PROGRAM")
        for name, folder in self.folders.items():
            data = data.replace(folder.encode(), name.encode())
        data = re.sub(rb"\bin \d+(\.\d+)? (s|ms)\b", b"in T s", data)
        data = re.sub(rb"(?m)^.*compiling the kernels for .*, once\n", b"", data)
        data = re.sub(rb"(?m)^[a-z ]+  \d+\.\d+ (?=(ms|MiB)$)", lambda match: plain_number(match[0]), data)
        data = re.sub(rb"(?m)^(device|build options) {2,}.*$", rb"\1", data)
        data = re.sub(rb"(?m)^( +memory +)\d.* GiB$", rb"\1N GiB", data)
        return re.sub(rb'(?m)^\{"phases_ms":.*$', lambda match: plain_stats(match[0]), data)

    def run(self, words):
        """The hash of all outputs, and the exit status; what was written is removed."""
        done = self.start(words)
        outputs = [b"", b""] if done is None else [done.stdout, done.stderr]
        for name in sorted(os.listdir(self.folders["OUT"])):
            path = os.path.join(self.folders["OUT"], name)
            with open(path, "rb") as file:
                outputs += [name.encode(), file.read()]
            os.remove(path)
        total = hashlib.sha256()
        for output in map(self.plain, outputs):
            total.update(b"%d\n" % len(output) + output)
        return total.hexdigest(), "timeout" if done is None else done.returncode


def plain_picture(data):
    """A PNG with its pixels as they were before compression: every other byte of it stays."""
    try:
        kept, pixels, at = data[:8], zlib.decompressobj(), 8
        while at < len(data):
            size = int.from_bytes(data[at:at + 4], "big") + 12
            is_pixels = data[at + 4:at + 8] == b"IDAT"
            kept += pixels.decompress(data[at + 8:at + size - 4]) if is_pixels else data[at:at + size]
            at += size
        return kept if pixels.eof and not pixels.unused_data else data
    except zlib.error:
        return data


def plain_number(text):
    """A number of a table becomes N, at the end of its column."""
    name = text.split(b"  ")[0]
    return name + b"N ".rjust(len(text) - len(name))


def plain_stats(line):
    """The keys stay, in their order."""
    stats = json.loads(line)
    stats["phases_ms"] = list(stats["phases_ms"])
    for key in ("device", "build_options", "device_memory_bytes", "peak_memory_bytes"):
        if key in stats:
            stats[key] = None
    return json.dumps(stats).encode()


def manifest_of(program, quick):
    """The lines of the manifest, as {command line: hash and exit status}."""
    manifest = {}
    with tempfile.TemporaryDirectory(prefix="rectray-") as holder:
        scenes = scenes_here(quick)
        runner = Runner(program, holder)
        runner.prepare(scenes)
        for group in GROUPS:
            start, before = time.monotonic(), len(manifest)
            for words in group(scenes, quick):
                line = shlex.join(words)
                if line not in manifest:
                    manifest[line] = "%s %s" % runner.run(words)
            print(f"{group.__name__:12} {len(manifest) - before:5} runs {time.monotonic() - start:6.1f} s",
                  file=sys.stderr, flush=True)
    return manifest


def manifest_in(path):
    """The manifest that this file is, or None."""
    with open(path, "rb") as file:
        if not re.match(rb"[0-9a-f]{64} ", file.read(65)):
            return None
    with open(path, encoding="utf-8") as file:
        lines = [line.rstrip("\n").split(" ", 2) for line in file]
    return {words: f"{digest} {status}" for digest, status, words in lines}


def compare(old, new):
    """Prints the runs that differ, and how many; a run that only one of them has differs."""
    different = 0
    for line in list(old) + [line for line in new if line not in old]:
        if old.get(line) == new.get(line):
            continue
        different += 1
        statuses = [values[line].split()[1] if line in values else "not run" for values in (old, new)]
        note = "" if statuses[0] == statuses[1] else " (exit status %s, then %s)" % tuple(statuses)
        print(f"differs{note}: {line}")
    print(f"{len(set(old) | set(new)) - different} the same, {different} different")
    return 1 if different else 0


def main():
    parser = argparse.ArgumentParser(description="Proves that a change of the source changes no output.")
    parser.add_argument("program", nargs="?", help="the program to run")
    parser.add_argument("-o", "--output", metavar="MANIFEST", help="write the manifest there, not to standard output")
    parser.add_argument("--quick", action="store_true", help="fewer scenes and kernels")
    parser.add_argument("--compare", nargs=2, metavar=("OLD", "NEW"), help="two manifests or programs, in any mixture")
    words = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143)) # so that the temporary folder goes
    if bool(words.program) == bool(words.compare):
        parser.error("give a program, or --compare and two")
    if words.compare:
        old, new = (manifest_in(path) or manifest_of(path, words.quick) for path in words.compare)
        return compare(old, new)
    manifest = manifest_of(words.program, words.quick)
    text = "".join(f"{value} {line}\n" for line, value in manifest.items())
    if words.output:
        with open(words.output, "w", encoding="utf-8") as file:
            file.write(text)
    else:
        sys.stdout.write(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
