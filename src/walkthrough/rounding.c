/* Collects the textbook's path and the exact one in the same form. */
#include "walkthrough/rounding.h"

#include <stdlib.h>
#include <string.h>

/* --- Both paths --- */

static bool path_new(RoundingPath *path, const Scene *scene)
{
    size_t hits = (size_t)scene->shading.max_bounces + 1, lights = (size_t)scene->light_count;
    path->hits = calloc(hits, sizeof *path->hits);
    path->lights = calloc(hits * lights + 1, sizeof *path->lights);
    return path->hits && path->lights;
}

static void path_free(RoundingPath *path)
{
    free(path->hits);
    free(path->lights);
}

static void add_hit(RoundingPath *path, const Scene *scene, RoundingHit hit)
{
    hit.lights = path->lights + (size_t)path->count * (size_t)scene->light_count;
    path->hits[path->count++] = hit;
}

static void add_light(RoundingPath *path, RoundingLight light)
{
    RoundingHit *hit = &path->hits[path->count - 1];
    hit->lights[hit->light_count++] = light;
}

/* The height of a point over the face's plane, on the side of the normal. Its sign is exact, its size is rounded. */
static double height_above(const Scene *scene, int face, Vec3 normal, Vec3 point)
{
    const Face *shape = &scene->faces[face];
    const Plane *plane = &scene->planes[face];
    int side = plane_side(shape, plane, point);
    int turned = vec3_dot(plane->normal, normal) < 0 ? -1 : 1;
    double height = vec3_dot(plane->normal, vec3_sub(point, face_vertex(shape, 0)));
    return side * turned * fabs(height);
}

/* --- From the events --- */

static RoundingHit hit_of(const Scene *scene, const WalkthroughPlace *place, const Event *event)
{
    return (RoundingHit){
        .ray = place->ray,
        .face = event->as.hit.face,
        .t = event->as.hit.test.t,
        .point = event->as.hit.point,
        .shifted = event->as.hit.shifted,
        .above = height_above(scene, event->as.hit.face, event->as.hit.normal, event->as.hit.shifted),
    };
}

static RoundingLight light_of(const WalkthroughPlace *place, const Event *event)
{
    const Event *light = place->light;
    Vec3 from = light->as.light.shadow_origin;
    return (RoundingLight){
        .verdict = event->as.light_end.verdict,
        .blocker = event->as.light_end.blocker,
        .height = light->as.light.height,
        .ray = {from, vec3_sub(light->as.light.position, from)},
    };
}

static void read_path(RoundingPath *path, const Walkthrough *walk)
{
    WalkthroughPlace place = {0};
    for (long i = 0; i < walk->count; i++) {
        const Event *event = &walk->events[i];
        walkthrough_follow(&place, walk, event);
        if (event->kind == EVENT_PIXEL)
            memcpy(path->rgb, event->as.pixel.rgb, sizeof path->rgb);
        if (!place.told)
            continue;
        if (event->kind == EVENT_HIT)
            add_hit(path, walk->scene, hit_of(walk->scene, &place, event));
        else if (event->kind == EVENT_MISS)
            add_hit(path, walk->scene, (RoundingHit){.ray = place.ray, .face = -1});
        else if (event->kind == EVENT_LIGHT_END)
            add_light(path, light_of(&place, event));
        else if (event->kind == EVENT_PATH_END)
            path->colour = event->as.path_end.colour;
    }
}

/* --- The textbook's walkthrough --- */

static Textbook textbook_of(const Rounding *rounding)
{
    return (Textbook){.scene = rounding->walk->scene, .shift = rounding->shift};
}

static bool tell_textbook(Rounding *rounding, Error *error)
{
    const Walkthrough *walk = rounding->walk;
    RenderReport report = {0};
    unsigned char rgb[3];
    Textbook textbook = textbook_of(rounding);
    Recorder recorder = walkthrough_recorder(&rounding->told);
    walkthrough_begin(&rounding->told, walk->scene, walk->scene_name, walk->request);
    textbook.report = &report;
    textbook.recorder = &recorder;
    (rounding->precision == PRECISION_FLOAT ? textbook_pixel_float : textbook_pixel)(&textbook, walk->request.column,
                                                                                     walk->request.row, rgb);
    return !rounding->told.failed || error_memory(error, "the walkthrough");
}

FaceTest rounding_textbook_test(const Rounding *rounding, int face, Ray ray)
{
    Textbook textbook = textbook_of(rounding);
    return (rounding->precision == PRECISION_FLOAT ? textbook_test_float : textbook_test)(&textbook, face, ray).test;
}

/* Of a ray from the origin N.O + D = D. */
double rounding_textbook_d(const Rounding *rounding, int face)
{
    return rounding_textbook_test(rounding, face, (Ray){{0, 0, 0}, {1, 0, 0}}).n_dot_o_plus_d;
}

bool rounding_make(Rounding *rounding, const Walkthrough *walk, const RenderSettings *settings, Error *error)
{
    const Scene *scene = walk->scene;
    *rounding = (Rounding){.walk = walk, .precision = settings->precision, .shift = settings->shift};
    if (scene->adaptive && scene->grid > 1)
        return error_set(error, ERROR_USAGE, "textbook arithmetic has no adaptive sampling; use --sampling uniform:N");
    if (!path_new(&rounding->textbook, scene) || !path_new(&rounding->exact, scene))
        return error_memory(error, "the walkthrough");
    if (!tell_textbook(rounding, error))
        return false;
    read_path(&rounding->textbook, &rounding->told);
    read_path(&rounding->exact, walk);
    return true;
}

void rounding_free(Rounding *rounding)
{
    path_free(&rounding->textbook);
    path_free(&rounding->exact);
    walkthrough_free(&rounding->told);
    *rounding = (Rounding){0};
}

/* --- Where they part --- */

bool rounding_same_face(const Rounding *rounding, int k)
{
    const RoundingPath *textbook = &rounding->textbook, *exact = &rounding->exact;
    return k < textbook->count && k < exact->count && textbook->hits[k].face == exact->hits[k].face;
}

bool rounding_same_verdict(const Rounding *rounding, int k, int light)
{
    return rounding->textbook.hits[k].lights[light].verdict == rounding->exact.hits[k].lights[light].verdict;
}

RoundingPart rounding_part(const Rounding *rounding)
{
    const RoundingPath *exact = &rounding->exact;
    for (int k = 0; k < exact->count; k++) {
        if (!rounding_same_face(rounding, k))
            return (RoundingPart){k, -1};
        for (int light = 0; light < exact->hits[k].light_count; light++)
            if (!rounding_same_verdict(rounding, k, light))
                return (RoundingPart){k, light};
    }
    return (RoundingPart){-1, -1};
}
