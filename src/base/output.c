/* An output file that appears under its name only when it is complete. */
#define _XOPEN_SOURCE 700 /* realpath */
#include "base/output.h"

#include "base/interrupt.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool output_failed(const Output *output, const char *reason, Error *error)
{
    if (strcmp(output->path, "-") == 0)
        return error_set(error, ERROR_SYSTEM, "cannot write %s to standard output: %s", output->what, reason);
    return error_set(error, ERROR_SYSTEM, "cannot write %s: %s", output->path, reason);
}

/* "FOLDER/.rectray-PROCESS-ATTEMPT.part": its length does not depend on the target's name, which may be as long as
 * the file system allows. */
static char *temporary_name(const char *target, int attempt)
{
    const char *slash = strrchr(target, '/');
    int folder = slash ? (int)(slash - target) + 1 : 0;
    size_t size = (size_t)folder + 64;
    char *name = malloc(size);
    if (name)
        snprintf(name, size, "%.*s.rectray-%ld-%d.part", folder, target, (long)getpid(), attempt);
    return name;
}

/* Locks a file for its writer. True, too, where the file system has no locks. */
static bool lock(int descriptor, bool *has_locks)
{
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    bool locked = fcntl(descriptor, F_SETLK, &whole) == 0;
    *has_locks = locked || errno == EACCES || errno == EAGAIN;
    return locked || !*has_locks;
}

/* A file that another process was about to sweep away is not taken. */
static bool is_ours(int descriptor, const char *name)
{
    bool has_locks;
    return lock(descriptor, &has_locks) && access(name, F_OK) == 0;
}

/* Creates the temporary file beside the target; the descriptor, or -1 with the error filled. */
static int create_temporary(Output *output, Error *error)
{
    for (int attempt = 0;; attempt++) {
        char *name = temporary_name(output->target, attempt);
        if (!name) {
            error_memory(error, "the name of the output");
            return -1;
        }
        int descriptor = interrupt_create_guarded(name);
        if (descriptor >= 0 && is_ours(descriptor, name)) {
            output->temporary = name;
            return descriptor;
        }
        int reason = descriptor >= 0 ? EEXIST : errno;
        if (descriptor >= 0) {
            interrupt_release();
            close(descriptor);
        }
        free(name);
        if (reason != EEXIST || attempt == 100) {
            output_failed(output, strerror(reason), error);
            return -1;
        }
    }
}

/* Where the output goes: stdout, a device or pipe as it is, or a new file beside the target. */
static bool open_file(Output *output, Error *error)
{
    int descriptor;
    struct stat there;
    if (strcmp(output->path, "-") == 0) {
        descriptor = dup(STDOUT_FILENO);
    } else if (stat(output->path, &there) != 0 || S_ISREG(there.st_mode)) {
        /* A rename needs no right to the file that it replaces; we do not take a file that is marked read-only. */
        if (access(output->path, W_OK) != 0 && errno != ENOENT)
            return output_failed(output, strerror(errno), error);
        descriptor = create_temporary(output, error);
    } else {
        descriptor = open(output->path, O_WRONLY | O_CLOEXEC); /* a folder fails here */
    }
    if (descriptor < 0)
        return output_failed(output, strerror(errno), error); /* an error that is already set stays */
    output->file = fdopen(descriptor, "wb");
    if (!output->file) { /* no memory, or a stdout that is not open for writing */
        output_failed(output, strerror(errno == EINVAL ? EBADF : errno), error);
        close(descriptor);
    }
    return output->file != NULL;
}

/* Removes a file that nobody holds locked. */
static void sweep_file(const char *path)
{
    bool has_locks;
    int descriptor = open(path, O_WRONLY | O_CLOEXEC);
    if (descriptor < 0)
        return;
    if (lock(descriptor, &has_locks) && has_locks)
        unlink(path);
    close(descriptor);
}

void output_sweep(const char *path)
{
    const char *slash = strrchr(path, '/');
    int length = slash ? (int)(slash - path) + 1 : 2;
    char file[4096];
    snprintf(file, sizeof file, "%.*s", length, slash ? path : "./");
    DIR *folder = opendir(file);
    for (struct dirent *entry; folder && (entry = readdir(folder)) != NULL;) {
        const char *end = strstr(entry->d_name, ".part");
        if (strncmp(entry->d_name, ".rectray-", 9) != 0 || !end || end[5] != '\0')
            continue;
        snprintf(file, sizeof file, "%.*s%s", length, slash ? path : "./", entry->d_name);
        sweep_file(file);
    }
    if (folder)
        closedir(folder);
}

bool output_replaces(const char *path, const char *input)
{
    struct stat a, b;
    return stat(path, &a) == 0 && stat(input, &b) == 0 && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

bool output_open(Output *output, const char *path, const char *what, Error *error)
{
    *output = (Output){.what = what, .path = strdup(path), .target = realpath(path, NULL)};
    if (!output->target) /* there is nothing yet */
        output->target = strdup(path);
    if (!output->path || !output->target) {
        output_abort(output);
        return error_memory(error, "the name of the output");
    }
    if (open_file(output, error))
        return true;
    output_abort(output);
    return false;
}

bool output_commit(Output *output, Error *error)
{
    errno = 0;
    bool lost = ferror(output->file) != 0;
    FILE *file = output->file;
    output->file = NULL;
    /* Closing writes what is still buffered, and learns what a network file system put off. */
    if (fclose(file) != 0 || lost || (output->temporary && rename(output->temporary, output->target) != 0)) {
        output_failed(output, errno ? strerror(errno) : "write error", error);
        output_abort(output);
        return false;
    }
    if (output->temporary) {
        interrupt_release();
        free(output->temporary);
        output->temporary = NULL;
    }
    output_abort(output);
    return true;
}

void output_abort(Output *output)
{
    if (output->file)
        fclose(output->file);
    if (output->temporary) {
        unlink(output->temporary);
        interrupt_release();
    }
    free(output->temporary);
    free(output->target);
    free(output->path);
    *output = (Output){0};
}
