/* Axis-aligned boxes, and the part of a ray inside one: what the trees are made of. */
#ifndef RECTRAY_BOX_H
#define RECTRAY_BOX_H

#include "base/vec3.h"

#include <float.h>

typedef struct Box {
    float low[3], high[3];
} Box;

/* The part of a ray from t = enter to t = leave; none where enter > leave. */
typedef struct Interval {
    double enter, leave;
} Interval;

/* The box of no point at all: any union with it is the other box. */
static inline Box box_empty(void)
{
    return (Box){{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}};
}

/* Grows `box` to hold the other one. Here, like the next two, since building a tree is made of it. */
static inline void box_grow(Box *box, const Box *other)
{
    for (int axis = 0; axis < 3; axis++) {
        box->low[axis] = other->low[axis] < box->low[axis] ? other->low[axis] : box->low[axis];
        box->high[axis] = other->high[axis] > box->high[axis] ? other->high[axis] : box->high[axis];
    }
}

static inline Box box_union(Box a, Box b)
{
    box_grow(&a, &b);
    return a;
}

/* Half the surface of a box: proportional to the chance that a random line meets it. 0 for the empty box. */
static inline double box_half_area(Box box)
{
    double x = (double)box.high[0] - (double)box.low[0], y = (double)box.high[1] - (double)box.low[1];
    double z = (double)box.high[2] - (double)box.low[2];
    return x < 0 ? 0 : x * y + y * z + z * x;
}

/* The part, from t = 0 on, that lies between two planes across an axis (in them, too), and in a box (Kay and Kajiya
 * 1986).
 * - It is never too short: it reaches beyond the exact one by more than rounding took away (Ize, "Robust BVH Ray
 *   Traversal", 2013).
 * - It is monotonic, bit for bit: a box inside another one gets an interval inside the other's. So a ray that meets the
 *   box of a face at some t meets every box around it at that t: the reason why trees lose nothing. */
Interval interval_between(double low, double high, double origin, double direction);
Interval interval_in_box(Box box, Vec3 origin, Vec3 direction);

Interval interval_common(Interval a, Interval b);

#endif
