/* What `rectray check` counts. The scene: a camera at the origin that looks along -z, a light at (0, 5, 0), and one
 * face, a unit square around `centre` whose normal is +x, +y or +z. */
#include "scene/survey.h"

#include "scene/geometry.h"

#include "unity.h"

static Material material;
static Light light;
static Face face;
static Plane plane;
static Scene scene;
static Survey survey;
static Error error;

void setUp(void)
{
    material = (Material){.diffuse = {1, 1, 1}};
    light = (Light){.position = {0, 5, 0}, .ambient = {1, 1, 1}, .diffuse = {1, 1, 1}, .specular = {1, 1, 1}};
    scene = (Scene){.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}},
                    .lights = &light,
                    .light_count = 1,
                    .materials = &material,
                    .material_count = 1,
                    .faces = &face,
                    .planes = &plane,
                    .face_count = 1,
                    .shading = {.max_bounces = 5}};
}

void tearDown(void)
{
    survey_free(&survey);
}

static void put_face(Vec3 centre, int axis, int one_sided)
{
    static const float corners[4][2] = {{-0.5f, -0.5f}, {0.5f, -0.5f}, {0.5f, 0.5f}, {-0.5f, 0.5f}};
    face = (Face){.vertex_count = 4, .one_sided = (unsigned short)one_sided};
    for (int k = 0; k < 4; k++) {
        face.vertices[k][0] = (float)centre.x;
        face.vertices[k][1] = (float)centre.y;
        face.vertices[k][2] = (float)centre.z;
        face.vertices[k][(axis + 1) % 3] += corners[k][0];
        face.vertices[k][(axis + 2) % 3] += corners[k][1];
    }
    plane = face_plane(&face);
}

static void look(void)
{
    survey_free(&survey);
    TEST_ASSERT_TRUE(survey_scene(&survey, &scene, &error));
}

static void assert_unseen(int edge_on, int back_to_camera, int behind_camera, int unreachable)
{
    look();
    TEST_ASSERT_EQUAL_INT(edge_on, survey.edge_on);
    TEST_ASSERT_EQUAL_INT(back_to_camera, survey.back_to_camera);
    TEST_ASSERT_EQUAL_INT(behind_camera, survey.behind_camera);
    TEST_ASSERT_EQUAL_INT(unreachable, survey.unreachable);
}

static void survey_should_count_a_face_in_view_as_needed(void)
{
    put_face(vec3(0, 0, -3), 2, 1);
    assert_unseen(0, 0, 0, 0);
}

static void survey_should_count_a_face_in_the_camera_s_plane(void)
{
    put_face(vec3(0, 0, -3), 0, 0);
    assert_unseen(1, 0, 0, 1); /* the light is in its plane too: nothing needs it */
    light.position = vec3(1, 5, 0);
    assert_unseen(1, 0, 0, 0); /* now it may cast a shadow */
}

static void survey_should_count_a_face_that_turns_its_back(void)
{
    put_face(vec3(0, 0, 3), 2, 1); /* faces +z, away from the camera at z = 0 */
    assert_unseen(0, 1, 0, 0);     /* the light is behind it: it may block */
    light.position = vec3(0, 0, 9);
    assert_unseen(0, 1, 0, 1); /* shadow rays to this light come through its back */
    face.one_sided = 0;
    assert_unseen(0, 0, 1, 0); /* two-sided: only its place behind the camera hides it */
}

static void survey_should_count_a_face_behind_the_camera_only_when_all_of_it_is(void)
{
    put_face(vec3(0, -1, 0.6), 1, 0);
    assert_unseen(0, 0, 1, 0);
    put_face(vec3(0, -1, 0.4), 1, 0);
    assert_unseen(0, 0, 0, 0);
}

static void survey_should_need_every_face_that_a_mirror_may_show(void)
{
    put_face(vec3(0, 0, -3), 0, 0);
    material.reflection = 0.5;
    assert_unseen(1, 0, 0, 0);
    TEST_ASSERT_TRUE(survey.reflections);
}

static void survey_should_know_when_paths_cannot_go_on(void)
{
    put_face(vec3(0, 0, -3), 2, 0);
    look();
    TEST_ASSERT_FALSE(survey.reflections);
    material.reflection = 0.5;
    look();
    TEST_ASSERT_TRUE(survey.reflections);
    scene.light_count = 0;
    look();
    TEST_ASSERT_FALSE(survey.reflections); /* "black": in shadow of all of no lights */
    TEST_ASSERT_FALSE(survey.shadow_rays);
    scene.shading.shadow = SHADOW_AMBIENT;
    look();
    TEST_ASSERT_TRUE(survey.reflections);
    scene.shading.max_bounces = 0;
    look();
    TEST_ASSERT_FALSE(survey.reflections);
}

static void survey_should_tell_used_materials_and_idle_lights(void)
{
    Material materials[2] = {{.specular = {0, 0, 1}}, {.diffuse = {1, 1, 1}}};
    Light lights[3] = {{.ambient = {0, 1, 0}}, {.specular = {1, 0, 0}}, {.position = {1, 2, 3}}};
    scene.materials = materials;
    scene.material_count = 2;
    scene.lights = lights;
    scene.light_count = 3;
    put_face(vec3(0, 0, -3), 2, 0);
    look();
    TEST_ASSERT_TRUE(survey.material_used[0]);
    TEST_ASSERT_FALSE(survey.material_used[1]);
    TEST_ASSERT_EQUAL_INT(1, survey.shiny);
    TEST_ASSERT_EQUAL_INT(1, survey.lights_ambient);
    TEST_ASSERT_EQUAL_INT(1, survey.lights_black);
}

static void survey_should_count_a_split_face_once(void)
{
    Face faces[3] = {
        {.vertex_count = 3, .number = 4}, {.vertex_count = 3, .number = 4}, {.vertex_count = 4, .number = 5}};
    Plane planes[3] = {{.d = 1}, {.d = 1}, {.d = 1}};
    scene.faces = faces;
    scene.planes = planes;
    scene.face_count = 3;
    look();
    TEST_ASSERT_EQUAL_INT(2, survey.numbers);
    TEST_ASSERT_EQUAL_INT(2, survey.triangles);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(survey_should_count_a_face_in_view_as_needed);
    RUN_TEST(survey_should_count_a_face_in_the_camera_s_plane);
    RUN_TEST(survey_should_count_a_face_that_turns_its_back);
    RUN_TEST(survey_should_count_a_face_behind_the_camera_only_when_all_of_it_is);
    RUN_TEST(survey_should_need_every_face_that_a_mirror_may_show);
    RUN_TEST(survey_should_know_when_paths_cannot_go_on);
    RUN_TEST(survey_should_tell_used_materials_and_idle_lights);
    RUN_TEST(survey_should_count_a_split_face_once);
    return UNITY_END();
}
