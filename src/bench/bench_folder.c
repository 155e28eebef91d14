/* The folder of bench. */
#include "bench/bench_folder.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

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

/* A shell that removes the folder when nobody holds the other end of its standard input any more: neither we, however
 * we end, nor the programs that we started and that may still write into it. */
static bool start_sweeper(BenchFolder *folder, Error *error)
{
    static const char wait_and_remove[] = "trap '' INT TERM HUP; read -r line; rm -rf -- \"$1\"";
    const char *argv[] = {"sh", "-c", wait_and_remove, "sh", folder->path, NULL};
    if (!process_start(&folder->sweeper, argv, error))
        return false;
    fcntl(fileno(folder->sweeper.to), F_SETFD, 0); /* what we start holds it, too */
    return true;
}

static bool make_temporary(BenchFolder *folder, Error *error)
{
    const char *place = getenv("TMPDIR");
    snprintf(folder->path, sizeof folder->path, "%.200s/rectray-bench-XXXXXX", place && place[0] ? place : "/tmp");
    if (!mkdtemp(folder->path))
        return error_set(error, ERROR_SYSTEM, "cannot make the temporary folder %s: %s", folder->path, strerror(errno));
    if (start_sweeper(folder, error))
        return true;
    rmdir(folder->path);
    return false;
}

bool bench_folder_open(BenchFolder *folder, const char *wanted, Error *error)
{
    *folder = (BenchFolder){.path = ""};
    if (!wanted)
        return make_temporary(folder, error);
    if (strlen(wanted) >= sizeof folder->path)
        return error_set(error, ERROR_USAGE, "the folder's name is too long: %s", wanted);
    snprintf(folder->path, sizeof folder->path, "%s", wanted);
    return make_with_parents(folder->path, error);
}

void bench_folder_close(BenchFolder *folder)
{
    process_end(&folder->sweeper);
}

BenchPath bench_path(const BenchFolder *folder, const char *prefix, const char *name)
{
    BenchPath path;
    snprintf(path.text, sizeof path.text, "%s%s/%s", prefix, folder->path, name);
    return path;
}
