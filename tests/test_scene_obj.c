/* Wavefront models: references, materials, lines that are skipped, and libraries. */
#include "base/text_blocks.h"
#include "reader/scene_obj.h"

#include "unity.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

static Scene scene;
static Error error;
static SceneBuild build;
static char folder[64], model[96], library[96];

/* A scene with the materials "own" (of the object) and "scene", and an object that waits for its model. */
void setUp(void)
{
    scene = (Scene){.camera = {.position = {0, 0, 9}, .up = {0, 1, 0}}};
    error = (Error){.kind = ERROR_NONE};
    build = (SceneBuild){.scene = &scene, .error = &error};
    TEST_ASSERT_EQUAL(0, scene_build_material(&build, (Material){.name = "own"}));
    TEST_ASSERT_EQUAL(1, scene_build_material(&build, (Material){.name = "scene"}));
    TEST_ASSERT_TRUE(names_add(&build.materials, scene.materials[1].name, 1, &error));
    TEST_ASSERT_TRUE(scene_build_object(&build, "model", (SceneBuildObject){.transform = transform_identity()}));
    snprintf(folder, sizeof folder, "/tmp/rectray-test-obj-%ld", (long)getpid());
    snprintf(model, sizeof model, "%s.obj", folder);
    snprintf(library, sizeof library, "%s.mtl", folder);
}

void tearDown(void)
{
    scene_build_free(&build);
    scene_free(&scene);
    unlink(model);
    unlink(library);
}

static void write_file(const char *path, const char *text)
{
    FILE *file = fopen(path, "wb");
    TEST_ASSERT_NOT_NULL(file);
    fputs(text, file);
    fclose(file);
}

/* Reads a model of a unit square (vertices 1 to 4, all on line 1 to 4) and these lines. */
static bool read_model(const char *lines)
{
    char text[2048];
    snprintf(text, sizeof text, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n%s", lines);
    write_file(model, text);
    return scene_obj_read(&build, model);
}

static void assert_points(int face, int a, int b, int c, int d)
{
    const int expected[4] = {a, b, c, d};
    TEST_ASSERT_LESS_THAN(build.face_count, face);
    for (int i = 0; i < build.faces[face].vertex_count; i++)
        TEST_ASSERT_EQUAL(expected[i], build.faces[face].points[i]);
}

static void every_form_of_a_reference_should_name_its_vertex(void)
{
    TEST_ASSERT_TRUE_MESSAGE(read_model("f 1 2 3\nf 1/9 2/9 4/9\nf 1//9 2//-9 3//9 4//9\nf 2/1/1 3/-2/2 4/3/3\n"),
                             error.text);
    TEST_ASSERT_EQUAL(4, build.face_count);
    assert_points(0, 0, 1, 2, 0);
    assert_points(1, 0, 1, 3, 0);
    assert_points(2, 0, 1, 2, 3);
    assert_points(3, 1, 2, 3, 0);
    TEST_ASSERT_EQUAL(5, build.faces[0].place); /* its line */
    TEST_ASSERT_EQUAL(8, build.faces[3].place);
}

static void negative_references_should_count_from_the_last_vertex_so_far(void)
{
    TEST_ASSERT_TRUE(read_model("f -4 -3 -2 -1\nv 0 0 1\nf -1 1 2\n"));
    assert_points(0, 0, 1, 2, 3);
    assert_points(1, 4, 0, 1, 0);
}

static void other_lines_blanks_and_line_ends_should_not_matter(void)
{
    TEST_ASSERT_TRUE_MESSAGE(
        read_model("\r\n# f 1 2\r\nvt 0 0\r\nvn 0 0 1\r\no name\r\ng a b\r\ns 1\r\nl 1 2\r\nvp 1\r\n"
                   " \t f \t 1   2\t3  \r\nv +1.5e0 .5 2. \nv 0 0 2 1.0\nv 0 0 3 0.1 0.2 0.3\nf 5 6 7"),
        error.text);
    TEST_ASSERT_EQUAL(2, build.face_count);
    TEST_ASSERT_TRUE(build.points[4].x == 1.5 && build.points[4].y == 0.5 && build.points[4].z == 2);
}

static void a_weight_should_divide_and_a_colour_should_not(void)
{
    TEST_ASSERT_TRUE_MESSAGE(
        read_model("v 2 4 6 2\nv 1 2 3 0.5 0.5 0.5\nv 1 2 4 0.5 0.5 0.5 1\nv nan 0 0\nv 0 0 0 0\nf 5 7 1\n"),
        error.text);
    TEST_ASSERT_TRUE(build.points[4].x == 1 && build.points[4].y == 2 && build.points[4].z == 3);
    TEST_ASSERT_TRUE(build.points[5].x == 1 && build.points[5].y == 2 && build.points[5].z == 3);
    TEST_ASSERT_TRUE(build.points[6].x == 1 && build.points[6].y == 2 && build.points[6].z == 4);
    TEST_ASSERT_EQUAL(9, scene_build_point_count(&build)); /* those that are none, too */
    TEST_ASSERT_EQUAL(1, scene.notes.count);
    TEST_ASSERT_EQUAL(2, scene.notes.items[0].count);
}

static void faces_below_and_above_their_vertices_should_keep_their_order(void)
{
    TEST_ASSERT_TRUE_MESSAGE(read_model("f 1 2 3\nf 1 2 5\nf 2 3 4\nv 0 0 1\nf 3 4 1\n"), error.text);
    static const int places[4] = {5, 6, 7, 9};
    TEST_ASSERT_EQUAL(4, build.face_count);
    for (int i = 0; i < 4; i++) {
        TEST_ASSERT_EQUAL(i, build.faces[i].number);
        TEST_ASSERT_EQUAL(places[i], build.faces[i].place);
    }
    assert_points(1, 0, 1, 4, 0);
    assert_points(2, 1, 2, 3, 0);
}

static void the_transform_should_move_the_model(void)
{
    build.object.transform = transform_translate(vec3(10, 20, 30));
    TEST_ASSERT_TRUE(read_model("f 1 2 3 4\n"));
    TEST_ASSERT_TRUE(build.points[2].x == 11 && build.points[2].y == 21 && build.points[2].z == 30);
}

static void usemtl_should_look_in_the_scene_then_in_the_library_then_at_the_object(void)
{
    char text[256];
    write_file(library, "# three\nnewmtl scene\nKd 1 1 1\n\nnewmtl glass blue\r\n Ka .1 .2 .3\n\tKd 0.4 0.5 0.6\nKs "
                        "0.7 0.8 0.9\nNs 25\n"
                        "illum 2\nmap_Kd x.png\nnewmtl unused\n");
    snprintf(text, sizeof text,
             "f 1 2 3\nmtllib %s\nmtllib %s\nusemtl scene\nf 1 2 3\nusemtl glass blue \nf 1 2 3\nf 1 2 4\nusemtl "
             "none\nf 1 2 3\n",
             strrchr(library, '/') + 1, strrchr(library, '/') + 1);
    TEST_ASSERT_TRUE_MESSAGE(read_model(text), error.text);
    static const int materials[5] = {0, 1, 2, 2, 0};
    for (int i = 0; i < 5; i++)
        TEST_ASSERT_EQUAL(materials[i], build.faces[i].material);
    TEST_ASSERT_EQUAL(3, scene.material_count); /* what is not used is not added */
    const Material *glass = &scene.materials[2];
    TEST_ASSERT_EQUAL_STRING("glass blue", glass->name);
    TEST_ASSERT_TRUE(glass->ambient.x == 0.1 && glass->ambient.y == 0.2 && glass->ambient.z == 0.3);
    TEST_ASSERT_TRUE(glass->diffuse.x == 0.4 && glass->diffuse.y == 0.5 && glass->diffuse.z == 0.6);
    TEST_ASSERT_TRUE(glass->specular.x == 0.7 && glass->specular.y == 0.8 && glass->specular.z == 0.9);
    TEST_ASSERT_TRUE(glass->shininess == 25 && glass->reflection == 0);
}

static void a_library_should_serve_its_own_model_only(void)
{
    char text[256];
    write_file(library, "newmtl glass\nKd 1 1 1\n");
    snprintf(text, sizeof text, "mtllib %s\nusemtl glass\nf 1 2 3\n", strrchr(library, '/') + 1);
    TEST_ASSERT_TRUE(read_model(text));
    TEST_ASSERT_EQUAL(2, build.faces[0].material);
    TEST_ASSERT_TRUE(scene_build_object(&build, "other", (SceneBuildObject){.transform = transform_identity()}));
    TEST_ASSERT_TRUE(read_model("usemtl glass\nf 1 2 3\n"));
    TEST_ASSERT_EQUAL(0, build.faces[1].material);
    assert_points(1, 4, 5, 6, 0);
}

static void nonplanar_faces_should_split_where_the_object_says_so(void)
{
    build.object.split = true;
    TEST_ASSERT_TRUE(read_model("v 0 1 1\nf 1 2 3 5\n"));
    TEST_ASSERT_EQUAL(2, build.face_count);
    assert_points(0, 0, 1, 2, 0);
    assert_points(1, 0, 2, 4, 0);
}

static void assert_fails(const char *lines, const char *place_and_reason)
{
    TEST_ASSERT_TRUE(scene_build_object(&build, "again", build.object)); /* whose vertices count from 1 */
    TEST_ASSERT_FALSE(read_model(lines));
    TEST_ASSERT_EQUAL(ERROR_INPUT, error.kind);
    TEST_ASSERT_EQUAL_STRING_LEN(model, error.text, strlen(model));
    TEST_ASSERT_EQUAL_STRING(place_and_reason, error.text + strlen(model));
    error = (Error){.kind = ERROR_NONE};
}

/* Only what tests/scenes/bad does not hold. */
static void broken_lines_should_be_named(void)
{
    assert_fails("f 1 2 99999999999999999999\n",
                 ":5: vertex 99999999999999999999 does not exist; 4 are defined above this line");
    assert_fails("f 1 2 -99999999999999999999\n",
                 ":5: vertex -99999999999999999999 does not exist; 4 are defined above this line");
    assert_fails("f 1 2 6\nv 1 1 1\n", ":5: vertex 6 does not exist; the file has 5");
    static const char *const words[] = {"/1", "1/1/1/1", "1/1/1/", "1/a", "1//a", "+1", "-", "1.5", "0"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        char line[64], expected[128];
        snprintf(line, sizeof line, "f 1 2 %s\n", words[i]);
        snprintf(expected, sizeof expected, ":5: \"%s\" is not a reference to a vertex (like 7, -1, 7/1, 7//3, 7/1/3)",
                 words[i]);
        assert_fails(line, expected);
    }
    assert_fails("v 1e999 0 0\nf 1 2 5\n", ":6: vertex 5 of the face is not a finite number");
    assert_fails("v 1 2 3 0\nf 1 2 5\n", ":6: vertex 5 of the face is not a finite number");
    assert_fails("v 1e\n", ":5: \"1e\" is not a finite number");
    assert_fails("v 1 2 3#\n", ":5: \"3#\" is not a finite number");
    assert_fails("v 0x10 0 0\n", ":5: \"0x10\" is not a finite number");
    assert_fails("v 1 2 3 4 5\n", ":5: a vertex needs three coordinates, not 5");
    assert_fails("v 1 2 3 1 5 6 7 8\n", ":5: more than 7 numbers");
    assert_fails("f\n", ":5: a face of 0 vertices; it needs at least 3");
    build.object.material = -1;
    assert_fails("f 1 2 3\n", ":5: the face has no material: neither it nor its object names one");
    assert_fails(
        "usemtl none\nf 1 2 3\n",
        ":6: the face has no material: \"none\" is not in the scene nor in a library, and the object names none");
}

static void a_line_without_end_should_be_refused(void)
{
    static char text[TEXT_BLOCK_MAX + 100];
    memset(text, 'v', sizeof text - 1);
    write_file(model, text);
    TEST_ASSERT_FALSE(scene_obj_read(&build, model));
    TEST_ASSERT_NOT_NULL(strstr(error.text, ":1: the line is longer than 1048576 bytes"));
}

static void long_files_should_be_read_across_the_buffer(void)
{
    enum { COUNT = 90000 }; /* some 4 MB */
    FILE *file = fopen(model, "wb");
    TEST_ASSERT_NOT_NULL(file);
    for (int i = 0; i < COUNT; i++)
        fprintf(file, "v %d 0 0\nv %d.5 1 0\nv %d 0 1\nf -1 -2 -3\n", i, i, i);
    fclose(file);
    TEST_ASSERT_TRUE_MESSAGE(scene_obj_read(&build, model), error.text);
    TEST_ASSERT_EQUAL(COUNT, build.face_count);
    TEST_ASSERT_EQUAL(3 * COUNT, build.point_count);
    for (int i = 0; i < COUNT; i++) {
        TEST_ASSERT_TRUE(build.points[3 * i + 1].x == i + 0.5);
        TEST_ASSERT_EQUAL(4 * i + 4, build.faces[i].place);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(every_form_of_a_reference_should_name_its_vertex);
    RUN_TEST(negative_references_should_count_from_the_last_vertex_so_far);
    RUN_TEST(other_lines_blanks_and_line_ends_should_not_matter);
    RUN_TEST(a_weight_should_divide_and_a_colour_should_not);
    RUN_TEST(faces_below_and_above_their_vertices_should_keep_their_order);
    RUN_TEST(the_transform_should_move_the_model);
    RUN_TEST(usemtl_should_look_in_the_scene_then_in_the_library_then_at_the_object);
    RUN_TEST(a_library_should_serve_its_own_model_only);
    RUN_TEST(nonplanar_faces_should_split_where_the_object_says_so);
    RUN_TEST(broken_lines_should_be_named);
    RUN_TEST(a_line_without_end_should_be_refused);
    RUN_TEST(long_files_should_be_read_across_the_buffer);
    return UNITY_END();
}
