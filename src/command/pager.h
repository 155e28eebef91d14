/* Text for a terminal: how wide it is, and a pager where the text is longer than it is tall. */
#ifndef RECTRAY_PAGER_H
#define RECTRAY_PAGER_H

#include <stdio.h>

/* Of the terminal that a stream is; both 0 where it is none or does not say. */
typedef struct TerminalSize {
    int columns, rows;
} TerminalSize;

TerminalSize terminal_size(FILE *out);

/* Shows the text on standard output through $PAGER (without one: less) where that is a terminal with too few rows, else
 * as it is. */
void pager_show(const char *text);

#endif
