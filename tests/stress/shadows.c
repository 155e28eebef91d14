/* The next ray's start and the shadow ray's ends. Tests 9 and 10. */
#include "scenes.h"
#include "support/oracle.h"
#include "tests.h"

#include <stdlib.h>
#include <string.h>

/* Room for one batch of questions and answers. */
typedef struct Shots {
    long count;
    double *rays, *points, *shifted, *segments;
    CastHit *hits;
    int *left, *blocked;
} Shots;

static Shots shots_make(long count)
{
    size_t n = (size_t)count;
    return (Shots){
        .count = count,
        .rays = malloc(6 * n * sizeof(double)),
        .points = malloc(3 * n * sizeof(double)),
        .shifted = malloc(3 * n * sizeof(double)),
        .segments = malloc(6 * n * sizeof(double)),
        .hits = malloc(n * sizeof(CastHit)),
        .left = malloc(n * sizeof(int)),
        .blocked = malloc(n * sizeof(int)),
    };
}

static void shots_free(Shots *shots)
{
    free(shots->rays);
    free(shots->points);
    free(shots->shifted);
    free(shots->segments);
    free(shots->hits);
    free(shots->left);
    free(shots->blocked);
}

static const float (*vertices_of(const Scene *scene, int face))[3]
{
    return (const float(*)[3])scene->faces[face].vertices;
}

/* Rays from the normal's side at points of the square of the given size around the middle of a rotated plane. */
static void aim_at_square(Shots *shots, Random *random, const Rotation *rotation, Vec3 centre, double size)
{
    for (long i = 0; i < shots->count; i++) {
        Vec3 target = vec3(random_in(random, -0.4, 0.4) * size, random_in(random, -0.4, 0.4) * size, 0);
        Vec3 origin =
            vec3(random_in(random, -2, 2) * size, random_in(random, -2, 2) * size, random_in(random, 0.5, 3) * size);
        Vec3 start = vec3_rounded(vec3_add(centre, rotate(rotation, origin)));
        vec3_put(shots->rays + 6 * i, start);
        vec3_put(shots->rays + 6 * i + 3, vec3_rounded(vec3_sub(vec3_add(centre, rotate(rotation, target)), start)));
    }
}

/* The shadow segments of the hits; a ray that missed gets one of no length. */
static void segments_to(Shots *shots, Vec3 light, bool leave)
{
    for (long i = 0; i < shots->count; i++) {
        bool hit = shots->hits[i].face >= 0;
        memcpy(shots->segments + 6 * i, hit ? shots->shifted + 3 * i : (const double[3]){0, 0, 0}, 3 * sizeof(double));
        vec3_put(shots->segments + 6 * i + 3, hit ? light : vec3(0, 0, 0));
        shots->left[i] = leave ? shots->hits[i].face : -1;
    }
}

static void add_square(Scene *scene, const Rotation *rotation, Vec3 centre, double size, double height)
{
    static const double x[4] = {-0.5, 0.5, 0.5, -0.5}, y[4] = {-0.5, -0.5, 0.5, 0.5};
    Vec3 corners[4];
    for (int k = 0; k < 4; k++)
        corners[k] = vec3_add(centre, rotate(rotation, vec3(x[k] * size, y[k] * size, height)));
    scene_add(scene, corners, 4);
}

static double largest(Vec3 a)
{
    return fmax(fabs(a.x), fmax(fabs(a.y), fabs(a.z)));
}

/* The shifted points: on the right side, and near. */
static void check_points(Suite *suite, Method method, const Shots *shots)
{
    suite_rays(suite, method, shots->count);
    for (long i = 0; i < shots->count; i++) {
        const double *ray = shots->rays + 6 * i;
        int face = shots->hits[i].face;
        if (face < 0) {
            suite_fail(suite, method, ray, "a miss");
            continue;
        }
        const float(*vertices)[3] = vertices_of(suite->scene, face);
        Vec3 shifted = vec3_at(shots->shifted + 3 * i), moved = vec3_sub(shifted, vec3_at(shots->points + 3 * i));
        /* P = O + t R is off the plane by the rounding of its terms; P may be smaller than they are. */
        double unit = method_ulp(method, fmax(largest(shifted), largest(vec3_at(ray))));
        if (oracle_side(vertices, shots->shifted + 3 * i) != oracle_side(vertices, ray))
            suite_fail(suite, method, ray, "the shifted point is on the wrong side");
        else if (vec3_length(moved) > 16 * unit + 0x1p-59)
            suite_fail(suite, method, ray, "the point was shifted by %g, %g ulp", vec3_length(moved),
                       vec3_length(moved) / unit);
    }
}

static void check_shadows(Suite *suite, Method method, const Shots *shots, int expected, const char *wrong)
{
    for (long i = 0; i < shots->count; i++)
        if (shots->hits[i].face >= 0 && shots->blocked[i] != expected)
            suite_fail(suite, method, shots->rays + 6 * i, "%s", wrong);
}

/* Seen from before its normal or from behind it, as it falls. */
static void self_hits_at(Suite *suite, double size, double offset)
{
    Vec3 centre = vec3(offset, -0.7 * offset, 1.3 * offset);
    Rotation rotation = random_rotation(&suite->random);
    if (random_below(&suite->random, 2)) /* left-handed: the square's vertices run the other way round */
        rotation.z = vec3_negate(rotation.z);
    double occluder = 64 * method_ulp(KERNEL_FLOAT, largest(centre) + size);
    Vec3 light = vec3_rounded(vec3_add(centre, rotate(&rotation, vec3(0, 0, 4 * size))));
    Scene alone = scene_empty(), covered = scene_empty();
    add_square(&alone, &rotation, centre, size, 0);
    add_square(&covered, &rotation, centre, size, 0);
    add_square(&covered, &rotation, centre, 4 * size, occluder);
    Shots shots = shots_make(suite_count(suite, 50000));
    suite_row(suite, "size %g, offset %g", size, offset);
    aim_at_square(&shots, &suite->random, &rotation, centre, size);
    for (Method method = 0; method < METHOD_COUNT; method++) {
        if (!method_is_here(suite, method))
            continue;
        suite_load(suite, &alone);
        method_points(suite, method, shots.rays, shots.count, shots.hits, shots.points, shots.shifted);
        check_points(suite, method, &shots);
        segments_to(&shots, light, false); /* its own face is asked too: the point alone must keep it from shadow */
        method_blocked(suite, method, shots.segments, shots.left, shots.count, shots.blocked);
        check_shadows(suite, method, &shots, 0, "the face shadows itself");
        suite_load(suite, &covered);
        segments_to(&shots, light, true);
        method_blocked(suite, method, shots.segments, shots.left, shots.count, shots.blocked);
        check_shadows(suite, method, &shots, 1, "an occluder 64 ulp away casts no shadow");
    }
    suite_load(suite, &alone);
    shots_free(&shots);
    scene_free(&covered);
    suite->scene = NULL;
    scene_free(&alone);
}

void test_self_hits(Suite *suite)
{
    static const double sizes[] = {1e-3, 1, 1e3, 1e6}, offsets[] = {0, 1, 1e3, 1e6};
    for (int s = 0; s < 4; s++)
        for (int o = 0; o < 4; o++)
            if (sizes[s] > 256 * method_ulp(KERNEL_FLOAT, 1.3 * offsets[o])) /* else rounding leaves no square */
                self_hits_at(suite, sizes[s], offsets[o]);
}

/* --- Shadow rays --- */

static void coplanar_tiles(Suite *suite, double offset)
{
    double spacing = fmax(0.25, 64 * method_ulp(KERNEL_FLOAT, offset));
    Sheet sheet = sheet_make(&suite->random, 8, spacing, vec3(offset, -0.7 * offset, 1.3 * offset));
    Vec3 light = vec3_rounded(vec3_add(sheet.centre, rotate(&sheet.rotation, vec3(spacing, 2 * spacing, 4 * spacing))));
    Shots shots = shots_make(suite_count(suite, 2.5e5));
    suite_load(suite, &sheet.scene);
    suite_row(suite, "coplanar tiles, offset %g: acne", offset);
    aim_at_square(&shots, &suite->random, &sheet.rotation, sheet.centre, 8 * spacing);
    for (Method method = 0; method < METHOD_COUNT; method++) {
        if (!method_is_here(suite, method))
            continue;
        method_points(suite, method, shots.rays, shots.count, shots.hits, shots.points, shots.shifted);
        segments_to(&shots, light, true);
        method_blocked(suite, method, shots.segments, shots.left, shots.count, shots.blocked);
        suite_rays(suite, method, shots.count);
        /* Float vertices leave the tiles a little out of one plane: the oracle says which neighbour really blocks. */
        for (long i = 0; i < shots.count; i++)
            if (shots.hits[i].face >= 0 && shots.blocked[i] &&
                !true_blocked(&sheet.scene, shots.segments + 6 * i, shots.left[i]))
                suite_fail(suite, method, shots.rays + 6 * i, "a shadow from nothing");
    }
    shots_free(&shots);
    scene_free(&sheet.scene);
}

/* Segments that the oracle judges. */
static void judge_segments(Suite *suite, Shots *shots)
{
    for (long i = 0; i < shots->count; i++)
        shots->left[i] = -1;
    method_round_to_device(suite, shots->segments, 6 * shots->count);
    int *truth = malloc((size_t)shots->count * sizeof *truth);
    for (long i = 0; i < shots->count; i++)
        truth[i] = true_blocked(suite->scene, shots->segments + 6 * i, -1);
    for (Method method = 0; method < METHOD_COUNT; method++) {
        if (!method_is_here(suite, method))
            continue;
        method_blocked(suite, method, shots->segments, shots->left, shots->count, shots->blocked);
        suite_rays(suite, method, shots->count);
        for (long i = 0; i < shots->count; i++)
            if (shots->blocked[i] != truth[i]) {
                double ray[6];
                memcpy(ray, shots->segments + 6 * i, sizeof ray);
                for (int k = 0; k < 3; k++)
                    ray[3 + k] -= ray[k];
                suite_fail(suite, method, ray, "to the light at t = 1: %s, the oracle says otherwise",
                           shots->blocked[i] ? "blocked" : "not blocked");
            }
    }
    free(truth);
}

/* A face at, just before and just behind the light. */
static void occluder_at_light(Suite *suite, int ulps)
{
    Shots shots = shots_make(suite_count(suite, 4000));
    suite_row(suite, "occluder %+d ulp from the light", ulps);
    for (int turn = 0; turn < 10; turn++) {
        Rotation rotation = random_rotation(&suite->random);
        if (turn < 3)
            rotation = (Rotation){{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        Vec3 light = vec3_rounded(vec3(random_in(&suite->random, -4, 4), random_in(&suite->random, -4, 4), 4));
        Scene scene = scene_empty();
        add_square(&scene, &rotation, light, 2, -ulps * method_ulp(KERNEL_FLOAT, 4));
        suite_load(suite, &scene);
        for (long i = 0; i < shots.count; i++) {
            Vec3 from = vec3(random_in(&suite->random, -3, 3), random_in(&suite->random, -3, 3),
                             random_in(&suite->random, -9, -1));
            if (random_below(&suite->random, 2))
                from.z = -from.z;
            vec3_put(shots.segments + 6 * i, vec3_rounded(vec3_add(light, rotate(&rotation, from))));
            vec3_put(shots.segments + 6 * i + 3, light);
        }
        judge_segments(suite, &shots);
        scene_free(&scene);
    }
    shots_free(&shots);
}

/* From anywhere past the seams of a sheet, near a corner or an edge as often as not. */
static void segments_past_seams(Suite *suite)
{
    Shots shots = shots_make(suite_count(suite, 1e5));
    suite_row(suite, "segments past the seams of a strip of tiles");
    Sheet sheet = sheet_make(&suite->random, 3, 1, vec3(0.1, 0.2, 0.3));
    suite_load(suite, &sheet.scene);
    for (long i = 0; i < shots.count; i++) {
        Vec3 through = sheet_vertex(&sheet, random_below(&suite->random, 4), random_below(&suite->random, 4));
        if (random_below(&suite->random, 2))
            through = vec3_add(through, rotate(&sheet.rotation, vec3(random_in(&suite->random, 0, 1), 0, 0)));
        Vec3 from =
            vec3_rounded(vec3_add(through, vec3_scale(random_in(&suite->random, 0, 3), random_unit(&suite->random))));
        Vec3 to = vec3_add(through, vec3_scale(random_in(&suite->random, 0, 2), vec3_sub(through, from)));
        vec3_put(shots.segments + 6 * i, from);
        vec3_put(shots.segments + 6 * i + 3, random_below(&suite->random, 2) ? vec3_rounded(to) : to);
    }
    judge_segments(suite, &shots);
    scene_free(&sheet.scene);
    shots_free(&shots);
}

void test_shadows(Suite *suite)
{
    static const double offsets[] = {0, 1e3, 1.5e5, 1e6};
    static const int ulps[] = {-4, -2, -1, 0, 1, 2, 4};
    for (int i = 0; i < 4; i++)
        coplanar_tiles(suite, offsets[i]);
    for (int i = 0; i < 7; i++)
        occluder_at_light(suite, ulps[i]);
    segments_past_seams(suite);
}
