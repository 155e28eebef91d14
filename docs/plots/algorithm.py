#!/usr/bin/env python3
"""The drawings of docs/algorithm.md: `python3 docs/plots/algorithm.py` writes docs/images/algorithm-*.svg.

To add one: write a function that fills a Drawing, and name it in DRAWINGS."""
import drawing
from drawing import BLUE, GREY, INK, PALE, RUST, Drawing, direction, mixed, towards


def screen():
    d = Drawing("The camera, the screen and the ray through one pixel", 680, 350)
    camera, f, r, u = (60, 200), (290, -14), (52, 34), (0, -50)

    def at(x, y):
        """The place of the screen x to the right and y up from its middle, in units of r and u."""
        return mixed(camera, (1, f), (x, r), (y, u))

    d.area(at(-2, -1.5), at(2, -1.5), at(2, 1.5), at(-2, 1.5), fill="#f2f4f6")
    for k in range(1, 8):
        d.line(at(-2 + k / 2, -1.5), at(-2 + k / 2, 1.5), colour="#aaa", width=0.8)
    for k in range(1, 6):
        d.line(at(-2, -1.5 + k / 2), at(2, -1.5 + k / 2), colour="#aaa", width=0.8)
    x, y = 0.75, 1.25
    sides = ((-0.25, -0.25), (0.25, -0.25), (0.25, 0.25), (-0.25, 0.25))
    d.area(*[at(x + i, y + j) for i, j in sides], fill="#f4c27a")
    d.line(camera, at(0, 0), dash="7 4", colour=GREY)
    d.line(at(0, 0), at(x, 0), width=2.4, colour=RUST)
    d.line(at(x, 0), at(x, y), width=2.4, colour=RUST)
    d.text(mixed(at(x / 2, 0), (1, (-6, 19))), "x r", colour=RUST, anchor="middle")
    d.text(mixed(at(x, y / 2), (1, (8, 8))), "y u", colour=RUST)
    d.arrow(camera, mixed(camera, (0.3, f)), width=2.6)
    d.arrow(camera, mixed(camera, (1, r)), width=2.6)
    d.arrow(camera, mixed(camera, (1, u)), width=2.6)
    d.text((138, 215), "f"), d.text((116, 248), "r"), d.text((44, 150), "u")
    q = at(x, y)
    d.arrow(camera, mixed(camera, (1.62, (q[0] - camera[0], q[1] - camera[1]))), colour=BLUE, width=2)
    d.dot(camera), d.dot(q), d.dot(at(0, 0), radius=3)
    d.text((30, 218), "C", bold=True), d.text(mixed(q, (1, (8, -10))), "Q", bold=True)
    d.text((560, 92), "P(t) = C + t R", colour=BLUE), d.text((184, 216), "distance", colour=GREY)
    d.text(mixed(at(-2, 1.5), (1, (-8, -8))), "column 0, row 0", size=13, anchor="middle")
    d.text(mixed(at(2, -1.5), (1, (12, 0))), "the screen, width by height", size=13)
    return d


def plane():
    d = Drawing("The plane hit, seen from the side", 680, 300)
    d.ground((40, 235), (640, 235))
    o, p, v = (130, 65), (470, 235), (570, 235)
    d.line(o, (130, 235), colour=RUST, dash="6 4", width=2)
    d.right_angle((130, 235), (1, 0), (0, -1))
    d.text((122, 158), "height of O:", anchor="end", colour=RUST, size=14)
    d.text((122, 177), "N.(O - v[0])", anchor="end", colour=RUST, size=14)
    step = ((p[0] - o[0]) / 3, (p[1] - o[1]) / 3)
    d.line(o, p, colour=BLUE, dash="2 4", width=2)
    d.arrow(o, mixed(o, (1, step)), colour=BLUE, width=2.6)
    for k in (1, 2):
        d.dot(mixed(o, (k, step)), colour=BLUE, radius=3)
    corner = (mixed(o, (1, step))[0], o[1])
    d.line(o, corner, colour=GREY, width=1)
    d.line(corner, mixed(o, (1, step)), colour=RUST, width=2, dash="6 4")
    d.text((corner[0] + 8, corner[1] + 32), "N.R (negative: downwards)", colour=RUST, size=14)
    d.text((188, 116), "R", colour=BLUE)
    d.text((236, 144), "t = 1", anchor="end", size=14), d.text((350, 200), "t = 2", anchor="end", size=14)
    d.arrow(v, (570, 135), width=2.6)
    d.text((580, 150), "N"), d.text((562, 268), "v[0]"), d.text((404, 268), "P, at t = 3", anchor="start")
    d.right_angle(v, (1, 0), (0, -1))
    d.dot(o), d.dot(p), d.dot(v)
    d.text((118, 56), "O", anchor="end", bold=True)
    return d


def edges():
    d = Drawing("The inside test, seen from the tip of N", 680, 300)
    for shift, inside in ((0, True), (340, False)):
        v = [(60 + shift, 230), (280 + shift, 245), (250 + shift, 70), (95 + shift, 60)]
        p = (165 + shift, 160) if inside else (292 + shift, 150)
        d.area(*v, colour="none")
        signs = [(170, 264, "+"), (285, 195, "+"), (175, 52, "+"), (56, 150, "+")]
        for k in range(4):
            d.arrow(v[k], v[(k + 1) % 4], width=2)
            x, y, sign = signs[k]
            if not inside and k == 1:
                x, sign = 249, "\u2212"
            d.text((x + shift, y), sign, anchor="middle", size=22, bold=True, colour=RUST if sign != "+" else INK)
        k = 0 if inside else 1
        d.arrow(v[k], towards(v[k], v[k + 1], 0.62 if k == 0 else 0.75), colour=RUST, width=3)
        d.arrow(v[k], p, colour=BLUE, width=2.4)
        e, c = ((200, 228), (100, 190)) if inside else ((236, 124), (303, 212))
        d.text((e[0] + shift, e[1]), "e", colour=RUST, bold=True)
        d.text((c[0] + shift, c[1]), "c", colour=BLUE, bold=True)
        d.dot(p)
        d.text((p[0] + 10, p[1] - 6), "P", bold=True)
        for k, (x, y) in enumerate(((-34, 18), (6, 18), (4, -8), (-34, -6))):
            d.text((v[k][0] + x, v[k][1] + y), f"v[{k}]")
        d.text((170 + shift, 22), "inside: P is left of all edges" if inside else "outside: P is right of edge 1",
               anchor="middle", size=14)
    return d


def nearest():
    d = Drawing("The nearest hit, and a tie", 680, 220)
    o, far = (40, 130), (425, 130)
    d.arrow(o, far, colour=BLUE, width=2)
    for x, name, t in ((150, "A", "t = 1.1"), (255, "B", "t = 2.2"), (355, "C", "t = 3.2")):
        d.line((x - 22, 60), (x + 22, 190), width=5, colour=INK if name == "A" else "#9aa0a6")
        d.text((x - 26, 50), name, anchor="middle", bold=True)
        d.text((x + 12, 120), t, size=13)
    d.dot(o), d.dot((150, 130), radius=5)
    d.text((30, 118), "O", bold=True)
    d.text((200, 22), "A is seen: its t is the smallest", anchor="middle", size=14)
    d.line((460, 10), (460, 210), colour="#ccc", width=1)
    d.line((545, 60), (590, 130), (560, 195), width=5)
    d.arrow((490, 130), (585, 130), colour=BLUE, width=2)
    d.dot((590, 130), radius=5)
    d.text((573, 72), "face 4"), d.text((586, 186), "face 7")
    d.text((565, 22), "the same t: face 4 counts", anchor="middle", size=14)
    return d


def shadow():
    d = Drawing("The shifted point, and shadow rays", 680, 330)
    d.ground((30, 215), (272, 215))
    d.arrow((240, 215), (240, 120), width=2.6), d.text((250, 134), "n")
    p, s = (110, 238), (110, 180)
    d.arrow(p, s, colour=RUST, width=2.4)
    d.dot(p), d.dot(s)
    d.text((122, 246), "P, rounded, may lie", size=14), d.text((122, 264), "below the face", size=14)
    d.text((96, 176), "S", bold=True, anchor="end"), d.text((120, 186), "surely above", size=14)
    d.text((142, 22), "very much enlarged", anchor="middle", size=14)
    d.line((290, 10), (290, 320), colour="#ccc", width=1)
    d.ground((310, 260), (665, 260))
    s = (470, 257)
    lights = [(345, 80), (590, 70), (625, 315)]
    d.arrow(s, towards(s, lights[0], 0.91), colour=BLUE, width=2)
    d.area((515, 165), (560, 165), (560, 180), (515, 180), fill="#9aa0a6")
    d.arrow(s, (524, 182), colour=BLUE, width=2)
    d.line((531, 163), towards(s, lights[1], 0.91), colour=BLUE, width=1.4, dash="3 4")
    d.cross((527, 181))
    for k, place in enumerate(lights):
        d.lamp(place, "")
        x, y, side = ((0, -20, "middle"), (0, -20, "middle"), (-22, 5, "end"))[k]
        d.text((place[0] + x, place[1] + y), f"light {k}", anchor=side)
    d.text((404, 130), "reaches S", size=14, anchor="start"), d.text((568, 178), "is blocked", size=14)
    d.text((430, 320), "is behind the plane: no ray", size=14, anchor="middle")
    d.dot(s, radius=5), d.text((484, 250), "S", bold=True)
    return d


def shading():
    d = Drawing("The vectors of the illumination", 680, 280)
    d.ground((60, 240), (620, 240))
    p, length = (340, 240), 165
    to_light, to_viewer = 132, 28
    for degrees, end in ((to_light, 1.42), (to_viewer, 1.35)):
        along = direction(degrees)
        d.line(mixed(p, (length, along)), mixed(p, (end * length, along)), dash="2 4", colour=GREY)
    for name, degrees, colour, dash in (("N", 90, INK, None), ("L", to_light, RUST, None), ("V", to_viewer, BLUE, None),
                                        ("H", (to_light + to_viewer) / 2, INK, "7 4")):
        d.arrow(p, mixed(p, (length, direction(degrees))), colour=colour, width=2.6, dash=dash)
        beside = {"L": (14, -8), "V": (-10, -14)}.get(name, (0, 0))
        at = mixed(p, (length + 16, direction(degrees)), (1, (0, 5)), (1, beside))
        d.text(at, name, anchor="middle", colour=colour, bold=True)
    d.arc(p, 90, to_light, 62), d.text(mixed(p, (80, direction(111)), (1, (0, 5))), "theta", anchor="middle", size=14)
    half = (to_light + to_viewer) / 2
    for start, end in ((to_viewer, half), (half, to_light)):
        d.arc(p, start, end, 112)
        middle = direction((start + end) / 2)
        d.line(mixed(p, (106, middle)), mixed(p, (118, middle)), width=1.1)
    d.lamp((166, 48), "")
    d.text((144, 53), "light", anchor="end"), d.dot(mixed(p, (1.38 * length, direction(to_viewer))), radius=5)
    d.text((552, 138), "viewer"), d.dot(p, radius=5), d.text((346, 268), "P", bold=True)
    d.text((400, 94), "two equal angles:", size=14), d.text((400, 112), "H is half-way", size=14)
    return d


def mirror():
    d = Drawing("Reflection", 680, 290)
    d.ground((30, 235), (330, 235))
    s, a, b = (180, 235), 110, 130
    start = (s[0] - a, s[1] - b)
    d.arrow(start, s, colour=BLUE, width=2.6)
    d.arrow(s, (s[0] + a, s[1] - b), colour=BLUE, width=2.6)
    d.arrow(s, (s[0], s[1] - 1.25 * b), width=2.6)
    d.line(start, (s[0] + a, s[1] - b), colour=GREY, dash="5 4")
    d.arrow(start, (start[0], s[1] - 2), colour=RUST, width=2, dash="6 4")
    d.text((start[0] - 6, 185), "(r.N) N", anchor="end", colour=RUST, size=14)
    d.text((122, 97), "the rest", anchor="middle", colour="#555", size=14)
    d.text((128, 150), "r", colour=BLUE, bold=True), d.text((250, 182), "R'", colour=BLUE, bold=True)
    d.text((190, 84), "N", bold=True), d.text((172, 264), "S", bold=True), d.dot(s)
    d.text((180, 24), "the part along N is turned round", anchor="middle", size=14)
    d.line((365, 10), (365, 280), colour="#ccc", width=1)
    d.ground((395, 245), (665, 245)), d.ground((665, 70), (440, 70))
    c, p1, p2, p3 = (385, 120), (460, 245), (560, 70), (640, 245)
    for a, b, width in ((c, p1, 3), (p1, p2, 2.2), (p2, p3, 1.4)):
        d.arrow(a, b, colour=BLUE, width=width)
    d.text((436, 160), "weight 1", size=14), d.text((522, 190), "q[0]", size=14)
    d.text((610, 140), "q[0] q[1]", size=14)
    for place, name, up in ((p1, "P1", 26), (p2, "P2", -18), (p3, "P3", 26)):
        d.dot(place), d.text((place[0], place[1] + up), name, anchor="middle", bold=True)
    d.text((525, 24), "each mirror multiplies the weight", anchor="middle", size=14)
    return d


def lattice():
    d = Drawing("Sixteen samples of a pixel: a grid and a lattice", 560, 290)
    size, top = 220, 40
    grid = [((i + 0.5) / 4, (j + 0.5) / 4) for j in range(4) for i in range(4)]
    spread = [((k + 0.5) / 16, (k * 13 % 16 + 0.5) / 16) for k in range(16)]
    edge, bottom = top + 0.44 * size, top + size
    for left, title, cells, samples in ((40, "a grid of 4 x 4", 4, grid), (300, "a lattice of 16", 16, spread)):
        d.area((left, edge), (left + size, edge), (left + size, bottom), (left, bottom), fill=PALE, colour="none")
        for k in range(1, cells):
            at = k * size / cells
            d.line((left + at, top), (left + at, top + size), colour="#c4c8cc", width=0.7)
            d.line((left, top + at), (left + size, top + at), colour="#c4c8cc", width=0.7)
        d.line((left, edge), (left + size, edge), colour=RUST, width=2.4)
        d.area((left, top), (left + size, top), (left + size, bottom), (left, bottom), fill="none")
        for x, y in samples:
            d.dot((left + x * size, top + y * size), radius=4.5, colour=BLUE)
        d.text((left + size / 2, 24), title, anchor="middle")
    d.text((280, 282), "an edge along the rows, as it moves down", anchor="middle", size=14, colour=RUST)
    return d


DRAWINGS = {"screen": screen, "plane": plane, "edges": edges, "nearest": nearest, "shadow": shadow, "shading": shading,
            "mirror": mirror, "lattice": lattice}


if __name__ == "__main__":
    drawing.write_all("algorithm", DRAWINGS)
