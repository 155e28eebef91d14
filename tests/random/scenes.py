"""Valid random scenes that use every feature of the format. The same seed gives the same scene. Half of them are
snapped to a coarse lattice, where rays meet edges, vertices and shadow edges exactly, faces share a plane or lie on one
another, and lights and cameras are in the planes of faces. To use a new key of the format, add it where its object is
made."""
import json
import math
import random


class Spelling:
    """Writes a value as JSON in one of the many ways that mean the same."""

    def __init__(self, rng):
        self.rng = rng
        self.line = rng.choice(["\n", "\r\n", " ", ""])
        self.blank = rng.choice(["", " ", "\t"])

    def number(self, value):
        if isinstance(value, int) and abs(value) < 1 << 50:
            return self.rng.choice([str(value), str(value), f"{value}.0", f"{value}e0", f"{value}.000E+00"])
        return self.rng.choice([repr(float(value)), repr(float(value)), f"{float(value):.17e}"])

    def string(self, value):
        if self.rng.random() < 0.1:
            return '"' + "".join(f"\\u{ord(c):04x}" if ord(c) < 0x10000 else c for c in value) + '"'
        return json.dumps(value, ensure_ascii=self.rng.random() < 0.5)

    def gap(self):
        return self.line + self.blank if self.rng.random() < 0.3 else self.blank

    def write(self, value):
        if isinstance(value, dict):
            members = [self.string(key) + self.gap() + ":" + self.gap() + self.write(item)
                       for key, item in value.items()]
            return "{" + self.gap() + ("," + self.gap()).join(members) + self.gap() + "}"
        if isinstance(value, (list, tuple)):
            return "[" + self.gap() + ("," + self.gap()).join(map(self.write, value)) + self.gap() + "]"
        return self.string(value) if isinstance(value, str) else self.number(value)


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def length(a):
    return math.sqrt(sum(x * x for x in a))


def combine(*terms):
    """The sum of factor * vector."""
    return [sum(factor * vector[i] for factor, vector in terms) for i in range(3)]


class Generator:
    def __init__(self, seed, name):
        self.rng = random.Random(seed)
        self.name = name # of the scene's files, without an ending
        self.files = {}
        self.snapped = self.rng.random() < 0.5
        self.extreme = self.rng.random() < 0.06 # numbers up to the format's limits, too large for a float's precision
        self.adaptive = False
        # two faces lie on one another, but list their vertices in another order: then t is equal but for rounding
        self.tied = False
        self.scale = self.rng.choice([1e-9, 1e-6, 1, 1e6, 1e9] if self.extreme
                                     else [1, 1, 1, 1, 1000, 0.125, 1e-3, 7.3e4])
        self.offset = [0, 0, 0]
        if self.chance(0.15):
            self.offset = [self.scale * self.rng.choice([1e3, -1e5, 1e6]) for _ in range(3)]

    # --- Numbers ---

    def chance(self, p):
        return self.rng.random() < p

    def power(self, low, high):
        """Any order of magnitude from 10^low to 10^high."""
        return 10 ** self.rng.uniform(low, high)

    def coordinate(self, size=3.0):
        if self.snapped:
            if self.chance(0.3):
                return self.rng.randint(-int(4 * size), int(4 * size)) / 4
            return self.rng.randint(-int(size), int(size))
        return self.rng.uniform(-size, size)

    def vector(self, size=3.0):
        return [self.coordinate(size) for _ in range(3)]

    def edge(self, size):
        """A vector that is long enough to be a side."""
        while True:
            v = self.vector(size)
            if length(v) > 0.2:
                return v

    def place(self, v):
        """A point of the scene's unit world as it stands in the file."""
        placed = [self.offset[i] + self.scale * v[i] for i in range(3)]
        return [int(x) if x == int(x) and abs(x) < 1e9 and self.chance(0.7) else x for x in placed]

    def sides(self, size=3.0):
        """Two vectors that are not nearly parallel."""
        while True:
            a, b = self.edge(size), self.edge(size)
            if length(cross(a, b)) > 0.1 * length(a) * length(b):
                return a, b

    def colour(self, most=1.0):
        if self.extreme and self.chance(0.3):
            return [self.rng.choice([0, 1e18, self.power(-320, -300), self.power(-18, 18)]) for _ in range(3)]
        if self.chance(0.2):
            return [self.rng.choice([0, most, most / 2])] * 3
        return [self.rng.choice([0, 1, round(self.rng.uniform(0, most), 2), self.rng.uniform(0, most)])
                for _ in range(3)]

    def word(self):
        words = ["pink", "a", "wall", "light grey", "é", "日本", "\"quoted\"", "\\", "x/y", "\U0001f600", ""]
        return self.rng.choice(words) + str(self.rng.randint(0, 99))

    def commented(self, members):
        """The members with a comment now and then, in any order."""
        if self.chance(0.05):
            members["//"] = self.rng.choice(["a comment", ["of two", "lines é"], []])
        keys = list(members)
        if self.chance(0.3):
            self.rng.shuffle(keys)
        return {key: members[key] for key in keys}

    # --- What stands in a scene ---

    def camera(self):
        while True:
            position, look_at = self.rng.choice([self.vector(3), [0, 0, 5], self.vector(6)]), self.vector(1)
            view, up = combine((1, look_at), (-1, position)), self.rng.choice([None, None, self.vector(2), [0, 0, 1]])
            used = up or [0, 1, 0]
            if length(view) > 0.1 and length(cross(view, used)) > 0.01 * length(view) * length(used) > 0:
                break
        self.eye = position
        camera = {"position": self.place(position), "look_at": self.place(look_at)}
        return self.commented(camera | ({"up": up} if up else {}))

    def screen(self):
        columns, rows = self.rng.choice([(24, 18), (24, 18), (16, 16), (31, 17), (1, 40), (40, 1), (7, 5), (33, 9),
                                         (3, 150), (61, 47)])
        screen = {"columns": columns, "rows": rows, "width": self.rng.choice([0.5, 1])}
        for key in ("distance", "width", "height"):
            if self.chance(0.3):
                screen[key] = self.power(-12, 12) if self.extreme else self.rng.choice([1, 2, self.rng.uniform(0.5, 3)])
        return self.commented(screen)

    def light(self):
        near_eye = combine((1, self.eye), (1, self.vector(1)))
        position = self.rng.choice([self.vector(5), self.vector(3), near_eye, near_eye, self.eye])
        light = {"position": self.place(position)}
        for key in ("ambient", "diffuse", "specular"):
            if self.chance(0.3):
                light[key] = self.colour(self.rng.choice([1, 0.3, 2]))
        return self.commented(light)

    def material(self):
        material = {}
        for key in ("ambient", "diffuse", "specular"):
            if self.chance(0.8):
                material[key] = self.colour(0.3 if key == "ambient" else 1.0)
        if self.chance(0.6):
            material["shininess"] = self.rng.choice([0, 1, 2, 4, 10, 50, 200, self.rng.uniform(0, 300)])
            if self.extreme:
                material["shininess"] = self.power(-300, 18)
        if self.chance(0.5):
            material["reflection"] = self.rng.choice([0, 0.5, 1, self.rng.random()])
        return self.commented(material)

    def corners(self):
        """A convex planar quad, or a triangle."""
        a, b = self.sides()
        corner = self.vector()
        if self.chance(0.3):
            return [corner, combine((1, corner), (1, a)), combine((1, corner), (1, b))]
        s, t = self.rng.choice([(1, 1), (1, 1), (0.5, 1), (0.75, 0.75), (2, 1)])
        return [corner, combine((1, corner), (1, a)), combine((1, corner), (s, a), (t, b)),
                combine((1, corner), (1, b))]

    def mesh_of_faces(self):
        """Faces that have nothing to do with one another, or lie on one another."""
        vertices, faces = [], []
        for _ in range(self.rng.choice([1, 1, 2, 4])):
            corners = self.corners()
            copies = 2 if self.chance(0.1) else 1
            self.tied = self.tied or copies == 2
            for _ in range(copies):
                order = [len(vertices) + i for i in range(len(corners))]
                vertices += corners
                turn = self.rng.randrange(len(order))
                order = order[turn:] + order[:turn]
                faces.append(order[::-1] if self.chance(0.3) else order)
        return vertices, faces

    def mesh_of_sheet(self):
        """A sheet of quads or triangles that share their edges; flat."""
        a, b = self.sides()
        corner = self.vector()
        n, m = (self.rng.randint(5, 20) if self.chance(0.1) else self.rng.randint(1, 4) for _ in range(2))
        vertices = [combine((1, corner), (i / n, a), (j / m, b)) for j in range(m + 1) for i in range(n + 1)]
        faces = []
        for j in range(m):
            for i in range(n):
                p = j * (n + 1) + i
                quad = [p, p + 1, p + n + 2, p + n + 1]
                faces += [quad] if self.chance(0.7) else [[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]]
        return vertices, faces

    def mesh_of_twisted(self):
        """A quad that may be far from planar, for "split"."""
        a, b = self.sides()
        corner, lift = self.vector(), self.rng.choice([0, 0.25, 1])
        normal = cross(a, b)
        raised = combine((1, corner), (1, b), (lift / length(normal), normal))
        return [corner, combine((1, corner), (1, a)), combine((1, corner), (1, a), (1, b)), raised], [[0, 1, 2, 3]]

    def mesh_of_polygons(self):
        """Planar polygons around a middle, most of them concave; some with a corner that has no area, or is none."""
        vertices, faces = [], []
        for _ in range(self.rng.choice([1, 1, 2])):
            a, b = self.sides()
            corner, count = self.vector(), self.rng.choice([4, 5, 5, 6, 7, 9, 12, 20])
            ring = []
            for i in range(count):
                angle, radius = 2 * math.pi * i / count, self.rng.choice([1, 1, 0.6, self.rng.uniform(0.2, 1)])
                ring.append(combine((1, corner), (radius * math.cos(angle), a), (radius * math.sin(angle), b)))
            order = [len(vertices) + i for i in range(count)]
            vertices += ring
            if self.chance(0.2):
                order.insert(2, order[1])
            faces.append(order[::-1] if self.chance(0.3) else order)
        return vertices, faces

    def transform(self):
        steps = []
        for _ in range(self.rng.choice([0, 0, 1, 1, 2, 3])):
            factor = lambda: self.rng.choice([1, 2, 0.5, -1, self.rng.uniform(0.3, 2), -self.rng.uniform(0.3, 2)])
            axis = self.rng.choice([[0, 1, 0], [1, 0, 0], [0, 0, -2], [1, 1, 1], self.edge(1)])
            degrees = self.rng.choice([90, 180, -270, 45, 30, self.rng.uniform(-360, 360)])
            steps.append(self.commented(self.rng.choice([
                {"scale": factor()}, {"scale": [factor(), factor(), factor()]},
                {"rotate": {"axis": axis, "degrees": degrees}}, {"translate": self.vector(2)}])))
        return steps

    def model(self, vertices, faces, own_material):
        """Writes an OBJ and its library; the names of some materials are nowhere, where the object has one of its
        own."""
        names = list(self.materials) + ["brick", "glass bead"] + (["nowhere"] if own_material else [])
        names = [name for name in names if name.strip() == name and name]
        lines, end = ["# a model"], self.rng.choice(["\n", "\r\n"])
        lines.append(f"mtllib {self.name}.mtl")
        for v in vertices:
            weight = self.rng.choice(["", "", " 1", " 0.5 0.5 0.5"])
            lines.append("v " + " ".join(repr(float(x)) if self.chance(0.5) else f"{x:.17g}" for x in v) + weight)
        lines += ["vt 0 0", "vn 0 0 1", "g part", "s off"]
        if not own_material or self.chance(0.8):
            lines.append(f"usemtl {self.rng.choice(names)}")
        for face in faces:
            if self.chance(0.3):
                lines.append(f"usemtl {self.rng.choice(names)}")
            form = self.rng.choice(["{}", "{}/1", "{}//1", "{}/1/1"])
            back = self.chance(0.3)
            lines.append("f " + " ".join(form.format(i - len(vertices) if back else i + 1) for i in face))
        self.files[self.name + ".obj"] = end.join(lines) + (end if self.chance(0.8) else "")
        self.files[self.name + ".mtl"] = end.join([
            "newmtl brick", "Ka 0.1 0.05 0", "Kd 0.7 0.3 0.1", "newmtl glass bead", "Kd 0.1 0.1 0.1", "Ks 1 1 1",
            "Ns 120", "d 1"])

    def room(self):
        """Walls around all, or a floor below; the camera may be in one."""
        r = self.rng.choice([6, 6, 3, self.rng.uniform(3, 7)])
        thing = {"material": self.rng.choice(list(self.materials))}
        if self.chance(0.5):
            thing["box"] = {"min": self.place([-r, -r, -r]), "max": self.place([r, r, r])}
        else:
            thing["vertices"] = [self.place([x, -1, z]) for x, z in ((-r, -r), (-r, r), (r, r), (r, -r))]
            thing["faces"] = [[0, 1, 2, 3]]
        return thing

    def object(self):
        thing = {"name": self.word()} if self.chance(0.5) else {}
        steps = self.transform()
        kind = self.rng.choice(["box", "box", "faces", "faces", "sheet", "twisted", "polygons", "obj"])
        names = list(self.materials)
        own_material = kind in ("box", "twisted") or self.chance(0.7)
        if own_material:
            thing["material"] = self.rng.choice(names)
        if kind == "box":
            low = self.vector(2)
            size = [abs(x) or 1 for x in self.edge(2)]
            thing["box"] = {"min": low, "max": combine((1, low), (1, [max(s, 0.1) for s in size]))}
        else:
            vertices, faces = {"faces": self.mesh_of_faces, "sheet": self.mesh_of_sheet,
                               "twisted": self.mesh_of_twisted, "polygons": self.mesh_of_polygons,
                               "obj": self.rng.choice([self.mesh_of_faces, self.mesh_of_sheet,
                                                       self.mesh_of_polygons])}[kind]()
            if kind == "obj" and self.name + ".obj" not in self.files:
                self.model(vertices, faces, own_material)
                thing["obj"] = self.name + ".obj"
            else:
                with_material = lambda face: self.commented({"vertices": face, "material": self.rng.choice(names)})
                thing["vertices"] = vertices + ([self.vector()] if self.chance(0.1) else [])
                thing["faces"] = [with_material(f) if not own_material or self.chance(0.2) else f for f in faces]
            if kind in ("twisted", "polygons") or self.chance(0.1):
                thing["nonplanar"] = "split"
            if kind == "polygons" or (kind == "obj" and "obj" not in thing):
                thing["degenerate"] = "skip"
        if self.chance(0.25):
            thing["sided"] = self.rng.choice(["front", "front", "both"])
        if self.scale != 1:
            steps.append({"scale": self.scale})
        if any(self.offset):
            steps.append({"translate": self.offset})
        if steps or self.chance(0.1):
            thing["transform"] = steps
        return self.commented(thing)

    def shading(self):
        shading = {}
        for key, choices in (("shadow", ["black", "ambient"]), ("viewer", ["camera", "ray"]),
                             ("max_bounces", [0, 1, 2, 5, 8, 64])):
            if self.chance(0.6):
                shading[key] = self.rng.choice(choices)
        if self.chance(0.4):
            shading["background"] = self.colour()
        return self.commented(shading)

    def keys(self, first, others):
        """Keys of a track that begins with the values `first`."""
        frames = sorted(self.rng.sample(range(0, 40), 1 + len(others)))
        keys = [{"frame": frame} | values for frame, values in zip(frames, [first] + others)]
        for key in keys:
            if self.chance(0.3):
                key["interpolation"] = self.rng.choice(["linear", "smooth"])
        return [self.commented(key) for key in keys]

    def moved(self, step):
        """A step of the same kind, by another number."""
        if "rotate" not in step:
            return step
        return {"rotate": step["rotate"] | {"degrees": self.rng.choice([0, 90, 360, self.rng.uniform(-700, 700)])}}

    def animation(self, scene):
        """Frame 0 is the scene as it stands."""
        animation = {"frames": self.rng.choice([1, 2, 24, 1000000])}
        if self.chance(0.5):
            animation["fps"] = self.rng.choice([1, 25, 29.97])
        if self.chance(0.5):
            animation["interpolation"] = self.rng.choice(["linear", "smooth"])
        orbit = {"centre": self.place(self.vector()), "degrees": self.rng.choice([360, -90, self.rng.uniform(0, 720)])}
        if self.chance(0.3):
            orbit["axis"] = self.edge(1)
        first = {key: value for key, value in scene["camera"].items() if key in ("position", "look_at")}
        camera = self.keys(first, [{key: self.place(self.vector(5)) for key in first} for _ in range(3)])
        animation["camera"] = self.rng.choice([camera, self.commented({"orbit": self.commented(orbit)})])
        lights = {str(i): self.keys({"position": light["position"]}, [{"position": self.place(self.vector(5))}])
                  for i, light in enumerate(scene.get("lights", [])) if self.chance(0.3)}
        objects, names = {}, [thing.get("name", f"objects[{i}]") for i, thing in enumerate(scene["objects"])]
        for name, thing in zip(names, scene["objects"]):
            steps = thing.get("transform", [])
            if names.count(name) == 1 and self.chance(0.3):
                objects[name] = self.keys({"transform": steps}, [{"transform": list(map(self.moved, steps))}])
        return self.commented(animation | {"lights": lights, "objects": objects})

    def scene(self):
        """The text of the scene file; `files` holds the models, by name."""
        scene = {"camera": self.camera(), "screen": self.screen()}
        lights = [self.light() for _ in range(self.rng.choice([0, 1, 1, 1, 2, 2, 2, 3, 6, 20]))]
        self.materials = {self.word(): self.material() for _ in range(self.rng.randint(1, 5))}
        objects = [self.object() for _ in range(self.rng.choice([0, 1, 3, 5, 8, 12]))]
        if self.chance(0.5):
            objects.insert(self.rng.randrange(len(objects) + 1), self.room())
        if lights or self.chance(0.5):
            scene["lights"] = lights
        scene["materials"] = self.commented(dict(self.materials))
        scene["objects"] = objects
        if self.chance(0.8):
            scene["shading"] = self.shading()
        if self.chance(0.3):
            how = self.rng.choice(["grid", "adaptive"])
            self.adaptive = how == "adaptive"
            scene["sampling"] = {how: self.rng.choice([1, 2, 3, 4])}
        if self.chance(0.2):
            scene["animation"] = self.animation(scene)
        return Spelling(self.rng).write(self.commented(scene))
