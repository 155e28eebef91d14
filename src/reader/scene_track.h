/* A track of an animation: a list of keys for the camera, an object or a light. A key holds what the scene would hold
 * there. To let another value move, add it to the table of its kind in scene_track.c. */
#ifndef RECTRAY_SCENE_TRACK_H
#define RECTRAY_SCENE_TRACK_H

#include "reader/scene_curve.h"
#include "json/json.h"

enum { TRACK_MAX_FRAMES = 1000000 }; /* of an animation */

typedef enum TrackKind { TRACK_CAMERA, TRACK_OBJECT, TRACK_LIGHT, TRACK_KINDS } TrackKind;

typedef struct Track {
    TrackKind kind;
    char target[32];     /* where its values go: camera, objects[3], lights[0] */
    const cJSON **items; /* the keys, in order */
    CurveKey *curve;     /* when they are reached */
    int count;
} Track;

/* Reads the keys of a list, which the tree keeps. `smooth` holds for keys that do not say how the way goes on. Errors:
 * no key; frames that are not whole, or do not rise; values that the scene could not hold; a key that has other values
 * than the first one, or a transform of other steps. Free it also after a failure. */
bool scene_track_read(Track *track, const Json *json, const cJSON *list, bool smooth);
void scene_track_free(Track *track);

/* The text of a scene with the values of a frame in it; takes over `text`. NULL with the error filled. */
char *scene_track_apply(const Track *track, int frame, char *text, Error *error);

/* A number as JSON, in as few digits as give the same double when they are read. */
typedef struct TrackNumber {
    char text[32];
} TrackNumber;

TrackNumber scene_track_number(double x);

/* The text of a scene with a value where a path leads; takes over `text`. NULL with the error filled. */
char *scene_track_put(char *text, const char *path, const char *value, Error *error);

#endif
