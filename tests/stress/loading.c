/* What a scene may be made of: any bits as vertices, and each kind of bad face. Tests 14 and 15. */
#include "reader/scene_build.h"
#include "scenes.h"
#include "tests.h"
#include "trace/reference.h"

#include <stdio.h>
#include <string.h>

/* One object of one face through the builder: the scene, or the reason why not. */
static bool build_one(Scene *scene, const Vec3 *corners, int count, char *reason, size_t size)
{
    Error error = {0};
    *scene = (Scene){.camera = {.look_at = {0, 0, -1}, .up = {0, 1, 0}}, .grid = 1};
    SceneBuild build = {.scene = scene, .error = &error};
    int material = scene_build_material(&build, (Material){.name = "dull"});
    const int vertices[4] = {0, 1, 2, 3};
    bool good =
        scene_build_object(&build, "face", (SceneBuildObject){.transform = transform_identity(), .material = material});
    for (int k = 0; good && k < count; k++)
        good = scene_build_point(&build, corners[k]);
    good = good && scene_build_face(&build, vertices, count, material, 0) && scene_build_finish(&build);
    snprintf(reason, size, "%s", build.reason);
    scene_build_free(&build);
    return good;
}

/* --- Bits --- */

static double random_pattern(Random *random)
{
    uint32_t bits = (uint32_t)random_bits(random);
    if (random_below(random, 2)) /* any sign and fraction, an exponent near 1 */
        bits = (bits & 0x807FFFFFu) | (uint32_t)(100 + random_below(random, 60)) << 23;
    float number;
    memcpy(&number, &bits, sizeof number);
    return (double)number;
}

/* Two faces of which a device without double may not tell the nearer: their t are within 2 ulp of a float. */
static bool is_tie_of_pairs(const Suite *suite, CastHit a, CastHit b)
{
    return !method_is_here(suite, KERNEL_DOUBLE) && a.face >= 0 && b.face >= 0 &&
           fabs(a.t - b.t) <= 2 * method_ulp(KERNEL_FLOAT, b.t);
}

/* Rays at the middle of the face: any answer, but no nonsense, and the same from kernel and reference. */
static void trace_pattern(Suite *suite, const Scene *scene)
{
    double rays[6 * 16];
    CastHit hits[METHOD_COUNT][16];
    const Face *face = &scene->faces[0];
    for (int i = 0; i < 16; i++) {
        Vec3 from = vec3_scale(pow(10, random_in(&suite->random, -3, 9)), random_unit(&suite->random));
        vec3_put(rays + 6 * i, from);
        for (int axis = 0; axis < 3; axis++)
            rays[6 * i + 3 + axis] =
                ((double)face->vertices[i % 4][axis] + (double)face->vertices[2][axis]) / 2 - rays[6 * i + axis];
    }
    method_round_to_device(suite, rays, 6 * 16);
    suite_load(suite, scene);
    for (Method method = KERNEL_FLOAT; method < METHOD_COUNT; method++) {
        if (!method_is_here(suite, method))
            continue;
        method_nearest(suite, method, rays, 16, hits[method]);
        suite_rays(suite, method, 16);
    }
    for (int i = 0; i < 16; i++) {
        CastHit expected = hits[REFERENCE][i];
        if (expected.face >= 0 && !(isfinite(expected.t) && expected.t >= 0))
            suite_fail(suite, REFERENCE, rays + 6 * i, "t = %g", expected.t);
        if (method_is_here(suite, KERNEL_DOUBLE) &&
            (memcmp(&hits[KERNEL_DOUBLE][i].t, &expected.t, sizeof(double)) != 0 ||
             hits[KERNEL_DOUBLE][i].face != expected.face))
            suite_fail(suite, KERNEL_DOUBLE, rays + 6 * i, "not what the reference says");
        if (hits[KERNEL_FLOAT][i].face != expected.face && !is_tie_of_pairs(suite, hits[KERNEL_FLOAT][i], expected))
            suite_fail(suite, KERNEL_FLOAT, rays + 6 * i, "not the face that the reference says");
    }
}

void test_bit_patterns(Suite *suite)
{
    suite_row(suite, "faces of random bits: those that load, traced");
    long count = suite_count(suite, 1e5), loaded = 0;
    for (long i = 0; i < count; i++) {
        Scene scene;
        Vec3 corners[4];
        char reason[256];
        int n = 3 + (i % 8 == 0);
        for (int k = 0; k < n; k++)
            corners[k] =
                vec3(random_pattern(&suite->random), random_pattern(&suite->random), random_pattern(&suite->random));
        bool good = build_one(&scene, corners, n, reason, sizeof reason);
        suite->scene = &scene;
        if (!good && reason[0] == '\0')
            suite_fail(suite, REFERENCE, NULL, "a face was refused without a reason");
        if (good) {
            trace_pattern(suite, &scene);
            loaded++;
        }
        suite->scene = NULL;
        scene_free(&scene);
    }
    fprintf(stderr, "    %ld of %ld loaded\n", loaded, count);
}

/* --- Bad faces --- */

static void expect(Suite *suite, const char *what, const Vec3 *corners, int count, const char *expected)
{
    Scene scene;
    char reason[256];
    bool good = build_one(&scene, corners, count, reason, sizeof reason);
    suite_row(suite, "%s: %s", what, expected ? expected : "good");
    suite_rays(suite, REFERENCE, 1);
    if (good != (expected == NULL) || (expected && !strstr(reason, expected)))
        suite_fail(suite, REFERENCE, NULL, "the verdict is: %s", good ? "good" : reason);
    scene_free(&scene);
}

void test_bad_faces(Suite *suite)
{
    const Vec3 square[4] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const Vec3 bow_tie[4] = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
    const Vec3 concave[4] = {{0, 0, 0}, {1, 0, 0}, {0.25, 0.25, 0}, {0, 1, 0}};
    const Vec3 line[4] = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}};
    const Vec3 repeated[4] = {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const Vec3 infinite[4] = {{0, 0, 0}, {HUGE_VAL, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const Vec3 not_a_number[4] = {{0, 0, 0}, {1, (double)NAN, 0}, {1, 1, 0}, {0, 1, 0}};
    const Vec3 far[4] = {{-4e12, 0, 0}, {4e12, 0, 0}, {4e12, 1e12, 0}, {-4e12, 1e12, 0}};
    const Vec3 denormal[4] = {{0, 0, 0}, {1e-310, 0, 0}, {1e-310, 1e-310, 0}, {0, 1e-310, 0}};
    expect(suite, "a square", square, 4, NULL);
    expect(suite, "a triangle", square, 3, NULL);
    expect(suite, "a bow-tie", bow_tie, 4, "crosses itself");
    expect(suite, "a reflex corner", concave, 4, NULL); /* cut in two */
    expect(suite, "four vertices on a line", line, 4, "no area");
    expect(suite, "three vertices on a line", line, 3, "no area");
    expect(suite, "a vertex repeated", repeated, 4, "same point");
    expect(suite, "an infinite coordinate", infinite, 4, "not a finite number");
    expect(suite, "NaN", not_a_number, 4, "not a finite number");
    expect(suite, "8e12 across", far, 4, "1e12");
    expect(suite, "denormal sides", denormal, 4, "face");
    for (int k = 1; k <= 8; k++) {
        Vec3 bent[4];
        char what[64];
        memcpy(bent, square, sizeof bent);
        bent[1].z = pow(10, -k);
        snprintf(what, sizeof what, "a corner off the plane by 1e-%d", k);
        /* Vertices 1 and 3 are a half of it from the plane, of which 1e-5 of the diagonal, 1.4, is allowed. */
        expect(suite, what, bent, 4, k <= 4 ? "not planar" : NULL);
    }
}
