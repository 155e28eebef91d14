/* What a scene file's tree of values does without, where its error is looked for: the long lists. */
#ifndef RECTRAY_SCENE_CUTS_H
#define RECTRAY_SCENE_CUTS_H

#include "json/json.h"

/* Finds the vertices and faces of all objects, of whose list the inside is given. What is not found, since the text is
 * not plain or no JSON, the tree keeps. The caller frees the spans. False without memory. */
bool scene_cuts_find(JsonSpan objects, JsonCuts *cuts, Error *error);

#endif
