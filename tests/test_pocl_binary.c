/* Binaries of PoCL are trimmed if each field is as known, and never read beyond their end. */
#include "opencl/pocl_binary.h"

#include "unity.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST = 1024 };

static unsigned char whole[MOST];
static size_t size;
static size_t form_at, kernel_at, kernel_files_at; /* where these parts begin */

void setUp(void)
{
    setenv("POCL_WORK_GROUP_SPECIALIZATION", "0", 1);
    unsetenv("POCL_AFFINITY");
    unsetenv("POCL_DEBUG");
    unsetenv("POCL_CACHE_DIR");
}
void tearDown(void) {}

static void put(const void *bytes, size_t count)
{
    TEST_ASSERT_TRUE(size + count <= MOST);
    memcpy(whole + size, bytes, count);
    size += count;
}

static void put_number(uint64_t number, int bytes)
{
    for (int i = 0; i < bytes; i++) {
        unsigned char byte = (unsigned char)(number >> 8 * i);
        put(&byte, 1);
    }
}

static void put_text(const char *text)
{
    put_number(strlen(text), 4);
    put(text, strlen(text));
}

static void put_file(const char *path, const char *content, size_t bytes)
{
    put_text(path);
    put_number(bytes, 4);
    put(content, bytes);
}

/* A binary with that dummy or form, folder, kernel and files of the kernel. */
static void make_binary(const char *form_path, const char *form, const char *folder, const char *kernel,
                        const char *code_path, int code_files)
{
    size = 0;
    put("poclbin", 8);
    put("DEVICEID", 8);
    put_number(9, 4);
    put_number(1, 4);
    put_number(0, 4);
    put_number(4, 4);
    put_number(1, 4);
    put(folder, 41);
    put_number(8 + strlen(form_path) + strlen(form), 8);
    form_at = size;
    put_file(form_path, form, strlen(form) + (form[0] == '\0'));
    if (form[0] == '\0')
        whole[form_at - 8]++;
    kernel_at = size;
    size_t code = (8 + strlen(code_path) + 10) * (size_t)code_files;
    put_number(24 + strlen(kernel) + 60 + code, 8);
    put_number(code, 8);
    put_number(40, 4);
    put_text(kernel);
    for (int i = 0; i < 60; i++)
        put(&(char){(char)i}, 1);
    kernel_files_at = size;
    for (int i = 0; i < code_files; i++)
        put_file(code_path,
                 "\x7f"
                 "ELF rest.",
                 10);
}

#define FORM "BC\xc0\xde and so on"
#define FOLDER "AP/AHMNECHNBNCKOFKLJEIMHOGEBCLNCPPEOFBGC"
#define FOLDER_OF_TRIMMED "AP/AHMNECHNBNCKOFKLJEIMHOGEBCLNCPPEOFBGc"

static void make_usual(void)
{
    make_binary("/program.bc", FORM, FOLDER, "render", "/render/0-0-0/render.so", 1);
}

/* Trims a copy that ends where its memory ends, so that a sanitizer sees each read beyond. */
static bool trim(const unsigned char *bytes, size_t count, PoclBinary *trimmed)
{
    unsigned char *copy = malloc(count > 0 ? count : 1);
    TEST_ASSERT_NOT_NULL(copy);
    memcpy(copy, bytes, count);
    bool ok = pocl_binary_trim(copy, count, trimmed);
    free(copy);
    return ok;
}

static void assert_is_not_trimmed(void)
{
    PoclBinary trimmed;
    TEST_ASSERT_FALSE(trim(whole, size, &trimmed));
}

static void trimmed_binary_should_have_a_dummy_and_a_folder_of_its_own(void)
{
    PoclBinary trimmed;
    make_usual();
    TEST_ASSERT_TRUE(trim(whole, size, &trimmed));
    TEST_ASSERT_EQUAL_STRING(FOLDER_OF_TRIMMED "/render/0-0-0/render.so", trimmed.code_path);
    TEST_ASSERT_EQUAL_INT(10, trimmed.code_size);
    make_binary("/program.xx", "", FOLDER_OF_TRIMMED, "render", "/render/0-0-0/render.so", 1);
    TEST_ASSERT_EQUAL_INT(size, trimmed.size);
    TEST_ASSERT_EQUAL_MEMORY(whole, trimmed.bytes, size);
    free(trimmed.bytes);
}

static void binary_should_stay_whole_when_it_is_cut_or_goes_on(void)
{
    PoclBinary trimmed;
    make_usual();
    for (size_t cut = 0; cut < size; cut++)
        TEST_ASSERT_FALSE(trim(whole, cut, &trimmed));
    put_number(0, 1);
    assert_is_not_trimmed();
}

/* The bytes that may have any value: the device, the folder within A to P, and what only PoCL reads. */
static bool may_differ(size_t at, unsigned char value)
{
    if (at >= 8 && at < 16)
        return true;
    if (at >= 36 && at < 76)
        return at != 38 && value >= 'A' && value <= 'P';
    size_t form_content = form_at + 4 + 11 + 4 + 4, code_content = size - 6;
    size_t arguments = kernel_at + 16, name_end = kernel_at + 24 + 6;
    return (at >= form_content && at < kernel_at) || (at >= arguments && at < arguments + 4) ||
           (at >= name_end && at < kernel_files_at) || at >= code_content;
}

static void binary_should_stay_whole_when_a_byte_of_its_form_differs(void)
{
    make_usual();
    int kept = 0;
    for (size_t at = 0; at < size; at++)
        for (int value = 0; value < 256; value++) {
            unsigned char old = whole[at];
            if (value == old)
                continue;
            PoclBinary trimmed;
            whole[at] = (unsigned char)value;
            bool ok = trim(whole, size, &trimmed);
            whole[at] = old;
            if (ok)
                free(trimmed.bytes);
            TEST_ASSERT_EQUAL_INT(may_differ(at, (unsigned char)value), ok);
            kept += !ok;
        }
    TEST_ASSERT_GREATER_THAN(10000, kept);
}

static void binary_should_stay_whole_when_its_files_are_others(void)
{
    make_binary("/program.xx", FORM, FOLDER, "render", "/render/0-0-0/render.so", 1);
    assert_is_not_trimmed();
    make_binary("/program.bc", "no bitcode", FOLDER, "render", "/render/0-0-0/render.so", 1);
    assert_is_not_trimmed();
    make_binary("/program.bc", FORM, FOLDER, "render", "/render/0-0-0/render.so", 0);
    assert_is_not_trimmed();
    make_binary("/program.bc", FORM, FOLDER, "render", "/render/0-0-0/render.so", 2);
    assert_is_not_trimmed();
    make_binary("/program.bc", FORM, FOLDER, "render", "/render/1-1-1/render.so", 1);
    assert_is_not_trimmed();
    make_binary("/program.bc", FORM, FOLDER, "render", "/render/1-1-1-goffs0/render.so", 1);
    assert_is_not_trimmed();
    make_binary("/program.bc", FORM, FOLDER, "render", "/rander/0-0-0/render.so", 1);
    assert_is_not_trimmed();
    make_binary("/program.bc", FORM, FOLDER, "../../x", "/../../x/0-0-0/../../x.so", 1);
    assert_is_not_trimmed();
    make_binary("/program.bc", FORM, FOLDER_OF_TRIMMED, "render", "/render/0-0-0/render.so", 1);
    assert_is_not_trimmed();
}

static void only_the_tried_driver_should_be_known(void)
{
    const char *pocl = "Portable Computing Language";
    TEST_ASSERT_TRUE(pocl_binary_is_known(pocl, "3.1+debian"));
    TEST_ASSERT_FALSE(pocl_binary_is_known(pocl, "3.1"));
    TEST_ASSERT_FALSE(pocl_binary_is_known(pocl, "6.0+debian"));
    TEST_ASSERT_FALSE(pocl_binary_is_known("Intel(R) OpenCL", "3.1+debian"));
}

static void driver_should_be_unknown_when_the_environment_tells_it_to_work_otherwise(void)
{
    const char *pocl = "Portable Computing Language", *driver = "3.1+debian";
    setenv("POCL_AFFINITY", "1", 1);
    setenv("POCL_CACHE_DIR", "/tmp", 1);
    TEST_ASSERT_TRUE(pocl_binary_is_known(pocl, driver));
    setenv("POCL_DEBUG", "all", 1);
    TEST_ASSERT_FALSE(pocl_binary_is_known(pocl, driver));
    unsetenv("POCL_DEBUG");
    const char *others[] = {"1", "", "00"};
    for (int i = 0; i < 3; i++) {
        setenv("POCL_WORK_GROUP_SPECIALIZATION", others[i], 1);
        TEST_ASSERT_FALSE(pocl_binary_is_known(pocl, driver));
    }
    unsetenv("POCL_WORK_GROUP_SPECIALIZATION");
    TEST_ASSERT_FALSE(pocl_binary_is_known(pocl, driver));
}

static void make_file(const char *path, const char *content)
{
    FILE *file = fopen(path, "wb");
    TEST_ASSERT_NOT_NULL(file);
    fputs(content, file);
    fclose(file);
}

/* The machine code is there whole, whatever was there before. PoCL alone makes the dummy. */
static void binary_should_count_as_unpacked_when_its_code_and_the_dummy_are_there(void)
{
    char folder[] = "/tmp/rectray-pocl-XXXXXX", code[512], dummy[256];
    PoclBinary trimmed;
    TEST_ASSERT_NOT_NULL(mkdtemp(folder));
    setenv("POCL_CACHE_DIR", folder, 1);
    make_usual();
    TEST_ASSERT_TRUE(trim(whole, size, &trimmed));
    snprintf(code, sizeof code, "%s/%s", folder, trimmed.code_path);
    snprintf(dummy, sizeof dummy, "%s/" FOLDER_OF_TRIMMED "/program.xx", folder);
    TEST_ASSERT_TRUE(pocl_binary_unpack(&trimmed));
    TEST_ASSERT_FALSE(pocl_binary_is_unpacked(&trimmed));
    make_file(dummy, "?");
    TEST_ASSERT_TRUE(pocl_binary_is_unpacked(&trimmed));
    const char *others[] = {"", "\x7f",
                            "\x7f"
                            "ELF rest.?",
                            "\x7f"
                            "ELF nest."};
    for (int i = 0; i < 4; i++) {
        make_file(code, others[i]);
        TEST_ASSERT_FALSE(pocl_binary_is_unpacked(&trimmed));
        TEST_ASSERT_TRUE(pocl_binary_unpack(&trimmed));
        TEST_ASSERT_TRUE(pocl_binary_is_unpacked(&trimmed));
    }
    remove(dummy);
    remove(code);
    TEST_ASSERT_EQUAL_INT(0, mkdir(code, 0700));
    TEST_ASSERT_FALSE(pocl_binary_unpack(&trimmed));
    remove(code);
    for (char *slash; (slash = strrchr(code, '/')) > code + strlen(folder) - 1;) {
        *slash = '\0';
        TEST_ASSERT_EQUAL_INT(0, rmdir(code)); /* nothing else was left there */
    }
    free(trimmed.bytes);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(trimmed_binary_should_have_a_dummy_and_a_folder_of_its_own);
    RUN_TEST(binary_should_stay_whole_when_it_is_cut_or_goes_on);
    RUN_TEST(binary_should_stay_whole_when_a_byte_of_its_form_differs);
    RUN_TEST(binary_should_stay_whole_when_its_files_are_others);
    RUN_TEST(only_the_tried_driver_should_be_known);
    RUN_TEST(driver_should_be_unknown_when_the_environment_tells_it_to_work_otherwise);
    RUN_TEST(binary_should_count_as_unpacked_when_its_code_and_the_dummy_are_there);
    return UNITY_END();
}
