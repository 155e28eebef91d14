/* The part of a ray inside a box, as in src/scene/box.c, bit for bit (Kay and Kajiya 1986). It reaches beyond the exact
 * part by more than rounding took away, so that no box is missed. */
#include "shared/precision.cl"
#include "plain/scene.cl"

/* From t = enter to t = leave; none where enter > leave. */
typedef struct Interval {
    wide enter, leave;
} Interval;

static Interval interval_common(Interval a, Interval b)
{
    Interval both = {a.enter > b.enter ? a.enter : b.enter, a.leave < b.leave ? a.leave : b.leave};
    return both;
}

/* The part, from t = 0 on, between two planes across an axis. */
static Interval interval_between(wide low, wide high, wide origin, wide direction)
{
    const Interval all = {0, INFINITY}, none = {INFINITY, -INFINITY};
    if (direction == 0)
        return low <= origin && origin <= high ? all : none;
    wide to_low = (low - origin) / direction, to_high = (high - origin) / direction;
    wide enter = direction > 0 ? to_low : to_high, leave = direction > 0 ? to_high : to_low;
    Interval between = {enter * (1 - 8 * WIDE_ROUNDING), leave * (1 + 8 * WIDE_ROUNDING)};
    return interval_common(all, between);
}

/* box: low x, high x, low y, ..., one value every `stride`. */
static Interval interval_in_box(global const float *box, int stride, Ray ray)
{
    Interval x = interval_between(box[0], box[stride], ray.origin.x, ray.direction.x);
    Interval y = interval_between(box[2 * stride], box[3 * stride], ray.origin.y, ray.direction.y);
    Interval z = interval_between(box[4 * stride], box[5 * stride], ray.origin.z, ray.direction.z);
    return interval_common(x, interval_common(y, z));
}
