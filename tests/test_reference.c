/* The reference tracer on scenes so small that their colours are known in closed form. */
#include "trace/reference.h"

#include "support/assert_vec3.h"
#include "support/small_scene.h"

#include "unity.h"

#include <string.h>

#define EXACT 1e-14

static SmallScene small;
static RenderReport report;

/* Counts and keeps the events of a pixel. */
enum { KEPT_MAX = 2048 };
static Event kept[KEPT_MAX];
static int kept_count;

static void keep(void *user, const Event *event)
{
    (void)user;
    TEST_ASSERT_LESS_THAN(KEPT_MAX, kept_count);
    kept[kept_count++] = *event;
}

static const Recorder recorder = {keep, NULL};

/* The n-th event of a kind, from 0; fails when there are fewer. */
static const Event *event_of(EventKind kind, int n)
{
    for (int i = 0; i < kept_count; i++)
        if (kept[i].kind == kind && n-- == 0)
            return &kept[i];
    TEST_FAIL_MESSAGE("fewer events of that kind than expected");
    return NULL;
}

static int events_of(EventKind kind)
{
    int count = 0;
    for (int i = 0; i < kept_count; i++)
        count += kept[i].kind == kind;
    return count;
}

/* The colour of the scene's only pixel; events and counts are those of this pixel. */
static Vec3 pixel(void)
{
    kept_count = 0;
    report = (RenderReport){0};
    return reference_pixel(&(Tracer){.scene = &small.scene, .report = &report, .recorder = &recorder}, 0, 0);
}

static PathEnd path_end(void)
{
    return event_of(EVENT_PATH_END, 0)->as.path_end.reason;
}

/* ambient 1/8, diffuse 1/4, specular 1/2, each in its own colour. */
static Material matt(void)
{
    return (Material){.ambient = {0.125, 0, 0}, .diffuse = {0, 0.25, 0}, .specular = {0, 0, 0.5}, .shininess = 8};
}

static Material glow(double ambient, double reflection)
{
    return (Material){.ambient = {ambient, ambient, ambient}, .reflection = reflection};
}

/* A floor of 4 x 4 at z = 0 below the camera, in the material number 0. */
static void add_floor(Material material)
{
    small_scene_face(&small, small_scene_material(&small, material), face_at_height(-2, -2, 2, 2, 0));
}

void setUp(void)
{
    small_scene_begin(&small);
}
void tearDown(void) {}

/* --- Illumination --- */

static void light_in_front_should_add_all_three_terms(void)
{
    add_floor(matt());
    small_scene_light(&small, vec3(0, 0, 2)); /* L = V = H = N */
    ASSERT_VEC3_WITHIN(EXACT, 0.125, 0.25, 0.5, pixel());
    TEST_ASSERT_EQUAL_UINT64(1, report.rays.primary);
    TEST_ASSERT_EQUAL_UINT64(1, report.rays.shadow);
    TEST_ASSERT_EQUAL_UINT64(0, report.rays.reflection);
    TEST_ASSERT_EQUAL_INT(PATH_NOT_MIRROR, path_end());
}

/* L is 60 degrees from N: L.N = 1/2; H is 30 degrees from it: (N.H)^(8/4) = 3/4. */
static void slanting_light_should_add_by_its_angle(void)
{
    add_floor(matt());
    small_scene_light(&small, vec3(sqrt(3), 0, 1));
    ASSERT_VEC3_WITHIN(EXACT, 0.125, 0.125, 0.375, pixel());
}

static void distance_should_not_dim_a_light(void)
{
    add_floor(matt());
    small_scene_light(&small, vec3(0, 0, 1e9));
    ASSERT_VEC3_WITHIN(EXACT, 0.125, 0.25, 0.5, pixel());
}

static void lights_should_add_up(void)
{
    add_floor(matt());
    small_scene_light(&small, vec3(0, 0, 2));
    small_scene_light(&small, vec3(sqrt(3), 0, 1));
    small_scene_light(&small, vec3(0, 0, -2)); /* behind: nothing */
    ASSERT_VEC3_WITHIN(EXACT, 0.25, 0.375, 0.875, pixel());
}

static void face_seen_from_behind_should_be_lit_from_behind(void)
{
    small_scene_face(&small, small_scene_material(&small, matt()),
                     face_quad(vec3(-2, 2, 0), vec3(2, 2, 0), vec3(2, -2, 0), vec3(-2, -2, 0))); /* normal -z */
    small_scene_light(&small, vec3(0, 0, 2));
    ASSERT_VEC3_WITHIN(EXACT, 0.125, 0.25, 0.5, pixel());
    ASSERT_VEC3_WITHIN(0, 0, 0, 1, event_of(EVENT_HIT, 0)->as.hit.normal);
}

static void scene_without_lights_should_be_black(void)
{
    add_floor(matt());
    ASSERT_VEC3_WITHIN(0, 0, 0, 0, pixel());
    TEST_ASSERT_EQUAL_INT(PATH_IN_SHADOW, path_end());
}

/* --- Which face is seen --- */

static void nearest_face_should_be_seen_wherever_it_stands_in_the_file(void)
{
    const double heights[3][3] = {{0, 0.25, 0.5}, {0.5, 0, 0.25}, {0.25, 0.5, 0}};
    for (int order = 0; order < 3; order++) {
        small_scene_begin(&small);
        small_scene_light(&small, vec3(0, 0, 2));
        for (int i = 0; i < 3; i++)
            small_scene_face(&small, small_scene_material(&small, glow(heights[order][i], 0)),
                             face_at_height(-1, -1, 1, 1, heights[order][i]));
        ASSERT_VEC3_WITHIN(EXACT, 0.5, 0.5, 0.5, pixel());
    }
}

static void tie_should_go_to_the_first_face_in_the_file(void)
{
    small_scene_light(&small, vec3(0, 0, 2));
    for (int i = 1; i <= 3; i++) /* the same plane, other outlines */
        small_scene_face(&small, small_scene_material(&small, glow(i, 0)), face_at_height(-i, -i, 1, 1, 0));
    ASSERT_VEC3_WITHIN(EXACT, 1, 1, 1, pixel());
    TEST_ASSERT_EQUAL_INT(0, event_of(EVENT_HIT, 0)->as.hit.face);
}

static void shared_edge_should_belong_to_the_first_face_in_the_file(void)
{
    small_scene_light(&small, vec3(0, 0, 2));
    small_scene_face(&small, small_scene_material(&small, glow(0.5, 0)), face_at_height(0, -1, 1, 1, 0));
    small_scene_face(&small, small_scene_material(&small, glow(0.25, 0)), face_at_height(-1, -1, 0, 1, 0));
    ASSERT_VEC3_WITHIN(EXACT, 0.5, 0.5, 0.5, pixel());
}

static void one_sided_face_should_be_seen_through_from_behind(void)
{
    add_floor(glow(0.25, 0));
    Face *veil = small_scene_face(&small, small_scene_material(&small, glow(1, 0)),
                                  face_quad(vec3(-1, 1, 0.5), vec3(1, 1, 0.5), vec3(1, -1, 0.5), vec3(-1, -1, 0.5)));
    small_scene_light(&small, vec3(0, 0, 2));
    ASSERT_VEC3_WITHIN(EXACT, 1, 1, 1, pixel());
    veil->one_sided = 1; /* for the shadow ray, which meets its front, it is still there */
    ASSERT_VEC3_WITHIN(0, 0, 0, 0, pixel());
    TEST_ASSERT_EQUAL_INT(0, event_of(EVENT_HIT, 0)->as.hit.face);
    TEST_ASSERT_EQUAL_INT(1, event_of(EVENT_LIGHT_END, 0)->as.light_end.blocker);
}

static void miss_should_show_the_background(void)
{
    small.scene.shading.background = vec3(0.25, 0.5, 2);
    ASSERT_VEC3_WITHIN(0, 0.25, 0.5, 2, pixel());
    TEST_ASSERT_EQUAL_INT(PATH_MISSED, path_end());
    TEST_ASSERT_EQUAL_UINT8(255, event_of(EVENT_PIXEL, 0)->as.pixel.rgb[2]);
}

static void nearest_should_leave_out_the_face_to_skip(void)
{
    add_floor(matt());
    small_scene_face(&small, 0, face_at_height(-1, -1, 1, 1, 0.5));
    Ray ray = {vec3(0, 0, 1), vec3(0, 0, -2)};
    CastHit hit = reference_nearest(&(Tracer){.scene = &small.scene, .report = &report}, ray, -1);
    TEST_ASSERT_TRUE(hit.face == 1 && hit.t == 0.25);
    hit = reference_nearest(&(Tracer){.scene = &small.scene, .report = &report}, ray, 1);
    TEST_ASSERT_TRUE(hit.face == 0 && hit.t == 0.5);
    hit =
        reference_nearest(&(Tracer){.scene = &small.scene, .report = &report}, (Ray){vec3(0, 0, 1), vec3(0, 0, 1)}, -1);
    TEST_ASSERT_EQUAL_INT(-1, hit.face);
}

/* --- Shadows --- */

static void light_behind_the_face_should_leave_it_black_without_a_ray(void)
{
    add_floor(matt());
    small_scene_light(&small, vec3(0, 0, -2));
    ASSERT_VEC3_WITHIN(0, 0, 0, 0, pixel());
    TEST_ASSERT_EQUAL_UINT64(0, report.rays.shadow);
    TEST_ASSERT_EQUAL_UINT64(1, report.skipped[SKIP_LIGHT_BEHIND]);
    TEST_ASSERT_EQUAL_INT(LIGHT_BEHIND_FACE, event_of(EVENT_LIGHT_END, 0)->as.light_end.verdict);
}

static void light_in_the_plane_should_leave_the_face_black_without_a_ray(void)
{
    add_floor(matt());
    small_scene_light(&small, vec3(1, 1, 0));
    small_scene_light(&small, vec3(9, 0, 0));
    small_scene_light(&small, vec3(0, 0, 0)); /* at the very point */
    ASSERT_VEC3_WITHIN(0, 0, 0, 0, pixel());
    TEST_ASSERT_EQUAL_UINT64(0, report.rays.shadow);
    TEST_ASSERT_EQUAL_UINT64(3, report.skipped[SKIP_LIGHT_BEHIND]);
}

static void light_just_above_the_plane_should_reach_the_face(void)
{
    add_floor(glow(0.5, 0));
    small_scene_light(&small, vec3(1, 1, 1e-9));
    ASSERT_VEC3_WITHIN(EXACT, 0.5, 0.5, 0.5, pixel());
}

/* A camera from the side, so that what hangs over the floor's centre does not hide it. */
static void look_from_the_side(void)
{
    small.scene.camera.position = vec3(1.5, 0, 1);
}

static bool is_lit(void)
{
    Vec3 colour = pixel();
    TEST_ASSERT_EQUAL_INT(0, event_of(EVENT_HIT, 0)->as.hit.face);
    TEST_ASSERT_TRUE(colour.x == 0 || colour.x == 0.5);
    return colour.x == 0.5;
}

static void only_occluders_between_point_and_light_should_shadow(void)
{
    const struct {
        double height;
        bool lit;
    } cases[] = {{-1, true},        {-1e-9, true},      {0.5, false},
                 {1, false},        {1.9999999, false}, {2, true}, /* the light lies on it */
                 {2.0000005, true}, {3, true}};
    for (int i = 0; i < (int)(sizeof cases / sizeof cases[0]); i++) {
        small_scene_begin(&small);
        look_from_the_side();
        add_floor(glow(0.5, 0));
        small_scene_light(&small, vec3(0, 0, 2));
        small_scene_face(&small, 0, face_at_height(-0.01, -0.01, 0.01, 0.01, cases[i].height));
        TEST_ASSERT_EQUAL_INT(cases[i].lit, is_lit());
    }
}

/* It stands upright, 2^-40 behind the point as the camera sees it. */
static void occluder_next_to_the_point_should_shadow(void)
{
    look_from_the_side();
    add_floor(glow(0.5, 0));
    small_scene_light(&small, vec3(-1, 0, 2));
    double x = -0x1p-40;
    small_scene_face(&small, 0, face_quad(vec3(x, -1, -1), vec3(x, 1, -1), vec3(x, 1, 1), vec3(x, -1, 1)));
    TEST_ASSERT_FALSE(is_lit());
    small.scene.lights[0].position.x = 1;
    TEST_ASSERT_TRUE(is_lit());
}

static void occluder_should_shadow_up_to_its_edge(void)
{
    look_from_the_side();
    add_floor(glow(0.5, 0));
    small_scene_light(&small, vec3(0, 0, 2));
    /* The ray runs along its edge. */
    Face *occluder = small_scene_face(&small, 0, face_at_height(0, -0.5, 0.5, 0.5, 1));
    TEST_ASSERT_FALSE(is_lit());
    *occluder = face_at_height(0x1p-100, -0.5, 0.5, 0.5, 1);
    TEST_ASSERT_TRUE(is_lit());
}

static void occluder_in_the_plane_of_the_shadow_ray_should_not_shadow(void)
{
    look_from_the_side();
    add_floor(glow(0.5, 0));
    small_scene_light(&small, vec3(0, 0, 2));
    small_scene_face(&small, 0, face_quad(vec3(0, 0, 0.5), vec3(0, 1, 0.5), vec3(0, 1, 1), vec3(0, 0, 1)));
    TEST_ASSERT_TRUE(is_lit());
}

static void one_sided_occluder_should_shadow_by_its_side(void)
{
    look_from_the_side();
    add_floor(glow(0.5, 0));
    small_scene_light(&small, vec3(0, 0, 2));
    /* Its front is up, the ray comes from below. */
    Face *occluder = small_scene_face(&small, 0, face_at_height(-0.1, -0.1, 0.1, 0.1, 1));
    TEST_ASSERT_FALSE(is_lit());
    occluder->one_sided = 1;
    TEST_ASSERT_TRUE(is_lit());
    Face turned = face_quad(vec3(-1, 1, 1), vec3(1, 1, 1), vec3(1, -1, 1), vec3(-1, -1, 1));
    small_scene_face(&small, 0, turned)->one_sided = 1;
    TEST_ASSERT_FALSE(is_lit());
}

static void blocker_should_be_the_first_in_the_file(void)
{
    look_from_the_side();
    add_floor(glow(0.5, 0));
    small_scene_light(&small, vec3(0, 0, 2));
    small_scene_face(&small, 0, face_at_height(-0.1, -0.1, 0.1, 0.1, 1.5));
    small_scene_face(&small, 0, face_at_height(-0.1, -0.1, 0.1, 0.1, 1));
    TEST_ASSERT_FALSE(is_lit());
    TEST_ASSERT_EQUAL_INT(1, event_of(EVENT_LIGHT_END, 0)->as.light_end.blocker);
    TEST_ASSERT_EQUAL_INT(LIGHT_BLOCKED, event_of(EVENT_LIGHT_END, 0)->as.light_end.verdict);
}

/* A slanted face, far from the origin, in a light that grazes it: no point is in the face's own shadow. */
static void face_should_never_shadow_itself(void)
{
    Vec3 c = vec3(1000.3, -2000.7, 3000.9);
    Face face = {.vertex_count = 3};
    face_set_vertex(&face, 0, c);
    face_set_vertex(&face, 1, vec3_add(c, vec3(5, 1, 0.3)));
    face_set_vertex(&face, 2, vec3_add(c, vec3(1, 6, 0.7)));
    face_set_vertex(&face, 3, c);
    small_scene_face(&small, small_scene_material(&small, glow(1, 0)), face);
    Vec3 middle = vec3_add(c, vec3(2, 2.3, 1.0 / 3));
    small.scene.camera = (Camera){vec3_add(middle, vec3(0, 0, 4)), middle, {0, 1, 0}};
    small.scene.screen = (Screen){.columns = 30, .rows = 30, .distance = 1, .width = 1};
    small_scene_light(&small, vec3_add(c, vec3(-30, -30, -4.4)));
    report = (RenderReport){0};
    int hits = 0;
    for (int row = 0; row < 30; row++)
        for (int column = 0; column < 30; column++) {
            Vec3 colour = reference_pixel(&(Tracer){.scene = &small.scene, .report = &report}, column, row);
            View view = view_of(&small.scene);
            Ray ray = {view.eye, view_direction(&view, column, row, 0, 0)};
            bool hit = reference_nearest(&(Tracer){.scene = &small.scene, .report = &report}, ray, -1).face == 0;
            hits += hit;
            TEST_ASSERT_TRUE(colour.x == (hit ? 1 : 0));
        }
    TEST_ASSERT_GREATER_THAN(300, hits);
}

/* --- The rules of shading --- */

static void black_rule_should_drop_the_ambient_term_of_a_shadowed_light(void)
{
    look_from_the_side();
    add_floor(matt());
    small_scene_light(&small, vec3(0, 0, 2));
    small_scene_light(&small, vec3(-1, 0, 1))->ambient = vec3(2, 2, 2);
    small_scene_face(&small, 0, face_at_height(-0.1, -0.1, 0.1, 0.1, 1)); /* before the first light only */
    TEST_ASSERT_DOUBLE_WITHIN(EXACT, 0.25, pixel().x);
    TEST_ASSERT_EQUAL_INT(1, event_of(EVENT_SHADED, 0)->as.shaded.lights_reaching);
    TEST_ASSERT_EQUAL_INT(PATH_NOT_MIRROR, path_end());
}

static void ambient_rule_should_keep_the_ambient_term_of_every_light(void)
{
    look_from_the_side();
    small.scene.shading.shadow = SHADOW_AMBIENT;
    add_floor(matt());
    small_scene_light(&small, vec3(0, 0, 2));                           /* blocked */
    small_scene_light(&small, vec3(0, 0, -5))->ambient = vec3(2, 2, 2); /* behind */
    small_scene_light(&small, vec3(1, 1, 0))->ambient = vec3(4, 4, 4);  /* in the plane */
    small_scene_face(&small, 0, face_at_height(-0.1, -0.1, 0.1, 0.1, 1));
    ASSERT_VEC3_WITHIN(EXACT, 0.125 * 7, 0, 0, pixel());
    TEST_ASSERT_EQUAL_INT(0, event_of(EVENT_SHADED, 0)->as.shaded.lights_reaching);
    TEST_ASSERT_TRUE(event_of(EVENT_TERMS, 0)->as.terms.ambient_only);
}

static void black_rule_should_end_the_path_in_shadow(void)
{
    small.scene.shading.background = vec3(1, 1, 1);
    add_floor(glow(0.5, 0.5));
    small_scene_light(&small, vec3(0, 0, -2));
    ASSERT_VEC3_WITHIN(0, 0, 0, 0, pixel());
    TEST_ASSERT_EQUAL_INT(PATH_IN_SHADOW, path_end());
    TEST_ASSERT_EQUAL_UINT64(0, report.rays.reflection);
}

static void ambient_rule_should_let_the_path_go_on_from_shadow(void)
{
    small.scene.shading.shadow = SHADOW_AMBIENT;
    small.scene.shading.background = vec3(1, 1, 1);
    add_floor(glow(0.25, 0.5));
    ASSERT_VEC3_WITHIN(EXACT, 0.5, 0.5, 0.5, pixel()); /* no light, the mirror still shows the background */
    small_scene_light(&small, vec3(0, 0, -2));
    ASSERT_VEC3_WITHIN(EXACT, 0.75, 0.75, 0.75, pixel());
    TEST_ASSERT_EQUAL_INT(PATH_MISSED, path_end());
}

/* In the x-z plane: from (-1, 1) down to a mirror at the origin, up to a wall at (1, 1). There L = (-1, 0), and so is V
 * to the camera, while V back along the ray is 45 degrees off: H is 22.5 degrees off, (N.H)^(8/4) = (1 + cos 45)/2. */
static void build_viewer_scene(void)
{
    small.scene.camera = (Camera){{-1, 0, 1}, {0, 0, 0}, {0, 0, 1}};
    add_floor((Material){.reflection = 0.5});
    int wall = small_scene_material(&small, (Material){.specular = {1, 1, 1}, .shininess = 8});
    small_scene_face(&small, wall, face_quad(vec3(1, -1, 0.5), vec3(1, -1, 2), vec3(1, 1, 2), vec3(1, 1, 0.5)));
    small_scene_light(&small, vec3(0, 0, 1));
}

static void viewer_camera_should_look_from_the_camera_in_mirrors(void)
{
    build_viewer_scene();
    small.scene.shading.viewer = VIEWER_CAMERA;
    TEST_ASSERT_DOUBLE_WITHIN(EXACT, 0.5, pixel().x);
    ASSERT_VEC3_WITHIN(EXACT, -1, 0, 0, event_of(EVENT_TERMS, 1)->as.terms.v);
}

static void viewer_ray_should_look_back_along_the_ray(void)
{
    build_viewer_scene();
    small.scene.shading.viewer = VIEWER_RAY;
    TEST_ASSERT_DOUBLE_WITHIN(EXACT, 0.5 * (1 + sqrt(0.5)) / 2, pixel().x);
    ASSERT_VEC3_WITHIN(EXACT, -sqrt(0.5), 0, -sqrt(0.5), event_of(EVENT_TERMS, 1)->as.terms.v);
}

static void viewer_rules_should_agree_on_the_first_hit(void)
{
    add_floor(matt());
    small_scene_light(&small, vec3(sqrt(3), 0, 1));
    Vec3 by_camera = pixel();
    small.scene.shading.viewer = VIEWER_RAY;
    ASSERT_VEC3_WITHIN(EXACT, by_camera.x, by_camera.y, by_camera.z, pixel());
}

/* --- Reflection --- */

/* Two mirrors face each other at z = 0 and z = 2, the camera and the light between them; the ray goes to and fro. */
static void build_facing_mirrors(double lower, double upper)
{
    add_floor(glow(1, lower));
    small_scene_face(&small, small_scene_material(&small, glow(1, upper)), face_at_height(-2, -2, 2, 2, 2));
    small_scene_light(&small, vec3(0.5, 0, 1));
}

static void facing_mirrors_should_sum_the_geometric_series(void)
{
    build_facing_mirrors(0.5, 0.5);
    for (int bounces = 0; bounces <= SCENE_MAX_BOUNCES; bounces++) {
        small.scene.shading.max_bounces = bounces;
        double series = 2 - ldexp(1, -bounces); /* 1 + 1/2 + ... + 2^-bounces */
        ASSERT_VEC3_WITHIN(EXACT, series, series, series, pixel());
        TEST_ASSERT_EQUAL_UINT64(bounces, report.rays.reflection);
        TEST_ASSERT_EQUAL_INT(PATH_MAX_BOUNCES, path_end());
        TEST_ASSERT_EQUAL_INT(bounces, event_of(EVENT_PATH_END, 0)->as.path_end.bounces);
    }
}

static void each_hit_should_be_weighted_by_the_mirrors_before_it(void)
{
    build_facing_mirrors(0.5, 0.25);
    small.scene.shading.max_bounces = 3;
    ASSERT_VEC3_WITHIN(EXACT, 1.6875, 1.6875, 1.6875, pixel()); /* 1 + 1/2 + 1/8 + 1/16 */
    const double weights[] = {1, 0.5, 0.125, 0.0625};
    for (int k = 0; k < 4; k++)
        TEST_ASSERT_EQUAL_DOUBLE(weights[k], event_of(EVENT_SHADED, k)->as.shaded.weight);
}

static void perfect_mirrors_should_not_lose_light(void)
{
    build_facing_mirrors(1, 1);
    small.scene.shading.max_bounces = 64;
    ASSERT_VEC3_WITHIN(1e-12, 65, 65, 65, pixel());
}

static void max_bounces_of_zero_should_show_no_reflection(void)
{
    add_floor(glow(0.25, 1));
    small_scene_light(&small, vec3(1, 0, 2));
    small.scene.shading.background = vec3(1, 1, 1);
    small.scene.shading.max_bounces = 0;
    ASSERT_VEC3_WITHIN(EXACT, 0.25, 0.25, 0.25, pixel());
    TEST_ASSERT_EQUAL_INT(PATH_MAX_BOUNCES, path_end());
    small.scene.shading.max_bounces = 1;
    ASSERT_VEC3_WITHIN(EXACT, 1.25, 1.25, 1.25, pixel());
}

static void mirror_should_add_the_background_by_its_weight(void)
{
    add_floor(glow(0.25, 0.5));
    small_scene_light(&small, vec3(1, 0, 2));
    small.scene.shading.background = vec3(0.25, 0.5, 1);
    ASSERT_VEC3_WITHIN(EXACT, 0.375, 0.5, 0.75, pixel());
    TEST_ASSERT_EQUAL_INT(PATH_MISSED, path_end());
    TEST_ASSERT_EQUAL_DOUBLE(0.5, event_of(EVENT_MISS, 0)->as.miss.weight);
}

static void reflected_ray_should_leave_by_the_angle_of_arrival(void)
{
    build_viewer_scene();
    pixel();
    const Event *reflected = event_of(EVENT_REFLECTED, 0);
    double half = sqrt(0.5);
    ASSERT_VEC3_WITHIN(EXACT, half, 0, -half, reflected->as.reflected.r_unit);
    ASSERT_VEC3_WITHIN(EXACT, half, 0, half, reflected->as.reflected.direction);
    ASSERT_VEC3_WITHIN(EXACT, 1, 0, 1, event_of(EVENT_HIT, 1)->as.hit.point);
}

/* A mirror seen from behind its normal reflects on the side that is seen. */
static void mirror_seen_from_behind_should_reflect_to_the_viewer(void)
{
    small_scene_face(&small, small_scene_material(&small, glow(0, 1)),
                     face_quad(vec3(-2, 2, 0), vec3(2, 2, 0), vec3(2, -2, 0), vec3(-2, -2, 0)));
    small_scene_face(&small, small_scene_material(&small, glow(0.5, 0)), face_at_height(-2, -2, 2, 2, 2));
    small_scene_face(&small, small_scene_material(&small, glow(1, 0)), face_at_height(-2, -2, 2, 2, -2));
    small_scene_light(&small, vec3(1, 0, 1));
    ASSERT_VEC3_WITHIN(EXACT, 0.5, 0.5, 0.5, pixel());
}

/* --- Sampling --- */

static void grid_should_average_its_samples(void)
{
    small_scene_face(&small, small_scene_material(&small, glow(1, 0)),
                     face_at_height(-1, -1, 0, 1, 0)); /* the left half */
    small_scene_light(&small, vec3(0, 0, 2));
    small.scene.shading.background = vec3(0, 0.5, 1);
    small.scene.grid = 2;
    ASSERT_VEC3_WITHIN(EXACT, 0.5, 0.75, 1, pixel());
    small.scene.grid = 16;
    ASSERT_VEC3_WITHIN(EXACT, 0.5, 0.75, 1, reference_pixel(&(Tracer){.scene = &small.scene, .report = &report}, 0, 0));
    small.scene.grid = 3; /* the middle column hits the edge, which is inside */
    ASSERT_VEC3_WITHIN(EXACT, 2.0 / 3, 2.5 / 3, 1, pixel());
    TEST_ASSERT_EQUAL_UINT64(9, report.rays.primary);
}

/* --- What the recorder hears --- */

/* Two samples of four hit a mirror that shows a half-shadowed wall; the others miss. */
static void build_eventful_scene(void)
{
    build_viewer_scene();
    small.scene.shading.viewer = VIEWER_RAY;
    small.scene.shading.background = vec3(0.1, 0.2, 0.3);
    small.scene.grid = 2;
    small.materials[0] = matt();
    small.materials[0].reflection = 0.5;
    small_scene_light(&small, vec3(-3, 1, 4));
    small_scene_light(&small, vec3(0, 0, -4));
}

static void recorder_should_hear_every_kind_of_event(void)
{
    build_eventful_scene();
    pixel();
    /* Nodes belong to trees, which the reference does without. */
    const EventKind kinds[] = {EVENT_SAMPLE,    EVENT_FACE,      EVENT_HIT,      EVENT_MISS,
                               EVENT_LIGHT,     EVENT_OCCLUDER,  EVENT_TERMS,    EVENT_SHADED,
                               EVENT_LIGHT_END, EVENT_REFLECTED, EVENT_PATH_END, EVENT_PIXEL};
    for (int i = 0; i < (int)(sizeof kinds / sizeof kinds[0]); i++)
        TEST_ASSERT_GREATER_THAN(0, events_of(kinds[i]));
    TEST_ASSERT_EQUAL_INT(0, events_of(EVENT_NODE));
}

static void recorder_should_not_change_the_colour(void)
{
    build_eventful_scene();
    Vec3 told = pixel();
    RenderReport told_report = report, silent_report = {0};
    Vec3 silent = reference_pixel(&(Tracer){.scene = &small.scene, .report = &silent_report}, 0, 0);
    TEST_ASSERT_EQUAL_MEMORY(&told, &silent, sizeof told);
    TEST_ASSERT_EQUAL_MEMORY(&told_report.rays, &silent_report.rays, sizeof silent_report.rays);
}

static void events_should_count_what_the_report_counts(void)
{
    build_eventful_scene();
    pixel();
    int shadow_rays = 0;
    for (int i = 0; i < events_of(EVENT_LIGHT_END); i++)
        shadow_rays += event_of(EVENT_LIGHT_END, i)->as.light_end.verdict != LIGHT_BEHIND_FACE;
    TEST_ASSERT_EQUAL_UINT64(report.rays.primary, events_of(EVENT_SAMPLE));
    TEST_ASSERT_EQUAL_UINT64(report.rays.reflection, events_of(EVENT_REFLECTED));
    TEST_ASSERT_EQUAL_UINT64(report.rays.shadow, shadow_rays);
    TEST_ASSERT_EQUAL_INT(events_of(EVENT_HIT) + events_of(EVENT_MISS),
                          events_of(EVENT_SAMPLE) + events_of(EVENT_REFLECTED));
    TEST_ASSERT_EQUAL_INT(events_of(EVENT_PATH_END), events_of(EVENT_SAMPLE));
    TEST_ASSERT_EQUAL_INT(events_of(EVENT_FACE), 2 * (events_of(EVENT_SAMPLE) + events_of(EVENT_REFLECTED)));
    TEST_ASSERT_EQUAL_INT(events_of(EVENT_LIGHT), 3 * events_of(EVENT_HIT));
    TEST_ASSERT_EQUAL_INT(1, events_of(EVENT_PIXEL));
}

/* Every number that an event tells is the one that the next events go on with. */
static void events_should_lead_from_the_samples_to_the_pixel(void)
{
    build_eventful_scene();
    Vec3 colour = pixel(), lights = {0, 0, 0}, total = {0, 0, 0}, samples = {0, 0, 0};
    double weight = 1;
    for (int i = 0; i < kept_count; i++) {
        const Event *e = &kept[i];
        if (e->kind == EVENT_SAMPLE) {
            Vec3 r = vec3_sub(e->as.sample.q, e->as.sample.c);
            ASSERT_VEC3_WITHIN(EXACT, r.x, r.y, r.z, e->as.sample.r);
            total = vec3(0, 0, 0);
            weight = 1;
        } else if (e->kind == EVENT_HIT) {
            lights = vec3(0, 0, 0);
            TEST_ASSERT_DOUBLE_WITHIN(EXACT, 1, vec3_length(e->as.hit.normal));
            TEST_ASSERT_DOUBLE_WITHIN(1e-13, 0, vec3_length(vec3_sub(e->as.hit.point, e->as.hit.shifted)));
        } else if (e->kind == EVENT_LIGHT) {
            TEST_ASSERT_DOUBLE_WITHIN(EXACT, vec3_length(e->as.light.to_light), e->as.light.distance);
            TEST_ASSERT_DOUBLE_WITHIN(EXACT, 1, vec3_length(e->as.light.l));
        } else if (e->kind == EVENT_TERMS) {
            const Illumination *terms = &e->as.terms.illumination;
            Vec3 sum = vec3_add(vec3_add(terms->ambient, terms->diffuse), terms->specular);
            ASSERT_VEC3_WITHIN(EXACT, sum.x, sum.y, sum.z, e->as.terms.sum);
            TEST_ASSERT_EQUAL_DOUBLE(2, e->as.terms.exponent); /* 8 / 4 */
            lights = vec3_add(lights, sum);
        } else if (e->kind == EVENT_SHADED) {
            Vec3 seen = vec3_scale(weight, lights);
            total = vec3_add(total, seen);
            TEST_ASSERT_EQUAL_DOUBLE(weight, e->as.shaded.weight);
            ASSERT_VEC3_WITHIN(EXACT, lights.x, lights.y, lights.z, e->as.shaded.illumination);
            ASSERT_VEC3_WITHIN(EXACT, seen.x, seen.y, seen.z, e->as.shaded.contribution);
            ASSERT_VEC3_WITHIN(EXACT, total.x, total.y, total.z, e->as.shaded.total);
        } else if (e->kind == EVENT_REFLECTED) {
            weight *= e->as.reflected.reflection;
            TEST_ASSERT_EQUAL_DOUBLE(weight, e->as.reflected.weight);
        } else if (e->kind == EVENT_MISS) {
            Vec3 seen = e->as.miss.weight_times_background;
            TEST_ASSERT_EQUAL_DOUBLE(weight, e->as.miss.weight);
            ASSERT_VEC3_WITHIN(EXACT, 0.1 * weight, 0.2 * weight, 0.3 * weight, seen);
            total = vec3_add(total, seen);
        } else if (e->kind == EVENT_PATH_END) {
            ASSERT_VEC3_WITHIN(EXACT, total.x, total.y, total.z, e->as.path_end.colour);
            samples = vec3_add(samples, total);
        }
    }
    const Event *end = event_of(EVENT_PIXEL, 0);
    TEST_ASSERT_EQUAL_INT(4, end->as.pixel.samples);
    ASSERT_VEC3_WITHIN(EXACT, samples.x, samples.y, samples.z, end->as.pixel.sum);
    ASSERT_VEC3_WITHIN(EXACT, samples.x / 4, samples.y / 4, samples.z / 4, end->as.pixel.average);
    TEST_ASSERT_EQUAL_MEMORY(&colour, &end->as.pixel.average, sizeof colour);
    TEST_ASSERT_EQUAL_UINT8(colour_to_byte(colour.x), end->as.pixel.rgb[0]);
    TEST_ASSERT_EQUAL_UINT8(colour_to_byte(colour.y), end->as.pixel.rgb[1]);
    TEST_ASSERT_EQUAL_UINT8(colour_to_byte(colour.z), end->as.pixel.rgb[2]);
}

static void face_events_should_give_the_verdict_on_every_face(void)
{
    add_floor(matt());                                             /* 0: seen */
    small_scene_face(&small, 0, face_at_height(-1, -1, 1, 1, -1)); /* 1: farther */
    small_scene_face(&small, 0, face_at_height(-1, -1, 1, 1, 2));  /* 2: behind */
    small_scene_face(&small, 0, face_at_height(1, 1, 2, 2, 0.5));  /* 3: outside */
    small_scene_face(&small, 0,
                     face_quad(vec3(1, 0, 0), vec3(1, 1, 0), vec3(1, 1, 1), vec3(1, 0, 1))); /* 4: parallel */
    small_scene_face(&small, 0, face_quad(vec3(-1, 1, 0.5), vec3(1, 1, 0.5), vec3(1, -1, 0.5), vec3(-1, -1, 0.5)))
        ->one_sided = 1; /* 5: back */
    pixel();
    const FaceVerdict expected[] = {FACE_INSIDE, FACE_FARTHER, FACE_BEHIND, FACE_OUTSIDE, FACE_PARALLEL, FACE_BACK};
    for (int i = 0; i < 6; i++) {
        const Event *event = event_of(EVENT_FACE, i);
        TEST_ASSERT_EQUAL_INT(i, event->as.face.face);
        TEST_ASSERT_EQUAL_INT(expected[i], event->as.face.test.verdict);
        TEST_ASSERT_TRUE(event->as.face.nearest_t == (i == 0 ? HUGE_VAL : 1));
        TEST_ASSERT_EQUAL_INT(expected[i] == FACE_PARALLEL ? 0 : 4, event->as.face.test.edges);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(light_in_front_should_add_all_three_terms);
    RUN_TEST(slanting_light_should_add_by_its_angle);
    RUN_TEST(distance_should_not_dim_a_light);
    RUN_TEST(lights_should_add_up);
    RUN_TEST(face_seen_from_behind_should_be_lit_from_behind);
    RUN_TEST(scene_without_lights_should_be_black);
    RUN_TEST(nearest_face_should_be_seen_wherever_it_stands_in_the_file);
    RUN_TEST(tie_should_go_to_the_first_face_in_the_file);
    RUN_TEST(shared_edge_should_belong_to_the_first_face_in_the_file);
    RUN_TEST(one_sided_face_should_be_seen_through_from_behind);
    RUN_TEST(miss_should_show_the_background);
    RUN_TEST(nearest_should_leave_out_the_face_to_skip);
    RUN_TEST(light_behind_the_face_should_leave_it_black_without_a_ray);
    RUN_TEST(light_in_the_plane_should_leave_the_face_black_without_a_ray);
    RUN_TEST(light_just_above_the_plane_should_reach_the_face);
    RUN_TEST(only_occluders_between_point_and_light_should_shadow);
    RUN_TEST(occluder_next_to_the_point_should_shadow);
    RUN_TEST(occluder_should_shadow_up_to_its_edge);
    RUN_TEST(occluder_in_the_plane_of_the_shadow_ray_should_not_shadow);
    RUN_TEST(one_sided_occluder_should_shadow_by_its_side);
    RUN_TEST(blocker_should_be_the_first_in_the_file);
    RUN_TEST(face_should_never_shadow_itself);
    RUN_TEST(black_rule_should_drop_the_ambient_term_of_a_shadowed_light);
    RUN_TEST(ambient_rule_should_keep_the_ambient_term_of_every_light);
    RUN_TEST(black_rule_should_end_the_path_in_shadow);
    RUN_TEST(ambient_rule_should_let_the_path_go_on_from_shadow);
    RUN_TEST(viewer_camera_should_look_from_the_camera_in_mirrors);
    RUN_TEST(viewer_ray_should_look_back_along_the_ray);
    RUN_TEST(viewer_rules_should_agree_on_the_first_hit);
    RUN_TEST(facing_mirrors_should_sum_the_geometric_series);
    RUN_TEST(each_hit_should_be_weighted_by_the_mirrors_before_it);
    RUN_TEST(perfect_mirrors_should_not_lose_light);
    RUN_TEST(max_bounces_of_zero_should_show_no_reflection);
    RUN_TEST(mirror_should_add_the_background_by_its_weight);
    RUN_TEST(reflected_ray_should_leave_by_the_angle_of_arrival);
    RUN_TEST(mirror_seen_from_behind_should_reflect_to_the_viewer);
    RUN_TEST(grid_should_average_its_samples);
    RUN_TEST(recorder_should_hear_every_kind_of_event);
    RUN_TEST(recorder_should_not_change_the_colour);
    RUN_TEST(events_should_count_what_the_report_counts);
    RUN_TEST(events_should_lead_from_the_samples_to_the_pixel);
    RUN_TEST(face_events_should_give_the_verdict_on_every_face);
    return UNITY_END();
}
