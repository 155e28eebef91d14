"""What the drawings of the pages are made with: lines, arrows, lamps and labels of an SVG file.

Lengths are pixels, and y points down. A white ground makes a drawing readable on a dark page, too. What colours tell
apart, dashes or labels do also."""
import math
import os

FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "images")
INK, BLUE, RUST, GREY, PALE = "#222", "#1a56a0", "#a34700", "#777", "#e3e6ea"


def towards(a, b, share):
    """The point between a and b, a at 0 and b at 1."""
    return a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share


def mixed(origin, *terms):
    """origin + the sum of factor * vector."""
    return tuple(origin[k] + sum(factor * vector[k] for factor, vector in terms) for k in (0, 1))


def unit(a):
    length = math.hypot(*a)
    return a[0] / length, a[1] / length


def direction(degrees):
    """The unit vector at that angle, anticlockwise from the right."""
    return math.cos(math.radians(degrees)), -math.sin(math.radians(degrees))


def points(places):
    return " ".join(f"{x:.1f},{y:.1f}" for x, y in places)


class Drawing:
    def __init__(self, title, width, height):
        self.parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
                      f'height="{height}" font-family="sans-serif" font-size="15" fill="{INK}">',
                      f"<title>{title}</title>", f'<rect width="{width}" height="{height}" fill="#fff"/>']

    def line(self, *places, colour=INK, width=1.6, dash=None):
        dashed = f' stroke-dasharray="{dash}"' if dash else ""
        self.parts.append(f'<polyline points="{points(places)}" fill="none" stroke="{colour}" '
                          f'stroke-width="{width}"{dashed}/>')

    def area(self, *places, fill=PALE, colour=INK, width=1.6):
        self.parts.append(f'<polygon points="{points(places)}" fill="{fill}" stroke="{colour}" '
                          f'stroke-width="{width}"/>')

    def arrow(self, a, b, colour=INK, width=1.8, dash=None, head=10):
        along = unit((b[0] - a[0], b[1] - a[1]))
        across = (-along[1], along[0])
        back = mixed(b, (-head, along))
        self.line(a, back, colour=colour, width=width, dash=dash)
        wings = mixed(back, (head * 0.4, across)), mixed(back, (-head * 0.4, across))
        self.parts.append(f'<polygon points="{points((b, *wings))}" fill="{colour}"/>')

    def dot(self, place, colour=INK, radius=4):
        self.parts.append(f'<circle cx="{place[0]:.1f}" cy="{place[1]:.1f}" r="{radius}" fill="{colour}"/>')

    def cross(self, place, colour=RUST, size=6):
        x, y = place
        self.line((x - size, y - size), (x + size, y + size), colour=colour, width=2.4)
        self.line((x - size, y + size), (x + size, y - size), colour=colour, width=2.4)

    def lamp(self, place, label):
        x, y = place
        for k in range(8):
            ray = direction(45 * k)
            self.line(mixed(place, (9, ray)), mixed(place, (14, ray)), width=1.4)
        self.parts.append(f'<circle cx="{x}" cy="{y}" r="6" fill="#ffd84d" stroke="{INK}"/>')
        self.text((x, y - 20), label, anchor="middle")

    def text(self, place, words, anchor="start", colour=INK, size=None, bold=False):
        extra = (f' font-size="{size}"' if size else "") + (' font-weight="bold"' if bold else "")
        words = words.replace("&", "&amp;").replace("<", "&lt;")
        self.parts.append(f'<text x="{place[0]:.1f}" y="{place[1]:.1f}" text-anchor="{anchor}" fill="{colour}"{extra}>'
                          f"{words}</text>")

    def ground(self, a, b, below=12):
        """A face seen from its edge: its line, hatched on the far side."""
        along = unit((b[0] - a[0], b[1] - a[1]))
        into = (-along[1], along[0])
        places = [mixed(a, (14 * k, along)) for k in range(1, int(math.hypot(b[0] - a[0], b[1] - a[1]) / 14))]
        dx, dy = mixed((0, 0), (below, into), (-below * 0.6, along))
        strokes = "".join(f"M{x:.0f} {y:.0f}l{dx:.0f} {dy:.0f}" for x, y in places)
        self.parts.append(f'<path d="{strokes}" stroke="{GREY}" fill="none"/>')
        self.line(a, b, width=2.4)

    def right_angle(self, corner, a, b, size=10):
        a, b = unit(a), unit(b)
        self.line(mixed(corner, (size, a)), mixed(corner, (size, a), (size, b)), mixed(corner, (size, b)), width=1.1)

    def arc(self, centre, start, end, radius):
        """From the angle start to end, in degrees, anticlockwise from the right."""
        turns = [start + (end - start) * k / 12 for k in range(13)]
        self.line(*[mixed(centre, (radius, direction(turn))) for turn in turns], width=1.1)

    def svg(self):
        return "\n".join(self.parts) + "\n</svg>\n"


def path_of(page, name):
    return os.path.join(FOLDER, f"{page}-{name}.svg")


def write_all(page, drawings):
    for name, draw in drawings.items():
        with open(path_of(page, name), "w", encoding="utf-8") as file:
            file.write(draw().svg())
