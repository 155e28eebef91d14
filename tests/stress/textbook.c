/* The taught formulas, literally, in float32. */
#include "textbook.h"

#include <math.h>

#define SHIFT 1e-5f

typedef struct Float3 {
    float x, y, z;
} Float3;

typedef struct FloatPlane {
    Float3 n;
    float d;
} FloatPlane;

static Float3 load(const float *a)
{
    return (Float3){a[0], a[1], a[2]};
}
static Float3 load_double(const double *a)
{
    return (Float3){(float)a[0], (float)a[1], (float)a[2]};
}
static Float3 add(Float3 a, Float3 b)
{
    return (Float3){a.x + b.x, a.y + b.y, a.z + b.z};
}
static Float3 subtract(Float3 a, Float3 b)
{
    return (Float3){a.x - b.x, a.y - b.y, a.z - b.z};
}
static Float3 scale(float s, Float3 a)
{
    return (Float3){s * a.x, s * a.y, s * a.z};
}
static float dot(Float3 a, Float3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static Float3 cross(Float3 a, Float3 b)
{
    return (Float3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static FloatPlane plane_of(const Face *face)
{
    Float3 v0 = load(face->vertices[0]);
    Float3 n = cross(subtract(load(face->vertices[1]), v0), subtract(load(face->vertices[2]), v0));
    n = scale(1 / sqrtf(dot(n, n)), n);
    return (FloatPlane){n, -dot(n, v0)};
}

static bool inside(const Face *face, Float3 n, Float3 p)
{
    bool left = false, right = false;
    for (int k = 0; k < face->vertex_count; k++) {
        Float3 v = load(face->vertices[k]), next = load(face->vertices[(k + 1) % face->vertex_count]);
        float side = dot(n, cross(subtract(next, v), subtract(p, v)));
        left = left || side > 0;
        right = right || side < 0;
    }
    return !(left && right);
}

bool textbook_hits(const Face *face, const double ray[6], double *t)
{
    FloatPlane plane = plane_of(face);
    Float3 o = load_double(ray), r = load_double(ray + 3);
    float approach = dot(plane.n, r);
    if (approach == 0)
        return false;
    float parameter = -(dot(plane.n, o) + plane.d) / approach;
    *t = (double)parameter;
    if (!(parameter > 0))
        return false;
    if (face->front_only && approach > 0)
        return false;
    return inside(face, plane.n, add(o, scale(parameter, r)));
}

CastHit textbook_nearest(const Scene *scene, const double ray[6])
{
    CastHit nearest = {-1, HUGE_VAL};
    for (int i = 0; i < scene->face_count; i++) {
        double t;
        if (textbook_hits(&scene->faces[i], ray, &t) && t < nearest.t)
            nearest = (CastHit){i, t};
    }
    return nearest;
}

bool textbook_blocked(const Scene *scene, const double segment[6], int left)
{
    double ray[6];
    for (int i = 0; i < 3; i++) {
        ray[i] = segment[i];
        ray[3 + i] = (double)((float)segment[3 + i] - (float)segment[i]);
    }
    for (int i = 0; i < scene->face_count; i++) {
        double t;
        if (i != left && textbook_hits(&scene->faces[i], ray, &t) && t < 1)
            return true;
    }
    return false;
}

static void store(double out[3], Float3 a)
{
    out[0] = (double)a.x;
    out[1] = (double)a.y;
    out[2] = (double)a.z;
}

void textbook_points(const Scene *scene, const double ray[6], CastHit hit, double point[3], double shifted[3])
{
    FloatPlane plane = plane_of(&scene->faces[hit.face]);
    Float3 r = load_double(ray + 3), p = add(load_double(ray), scale((float)hit.t, r));
    store(point, p);
    store(shifted, add(p, scale(dot(plane.n, r) > 0 ? -SHIFT : SHIFT, plane.n)));
}
