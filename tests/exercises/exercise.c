/* Runs the tests of an exercise, and reports. A line of the report is a key, a tab and a value. Each is flushed, so
 * that after a crash or in an endless loop the report names the test and its input. */
#include "exercises/exercise.h"

#include "exercises/exercise_picture.h"
#include "reader/scene_json.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct Slip {
    Outcome outcome;
    char text[EXERCISE_TEXT];
} Slip;

enum { SLIPS = 24, SCENES = 8, TEXTS = 32, TEXT = 120 };

static FILE *report;
static Slip slips[SLIPS];
static int slip_count;

/* Slips that were not made: an earlier input would have shown them. */
static char refuted[SLIPS][EXERCISE_TEXT];
static int refuted_count;

static void tell(const char *key, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void tell(const char *key, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    fprintf(report, "%s\t", key);
    vfprintf(report, format, values);
    fputc('\n', report);
    fflush(report);
    va_end(values);
}

static void end_broken(const char *why)
{
    tell("broken", "%s", why);
    exit(EXERCISE_BROKEN);
}

void given(const char *name, const char *format, ...)
{
    char text[EXERCISE_TEXT];
    va_list values;
    va_start(values, format);
    vsnprintf(text, sizeof text, format, values);
    va_end(values);
    tell("given", "%s\t%s", name, text);
}

void shown_at(const char *scene, int column, int row)
{
    tell("shown", "%s\t%d\t%d", scene, column, row);
}

/* --- Outcomes --- */

static void add(Outcome *outcome, const char *name, ValueKind kind, double value)
{
    if (outcome->count == EXERCISE_VALUES)
        end_broken("too many values in an outcome");
    Value *added = &outcome->values[outcome->count++];
    *added = (Value){.kind = kind, .value = value};
    snprintf(added->name, sizeof added->name, "%s", name);
}

void add_number(Outcome *outcome, const char *name, double value)
{
    add(outcome, name, VALUE_NUMBER, value);
}

void add_integer(Outcome *outcome, const char *name, int value)
{
    add(outcome, name, VALUE_INTEGER, value);
}

void add_truth(Outcome *outcome, const char *name, bool value)
{
    add(outcome, name, VALUE_TRUTH, value);
}

void add_vector(Outcome *outcome, const char *name, Vec3 value)
{
    char component[60];
    for (int axis = 0; axis < 3; axis++) {
        snprintf(component, sizeof component, "%s.%c", name, "xyz"[axis]);
        add(outcome, component, VALUE_NUMBER, vec3_component(value, axis));
    }
}

/* A vector's name without its axis: how many bytes. */
static size_t stem_of(const Value *value)
{
    size_t length = strlen(value->name);
    return length > 2 && value->name[length - 2] == '.' && strchr("xyz", value->name[length - 1]) ? length - 2 : length;
}

void add_formula(Outcome *outcome, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    Value *last = &outcome->values[outcome->count - 1];
    vsnprintf(last->formula, sizeof last->formula, format, values);
    va_end(values);
    size_t stem = stem_of(last);
    for (Value *other = last - 1; stem < strlen(last->name) && other >= outcome->values && last - other < 3; other--)
        if (stem_of(other) == stem && strncmp(other->name, last->name, stem) == 0)
            memcpy(other->formula, last->formula, sizeof other->formula);
}

void slip(const Outcome *outcome, const char *format, ...)
{
    if (slip_count == SLIPS)
        end_broken("too many slips");
    Slip *added = &slips[slip_count++];
    added->outcome = *outcome;
    va_list values;
    va_start(values, format);
    vsnprintf(added->text, sizeof added->text, format, values);
    va_end(values);
}

static bool same_value(const Value *a, const Value *b)
{
    if (isnan(a->value) || isnan(b->value))
        return isnan(a->value) && isnan(b->value);
    return a->value == b->value || fabs(a->value - b->value) <= 1e-12 + 1e-9 * fmax(fabs(a->value), fabs(b->value));
}

/* The first value that differs; -1: none does. */
static int first_difference(const Outcome *a, const Outcome *b)
{
    for (int k = 0; k < a->count; k++)
        if (!same_value(&a->values[k], &b->values[k]))
            return k;
    return -1;
}

static bool is_refuted(const char *text)
{
    for (int k = 0; k < refuted_count; k++)
        if (strcmp(refuted[k], text) == 0)
            return true;
    return false;
}

static void refute(const char *text)
{
    if (refuted_count < SLIPS && !is_refuted(text))
        strcpy(refuted[refuted_count++], text);
}

static const char *value_text(const Value *value, const char *nothing)
{
    if (value->kind == VALUE_TRUTH)
        return value->value != 0 ? "true" : "false";
    return isnan(value->value) ? nothing : number_text(value->value);
}

void compare(const Outcome *returned, const Outcome *expected)
{
    int k = first_difference(returned, expected);
    if (k < 0) {
        for (int s = 0; s < slip_count; s++)
            if (first_difference(expected, &slips[s].outcome) >= 0)
                refute(slips[s].text);
        slip_count = 0;
        tell("forget", "input");
        return;
    }
    tell("value", "%s", expected->values[k].name);
    tell("returned", "%s", value_text(&returned->values[k], "nothing: it was not filled in"));
    tell("expected", "%s", value_text(&expected->values[k], "nothing: it is not to be filled in"));
    if (expected->values[k].formula[0])
        tell("formula", "%s", expected->values[k].formula);
    for (int s = 0; s < slip_count; s++)
        if (first_difference(returned, &slips[s].outcome) < 0 && !is_refuted(slips[s].text)) {
            tell("slip", "%s", slips[s].text);
            break;
        }
    exit(EXERCISE_FAILED);
}

/* --- Texts --- */

static char *next_text(void)
{
    static char texts[TEXTS][TEXT];
    static int next;
    return texts[next++ % TEXTS];
}

const char *number_text(double value)
{
    char *text = next_text();
    snprintf(text, TEXT, "%.6g", value == 0 ? 0 : value);
    return text;
}

const char *vector_text(Vec3 v)
{
    char text[TEXT];
    snprintf(text, sizeof text, "(%s, %s, %s)", number_text(v.x), number_text(v.y), number_text(v.z));
    return strcpy(next_text(), text);
}

/* --- Scenes --- */

const Scene *scene_of(const char *path)
{
    static struct {
        const char *path;
        Scene scene;
    } kept[SCENES];
    int k = 0;
    while (k < SCENES && kept[k].path && strcmp(kept[k].path, path) != 0)
        k++;
    if (k == SCENES)
        end_broken("too many scenes");
    if (kept[k].path)
        return &kept[k].scene;
    Error error = {0};
    if (!scene_load(&kept[k].scene, path, &error))
        end_broken(error.text);
    kept[k].path = path;
    return &kept[k].scene;
}

/* --- The program --- */

static int picture_test(const Exercise *exercise, const char *path)
{
    tell("test", "picture\tThe picture of %s", exercise->scene);
    Error error = {0};
    Scene scene = *scene_of(exercise->scene);
    if (exercise->columns) {
        scene.screen.columns = exercise->columns;
        scene.screen.rows = exercise->rows;
    }
    PictureDifference found;
    if (!exercise_picture(&scene, exercise->pixel, path, &found, &error))
        end_broken(error.text);
    tell("picture", "%s\t%d\t%d", path, found.differing, scene.screen.columns * scene.screen.rows);
    if (!found.wrong)
        return EXERCISE_PASSED;
    tell("shown", "%s\t%d\t%d\t%d\t%d", exercise->scene, found.column, found.row, scene.screen.columns,
         scene.screen.rows);
    tell("value", "the pixel's red, green and blue");
    tell("returned", "(%d, %d, %d)", found.returned[0], found.returned[1], found.returned[2]);
    tell("expected", "(%d, %d, %d)", found.expected[0], found.expected[1], found.expected[2]);
    return EXERCISE_FAILED;
}

int exercise_main(int argc, char **argv, const Exercise *exercise)
{
    report = argc == 3 ? fopen(argv[1], "w") : NULL;
    if (!report) {
        fprintf(stderr, "usage: %s REPORT PICTURE\n", argv[0]);
        return EXERCISE_BROKEN;
    }
    int status = EXERCISE_PASSED;
    for (const ExerciseTest *test = exercise->tests; test->name; test++)
        tell("listed", "%s\t%s", test->name, test->title);
    if (exercise->pixel)
        tell("listed", "picture\tThe picture of %s", exercise->scene);
    for (const ExerciseTest *test = exercise->tests; test->name; test++) {
        tell("test", "%s\t%s", test->name, test->title);
        test->run();
    }
    if (exercise->pixel)
        status = picture_test(exercise, argv[2]);
    if (status == EXERCISE_PASSED)
        tell("passed", "all");
    fclose(report);
    return status;
}
