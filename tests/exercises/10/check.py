#!/usr/bin/env python3
"""The tests of exercise 10: the functions of a student's OpenCL kernel beside ours, on the device, with known numbers;
then pictures. Usage: check.py SOLUTION REPORT PICTURE; the report's lines are told in tests/exercises/README.md.

A kernel is made for each run: ours, with other names, the student's, and checks.cl for both. Its numbers come back as
the colours of a picture, which `rectray render` writes. The slips are changes of our kernel: see slips.py."""
import os
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import words  # noqa: E402
from device import ROOT, Fails, NotCompiled, kernels_with, pfm_pixels, ppm_pixels, render, write_png  # noqa: E402
from slips import SLIPS  # noqa: E402

COLUMNS, ROWS, GRID, SLOTS = 48, 40, 2, 8
TOGETHER = 3  # slips in one kernel: more compile longer than they save
FUNCTIONS = ["primary_ray", "is_nearer", "nearest_hit", "place_hit", "is_blocked", "light_reaches", "at_least_zero",
             "illuminate", "shade", "trace_path", "store_pixel", "add_counts", "render"]
ARGUMENTS = """constant Parameters *parameters, global const FaceRecord *faces, global const real *face_rows,
                   global const wide *planes, global const real *materials, global const real *lights,
                   global const real *view, global uchar *picture, volatile global uint *totals,
                   global const float *tree_floats, global const int *tree_ints"""
PICTURES = [("gallery", "scenes/gallery.json", 64, 36),
            ("original", "scenes/original.json", 64, 48),
            ("viewer_camera", "tests/scenes/viewer_camera.json", 48, 36),
            ("no_bounces", "tests/scenes/no_bounces.json", 48, 36),
            ("store_pixel", "scenes/original.json", 64, 48)]


class Report:
    def __init__(self, path):
        self.file = open(path, "w", encoding="utf-8")

    def tell(self, *values):
        self.file.write("\t".join(str(value).replace("\t", " ").replace("\n", " ") for value in values) + "\n")
        self.file.flush()


def fail(report, *values):
    for key, value in values:
        if value:
            report.tell(key, value)
    sys.exit(1)


# --- Running a kernel ---

def renamed(prefix, file):
    """Includes a kernel with a prefix before its functions' names."""
    names = FUNCTIONS if prefix else ["render"]
    start = "".join(f"#define {name} {prefix or 'mine_'}{name}\n" for name in names)
    return start + f'#include "{file}"\n' + "".join(f"#undef {name}\n" for name in names)


def check_of(test, prefix):
    text = (HERE / "checks.cl").read_text(encoding="utf-8")
    return text.split(f"/* BEGIN {test} */\n")[1].split("/* END */")[0].replace("WHO_", prefix)


def numbers_of(tests, folder, mine, slips=()):
    """For each test, prefix and case, the numbers that went in and came out: {(test, prefix): [(in, out)]}."""
    prefixes = ["our_", ""] + [f"slip{k}_" for k in range(len(slips))]
    files = {"ours": (ROOT / "kernels" / "plain.cl").read_text(encoding="utf-8"), "mine": mine}
    files.update({f"slip{k}": text for k, text in enumerate(slips)})
    head = (HERE / "checks.cl").read_text(encoding="utf-8").split("/* BEGIN ")[0]
    names = {"our_": "ours", "": "mine"}
    plain = "".join(renamed(prefix, names.get(prefix, prefix[:-1]) + ".cl") for prefix in prefixes) + head
    plain += "".join(check_of(test, prefix) for test in tests for prefix in prefixes)
    cases = [(test, prefix, case) for test in tests for prefix in prefixes for case in words.CASES[test]]
    table = ", ".join(str(number) for *_, case in cases for number in (*case, *[0] * (5 - len(case))))

    def kind_of(test, prefix):
        return tests.index(test) * len(prefixes) + prefixes.index(prefix)

    calls = "".join(f"    if (kind == {kind_of(test, prefix)})\n"
                    f"        {prefix}check_{test}(&scene, number, in, out);\n"
                    for test in tests for prefix in prefixes)
    kinds = ", ".join(str(kind_of(test, prefix)) for test, prefix, _ in cases)
    plain += f"""
constant int table[] = {{{table}}};
constant int kinds[] = {{{kinds}}};

kernel void render({ARGUMENTS})
{{
    Scene scene = {{parameters, faces, face_rows, planes, materials, lights, view, tree_floats, tree_ints, {{0}}}};
    int place = (int)get_global_id(0), pixel = parameters->first_row * parameters->columns + place;
    if (place / parameters->columns >= parameters->band_rows)
        return;
    real3 in[VALUES], out[VALUES];
    for (int k = 0; k < VALUES; k++)
        in[k] = out[k] = (real3)0;
    int which = pixel / {SLOTS}, kind = which < {len(cases)} ? kinds[which] : -1, number[5];
    for (int k = 0; k < 5; k++)
        number[k] = kind < 0 ? 0 : table[which * 5 + k];
{calls}    real3 value = pixel % {SLOTS} < VALUES ? in[pixel % VALUES] : out[pixel % VALUES];
    ((global real *)picture)[3 * place] = value.x;
    ((global real *)picture)[3 * place + 1] = value.y;
    ((global real *)picture)[3 * place + 2] = value.z;
}}
"""
    assert len(cases) * SLOTS <= COLUMNS * ROWS
    pfm = render(kernels_with(folder, plain, **files), words.SCENE, COLUMNS, ROWS, "--format", "pfm", "--grid",
                 str(GRID))
    found = {}
    pixels = pfm_pixels(pfm)
    for k, (test, prefix, _) in enumerate(cases):
        own = pixels[k * SLOTS:(k + 1) * SLOTS]
        found.setdefault((test, prefix), []).append((own[:SLOTS // 2], own[SLOTS // 2:]))
    return found


# --- The functions ---

def options_of(columns, rows, grid):
    """Of the command that traces a pixel."""
    return f"--size {columns}x{rows} --grid {grid} -v"


def same(a, b):
    return a == b or abs(a - b) <= 1e-7 + 2e-6 * max(abs(a), abs(b))


def equal(theirs, ours):
    return all(same(a, b) for (_, x), (_, y) in zip(theirs, ours) for v, w in zip(x, y) for a, b in zip(v, w))


def tell_given(report, test, case, went_in):
    report.tell("forget", "input")
    report.tell("shown", words.SCENE, case[0], case[1], options_of(COLUMNS, ROWS, GRID))
    for name, value in words.given(test, case, went_in):
        report.tell("given", name, value)


def slip_of(test, theirs, folder, mine):
    """The words of the slip that gives the same numbers; None. A function that gives nothing back has none."""
    if not any(value for _, out in theirs for vector in out for value in vector):
        return None
    known = [(text, meaning) for name, text, meaning in SLIPS if name == test]
    for first in range(0, len(known), TOGETHER):
        some = known[first:first + TOGETHER]
        try:
            found = numbers_of([test], folder / str(first), mine, [text for text, _ in some])
        except Fails:
            continue
        for k, (_, meaning) in enumerate(some):
            if equal(theirs, found[test, f"slip{k}_"]):
                return meaning
    return None


def check_function(report, test, found, work, mine):
    theirs, ours = found[test, ""], found[test, "our_"]
    for case, (_, got), (went_in, expected) in zip(words.CASES[test], theirs, ours):
        for slot, component, name in words.VALUES[test]:
            if not same(got[slot][component], expected[slot][component]):
                tell_given(report, test, case, went_in)
                fail(report, ("value", name), ("returned", f"{got[slot][component]:.6g}"),
                     ("expected", f"{expected[slot][component]:.6g}"),
                     ("formula", words.formula(test, case, went_in, expected)),
                     ("slip", slip_of(test, theirs, work / f"slips of {test}", mine)))


def crashed(report, fault):
    report.tell("crash", fault)
    sys.exit(152 if fault.slow else 134)


def check_functions(report, work, mine):
    """All in one run; where that fails, one by one, to find out which."""
    tests = list(words.CASES)
    try:
        found = numbers_of(tests, work / "all", mine)
    except Fails:
        found = None
    for test in tests:
        report.tell("test", test, words.TITLES[test])
        own = found
        if found is None:
            try:
                own = numbers_of([test], work / test, mine)
            except Fails as fault:
                crashed(report, fault)
        check_function(report, test, own, work, mine)


# --- Pictures ---

def picture_of(folder, scene, columns, rows, grid=1):
    return ppm_pixels(render(folder, scene, columns, rows, "--format", "ppm", "--grid", str(grid)))


def colours_of(folder, scene, columns, rows):
    """The same before they become bytes, by store_pixel's other branch."""
    return pfm_pixels(render(folder, scene, columns, rows, "--format", "pfm", "--grid", "1"))


def first_difference(theirs, ours):
    return next((k for k, pair in enumerate(zip(theirs, ours)) if not all(map(same, *pair))), None)


def colour_text(colour):
    return "(" + ", ".join(f"{value:.6g}" for value in colour) + ")"


def check_picture(report, name, scene, size, folders):
    """`folders`: the student's kernels, ours, and a place for those with slips."""
    columns, rows = size
    made = picture_of if name == "store_pixel" else colours_of
    report.tell("test", name, words.TITLES[name])
    try:
        theirs = made(folders["mine"], scene, columns, rows)
    except Fails as fault:
        crashed(report, fault)
    ours = made(folders["ours"], scene, columns, rows)
    k = first_difference(theirs, ours)
    if k is None:
        return
    report.tell("shown", scene, k % columns, k // columns, options_of(columns, rows, 1))
    meaning = None
    for number, (test, text, said) in enumerate(SLIPS):
        if test == name:
            slipped = kernels_with(folders["slips"] / f"{name}{number}", text)
            if first_difference(theirs, made(slipped, scene, columns, rows)) is None:
                meaning = said
                break
    fail(report, ("value", "the pixel's red, green and blue"), ("returned", colour_text(theirs[k])),
         ("expected", colour_text(ours[k])), ("slip", meaning))


def side_by_side(report, path, folders):
    report.tell("test", "picture", words.TITLES["picture"])
    columns, rows, stripe = 128, 128, [(255, 255, 255)] * 4
    theirs, ours = (picture_of(folders[who], words.SCENE, columns, rows, GRID) for who in ("mine", "ours"))
    both = [pixel for row in range(rows) for pixel in (*theirs[row * columns:(row + 1) * columns], *stripe,
                                                       *ours[row * columns:(row + 1) * columns])]
    write_png(path, 2 * columns + 4, rows, both)
    differing = sum(a != b for a, b in zip(theirs, ours))
    report.tell("picture", path, differing, columns * rows)
    if differing > 3:
        k = first_difference(theirs, ours)
        report.tell("shown", words.SCENE, k % columns, k // columns, options_of(columns, rows, GRID))
        fail(report, ("value", "the pixel's red, green and blue"), ("returned", theirs[k]), ("expected", ours[k]))


def main():
    solution, report, picture = sys.argv[1], Report(sys.argv[2]), sys.argv[3]
    mine = Path(solution).read_text(encoding="utf-8", errors="replace")
    for name, title in words.TITLES.items():
        report.tell("listed", name, title)
    with tempfile.TemporaryDirectory() as holder:
        work = Path(holder)
        try:
            check_functions(report, work, mine)
            folders = {"mine": kernels_with(work / "mine", '#include "mine.cl"\n', mine=mine), "ours": ROOT / "kernels",
                       "slips": work}
            for name, scene, columns, rows in PICTURES:
                check_picture(report, name, scene, (columns, rows), folders)
            side_by_side(report, picture, folders)
        except NotCompiled as said:
            for line in str(said).replace("mine.cl", os.path.basename(solution)).splitlines():
                report.tell("compile", line)
            sys.exit(2)
    report.tell("passed", "all")


if __name__ == "__main__":
    main()
