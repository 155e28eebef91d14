/* Which files an mtllib line of a model means. Names may hold blanks, and were often written on Windows: a name is
 * looked for as it is written, then with '/' for each backslash, then without regard to case, where exactly one file
 * matches. */
#ifndef RECTRAY_MODEL_LIBRARY_H
#define RECTRAY_MODEL_LIBRARY_H

#include "base/error.h"

typedef struct LibraryName {
    char *name;      /* as it is written */
    char *path;      /* of the file; NULL: there is none */
    bool as_written; /* the path is that name, beside the model */
} LibraryName;

/* Takes the next name off *rest, which is what follows mtllib: the longest text of up to 16 words that names a file,
 * else, as a missing one, the words up to one that ends in ".mtl". False where none is left, and without memory. */
bool library_name_next(LibraryName *library, const char *model, char **rest, Error *error);

void library_name_free(LibraryName *library);

/* The path of the file that the name means, seen from the folder of `beside`. NULL, without an error, where there is
 * none. */
char *library_path(const char *beside, const char *name, bool *as_written, Error *error);

#endif
