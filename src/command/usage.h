/* The help of the commands and of their options. */
#ifndef RECTRAY_USAGE_H
#define RECTRAY_USAGE_H

#include "command/options.h"

#include <stdio.h>

/* What `rectray COMMAND --help` and `rectray --help` print. */
void usage_print_command(FILE *out, const Command *command);
void usage_print_commands(FILE *out, const Command *commands);

#endif
