/* Trees must not change what is seen: the same faces, the same t to the last bit, the same pictures. */
#include "trace/accel.h"

#include "support/crowds.h"
#include "support/xorshift.h"
#include "trace/reference.h"
#include "trace/reference_render.h"

#include "unity.h"

#include <string.h>

enum { FACES = 100, RAYS = 15000 };

static const AccelKind TREES[] = {ACCEL_KDTREE, ACCEL_BVH};
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
    Accel trees[] = {tree_of(scene, ACCEL_KDTREE), tree_of(scene, ACCEL_BVH)};
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
        for (int k = 0; k < 2; k++) {
            CastHit actual =
                reference_nearest(&(Tracer){.scene = scene, .accel = &trees[k], .report = &report}, ray, skip);
            TEST_ASSERT_TRUE_MESSAGE(same_hit(expected, actual), told);
        }
    }
    for (int k = 0; k < 2; k++)
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
        for (int i = 0; i < 2; i++)
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
        for (AccelKind accel = ACCEL_AUTO; accel <= ACCEL_BVH; accel++) {
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
        heard->entered += event->as.node.entered;
        heard->faces_in_leaves += event->as.node.entered ? event->as.node.faces : 0;
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

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(trees_should_find_the_same_nearest_face_and_t);
    RUN_TEST(a_tree_of_one_face_should_find_it);
    RUN_TEST(trees_should_find_a_blocker_where_there_is_one);
    RUN_TEST(pictures_should_not_depend_on_the_tree);
    RUN_TEST(auto_should_build_a_bvh_only_where_it_pays);
    RUN_TEST(no_faces_should_need_no_tree);
    RUN_TEST(recorder_should_hear_of_each_node_and_face);
    return UNITY_END();
}
