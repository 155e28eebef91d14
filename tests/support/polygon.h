/* Convex polygons in a pixel, cut by lines, in rational arithmetic without any rounding (GMP). */
#ifndef RECTRAY_TESTS_POLYGON_H
#define RECTRAY_TESTS_POLYGON_H

#include <gmp.h>
#include <stdbool.h>

enum { POLYGON_CORNERS = 48 };

/* Where at[0] + at[1] u + at[2] v >= 0: u, v in [0, 1] run over the pixel, to the right and down. */
typedef struct Line {
    mpq_t at[3];
} Line;

typedef struct Polygon {
    int count;
    mpq_t u[POLYGON_CORNERS], v[POLYGON_CORNERS];
} Polygon;

/* Polygons that do not overlap. */
typedef struct Pieces {
    int count;
    Polygon **list;
} Pieces;

void line_init(Line *line);
void line_clear(Line *line);
void line_scale(Line *line, const mpq_t factor);
bool line_is_zero(const Line *line);

/* Does the line go through the inside of the pixel? */
bool line_crosses(const Line *line);

/* The whole pixel as one piece. */
Pieces pieces_pixel(void);
void pieces_free(Pieces *pieces);

/* Keeps what is inside all of the lines, or what is outside at least one of them. */
void pieces_keep(Pieces *pieces, const Line *const *lines, int count);
void pieces_subtract(Pieces *pieces, const Line *const *lines, int count);

/* The area of all pieces, rounded once. */
double pieces_area(const Pieces *pieces);

#endif
