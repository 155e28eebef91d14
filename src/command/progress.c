/* The line is written with one call, over the old one and as long as it, so that nothing flickers; at most
 * ten times a second. */
#include "command/progress.h"

#include "base/clock.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const double FIRST_MS = 300, INTERVAL_MS = 100;

Progress progress_start(ProgressMode mode, bool quiet)
{
    double now = clock_ms();
    if (mode == PROGRESS_ALWAYS)
        return (Progress){.shown = true, .next_ms = now};
    bool shown = mode == PROGRESS_AUTO && !quiet && isatty(STDERR_FILENO);
    return (Progress){.shown = shown, .next_ms = now + FIRST_MS};
}

void progress_line(char *line, int size, double done, uint64_t rays, double seconds)
{
    double rate = seconds > 0 ? (double)rays / seconds : 0;
    double left = done > 0 ? ceil(seconds * (1 - done) / done) : 0;
    snprintf(line, (size_t)size, "%.0f %%, %.2f million rays/s, %.0f:%02.0f left", floor(100 * done), rate / 1e6,
             floor(left / 60), fmod(left, 60));
}

/* Writes the text over the line that is there. */
static void rewrite(Progress *progress, const char *text)
{
    int width = (int)strlen(text);
    int rest = progress->width > width ? progress->width - width : 0;
    fprintf(stderr, "\r%s%*s", text, rest, "");
    fflush(stderr);
    progress->width = width;
}

void progress_step(Progress *progress, double done, uint64_t rays, double ms)
{
    double now = clock_ms();
    if (!progress->shown || now < progress->next_ms)
        return;
    char line[96];
    progress_line(line, sizeof line, done, rays, ms / 1e3);
    rewrite(progress, line);
    progress->next_ms = now + INTERVAL_MS;
}

void progress_note(Progress *progress, const char *text)
{
    if (progress->shown)
        rewrite(progress, text);
}

void progress_end(Progress *progress)
{
    if (progress->width > 0)
        fprintf(stderr, "\r%*s\r", progress->width, "");
    progress->width = 0;
}
