/* Kept kernels: what was stored comes back, and nothing else does. */
#include "opencl/kernel_cache.h"

#include "unity.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[64];
static const KernelCacheKey key = {0x1234, 0x5678};
static const unsigned char binary[] = "not a kernel, but bytes";

void setUp(void)
{
    strcpy(folder, "/tmp/rectray-cache-XXXXXX");
    TEST_ASSERT_NOT_NULL(mkdtemp(folder));
    setenv("RECTRAY_CACHE_DIR", folder, 1);
}

static void kept_file(char *path, size_t size)
{
    snprintf(path, size, "%s/0000000000001234.kernel", folder);
}

void tearDown(void)
{
    char path[128];
    kept_file(path, sizeof path);
    remove(path);
    rmdir(folder);
}

static void cache_should_give_back_what_was_stored(void)
{
    kernel_cache_store(key, binary, sizeof binary);
    size_t size = 0;
    unsigned char *loaded = kernel_cache_load(key, &size);
    TEST_ASSERT_NOT_NULL(loaded);
    TEST_ASSERT_EQUAL_INT(sizeof binary, size);
    TEST_ASSERT_EQUAL_MEMORY(binary, loaded, sizeof binary);
    free(loaded);
}

static void cache_should_be_empty_at_first(void)
{
    size_t size;
    TEST_ASSERT_NULL(kernel_cache_load(key, &size));
}

static void cache_should_not_give_what_other_sources_made(void)
{
    size_t size;
    kernel_cache_store(key, binary, sizeof binary);
    TEST_ASSERT_NULL(kernel_cache_load((KernelCacheKey){key.place, key.sources + 1}, &size));
    TEST_ASSERT_NULL(kernel_cache_load((KernelCacheKey){key.place + 1, key.sources}, &size));
}

/* Changes or cuts the file at every byte: none of the results may be trusted. */
static void cache_should_not_give_what_was_damaged(void)
{
    char path[128];
    unsigned char whole[256];
    size_t size;
    kernel_cache_store(key, binary, sizeof binary);
    kept_file(path, sizeof path);
    FILE *file = fopen(path, "rb");
    TEST_ASSERT_NOT_NULL(file);
    size_t length = fread(whole, 1, sizeof whole, file);
    fclose(file);
    for (size_t i = 0; i < 2 * length; i++) {
        bool cut = i >= length;
        size_t at = i % length;
        file = fopen(path, "wb");
        whole[at] ^= 1;
        fwrite(whole, 1, cut ? at : length, file);
        whole[at] ^= 1;
        fclose(file);
        TEST_ASSERT_NULL(kernel_cache_load(key, &size));
    }
}

static void cache_should_do_without_a_folder(void)
{
    size_t size;
    setenv("RECTRAY_CACHE_DIR", "", 1);
    kernel_cache_store(key, binary, sizeof binary);
    TEST_ASSERT_NULL(kernel_cache_load(key, &size));
    setenv("RECTRAY_CACHE_DIR", "/dev/null/nowhere", 1);
    kernel_cache_store(key, binary, sizeof binary);
    TEST_ASSERT_NULL(kernel_cache_load(key, &size));
}

static void cache_hash_should_tell_texts_apart_where_they_join(void)
{
    uint64_t ab_c = kernel_cache_hash(kernel_cache_hash(KERNEL_CACHE_HASH_START, "ab"), "c");
    uint64_t a_bc = kernel_cache_hash(kernel_cache_hash(KERNEL_CACHE_HASH_START, "a"), "bc");
    TEST_ASSERT_TRUE(ab_c != a_bc);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(cache_should_be_empty_at_first);
    RUN_TEST(cache_should_give_back_what_was_stored);
    RUN_TEST(cache_should_not_give_what_other_sources_made);
    RUN_TEST(cache_should_not_give_what_was_damaged);
    RUN_TEST(cache_should_do_without_a_folder);
    RUN_TEST(cache_hash_should_tell_texts_apart_where_they_join);
    return UNITY_END();
}
