/* Where in the scene file a hint's subject stands. */
#ifndef RECTRAY_HINT_PLACES_H
#define RECTRAY_HINT_PLACES_H

#include "scene/hint.h"
#include "json/json.h"

/* The scene file, read once more. Zeroed: no place is known. */
typedef struct HintPlaces {
    Json json;
} HintPlaces;

/* Reads a file that was accepted as a scene. Of a very large one no place is known. Fails only for want of memory.
 * hint_places_free may be called in any case. */
bool hint_places_read(HintPlaces *places, const char *path, Error *error);
void hint_places_free(HintPlaces *places);

/* Line 0: the place is not known, as of a material of a model's library. */
JsonPlace hint_place(const HintPlaces *places, const Scene *scene, const Hint *hint);

#endif
