/* The scene as the kernels get it: values that a float cannot hold travel as two, and bounds do not fall short. */
#include "opencl/device_scene.h"

#include "support/assert_vec3.h"
#include "support/small_scene.h"
#include "support/xorshift.h"

#include "unity.h"

#include <string.h>

static SmallScene small;
static DeviceScene packed;
static Error error;
static uint64_t state;

void setUp(void)
{
    small_scene_begin(&small);
    error = (Error){0};
    state = 20250301;
    packed = (DeviceScene){0};
}

void tearDown(void)
{
    device_scene_free(&packed);
}

static const float *floats(const DeviceReals *reals)
{
    return reals->data;
}

/* value = NAME + NAME_LOW, to 2^-48 of it. */
static void assert_split(double value, const float *high, const float *low)
{
    TEST_ASSERT_DOUBLE_WITHIN(0x1p-48 * fabs(value), value, (double)*high + (double)*low);
}

static void light_position_should_travel_in_two_floats(void)
{
    Vec3 at = vec3(-1.6, 0.825, 4.6);
    small_scene_light(&small, at);
    TEST_ASSERT_TRUE_MESSAGE(
        device_scene_pack(&packed, &small.scene,
                          &(DevicePacking){.precision = PRECISION_FLOAT, .wide = PRECISION_FLOAT, .threads = 1},
                          &error),
        error.text);
    const float *row = floats(&packed.lights);
    assert_split(at.x, row + LIGHT_POSITION, row + LIGHT_POSITION_LOW);
    assert_split(at.y, row + LIGHT_POSITION + 1, row + LIGHT_POSITION_LOW + 1);
    assert_split(at.z, row + LIGHT_POSITION + 2, row + LIGHT_POSITION_LOW + 2);
}

static void normal_should_travel_in_two_floats_within_its_error(void)
{
    small_scene_material(&small, (Material){.reflection = 0});
    small_scene_face(&small, 0, face_triangle(vec3(6, 0, 0), vec3(0, 3, 0), vec3(0, 0, 3)));
    TEST_ASSERT_TRUE_MESSAGE(
        device_scene_pack(&packed, &small.scene,
                          &(DevicePacking){.precision = PRECISION_FLOAT, .wide = PRECISION_FLOAT, .threads = 1},
                          &error),
        error.text);
    const float *row = floats(&packed.faces.planes);
    const double exact[] = {1.0 / 3, 2.0 / 3, 2.0 / 3};
    for (int axis = 0; axis < 3; axis++) {
        assert_split(exact[axis], row + PLANE_NORMAL + axis, row + PLANE_NORMAL_LOW + axis);
        double stored = (double)row[PLANE_NORMAL + axis] + (double)row[PLANE_NORMAL_LOW + axis];
        TEST_ASSERT_DOUBLE_WITHIN((double)row[PLANE_ERROR], exact[axis], stored);
    }
}

/* --- The bits of a face --- */

static double random_between(double low, double high)
{
    return low + (high - low) * (1 + random_unit(&state)) / 2;
}

static Vec3 random_point(double size)
{
    return vec3(random_between(-size, size), random_between(-size, size), random_between(-size, size));
}

static double magnitudes(Vec3 a)
{
    return fabs(a.x) + fabs(a.y) + fabs(a.z);
}

static double half_of(uint32_t bits)
{
    float value;
    bits &= 0x7fff0000;
    memcpy(&value, &bits, sizeof value);
    return (double)value;
}

/* `count` faces of all sizes, some quads bent; returns them packed, in the given precision. */
static void pack_random_faces(unsigned char *closed, int count, Precision precision)
{
    for (int i = 0; i < count; i++) {
        double size = exp2(random_between(-30, 30)), bend = i % 3 ? size * exp2(random_between(-30, -3)) : 0;
        Vec3 a = random_point(size), u = random_point(size), v = random_point(size);
        Vec3 opposite = vec3_add(vec3_add(vec3_add(a, u), v), random_point(bend));
        Face face = i % 4 ? face_quad(a, vec3_add(a, u), opposite, vec3_add(a, v))
                          : face_triangle(a, vec3_add(a, u), vec3_add(a, v));
        small_scene_face(&small, 0, face)->one_sided = i % 5 == 0;
        closed[i] = i % 7 == 0;
    }
    TEST_ASSERT_TRUE_MESSAGE(
        device_scene_pack(&packed, &small.scene,
                          &(DevicePacking){.closed = closed, .precision = precision, .wide = precision, .threads = 1},
                          &error),
        error.text);
}

static void face_bits_should_bound_edges_and_warp(void)
{
    enum { COUNT = SMALL_SCENE_MAX };
    unsigned char closed[COUNT];
    small_scene_material(&small, (Material){.reflection = 0});
    pack_random_faces(closed, COUNT, PRECISION_FLOAT);
    for (int i = 0; i < COUNT; i++) {
        const float *row = floats(&packed.faces.rows) + i * FACE_REALS;
        uint32_t bits;
        memcpy(&bits, row + FACE_BITS, sizeof bits);
        const Face *face = &small.faces[i];
        double longest = 0, warp = 0;
        for (int k = 0; k < 4; k++) {
            Vec3 from = face_vertex(face, k), to = face_vertex(face, (k + 1) % 4);
            longest = fmax(longest, magnitudes(vec3_sub(to, from)));
            warp = fmax(warp, fabs(vec3_dot(small.planes[i].normal, vec3_sub(from, face_vertex(face, 0)))));
        }
        TEST_ASSERT_TRUE(half_of(bits) >= longest && half_of(bits) <= 1.01 * longest);
        TEST_ASSERT_TRUE(half_of(bits << 16) >= warp && half_of(bits << 16) <= 1.02 * warp + 0x1p-45 * longest);
    }
}

static void face_bits_should_tell_what_a_face_is(void)
{
    enum { COUNT = SMALL_SCENE_MAX };
    unsigned char closed[COUNT];
    small_scene_material(&small, (Material){.reflection = 0});
    pack_random_faces(closed, COUNT, PRECISION_DOUBLE);
    for (int i = 0; i < COUNT; i++) {
        uint32_t bits;
        memcpy(&bits, (const double *)packed.faces.rows.data + i * FACE_REALS + FACE_BITS, sizeof bits);
        TEST_ASSERT_EQUAL_INT(i % 4 == 0, (bits & FACE_TRIANGLE) != 0);
        TEST_ASSERT_EQUAL_INT(i % 5 == 0, (bits & FACE_ONE_SIDED) != 0);
        TEST_ASSERT_EQUAL_INT(i % 7 == 0 && i % 5 != 0, (bits & FACE_BACK_INSIDE) != 0);
    }
}

static void face_row_should_hold_the_vertices_as_they_are(void)
{
    small_scene_material(&small, (Material){.reflection = 0});
    small_scene_face(&small, 0, face_triangle(vec3(6, (double)0.1f, 0), vec3(0, 3, -7), vec3(1, 2, 3)));
    TEST_ASSERT_TRUE_MESSAGE(
        device_scene_pack(&packed, &small.scene,
                          &(DevicePacking){.precision = PRECISION_FLOAT, .wide = PRECISION_FLOAT, .threads = 1},
                          &error),
        error.text);
    const float expected[] = {6, 0, 1, 6, 0.1f, 3, 2, 0.1f, 0, -7, 3, 0};
    TEST_ASSERT_EQUAL_FLOAT_ARRAY(expected, floats(&packed.faces.rows) + FACE_VERTICES, 12);
}

static void double_rows_should_need_no_low_parts(void)
{
    small_scene_light(&small, vec3(-1.6, 0.825, 4.6));
    TEST_ASSERT_TRUE_MESSAGE(
        device_scene_pack(&packed, &small.scene,
                          &(DevicePacking){.precision = PRECISION_DOUBLE, .wide = PRECISION_DOUBLE, .threads = 1},
                          &error),
        error.text);
    const double *row = packed.lights.data;
    ASSERT_VEC3_WITHIN(0, -1.6, 0.825, 4.6,
                       vec3(row[LIGHT_POSITION], row[LIGHT_POSITION + 1], row[LIGHT_POSITION + 2]));
    for (int axis = 0; axis < 3; axis++)
        TEST_ASSERT_TRUE(row[LIGHT_POSITION_LOW + axis] == 0);
}

static void scene_of_nothing_should_pack(void)
{
    TEST_ASSERT_TRUE_MESSAGE(
        device_scene_pack(&packed, &small.scene,
                          &(DevicePacking){.precision = PRECISION_FLOAT, .wide = PRECISION_FLOAT, .threads = 1},
                          &error),
        error.text);
    TEST_ASSERT_GREATER_THAN(0, device_reals_bytes(&packed.lights));
    TEST_ASSERT_GREATER_THAN(0, device_reals_bytes(&packed.faces.planes));
}

/* Spoils the planes: nothing that is packed later may be made of them. */
static void spoil_planes(void *user)
{
    Scene *scene = user;
    for (int i = 0; i < scene->face_count; i++)
        scene->planes[i] = (Plane){.normal = vec3((double)NAN, (double)NAN, (double)NAN)};
}

static void planes_should_be_spent_when_they_are_packed(void)
{
    DeviceScene whole;
    DevicePacking how = {.precision = PRECISION_FLOAT, .wide = PRECISION_DOUBLE, .threads = 1};
    small_scene_material(&small, (Material){.reflection = 0});
    small_scene_face(&small, 0, face_triangle(vec3(6, 0, 0), vec3(0, 3, -7), vec3(1, 2, 3)));
    small_scene_face(&small, 0, face_triangle(vec3(6, 1, 0), vec3(0, 3, 7), vec3(1, -2, 3)));
    TEST_ASSERT_TRUE_MESSAGE(device_scene_pack(&whole, &small.scene, &how, &error), error.text);
    how.spent = (Spent){spoil_planes, &small.scene};
    TEST_ASSERT_TRUE_MESSAGE(device_scene_pack(&packed, &small.scene, &how, &error), error.text);
    TEST_ASSERT_TRUE(isnan(small.scene.planes[1].normal.x));
    TEST_ASSERT_EQUAL_MEMORY(whole.faces.records, packed.faces.records, 2 * sizeof *packed.faces.records);
    TEST_ASSERT_EQUAL_MEMORY(whole.faces.rows.data, packed.faces.rows.data, device_reals_bytes(&packed.faces.rows));
    TEST_ASSERT_EQUAL_MEMORY(whole.faces.planes.data, packed.faces.planes.data,
                             device_reals_bytes(&packed.faces.planes));
    device_scene_free(&whole);
}

/* In float the packed planes have not all of the normals, from which boxes and bits are made. */
static void planes_of_floats_should_not_be_spent(void)
{
    small_scene_material(&small, (Material){.reflection = 0});
    small_scene_face(&small, 0, face_triangle(vec3(6, 0, 0), vec3(0, 3, -7), vec3(1, 2, 3)));
    DevicePacking how = {
        .precision = PRECISION_FLOAT, .wide = PRECISION_FLOAT, .threads = 1, .spent = {spoil_planes, &small.scene}};
    TEST_ASSERT_TRUE_MESSAGE(device_scene_pack(&packed, &small.scene, &how, &error), error.text);
    TEST_ASSERT_FALSE(isnan(small.scene.planes[0].normal.x));
}

/* Small whole numbers make flat faces, zeros of both signs and edges of length 0. */
static Vec3 grid_point(void)
{
    double x = (double)random_integer(&state, 5) - 2, y = (double)random_integer(&state, 5) - 2;
    return vec3(x, y, random_unit(&state) < 0.5 ? -0.0 : random_unit(&state) - 0.5);
}

static bool is_flat(Box box)
{
    return box.low[0] == box.high[0] || box.low[1] == box.high[1] || box.low[2] == box.high[2];
}

/* 8 at a time, from any place on: the last ones are less than 8. */
static void boxes_should_be_those_of_single_faces_bit_for_bit(void)
{
    static const int order[] = {18, 3, 7, 0, 1, 2, 4, 5, 6, 8, 17, 16, 15, 14, 13, 12, 11, 10, 9};
    enum { COUNT = sizeof order / sizeof *order };
    small_scene_material(&small, (Material){.reflection = 0});
    while (small.scene.face_count < COUNT) {
        Face face = face_triangle(grid_point(), grid_point(), grid_point());
        if (face_plane(&face).length > 0)
            small_scene_face(&small, 0, face);
    }
    DevicePacking how = {.order = order, .precision = PRECISION_DOUBLE, .wide = PRECISION_DOUBLE, .threads = 1};
    TEST_ASSERT_TRUE_MESSAGE(device_scene_pack(&packed, &small.scene, &how, &error), error.text);
    for (int i = 0; i < COUNT; i++) {
        Box box = face_box(&small.faces[order[i]], &small.planes[order[i]]);
        const float *of = packed.faces.records[i].box;
        Box got = {{of[0], of[2], of[4]}, {of[1], of[3], of[5]}};
        TEST_ASSERT_EQUAL_INT(order[i], packed.faces.records[i].index);
        TEST_ASSERT_EQUAL_MEMORY(&box, &got, sizeof box);
        TEST_ASSERT_EQUAL(is_flat(box), (packed.faces.records[i].material & FACE_FLAT) != 0);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(boxes_should_be_those_of_single_faces_bit_for_bit);
    RUN_TEST(light_position_should_travel_in_two_floats);
    RUN_TEST(normal_should_travel_in_two_floats_within_its_error);
    RUN_TEST(planes_should_be_spent_when_they_are_packed);
    RUN_TEST(planes_of_floats_should_not_be_spent);
    RUN_TEST(face_bits_should_bound_edges_and_warp);
    RUN_TEST(face_bits_should_tell_what_a_face_is);
    RUN_TEST(face_row_should_hold_the_vertices_as_they_are);
    RUN_TEST(double_rows_should_need_no_low_parts);
    RUN_TEST(scene_of_nothing_should_pack);
    return UNITY_END();
}
