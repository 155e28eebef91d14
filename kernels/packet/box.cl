/* Where rays are in the bounding box of a face (Kay and Kajiya, "Ray Tracing Complex Scenes", 1986). The t of a hit is
 * clamped to that part of the ray: a ray that grazes a face which rounding has warped may meet its plane outside the
 * face. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/lanes.cl"
#include "packet/rays.cl"

/* The part of each ray from t = enter to t = leave. */
typedef struct Interval {
    Wide enter, leave;
} Interval;

/* Narrows the interval to between two planes across an axis, as interval_between in src/scene/box.c, bit for bit. */
INLINE void cross_planes(Interval *interval, wide low, wide high, Wide origin, Wide direction)
{
    const wide slack = 8 * WIDE_ROUNDING;
    Wide to_low = (low - origin) / direction, to_high = (high - origin) / direction;
    WideMask along = IS(direction == (Wide)0), forward = IS(direction > (Wide)0);
    WideMask between = IS(origin >= (Wide)low) & IS(origin <= (Wide)high);
    Wide enter = (forward ? to_low : to_high) * (1 - slack), leave = (forward ? to_high : to_low) * (1 + slack);
    enter = along ? (between ? (Wide)0 : (Wide)WIDE_MAX) : enter;
    leave = along ? (between ? (Wide)WIDE_MAX : (Wide)-WIDE_MAX) : leave;
    interval->enter = enter > interval->enter ? enter : interval->enter;
    interval->leave = leave < interval->leave ? leave : interval->leave;
}

/* Where each ray is in the face's box. */
static Interval interval_in_box(global const FaceRecord *face, const Ray *ray)
{
    Interval interval = {(Wide)0, (Wide)WIDE_MAX};
    cross_planes(&interval, (wide)face->box[0], (wide)face->box[1], ray->origin.x, ray->direction.x);
    cross_planes(&interval, (wide)face->box[2], (wide)face->box[3], ray->origin.y, ray->direction.y);
    cross_planes(&interval, (wide)face->box[4], (wide)face->box[5], ray->origin.z, ray->direction.z);
    return interval;
}
