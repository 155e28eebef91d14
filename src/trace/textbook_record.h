/* What happens in textbook.c, as the events of trace/recorder.h, so that the walkthrough can tell it. Nothing is
 * computed here but what an event shows. Included by textbook.c and its steps, and so compiled in either precision. */
#ifndef RECTRAY_TEXTBOOK_RECORD_H
#define RECTRAY_TEXTBOOK_RECORD_H

#include "trace/recorder.h"
#include "trace/textbook_real.h"

/* Records an event. Without a recorder it costs one comparison; the event is not even built. */
#define RECORD(recorder, ...)                                                    \
    do {                                                                         \
        if (recorder)                                                            \
            (recorder)->record((recorder)->user, &(Event){.kind = __VA_ARGS__}); \
    } while (0)

/* `hit`: hits() said so. */
static FaceTest test_of(const Hit *test, bool hit)
{
    FaceTest result = {.n_dot_r = (double)test->n_dot_r,
                       .n_dot_o_plus_d = (double)test->n_dot_o_plus_d,
                       .edges = test->edges,
                       .outside_edge = -1};
    if (test->n_dot_r != 0)
        result.t = result.t_in_box = (double)test->t;
    for (int k = 0; k < test->edges; k++) {
        result.edge_value[k] = (double)test->edge[k];
        result.edge_sign[k] = (test->edge[k] > 0) - (test->edge[k] < 0);
        if (test->edge[k] < 0)
            result.outside_edge = k;
    }
    result.verdict = hit                        ? FACE_INSIDE
                     : test->n_dot_r == 0       ? FACE_PARALLEL
                     : !(result.t > 0)          ? FACE_BEHIND
                     : result.outside_edge >= 0 ? FACE_OUTSIDE
                                                : FACE_BACK;
    return result;
}

typedef struct Place {
    int column, row, i, j;
} Place;

static void record_sample(const Recorder *recorder, Place at, Real x, Real y, RealRay ray)
{
    RECORD(recorder, EVENT_SAMPLE,
           .as.sample = {at.column,
                         at.row,
                         at.i,
                         at.j,
                         {(double)x, (double)y},
                         doubles(ray.o),
                         doubles(add(ray.o, ray.r)),
                         doubles(ray.r)});
}

static void record_face(const Recorder *recorder, const Hit *test, bool hit, Real nearest_t)
{
    RECORD(recorder, EVENT_FACE, .as.face = {test->face, test_of(test, hit), (double)nearest_t});
}

/* A face that is hit at t = 1 or later lies beyond the light. */
static void record_occluder(const Recorder *recorder, const Hit *test, bool hit)
{
    if (!recorder)
        return;
    FaceTest result = test_of(test, hit);
    if (hit && !(test->t < 1))
        result.verdict = FACE_FARTHER;
    RECORD(recorder, EVENT_OCCLUDER, .as.occluder = {test->face, result});
}

static void record_hit(const Recorder *recorder, const Hit *hit, int bounces)
{
    RECORD(recorder, EVENT_HIT,
           .as.hit = {hit->face, test_of(hit, true), doubles(hit->p), doubles(hit->n), doubles(hit->shifted), bounces});
}

static void record_light(const Recorder *recorder, const Hit *hit, int index, Real3 light, Real height)
{
    if (!recorder)
        return;
    Real3 to_light = subtract(light, hit->p);
    RECORD(recorder, EVENT_LIGHT,
           .as.light = {index, (height > 0) - (height < 0), doubles(light), doubles(to_light),
                        (double)sqrt(dot(to_light, to_light)), (double)height, doubles(unit(to_light)),
                        doubles(hit->shifted)});
}

static void record_light_end(const Recorder *recorder, int index, LightVerdict verdict, int blocker)
{
    RECORD(recorder, EVENT_LIGHT_END, .as.light_end = {index, verdict, blocker});
}

static void record_terms(const Recorder *recorder, const Material *material, int index, const Terms *terms, Real3 sum,
                         bool reaches)
{
    Illumination parts = {doubles(terms->ambient), doubles(terms->diffuse), doubles(terms->specular),
                          doubles(terms->h),       (double)terms->l_dot_n,  (double)terms->n_dot_h};
    RECORD(recorder, EVENT_TERMS,
           .as.terms = {index, parts, doubles(terms->l), doubles(terms->v), doubles(sum), material->shininess / 4,
                        !reaches});
}

static void record_shaded(const Recorder *recorder, Real3 illumination, Real weight, Real3 total, int reaching)
{
    RECORD(recorder, EVENT_SHADED,
           .as.shaded = {doubles(illumination), doubles(scale(weight, illumination)), doubles(total), (double)weight,
                         reaching});
}

static void record_reflected(const Recorder *recorder, Real3 r, RealRay ray, Real reflection, Real weight, int bounce)
{
    RECORD(recorder, EVENT_REFLECTED,
           .as.reflected = {doubles(r), doubles(ray.r), doubles(ray.o), (double)reflection, (double)weight, bounce});
}

static void record_miss(const Recorder *recorder, Vec3 background, Real3 seen, Real weight)
{
    RECORD(recorder, EVENT_MISS, .as.miss = {background, doubles(seen), (double)weight});
}

/* Gives the path's colour back. */
static Real3 end_path(const Recorder *recorder, PathEnd reason, Real3 colour, int bounces)
{
    RECORD(recorder, EVENT_PATH_END, .as.path_end = {reason, doubles(colour), bounces});
    return colour;
}

static void record_pixel(const Recorder *recorder, int samples, Real3 sum, Real3 average, const unsigned char *rgb)
{
    Vec3 a = doubles(average), clamped = {fmin(fmax(a.x, 0), 1), fmin(fmax(a.y, 0), 1), fmin(fmax(a.z, 0), 1)};
    RECORD(recorder, EVENT_PIXEL, .as.pixel = {doubles(sum), a, clamped, samples, {rgb[0], rgb[1], rgb[2]}});
}

#endif
