/* A table from names to numbers: a hash table with open addressing (Knuth, TAOCP 3, section 6.4), so that a
 * scene of ten thousand materials and a million faces that name them still loads in linear time. */
#ifndef RECTRAY_NAMES_H
#define RECTRAY_NAMES_H

#include "base/error.h"

typedef struct Name {
    const char *text; /* borrowed; NULL: a free slot */
    int value;
} Name;

typedef struct Names {
    Name *slots;
    int count, capacity;
} Names;

/* The value of a name, or -1. */
int names_find(const Names *names, const char *text);

/* Adds a name that is not there yet; the text must outlive the table. Values are 0 or more. */
bool names_add(Names *names, const char *text, int value, Error *error);

void names_free(Names *names);

#endif
