/* Fails at face_between_them: not the number of that face. */
#include "trace/textbook_face.h"

static void place_hit(const Textbook *textbook, Hit *hit)
{
    Real3 n = rounded(textbook->scene->planes[hit->face].normal);
    hit->n = hit->n_dot_r > 0 ? scale(-1, n) : n;
    hit->shifted = add(hit->p, scale((Real)textbook->shift, hit->n));
}

static int face_between(const Textbook *textbook, const Hit *hit, Real3 light)
{
    RealRay ray = {hit->shifted, subtract(light, hit->shifted)};
    for (int i = 0; i < textbook->scene->face_count; i++) {
        Hit between;
        if (hits_occluder(textbook, i, ray, &between) && between.t < 1)
            return 1;
    }
    return -1;
}
