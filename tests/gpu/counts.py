"""What runs, counted without a GPU: the instructions per pixel in what PoCL compiles, by valgrind, and the launches of
a picture, by tests/shims/opencl_device.c."""
import os

from compilers import FOLDER, run, skip

SCENES = {
    "original": ["scenes/original.json"],
    "gallery": ["scenes/gallery.json"],
    "city of 10 k": ["city", "1667"],
    "menger-3": ["menger", "3"],
}
SIZES = (96, 54), (192, 108)
FAST = "1000"  # times as fast as PoCL on a processor: the device that launches are counted for


def make_scene(rectray, words, folder):
    if len(words) == 1:
        return words[0]
    path = os.path.join(folder, f"{words[0]}.json")
    run([rectray, "generate", words[0], "--size", words[1], "-o", path])
    return path


def instructions_in(profile):
    """Of the kernels' own code: that of the shared objects that PoCL compiled. A line after `calls=` counts what was
    called, which has lines of its own."""
    total, inside, called = 0, False, False
    with open(profile, encoding="utf-8", errors="replace") as file:
        for line in file:
            if line.startswith("ob="):
                inside = "/tempfile" in line or "pocl" in line and "libpocl" not in line
            elif line.startswith("calls="):
                called = True
            elif called:
                called = False
            elif inside and (line[:1].isdigit() or line[:1] in "+-*"):
                total += int(line.split()[1])
    return total


def executed(rectray, scene, words, size, folder):
    """Instructions of a picture; None where valgrind failed."""
    out = os.path.join(folder, "callgrind.out")
    environment = dict(os.environ, POCL_MAX_PTHREAD_COUNT="1", RECTRAY_CACHE_DIR=os.path.join(FOLDER, "cache"))
    render = [rectray, "render", scene, "-q", "--accel", "bvh", "--size", size, "--threads", "1", *words, "-o",
              os.path.join(folder, "a.png")]
    run(["valgrind", "--tool=none", *render], env=environment)  # compiles the kernel, in less time, and keeps it
    done = run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", "--compress-strings=no",
                "--compress-pos=no", *render], env=environment)
    if done.returncode:
        skip(f"valgrind: {done.stderr.strip().splitlines()[-1]}")
        return None
    return instructions_in(out)


def per_pixel(rectray, scene, words, folder):
    """From two sizes of a picture, so that what is done once counts for nothing."""
    small, large = (executed(rectray, scene, words, f"{columns}x{rows}", folder) for columns, rows in SIZES)
    pixels = SIZES[1][0] * SIZES[1][1] - SIZES[0][0] * SIZES[0][1]
    return round((large - small) / pixels) if small and large else None


def launches(rectray, shim, words, folder):
    """Of a picture of 1920 x 1080 pixels on a device that is fast, those that compile the kernels included."""
    log = os.path.join(folder, "launches")
    environment = dict(os.environ, LD_PRELOAD=shim, SHIM_LOG=log, SHIM_SPEED=FAST)
    done = run([rectray, "render", "scenes/original.json", "-q", "--accel", "bvh", "--size", "1920x1080", *words, "-o",
                os.path.join(folder, "a.png")], env=environment)
    if done.returncode:
        skip(f"launches: {done.stderr.strip()}")
        return None
    with open(log, encoding="utf-8") as file:
        count = sum(line.startswith("LAUNCH") for line in file)
    os.remove(log)
    return count
