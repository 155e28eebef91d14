/* Step 6 of the textbook tracer: the shifted point, and what stands between it and a light. */
#ifndef RECTRAY_TEXTBOOK_SHADOW_H
#define RECTRAY_TEXTBOOK_SHADOW_H

#include "trace/textbook_face.h"

/* Fills hit->n, the normal N on the ray's side, and hit->shifted, P moved off the face along it. */
static void place_hit(const Textbook *textbook, Hit *hit)
{
    Real3 n = rounded(textbook->scene->planes[hit->face].normal);
    hit->n = hit->n_dot_r > 0 ? scale(-1, n) : n;
    hit->shifted = add(hit->p, scale((Real)textbook->shift, hit->n));
}

/* A face between the shifted point and the light, at 0 < t < 1; -1: none. */
static int face_between(const Textbook *textbook, const Hit *hit, Real3 light)
{
    RealRay ray = {hit->shifted, subtract(light, hit->shifted)};
    for (int i = 0; i < textbook->scene->face_count; i++) {
        Hit between;
        if (hits_occluder(textbook, i, ray, &between) && between.t < 1)
            return i;
    }
    return -1;
}

#endif
