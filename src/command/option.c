/* How the values of options are read, and how messages tell what they should have been. */
#include "command/option.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

/* OPTION_WORD writes an int into an enum. */
typedef char EnumsAreInts[sizeof(Backend) == sizeof(int) && sizeof(WalkthroughFormat) == sizeof(int) ? 1 : -1];

bool option_belongs(const Option *option, const char *command)
{
    size_t length = strlen(command);
    for (const char *at = option->commands; (at = strstr(at, command)) != NULL; at += length)
        if ((at == option->commands || at[-1] == ' ') && (at[length] == ' ' || at[length] == '\0'))
            return true;
    return option->commands[0] == '\0';
}

const char *option_read_int(const char *text, int low, int high, char end, int *value)
{
    long number = 0;
    const char *at = text;
    for (; isdigit((unsigned char)*at); at++) {
        number = number * 10 + (*at - '0');
        if (number > high)
            return NULL;
    }
    if (at == text || *at != end || number < low)
        return NULL;
    *value = (int)number;
    return at;
}

int option_word(const char *word, const char *const *words)
{
    for (int i = 0; words[i]; i++)
        if (strcmp(words[i], word) == 0)
            return i;
    return -1;
}

bool option_set(const Option *option, Options *options, const char *value)
{
    void *field = (char *)options + option->field;
    int index;
    switch (option->kind) {
    case OPTION_FLAG:
        return *(bool *)field = true;
    case OPTION_TEXT:
        *(const char **)field = value;
        return value[0] != '\0';
    case OPTION_NUMBER:
        return option_read_int(value, option->low, option->high, '\0', field) != NULL;
    case OPTION_WORD:
        index = option_word(value, option->words);
        *(int *)field = index;
        return index >= 0;
    case OPTION_OWN:
        break;
    }
    return option->set(options, value);
}

/* "text, json, obj or svg". */
static OptionText words_of(const char *const *words)
{
    OptionText list = {""};
    for (int i = 0; words[i]; i++) {
        const char *before = i == 0 ? "" : words[i + 1] ? ", " : " or ";
        size_t used = strlen(list.text);
        snprintf(list.text + used, sizeof list.text - used, "%s%s", before, words[i]);
    }
    return list;
}

OptionText option_expects(const Option *option)
{
    OptionText text = {""};
    if (option->expects)
        snprintf(text.text, sizeof text.text, "%s", option->expects);
    else if (option->kind == OPTION_NUMBER)
        snprintf(text.text, sizeof text.text, "a whole number from %d to %d", option->low, option->high);
    else if (option->words)
        return words_of(option->words);
    return text;
}
