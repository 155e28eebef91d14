/* Textbook arithmetic: the plain kernel against textbook.c on every scene in scenes/, scenes/lessons/ and
 * tests/scenes/, the same bytes and counts in either precision, for all that both do is rounded alike. A new scene file
 * is tested without a word here. */
#include "reader/scene_json.h"
#include "scene/geometry.h"
#include "trace/reference.h"
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
    Ray ray = {origin, direction};
    TextbookTest found[] = {textbook_test(&textbook, 0, ray), textbook_test_float(&textbook, 0, ray)};
    for (int i = 0; i < 2; i++) {
        TEST_ASSERT_EQUAL(expected > 0, found[i].hit);
        TEST_ASSERT_EQUAL(expected > 0, found[i].test.verdict == FACE_INSIDE);
        if (expected > 0)
            TEST_ASSERT_EQUAL_DOUBLE(expected, found[i].test.t);
    }
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
    TextbookTest from_above = textbook_test(&textbook, 0, (Ray){vec3(0.5, 0, 5), vec3(0, 0, -2)});
    TEST_ASSERT_EQUAL_DOUBLE(1, from_above.point.z);
    TEST_ASSERT_EQUAL_DOUBLE(1.25, from_above.shifted.z);
    TextbookTest from_below = textbook_test_float(&textbook, 0, (Ray){vec3(0.5, 0, -1), vec3(0, 0, 2)});
    TEST_ASSERT_EQUAL_DOUBLE(0.5, from_below.shifted.x);
    TEST_ASSERT_EQUAL_DOUBLE(0.75, from_below.shifted.z);
    scene_free(&scene);
}

static void textbook_test_should_say_why_a_face_is_not_hit(void)
{
    Scene scene = square_scene();
    const Textbook textbook = {.scene = &scene};
    TextbookTest missed = textbook_test(&textbook, 0, (Ray){vec3(1.5, 0, 5), vec3(0, 0, -1)});
    TEST_ASSERT_EQUAL(FACE_OUTSIDE, missed.test.verdict);
    TEST_ASSERT_EQUAL(1, missed.test.outside_edge);
    TEST_ASSERT_EQUAL_DOUBLE(-1, missed.test.edge_value[1]);
    TEST_ASSERT_EQUAL(FACE_PARALLEL, textbook_test(&textbook, 0, (Ray){vec3(0, 0, 5), vec3(1, 0, 0)}).test.verdict);
    TEST_ASSERT_EQUAL(FACE_BEHIND, textbook_test(&textbook, 0, (Ray){vec3(0, 0, 5), vec3(0, 0, 1)}).test.verdict);
    scene.faces[0].one_sided = 1;
    TEST_ASSERT_EQUAL(FACE_BACK, textbook_test(&textbook, 0, (Ray){vec3(0, 0, -5), vec3(0, 0, 1)}).test.verdict);
    scene_free(&scene);
}

/* --- What it tells --- */

typedef struct Told {
    Event events[64];
    int count;
} Told;

static void keep(void *user, const Event *event)
{
    Told *told = user;
    if (event->kind != EVENT_FACE && event->kind != EVENT_OCCLUDER)
        told->events[told->count++] = *event;
}

static void assert_near(Vec3 expected, Vec3 found)
{
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, expected.x, found.x);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, expected.y, found.y);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, expected.z, found.z);
}

static void assert_same_event(const Event *expected, const Event *found)
{
    switch (expected->kind) {
    case EVENT_SAMPLE:
        assert_near(expected->as.sample.q, found->as.sample.q);
        assert_near(expected->as.sample.r, found->as.sample.r);
        break;
    case EVENT_HIT:
        TEST_ASSERT_EQUAL(expected->as.hit.face, found->as.hit.face);
        TEST_ASSERT_EQUAL(expected->as.hit.step, found->as.hit.step);
        TEST_ASSERT_EQUAL_MEMORY(expected->as.hit.test.edge_sign, found->as.hit.test.edge_sign, 4 * sizeof(int));
        TEST_ASSERT_DOUBLE_WITHIN(1e-4, expected->as.hit.test.n_dot_o_plus_d, found->as.hit.test.n_dot_o_plus_d);
        assert_near(expected->as.hit.point, found->as.hit.point);
        assert_near(expected->as.hit.normal, found->as.hit.normal);
        break;
    case EVENT_LIGHT:
        TEST_ASSERT_EQUAL(expected->as.light.side, found->as.light.side);
        assert_near(expected->as.light.l, found->as.light.l);
        break;
    case EVENT_LIGHT_END:
        TEST_ASSERT_EQUAL(expected->as.light_end.verdict, found->as.light_end.verdict);
        TEST_ASSERT_EQUAL(expected->as.light_end.blocker, found->as.light_end.blocker);
        break;
    case EVENT_TERMS:
        TEST_ASSERT_EQUAL(expected->as.terms.ambient_only, found->as.terms.ambient_only);
        assert_near(expected->as.terms.illumination.h, found->as.terms.illumination.h);
        assert_near(expected->as.terms.illumination.diffuse, found->as.terms.illumination.diffuse);
        assert_near(expected->as.terms.illumination.specular, found->as.terms.illumination.specular);
        assert_near(expected->as.terms.sum, found->as.terms.sum);
        break;
    case EVENT_SHADED:
        TEST_ASSERT_EQUAL(expected->as.shaded.lights_reaching, found->as.shaded.lights_reaching);
        assert_near(expected->as.shaded.contribution, found->as.shaded.contribution);
        assert_near(expected->as.shaded.total, found->as.shaded.total);
        break;
    case EVENT_REFLECTED:
        TEST_ASSERT_EQUAL(expected->as.reflected.bounce, found->as.reflected.bounce);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, expected->as.reflected.weight, found->as.reflected.weight);
        assert_near(expected->as.reflected.direction, found->as.reflected.direction);
        assert_near(expected->as.reflected.origin, found->as.reflected.origin);
        break;
    case EVENT_MISS:
        assert_near(expected->as.miss.weight_times_background, found->as.miss.weight_times_background);
        break;
    case EVENT_PATH_END:
        TEST_ASSERT_EQUAL(expected->as.path_end.reason, found->as.path_end.reason);
        assert_near(expected->as.path_end.colour, found->as.path_end.colour);
        break;
    default:
        TEST_ASSERT_EQUAL_MEMORY(expected->as.pixel.rgb, found->as.pixel.rgb, 3);
        TEST_ASSERT_EQUAL(expected->as.pixel.samples, found->as.pixel.samples);
    }
}

/* Where rounding decides nothing the textbook tells what the reference tells: paths that end in all four ways. */
static void textbook_should_tell_the_events_of_the_reference(void)
{
    static const struct {
        const char *scene;
        int column, row, bounces;
    } paths[] = {{"scenes/original.json", 40, 36, 13},      {"scenes/original.json", 40, 36, 1},
                 {"scenes/lessons/acne.json", 95, 151, 13}, {"scenes/lessons/leak.json", 160, 120, 13},
                 {"scenes/original.json", 50, 50, 13},      {"tests/scenes/shadow_black.json", 4, 3, 13},
                 {"tests/scenes/viewer_ray.json", 4, 3, 13}};
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++) {
        Scene scene;
        Error error = {0};
        TEST_ASSERT_TRUE_MESSAGE(scene_load(&scene, paths[i].scene, &error), error.text);
        scene.shading.max_bounces = paths[i].bounces;
        scene.grid = 1;
        RenderReport report = {0};
        unsigned char rgb[3];
        Told told[2] = {{.count = 0}};
        Recorder recorders[] = {{keep, &told[0]}, {keep, &told[1]}};
        Tracer tracer = {.scene = &scene, .report = &report, .recorder = &recorders[0]};
        Textbook textbook = {.scene = &scene, .shift = 1e-5f, .report = &report, .recorder = &recorders[1]};
        reference_pixel(&tracer, paths[i].column, paths[i].row);
        textbook_pixel(&textbook, paths[i].column, paths[i].row, rgb);
        TEST_ASSERT_EQUAL(told[0].count, told[1].count);
        for (int k = 0; k < told[0].count; k++) {
            TEST_ASSERT_EQUAL(told[0].events[k].kind, told[1].events[k].kind);
            assert_same_event(&told[0].events[k], &told[1].events[k]);
        }
        scene_free(&scene);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(textbook_hit_should_follow_the_steps);
    RUN_TEST(textbook_points_should_be_shifted_to_the_ray_s_side);
    RUN_TEST(textbook_test_should_say_why_a_face_is_not_hit);
    RUN_TEST(textbook_should_tell_the_events_of_the_reference);
    RUN_TEST(textbook_kernel_should_equal_the_textbook_reference_on_every_scene);
    RUN_TEST(textbook_in_double_should_say_what_the_exact_arithmetic_says_but_for_few_pixels);
    RUN_TEST(each_lesson_should_show_its_fault);
    RUN_TEST(shift_should_decide_whether_a_face_shadows_itself);
    return UNITY_END();
}
