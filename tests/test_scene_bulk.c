/* The two ways through a scene file, straight from the text and through the tree of values: what one accepts the other
 * does, with every number's bits, and the messages are the same. RECTRAY_SOAK=1 tries many more texts. */
#include "reader/generate.h"
#include "reader/scene_json.h"

#include "support/xorshift.h"
#include "unity.h"

#include <glob.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void setUp(void) {}
void tearDown(void) {}

static bool is_soak(void)
{
    return getenv("RECTRAY_SOAK") != NULL;
}

/* --- Comparing --- */

static bool same_names(const Scene *a, const Scene *b)
{
    for (int i = 0; i < a->object_count; i++)
        if (strcmp(a->objects[i].name, b->objects[i].name) != 0 ||
            a->objects[i].first_face != b->objects[i].first_face ||
            a->objects[i].face_count != b->objects[i].face_count)
            return false;
    for (int i = 0; i < a->material_count; i++)
        if (strcmp(a->materials[i].name, b->materials[i].name) != 0 ||
            memcmp(&a->materials[i].ambient, &b->materials[i].ambient,
                   sizeof(Material) - offsetof(Material, ambient)) != 0)
            return false;
    return true;
}

/* Of nothing there may be no address. */
static bool same_bytes(const void *a, const void *b, size_t size)
{
    return size == 0 || memcmp(a, b, size) == 0;
}

/* Bit for bit. */
static bool same_scene(const Scene *a, const Scene *b)
{
    return a->face_count == b->face_count && a->object_count == b->object_count &&
           a->material_count == b->material_count && a->light_count == b->light_count &&
           same_bytes(a->faces, b->faces, (size_t)a->face_count * sizeof *a->faces) &&
           same_bytes(a->planes, b->planes, (size_t)a->face_count * sizeof *a->planes) &&
           same_bytes(a->lights, b->lights, (size_t)a->light_count * sizeof *a->lights) &&
           memcmp(&a->camera, &b->camera, sizeof a->camera) == 0 &&
           memcmp(&a->centre, &b->centre, sizeof a->centre) == 0 &&
           memcmp(&a->screen.distance, &b->screen.distance, 3 * sizeof(double)) == 0 &&
           a->screen.columns == b->screen.columns && a->screen.rows == b->screen.rows && a->grid == b->grid &&
           a->adaptive == b->adaptive && a->shading.max_bounces == b->shading.max_bounces && same_names(a, b);
}

/* Reads the text by both ways. Returns whether it is a scene. */
static bool assert_ways_agree(const char *text, long length)
{
    static Error any_error, tree_error;
    Scene any, tree;
    any_error = tree_error = (Error){.kind = ERROR_NONE};
    bool good = scene_parse_by(SCENE_WAY_ANY, &any, "tests/scenes/x.json", text, length, &any_error);
    bool expected = scene_parse_by(SCENE_WAY_TREE, &tree, "tests/scenes/x.json", text, length, &tree_error);
    if (good != expected || any_error.kind != tree_error.kind || strcmp(any_error.text, tree_error.text) != 0 ||
        !same_scene(&any, &tree)) {
        printf("%.*s\n%s\n%s\n", (int)length, text, any_error.text, tree_error.text);
        TEST_FAIL_MESSAGE("the ways differ on the text above");
    }
    scene_free(&any);
    scene_free(&tree);
    return good;
}

static bool in_bulk(const char *text)
{
    Scene scene;
    Error error = {.kind = ERROR_NONE};
    bool good = scene_parse_by(SCENE_WAY_BULK, &scene, "x.json", text, (long)strlen(text), &error);
    scene_free(&scene);
    return good;
}

/* --- Texts --- */

#define HEAD                                                                                                     \
    "{\"camera\": {\"position\": [0, 0, 5], \"look_at\": [0, 0, 0]}, \"screen\": {\"columns\": 4, \"rows\": 3}," \
    "\"materials\": {\"red\": {\"diffuse\": [1, 0, 0]}, \"blue\": {}}, \"objects\": ["

/* Every form that has a way of its own. */
static const char *const objects[] = {
    "{\"material\": \"red\", \"box\": {\"min\": [0, 0, 0], \"max\": [1, 1.5, 2e0]}}",
    "{\"name\": \"a\", \"vertices\": [[0,0,0], [1,0,0], [1,1,0], [0,1,0]], \"faces\": [[0,1,2,3]], \"material\": "
    "\"red\"}",
    "{\"faces\": [[0, 1, 2], {\"vertices\": [0, 2, 3], \"material\": \"blue\"}, {\"material\": \"red\", \"vertices\": "
    "[3, 2, 1, 0]}], \"material\": \"red\", \"vertices\": [[-1, 0, 0.1], [1, 0, 0.1], [1, 1, 0.1], [-1, 1, 0.1]]}",
    "{\"material\": \"red\", \"transform\": [{\"scale\": [1, -2, 1]}, {\"translate\": [0, 0.1, 3]}], \"vertices\": "
    "[[0,0,0],[1.25,0,0],[1,1,0],[0,1,1e-9]], \"faces\": [[0,1,2,3], [2, 1, 0]], \"sided\": \"front\"}",
    "{\"//\": [\"a\", \"b\"], \"name\": \"\\u00e9\", \"material\": \"blue\", \"transform\": [{\"rotate\": {\"axis\": "
    "[1, "
    "1, 0], \"degrees\": 30}}], \"box\": {\"min\": [-3, -3, -3], \"max\": [-2, -2, -2]}}",
    "{\"material\": \"red\", \"nonplanar\": \"split\", \"vertices\": [[0,0,0],[1,0,0],[1,1,0.5],[0,1,0]], \"faces\": "
    "[[0,1,2,3], [0, 1, 2]]}",
    "{\"material\": \"red\", \"vertices\": [], \"faces\": []}",
    "{\"material\": \"red\", \"vertices\": [[0,0,9],[2,0,9],[3,1,9],[2,2,9],[0,2,9]], \"faces\": [[0,1,2,3,4], [0, 1, "
    "2]]}",
    "{\"material\": \"red\", \"vertices\": [[0,0,8],[4,0,8],[1,1,8],[0,4,8]], \"faces\": [[0,1,2,3]]}",
    "{\"material\": \"red\", \"obj\": \"models/house.obj\"}",
};

/* A concave face is cut, which takes the places of the tree. */
enum { OBJECTS = (int)(sizeof objects / sizeof *objects), CONCAVE = 8 };

/* A scene of all objects. The caller frees it. */
static char *whole_text(void)
{
    char *text = calloc(1, 8192);
    TEST_ASSERT_NOT_NULL(text);
    strcpy(text, HEAD);
    for (int i = 0; i < OBJECTS; i++) {
        strcat(text, i > 0 ? ",\n  " : "\n  ");
        strcat(text, objects[i]);
    }
    return strcat(text, "\n], \"lights\": [{\"position\": [1, 2, 3]}]}");
}

static void every_form_should_be_read_in_bulk(void)
{
    char text[2048];
    for (int i = 0; i < OBJECTS - 1; i++) { /* the model is not there */
        snprintf(text, sizeof text, HEAD "%s]}", objects[i]);
        TEST_ASSERT_EQUAL_MESSAGE(i != CONCAVE, in_bulk(text), text);
        assert_ways_agree(text, (long)strlen(text));
    }
    TEST_ASSERT_TRUE(in_bulk(HEAD "]}"));
}

/* Each must not pass in bulk: what the other way accepts is read by that one. */
static void what_is_not_plain_should_be_left_to_the_tree(void)
{
    static const char *const texts[] = {
        "{\"material\": \"red\", \"box\": {\"min\": [0, 0, 0], \"max\": [1, 1, 0]}}",
        "{\"material\": \"red\", \"material\": \"red\", \"box\": {\"min\": [0, 0, 0], \"max\": [1, 1, 1]}}",
        "{\"material\": \"red\", \"b\\u006fx\": {\"min\": [0, 0, 0], \"max\": [1, 1, 1]}, \"box\": {\"min\": [0, 0, "
        "0], "
        "\"max\": [1, 1, 1]}}",
        "{\"material\": \"red\", \"box\": {\"min\": [0, 0, 0], \"max\": [1, 1, 1]}, \"box\": {\"min\": [0, 0, 0], "
        "\"max\": [1, 1, 1]}}",
        "{\"material\": \"red\", \"vertices\": [[0,0,0], [1,0,0], [1,1,0]], \"faces\": [[0,1,2]], \"faces\": "
        "[[0,1,2]]}",
        "{\"material\": \"red\", \"vertices\": [[0,0,0], [1,0,0], [1,1,0]], \"vertices\": [[0,0,0]], \"faces\": "
        "[[0,1,2]]}",
        "{\"material\": \"green\", \"box\": {\"min\": [0, 0, 0], \"max\": [1, 1, 1]}}",
        "{\"box\": {\"min\": [0, 0, 0], \"max\": [1, 1, 1]}}",
        "{\"material\": \"red\", \"box\": {\"min\": [0, 0, 0], \"max\": [1, 1, 01]}}",
        "{\"material\": \"red\", \"box\": {\"min\": [0, 0, 0], \"max\": [1, 1, 1]}},",
        "{\"material\": \"red\", \"box\": {\"min\": [0, 0, 0], \"max\": [1, 1, 1]}} 1",
        "{\"material\": \"red\", \"vertices\": [[0,0,0], [1,0,0], [1,1,0]], \"faces\": [[0,1,3]]}",
        "{\"material\": \"red\", \"vertices\": [[0,0,0], [1,0,0], [1,1,0]], \"faces\": [[0,1,1]]}",
        "{\"material\": \"red\", \"vertices\": [[0,0,0], [1,0,0], [2,0,0]], \"faces\": [[0,1,2]]}",
        "{\"material\": \"red\", \"vertices\": [[0,0,0], [1,0,0], [1,1,0]], \"faces\": [[0,1,2.5]]}",
        "{\"material\": \"red\", \"vertices\": [[0,0,0], [1,0,0], [1,1,0]], \"faces\": [[0,1,2],]}",
        "{\"material\": \"red\", \"vertices\": [[0,0,0], [1,0,0], [1,1,0]]}",
        "{\"material\": \"red\", \"vertices\": [[0,0,0], [1,0,0], [1,1]], \"faces\": []}",
        "{\"material\": \"red\", \"vertices\": [[0,0,0], [1,0,0], [1,1,1e999]], \"faces\": []}",
        "{\"material\": \"red\", \"transform\": [{\"scale\": 1e300}], \"vertices\": [[1e300,0,0]], \"faces\": []}",
        "{\"material\": \"red\"}",
        "{}",
        "1",
    };
    char text[1024];
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        snprintf(text, sizeof text, HEAD "%s]}", texts[i]);
        TEST_ASSERT_FALSE_MESSAGE(in_bulk(text), text);
        assert_ways_agree(text, (long)strlen(text));
    }
    TEST_ASSERT_FALSE(in_bulk("{\"objects\": [], \"objects\": []}"));
}

/* Where the tree lacks vertices and faces, an error has the path and the column that it has with them. */
static void a_fault_should_have_its_place_without_the_long_lists(void)
{
    static const char *const twice = "the key stands twice in this object; keep one of the two";
    static const char *const texts[][3] = {
        {"\"vertices\": [[0,0,0], [1,0,0], [1,1,0]], \"faces\": [[0,1,2], [2,1,0],\n [0,1,3]]", "2:2",
         "objects[1].faces[2]: vertex 3 does not exist; the object has 3 vertices"},
        {"\"vertices\": [[0,0,0], [1,0,0],\n [1,1]], \"faces\": [[0,1,2]]", "2:2",
         "objects[1].vertices[2]: must be a list of three numbers, not of 2"},
        {"\"vertices\": [[0,0,0], [1,0,0], [1,1,0]], \"faces\": [[0,1,2],\n {\"vertices\": [0, 1, null]}]", "2:22",
         "objects[1].faces[1].vertices[2]: must be a whole number, not null"},
        {"\"vertices\": [[0,0,0], [1,0,0], [1,1,0]], \"faces\": [{\"vertices\": [0, 1, 2],\n \"vertices\": 3}]", "2:2",
         "objects[1].faces[0].vertices: "},
        {"\"faces\": [[0,1,2], {\"vertices\": [[{\"a\": 1,\n \"a\": 2}]]}], \"sided\": 1, \"sided\": 2", "2:27",
         "objects[1].sided: "},
        {"\"vertices\": [[0,0,0], [1,0,0], [1,1,0]], \"faces\": [[0,1,2], [0, 1, 2],\n  [1,1,2]]", "2:3",
         "objects[1].faces[2]: the face uses vertex 1 twice"},
    };
    static Error error;
    char text[1024];
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        Scene scene;
        error = (Error){.kind = ERROR_NONE};
        snprintf(text, sizeof text, HEAD "%s, {\"material\": \"red\", %s}]}", objects[0], texts[i][0]);
        assert_ways_agree(text, (long)strlen(text));
        TEST_ASSERT_FALSE(scene_parse_by(SCENE_WAY_ANY, &scene, "x", text, (long)strlen(text), &error));
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(error.text, texts[i][1]), error.text);
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(error.text, texts[i][2]), error.text);
        TEST_ASSERT_TRUE_MESSAGE(i < 3 || i > 4 || strstr(error.text, twice), error.text);
    }
}

/* A key that stands twice is told in the order of the objects that have it, also where the tree lacks one of them. */
static void the_first_key_that_stands_twice_should_be_told(void)
{
    static const char *const lists = "\"vertices\": [], \"faces\": [[0], {\"a\": 1, \"b\": {}, \"a\": 2}]";
    char text[1024];
    static Error error;
    for (int after = 0; after < 2; after++) {
        Scene scene;
        error = (Error){.kind = ERROR_NONE};
        snprintf(text, sizeof text, HEAD "{%s}, {\"box\": {}, \"box\": {}}, {%s}]}", after ? lists : "", lists);
        assert_ways_agree(text, (long)strlen(text));
        TEST_ASSERT_FALSE(scene_parse_by(SCENE_WAY_ANY, &scene, "x", text, (long)strlen(text), &error));
        const char *path = after ? "objects[0].faces[1].a: the key" : "objects[1].box: the key";
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(error.text, path), error.text);
    }
}

/* What is not plain but right is read without a tree of the whole list. */
static void faces_of_other_forms_should_be_accepted(void)
{
    static const char *const text =
        HEAD "{\"material\": \"red\", \"vertices\": [[0,0,0], [1,0,0], [1,1,0]], \"faces\": [[0,1,2], "
             "{\"material\": \"bl\\u0075e\", \"vertices\": [2, 1, 0]}, {\"//\": \"a\", \"vertices\": [0, 1, 2]}]}]}";
    TEST_ASSERT_FALSE(in_bulk(text));
    TEST_ASSERT_TRUE(assert_ways_agree(text, (long)strlen(text)));
}

/* Written in other ways, the same indices. */
static void indices_should_be_numbers_of_any_form(void)
{
    static const char *const text =
        HEAD "{\"material\": \"red\", \"vertices\": [[0,0,0], [1,0,0], [1,1,0]], \"faces\": "
             "[[-0, 1.0, 2e0], [0.1e1, 20E-1, 0.0]]}]}";
    TEST_ASSERT_TRUE(in_bulk(text));
    TEST_ASSERT_TRUE(assert_ways_agree(text, (long)strlen(text)));
}

/* --- Files --- */

static char *read_file(const char *path, long *length)
{
    FILE *file = fopen(path, "rb");
    TEST_ASSERT_NOT_NULL_MESSAGE(file, path);
    fseek(file, 0, SEEK_END);
    *length = ftell(file);
    rewind(file);
    char *text = malloc((size_t)*length + 1);
    TEST_ASSERT_NOT_NULL(text);
    TEST_ASSERT_EQUAL_INT(*length, fread(text, 1, (size_t)*length, file));
    text[*length] = '\0';
    fclose(file);
    return text;
}

static int compare_all(const char *pattern)
{
    glob_t found;
    int good = 0;
    TEST_ASSERT_EQUAL_INT_MESSAGE(0, glob(pattern, 0, NULL, &found), pattern);
    for (size_t i = 0; i < found.gl_pathc; i++) {
        long length;
        char *text = read_file(found.gl_pathv[i], &length);
        good += assert_ways_agree(text, length);
        free(text);
    }
    globfree(&found);
    return good;
}

static void the_ways_should_agree_on_every_file(void)
{
    TEST_ASSERT_GREATER_THAN_INT(10, compare_all("tests/scenes/*.json"));
    TEST_ASSERT_LESS_THAN_INT(10, compare_all("tests/scenes/bad/*.json"));
}

static void the_ways_should_agree_on_a_text_cut_anywhere(void)
{
    char *text = whole_text();
    long length = (long)strlen(text);
    TEST_ASSERT_TRUE(assert_ways_agree(text, length));
    for (long cut = 0; cut < length; cut++)
        TEST_ASSERT_FALSE(assert_ways_agree(text, cut));
    free(text);
}

/* A scene of 2 000 boxes. */
static char *generated_text(long *length)
{
    Error error = {.kind = ERROR_NONE};
    FILE *file = tmpfile();
    TEST_ASSERT_NOT_NULL(file);
    TEST_ASSERT_TRUE(generate_scene(generate_find_kind("city", &error), file, 2000, 0, &error));
    *length = ftell(file);
    rewind(file);
    char *text = malloc((size_t)*length + 1);
    TEST_ASSERT_NOT_NULL(text);
    TEST_ASSERT_EQUAL_INT(*length, fread(text, 1, (size_t)*length, file));
    text[*length] = '\0';
    fclose(file);
    return text;
}

static void the_ways_should_agree_on_a_large_text_cut_or_changed(void)
{
    long length;
    uint64_t state = 11;
    char *text = generated_text(&length);
    TEST_ASSERT_TRUE(in_bulk(text));
    for (int i = 0; i < (is_soak() ? 1000 : 15); i++) {
        long at = (long)(random_next(&state) % (uint64_t)length);
        char kept = text[at];
        assert_ways_agree(text, at);
        text[at] = "0]},\"x- "[random_next(&state) % 8];
        assert_ways_agree(text, length);
        text[at] = kept;
    }
    free(text);
}

/* --- Mutations --- */

/* Another digit keeps most texts valid, with other numbers. */
static long change_digit(char *text, long length, uint64_t *state)
{
    long at = (long)(random_next(state) % (uint64_t)length);
    while (at < length && !(text[at] >= '0' && text[at] <= '9'))
        at++;
    if (at < length)
        text[at] = (char)('0' + random_next(state) % 10);
    return length;
}

static long mutate(char *text, long length, uint64_t *state)
{
    if (random_next(state) % 4)
        return change_digit(text, length, state);
    static const char *const pieces[] = {"[",  "]",  "{",    "}",  ",",        ":",      "\"",      "0",    "-",
                                         ".",  "e",  "1e99", "\\", "vertices", "faces",  "\"box\"", "null", " ",
                                         "\n", "//", "3",    "01", "material", "[0, 1]", "-0.0",    "\xC3"};
    const char *piece = pieces[random_next(state) % (sizeof pieces / sizeof *pieces)];
    long at = (long)(random_next(state) % (uint64_t)length), size = (long)strlen(piece);
    long removed = (long)(random_next(state) % 3) * (long)(random_next(state) % 6);
    removed = at + removed < length ? removed : length - at;
    memmove(text + at + size, text + at + removed, (size_t)(length - at - removed));
    memcpy(text + at, piece, (size_t)size);
    return length - removed + size;
}

static void the_ways_should_agree_on_mutated_texts(void)
{
    char *text = whole_text(), copy[9000];
    long length = (long)strlen(text);
    uint64_t state = 5;
    int count = is_soak() ? 100000 : 6000, good = 0;
    for (int i = 0; i < count; i++) {
        long now = length;
        memcpy(copy, text, (size_t)length);
        for (uint64_t k = random_next(&state) % 3 + 1; k > 0; k--)
            now = mutate(copy, now, &state);
        good += assert_ways_agree(copy, now);
    }
    TEST_ASSERT_GREATER_THAN_INT(count / 20, good); /* so that numbers are compared, too */
    free(text);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(every_form_should_be_read_in_bulk);
    RUN_TEST(what_is_not_plain_should_be_left_to_the_tree);
    RUN_TEST(a_fault_should_have_its_place_without_the_long_lists);
    RUN_TEST(the_first_key_that_stands_twice_should_be_told);
    RUN_TEST(faces_of_other_forms_should_be_accepted);
    RUN_TEST(indices_should_be_numbers_of_any_form);
    RUN_TEST(the_ways_should_agree_on_every_file);
    RUN_TEST(the_ways_should_agree_on_a_text_cut_anywhere);
    RUN_TEST(the_ways_should_agree_on_a_large_text_cut_or_changed);
    RUN_TEST(the_ways_should_agree_on_mutated_texts);
    return UNITY_END();
}
