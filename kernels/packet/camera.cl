/* The camera and the rays through pixels. docs/algorithm.md, section 1:
 *
 *     R = forward + x right + y up
 *
 * A plane mirror makes of the camera another camera, its image, of which the same holds. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/apex.cl"
#include "packet/faces.cl"
#include "packet/lanes.cl"
#include "packet/tiles.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"

/* A value of the view, with what rounding took from it. */
static wide view_value(const World *world, int column)
{
    return (wide)world->view[column] + (wide)world->view[VIEW_REALS + column];
}

static WideVec view_vec(const World *world, int column)
{
    return wide_vec((Wide)view_value(world, column), (Wide)view_value(world, column + 1),
                    (Wide)view_value(world, column + 2));
}

INLINE Apex apex_at_eye(const World *world)
{
    wide eye[3] = {view_value(world, VIEW_EYE), view_value(world, VIEW_EYE + 1), view_value(world, VIEW_EYE + 2)};
    return apex_at(eye, 0, world->view[VIEW_LENGTH]);
}

/* The places of a tile's columns and rows on the screen, as view_direction in src/scene/geometry.c has them. */
typedef struct ScreenPlaces {
    wide x[TILE_COLUMNS], y[TILE_ROWS];
} ScreenPlaces;

/* x of the middle of sub-column i of a column of the band's pixels. */
INLINE wide screen_x(const World *world, int column, int i)
{
    constant const Parameters *p = world->parameters;
    wide place = p->first_column + column + (i + (wide)0.5f) / p->grid;
    return (place / (wide)p->columns - (wide)0.5f) * view_value(world, VIEW_WIDTH);
}

/* y of the middle of sub-row j of a row of the band's pixels. */
INLINE wide screen_y(const World *world, int row, int j)
{
    constant const Parameters *p = world->parameters;
    wide place = p->first_row + row + (j + (wide)0.5f) / p->grid;
    return ((wide)0.5f - place / (wide)p->rows) * view_value(world, VIEW_HEIGHT);
}

/* The places of the sub-pixels (i, j). */
INLINE ScreenPlaces screen_places(const World *world, int first_column, int first_row, int i, int j)
{
    ScreenPlaces places;
    for (int column = 0; column < TILE_COLUMNS; column++)
        places.x[column] = screen_x(world, first_column + column, i);
    for (int row = 0; row < TILE_ROWS; row++)
        places.y[row] = screen_y(world, first_row + row, j);
    return places;
}

/* The camera, or its image in mirrors. */
typedef struct Camera {
    wide eye[3], forward[3], right[3], up[3];
} Camera;

INLINE Camera camera_of(const World *world)
{
    Camera c;
    for (int axis = 0; axis < 3; axis++) {
        c.eye[axis] = view_value(world, VIEW_EYE + axis);
        c.forward[axis] = view_value(world, VIEW_FORWARD + axis);
        c.right[axis] = view_value(world, VIEW_RIGHT + axis);
        c.up[axis] = view_value(world, VIEW_UP + axis);
    }
    return c;
}

/* Turns the part of v along the normal round. height: v.N, or for a point its distance from the plane. */
INLINE void mirror(global const wide *normal, wide height, wide *v)
{
    for (int axis = 0; axis < 3; axis++)
        v[axis] -= 2 * height * normal[axis];
}

INLINE wide height_of(global const wide *normal, const wide *v)
{
    return normal[0] * v[0] + normal[1] * v[1] + normal[2] * v[2];
}

/* The image of a camera in the plane of a face. */
COMPILED_ONCE Camera camera_in_mirror(const World *world, int face, const Camera *camera)
{
    Camera c = *camera;
    global const wide *n = world->planes + (size_t)face * PLANE_REALS;
    global const real *v = face_row(world, face) + FACE_VERTICES;
    wide off[3] = {c.eye[0] - v[0], c.eye[1] - v[4], c.eye[2] - v[8]};
    mirror(n, height_of(n, off), c.eye);
    mirror(n, height_of(n, c.forward), c.forward);
    mirror(n, height_of(n, c.right), c.right);
    mirror(n, height_of(n, c.up), c.up);
    return c;
}

/* The directions R of packet k's rays. */
INLINE WideVec camera_direction(const Camera *c, const ScreenPlaces *places, int k)
{
    const wide *x = places->x + PACKET_COLUMN(k), *y = places->y + PACKET_ROW(k);
#if LANES == 16
    Wide across = (Wide)(vload4(0, x), vload4(0, x), vload4(0, x), vload4(0, x));
    Wide down = (Wide)((wide4)y[0], (wide4)y[1], (wide4)y[2], (wide4)y[3]);
#elif LANES == 8
    Wide across = (Wide)(vload4(0, x), vload4(0, x)), down = (Wide)((wide4)y[0], (wide4)y[1]);
#elif LANES == 4
    Wide across = (Wide)(x[0], x[1], x[0], x[1]), down = (Wide)(y[0], y[0], y[1], y[1]);
#else
    Wide across = x[0], down = y[0];
#endif
    return wide_vec(c->forward[0] + across * c->right[0] + down * c->up[0],
                    c->forward[1] + across * c->right[1] + down * c->up[1],
                    c->forward[2] + across * c->right[2] + down * c->up[2]);
}
