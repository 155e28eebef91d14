/* Which faces a path of pairs.cl meets. */
#include "pairs.cl"
#include "gpu/trail.cl"

/* Follows a path of so many hits once more, and keeps their faces. */
static void follow_path(Scene *scene, PairRay ray, int hits, Trail trail)
{
    for (int k = 0; k < hits; k++) {
        PairHit hit = nearest_hit(scene, &ray);
        keep_hit(trail, k, hit.face);
        if (hit.face < 0)
            return;
        place_hit(scene, &ray, &hit);
        ray = mirrored_ray(&ray, &hit);
    }
}
