/* rectray kernels: lists the kernel files inside the program, or writes them into a folder, to read or to change. */
#include "base/output.h"
#include "command/command.h"
#include "opencl/kernel_sources.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Makes a folder, unless it is there. */
static bool make_folder(const char *path, Error *error)
{
    return mkdir(path, 0777) == 0 || errno == EEXIST ||
           error_set(error, ERROR_SYSTEM, "cannot make the folder %s: %s", path, strerror(errno));
}

static bool write_file(const char *path, const char *text, Error *error)
{
    Output output;
    if (!output_open(&output, path, "a kernel file", error))
        return false;
    fputs(text, output.file);
    return output_commit(&output, error);
}

/* Writes a file below the folder: "packet/light.cl" wants the folder "packet". */
static bool write_below(const char *folder, const KernelSource *source, Error *error)
{
    size_t size = strlen(folder) + strlen(source->name) + 2;
    char *path = malloc(size);
    if (!path)
        return error_memory(error, "a path");
    snprintf(path, size, "%s/%s", folder, source->name);
    char *slash = strrchr(path, '/');
    *slash = '\0';
    bool done = make_folder(path, error);
    *slash = '/';
    done = done && write_file(path, source->text, error);
    free(path);
    return done;
}

/* A file that is there may have been changed by hand: none is replaced. */
static bool check_free(const char *folder, Error *error)
{
    struct stat there;
    if (stat(folder, &there) != 0)
        return true;
    return error_set(error, ERROR_USAGE, "%s is there already; --export wants the name of a new folder", folder);
}

bool command_kernels(const Options *options, Error *error)
{
    const char *folder = options->export_folder;
    if (!folder) {
        for (int i = 0; i < kernel_source_count; i++)
            puts(kernel_sources[i].name);
        return true;
    }
    bool done = check_free(folder, error) && make_folder(folder, error);
    for (int i = 0; i < kernel_source_count && done; i++)
        done = write_below(folder, &kernel_sources[i], error);
    if (done && !options->quiet)
        fprintf(stderr, "%s: %d kernel files; RECTRAY_KERNELS=%s makes rectray use them\n", folder, kernel_source_count,
                folder);
    return done;
}
