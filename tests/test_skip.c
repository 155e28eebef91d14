/* Work that is left out: each kind is counted where a scene lets it be left out, is done where it must, and never
 * changes a byte. The pictures of all scene files, with and without, are compared in test_backends.c. */
#include "opencl/opencl.h"
#include "trace/reference_render.h"
#include "trace/skip.h"

#include "support/small_scene.h"

#include "unity.h"

#include <stdlib.h>
#include <string.h>

static SmallScene small;
static Error error;

enum { BOX_FACES = 6 };

static const Material MATT = {.ambient = {0.2, 0.1, 0.1}, .diffuse = {0.7, 0.6, 0.5}};
static const Material SHINY = {
    .ambient = {0.1, 0.1, 0.2}, .diffuse = {0.4, 0.5, 0.6}, .specular = {0.8, 0.7, 0.6}, .shininess = 40};
static const Material MIRROR = {.ambient = {0.1, 0.2, 0.1}, .diffuse = {0.3, 0.3, 0.3}, .reflection = 0.5};

/* The camera at the origin looks along -z; x and y of the rays through the pixels' centres are odd multiples of 1/4. */
void setUp(void)
{
    small_scene_begin(&small);
    error = (Error){0};
    small.scene.camera.position = vec3(0, 0, 0);
    small.scene.camera.look_at = vec3(0, 0, -1);
    small.scene.screen = (Screen){.columns = 16, .rows = 12, .distance = 1, .width = 8};
    small.scene.shading.background = vec3(0.3, 0.5, 0.7);
    small.scene.shading.shadow = SHADOW_AMBIENT;
}

void tearDown(void) {}

/* --- Scenes --- */

/* The corners of a side, outwards: bit 0 of a digit is x, bit 1 is y, bit 2 is z. */
static const int SIDES[BOX_FACES][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                        {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

static Vec3 corner_of(Vec3 low, Vec3 high, int corner)
{
    return vec3(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z);
}

static void add_side(int material, Vec3 low, Vec3 high, int side)
{
    const int *k = SIDES[side];
    small_scene_face(&small, material,
                     face_quad(corner_of(low, high, k[0]), corner_of(low, high, k[1]), corner_of(low, high, k[2]),
                               corner_of(low, high, k[3])));
}

static void add_box(int material, Vec3 low, Vec3 high)
{
    for (int side = 0; side < BOX_FACES; side++)
        add_side(material, low, high, side);
}

static void add_floor(int material)
{
    small_scene_face(&small, material,
                     face_quad(vec3(-50, -3, 0), vec3(50, -3, 0), vec3(50, -3, -60), vec3(-50, -3, -60)));
}

/* --- Pictures --- */

typedef struct Picture {
    unsigned char rgb[16 * 12 * 3];
    RenderReport report;
} Picture;

static bool take_band(void *user, int first_row, int rows, const unsigned char *rgb, const RenderReport *so_far,
                      Error *e)
{
    (void)so_far;
    (void)e;
    memcpy((unsigned char *)user + (size_t)first_row * 16 * 3, rgb, (size_t)rows * 16 * 3);
    return true;
}

static Picture render(Precision precision, AccelKind accel, unsigned no_skip)
{
    Picture picture;
    RenderSettings settings = {.precision = precision, .accel = accel, .device = -1, .no_skip = no_skip};
    TEST_ASSERT_TRUE_MESSAGE(
        opencl_render(&small.scene, &settings, (BandSink){take_band, picture.rgb}, &picture.report, &error),
        error.text);
    return picture;
}

/* The reference's bytes, with and without; the given count with, none without. */
static void assert_skipped(int skip, AccelKind accel, uint64_t count)
{
    Picture expected;
    TEST_ASSERT_TRUE_MESSAGE(reference_render(&small.scene, &(RenderSettings){.accel = ACCEL_NONE},
                                              (BandSink){take_band, expected.rgb}, &expected.report, &error),
                             error.text);
    Picture with = render(PRECISION_DOUBLE, accel, 0), without = render(PRECISION_DOUBLE, accel, 1u << skip);
    const char *name = skip_texts[skip].name;
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(count, with.report.skipped[skip], name);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(0, without.report.skipped[skip], name);
    TEST_ASSERT_EQUAL_MEMORY_MESSAGE(expected.rgb, with.rgb, sizeof with.rgb, name);
    TEST_ASSERT_EQUAL_MEMORY_MESSAGE(expected.rgb, without.rgb, sizeof without.rgb, name);
    Picture float_with = render(PRECISION_FLOAT, accel, 0), float_without = render(PRECISION_FLOAT, accel, 1u << skip);
    TEST_ASSERT_EQUAL_MEMORY_MESSAGE(float_with.rgb, float_without.rgb, sizeof float_with.rgb, name);
}

/* --- Each kind --- */

static void lights_behind_a_face_should_get_no_shadow_rays(void)
{
    small_scene_face(&small, small_scene_material(&small, MATT), face_at_height(-50, -50, 50, 50, -5));
    small_scene_light(&small, vec3(0, 0, -9));
    assert_skipped(SKIP_LIGHT_BEHIND, ACCEL_NONE, 16 * 12);
    TEST_ASSERT_EQUAL_UINT64(0, render(PRECISION_FLOAT, ACCEL_NONE, 0).report.rays.shadow);
    TEST_ASSERT_EQUAL_UINT64(16 * 12, render(PRECISION_FLOAT, ACCEL_NONE, 1u << SKIP_LIGHT_BEHIND).report.rays.shadow);
}

static void light_that_is_only_ambient_should_get_no_shadow_rays(void)
{
    small_scene_face(&small, small_scene_material(&small, MATT), face_at_height(-50, -50, 50, 50, -5));
    Light *light = small_scene_light(&small, vec3(0, 3, 0));
    light->diffuse = light->specular = vec3(0, 0, 0);
    assert_skipped(SKIP_LIGHT_AMBIENT, ACCEL_NONE, 16 * 12);
    small.scene.shading.shadow = SHADOW_BLACK; /* now its shadow is black */
    assert_skipped(SKIP_LIGHT_AMBIENT, ACCEL_NONE, 0);
}

static void material_without_highlight_should_get_no_specular_term(void)
{
    small_scene_face(&small, small_scene_material(&small, MATT), face_at_height(-50, -50, 0, 50, -5));
    small_scene_face(&small, small_scene_material(&small, SHINY), face_at_height(0, -50, 50, 50, -5));
    small_scene_light(&small, vec3(1, 3, 0));
    assert_skipped(SKIP_HIGHLIGHT, ACCEL_NONE, 8 * 12);
    small.lights[0].specular = vec3(0, 0, 0);
    assert_skipped(SKIP_HIGHLIGHT, ACCEL_NONE, 16 * 12);
}

static void bounce_that_cannot_change_a_byte_should_end_the_path(void)
{
    int mirror = small_scene_material(&small, (Material){.ambient = {1, 1, 1}, .reflection = 0.5});
    small_scene_face(&small, mirror, face_at_height(-50, -50, 0, 50, -5));
    int dull = small_scene_material(&small, (Material){.ambient = {0.5, 0.5, 0.5}, .reflection = 0.5});
    small_scene_face(&small, dull, face_at_height(0, -50, 50, 50, -5));
    small_scene_light(&small, vec3(1, 3, 0));
    /* The left half is white whatever a mirror adds; the right half is not. */
    assert_skipped(SKIP_WEAK_BOUNCE, ACCEL_NONE, 8 * 12);
    TEST_ASSERT_EQUAL_UINT64(8 * 12, render(PRECISION_FLOAT, ACCEL_NONE, 0).report.rays.reflection);
    /* With more rays for a pixel no single one decides. */
    small.scene.grid = 2;
    assert_skipped(SKIP_WEAK_BOUNCE, ACCEL_NONE, 0);
}

static void tiles_beside_the_scene_should_cast_no_rays(void)
{
    add_box(small_scene_material(&small, MATT), vec3(-0.9, -0.9, -3), vec3(-0.6, -0.6, -2.5));
    small_scene_light(&small, vec3(1, 3, 0));
    Picture picture = render(PRECISION_FLOAT, ACCEL_BVH, 0);
    TEST_ASSERT_GREATER_THAN_UINT64(0, picture.report.skipped[SKIP_EMPTY_TILE]);
    TEST_ASSERT_EQUAL_UINT64(16 * 12, picture.report.rays.primary);
    assert_skipped(SKIP_EMPTY_TILE, ACCEL_BVH, render(PRECISION_DOUBLE, ACCEL_BVH, 0).report.skipped[SKIP_EMPTY_TILE]);
    /* A tree has a box around it; without one nothing tells where the scene ends. */
    assert_skipped(SKIP_EMPTY_TILE, ACCEL_NONE, 0);
}

/* Between two mirrors that face one another a box throws its shadow: of four tiles some see one wall, in mirror after
 * mirror, in the light or in the shadow, others a part of the box, or their light is cut by it. */
static void tiles_that_see_the_same_should_be_traced_by_their_corners(void)
{
    uint64_t whole = 0;
    const float lefts[] = {-11, -7, -2, 1, 4, 8}, heights[] = {-6, 2, -1, 4, -4, 1};
    for (int k = 0; k < 6; k++) {
        small_scene_begin(&small);
        setUp();
        int mirror = small_scene_material(&small, (Material){.ambient = {0.1, 0.1, 0.1},
                                                             .diffuse = {0.4, 0.5, 0.6},
                                                             .specular = {0.3, 0.3, 0.3},
                                                             .shininess = 40,
                                                             .reflection = 0.6});
        small_scene_face(&small, mirror, face_at_height(-50, -50, 50, 50, -5));
        small_scene_face(&small, mirror, face_at_height(-50, -50, 50, 50, 2));
        small.scene.faces[0].one_sided = small.scene.faces[1].one_sided = k % 3 == 2;
        double left = (double)lefts[k], low = (double)heights[k];
        add_box(small_scene_material(&small, MATT), vec3(left, low, -3), vec3(left + 2, low + 1.5, -2.5));
        small_scene_light(&small, vec3(0.9, 1.5, 1));
        small_scene_light(&small, vec3(left + 0.7, low + 0.6, -1.9)); /* close to the box: a large shadow */
        small.scene.shading.max_bounces = 4;
        small.scene.shading.shadow = k % 2 ? SHADOW_BLACK : SHADOW_AMBIENT;
        for (int tree = 0; tree < 2; tree++) {
            Picture with = render(PRECISION_FLOAT, tree ? ACCEL_BVH : ACCEL_NONE, 0);
            Picture without = render(PRECISION_FLOAT, tree ? ACCEL_BVH : ACCEL_NONE, 1u << SKIP_WHOLE_TILE);
            whole += with.report.skipped[SKIP_WHOLE_TILE];
            TEST_ASSERT_EQUAL_UINT64(0, without.report.skipped[SKIP_WHOLE_TILE]);
            TEST_ASSERT_EQUAL_UINT64(without.report.rays.primary, with.report.rays.primary);
            TEST_ASSERT_EQUAL_UINT64(without.report.rays.shadow, with.report.rays.shadow);
            TEST_ASSERT_EQUAL_UINT64(without.report.rays.reflection, with.report.rays.reflection);
            TEST_ASSERT_EQUAL_MEMORY(without.rgb, with.rgb, sizeof with.rgb);
        }
    }
    TEST_ASSERT_GREATER_THAN_UINT64(16 * 12, whole);
    /* In double every ray goes its own way. */
    TEST_ASSERT_EQUAL_UINT64(0, render(PRECISION_DOUBLE, ACCEL_BVH, 0).report.skipped[SKIP_WHOLE_TILE]);
}

static void tiles_should_go_on_whole_from_one_sided_mirrors(void)
{
    int mirror = small_scene_material(&small, (Material){.diffuse = {0.4, 0.5, 0.6}, .reflection = 0.5});
    small_scene_face(&small, mirror, face_at_height(-50, -50, 50, 50, -5))->one_sided = true;
    small_scene_light(&small, vec3(1, 3, 0));
    Picture picture;
    RenderSettings settings = {.device = -1, .lanes = 16, .accel = ACCEL_NONE}; /* the picture is one block then */
    TEST_ASSERT_TRUE_MESSAGE(
        opencl_render(&small.scene, &settings, (BandSink){take_band, picture.rgb}, &picture.report, &error),
        error.text);
    TEST_ASSERT_EQUAL_UINT64(16 * 12, picture.report.rays.reflection);
    TEST_ASSERT_EQUAL_UINT64(2 * 16 * 12, picture.report.skipped[SKIP_WHOLE_TILE]);
    /* The four corners of the block ask the face once, which neither mirrors itself nor stands in its own light. */
    TEST_ASSERT_EQUAL_UINT64(4, picture.report.face_tests);
}

static void lights_without_colour_should_be_left_out(void)
{
    small_scene_face(&small, small_scene_material(&small, MATT), face_at_height(-50, -50, 50, 50, -5));
    Light *light = small_scene_light(&small, vec3(1, 3, 0));
    light->ambient = light->diffuse = light->specular = vec3(0, 0, 0);
    small_scene_light(&small, vec3(2, 1, 0));
    assert_skipped(SKIP_LIGHT_BLACK, ACCEL_NONE, 1);
}

static void light_without_colour_should_stay_where_paths_go_on_from_it(void)
{
    small_scene_face(&small, small_scene_material(&small, MIRROR), face_at_height(-50, -50, 50, 50, -5));
    Light *light = small_scene_light(&small, vec3(1, 3, 0));
    light->ambient = light->diffuse = light->specular = vec3(0, 0, 0);
    small.scene.shading.shadow = SHADOW_BLACK;
    assert_skipped(SKIP_LIGHT_BLACK, ACCEL_NONE, 0);
    TEST_ASSERT_EQUAL_UINT64(16 * 12, render(PRECISION_FLOAT, ACCEL_NONE, 0).report.rays.reflection);
}

static void faces_that_no_ray_can_hit_should_be_left_out(void)
{
    int matt = small_scene_material(&small, MATT);
    small_scene_face(&small, matt, face_at_height(-50, -50, 50, 50, -5));
    small_scene_face(&small, matt, face_at_height(-1, -1, 1, 1, -3))->one_sided = 1;
    small_scene_face(&small, matt, face_at_height(-1, -1, 1, 1, 3))->one_sided = 1;
    small_scene_light(&small, vec3(0, 2, -1));
    /* The first two are seen; the third, behind the camera, might block light from its front to the light behind it. */
    assert_skipped(SKIP_UNREACHABLE_FACE, ACCEL_NONE, 0);
    small.lights[0].position = vec3(0, 2, 5);
    assert_skipped(SKIP_UNREACHABLE_FACE, ACCEL_NONE, 1); /* one-sided, it lets the light through from its back */
    small.faces[2].one_sided = 0;
    assert_skipped(SKIP_UNREACHABLE_FACE, ACCEL_NONE, 0); /* now it blocks it */
}

static void scene_without_mirrors_should_need_no_code_for_them(void)
{
    small_scene_face(&small, small_scene_material(&small, MATT), face_at_height(-50, -50, 50, 50, -5));
    small_scene_light(&small, vec3(0, 2, -1));
    assert_skipped(SKIP_MIRRORS, ACCEL_NONE, 1);
    small.materials[0].reflection = 0.5;
    assert_skipped(SKIP_MIRRORS, ACCEL_NONE, 0);
    small.scene.shading.max_bounces = 0;
    assert_skipped(SKIP_MIRRORS, ACCEL_NONE, 1);
}

static void small_scene_should_need_no_tree(void)
{
    int matt = small_scene_material(&small, MATT);
    add_box(matt, vec3(-2, -2, -8), vec3(2, 2, -4));
    small_scene_light(&small, vec3(0, 5, 0));
    assert_skipped(SKIP_TREE, ACCEL_AUTO, 1);
    TEST_ASSERT_EQUAL_INT(ACCEL_NONE, render(PRECISION_FLOAT, ACCEL_AUTO, 0).report.accel);
    TEST_ASSERT_EQUAL_INT(ACCEL_BVH, render(PRECISION_FLOAT, ACCEL_AUTO, 1u << SKIP_TREE).report.accel);
    add_box(matt, vec3(-9, -2, -9), vec3(-5, 2, -6));
    assert_skipped(SKIP_TREE, ACCEL_AUTO, 0);
    assert_skipped(SKIP_TREE, ACCEL_NONE, 0); /* as asked for, not left out */
}

/* --- Closed boxes --- */

static int closed_faces(void)
{
    unsigned char closed[SMALL_SCENE_MAX] = {0};
    skip_closed_boxes(&small.scene, closed, 0);
    int count = 0;
    for (int i = 0; i < SMALL_SCENE_MAX; i++)
        count += closed[i] != 0;
    return count;
}

static void boxes_should_be_found_among_other_faces(void)
{
    int matt = small_scene_material(&small, MATT);
    add_floor(matt);
    add_box(matt, vec3(-2, -2, -8), vec3(2, 2, -4));
    add_floor(matt);
    add_box(matt, vec3(-9, -2, -9), vec3(-5, 2, -6));
    small_scene_light(&small, vec3(0, 5, 0));
    TEST_ASSERT_EQUAL_INT(2 * BOX_FACES, closed_faces());
}

static void box_should_be_closed_only_if_it_is_whole_and_two_sided_and_nothing_is_inside(void)
{
    int matt = small_scene_material(&small, MATT);
    const Vec3 low = vec3(-2, -2, -8), high = vec3(2, 2, -4);
    add_box(matt, low, high);
    Light *light = small_scene_light(&small, vec3(0, 5, 0));
    TEST_ASSERT_EQUAL_INT(BOX_FACES, closed_faces());

    light->position = vec3(0, 0, -5);
    TEST_ASSERT_EQUAL_INT_MESSAGE(0, closed_faces(), "a light inside");
    light->position = vec3(0, 2, -5);
    TEST_ASSERT_EQUAL_INT_MESSAGE(0, closed_faces(), "a light on the box");
    light->position = vec3(0, 5, 0);
    small.scene.camera.position = vec3(0, 0, -4);
    TEST_ASSERT_EQUAL_INT_MESSAGE(0, closed_faces(), "the camera on the box");
    small.scene.camera.position = vec3(0, 0, 0);

    small.faces[3].one_sided = 1;
    TEST_ASSERT_EQUAL_INT_MESSAGE(0, closed_faces(), "a one-sided face");
    small.faces[3].one_sided = 0;
    Face kept = small.faces[3];
    small.faces[3] =
        face_quad(corner_of(low, high, 3), corner_of(low, high, 7), corner_of(low, high, 6), corner_of(low, high, 2));
    small.planes[3] = face_plane(&small.faces[3]);
    TEST_ASSERT_EQUAL_INT_MESSAGE(0, closed_faces(), "a face turned inwards");
    small.faces[3] = small.faces[2];
    small.planes[3] = small.planes[2];
    TEST_ASSERT_EQUAL_INT_MESSAGE(0, closed_faces(), "a face twice, another missing");
    small.faces[3] = kept;
    small.planes[3] = face_plane(&kept);
    small.faces[3].vertices[0][1] += 0.001f;
    TEST_ASSERT_EQUAL_INT_MESSAGE(0, closed_faces(), "a gap");
    small.faces[3] = kept;
    TEST_ASSERT_EQUAL_INT(BOX_FACES, closed_faces());
    small.scene.face_count--;
    TEST_ASSERT_EQUAL_INT_MESSAGE(0, closed_faces(), "an open box");
}

static void box_too_thin_for_rounding_should_not_be_closed(void)
{
    add_box(small_scene_material(&small, MATT), vec3(-2, -2, -4.0001), vec3(2, 2, -4));
    TEST_ASSERT_EQUAL_INT(BOX_FACES, closed_faces());
    small.scene.camera.position = vec3(0, 0, 1000);
    TEST_ASSERT_EQUAL_INT(0, closed_faces());
}

/* Rays through the pixels' centres meet edges of these boxes exactly: front and back are equally near there. */
static void backs_should_be_asked_where_rounding_makes_them_as_near_as_the_front(void)
{
    int matt = small_scene_material(&small, MATT), shiny = small_scene_material(&small, SHINY);
    int mirror = small_scene_material(&small, MIRROR);
    add_floor(mirror);
    add_box(matt, vec3(1, -3, -8), vec3(3, 1, -4));
    add_box(shiny, vec3(-3, -3, -8), vec3(-1, 3, -4));
    add_box(matt, vec3(-1, -3, -12), vec3(1, -1, -4)); /* stands beside both, with edges and sides in common */
    add_box(shiny, vec3(1, 1, -8), vec3(3, 2, -4));    /* stands on the first one */
    add_box(mirror, vec3(-9, -3, -12.75), vec3(9, 3, -12.25));
    small_scene_light(&small, vec3(-1, 5, 1)); /* in the planes of sides */
    small_scene_light(&small, vec3(6, 4, -6));
    TEST_ASSERT_EQUAL_INT(5 * BOX_FACES, closed_faces());
    AccelKind kinds[] = {ACCEL_NONE, ACCEL_BVH, ACCEL_KDTREE};
    for (int k = 0; k < 3; k++) {
        uint64_t count = render(PRECISION_DOUBLE, kinds[k], 0).report.skipped[SKIP_BACK_FACE];
        TEST_ASSERT_GREATER_THAN_UINT64(0, count);
        assert_skipped(SKIP_BACK_FACE, kinds[k], count);
    }
}

/* Threads search the faces in pieces, and a box may lie across the end of one. */
static void boxes_of_a_long_row_should_be_found_wherever_they_begin(void)
{
    enum { BOXES = 5000 };
    add_box(small_scene_material(&small, MATT), vec3(-2, -2, -8), vec3(2, 2, -4));
    const int count = BOXES * BOX_FACES + BOX_FACES;
    Scene row = small.scene;
    row.faces = malloc((size_t)count * sizeof *row.faces);
    row.planes = malloc((size_t)count * sizeof *row.planes);
    unsigned char *closed = malloc((size_t)count);
    TEST_ASSERT_TRUE(row.faces && row.planes && closed);
    for (int before = 0; before < BOX_FACES; before++) {
        row.face_count = before + BOXES * BOX_FACES;
        for (int i = 0; i < row.face_count; i++) {
            int side = i < before ? 0 : (i - before) % BOX_FACES, box = i < before ? -1 : (i - before) / BOX_FACES;
            row.faces[i] = small.scene.faces[side];
            row.planes[i] = small.scene.planes[side];
            for (int k = 0; k < 4; k++)
                row.faces[i].vertices[k][2] -= (float)(10 * box);
        }
        for (int threads = 1; threads <= 3; threads += 2) {
            memset(closed, 0, (size_t)count);
            skip_closed_boxes(&row, closed, threads);
            for (int i = 0; i < row.face_count; i++)
                TEST_ASSERT_EQUAL_INT_MESSAGE(i >= before, closed[i] != 0, "a face of a box");
        }
    }
    free(row.faces);
    free(row.planes);
    free(closed);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(lights_behind_a_face_should_get_no_shadow_rays);
    RUN_TEST(light_that_is_only_ambient_should_get_no_shadow_rays);
    RUN_TEST(material_without_highlight_should_get_no_specular_term);
    RUN_TEST(bounce_that_cannot_change_a_byte_should_end_the_path);
    RUN_TEST(tiles_beside_the_scene_should_cast_no_rays);
    RUN_TEST(tiles_that_see_the_same_should_be_traced_by_their_corners);
    RUN_TEST(tiles_should_go_on_whole_from_one_sided_mirrors);
    RUN_TEST(lights_without_colour_should_be_left_out);
    RUN_TEST(light_without_colour_should_stay_where_paths_go_on_from_it);
    RUN_TEST(faces_that_no_ray_can_hit_should_be_left_out);
    RUN_TEST(scene_without_mirrors_should_need_no_code_for_them);
    RUN_TEST(small_scene_should_need_no_tree);
    RUN_TEST(boxes_should_be_found_among_other_faces);
    RUN_TEST(box_should_be_closed_only_if_it_is_whole_and_two_sided_and_nothing_is_inside);
    RUN_TEST(box_too_thin_for_rounding_should_not_be_closed);
    RUN_TEST(backs_should_be_asked_where_rounding_makes_them_as_near_as_the_front);
    RUN_TEST(boxes_of_a_long_row_should_be_found_wherever_they_begin);
    return UNITY_END();
}
