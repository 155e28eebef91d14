/* A box as the builder of a hierarchy wants it: the low corner, then the negatives of the high corner, four floats
 * each, of which the last is 0. To grow it takes eight times the smaller of two floats, and compilers make two vector
 * instructions of that. */
#ifndef RECTRAY_BOUNDS_H
#define RECTRAY_BOUNDS_H

#include "scene/box.h"

typedef struct Bounds {
    float least[8]; /* low x, y, z, 0, -high x, y, z, 0 */
} Bounds;

static inline Bounds bounds_of(Box box)
{
    return (Bounds){{box.low[0], box.low[1], box.low[2], 0, -box.high[0], -box.high[1], -box.high[2], 0}};
}

static inline Box bounds_box(Bounds bounds)
{
    const float *least = bounds.least;
    return (Box){{least[0], least[1], least[2]}, {-least[4], -least[5], -least[6]}};
}

/* The bounds of nothing: any union with them is the other bounds. */
static inline Bounds bounds_empty(void)
{
    return (Bounds){{FLT_MAX, FLT_MAX, FLT_MAX, 0, FLT_MAX, FLT_MAX, FLT_MAX, 0}};
}

/* Grows `bounds` to hold the others. */
static inline void bounds_grow(Bounds *bounds, const Bounds *other)
{
    for (int i = 0; i < 8; i++)
        bounds->least[i] = other->least[i] < bounds->least[i] ? other->least[i] : bounds->least[i];
}

/* The same for boxes that are met from the last to the first. The
 * two differ where 0 meets -0: always the first box's zero stays. */
static inline void bounds_grow_before(Bounds *bounds, const Bounds *other)
{
    for (int i = 0; i < 8; i++)
        bounds->least[i] = bounds->least[i] < other->least[i] ? bounds->least[i] : other->least[i];
}

/* Half the surface, as box_half_area. */
static inline double bounds_half_area(const Bounds *bounds)
{
    const float *least = bounds->least;
    double x = -(double)least[4] - (double)least[0], y = -(double)least[5] - (double)least[1];
    double z = -(double)least[6] - (double)least[2];
    return x < 0 ? 0 : x * y + y * z + z * x;
}

/* Bounds of one point: twice the middle of a box. Where it is rounded matters to no picture. */
static inline Bounds bounds_middle(const Bounds *bounds)
{
    Bounds middle;
    for (int i = 0; i < 4; i++)
        middle.least[i] = bounds->least[i] - bounds->least[4 + i];
    for (int i = 0; i < 4; i++)
        middle.least[4 + i] = -middle.least[i];
    return middle;
}

/* Around some boxes, and around their middles. */
typedef struct BoundsRange {
    Bounds boxes, middles;
} BoundsRange;

static inline BoundsRange bounds_range_empty(void)
{
    return (BoundsRange){bounds_empty(), bounds_empty()};
}

static inline void bounds_range_grow(BoundsRange *range, const Bounds *box)
{
    Bounds middle = bounds_middle(box);
    bounds_grow(&range->boxes, box);
    bounds_grow(&range->middles, &middle);
}

static inline BoundsRange bounds_range_of(const Bounds *boxes, int count)
{
    BoundsRange range = bounds_range_empty();
    for (int i = 0; i < count; i++)
        bounds_range_grow(&range, &boxes[i]);
    return range;
}

#endif
