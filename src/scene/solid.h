/* Closed objects: boxes, and models without a hole. Nothing passes between the inside of one and its outside. */
#ifndef RECTRAY_SOLID_H
#define RECTRAY_SOLID_H

#include "scene/box.h"
#include "scene/scene.h"

typedef enum SolidKind {
    SOLID_UNKNOWN, /* not looked at yet */
    SOLID_OPEN,    /* has a hole, or one-sided faces, or is too large to be looked at */
    SOLID_OUTWARD, /* closed, all normals point outward */
    SOLID_INWARD,  /* closed, all normals point inward */
    SOLID_MIXED    /* closed, some normals point outward */
} SolidKind;

typedef struct Solids {
    const Scene *scene;
    unsigned char *kinds; /* one SolidKind for each object */
    Box *boxes;           /* around each object's vertices */
    Error *error;
} Solids;

/* Fails only for want of memory, as do the functions below: then they return false. solids_free may be called in any
 * case. */
bool solids_make(Solids *solids, const Scene *scene, Error *error);
void solids_free(Solids *solids);

/* Is the object closed, and the point inside it? */
bool solid_holds(Solids *solids, int object, Vec3 point);

/* Does the camera see the face from the inside of a closed object only, while it is outside itself? Then other faces of
 * the object hide it. */
bool solid_hides(Solids *solids, int face);

#endif
