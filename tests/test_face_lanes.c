/* Eight faces at a time against one by one: the same verdicts, and the same numbers to the last bit. */
#include "scene/face_lanes.h"
#include "scene/geometry.h"
#include "scene/shape.h"

#include "support/xorshift.h"
#include "unity.h"

#include <stdio.h>
#include <string.h>

void setUp(void) {}
void tearDown(void) {}

static Vec3 vertex(const FaceLanes *faces, int k, int l)
{
    return vec3(faces->x[k][l], faces->y[k][l], faces->z[k][l]);
}

static void set_vertex(FaceLanes *faces, int k, int l, Vec3 v)
{
    faces->x[k][l] = v.x;
    faces->y[k][l] = v.y;
    faces->z[k][l] = v.z;
}

static Vec3 random_vector(uint64_t *state, double size)
{
    double x = random_unit(state), y = random_unit(state), z = random_unit(state);
    return vec3_scale(size, vec3(x, y, z));
}

/* Parallelograms, somewhat spoilt: good faces, and all kinds of bad ones that differ little from them. */
static void make_face(FaceLanes *faces, int l, uint64_t *state)
{
    static const double spoils[] = {0, 0, 0, 1e-17, 1e-6, 3e-6, 2e-5, 1e-2, 1};
    double size = ldexp(1, (int)random_integer(state, 16)), spoil = spoils[random_next(state) % 9] * size;
    Vec3 at = random_vector(state, size * (random_next(state) % 4 ? 1 : 1e6)), a = random_vector(state, size);
    Vec3 b = random_next(state) % 16 ? random_vector(state, size) : vec3_scale(random_unit(state), a);
    Vec3 corners[4] = {at, vec3_add(at, a), vec3_add(vec3_add(at, a), b), vec3_add(at, b)};
    corners[random_next(state) % 4] = vec3_add(corners[random_next(state) % 4], random_vector(state, spoil));
    if (random_next(state) % 2) /* else two corners may be one */
        for (int k = 0; k < 4; k++)
            corners[k] = vec3_add(k & 1 ? vec3_add(at, k == 1 ? a : b)
                                  : k   ? vec3_add(vec3_add(at, a), b)
                                        : at,
                                  random_vector(state, spoil));
    for (int k = 0; k < 4; k++)
        set_vertex(faces, k, l, corners[k < faces->count ? k : 0]);
}

static FaceLanes make_faces(int count, uint64_t *state)
{
    FaceLanes faces = {.count = count};
    for (int l = 0; l < FACE_LANES; l++)
        make_face(&faces, l, state);
    return faces;
}

static void corners_of(const FaceLanes *faces, int l, Vec3 corners[4])
{
    for (int k = 0; k < 4; k++)
        corners[k] = vertex(faces, k, l);
}

static void shapes_should_be_good_where_shape_of_says_so(void)
{
    uint64_t state = 3;
    int good = 0, bad = 0;
    for (int i = 0; i < 20000; i++) {
        FaceLanes faces = make_faces(3 + i % 2, &state);
        unsigned doubt = face_lanes_shapes(&faces);
        for (int l = 0; l < FACE_LANES; l++) {
            Vec3 corners[4];
            corners_of(&faces, l, corners);
            bool is_good = shape_of(corners, faces.count).verdict == SHAPE_GOOD;
            TEST_ASSERT_EQUAL(!is_good, doubt >> l & 1);
            good += is_good;
            bad += !is_good;
        }
    }
    TEST_ASSERT_GREATER_THAN(1000, good);
    TEST_ASSERT_GREATER_THAN(1000, bad);
}

/* What is too large for plain arithmetic is left to a closer look, whatever it is. */
static void shapes_should_doubt_huge_coordinates(void)
{
    FaceLanes faces = {.count = 4};
    for (int l = 0; l < FACE_LANES; l++) {
        double size = l == 2 ? 1e80 : 1;
        set_vertex(&faces, 1, l, vec3(size, 0, 0));
        set_vertex(&faces, 2, l, vec3(size, size, 0));
        set_vertex(&faces, 3, l, vec3(0, size, 0));
    }
    TEST_ASSERT_EQUAL_HEX(1u << 2, face_lanes_shapes(&faces));
}

static Face face_of(const FaceLanes *faces, int l)
{
    Face face = {.vertex_count = (unsigned short)faces->count};
    for (int k = 0; k < 4; k++) {
        face.vertices[k][0] = (float)faces->x[k][l];
        face.vertices[k][1] = (float)faces->y[k][l];
        face.vertices[k][2] = (float)faces->z[k][l];
    }
    return face;
}

static void assert_same_plane(const PlaneLanes *planes, int l, Plane expected)
{
    Plane plane = {
        .normal = vec3(planes->normal[0][l], planes->normal[1][l], planes->normal[2][l]),
        .normal_low = vec3(planes->normal_low[0][l], planes->normal_low[1][l], planes->normal_low[2][l]),
        .d = planes->d[l],
        .error = planes->error[l],
        .length = planes->length[l],
    };
    TEST_ASSERT_EQUAL_MEMORY(&expected, &plane, sizeof plane);
}

static void rounded_faces_and_planes_should_have_the_same_bits(void)
{
    uint64_t state = 4;
    int good = 0, bad = 0;
    for (int i = 0; i < 20000; i++) {
        FaceLanes faces = make_faces(3 + i % 2, &state), rounded = faces;
        PlaneLanes planes;
        Vec3 centre = random_vector(&state, i % 3 ? 1 : 1e9);
        unsigned doubt = face_lanes_round(&rounded, centre, 1e12);
        TEST_ASSERT_EQUAL_HEX(0, doubt);
        doubt = face_lanes_planes(&rounded, &planes);
        for (int l = 0; l < FACE_LANES; l++) {
            Vec3 corners[4];
            Face face = face_of(&rounded, l);
            for (int k = 0; k < 4; k++) {
                Vec3 moved = vec3_sub(vertex(&faces, k, l), centre);
                TEST_ASSERT_TRUE(face.vertices[k][0] == (float)moved.x && face.vertices[k][1] == (float)moved.y &&
                                 face.vertices[k][2] == (float)moved.z);
                corners[k] = face_vertex(&face, k);
            }
            bool is_good = shape_of_rounded(corners, face.vertex_count).verdict == SHAPE_GOOD;
            TEST_ASSERT_TRUE(!is_good || !(doubt >> l & 1));
            TEST_ASSERT_TRUE(is_good || doubt >> l & 1);
            if (is_good)
                assert_same_plane(&planes, l, face_plane(&face));
            good += is_good;
            bad += !is_good;
        }
    }
    TEST_ASSERT_GREATER_THAN(1000, good);
    TEST_ASSERT_GREATER_THAN(1000, bad);
}

static void rounding_should_doubt_what_is_beyond_the_limit(void)
{
    uint64_t state = 5;
    FaceLanes faces = make_faces(4, &state);
    set_vertex(&faces, 3, 6, vec3(0, 0, -2e12));
    TEST_ASSERT_EQUAL_HEX(1u << 6, face_lanes_round(&faces, vec3(0, 0, 0), 1e12));
}

static void the_box_should_hold_every_vertex(void)
{
    uint64_t state = 6;
    FaceLanes faces = make_faces(4, &state);
    BoundLanes bounds;
    for (int l = 0; l < FACE_LANES; l++)
        for (int axis = 0; axis < 3; axis++) {
            bounds.low[axis][l] = HUGE_VAL;
            bounds.high[axis][l] = -HUGE_VAL;
        }
    face_lanes_grow(&faces, &bounds);
    for (int l = 0; l < FACE_LANES; l++)
        for (int axis = 0; axis < 3; axis++) {
            double low = HUGE_VAL, high = -HUGE_VAL;
            for (int k = 0; k < 4; k++) {
                low = fmin(low, vec3_component(vertex(&faces, k, l), axis));
                high = fmax(high, vec3_component(vertex(&faces, k, l), axis));
            }
            TEST_ASSERT_TRUE(bounds.low[axis][l] == low && bounds.high[axis][l] == high);
        }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(shapes_should_be_good_where_shape_of_says_so);
    RUN_TEST(shapes_should_doubt_huge_coordinates);
    RUN_TEST(rounded_faces_and_planes_should_have_the_same_bits);
    RUN_TEST(rounding_should_doubt_what_is_beyond_the_limit);
    RUN_TEST(the_box_should_hold_every_vertex);
    return UNITY_END();
}
