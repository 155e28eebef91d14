/* Rays in the coordinates of a scene file: origin and direction, six numbers. How they become rays that are traced. */
#ifndef RECTRAY_WORLD_RAY_H
#define RECTRAY_WORLD_RAY_H

#include "base/vec3.h"

#include <stdbool.h>

/* A component of a ray is 0 or between these, so that no product of three leaves a double's range (exact.h), and 1e12
 * at most from the scene's centre, as the scene's own coordinates are. */
#define WORLD_RAY_SMALLEST 1e-60
#define WORLD_RAY_LARGEST_DIRECTION 1e60
#define WORLD_RAY_LARGEST_POSITION 1e12

/* False for NaN and infinity, too. The second one is true for a direction of zero. */
bool world_ray_origin_in_range(const double ray[6], Vec3 centre);
bool world_ray_direction_in_range(const double ray[6]);

bool world_ray_has_direction(const double ray[6]);

/* The ray as seen from the scene's centre. The direction is divided by the power of two whose exponent is returned,
 * which is exact, so that its largest component is in [0.5, 1): floats hold it. */
int world_ray_localise(const double ray[6], Vec3 centre, double local[6]);

/* The t of a localised ray's hit, along the ray itself. */
double world_ray_t(double local_t, int exponent);

#endif
