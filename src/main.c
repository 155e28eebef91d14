/* rectray: finds the command and lets it run. Only here an Error becomes a message and an exit status. */
#include "base/interrupt.h"
#include "command/command_table.h"
#include "command/usage.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <unistd.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

/* A closed standard stream would give its number to the next file that is opened, and messages would go into the
 * picture. Its place is taken by an end of /dev/null that fails, so that nobody takes lost output for written. */
static void occupy_standard_streams(void)
{
    for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; stream++)
        if (fcntl(stream, F_GETFD) < 0 && errno == EBADF)
            (void)!open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

/* Output that only now turns out not to be writable is an error too. */
static bool flush_output(Error *error)
{
    errno = 0;
    if (fflush(stdout) == 0 && !ferror(stdout))
        return true;
    return error_set(error, ERROR_SYSTEM, "cannot write to standard output: %s",
                     errno ? strerror(errno) : "write error");
}

static bool run(int argc, char **argv, Error *error)
{
    if (argc < 2) {
        usage_print_commands(stderr, command_table);
        return error_set(error, ERROR_USAGE, "a command is missing");
    }
    const char *name = argv[1];
    if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0) {
        usage_print_commands(stdout, command_table);
        return true;
    }
    if (strcmp(name, "--version") == 0 || strcmp(name, "-V") == 0) {
        usage_print_version(stdout);
        return true;
    }
    Options options;
    const Command *command = options_find_command(command_table, name, error);
    if (!command || !options_parse(&options, command, argc - 1, argv + 1, error))
        return false;
    if (options.help)
        usage_print_command(stdout, command);
    else if (options.version)
        usage_print_version(stdout);
    else
        return command->run(&options, error);
    return true;
}

/* Large arrays go back to the system as soon as they are freed. Left to itself, glibc keeps up to 64 MiB of them for
 * later, at the end of its heap, while a large scene has no use for them any more. */
static void return_large_arrays(void)
{
#ifdef __GLIBC__
    enum { LARGE = 4 << 20 }; /* bytes: more than a band of pixels, which is used again and again */
    mallopt(M_MMAP_THRESHOLD, LARGE);
    mallopt(M_TRIM_THRESHOLD, LARGE);
#endif
}

int main(int argc, char **argv)
{
    return_large_arrays();
    Error error = {0};
    occupy_standard_streams();
    interrupt_install();
    if (run(argc, argv, &error))
        flush_output(&error);
    else
        fflush(stdout);
    /* A message about an input begins with the file's name, as compilers' do: editors find the place by it. */
    if (error.kind != ERROR_NONE)
        fprintf(stderr, "%s%s\n", error.kind == ERROR_INPUT ? "" : "rectray: ", error.text);
    return (int)error.kind;
}
