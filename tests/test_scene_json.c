/* Scene files: what each key becomes, every default, and the error of every broken scene in tests/scenes/bad. */
#include "reader/scene_json.h"

#include "unity.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static Scene scene;
static Error error;

void setUp(void) {}
void tearDown(void)
{
    scene_free(&scene);
}

static bool parse(const char *text)
{
    scene_free(&scene);
    error = (Error){.kind = ERROR_NONE};
    return scene_parse(&scene, "tests/scenes/x.json", text, (long)strlen(text), &error);
}

static void assert_vec3(double x, double y, double z, Vec3 v)
{
    TEST_ASSERT_EQUAL_DOUBLE(x, v.x);
    TEST_ASSERT_EQUAL_DOUBLE(y, v.y);
    TEST_ASSERT_EQUAL_DOUBLE(z, v.z);
}

static void scene_parse_should_fill_in_the_documented_defaults(void)
{
    TEST_ASSERT_TRUE(parse("{ \"camera\": { \"position\": [0, 0, 0], \"look_at\": [0, 0, -1] },"
                           "  \"screen\": { \"columns\": 640, \"rows\": 480 },"
                           "  \"lights\": [{ \"position\": [1, 2, 3] }], \"materials\": { \"m\": {} } }"));
    assert_vec3(0, 0.5, 0, scene.camera.up); /* [0, 1, 0], as a direction */
    TEST_ASSERT_EQUAL_DOUBLE(1, scene.screen.distance);
    TEST_ASSERT_EQUAL_DOUBLE(2, scene.screen.width);
    TEST_ASSERT_EQUAL_DOUBLE(1.5, screen_height(&scene.screen));
    assert_vec3(1, 1, 1, scene.lights[0].ambient);
    assert_vec3(1, 1, 1, scene.lights[0].diffuse);
    assert_vec3(1, 1, 1, scene.lights[0].specular);
    assert_vec3(0, 0, 0, scene.materials[0].ambient);
    assert_vec3(0, 0, 0, scene.materials[0].diffuse);
    assert_vec3(0, 0, 0, scene.materials[0].specular);
    TEST_ASSERT_EQUAL_DOUBLE(0, scene.materials[0].shininess);
    TEST_ASSERT_EQUAL_DOUBLE(0, scene.materials[0].reflection);
    TEST_ASSERT_EQUAL(SHADOW_BLACK, scene.shading.shadow);
    TEST_ASSERT_EQUAL(VIEWER_CAMERA, scene.shading.viewer);
    TEST_ASSERT_EQUAL(5, scene.shading.max_bounces);
    assert_vec3(0, 0, 0, scene.shading.background);
    TEST_ASSERT_EQUAL(1, scene.grid);
    TEST_ASSERT_EQUAL(0, scene.face_count);
}

static void scene_parse_should_read_every_key(void)
{
    TEST_ASSERT_TRUE(
        parse("{ \"camera\": { \"position\": [0, 0, 0], \"look_at\": [0, 0, -3], \"up\": [0, 0.25, 0] },"
              "  \"screen\": { \"columns\": 16384, \"rows\": 1.0, \"distance\": 3, \"width\": 4, \"height\": 5 },"
              "  \"lights\": [{ \"position\": [1, 2, 3], \"ambient\": [1, 2, 3], \"diffuse\": [4, 5, 6], \"specular\": "
              "[7, 8, 9] }],"
              "  \"materials\": { \"a\": {}, \"m\": { \"ambient\": [1, 2, 3], \"diffuse\": [4, 5, 6], \"specular\": "
              "[7, 8, 9],"
              "                   \"shininess\": 100, \"reflection\": 0.5 } },"
              "  \"shading\": { \"shadow\": \"ambient\", \"viewer\": \"ray\", \"max_bounces\": 64, \"background\": "
              "[0.1, 0.2, 3] },"
              "  \"sampling\": { \"grid\": 16 } }"));
    assert_vec3(0, 0, -3, scene.camera.look_at);
    assert_vec3(0, 0.5, 0, scene.camera.up);
    TEST_ASSERT_EQUAL(16384, scene.screen.columns);
    TEST_ASSERT_EQUAL(1, scene.screen.rows);
    TEST_ASSERT_EQUAL_DOUBLE(3, scene.screen.distance);
    TEST_ASSERT_EQUAL_DOUBLE(4, scene.screen.width);
    TEST_ASSERT_EQUAL_DOUBLE(5, screen_height(&scene.screen));
    TEST_ASSERT_EQUAL(1, scene.light_count);
    assert_vec3(1, 2, 3, scene.lights[0].position);
    assert_vec3(1, 2, 3, scene.lights[0].ambient);
    assert_vec3(4, 5, 6, scene.lights[0].diffuse);
    assert_vec3(7, 8, 9, scene.lights[0].specular);
    TEST_ASSERT_EQUAL(2, scene.material_count);
    TEST_ASSERT_EQUAL_STRING("m", scene.materials[1].name);
    assert_vec3(1, 2, 3, scene.materials[1].ambient);
    assert_vec3(4, 5, 6, scene.materials[1].diffuse);
    assert_vec3(7, 8, 9, scene.materials[1].specular);
    TEST_ASSERT_EQUAL_DOUBLE(100, scene.materials[1].shininess);
    TEST_ASSERT_EQUAL_DOUBLE(0.5, scene.materials[1].reflection);
    TEST_ASSERT_EQUAL(SHADOW_AMBIENT, scene.shading.shadow);
    TEST_ASSERT_EQUAL(VIEWER_RAY, scene.shading.viewer);
    TEST_ASSERT_EQUAL(64, scene.shading.max_bounces);
    assert_vec3(0.1, 0.2, 3, scene.shading.background);
    TEST_ASSERT_EQUAL(16, scene.grid);
}

static const char head[] =
    "{ \"camera\": { \"position\": [0, 0, 9], \"look_at\": [0, 0, 0] }, \"screen\": { \"columns\": 8, \"rows\": 6 },"
    "  \"materials\": { \"a\": {}, \"b\": {} }, \"objects\": ";

static bool parse_objects(const char *objects)
{
    char text[4096];
    snprintf(text, sizeof text, "%s%s }", head, objects);
    return parse(text);
}

static void objects_should_number_their_faces_in_file_order(void)
{
    TEST_ASSERT_TRUE(parse_objects(
        "[{ \"name\": \"box\", \"material\": \"b\", \"box\": { \"min\": [-1, -1, -1], \"max\": [1, 1, 1] } },"
        " { \"material\": \"a\", \"sided\": \"front\", \"nonplanar\": \"split\","
        "   \"vertices\": [[0, 0, 0], [1, 0, 0], [1, 1, 0.5], [0, 1, 0]],"
        "   \"faces\": [[0, 1, 2, 3], { \"vertices\": [0, 1, 2], \"material\": \"b\" }] }]"));
    TEST_ASSERT_EQUAL(9, scene.face_count);
    TEST_ASSERT_EQUAL_STRING("box", scene.objects[0].name);
    TEST_ASSERT_EQUAL_STRING("objects[1]", scene.objects[1].name);
    TEST_ASSERT_EQUAL(0, scene.objects[0].first_face);
    TEST_ASSERT_EQUAL(6, scene.objects[0].face_count);
    TEST_ASSERT_EQUAL(6, scene.objects[1].first_face);
    TEST_ASSERT_EQUAL(3, scene.objects[1].face_count);
    static const int numbers[9] = {0, 1, 2, 3, 4, 5, 6, 6, 7}, materials[9] = {1, 1, 1, 1, 1, 1, 0, 0, 1};
    for (int i = 0; i < 9; i++) {
        TEST_ASSERT_EQUAL(numbers[i], scene.faces[i].number);
        TEST_ASSERT_EQUAL(materials[i], scene.faces[i].material);
        TEST_ASSERT_EQUAL(i >= 6, scene.faces[i].object);
        TEST_ASSERT_EQUAL(i >= 6, scene.faces[i].one_sided);
        TEST_ASSERT_EQUAL(i < 6 ? 4 : 3, scene.faces[i].vertex_count);
    }
}

static void a_missing_vertex_should_be_reported_as_the_specification_says(void)
{
    TEST_ASSERT_FALSE(parse("{ \"camera\": { \"position\": [0, 0, 1], \"look_at\": [0, 0, 0] },\n"
                            "  \"screen\": { \"columns\": 8, \"rows\": 6 },\n"
                            "  \"materials\": { \"m\": {} },\n"
                            "  \"objects\": [\n"
                            "    { \"material\": \"m\", \"box\": { \"min\": [0, 0, 0], \"max\": [1, 1, 1] } },\n"
                            "    { \"material\": \"m\", \"box\": { \"min\": [0, 0, 0], \"max\": [1, 1, 1] } },\n"
                            "    { \"material\": \"m\",\n"
                            "      \"vertices\": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [2, 1, 0]],\n"
                            "      \"faces\": [[0, 1, 2, 7]] } ] }"));
    TEST_ASSERT_EQUAL_STRING(
        "tests/scenes/x.json:9:17: objects[2].faces[0]: vertex 7 does not exist; the object has 6 vertices\n"
        "        \"faces\": [[0, 1, 2, 7]] } ] }\n"
        "                  ^",
        error.text);
    TEST_ASSERT_EQUAL(ERROR_INPUT, error.kind);
    TEST_ASSERT_EQUAL(0, scene.material_count); /* nothing is left */
}

static void crlf_should_count_as_one_line_end(void)
{
    TEST_ASSERT_FALSE(parse("{\r\n  \"camera\": {},\r\n  \"screen\": { \"columns\": 8, \"rows\": 6 }\r\n}\r\n"));
    TEST_ASSERT_EQUAL_STRING("tests/scenes/x.json:2:13: camera: the key \"position\" is missing\n"
                             "    \"camera\": {},\n"
                             "              ^",
                             error.text);
}

static void a_scene_should_be_independent_of_where_it_is(void)
{
    TEST_ASSERT_TRUE(scene_load(&scene, "tests/scenes/shadow_ambient.json", &error));
    Scene far;
    TEST_ASSERT_TRUE(scene_load(&far, "tests/scenes/far_away.json", &error));
    TEST_ASSERT_EQUAL(scene.face_count, far.face_count);
    for (int i = 0; i < far.face_count; i++)
        TEST_ASSERT_EQUAL_MEMORY(scene.faces[i].vertices, far.faces[i].vertices, sizeof far.faces[i].vertices);
    assert_vec3(scene.lights[0].position.x, scene.lights[0].position.y, scene.lights[0].position.z,
                far.lights[0].position);
    Vec3 moved = vec3_sub(far.centre, scene.centre);
    assert_vec3(1e6, 1e6, 1e6, moved);
    scene_free(&far);
}

static void ten_thousand_materials_should_be_found(void)
{
    enum { COUNT = 10000 };
    char *text = malloc(COUNT * 80), *at = text;
    at += sprintf(at, "{ \"camera\": { \"position\": [0, 0, 9], \"look_at\": [0, 0, 0] },"
                      "  \"screen\": { \"columns\": 8, \"rows\": 6 }, \"materials\": {");
    for (int i = 0; i < COUNT; i++)
        at += sprintf(at, "%s\"m%d\": {}", i ? "," : "", i);
    at += sprintf(at, "}, \"objects\": [{ \"vertices\": [[0, 0, 0], [1, 0, 0], [1, 1, 0]], \"faces\": [");
    for (int i = 0; i < COUNT; i++)
        at += sprintf(at, "%s{ \"vertices\": [0, 1, 2], \"material\": \"m%d\" }", i ? "," : "", COUNT - 1 - i);
    sprintf(at, "] }] }");
    TEST_ASSERT_TRUE_MESSAGE(parse(text), error.text);
    free(text);
    TEST_ASSERT_EQUAL(COUNT, scene.face_count);
    for (int i = 0; i < COUNT; i++)
        TEST_ASSERT_EQUAL(COUNT - 1 - i, scene.faces[i].material);
}

static void a_real_scene_should_survive_being_cut_at_every_byte(void)
{
    char text[16384];
    FILE *file = fopen("tests/scenes/transforms.json", "rb");
    TEST_ASSERT_NOT_NULL(file);
    size_t length = fread(text, 1, sizeof text, file);
    fclose(file);
    while (length > 0 && text[length - 1] != '}')
        length--;
    for (size_t cut = 0; cut < length; cut++) {
        error = (Error){.kind = ERROR_NONE};
        TEST_ASSERT_FALSE(scene_parse(&scene, "tests/scenes/x.json", text, (long)cut, &error));
        TEST_ASSERT_EQUAL(ERROR_INPUT, error.kind);
    }
    error = (Error){.kind = ERROR_NONE};
    TEST_ASSERT_TRUE(scene_parse(&scene, "tests/scenes/x.json", text, (long)length, &error));
}

/* Each line: class, file, the first line of its error. */
static void every_bad_scene_should_give_its_error(void)
{
    FILE *table = fopen("tests/scenes/bad/expected.tsv", "rb");
    TEST_ASSERT_NOT_NULL(table);
    char line[1024];
    int count = 0;
    while (fgets(line, sizeof line, table)) {
        char path[256];
        const char *name = strchr(line, '\t');
        if (line[0] == '#')
            continue;
        TEST_ASSERT_NOT_NULL(name);
        char *message = strchr(name + 1, '\t');
        TEST_ASSERT_NOT_NULL(message);
        *message++ = '\0';
        message[strcspn(message, "\n")] = '\0';
        snprintf(path, sizeof path, "tests/scenes/bad/%s", name + 1);
        error = (Error){.kind = ERROR_NONE};
        TEST_ASSERT_FALSE_MESSAGE(scene_load(&scene, path, &error), path);
        TEST_ASSERT_EQUAL_MESSAGE(ERROR_INPUT, error.kind, path);
        error.text[strcspn(error.text, "\n")] = '\0';
        TEST_ASSERT_EQUAL_STRING_MESSAGE(message, error.text, path);
        count++;
    }
    fclose(table);
    TEST_ASSERT_GREATER_OR_EQUAL(170, count);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(scene_parse_should_fill_in_the_documented_defaults);
    RUN_TEST(scene_parse_should_read_every_key);
    RUN_TEST(objects_should_number_their_faces_in_file_order);
    RUN_TEST(a_missing_vertex_should_be_reported_as_the_specification_says);
    RUN_TEST(crlf_should_count_as_one_line_end);
    RUN_TEST(a_scene_should_be_independent_of_where_it_is);
    RUN_TEST(ten_thousand_materials_should_be_found);
    RUN_TEST(a_real_scene_should_survive_being_cut_at_every_byte);
    RUN_TEST(every_bad_scene_should_give_its_error);
    return UNITY_END();
}
