/* The files of a scene are found anew before each picture, for an edit may name other models. */
#include "command/render_watch.h"

#include "base/text.h"
#include "base/watch.h"
#include "opencl/kernel_sources.h"
#include "page/explore_files.h"

#include <stdlib.h>
#include <string.h>

/* The folder of a kernel file below the folder that the user has named: "FOLDER/packet/". */
static bool add_kernel_folder(Watch *watch, const char *folder, const char *name, Error *error)
{
    const char *slash = strrchr(name, '/');
    char path[4096];
    snprintf(path, sizeof path, "%s/%.*s", folder, slash ? (int)(slash - name) + 1 : 0, name);
    return watch_add(watch, path, error);
}

static bool add_kernels(Watch *watch, Error *error)
{
    const char *folder = getenv("RECTRAY_KERNELS");
    for (int i = 0; folder && folder[0] && i < kernel_source_count; i++)
        if (!add_kernel_folder(watch, folder, kernel_sources[i].name, error))
            return false;
    return true;
}

/* Adds the files that the scene names now. A scene that has a fault names what it names up to there. */
static bool add_scene(Watch *watch, const char *scene_path, Error *error)
{
    ExploreFiles files;
    Error fault = {.kind = ERROR_NONE};
    bool done = watch_add(watch, scene_path, error);
    explore_find_files(&files, scene_path, &fault);
    for (int i = 0; i < files.count && done; i++) {
        Error missing = {.kind = ERROR_NONE};
        watch_add(watch, files.items[i].path, &missing); /* a folder may be missing: the scene's reader tells it */
    }
    explore_free_files(&files);
    return done;
}

static void tell(const Options *options, const Error *fault)
{
    if (fault->kind != ERROR_NONE)
        fprintf(stderr, "%s%s\n", fault->kind == ERROR_INPUT ? "" : "rectray: ", fault->text);
    if (!options->quiet)
        fprintf(stderr, "watching %s; Ctrl-C ends it\n", options->operands[0]);
}

bool render_watch(const Options *options, bool (*render)(const Options *, Error *), Error *error)
{
    const char *scene = options->operands[0];
    if (text_is_stream(scene))
        return error_set(error, ERROR_USAGE, "--watch needs a file; a pipe is read once");
    Watch *watch = watch_open(error);
    bool good = watch && add_kernels(watch, error);
    for (bool first = true; good; first = false) {
        Error fault = {.kind = ERROR_NONE};
        good = add_scene(watch, scene, error);
        if (good && !render(options, &fault) && first && fault.kind == ERROR_USAGE)
            good = error_set(error, fault.kind, "%s", fault.text);
        if (!good)
            break;
        tell(options, &fault);
        good = watch_wait(watch, error);
    }
    watch_close(watch);
    return good;
}
