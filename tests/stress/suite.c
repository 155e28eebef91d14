/* The table of failures, and rays by the batch. */
#include "suite.h"

#include "scenes.h"
#include "support/oracle.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

const char TIE[] = "tie";

enum { SHOWN = 3 };

/* The taught formulas have no tree: they get as many of a row's rays as make this many tests of faces. */
static const double TEXTBOOK_TESTS = 2e7;

long suite_count(const Suite *suite, double count)
{
    double scaled = count * suite->scale;
    return scaled < 1 ? 1 : (long)scaled;
}

void suite_row(Suite *suite, const char *format, ...)
{
    if (suite->row_count == MAX_ROWS) {
        fprintf(stderr, "stress: more than %d rows\n", MAX_ROWS);
        exit(3);
    }
    Row *row = &suite->rows[suite->row_count++];
    *row = (Row){.test = suite->test};
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(row->label, sizeof row->label, format, arguments);
    va_end(arguments);
    suite->shown = 0;
    fprintf(stderr, "    %s\n", row->label);
}

static Row *current(Suite *suite)
{
    return &suite->rows[suite->row_count - 1];
}

void suite_rays(Suite *suite, Method method, long rays)
{
    current(suite)->rays[method] += rays;
}

void suite_measure(Suite *suite, Method method, long rays, double value, double limit)
{
    Row *row = current(suite);
    if (!method_is_here(suite, method))
        return;
    row->measured = true;
    row->rays[method] = rays;
    row->value[method] = value;
    row->limit[method] = limit;
    if (method != TEXTBOOK && limit >= 0 && !(value <= limit)) {
        row->failures[method]++;
        printf("FAIL %s, %s: %s is %g, the limit is %g\n", suite->test_name, row->label, method_name(method), value,
               limit);
    }
}

static void print_command(const Suite *suite, Method method, const double *ray)
{
    static const char *const options[METHOD_COUNT] = {"", "--precision float", "--precision double",
                                                      "--backend reference"};
    char path[160];
    snprintf(path, sizeof path, "build/stress-%s-%d.json", suite->test_name, suite->row_count);
    if (suite->shown == 0)
        scene_write(suite->scene, path);
    printf("     echo '%.17g %.17g %.17g  %.17g %.17g %.17g' | build/rectray cast %s %s\n", ray[0], ray[1], ray[2],
           ray[3], ray[4], ray[5], path, options[method]);
}

void suite_fail(Suite *suite, Method method, const double *ray, const char *format, ...)
{
    Row *row = current(suite);
    row->failures[method]++;
    if (method == TEXTBOOK || suite->shown >= SHOWN)
        return;
    printf("FAIL %s, %s, %s, seed %llu: ", suite->test_name, row->label, method_name(method),
           (unsigned long long)suite->seed);
    va_list arguments;
    va_start(arguments, format);
    vprintf(format, arguments);
    va_end(arguments);
    printf("\n");
    if (ray)
        print_command(suite, method, ray);
    suite->shown++;
    fflush(stdout);
}

/* --- Rays --- */

typedef struct Batch {
    double *rays;
    int *truths;
    CastHit *hits;
    long count;
} Batch;

static void judge(Suite *suite, const Cast *cast, Method method, const Batch *batch)
{
    suite_rays(suite, method, batch->count);
    for (long i = 0; i < batch->count; i++) {
        const double *ray = batch->rays + 6 * i;
        const char *wrong = cast->check(cast->user, suite->scene, method, ray, batch->truths[i], batch->hits[i]);
        if (wrong == TIE)
            current(suite)->ties[method]++;
        else if (wrong)
            suite_fail(suite, method, ray, "%s: face %d, t = %.17g; the oracle says %d", wrong, batch->hits[i].face,
                       batch->hits[i].t, batch->truths[i]);
    }
}

/* How many of the next rays the textbook gets. */
static long textbook_share(Suite *suite, long count)
{
    long most = (long)(TEXTBOOK_TESTS / suite->scene->face_count) + 1 - current(suite)->rays[TEXTBOOK];
    return most < 0 ? 0 : most < count ? most : count;
}

static void run_batch(Suite *suite, const Cast *cast, Batch *batch, bool floats)
{
    for (long i = 0; i < batch->count; i++)
        cast->aim(cast->user, &suite->random, batch->rays + 6 * i);
    method_round(floats ? TEXTBOOK : REFERENCE, batch->rays, 6 * batch->count);
    method_round_to_device(suite, batch->rays, 6 * batch->count);
    for (long i = 0; i < batch->count; i++)
        batch->truths[i] = cast->truth ? cast->truth(suite->scene, batch->rays + 6 * i) : 0;
    for (Method method = 0; method < METHOD_COUNT; method++) {
        if (!method_is_here(suite, method))
            continue;
        Batch part = *batch;
        if (method == TEXTBOOK)
            part.count = floats ? textbook_share(suite, batch->count) : 0;
        if (part.count == 0)
            continue;
        if (cast->counts)
            method_counts(suite, method, part.rays, part.count, part.hits);
        else
            method_nearest(suite, method, part.rays, part.count, part.hits);
        judge(suite, cast, method, &part);
    }
}

void suite_cast(Suite *suite, const Cast *cast)
{
    long left = suite_count(suite, cast->count);
    long most = left < 2 * BATCH ? (left + 1) / 2 : BATCH;
    Batch batch = {
        .rays = malloc((size_t)most * 6 * sizeof *batch.rays),
        .truths = malloc((size_t)most * sizeof *batch.truths),
        .hits = malloc((size_t)most * sizeof *batch.hits),
    };
    for (bool floats = true; left > 0; left -= batch.count, floats = !floats) {
        batch.count = left < most ? left : most;
        run_batch(suite, cast, &batch, floats);
    }
    free(batch.rays);
    free(batch.truths);
    free(batch.hits);
}

/* --- The oracle on a scene --- */

static bool counts_for(const Face *face, const double ray[6])
{
    return !face->one_sided || oracle_heading((const float(*)[3])face->vertices, ray) < 0;
}

int true_nearest(const Scene *scene, const double ray[6])
{
    int nearest = -1;
    for (int i = 0; i < scene->face_count; i++) {
        const Face *face = &scene->faces[i];
        if (!oracle_hits((const float(*)[3])face->vertices, ray) || !counts_for(face, ray))
            continue;
        if (nearest < 0 ||
            oracle_order((const float(*)[3])face->vertices, (const float(*)[3])scene->faces[nearest].vertices, ray) < 0)
            nearest = i;
    }
    return nearest;
}

int true_count(const Scene *scene, const double ray[6])
{
    int count = 0;
    for (int i = 0; i < scene->face_count; i++)
        count += oracle_hits((const float(*)[3])scene->faces[i].vertices, ray);
    return count;
}

bool true_blocked(const Scene *scene, const double segment[6], int left)
{
    for (int i = 0; i < scene->face_count; i++)
        if (i != left && oracle_blocks((const float(*)[3])scene->faces[i].vertices, segment, segment + 3))
            return true;
    return false;
}

const char *check_nearest(void *user, const Scene *scene, Method method, const double ray[6], int truth, CastHit hit)
{
    (void)user;
    if (hit.face == truth)
        return NULL;
    if (truth < 0)
        return "a false hit";
    if (hit.face < 0)
        return "a miss";
    const float(*found)[3] = (const float(*)[3])scene->faces[hit.face].vertices;
    if (!oracle_hits(found, ray))
        return "a false hit before the right one";
    double nearest = oracle_t((const float(*)[3])scene->faces[truth].vertices, ray);
    return fabs(oracle_t(found, ray) - nearest) <= 2 * method_ulp(method, nearest) ? TIE : "the wrong nearest face";
}
