/* Rays through samples of pixels, lane by lane. */
#include "shared/precision.cl"
#include "packet/camera.cl"
#include "packet/lanes.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"

/* The directions R = Q - C to sub-pixels (i, j) of the pixels at (column, row), lane by lane: see view_direction in
 * geometry.c. */
static WideVec direction_to(const World *world, Wide column, Wide row, Wide i, Wide j)
{
    constant const Parameters *p = world->parameters;
    Wide sub_column = (i + (wide)0.5f) / (wide)p->grid, sub_row = (j + (wide)0.5f) / (wide)p->grid;
    Wide x = ((column + sub_column) / (wide)p->columns - (wide)0.5f) * view_value(world, VIEW_WIDTH);
    Wide y = ((wide)0.5f - (row + sub_row) / (wide)p->rows) * view_value(world, VIEW_HEIGHT);
    return wide_add(wide_add(view_vec(world, VIEW_FORWARD), wide_scale(x, view_vec(world, VIEW_RIGHT))),
                    wide_scale(y, view_vec(world, VIEW_UP)));
}
