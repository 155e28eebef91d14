/* Any faces, any rays: hit, face and order as the exact oracle says. Tests 6 and 12. */
#include "scenes.h"
#include "tests.h"

#include <float.h>

enum { SOUP = 12, SCENES = 40 };

/* A planar quad or a triangle of any shape near the middle. */
static void add_random_face(Scene *scene, Random *random)
{
    Vec3 middle = vec3(random_in(random, -1, 1), random_in(random, -1, 1), random_in(random, -1, 1));
    Vec3 a = vec3_scale(pow(10, random_in(random, -2, 0.3)), random_unit(random));
    Vec3 b = vec3_scale(pow(10, random_in(random, -2, 0.3)), random_unit(random));
    if (random_below(random, 3) == 0) {
        const Vec3 corners[3] = {middle, vec3_add(middle, a), vec3_add(middle, b)};
        scene_add(scene, corners, 3);
        return;
    }
    double u = random_in(random, 0.6, 1), v = random_in(random, 0.6, 1);
    const Vec3 corners[4] = {middle, vec3_add(middle, a),
                             vec3_add(middle, vec3_add(vec3_scale(u, a), vec3_scale(v, b))), vec3_add(middle, b)};
    scene_add(scene, corners, 4);
}

static void aim_anywhere(void *user, Random *random, double ray[6])
{
    (void)user;
    vec3_put(ray, vec3_scale(random_in(random, 0, 4), random_unit(random)));
    vec3_put(ray + 3, vec3_scale(pow(10, random_in(random, -3, 3)), random_unit(random)));
}

/* At a point within 8 ulp of an edge. */
static void aim_near_edge(void *user, Random *random, double ray[6])
{
    const Scene *scene = user;
    const Face *face = &scene->faces[random_below(random, scene->face_count)];
    int k = random_below(random, face->vertex_count), next = (k + 1) % face->vertex_count;
    double along = random_below(random, 4) ? random_in(random, 0, 1) : random_below(random, 2);
    double precision = random_below(random, 2) ? (double)FLT_EPSILON : DBL_EPSILON;
    vec3_put(ray, vec3_rounded(vec3_scale(random_in(random, 1, 8), random_unit(random))));
    for (int i = 0; i < 3; i++) {
        double a = (double)face->vertices[k][i], b = (double)face->vertices[next][i];
        double target = a + along * (b - a);
        ray[3 + i] = target + random_in(random, -8, 8) * precision * fabs(target) - ray[i];
    }
}

void test_agreement(Suite *suite)
{
    Scene scenes[SCENES];
    for (int i = 0; i < SCENES; i++) {
        scenes[i] = scene_empty();
        for (int k = 0; k < SOUP; k++)
            add_random_face(&scenes[i], &suite->random);
    }
    for (int near_edge = 0; near_edge < 2; near_edge++) {
        suite_row(suite, near_edge ? "within 8 ulp of an edge" : "random rays");
        for (int i = 0; i < SCENES; i++) {
            suite_load(suite, &scenes[i]);
            suite_cast(suite, &(Cast){.count = 1e7 / SCENES,
                                      .user = &scenes[i],
                                      .aim = near_edge ? aim_near_edge : aim_anywhere,
                                      .truth = true_nearest,
                                      .check = check_nearest});
        }
    }
    for (int i = 0; i < SCENES; i++)
        scene_free(&scenes[i]);
}

/* --- Along the axes --- */

/* Whole numbers, so that rays run in planes and along edges; zeros of either sign. */
static void aim_along_axes(void *user, Random *random, double ray[6])
{
    (void)user;
    do
        for (int i = 0; i < 6; i++) {
            ray[i] = i < 3 ? random_below(random, 17) * 0.5 - 4 : random_below(random, 3) - 1;
            if (ray[i] == 0 && random_below(random, 2))
                ray[i] = -0.0;
        }
    while (ray[3] == 0 && ray[4] == 0 && ray[5] == 0);
}

void test_axes(Suite *suite)
{
    Scene scene = scene_empty();
    scene_add_box(&scene, vec3(-3, -3, -3), vec3(6, 0, 0), vec3(0, 6, 0), vec3(0, 0, 6));
    scene_add_box(&scene, vec3(-1, -1, -1), vec3(2, 0, 0), vec3(0, 2, 0), vec3(0, 0, 2));
    scene_add_box(&scene, vec3(1, -1, 0), vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1));
    const Vec3 tilted[4] = {{-2, -2, 2}, {2, -2, 2}, {2, 2, -2}, {-2, 2, -2}};
    scene_add(&scene, tilted, 4);
    suite_load(suite, &scene);
    suite_row(suite, "along axes and in planes, zeros of both signs");
    suite_cast(suite, &(Cast){.count = 1e6, .aim = aim_along_axes, .truth = true_nearest, .check = check_nearest});
    scene_free(&scene);
}
