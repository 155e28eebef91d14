/* The text of an OpenCL program: a kernel file with all that it includes, each once, and every line where the #line
 * directives say. Small files are written to a folder; the kernels themselves are read as they are. */
#include "opencl/opencl_sources.h"

#include "opencl/kernel_sources.h"

#include "unity.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *const ROOTS[] = {
    "tile/render.cl", "packet/render.cl", "packet/cast.cl",        "adaptive/refine.cl", "plain.cl", "gpu.cl",
    "gpu_exact.cl",   "gpu_adaptive.cl",  "gpu_adaptive_exact.cl", "gpu_judge.cl",       "pairs.cl", "pairs/cast.cl"};
enum { ROOT_COUNT = sizeof ROOTS / sizeof ROOTS[0] };
static const char *const TREES[] = {"bvh", "kdtree", "all_faces"};

static char folder[64];
static Error error;

static void path_of(char *path, size_t size, const char *name)
{
    snprintf(path, size, "%s/%s", folder, name);
}

/* Writes a file below the folder, whose own folder is made if need be. */
static void put(const char *name, const char *text)
{
    char path[128];
    path_of(path, sizeof path, name);
    char *slash = strrchr(path, '/');
    *slash = '\0';
    mkdir(path, 0700);
    *slash = '/';
    FILE *file = fopen(path, "w");
    TEST_ASSERT_NOT_NULL(file);
    fputs(text, file);
    fclose(file);
}

void setUp(void)
{
    error = (Error){.kind = ERROR_NONE};
    strcpy(folder, "/tmp/rectray-sources-XXXXXX");
    TEST_ASSERT_NOT_NULL(mkdtemp(folder));
    setenv("RECTRAY_KERNELS", folder, 1);
}

void tearDown(void)
{
    static const char *const files[] = {"a/root.cl",     "a/beside.cl",          "b/leaf.cl",           "packet/bvh.cl",
                                        "packet/one.cl", "adaptive/beam_bvh.cl", "adaptive/beam_one.cl"};
    static const char *const folders[] = {"a", "b", "packet", "adaptive", ""};
    char path[128];
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        path_of(path, sizeof path, files[i]);
        remove(path);
    }
    for (size_t i = 0; i < sizeof folders / sizeof folders[0]; i++) {
        path_of(path, sizeof path, folders[i]);
        rmdir(path);
    }
}

/* The text of the program whose root is that file; the next call frees it. */
static const char *expanded(const char *root, const char *tree)
{
    static char *text;
    free(text);
    text = opencl_sources(root, tree, "exact", &error);
    TEST_ASSERT_NOT_NULL_MESSAGE(text, error.text);
    return text;
}

static int times_of(const char *text, const char *piece)
{
    int times = 0;
    for (const char *at = strstr(text, piece); at; at = strstr(at + 1, piece))
        times++;
    return times;
}

/* --- Small files --- */

static void an_include_should_become_the_text_of_its_file(void)
{
    put("a/root.cl", "one\n#include \"b/leaf.cl\"\nthree\n");
    put("b/leaf.cl", "two\n");
    TEST_ASSERT_EQUAL_STRING("#line 1 \"a/root.cl\"\none\n"
                             "#line 1 \"b/leaf.cl\"\ntwo\n\n"
                             "#line 3 \"a/root.cl\"\nthree\n\n",
                             expanded("a/root.cl", "bvh"));
}

static void a_file_that_is_included_twice_should_stand_once(void)
{
    put("a/root.cl", "#include \"b/leaf.cl\"\n#include \"a/beside.cl\"\n#include \"b/leaf.cl\"\n");
    put("a/beside.cl", "#include \"b/leaf.cl\"\nbeside\n");
    put("b/leaf.cl", "leaf\n");
    const char *text = expanded("a/root.cl", "bvh");
    TEST_ASSERT_EQUAL_INT(1, times_of(text, "leaf\n"));
    TEST_ASSERT_TRUE(strstr(text, "leaf\n") < strstr(text, "beside\n"));
}

static void a_name_without_a_folder_should_stand_beside_its_includer(void)
{
    put("a/root.cl", "#include \"beside.cl\"\n");
    put("a/beside.cl", "beside\n");
    TEST_ASSERT_NOT_NULL(strstr(expanded("a/root.cl", "bvh"), "#line 1 \"a/beside.cl\"\nbeside\n"));
}

static void an_include_may_be_written_as_c_allows(void)
{
    put("a/root.cl", "\n\n  #  include   \"b/leaf.cl\"   /* why */\nlast");
    put("b/leaf.cl", "leaf");
    TEST_ASSERT_EQUAL_STRING("#line 1 \"a/root.cl\"\n\n\n"
                             "#line 1 \"b/leaf.cl\"\nleaf\n"
                             "#line 4 \"a/root.cl\"\nlast\n",
                             expanded("a/root.cl", "bvh"));
}

static void other_directives_should_stay(void)
{
    const char *lines = "#define X 1\n#if X\n#pragma OPENCL EXTENSION cl_khr_fp64 : enable\n#endif\n"
                        "#include OTHER\n/* #include \"b/leaf.cl\" */\n";
    put("a/root.cl", lines);
    TEST_ASSERT_NOT_NULL(strstr(expanded("a/root.cl", "bvh"), lines));
}

static void the_tree_should_be_the_one_that_the_host_names(void)
{
    put("a/root.cl", "#include TREE\n#include BEAM_TREE /* with beams */\n");
    put("packet/bvh.cl", "bvh\n");
    put("adaptive/beam_bvh.cl", "beam\n");
    put("packet/one.cl", "another tree\n");
    put("adaptive/beam_one.cl", "another beam\n");
    const char *text = expanded("a/root.cl", "bvh");
    TEST_ASSERT_NOT_NULL(strstr(text, "#line 1 \"packet/bvh.cl\"\nbvh\n"));
    TEST_ASSERT_NOT_NULL(strstr(text, "#line 1 \"adaptive/beam_bvh.cl\"\nbeam\n"));
    TEST_ASSERT_NULL(strstr(text, "another"));
    TEST_ASSERT_NOT_NULL(strstr(expanded("a/root.cl", "one"), "another tree\n"));
}

/* --- What is wrong --- */

static void assert_refused(const char *root, const char *expected)
{
    TEST_ASSERT_NULL(opencl_sources(root, "bvh", "exact", &error));
    TEST_ASSERT_EQUAL_INT(ERROR_SYSTEM, error.kind);
    TEST_ASSERT_EQUAL_STRING(expected, error.text);
}

static void a_missing_file_of_the_folder_should_be_named_with_its_includer(void)
{
    char expected[256];
    put("a/root.cl", "one\n#include \"b/leaf.cl\"\n");
    put("b/leaf.cl", "\n\n\n#include \"nowhere.cl\"\n");
    snprintf(expected, sizeof expected, "%s/b/leaf.cl:4: %s/b/nowhere.cl: cannot be opened: No such file or directory",
             folder, folder);
    assert_refused("a/root.cl", expected);
}

static void a_missing_root_should_be_named(void)
{
    char expected[256];
    snprintf(
        expected, sizeof expected,
        "%s/a/root.cl: cannot be opened: No such file or directory; RECTRAY_KERNELS must name a folder like kernels/",
        folder);
    assert_refused("a/root.cl", expected);
}

static void files_that_include_one_another_should_be_refused(void)
{
    put("a/root.cl", "#include \"b/leaf.cl\"\nroot\n");
    put("b/leaf.cl", "leaf\n#include \"a/root.cl\"\n");
    char expected[256];
    snprintf(expected, sizeof expected,
             "%s/b/leaf.cl:2: a/root.cl is included in a circle: it leads to this line itself", folder);
    assert_refused("a/root.cl", expected);
}

static void a_file_that_is_not_in_the_program_should_be_named(void)
{
    setenv("RECTRAY_KERNELS", "", 1);
    assert_refused("tile/nowhere.cl", "there is no kernel file tile/nowhere.cl in the program");
}

static void a_tree_that_is_not_in_the_program_should_be_named_with_its_includer(void)
{
    setenv("RECTRAY_KERNELS", "", 1);
    TEST_ASSERT_NULL(opencl_sources("packet/cast.cl", "oak", "exact", &error));
    TEST_ASSERT_EQUAL_INT(ERROR_SYSTEM, error.kind);
    TEST_ASSERT_EQUAL_INT(0, strncmp(error.text, "kernels/packet/", strlen("kernels/packet/")));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(error.text, ": there is no kernel file packet/oak.cl in the program"),
                                 error.text);
}

/* --- The kernels --- */

static const char *embedded(const char *name)
{
    for (int i = 0; i < kernel_source_count; i++)
        if (strcmp(kernel_sources[i].name, name) == 0)
            return kernel_sources[i].text;
    return NULL;
}

/* Line `number`, from 1, of a text; its length without the newline. An end that is passed is an empty line. */
static const char *line_of(const char *text, int number, size_t *length)
{
    while (number-- > 1 && *text) {
        text += strcspn(text, "\n");
        text += *text == '\n';
    }
    *length = strcspn(text, "\n");
    return text;
}

/* Each line that is no directive of ours is the one that the last directive and the lines since then say. */
static void assert_places(const char *text)
{
    char name[128] = "";
    int line = 0, lines = 0;
    while (*text) {
        size_t length = strcspn(text, "\n"), expected_length;
        if (sscanf(text, "#line %d \"%127[^\"]\"", &line, name) != 2) {
            const char *file = embedded(name);
            TEST_ASSERT_NOT_NULL_MESSAGE(file, name);
            const char *expected = line_of(file, line++, &expected_length);
            TEST_ASSERT_EQUAL_INT_MESSAGE(expected_length, length, name);
            TEST_ASSERT_EQUAL_INT_MESSAGE(0, strncmp(expected, text, length), name);
            lines++;
        }
        text += length + 1;
    }
    TEST_ASSERT_GREATER_THAN_INT(100, lines);
}

static void every_line_of_the_kernels_should_be_where_the_directives_say(void)
{
    setenv("RECTRAY_KERNELS", "", 1);
    for (int root = 0; root < ROOT_COUNT; root++)
        for (int tree = 0; tree < 3; tree++)
            assert_places(expanded(ROOTS[root], TREES[tree]));
}

static void the_folder_of_the_kernels_should_give_the_program_s_own_text(void)
{
    for (int root = 0; root < ROOT_COUNT; root++) {
        setenv("RECTRAY_KERNELS", "kernels", 1);
        char *from_folder = opencl_sources(ROOTS[root], "bvh", "exact", &error);
        TEST_ASSERT_NOT_NULL_MESSAGE(from_folder, error.text);
        setenv("RECTRAY_KERNELS", "", 1);
        TEST_ASSERT_EQUAL_INT(0, strcmp(from_folder, expanded(ROOTS[root], "bvh")));
        free(from_folder);
    }
}

static bool holds(const char *root, const char *tree, const char *beginning)
{
    char directive[128];
    snprintf(directive, sizeof directive, "#line 1 \"%s", beginning);
    return strstr(expanded(root, tree), directive) != NULL;
}

static void a_program_should_hold_only_what_its_root_includes(void)
{
    setenv("RECTRAY_KERNELS", "", 1);
    for (int tree = 0; tree < 3; tree++) {
        TEST_ASSERT_FALSE(holds("tile/render.cl", TREES[tree], "adaptive/"));
        TEST_ASSERT_FALSE(holds("adaptive/refine.cl", TREES[tree], "tile/"));
        TEST_ASSERT_FALSE(holds("packet/cast.cl", TREES[tree], "tile/"));
        TEST_ASSERT_FALSE(holds("packet/cast.cl", TREES[tree], "adaptive/"));
        TEST_ASSERT_FALSE(holds("packet/cast.cl", TREES[tree], "packet/shade"));
        TEST_ASSERT_TRUE(holds("tile/render.cl", TREES[tree], "packet/shade"));
        TEST_ASSERT_FALSE(holds("plain.cl", TREES[tree], "packet/"));
        for (int other = 0; other < 3; other++) {
            char name[64];
            snprintf(name, sizeof name, "packet/%s.cl", TREES[other]);
            TEST_ASSERT_EQUAL_INT(other == tree, holds("packet/cast.cl", TREES[tree], name));
            snprintf(name, sizeof name, "adaptive/beam_%s.cl", TREES[other]);
            TEST_ASSERT_EQUAL_INT(other == tree, holds("adaptive/refine.cl", TREES[tree], name));
            snprintf(name, sizeof name, "plain/%s.cl", TREES[other]);
            TEST_ASSERT_EQUAL_INT(other == tree, holds("plain.cl", TREES[tree], name));
        }
    }
}

static void arithmetic_should_choose_a_file_of_the_plain_kernel(void)
{
    static const char *const arithmetics[] = {"exact", "textbook"};
    setenv("RECTRAY_KERNELS", "", 1);
    for (int i = 0; i < 2; i++) {
        char *text = opencl_sources("plain.cl", "bvh", arithmetics[i], &error);
        TEST_ASSERT_NOT_NULL_MESSAGE(text, error.text);
        TEST_ASSERT_EQUAL_INT(i == 0, strstr(text, "#line 1 \"plain/exact_arithmetic.cl\"") != NULL);
        TEST_ASSERT_EQUAL_INT(i == 1, strstr(text, "#line 1 \"plain/textbook_arithmetic.cl\"") != NULL);
        TEST_ASSERT_EQUAL_INT(i == 0, strstr(text, "#line 1 \"shared/exact.cl\"") != NULL);
        free(text);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(an_include_should_become_the_text_of_its_file);
    RUN_TEST(a_file_that_is_included_twice_should_stand_once);
    RUN_TEST(a_name_without_a_folder_should_stand_beside_its_includer);
    RUN_TEST(an_include_may_be_written_as_c_allows);
    RUN_TEST(other_directives_should_stay);
    RUN_TEST(the_tree_should_be_the_one_that_the_host_names);
    RUN_TEST(a_missing_file_of_the_folder_should_be_named_with_its_includer);
    RUN_TEST(a_missing_root_should_be_named);
    RUN_TEST(files_that_include_one_another_should_be_refused);
    RUN_TEST(a_file_that_is_not_in_the_program_should_be_named);
    RUN_TEST(a_tree_that_is_not_in_the_program_should_be_named_with_its_includer);
    RUN_TEST(every_line_of_the_kernels_should_be_where_the_directives_say);
    RUN_TEST(the_folder_of_the_kernels_should_give_the_program_s_own_text);
    RUN_TEST(a_program_should_hold_only_what_its_root_includes);
    RUN_TEST(arithmetic_should_choose_a_file_of_the_plain_kernel);
    return UNITY_END();
}
