"""What the tests of exercise 10 are called, their input, and the formulas that a student is told."""
SCENE = "scenes/cornell.json"

TITLES = {
    "primary_ray": "Function 1: rays from the camera",
    "nearest_hit": "Function 2: the nearest face",
    "place_hit": "Function 3: the point and its normal",
    "is_blocked": "Function 4: what stands before a light",
    "illuminate": "Function 5: the light of a lamp",
    "trace_path": "Function 6: paths",
    "gallery": "A scene with mirrors and shadows that keep ambient light",
    "original": "A scene with black shadows",
    "viewer_camera": "A scene where V points to the camera, also in a mirror",
    "no_bounces": "A mirror in a scene that allows no reflected ray",
    "store_pixel": "Function 7: bytes",
    "picture": "The picture of scenes/cornell.json",
}

# The numbers of each case: mostly a pixel's column and row, then what checks.cl makes of the others.
CASES = {
    "primary_ray": [(0, 0, 0, 0), (47, 39, 1, 1), (20, 10, 1, 0), (30, 22, 0, 1)],
    "nearest_hit": [(24, 20), (4, 20), (15, 31), (30, 34), (24, 20, 1), (24, 4)],
    "place_hit": [(24, 20), (15, 31), (4, 20, 1), (30, 34, 1)],
    "is_blocked": [(24, 36, 0), (14, 34, 0), (10, 32, 3), (12, 36, 4), (12, 36, 1), (4, 20, 1)],
    "illuminate": [(15, 31, 1, 3, 1), (24, 36, 0, 2, 1), (15, 31, 2, 1, 0), (15, 31, 1, -1, 1), (15, 31, -1, 2, 1)],
    "trace_path": [(24, 36), (4, 20), (15, 31), (14, 26), (17, 29), (30, 34), (24, 4), (14, 34)],
}

COORDINATES = "xyz"
COLOURS = ("red", "green", "blue")


def vector_of(slot, name, parts=COORDINATES):
    return [(slot, k, f"{name}.{parts[k]}") for k in range(3)]


VALUES = {
    "primary_ray": [*vector_of(0, "direction"), *vector_of(1, "origin"), (2, 0, "from")],
    "nearest_hit": [(0, 0, "face, by its number in the file"), (1, 0, "t")],
    "place_hit": [*vector_of(0, "hit->point"), *vector_of(1, "hit->normal"),
                  *vector_of(2, "(hit->shifted - hit->point) / shift")],
    "is_blocked": [(0, 0, "the answer, 1 for true")],
    "illuminate": [(0, k, COLOURS[k]) for k in range(3)],
    "trace_path": [(0, k, COLOURS[k]) for k in range(3)],
}


def text(vector):
    return "(" + ", ".join(f"{value:.6g}" for value in vector) + ")"


def given(test, case, went_in):
    """[(name, value)]: what the function was called with."""
    if test == "primary_ray":
        return [(name, str(value)) for name, value in zip(("column", "row", "i", "j"), case)]
    if test in ("nearest_hit", "trace_path"):
        return [("origin", text(went_in[0])), ("direction", text(went_in[1]))]
    if test == "place_hit":
        return [("O", text(went_in[0])), ("R", text(went_in[1])), ("hit->t", f"{went_in[2][0]:.6g}"),
                ("N", text(went_in[3])), ("from_behind", "true" if len(case) > 2 and case[2] else "false")]
    if test == "is_blocked":
        return [("shifted", text(went_in[0])), ("light", text(went_in[1]))]
    return [("n", "(0, 1, 0)"), ("l", text(went_in[0])), ("v", text(went_in[1])),
            ("alpha/4", f"{went_in[2][0]:.6g}"), ("ks", text(went_in[3])), ("reaches", "true" if case[4] else "false")]


def formula(test, case, went_in, expected):
    """The formula with its numbers."""
    if test == "primary_ray":
        column, row, i, j = case
        return (f"R = forward + x right + y up = {text(expected[0])} with "
                f"x = (({column} + ({i} + 0.5)/2)/48 - 0.5) width, y = (0.5 - ({row} + ({j} + 0.5)/2)/40) height; "
                "O = eye; from = -1")
    if test == "nearest_hit":
        return ("no face is hit: face -1" if expected[0][0] < 0 else
                f"of the faces that the ray hits the smallest t is {expected[1][0]:.6g}, that of face "
                f"{expected[0][0]:.0f}")
    if test == "place_hit":
        turned = "-N" if len(case) > 2 and case[2] else "N"
        return (f"P = O + t R = {text(went_in[0])} + {went_in[2][0]:.6g} {text(went_in[1])} = {text(expected[0])}; "
                f"normal = {turned} = {text(expected[1])}; shifted = P + shift normal")
    if test == "is_blocked":
        way = f"on the way {text(went_in[0])} + t L"
        return (f"{'a' if expected[0][0] else 'no'} face is met at 0 < t < 1 {way}, where "
                f"L = light - shifted = {text([b - a for a, b in zip(went_in[0], went_in[1])])}")
    if test == "illuminate":
        return illumination(case, went_in, expected)
    return f"the sum of the path, as its walkthrough has it, is {text(expected[0])}"


def illumination(case, went_in, expected):
    if not case[4]:
        return f"the light does not reach the point: ka ia = {text(expected[0])}"
    light, viewer = went_in[0], went_in[1]
    sums = [a + b for a, b in zip(light, viewer)]
    length = sum(value * value for value in sums) ** 0.5
    l_dot_n, n_dot_h = max(light[1], 0), max(sums[1] / length, 0)
    return (f"ka ia + kd id (L.N) + ks is (N.H)^(alpha/4) with L.N = {l_dot_n:.6g}, N.H = {n_dot_h:.6g}, "
            f"(N.H)^{went_in[2][0]:.6g} = {n_dot_h ** went_in[2][0]:.6g}; sum {text(expected[0])}")
