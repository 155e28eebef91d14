/* Textbook arithmetic: the plain kernel against textbook.c on every scene in scenes/ and tests/scenes/, the same bytes
 * and counts in either precision, for all that both do is rounded alike. A new scene file is tested without a word
 * here. */
#include "trace/render.h"

#include "support/plain_picture.h"

#include "unity.h"

#include <stdlib.h>

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

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(textbook_kernel_should_equal_the_textbook_reference_on_every_scene);
    RUN_TEST(textbook_in_double_should_say_what_the_exact_arithmetic_says_but_for_few_pixels);
    RUN_TEST(shift_should_decide_whether_a_face_shadows_itself);
    return UNITY_END();
}
