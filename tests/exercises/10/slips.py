"""Likely slips of exercise 10: our kernel with a piece of it changed. To add one: the test that is to recognise it,
what stands in kernels/plain.cl, what a careless hand writes for it, and what the student is told."""
from pathlib import Path

OURS = (Path(__file__).resolve().parent.parent.parent.parent / "kernels" / "plain.cl").read_text(encoding="utf-8")

X = "((column + (i + (wide)0.5f) / p->grid) / p->columns - (wide)0.5f) * size.x"
Y = "((wide)0.5f - (row + (j + (wide)0.5f) / p->grid) / p->rows) * size.y"
R = "forward + x * right + y * up"
NEAREST = "ray, &hit) && is_nearer(scene, &hit, &nearest))"
SHADOW = "{hit->shifted, light - hit->shifted, hit->face}"
MIRRORED = "r - 2 * vec3_dot(r, hit.normal) * hit.normal"
BYTE = "(uchar)floor(255 * clamp(rgb[i], (real)0, (real)1) + (real)0.5f)"

CHANGES = [
    ("primary_ray", Y, Y.replace("((wide)0.5f - (row", "((row").replace("p->rows)", "p->rows - (wide)0.5f)"),
     "the picture is upside down: y is largest in row 0"),
    ("primary_ray", "(wide)0.5f) / p->grid", "(wide)0) / p->grid",
     "the ray goes through the corner of the sub-pixel: + 0.5 is missing"),
    ("primary_ray", "/ p->grid)", "/ 1)", "i and j are not divided by the grid"),
    ("primary_ray", "primary_ray(const Scene *scene, int column, int row, int i, int j)",
     "primary_ray(const Scene *scene, int column, int row, int j, int i)",
     "i and j are exchanged: i goes with the column"),
    ("primary_ray", R, "eye + " + R, "the direction is the point Q of the screen, not R = Q - C"),
    ("primary_ray", ") * size.x", ")", "x is not multiplied by the screen's width"),
    ("primary_ray", R, f"unit_or_zero({R})", "the direction is made a unit vector: R reaches the screen at t = 1"),

    ("nearest_hit", NEAREST, "ray, &hit))", "every hit replaces the one before, whether it is nearer or not"),
    ("nearest_hit", NEAREST, "ray, &hit) && !is_nearer(scene, &hit, &nearest))",
     "the farthest hit is kept: is_nearer is asked the wrong way round"),
    ("nearest_hit", "is_nearer(scene, &hit, &nearest))\n                nearest = hit;",
     "is_nearer(scene, &hit, &nearest))\n                return hit;", "the first hit is given back, not the nearest"),
    ("nearest_hit", "face_in_leaf(scene, i), ray, &hit) &&", "face_in_leaf(scene, i), ray, &nearest) &&",
     "the test writes into `nearest` itself, also for faces that are not hit"),

    ("place_hit", "hit->from_behind ? -n : n", "n", "the normal is not turned where the ray came from behind"),
    ("place_hit", "hit->from_behind ? -n : n", "hit->from_behind ? n : -n", "the normal is turned the wrong way round"),
    ("place_hit", "hit->t * ray.direction", "hit->t * unit_or_zero(ray.direction)",
     "the direction is made a unit vector: t is measured in lengths of R"),
    ("place_hit", "hit->normal = hit->from_behind ? -n : n;\n    hit->shifted = point_shifted(scene, hit);",
     "hit->normal = n;\n    hit->shifted = point_shifted(scene, hit);\n    hit->normal = hit->from_behind ? -n : n;",
     "the point is shifted before the normal is turned"),
    ("place_hit", "hit->shifted = point_shifted(scene, hit)", "hit->shifted = hit->point",
     "the point is shifted before there is a normal, or not at all"),

    ("is_blocked", SHADOW, "{hit->shifted, light, hit->face}",
     "the ray's direction is the light's position, not the way to it: L = light - shifted"),
    ("is_blocked", SHADOW, "{hit->shifted, hit->shifted - light, hit->face}",
     "the ray goes away from the light: light - shifted, not shifted - light"),
    ("is_blocked", SHADOW, "{hit->shifted, unit_or_zero(light - hit->shifted), hit->face}",
     "the direction is made a unit vector: then the light is not at t = 1, and only faces nearer than 1 are before it"),
    ("is_blocked",
     "if (face_blocks(scene, face_in_leaf(scene, i), ray, light))\n                return true;\n    return "
     "false;",
     "if (face_blocks(scene, face_in_leaf(scene, i), ray, light))\n                return false;\n    return true;",
     "the answer is the wrong way round"),

    ("illuminate", "unit_or_zero(l + v)", "unit_or_zero(l - v)", "H = unit(L - V): it is halfway between, L + V"),
    ("illuminate", "unit_or_zero(l + v)", "(l + v)", "H is not made a unit vector"),
    ("illuminate", "+ l_dot_n * diffuse", "+ diffuse", "the cosine L.N is missing"),
    ("illuminate", "at_least_zero(vec3_dot(l, n))", "(real)vec3_dot(l, n)", "a negative L.N is not cut to 0"),
    ("illuminate", "material[MATERIAL_EXPONENT]", "(material[MATERIAL_EXPONENT] / 4)",
     "the exponent is divided by 4 once more: MATERIAL_EXPONENT is alpha/4 already"),
    ("illuminate", "    if (!reaches)\n        return ambient;\n", "",
     "diffuse and specular terms are added where the light does not reach the point"),
    ("illuminate", "        return ambient;\n", "        return (real3)0;\n",
     "ka ia is left out where the light does not reach"),
    ("illuminate", "vload3(0, material + MATERIAL_AMBIENT) * vload3(0, light + LIGHT_AMBIENT)",
     "vload3(0, material + MATERIAL_AMBIENT)", "the ambient term lacks the light's colour ia"),

    ("trace_path", MIRRORED, "r - vec3_dot(r, hit.normal) * hit.normal",
     "R - (R.N) N glides along the face: it is 2 (R.N) N"),
    ("trace_path", MIRRORED, "r + 2 * vec3_dot(r, hit.normal) * hit.normal",
     "the mirrored ray has a wrong sign: R - 2 (R.N) N"),
    ("gallery", "weight *= reflection", "weight = reflection",
     "the weight is the last mirror's reflection alone, not the product of all"),
    ("trace_path", "total += weight * shade(", "total += shade(", "the illumination is not weighted"),
    ("trace_path", "total += weight * shade(", "total = weight * shade(", "the sum begins anew at each hit"),
    ("gallery", "(reaching == 0 && !p->shadow_ambient)", "reaching == 0",
     "the path ends where no light reaches the hit, although the scene keeps ambient light in shadow"),
    ("gallery", "p->viewer_ray ? -r", "p->viewer_ray ? r", "V points along the ray, away from the viewer"),
    ("trace_path", "        place_hit(scene, ray, &hit);\n", "", "place_hit is not called: the hit has no point"),
    ("gallery", "r = unit_or_zero(ray.direction)", "r = ray.direction", "R is not made a unit vector"),
    ("trace_path", "ray = (Ray){hit.shifted,", "ray = (Ray){hit.point,",
     "the mirrored ray starts at the point, not at the shifted point"),

    ("store_pixel", BYTE, "(uchar)(255 * clamp(rgb[i], (real)0, (real)1))",
     "the number is cut off, not rounded: + 0.5 is missing"),
    ("store_pixel", BYTE, "(uchar)(255 * rgb[i] + (real)0.5f)", "the number is not cut to 0 .. 1"),
    ("store_pixel", BYTE, "(uchar)(256 * clamp(rgb[i], (real)0, (real)1))",
     "it is multiplied by 256: 1 then becomes 0"),
    ("store_pixel", "picture[3 * place + i] = (uchar)", "picture[3 * place + 2 - i] = (uchar)",
     "red and blue are exchanged"),

    ("viewer_camera", "unit_or_zero(eye - hit.point)", "-r",
     "V is -R, although the scene says that it points to the camera"),
    ("original", "(reaching == 0 && !p->shadow_ambient) || ", "",
     "the path goes on where no light reaches the hit and shadows are black"),
    ("no_bounces", "bounces == p->max_bounces", "bounces > p->max_bounces",
     "there is one mirror too many: the count is asked too late"),
    ("gallery", "return total + weight * vload3(", "return total + vload3(",
     "the background is not weighted by the mirrors before it"),
    ("trace_path", "return total + weight * vload3(", "return weight * vload3(",
     "what the hits before the background added is forgotten"),
]

for _, before, _, _ in CHANGES:
    assert before in OURS, f"kernels/plain.cl has changed: {before}"

# (test, the changed kernel, what the student is told)
SLIPS = [(test, OURS.replace(before, after), meaning) for test, before, after, meaning in CHANGES]
