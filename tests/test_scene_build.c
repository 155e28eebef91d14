/* From objects to traced faces: every transform in closed form, every verdict on a shape, centre and rounding. */
#include "reader/scene_build.h"
#include "scene/geometry.h"

#include "unity.h"

#include <stdlib.h>
#include <string.h>

static Scene scene;
static Error error;
static SceneBuild build;

/* A scene of one material and one object, which stands as it is. */
void setUp(void)
{
    scene = (Scene){.camera = {.position = {0, 0, 9}, .look_at = {0, 0, 0}, .up = {0, 1, 0}}};
    error = (Error){.kind = ERROR_NONE};
    build = (SceneBuild){.scene = &scene, .error = &error};
    TEST_ASSERT_EQUAL(0, scene_build_material(&build, (Material){.name = "m"}));
    TEST_ASSERT_TRUE(scene_build_object(&build, "object", (SceneBuildObject){.transform = transform_identity()}));
}

void tearDown(void)
{
    scene_build_free(&build);
    scene_free(&scene);
}

static void assert_vec3_within(double tolerance, Vec3 expected, Vec3 v)
{
    TEST_ASSERT_DOUBLE_WITHIN(tolerance, expected.x, v.x);
    TEST_ASSERT_DOUBLE_WITHIN(tolerance, expected.y, v.y);
    TEST_ASSERT_DOUBLE_WITHIN(tolerance, expected.z, v.z);
}

static void assert_moves(Transform transform, Vec3 from, Vec3 to)
{
    assert_vec3_within(1e-15, to, transform_point(&transform, from));
}

static void scale_should_multiply_each_axis(void)
{
    assert_moves(transform_scale(vec3(2, 3, -4)), vec3(1, 10, 100), vec3(2, 30, -400));
    TEST_ASSERT_FALSE(transform_mirrors(&(Transform){.rows = {{2, 0, 0}, {0, 3, 0}, {0, 0, 4}}}));
}

static void translate_should_add(void)
{
    assert_moves(transform_translate(vec3(1, -2, 3)), vec3(10, 20, 30), vec3(11, 18, 33));
}

static void rotate_should_follow_the_right_hand(void)
{
    assert_moves(transform_rotate(vec3(0, 0, 1), 90), vec3(1, 0, 0), vec3(0, 1, 0));
    assert_moves(transform_rotate(vec3(0, 1, 0), 90), vec3(0, 0, 1), vec3(1, 0, 0));
    assert_moves(transform_rotate(vec3(1, 0, 0), 90), vec3(0, 1, 0), vec3(0, 0, 1));
    assert_moves(transform_rotate(vec3(0, 0, -1), 90), vec3(1, 0, 0), vec3(0, -1, 0));
    assert_moves(transform_rotate(vec3(0, 0, 7), 30), vec3(2, 0, 5), vec3(sqrt(3), 1, 5));
    assert_moves(transform_rotate(vec3(0, 0, 1), -45), vec3(sqrt(2), 0, 0), vec3(1, -1, 0));
    assert_moves(transform_rotate(vec3(1, 1, 1), 120), vec3(1, 2, 3), vec3(3, 1, 2)); /* permutes the axes */
    assert_moves(transform_rotate(vec3(1e200, 1e200, 1e200), 120), vec3(1, 2, 3), vec3(3, 1, 2));
    assert_moves(transform_rotate(vec3(1e-200, 1e-200, 1e-200), 120), vec3(1, 2, 3), vec3(3, 1, 2));
}

static void quarter_turns_should_be_exact(void)
{
    for (int quarter = -9; quarter <= 9; quarter++) {
        Transform turn = transform_rotate(vec3(0, 2, 0), 90.0 * quarter);
        static const double cosines[4] = {1, 0, -1, 0}, sines[4] = {0, 1, 0, -1};
        Vec3 moved = transform_point(&turn, vec3(3, 5, 0));
        TEST_ASSERT_TRUE(moved.x == 3 * cosines[quarter & 3]);
        TEST_ASSERT_TRUE(moved.y == 5);
        TEST_ASSERT_TRUE(moved.z == -3 * sines[quarter & 3]);
    }
}

static void steps_should_apply_in_order(void)
{
    Transform scale = transform_scale(vec3(2, 2, 2)), translate = transform_translate(vec3(1, 0, 0));
    Transform rotate = transform_rotate(vec3(0, 0, 1), 90);
    assert_moves(transform_then(scale, translate), vec3(1, 1, 1), vec3(3, 2, 2));
    assert_moves(transform_then(translate, scale), vec3(1, 1, 1), vec3(4, 2, 2));
    assert_moves(transform_then(transform_then(translate, rotate), scale), vec3(1, 0, 0), vec3(0, 4, 0));
    Transform mirror = transform_scale(vec3(-1, 1, 1)), both = transform_then(mirror, rotate);
    TEST_ASSERT_TRUE(transform_mirrors(&both));
    both = transform_then(both, mirror);
    TEST_ASSERT_FALSE(transform_mirrors(&both));
}

static bool add_points(const Vec3 *points, int count)
{
    for (int i = 0; i < count; i++)
        if (!scene_build_point(&build, points[i]))
            return false;
    return true;
}

static const Vec3 square[4] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
static const int in_order[4] = {0, 1, 2, 3};

static ShapeVerdict verdict_of(Vec3 a, Vec3 b, Vec3 c, Vec3 d)
{
    const Vec3 points[4] = {a, b, c, d};
    return shape_of(points, 4).verdict;
}

static void shape_should_accept_convex_faces_either_way_round(void)
{
    TEST_ASSERT_EQUAL(SHAPE_GOOD, shape_of(square, 4).verdict);
    TEST_ASSERT_EQUAL(SHAPE_GOOD, shape_of(square, 3).verdict);
    TEST_ASSERT_EQUAL(SHAPE_GOOD, verdict_of(square[3], square[2], square[1], square[0]));
    TEST_ASSERT_EQUAL(SHAPE_GOOD,
                      verdict_of(vec3(0, 0, 0), vec3(1, 0, 0), vec3(2, 0, 0), vec3(1, 1, 0))); /* a straight corner */
    TEST_ASSERT_EQUAL(SHAPE_GOOD, verdict_of(vec3(0, 0, 0), vec3(1e6, 0, 0), vec3(1e6, 1, 0), vec3(0, 1, 0)));
}

static void shape_should_find_each_fault_in_every_rotation_of_the_order(void)
{
    const struct {
        Vec3 points[4];
        ShapeVerdict verdict;
    } cases[] = {
        {{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}}, SHAPE_REPEATED},
        {{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}, SHAPE_NO_AREA},
        {{{0, 0, 0}, {1, 0, 0}, {1, 1, 1e-3}, {0, 1, 0}}, SHAPE_NOT_PLANAR},
        {{{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}}, SHAPE_CONCAVE},
        {{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}, SHAPE_CROSSED},
        {{{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {3, 1, 0}}, SHAPE_CROSSED},
        {{{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1, 1, 0}}, SHAPE_CONCAVE},
        {{{0, 0, 0}, {1, 0, 0}, {HUGE_VAL, 1, 0}, {0, 1, 0}}, SHAPE_NOT_FINITE},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int k = 0; k < 8; k++) { /* four beginnings, two directions */
            Vec3 points[4];
            for (int j = 0; j < 4; j++)
                points[j] = cases[i].points[(k < 4 ? k + j : k - j + 4) % 4];
            TEST_ASSERT_EQUAL(cases[i].verdict, shape_of(points, 4).verdict);
        }
}

static void shape_should_measure_planarity_against_the_longer_diagonal(void)
{
    /* one corner of a unit square lifted by h is h / 2 from the plane of the diagonals; 1e-5 of sqrt 2 is allowed */
    double limit = 2 * sqrt(2) * 1e-5;
    TEST_ASSERT_EQUAL(SHAPE_GOOD, verdict_of(square[0], square[1], vec3(1, 1, 0.999 * limit), square[3]));
    TEST_ASSERT_EQUAL(SHAPE_NOT_PLANAR, verdict_of(square[0], square[1], vec3(1, 1, 1.001 * limit), square[3]));
    for (int k = 1; k <= 12; k++) {
        double scale = pow(10, k - 6), height = pow(10, -k);
        Vec3 points[4];
        for (int i = 0; i < 4; i++)
            points[i] = vec3_scale(scale, square[i]);
        points[2].z = scale * height;
        Shape shape = shape_of(points, 4);
        TEST_ASSERT_EQUAL(k <= 4 ? SHAPE_NOT_PLANAR : SHAPE_GOOD, shape.verdict);
        TEST_ASSERT_DOUBLE_WITHIN(0.01 * shape.distance, scale * height / 2, shape.distance);
    }
}

static void shape_should_take_rounding_errors_for_no_area(void)
{
    const Vec3 points[3] = {{0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}, {0.3, 0.3, 0.3}}; /* not exactly on a line */
    TEST_ASSERT_EQUAL(SHAPE_NO_AREA, shape_of(points, 3).verdict);
}

static void faces_should_be_centred_rounded_once_and_get_their_planes(void)
{
    scene.lights = calloc(1, sizeof *scene.lights);
    scene.lights[0].position = vec3(1000, 2000, 3004);
    scene.light_count = 1;
    const Vec3 points[3] = {{1000.1, 2000, 3000}, {1002, 2000, 3000}, {1001, 2002, 3000}};
    TEST_ASSERT_TRUE(add_points(points, 3) && scene_build_face(&build, in_order, 3, -1, 0) &&
                     scene_build_finish(&build));
    Vec3 c = scene.centre;
    assert_vec3_within(0.002, vec3(1001.05, 2001, 3000), c);
    TEST_ASSERT_EQUAL(1, scene.face_count);
    TEST_ASSERT_TRUE(scene.faces[0].vertices[0][0] == (float)(1000.1 - c.x));
    TEST_ASSERT_TRUE(scene.faces[0].vertices[2][1] == (float)(2002 - c.y));
    TEST_ASSERT_EQUAL_MEMORY(scene.faces[0].vertices[0], scene.faces[0].vertices[3], sizeof scene.faces[0].vertices[0]);
    assert_vec3_within(0, vec3(0, 0, 1), scene.planes[0].normal);
    assert_vec3_within(0, vec3_sub(vec3(1000, 2000, 3004), c), scene.lights[0].position);
    assert_vec3_within(0, vec3_sub(vec3(0, 0, 9), c), scene.camera.position);
    assert_vec3_within(0, vec3_negate(c), scene.camera.look_at);
}

static void scene_centre_should_move_with_the_scene(void)
{
    const double sizes[] = {1e-3, 0.1, 1, 2, 3.7, 1024, 50000}, moves[] = {1e6, -1e6, 65536};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        for (size_t k = 0; k < sizeof moves / sizeof *moves; k++) {
            Vec3 low = vec3(-0.25 * sizes[i], 0, 1), high = vec3(0.75 * sizes[i], 0.5 * sizes[i], 1);
            Vec3 move = vec3(moves[k], moves[k], moves[k]);
            Vec3 here = scene_centre(low, high), there = scene_centre(vec3_add(low, move), vec3_add(high, move));
            assert_vec3_within(sizes[i] / 1024, vec3(0.25 * sizes[i], 0.25 * sizes[i], 1), here);
            assert_vec3_within(0, vec3_add(here, move), there);
        }
    assert_vec3_within(0, vec3(0.1, 0.2, 0.3), scene_centre(vec3(0.1, 0.2, 0.3), vec3(0.1, 0.2, 0.3)));
}

/* The normals of a box point away from its middle, and come in the documented order of axes. */
static void assert_box_outward(Transform transform)
{
    TEST_ASSERT_TRUE(scene_build_object(&build, "box", (SceneBuildObject){.transform = transform}));
    TEST_ASSERT_TRUE(scene_build_box(&build, vec3(1, 2, 3), vec3(2, 4, 6)) && scene_build_finish(&build));
    TEST_ASSERT_EQUAL(6, scene.face_count);
    Vec3 middle = vec3_sub(transform_point(&transform, vec3(1.5, 3, 4.5)), scene.centre);
    for (int i = 0; i < 6; i++) {
        double side = i % 2 ? 1 : -1;
        Vec3 expected = vec3(i / 2 == 0 ? side : 0, i / 2 == 1 ? side : 0, i / 2 == 2 ? side : 0);
        expected =
            vec3_sub(transform_point(&transform, expected), transform.offset); /* axes stay at right angles here */
        assert_vec3_within(1e-6, vec3_unit(expected), scene.planes[i].normal);
        TEST_ASSERT_TRUE(vec3_dot(scene.planes[i].normal, vec3_sub(face_vertex(&scene.faces[i], 0), middle)) > 0);
    }
}

static void box_should_be_wound_outward_in_order(void)
{
    assert_box_outward(transform_identity());
}

static void box_should_stay_wound_outward_when_mirrored(void)
{
    assert_box_outward(transform_scale(vec3(1, 1, -1)));
}

static void box_should_stay_wound_outward_when_turned_and_mirrored(void)
{
    Transform transform = transform_then(transform_scale(vec3(-2, -2, -2)), transform_rotate(vec3(1, 2, 3), 40));
    assert_box_outward(transform_then(transform, transform_translate(vec3(5, 6, 7))));
}

static void split_should_cut_from_vertex_0_to_2_and_keep_the_number(void)
{
    const Vec3 bent[4] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 1}, {0, 2, 0}};
    TEST_ASSERT_TRUE(
        scene_build_object(&build, "bent", (SceneBuildObject){.transform = transform_identity(), .split = true}));
    TEST_ASSERT_TRUE(add_points(bent, 4) && scene_build_face(&build, in_order, 4, -1, 0));
    TEST_ASSERT_TRUE(scene_build_face(&build, (const int[]){0, 1, 2}, 3, -1, 1) && scene_build_finish(&build));
    TEST_ASSERT_EQUAL(3, scene.face_count);
    static const int corners[2][3] = {{0, 1, 2}, {0, 2, 3}};
    for (int i = 0; i < 2; i++) {
        TEST_ASSERT_EQUAL(0, scene.faces[i].number);
        TEST_ASSERT_EQUAL(3, scene.faces[i].vertex_count);
        for (int k = 0; k < 3; k++)
            assert_vec3_within(0, vec3_sub(bent[corners[i][k]], scene.centre), face_vertex(&scene.faces[i], k));
    }
    TEST_ASSERT_EQUAL(1, scene.faces[2].number);
}

static void split_should_leave_a_planar_face_whole(void)
{
    TEST_ASSERT_TRUE(
        scene_build_object(&build, "flat", (SceneBuildObject){.transform = transform_identity(), .split = true}));
    TEST_ASSERT_TRUE(add_points(square, 4) && scene_build_face(&build, in_order, 4, -1, 0));
    TEST_ASSERT_EQUAL(1, build.face_count);
}

static void the_front_should_stay_the_front_in_a_mirror(void)
{
    TEST_ASSERT_TRUE(
        scene_build_object(&build, "mirrored", (SceneBuildObject){.transform = transform_scale(vec3(-1, 1, 1))}));
    TEST_ASSERT_TRUE(add_points(square, 4) && scene_build_face(&build, in_order, 4, -1, 0) &&
                     scene_build_finish(&build));
    assert_vec3_within(0, vec3(0, 0, 1), scene.planes[0].normal);
    assert_vec3_within(0, vec3_negate(scene.centre), face_vertex(&scene.faces[0], 0)); /* vertex 0 stays the first */
}

static void finish_should_name_the_face_that_float32_cannot_hold(void)
{
    const Vec3 points[6] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1e8, 0, 0}, {1e8 + 1, 0, 0}, {1e8, 1, 0}};
    TEST_ASSERT_TRUE(add_points(points, 6));
    TEST_ASSERT_TRUE(scene_build_face(&build, (const int[]){0, 1, 2}, 3, -1, 70) &&
                     scene_build_face(&build, (const int[]){3, 4, 5}, 3, -1, 71));
    TEST_ASSERT_FALSE(scene_build_finish(&build));
    TEST_ASSERT_EQUAL(70, build.fault->place); /* both are 5e7 from the centre, where a float's step is 4 */
    TEST_ASSERT_NOT_NULL(strstr(build.reason, "too small"));
}

static void finish_should_refuse_coordinates_beyond_1e12(void)
{
    const Vec3 points[3] = {{0, 0, 0}, {2.1e12, 0, 0}, {0, 1e12, 0}};
    TEST_ASSERT_TRUE(add_points(points, 3) && scene_build_face(&build, in_order, 3, -1, 0));
    TEST_ASSERT_FALSE(scene_build_finish(&build));
    TEST_ASSERT_NOT_NULL(strstr(build.reason, "1e12"));
}

static void finish_should_accept_a_scene_far_away_from_the_origin(void)
{
    scene.camera.position = vec3(1e15, 0, 9);
    scene.camera.look_at = vec3(1e15, 0, 0);
    const Vec3 points[3] = {{1e15, 0, 0}, {1e15 + 8, 0, 0}, {1e15, 8, 0}};
    TEST_ASSERT_TRUE(add_points(points, 3) && scene_build_face(&build, in_order, 3, -1, 0) &&
                     scene_build_finish(&build));
    TEST_ASSERT_TRUE(scene.faces[0].vertices[1][0] - scene.faces[0].vertices[0][0] == 8);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(scale_should_multiply_each_axis);
    RUN_TEST(translate_should_add);
    RUN_TEST(rotate_should_follow_the_right_hand);
    RUN_TEST(quarter_turns_should_be_exact);
    RUN_TEST(steps_should_apply_in_order);
    RUN_TEST(shape_should_accept_convex_faces_either_way_round);
    RUN_TEST(shape_should_find_each_fault_in_every_rotation_of_the_order);
    RUN_TEST(shape_should_measure_planarity_against_the_longer_diagonal);
    RUN_TEST(shape_should_take_rounding_errors_for_no_area);
    RUN_TEST(faces_should_be_centred_rounded_once_and_get_their_planes);
    RUN_TEST(scene_centre_should_move_with_the_scene);
    RUN_TEST(box_should_be_wound_outward_in_order);
    RUN_TEST(box_should_stay_wound_outward_when_mirrored);
    RUN_TEST(box_should_stay_wound_outward_when_turned_and_mirrored);
    RUN_TEST(split_should_cut_from_vertex_0_to_2_and_keep_the_number);
    RUN_TEST(split_should_leave_a_planar_face_whole);
    RUN_TEST(the_front_should_stay_the_front_in_a_mirror);
    RUN_TEST(finish_should_name_the_face_that_float32_cannot_hold);
    RUN_TEST(finish_should_refuse_coordinates_beyond_1e12);
    RUN_TEST(finish_should_accept_a_scene_far_away_from_the_origin);
    return UNITY_END();
}
