/* Traces a pixel with a slip: the loop of the algorithm, whose steps come from a table. */
#include "grade/slip_trace.h"

typedef struct SlipTracer {
    const Scene *scene;
    SlipSteps steps;
    Recorder recorder;
} SlipTracer;

#define RECORD(tracer, ...) (tracer)->recorder.record((tracer)->recorder.user, &(Event){.kind = __VA_ARGS__})

/* Steps 3 to 5. The face that the ray leaves is asked, too: rightly done, it never answers. */
static SlipHit nearest_hit(const SlipTracer *tracer, Ray ray)
{
    SlipHit nearest = {.face = -1, .ray = ray};
    for (int i = 0; i < tracer->scene->face_count; i++) {
        FaceTest test = tracer->steps.test(tracer->scene, i, ray);
        if (test.verdict != FACE_INSIDE || !tracer->steps.nearer(&nearest, test.t_in_box))
            continue;
        nearest.face = i;
        nearest.test = test;
    }
    return nearest;
}

static void place_hit(const SlipTracer *tracer, SlipHit *hit, Ray primary, int bounces)
{
    hit->primary = primary;
    hit->r = vec3_unit(hit->ray.direction);
    hit->point = tracer->steps.point(tracer->scene, hit->ray, hit->test.t);
    hit->normal = tracer->steps.normal(tracer->scene, hit);
    hit->shifted = tracer->steps.shifted(tracer->scene, hit);
    RECORD(tracer, EVENT_HIT, .as.hit = {hit->face, hit->test, hit->point, hit->normal, hit->shifted, bounces});
}

/* Step 6 for one face. */
static bool is_between(const SlipTracer *tracer, int face, Vec3 from, Vec3 to)
{
    if (tracer->steps.between)
        return tracer->steps.between(tracer->scene, face, from, to).verdict == FACE_INSIDE;
    FaceTest test = tracer->steps.test(tracer->scene, face, (Ray){from, vec3_sub(to, from)});
    return test.verdict == FACE_INSIDE && test.t < 1;
}

/* Step 6. */
static int find_blocker(const SlipTracer *tracer, const SlipHit *hit, Vec3 light)
{
    for (int i = 0; i < tracer->scene->face_count; i++)
        if (is_between(tracer, i, hit->shifted, light))
            return i;
    return -1;
}

static void record_light(const SlipTracer *tracer, const SlipHit *hit, int index, int side)
{
    Vec3 position = tracer->scene->lights[index].position, way = vec3_sub(position, hit->point);
    Vec3 from_vertex = vec3_sub(position, face_vertex(&tracer->scene->faces[hit->face], 0));
    double height = side == 0 ? 0 : vec3_dot(hit->normal, from_vertex);
    RECORD(
        tracer, EVENT_LIGHT,
        .as.light = {index, side, position, way, vec3_length(way), height, tracer->steps.to_light(way), hit->shifted});
}

/* Step 6. */
static bool light_reaches(const SlipTracer *tracer, const SlipHit *hit, int index)
{
    int side = tracer->steps.side(tracer->scene, hit, index);
    record_light(tracer, hit, index, side);
    int blocker = side > 0 ? find_blocker(tracer, hit, tracer->scene->lights[index].position) : -1;
    LightVerdict verdict = side <= 0 ? LIGHT_BEHIND_FACE : blocker >= 0 ? LIGHT_BLOCKED : LIGHT_REACHES;
    RECORD(tracer, EVENT_LIGHT_END, .as.light_end = {index, verdict, blocker});
    return verdict == LIGHT_REACHES;
}

/* Steps 6 to 8. */
static Vec3 shade(const SlipTracer *tracer, const SlipHit *hit, int *reaching)
{
    const Scene *scene = tracer->scene;
    Vec3 sum = {0, 0, 0}, v = tracer->steps.viewer(scene, hit);
    *reaching = 0;
    for (int i = 0; i < scene->light_count; i++) {
        SlipShine shine = {scene,
                           hit,
                           i,
                           scene->materials[scene->faces[hit->face].material],
                           scene->lights[i],
                           tracer->steps.to_light(vec3_sub(scene->lights[i].position, hit->point)),
                           v,
                           light_reaches(tracer, hit, i),
                           *reaching};
        *reaching += shine.reaches;
        if (!shine.reaches && scene->shading.shadow == SHADOW_BLACK)
            continue;
        if (tracer->steps.colours)
            tracer->steps.colours(&shine.material, &shine.light);
        Illumination terms = tracer->steps.terms(&shine);
        Vec3 light = tracer->steps.lit(&shine, &terms);
        sum = tracer->steps.add_light(sum, light);
        RECORD(tracer, EVENT_TERMS,
               .as.terms = {i, terms, shine.l, v, light, shine.material.shininess / 4, !shine.reaches});
    }
    return sum;
}

static Vec3 end_path(const SlipTracer *tracer, PathEnd reason, Vec3 total, int bounces)
{
    RECORD(tracer, EVENT_PATH_END, .as.path_end = {reason, total, bounces});
    return total;
}

/* Steps 3 to 9. */
static Vec3 trace_path(const SlipTracer *tracer, Ray primary)
{
    const Scene *scene = tracer->scene;
    const SlipSteps *steps = &tracer->steps;
    Ray ray = primary;
    Vec3 total = {0, 0, 0};
    double weight = 1;
    for (int bounces = 0;; bounces++) {
        SlipHit hit = nearest_hit(tracer, ray);
        if (hit.face < 0) {
            Vec3 seen = steps->miss(weight, scene->shading.background);
            RECORD(tracer, EVENT_MISS, .as.miss = {scene->shading.background, seen, weight});
            return end_path(tracer, PATH_MISSED, steps->add_hit(total, seen), bounces);
        }
        place_hit(tracer, &hit, primary, bounces);
        const Material *material = &scene->materials[scene->faces[hit.face].material];
        SlipEnd end = {scene, material, 0, bounces};
        Vec3 illumination = shade(tracer, &hit, &end.reaching);
        Vec3 contribution = steps->contribution(weight, illumination, material);
        total = steps->add_hit(total, contribution);
        RECORD(tracer, EVENT_SHADED, .as.shaded = {illumination, contribution, total, weight, end.reaching});
        PathEnd reason;
        if (steps->ends(&end, &reason) || bounces == SCENE_MAX_BOUNCES)
            return end_path(tracer, reason, total, bounces);
        ray = steps->reflected(&hit);
        weight = steps->weight(weight, material->reflection);
        RECORD(tracer, EVENT_REFLECTED,
               .as.reflected = {hit.r, ray.direction, ray.origin, material->reflection, weight, bounces + 1});
    }
}

static Vec3 clamped(Vec3 c)
{
    return vec3(fmin(fmax(c.x, 0), 1), fmin(fmax(c.y, 0), 1), fmin(fmax(c.z, 0), 1));
}

static void end_pixel(const SlipTracer *tracer, Vec3 sum, int samples)
{
    Vec3 average = tracer->steps.average(sum, samples);
    Event pixel = {.kind = EVENT_PIXEL, .as.pixel = {sum, average, clamped(average), samples, {0, 0, 0}}};
    tracer->steps.bytes(average, pixel.as.pixel.rgb);
    tracer->recorder.record(tracer->recorder.user, &pixel);
}

/* Step 1. */
static Ray primary_ray(const SlipTracer *tracer, const View *view, const Event *sample)
{
    ScreenPoint at = tracer->steps.screen_point(view, sample);
    Ray ray = {view->eye, tracer->steps.direction(view, at)};
    RECORD(tracer, EVENT_SAMPLE,
           .as.sample = {sample->as.sample.column, sample->as.sample.row, sample->as.sample.i, sample->as.sample.j, at,
                         ray.origin, vec3_add(ray.origin, ray.direction), ray.direction});
    return ray;
}

bool slip_trace(Walkthrough *walk, const Walkthrough *right, const SlipSteps *slip, Error *error)
{
    Scene scene = *right->scene;
    scene.grid = right->grid;
    if (slip->scene)
        slip->scene(&scene);
    walkthrough_begin(walk, right->scene, right->scene_name, right->request);
    SlipTracer tracer = {&scene, slip_steps_of(slip), walkthrough_recorder(walk)};
    View view = tracer.steps.view(&scene);
    Vec3 sum = {0, 0, 0};
    int samples = 0;
    for (long i = 0; i < right->count; i++) {
        if (right->events[i].kind != EVENT_SAMPLE)
            continue;
        sum = vec3_add(sum, trace_path(&tracer, primary_ray(&tracer, &view, &right->events[i])));
        samples++;
    }
    end_pixel(&tracer, sum, samples);
    walk->grid = right->grid;
    return !walk->failed || error_memory(error, "a walkthrough with a slip");
}
