/* How far the rendering is, on one line of stderr that is rewritten in place and wiped at the end. */
#ifndef RECTRAY_PROGRESS_H
#define RECTRAY_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

typedef enum ProgressMode { PROGRESS_AUTO, PROGRESS_ALWAYS, PROGRESS_NEVER } ProgressMode;

typedef struct Progress {
    bool shown;     /* whether to show anything at all */
    double next_ms; /* not before, so that the line can be read and costs nothing */
    int width;      /* letters on the line now */
} Progress;

/* AUTO: on a terminal unless `quiet`, and only when it takes a moment. ALWAYS: from the first step on. */
Progress progress_start(ProgressMode mode, bool quiet);

/* `done` in 0..1 of the picture, `rays` traced so far in `ms`:
 * what went before, such as compiling, would spoil the rate. */
void progress_step(Progress *progress, double done, uint64_t rays, double ms);

/* Shows a few words instead, such as what is being prepared. */
void progress_note(Progress *progress, const char *text);

/* Wipes the line. */
void progress_end(Progress *progress);

/* Fills `line` with what progress_step shows after `seconds`: "12 %, 3.45 million rays/s, 1:07 left". */
void progress_line(char *line, int size, double done, uint64_t rays, double seconds);

#endif
