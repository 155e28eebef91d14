/* Kept binaries of PoCL without what a warm start does not need. */
#include "opencl/pocl_binary.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

extern char **environ;

/* Debian 12's. Another version needs the same trials: docs/performance.md, "Cold and warm". */
static const char known_platform[] = "Portable Computing Language", known_driver[] = "3.1+debian";

/* Settings of PoCL that change nothing about the files of a binary. */
static const char *const harmless[] = {"POCL_CACHE_DIR=", "POCL_AFFINITY=", "POCL_MAX_PTHREAD_COUNT=",
                                       "POCL_CPU_MAX_CU_COUNT=", "POCL_WORK_GROUP_SPECIALIZATION=0"};

static bool is_harmless(const char *setting)
{
    for (size_t i = 0; i < sizeof harmless / sizeof harmless[0]; i++) {
        size_t length = strlen(harmless[i]);
        if (strncmp(setting, harmless[i], length) == 0 && (harmless[i][length - 1] == '=' || !setting[length]))
            return true;
    }
    return false;
}

bool pocl_binary_is_known(const char *platform, const char *driver)
{
    const char *specialization = getenv("POCL_WORK_GROUP_SPECIALIZATION");
    if (strcmp(platform, known_platform) != 0 || strcmp(driver, known_driver) != 0 || !specialization)
        return false;
    for (char **setting = environ; *setting; setting++)
        if (strncmp(*setting, "POCL_", 5) == 0 && !is_harmless(*setting))
            return false;
    return true;
}

/* --- The form of a binary: numbers are little-endian, a file is its path and its content, each after its size. */

enum {
    MAGIC_BYTES = 8,
    DEVICE_BYTES = 8,
    HASH_BYTES = 41, /* XX/XXXX...: a folder of PoCL's cache, in the letters A to P; and a NUL */
    NAME_BYTES = 64,
    PATH_BYTES = 4096
};

static const unsigned char magic[MAGIC_BYTES] = "poclbin";
/* Version 9; one kernel; flags; a program that is ready to run. */
static const unsigned char settings[] = {9, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 4, 0, 0, 0, 1, 0, 0, 0};
static const char form_path[] = "/program.bc", dummy_path[] = "/program.xx";
static const unsigned char form_begin[] = {'B', 'C', 0xc0, 0xde}, code_begin[] = {0x7f, 'E', 'L', 'F'};

/* Bytes that are still to be read. `failed` stays set. */
typedef struct Bytes {
    const unsigned char *at;
    size_t left;
    bool failed;
} Bytes;

/* The next bytes; NULL if there are not so many. */
static const unsigned char *take(Bytes *b, uint64_t size)
{
    if (b->failed || size > b->left) {
        b->failed = true;
        return NULL;
    }
    const unsigned char *taken = b->at;
    b->at += size;
    b->left -= (size_t)size;
    return taken;
}

static uint64_t take_number(Bytes *b, int size)
{
    const unsigned char *taken = take(b, (uint64_t)size);
    uint64_t number = 0;
    for (int i = size - 1; taken && i >= 0; i--)
        number = number << 8 | taken[i];
    return number;
}

/* Takes bytes that must have that value. */
static void take_known(Bytes *b, const void *known, size_t size)
{
    const unsigned char *taken = take(b, size);
    if (taken && memcmp(taken, known, size) != 0)
        b->failed = true;
}

/* Takes a file of that path whose content begins with four known bytes. Returns the size of the content. */
static size_t take_file(Bytes *b, const char *path, const unsigned char *begin)
{
    size_t length = strlen(path);
    if (take_number(b, 4) != length)
        b->failed = true;
    take_known(b, path, length);
    uint64_t size = take_number(b, 4);
    const unsigned char *content = take(b, size);
    if (!content || size < 4 || memcmp(content, begin, 4) != 0)
        b->failed = true;
    return (size_t)size;
}

/* Takes the name of the folder in PoCL's cache. */
static void take_hash(Bytes *b, char *hash)
{
    const unsigned char *taken = take(b, HASH_BYTES);
    for (int i = 0; taken && i < HASH_BYTES; i++) {
        bool fits = i == 2 ? taken[i] == '/' : i == HASH_BYTES - 1 ? !taken[i] : taken[i] >= 'A' && taken[i] <= 'P';
        b->failed |= !fits;
        hash[i] = (char)taken[i];
    }
}

/* Takes the kernel's name: small letters and underscores. */
static void take_name(Bytes *b, char *name)
{
    uint64_t length = take_number(b, 4);
    const unsigned char *taken = length > 0 && length < NAME_BYTES ? take(b, length) : NULL;
    b->failed |= !taken;
    for (uint64_t i = 0; taken && i < length; i++) {
        b->failed |= taken[i] != '_' && (taken[i] < 'a' || taken[i] > 'z');
        name[i] = (char)taken[i];
        name[i + 1] = '\0';
    }
}

/* Takes the kernel: its description, and one file of machine code that runs groups of any size. */
static void take_kernel(Bytes *b, PoclBinary *found)
{
    size_t all = b->left;
    char name[NAME_BYTES] = "", path[2 * NAME_BYTES + 16];
    if (take_number(b, 8) != all)
        b->failed = true;
    uint64_t files = take_number(b, 8);
    take_number(b, 4);
    take_name(b, name);
    if (b->failed || files > b->left) {
        b->failed = true;
        return;
    }
    take(b, b->left - files); /* arguments and attributes */
    snprintf(path, sizeof path, "/%s/0-0-0/%s.so", name, name);
    found->code_size = take_file(b, path, code_begin);
    strcat(found->code_path, path);
}

static unsigned char *put(unsigned char *out, const void *bytes, size_t size)
{
    memcpy(out, bytes, size);
    return out + size;
}

static unsigned char *put_number(unsigned char *out, uint64_t number, int size)
{
    for (int i = 0; i < size; i++)
        *out++ = (unsigned char)(number >> 8 * i);
    return out;
}

bool pocl_binary_trim(const unsigned char *whole, size_t size, PoclBinary *trimmed)
{
    Bytes b = {whole, size, false};
    *trimmed = (PoclBinary){0};
    take_known(&b, magic, sizeof magic);
    take(&b, DEVICE_BYTES);
    take_known(&b, settings, sizeof settings);
    take_hash(&b, trimmed->code_path);
    uint64_t files = take_number(&b, 8);
    size_t left = b.left;
    take_file(&b, form_path, form_begin);
    if (b.failed || files != left - b.left)
        return false;
    Bytes kernel = b;
    take_kernel(&b, trimmed);
    if (b.failed || b.left > 0)
        return false;

    /* A folder of its own, since PoCL would read the form that it has in its cache. A small letter is not PoCL's. */
    const size_t head = sizeof magic + DEVICE_BYTES + sizeof settings, dummy = sizeof dummy_path - 1;
    char *last = trimmed->code_path + HASH_BYTES - 2;
    *last = (char)(*last - 'A' + 'a');
    trimmed->size = head + HASH_BYTES + 8 + 4 + dummy + 4 + 1 + kernel.left;
    unsigned char *out = trimmed->bytes = malloc(trimmed->size);
    if (!out)
        return false;
    out = put(out, whole, head);
    out = put(out, trimmed->code_path, HASH_BYTES - 1);
    *out++ = '\0';
    out = put_number(out, 4 + dummy + 4 + 1, 8);
    out = put_number(out, dummy, 4);
    out = put(out, dummy_path, dummy);
    out = put_number(out, 1, 4);
    *out++ = '\0';
    put(out, kernel.at, kernel.left);
    return true;
}

/* A path below the folder of PoCL's cache. False: there is none. */
static bool find_path(const char *below, char *path, size_t size)
{
    const char *own = getenv("POCL_CACHE_DIR"), *xdg = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    const char *folder = own ? own : xdg ? xdg : home, *cache = own ? "" : xdg ? "/pocl/kcache" : "/.cache/pocl/kcache";
    return folder && snprintf(path, size, "%s%s/%s", folder, cache, below) < (int)size;
}

static const unsigned char *code_of(const PoclBinary *trimmed)
{
    return trimmed->bytes + trimmed->size - trimmed->code_size;
}

/* Is the file there, with that content? */
static bool has_content(const char *path, const unsigned char *content, size_t size)
{
    FILE *file = fopen(path, "rb");
    unsigned char *found = file ? malloc(size) : NULL;
    bool same = found && fread(found, size, 1, file) == 1 && getc(file) == EOF && memcmp(found, content, size) == 0;
    free(found);
    if (file)
        fclose(file);
    return same;
}

bool pocl_binary_unpack(const PoclBinary *trimmed)
{
    char path[PATH_BYTES], temporary[PATH_BYTES + 32];
    if (!find_path(trimmed->code_path, path, sizeof path))
        return false;
    if (has_content(path, code_of(trimmed), trimmed->code_size))
        return true;
    for (char *slash = path + strlen(path) - strlen(trimmed->code_path); (slash = strchr(slash, '/')); slash++) {
        *slash = '\0';
        mkdir(path, 0700);
        *slash = '/';
    }
    snprintf(temporary, sizeof temporary, "%s.%ld", path, (long)getpid());
    FILE *file = fopen(temporary, "wb");
    bool ok = file && fwrite(code_of(trimmed), trimmed->code_size, 1, file) == 1;
    if (file)
        ok = fclose(file) == 0 && ok;
    if (ok && rename(temporary, path) == 0)
        return true;
    remove(temporary);
    return false;
}

bool pocl_binary_is_unpacked(const PoclBinary *trimmed)
{
    char path[PATH_BYTES], dummy[HASH_BYTES + sizeof dummy_path];
    snprintf(dummy, sizeof dummy, "%.*s%s", HASH_BYTES - 1, trimmed->code_path, dummy_path);
    return find_path(dummy, path, sizeof path) && access(path, F_OK) == 0 &&
           find_path(trimmed->code_path, path, sizeof path) && has_content(path, code_of(trimmed), trimmed->code_size);
}
