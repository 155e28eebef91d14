/* Slips of step 4: the inside test. */
#include "grade/slip.h"
#include "grade/slip_test.h"

#include <stddef.h>

static FaceTest outside_for_inside(const Scene *scene, int face, Ray ray)
{
    FaceTest test = slip_test_taught(scene, face, ray);
    bool outside = true;
    for (int k = 0; k < test.edges; k++)
        outside = outside && test.edge_sign[k] <= 0;
    return slip_test_judged(test, slip_test_ahead(scene, face, &test) && outside);
}

static FaceTest one_edge_enough(const Scene *scene, int face, Ray ray)
{
    FaceTest test = slip_test_taught(scene, face, ray);
    bool any = false;
    for (int k = 0; k < test.edges; k++)
        any = any || test.edge_sign[k] >= 0;
    return slip_test_judged(test, slip_test_ahead(scene, face, &test) && any);
}

static FaceTest without_edge(const Scene *scene, int face, Ray ray, int left_out)
{
    FaceTest test = slip_test_taught(scene, face, ray);
    int edge = left_out < 0 ? test.edges - 1 : left_out;
    return slip_test_judged(test, slip_test_ahead(scene, face, &test) && slip_test_inside(&test, 0, edge) &&
                                      slip_test_inside(&test, edge + 1, test.edges));
}

static FaceTest without_last_edge(const Scene *scene, int face, Ray ray)
{
    FaceTest test = without_edge(scene, face, ray, -1);
    test.edges--;
    return test;
}

static FaceTest without_first_edge(const Scene *scene, int face, Ray ray)
{
    return without_edge(scene, face, ray, 0);
}

static FaceTest edges_skip_one(const Scene *scene, int index, Ray ray)
{
    FaceTest test = slip_test_taught(scene, index, ray);
    const Face *face = &scene->faces[index];
    Vec3 p = vec3_add(ray.origin, vec3_scale(test.t, ray.direction));
    bool all = true;
    for (int k = 0; k < test.edges; k++) {
        Vec3 v = face_vertex(face, k), e = vec3_sub(face_vertex(face, (k + 2) % face->vertex_count), v);
        test.edge_value[k] = vec3_dot(scene->planes[index].normal, vec3_cross(e, vec3_sub(p, v)));
        all = all && test.edge_value[k] >= 0;
    }
    return slip_test_judged(test, slip_test_ahead(scene, index, &test) && all);
}

static FaceTest whole_plane(const Scene *scene, int face, Ray ray)
{
    FaceTest test = slip_test_taught(scene, face, ray);
    return slip_test_judged(test, slip_test_ahead(scene, face, &test));
}

static FaceTest half_the_quad(const Scene *scene, int index, Ray ray)
{
    FaceTest test = slip_test_taught(scene, index, ray);
    const Face *face = &scene->faces[index];
    Vec3 v0 = face_vertex(face, 0), v2 = face_vertex(face, 2);
    Vec3 p = vec3_add(ray.origin, vec3_scale(test.t, ray.direction));
    double diagonal = vec3_dot(scene->planes[index].normal, vec3_cross(vec3_sub(v0, v2), vec3_sub(p, v2)));
    return slip_test_judged(test, slip_test_ahead(scene, index, &test) && slip_test_inside(&test, 0, 2) &&
                                      (face->vertex_count == 3 ? test.edge_sign[2] >= 0 : diagonal >= 0));
}

/* The edge value of the formula without N, looked at in one coordinate of the cross product. */
static FaceTest edges_against_n(const Scene *scene, int face, Ray ray)
{
    FaceTest test = slip_test_taught(scene, face, ray);
    bool all = true;
    for (int k = 0; k < test.edges; k++) {
        test.edge_value[k] = test.n_dot_r < 0 ? test.edge_value[k] : -test.edge_value[k];
        all = all && test.edge_value[k] >= 0;
    }
    return slip_test_judged(test, slip_test_ahead(scene, face, &test) && all);
}

/* --- A ray that meets an edge, where rounding decides --- */

enum { MARGIN_BITS = 17 }; /* float is that exact, after some operations */

/* The faces are larger by a hair, or smaller: by so much of the length of the edge. */
static FaceTest with_margin(const Scene *scene, int index, Ray ray, double margin)
{
    FaceTest test = slip_test_taught(scene, index, ray);
    const Face *face = &scene->faces[index];
    bool all = true;
    for (int k = 0; k < test.edges; k++) {
        Vec3 e = vec3_sub(face_vertex(face, (k + 1) % face->vertex_count), face_vertex(face, k));
        all = all && test.edge_value[k] >= -margin * vec3_dot(e, e);
    }
    return slip_test_judged(test, slip_test_ahead(scene, index, &test) && all);
}

static FaceTest edge_counts(const Scene *scene, int face, Ray ray)
{
    return with_margin(scene, face, ray, ldexp(1, -MARGIN_BITS));
}

static FaceTest edge_is_missed(const Scene *scene, int face, Ray ray)
{
    return with_margin(scene, face, ray, -ldexp(1, -MARGIN_BITS));
}

#define EDGES "algorithm.md#4-the-inside-test"

const Slip slip_edge[] = {
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
    {"edges-skip-one", "The edges go from each vertex to the next but one.", "e = v[k+1] - v[k]", "e = v[k+2] - v[k]",
     EDGES, .steps = {.test = edges_skip_one}},
    {"whole-plane", "The inside test is left out: a face is as large as its plane.", "t > 0 and inside all edges",
     "t > 0", EDGES, .steps = {.test = whole_plane}},
    {"one-edge-enough", "A point inside one edge counts as inside all of them.", "inside every edge", "inside any edge",
     EDGES, .steps = {.test = one_edge_enough}},
    {"edge-met", "No slip: the ray meets an edge, and your arithmetic rounds to inside.", "no edge has a gap",
     "a face larger by a hair", "rounding.md#3-cracks", .rounding = true, .steps = {.test = edge_counts}},
    {"edge-missed", "No slip: the ray meets an edge, and your arithmetic rounds to outside.", "no edge has a gap",
     "a face smaller by a hair", "rounding.md#3-cracks", .rounding = true, .steps = {.test = edge_is_missed}},
    {0},
};
