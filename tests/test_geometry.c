/* The formulas of tracing, on planes and rays whose answers can be written down. */
#include "scene/geometry.h"

#include "support/assert_vec3.h"
#include "support/small_scene.h"
#include "support/xorshift.h"

#include "unity.h"

void setUp(void) {}
void tearDown(void) {}

static FaceTest test_ray(Face face, Vec3 origin, Vec3 direction)
{
    Plane plane = face_plane(&face);
    return face_test(&face, &plane, (Ray){origin, direction}, HUGE_VAL, true);
}

static FaceTest test_segment(Face face, Vec3 from, Vec3 to)
{
    Plane plane = face_plane(&face);
    return face_test_segment(&face, &plane, from, to, true);
}

/* The unit square at z = 0, its normal +z. */
static Face unit_square(void)
{
    return face_at_height(0, 0, 1, 1, 0);
}

/* x + 2 y + 2 z = 6, cut out where it meets the axes: N = (1, 2, 2) / 3, D = -2. */
static Face slanted_triangle(void)
{
    return face_triangle(vec3(6, 0, 0), vec3(0, 3, 0), vec3(0, 0, 3));
}

/* A planar face (triangles always are) in no special position, of floats. */
static Face random_triangle(uint64_t *state)
{
    Vec3 v[3];
    for (int i = 0; i < 3; i++)
        v[i] = vec3(random_unit(state), random_unit(state), random_unit(state));
    return face_triangle(v[0], v[1], v[2]);
}

/* --- The screen --- */

static View view_from(int columns, int rows, int grid)
{
    Scene scene = {
        .camera = {.position = {1, 2, 3}, .look_at = {1, 2, 0}, .up = {0, 1, 0}},
        .screen = {.columns = columns, .rows = rows, .distance = 2, .width = 8, .height = 4},
        .grid = grid,
    };
    return view_of(&scene);
}

static void view_should_span_the_screen_by_the_camera(void)
{
    View view = view_from(4, 2, 1);
    ASSERT_VEC3_WITHIN(0, 1, 2, 3, view.eye);
    ASSERT_VEC3_WITHIN(0, 0, 0, -2, view.forward);
    ASSERT_VEC3_WITHIN(0, 1, 0, 0, view.right);
    ASSERT_VEC3_WITHIN(0, 0, 1, 0, view.up);
}

static void view_should_make_up_square_to_the_gaze(void)
{
    Scene scene = {
        .camera = {.position = {0, 0, 0}, .look_at = {0, 5, -5}, .up = {0, 1, 0}},
        .screen = {.columns = 1, .rows = 1, .distance = 1, .width = 1},
        .grid = 1,
    };
    View view = view_of(&scene);
    double half = sqrt(0.5);
    ASSERT_VEC3_WITHIN(1e-15, 0, half, -half, view.forward);
    ASSERT_VEC3_WITHIN(1e-15, 1, 0, 0, view.right);
    ASSERT_VEC3_WITHIN(1e-15, 0, half, half, view.up);
}

static void view_should_have_square_pixels_where_no_height_is_given(void)
{
    Scene scene = {
        .camera = {.position = {0, 0, 1}, .up = {0, 1, 0}},
        .screen = {.columns = 640, .rows = 480, .distance = 1, .width = 2},
        .grid = 1,
    };
    TEST_ASSERT_EQUAL_DOUBLE(1.5, view_of(&scene).height);
}

static void ray_should_go_through_the_pixel_centre(void)
{
    View view = view_from(4, 2, 1); /* pixels of 2 x 2 */
    ASSERT_VEC3_WITHIN(0, -3, 1, -2, view_direction(&view, 0, 0, 0, 0));
    ASSERT_VEC3_WITHIN(0, 3, 1, -2, view_direction(&view, 3, 0, 0, 0));
    ASSERT_VEC3_WITHIN(0, -3, -1, -2, view_direction(&view, 0, 1, 0, 0));
    ASSERT_VEC3_WITHIN(0, 1, -1, -2, view_direction(&view, 2, 1, 0, 0));
}

static void centre_pixel_of_odd_sizes_should_look_straight_ahead(void)
{
    const int sizes[][2] = {{1, 1}, {3, 5}, {97, 61}, {16383, 1}};
    for (int k = 0; k < 4; k++) {
        View view = view_from(sizes[k][0], sizes[k][1], 1);
        ASSERT_VEC3_WITHIN(1e-15, 0, 0, -2, view_direction(&view, sizes[k][0] / 2, sizes[k][1] / 2, 0, 0));
    }
}

static void corner_pixels_should_lie_half_a_pixel_inside_the_screen(void)
{
    View view = view_from(61, 47, 1);
    Vec3 first = view_direction(&view, 0, 0, 0, 0), last = view_direction(&view, 60, 46, 0, 0);
    ASSERT_VEC3_WITHIN(1e-14, -4 + 4.0 / 61, 2 - 2.0 / 47, -2, first);
    ASSERT_VEC3_WITHIN(1e-14, 4 - 4.0 / 61, -2 + 2.0 / 47, -2, last);
}

static void grid_should_divide_the_pixel_evenly(void)
{
    View view = view_from(4, 2, 2); /* sub-pixels of 1 x 1 */
    ASSERT_VEC3_WITHIN(0, -3.5, 1.5, -2, view_direction(&view, 0, 0, 0, 0));
    ASSERT_VEC3_WITHIN(0, -2.5, 1.5, -2, view_direction(&view, 0, 0, 1, 0));
    ASSERT_VEC3_WITHIN(0, -3.5, 0.5, -2, view_direction(&view, 0, 0, 0, 1));
    view = view_from(4, 2, 3);
    ASSERT_VEC3_WITHIN(1e-15, -3, 1, -2, view_direction(&view, 0, 0, 1, 1));
}

/* --- Planes --- */

static void plane_should_follow_the_right_hand_rule(void)
{
    Face face = face_at_height(0, 0, 1, 1, 5);
    Plane plane = face_plane(&face);
    ASSERT_VEC3_WITHIN(0, 0, 0, 1, plane.normal);
    TEST_ASSERT_EQUAL_DOUBLE(-5, plane.d);
}

static void plane_should_turn_with_the_winding(void)
{
    Face face = face_quad(vec3(0, 1, 5), vec3(1, 1, 5), vec3(1, 0, 5), vec3(0, 0, 5));
    Plane plane = face_plane(&face);
    ASSERT_VEC3_WITHIN(0, 0, 0, -1, plane.normal);
    TEST_ASSERT_EQUAL_DOUBLE(5, plane.d);
}

static void plane_should_solve_the_triangle(void)
{
    Face face = slanted_triangle();
    Plane plane = face_plane(&face);
    ASSERT_VEC3_WITHIN(1e-15, 1.0 / 3, 2.0 / 3, 2.0 / 3, plane.normal);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, -2, plane.d);
}

static void plane_should_not_depend_on_which_vertex_is_first(void)
{
    Face quad = face_quad(vec3(0, 0, 0), vec3(4, 0, 4), vec3(4, 3, 4), vec3(0, 3, 0)); /* z = x */
    for (int first = 0; first < 4; first++) {
        Face face = face_quad(face_vertex(&quad, first), face_vertex(&quad, (first + 1) % 4),
                              face_vertex(&quad, (first + 2) % 4), face_vertex(&quad, (first + 3) % 4));
        ASSERT_VEC3_WITHIN(1e-15, -sqrt(0.5), 0, sqrt(0.5), face_plane(&face).normal);
    }
}

static void plane_should_have_a_unit_normal_at_any_size(void)
{
    const double sizes[] = {1e-12, 1e-3, 1, 1e6, 1e12};
    for (int k = 0; k < 5; k++) {
        double s = sizes[k];
        Face face = face_triangle(vec3(6 * s, 0, 0), vec3(0, 3 * s, 0), vec3(0, 0, 3 * s));
        Plane plane = face_plane(&face);
        ASSERT_VEC3_WITHIN(1e-6, 1.0 / 3, 2.0 / 3, 2.0 / 3, plane.normal);
        TEST_ASSERT_DOUBLE_WITHIN(1e-15, 1, vec3_length(plane.normal));
    }
}

static void plane_of_a_face_without_area_should_have_no_normal(void)
{
    Face face = face_triangle(vec3(0, 0, 0), vec3(1, 2, 3), vec3(2, 4, 6));
    ASSERT_VEC3_WITHIN(0, 0, 0, 0, face_plane(&face).normal);
}

static void plane_side_should_be_exact_at_the_face_itself(void)
{
    uint64_t state = 11;
    int off_in_doubles = 0;
    for (int i = 0; i < 1000; i++) {
        Face face = random_triangle(&state);
        Plane plane = face_plane(&face);
        for (int k = 0; k < 3; k++) {
            Vec3 a = face_vertex(&face, k), b = face_vertex(&face, (k + 1) % 3);
            Vec3 middle = vec3_scale(0.5, vec3_add(a, b));
            TEST_ASSERT_EQUAL_INT(0, plane_side(&face, &plane, a));
            TEST_ASSERT_EQUAL_INT(0, plane_side(&face, &plane, middle));
            off_in_doubles += vec3_dot(plane.normal, middle) + plane.d != 0;
        }
    }
    TEST_ASSERT_GREATER_THAN(1000, off_in_doubles);
}

static void plane_side_should_tell_neighbouring_doubles_apart(void)
{
    Face face = unit_square();
    Plane plane = face_plane(&face);
    TEST_ASSERT_EQUAL_INT(1, plane_side(&face, &plane, vec3(0.3, 0.3, 0x1p-1000)));
    TEST_ASSERT_EQUAL_INT(0, plane_side(&face, &plane, vec3(7, 7, 0)));
    TEST_ASSERT_EQUAL_INT(-1, plane_side(&face, &plane, vec3(0.3, 0.3, -0x1p-1000)));
    face = slanted_triangle();
    plane = face_plane(&face);
    TEST_ASSERT_EQUAL_INT(0, plane_side(&face, &plane, vec3(2, 1, 1)));
    TEST_ASSERT_EQUAL_INT(1, plane_side(&face, &plane, vec3(2, 1, nextafter(1, 2))));
    TEST_ASSERT_EQUAL_INT(-1, plane_side(&face, &plane, vec3(nextafter(2, 0), 1, 1)));
}

/* --- The plane hit --- */

static void plane_hit_should_measure_t_in_lengths_of_the_direction(void)
{
    FaceTest test = test_ray(unit_square(), vec3(0.5, 0.5, 4), vec3(0, 0, -1));
    TEST_ASSERT_EQUAL_INT(FACE_INSIDE, test.verdict);
    TEST_ASSERT_TRUE(test.n_dot_r == -1 && test.n_dot_o_plus_d == 4 && test.t == 4);
    test = test_ray(unit_square(), vec3(0.5, 0.5, 4), vec3(0, 0, -8));
    TEST_ASSERT_TRUE(test.n_dot_r == -8 && test.n_dot_o_plus_d == 4 && test.t == 0.5);
}

/* x + 2 y + 2 z = 6 from (-1, -1, -1) along (1, 1, 1): -5 + 5 t = 6. */
static void plane_hit_should_solve_the_slanted_plane(void)
{
    FaceTest test = test_ray(slanted_triangle(), vec3(-1, -1, -1), vec3(1, 1, 1));
    TEST_ASSERT_EQUAL_INT(FACE_INSIDE, test.verdict);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 5.0 / 3, test.n_dot_r);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, -11.0 / 3, test.n_dot_o_plus_d);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 2.2, test.t);
}

static void plane_hit_should_reject_parallel_ray(void)
{
    FaceTest test = test_ray(unit_square(), vec3(0.5, 0.5, 1), vec3(1, 1, 0));
    TEST_ASSERT_EQUAL_INT(FACE_PARALLEL, test.verdict);
    TEST_ASSERT_TRUE(test.n_dot_r == 0 && test.edges == 0);
}

static void plane_hit_should_reject_ray_in_the_plane(void)
{
    TEST_ASSERT_EQUAL_INT(FACE_PARALLEL, test_ray(unit_square(), vec3(-1, 0.5, 0), vec3(1, 0, 0)).verdict);
    TEST_ASSERT_EQUAL_INT(FACE_PARALLEL,
                          test_ray(unit_square(), vec3(-1, 0, 0), vec3(1, 0, 0)).verdict); /* along an edge */
    TEST_ASSERT_EQUAL_INT(FACE_PARALLEL, test_ray(unit_square(), vec3(0.5, 0.5, -0.0), vec3(-0.0, 1, -0.0)).verdict);
}

/* A side of the face is parallel to it, whatever rounding makes of N.R. */
static void plane_hit_should_find_slanted_parallels_exactly(void)
{
    uint64_t state = 5;
    int off_in_doubles = 0;
    for (int i = 0; i < 1000; i++) {
        Face face = random_triangle(&state);
        Plane plane = face_plane(&face);
        for (int k = 0; k < 3; k++) {
            Vec3 side = vec3_sub(face_vertex(&face, (k + 1) % 3), face_vertex(&face, k));
            TEST_ASSERT_EQUAL_INT(FACE_PARALLEL, test_ray(face, vec3(2, 3, 4), side).verdict);
            off_in_doubles += vec3_dot(plane.normal, side) != 0;
        }
    }
    TEST_ASSERT_GREATER_THAN(1000, off_in_doubles);
}

static void plane_hit_should_accept_the_smallest_slope(void)
{
    FaceTest test = test_ray(face_at_height(-1e6, -1e6, 1e6, 1e6, 0), vec3(0, 0, 0x1p-40), vec3(1, 0, -0x1p-50));
    TEST_ASSERT_EQUAL_INT(FACE_INSIDE, test.verdict);
    TEST_ASSERT_TRUE(test.t == 1024);
}

static void plane_hit_should_reject_planes_behind(void)
{
    TEST_ASSERT_EQUAL_INT(FACE_BEHIND, test_ray(unit_square(), vec3(0.5, 0.5, 1), vec3(0, 0, 1)).verdict);
    TEST_ASSERT_EQUAL_INT(FACE_BEHIND, test_ray(unit_square(), vec3(0.5, 0.5, -1), vec3(0.1, 0, -1)).verdict);
}

/* t = 0 is not in front. */
static void plane_hit_should_reject_an_origin_in_the_plane(void)
{
    TEST_ASSERT_EQUAL_INT(FACE_BEHIND, test_ray(unit_square(), vec3(0.5, 0.5, 0), vec3(0, 0, 1)).verdict);
    TEST_ASSERT_EQUAL_INT(FACE_BEHIND, test_ray(unit_square(), vec3(0.5, 0.5, 0), vec3(0, 0, -1)).verdict);
    TEST_ASSERT_EQUAL_INT(FACE_BEHIND, test_ray(slanted_triangle(), vec3(2, 1, 1), vec3(1, 0, 0)).verdict);
}

static void plane_hit_should_accept_the_least_distance_ahead(void)
{
    FaceTest test = test_ray(unit_square(), vec3(0.5, 0.5, 0x1p-1000), vec3(0, 0, -1));
    TEST_ASSERT_EQUAL_INT(FACE_INSIDE, test.verdict);
    TEST_ASSERT_TRUE(test.t == 0x1p-1000);
}

static void plane_hit_should_include_its_limit(void)
{
    Face face = unit_square();
    Plane plane = face_plane(&face);
    Ray ray = {vec3(0.5, 0.5, 2), vec3(0, 0, -1)};
    TEST_ASSERT_EQUAL_INT(FACE_INSIDE, face_test(&face, &plane, ray, 2, false).verdict);
    TEST_ASSERT_EQUAL_INT(FACE_FARTHER, face_test(&face, &plane, ray, nextafter(2, 0), false).verdict);
}

static void one_sided_face_should_pass_rays_from_behind(void)
{
    Face face = unit_square();
    face.one_sided = 1;
    TEST_ASSERT_EQUAL_INT(FACE_INSIDE, test_ray(face, vec3(0.5, 0.5, 1), vec3(0, 0, -1)).verdict);
    TEST_ASSERT_EQUAL_INT(FACE_BACK, test_ray(face, vec3(0.5, 0.5, -1), vec3(0, 0, 1)).verdict);
    face.one_sided = 0;
    TEST_ASSERT_EQUAL_INT(FACE_INSIDE, test_ray(face, vec3(0.5, 0.5, -1), vec3(0, 0, 1)).verdict);
}

/* --- The inside test --- */

/* For the unit square dot(N, cross(e, c)) is the distance to each edge: y, 1 - x, 1 - y, x. */
static void edge_values_should_be_the_distances_in_a_unit_square(void)
{
    for (int side = -1; side <= 1; side += 2) {
        FaceTest test = test_ray(unit_square(), vec3(0.25, 0.125, 2 * side), vec3(0, 0, -4 * side));
        const double expected[] = {0.125, 0.75, 0.875, 0.25};
        TEST_ASSERT_EQUAL_INT(4, test.edges);
        for (int k = 0; k < 4; k++) {
            TEST_ASSERT_EQUAL_DOUBLE(expected[k], test.edge_value[k]);
            TEST_ASSERT_EQUAL_INT(1, test.edge_sign[k]);
        }
        TEST_ASSERT_EQUAL_INT(-1, test.outside_edge);
    }
}

static void each_edge_should_reject_what_lies_beyond_it(void)
{
    const double beyond[4][2] = {{0.5, -0.25}, {1.25, 0.5}, {0.5, 1.25}, {-0.25, 0.5}};
    for (int k = 0; k < 4; k++) {
        FaceTest test = test_ray(unit_square(), vec3(beyond[k][0], beyond[k][1], 1), vec3(0, 0, -1));
        TEST_ASSERT_EQUAL_INT(FACE_OUTSIDE, test.verdict);
        TEST_ASSERT_EQUAL_INT(k, test.outside_edge);
        for (int edge = 0; edge < 4; edge++)
            TEST_ASSERT_EQUAL_INT(edge == k ? -1 : 1, test.edge_sign[edge]);
        TEST_ASSERT_EQUAL_DOUBLE(-0.25, test.edge_value[k]);
    }
}

static void each_edge_of_a_triangle_should_reject_what_lies_beyond_it(void)
{
    Face face = face_triangle(vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0));
    const double beyond[3][2] = {{0.25, -0.25}, {0.75, 0.75}, {-0.25, 0.25}};
    for (int k = 0; k < 3; k++) {
        FaceTest test = test_ray(face, vec3(beyond[k][0], beyond[k][1], 1), vec3(0, 0, -1));
        TEST_ASSERT_EQUAL_INT(FACE_OUTSIDE, test.verdict);
        TEST_ASSERT_EQUAL_INT(k, test.outside_edge);
        TEST_ASSERT_EQUAL_INT(3, test.edges);
    }
    TEST_ASSERT_EQUAL_INT(FACE_INSIDE, test_ray(face, vec3(0.25, 0.25, 1), vec3(0, 0, -1)).verdict);
}

static void point_on_an_edge_should_be_inside(void)
{
    const double on[4][2] = {{0.3, 0}, {1, 0.3}, {0.3, 1}, {0, 0.3}};
    for (int k = 0; k < 4; k++) {
        FaceTest test = test_ray(unit_square(), vec3(on[k][0], on[k][1], 1), vec3(0, 0, -1));
        TEST_ASSERT_EQUAL_INT(FACE_INSIDE, test.verdict);
        TEST_ASSERT_EQUAL_INT(0, test.edge_sign[k]);
    }
}

static void vertex_should_be_inside(void)
{
    for (int k = 0; k < 4; k++) {
        Face face = unit_square();
        Vec3 v = face_vertex(&face, k);
        FaceTest test = test_ray(face, vec3(v.x, v.y, 1), vec3(0, 0, -1));
        TEST_ASSERT_EQUAL_INT(FACE_INSIDE, test.verdict);
        TEST_ASSERT_EQUAL_INT(0, test.edge_sign[k]);
        TEST_ASSERT_EQUAL_INT(0, test.edge_sign[(k + 3) % 4]);
    }
}

static void point_one_ulp_beyond_an_edge_should_be_outside(void)
{
    Face face = unit_square();
    TEST_ASSERT_EQUAL_INT(FACE_OUTSIDE, test_ray(face, vec3(nextafter(1, 2), 0.3, 1), vec3(0, 0, -1)).verdict);
    TEST_ASSERT_EQUAL_INT(FACE_OUTSIDE, test_ray(face, vec3(-0x1p-1000, 0.3, 1), vec3(0, 0, -1)).verdict);
    TEST_ASSERT_EQUAL_INT(FACE_INSIDE, test_ray(face, vec3(nextafter(1, 0), 0.3, 1), vec3(0, 0, -1)).verdict);
    /* The same by a tilt of the ray that no hit point could show. */
    TEST_ASSERT_EQUAL_INT(FACE_OUTSIDE, test_ray(face, vec3(1, 0.3, 1), vec3(0x1p-90, 0, -1)).verdict);
    TEST_ASSERT_EQUAL_INT(FACE_INSIDE, test_ray(face, vec3(1, 0.3, 1), vec3(-0x1p-90, 0, -1)).verdict);
}

/* Rays of doubles straight at the vertices and the middles of the sides of triangles of floats. */
static void rays_aimed_at_slanted_edges_should_hit_them_exactly(void)
{
    uint64_t state = 31;
    for (int i = 0; i < 1000; i++) {
        Face face = random_triangle(&state);
        Vec3 origin = vec3(3 + random_unit(&state), random_unit(&state), 4 * random_unit(&state));
        for (int k = 0; k < 3; k++) {
            Vec3 a = face_vertex(&face, k), b = face_vertex(&face, (k + 1) % 3);
            FaceTest at_vertex = test_ray(face, origin, vec3_sub(a, origin));
            FaceTest at_middle = test_ray(face, origin, vec3_sub(vec3_scale(0.5, vec3_add(a, b)), origin));
            TEST_ASSERT_EQUAL_INT(FACE_INSIDE, at_vertex.verdict);
            TEST_ASSERT_EQUAL_INT(0, at_vertex.edge_sign[k]);
            TEST_ASSERT_EQUAL_INT(FACE_INSIDE, at_middle.verdict);
            TEST_ASSERT_EQUAL_INT(0, at_middle.edge_sign[k]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1, at_vertex.t);
        }
    }
}

static void winding_should_not_change_the_hit(void)
{
    Face face = slanted_triangle(),
         turned = face_triangle(face_vertex(&face, 2), face_vertex(&face, 1), face_vertex(&face, 0));
    uint64_t state = 3;
    int inside = 0;
    for (int i = 0; i < 1000; i++) {
        Vec3 origin = vec3(-1, -1, -1),
             target = vec3(6 * random_unit(&state), 3 * random_unit(&state), 3 * random_unit(&state));
        FaceTest a = test_ray(face, origin, vec3_sub(target, origin)),
                 b = test_ray(turned, origin, vec3_sub(target, origin));
        TEST_ASSERT_EQUAL_INT(a.verdict, b.verdict);
        TEST_ASSERT_EQUAL_DOUBLE(a.t, b.t);
        TEST_ASSERT_DOUBLE_WITHIN(1e-14, a.n_dot_r, -b.n_dot_r);
        inside += a.verdict == FACE_INSIDE;
    }
    TEST_ASSERT_INT_WITHIN(400, 500, inside);
}

static void edges_should_only_be_evaluated_where_they_matter(void)
{
    Face face = unit_square();
    Plane plane = face_plane(&face);
    Ray outside = {vec3(0.5, -0.25, 1), vec3(0, 0, -1)}, behind = {vec3(0.5, 0.5, 1), vec3(0, 0, 1)};
    TEST_ASSERT_EQUAL_INT(1, face_test(&face, &plane, outside, HUGE_VAL, false).edges);
    TEST_ASSERT_EQUAL_INT(4, face_test(&face, &plane, outside, HUGE_VAL, true).edges);
    TEST_ASSERT_EQUAL_INT(0, face_test(&face, &plane, behind, HUGE_VAL, false).edges);
    TEST_ASSERT_EQUAL_INT(4, face_test(&face, &plane, behind, HUGE_VAL, true).edges);
}

/* --- Segments: what stands between a point and a light --- */

static void segment_should_meet_only_what_is_strictly_between_its_ends(void)
{
    const struct {
        double from, to;
        FaceVerdict verdict;
    } cases[] = {
        {1, -1, FACE_INSIDE},         {-1, 1, FACE_INSIDE},
        {0x1p-1000, -1, FACE_INSIDE}, {1, -0x1p-1000, FACE_INSIDE},
        {0, 1, FACE_BEHIND},          {0, -1, FACE_BEHIND}, /* starts in the plane */
        {1, 2, FACE_BEHIND},          {-1, -3, FACE_BEHIND},
        {1, 0, FACE_FARTHER},         {-1, 0, FACE_FARTHER}, /* ends in the plane: the light on the face */
        {2, 1, FACE_FARTHER},         {-3, -0x1p-1000, FACE_FARTHER},
        {1, 1, FACE_PARALLEL},        {0, 0, FACE_PARALLEL},
    };
    for (int i = 0; i < (int)(sizeof cases / sizeof cases[0]); i++) {
        FaceTest test = test_segment(unit_square(), vec3(0.5, 0.25, cases[i].from), vec3(0.5, 0.25, cases[i].to));
        TEST_ASSERT_EQUAL_INT_MESSAGE(cases[i].verdict, test.verdict, "see the table");
    }
}

static void segment_should_measure_t_from_0_to_1(void)
{
    FaceTest test = test_segment(unit_square(), vec3(0, 0, 3), vec3(1, 1, -1));
    TEST_ASSERT_EQUAL_INT(FACE_INSIDE, test.verdict);
    TEST_ASSERT_EQUAL_DOUBLE(0.75, test.t);
    TEST_ASSERT_EQUAL_DOUBLE(1.25, test_segment(unit_square(), vec3(0, 0, 5), vec3(0, 0, 1)).t);
}

static void segment_should_pass_beside_and_touch_edges(void)
{
    TEST_ASSERT_EQUAL_INT(FACE_OUTSIDE, test_segment(unit_square(), vec3(1.5, 0.5, 1), vec3(1.5, 0.5, -1)).verdict);
    TEST_ASSERT_EQUAL_INT(FACE_INSIDE, test_segment(unit_square(), vec3(2, 0.5, 1), vec3(0, 0.5, -1)).verdict);
    TEST_ASSERT_EQUAL_INT(FACE_OUTSIDE,
                          test_segment(unit_square(), vec3(nextafter(2, 3), 0.5, 1), vec3(0, 0.5, -1)).verdict);
    TEST_ASSERT_EQUAL_INT(FACE_INSIDE,
                          test_segment(unit_square(), vec3(2, 2, 1), vec3(0, 0, -1)).verdict); /* a vertex */
}

/* An end that no double can be subtracted from without rounding. */
static void segment_should_be_exact_between_distant_ends(void)
{
    Vec3 from = vec3(1 + 0x1p-52, 0.5, 1), to = vec3(1 + 0x1p-52, 0.5, -0x1p60);
    TEST_ASSERT_EQUAL_INT(FACE_OUTSIDE, test_segment(unit_square(), from, to).verdict);
    from.x = to.x = 1;
    TEST_ASSERT_EQUAL_INT(FACE_INSIDE, test_segment(unit_square(), from, to).verdict);
    /* x = 1 + 2^-52 at z = 1 and 1 - 2^-53 at z = -1: more than 1 at z = 0. */
    TEST_ASSERT_EQUAL_INT(FACE_OUTSIDE,
                          test_segment(unit_square(), vec3(1 + 0x1p-52, 0.5, 1), vec3(1 - 0x1p-53, 0.5, -1)).verdict);
    TEST_ASSERT_EQUAL_INT(FACE_INSIDE,
                          test_segment(unit_square(), vec3(1 + 0x1p-52, 0.5, 1), vec3(1 - 0x1p-52, 0.5, -1)).verdict);
}

static void segment_should_pass_one_sided_faces_from_behind(void)
{
    Face face = unit_square();
    face.one_sided = 1;
    TEST_ASSERT_EQUAL_INT(FACE_INSIDE, test_segment(face, vec3(0.5, 0.5, 1), vec3(0.5, 0.5, -1)).verdict);
    TEST_ASSERT_EQUAL_INT(FACE_BACK, test_segment(face, vec3(0.5, 0.5, -1), vec3(0.5, 0.5, 1)).verdict);
}

/* --- The shifted point --- */

static void shifted_point_should_lie_on_its_side_and_near(void)
{
    uint64_t state = 17;
    const double offsets[] = {0, 1e3, 1e6};
    int unshifted_wrong = 0;
    for (int i = 0; i < 3000; i++) {
        double offset = offsets[i % 3];
        Face face = random_triangle(&state);
        for (int k = 0; k < 4; k++)
            for (int axis = 0; axis < 3; axis++)
                face.vertices[k][axis] = (float)((double)face.vertices[k][axis] + offset);
        Plane plane = face_plane(&face);
        if (plane.normal.x == 0 && plane.normal.y == 0 && plane.normal.z == 0)
            continue; /* so far out floats may leave no area */
        double u = fabs(random_unit(&state)), v = fabs(random_unit(&state));
        Vec3 a = face_vertex(&face, 0), b = face_vertex(&face, 1), c = face_vertex(&face, 2);
        Vec3 point = vec3_add(a, vec3_add(vec3_scale(u, vec3_sub(b, a)), vec3_scale(v, vec3_sub(c, a))));
        Vec3 back = vec3_negate(plane.normal);
        Vec3 above = point_shifted(&face, &plane, plane.normal, point),
             below = point_shifted(&face, &plane, back, point);
        TEST_ASSERT_EQUAL_INT(1, plane_side(&face, &plane, above));
        TEST_ASSERT_EQUAL_INT(-1, plane_side(&face, &plane, below));
        double size = 1 + 2 * offset;
        TEST_ASSERT_DOUBLE_WITHIN(3e-14 * size, 0, vec3_length(vec3_sub(above, point)));
        TEST_ASSERT_DOUBLE_WITHIN(3e-14 * size, 0, vec3_length(vec3_sub(below, point)));
        unshifted_wrong += plane_side(&face, &plane, point) <= 0;
    }
    TEST_ASSERT_GREATER_THAN(1000, unshifted_wrong);
}

static void shifted_point_should_mend_a_point_on_the_wrong_side(void)
{
    Face face = unit_square();
    Plane plane = face_plane(&face);
    Vec3 shifted = point_shifted(&face, &plane, plane.normal, vec3(0.5, 0.5, -1e-12));
    TEST_ASSERT_TRUE(shifted.z > 0 && shifted.z < 1e-14);
    TEST_ASSERT_TRUE(shifted.x == 0.5 && shifted.y == 0.5);
    shifted = point_shifted(&face, &plane, plane.normal, vec3(0, 0, 0));
    TEST_ASSERT_TRUE(shifted.z > 0 && shifted.z < 1e-14);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(view_should_span_the_screen_by_the_camera);
    RUN_TEST(view_should_make_up_square_to_the_gaze);
    RUN_TEST(view_should_have_square_pixels_where_no_height_is_given);
    RUN_TEST(ray_should_go_through_the_pixel_centre);
    RUN_TEST(centre_pixel_of_odd_sizes_should_look_straight_ahead);
    RUN_TEST(corner_pixels_should_lie_half_a_pixel_inside_the_screen);
    RUN_TEST(grid_should_divide_the_pixel_evenly);
    RUN_TEST(plane_should_follow_the_right_hand_rule);
    RUN_TEST(plane_should_turn_with_the_winding);
    RUN_TEST(plane_should_solve_the_triangle);
    RUN_TEST(plane_should_not_depend_on_which_vertex_is_first);
    RUN_TEST(plane_should_have_a_unit_normal_at_any_size);
    RUN_TEST(plane_of_a_face_without_area_should_have_no_normal);
    RUN_TEST(plane_side_should_be_exact_at_the_face_itself);
    RUN_TEST(plane_side_should_tell_neighbouring_doubles_apart);
    RUN_TEST(plane_hit_should_measure_t_in_lengths_of_the_direction);
    RUN_TEST(plane_hit_should_solve_the_slanted_plane);
    RUN_TEST(plane_hit_should_reject_parallel_ray);
    RUN_TEST(plane_hit_should_reject_ray_in_the_plane);
    RUN_TEST(plane_hit_should_find_slanted_parallels_exactly);
    RUN_TEST(plane_hit_should_accept_the_smallest_slope);
    RUN_TEST(plane_hit_should_reject_planes_behind);
    RUN_TEST(plane_hit_should_reject_an_origin_in_the_plane);
    RUN_TEST(plane_hit_should_accept_the_least_distance_ahead);
    RUN_TEST(plane_hit_should_include_its_limit);
    RUN_TEST(one_sided_face_should_pass_rays_from_behind);
    RUN_TEST(edge_values_should_be_the_distances_in_a_unit_square);
    RUN_TEST(each_edge_should_reject_what_lies_beyond_it);
    RUN_TEST(each_edge_of_a_triangle_should_reject_what_lies_beyond_it);
    RUN_TEST(point_on_an_edge_should_be_inside);
    RUN_TEST(vertex_should_be_inside);
    RUN_TEST(point_one_ulp_beyond_an_edge_should_be_outside);
    RUN_TEST(rays_aimed_at_slanted_edges_should_hit_them_exactly);
    RUN_TEST(winding_should_not_change_the_hit);
    RUN_TEST(edges_should_only_be_evaluated_where_they_matter);
    RUN_TEST(segment_should_meet_only_what_is_strictly_between_its_ends);
    RUN_TEST(segment_should_measure_t_from_0_to_1);
    RUN_TEST(segment_should_pass_beside_and_touch_edges);
    RUN_TEST(segment_should_be_exact_between_distant_ends);
    RUN_TEST(segment_should_pass_one_sided_faces_from_behind);
    RUN_TEST(shifted_point_should_lie_on_its_side_and_near);
    RUN_TEST(shifted_point_should_mend_a_point_on_the_wrong_side);
    return UNITY_END();
}
