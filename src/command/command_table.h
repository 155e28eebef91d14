/* The list of the program's commands. */
#ifndef RECTRAY_COMMAND_TABLE_H
#define RECTRAY_COMMAND_TABLE_H

#include "command/options.h"

/* In the order of --help; it ends in a NULL name. */
extern const Command command_table[];

#endif
