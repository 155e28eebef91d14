#!/usr/bin/env python3
"""Does `rectray grade` know the mutants? Each mutant of the tracers that changes a walkthrough is built, tells some
pixels, and what it tells is graded by the program as it is.

Usage: tests/soak/grade_mutants.py [NAME...]      (from the top of the tree, after `make`)

A mutant is known where one of the slips that grading names is the one below. CANNOT has those that grading cannot name,
and why; docs/grading.md sums them up. The exit status is 1 where a mutant is neither."""
import json
import os
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "mutants"))
from run import copy_tree, read_list  # pylint: disable=wrong-import-position

FILES = ("src/trace/reference.c", "src/trace/textbook", "src/scene/geometry.c", "src/scene/light.c",
         "src/walkthrough/walkthrough.c", "src/walkthrough/walkthrough_json")
PROGRAM = os.path.abspath("build/rectray")
FOLDER = "build/grade-mutants"

# Pixels in which something shows: mirrors, shadows, both sides of a face, several lights and several samples.
PIXELS = [("scenes/original.json", 40, 36), ("scenes/original.json", 20, 50), ("scenes/mirrors.json", 300, 200),
          ("scenes/cornell.json", 100, 450), ("scenes/cornell.json", 320, 380), ("tests/scenes/one_sided.json", 40, 24),
          ("tests/scenes/facing_mirrors.json", 30, 14), ("tests/scenes/highlight_in_a_mirror.json", 28, 21),
          ("tests/scenes/many_lights.json", 27, 20), ("tests/scenes/shadow_ambient.json", 20, 31),
          ("tests/scenes/viewer_ray.json", 26, 26), ("tests/scenes/background.json", 20, 31),
          ("tests/scenes/no_bounces.json", 27, 20), ("tests/scenes/same_place.json", 16, 6),
          ("tests/scenes/grid.json", 2, 43), ("tests/scenes/bright.json", 27, 20), ("scenes/cornell.json", 200, 200),
          ("tests/scenes/facing_mirrors.json", 30, 14, "--bounces", "1"),
          ("scenes/gallery.json", 965, 320, "--grid", "1"), ("scenes/gallery.json", 900, 390, "--grid", "1")]

# The slips that are the mutant, in the words of grading.
KNOWN = {
    "edge-side-dropped": ["outside-counts"], "last-edge-forgotten": ["last-edge-forgotten"],
    "t-sign-dropped": ["t-sign-at-last"], "front-is-back": ["one-sided-reversed"],
    "segment-without-end": ["shadow-beyond-light"], "shift-backwards": ["shift-inwards"],
    "shift-without-margin": ["shadow-not-shifted"], "tie-to-the-last": ["last-of-equal"],
    "normal-not-turned": ["normal-not-turned"], "light-in-plane-lights": ["light-in-plane-counts"],
    "light-side-dropped": ["light-behind-counts"], "no-shadows": ["no-shadows"],
    "shadow-keeps-ambient": ["shadow-rule"], "half-a-reflection": ["reflection-once"],
    "weight-forgets": ["weight-not-accumulated"], "one-bounce-more": ["bounce-too-many", "bounces-unlimited"],
    "no-clamp-at-zero": ["highlight-not-clamped"], "halfway-difference": ["h-difference"],
    "byte-truncated": ["bytes-cut-off"], "samples-upside-down": ["upside-down"],
    "textbook-upside-down": ["upside-down"], "textbook-d": ["d-sign"], "textbook-behind": ["behind-counts"],
    "textbook-edge": ["edges-skip-one"], "textbook-one-sided": ["one-sided-left-out"],
    "textbook-last-of-equal": ["last-of-equal"], "textbook-normal-not-turned": ["normal-not-turned"],
    "textbook-light-behind": ["light-behind-counts"], "textbook-beyond-the-light": ["shadow-beyond-light"],
    "textbook-halfway-backwards": ["h-difference"], "textbook-no-cosine": ["no-cosine"],
    "textbook-full-shininess": ["alpha-undivided"], "textbook-lit-in-shadow": ["lit-in-shadow"],
    "textbook-ambient-without-light": ["light-ambient-forgotten"],
    "textbook-specular-without-light": ["light-specular-forgotten"],
    "textbook-diffuse-without-light": ["light-diffuse-forgotten"],
    "textbook-shadow-always-black": ["nothing-in-shadow"],
    "textbook-half-mirrored": ["reflection-once"], "textbook-last-mirror-counts": ["weight-not-accumulated"],
    "textbook-one-bounce-more": ["bounce-too-many", "bounces-unlimited"],
    "textbook-path-ends-in-ambient": ["dark-ends"], "textbook-viewer-ahead": ["v-backwards"],
    "textbook-background-unweighted": ["background-unweighted"], "textbook-bytes-cut-off": ["bytes-cut-off"],
}

# What no slip of the list is.
NUMBER = "a number that no hand writes: the place and both values are told"
CANNOT = {
    "samples-off-centre": NUMBER, "textbook-pixel-corner": NUMBER, "textbook-outside": NUMBER,
    "alpha-undivided": "the document contradicts itself: its highlight is right, its terms are not",
    "behind-counts": "only a ray that starts in the box of a face it has left meets it again",
    "textbook-sum-for-mean": "the samples' sum is divided by their root: the place and the ratio are told",
    "textbook-last-light-decides": "only the end of the path differs, as it does without mirrors",
}


def run(program, *words, text_in=None):
    return subprocess.run([program, *words], input=text_in, capture_output=True, text=True, check=False)


def textbook_document(text, column, row):
    """The walkthrough in the numbers of textbook arithmetic."""
    told = json.loads(text)["textbook"]
    hits = [{"face": hit["face"], "t": hit["t"],
             "lights": [{"light": k, "verdict": light["verdict"]} for k, light in enumerate(hit.get("lights", []))]}
            for hit in told["hits"] if hit["face"] >= 0]
    return json.dumps({"pixel": {"column": column, "row": row},
                       "summary": {"hits": hits, "colour": told["colour"], "rgb": told["rgb"]}})


def tell(program, textbook, scene, column, row, *options):
    """What the program tells of the pixel, as a document to be graded. None where it ends before: a mutant may."""
    words = [*options] + (["--arithmetic", "textbook", "-p", "double", "--shift", "1e-9"] if textbook else [])
    out = run(program, "trace", scene, "--pixel", f"{column},{row}", "-f", "json", *words)
    if out.returncode:
        return None
    return textbook_document(out.stdout, column, row) if textbook else out.stdout


def grades(program, textbook):
    """Of each pixel in which the program tells something else than ours: the slips that are named."""
    found = []
    for pixel in PIXELS:
        theirs, ours = tell(program, textbook, *pixel), tell(PROGRAM, textbook, *pixel)
        if theirs is None or ours is None or theirs == ours:
            continue
        out = run(PROGRAM, "grade", pixel[0], "-", "--json", *pixel[3:], text_in=theirs)
        grade = json.loads(out.stdout) if out.stdout else {"same": False, "causes": []}
        found.append(None if grade["same"] else [cause["slip"] for cause in grade["causes"] if not cause["rounding"]])
    return found


def try_mutant(mutant):
    """What grading says of it, or None where it does not build."""
    _, file, _, before, after = mutant
    path = f"{FOLDER}/{file}"
    with open(path, encoding="utf-8") as source:
        original = source.read()
    try:
        with open(path, "w", encoding="utf-8") as out:
            out.write(original.replace(before, after))
        build = subprocess.run(["make", "-s", "build/rectray", "WERROR="], cwd=FOLDER, capture_output=True, check=False)
        if build.returncode:
            return None
        return grades(os.path.abspath(f"{FOLDER}/build/rectray"), file.startswith("src/trace/textbook"))
    finally:
        with open(path, "w", encoding="utf-8") as out:
            out.write(original)  # its new time has it compiled again


def judge(name, found):
    """A word for the table, and whether that is as it should be."""
    told = [slips for slips in found or [] if slips is not None]
    names = sorted({slip for slips in told for slip in slips})
    if found is None:
        return "does not build", False
    if not found:
        return "changes no walkthrough here", True
    if not told:
        return "changes less than is tolerated", True
    if set(KNOWN.get(name, [])) & set(names):
        return "known: " + ", ".join(KNOWN[name]), True
    return "not known: " + (CANNOT.get(name) or f"named are {names}, in {told}"), name in CANNOT


def main():
    mutants = [m for m in read_list("tests/mutants/list") if m[1].startswith(FILES)]
    mutants = [m for m in mutants if not sys.argv[1:] or m[0] in sys.argv[1:]]
    copy_tree(FOLDER)
    failed = []
    for mutant in mutants:
        words, good = judge(mutant[0], try_mutant(mutant))
        print(f"  {'' if good else 'FAIL '}{mutant[0]:36} {words}", flush=True)
        if not good:
            failed.append(mutant[0])
    print(f"{len(mutants) - len(failed)} of {len(mutants)} as they should be")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
