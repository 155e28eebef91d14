/* Scripts that complete a command line of rectray in bash, zsh and fish. Each is one function over the commands. */
#include "command/completion.h"

#include "command/option_table.h"

#include <string.h>

static bool takes_value(const Option *option)
{
    return option->argument && option->argument[0] != '[';
}

static void put_words(FILE *out, const char *const *words)
{
    for (int i = 0; words[i]; i++)
        fprintf(out, "%s%s", i > 0 ? " " : "", words[i]);
}

/* Text between single quotes of a shell; the characters of `special` get a backslash before them. */
static void put_quoted(FILE *out, const char *text, const char *special)
{
    for (const char *c = text; *c; c++) {
        if (strchr(special, *c))
            fputc('\\', out);
        fputs(*c == '\'' ? "'\\''" : (char[]){*c, '\0'}, out);
    }
}

/* --- bash --- */

static void put_bash_command(FILE *out, const Command *command)
{
    fprintf(out, "    %s)\n        case $before in\n", command->name);
    for (const Option *option = option_table; option->name; option++) {
        if (!option_belongs(option, command->name) || !takes_value(option))
            continue;
        fprintf(out, option->letter ? "        --%s|-%c) " : "        --%s) ", option->name, option->letter);
        if (option->words) {
            fputs("list=\"", out);
            put_words(out, option->words);
            fputs("\" ;;\n", out);
        } else {
            fputs("return ;;\n", out);
        }
    }
    fputs("        -*|*) [[ $word != -* ]] || list=\"", out);
    for (const Option *option = option_table; option->name; option++)
        if (option_belongs(option, command->name))
            fprintf(out, "--%s ", option->name);
    fputs("\" ;;\n        esac ;;\n", out);
}

void completion_print_bash(FILE *out, const Command *commands)
{
    fputs("# Completion of rectray in bash. Made by: rectray help --as bash\n"
          "_rectray()\n{\n"
          "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} list=\n"
          "    COMPREPLY=()\n"
          "    if [ \"$COMP_CWORD\" -eq 1 ]; then\n        list=\"",
          out);
    for (const Command *command = commands; command->name; command++)
        fprintf(out, "%s ", command->name);
    fputs("--help --version\"\n    else\n    case ${COMP_WORDS[1]} in\n", out);
    for (const Command *command = commands; command->name; command++)
        put_bash_command(out, command);
    fputs("    esac\n    fi\n"
          "    COMPREPLY=($(compgen -W \"$list\" -- \"$word\"))\n"
          "}\n"
          "complete -o default -F _rectray rectray\n",
          out);
}

/* --- zsh --- */

static void put_zsh_option(FILE *out, const Option *option)
{
    if (option->letter)
        fprintf(out, "        '(-%c --%s)'{-%c,--%s}'[", option->letter, option->name, option->letter, option->name);
    else
        fprintf(out, "        '--%s[", option->name);
    put_quoted(out, option->help, "[]:\\");
    fputc(']', out);
    if (takes_value(option)) {
        fputc(':', out);
        put_quoted(out, option->argument, "[]:\\");
        fputc(':', out);
        if (option->words) {
            fputc('(', out);
            put_words(out, option->words);
            fputc(')', out);
        } else {
            fputs("_files", out);
        }
    }
    fputs("' \\\n", out);
}

void completion_print_zsh(FILE *out, const Command *commands)
{
    fputs("#compdef rectray\n# Completion of rectray in zsh. Made by: rectray help --as zsh\n"
          "local -a commands\ncommands=(\n",
          out);
    for (const Command *command = commands; command->name; command++) {
        fprintf(out, "    '%s:", command->name);
        put_quoted(out, command->summary, ":\\");
        fputs("'\n", out);
    }
    fputs(")\nif (( CURRENT == 2 )); then\n    _describe command commands\n    return\nfi\n"
          "local command=$words[2]\nshift words\n(( CURRENT-- ))\ncase $command in\n",
          out);
    for (const Command *command = commands; command->name; command++) {
        fprintf(out, "(%s)\n    _arguments \\\n", command->name);
        for (const Option *option = option_table; option->name; option++)
            if (option_belongs(option, command->name))
                put_zsh_option(out, option);
        fputs("        '*:file:_files' ;;\n", out);
    }
    fputs("esac\n", out);
}

/* --- fish --- */

void completion_print_fish(FILE *out, const Command *commands)
{
    fputs("# Completion of rectray in fish. Made by: rectray help --as fish\n", out);
    for (const Command *command = commands; command->name; command++) {
        fprintf(out, "complete -c rectray -n __fish_use_subcommand -f -a %s -d '", command->name);
        put_quoted(out, command->summary, "\\");
        fputs("'\n", out);
        for (const Option *option = option_table; option->name; option++) {
            if (!option_belongs(option, command->name))
                continue;
            fprintf(out, "complete -c rectray -n '__fish_seen_subcommand_from %s' -l %s", command->name, option->name);
            if (option->letter)
                fprintf(out, " -s %c", option->letter);
            if (takes_value(option))
                fputs(" -r", out);
            if (option->words && takes_value(option)) {
                fputs(" -f -a '", out);
                put_words(out, option->words);
                fputc('\'', out);
            }
            fputs(" -d '", out);
            put_quoted(out, option->help, "\\");
            fputs("'\n", out);
        }
    }
}
