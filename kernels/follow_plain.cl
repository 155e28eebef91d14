/* Which faces a path of the plain kernel meets. follow_pairs.cl is the same for devices without double. */
#include "plain.cl"
#include "gpu/trail.cl"

/* Follows a path of so many hits once more, and keeps their faces. */
static void follow_path(Scene *scene, Ray ray, int hits, Trail trail)
{
    for (int k = 0; k < hits; k++) {
        Hit hit = nearest_hit(scene, ray);
        keep_hit(trail, k, hit.face);
        if (hit.face < 0)
            return;
        place_hit(scene, ray, &hit);
        wide3 r = unit_or_zero(ray.direction);
        ray = (Ray){hit.shifted, r - 2 * vec3_dot(r, hit.normal) * hit.normal, hit.face}; /* as in trace_path */
    }
}
