/* The "orbit" of an animation, the short form for a camera that turns about an axis through a point. */
#ifndef RECTRAY_SCENE_ORBIT_H
#define RECTRAY_SCENE_ORBIT_H

#include "base/vec3.h"
#include "json/json.h"

typedef struct Orbit {
    Vec3 centre, axis;
    double degrees;             /* in the whole film */
    Vec3 position, look_at, up; /* of the scene's camera */
    bool given, turns_up;       /* the axis is not the camera's own "up" */
} Orbit;

/* Reads the orbit, and the camera of the scene. */
bool scene_orbit_read(Orbit *orbit, const Json *json, const cJSON *item);

/* The text of a scene whose camera has gone so far on its way, from 0 to 1; takes over `text`. NULL with the error
 * filled. */
char *scene_orbit_apply(const Orbit *orbit, double way, char *text, Error *error);

#endif
