/* The formulas of steps 3 and 4 as they stand. */
#include "grade/slip_test.h"

/* 3. */
FaceTest slip_test_plane(const Scene *scene, int face, Ray ray)
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
bool slip_test_inside(const FaceTest *test, int first, int end)
{
    for (int k = first; k < end; k++)
        if (test->edge_sign[k] < 0)
            return false;
    return true;
}

FaceTest slip_test_judged(FaceTest test, bool hit)
{
    test.verdict = hit ? FACE_INSIDE : FACE_OUTSIDE;
    return test;
}

bool slip_test_faces_ray(const Scene *scene, int face, const FaceTest *test)
{
    return !scene->faces[face].one_sided || test->n_dot_r < 0;
}

bool slip_test_ahead(const Scene *scene, int face, const FaceTest *test)
{
    return test->n_dot_r != 0 && test->t > 0 && slip_test_faces_ray(scene, face, test);
}

FaceTest slip_test_with_t(const Scene *scene, int face, Ray ray, FaceTest test)
{
    test.t_in_box = test.t;
    fill_edges(&test, scene, face, ray);
    return slip_test_judged(test, slip_test_ahead(scene, face, &test) && slip_test_inside(&test, 0, test.edges));
}

/* As the text has it. */
FaceTest slip_test_taught(const Scene *scene, int face, Ray ray)
{
    return slip_test_with_t(scene, face, ray, slip_test_plane(scene, face, ray));
}
