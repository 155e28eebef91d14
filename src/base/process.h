/* Other programs, started and listened to: what bench measures whole, and what it measures beside us. */
#ifndef RECTRAY_PROCESS_H
#define RECTRAY_PROCESS_H

#include "base/error.h"

#include <stdio.h>
#include <sys/types.h>

typedef struct Process {
    pid_t pid;
    FILE *to, *from; /* its standard input and output */
} Process;

/* Starts the program argv[0], which is looked for in PATH unless it has a slash; argv ends in a NULL. Its messages to
 * standard error are dropped. */
bool process_start(Process *process, const char *const *argv, Error *error);

/* Closes both streams and waits. Returns whether the program ended with status 0; a zeroed process may be ended. */
bool process_end(Process *process);

/* Runs a program to its end. `output` receives the beginning of what it printed (may be NULL), *ms the wall-clock time
 * from before its start to after its end. A status other than 0 is an ERROR_SYSTEM that names the program. */
bool process_run(const char *const *argv, char *output, size_t size, double *ms, Error *error);

#endif
