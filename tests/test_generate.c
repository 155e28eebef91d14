/* Generated scenes: they load, have the faces that their size says, and are the same each time. */
#include "reader/generate.h"
#include "reader/scene_json.h"

#include "unity.h"

#include <stdlib.h>
#include <string.h>

typedef struct Text {
    char *bytes;
    long length;
} Text;

void setUp(void) {}
void tearDown(void) {}

/* The scene's text; the caller frees it. */
static Text generated(const char *name, int size, uint64_t seed)
{
    Error error = {0};
    const GenerateKind *kind = generate_find_kind(name, &error);
    TEST_ASSERT_NOT_NULL_MESSAGE(kind, error.text);
    FILE *file = tmpfile();
    TEST_ASSERT_NOT_NULL(file);
    TEST_ASSERT_TRUE_MESSAGE(generate_scene(kind, file, size, seed, &error), error.text);
    Text text = {.length = ftell(file)};
    TEST_ASSERT_GREATER_THAN(0, text.length);
    text.bytes = malloc((size_t)text.length);
    TEST_ASSERT_NOT_NULL(text.bytes);
    rewind(file);
    TEST_ASSERT_EQUAL_INT(text.length, fread(text.bytes, 1, (size_t)text.length, file));
    fclose(file);
    return text;
}

static Scene loaded(const char *name, int size)
{
    Error error = {0};
    Text text = generated(name, size, 7);
    Scene scene;
    TEST_ASSERT_TRUE_MESSAGE(scene_parse(&scene, "generated.json", text.bytes, text.length, &error), error.text);
    free(text.bytes);
    return scene;
}

static int face_count(const char *name, int size)
{
    Scene scene = loaded(name, size);
    int count = scene.face_count;
    scene_free(&scene);
    return count;
}

/* The surface of the sponge after n steps, in unit squares: 2 * 20^n + 4 * 8^n. */
static void menger_should_be_the_surface_of_the_sponge(void)
{
    TEST_ASSERT_EQUAL_INT(72, face_count("menger", 1));
    TEST_ASSERT_EQUAL_INT(1056, face_count("menger", 2));
    TEST_ASSERT_EQUAL_INT(18048, face_count("menger", 3));
}

/* Wound outward, the squares' areas along each axis cancel: the surface is closed. */
static void menger_should_be_closed(void)
{
    Scene scene = loaded("menger", 2);
    Vec3 sum = {0, 0, 0};
    for (int i = 0; i < scene.face_count; i++)
        sum = vec3_add(sum, scene.planes[i].normal);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0, sum.x);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0, sum.y);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0, sum.z);
    /* The hull is written first, its first square being one on the side of -x: its normal points that way. */
    TEST_ASSERT_EQUAL_DOUBLE(-1, scene.planes[0].normal.x);
    scene_free(&scene);
}

static void city_should_have_six_faces_per_box_and_floor(void)
{
    TEST_ASSERT_EQUAL_INT(12, face_count("city", 1));
    TEST_ASSERT_EQUAL_INT(6 * 101, face_count("city", 100));
    TEST_ASSERT_EQUAL_INT(6 * 1235, face_count("city", 1234));
}

static void grid_should_have_the_square_of_its_side(void)
{
    TEST_ASSERT_EQUAL_INT(1, face_count("grid", 1));
    TEST_ASSERT_EQUAL_INT(49, face_count("grid", 7));
}

static void scene_generate_should_repeat_itself(void)
{
    for (int i = 0; scene_kinds[i].name; i++) {
        Text a = generated(scene_kinds[i].name, 2, 5), b = generated(scene_kinds[i].name, 2, 5);
        TEST_ASSERT_EQUAL_INT(a.length, b.length);
        TEST_ASSERT_EQUAL_MEMORY(a.bytes, b.bytes, (size_t)a.length);
        free(a.bytes);
        free(b.bytes);
    }
}

static void another_seed_should_give_another_city(void)
{
    Text a = generated("city", 20, 1), b = generated("city", 20, 2);
    TEST_ASSERT_TRUE(a.length != b.length || memcmp(a.bytes, b.bytes, (size_t)a.length) != 0);
    free(a.bytes);
    free(b.bytes);
}

static void scene_kind_find_should_suggest_the_nearest(void)
{
    Error error = {0};
    TEST_ASSERT_NULL(generate_find_kind("meger", &error));
    TEST_ASSERT_EQUAL_INT(ERROR_USAGE, error.kind);
    TEST_ASSERT_NOT_NULL(strstr(error.text, "did you mean 'menger'"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(menger_should_be_the_surface_of_the_sponge);
    RUN_TEST(menger_should_be_closed);
    RUN_TEST(city_should_have_six_faces_per_box_and_floor);
    RUN_TEST(grid_should_have_the_square_of_its_side);
    RUN_TEST(scene_generate_should_repeat_itself);
    RUN_TEST(another_seed_should_give_another_city);
    RUN_TEST(scene_kind_find_should_suggest_the_nearest);
    return UNITY_END();
}
