/* Every option there is, in one table from which parsing, messages and help are made. */
#ifndef RECTRAY_OPTION_TABLE_H
#define RECTRAY_OPTION_TABLE_H

#include "command/option.h"

extern const Option option_table[]; /* ends in a NULL name */

#endif
