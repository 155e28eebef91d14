/* What the program's own walkthrough, or one with a slip, says: the members of each event by name, as a walkthrough in
 * JSON has them. */
#ifndef RECTRAY_EXPECTED_H
#define RECTRAY_EXPECTED_H

#include "walkthrough/walkthrough.h"

#include <cjson/cJSON.h>

typedef struct ExpectedEvent {
    EventKind kind;
    int hit; /* the number of P1, P2, ... that it belongs to; 0 before the first */
    cJSON *object;
} ExpectedEvent;

typedef struct Expected {
    ExpectedEvent *events;
    int count;
} Expected;

/* The events of the sample that is told, and the pixel's. False without memory. */
bool expected_make(Expected *expected, const Walkthrough *walk, Error *error);
void expected_free(Expected *expected);

#endif
