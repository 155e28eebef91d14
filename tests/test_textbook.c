/* Textbook arithmetic: the plain kernel against textbook.c on every scene in scenes/, scenes/lessons/ and
 * tests/scenes/, the same bytes and counts in either precision, for all that both do is rounded alike. A new scene file
 * is tested without a word here. */
#include "reader/scene_json.h"
#include "scene/geometry.h"
#include "trace/textbook.h"

#include "support/plain_picture.h"

#include "unity.h"

#include <glob.h>
#include <stdlib.h>
#include <string.h>

static const AccelKind ACCELS[] = {ACCEL_NONE, ACCEL_KDTREE, ACCEL_BVH};
enum { ACCEL_KINDS = sizeof ACCELS / sizeof ACCELS[0] };

void setUp(void) {}
void tearDown(void) {}

static void compare_textbook(const char *path, const Scene *scene)
{
    for (int precision = PRECISION_FLOAT; precision <= PRECISION_DOUBLE; precision++) {
        RenderSettings settings = plain_settings((Precision)precision, ACCEL_NONE, ARITHMETIC_TEXTBOOK);
        Picture expected = picture_render(scene, BACKEND_REFERENCE, settings),
                picture = picture_render(scene, BACKEND_OPENCL, settings);
        assert_same_picture(path, &expected, &picture, &settings);
        free(expected.rgb);
        free(picture.rgb);
    }
}

static void textbook_kernel_should_equal_the_textbook_reference_on_every_scene(void)
{
    for_each_scene(compare_textbook);
}

/* Both textbooks at once could be wrong: where rounding decides nothing they say what the reference says. */
static void textbook_in_double_should_say_what_the_exact_arithmetic_says_but_for_few_pixels(void)
{
    Scene scene = load_small("scenes/gallery.json");
    Picture exact = picture_render(&scene, BACKEND_REFERENCE, (RenderSettings){.accel = ACCEL_AUTO});
    for (int k = 0; k < ACCEL_KINDS; k++) {
        RenderSettings settings = plain_settings(PRECISION_DOUBLE, ACCELS[k], ARITHMETIC_TEXTBOOK);
        Picture picture = picture_render(&scene, BACKEND_OPENCL, settings);
        int off = 0;
        for (int i = 0; i < exact.columns * exact.rows; i++)
            off += pixel_difference(&exact, &picture, i) > 1;
        TEST_ASSERT_LESS_OR_EQUAL(2, off);
        free(picture.rgb);
    }
    free(exact.rgb);
    scene_free(&scene);
}

/* A fault that is visible at a glance takes hundreds of pixels of 76 800, and much of their colour. */
static void each_lesson_should_show_its_fault(void)
{
    glob_t found;
    TEST_ASSERT_EQUAL_INT(0, glob("scenes/lessons/*.json", 0, NULL, &found));
    TEST_ASSERT_GREATER_OR_EQUAL(6, found.gl_pathc);
    for (size_t lesson = 0; lesson < found.gl_pathc; lesson++) {
        Scene scene;
        Error error = {0};
        TEST_ASSERT_TRUE_MESSAGE(scene_load(&scene, found.gl_pathv[lesson], &error), error.text);
        RenderSettings textbook = plain_settings(PRECISION_FLOAT, ACCEL_NONE, ARITHMETIC_TEXTBOOK);
        Picture exact = picture_render(&scene, BACKEND_REFERENCE, (RenderSettings){.accel = ACCEL_AUTO});
        Picture picture = picture_render(&scene, BACKEND_REFERENCE, textbook);
        int off = 0;
        for (int i = 0; i < exact.columns * exact.rows; i++)
            off += pixel_difference(&exact, &picture, i) > 32;
        TEST_ASSERT_GREATER_OR_EQUAL_MESSAGE(500, off, found.gl_pathv[lesson]);
        free(exact.rgb);
        free(picture.rgb);
        scene_free(&scene);
    }
    globfree(&found);
}

static void shift_should_decide_whether_a_face_shadows_itself(void)
{
    Scene scene = load_small("scenes/cornell.json");
    RenderSettings settings = plain_settings(PRECISION_FLOAT, ACCEL_NONE, ARITHMETIC_TEXTBOOK);
    uint64_t reflections[2];
    const float shifts[] = {0, 1e-3f};
    for (int i = 0; i < 2; i++) {
        settings.shift = shifts[i];
        Picture picture = picture_render(&scene, BACKEND_REFERENCE, settings);
        reflections[i] = picture.report.rays.reflection;
        free(picture.rgb);
    }
    TEST_ASSERT_GREATER_THAN_UINT64_MESSAGE(reflections[1], reflections[0], "mirrors that meet themselves");
    scene_free(&scene);
}

/* --- Single steps --- */

/* A square of side 2 in the plane z = 1; its normal is +z. */
static Scene square_scene(void)
{
    Scene scene = load_small("tests/scenes/triangles.json");
    static const float corners[4][3] = {{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
    TEST_ASSERT_GREATER_OR_EQUAL(1, scene.face_count);
    memcpy(scene.faces[0].vertices, corners, sizeof corners);
    scene.faces[0].vertex_count = 4;
    scene.faces[0].one_sided = 0;
    scene.planes[0] = face_plane(&scene.faces[0]);
    return scene;
}

static void assert_hit(const Scene *scene, double expected, Vec3 origin, Vec3 direction)
{
    const Textbook textbook = {.scene = scene};
    TEST_ASSERT_EQUAL_DOUBLE(expected, textbook_hit(&textbook, 0, origin, direction));
    TEST_ASSERT_EQUAL_DOUBLE(expected, textbook_hit_float(&textbook, 0, origin, direction));
}

static void textbook_hit_should_follow_the_steps(void)
{
    Scene scene = square_scene();
    assert_hit(&scene, 2, vec3(0, 0, 5), vec3(0, 0, -2));
    assert_hit(&scene, 1.5, vec3(0.25, 0.5, -2), vec3(0, 0, 2));
    assert_hit(&scene, 0, vec3(0, 0, 5), vec3(1, 0, 0));   /* parallel */
    assert_hit(&scene, 0, vec3(0, 0, 5), vec3(0, 0, 1));   /* behind */
    assert_hit(&scene, 0, vec3(0, 0, 1), vec3(0, 0, 1));   /* in the plane */
    assert_hit(&scene, 4, vec3(1, 0, 5), vec3(0, 0, -1));  /* on an edge */
    assert_hit(&scene, 4, vec3(-1, 1, 5), vec3(0, 0, -1)); /* on a vertex */
    assert_hit(&scene, 0, vec3(0, -1.5, 5), vec3(0, 0, -1));
    assert_hit(&scene, 0, vec3(1.5, 0, 5), vec3(0, 0, -1));
    assert_hit(&scene, 0, vec3(0, 1.5, 5), vec3(0, 0, -1));
    assert_hit(&scene, 0, vec3(-1.5, 0, 5), vec3(0, 0, -1));
    scene.faces[0].one_sided = 1;
    assert_hit(&scene, 4, vec3(0, 0, 5), vec3(0, 0, -1));
    assert_hit(&scene, 0, vec3(0, 0, -5), vec3(0, 0, 1)); /* from behind */
    scene_free(&scene);
}

static void textbook_points_should_be_shifted_to_the_ray_s_side(void)
{
    Scene scene = square_scene();
    const Textbook textbook = {.scene = &scene, .shift = 0.25f};
    Vec3 point, shifted;
    textbook_points(&textbook, 0, vec3(0.5, 0, 5), vec3(0, 0, -2), 2, &point, &shifted);
    TEST_ASSERT_EQUAL_DOUBLE(1, point.z);
    TEST_ASSERT_EQUAL_DOUBLE(1.25, shifted.z);
    textbook_points_float(&textbook, 0, vec3(0.5, 0, -1), vec3(0, 0, 2), 1, &point, &shifted);
    TEST_ASSERT_EQUAL_DOUBLE(0.5, shifted.x);
    TEST_ASSERT_EQUAL_DOUBLE(0.75, shifted.z);
    scene_free(&scene);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(textbook_hit_should_follow_the_steps);
    RUN_TEST(textbook_points_should_be_shifted_to_the_ray_s_side);
    RUN_TEST(textbook_kernel_should_equal_the_textbook_reference_on_every_scene);
    RUN_TEST(textbook_in_double_should_say_what_the_exact_arithmetic_says_but_for_few_pixels);
    RUN_TEST(each_lesson_should_show_its_fault);
    RUN_TEST(shift_should_decide_whether_a_face_shadows_itself);
    return UNITY_END();
}
