#!/usr/bin/env python3
"""The figures of the course's slides, as SVG and PNG, with a page that shows them all: `make figures` writes them to
build/figures/. To add one: a line in FIGURES with its week, name, words, and the command that draws it.

A figure is a file of docs/ that is copied, or what a command of rectray writes to {out}."""
import html
import os
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
FOLDER = ROOT / "build" / "figures"
PROGRAM = ROOT / "build" / "rectray"
LESSONS = ("acne", "leak", "cracks", "far", "light_in_the_plane", "camera_in_the_plane")


def traced(scene, pixel, *words):
    return ["trace", scene, "--pixel", pixel, *words, "--format", "svg", "-o", "{out}"]


def rendered(scene, *words):
    return ["render", scene, *words, "-b", "reference", "-q", "-o", "{out}"]


# (week, name with its ending, what it shows, a file of docs/ or the words of a command)
FIGURES = [
    (1, "gallery.png", "What the program draws", "docs/images/gallery.png"),
    (1, "screen.svg", "The screen, and the ray through a pixel", "docs/images/algorithm-screen.svg"),
    (1, "original-pixel.svg", "Pixel 60,60 of scenes/original.json, 128 x 96: the primary ray",
     traced("scenes/original.json", "60,60", "--size", "128x96")),
    (2, "plane.svg", "Where a ray meets a plane", "docs/images/algorithm-plane.svg"),
    (3, "edges.svg", "The inside test", "docs/images/algorithm-edges.svg"),
    (3, "nearest.svg", "The nearest of several hits", "docs/images/algorithm-nearest.svg"),
    (4, "shadow.svg", "The shadow ray, and the shifted point", "docs/images/algorithm-shadow.svg"),
    (4, "cornell-shadow.svg", "Pixel 142,430 of scenes/cornell.json: lights that are blocked",
     traced("scenes/cornell.json", "142,430")),
    (5, "shading.svg", "The vectors of Blinn-Phong", "docs/images/algorithm-shading.svg"),
    (5, "alpha.png", "The highlight of scenes/original.json", rendered("scenes/original.json", "--size", "320x240")),
    (6, "mirror.svg", "The mirrored ray", "docs/images/algorithm-mirror.svg"),
    (6, "gallery-pixel.svg", "Pixel 900,390 of scenes/gallery.json: the mirror, the star, the plinth",
     traced("scenes/gallery.json", "900,390")),
    (6, "mirrors.png", "Two mirrors that face each other", rendered("scenes/mirrors.json", "--size", "320x180")),
    (8, "kdtree.svg", "The k-d tree of scenes/cornell.json",
     ["tree", "scenes/cornell.json", "--accel", "kdtree", "-o", "{out}"]),
    (8, "bvh.svg", "The bounding volume hierarchy of the same scene",
     ["tree", "scenes/cornell.json", "--accel", "bvh", "-o", "{out}"]),
    (8, "wide.svg", "A wide node takes in the nodes of several levels", "docs/images/trees-wide.svg"),
    (8, "gallery-kdtree.svg", "A pixel's way through the k-d tree of the gallery",
     traced("scenes/gallery.json", "900,390", "--accel", "kdtree")),
    (9, "lanes.svg", "Rays side by side", "docs/images/kernels-lanes.svg"),
    (9, "tiles.svg", "Tiles of pixels and their corner rays", "docs/images/kernels-tiles.svg"),
    (9, "ladder.png", "From the plainest kernel to the fastest", "docs/images/bench-kernels-gallery.png"),
    (10, "lattice.svg", "Sixteen samples of a pixel", "docs/images/algorithm-lattice.svg"),
    (10, "accuracy.png", "Where sampling errs", "docs/images/accuracy-heat.png"),
]
for lesson in LESSONS:
    for kind in ("textbook", "exact", "apart"):
        FIGURES.append((7, f"{lesson}-{kind}.png", f"Rounding, {lesson.replace('_', ' ')}: {kind}",
                        f"docs/images/rounding-{lesson}-{kind}.png"))
FIGURES += [(0, f"exercise-{path.parent.name}.{path.suffix[1:]}", f"The goal of exercise {path.parent.name[:2]}",
             str(path.relative_to(ROOT)))
            for path in sorted((ROOT / "docs" / "exercises").glob("[0-9]*/goal.*"))]

PAGE = """<!doctype html>
<html lang="en"><meta charset="utf-8"><title>Figures for the course</title>
<style>
body {{ font: 16px/1.5 sans-serif; max-width: 75rem; margin: 2rem auto; padding: 0 1rem; color: #222; background: #fff }}
section {{ display: grid; grid-template-columns: repeat(auto-fill, minmax(20rem, 1fr)); gap: 1.5rem }}
figure {{ margin: 0; border: 1px solid #ccc; padding: .75rem }}
img {{ width: 100%; height: 16rem; object-fit: contain }}
figcaption {{ font-size: .9rem }}
</style>
<h1>Figures for the course</h1>
<p>Made by <code>make figures</code>. docs/course.md says when to show which. Each drawing is an SVG and a PNG.</p>
{sections}
</html>
"""


def make(name, source):
    out = FOLDER / name
    if isinstance(source, str):
        shutil.copyfile(ROOT / source, out)
    else:
        subprocess.run([PROGRAM, *(word.format(out=out) for word in source)], cwd=ROOT, check=True,
                       stdout=subprocess.DEVNULL)
    if out.suffix == ".svg":
        subprocess.run(["rsvg-convert", "--width", "1600", "--keep-aspect-ratio", "--background-color", "white",
                        "-o", out.with_suffix(".png"), out], check=True)


def section(week, figures):
    shown = []
    for name, words in figures:
        links = [name] + ([Path(name).with_suffix(".png").name] if name.endswith(".svg") else [])
        links = ", ".join(f'<a href="{link}">{link}</a>' for link in links)
        shown.append(f'<figure><img src="{name}" alt="{html.escape(words)}"><figcaption>{html.escape(words)}<br>{links}'
                     "</figcaption></figure>")
    title = f"Week {week}" if week else "Goals of the exercises"
    return f"<h2>{title}</h2>\n<section>\n" + "\n".join(shown) + "\n</section>"


def main():
    only = sys.argv[1:]
    FOLDER.mkdir(parents=True, exist_ok=True)
    for _, name, _, source in FIGURES:
        if not only or name in only:
            make(name, source)
    weeks = sorted({week for week, *_ in FIGURES}, key=lambda week: week or 99)
    sections = "\n".join(section(week, [(name, words) for own, name, words, _ in FIGURES if own == week])
                         for week in weeks)
    (FOLDER / "index.html").write_text(PAGE.format(sections=sections), encoding="utf-8")
    print(f"{len(FIGURES)} figures: {os.path.relpath(FOLDER / 'index.html')}")


if __name__ == "__main__":
    main()
