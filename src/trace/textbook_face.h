/* Steps 3 and 4 of the textbook tracer: a ray and a face. What the searches of steps 5 and 6 call. */
#ifndef RECTRAY_TEXTBOOK_FACE_H
#define RECTRAY_TEXTBOOK_FACE_H

#include "trace/textbook_input.h"
#include "trace/textbook_inside.h"
#include "trace/textbook_plane.h"
#include "trace/textbook_record.h"

/* Does the ray hit the face? Fills what it finds on the way. To copy a ray for each face would take as long as the test
 * itself, so this takes a pointer. */
static bool hits(const Scene *scene, int index, const RealRay *ray, Hit *hit)
{
    const Face *face = &scene->faces[index];
    Real3 n = rounded(scene->planes[index].normal);
    hit->face = index;
    hit->edges = 0;
    if (!meets_plane(n, vertex(face, 0), *ray, hit))
        return false; /* parallel, or behind the origin */
    if (face->one_sided && hit->n_dot_r > 0)
        return false; /* a one-sided face, from behind */
    hit->p = add(ray->o, scale(hit->t, ray->r));
    return inside_edges(face, n, hit);
}

/* The same, and the walkthrough is told. nearest_t: of the faces before. */
static bool hits_face(const Textbook *textbook, int index, RealRay ray, Real nearest_t, Hit *hit)
{
    bool found = hits(textbook->scene, index, &ray, hit);
    record_face(textbook->recorder, hit, found, nearest_t);
    return found;
}

/* The same for a shadow ray. */
static bool hits_occluder(const Textbook *textbook, int index, RealRay ray, Hit *hit)
{
    bool found = hits(textbook->scene, index, &ray, hit);
    record_occluder(textbook->recorder, hit, found);
    textbook->report->face_tests++;
    return found;
}

#endif
