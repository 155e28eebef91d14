/* The folder of bench. */
#include "bench_folder.h"

#include "process.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static bool make_one(const char *path, Error *error)
{
    if (mkdir(path, 0777) == 0 || errno == EEXIST)
        return true;
    return error_set(error, ERROR_SYSTEM, "cannot make the folder %s: %s", path, strerror(errno));
}

/* Each folder on the way is made from the top. */
static bool make_with_parents(char *path, Error *error)
{
    for (char *slash = path + 1; (slash = strchr(slash, '/')) != NULL; slash++) {
        *slash = '\0';
        bool made = make_one(path, error);
        *slash = '/';
        if (!made)
            return false;
    }
    return make_one(path, error);
}

static bool make_temporary(BenchFolder *folder, Error *error)
{
    const char *place = getenv("TMPDIR");
    folder->temporary = true;
    snprintf(folder->path, sizeof folder->path, "%.200s/rectray-bench-XXXXXX", place && place[0] ? place : "/tmp");
    return mkdtemp(folder->path) ||
           error_set(error, ERROR_SYSTEM, "cannot make the temporary folder %s: %s", folder->path, strerror(errno));
}

bool bench_folder_open(BenchFolder *folder, const char *wanted, Error *error)
{
    *folder = (BenchFolder){.temporary = false};
    if (!wanted)
        return make_temporary(folder, error);
    if (strlen(wanted) >= sizeof folder->path)
        return error_set(error, ERROR_USAGE, "the folder's name is too long: %s", wanted);
    snprintf(folder->path, sizeof folder->path, "%s", wanted);
    return make_with_parents(folder->path, error);
}

void bench_folder_close(const BenchFolder *folder)
{
    const char *argv[] = {"rm", "-rf", "--", folder->path, NULL};
    Error ignored = {0};
    double ms;
    if (folder->temporary)
        process_run(argv, NULL, 0, &ms, &ignored);
}

BenchPath bench_path(const BenchFolder *folder, const char *prefix, const char *name)
{
    BenchPath path;
    snprintf(path.text, sizeof path.text, "%s%s/%s", prefix, folder->path, name);
    return path;
}
