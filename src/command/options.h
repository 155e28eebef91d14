/* The command line: the commands, and what the user says to one of them. */
#ifndef RECTRAY_OPTIONS_H
#define RECTRAY_OPTIONS_H

#include "base/error.h"
#include "command/option.h"

enum { EXAMPLES = 2 }; /* of each command */

/* A command line, and in a few words what it does. */
typedef struct Example {
    const char *line, *meaning;
} Example;

typedef struct Command {
    const char *name;
    const char *operands; /* as help shows them: "SCENE" */
    int operands_min, operands_max;
    const char *summary;
    bool (*run)(const Options *options, Error *error);
    Example examples[EXAMPLES];
} Command;

/* The command of that name in a table that ends in a NULL name; NULL, with an ERROR_USAGE that suggests the nearest
 * one, where there is none. */
const Command *options_find_command(const Command *commands, const char *name, Error *error);

/* Reads argv[1], argv[2], ... (argv[0] is the command's name). Every error is an ERROR_USAGE that names the option, its
 * value and the cure. With --help or --version on the line the operands are not looked at. May reorder argv. */
bool options_parse(Options *options, const Command *command, int argc, char **argv, Error *error);

/* False, with an ERROR_USAGE, where one option makes no sense beside another. */
bool options_agree(const Options *options, Error *error);

/* Tells, in a line each on stderr, which of the given options do nothing with the backend that was chosen. */
void options_note_unused(const Options *options);

#endif
