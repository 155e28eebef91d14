/* Prints the help of a command from the tables of commands and options. */
#include "command/usage.h"

#include "command/option_table.h"

#ifndef RECTRAY_COMMIT
#define RECTRAY_COMMIT "" /* not known: an archive, or a build without the Makefile */
#endif

enum { HELP_COLUMN = 28 }; /* where the explanation of an option begins */

void usage_print_version(FILE *out)
{
    const char *commit = RECTRAY_COMMIT;
    fprintf(out, commit[0] ? "rectray " RECTRAY_VERSION " (%s)\n" : "rectray " RECTRAY_VERSION "\n", commit);
}

static void print_option(FILE *out, const Option *option)
{
    const char *argument = option->argument ? option->argument : "";
    const char *blank = argument[0] && argument[0] != '[' ? " " : "";
    int width = fprintf(out, option->letter ? "  -%c, " : "      ", option->letter);
    width += fprintf(out, "--%s%s%s", option->name, blank, argument);
    if (width >= HELP_COLUMN) /* it gets a line of its own */
        width = fprintf(out, "\n") - 1;
    fprintf(out, "%*s%s\n", HELP_COLUMN - width, "", option->help);
}

void usage_print_command(FILE *out, const Command *command)
{
    fprintf(out, "usage: rectray %s%s%s [options]\n\n%s\n\noptions:\n", command->name, command->operands[0] ? " " : "",
            command->operands, command->summary);
    for (const Option *option = option_table; option->name; option++)
        if (option_belongs(option, command->name))
            print_option(out, option);
    fprintf(out, "\nexamples:\n");
    for (int i = 0; i < EXAMPLES; i++)
        fprintf(out, "  %s\n      %s\n", command->examples[i].line, command->examples[i].meaning);
}

void usage_print_commands(FILE *out, const Command *commands)
{
    fprintf(out, "usage: rectray COMMAND ...\n\ncommands:\n");
    for (const Command *command = commands; command->name; command++)
        fprintf(out, "  %-9s%-20s%s\n", command->name, command->operands, command->summary);
    fprintf(out, "\n`rectray help COMMAND` tells the options of a command, `rectray --version` the version.\n");
}
