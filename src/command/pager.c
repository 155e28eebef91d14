/* Text for a terminal. */
#include "command/pager.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

TerminalSize terminal_size(FILE *out)
{
    struct winsize size;
    if (!isatty(fileno(out)) || ioctl(fileno(out), TIOCGWINSZ, &size) != 0)
        return (TerminalSize){0, 0};
    return (TerminalSize){size.ws_col, size.ws_row};
}

static int count_lines(const char *text)
{
    int lines = 0;
    for (; *text; text++)
        lines += *text == '\n';
    return lines;
}

/* Whether a pager ran; the shell answers 127 where it finds none. */
static bool show_paged(const char *text)
{
    const char *pager = getenv("PAGER");
    if (pager && (pager[0] == '\0' || strcmp(pager, "cat") == 0))
        return false;
    setenv("LESS", "FRX", 0); /* unless the user says otherwise: colours are shown */
    fflush(stdout);
    FILE *to = popen(pager ? pager : "less", "w");
    if (!to)
        return false;
    fputs(text, to); /* a pager that is left early has seen enough */
    int status = pclose(to);
    return !(WIFEXITED(status) && WEXITSTATUS(status) == 127);
}

void pager_show(const char *text)
{
    int rows = terminal_size(stdout).rows;
    if (rows == 0 || count_lines(text) < rows || !show_paged(text))
        fputs(text, stdout);
}
