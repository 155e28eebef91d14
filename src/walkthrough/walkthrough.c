/* Records one pixel. A face that a ray does not hit is counted and forgotten, unless all shall be told, so that a scene
 * of a hundred thousand faces leaves a list no longer than a scene of six. */
#include "walkthrough/walkthrough.h"

#include "trace/adaptive.h"
#include "trace/reference.h"

#include <stdlib.h>

const char *const walkthrough_face_verdicts[] = {
    [FACE_PARALLEL] = "parallel", [FACE_BEHIND] = "behind", [FACE_BACK] = "back", [FACE_FARTHER] = "farther",
    [FACE_OUTSIDE] = "outside",   [FACE_INSIDE] = "inside", [FACE_LEFT] = "left",
};
const char *const walkthrough_node_verdicts[] = {
    [NODE_ENTERED] = "entered",
    [NODE_MISSED] = "missed",
    [NODE_BEYOND] = "beyond",
    [NODE_UNNEEDED] = "unneeded",
};
const char *const walkthrough_light_verdicts[] = {
    [LIGHT_BEHIND_FACE] = "behind face",
    [LIGHT_BLOCKED] = "blocked",
    [LIGHT_REACHES] = "reaches",
};
const char *const walkthrough_path_ends[] = {
    [PATH_MISSED] = "missed",
    [PATH_IN_SHADOW] = "in shadow",
    [PATH_NOT_MIRROR] = "not a mirror",
    [PATH_MAX_BOUNCES] = "max bounces",
};
const char *const walkthrough_adaptive_reasons[] = {
    [ADAPTIVE_SAME] = "same",     [ADAPTIVE_EDGE] = "edge",           [ADAPTIVE_FACE] = "face",
    [ADAPTIVE_SHADOW] = "shadow", [ADAPTIVE_HIGHLIGHT] = "highlight",
};

/* --- Recording --- */

static void append(Walkthrough *walk, const Event *event)
{
    if (walk->failed)
        return;
    if (walk->count == walk->capacity) {
        long capacity = walk->capacity ? 2 * walk->capacity : 64;
        Event *events = realloc(walk->events, (size_t)capacity * sizeof *events);
        if (!events) {
            walk->failed = true;
            return;
        }
        walk->events = events;
        walk->capacity = capacity;
    }
    walk->events[walk->count++] = *event;
}

bool walkthrough_is_hit(const FaceTest *test)
{
    return test->verdict == FACE_INSIDE || (test->verdict == FACE_FARTHER && test->edges > 0 && test->outside_edge < 0);
}

/* Keeps the nearest hits of the ray, in the order of the faces. */
static void keep_hit(Walkthrough *walk, const Event *event)
{
    walk->hits[walk->hit_count++] = *event;
    if (walk->hit_count <= WALKTHROUGH_HITS_TOLD)
        return;
    int farthest = 0;
    for (int i = 1; i < walk->hit_count; i++)
        if (walk->hits[i].as.face.test.t >= walk->hits[farthest].as.face.test.t)
            farthest = i;
    walk->hit_count--;
    for (int i = farthest; i < walk->hit_count; i++)
        walk->hits[i] = walk->hits[i + 1];
}

/* The current search's tally, which its first event begins. NULL without memory. */
static Event *tally_of(Walkthrough *walk)
{
    if (walk->tally < 0) {
        walk->tally = walk->count;
        append(walk, &(Event){.kind = EVENT_TALLY, .as.tally.shadow = walk->shadow});
    }
    return walk->failed ? NULL : &walk->events[walk->tally];
}

static void count_node(Walkthrough *walk, const Event *event)
{
    Event *tally = tally_of(walk);
    if (!tally)
        return;
    NodeVerdict verdict = event->as.node.visit.verdict;
    tally->as.tally.nodes_met++;
    tally->as.tally.nodes[verdict]++;
    tally->as.tally.leaves += verdict == NODE_ENTERED && event->as.node.shape.leaf;
    append(walk, event);
}

/* A face was tested, against the path's ray or against a shadow ray. */
static void count_face(Walkthrough *walk, const Event *event)
{
    const FaceTest *test = walk->shadow ? &event->as.occluder.test : &event->as.face.test;
    Event *tally = tally_of(walk);
    if (!tally)
        return;
    tally->as.tally.tested += test->verdict != FACE_LEFT;
    tally->as.tally.verdicts[test->verdict]++;
    if (walk->request.verbose || (walk->shadow && test->verdict == FACE_INSIDE))
        append(walk, event);
    else if (!walk->shadow && walkthrough_is_hit(test))
        keep_hit(walk, event);
}

/* The search is over. */
static void end_ray(Walkthrough *walk)
{
    for (int i = 0; i < walk->hit_count; i++)
        append(walk, &walk->hits[i]);
    walk->hit_count = 0;
    walk->tally = -1;
}

static bool is_told(const WalkthroughRequest *request, const Event *sample)
{
    return sample->as.sample.i == request->i && sample->as.sample.j == request->j;
}

static void record(void *user, const Event *event)
{
    Walkthrough *walk = user;
    WalkthroughRequest *request = &walk->request;
    if (event->kind == EVENT_ADAPTIVE && event->as.adaptive.reason == ADAPTIVE_SAME) {
        walk->grid = 1;
        request->i = request->j = 0;
    } else if (event->kind == EVENT_ADAPTIVE) {
        walk->grid = adaptive_samples(walk->scene->grid);
    }
    if (event->kind == EVENT_SAMPLE)
        walk->found |= walk->telling = is_told(request, event);
    bool always = event->kind == EVENT_ADAPTIVE || event->kind == EVENT_SAMPLE || event->kind == EVENT_PATH_END ||
                  event->kind == EVENT_PIXEL;
    if (!walk->telling && !always)
        return;
    if (event->kind == EVENT_NODE) {
        count_node(walk, event);
        return;
    }
    if (event->kind == EVENT_FACE || event->kind == EVENT_OCCLUDER) {
        count_face(walk, event);
        return;
    }
    walk->shadow = event->kind == EVENT_LIGHT;
    if (event->kind == EVENT_HIT || event->kind == EVENT_MISS || event->kind == EVENT_LIGHT_END)
        end_ray(walk);
    append(walk, event);
}

void walkthrough_begin(Walkthrough *walk, const Scene *scene, const char *scene_name, WalkthroughRequest request)
{
    *walk =
        (Walkthrough){.scene = scene, .scene_name = scene_name, .request = request, .grid = scene->grid, .tally = -1};
}

Recorder walkthrough_recorder(Walkthrough *walk)
{
    return (Recorder){record, walk};
}

bool walkthrough_record(Walkthrough *walk, const Scene *scene, const Accel *accel, const char *scene_name,
                        WalkthroughRequest request, Error *error)
{
    walkthrough_begin(walk, scene, scene_name, request);
    RenderReport report = {0};
    Recorder recorder = walkthrough_recorder(walk);
    Tracer tracer = {.scene = scene, .accel = accel, .report = &report, .recorder = &recorder};
    reference_pixel(&tracer, request.column, request.row);
    if (walk->failed)
        return error_memory(error, "the walkthrough");
    return walk->found ||
           error_set(error, ERROR_USAGE,
                     "--sample %d,%d: adaptive sampling traces one sample in each column of pixel %d,%d, in column %d "
                     "that of row %d; with --sampling uniform it is %d x %d",
                     request.i, request.j, request.column, request.row, request.i,
                     request.i * adaptive_generator(walk->grid) % walk->grid, scene->grid, scene->grid);
}

void walkthrough_free(Walkthrough *walk)
{
    free(walk->events);
    *walk = (Walkthrough){0};
}

/* --- Reading --- */

void walkthrough_follow(WalkthroughPlace *place, const Walkthrough *walk, const Event *event)
{
    if (event->kind == EVENT_SAMPLE) {
        *place = (WalkthroughPlace){.sample = event, .ray = {event->as.sample.c, event->as.sample.r}, .weight = 1};
        place->told = is_told(&walk->request, event);
    } else if (event->kind == EVENT_HIT) {
        place->hit = event;
        place->length = vec3_length(place->ray.direction);
    } else if (event->kind == EVENT_LIGHT) {
        place->light = event;
    } else if (event->kind == EVENT_TALLY) {
        place->shadow = event->as.tally.shadow;
    } else if (event->kind == EVENT_REFLECTED) {
        place->ray = (Ray){event->as.reflected.origin, event->as.reflected.direction};
        place->weight = event->as.reflected.weight;
    }
}

int walkthrough_hit_number(const WalkthroughPlace *place)
{
    return place->hit ? place->hit->as.hit.step + 1 : 0;
}

WalkthroughEdge walkthrough_edge(const Face *face, int k, Vec3 point)
{
    Vec3 from = face_vertex(face, k), to = face_vertex(face, (k + 1) % face->vertex_count);
    return (WalkthroughEdge){vec3_sub(to, from), vec3_sub(point, from)};
}

WalkthroughSides walkthrough_sides(const Face *face)
{
    Vec3 v0 = face_vertex(face, 0), v1 = face_vertex(face, 1), v2 = face_vertex(face, 2);
    if (face->vertex_count == 3)
        return (WalkthroughSides){vec3_sub(v1, v0), vec3_sub(v2, v0)};
    return (WalkthroughSides){vec3_sub(v2, v0), vec3_sub(face_vertex(face, 3), v1)};
}

Ray walkthrough_search_ray(const WalkthroughPlace *place)
{
    if (!place->shadow)
        return place->ray;
    Vec3 from = place->light->as.light.shadow_origin;
    return (Ray){from, vec3_sub(place->light->as.light.position, from)};
}

Vec3 walkthrough_to_viewer(const Scene *scene, const WalkthroughPlace *place)
{
    return scene->shading.viewer == VIEWER_RAY ? vec3_negate(place->ray.direction)
                                               : vec3_sub(scene->camera.position, place->hit->as.hit.point);
}

Vec3 walkthrough_world(const Scene *scene, Vec3 position)
{
    return vec3_add(position, scene->centre);
}

int walkthrough_face_in_object(const Scene *scene, int face)
{
    const Object *object = &scene->objects[scene->faces[face].object];
    return scene->faces[face].number - object->first_number;
}

WalkthroughPiece walkthrough_piece(const Scene *scene, int face)
{
    int first = face, end = face + 1, number = scene->faces[face].number;
    while (first > 0 && scene->faces[first - 1].number == number)
        first--;
    while (end < scene->face_count && scene->faces[end].number == number)
        end++;
    return (WalkthroughPiece){face - first + 1, end - first};
}

double walkthrough_scene_size(const Scene *scene)
{
    Vec3 low = scene->camera.position, high = low;
    for (int i = 0; i < scene->face_count; i++)
        for (int k = 0; k < scene->faces[i].vertex_count; k++) {
            Vec3 p = face_vertex(&scene->faces[i], k);
            low = vec3(fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z));
            high = vec3(fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z));
        }
    return fmax(high.x - low.x, fmax(high.y - low.y, high.z - low.z));
}
