/* What the plain kernel works with: vectors, rays, hits, and the scene as the host lays it out: shared/layout.h. */
#include "shared/layout.h"
#include "shared/precision.cl"

/* P(t) = origin + t direction. */
typedef struct Ray {
    wide3 origin, direction;
    int from; /* the face that it leaves, -1: none */
} Ray;

typedef struct Hit {
    int face; /* its place on the device, -1: none */
    wide t;
    wide t_in_box;    /* t, kept within the face's box: it decides what is nearest */
    bool from_behind; /* N.R > 0 */
    wide3 point;      /* P */
    wide3 normal;     /* N turned to the side that the ray came from */
    wide3 shifted;    /* P moved off the face along N */
} Hit;

typedef struct Scene {
    constant const Parameters *parameters;
    global const FaceRecord *faces;
    global const real *face_rows;                 /* FACE_REALS each */
    global const wide *planes;                    /* PLANE_REALS each */
    global const real *materials, *lights, *view; /* rows, too */
    global const float *tree_floats;              /* see bvh.cl and kdtree.cl */
    global const int *tree_ints;
    uint counts[COUNTER_KINDS]; /* of this work-item */
} Scene;

/* As in src/base/vec3.h: the built-in dot may round otherwise. */
static wide vec3_dot(wide3 a, wide3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

static wide3 unit_or_zero(wide3 a) { return vec3_dot(a, a) > 0 ? a / sqrt(vec3_dot(a, a)) : a; }

static global const real *face_row(const Scene *scene, int i) { return scene->face_rows + (size_t)i * FACE_REALS; }
static global const wide *plane_row(const Scene *scene, int face) { return scene->planes + (size_t)face * PLANE_REALS; }

static wide3 face_vertex(const Scene *scene, int face, int k)
{
    global const real *row = face_row(scene, face) + FACE_VERTICES;
    return (wide3)((wide)row[k], (wide)row[4 + k], (wide)row[8 + k]);
}

static bool is_one_sided(const Scene *scene, int face)
{
    return *(global const uint *)(face_row(scene, face) + FACE_BITS) & FACE_ONE_SIDED;
}

static wide3 face_normal(const Scene *scene, int face) { return vload3(0, plane_row(scene, face) + PLANE_NORMAL); }

static global const real *face_material(const Scene *scene, int face)
{
    return scene->materials + (size_t)(scene->faces[face].material & ~FACE_FLAT) * MATERIAL_REALS;
}

/* A vector that is stored in two parts: its rounded value at `row`, and what rounding took from it at `row + low`. */
static wide3 vector_at(global const real *row, int low)
{
    return (wide3)((wide)row[0] + row[low], (wide)row[1] + row[low + 1], (wide)row[2] + row[low + 2]);
}
