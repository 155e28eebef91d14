/* The completion of commands, options and their words in shells, made from the tables of commands and options. */
#ifndef RECTRAY_COMPLETION_H
#define RECTRAY_COMPLETION_H

#include "command/options.h"

#include <stdio.h>

/* A script for the shell to read. The table ends in a NULL name. */
void completion_print_bash(FILE *out, const Command *commands);
void completion_print_zsh(FILE *out, const Command *commands);
void completion_print_fish(FILE *out, const Command *commands);

#endif
