/* Every pixel of scenes that between them take every branch of the tracer: the walkthrough's bytes are the picture's,
 * what it tells is in order, and each kind of event, each verdict and each end of a path occurs. */
#include "walkthrough/walkthrough.h"

#include "reader/scene_json.h"
#include "trace/reference_render.h"
#include "unity.h"

#include <stdlib.h>
#include <string.h>

static const char *const scenes[] = {"black", "ambient", "dark", "empty", "refined"};
enum { SCENES = 5 };

static Scene scene;
static Accel accel;
static Error error;
static Walkthrough walk;
static unsigned char *picture;

/* What has occurred, in any pixel of any scene. */
static struct {
    long kinds[EVENT_KIND_COUNT], adaptive[ADAPTIVE_HIGHLIGHT + 1], faces[FACE_VERDICT_COUNT],
        occluders[FACE_VERDICT_COUNT], edges[4];
    long light_verdicts[LIGHT_REACHES + 1], path_ends[PATH_MAX_BOUNCES + 1];
    long light_in_plane, on_edge, same_t, ambient_only, mirrored_background, clamped, from_behind, superseded;
} seen;

void setUp(void) {}

void tearDown(void)
{
    walkthrough_free(&walk);
    accel_free(&accel);
    scene_free(&scene);
    free(picture);
    picture = NULL;
}

static void load(const char *name)
{
    char path[128];
    snprintf(path, sizeof path, "tests/scenes/walkthrough/%s.json", name);
    error = (Error){.kind = ERROR_NONE};
    scene_free(&scene);
    TEST_ASSERT_TRUE_MESSAGE(scene_load(&scene, path, &error), error.text);
}

static void build(AccelKind kind)
{
    accel_free(&accel);
    TEST_ASSERT_TRUE_MESSAGE(accel_build(&accel, &scene, kind, 1, &error), error.text);
}

static void record(WalkthroughRequest request)
{
    walkthrough_free(&walk);
    TEST_ASSERT_TRUE_MESSAGE(walkthrough_record(&walk, &scene, &accel, "scene.json", request, &error), error.text);
}

static bool keep_band(void *user, int first_row, int rows, const unsigned char *rgb, const RenderReport *so_far,
                      Error *band_error)
{
    (void)user, (void)so_far, (void)band_error;
    size_t row = (size_t)scene.screen.columns * 3;
    memcpy(picture + (size_t)first_row * row, rgb, (size_t)rows * row);
    return true;
}

static void render(void)
{
    RenderReport report;
    free(picture);
    picture = malloc((size_t)scene.screen.columns * (size_t)scene.screen.rows * 3);
    TEST_ASSERT_NOT_NULL(picture);
    BandSink sink = {keep_band, NULL};
    TEST_ASSERT_TRUE(reference_render(&scene, &(RenderSettings){.threads = 1}, sink, &report, &error));
}

/* --- What occurs --- */

static void see_face(const Event *event)
{
    const FaceTest *test = &event->as.face.test;
    seen.faces[test->verdict]++;
    if (test->verdict == FACE_OUTSIDE)
        seen.edges[test->outside_edge]++;
    seen.same_t += test->verdict == FACE_INSIDE && test->t == event->as.face.nearest_t;
    seen.superseded +=
        test->verdict == FACE_INSIDE && test->t < event->as.face.nearest_t && event->as.face.nearest_t < HUGE_VAL;
    for (int k = 0; k < test->edges && test->verdict == FACE_INSIDE; k++)
        seen.on_edge += test->edge_sign[k] == 0;
}

static void see(const Event *event)
{
    seen.kinds[event->kind]++;
    if (event->kind == EVENT_ADAPTIVE)
        seen.adaptive[event->as.adaptive.reason]++;
    else if (event->kind == EVENT_FACE)
        see_face(event);
    else if (event->kind == EVENT_OCCLUDER)
        seen.occluders[event->as.occluder.test.verdict]++;
    else if (event->kind == EVENT_HIT)
        seen.from_behind += event->as.hit.test.n_dot_r > 0;
    else if (event->kind == EVENT_MISS)
        seen.mirrored_background += event->as.miss.weight < 1;
    else if (event->kind == EVENT_LIGHT)
        seen.light_in_plane += event->as.light.side == 0;
    else if (event->kind == EVENT_LIGHT_END)
        seen.light_verdicts[event->as.light_end.verdict]++;
    else if (event->kind == EVENT_TERMS)
        seen.ambient_only += event->as.terms.ambient_only;
    else if (event->kind == EVENT_PATH_END)
        seen.path_ends[event->as.path_end.reason]++;
    else if (event->kind == EVENT_PIXEL)
        seen.clamped += event->as.pixel.average.x > event->as.pixel.clamped.x;
}

/* --- The tests --- */

static void check_pixel(const char *name, int column, int row)
{
    char message[128];
    snprintf(message, sizeof message, "rectray trace tests/scenes/walkthrough/%s.json --pixel %d,%d", name, column,
             row);
    record((WalkthroughRequest){.column = column, .row = row, .verbose = true});
    const Event *last = &walk.events[walk.count - 1];
    TEST_ASSERT_EQUAL_INT_MESSAGE(EVENT_PIXEL, last->kind, message);
    const unsigned char *expected = picture + 3 * (row * scene.screen.columns + column);
    TEST_ASSERT_EQUAL_UINT8_ARRAY_MESSAGE(expected, last->as.pixel.rgb, 3, message);
    for (long i = 0; i < walk.count; i++)
        see(&walk.events[i]);
}

static void walkthrough_should_end_with_the_bytes_of_the_picture_for_every_pixel(void)
{
    for (int s = 0; s < SCENES; s++) {
        load(scenes[s]);
        render();
        for (AccelKind kind = ACCEL_NONE; kind <= ACCEL_LBVH; kind++) {
            build(kind);
            for (int row = 0; row < scene.screen.rows; row++)
                for (int column = 0; column < scene.screen.columns; column++)
                    check_pixel(scenes[s], column, row);
        }
    }
}

/* The text tells which count it was. */
static void assert_seen(long count, const char *what, int index)
{
    char message[64];
    snprintf(message, sizeof message, "%s %d never occurred", what, index);
    TEST_ASSERT_TRUE_MESSAGE(count > 0, message);
}

/* After the test above. */
static void the_scenes_should_take_every_branch(void)
{
    for (int kind = 0; kind < EVENT_KIND_COUNT; kind++)
        assert_seen(seen.kinds[kind], "event", kind);
    for (int reason = ADAPTIVE_SAME; reason <= ADAPTIVE_HIGHLIGHT; reason++)
        assert_seen(seen.adaptive[reason], "adaptive reason", reason);
    for (int verdict = 0; verdict < FACE_VERDICT_COUNT; verdict++) {
        assert_seen(seen.faces[verdict], "face verdict", verdict);
        if (verdict != FACE_LEFT) /* the point's own face is not asked */
            assert_seen(seen.occluders[verdict], "occluder verdict", verdict);
    }
    for (int edge = 0; edge < 4; edge++)
        assert_seen(seen.edges[edge], "outside edge", edge);
    for (int verdict = 0; verdict <= LIGHT_REACHES; verdict++)
        assert_seen(seen.light_verdicts[verdict], "light verdict", verdict);
    for (int reason = 0; reason <= PATH_MAX_BOUNCES; reason++)
        assert_seen(seen.path_ends[reason], "path end", reason);
    assert_seen(seen.light_in_plane, "light in the face's plane", 0);
    assert_seen(seen.on_edge, "hit on an edge", 0);
    assert_seen(seen.same_t, "second face at the same t", 0);
    assert_seen(seen.superseded, "nearer face after a hit", 0);
    assert_seen(seen.ambient_only, "ambient term in shadow", 0);
    assert_seen(seen.mirrored_background, "background in a mirror", 0);
    assert_seen(seen.clamped, "clamped colour", 0);
    assert_seen(seen.from_behind, "hit from behind", 0);
}

/* The ray that arrives, the faces, the hit, the lights, the sum: a format may rely on this order. */
static void events_should_follow_one_another_as_a_path_does(void)
{
    static const char *const followers[EVENT_KIND_COUNT] = {
        [EVENT_ADAPTIVE] = "sample",
        [EVENT_SAMPLE] = "tally miss",
        [EVENT_TALLY] = "node face occluder hit miss light_end",
        [EVENT_FACE] = "node face hit miss",
        [EVENT_NODE] = "node face occluder hit miss light_end",
        [EVENT_HIT] = "light shaded",
        [EVENT_MISS] = "path_end",
        [EVENT_LIGHT] = "tally light_end",
        [EVENT_OCCLUDER] = "node occluder light_end",
        [EVENT_LIGHT_END] = "terms light shaded",
        [EVENT_TERMS] = "light shaded",
        [EVENT_SHADED] = "reflected path_end",
        [EVENT_REFLECTED] = "tally miss",
        [EVENT_PATH_END] = "sample pixel",
    };
    static const char *const names[EVENT_KIND_COUNT] = {"adaptive", "sample",    "face",     "node",      "hit",
                                                        "miss",     "light",     "occluder", "light_end", "terms",
                                                        "shaded",   "reflected", "path_end", "pixel",     "tally"};
    for (int s = 0; s < 4; s++) {
        load(scenes[s % 2]);
        build(s < 2 ? ACCEL_NONE : ACCEL_BVH);
        for (int k = 0; k < scene.screen.columns * scene.screen.rows; k++) {
            record((WalkthroughRequest){k % scene.screen.columns, k / scene.screen.columns, scene.grid - 1, 0, k % 2});
            bool told = false;
            for (long i = 0; i + 1 < walk.count; i++) {
                const Event *event = &walk.events[i];
                if (event->kind == EVENT_SAMPLE)
                    told = event->as.sample.i == scene.grid - 1 && event->as.sample.j == 0;
                const char *allowed = told || event->kind != EVENT_SAMPLE ? followers[event->kind] : "path_end";
                TEST_ASSERT_NOT_NULL_MESSAGE(strstr(allowed, names[walk.events[i + 1].kind]), names[event->kind]);
            }
        }
    }
}

static void what_is_not_verbose_should_count_what_verbose_tells(void)
{
    load("black");
    for (int k = 0; k < scene.screen.columns * scene.screen.rows; k++) {
        WalkthroughRequest request = {k % scene.screen.columns, k / scene.screen.columns, 0, 0, true};
        record(request);
        Walkthrough full = walk;
        walk = (Walkthrough){0};
        request.verbose = false;
        record(request);
        long i = 0;
        for (long n = 0; n < full.count; n++) {
            const Event *event = &full.events[n];
            bool rejected = (event->kind == EVENT_FACE && !walkthrough_is_hit(&event->as.face.test)) ||
                            (event->kind == EVENT_OCCLUDER && event->as.occluder.test.verdict != FACE_INSIDE);
            if (rejected)
                continue;
            TEST_ASSERT_LESS_THAN(walk.count, i);
            TEST_ASSERT_EQUAL_INT(event->kind, walk.events[i].kind);
            if (event->kind == EVENT_TALLY) {
                long told = 0, counted = 0;
                for (long m = n + 1; full.events[m].kind == EVENT_FACE || full.events[m].kind == EVENT_OCCLUDER; m++)
                    told++;
                for (int verdict = 0; verdict < FACE_VERDICT_COUNT; verdict++)
                    counted += walk.events[i].as.tally.verdicts[verdict];
                TEST_ASSERT_EQUAL(told, counted);
            }
            i++;
        }
        TEST_ASSERT_EQUAL(walk.count, i);
        walkthrough_free(&full);
    }
}

/* A stack of parallel sheets: all are hit. */
static void a_ray_that_hits_many_faces_should_tell_the_nearest_ones(void)
{
    enum { SHEETS = 200 };
    char text[SHEETS * 96 + 1024];
    int used = snprintf(text, sizeof text,
                        "{\"camera\":{\"position\":[0,0,9],\"look_at\":[0,0,0]},\"screen\":{\"columns\":1,\"rows\":1},"
                        "\"materials\":{\"m\":{}},\"objects\":[");
    for (int i = 0; i < SHEETS; i++) /* in an order that is neither near to far nor far to near */
        used += snprintf(text + used, sizeof text - (size_t)used,
                         "%s{\"material\":\"m\",\"vertices\":[[-9,-9,%d],[9,-9,%d],[0,9,%d]],\"faces\":[[0,1,2]]}",
                         i ? "," : "", -(i * 77 % SHEETS), -(i * 77 % SHEETS), -(i * 77 % SHEETS));
    used += snprintf(text + used, sizeof text - (size_t)used, "]}");
    error = (Error){.kind = ERROR_NONE};
    TEST_ASSERT_TRUE_MESSAGE(scene_parse(&scene, "sheets.json", text, used, &error), error.text);
    record((WalkthroughRequest){0});
    int told = 0;
    for (long i = 0; i < walk.count; i++)
        if (walk.events[i].kind == EVENT_FACE) {
            told++;
            TEST_ASSERT_TRUE(walk.events[i].as.face.test.t <= 9 + WALKTHROUGH_HITS_TOLD - 1 + 1e-9);
            TEST_ASSERT_TRUE(walk.events[i].as.face.face > walk.events[i - 1].as.face.face || told == 1);
        }
    TEST_ASSERT_EQUAL_INT(WALKTHROUGH_HITS_TOLD, told);
}

static void a_place_should_know_the_ray_the_hit_and_the_light(void)
{
    load("black");
    record((WalkthroughRequest){.column = 3, .row = 12}); /* the floor, which is a mirror */
    WalkthroughPlace place = {0};
    for (long i = 0; i < walk.count; i++) {
        const Event *event = &walk.events[i];
        walkthrough_follow(&place, &walk, event);
        if (event->kind == EVENT_SAMPLE)
            TEST_ASSERT_EQUAL_INT(0, walkthrough_hit_number(&place));
        if (event->kind == EVENT_HIT) {
            Vec3 point = vec3_add(place.ray.origin, vec3_scale(event->as.hit.test.t, place.ray.direction));
            TEST_ASSERT_EQUAL_DOUBLE(event->as.hit.point.x, point.x);
            TEST_ASSERT_EQUAL_INT(event->as.hit.step + 1, walkthrough_hit_number(&place));
        }
        if (event->kind == EVENT_SHADED)
            TEST_ASSERT_EQUAL_DOUBLE(event->as.shaded.weight, place.weight);
        if (event->kind == EVENT_TERMS)
            TEST_ASSERT_EQUAL_INT(event->as.terms.light, place.light->as.light.light);
    }
    TEST_ASSERT_TRUE(walkthrough_hit_number(&place) > 1);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(walkthrough_should_end_with_the_bytes_of_the_picture_for_every_pixel);
    RUN_TEST(the_scenes_should_take_every_branch);
    RUN_TEST(events_should_follow_one_another_as_a_path_does);
    RUN_TEST(what_is_not_verbose_should_count_what_verbose_tells);
    RUN_TEST(a_ray_that_hits_many_faces_should_tell_the_nearest_ones);
    RUN_TEST(a_place_should_know_the_ray_the_hit_and_the_light);
    return UNITY_END();
}
