/* A line of a text file as words between blanks. */
#include "base/words.h"

#include <stdarg.h>
#include <string.h>

static const char BLANKS[] = " \t\v\f";

char *word_next(char **rest)
{
    char *word = *rest + strspn(*rest, BLANKS);
    char *end = word + strcspn(word, BLANKS);
    *rest = *end ? end + 1 : end;
    *end = '\0';
    return word;
}

char *word_rest(char **rest)
{
    char *word = *rest + strspn(*rest, BLANKS);
    size_t length = strlen(word);
    while (length > 0 && strchr(BLANKS, word[length - 1]))
        length--;
    word[length] = '\0';
    *rest = word + length;
    return word;
}

bool word_fail(const TextLines *lines, Error *error, const char *format, ...)
{
    char reason[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(reason, sizeof reason, format, arguments);
    va_end(arguments);
    return error_set(error, ERROR_INPUT, "%s:%ld: %s", lines->path, lines->line, reason);
}

bool word_numbers(const TextLines *lines, char *rest, double *numbers, int room, int *count, Error *error)
{
    for (*count = 0;; ++*count) {
        char *word = word_next(&rest);
        if (!*word)
            return true;
        if (*count == room)
            return word_fail(lines, error, "more than %d numbers", room);
        if (!text_number(word, &numbers[*count]))
            return word_fail(lines, error, "%s is not a finite number%s", text_quote(word).text,
                             strchr(word, ',') ? "; blanks separate the numbers, and a point their fractions" : "");
    }
}
