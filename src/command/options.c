/* Reads a command line with getopt_long, to which it gives only those options of the table that the command
 * takes, and explains what is wrong with it. getopt_long allows `--size=640x480`, `--size 640x480`, options after
 * the operands, `--` before operands that begin with a dash, and names cut short while they are unambiguous. */
#include "command/options.h"

#include "base/suggest.h"
#include "command/option_table.h"
#include "picture/map.h"

#include <assert.h>
#include <getopt.h>
#include <stdio.h>
#include <string.h>

enum { MAX_OPTIONS = 64, LONG_BASE = 256 }; /* getopt_long returns LONG_BASE + place in the table */

/* The names of the commands, or of one command's options, as suggest_word takes them. */
typedef struct WordList {
    const char *word[MAX_OPTIONS + 1];
    int count;
} WordList;

static void words_add(WordList *words, const char *word)
{
    assert(words->count < MAX_OPTIONS);
    words->word[words->count++] = word;
}

const Command *options_find_command(const Command *commands, const char *name, Error *error)
{
    WordList words = {.count = 0};
    for (const Command *command = commands; command->name; command++) {
        if (strcmp(command->name, name) == 0)
            return command;
        words_add(&words, command->name);
    }
    const char *nearest = suggest_word(name, words.word);
    if (nearest)
        error_set(error, ERROR_USAGE, "there is no command '%s'; did you mean '%s'?", name, nearest);
    else
        error_set(error, ERROR_USAGE, "there is no command '%s'; `rectray --help` lists them", name);
    return NULL;
}

/* --- What getopt_long is given --- */

typedef struct Grammar {
    struct option options[MAX_OPTIONS + 1];
    char letters[2 + 3 * MAX_OPTIONS];
} Grammar;

static int argument_kind(const Option *option)
{
    if (!option->argument)
        return no_argument;
    return option->argument[0] == '[' ? optional_argument : required_argument;
}

static Grammar grammar_of(const Command *command)
{
    Grammar grammar = {.letters = ":"}; /* the colon: tell a missing argument apart */
    char *letter = grammar.letters + 1;
    int count = 0;
    for (int i = 0; option_table[i].name; i++) {
        const Option *option = &option_table[i];
        if (!option_belongs(option, command->name))
            continue;
        assert(count < MAX_OPTIONS);
        grammar.options[count++] = (struct option){option->name, argument_kind(option), NULL, LONG_BASE + i};
        if (option->letter) {
            *letter++ = option->letter;
            for (int colons = argument_kind(option); colons > 0; colons--)
                *letter++ = ':'; /* one: required, two: may be left out */
        }
    }
    return grammar;
}

/* The option for a value that getopt_long returned or left in optopt; NULL for an unknown letter. */
static const Option *option_found(int value)
{
    if (value >= LONG_BASE)
        return &option_table[value - LONG_BASE];
    for (const Option *option = option_table; option->name; option++)
        if (option->letter && option->letter == value)
            return option;
    return NULL;
}

/* --- What is wrong --- */

/* An option of several meanings has several lines in the table. */
static bool belongs_elsewhere(const Command *command, const Option *option, Error *error)
{
    char commands[256] = "";
    for (const Option *other = option_table; other->name; other++)
        if (strcmp(other->name, option->name) == 0) {
            size_t used = strlen(commands);
            snprintf(commands + used, sizeof commands - used, " %s", other->commands);
        }
    return error_set(error, ERROR_USAGE, "%s takes no --%s; that is an option of:%s", command->name, option->name,
                     commands);
}

static bool unknown_letter(const Command *command, int letter, Error *error)
{
    const Option *option = option_found(letter);
    if (option)
        return belongs_elsewhere(command, option, error);
    return error_set(error, ERROR_USAGE, "%s has no option -%c; `rectray %s --help` lists its options", command->name,
                     letter, command->name);
}

/* `word` begins with "--"; it is no option of the command, or the beginning of several. */
static bool unknown_word(const Command *command, const char *word, Error *error)
{
    char name[64];
    size_t length = strcspn(word + 2, "=");
    length = length < sizeof name - 1 ? length : sizeof name - 1;
    memcpy(name, word + 2, length);
    name[length] = '\0';

    WordList words = {.count = 0};
    const char *first = NULL;
    for (const Option *option = option_table; option->name; option++) {
        if (!option_belongs(option, command->name)) {
            if (strcmp(option->name, name) == 0)
                return belongs_elsewhere(command, option, error);
            continue;
        }
        words_add(&words, option->name);
        if (length == 0 || strncmp(option->name, name, length) != 0)
            continue;
        if (first)
            return error_set(error, ERROR_USAGE, "--%s could be --%s or --%s", name, first, option->name);
        first = option->name;
    }
    const char *nearest = suggest_word(name, words.word);
    if (nearest)
        return error_set(error, ERROR_USAGE, "%s has no option --%s; did you mean --%s?", command->name, name, nearest);
    return error_set(error, ERROR_USAGE, "%s has no option --%s; `rectray %s --help` lists its options", command->name,
                     name, command->name);
}

/* getopt_long found something that is none of the options. */
static bool unknown_option(const Command *command, char **argv, Error *error)
{
    if (optopt >= LONG_BASE)
        return error_set(error, ERROR_USAGE, "--%s takes no value", option_found(optopt)->name);
    if (optopt == 0)
        return unknown_word(command, argv[optind - 1], error);
    return unknown_letter(command, optopt, error);
}

static bool wrong_value(const Option *option, const char *value, Error *error)
{
    if (!value)
        return error_set(error, ERROR_USAGE, "--%s needs a value: %s", option->name, option_expects(option).text);
    return error_set(error, ERROR_USAGE, "--%s '%s': expected %s", option->name, value, option_expects(option).text);
}

bool options_agree(const Options *options, Error *error)
{
    bool textbook = options->settings.arithmetic == ARITHMETIC_TEXTBOOK;
    if (options->shift_given && !textbook)
        return error_set(error, ERROR_USAGE,
                         "--shift needs --arithmetic textbook: exact arithmetic finds the shift of each point");
    if (options->map_count > 0 && textbook)
        return error_set(error, ERROR_USAGE, "--map shows what exact arithmetic does; leave out --arithmetic textbook");
    bool scaled = false;
    for (int i = 0; i < options->map_count; i++)
        scaled = scaled || map_has_scale(options->maps[i].kind);
    if (options->map_high > 0 && !scaled)
        return error_set(error, ERROR_USAGE, "--map-scale needs --map rays, time, depth or tests");
    return true;
}

void options_note_unused(const Options *options)
{
    bool is_exact = options->settings.arithmetic == ARITHMETIC_EXACT;
    const struct {
        bool given;
        const char *text;
    } notes[] = {
        {options->settings.device >= 0, "--device does nothing"},
        {options->settings.lanes > 0, "--lanes does nothing"},
        {options->settings.kernel != KERNEL_AUTO, "--kernel does nothing"},
        {options->settings.no_skip != 0, "--no-skip does nothing"},
        {is_exact && options->precision_given && options->settings.precision == PRECISION_FLOAT,
         "--precision float does nothing"},
    };
    if (options->backend != BACKEND_REFERENCE || options->quiet)
        return;
    for (size_t i = 0; i < sizeof notes / sizeof *notes; i++)
        if (notes[i].given)
            fprintf(stderr, "rectray: note: %s with --backend reference, which is scalar and double\n", notes[i].text);
}

/* --- Reading --- */

static bool take_operands(Options *options, const Command *command, int count, char **operands, Error *error)
{
    if (count < command->operands_min)
        return error_set(error, ERROR_USAGE, "%s needs %s; `rectray %s --help` tells more", command->name,
                         command->operands, command->name);
    int column, row;
    if (count > command->operands_max && strcmp(command->name, "trace") == 0 &&
        sscanf(operands[command->operands_max], "%d,%d", &column, &row) == 2)
        return error_set(error, ERROR_USAGE, "trace does not know what to do with '%s'; did you mean --pixel %s?",
                         operands[command->operands_max], operands[command->operands_max]);
    if (count > command->operands_max)
        return error_set(error, ERROR_USAGE, "%s does not know what to do with '%s'; `rectray %s --help` tells more",
                         command->name, operands[command->operands_max], command->name);
    options->operands = (const char *const *)operands;
    options->operand_count = count;
    return true;
}

bool options_parse(Options *options, const Command *command, int argc, char **argv, Error *error)
{
    Grammar grammar = grammar_of(command);
    *options = (Options){
        .settings.device = -1, .settings.shift = SCENE_SHIFT, .bounces = -1, .blocked_light = -1, .picture_format = -1};
    opterr = 0;
    optind = 0; /* from the beginning, whatever was read before */
    for (int found; (found = getopt_long(argc, argv, grammar.letters, grammar.options, NULL)) != -1;) {
        if (found == '?')
            return unknown_option(command, argv, error);
        const Option *option = option_found(found == ':' ? optopt : found);
        const char *value = found == ':' ? NULL : optarg;
        if (value && strchr(option->argument, ' '))
            options->second_value = optind < argc ? argv[optind++] : NULL;
        if (found == ':' || !option_set(option, options, value))
            return wrong_value(option, value, error);
    }
    if (options->help || options->version)
        return true;
    return take_operands(options, command, argc - optind, argv + optind, error);
}
