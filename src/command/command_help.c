/* rectray help: the help of the program or of one command, as text, as a manual page, or as a shell's completion. */
#include "command/command.h"
#include "command/command_table.h"
#include "command/completion.h"
#include "command/manual.h"
#include "command/usage.h"

static void print_command(const Command *command, HelpFormat format)
{
    if (format == HELP_MAN)
        manual_print_command(stdout, command);
    else
        usage_print_command(stdout, command);
}

bool command_help(const Options *options, Error *error)
{
    static void (*const printers[])(FILE *, const Command *) = {
        [HELP_TEXT] = usage_print_commands, [HELP_MAN] = manual_print_program,   [HELP_BASH] = completion_print_bash,
        [HELP_ZSH] = completion_print_zsh,  [HELP_FISH] = completion_print_fish,
    };
    if (options->operand_count == 0) {
        printers[options->help_format](stdout, command_table);
        return true;
    }
    if (options->help_format > HELP_MAN)
        return error_set(error, ERROR_USAGE, "the completion of a shell is of all commands; leave out '%s'",
                         options->operands[0]);
    const Command *command = options_find_command(command_table, options->operands[0], error);
    if (command)
        print_command(command, options->help_format);
    return command != NULL;
}
