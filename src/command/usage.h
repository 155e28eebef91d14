/* The help of the commands and of their options. */
#ifndef RECTRAY_USAGE_H
#define RECTRAY_USAGE_H

#include "command/options.h"

#include <stdio.h>

#define RECTRAY_VERSION "1.0"
#define RECTRAY_DATE "2026-11-30" /* of the version; docs/CHANGELOG.md has both, too */

/* What `rectray help COMMAND`, `rectray help` and `rectray --version` print. */
void usage_print_command(FILE *out, const Command *command);
void usage_print_commands(FILE *out, const Command *commands);
void usage_print_version(FILE *out);

#endif
