/* Windows, which are rectangles of the screen, and the frustum of the rays through one. A frustum is given by the rays
 * of its four corners. Its bounds tell at the root of the tree whether it misses all faces. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "shared/skips.h"
#include "packet/apex.cl"
#include "packet/camera.cl"
#include "packet/lanes.cl"
#include "packet/tiles.cl"
#include "packet/tree.cl"
#include "packet/world.cl"

/* The part of the screen between two places of columns and two of rows. */
typedef struct Window {
    wide x[2], y[2];
} Window;

/* The window of those pixels of a tile that are in the band. A face that covers them may end beyond them, or lie behind
 * the camera there. */
INLINE Window window_of_tile(constant const Parameters *p, const ScreenPlaces *places, int first_column, int first_row)
{
    int column = min((int)TILE_COLUMNS, p->band_columns - first_column) - 1;
    int row = min((int)TILE_ROWS, p->band_rows - first_row) - 1;
    Window w = {{places->x[0], places->x[column]}, {places->y[0], places->y[row]}};
    return w;
}

/* The window of all sub-pixels of an area. */
INLINE Window window_of_area(const World *world, const Area *area)
{
    int column = area->column, row = area->row, last = world->parameters->grid - 1;
    Window w = {{screen_x(world, column, 0), screen_x(world, column + area->columns - 1, last)},
                {screen_y(world, row, 0), screen_y(world, row + area->rows - 1, last)}};
    return w;
}

/* The directions of the four corner rays, component by component. */
typedef struct Frustum {
    real x[4], y[4], z[4];
} Frustum;

/* The frustum of a window. Each component of a direction rises or falls with either place, and so does its rounding: it
 * has its extremes at the corners. */
COMPILED_ONCE Frustum camera_frustum(const Camera *c, const Window *window)
{
    const wide *x = window->x, *y = window->y, *forward = c->forward, *right = c->right, *up = c->up;
    wide4 across = (wide4)(x[0], x[1], x[0], x[1]), down = (wide4)(y[0], y[0], y[1], y[1]);
    Frustum corners;
    vstore4(TO_REAL4(forward[0] + across * right[0] + down * up[0]), 0, corners.x);
    vstore4(TO_REAL4(forward[1] + across * right[1] + down * up[1]), 0, corners.y);
    vstore4(TO_REAL4(forward[2] + across * right[2] + down * up[2]), 0, corners.z);
    return corners;
}

INLINE real least_of(real4 a)
{
    real2 b = LESSER(a.lo, a.hi);
    return LESSER(b.x, b.y);
}

INLINE real most_of(real4 a) { return -least_of(-a); }

/* The bounds of all rays of a frustum. spread: no component of an exact direction is farther from the frustum's. */
INLINE RayBounds bounds_of_frustum(const Apex *a, const Frustum *c, real spread)
{
    real4 x = vload4(0, c->x), y = vload4(0, c->y), z = vload4(0, c->z);
    real low[3] = {least_of(x) - spread, least_of(y) - spread, least_of(z) - spread};
    real high[3] = {most_of(x) + spread, most_of(y) + spread, most_of(z) + spread};
    return bounds_within(a, low, high);
}

/* Do all rays miss all faces, so that they show the background? `--no-skip empty_tile` makes it false. */
INLINE bool is_empty(const World *world, const RayBounds *seen)
{
    return MAY_SKIP(world->parameters, SKIP_EMPTY_TILE) && misses_all(world, seen);
}
