/* A line of a text file as words between blanks. */
#ifndef RECTRAY_WORDS_H
#define RECTRAY_WORDS_H

#include "base/text.h"

/* Cuts the next word off *rest and ends it with a NUL; an empty one at the end. */
char *word_next(char **rest);

/* All that is left, without the blanks around it: a name, which may hold blanks. */
char *word_rest(char **rest);

/* Reads the words that are left as numbers, at most `room`; *count is how many. Fails at a word that is no number. */
bool word_numbers(const TextLines *lines, char *rest, double *numbers, int room, int *count, Error *error);

/* "PATH:LINE: reason" of the line last read. */
bool word_fail(const TextLines *lines, Error *error, const char *format, ...)
#ifdef __GNUC__
    __attribute__((format(printf, 3, 4)))
#endif
    ;

#endif
