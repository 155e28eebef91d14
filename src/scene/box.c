/* Axis-aligned boxes, and the part of a ray inside one. */
#include "scene/box.h"

#include <float.h>

/* Three roundings part a computed t from the exact one: of the direction, the difference and the quotient, half an
 * epsilon each. More than twice that, and what this product rounds itself. */
#define SLACK (4 * DBL_EPSILON)

Interval interval_common(Interval a, Interval b)
{
    return (Interval){a.enter > b.enter ? a.enter : b.enter, a.leave < b.leave ? a.leave : b.leave};
}

Interval interval_between(double low, double high, double origin, double direction)
{
    /* A ray along the planes lies between them with all its points or with none. */
    if (direction == 0)
        return low <= origin && origin <= high ? (Interval){0, HUGE_VAL} : (Interval){HUGE_VAL, -HUGE_VAL};
    double to_low = (low - origin) / direction, to_high = (high - origin) / direction;
    double enter = direction > 0 ? to_low : to_high, leave = direction > 0 ? to_high : to_low;
    return interval_common((Interval){0, HUGE_VAL}, (Interval){enter * (1 - SLACK), leave * (1 + SLACK)});
}

Interval interval_in_box(Box box, Vec3 origin, Vec3 direction)
{
    Interval x = interval_between((double)box.low[0], (double)box.high[0], origin.x, direction.x);
    Interval y = interval_between((double)box.low[1], (double)box.high[1], origin.y, direction.y);
    Interval z = interval_between((double)box.low[2], (double)box.high[2], origin.z, direction.z);
    return interval_common(x, interval_common(y, z));
}
