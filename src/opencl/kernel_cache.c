/* Compiled kernels kept from one run to the next. */
#include "opencl/kernel_cache.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { PATH_BYTES = 4096 };

/* What stands before the binary in a file. */
typedef struct Header {
    char magic[8];
    uint64_t sources, size, checksum;
} Header;

static const char magic[8] = "rectray2";

/* As FNV-1a, but eight bytes at a time, which takes 1 ms less at each start; a shift brings the high bits down. Each
 * step can be undone, so that one changed word always changes the hash. */
static uint64_t hash_bytes(uint64_t hash, const unsigned char *bytes, size_t size)
{
    hash = (hash ^ size) * 1099511628211u;
    for (size_t i = 0; i < size; i += sizeof(uint64_t)) {
        uint64_t word = 0;
        size_t left = size - i;
        memcpy(&word, bytes + i, left < sizeof word ? left : sizeof word);
        hash = (hash ^ word) * 1099511628211u;
        hash ^= hash >> 32;
    }
    return hash;
}

uint64_t kernel_cache_hash(uint64_t hash, const char *text)
{
    return hash_bytes(hash, (const unsigned char *)text, strlen(text) + 1);
}

/* The folder's path, "" if there is to be none; its last two levels are made if `make` says so. */
static void find_folder(char *folder, bool make)
{
    const char *own = getenv("RECTRAY_CACHE_DIR"), *xdg = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    int length = 0;
    if (own)
        length = snprintf(folder, PATH_BYTES, "%s", own);
    else if (xdg && xdg[0] == '/')
        length = snprintf(folder, PATH_BYTES, "%s/rectray", xdg);
    else if (home && home[0] == '/')
        length = snprintf(folder, PATH_BYTES, "%s/.cache/rectray", home);
    if (length <= 0 || length >= PATH_BYTES - 64) {
        folder[0] = '\0';
        return;
    }
    char *slash = strrchr(folder, '/');
    if (make && slash && slash != folder) {
        *slash = '\0';
        mkdir(folder, 0700);
        *slash = '/';
    }
    if (make)
        mkdir(folder, 0700);
}

/* The name of the key's file; false if there is no place for one. */
static bool find_file(KernelCacheKey key, bool make, char *path)
{
    find_folder(path, make);
    if (!path[0])
        return false;
    size_t length = strlen(path);
    snprintf(path + length, PATH_BYTES - length, "/%016llx.kernel", (unsigned long long)key.place);
    return true;
}

unsigned char *kernel_cache_load(KernelCacheKey key, size_t *size)
{
    char path[PATH_BYTES];
    FILE *file = find_file(key, false, path) ? fopen(path, "rb") : NULL;
    if (!file)
        return NULL;
    Header header;
    unsigned char *binary = NULL;
    bool ok = fread(&header, sizeof header, 1, file) == 1 && memcmp(header.magic, magic, sizeof magic) == 0 &&
              header.sources == key.sources && header.size > 0 && header.size <= KERNEL_CACHE_FILE_MAX &&
              (binary = malloc((size_t)header.size)) && fread(binary, (size_t)header.size, 1, file) == 1 &&
              hash_bytes(KERNEL_CACHE_HASH_START, binary, (size_t)header.size) == header.checksum;
    fclose(file);
    if (!ok) {
        free(binary);
        return NULL;
    }
    *size = (size_t)header.size;
    return binary;
}

void kernel_cache_store(KernelCacheKey key, const unsigned char *binary, size_t size)
{
    char path[PATH_BYTES], temporary[PATH_BYTES + 32];
    if (size == 0 || size > KERNEL_CACHE_FILE_MAX || !find_file(key, true, path))
        return;
    snprintf(temporary, sizeof temporary, "%s.%ld", path, (long)getpid());
    FILE *file = fopen(temporary, "wb");
    if (!file)
        return;
    Header header = {
        .sources = key.sources, .size = size, .checksum = hash_bytes(KERNEL_CACHE_HASH_START, binary, size)};
    memcpy(header.magic, magic, sizeof magic);
    bool ok = fwrite(&header, sizeof header, 1, file) == 1 && fwrite(binary, size, 1, file) == 1;
    ok = fclose(file) == 0 && ok;
    if (!ok || rename(temporary, path) != 0)
        remove(temporary);
}
