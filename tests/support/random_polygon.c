/* Random polygons, and what their edges do to one another. */
#include "random_polygon.h"

#include "xorshift.h"

#include <math.h>
#include <stdlib.h>

static int64_t random_below(uint64_t *random, int64_t limit)
{
    return (int64_t)(random_next(random) % (uint64_t)limit);
}

static int64_t turn(const GridPolygon *p, int a, int b, int c)
{
    int64_t value = (p->x[b] - p->x[a]) * (p->y[c] - p->y[a]) - (p->y[b] - p->y[a]) * (p->x[c] - p->x[a]);
    return (value > 0) - (value < 0);
}

static int after(const GridPolygon *p, int i)
{
    return (i + 1) % p->count;
}

bool grid_edges_cross(const GridPolygon *p, int i, int k)
{
    int j = after(p, i), l = after(p, k);
    return turn(p, i, j, k) * turn(p, i, j, l) < 0 && turn(p, k, l, i) * turn(p, k, l, j) < 0;
}

bool grid_polygon_crosses(const GridPolygon *p)
{
    for (int i = 0; i < p->count; i++)
        for (int k = 0; k < i; k++)
            if (grid_edges_cross(p, i, k))
                return true;
    return false;
}

static bool is_between(int64_t a, int64_t x, int64_t b)
{
    return (a <= x && x <= b) || (b <= x && x <= a);
}

static bool is_on_edge(const GridPolygon *p, int i, int point)
{
    int j = after(p, i);
    return turn(p, i, j, point) == 0 && is_between(p->x[i], p->x[point], p->x[j]) &&
           is_between(p->y[i], p->y[point], p->y[j]);
}

bool grid_polygon_touches(const GridPolygon *p)
{
    for (int i = 0; i < p->count; i++)
        for (int k = 0; k < p->count; k++)
            if (k != i && k != after(p, i) && is_on_edge(p, i, k))
                return true;
    return false;
}

int64_t grid_polygon_area2(const GridPolygon *p)
{
    int64_t area = 0;
    for (int i = 0; i < p->count; i++)
        area += p->x[i] * p->y[after(p, i)] - p->x[after(p, i)] * p->y[i];
    return area;
}

/* --- Making them --- */

/* Reverses the order of the vertices i + 1 to k, which exchanges the edges at i and k for two others. */
static void reverse(GridPolygon *p, int i, int k)
{
    for (int a = i + 1, b = k; a < b; a++, b--) {
        int64_t x = p->x[a], y = p->y[a];
        p->x[a] = p->x[b], p->y[a] = p->y[b];
        p->x[b] = x, p->y[b] = y;
    }
}

/* Exchanges crossing edges until none is left: each exchange makes the boundary shorter. */
static void untangle(GridPolygon *p)
{
    for (bool again = true; again;) {
        again = false;
        for (int k = 0; k < p->count; k++)
            for (int i = 0; i < k; i++)
                if (grid_edges_cross(p, i, k)) {
                    reverse(p, i, k);
                    again = true;
                }
    }
}

static int compare_angles(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void place_around(GridPolygon *p, bool convex, uint64_t *random)
{
    double angles[GRID_POLYGON_MAX], middle = GRID_POLYGON_SIZE / 2;
    for (int i = 0; i < p->count; i++)
        angles[i] = 6.283185307179586 * (double)random_below(random, 1 << 20) / (1 << 20);
    qsort(angles, (size_t)p->count, sizeof *angles, compare_angles);
    for (int i = 0; i < p->count; i++) {
        double radius = convex ? 1 : 0.05 + 0.95 * (double)random_below(random, 1 << 20) / (1 << 20);
        p->x[i] = (int64_t)(middle + middle * radius * cos(angles[i]));
        p->y[i] = (int64_t)(middle + middle * radius * sin(angles[i]));
    }
}

static void place_anywhere(GridPolygon *p, int64_t cells, uint64_t *random)
{
    for (int i = 0; i < p->count; i++) {
        p->x[i] = random_below(random, cells + 1) * (GRID_POLYGON_SIZE / cells);
        p->y[i] = random_below(random, cells + 1) * (GRID_POLYGON_SIZE / cells);
    }
}

static void place_near_a_line(GridPolygon *p, uint64_t *random)
{
    int64_t slope = random_below(random, 16), width = 1 + random_below(random, 8);
    for (int i = 0; i < p->count; i++) {
        p->x[i] = random_below(random, GRID_POLYGON_SIZE);
        p->y[i] = slope * p->x[i] / 16 + random_below(random, width + 1);
    }
}

GridPolygon grid_polygon(GridPolygonKind kind, uint64_t *random)
{
    GridPolygon p = {.count = 3 + (int)random_below(random, random_below(random, 2) ? 6 : GRID_POLYGON_MAX - 2)};
    if (kind == GRID_CONVEX || kind == GRID_STAR)
        place_around(&p, kind == GRID_CONVEX, random);
    else if (kind == GRID_THIN)
        place_near_a_line(&p, random);
    else
        place_anywhere(&p, kind == GRID_COARSE ? 2 + random_below(random, 7) : GRID_POLYGON_SIZE, random);
    if (kind == GRID_KNOT || kind == GRID_COARSE || kind == GRID_THIN)
        untangle(&p);
    return p;
}
