/* The product reads its kernels from the folder that RECTRAY_KERNELS names: the probe writes them to a folder of its
 * own, with the probe kernels behind `cast`, whose program they become part of. */
#include "base/text.h"
#include "opencl/kernel_sources.h"
#include "probe.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* The texts of probe.cl and probe_pairs.cl, byte by byte. */
static const char probe_kernels[] = {
#include "probe_cl.inc"
    0};

static const char probe_pairs_kernels[] = {
#include "probe_pairs_cl.inc"
    0};

/* What stands behind a kernel file of the product. */
static const char *text_behind(const char *name)
{
    return strcmp(name, "packet/cast.cl") == 0  ? probe_kernels
           : strcmp(name, "pairs/cast.cl") == 0 ? probe_pairs_kernels
                                                : "";
}

static void write_source(const char *folder, const char *name, const char *text, const char *more)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%.*s", folder, (int)strcspn(name, "/"), name);
    if (strchr(name, '/'))
        mkdir(path, 0700); /* the folder of the file; it may be there already */
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    if (!file || fputs(text, file) < 0 || fputs(more, file) < 0 || fclose(file) != 0) {
        perror(path);
        exit(3);
    }
}

/* Copies the kernels, those of RECTRAY_KERNELS where it is set, to `folder`. */
static void write_sources(const char *folder)
{
    const char *from = getenv("RECTRAY_KERNELS");
    for (int i = 0; i < kernel_source_count; i++) {
        const char *more = text_behind(kernel_sources[i].name);
        if (!from) {
            write_source(folder, kernel_sources[i].name, kernel_sources[i].text, more);
            continue;
        }
        char path[512];
        long length;
        Error error = {0};
        snprintf(path, sizeof path, "%s/%s", from, kernel_sources[i].name);
        char *text = text_read(path, 1 << 20, &length, &error);
        stop_unless(text != NULL, &error);
        write_source(folder, kernel_sources[i].name, text, more);
        free(text);
    }
}

static void remove_sources(const char *folder)
{
    char path[512];
    for (int i = 0; i < kernel_source_count; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, kernel_sources[i].name);
        remove(path);
    }
    for (int i = 0; i < kernel_source_count; i++) {
        const char *name = kernel_sources[i].name;
        snprintf(path, sizeof path, "%s/%.*s", folder, (int)strcspn(name, "/"), name);
        remove(path);
    }
    rmdir(folder);
}

static char folder[256];

char *probe_sources_write(void)
{
    const char *temporary = getenv("TMPDIR");
    snprintf(folder, sizeof folder, "%s/rectray-probe-XXXXXX", temporary ? temporary : "/tmp");
    if (!mkdtemp(folder)) {
        perror(folder);
        exit(3);
    }
    write_sources(folder);
    Error error = {0};
    const char *set = getenv("RECTRAY_KERNELS");
    char *kept = set ? text_copy(set, &error) : NULL;
    setenv("RECTRAY_KERNELS", folder, 1);
    return kept;
}

void probe_sources_remove(char *kept)
{
    if (kept)
        setenv("RECTRAY_KERNELS", kept, 1);
    else
        unsetenv("RECTRAY_KERNELS");
    free(kept);
    remove_sources(folder);
}
