/* Slips of steps 3 to 5: the plane, the edges, the nearest face. Shadow rays come by the same test, up to t = 1. */
#include "grade/slip.h"

#include <stddef.h>

/* --- The formulas of steps 3 and 4 as they stand, without the guards against rounding --- */

/* 3. */
static FaceTest at_plane(const Scene *scene, int face, Ray ray)
{
    FaceTest test = {.outside_edge = -1};
    Vec3 n = scene->planes[face].normal;
    test.n_dot_r = vec3_dot(n, ray.direction);
    test.n_dot_o_plus_d = vec3_dot(n, vec3_sub(ray.origin, face_vertex(&scene->faces[face], 0)));
    test.t = test.t_in_box = test.n_dot_r == 0 ? 0 : -test.n_dot_o_plus_d / test.n_dot_r;
    return test;
}

/* 4. The values of the edges. */
static void fill_edges(FaceTest *test, const Scene *scene, int index, Ray ray)
{
    const Face *face = &scene->faces[index];
    Vec3 p = vec3_add(ray.origin, vec3_scale(test->t, ray.direction));
    test->edges = face->vertex_count;
    for (int k = 0; k < face->vertex_count; k++) {
        Vec3 v = face_vertex(face, k), e = vec3_sub(face_vertex(face, (k + 1) % face->vertex_count), v);
        test->edge_value[k] = vec3_dot(scene->planes[index].normal, vec3_cross(e, vec3_sub(p, v)));
        test->edge_sign[k] = (test->edge_value[k] > 0) - (test->edge_value[k] < 0);
    }
}

/* Inside the edges from `first` up to `end`. */
static bool inside(const FaceTest *test, int first, int end)
{
    for (int k = first; k < end; k++)
        if (test->edge_sign[k] < 0)
            return false;
    return true;
}

static FaceTest judged(FaceTest test, bool hit)
{
    test.verdict = hit ? FACE_INSIDE : FACE_OUTSIDE;
    return test;
}

static bool faces_ray(const Scene *scene, int face, const FaceTest *test)
{
    return !scene->faces[face].one_sided || test->n_dot_r < 0;
}

static bool is_ahead(const Scene *scene, int face, const FaceTest *test)
{
    return test->n_dot_r != 0 && test->t > 0 && faces_ray(scene, face, test);
}

static FaceTest with_t(const Scene *scene, int face, Ray ray, FaceTest test)
{
    test.t_in_box = test.t;
    fill_edges(&test, scene, face, ray);
    return judged(test, is_ahead(scene, face, &test) && inside(&test, 0, test.edges));
}

/* As the text has it. */
static FaceTest as_taught(const Scene *scene, int face, Ray ray)
{
    return with_t(scene, face, ray, at_plane(scene, face, ray));
}

/* --- 3: the plane --- */

static FaceTest t_negated(const Scene *scene, int face, Ray ray)
{
    FaceTest test = at_plane(scene, face, ray);
    test.t = -test.t;
    return with_t(scene, face, ray, test);
}

static FaceTest n_dot_r_negated(const Scene *scene, int face, Ray ray)
{
    FaceTest test = at_plane(scene, face, ray);
    test.n_dot_r = -test.n_dot_r;
    test.t = -test.t;
    return with_t(scene, face, ray, test);
}

/* In the file's coordinates, where N.O and D are what a student's program has. */
static double world_dot(const Scene *scene, Vec3 n, Vec3 position)
{
    return vec3_dot(n, vec3_add(position, scene->centre));
}

static FaceTest d_negated(const Scene *scene, int face, Ray ray)
{
    FaceTest test = at_plane(scene, face, ray);
    Vec3 n = scene->planes[face].normal;
    test.n_dot_o_plus_d = world_dot(scene, n, ray.origin) + world_dot(scene, n, face_vertex(&scene->faces[face], 0));
    test.t = -test.n_dot_o_plus_d / test.n_dot_r;
    return with_t(scene, face, ray, test);
}

static FaceTest without_d(const Scene *scene, int face, Ray ray)
{
    FaceTest test = at_plane(scene, face, ray);
    test.n_dot_o_plus_d = world_dot(scene, scene->planes[face].normal, ray.origin);
    test.t = -test.n_dot_o_plus_d / test.n_dot_r;
    return with_t(scene, face, ray, test);
}

static FaceTest behind_counts(const Scene *scene, int face, Ray ray)
{
    FaceTest test = as_taught(scene, face, ray);
    return judged(test, test.n_dot_r != 0 && faces_ray(scene, face, &test) && inside(&test, 0, test.edges));
}

static FaceTest t_without_sign(const Scene *scene, int face, Ray ray)
{
    FaceTest test = at_plane(scene, face, ray);
    test.t = fabs(test.t);
    return with_t(scene, face, ray, test);
}

static FaceTest back_counts(const Scene *scene, int face, Ray ray)
{
    FaceTest test = as_taught(scene, face, ray);
    return judged(test, test.n_dot_r != 0 && test.t > 0 && inside(&test, 0, test.edges));
}

static FaceTest front_left_out(const Scene *scene, int face, Ray ray)
{
    FaceTest test = as_taught(scene, face, ray);
    bool seen = !scene->faces[face].one_sided || test.n_dot_r > 0;
    return judged(test, test.n_dot_r != 0 && test.t > 0 && seen && inside(&test, 0, test.edges));
}

static FaceTest all_backs_left_out(const Scene *scene, int face, Ray ray)
{
    FaceTest test = as_taught(scene, face, ray);
    return judged(test, test.n_dot_r < 0 && test.t > 0 && inside(&test, 0, test.edges));
}

/* --- 4: the edges --- */

static FaceTest outside_for_inside(const Scene *scene, int face, Ray ray)
{
    FaceTest test = as_taught(scene, face, ray);
    bool outside = true;
    for (int k = 0; k < test.edges; k++)
        outside = outside && test.edge_sign[k] <= 0;
    return judged(test, is_ahead(scene, face, &test) && outside);
}

static FaceTest one_edge_enough(const Scene *scene, int face, Ray ray)
{
    FaceTest test = as_taught(scene, face, ray);
    bool any = false;
    for (int k = 0; k < test.edges; k++)
        any = any || test.edge_sign[k] >= 0;
    return judged(test, is_ahead(scene, face, &test) && any);
}

static FaceTest without_edge(const Scene *scene, int face, Ray ray, int left_out)
{
    FaceTest test = as_taught(scene, face, ray);
    int edge = left_out < 0 ? test.edges - 1 : left_out;
    return judged(test, is_ahead(scene, face, &test) && inside(&test, 0, edge) && inside(&test, edge + 1, test.edges));
}

static FaceTest without_last_edge(const Scene *scene, int face, Ray ray)
{
    return without_edge(scene, face, ray, -1);
}

static FaceTest without_first_edge(const Scene *scene, int face, Ray ray)
{
    return without_edge(scene, face, ray, 0);
}

static FaceTest whole_plane(const Scene *scene, int face, Ray ray)
{
    FaceTest test = as_taught(scene, face, ray);
    return judged(test, is_ahead(scene, face, &test));
}

static FaceTest half_the_quad(const Scene *scene, int index, Ray ray)
{
    FaceTest test = as_taught(scene, index, ray);
    const Face *face = &scene->faces[index];
    Vec3 v0 = face_vertex(face, 0), v2 = face_vertex(face, 2);
    Vec3 p = vec3_add(ray.origin, vec3_scale(test.t, ray.direction));
    double diagonal = vec3_dot(scene->planes[index].normal, vec3_cross(vec3_sub(v0, v2), vec3_sub(p, v2)));
    return judged(test, is_ahead(scene, index, &test) && inside(&test, 0, 2) &&
                            (face->vertex_count == 3 ? test.edge_sign[2] >= 0 : diagonal >= 0));
}

/* The edge value of the formula without N, looked at in one coordinate of the cross product. */
static FaceTest edges_against_n(const Scene *scene, int face, Ray ray)
{
    FaceTest test = as_taught(scene, face, ray);
    bool all = true;
    for (int k = 0; k < test.edges; k++) {
        test.edge_value[k] = test.n_dot_r < 0 ? test.edge_value[k] : -test.edge_value[k];
        all = all && test.edge_value[k] >= 0;
    }
    return judged(test, is_ahead(scene, face, &test) && all);
}

/* --- 4: a ray that meets an edge, where rounding decides --- */

enum { MARGIN_BITS = 17 }; /* float is that exact, after some operations */

/* The faces are larger by a hair, or smaller: by so much of the length of the edge. */
static FaceTest with_margin(const Scene *scene, int index, Ray ray, double margin)
{
    FaceTest test = as_taught(scene, index, ray);
    const Face *face = &scene->faces[index];
    bool all = true;
    for (int k = 0; k < test.edges; k++) {
        Vec3 e = vec3_sub(face_vertex(face, (k + 1) % face->vertex_count), face_vertex(face, k));
        all = all && test.edge_value[k] >= -margin * vec3_dot(e, e);
    }
    return judged(test, is_ahead(scene, index, &test) && all);
}

static FaceTest edge_counts(const Scene *scene, int face, Ray ray)
{
    return with_margin(scene, face, ray, ldexp(1, -MARGIN_BITS));
}

static FaceTest edge_is_missed(const Scene *scene, int face, Ray ray)
{
    return with_margin(scene, face, ray, -ldexp(1, -MARGIN_BITS));
}

/* --- 5: the nearest --- */

static bool farthest(const SlipHit *nearest, double t)
{
    return nearest->face < 0 || t > nearest->test.t_in_box;
}

static bool last(const SlipHit *nearest, double t)
{
    (void)nearest;
    (void)t;
    return true;
}

static bool first(const SlipHit *nearest, double t)
{
    (void)t;
    return nearest->face < 0;
}

static bool last_of_equal(const SlipHit *nearest, double t)
{
    return nearest->face < 0 || t <= nearest->test.t_in_box;
}

#define PLANE "algorithm.md#3-the-plane-hit"
#define EDGES "algorithm.md#4-the-inside-test"
#define NEAREST "algorithm.md#5-nearest-and-ties"

const Slip slip_face[] = {
    {"t-sign", "The sign of t is wrong: faces behind the eye are seen, those before it are not.",
     "t = -(N.O + D) / (N.R)", "t = (N.O + D) / (N.R)", PLANE, .steps = {.test = t_negated}},
    {"n-dot-r-sign", "The sign of N.R is wrong.", "N.R", "-(N.R)", PLANE, .steps = {.test = n_dot_r_negated}},
    {"d-sign", "The sign of D is wrong.", "D = -(N.v0)", "D = N.v0", "algorithm.md#2-faces-and-their-planes",
     .steps = {.test = d_negated}},
    {"d-forgotten", "D is forgotten: every plane goes through the origin.", "t = -(N.O + D) / (N.R)",
     "t = -(N.O) / (N.R)", "algorithm.md#2-faces-and-their-planes", .steps = {.test = without_d}},
    {"behind-counts", "Faces behind the eye are hit, too: t may be negative, and the smallest t counts.",
     "a hit has t > 0", "any t", PLANE, .steps = {.test = behind_counts}},
    {"t-without-sign", "The sign of t is dropped: faces behind the eye are seen as if they were before it.",
     "a hit has t > 0", "|t|", PLANE, .steps = {.test = t_without_sign}},
    {"one-sided-ignored", "One-sided faces are seen from behind, too.", "one-sided: N.R < 0", "any N.R", PLANE,
     .steps = {.test = back_counts}},
    {"one-sided-reversed", "One-sided faces are seen from behind instead of from the front.", "one-sided: N.R < 0",
     "one-sided: N.R > 0", PLANE, .steps = {.test = front_left_out}},
    {"all-one-sided", "All faces are seen from the front only, also those that have two sides.",
     "N.R < 0 is asked of one-sided faces only", "N.R < 0 is asked of all faces", PLANE,
     .steps = {.test = all_backs_left_out}},
    {"outside-counts", "The sign of the inside test is wrong: outside counts as inside.", "no N.(e x c) is negative",
     "no N.(e x c) is positive", EDGES, .steps = {.test = outside_for_inside}},
    {"edges-by-ray", "The edges are taken to run counter-clockwise as the ray sees them.",
     "no N.(e x c) is negative, N as the vertices give it", "N turned to the ray first", EDGES,
     .steps = {.test = edges_against_n}},
    {"last-edge-forgotten", "The last edge, from the last vertex back to the first, is not tested.",
     "an edge from each vertex to the next, k + 1 modulo the vertices", "edges up to the last vertex", EDGES,
     .steps = {.test = without_last_edge}},
    {"first-edge-forgotten", "The first edge is not tested.", "edges from k = 0", "edges from k = 1", EDGES,
     .steps = {.test = without_first_edge}},
    {"half-a-quad", "Only the triangle v0 v1 v2 of a quad is tested.", "all four edges of a quad",
     "the triangle of its first three vertices", EDGES, .steps = {.test = half_the_quad}},
    {"whole-plane", "The inside test is left out: a face is as large as its plane.", "t > 0 and inside all edges",
     "t > 0", EDGES, .steps = {.test = whole_plane}},
    {"one-edge-enough", "A point inside one edge counts as inside all of them.", "inside every edge", "inside any edge",
     EDGES, .steps = {.test = one_edge_enough}},
    {"edge-met", "No slip: the ray meets an edge, and your arithmetic rounds to inside.", "no edge has a gap",
     "a face larger by a hair", "rounding.md#3-cracks", .rounding = true, .steps = {.test = edge_counts}},
    {"edge-missed", "No slip: the ray meets an edge, and your arithmetic rounds to outside.", "no edge has a gap",
     "a face smaller by a hair", "rounding.md#3-cracks", .rounding = true, .steps = {.test = edge_is_missed}},
    {"farthest", "The farthest face is taken, not the nearest.", "the smallest t", "the largest t", NEAREST,
     .steps = {.nearer = farthest}},
    {"last-face", "The last face of the file that is hit is taken, not the nearest.", "the smallest t",
     "the last one found", NEAREST, .steps = {.nearer = last}},
    {"first-face", "The first face of the file that is hit is taken, not the nearest.", "the smallest t",
     "the first one found", NEAREST, .steps = {.nearer = first}},
    {"last-of-equal", "Of faces that are equally near the last one is taken.", "of equal t, the first in the file",
     "of equal t, the last in the file", NEAREST, .steps = {.nearer = last_of_equal}},
    {0},
};
