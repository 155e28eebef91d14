/* Faces of any number of vertices in scenes: their pieces, and what is left out of them. By exact coverage their
 * pictures are those of the whole polygons. */
#include "reader/scene_build.h"
#include "scene/geometry.h"
#include "support/coverage.h"
#include "support/random_polygon.h"
#include "support/small_scene.h"
#include "support/xorshift.h"
#include "trace/reference.h"

#include "unity.h"

#include <stdlib.h>
#include <string.h>

static Scene scene;
static Error error;
static SceneBuild build;

void setUp(void)
{
    scene = (Scene){.camera = {.position = {0, 0, 9}, .look_at = {0, 0, 0}, .up = {0, 1, 0}}};
    error = (Error){.kind = ERROR_NONE};
    build = (SceneBuild){.scene = &scene, .error = &error, .path = "a.json"};
    TEST_ASSERT_EQUAL(0, scene_build_material(&build, (Material){.name = "m", .ambient = {1, 1, 1}}));
}

void tearDown(void)
{
    scene_build_free(&build);
    scene_free(&scene);
}

static void begin(SceneBuildObject object, const Vec3 *points, int count)
{
    object.transform = transform_identity();
    TEST_ASSERT_TRUE(scene_build_object(&build, "object", object));
    for (int i = 0; i < count; i++)
        TEST_ASSERT_TRUE(scene_build_point(&build, points[i]));
}

static const Vec3 arrow[5] = {{-1, 0, 0}, {0, 0.5, 0}, {1, 0, 0}, {0, 2, 0}, {-1, 0, 0}};

static void pieces_should_share_the_number_and_the_next_face_have_another(void)
{
    begin((SceneBuildObject){.one_sided = true}, arrow, 5);
    TEST_ASSERT_TRUE(scene_build_face(&build, (const int[]){0, 1, 2, 3}, 4, -1, 0));
    TEST_ASSERT_TRUE(scene_build_face(&build, (const int[]){0, 1, 3}, 3, -1, 1) && scene_build_finish(&build));
    TEST_ASSERT_EQUAL(3, scene.face_count);
    TEST_ASSERT_EQUAL(0, scene.faces[0].number);
    TEST_ASSERT_EQUAL(0, scene.faces[1].number);
    TEST_ASSERT_EQUAL(1, scene.faces[2].number);
    TEST_ASSERT_EQUAL(1, scene.faces[1].one_sided);
    TEST_ASSERT_EQUAL(3, scene.objects[0].face_count);
    TEST_ASSERT_TRUE(scene.planes[0].normal.z > 0 && scene.planes[1].normal.z > 0);
}

static void what_has_no_area_should_be_an_error_unless_it_is_skipped(void)
{
    begin((SceneBuildObject){.material = 0}, arrow, 5);
    TEST_ASSERT_FALSE(scene_build_face(&build, (const int[]){0, 1, 2, 3, 4}, 5, -1, 0));
    TEST_ASSERT_EQUAL_STRING("vertices 0 and 4 of the face are the same point", build.reason);
    TEST_ASSERT_FALSE(scene_build_face(&build, (const int[]){0, 1, 0, 2}, 4, -1, 0));
    TEST_ASSERT_EQUAL_STRING("the face uses vertex 0 twice", build.reason);
    begin((SceneBuildObject){.skip = true}, arrow, 5);
    TEST_ASSERT_TRUE(scene_build_face(&build, (const int[]){0, 1, 0, 2}, 4, -1, 0));
    TEST_ASSERT_TRUE(scene_build_face(&build, (const int[]){0, 1, 2, 3, 4}, 5, -1, 1));
    TEST_ASSERT_EQUAL(2, build.face_count);
    TEST_ASSERT_EQUAL(1, build.faces[0].number); /* face 0 is left out */
    TEST_ASSERT_EQUAL(2, scene.notes.count);
    TEST_ASSERT_EQUAL_STRING("a.json", scene.notes.items[0].path);
    TEST_ASSERT_EQUAL_STRING("objects[1].faces[0]", scene.notes.items[0].places[0].detail);
}

/* Three objects; the middle one loses the face that is far too small, where its model may. */
static void build_with_a_speck(bool skip)
{
    static const Vec3 points[7] = {{-5e4, 0, 0}, {5e4, 0, 0},      {0, 5e4, 0},
                                   {4e4, 1, 0},  {4e4, 1.0001, 0}, {4e4 + 1e-4, 1, 0}};
    begin((SceneBuildObject){.material = 0}, points, 3);
    TEST_ASSERT_TRUE(scene_build_face(&build, (const int[]){0, 1, 2}, 3, -1, 0));
    begin((SceneBuildObject){.skip = skip}, points, 6);
    TEST_ASSERT_TRUE(scene_build_model(&build, "m.obj") && scene_build_part(&build, "speck"));
    TEST_ASSERT_TRUE(scene_build_face(&build, (const int[]){3, 4, 5}, 3, -1, 7));
    TEST_ASSERT_TRUE(scene_build_part(&build, "large"));
    TEST_ASSERT_TRUE(scene_build_face(&build, (const int[]){0, 2, 1}, 3, -1, 8));
    begin((SceneBuildObject){.material = 0}, points, 3);
    TEST_ASSERT_TRUE(scene_build_face(&build, (const int[]){0, 1, 2}, 3, -1, 0));
}

static void a_face_that_rounding_takes_should_leave_no_gap(void)
{
    build_with_a_speck(true);
    TEST_ASSERT_TRUE(scene_build_finish(&build));
    TEST_ASSERT_EQUAL(3, scene.face_count);
    static const int numbers[] = {0, 2, 3};
    for (int i = 0; i < 3; i++) {
        TEST_ASSERT_EQUAL(numbers[i], scene.faces[i].number);
        TEST_ASSERT_EQUAL(i, scene.faces[i].object);
        TEST_ASSERT_EQUAL(i, scene.objects[i].first_face);
        TEST_ASSERT_EQUAL(1, scene.objects[i].face_count);
        TEST_ASSERT_TRUE(scene.planes[i].length > 1e9);
    }
    TEST_ASSERT_EQUAL(1, scene.part_count); /* the speck's has no face left */
    TEST_ASSERT_EQUAL_STRING("large", scene_part_of(&scene, 1));
    TEST_ASSERT_NULL(scene_part_of(&scene, 2));
    TEST_ASSERT_EQUAL(1, scene.objects[1].first_number);
    TEST_ASSERT_EQUAL_STRING("too-small", scene.notes.items[0].kind->name);
    TEST_ASSERT_EQUAL_STRING("m.obj", scene.notes.items[0].path);
    TEST_ASSERT_EQUAL(7, scene.notes.items[0].places[0].line);
}

static void a_face_that_rounding_takes_should_be_an_error_where_nothing_is_skipped(void)
{
    build_with_a_speck(false);
    TEST_ASSERT_FALSE(scene_build_finish(&build));
    TEST_ASSERT_EQUAL(7, build.fault->place);
    TEST_ASSERT_NOT_NULL(strstr(build.reason, "too small"));
}

/* In a square of 1e5, vertices 3 and 4 round to one point: the triangle at them goes, or a quad becomes a triangle. */
static void a_piece_that_rounding_takes_should_go_silently(void)
{
    const Vec3 points[6] = {{-5e4, 0, 0},  {5e4, 0, 0},          {5e4, 5e4, 0},
                            {4e4, 4e4, 0}, {4e4 - 1e-5, 4e4, 0}, {-5e4, 5e4, 0}};
    double area = 0;
    begin((SceneBuildObject){.material = 0}, points, 6);
    TEST_ASSERT_TRUE(scene_build_face(&build, (const int[]){0, 1, 2, 3, 4, 5}, 6, -1, 0) && scene_build_finish(&build));
    for (int i = 0; i < scene.face_count; i++)
        area += scene.planes[i].length / 2;
    TEST_ASSERT_DOUBLE_WITHIN(1e5, 1e5 * 5e4 - 1e5 * 1e4 / 2, area);
    TEST_ASSERT_EQUAL(0, scene.notes.count);
}

/* A quad two of whose vertices round to one point. */
static bool build_pointed(bool skip)
{
    const Vec3 points[4] = {{-5e4, 0, 0}, {5e4, 0, 0}, {4e4, 4e4, 0}, {4e4 - 1e-5, 4e4, 0}};
    begin((SceneBuildObject){.skip = skip}, points, 4);
    return scene_build_face(&build, (const int[]){0, 1, 2, 3}, 4, -1, 0) && scene_build_finish(&build);
}

static void a_quad_of_a_model_should_keep_the_triangle_that_rounding_leaves(void)
{
    TEST_ASSERT_TRUE(build_pointed(true));
    TEST_ASSERT_EQUAL(1, scene.face_count);
    TEST_ASSERT_EQUAL(3, scene.faces[0].vertex_count);
    TEST_ASSERT_EQUAL_MEMORY(scene.faces[0].vertices[0], scene.faces[0].vertices[3], sizeof scene.faces[0].vertices[0]);
}

static void a_quad_that_rounding_changes_should_be_an_error_where_nothing_is_skipped(void)
{
    TEST_ASSERT_FALSE(build_pointed(false));
    TEST_ASSERT_NOT_NULL(strstr(build.reason, "too small"));
}

/* --- Pictures --- */

enum { WIDTH = 4 };

/* One face over the whole screen of WIDTH x WIDTH pixels, which is a unit wide; slanted, so that it is seen in
 * perspective. */
static void build_polygon(const GridPolygon *p)
{
    int corners[GRID_POLYGON_MAX];
    begin((SceneBuildObject){.material = 0}, NULL, 0);
    for (int i = 0; i < p->count; i++) {
        double x = (double)p->x[i] / GRID_POLYGON_SIZE - 0.5, y = (double)p->y[i] / GRID_POLYGON_SIZE - 0.5;
        TEST_ASSERT_TRUE(scene_build_point(&build, vec3(x, y, 0.25 * x)));
        corners[i] = i;
    }
    TEST_ASSERT_TRUE(scene_build_face(&build, corners, p->count, -1, 0) && scene_build_finish(&build));
    scene.camera.position = vec3_sub(vec3(0, 0, 1), scene.centre);
    scene.camera.look_at = vec3_sub(vec3(0, 0, 0), scene.centre);
    scene.screen = (Screen){.columns = WIDTH, .rows = WIDTH, .distance = 1, .width = 1};
    scene.lights = calloc(1, sizeof *scene.lights);
    scene.lights[0] = (Light){{0, 0, 100}, {1, 1, 1}, {0, 0, 0}, {0, 0, 0}};
    scene.light_count = 1;
    scene.shading.shadow = SHADOW_AMBIENT;
    scene.grid = 1;
}

/* The polygon's share of a pixel, from its rounded vertices alone: each triangle with vertex 0 counts with the sense in
 * which it turns. */
static double share_of_polygon(int vertices, int column, int row)
{
    SmallScene small;
    double sum = 0;
    Vec3 rounded[GRID_POLYGON_MAX];
    for (int i = 0; i < vertices; i++) {
        Face face;
        face_set_vertex(&face, 0, vec3_sub(build.points[i], scene.centre));
        rounded[i] = face_vertex(&face, 0);
    }
    for (int i = 2; i < vertices; i++) {
        Vec3 normal = vec3_cross(vec3_sub(rounded[i - 1], rounded[0]), vec3_sub(rounded[i], rounded[0]));
        if (normal.z == 0)
            continue;
        small_scene_begin(&small);
        small.scene.camera = scene.camera;
        small.scene.screen = scene.screen;
        small.faces[0] = face_quad(rounded[0], rounded[i - 1], rounded[i], rounded[0]);
        small.faces[0].vertex_count = 3;
        small.scene.face_count = 1;
        double share = coverage_of_pixel(&small.scene, column, row).face[0];
        sum += normal.z > 0 ? share : -share;
    }
    return fabs(sum);
}

static void assert_pixel(int vertices, int column, int row)
{
    enum { GRID = 12 };
    double exact = share_of_polygon(vertices, column, row);
    Coverage coverage = coverage_of_pixel(&scene, column, row);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 1 - exact, coverage.background);
    Scene fine = scene;
    RenderReport report = {0};
    fine.grid = GRID;
    double seen = reference_pixel(&(Tracer){.scene = &fine, .report = &report}, column, row).x;
    TEST_ASSERT_DOUBLE_WITHIN(coverage_grid_bound(coverage.lines, GRID) + 1e-6, exact, seen);
}

static void the_picture_of_a_cut_polygon_should_be_the_polygon_s(void)
{
    uint64_t random = 7;
    static const GridPolygonKind kinds[] = {GRID_CONVEX, GRID_STAR, GRID_KNOT, GRID_COARSE};
    int cases = getenv("RECTRAY_SOAK") ? 400 : 40, seen = 0;
    while (seen < cases) {
        GridPolygon p = grid_polygon(kinds[seen % 4], &random);
        if (p.count > 24 || grid_polygon_crosses(&p) || grid_polygon_touches(&p))
            continue;
        tearDown();
        setUp();
        build_polygon(&p);
        for (int pixel = seen % 3; pixel < WIDTH * WIDTH; pixel += 3)
            assert_pixel(p.count, pixel % WIDTH, pixel / WIDTH);
        seen++;
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(pieces_should_share_the_number_and_the_next_face_have_another);
    RUN_TEST(what_has_no_area_should_be_an_error_unless_it_is_skipped);
    RUN_TEST(a_face_that_rounding_takes_should_leave_no_gap);
    RUN_TEST(a_face_that_rounding_takes_should_be_an_error_where_nothing_is_skipped);
    RUN_TEST(a_piece_that_rounding_takes_should_go_silently);
    RUN_TEST(a_quad_of_a_model_should_keep_the_triangle_that_rounding_leaves);
    RUN_TEST(a_quad_that_rounding_changes_should_be_an_error_where_nothing_is_skipped);
    RUN_TEST(the_picture_of_a_cut_polygon_should_be_the_polygon_s);
    return UNITY_END();
}
