/* The reference tracer: the algorithm of docs/algorithm.md, scalar, in double, as plainly as it can be said.
 * The step numbers in the comments are that document's. What happens is recorded, where there is a recorder. */
#include "trace/reference.h"

#include <math.h>
#include <stddef.h>

typedef struct Hit {
    int face; /* -1: none */
    FaceTest test;
    Vec3 point;   /* P */
    Vec3 normal;  /* N turned to the side that the ray came from */
    Vec3 shifted; /* P moved off the face along N */
} Hit;

/* A ray's or a shadow ray's search among the faces. */
typedef struct Search {
    const Tracer *tracer;
    Ray ray;
    Vec3 to;     /* where a shadow ray ends */
    int from;    /* the face that it leaves, -1 for none */
    Hit *hit;    /* the nearest so far */
    int blocker; /* the face in a shadow ray's way, -1 for none */
} Search;

/* Records an event. Without a recorder it costs one comparison; the event is not even built. */
#define RECORD(tracer, ...)                                           \
    do {                                                              \
        if ((tracer)->recorder)                                       \
            record((tracer)->recorder, (Event){.kind = __VA_ARGS__}); \
    } while (0)

static void record(const Recorder *recorder, Event event)
{
    recorder->record(recorder->user, &event);
}

static Vec3 unit_or_zero(Vec3 a)
{
    return vec3_dot(a, a) > 0 ? vec3_unit(a) : a;
}

static Vec3 point_at(Ray ray, double t)
{
    return vec3_add(ray.origin, vec3_scale(t, ray.direction));
}

static void record_node(const Traversal *traversal, TraversalNode visit)
{
    const Search *search = traversal->user;
    const Tracer *tracer = search->tracer;
    RECORD(tracer, EVENT_NODE, .as.node = {visit, accel_node(tracer->accel, visit.node)});
}

/* Shows `visit` the faces that the ray may meet before t = limit: those that the tree finds, or all in file order. */
static void search_faces(Search *search, Ray ray, double limit, bool (*visit)(Traversal *traversal, int face))
{
    const Tracer *tracer = search->tracer;
    Traversal traversal = {
        .origin = ray.origin, .direction = ray.direction, .limit = limit, .visit = visit, .user = search};
    traversal.node = tracer->recorder ? record_node : NULL;
    if (accel_has_tree(tracer->accel))
        accel_traverse(tracer->accel, &traversal);
    else
        for (int i = 0; i < tracer->scene->face_count && visit(&traversal, i); i++)
            continue;
    tracer->report->box_tests += traversal.box_tests;
}

/* Steps 3 to 5 for one face: is it the nearest so far? Of equal ones, the first in the file is. */
static bool visit_for_nearest(Traversal *traversal, int face)
{
    Search *search = traversal->user;
    const Tracer *tracer = search->tracer;
    Hit *nearest = search->hit;
    FaceTest test = {.verdict = FACE_LEFT, .outside_edge = -1};
    if (face != search->from) {
        test = face_test(&tracer->scene->faces[face], &tracer->scene->planes[face], search->ray, traversal->limit,
                         tracer->recorder != NULL);
        tracer->report->face_tests++;
    }
    RECORD(tracer, EVENT_FACE, .as.face = {face, test, nearest->test.t});
    bool nearer = test.t_in_box < traversal->limit || (test.t_in_box == traversal->limit && face < nearest->face);
    if (test.verdict == FACE_INSIDE && nearer) {
        nearest->face = face;
        nearest->test = test;
        traversal->limit = test.t_in_box;
    }
    return true;
}

/* Steps 3 to 5: the face with the smallest t > 0; of equal ones, the first in the file. */
static Hit nearest_hit(const Tracer *tracer, Ray ray, int from)
{
    Hit nearest = {.face = -1, .test = {.t = HUGE_VAL}};
    Search search = {.tracer = tracer, .ray = ray, .from = from, .hit = &nearest};
    search_faces(&search, ray, HUGE_VAL, visit_for_nearest);
    return nearest;
}

/* The point of the hit, the normal on the ray's side, and the point from which the next rays start. */
static void place_hit(const Scene *scene, Ray ray, Hit *hit)
{
    const Plane *plane = &scene->planes[hit->face];
    hit->point = point_at(ray, hit->test.t);
    hit->normal = hit->test.n_dot_r > 0 ? vec3_negate(plane->normal) : plane->normal;
    hit->shifted = point_shifted(&scene->faces[hit->face], plane, hit->normal, hit->point);
}

/* Step 6 for one face: is it strictly between the shifted point and the light? */
static bool visit_for_blocker(Traversal *traversal, int face)
{
    Search *search = traversal->user;
    const Tracer *tracer = search->tracer;
    if (face == search->from)
        return true;
    FaceTest test = face_test_segment(&tracer->scene->faces[face], &tracer->scene->planes[face], traversal->origin,
                                      search->to, tracer->recorder != NULL);
    tracer->report->face_tests++;
    RECORD(tracer, EVENT_OCCLUDER, .as.occluder = {face, test});
    if (test.verdict == FACE_INSIDE)
        search->blocker = face;
    return test.verdict != FACE_INSIDE;
}

/* Step 6: the first face met between the shifted point and the light (the first in the file, without a tree), or -1. */
static int find_blocker(const Tracer *tracer, const Hit *hit, const Light *light)
{
    Search search = {.tracer = tracer, .to = light->position, .from = hit->face, .blocker = -1};
    tracer->report->rays.shadow++;
    search_faces(&search, (Ray){hit->shifted, vec3_sub(light->position, hit->shifted)}, 1, visit_for_blocker);
    return search.blocker;
}

static void record_light(const Tracer *tracer, const Hit *hit, int index, int side)
{
    Vec3 position = tracer->scene->lights[index].position;
    Vec3 to_light = vec3_sub(position, hit->point);
    Vec3 from_vertex = vec3_sub(position, face_vertex(&tracer->scene->faces[hit->face], 0));
    double height = side == 0 ? 0 : vec3_dot(hit->normal, from_vertex);
    RECORD(tracer, EVENT_LIGHT,
           .as.light = {index, side, position, to_light, vec3_length(to_light), height, unit_or_zero(to_light),
                        hit->shifted});
}

/* Step 6 for one light: is it in front of the face, and does anything stand between? */
static LightVerdict look_at_light(const Tracer *tracer, const Hit *hit, int index)
{
    const Scene *scene = tracer->scene;
    const Light *light = &scene->lights[index];
    /* All points of the face see the light on the same side of its plane, so the plane decides: N.L <= 0. */
    int side = plane_side(&scene->faces[hit->face], &scene->planes[hit->face], light->position);
    side = hit->test.n_dot_r > 0 ? -side : side;
    bool behind = side <= 0;
    int blocker = -1;
    if (behind)
        tracer->report->skipped[SKIP_LIGHT_BEHIND]++;
    if (tracer->recorder)
        record_light(tracer, hit, index, side);
    if (!behind)
        blocker = find_blocker(tracer, hit, light);
    LightVerdict verdict = behind ? LIGHT_BEHIND_FACE : blocker >= 0 ? LIGHT_BLOCKED : LIGHT_REACHES;
    RECORD(tracer, EVENT_LIGHT_END, .as.light_end = {index, verdict, blocker});
    return verdict;
}

/* Steps 6 to 8: the illumination of a hit by all the lights; *reaching counts those not in shadow. */
static Vec3 shade(const Tracer *tracer, const Hit *hit, Vec3 v, int *reaching)
{
    const Scene *scene = tracer->scene;
    const Material *material = &scene->materials[scene->faces[hit->face].material];
    Vec3 colour = {0, 0, 0};
    *reaching = 0;
    for (int i = 0; i < scene->light_count; i++) {
        bool reaches = look_at_light(tracer, hit, i) == LIGHT_REACHES;
        *reaching += reaches;
        if (!reaches && scene->shading.shadow == SHADOW_BLACK)
            continue;
        Vec3 l = unit_or_zero(vec3_sub(scene->lights[i].position, hit->point));
        Illumination terms = illuminate(material, &scene->lights[i], hit->normal, l, v);
        Vec3 sum = terms.ambient;
        if (reaches)
            sum = vec3_add(vec3_add(terms.ambient, terms.diffuse), terms.specular);
        colour = vec3_add(colour, sum);
        RECORD(tracer, EVENT_TERMS, .as.terms = {i, terms, l, v, sum, material->shininess / 4, !reaches});
    }
    return colour;
}

/* Step 9: the ray that leaves the mirror. */
static Ray reflected_ray(const Hit *hit, Vec3 r)
{
    Vec3 direction = vec3_sub(r, vec3_scale(2 * vec3_dot(r, hit->normal), hit->normal));
    return (Ray){hit->shifted, direction};
}

/* Why a path ends at this hit; false if it goes on. */
static bool path_ends(const Scene *scene, const Material *material, int reaching, int bounces, PathEnd *reason)
{
    if (reaching == 0 && scene->shading.shadow == SHADOW_BLACK)
        *reason = PATH_IN_SHADOW;
    else if (material->reflection == 0)
        *reason = PATH_NOT_MIRROR;
    else if (bounces == scene->shading.max_bounces)
        *reason = PATH_MAX_BOUNCES;
    else
        return false;
    return true;
}

/* V: to the camera, or back along the ray that arrived, whose unit direction is r. */
static Vec3 viewer_direction(const Scene *scene, const Hit *hit, Vec3 r)
{
    if (scene->shading.viewer == VIEWER_RAY)
        return vec3_negate(r);
    return unit_or_zero(vec3_sub(scene->camera.position, hit->point));
}

static Vec3 end_path(const Tracer *tracer, PathEnd reason, Vec3 total, int bounces)
{
    RECORD(tracer, EVENT_PATH_END, .as.path_end = {reason, total, bounces});
    return total;
}

/* Steps 3 to 10 for one primary ray: the sum of the hits' illuminations, each weighted by the mirrors before it. */
static Vec3 trace_path(const Tracer *tracer, Ray ray)
{
    const Scene *scene = tracer->scene;
    Vec3 total = {0, 0, 0};
    double weight = 1;
    int left = -1; /* the face that the ray leaves */
    for (int bounces = 0;; bounces++) {
        Hit hit = nearest_hit(tracer, ray, left);
        if (tracer->path)
            tracer->path->faces[tracer->path->count++] = hit.face;
        if (hit.face < 0) {
            Vec3 seen = vec3_scale(weight, scene->shading.background);
            total = vec3_add(total, seen);
            RECORD(tracer, EVENT_MISS, .as.miss = {scene->shading.background, seen, weight});
            return end_path(tracer, PATH_MISSED, total, bounces);
        }
        place_hit(scene, ray, &hit);
        RECORD(tracer, EVENT_HIT, .as.hit = {hit.face, hit.test, hit.point, hit.normal, hit.shifted, bounces});

        Vec3 r = vec3_unit(ray.direction);
        int reaching;
        Vec3 illumination = shade(tracer, &hit, viewer_direction(scene, &hit, r), &reaching);
        Vec3 contribution = vec3_scale(weight, illumination);
        total = vec3_add(total, contribution);
        RECORD(tracer, EVENT_SHADED, .as.shaded = {illumination, contribution, total, weight, reaching});

        const Material *material = &scene->materials[scene->faces[hit.face].material];
        PathEnd reason;
        if (path_ends(scene, material, reaching, bounces, &reason))
            return end_path(tracer, reason, total, bounces);
        ray = reflected_ray(&hit, r);
        weight *= material->reflection;
        left = hit.face;
        tracer->report->rays.reflection++;
        RECORD(tracer, EVENT_REFLECTED,
               .as.reflected = {r, ray.direction, ray.origin, material->reflection, weight, bounces + 1});
    }
}

/* The sample of a grid of grid x grid. */
static Vec3 trace_sample(const Tracer *tracer, int grid, int column, int row, int i, int j)
{
    View view = view_of(tracer->scene);
    view.grid = grid;
    Ray ray = {view.eye, view_direction(&view, column, row, i, j)};
    if (tracer->path)
        tracer->path->count = 0;
    tracer->report->rays.primary++;
    RECORD(tracer, EVENT_SAMPLE,
           .as.sample = {column, row, i, j, view_screen_point(&view, column, row, i, j), ray.origin,
                         vec3_add(ray.origin, ray.direction), ray.direction});
    return trace_path(tracer, ray);
}

Vec3 reference_sample(const Tracer *tracer, int column, int row, int i, int j)
{
    return trace_sample(tracer, tracer->scene->grid, column, row, i, j);
}

static Vec3 clamped(Vec3 c)
{
    return vec3(fmin(fmax(c.x, 0), 1), fmin(fmax(c.y, 0), 1), fmin(fmax(c.z, 0), 1));
}

static Vec3 average_of(const Tracer *tracer, Vec3 sum, int samples)
{
    Vec3 average = vec3(sum.x / samples, sum.y / samples, sum.z / samples);
    RECORD(tracer, EVENT_PIXEL,
           .as.pixel = {sum,
                        average,
                        clamped(average),
                        samples,
                        {colour_to_byte(average.x), colour_to_byte(average.y), colour_to_byte(average.z)}});
    return average;
}

/* The average of a grid of samples. */
static Vec3 trace_grid(const Tracer *tracer, int grid, int column, int row)
{
    Vec3 sum = {0, 0, 0};
    for (int j = 0; j < grid; j++)
        for (int i = 0; i < grid; i++)
            sum = vec3_add(sum, trace_sample(tracer, grid, column, row, i, j));
    return average_of(tracer, sum, grid * grid);
}

/* The average of a lattice of samples. */
static Vec3 trace_lattice(const Tracer *tracer, int samples, int column, int row)
{
    int generator = adaptive_generator(samples);
    Vec3 sum = {0, 0, 0};
    for (int k = 0; k < samples; k++)
        sum = vec3_add(sum, trace_sample(tracer, samples, column, row, k, k * generator % samples));
    return average_of(tracer, sum, samples);
}

/* Adaptive sampling: the centre's colour where its path is the whole pixel's; else that of a lattice. */
static Vec3 trace_adaptive(const Tracer *tracer, int column, int row)
{
    Path path;
    Tracer silent = *tracer;
    silent.recorder = NULL;
    silent.path = &path;
    Vec3 centre = trace_grid(&silent, 1, column, row);
    AdaptiveVerdict verdict = adaptive_judge(tracer->scene, tracer->accel, &path, column, row, tracer->report);
    RECORD(tracer, EVENT_ADAPTIVE, .as.adaptive = verdict);
    bool refine = verdict.reason != ADAPTIVE_SAME;
    tracer->report->refined_pixels += refine;
    if (!refine && !tracer->recorder)
        return centre;
    return refine ? trace_lattice(tracer, adaptive_samples(tracer->scene->grid), column, row)
                  : trace_grid(tracer, 1, column, row);
}

Vec3 reference_pixel(const Tracer *tracer, int column, int row)
{
    const Scene *scene = tracer->scene;
    return scene->adaptive && scene->grid > 1 ? trace_adaptive(tracer, column, row)
                                              : trace_grid(tracer, scene->grid, column, row);
}

CastHit reference_nearest(const Tracer *tracer, Ray ray, int from)
{
    Hit hit = nearest_hit(tracer, ray, from);
    return (CastHit){hit.face, hit.face < 0 ? 0 : hit.test.t};
}
