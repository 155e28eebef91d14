/* Affine transforms: x -> M x + t, as scale, rotate and translate steps make them. */
#ifndef RECTRAY_TRANSFORM_H
#define RECTRAY_TRANSFORM_H

#include "base/vec3.h"

#include <stdbool.h>

typedef struct Transform {
    Vec3 rows[3]; /* of M */
    Vec3 offset;  /* t */
} Transform;

Transform transform_identity(void);
Transform transform_scale(Vec3 factors);
Transform transform_translate(Vec3 offset);

/* The rotation about a non-zero axis through the origin, counter-clockwise for
 * one who looks against the axis (right-hand rule): R = cos I + sin [k] + (1 -
 * cos) k k^T for the unit axis k (Rodrigues 1840). Quarter turns are exact. */
Transform transform_rotate(Vec3 axis, double degrees);

/* First `first`, then `next`. */
Transform transform_then(Transform first, Transform next);

Vec3 transform_point(const Transform *transform, Vec3 point);

/* Does it turn a right hand into a left one (det M < 0)? */
bool transform_mirrors(const Transform *transform);

#endif
