/* The kernels' fast edge test, which must send every doubtful ray to the exact one: rays whose origins and directions
 * are floats, aimed exactly at edges and vertices and one ulp beside them. Every kernel must decide as the
 * reference does. */
#include "opencl/opencl_cast.h"
#include "trace/reference.h"

#include "support/small_scene.h"
#include "support/xorshift.h"

#include "unity.h"

#include <stdio.h>

static const int LANES[] = {1, 4, 8, 16};
static const AccelKind ACCELS[] = {ACCEL_NONE, ACCEL_BVH};

enum { RAYS_MAX = 20000 };
static double rays[RAYS_MAX][6];
static CastHit expected[RAYS_MAX], hits[RAYS_MAX];
static int ray_count;

static SmallScene small;
static Error error;
static uint64_t state;

void setUp(void)
{
    small_scene_begin(&small);
    small_scene_material(&small, (Material){.reflection = 0});
    error = (Error){0};
    ray_count = 0;
    state = 20240607;
}

void tearDown(void) {}

/* --- Rays --- */

static void add_ray(Vec3 origin, Vec3 direction)
{
    if (vec3_dot(direction, direction) == 0)
        return;
    TEST_ASSERT_LESS_THAN(RAYS_MAX, ray_count);
    double *ray = rays[ray_count++];
    const double values[] = {origin.x, origin.y, origin.z, direction.x, direction.y, direction.z};
    for (int k = 0; k < 6; k++) {
        ray[k] = values[k];
        TEST_ASSERT_TRUE_MESSAGE((double)(float)ray[k] == ray[k], "the test's rays must be floats");
    }
}

/* Straight at the point, and with each component of the direction one ulp off to either side. */
static void aim(Vec3 origin, Vec3 target)
{
    Vec3 d = vec3_sub(target, origin);
    add_ray(origin, d);
    const float infinity = HUGE_VALF;
    for (int side = 0; side < 2; side++) {
        float end = side ? infinity : -infinity;
        add_ray(origin, vec3((double)nextafterf((float)d.x, end), d.y, d.z));
        add_ray(origin, vec3(d.x, (double)nextafterf((float)d.y, end), d.z));
        add_ray(origin, vec3(d.x, d.y, (double)nextafterf((float)d.z, end)));
    }
}

/* At all vertices and at quarters of the edges. */
static void aim_at_outline(Vec3 origin, const Face *face)
{
    for (int k = 0; k < face->vertex_count; k++) {
        Vec3 a = face_vertex(face, k), b = face_vertex(face, (k + 1) % face->vertex_count);
        for (int quarter = 0; quarter < 4; quarter++)
            aim(origin, vec3_add(a, vec3_scale(0.25 * quarter, vec3_sub(b, a))));
    }
}

/* Multiples of `step`, so few of them apart that all sums and differences here are floats. */
static Vec3 random_lattice(double step, int range)
{
    return vec3(step * (double)random_integer(&state, range), step * (double)random_integer(&state, range),
                step * (double)random_integer(&state, range));
}

/* --- Comparing --- */

static void trace_with_the_reference(void)
{
    RenderReport report = {0};
    const Tracer tracer = {.scene = &small.scene, .report = &report};
    for (int i = 0; i < ray_count; i++) {
        const double *r = rays[i];
        expected[i] = reference_nearest(&tracer, (Ray){vec3(r[0], r[1], r[2]), vec3(r[3], r[4], r[5])}, -1);
    }
}

static const char *describe(int i, const RenderSettings *settings)
{
    static char text[512];
    const double *r = rays[i];
    snprintf(text, sizeof text,
             "ray %d at %d lanes, %s, %s: face %d at %.17g is face %d at %.17g; origin %a %a %a direction %a %a %a", i,
             settings->lanes, settings->precision == PRECISION_DOUBLE ? "double" : "float",
             settings->accel == ACCEL_NONE ? "no tree" : "tree", expected[i].face, expected[i].t, hits[i].face,
             hits[i].t, r[0], r[1], r[2], r[3], r[4], r[5]);
    return text;
}

/* The float kernel's t may be off by the rounding of the stored normal, 2^-48, as far as N.R magnifies it. */
static bool same_t(int i, Precision precision)
{
    if (expected[i].face < 0 || precision == PRECISION_DOUBLE)
        return expected[i].t == hits[i].t;
    const double *r = rays[i];
    Vec3 direction = vec3(r[3], r[4], r[5]);
    double cosine = fabs(vec3_dot(small.planes[expected[i].face].normal, direction)) / vec3_length(direction);
    return fabs(expected[i].t - hits[i].t) * cosine <= 0x1p-44 * expected[i].t;
}

/* With `coplanar` faces, of which several are hit at one t, the float kernel may choose another than the reference. */
static void assert_every_kernel_agrees(bool coplanar)
{
    trace_with_the_reference();
    for (int k = 0; k < 16; k++) {
        RenderSettings settings = {
            .precision = k & 1 ? PRECISION_DOUBLE : PRECISION_FLOAT,
            .accel = ACCELS[k >> 1 & 1],
            .lanes = LANES[k >> 2],
            .device = -1,
        };
        RenderReport report;
        bool ok = opencl_cast(&small.scene, &settings, rays[0], ray_count, hits, &report, &error);
        TEST_ASSERT_TRUE_MESSAGE(ok, error.text);
        for (int i = 0; i < ray_count; i++) {
            bool same = expected[i].face == hits[i].face;
            if (coplanar && settings.precision == PRECISION_FLOAT)
                same = (expected[i].face < 0) == (hits[i].face < 0);
            if (!same || !same_t(i, settings.precision))
                TEST_FAIL_MESSAGE(describe(i, &settings));
        }
    }
}

/* How many of the rays hit something. */
static int hits_expected(void)
{
    int count = 0;
    for (int i = 0; i < ray_count; i++)
        count += expected[i].face >= 0;
    return count;
}

/* --- The tests --- */

/* Faces apart from each other around the point `middle`, some of them triangles or one-sided. */
static void build_scattered_faces(Vec3 middle, double step)
{
    for (int i = 0; i < 24; i++) {
        Vec3 a = vec3_add(middle, random_lattice(64 * step, 64));
        Vec3 u = random_lattice(4 * step, 64), v = random_lattice(4 * step, 64);
        Vec3 b = vec3_add(a, u), d = vec3_add(a, v);
        Face face = i % 3 ? face_quad(a, b, vec3_add(b, v), d) : face_triangle(a, b, d);
        if (vec3_length(vec3_cross(u, v)) > 0)
            small_scene_face(&small, 0, face)->one_sided = i % 5 == 0;
    }
    for (int i = 0; i < small.scene.face_count; i++)
        for (int k = 0; k < 3; k++)
            aim_at_outline(vec3_add(middle, random_lattice(64 * step, 96)), &small.faces[i]);
}

static void kernels_should_decide_edges_exactly(void)
{
    build_scattered_faces(vec3(0, 0, 0), 0x1p-12);
    assert_every_kernel_agrees(false);
    TEST_ASSERT_GREATER_THAN(ray_count / 4, hits_expected());
    TEST_ASSERT_GREATER_THAN(ray_count / 4, ray_count - hits_expected());
}

/* Far from the origin nearly every ray is doubtful for floats. */
static void kernels_should_decide_edges_exactly_far_away(void)
{
    build_scattered_faces(vec3(1024, -512, 768), 0x1p-12);
    assert_every_kernel_agrees(false);
    TEST_ASSERT_GREATER_THAN(ray_count / 4, hits_expected());
}

static void kernels_should_decide_edges_exactly_in_tiny_scenes(void)
{
    build_scattered_faces(vec3(0, 0, 0), 0x1p-40);
    assert_every_kernel_agrees(false);
    TEST_ASSERT_GREATER_THAN(ray_count / 4, hits_expected());
}

/* A tilted sheet of 7 x 7 faces: no ray at an inner edge or vertex may slip through. */
static void sheet_should_let_no_ray_through(void)
{
    Vec3 u = vec3(0x1p-3, 0x1p-5, 3 * 0x1p-6), v = vec3(-0x1p-6, 5 * 0x1p-6, 0x1p-4);
    for (int j = 0; j < 7; j++)
        for (int i = 0; i < 7; i++) {
            Vec3 a = vec3_add(vec3_scale(i, u), vec3_scale(j, v));
            small_scene_face(&small, 0, face_quad(a, vec3_add(a, u), vec3_add(vec3_add(a, u), v), vec3_add(a, v)));
        }
    for (int n = 0; n < 100; n++) {
        Vec3 origin = vec3_add(vec3(1, -1, 2), random_lattice(0x1p-10, 512));
        aim_at_outline(origin, &small.faces[7 * (1 + n % 5) + 1 + n / 5 % 5]);
    }
    assert_every_kernel_agrees(true);
    TEST_ASSERT_EQUAL_INT(ray_count, hits_expected());
}

/* Rays along the axes, and rays that lie in planes and on edges of an axis-parallel box, with both zeros. */
static void axis_parallel_rays_should_be_decided_exactly(void)
{
    for (int side = 0; side < 2; side++) {
        double s = side;
        small_scene_face(&small, 0, face_at_height(0, 0, 1, 1, s));
        small_scene_face(&small, 0, face_quad(vec3(0, s, 0), vec3(1, s, 0), vec3(1, s, 1), vec3(0, s, 1)));
        small_scene_face(&small, 0, face_quad(vec3(s, 0, 0), vec3(s, 1, 0), vec3(s, 1, 1), vec3(s, 0, 1)));
    }
    const double places[] = {-1, -0.0, 0, 0.5, 1, 2};
    for (int n = 0; n < 6 * 6 * 6; n++) {
        Vec3 origin = vec3(places[n % 6], places[n / 6 % 6], places[n / 36]);
        for (int m = 0; m < 27; m++)
            add_ray(origin, vec3(m % 3 - 1, m / 3 % 3 - 1, m % 2 ? m / 9 - 1 : -(m / 9 - 1.0)));
    }
    assert_every_kernel_agrees(false);
    TEST_ASSERT_GREATER_THAN(1000, hits_expected());
}

/* The last bundle is not full: its spare lanes must not write. */
static void any_number_of_rays_should_be_cast(void)
{
    small_scene_face(&small, 0, face_at_height(-1, -1, 1, 1, 0));
    for (int count = 1; count <= 17; count += 4) {
        ray_count = 0;
        for (int i = 0; i < count; i++)
            add_ray(vec3(i - 2, 0, 1), vec3(0, 0, -1));
        hits[count] = (CastHit){77, 77};
        assert_every_kernel_agrees(false);
        TEST_ASSERT_EQUAL_INT(77, hits[count].face);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(kernels_should_decide_edges_exactly);
    RUN_TEST(kernels_should_decide_edges_exactly_far_away);
    RUN_TEST(kernels_should_decide_edges_exactly_in_tiny_scenes);
    RUN_TEST(sheet_should_let_no_ray_through);
    RUN_TEST(axis_parallel_rays_should_be_decided_exactly);
    RUN_TEST(any_number_of_rays_should_be_cast);
    return UNITY_END();
}
