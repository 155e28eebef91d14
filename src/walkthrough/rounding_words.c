/* Why the textbook's path and the exact one part. */
#include "walkthrough/rounding_words.h"

#include "walkthrough/walkthrough_words.h"

enum { FACE_COLUMNS = 24 };

InkText rounding_size(double x)
{
    return ink_number(fabs(x), 2);
}

InkText rounding_face(const Rounding *rounding, int face)
{
    return face < 0 ? ink_text("no face") : walkthrough_face_words(rounding->walk->scene, face, FACE_COLUMNS);
}

/* --- Another face --- */

/* Why textbook arithmetic finds that the ray does not hit the face. */
static InkText why_not_hit(const Rounding *rounding, int face, const FaceTest *test)
{
    InkText name = rounding_face(rounding, face);
    switch (test->verdict) {
    case FACE_PARALLEL:
        return ink_text("the ray is parallel to %s: N.R = 0", name.text);
    case FACE_BEHIND:
        return ink_text("%s is behind the ray: t = %s", name.text, ink_number(test->t, 3).text);
    case FACE_OUTSIDE:
        return ink_text("%s is missed, outside its edge %d: N.(e x c) = %s", name.text, test->outside_edge,
                        ink_number(test->edge_value[test->outside_edge], 3).text);
    default:
        return ink_text("%s is seen from behind", name.text);
    }
}

static InkText textbook_face(const Rounding *rounding, int k)
{
    const RoundingHit *found = &rounding->textbook.hits[k], *right = &rounding->exact.hits[k];
    InkText name = rounding_face(rounding, found->face);
    InkText outcome = found->face < 0 ? ink_text("no face is hit")
                                      : ink_text("%s is hit at t = %s", name.text, ink_number(found->t, 3).text);
    if (right->face < 0)
        return outcome;
    FaceTest test = rounding_textbook_test(rounding, right->face, found->ray);
    if (test.verdict == FACE_INSIDE)
        return ink_text("%s, before %s at t = %s", outcome.text, rounding_face(rounding, right->face).text,
                        ink_number(test.t, 3).text);
    return ink_text("%s, and %s", why_not_hit(rounding, right->face, &test).text, outcome.text);
}

/* What the face that textbook arithmetic found is to the exact ray. */
static InkText exact_test_words(const Rounding *rounding, int k, int face)
{
    const Scene *scene = rounding->walk->scene;
    InkText name = rounding_face(rounding, face);
    if (k > 0 && rounding->exact.hits[k - 1].face == face)
        return ink_text("the ray leaves %s and cannot meet it again", name.text);
    FaceTest test = face_test(&scene->faces[face], &scene->planes[face], rounding->exact.hits[k].ray, HUGE_VAL, true);
    switch (test.verdict) {
    case FACE_PARALLEL:
        return ink_text("the ray is parallel to %s", name.text);
    case FACE_BEHIND:
        if (test.n_dot_o_plus_d == 0)
            return ink_text("the ray starts in the plane of %s: N.O + D = 0, t = 0", name.text);
        return ink_text("%s is behind the ray: t = %s", name.text, ink_number(test.t, 3).text);
    case FACE_OUTSIDE:
        return ink_text("%s is missed, outside its edge %d", name.text, test.outside_edge);
    case FACE_INSIDE:
        return ink_text("%s is hit at t = %s, too", name.text, ink_number(test.t, 3).text);
    default:
        return ink_text("%s is seen from behind", name.text);
    }
}

/* Where exactly the point lies at the edge that textbook arithmetic finds it outside of. */
static InkText edge_words(const Rounding *rounding, int k)
{
    const Scene *scene = rounding->walk->scene;
    const RoundingHit *hit = &rounding->exact.hits[k];
    FaceTest textbook = rounding_textbook_test(rounding, hit->face, rounding->textbook.hits[k].ray);
    FaceTest test = face_test(&scene->faces[hit->face], &scene->planes[hit->face], hit->ray, HUGE_VAL, true);
    int edge = textbook.outside_edge;
    if (edge < 0 || edge >= test.edges)
        return ink_text("%s", "");
    return ink_text(": N.(e x c) = %s at edge %d%s", ink_number(test.edge_value[edge], 3).text, edge,
                    test.edge_sign[edge] == 0 ? ", which belongs to it" : "");
}

static InkText exact_face(const Rounding *rounding, int k)
{
    const RoundingHit *right = &rounding->exact.hits[k];
    int found = rounding->textbook.hits[k].face;
    InkText outcome = ink_text("no face is hit");
    if (right->face >= 0)
        outcome = ink_text("%s is hit at t = %s%s", rounding_face(rounding, right->face).text,
                           ink_number(right->t, 3).text, edge_words(rounding, k).text);
    return found < 0 ? outcome : ink_text("%s, and %s", exact_test_words(rounding, k, found).text, outcome.text);
}

/* --- Another verdict on a light --- */

/* Only textbook arithmetic tests the face that the shadow ray leaves. */
static InkText own_face_words(const Rounding *rounding, const RoundingLight *light, InkText place)
{
    FaceTest test = rounding_textbook_test(rounding, light->blocker, light->ray);
    return ink_text("%s and is blocked by its own face, at t = %s of the shadow ray", place.text,
                    ink_number(test.t, 3).text);
}

static InkText light_words(const Rounding *rounding, const RoundingPath *path, RoundingPart part)
{
    const RoundingHit *hit = &path->hits[part.hit];
    const RoundingLight *light = &hit->lights[part.light];
    InkText face = rounding_face(rounding, hit->face);
    InkText place = ink_text("P%d' lies %s %s the plane of %s", part.hit + 1, rounding_size(hit->above).text,
                             hit->above < 0 ? "below" : "above", face.text);
    if (hit->above == 0)
        place = ink_text("P%d' lies in the plane of %s", part.hit + 1, face.text);
    if (light->verdict == LIGHT_REACHES)
        return ink_text("%s, and light %d reaches it", place.text, part.light);
    if (light->blocker == hit->face)
        return own_face_words(rounding, light, place);
    return ink_text("%s, and %s is between it and light %d", place.text, rounding_face(rounding, light->blocker).text,
                    part.light);
}

/* A light in the plane or behind it needs no point. */
static InkText side_words(const Rounding *rounding, const RoundingPath *path, RoundingPart part)
{
    const RoundingHit *hit = &path->hits[part.hit];
    const RoundingLight *light = &hit->lights[part.light];
    const char *side = light->height == 0 ? "in the plane of" : light->height < 0 ? "behind" : "in front of";
    InkText where = ink_text("light %d is %s %s, N.(light - P%d) = %s", part.light, side,
                             rounding_face(rounding, hit->face).text, part.hit + 1, ink_number(light->height, 3).text);
    if (light->verdict == LIGHT_REACHES)
        return ink_text("%s, and reaches it", where.text);
    if (light->verdict == LIGHT_BEHIND_FACE)
        return ink_text("%s, and cannot reach it", where.text);
    return ink_text("%s, and %s is between", where.text, rounding_face(rounding, light->blocker).text);
}

static InkText verdict_words(const Rounding *rounding, const RoundingPath *path, RoundingPart part)
{
    bool by_side = rounding->textbook.hits[part.hit].lights[part.light].verdict == LIGHT_BEHIND_FACE ||
                   rounding->exact.hits[part.hit].lights[part.light].verdict == LIGHT_BEHIND_FACE;
    return by_side ? side_words(rounding, path, part) : light_words(rounding, path, part);
}

InkText rounding_textbook_words(const Rounding *rounding, RoundingPart part)
{
    return part.light < 0 ? textbook_face(rounding, part.hit) : verdict_words(rounding, &rounding->textbook, part);
}

InkText rounding_exact_words(const Rounding *rounding, RoundingPart part)
{
    return part.light < 0 ? exact_face(rounding, part.hit) : verdict_words(rounding, &rounding->exact, part);
}
