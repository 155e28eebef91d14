/* How exact t is, and that grazing rays meet the face where it is. Tests 7 and 8. */
#include "scenes.h"
#include "support/oracle.h"
#include "tests.h"

#include <stdlib.h>

/* --- The error of t --- */

enum { ERRORS_MAX = 1 << 20 };

typedef struct Errors {
    const Sheet *sheet;
    double *ulps[METHOD_COUNT];
    long count[METHOD_COUNT];
} Errors;

static void aim_at_sheet(void *user, Random *random, double ray[6])
{
    const Sheet *sheet = ((const Errors *)user)->sheet;
    double half = sheet->spacing * sheet->cells / 2, far = 3 * half;
    Vec3 target = vec3(random_in(random, -half, half), random_in(random, -half, half), 0);
    Vec3 origin = vec3(random_in(random, -far, far), random_in(random, -far, far), random_in(random, 0.1, 1) * far);
    vec3_put(ray, vec3_add(sheet->centre, rotate(&sheet->rotation, origin)));
    vec3_put(ray + 3, rotate(&sheet->rotation, vec3_sub(target, origin)));
}

static const char *note_error(void *user, const Scene *scene, Method method, const double ray[6], int truth,
                              CastHit hit)
{
    (void)truth;
    Errors *errors = user;
    if (hit.face < 0 || errors->count[method] == ERRORS_MAX)
        return NULL;
    const float(*face)[3] = (const float(*)[3])scene->faces[hit.face].vertices;
    double ulp = method_ulp(method, oracle_t(face, ray));
    errors->ulps[method][errors->count[method]++] = fabs(oracle_t_error(face, ray, hit.t)) / ulp;
    return NULL;
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double percentile(double *numbers, long count, double share)
{
    if (count == 0)
        return 0;
    qsort(numbers, (size_t)count, sizeof *numbers, by_size);
    return numbers[(long)(share * (double)(count - 1))];
}

void test_t(Suite *suite)
{
    static const double offsets[] = {0, 1e2, 1e3, 1e5, 1e6};
    static const double limits[METHOD_COUNT] = {-1, 1e-6, 0.6, 0.6}; /* asked for: 8, 1, 1 */
    Errors errors = {.sheet = NULL};
    for (Method method = 0; method < METHOD_COUNT; method++)
        errors.ulps[method] = malloc(ERRORS_MAX * sizeof *errors.ulps[method]);
    for (size_t i = 0; i < sizeof offsets / sizeof offsets[0]; i++) {
        double offset = offsets[i];
        Sheet sheet = sheet_make(&suite->random, 2, offset > 1e5 ? 16 : 4, vec3(offset, -0.7 * offset, 1.3 * offset));
        errors.sheet = &sheet;
        suite_load(suite, &sheet.scene);
        suite_row(suite, "offset %g: error of t, 99th percentile, ulp", offset);
        for (Method method = 0; method < METHOD_COUNT; method++)
            errors.count[method] = 0;
        suite_cast(suite, &(Cast){.count = 5e5, .user = &errors, .aim = aim_at_sheet, .check = note_error});
        for (Method method = 0; method < METHOD_COUNT; method++)
            suite_measure(suite, method, errors.count[method],
                          percentile(errors.ulps[method], errors.count[method], 0.99), limits[method]);
        scene_free(&sheet.scene);
    }
    for (Method method = 0; method < METHOD_COUNT; method++)
        free(errors.ulps[method]);
}

/* --- Grazing --- */

typedef struct Graze {
    Rotation rotation;
    double length, width, sine;
} Graze;

/* At a point of the face, or a little beside it, under the angle, from beside the face. */
static void aim_grazing(void *user, Random *random, double ray[6])
{
    const Graze *graze = user;
    Vec3 target =
        vec3(random_in(random, -0.51, 0.51) * graze->length, random_in(random, -0.51, 0.51) * graze->width, 0);
    double turn = random_in(random, 0, 6.283185307179586);
    Vec3 along = vec3(cos(turn), sin(turn), random_below(random, 2) ? graze->sine : -graze->sine);
    Vec3 origin = vec3_sub(target, vec3_scale(graze->length * random_in(random, 1, 3), along));
    vec3_put(ray, rotate(&graze->rotation, origin));
    vec3_put(ray + 3, rotate(&graze->rotation, along));
}

static int true_hit(const Scene *scene, const double ray[6])
{
    return oracle_hits((const float(*)[3])scene->faces[0].vertices, ray) ? 0 : -1;
}

/* t lies between the vertices, as the ray meets them one after the other, but for 4 ulp. */
static const char *check_graze(void *user, const Scene *scene, Method method, const double ray[6], int truth,
                               CastHit hit)
{
    (void)user;
    if (hit.face != truth)
        return hit.face < 0 ? "a miss" : "a false hit";
    if (hit.face < 0)
        return NULL;
    Vec3 o = vec3_at(ray), r = vec3_at(ray + 3);
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int k = 0; k < 4; k++) {
        const float *v = scene->faces[0].vertices[k];
        double t = vec3_dot(vec3_sub(vec3((double)v[0], (double)v[1], (double)v[2]), o), r) / vec3_dot(r, r);
        low = fmin(low, t);
        high = fmax(high, t);
    }
    double slack = 4 * method_ulp(method, high);
    return hit.t < low - slack || hit.t > high + slack ? "t outside the face" : NULL;
}

void test_grazing(Suite *suite)
{
    for (int k = 1; k <= 7; k++)
        for (int aspect = 0; aspect <= 6; aspect += 3) {
            suite_row(suite, "90 - 1e-%d degrees, aspect 1e%d", k, aspect);
            for (int turn = 0; turn < 4; turn++) {
                double width = pow(10, -aspect);
                Graze graze = {random_rotation(&suite->random), 1, width,
                               sin(pow(10, -k) * 3.14159265358979323846 / 180)};
                if (turn == 0) /* across an axis, where the sine is not lost to rounding */
                    graze.rotation = (Rotation){{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
                Scene scene = scene_empty();
                Vec3 corners[4];
                for (int i = 0; i < 4; i++) {
                    Vec3 flat = vec3(i == 1 || i == 2 ? 0.5 : -0.5, i >= 2 ? width / 2 : -width / 2, 0);
                    corners[i] = rotate(&graze.rotation, flat);
                }
                scene_add(&scene, corners, 4);
                suite_load(suite, &scene);
                suite_cast(
                    suite,
                    &(Cast){
                        .count = 2.5e4, .user = &graze, .aim = aim_grazing, .truth = true_hit, .check = check_graze});
                scene_free(&scene);
            }
        }
}
