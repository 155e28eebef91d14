/* Why a node is entered or passed over: boxes and rays whose crossings can be told by hand, then all nodes that the
 * pixels of a scene meet. */
#include "walkthrough/walkthrough_node.h"

#include "reader/scene_json.h"
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
    for (AccelKind kind = ACCEL_KDTREE; kind <= ACCEL_BVH; kind++) {
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

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_crossing_should_be_the_last_entry_and_the_first_exit);
    RUN_TEST(reasons_should_name_axes_and_times);
    RUN_TEST(the_near_child_should_be_the_one_that_the_ray_meets_first);
    RUN_TEST(the_reasons_of_a_scene_should_be_those_of_its_boxes);
    return UNITY_END();
}
