/* Pixels, packets of them, tiles of packets, and the rays through them. */

/* A packet is PACKET_COLUMNS x PACKET_ROWS = LANES pixels; the tile that one work-item renders is PACKETS of them,
 * PACKETS_ACROSS side by side, as the host's build options say. */
enum { TILE_COLUMNS = PACKETS_ACROSS * PACKET_COLUMNS, TILE_ROWS = PACKETS / PACKETS_ACROSS * PACKET_ROWS };

#define TILES_ACROSS(p) (((p)->columns + TILE_COLUMNS - 1) / TILE_COLUMNS)
#define TILES_DOWN(p) (((p)->band_rows + TILE_ROWS - 1) / TILE_ROWS)

static wide view_value(const Shading *s, int column) { return (wide)s->view[column] + (wide)s->view[VIEW_REALS + column]; }

static WideVec view_vec(const Shading *s, int column)
{
    return wide_vec((Wide)view_value(s, column), (Wide)view_value(s, column + 1), (Wide)view_value(s, column + 2));
}

/* Where packet k begins in its tile. */
#define PACKET_COLUMN(k) ((k) % PACKETS_ACROSS * PACKET_COLUMNS)
#define PACKET_ROW(k) ((k) / PACKETS_ACROSS * PACKET_ROWS)

INLINE Apex apex_at_eye(const Shading *s)
{
    wide eye[3] = {view_value(s, VIEW_EYE), view_value(s, VIEW_EYE + 1), view_value(s, VIEW_EYE + 2)};
    return apex_at(eye, 0, s->view[VIEW_LENGTH]);
}

/* The places of the tile's columns and rows on the screen: see view_direction in geometry.c. */
typedef struct ScreenPlaces {
    wide x[TILE_COLUMNS], y[TILE_ROWS];
} ScreenPlaces;

/* For the sub-pixels (i, j) of each pixel's grid. */
INLINE ScreenPlaces screen_places(const Shading *s, int first_column, int first_row, int i, int j)
{
    constant const Parameters *p = s->parameters;
    wide sub_column = (i + (wide)0.5) / p->grid, sub_row = (j + (wide)0.5) / p->grid;
    wide width = view_value(s, VIEW_WIDTH), height = view_value(s, VIEW_HEIGHT);
    ScreenPlaces places;
    for (int column = 0; column < TILE_COLUMNS; column++)
        places.x[column] = ((first_column + column + sub_column) / (wide)p->columns - (wide)0.5) * width;
    for (int row = 0; row < TILE_ROWS; row++)
        places.y[row] = ((wide)0.5 - (first_row + row + sub_row) / (wide)p->rows) * height;
    return places;
}

/* The camera, or its image in mirrors: pixels at (x, y) of the screen are seen along forward + x right + y up. */
typedef struct Camera {
    wide eye[3], forward[3], right[3], up[3];
} Camera;

INLINE Camera camera_of(const Shading *s)
{
    Camera c;
    for (int axis = 0; axis < 3; axis++) {
        c.eye[axis] = view_value(s, VIEW_EYE + axis);
        c.forward[axis] = view_value(s, VIEW_FORWARD + axis);
        c.right[axis] = view_value(s, VIEW_RIGHT + axis);
        c.up[axis] = view_value(s, VIEW_UP + axis);
    }
    return c;
}

INLINE void mirror(global const wide *normal, wide height, wide *v)
{
    for (int axis = 0; axis < 3; axis++)
        v[axis] -= 2 * height * normal[axis];
}

INLINE wide height_of(global const wide *normal, const wide *v) { return normal[0] * v[0] + normal[1] * v[1] + normal[2] * v[2]; }

/* The image of a camera in the plane of a face. */
INLINE Camera camera_in_mirror(const Geometry *g, int face, const Camera *camera)
{
    Camera c = *camera;
    global const wide *n = g->planes + (size_t)face * PLANE_REALS;
    global const real *v = face_row(g, face) + FACE_VERTICES;
    wide off[3] = {c.eye[0] - v[0], c.eye[1] - v[4], c.eye[2] - v[8]};
    mirror(n, height_of(n, off), c.eye);
    mirror(n, height_of(n, c.forward), c.forward);
    mirror(n, height_of(n, c.right), c.right);
    mirror(n, height_of(n, c.up), c.up);
    return c;
}

/* The rays of a tile's corners. Each component of a direction rises or falls with either place, and so does its rounding: it has
 * its extremes there. */
INLINE CornerRays camera_corners(const Camera *c, const ScreenPlaces *places)
{
    CornerRays corners;
    for (int i = 0; i < 4; i++) {
        wide x = places->x[i % 2 * (TILE_COLUMNS - 1)], y = places->y[i / 2 * (TILE_ROWS - 1)];
        corners.x[i] = (real)(c->forward[0] + x * c->right[0] + y * c->up[0]);
        corners.y[i] = (real)(c->forward[1] + x * c->right[1] + y * c->up[1]);
        corners.z[i] = (real)(c->forward[2] + x * c->right[2] + y * c->up[2]);
    }
    return corners;
}

/* The directions R = Q - C of packet k's rays. */
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
    return wide_vec(c->forward[0] + across * c->right[0] + down * c->up[0], c->forward[1] + across * c->right[1] + down * c->up[1],
                    c->forward[2] + across * c->right[2] + down * c->up[2]);
}
