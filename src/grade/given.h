/* A walkthrough that some program wrote, in any language: the JSON of `rectray trace --format json`, or a part of it.
 * docs/given.schema.json says what must be there; what is not known is passed over. */
#ifndef RECTRAY_GIVEN_H
#define RECTRAY_GIVEN_H

#include "trace/recorder.h"
#include "json/json.h"

#include <stdbool.h>

/* Something that the program says has happened. */
typedef struct GivenEvent {
    EventKind kind;
    const cJSON *object; /* its members are those of our event of that kind; the tree's */
} GivenEvent;

typedef struct Given {
    Json json;
    bool has_pixel;
    int column, row, i, j; /* of the pixel, and of the sample; 0 where it is not said */
    GivenEvent *events;
    int count, capacity;
    bool kinds[EVENT_KIND_COUNT]; /* which kinds of events it tells */
} Given;

/* Reads a file, or standard input for "-". A failure is an ERROR_INPUT with the place, or want of memory. */
bool given_load(Given *given, const char *path, Error *error);

/* The same for a text in memory. */
bool given_parse(Given *given, const char *name, const char *text, long length, Error *error);

/* A zeroed one may be freed, also after a failure. */
void given_free(Given *given);

#endif
