/* posix_spawn and two pipes: unlike fork it is safe beside the threads of an OpenCL driver. */
#include "base/process.h"

#include "base/clock.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

static bool spawn(Process *process, const char *const *argv, const int in[2], const int out[2], Error *error)
{
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, in[0], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    /* The cast is POSIX's: spawn does not write to the strings. */
    int status = posix_spawnp(&process->pid, argv[0], &actions, NULL, (char *const *)argv, environ);
    posix_spawn_file_actions_destroy(&actions);
    return status == 0 || error_set(error, ERROR_SYSTEM, "cannot start %s: %s", argv[0], strerror(status));
}

/* A pipe whose ends other programs do not inherit. */
static bool make_pipe(int ends[2], Error *error)
{
    if (pipe(ends) != 0)
        return error_set(error, ERROR_SYSTEM, "cannot make a pipe: %s", strerror(errno));
    fcntl(ends[0], F_SETFD, FD_CLOEXEC);
    fcntl(ends[1], F_SETFD, FD_CLOEXEC);
    return true;
}

static void close_pipe(const int ends[2])
{
    close(ends[0]);
    close(ends[1]);
}

bool process_start(Process *process, const char *const *argv, Error *error)
{
    *process = (Process){0};
    int in[2], out[2];
    if (!make_pipe(in, error))
        return false;
    if (!make_pipe(out, error)) {
        close_pipe(in);
        return false;
    }
    if (!spawn(process, argv, in, out, error)) {
        close_pipe(in);
        close_pipe(out);
        return false;
    }
    close(in[0]);
    close(out[1]);
    process->to = fdopen(in[1], "w");
    process->from = fdopen(out[0], "r");
    if (process->to && process->from)
        return true;
    process_end(process);
    return error_memory(error, "a pipe");
}

bool process_end(Process *process)
{
    int status = 0;
    if (process->to)
        fclose(process->to);
    if (process->from)
        fclose(process->from);
    if (process->pid > 0)
        while (waitpid(process->pid, &status, 0) < 0 && errno == EINTR)
            ;
    *process = (Process){0};
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

bool process_run(const char *const *argv, char *output, size_t size, double *ms, Error *error)
{
    double start = clock_ms();
    Process process;
    if (!process_start(&process, argv, error))
        return false;
    fclose(process.to);
    process.to = NULL;
    size_t length = output ? fread(output, 1, size - 1, process.from) : 0;
    if (output)
        output[length] = '\0';
    while (fgetc(process.from) != EOF)
        ;
    bool done = process_end(&process);
    *ms = clock_ms() - start;
    return done || error_set(error, ERROR_SYSTEM, "%s failed", argv[0]);
}
