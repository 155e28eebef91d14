/* The textbook arithmetic of the plain kernel: the formulas as they are taught, in one precision, and nothing else. It
 * promises nothing where a value comes close to 0: rounding may then turn a yes into a no, and the picture may depend
 * on the tree. src/trace/textbook.c has the same in C. */
#include "shared/layout.h"
#include "shared/precision.cl"
#include "plain/scene.cl"

static wide3 vec3_cross(wide3 a, wide3 b)
{
    return (wide3)(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/* Steps 3 and 4: does the ray hit the face? */
static bool face_test(Scene *scene, int face, Ray ray, Hit *hit)
{
    scene->counts[COUNT_FACE_TESTS]++;
    wide3 n = face_normal(scene, face);
    wide d = -vec3_dot(n, face_vertex(scene, face, 0)), n_dot_r = vec3_dot(n, ray.direction);
    if (n_dot_r == 0) /* parallel */
        return false;
    hit->face = face;
    hit->from_behind = n_dot_r > 0;
    hit->t = hit->t_in_box = -(vec3_dot(n, ray.origin) + d) / n_dot_r;
    if (!(hit->t > 0)) /* behind the origin */
        return false;
    if (hit->from_behind && is_one_sided(scene, face))
        return false;
    wide3 p = ray.origin + hit->t * ray.direction;
    for (int k = 0; k < 4; k++) { /* a triangle's fourth edge has no length: its sign is 0 */
        wide3 e = face_vertex(scene, face, (k + 1) % 4) - face_vertex(scene, face, k);
        wide3 c = p - face_vertex(scene, face, k);
        if (vec3_dot(n, vec3_cross(e, c)) < 0) /* outside this edge */
            return false;
    }
    return true;
}

/* Step 6: is the face between the ray's origin and its end, where t = 1? */
static bool face_blocks(Scene *scene, int face, Ray ray, wide3 end)
{
    Hit hit;
    return face_test(scene, face, ray, &hit) && hit.t < 1;
}

/* Step 6: is the light in front of the face, N.L > 0? */
static bool faces_light(const Scene *scene, const Hit *hit, wide3 light)
{
    return vec3_dot(hit->normal, light - hit->point) > 0;
}

/* Step 6: P moved off the face by a fixed length. */
static wide3 point_shifted(const Scene *scene, const Hit *hit)
{
    return hit->point + scene->parameters->shift * hit->normal;
}
