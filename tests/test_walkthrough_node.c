/* Why a node is entered or passed over: boxes and rays whose crossings can be told by hand, then all nodes that the
 * pixels of a scene meet. What all pixels of three scenes count is what the renderer counts. */
#include "walkthrough/walkthrough_node.h"

#include "reader/scene_json.h"
#include "trace/reference.h"
#include "unity.h"

static const Box box = {{1, 2, 3}, {2, 4, 6}};

void setUp(void) {}
void tearDown(void) {}

static InkText reason(Ray ray, double limit, bool shadow)
{
    Interval inside = interval_in_box(box, ray.origin, ray.direction);
    Traversal traversal = {.limit = limit};
    Event event = {.kind = EVENT_NODE,
                   .as.node = {{0, 0, traversal_verdict(&traversal, inside), inside, limit}, {.box = box, .axis = -1}}};
    return node_reason(&event, ray, shadow);
}

static void a_crossing_should_be_the_last_entry_and_the_first_exit(void)
{
    NodeCrossing crossing = node_crossing(box, (Ray){vec3(0, 1, 0), vec3(1, 1, 3)});
    TEST_ASSERT_EQUAL_DOUBLE(1, crossing.enter);
    TEST_ASSERT_EQUAL_DOUBLE(2, crossing.leave);
    crossing = node_crossing(box, (Ray){vec3(1.5, 3, 4), vec3(0, 1, 0)});
    TEST_ASSERT_EQUAL_INT(-1, crossing.enter_axis);
    TEST_ASSERT_EQUAL_INT(1, crossing.leave_axis);
    TEST_ASSERT_EQUAL_DOUBLE(1, crossing.leave);
}

static void reasons_should_name_axes_and_times(void)
{
    TEST_ASSERT_EQUAL_STRING("entered, from t = 1 to 2", reason((Ray){vec3(0, 1, 0), vec3(1, 1, 3)}, 9, false).text);
    TEST_ASSERT_EQUAL_STRING("missed: leaves x at t = 2, enters z at t = 3",
                             reason((Ray){vec3(0, 1, 0), vec3(1, 1, 1)}, 9, false).text);
    TEST_ASSERT_EQUAL_STRING("missed: runs beside it in y", reason((Ray){vec3(0, 0, 0), vec3(1, 0, 1)}, 9, false).text);
    TEST_ASSERT_EQUAL_STRING("missed: it is behind the ray's start, leaves x at t = -1",
                             reason((Ray){vec3(3, 3, 4), vec3(1, 0, 0)}, 9, false).text);
    TEST_ASSERT_EQUAL_STRING("begins at t = 1, beyond the nearest hit 0.5",
                             reason((Ray){vec3(0, 1, 0), vec3(1, 1, 3)}, 0.5, false).text);
    TEST_ASSERT_EQUAL_STRING("begins at t = 2, beyond the light",
                             reason((Ray){vec3(0, 1, 0), vec3(0.5, 0.5, 1.5)}, 1, true).text);
}

static void the_near_child_should_be_the_one_that_the_ray_meets_first(void)
{
    const AccelNode node = {.axis = 2, .split = 4, .low = 5, .high = 9};
    const Ray up = {vec3(0, 0, 1), vec3(1, 0, 1.5)}, down = {vec3(0, 0, 6), vec3(1, 0, -0.5)};
    TEST_ASSERT_EQUAL_INT(5, node_near_child(&node, up));
    TEST_ASSERT_EQUAL_INT(9, node_near_child(&node, down));
    TEST_ASSERT_EQUAL_DOUBLE(2, node_plane_t(&node, up));
    TEST_ASSERT_EQUAL_DOUBLE(4, node_plane_t(&node, down));
    TEST_ASSERT_TRUE(node_plane_t(&node, (Ray){vec3(0, 0, 1), vec3(1, 0, 0)}) == HUGE_VAL);
}

/* What has occurred in any pixel. */
static long seen[NODE_VERDICT_COUNT];

static void check_events(const Walkthrough *walk, const char *message)
{
    WalkthroughPlace place = {0};
    for (long i = 0; i < walk->count; i++) {
        const Event *event = &walk->events[i];
        walkthrough_follow(&place, walk, event);
        if (event->kind != EVENT_NODE)
            continue;
        const TraversalNode *visit = &event->as.node.visit;
        NodeCrossing crossing = node_crossing(event->as.node.shape.box, walkthrough_search_ray(&place));
        double slack = 1e-12 * (1 + crossing.enter);
        seen[visit->verdict]++;
        bool enters = crossing.enter <= crossing.leave + slack && crossing.enter <= visit->limit + slack;
        bool fits = visit->verdict == NODE_MISSED    ? crossing.leave < crossing.enter
                    : visit->verdict == NODE_ENTERED ? enters
                    : visit->verdict == NODE_BEYOND  ? crossing.enter > visit->limit
                                                     : true;
        bool inside = visit->verdict == NODE_MISSED || fabs(crossing.enter - visit->inside.enter) <= slack;
        TEST_ASSERT_TRUE_MESSAGE(fits && inside, message);
    }
}

static void the_reasons_of_a_scene_should_be_those_of_its_boxes(void)
{
    Scene scene;
    Error error = {.kind = ERROR_NONE};
    TEST_ASSERT_TRUE_MESSAGE(scene_load(&scene, "scenes/cornell.json", &error), error.text);
    scene.screen.columns = scene.screen.rows = 24;
    scene.grid = 1;
    for (AccelKind kind = ACCEL_KDTREE; kind <= ACCEL_LBVH; kind++) {
        Accel accel;
        TEST_ASSERT_TRUE(accel_build(&accel, &scene, kind, 1, &error));
        for (int k = 0; k < 24 * 24; k++) {
            char message[128];
            snprintf(message, sizeof message,
                     "rectray trace scenes/cornell.json --size 24x24 --grid 1 -a %s --pixel %d,%d", render_accels[kind],
                     k % 24, k / 24);
            Walkthrough walk;
            TEST_ASSERT_TRUE(walkthrough_record(&walk, &scene, &accel, "cornell",
                                                (WalkthroughRequest){.column = k % 24, .row = k / 24}, &error));
            check_events(&walk, message);
            walkthrough_free(&walk);
        }
        accel_free(&accel);
    }
    scene_free(&scene);
    for (int verdict = 0; verdict < NODE_VERDICT_COUNT; verdict++)
        TEST_ASSERT_TRUE_MESSAGE(seen[verdict] > 0, walkthrough_node_verdicts[verdict]);
}

/* --- Counts --- */

/* What the rays of the told sample were tested against. */
typedef struct Counts {
    uint64_t nodes, nodes_in_tallies, faces;
} Counts;

static void count_events(Counts *counts, const Walkthrough *walk)
{
    for (long i = 0; i < walk->count; i++) {
        const Event *event = &walk->events[i];
        counts->nodes += event->kind == EVENT_NODE;
        if (event->kind == EVENT_TALLY) {
            counts->nodes_in_tallies += (uint64_t)event->as.tally.nodes_met;
            counts->faces += (uint64_t)event->as.tally.tested;
        }
    }
}

/* Every pixel: its bytes without a tree, and what the renderer counts with this tree. */
static void check_counts(const char *path, const Scene *scene, AccelKind kind)
{
    Error error = {.kind = ERROR_NONE};
    Accel accel;
    TEST_ASSERT_TRUE(accel_build(&accel, scene, kind, 1, &error));
    RenderReport report = {0}, unused = {0};
    Tracer with_tree = {.scene = scene, .accel = &accel, .report = &report};
    Tracer without = {.scene = scene, .report = &unused};
    Counts counts = {0};
    for (int k = 0; k < scene->screen.columns * scene->screen.rows; k++) {
        WalkthroughRequest request = {.column = k % scene->screen.columns, .row = k / scene->screen.columns};
        char message[160];
        snprintf(message, sizeof message, "%s, %dx%d, %s, pixel %d,%d", path, scene->screen.columns, scene->screen.rows,
                 render_accels[kind], request.column, request.row);
        Walkthrough walk;
        TEST_ASSERT_TRUE(walkthrough_record(&walk, scene, &accel, path, request, &error));
        Vec3 plain = reference_pixel(&without, request.column, request.row);
        reference_pixel(&with_tree, request.column, request.row);
        const unsigned char bytes[3] = {colour_to_byte(plain.x), colour_to_byte(plain.y), colour_to_byte(plain.z)};
        TEST_ASSERT_EQUAL_UINT8_ARRAY_MESSAGE(bytes, walk.events[walk.count - 1].as.pixel.rgb, 3, message);
        count_events(&counts, &walk);
        TEST_ASSERT_EQUAL_UINT64_MESSAGE(report.box_tests, counts.nodes, message);
        TEST_ASSERT_EQUAL_UINT64_MESSAGE(report.box_tests, counts.nodes_in_tallies, message);
        TEST_ASSERT_EQUAL_UINT64_MESSAGE(report.face_tests, counts.faces, message);
        walkthrough_free(&walk);
    }
    TEST_ASSERT_TRUE((counts.nodes > 0) == (kind != ACCEL_NONE));
    accel_free(&accel);
}

static void the_events_of_all_pixels_should_be_as_many_as_the_renderer_counts(void)
{
    static const char *const paths[] = {"scenes/original.json", "scenes/cornell.json", "scenes/gallery.json"};
    for (int i = 0; i < 3; i++) {
        Scene scene;
        Error error = {.kind = ERROR_NONE};
        TEST_ASSERT_TRUE_MESSAGE(scene_load(&scene, paths[i], &error), error.text);
        scene.screen.columns = 64;
        scene.screen.rows = 36;
        scene.grid = 1;
        for (AccelKind kind = ACCEL_NONE; kind <= ACCEL_LBVH; kind++)
            check_counts(paths[i], &scene, kind);
        scene_free(&scene);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_crossing_should_be_the_last_entry_and_the_first_exit);
    RUN_TEST(reasons_should_name_axes_and_times);
    RUN_TEST(the_near_child_should_be_the_one_that_the_ray_meets_first);
    RUN_TEST(the_reasons_of_a_scene_should_be_those_of_its_boxes);
    RUN_TEST(the_events_of_all_pixels_should_be_as_many_as_the_renderer_counts);
    return UNITY_END();
}
