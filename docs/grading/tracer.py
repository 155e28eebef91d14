"""A ray tracer in plain Python, the example of grading.md: the formulas of algorithm.md as they stand. The numbers are
those of its steps. It reads scenes of faces and boxes, without models and transforms, and casts one ray a pixel.
Usage: tracer.py SCENE COLUMN ROW >mine.json    or    tracer.py SCENE >mine.ppm"""
import json
import math
import sys

SHIFT = 1e-9  # how far a point is moved off its face
BOX = [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]  # -x, +x, -y, ...
NO_COLOURS = {"ambient": [0, 0, 0], "diffuse": [0, 0, 0], "specular": [0, 0, 0], "shininess": 0, "reflection": 0}

def add(a, b): return [x + y for x, y in zip(a, b)]
def sub(a, b): return [x - y for x, y in zip(a, b)]
def mul(a, b): return [x * y for x, y in zip(a, b)]
def scale(s, a): return [s * x for x in a]
def dot(a, b): return sum(x * y for x, y in zip(a, b))
def cross(a, b): return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]
def unit(a): return scale(1 / (math.sqrt(dot(a, a)) or 1), a)

def read_faces(scene):  # 2: of each face its name, vertices, unit normal N, material, and whether it has one side
    faces = []
    for index, thing in enumerate(scene.get("objects", [])):
        v, name = thing.get("vertices"), thing.get("name", f"objects[{index}]")
        if "box" in thing:
            ends = thing["box"]["min"], thing["box"]["max"]
            v = [[ends[k >> axis & 1][axis] for axis in range(3)] for k in range(8)]
        for k, entry in enumerate(thing.get("faces", BOX)):
            entry = entry if isinstance(entry, dict) else {"vertices": entry}
            corners = [v[i] for i in entry["vertices"]]
            a, b = sub(corners[2], corners[0]), sub(corners[3 % len(corners)], corners[1])
            material = {**NO_COLOURS, **scene["materials"][entry.get("material", thing.get("material"))]}
            faces.append((f"{name}/{k}", corners, unit(cross(a, b)), material, thing.get("sided") == "front"))
    return faces

def primary_ray(scene, column, row):  # 1
    camera, screen = scene["camera"], {"distance": 1, "width": 2, **scene["screen"]}
    columns, rows, width = screen["columns"], screen["rows"], screen["width"]
    height = screen.get("height", width * rows / columns)
    f = unit(sub(camera["look_at"], camera["position"]))
    r = unit(cross(f, camera.get("up", [0, 1, 0])))
    u = cross(r, f)
    x = ((column + 0.5) / columns - 0.5) * width
    y = (0.5 - (row + 0.5) / rows) * height
    return camera["position"], add(add(scale(screen["distance"], f), scale(x, r)), scale(y, u))

def hit_face(face, o, r):  # 3 and 4: t, or None
    _, v, n, _, one_sided = face
    n_r = dot(n, r)
    if n_r == 0 or (one_sided and n_r > 0):
        return None
    t = -dot(n, sub(o, v[0])) / n_r
    if t <= 0:
        return None
    p = add(o, scale(t, r))
    for k in range(len(v)):
        e, c = sub(v[(k + 1) % len(v)], v[k]), sub(p, v[k])
        if dot(n, cross(e, c)) < 0:
            return None
    return t

def nearest(faces, o, r):  # 5
    hits = [(hit_face(face, o, r), k) for k, face in enumerate(faces)]
    return min([(t, k) for t, k in hits if t is not None], default=(None, None))

def light_verdict(faces, light, n, p, start):  # 6
    if dot(n, sub(light["position"], p)) <= 0:
        return "behind face"
    ts = [hit_face(face, start, sub(light["position"], start)) for face in faces]
    return "blocked" if any(t is not None and t < 1 for t in ts) else "reaches"

def illuminate(material, light, n, l, v, reaches):  # 7 and 8
    h = unit(add(l, v))
    s = max(0, dot(n, h)) ** (material["shininess"] / 4)
    ambient = mul(material["ambient"], light["ambient"])
    diffuse = scale(max(0, dot(l, n)), mul(material["diffuse"], light["diffuse"]))
    specular = scale(s, mul(material["specular"], light["specular"]))
    return add(add(ambient, diffuse), specular) if reaches else ambient

def trace(scene, faces, o, r):  # 3 to 9
    rules = {"shadow": "black", "viewer": "camera", "max_bounces": 5, "background": [0, 0, 0],
             **scene.get("shading", {})}
    lights = [{"ambient": [1, 1, 1], "diffuse": [1, 1, 1], "specular": [1, 1, 1], **light} for light in scene["lights"]]
    eye, colour, weight, hits = o, [0, 0, 0], 1, []
    for bounces in range(rules["max_bounces"] + 1):
        t, k = nearest(faces, o, r)
        if t is None:
            seen = scale(weight, rules["background"])
            return {"hits": hits, "background": {"contribution": seen}, "colour": add(colour, seen)}
        name, _, n, material, _ = faces[k]
        p = add(o, scale(t, r))
        n = scale(-1, n) if dot(n, r) > 0 else n
        start, r1 = add(p, scale(SHIFT, n)), unit(r)
        v = scale(-1, r1) if rules["viewer"] == "ray" else unit(sub(eye, p))
        verdicts = [light_verdict(faces, light, n, p, start) for light in lights]
        i = [0, 0, 0]
        for light, verdict in zip(lights, verdicts):
            if verdict == "reaches" or rules["shadow"] == "ambient":
                l = unit(sub(light["position"], p))
                i = add(i, illuminate(material, light, n, l, v, verdict == "reaches"))
        colour = add(colour, scale(weight, i))
        hits.append({"face": name, "t": t, "contribution": scale(weight, i),
                     "lights": [{"light": k, "verdict": verdict} for k, verdict in enumerate(verdicts)]})
        if (rules["shadow"] == "black" and "reaches" not in verdicts) or material["reflection"] == 0:
            break
        o, r = start, sub(r1, scale(2 * dot(r1, n), n))
        weight *= material["reflection"]
    return {"hits": hits, "colour": colour}

def pixel(scene, faces, column, row):  # 10
    answer = trace(scene, faces, *primary_ray(scene, column, row))
    return {**answer, "rgb": [math.floor(255 * min(max(c, 0), 1) + 0.5) for c in answer["colour"]]}

SCENE = json.load(open(sys.argv[1], encoding="utf-8"))
FACES, COLUMNS, ROWS = read_faces(SCENE), SCENE["screen"]["columns"], SCENE["screen"]["rows"]
if len(sys.argv) > 3:
    AT = {"column": int(sys.argv[2]), "row": int(sys.argv[3])}
    print(json.dumps({"pixel": AT, "summary": pixel(SCENE, FACES, **AT)}))
else:
    PIXELS = [pixel(SCENE, FACES, column, row)["rgb"] for row in range(ROWS) for column in range(COLUMNS)]
    sys.stdout.buffer.write(b"P6 %d %d 255\n" % (COLUMNS, ROWS) + bytes(byte for rgb in PIXELS for byte in rgb))
