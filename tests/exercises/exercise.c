/* Runs the tests of an exercise, and holds what they need beside the outcomes: texts of numbers, and scenes. */
#include "exercises/exercise.h"

#include "exercises/exercise_picture.h"
#include "exercises/exercise_report.h"
#include "reader/scene_json.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { SCENES = 8, TEXTS = 32, TEXT = 120 };

void given(const char *name, const char *format, ...)
{
    char text[EXERCISE_TEXT];
    va_list values;
    va_start(values, format);
    vsnprintf(text, sizeof text, format, values);
    va_end(values);
    if (!report_failed)
        report_line("given", "%s\t%s", name, text);
}

void shown_at(const char *scene, int column, int row)
{
    shown_with(scene, column, row, "-v");
}

void shown_with(const char *scene, int column, int row, const char *options)
{
    if (!report_failed)
        report_line("shown", "%s\t%d\t%d\t%s", scene, column, row, options);
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

const char *exact_text(double value)
{
    char *text = next_text();
    snprintf(text, TEXT, "%.17g", value);
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
        report_broken("too many scenes");
    if (kept[k].path)
        return &kept[k].scene;
    Error error = {0};
    if (!scene_load(&kept[k].scene, path, &error))
        report_broken(error.text);
    kept[k].path = path;
    return &kept[k].scene;
}

/* --- The program --- */

static int picture_test(const Exercise *exercise, const char *path)
{
    report_line("test", "picture\tThe picture of %s", exercise->scene);
    Error error = {0};
    Scene scene = *scene_of(exercise->scene);
    if (exercise->columns) {
        scene.screen.columns = exercise->columns;
        scene.screen.rows = exercise->rows;
    }
    PictureDifference found;
    if (!exercise_picture(&scene, exercise, path, &found, &error))
        report_broken(error.text);
    report_line("picture", "%s\t%d\t%d", path, found.differing, scene.screen.columns * scene.screen.rows);
    if (!found.wrong)
        return EXERCISE_PASSED;
    char size[40];
    snprintf(size, sizeof size, "--size %dx%d -v", scene.screen.columns, scene.screen.rows);
    shown_with(exercise->scene, found.column, found.row, size);
    report_line("value", "the pixel's red, green and blue");
    report_line("returned", "(%d, %d, %d)", found.returned[0], found.returned[1], found.returned[2]);
    report_line("expected", "(%d, %d, %d)", found.expected[0], found.expected[1], found.expected[2]);
    return EXERCISE_FAILED;
}

int exercise_main(int argc, char **argv, const Exercise *exercise)
{
    if (argc != 3 || !report_open(argv[1])) {
        fprintf(stderr, "usage: %s REPORT PICTURE\n", argv[0]);
        return EXERCISE_BROKEN;
    }
    int status = EXERCISE_PASSED;
    for (const ExerciseTest *test = exercise->tests; test->name; test++)
        report_line("listed", "%s\t%s", test->name, test->title);
    if (exercise->pixel)
        report_line("listed", "picture\tThe picture of %s", exercise->scene);
    for (const ExerciseTest *test = exercise->tests; test->name; test++) {
        if (!report_failed)
            report_line("test", "%s\t%s", test->name, test->title);
        test->run();
    }
    if (report_failed) {
        exercise_tell_slips("surely");
        return EXERCISE_FAILED;
    }
    if (exercise->pixel)
        status = picture_test(exercise, argv[2]);
    if (status == EXERCISE_PASSED)
        report_line("passed", "all");
    return status;
}
