/* The stress suite: every promise of the geometry core, tried by millions of rays and judged by exact arithmetic.
 * To add a test, write it in a file of its subject, declare it in tests.h and name it below. */
#include "support/oracle.h"
#include "tests.h"

#include "base/clock.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct Test {
    int number;
    const char *name, *what;
    void (*run)(Suite *suite);
} Test;

static const Test tests[] = {
    {1, "grid-misses", "A rotated 64 x 64 grid of quads: rays at its inner vertices and edges never pass through",
     test_grid_misses},
    {2, "grid-counts", "The same, every face that is hit counted: as many as the oracle says", test_grid_counts},
    {3, "embree", "Embree's watertight scenes, with quads", test_embree},
    {4, "boxes", "Closed boxes from inside: no ray escapes", test_boxes},
    {5, "nested", "Ten nested boxes: the nearest face is the oracle's", test_nested},
    {6, "agreement", "Random faces: hit, face and order are the oracle's", test_agreement},
    {7, "t", "The error of t", test_t},
    {8, "grazing", "Grazing rays: no false hit, no t outside the face", test_grazing},
    {9, "self-hits", "Shifted points: on the right side, near, never in the shadow of their own face", test_self_hits},
    {10, "shadows", "Shadow rays end exactly before the light; no acne on coplanar tiles", test_shadows},
    {11, "light-on-face", "A light on a face, on its edge, behind it, at the hit point", test_light_on_face},
    {12, "axes", "Rays along axes and in planes, zeros of both signs", test_axes},
    {13, "trees", "Trees find what no tree finds: the same faces, the same bits of t", test_trees},
    {14, "bit-patterns", "Random bit patterns as vertices: refused with a reason, or traced", test_bit_patterns},
    {15, "bad-faces", "Bad faces: the verdict that docs/scene-format.md gives", test_bad_faces},
    {16, "invariance", "Scaled, permuted, reversed, reordered: the same hits", test_invariance},
    {17, "mirrors", "Facing mirrors: the geometric series", test_mirrors},
    {18, "translation", "A scene moved by 1e6: the same picture", test_translation},
    {19, "pictures", "Kernels against the reference, pixel by pixel", test_pictures},
    {20, "powers", "The error of the highlight's powers", test_powers},
};

enum { TEST_COUNT = sizeof tests / sizeof tests[0] };

static int usage(void)
{
    fprintf(stderr,
            "Usage: stress [--list] [--test NAME] [--seed N] [--scale X] [--markdown]\n"
            "  --scale 0.01 casts a hundredth of the rays; --markdown prints the table for docs/stability.md\n");
    return 2;
}

/* --- The table --- */

static void print_number(char *text, size_t size, long n)
{
    if (n >= 1000000)
        snprintf(text, size, "%ld %03ld %03ld", n / 1000000, n / 1000 % 1000, n % 1000);
    else if (n >= 1000)
        snprintf(text, size, "%ld %03ld", n / 1000, n % 1000);
    else
        snprintf(text, size, "%ld", n);
}

static void print_cell(const Row *row, Method method)
{
    char rays[32], ties[32], failures[32];
    print_number(rays, sizeof rays, row->rays[method]);
    print_number(ties, sizeof ties, row->ties[method]);
    print_number(failures, sizeof failures, row->failures[method]);
    if (row->rays[method] == 0)
        printf(" | -");
    else if (row->measured)
        printf(" | %.3g", row->value[method]);
    else if (row->ties[method])
        printf(" | %s of %s, %s ties", failures, rays, ties);
    else
        printf(" | %s of %s", failures, rays);
}

static void print_table(const Suite *suite, const Test *test)
{
    bool any = false;
    for (int i = 0; i < suite->row_count; i++) {
        const Row *row = &suite->rows[i];
        if (row->test != test->number)
            continue;
        if (!any) {
            printf("\n### %d. %s\n\n|  ", test->number, test->what);
            for (Method method = 0; method < METHOD_COUNT; method++)
                printf(" | %s", method_name(method));
            printf(" |\n| --- | --- | --- | --- | --- |\n");
        }
        any = true;
        printf("| %s", row->label);
        for (Method method = 0; method < METHOD_COUNT; method++)
            print_cell(row, method);
        printf(" |\n");
    }
}

/* Failures of the taught formulas are what the table is there to show; the others' fail the suite. */
static long failures_of(const Suite *suite, int test)
{
    long failures = 0;
    for (int i = 0; i < suite->row_count; i++)
        for (Method method = KERNEL_FLOAT; method < METHOD_COUNT; method++)
            if (test == 0 || suite->rows[i].test == test)
                failures += suite->rows[i].failures[method];
    return failures;
}

static void run(Suite *suite, const Test *test)
{
    double start = clock_ms();
    suite->test = test->number;
    suite->test_name = test->name;
    suite->random.state = suite->seed * 1000003 + (uint64_t)test->number; /* the same alone as among the others */
    fprintf(stderr, "%2d %-14s %s\n", test->number, test->name, test->what);
    test->run(suite);
    long failures = failures_of(suite, test->number);
    fprintf(stderr, "%2d %-14s %s, %ld failures, %.1f s\n", test->number, test->name, failures ? "FAIL" : "ok",
            failures, (clock_ms() - start) / 1000);
}

int main(int argument_count, char **arguments)
{
    const char *only = NULL;
    bool markdown = false;
    Suite suite = {.seed = 1, .scale = 1};
    for (int i = 1; i < argument_count; i++) {
        const char *value = i + 1 < argument_count ? arguments[i + 1] : NULL;
        if (strcmp(arguments[i], "--list") == 0) {
            for (int k = 0; k < TEST_COUNT; k++)
                printf("%2d %-14s %s\n", tests[k].number, tests[k].name, tests[k].what);
            return 0;
        }
        if (strcmp(arguments[i], "--markdown") == 0) {
            markdown = true;
            continue;
        }
        if (!value)
            return usage();
        if (strcmp(arguments[i], "--test") == 0)
            only = value;
        else if (strcmp(arguments[i], "--seed") == 0)
            suite.seed = strtoull(value, NULL, 0);
        else if (strcmp(arguments[i], "--scale") == 0)
            suite.scale = strtod(value, NULL);
        else
            return usage();
        i++;
    }
    if (!(suite.scale > 0))
        return usage();

    suite.rows = calloc(MAX_ROWS, sizeof *suite.rows);
    probe_open(&suite.probes[0], PRECISION_FLOAT);
    if (suite.probes[0].session.info.has_double)
        probe_open(&suite.probes[1], PRECISION_DOUBLE);
    fprintf(stderr, "stress: seed %llu, scale %g, %s\n", (unsigned long long)suite.seed, suite.scale,
            suite.probes[0].session.info.name);
    int ran = 0, passed = 0;
    for (int k = 0; k < TEST_COUNT; k++)
        if (!only || strcmp(only, tests[k].name) == 0) {
            run(&suite, &tests[k]);
            ran++;
            passed += failures_of(&suite, tests[k].number) == 0;
        }
    if (markdown)
        for (int k = 0; k < TEST_COUNT; k++)
            print_table(&suite, &tests[k]);
    else
        printf("%d passed, %d failed\n", passed, ran - passed);
    probe_close(&suite.probes[0]);
    probe_close(&suite.probes[1]);
    accel_free(&suite.accel);
    oracle_free();
    free(suite.rows);
    if (ran == 0)
        fprintf(stderr, "stress: no test of that name; --list names them\n");
    return ran > 0 && passed == ran ? 0 : 1;
}
