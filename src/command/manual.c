/* Writes the macros of man(7): a page of the program and a page of each command. */
#include "command/manual.h"

#include "command/option_table.h"
#include "command/usage.h"

#include <ctype.h>

/* Text as roff takes it: a minus that can be copied, no macro at the start of a line. */
static void put(FILE *out, const char *text)
{
    for (const char *c = text; *c; c++) {
        bool first = c == text || c[-1] == '\n';
        if (first && (*c == '.' || *c == '\''))
            fputs("\\&", out);
        if (*c == '\\')
            fputs("\\e", out);
        else if (*c == '-')
            fputs("\\-", out);
        else
            fputc(*c, out);
    }
}

/* "Renders a scene to a picture: PNG, PPM or PFM." as the line NAME wants it: a small first letter, no full stop. */
static void put_summary(FILE *out, const char *summary)
{
    char line[128];
    int length = snprintf(line, sizeof line, "%s", summary);
    line[0] = (char)tolower((unsigned char)line[0]);
    if (length > 0 && length < (int)sizeof line && line[length - 1] == '.')
        line[length - 1] = '\0';
    put(out, line);
    fputc('\n', out);
}

static void put_head(FILE *out, const char *title)
{
    fprintf(out, ".TH \"%s\" 1 \"" RECTRAY_DATE "\" \"rectray " RECTRAY_VERSION "\" \"User Commands\"\n.SH NAME\n",
            title);
}

static void put_option(FILE *out, const Option *option)
{
    fputs(".TP\n", out);
    if (option->letter)
        fprintf(out, "\\fB\\-%c\\fR, ", option->letter);
    fputs("\\fB\\-\\-", out);
    put(out, option->name);
    fputs("\\fR", out);
    if (option->argument) {
        fputs(option->argument[0] == '[' ? "\\fI" : " \\fI", out);
        put(out, option->argument);
        fputs("\\fR", out);
    }
    fputc('\n', out);
    put(out, option->help);
    OptionText expects = option_expects(option);
    if (expects.text[0]) {
        fputs(".\nValue: ", out);
        put(out, expects.text);
    }
    fputs(".\n", out);
}

static void put_examples(FILE *out, const Command *command)
{
    fputs(".SH EXAMPLES\n", out);
    for (int i = 0; i < EXAMPLES; i++) {
        fputs(".TP\n\\fB", out);
        put(out, command->examples[i].line);
        fputs("\\fR\n", out);
        put(out, command->examples[i].meaning);
        fputs(".\n", out);
    }
}

static void put_status(FILE *out)
{
    fputs(".SH \"EXIT STATUS\"\n"
          ".TP\n0\nIt was done.\n"
          ".TP\n1\nThe scene or another input is wrong; the message begins with its file and line.\n"
          ".TP\n2\nThe command line is wrong.\n"
          ".TP\n3\nThe device, the memory or the file system failed.\n",
          out);
}

void manual_print_command(FILE *out, const Command *command)
{
    char title[64];
    snprintf(title, sizeof title, "rectray-%s", command->name);
    put_head(out, title);
    fputs("rectray\\-", out);
    fprintf(out, "%s \\- ", command->name);
    put_summary(out, command->summary);
    fprintf(out, ".SH SYNOPSIS\n.B rectray %s\n.RI \"", command->name);
    put(out, command->operands);
    fputs("\" \" [options]\"\n.SH DESCRIPTION\n", out);
    put(out, command->summary);
    fputs("\n.SH OPTIONS\n", out);
    for (const Option *option = option_table; option->name; option++)
        if (option_belongs(option, command->name))
            put_option(out, option);
    put_examples(out, command);
    put_status(out);
    fputs(".SH \"SEE ALSO\"\n.BR rectray (1),\n.BR rectray\\-scene (5)\n", out);
}

void manual_print_program(FILE *out, const Command *commands)
{
    put_head(out, "rectray");
    fputs("rectray \\- a teaching ray tracer for rectangular surfaces\n"
          ".SH SYNOPSIS\n.B rectray\n.RI COMMAND\n.RI [options]\n"
          ".SH DESCRIPTION\n"
          "rectray renders scenes of rectangular surfaces, written in JSON, to pictures.\n"
          "It runs an OpenCL kernel, or a reference tracer in plain C that tells every step of a pixel.\n"
          ".SH COMMANDS\n",
          out);
    for (const Command *command = commands; command->name; command++) {
        fprintf(out, ".TP\n.BR rectray\\-%s (1)\n", command->name);
        put(out, command->summary);
        fputc('\n', out);
    }
    put_status(out);
    fputs(".SH ENVIRONMENT\n"
          ".TP\n.B RECTRAY_KERNELS\nA folder whose kernel files are used instead of those in the program.\n"
          ".TP\n.B RECTRAY_CACHE_DIR\nWhere compiled kernels are kept; empty: nowhere.\n"
          ".TP\n.B PAGER\nShows a long walkthrough on a terminal.\n"
          ".SH \"SEE ALSO\"\n.BR rectray\\-scene (5)\n",
          out);
}
