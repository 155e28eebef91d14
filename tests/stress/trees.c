/* What must not matter to a hit: the tree it was found through, the scale, the axes, the order of vertices and faces.
 * Tests 13 and 16. */
#include "opencl/opencl_cast.h"
#include "scenes.h"
#include "tests.h"
#include "trace/reference.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct Hits {
    long count;
    double *rays;
    CastHit *before, *after;
} Hits;

static Hits hits_make(long count)
{
    size_t n = (size_t)count;
    return (Hits){count, malloc(6 * n * sizeof(double)), malloc(n * sizeof(CastHit)), malloc(n * sizeof(CastHit))};
}

static void hits_free(Hits *hits)
{
    free(hits->rays);
    free(hits->before);
    free(hits->after);
}

static void aim_at_faces(Hits *hits, const Scene *scene, Random *random)
{
    for (long i = 0; i < hits->count; i++) {
        double *ray = hits->rays + 6 * i;
        const Face *face = &scene->faces[random_below(random, scene->face_count)];
        vec3_put(ray, vec3_rounded(vec3_scale(random_in(random, 1, 8), random_unit(random))));
        int k = random_below(random, 4), next = (k + 1) % 4;
        double along = random_in(random, 0, 1);
        for (int axis = 0; axis < 3; axis++)
            ray[3 + axis] = (double)face->vertices[k][axis] +
                            along * ((double)face->vertices[next][axis] - (double)face->vertices[k][axis]) - ray[axis];
        if (i % 2)
            vec3_put(ray + 3, random_unit(random));
        method_round(TEXTBOOK, ray, 6); /* floats: what scales and permutes without a change */
    }
}

static Scene random_soup(Random *random, int count)
{
    Scene scene = scene_empty();
    for (int i = 0; i < count; i++) {
        Vec3 middle = vec3_scale(random_in(random, 0, 2), random_unit(random));
        Vec3 a = vec3_scale(random_in(random, 0.05, 0.6), random_unit(random));
        Vec3 b = vec3_scale(random_in(random, 0.05, 0.6), random_unit(random));
        const Vec3 corners[4] = {middle, vec3_add(middle, a), vec3_add(middle, vec3_add(a, b)), vec3_add(middle, b)};
        scene_add(&scene, corners, 3 + random_below(random, 2));
    }
    return scene;
}

/* --- Trees --- */

static void cast_with(const Scene *scene, Method method, AccelKind kind, const Hits *hits, CastHit *found)
{
    Error error = {0};
    RenderReport report = {0};
    if (method != REFERENCE) {
        RenderSettings settings = {
            .precision = method == KERNEL_FLOAT ? PRECISION_FLOAT : PRECISION_DOUBLE, .accel = kind, .device = -1};
        stop_unless(opencl_cast(scene, &settings, hits->rays, hits->count, found, &report, &error), &error);
        return;
    }
    Accel accel = {0};
    stop_unless(accel_build(&accel, scene, kind, 0, &error), &error);
    const Tracer tracer = {.scene = scene, .accel = &accel, .report = &report};
    for (long i = 0; i < hits->count; i++)
        found[i] = reference_nearest(&tracer, (Ray){vec3_at(hits->rays + 6 * i), vec3_at(hits->rays + 6 * i + 3)}, -1);
    accel_free(&accel);
}

static void compare_tree(Suite *suite, Method method, AccelKind kind, Hits *hits)
{
    cast_with(suite->scene, method, kind, hits, hits->after);
    suite_rays(suite, method, hits->count);
    for (long i = 0; i < hits->count; i++)
        if (hits->before[i].face != hits->after[i].face ||
            memcmp(&hits->before[i].t, &hits->after[i].t, sizeof(double)) != 0)
            suite_fail(suite, method, hits->rays + 6 * i, "face %d, t = %.17g; without the tree face %d, t = %.17g",
                       hits->after[i].face, hits->after[i].t, hits->before[i].face, hits->before[i].t);
}

void test_trees(Suite *suite)
{
    suite_row(suite, "BVH and k-d tree against no tree, 100 faces");
    for (int round = 0; round < 4; round++) {
        Scene scene = random_soup(&suite->random, 100);
        suite->scene = &scene;
        Hits hits = hits_make(suite_count(suite, 1.25e6));
        aim_at_faces(&hits, &scene, &suite->random);
        for (Method method = KERNEL_FLOAT; method < METHOD_COUNT; method++) {
            if (!method_is_here(suite, method))
                continue;
            cast_with(&scene, method, ACCEL_NONE, &hits, hits.before);
            compare_tree(suite, method, ACCEL_BVH, &hits);
            compare_tree(suite, method, ACCEL_KDTREE, &hits);
        }
        hits_free(&hits);
        scene_free(&scene);
    }
}

/* --- The same scene, written otherwise --- */

typedef enum Change { SCALED, PERMUTED, REVERSED, REORDERED, ROTATED, CHANGE_COUNT } Change;

static const char *const change_names[CHANGE_COUNT] = {"scaled by 2^20 and 2^-20", "axes permuted", "winding reversed",
                                                       "faces reordered", "first vertex moved on"};

static Vec3 changed_vec3(Change change, int turn, Vec3 a)
{
    if (change == SCALED)
        return vec3_scale(turn % 2 ? 0x1p20 : 0x1p-20, a);
    return change == PERMUTED ? vec3(a.y, a.z, a.x) : a;
}

static Scene changed_scene(const Scene *scene, Change change, int turn)
{
    Scene other = scene_empty();
    for (int i = 0; i < scene->face_count; i++) {
        const Face *face = &scene->faces[change == REORDERED ? scene->face_count - 1 - i : i];
        int n = face->vertex_count;
        Vec3 corners[4];
        for (int k = 0; k < n; k++) {
            int from = change == REVERSED ? (n - k) % n : change == ROTATED ? (k + 1) % n : k;
            const float *v = face->vertices[from];
            corners[k] = changed_vec3(change, turn, vec3((double)v[0], (double)v[1], (double)v[2]));
        }
        scene_add(&other, corners, n);
    }
    return other;
}

static void compare_change(Suite *suite, Method method, Change change, int turn, const Scene *scene, const Scene *other,
                           Hits *hits)
{
    double *rays = malloc((size_t)hits->count * 6 * sizeof *rays);
    for (long i = 0; i < 2 * hits->count; i++)
        vec3_put(rays + 3 * i, changed_vec3(change, turn, vec3_at(hits->rays + 3 * i)));
    void (*ask)(Suite *, Method, const double *, long, CastHit *) = change == ROTATED ? method_counts : method_nearest;
    suite_load(suite, other);
    ask(suite, method, rays, hits->count, hits->after);
    suite_load(suite, scene);
    ask(suite, method, hits->rays, hits->count, hits->before);
    suite_rays(suite, method, hits->count);
    for (long i = 0; i < hits->count; i++) {
        CastHit before = hits->before[i], after = hits->after[i];
        if (change == REORDERED && after.face >= 0)
            after.face = scene->face_count - 1 - after.face;
        double allowed = change == PERMUTED ? 2 * method_ulp(method, before.t) : 0;
        if (before.face != after.face && before.t != after.t) /* equal t: the first in the file, which may be another */
            suite_fail(suite, method, hits->rays + 6 * i, "face %d became %d", before.face, after.face);
        else if (fabs(before.t - after.t) > allowed)
            suite_fail(suite, method, hits->rays + 6 * i, "t = %.17g became %.17g", before.t, after.t);
    }
    free(rays);
}

void test_invariance(Suite *suite)
{
    for (Change change = 0; change < CHANGE_COUNT; change++) {
        suite_row(suite, "%s", change_names[change]);
        for (int turn = 0; turn < 4; turn++) {
            Scene scene = random_soup(&suite->random, 20), other = changed_scene(&scene, change, turn);
            Hits hits = hits_make(suite_count(suite, 5e4));
            aim_at_faces(&hits, &scene, &suite->random);
            for (Method method = 0; method < METHOD_COUNT; method++)
                if (method_is_here(suite, method))
                    compare_change(suite, method, change, turn, &scene, &other, &hits);
            hits_free(&hits);
            scene_free(&other);
            scene_free(&scene);
        }
    }
}
