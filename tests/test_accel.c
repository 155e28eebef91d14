/* Trees must not change what is seen: the same faces, the same t to the last bit, the same pictures. */
#include "trace/accel.h"

#include "reader/scene_json.h"
#include "support/crowds.h"
#include "support/xorshift.h"
#include "trace/reference.h"
#include "trace/reference_render.h"

#include "unity.h"

#include <string.h>

enum { FACES = 100, RAYS = 15000 };

static const AccelKind TREES[] = {ACCEL_KDTREE, ACCEL_BVH, ACCEL_LBVH};
enum { TREE_KINDS = sizeof TREES / sizeof TREES[0] };
static Error error;

void setUp(void)
{
    error = (Error){.kind = ERROR_NONE};
}
void tearDown(void) {}

static Accel tree_of(const Scene *scene, AccelKind kind)
{
    Accel accel;
    TEST_ASSERT_TRUE(accel_build(&accel, scene, kind, 1, &error));
    return accel;
}

static bool same_hit(CastHit a, CastHit b)
{
    return a.face == b.face && memcmp(&a.t, &b.t, sizeof a.t) == 0;
}

static void compare_nearest(const Scene *scene)
{
    Accel trees[TREE_KINDS];
    for (int k = 0; k < TREE_KINDS; k++)
        trees[k] = tree_of(scene, TREES[k]);
    RenderReport report = {.lanes = 1};
    uint64_t state = 7;
    char told[200];
    for (int i = 0; i < RAYS; i++) {
        Ray ray = hard_ray(scene, &state);
        if (vec3_dot(ray.direction, ray.direction) == 0)
            continue;
        int skip = i % 3 == 0 ? (int)(random_next(&state) % (uint64_t)scene->face_count) : -1;
        snprintf(told, sizeof told, "ray %d from %a %a %a along %a %a %a", i, ray.origin.x, ray.origin.y, ray.origin.z,
                 ray.direction.x, ray.direction.y, ray.direction.z);
        CastHit expected = reference_nearest(&(Tracer){.scene = scene, .report = &report}, ray, skip);
        for (int k = 0; k < TREE_KINDS; k++) {
            CastHit actual =
                reference_nearest(&(Tracer){.scene = scene, .accel = &trees[k], .report = &report}, ray, skip);
            TEST_ASSERT_TRUE_MESSAGE(same_hit(expected, actual), told);
        }
    }
    for (int k = 0; k < TREE_KINDS; k++)
        accel_free(&trees[k]);
}

static void trees_should_find_the_same_nearest_face_and_t(void)
{
    for (int kind = 0; kind < CROWD_KINDS; kind++) {
        Scene scene = crowd_scene((Crowd)kind, FACES, 0x1234567u + (unsigned)kind);
        compare_nearest(&scene);
        scene_free(&scene);
    }
}

static void a_tree_of_one_face_should_find_it(void)
{
    Scene scene = crowd_scene(CROWD_QUADS, 1, 99);
    compare_nearest(&scene);
    scene_free(&scene);
}

/* --- Shadow rays: another blocker may be found, but one is, or none --- */

typedef struct Segment {
    const Scene *scene;
    Vec3 to;
    bool blocked;
} Segment;

static bool visit_blocker(Traversal *walk, int face)
{
    Segment *segment = walk->user;
    FaceTest test = face_test_segment(&segment->scene->faces[face], &segment->scene->planes[face], walk->origin,
                                      segment->to, false);
    segment->blocked = test.verdict == FACE_INSIDE;
    return !segment->blocked;
}

static bool is_blocked(const Scene *scene, const Accel *accel, Vec3 from, Vec3 to)
{
    Segment segment = {scene, to, false};
    Traversal walk = {
        .origin = from, .direction = vec3_sub(to, from), .limit = 1, .visit = visit_blocker, .user = &segment};
    if (accel_has_tree(accel))
        accel_traverse(accel, &walk);
    else
        for (int i = 0; i < scene->face_count && visit_blocker(&walk, i); i++)
            continue;
    return segment.blocked;
}

static void compare_shadows(const Scene *scene, AccelKind kind)
{
    Accel accel = tree_of(scene, kind);
    uint64_t state = 11;
    int blocked = 0;
    for (int i = 0; i < RAYS / 3; i++) {
        Ray ray = hard_ray(scene, &state);
        Vec3 to = vec3_add(ray.origin, ray.direction);
        if (vec3_dot(ray.direction, ray.direction) == 0)
            continue;
        bool expected = is_blocked(scene, NULL, ray.origin, to);
        blocked += expected;
        TEST_ASSERT_EQUAL_INT(expected, is_blocked(scene, &accel, ray.origin, to));
    }
    TEST_ASSERT_GREATER_THAN_INT(0, blocked);
    accel_free(&accel);
}

static void trees_should_find_a_blocker_where_there_is_one(void)
{
    for (int kind = 0; kind < CROWD_KINDS; kind++) {
        Scene scene = crowd_scene((Crowd)kind, FACES, 0x7654321u + (unsigned)kind);
        for (int i = 0; i < TREE_KINDS; i++)
            compare_shadows(&scene, TREES[i]);
        scene_free(&scene);
    }
}

/* --- Pictures --- */

static bool keep_band(void *user, int first_row, int rows, const unsigned char *rgb, const RenderReport *so_far,
                      Error *unused)
{
    (void)so_far;
    (void)unused;
    memcpy((unsigned char *)user + first_row * 48 * 3, rgb, (size_t)(rows * 48 * 3));
    return true;
}

static void pictures_should_not_depend_on_the_tree(void)
{
    static const Crowd kinds[] = {CROWD_BOXES, CROWD_QUADS, CROWD_SHEETS};
    static unsigned char expected[32 * 48 * 3], actual[32 * 48 * 3];
    for (int k = 0; k < 3; k++) {
        Scene scene = crowd_scene(kinds[k], FACES, 5);
        RenderReport report;
        for (AccelKind accel = ACCEL_AUTO; accel <= ACCEL_LBVH; accel++) {
            RenderSettings settings = {.accel = accel, .threads = 2};
            BandSink sink = {keep_band, accel == ACCEL_AUTO ? expected : actual};
            TEST_ASSERT_TRUE(reference_render(&scene, &settings, sink, &report, &error));
            TEST_ASSERT_EQUAL_INT(accel == ACCEL_AUTO ? ACCEL_BVH : accel, report.accel);
            TEST_ASSERT_EQUAL_INT(accel == ACCEL_NONE, report.box_tests == 0);
            if (accel != ACCEL_AUTO)
                TEST_ASSERT_EQUAL_MEMORY(expected, actual, sizeof actual);
        }
        scene_free(&scene);
    }
}

/* --- What is built --- */

static void auto_should_build_a_bvh_only_where_it_pays(void)
{
    Scene scene = crowd_scene(CROWD_QUADS, ACCEL_AUTO_FACES, 3);
    Accel accel = tree_of(&scene, ACCEL_AUTO);
    TEST_ASSERT_EQUAL_INT(ACCEL_BVH, accel.kind);
    TEST_ASSERT_TRUE(accel_has_tree(&accel));
    accel_free(&accel);
    scene.face_count = ACCEL_AUTO_FACES - 1;
    accel = tree_of(&scene, ACCEL_AUTO);
    TEST_ASSERT_EQUAL_INT(ACCEL_NONE, accel.kind);
    TEST_ASSERT_FALSE(accel_has_tree(&accel));
    accel_free(&accel);
    scene_free(&scene);
}

static void a_sorted_tree_should_be_a_bvh_of_another_name(void)
{
    Scene scene = crowd_scene(CROWD_QUADS, FACES, 3);
    for (AccelKind kind = ACCEL_KDTREE; kind <= ACCEL_LBVH; kind++) {
        Accel accel = tree_of(&scene, kind);
        TEST_ASSERT_EQUAL_INT(kind == ACCEL_KDTREE ? ACCEL_KDTREE : ACCEL_BVH, accel.kind);
        TEST_ASSERT_EQUAL_INT(kind, accel_name(&accel));
        accel_free(&accel);
        TEST_ASSERT_EQUAL_INT(ACCEL_NONE, accel_name(&accel));
    }
    scene_free(&scene);
}

static void sorting_should_pay_for_few_rays_in_many_faces(void)
{
    Scene scene = {.screen = {.columns = 1000, .rows = 1000}, .grid = 1, .face_count = 1000000};
    RenderSettings settings = {.threads = 1};
    TEST_ASSERT_TRUE(accel_sorting_pays(&scene, &settings));
    scene.grid = 8;
    TEST_ASSERT_FALSE(accel_sorting_pays(&scene, &settings));
    settings.region = (Region){10, 10, 100, 100};
    TEST_ASSERT_TRUE(accel_sorting_pays(&scene, &settings));
    settings.region = (Region){0, 0, 0, 0};
    scene.grid = 1;
    scene.face_count = 10000;
    TEST_ASSERT_FALSE(accel_sorting_pays(&scene, &settings));
    scene.screen.columns = scene.screen.rows = 10;
    TEST_ASSERT_TRUE(accel_sorting_pays(&scene, &settings));
    scene.face_count = 100;
    TEST_ASSERT_FALSE(accel_sorting_pays(&scene, &settings));
}

static void no_faces_should_need_no_tree(void)
{
    Scene scene = {.face_count = 0};
    Accel accel = tree_of(&scene, ACCEL_KDTREE);
    TEST_ASSERT_EQUAL_INT(ACCEL_NONE, accel.kind);
    accel_free(&accel);
    accel_free(&accel);
    TEST_ASSERT_FALSE(accel_has_tree(NULL));
    TEST_ASSERT_FALSE(accel_has_tree(&(Accel){.kind = ACCEL_AUTO}));
}

/* --- What the recorder hears --- */

typedef struct Heard {
    int nodes, entered, faces, faces_in_leaves;
} Heard;

static void hear(void *user, const Event *event)
{
    Heard *heard = user;
    if (event->kind == EVENT_NODE) {
        heard->nodes++;
        bool entered = event->as.node.visit.verdict == NODE_ENTERED;
        heard->entered += entered;
        heard->faces_in_leaves += entered ? event->as.node.shape.faces : 0;
    }
    heard->faces += event->kind == EVENT_FACE;
}

static void recorder_should_hear_of_each_node_and_face(void)
{
    Scene scene = crowd_scene(CROWD_SHEETS, FACES, 5);
    for (int i = 0; i < 2; i++) {
        Accel accel = tree_of(&scene, TREES[i]);
        RenderReport report = {.lanes = 1};
        Heard heard = {.nodes = 0};
        Tracer tracer = {.scene = &scene, .accel = &accel, .report = &report, .recorder = &(Recorder){hear, &heard}};
        CastHit hit = reference_nearest(&tracer, (Ray){vec3(0.25, -5.75, 9), vec3(0, 0, -1)}, -1);
        TEST_ASSERT_TRUE(hit.t == 9);
        TEST_ASSERT_EQUAL_INT(report.box_tests, heard.nodes);
        TEST_ASSERT_EQUAL_INT(report.face_tests, heard.faces);
        TEST_ASSERT_EQUAL_INT(heard.faces_in_leaves, heard.faces);
        TEST_ASSERT_TRUE(heard.entered < heard.nodes && heard.faces < FACES / 4);
        accel_free(&accel);
    }
    scene_free(&scene);
}

/* --- With a recorder and without --- */

typedef struct Counted {
    uint64_t nodes, faces;
} Counted;

static void count(void *user, const Event *event)
{
    Counted *counted = user;
    counted->nodes += event->kind == EVENT_NODE;
    counted->faces +=
        event->kind == EVENT_OCCLUDER || (event->kind == EVENT_FACE && event->as.face.test.verdict != FACE_LEFT);
}

static void check_recorded_pixel(const Scene *scene, const Accel *accel, int column, int row, const char *path)
{
    char message[128];
    snprintf(message, sizeof message, "rectray trace %s --size %dx%d --grid 1 --pixel %d,%d --accel %s", path,
             scene->screen.columns, scene->screen.rows, column, row, render_accels[accel->kind]);
    RenderReport silent_report = {.lanes = 1}, report = {.lanes = 1};
    Counted counted = {.nodes = 0};
    Tracer silent = {.scene = scene, .accel = accel, .report = &silent_report};
    Tracer tracer = {.scene = scene, .accel = accel, .report = &report, .recorder = &(Recorder){count, &counted}};
    Vec3 expected = reference_pixel(&silent, column, row), colour = reference_pixel(&tracer, column, row);
    TEST_ASSERT_EQUAL_MEMORY_MESSAGE(&expected, &colour, sizeof colour, message);
    TEST_ASSERT_EQUAL_MEMORY_MESSAGE(&silent_report, &report, sizeof report, message);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(report.box_tests, counted.nodes, message);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(report.face_tests, counted.faces, message);
}

/* Every pixel of three scenes, with every tree and without one. */
static void recorder_should_change_nothing_and_hear_what_is_counted(void)
{
    static const char *const paths[] = {"scenes/original.json", "scenes/cornell.json", "scenes/gallery.json"};
    for (int s = 0; s < 3; s++) {
        Scene scene;
        TEST_ASSERT_TRUE_MESSAGE(scene_load(&scene, paths[s], &error), error.text);
        scene.screen.columns = 32;
        scene.screen.rows = 24;
        scene.grid = 1;
        for (AccelKind kind = ACCEL_NONE; kind <= ACCEL_BVH; kind++) {
            Accel accel = tree_of(&scene, kind);
            for (int k = 0; k < 32 * 24; k++)
                check_recorded_pixel(&scene, &accel, k % 32, k / 32, paths[s]);
            accel_free(&accel);
        }
        scene_free(&scene);
    }
}

/* --- Nodes as they are described --- */

static bool box_within(Box inner, Box outer)
{
    for (int axis = 0; axis < 3; axis++)
        if (inner.low[axis] < outer.low[axis] || inner.high[axis] > outer.high[axis])
            return false;
    return true;
}

/* Counts the faces in the leaves below. */
static int check_described(const Accel *accel, int index)
{
    AccelNode node = accel_node(accel, index);
    if (node.leaf) {
        TEST_ASSERT_EQUAL_INT(-1, node.axis);
        return node.faces;
    }
    TEST_ASSERT_EQUAL_INT(0, node.faces);
    AccelNode low = accel_node(accel, node.low), high = accel_node(accel, node.high);
    TEST_ASSERT_TRUE(box_within(low.box, node.box) && box_within(high.box, node.box));
    if (node.axis >= 0) {
        TEST_ASSERT_EQUAL_FLOAT(node.split, low.box.high[node.axis]);
        TEST_ASSERT_EQUAL_FLOAT(node.split, high.box.low[node.axis]);
    }
    return check_described(accel, node.low) + check_described(accel, node.high);
}

static void nodes_should_be_described_with_boxes_inside_their_parents(void)
{
    Scene scene = crowd_scene(CROWD_SHEETS, FACES, 5);
    Accel bvh = tree_of(&scene, ACCEL_BVH), kdtree = tree_of(&scene, ACCEL_KDTREE);
    TEST_ASSERT_EQUAL_INT(FACES, check_described(&bvh, 0));
    TEST_ASSERT_EQUAL_INT(kdtree.kdtree.order_count, check_described(&kdtree, 0));
    accel_free(&bvh);
    accel_free(&kdtree);
    scene_free(&scene);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(trees_should_find_the_same_nearest_face_and_t);
    RUN_TEST(a_tree_of_one_face_should_find_it);
    RUN_TEST(trees_should_find_a_blocker_where_there_is_one);
    RUN_TEST(pictures_should_not_depend_on_the_tree);
    RUN_TEST(auto_should_build_a_bvh_only_where_it_pays);
    RUN_TEST(a_sorted_tree_should_be_a_bvh_of_another_name);
    RUN_TEST(sorting_should_pay_for_few_rays_in_many_faces);
    RUN_TEST(no_faces_should_need_no_tree);
    RUN_TEST(recorder_should_hear_of_each_node_and_face);
    RUN_TEST(recorder_should_change_nothing_and_hear_what_is_counted);
    RUN_TEST(nodes_should_be_described_with_boxes_inside_their_parents);
    return UNITY_END();
}
