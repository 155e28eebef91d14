/* The handler itself removes the file and ends the program. A flag that the program would look at now and then
 * is not enough: a kernel on an OpenCL device may run for minutes, and nothing can break it off.
 * It uses only what POSIX allows in a handler: poll, raise, signal, unlink, strlen, write, _exit. */
#include "base/interrupt.h"

#include <assert.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *volatile guarded;      /* the file to remove, NULL for none */
static volatile sig_atomic_t on_terminal; /* whether stderr is one */

/* A message that cannot be written has no one to tell. */
static void say(const char *message)
{
    ssize_t ignored = write(STDERR_FILENO, message, strlen(message));
    (void)ignored;
}

static void stop(int signal)
{
    const char *path = guarded;
    bool removed = path && unlink(path) == 0; /* not removed: it has just got its final name */
    if (on_terminal)
        say("\n"); /* after the line of the progress, and the ^C */
    say(removed ? "rectray: interrupted; the picture was not written\n" : "rectray: interrupted\n");
    _exit(128 + signal);
}

/* A pipe has lost its reader. Where it is standard output, nobody wants the rest: the program ends as cat does, killed
 * by the signal, without a word. Another pipe's write fails with EPIPE. */
static void lose_reader(int signal_number)
{
    int before = errno;
    struct pollfd output = {.fd = STDOUT_FILENO, .events = POLLOUT};
    if (poll(&output, 1, 0) == 1 && (output.revents & POLLERR)) {
        const char *path = guarded;
        if (path)
            unlink(path);
        signal(signal_number, SIG_DFL);
        raise(signal_number);
    }
    errno = before;
}

static void set_handler(int signal, void (*handler)(int))
{
    struct sigaction action;
    memset(&action, 0, sizeof action);
    sigemptyset(&action.sa_mask);
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    sigaction(signal, &action, NULL);
}

void interrupt_install(void)
{
    struct sigaction hangup, broken_pipe;
    on_terminal = isatty(STDERR_FILENO);
    set_handler(SIGINT, stop);
    set_handler(SIGTERM, stop);
    /* nohup starts us with SIGHUP ignored, and means it. */
    if (sigaction(SIGHUP, NULL, &hangup) == 0 && hangup.sa_handler != SIG_IGN)
        set_handler(SIGHUP, stop);
    /* A caller that ignores SIGPIPE wants to be told. */
    if (sigaction(SIGPIPE, NULL, &broken_pipe) == 0 && broken_pipe.sa_handler != SIG_IGN)
        set_handler(SIGPIPE, lose_reader);
    set_handler(SIGXFSZ, SIG_IGN);
}

int interrupt_create_guarded(const char *path)
{
    assert(!guarded);
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &before);
    int descriptor = open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    int reason = errno;
    if (descriptor >= 0)
        guarded = path;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    errno = reason;
    return descriptor;
}

void interrupt_release(void)
{
    guarded = NULL;
}
