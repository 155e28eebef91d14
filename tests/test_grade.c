/* Slips: steps without a slip find what the reference finds, and every slip is a whole one. */
#include "grade/grade.h"
#include "grade/slip_trace.h"
#include "reader/scene_json.h"

#include "unity.h"

#include <glob.h>
#include <string.h>

void setUp(void) {}
void tearDown(void) {}

static bool is_told(const Event *event)
{
    return event->kind != EVENT_TALLY && event->kind != EVENT_FACE && event->kind != EVENT_OCCLUDER &&
           event->kind != EVENT_ADAPTIVE;
}

/* The next event that both tracers tell; NULL behind the last. */
static const Event *next_told(const Walkthrough *walk, long *at)
{
    while (*at < walk->count)
        if (is_told(&walk->events[(*at)++]))
            return &walk->events[*at - 1];
    return NULL;
}

static void assert_same_event(const Event *right, const Event *other, const char *scene)
{
    TEST_ASSERT_EQUAL_INT_MESSAGE(right->kind, other->kind, scene);
    if (right->kind == EVENT_HIT) {
        TEST_ASSERT_EQUAL_INT_MESSAGE(right->as.hit.face, other->as.hit.face, scene);
        TEST_ASSERT_EQUAL_MEMORY_MESSAGE(&right->as.hit.point, &other->as.hit.point, sizeof(Vec3), scene);
        TEST_ASSERT_EQUAL_MEMORY_MESSAGE(&right->as.hit.shifted, &other->as.hit.shifted, sizeof(Vec3), scene);
    } else if (right->kind == EVENT_LIGHT_END) {
        TEST_ASSERT_EQUAL_INT_MESSAGE(right->as.light_end.verdict, other->as.light_end.verdict, scene);
        TEST_ASSERT_EQUAL_INT_MESSAGE(right->as.light_end.blocker, other->as.light_end.blocker, scene);
    } else if (right->kind == EVENT_SHADED) {
        TEST_ASSERT_EQUAL_MEMORY_MESSAGE(&right->as.shaded.total, &other->as.shaded.total, sizeof(Vec3), scene);
    } else if (right->kind == EVENT_PIXEL) {
        TEST_ASSERT_EQUAL_MEMORY_MESSAGE(&right->as.pixel.average, &other->as.pixel.average, sizeof(Vec3), scene);
        TEST_ASSERT_EQUAL_MEMORY_MESSAGE(right->as.pixel.rgb, other->as.pixel.rgb, 3, scene);
    }
}

static void check_pixel(const Scene *scene, const char *path, int column, int row)
{
    Error error = {.kind = ERROR_NONE};
    Walkthrough right, other;
    WalkthroughRequest request = {.column = column, .row = row};
    TEST_ASSERT_TRUE_MESSAGE(walkthrough_record(&right, scene, NULL, path, request, &error), error.text);
    TEST_ASSERT_TRUE_MESSAGE(slip_trace(&other, &right, &(SlipSteps){.scene = NULL}, &error), error.text);
    long i = 0, k = 0;
    const Event *event;
    while ((event = next_told(&right, &i))) {
        const Event *theirs = next_told(&other, &k);
        TEST_ASSERT_NOT_NULL_MESSAGE(theirs, path);
        assert_same_event(event, theirs, path);
    }
    TEST_ASSERT_NULL_MESSAGE(next_told(&other, &k), path);
    walkthrough_free(&right);
    walkthrough_free(&other);
}

static void steps_without_a_slip_should_find_what_the_reference_finds(void)
{
    glob_t found;
    TEST_ASSERT_EQUAL_INT(0, glob("tests/scenes/*.json", 0, NULL, &found));
    TEST_ASSERT_EQUAL_INT(0, glob("scenes/original.json", GLOB_APPEND, NULL, &found));
    for (size_t k = 0; k < found.gl_pathc; k++) {
        Error error = {.kind = ERROR_NONE};
        Scene scene;
        TEST_ASSERT_TRUE_MESSAGE(scene_load(&scene, found.gl_pathv[k], &error), error.text);
        for (int i = 1; i < 12; i++)
            check_pixel(&scene, found.gl_pathv[k], i * 7919 % scene.screen.columns, i * 104729 % scene.screen.rows);
        scene_free(&scene);
    }
    globfree(&found);
}

static void every_slip_should_have_a_name_of_its_own_words_and_a_change(void)
{
    static const SlipSteps none;
    const Slip *slip, *other;
    for (int i = 0; (slip = slip_number(i)); i++) {
        TEST_ASSERT_TRUE_MESSAGE(slip->title && slip->right && slip->wrong && slip->read, slip->name);
        TEST_ASSERT_TRUE_MESSAGE(strchr(slip->read, '#') != NULL, slip->name);
        TEST_ASSERT_TRUE_MESSAGE(memcmp(&slip->steps, &none, sizeof none) != 0 || slip->unit > 0 || slip->byte_unit > 0,
                                 slip->name);
        for (int k = 0; k < i && (other = slip_number(k)); k++)
            TEST_ASSERT_TRUE_MESSAGE(strcmp(slip->name, other->name) != 0, slip->name);
    }
    TEST_ASSERT_NULL(slip_number(100000));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(steps_without_a_slip_should_find_what_the_reference_finds);
    RUN_TEST(every_slip_should_have_a_name_of_its_own_words_and_a_change);
    return UNITY_END();
}
