#!/usr/bin/env python3
"""The drawing of docs/trees.md that no command makes: `python3 docs/plots/trees.py` writes docs/images/trees-wide.svg.

To add one: write a function that fills a Drawing, and name it in DRAWINGS."""
import drawing
from drawing import BLUE, GREY, INK, RUST, Drawing

# A binary tree: a pair of subtrees, or 1, a triangle that stands for what is below.
TREE = (((((1, 1), (1, 1)), ((1, 1), 1)), ((1, 1), (1, (1, 1)))), ((1, 1), (1, 1)))


def leaves_of(tree):
    return 1 if isinstance(tree, int) else leaves_of(tree[0]) + leaves_of(tree[1])


def subtree(d, place, number):
    x, y = place
    d.area((x, y - 8), (x - 12, y + 14), (x + 12, y + 14), fill="#cfe0f2", colour=BLUE, width=1.2)
    d.text((x, y + 12), str(number), anchor="middle", size=11, colour=BLUE)


def wide():
    d = Drawing("A wide node takes in the nodes of several levels", 680, 400)
    left, step, top, level = 40, 40, 60, 38
    ends, inner = [], []

    def draw(tree, first, depth):
        """Draws a subtree whose triangles begin with that one; returns where its top is."""
        if isinstance(tree, int):
            ends.append((left + step * first, top + level * depth))
            return ends[-1]
        below = [draw(tree[0], first, depth + 1), draw(tree[1], first + leaves_of(tree[0]), depth + 1)]
        inner.append(((below[0][0] + below[1][0]) / 2, top + level * depth))
        d.line(below[0], inner[-1], below[1], width=1.4)
        return inner[-1]

    draw(TREE, 0, 0)
    for at in inner:
        d.dot(at, colour=GREY, radius=6)
    root, row = (left + 7.5 * step, 290), 366
    for number, at in enumerate(ends, 1):
        place = (left + step * (number - 1), row)
        subtree(d, at, number)
        d.line(root, (place[0], row - 8), width=1.1)
        subtree(d, place, number)
    d.dot(root, colour=INK, radius=8)
    d.text((left - 12, 40), f"{len(inner)} nodes, each of two children")
    d.text((left - 12, root[1] + 5), "one node of 16 children")
    d.text((root[0] + 24, root[1] + 5), "all 16 boxes are tested at once", colour=RUST)
    return d


DRAWINGS = {"wide": wide}


if __name__ == "__main__":
    drawing.write_all("trees", DRAWINGS)
