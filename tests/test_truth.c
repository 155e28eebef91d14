/* The truth about a pixel, its exact box-filtered colour, found in three ways that must agree: the double reference on
 * fine grids, the exact coverage of polygons (coverage.h), and closed forms. Every tolerance is a bound that is
 * derived: of a grid, coverage_grid_bound; of a closed form, the rounding of its formula. */
#include "reader/scene_json.h"
#include "support/coverage.h"
#include "trace/reference.h"

#include "support/assert_vec3.h"
#include "support/small_scene.h"
#include "support/xorshift.h"

#include "unity.h"

static SmallScene small;
static RenderReport report;

/* Doubles: some hundred additions of colours up to 1. */
#define ROUNDING 1e-13

void setUp(void)
{
    small_scene_begin(&small);
}
void tearDown(void) {}

/* A material that is the same everywhere, whatever the lights do: ambient shadows, and one white light. */
static int unshaded(Vec3 colour)
{
    small.scene.shading.shadow = SHADOW_AMBIENT;
    if (small.scene.light_count == 0)
        small_scene_light(&small, vec3(0, 0, 100));
    return small_scene_material(&small, (Material){.ambient = colour});
}

static Vec3 reference_at(const Scene *scene, int column, int row, int grid)
{
    Scene fine = *scene;
    fine.grid = grid;
    return reference_pixel(&(Tracer){.scene = &fine, .report = &report}, column, row);
}

/* The exact colour of a pixel of unshaded faces; *contrast receives how much its colours differ. */
static Vec3 exact_at(const Scene *scene, int column, int row, int *lines, double *contrast)
{
    Coverage coverage = coverage_of_pixel(scene, column, row);
    Vec3 low = scene->shading.background, high = low, sum = vec3_scale(coverage.background, low);
    for (int i = 0; i < scene->face_count; i++) {
        Vec3 colour = scene->materials[scene->faces[i].material].ambient;
        sum = vec3_add(sum, vec3_scale(coverage.face[i], colour));
        low = vec3(fmin(low.x, colour.x), fmin(low.y, colour.y), fmin(low.z, colour.z));
        high = vec3(fmax(high.x, colour.x), fmax(high.y, colour.y), fmax(high.z, colour.z));
    }
    *lines = coverage.lines;
    *contrast = fmax(high.x - low.x, fmax(high.y - low.y, high.z - low.z));
    return sum;
}

/* --- Closed forms --- */

/* A white face over the left half of the pixel. */
static void half_covered_pixel_should_be_half_as_bright(void)
{
    small_scene_face(&small, unshaded(vec3(1, 1, 1)), face_at_height(-4, -4, 0, 4, 0));
    Coverage coverage = coverage_of_pixel(&small.scene, 0, 0);
    TEST_ASSERT_EQUAL_DOUBLE(0.5, coverage.face[0]);
    TEST_ASSERT_EQUAL_DOUBLE(0.5, coverage.background);
    TEST_ASSERT_EQUAL_INT(1, coverage.lines);
    for (int n = 2; n <= 64; n *= 2)
        ASSERT_VEC3_WITHIN(0, 0.5, 0.5, 0.5, reference_at(&small.scene, 0, 0, n));
    /* An odd grid has a column of rays on the edge itself, which belongs to the face. */
    for (int n = 1; n <= 63; n += 2)
        TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.5 + 0.5 / n, reference_at(&small.scene, 0, 0, n).x);
}

static double squared_if_positive(double x)
{
    return x > 0 ? x * x : 0;
}

/* The area of the unit square where a x + b y <= c, for a, b > 0: the triangle under the line, less what of it is
 * beyond the square's right and upper side, and what both take away. */
static double half_plane_area(double a, double b, double c)
{
    double area = squared_if_positive(c) - squared_if_positive(c - a) - squared_if_positive(c - b) +
                  squared_if_positive(c - a - b);
    return area / (2 * a * b);
}

/* The pixel is [-1, 1]^2 at z = 0. The face's edge goes through `through` at the angle, the face is on its left. */
static void add_half_plane(Vec3 through, double angle)
{
    Vec3 along = vec3_scale(8, vec3(cos(angle), sin(angle), 0)), left = vec3(-along.y, along.x, 0);
    Vec3 a = vec3_sub(through, along), b = vec3_add(through, along);
    small_scene_face(&small, unshaded(vec3(1, 1, 1)), face_quad(a, b, vec3_add(b, left), vec3_add(a, left)));
}

/* The share of the pixel on the left of the edge from vertex 0 to vertex 1 as they were rounded. */
static double left_of_edge(const Face *face)
{
    Vec3 p = face_vertex(face, 0), e = vec3_sub(face_vertex(face, 1), p);
    /* Left: e.x (y - p.y) - e.y (x - p.x) >= 0. With x = 2 u - 1, y = 2 v - 1: a u + b v <= c. */
    double a = 2 * e.y, b = -2 * e.x, c = e.y * (1 + p.x) - e.x * (1 + p.y);
    if (a < 0) { /* u -> 1 - u */
        c -= a;
        a = -a;
    }
    if (b < 0) {
        c -= b;
        b = -b;
    }
    return half_plane_area(a, b, c);
}

static void edge_at_any_angle_should_cut_off_its_half_plane(void)
{
    enum { ANGLES = 90, GRID = 256 };
    uint64_t seed = 7;
    for (int i = 0; i < ANGLES; i++) {
        small_scene_begin(&small);
        Vec3 through = vec3(random_unit(&seed), random_unit(&seed), 0);
        add_half_plane(through, (i + 0.37) * 2 * 3.14159265358979 / ANGLES);
        double closed = left_of_edge(&small.faces[0]);
        Coverage coverage = coverage_of_pixel(&small.scene, 0, 0);
        /* The closed form divides squares of up to 32^2 by 2ab, and a, b >= 32 sin(0.37 degrees). */
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, closed, coverage.face[0]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-15, 1 - coverage.face[0], coverage.background);
        double bound = coverage_grid_bound(coverage.lines, GRID) + ROUNDING;
        TEST_ASSERT_DOUBLE_WITHIN(bound, closed, reference_at(&small.scene, 0, 0, GRID).x);
    }
}

/* A grid is the same turned by half a turn about the pixel's centre. One that is not misses edges to one side, by less
 * than a bound for any edge can tell. */
static void half_a_turn_should_change_no_pixel(void)
{
    uint64_t seed = 9;
    for (int n = 1; n <= 16; n++)
        for (int i = 0; i < 16; i++) {
            small_scene_begin(&small);
            add_half_plane(vec3(random_unit(&seed), random_unit(&seed), 0), 6.28 * random_unit(&seed));
            Vec3 colour = reference_at(&small.scene, 0, 0, n);
            for (int k = 0; k < 8; k++)
                small.faces[0].vertices[k / 2][k % 2] *= -1;
            TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, colour.x, reference_at(&small.scene, 0, 0, n).x);
        }
}

/* --- Coverage against the reference --- */

/* A parallelogram of random place, size, tilt and colour; its corners are multiples of 1/64, hence in one plane. */
static void add_card(uint64_t *seed)
{
    Vec3 v[3];
    for (int i = 0; i < 3; i++)
        v[i] = vec3((double)random_integer(seed, 96) / 64, (double)random_integer(seed, 96) / 64,
                    (double)random_integer(seed, 64) / 64);
    Vec3 centre = vec3_sub(v[0], vec3(0, 0, 1.5)), a = v[1], b = v[2];
    Vec3 sum = vec3_add(a, b), difference = vec3_sub(a, b);
    Face face = face_quad(vec3_sub(centre, sum), vec3_add(centre, difference), vec3_add(centre, sum),
                          vec3_sub(centre, difference));
    if (face_plane(&face).length == 0)
        return;
    face.one_sided = random_next(seed) % 4 == 0;
    small_scene_face(&small, unshaded(vec3(fabs(random_unit(seed)), fabs(random_unit(seed)), fabs(random_unit(seed)))),
                     face);
}

static void deal_cards(uint64_t seed, int cards)
{
    small_scene_begin(&small);
    small.scene.screen.columns = 6;
    small.scene.screen.rows = 5;
    small.scene.shading.background = vec3(0.3, 0.6, 0.9);
    for (int i = 0; i < cards; i++)
        add_card(&seed);
}

static void shares_should_add_up_to_the_pixel(void)
{
    deal_cards(11, 12);
    for (int i = 0; i < 30; i++) {
        Coverage coverage = coverage_of_pixel(&small.scene, i % 6, i / 6);
        double sum = coverage.background;
        for (int k = 0; k < small.scene.face_count; k++)
            sum += coverage.face[k];
        TEST_ASSERT_DOUBLE_WITHIN(1e-15 * 13, 1, sum);
    }
}

/* Cards stand before, behind and through one another, some behind the eye. */
static void pixels_should_hold_what_is_seen_of_each_face(void)
{
    const int grids[] = {1, 4, 16, 64};
    for (uint64_t seed = 1; seed <= 4; seed++) {
        deal_cards(seed, 10);
        for (int i = 0; i < 30; i++) {
            int lines;
            double contrast;
            Vec3 exact = exact_at(&small.scene, i % 6, i / 6, &lines, &contrast);
            for (int g = 0; g < 4; g++) {
                double bound = contrast * coverage_grid_bound(lines, grids[g]) + ROUNDING;
                ASSERT_VEC3_WITHIN(bound, exact.x, exact.y, exact.z,
                                   reference_at(&small.scene, i % 6, i / 6, grids[g]));
            }
        }
    }
}

static void of_two_faces_in_one_plane_the_first_should_be_seen(void)
{
    small_scene_face(&small, unshaded(vec3(1, 0, 0)), face_at_height(-1, -1, 0, 1, 0));
    small_scene_face(&small, unshaded(vec3(0, 1, 0)), face_at_height(-1, -1, 1, 0, 0));
    Coverage coverage = coverage_of_pixel(&small.scene, 0, 0);
    TEST_ASSERT_EQUAL_DOUBLE(0.5, coverage.face[0]);
    TEST_ASSERT_EQUAL_DOUBLE(0.25, coverage.face[1]);
    TEST_ASSERT_EQUAL_DOUBLE(0.25, coverage.background);
    ASSERT_VEC3_WITHIN(0, 0.5, 0.25, 0, reference_at(&small.scene, 0, 0, 64));
}

/* --- Facing mirrors --- */

/* Unfolded, a ray that meets k mirrors passes through their images 0 ... k - 1, rectangles in planes ever farther away,
 * so that the pixel is a sum over images: the share of it that sees image k, times what one more hit adds to the
 * colour. */
static void facing_mirrors_should_add_up_their_images(void)
{
    const double q = 0.75;
    const Vec3 mirrors[2] = {{0.02, 0.10, 0.22}, {0.30, 0.13, 0.04}}, sky = {0.93, 0.90, 0.82}; /* left, right */
    enum { COLUMNS = 16, ROWS = 9, GRID = 64 };
    static Error error;
    Scene scene;
    TEST_ASSERT_TRUE_MESSAGE(scene_load(&scene, "scenes/mirrors.json", &error), error.text);
    scene.screen.columns = COLUMNS;
    scene.screen.rows = ROWS;
    for (int pixel = 0; pixel < COLUMNS * ROWS; pixel += 5) {
        Vec3 exact = sky;
        double bound = 1e-6; /* mirrors at 1.3 are rounded to float32, 5e-8 off, some pixels of 0.1 wide */
        for (int side = -1; side <= 1; side += 2) {
            double weight = 1;
            for (int k = 0; k <= scene.shading.max_bounces; k++, weight *= q) {
                double x = side * (2 * k + 1);
                Face image = face_quad(vec3(x, -1.3, -9), vec3(x, -1.3, 1), vec3(x, 1.3, 1), vec3(x, 1.3, -9));
                for (int v = 0; v < 4; v++)
                    face_set_vertex(&image, v, vec3_sub(face_vertex(&image, v), scene.centre));
                Scene one = scene;
                one.faces = &image;
                one.face_count = 1;
                Coverage coverage = coverage_of_pixel(&one, pixel % COLUMNS, pixel / COLUMNS);
                double sky_after = k < scene.shading.max_bounces ? q * weight : 0; /* the last hit ends the path */
                Vec3 mirror = mirrors[(side > 0) ^ (k & 1)];
                Vec3 step = vec3_add(vec3_scale(weight, mirror), vec3_scale(sky_after - weight, sky));
                exact = vec3_add(exact, vec3_scale(coverage.face[0], step));
                double largest = fmax(fabs(step.x), fmax(fabs(step.y), fabs(step.z)));
                bound += largest * coverage_grid_bound(coverage.lines, GRID);
            }
        }
        ASSERT_VEC3_WITHIN(bound, exact.x, exact.y, exact.z,
                           reference_at(&scene, pixel % COLUMNS, pixel / COLUMNS, GRID));
    }
    scene_free(&scene);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(half_covered_pixel_should_be_half_as_bright);
    RUN_TEST(edge_at_any_angle_should_cut_off_its_half_plane);
    RUN_TEST(half_a_turn_should_change_no_pixel);
    RUN_TEST(shares_should_add_up_to_the_pixel);
    RUN_TEST(pixels_should_hold_what_is_seen_of_each_face);
    RUN_TEST(of_two_faces_in_one_plane_the_first_should_be_seen);
    RUN_TEST(facing_mirrors_should_add_up_their_images);
    return UNITY_END();
}
