/* rectray tree: what the builder of a tree decides. A table of all trees, or of one; its first steps with the planes
 * that were tried; a drawing of its boxes. */
#include "base/clock.h"
#include "base/output.h"
#include "command/command.h"
#include "command/scene_open.h"
#include "command/tree_steps.h"
#include "trace/tree_survey.h"
#include "walkthrough/tree_drawing.h"

#include <string.h>

enum { TREES = 3 };

static const AccelKind kinds[TREES] = {ACCEL_KDTREE, ACCEL_BVH, ACCEL_LBVH};

/* A tree, and how long building it took. */
typedef struct Built {
    Accel accel;
    TreeSurvey survey;
    double ms;
} Built;

static bool build(Built *built, const Scene *scene, AccelKind kind, Error *error)
{
    double start = clock_ms();
    bool done = accel_build(&built->accel, scene, kind, 1, error);
    built->ms = clock_ms() - start;
    if (done)
        built->survey = tree_survey(&built->accel);
    return done;
}

/* --- The table --- */

static void print_count(const char *label, const Built *built, int trees, int (*value)(const TreeSurvey *survey))
{
    printf("  %-34s", label);
    for (int i = 0; i < trees; i++)
        printf(" %14d", value(&built[i].survey));
    printf("\n");
}

static void print_value(const char *label, const char *unit, int trees, const double *values, int places)
{
    printf("  %-34s", label);
    for (int i = 0; i < trees; i++)
        printf(" %14.*f", places, values[i]);
    printf("%s\n", unit);
}

static int nodes_of(const TreeSurvey *survey)
{
    return survey->nodes;
}
static int leaves_of(const TreeSurvey *survey)
{
    return survey->leaves;
}
static int empty_of(const TreeSurvey *survey)
{
    return survey->of_size[0];
}
static int depth_of(const TreeSurvey *survey)
{
    return survey->depth;
}
static int most_of(const TreeSurvey *survey)
{
    return survey->most;
}
static int entries_of(const TreeSurvey *survey)
{
    return survey->entries;
}

static void print_leaf_sizes(const Built *built, int trees)
{
    printf("\nleaves by their number of faces\n");
    for (int size = 0; size < TREE_LEAF_SIZES; size++) {
        bool any = false;
        for (int i = 0; i < trees; i++)
            any = any || built[i].survey.of_size[size] > 0;
        if (!any)
            continue;
        char label[32];
        snprintf(label, sizeof label, "%d%s", size, size == TREE_LEAF_SIZES - 1 ? " and more" : "");
        printf("  %-34s", label);
        for (int i = 0; i < trees; i++)
            printf(" %14d", built[i].survey.of_size[size]);
        printf("\n");
    }
}

static void print_table(const Scene *scene, const Built *built, int trees)
{
    double duplicates[TREES], mean[TREES], nodes[TREES], tests[TREES], cost[TREES], memory[TREES], ms[TREES];
    for (int i = 0; i < trees; i++) {
        const TreeSurvey *survey = &built[i].survey;
        int full = survey->leaves - survey->of_size[0];
        duplicates[i] = survey->entries / (double)scene->face_count;
        mean[i] = full > 0 ? survey->entries / (double)full : 0;
        nodes[i] = survey->expected_nodes;
        tests[i] = survey->expected_tests;
        cost[i] = survey->sah_cost;
        memory[i] = survey->bytes / 1024;
        ms[i] = built[i].ms;
    }
    printf("%-36s", "tree");
    for (int i = 0; i < trees; i++)
        printf(" %14s", render_accels[accel_name(&built[i].accel)]);
    printf("\n");
    print_count("nodes", built, trees, nodes_of);
    print_count("leaves", built, trees, leaves_of);
    print_count("  of them empty", built, trees, empty_of);
    print_count("depth", built, trees, depth_of);
    print_count("faces in leaves", built, trees, entries_of);
    print_value("  per face of the scene", "", trees, duplicates, 2);
    print_value("  per leaf that is not empty", "", trees, mean, 2);
    print_count("  in the fullest leaf", built, trees, most_of);
    print_value("memory", " KiB", trees, memory, 1);
    print_value("building it took", " ms", trees, ms, 2);
    printf("\nexpected of a line through its box\n");
    print_value("nodes met", "", trees, nodes, 2);
    print_value("faces tested", "", trees, tests, 2);
    print_value("SAH cost, in face tests", "", trees, cost, 2);
    print_leaf_sizes(built, trees);
}

/* --- What is asked for --- */

static bool write_drawing(const Options *options, const Scene *scene, const Accel *accel, Error *error)
{
    const char *path = options->output, *dot = strrchr(path, '.');
    bool obj = dot && strcmp(dot, ".obj") == 0, svg = dot && strcmp(dot, ".svg") == 0;
    if (!obj && !svg)
        return error_set(error, ERROR_USAGE, "--output '%s': expected a file that ends in .svg or .obj", path);
    if (output_replaces(path, options->operands[0]))
        return error_set(error, ERROR_USAGE, "the drawing %s would replace the scene itself; choose another -o", path);
    Output output;
    if (!output_open(&output, path, "the drawing", error))
        return false;
    if (obj)
        tree_drawing_obj(output.file, scene, accel, options->operands[0]);
    else
        tree_drawing_svg(output.file, scene, accel, options->operands[0]);
    return output_commit(&output, error);
}

/* One tree: the one that is asked for, else the one that `auto` would build. */
static bool show_one(const Options *options, const Scene *scene, Error *error)
{
    Built built = {.ms = 0};
    AccelKind kind = options->settings.accel == ACCEL_AUTO ? ACCEL_BVH : options->settings.accel;
    bool done = build(&built, scene, kind, error);
    if (done && options->steps > 0)
        done = tree_steps_print(scene, &built.accel, options->steps, options->verbose, error);
    else if (done && !options->output)
        print_table(scene, &built, 1);
    if (done && options->output)
        done = write_drawing(options, scene, &built.accel, error);
    accel_free(&built.accel);
    return done;
}

static bool show_all(const Scene *scene, Error *error)
{
    Built built[TREES] = {{.ms = 0}};
    bool done = true;
    for (int i = 0; i < TREES; i++)
        done = done && build(&built[i], scene, kinds[i], error);
    if (done)
        print_table(scene, built, TREES);
    for (int i = 0; i < TREES; i++)
        accel_free(&built[i].accel);
    return done;
}

bool command_tree(const Options *options, Error *error)
{
    if (options->settings.accel == ACCEL_NONE)
        return error_set(error, ERROR_USAGE, "--accel 'none': expected kdtree, bvh or lbvh");
    if (options->settings.accel == ACCEL_LBVH && options->steps > 0)
        return error_set(error, ERROR_USAGE, "--step shows the planes that are tried, and lbvh tries none; use bvh");
    Scene scene;
    if (!scene_open(&scene, options, error))
        return false;
    bool one = options->settings.accel != ACCEL_AUTO || options->steps > 0 || options->output;
    bool done = scene.face_count > 0 ||
                error_set(error, ERROR_INPUT, "%s: a scene without faces has no tree", options->operands[0]);
    done = done && (one ? show_one(options, &scene, error) : show_all(&scene, error));
    scene_free(&scene);
    return done;
}
