/* Closed surfaces, seen through their seams: sheets of quads, Embree's sphere and plane, boxes. Tests 1 to 5. */
#include "scenes.h"
#include "support/oracle.h"
#include "tests.h"

#include <stdio.h>

typedef struct Seam {
    const Sheet *sheet;
    bool vertices; /* aim at vertices, else at edges */
} Seam;

static void aim_from(Random *random, Vec3 target, Vec3 normal, double distance, double ray[6])
{
    Vec3 side = random_unit(random);
    if (vec3_dot(side, normal) < 0)
        side = vec3_negate(side);
    Vec3 origin =
        vec3_rounded(vec3_add(target, vec3_scale(distance, vec3_unit(vec3_add(side, vec3_scale(0.5, normal))))));
    vec3_put(ray, origin);
    vec3_put(ray + 3, vec3_sub(target, origin));
}

static void aim_at_seam(void *user, Random *random, double ray[6])
{
    const Seam *seam = user;
    int inner = seam->sheet->cells - 1;
    int i = 1 + random_below(random, inner), j = 1 + random_below(random, inner);
    Vec3 target = sheet_vertex(seam->sheet, i, j);
    if (!seam->vertices) {
        bool along = random_below(random, 2);
        Vec3 next = sheet_vertex(seam->sheet, along ? i - 1 : i, along ? j : j - 1);
        target = vec3_add(target, vec3_scale(random_in(random, 0, 1), vec3_sub(next, target)));
    }
    aim_from(random, target, seam->sheet->rotation.z, 8 * seam->sheet->spacing, ray);
}

/* The oracle confirms a part of the hits, too. */
static const char *check_no_miss(void *user, const Scene *scene, Method method, const double ray[6], int truth,
                                 CastHit hit)
{
    (void)user, (void)method, (void)truth;
    static int turn = 0;
    if (hit.face < 0)
        return "a miss";
    if (turn++ % 16 == 0 && method != TEXTBOOK && !oracle_hits((const float(*)[3])scene->faces[hit.face].vertices, ray))
        return "a false hit";
    return NULL;
}

/* The spacing is at least 32 ulp of the offset: with less, rounding makes quads concave, and such a sheet has holes. */
typedef struct Place {
    double offset, spacing;
} Place;

static const Place places[] = {{0, 0.25}, {1e3, 0.25}, {1.5e5, 0.5}, {1e6, 2}};

static Vec3 place_centre(double offset)
{
    return vec3(offset, -0.7 * offset, 1.3 * offset);
}

void test_grid_misses(Suite *suite)
{
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        Sheet sheet = sheet_make(&suite->random, 64, places[i].spacing, place_centre(places[i].offset));
        suite_load(suite, &sheet.scene);
        for (int vertices = 1; vertices >= 0; vertices--) {
            Seam seam = {&sheet, vertices};
            suite_row(suite, "offset %g, aimed at %s", places[i].offset, vertices ? "vertices" : "edges");
            suite_cast(suite, &(Cast){.count = 1e6, .user = &seam, .aim = aim_at_seam, .check = check_no_miss});
        }
        scene_free(&sheet.scene);
    }
}

/* A ray exactly through a seam hits the faces on both sides; the oracle tells which do. */
static const char *check_count(void *user, const Scene *scene, Method method, const double ray[6], int truth,
                               CastHit hit)
{
    (void)user, (void)truth, (void)method;
    if (hit.face == 1)
        return NULL;
    return hit.face == true_count(scene, ray) ? NULL : hit.face == 0 ? "a miss" : "hit more than once";
}

void test_grid_counts(Suite *suite)
{
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++)
        for (int vertices = 1; vertices >= 0; vertices--) {
            suite_row(suite, "offset %g, aimed at %s", places[i].offset, vertices ? "vertices" : "edges");
            for (int patch = 0; patch < 4; patch++) {
                Sheet sheet = sheet_make(&suite->random, 8, places[i].spacing, place_centre(places[i].offset));
                Seam seam = {&sheet, vertices};
                suite_load(suite, &sheet.scene);
                suite_cast(
                    suite,
                    &(Cast){.count = 2.5e5, .user = &seam, .aim = aim_at_seam, .check = check_count, .counts = true});
                scene_free(&sheet.scene);
            }
        }
}

/* --- Embree's watertight scenes, with quads --- */

enum { RINGS = 50 };

static Vec3 sphere_point(int ring, int step)
{
    double theta = 3.14159265358979323846 * ring / RINGS, phi = 3.14159265358979323846 * (step % (2 * RINGS)) / RINGS;
    if (ring == 0 || ring == RINGS)
        phi = 0;
    double across = ring == RINGS ? 0 : sin(theta);
    return vec3_add(vec3(148376, 1234, -223423), vec3_scale(2, vec3(across * cos(phi), cos(theta), across * sin(phi))));
}

/* The sphere as loaded: around its centre. At its place in the world float32 leaves no sphere of it. */
static Vec3 sphere_vertex(int ring, int step)
{
    return vec3_rounded(vec3_sub(sphere_point(ring, step), vec3(148376, 1234, -223423)));
}

static void aim_inside_sphere(void *user, Random *random, double ray[6])
{
    (void)user;
    Vec3 origin = vec3_scale(random_in(random, 0, 1.5), random_unit(random));
    vec3_put(ray, origin);
    int turn = random_below(random, 3);
    int ring = 1 + random_below(random, RINGS - 1), step = random_below(random, 2 * RINGS);
    Vec3 target = sphere_vertex(ring, step);
    if (turn == 1)
        target = vec3_add(target, vec3_scale(random_in(random, 0, 1), vec3_sub(sphere_vertex(ring, step + 1), target)));
    vec3_put(ray + 3, turn == 2 ? random_unit(random) : vec3_sub(target, vec3_rounded(origin)));
}

static void test_sphere(Suite *suite)
{
    Scene scene = scene_empty();
    for (int ring = 0; ring < RINGS; ring++)
        for (int step = 0; step < 2 * RINGS; step++) {
            Vec3 corners[4] = {sphere_vertex(ring, step), sphere_vertex(ring + 1, step),
                               sphere_vertex(ring + 1, step + 1), sphere_vertex(ring, step + 1)};
            bool south = ring == RINGS - 1;
            if (south)
                corners[2] = corners[3];
            scene_add(&scene, corners, ring == 0 || south ? 3 : 4);
        }
    suite_load(suite, &scene);
    suite_row(suite, "sphere of radius 2, as loaded, from inside");
    suite_cast(suite, &(Cast){.count = 5e6, .aim = aim_inside_sphere, .check = check_no_miss});
    scene_free(&scene);
}

/* The plane x = 148376, as loaded: around its centre. */
static void aim_at_plane(void *user, Random *random, double ray[6])
{
    (void)user;
    bool seam = random_below(random, 2);
    double y = seam ? random_below(random, 199) - 99 : random_in(random, -99, 99), z = random_in(random, -99, 99);
    Vec3 origin =
        vec3_rounded(vec3(-random_in(random, 1, 300), random_in(random, -100, 100), random_in(random, -100, 100)));
    vec3_put(ray, origin);
    vec3_put(ray + 3, vec3_sub(vec3(0, y, z), origin));
}

static void test_plane(Suite *suite)
{
    Scene scene = scene_empty();
    for (int i = -100; i < 100; i++)
        for (int j = -100; j < 100; j++) {
            const Vec3 corners[4] = {vec3(0, i, j), vec3(0, i + 1, j), vec3(0, i + 1, j + 1), vec3(0, i, j + 1)};
            scene_add(&scene, corners, 4);
        }
    suite_load(suite, &scene);
    suite_row(suite, "plane of 200 x 200 squares, as loaded");
    suite_cast(suite, &(Cast){.count = 5e6, .aim = aim_at_plane, .check = check_no_miss});
    scene_free(&scene);
}

void test_embree(Suite *suite)
{
    test_sphere(suite);
    test_plane(suite);
}
