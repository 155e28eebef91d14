"""What the compilers of GPUs make of the kernels: registers, private memory, spills, arithmetic in double. No GPU is
needed. The texts are those that rectray gives to OpenCL, which tests/shims/opencl_device.c writes down. At the end the
packet kernel at one lane and the kernel for GPUs are compared with the goals.
Usage: report.py RECTRAY SHIM [--counts]    --counts: executed instructions, too"""
import glob
import os
import shutil
import sys
import tempfile

import compilers
import counts
from compilers import run, skip

SCENE = "scenes/cornell.json"
UNIFORM = ["--sampling", "uniform:1"]
ONE_LANE = ["--lanes", "1", "--kernel", "packet"]

# The programs that a GPU would be given, and what makes rectray build them.
PROGRAMS = {
    "packet, 1 lane": ONE_LANE + UNIFORM,
    "packet, 1 lane, adaptive": ONE_LANE + ["--sampling", "adaptive:4"],
    "plain": ["--kernel", "plain"] + UNIFORM,
    "gpu": ["--kernel", "gpu"] + UNIFORM,
    "gpu, adaptive": ["--kernel", "gpu", "--sampling", "adaptive:4"],
}

COUNTED = ["packet, 1 lane", "plain", "gpu"]

# Before and after, which are compared with the goals.
PAIRS = {"": ("packet, 1 lane", "gpu"), "adaptive, ": ("packet, 1 lane, adaptive", "gpu, adaptive")}

EXACT = "render_doubts", "render_centre_doubts"  # the exact passes, which the goals leave out

# The goals of the kernel for GPUs: what the compiler tells of it at most.
GOALS = {
    "sm_86": {"registers": 128, "private": 512, "spills": 0, "doubles": 0},
    "gfx1030": {"private": 512, "spills": 0, "doubles": 0},
    "skl": {"spills": 0},
}
NAMES = {"registers": "registers", "private": "private bytes", "spills": "spills", "doubles": "instructions in double"}
SHARE, LAUNCHES = 1 / 3, 8  # of the instructions per pixel; of a picture of 1920 x 1080


def sources(rectray, shim, words, folder):
    """The programs that rectray builds for these words."""
    environment = dict(os.environ, LD_PRELOAD=shim, SHIM_SOURCES=folder, RECTRAY_CACHE_DIR="")
    done = run([rectray, "render", SCENE, "-q", "--accel", "bvh", "--size", "8x8", *words, "-o",
                os.path.join(folder, "a.png")], env=environment)
    if done.returncode:
        skip(f"render {' '.join(words)}: {done.stderr.strip()}")
    return [compilers.read_source(name) for name in sorted(glob.glob(os.path.join(folder, "*.cl")))]


def cell(value):
    return "-" if value is None else str(value)


def table(title, heads, rows):
    print(f"\n### {title}\n\n| " + " | ".join(heads) + " |\n" + "| --- " * len(heads) + "|")
    for row in rows:
        print("| " + " | ".join(cell(value) for value in row) + " |")


def compiled(rectray, shim):
    """Each compiler's rows, by its name, and its table."""
    here = list(compilers.available())
    rows = {name: [] for name, _, _ in here}
    for program, words in PROGRAMS.items():
        with tempfile.TemporaryDirectory() as folder:
            for source in sources(rectray, shim, words, folder):
                for name, _, compiler in here:
                    rows[name] += [row for row in compiler(program, source, folder) if row.kernel in source.kernels]
    for name, title, _ in here:
        table(title, ["program", "kernel", "registers", "private bytes", "spills", "instructions",
                      "of them in double"], rows[name])
    return rows


def counted(rectray):
    """Instructions per pixel: of each scene, by program."""
    found = {}
    with tempfile.TemporaryDirectory() as folder:
        for name, made in counts.SCENES.items():
            scene = counts.make_scene(rectray, made, folder)
            found[name] = {program: counts.per_pixel(rectray, scene, PROGRAMS[program], folder) for program in COUNTED}
    table("Instructions per pixel, counted by valgrind in what PoCL compiles", ["scene", *COUNTED],
          [[name, *cells.values()] for name, cells in found.items()])
    return found


def goal_row(figure, goal, before, after):
    met = None if after is None else "yes" if after <= goal + 1e-9 else "NO"
    return [figure, *(f"{value:.2f}" if isinstance(value, float) else value for value in (goal, before, after)), met]


def worst(rows, program, field):
    """The largest figure of the program's kernels, without the exact pass."""
    values = [getattr(row, field) for row in rows if row.program == program and row.kernel not in EXACT]
    return max((value for value in values if value is not None), default=None)


def goals(rectray, shim, rows, per_pixel):
    found = []
    for sampling, (before, after) in PAIRS.items():
        for name, fields in GOALS.items():
            for field, goal in fields.items():
                figures = [worst(rows.get(name, []), program, field) for program in (before, after)]
                found.append(goal_row(f"{sampling}{name}: {NAMES[field]}", goal, *figures))
        for scene, cells in per_pixel.items():
            if cells.get(before) and cells.get(after):
                found.append(goal_row(f"{sampling}{scene}: share of the instructions per pixel", SHARE, 1.0,
                                      cells[after] / cells[before]))
        with tempfile.TemporaryDirectory() as folder:
            figures = [counts.launches(rectray, shim, PROGRAMS[program], folder) for program in (before, after)]
        found.append(goal_row(f"{sampling}launches of a picture of 1920 x 1080", LAUNCHES, *figures))
    table("The goals: the packet kernel at one lane, and the kernel for GPUs without its exact passes",
          ["figure", "at most", "packet kernel", "kernel for GPUs", "met"], found)


def main():
    rectray, shim = (os.path.abspath(word) for word in sys.argv[1:3])
    rows, per_pixel = compiled(rectray, shim), {}
    if "--counts" in sys.argv:
        if shutil.which("valgrind"):
            per_pixel = counted(rectray)
        else:
            skip("instructions per pixel: valgrind is not there")
    goals(rectray, shim, rows, per_pixel)


if __name__ == "__main__":
    main()
