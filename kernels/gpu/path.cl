/* A path from the camera on, in float: steps 1 and 6 to 9, in the order of plain.cl. The ray on its way is one of the
 * path, or a shadow ray from the path's last point. Whatever can be computed again or read again is not kept. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "plain/scene.cl"
#include "gpu/ray.cl"
#include "gpu/face.cl"
#include "gpu/search.cl"
#include "gpu/trail.cl"

/* Where the error of a hit point is a larger share of the distance to the light or to the viewer, it might be seen: an
 * angle of this size changes a diffuse term by a quarter of a byte's step. A highlight is steeper by the root of its
 * exponent. */
#define SHARE_MOST 0x1p-10f

/* The last point of a path. */
typedef struct FloatHit {
    int face;
    bool from_behind;
    float3 point, arrived;        /* where, and along which direction */
    float error, direction_error; /* of a component of these */
} FloatHit;

/* Step 1: the ray through sub-pixel (i, j) of a pixel. Places are counted from the middle of the screen, in halves. */
static float3 read3(volatile global const real *v) { return (float3)(v[0], v[1], v[2]); }
static FloatRay primary_ray(const Scene *scene, int column, int row, int i, int j)
{
    volatile constant const Parameters *p = scene->parameters;
    volatile global const real *view = scene->view;
    float3 eye = read3(view + VIEW_EYE), forward = read3(view + VIEW_FORWARD);
    float3 right = read3(view + VIEW_RIGHT), up = read3(view + VIEW_UP);
    int across = p->columns * p->grid, down = p->rows * p->grid;
    float x = (float)(2 * (column * p->grid + i) + 1 - across) / (2 * (float)across) * view[VIEW_WIDTH];
    float y = (float)(down - 1 - 2 * (row * p->grid + j)) / (2 * (float)down) * view[VIEW_HEIGHT];
    float3 direction = forward + x * right + y * up;
    float3 rest = read3(view + VIEW_REALS + VIEW_EYE);
    FloatRay ray = {eye, direction / sqrt(vec3_dot(direction, direction)), sum_of_magnitudes(rest),
                    8 * REAL_ROUNDING, -1};
    return ray;
}

static FloatHit place_hit(const FloatRay *ray, const Found *found)
{
    float t = found->at.t;
    FloatHit hit = {found->face, found->at.from_behind, ray->origin + t * ray->direction, ray->direction};
    hit.direction_error = ray->direction_error;
    hit.error = found->at.error + ray->origin_error + t * (ray->direction_error + 2 * REAL_ROUNDING) +
                REAL_ROUNDING * sum_of_magnitudes(ray->origin);
    return hit;
}

/* The normal on the side that the ray came from. */
static float3 normal_of(const Scene *scene, const FloatHit *hit)
{
    float3 n = float_row(scene, hit->face)[3].xyz;
    return hit->from_behind ? -n : n;
}

/* From the point to the viewer, of any length. */
static float3 to_viewer(const Scene *scene, const FloatHit *hit)
{
    return scene->parameters->viewer_ray ? -hit->arrived
                                         : vector_at(scene->view + VIEW_EYE, VIEW_REALS) - hit->point;
}

/* Is a place so far away that the error of the point is not seen? */
static bool is_far(const Scene *scene, const FloatHit *hit, float distance)
{
    return hit->error * (1 + sqrt(face_material(scene, hit->face)[MATERIAL_EXPONENT])) <= SHARE_MOST * distance;
}

/* x to the exponent, for x from 0 to 1. Twice the exponent is mostly a whole number: some multiplications then. */
static float power(float x, float exponent)
{
    float twice = 2 * exponent;
    uint n = (uint)min(twice, 65535.0f);
    if ((float)n != twice)
        return exp2(exponent * log2(x));
    float value = 1;
    for (float square = sqrt(x); n > 0; n >>= 1, square *= square)
        value *= n & 1 ? square : 1;
    return value;
}

/* Step 7: Blinn-Phong with a quarter of the shininess, without the ambient term. l: the unit vector to the light. */
static float3 illuminate(const Scene *scene, const FloatHit *hit, global const real *light, float3 l)
{
    global const real *material = face_material(scene, hit->face);
    float3 n = normal_of(scene, hit), h = unit_or_zero(l + unit_or_zero(to_viewer(scene, hit)));
    float3 diffuse = vload3(0, material + MATERIAL_DIFFUSE) * vload3(0, light + LIGHT_DIFFUSE);
    float3 specular = vload3(0, material + MATERIAL_SPECULAR) * vload3(0, light + LIGHT_SPECULAR);
    float3 colour = max(vec3_dot(l, n), 0.0f) * diffuse;
    if (specular.x + specular.y + specular.z > 0)
        colour += power(max(vec3_dot(n, h), 0.0f), material[MATERIAL_EXPONENT]) * specular;
    return colour;
}

static float3 ambient_of(const Scene *scene, const FloatHit *hit, global const real *light)
{
    return vload3(0, face_material(scene, hit->face) + MATERIAL_AMBIENT) * vload3(0, light + LIGHT_AMBIENT);
}

static float3 to_light(const FloatHit *hit, global const real *light)
{
    return (vload3(0, light + LIGHT_POSITION) - hit->point) + vload3(0, light + LIGHT_POSITION_LOW);
}

/* Step 6: is the light on the side of the face that the ray came from? */
static Answer faces_light(const Scene *scene, const FloatHit *hit, global const real *light)
{
    FaceRow row = float_row(scene, hit->face);
    float3 v0 = (float3)(row[0].x, row[1].x, row[2].x);
    float3 heights = row[3].xyz * ((vload3(0, light + LIGHT_POSITION) - v0) + vload3(0, light + LIGHT_POSITION_LOW));
    float height = heights.x + heights.y + heights.z;
    if (!(fabs(height) > 8 * REAL_ROUNDING * sum_of_magnitudes(heights) + REAL_FLOOR))
        return UNSURE;
    return (height < 0) == hit->from_behind ? YES : NO;
}

/* The shadow ray to a light that is so far away. */
static FloatRay shadow_ray(const FloatHit *hit, float3 to, float distance)
{
    FloatRay ray = {hit->point, to / distance, hit->error, hit->error / distance + 4 * REAL_ROUNDING, hit->face};
    return ray;
}

static void add_colour(local float *total, float3 colour) { vstore3(vload3(0, total) + colour, 0, total); }

/* Steps 3 to 9: adds the sum of the hits' illuminations. False: the path is in doubt, and what it added worthless. */
INLINE bool trace_path(Scene *scene, FloatRay ray, Trail trail, local float *total)
{
    constant const Parameters *p = scene->parameters;
    float weight = 1, end = INFINITY, end_error = 0;
    int bounces = 0, light = -1; /* that the ray goes to; -1: it is one of the path */
    bool is_lit = false;
    FloatHit hit = {-1};
    for (;;) {
        Found found = search(scene, &ray, end, end_error);
        if (found.answer == UNSURE)
            return false;
        if (light < 0)
            keep_hit(trail, bounces, found.face);
        if (light < 0 && found.face < 0) {
            add_colour(total, weight * vload3(0, scene->view + VIEW_BACKGROUND));
            return true;
        }
        if (light < 0) {
            hit = place_hit(&ray, &found);
            is_lit = p->shadow_ambient;
            if (!p->viewer_ray && !is_far(scene, &hit, length(to_viewer(scene, &hit))))
                return false;
        } else if (found.face < 0) {
            global const real *reached = scene->lights + light * LIGHT_REALS;
            add_colour(total, weight * illuminate(scene, &hit, reached, ray.direction));
            if (!p->shadow_ambient)
                add_colour(total, weight * ambient_of(scene, &hit, reached));
            is_lit = true;
        }
        for (end = INFINITY; end == INFINITY && ++light < p->light_count;) { /* the next light before the face */
            global const real *next = scene->lights + light * LIGHT_REALS;
            Answer faces = faces_light(scene, &hit, next);
            float3 to = to_light(&hit, next);
            float distance = length(to);
            if (faces == UNSURE || !is_far(scene, &hit, distance))
                return false;
            if (p->shadow_ambient)
                add_colour(total, weight * ambient_of(scene, &hit, next));
            if (faces == NO) {
                scene->counts[COUNT_SKIPPED + SKIP_LIGHT_BEHIND]++;
            } else {
                scene->counts[COUNT_SHADOW]++;
                ray = shadow_ray(&hit, to, distance);
                end = distance;
                end_error = 2 * hit.error + 4 * REAL_ROUNDING * distance;
            }
        }
        if (end < INFINITY)
            continue;
        float reflection = face_material(scene, hit.face)[MATERIAL_REFLECTION];
        if (!is_lit || reflection == 0 || bounces++ == p->max_bounces)
            return true;
        float3 n = normal_of(scene, &hit);
        FloatRay mirrored = {hit.point, hit.arrived - 2 * vec3_dot(hit.arrived, n) * n, hit.error,
                             hit.direction_error + 12 * REAL_ROUNDING, hit.face};
        ray = mirrored;
        weight *= reflection;
        light = -1;
        end_error = 0;
        scene->counts[COUNT_REFLECTION]++;
    }
}
