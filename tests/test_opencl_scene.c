/* The scene as the kernels get it: values that a float cannot hold travel as two, and bounds do not fall short. */
#include "opencl_scene.h"

#include "support.h"

static SmallScene small;
static DeviceScene packed;
static Error error;

void setUp(void)
{
    small_scene_begin(&small);
    error = (Error){0};
    packed = (DeviceScene){0};
}

void tearDown(void) { device_scene_free(&packed); }

static const float *floats(const Reals *reals) { return reals->data; }

/* value = NAME + NAME_LOW, to 2^-48 of it. */
static void assert_split(double value, const float *high, const float *low)
{
    TEST_ASSERT_DOUBLE_WITHIN(0x1p-48 * fabs(value), value, (double)*high + (double)*low);
}

static void light_position_should_travel_in_two_floats(void)
{
    Vec3 at = vec3(-1.6, 0.825, 4.6);
    small_scene_light(&small, at);
    TEST_ASSERT_TRUE_MESSAGE(device_scene_pack(&packed, &small.scene, NULL, NULL, 1, PRECISION_FLOAT, PRECISION_FLOAT, &error), error.text);
    const float *row = floats(&packed.lights);
    assert_split(at.x, row + LIGHT_POSITION, row + LIGHT_POSITION_LOW);
    assert_split(at.y, row + LIGHT_POSITION + 1, row + LIGHT_POSITION_LOW + 1);
    assert_split(at.z, row + LIGHT_POSITION + 2, row + LIGHT_POSITION_LOW + 2);
}

static void normal_should_travel_in_two_floats_within_its_error(void)
{
    small_scene_material(&small, (Material){.reflection = 0});
    small_scene_face(&small, 0, face_triangle(vec3(6, 0, 0), vec3(0, 3, 0), vec3(0, 0, 3)));
    TEST_ASSERT_TRUE_MESSAGE(device_scene_pack(&packed, &small.scene, NULL, NULL, 1, PRECISION_FLOAT, PRECISION_FLOAT, &error), error.text);
    const float *row = floats(&packed.planes);
    const double exact[] = {1.0 / 3, 2.0 / 3, 2.0 / 3};
    for (int axis = 0; axis < 3; axis++) {
        assert_split(exact[axis], row + PLANE_NORMAL + axis, row + PLANE_NORMAL_LOW + axis);
        double stored = (double)row[PLANE_NORMAL + axis] + (double)row[PLANE_NORMAL_LOW + axis];
        TEST_ASSERT_DOUBLE_WITHIN((double)row[PLANE_ERROR], exact[axis], stored);
    }
}

static void double_rows_should_need_no_low_parts(void)
{
    small_scene_light(&small, vec3(-1.6, 0.825, 4.6));
    TEST_ASSERT_TRUE_MESSAGE(device_scene_pack(&packed, &small.scene, NULL, NULL, 1, PRECISION_DOUBLE, PRECISION_DOUBLE, &error), error.text);
    const double *row = packed.lights.data;
    ASSERT_VEC3_WITHIN(0, -1.6, 0.825, 4.6, vec3(row[LIGHT_POSITION], row[LIGHT_POSITION + 1], row[LIGHT_POSITION + 2]));
    for (int axis = 0; axis < 3; axis++)
        TEST_ASSERT_TRUE(row[LIGHT_POSITION_LOW + axis] == 0);
}

static void scene_of_nothing_should_pack(void)
{
    TEST_ASSERT_TRUE_MESSAGE(device_scene_pack(&packed, &small.scene, NULL, NULL, 1, PRECISION_FLOAT, PRECISION_FLOAT, &error), error.text);
    TEST_ASSERT_GREATER_THAN(0, reals_bytes(&packed.lights));
    TEST_ASSERT_GREATER_THAN(0, reals_bytes(&packed.planes));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(light_position_should_travel_in_two_floats);
    RUN_TEST(normal_should_travel_in_two_floats_within_its_error);
    RUN_TEST(double_rows_should_need_no_low_parts);
    RUN_TEST(scene_of_nothing_should_pack);
    return UNITY_END();
}
