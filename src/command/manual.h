/* Manual pages, made from the tables of commands and options, for `man`. */
#ifndef RECTRAY_MANUAL_H
#define RECTRAY_MANUAL_H

#include "command/options.h"

#include <stdio.h>

/* The page of one command: rectray-NAME(1), in the macros of man(7). */
void manual_print_command(FILE *out, const Command *command);

/* The page of the program: rectray(1). The table ends in a NULL name. */
void manual_print_program(FILE *out, const Command *commands);

#endif
