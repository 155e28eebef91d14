/* Convex polygons with rational corners, cut by lines. */
#include "polygon.h"

#include <assert.h>
#include <stdlib.h>

/* --- Lines --- */

void line_init(Line *line)
{
    for (int i = 0; i < 3; i++)
        mpq_init(line->at[i]);
}

void line_clear(Line *line)
{
    for (int i = 0; i < 3; i++)
        mpq_clear(line->at[i]);
}

void line_scale(Line *line, const mpq_t factor)
{
    for (int i = 0; i < 3; i++)
        mpq_mul(line->at[i], line->at[i], factor);
}

static void line_value(mpq_t value, const Line *line, const mpq_t u, const mpq_t v)
{
    mpq_t product;
    mpq_init(product);
    mpq_mul(value, line->at[1], u);
    mpq_mul(product, line->at[2], v);
    mpq_add(value, value, product);
    mpq_add(value, value, line->at[0]);
    mpq_clear(product);
}

bool line_crosses(const Line *line)
{
    int above = 0, below = 0;
    mpq_t u, v, value;
    mpq_inits(u, v, value, NULL);
    for (unsigned corner = 0; corner < 4; corner++) {
        mpq_set_ui(u, corner % 2, 1);
        mpq_set_ui(v, corner / 2, 1);
        line_value(value, line, u, v);
        above += mpq_sgn(value) > 0;
        below += mpq_sgn(value) < 0;
    }
    mpq_clears(u, v, value, NULL);
    return above > 0 && below > 0;
}

bool line_is_zero(const Line *line)
{
    return mpq_sgn(line->at[0]) == 0 && mpq_sgn(line->at[1]) == 0 && mpq_sgn(line->at[2]) == 0;
}

/* --- Polygons --- */

static Polygon *polygon_new(void)
{
    Polygon *polygon = malloc(sizeof *polygon);
    assert(polygon);
    polygon->count = 0;
    for (int i = 0; i < POLYGON_CORNERS; i++)
        mpq_inits(polygon->u[i], polygon->v[i], NULL);
    return polygon;
}

static void polygon_free(Polygon *polygon)
{
    for (int i = 0; i < POLYGON_CORNERS; i++)
        mpq_clears(polygon->u[i], polygon->v[i], NULL);
    free(polygon);
}

static Polygon *polygon_pixel(void)
{
    static const unsigned u[] = {0, 1, 1, 0}, v[] = {0, 0, 1, 1};
    Polygon *polygon = polygon_new();
    polygon->count = 4;
    for (int i = 0; i < 4; i++) {
        mpq_set_ui(polygon->u[i], u[i], 1);
        mpq_set_ui(polygon->v[i], v[i], 1);
    }
    return polygon;
}

static void polygon_add(Polygon *polygon, const mpq_t u, const mpq_t v)
{
    assert(polygon->count < POLYGON_CORNERS);
    mpq_set(polygon->u[polygon->count], u);
    mpq_set(polygon->v[polygon->count++], v);
}

/* a + share (b - a) */
static void between(mpq_t out, const mpq_t a, const mpq_t b, const mpq_t share)
{
    mpq_sub(out, b, a);
    mpq_mul(out, out, share);
    mpq_add(out, out, a);
}

/* What of the polygon is where sign * line >= 0 (Sutherland and Hodgman 1974). */
static Polygon *polygon_cut(const Polygon *polygon, const Line *line, int sign)
{
    Polygon *part = polygon_new();
    mpq_t here, next, share, u, v;
    mpq_inits(here, next, share, u, v, NULL);
    for (int i = 0; i < polygon->count; i++) {
        int j = (i + 1) % polygon->count;
        line_value(here, line, polygon->u[i], polygon->v[i]);
        line_value(next, line, polygon->u[j], polygon->v[j]);
        int a = sign * mpq_sgn(here), b = sign * mpq_sgn(next);
        if (a >= 0)
            polygon_add(part, polygon->u[i], polygon->v[i]);
        if (a * b < 0) {
            mpq_sub(share, here, next);
            mpq_div(share, here, share);
            between(u, polygon->u[i], polygon->u[j], share);
            between(v, polygon->v[i], polygon->v[j], share);
            polygon_add(part, u, v);
        }
    }
    mpq_clears(here, next, share, u, v, NULL);
    return part;
}

/* Twice the area, by the shoelace formula; its sign is the sense of rotation. */
static void polygon_area2(mpq_t area, const Polygon *polygon)
{
    mpq_t a, b;
    mpq_inits(a, b, NULL);
    mpq_set_ui(area, 0, 1);
    for (int i = 0; i < polygon->count; i++) {
        int j = (i + 1) % polygon->count;
        mpq_mul(a, polygon->u[i], polygon->v[j]);
        mpq_mul(b, polygon->u[j], polygon->v[i]);
        mpq_sub(a, a, b);
        mpq_add(area, area, a);
    }
    mpq_clears(a, b, NULL);
}

static bool polygon_is_empty(const Polygon *polygon)
{
    if (polygon->count < 3)
        return true;
    mpq_t area;
    mpq_init(area);
    polygon_area2(area, polygon);
    bool empty = mpq_sgn(area) == 0;
    mpq_clear(area);
    return empty;
}

/* --- Pieces of a pixel --- */

/* Takes the polygon over. */
static void pieces_add(Pieces *pieces, Polygon *polygon)
{
    if (polygon_is_empty(polygon)) {
        polygon_free(polygon);
        return;
    }
    pieces->list = realloc(pieces->list, (size_t)(pieces->count + 1) * sizeof *pieces->list);
    assert(pieces->list);
    pieces->list[pieces->count++] = polygon;
}

void pieces_free(Pieces *pieces)
{
    for (int i = 0; i < pieces->count; i++)
        polygon_free(pieces->list[i]);
    free(pieces->list);
    *pieces = (Pieces){0};
}

Pieces pieces_pixel(void)
{
    Pieces pieces = {0};
    pieces_add(&pieces, polygon_pixel());
    return pieces;
}

void pieces_keep(Pieces *pieces, const Line *const *lines, int count)
{
    for (int k = 0; k < count; k++) {
        Pieces inside = {0};
        for (int i = 0; i < pieces->count; i++)
            pieces_add(&inside, polygon_cut(pieces->list[i], lines[k], 1));
        pieces_free(pieces);
        *pieces = inside;
    }
}

void pieces_subtract(Pieces *pieces, const Line *const *lines, int count)
{
    Pieces left = {0};
    for (int i = 0; i < pieces->count; i++) {
        Polygon *rest = polygon_cut(pieces->list[i], lines[0], 1);
        pieces_add(&left, polygon_cut(pieces->list[i], lines[0], -1));
        for (int k = 1; k < count; k++) {
            Polygon *inner = polygon_cut(rest, lines[k], 1);
            pieces_add(&left, polygon_cut(rest, lines[k], -1));
            polygon_free(rest);
            rest = inner;
        }
        polygon_free(rest);
    }
    pieces_free(pieces);
    *pieces = left;
}

double pieces_area(const Pieces *pieces)
{
    mpq_t area, sum;
    mpq_inits(area, sum, NULL);
    for (int i = 0; i < pieces->count; i++) {
        polygon_area2(area, pieces->list[i]);
        mpq_abs(area, area);
        mpq_add(sum, sum, area);
    }
    double twice = mpq_get_d(sum);
    mpq_clears(area, sum, NULL);
    return twice / 2;
}
