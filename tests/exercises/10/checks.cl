/* The tests of exercise 10, a function for each: calls one function of a kernel with known numbers. check.py takes this
 * text once for the student's functions and once for ours, and puts WHO_ before their names. `out` gets what came out,
 * `in` what went in. The numbers leave the device as colours of a picture. */

enum { VALUES = 4 };

/* The primary ray of a pixel, by ours: the input of other tests. */
static Ray ray_of(const Scene *scene, int column, int row) { return our_primary_ray(scene, column, row, 0, 0); }

static Hit hit_of(Scene *scene, int column, int row)
{
    Ray ray = ray_of(scene, column, row);
    Hit hit = our_nearest_hit(scene, ray);
    our_place_hit(scene, ray, &hit);
    return hit;
}

static real3 real3_of(wide3 a) { return (real3)((real)a.x, (real)a.y, (real)a.z); }

static int index_of(const Scene *scene, int face) { return face < 0 ? -1 : (int)scene->faces[face].index; }

/* BEGIN primary_ray */
static void WHO_check_primary_ray(Scene *scene, const int *number, real3 *in, real3 *out)
{
    Ray ray = WHO_primary_ray(scene, number[0], number[1], number[2], number[3]);
    out[0] = real3_of(ray.direction);
    out[1] = real3_of(ray.origin);
    out[2] = (real3)(ray.from);
}
/* END */
/* BEGIN nearest_hit */
static void WHO_check_nearest_hit(Scene *scene, const int *number, real3 *in, real3 *out)
{
    Ray ray = ray_of(scene, number[0], number[1]);
    ray.direction = number[2] ? -ray.direction : ray.direction;
    Hit hit = WHO_nearest_hit(scene, ray);
    bool found = hit.face >= 0 && hit.face < scene->parameters->face_count;
    in[0] = real3_of(ray.origin);
    in[1] = real3_of(ray.direction);
    out[0] = (real3)(found ? index_of(scene, hit.face) : hit.face);
    out[1] = (real3)(found ? (real)hit.t : 0);
}
/* END */
/* BEGIN place_hit */
static void WHO_check_place_hit(Scene *scene, const int *number, real3 *in, real3 *out)
{
    Ray ray = ray_of(scene, number[0], number[1]);
    Hit hit = our_nearest_hit(scene, ray);
    hit.from_behind = number[2];
    in[0] = real3_of(ray.origin);
    in[1] = real3_of(ray.direction);
    in[2] = (real3)((real)hit.t);
    in[3] = real3_of(face_normal(scene, hit.face));
    WHO_place_hit(scene, ray, &hit);
    out[0] = real3_of(hit.point);
    out[1] = real3_of(hit.normal);
    out[2] = real3_of((hit.shifted - hit.point) / scene->parameters->shift);
}
/* END */
/* BEGIN is_blocked */
static void WHO_check_is_blocked(Scene *scene, const int *number, real3 *in, real3 *out)
{
    Hit hit = hit_of(scene, number[0], number[1]);
    global const real *light = scene->lights + number[2] * LIGHT_REALS;
    wide3 position = vector_at(light + LIGHT_POSITION, LIGHT_POSITION_LOW - LIGHT_POSITION);
    in[0] = real3_of(hit.shifted);
    in[1] = real3_of(position);
    out[0] = (real3)(WHO_is_blocked(scene, &hit, position));
}
/* END */
/* BEGIN illuminate */
static void WHO_check_illuminate(Scene *scene, const int *number, real3 *in, real3 *out)
{
    Hit hit = hit_of(scene, number[0], number[1]);
    wide3 n = (wide3)(0, 1, 0), l = unit_or_zero((wide3)(number[2], number[3], 2));
    wide3 v = unit_or_zero((wide3)(-1, 2, -1));
    global const real *material = face_material(scene, hit.face), *light = scene->lights;
    in[0] = real3_of(l);
    in[1] = real3_of(v);
    in[2] = (real3)(material[MATERIAL_EXPONENT]);
    in[3] = vload3(0, material + MATERIAL_SPECULAR);
    out[0] = WHO_illuminate(material, light, n, l, v, number[4]);
}
/* END */
/* BEGIN trace_path */
static void WHO_check_trace_path(Scene *scene, const int *number, real3 *in, real3 *out)
{
    Ray ray = ray_of(scene, number[0], number[1]);
    in[0] = real3_of(ray.origin);
    in[1] = real3_of(ray.direction);
    out[0] = WHO_trace_path(scene, ray);
}
/* END */
