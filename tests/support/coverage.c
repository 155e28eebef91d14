/* Exact coverage: the faces' polygons in a pixel, less what nearer faces hide. */
#include "coverage.h"

#include "polygon.h"
#include "scene/geometry.h"

#include <assert.h>

/* A face as the pixel's eye sees it. */
typedef struct Shape {
    bool visible;
    int edges;
    Line inside[4];
    Line nearness; /* 1/t */
} Shape;

/* --- Vectors of rationals --- */

typedef struct Exact3 {
    mpq_t c[3];
} Exact3;

static void exact_init(Exact3 *a)
{
    for (int i = 0; i < 3; i++)
        mpq_init(a->c[i]);
}

static void exact_clear(Exact3 *a)
{
    for (int i = 0; i < 3; i++)
        mpq_clear(a->c[i]);
}

static void exact_set(Exact3 *a, Vec3 v)
{
    const double c[3] = {v.x, v.y, v.z};
    for (int i = 0; i < 3; i++)
        mpq_set_d(a->c[i], c[i]);
}

static void exact_sub(Exact3 *a, const Exact3 *b, const Exact3 *c)
{
    for (int i = 0; i < 3; i++)
        mpq_sub(a->c[i], b->c[i], c->c[i]);
}

static void exact_cross(Exact3 *a, const Exact3 *b, const Exact3 *c)
{
    mpq_t product;
    mpq_init(product);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        mpq_mul(a->c[i], b->c[j], c->c[k]);
        mpq_mul(product, b->c[k], c->c[j]);
        mpq_sub(a->c[i], a->c[i], product);
    }
    mpq_clear(product);
}

static void exact_dot(mpq_t dot, const Exact3 *a, const Exact3 *b)
{
    mpq_t product;
    mpq_init(product);
    mpq_set_ui(dot, 0, 1);
    for (int i = 0; i < 3; i++) {
        mpq_mul(product, a->c[i], b->c[i]);
        mpq_add(dot, dot, product);
    }
    mpq_clear(product);
}

/* --- The pixel --- */

/* The pixel's rays: R(u, v) = corner + u across + v down. */
typedef struct PixelRays {
    Exact3 eye, corner, across, down;
} PixelRays;

/* ((number + share)/count - 1/2) size as a vector along `unit`: its constant part, and the part of the share. */
static void screen_axis(int number, int count, double size, Vec3 unit, Exact3 *constant, Exact3 *per_share)
{
    mpq_t step, start, scale;
    mpq_inits(step, start, scale, NULL);
    mpq_set_d(step, size);
    mpq_set_si(start, 2 * number - count, (unsigned long)(2 * count));
    mpq_canonicalize(start);
    mpq_mul(start, start, step);
    Exact3 u;
    exact_init(&u);
    exact_set(&u, unit);
    mpq_set_si(scale, 1, (unsigned long)count);
    mpq_mul(step, step, scale);
    for (int i = 0; i < 3; i++) {
        mpq_mul(constant->c[i], u.c[i], start);
        mpq_mul(per_share->c[i], u.c[i], step);
    }
    exact_clear(&u);
    mpq_clears(step, start, scale, NULL);
}

static void rays_init(PixelRays *rays, const Scene *scene, int column, int row)
{
    View view = view_of(scene);
    Exact3 x, y;
    Exact3 *all[] = {&rays->eye, &rays->corner, &rays->across, &rays->down, &x, &y};
    for (int i = 0; i < 6; i++)
        exact_init(all[i]);
    exact_set(&rays->eye, view.eye);
    exact_set(&rays->corner, view.forward);
    screen_axis(column, view.columns, view.width, view.right, &x, &rays->across);
    screen_axis(row, view.rows, -view.height, view.up, &y, &rays->down);
    for (int i = 0; i < 3; i++) {
        mpq_add(rays->corner.c[i], rays->corner.c[i], x.c[i]);
        mpq_add(rays->corner.c[i], rays->corner.c[i], y.c[i]);
    }
    exact_clear(&x);
    exact_clear(&y);
}

static void rays_clear(PixelRays *rays)
{
    exact_clear(&rays->eye);
    exact_clear(&rays->corner);
    exact_clear(&rays->across);
    exact_clear(&rays->down);
}

/* m.R over the pixel. */
static void line_along(Line *line, const Exact3 *m, const PixelRays *rays)
{
    exact_dot(line->at[0], m, &rays->corner);
    exact_dot(line->at[1], m, &rays->across);
    exact_dot(line->at[2], m, &rays->down);
}

/* --- Faces --- */

/* Fills the shape of a face: its edges as lines with the inside above, and 1/t. */
static void shape_init(Shape *shape, const Face *face, const PixelRays *rays)
{
    Exact3 v[4], a, b, m;
    mpq_t height, scale;
    mpq_inits(height, scale, NULL);
    exact_init(&a);
    exact_init(&b);
    exact_init(&m);
    for (int k = 0; k < 4; k++) {
        exact_init(&v[k]);
        exact_set(&v[k], face_vertex(face, k));
        line_init(&shape->inside[k]);
    }
    line_init(&shape->nearness);
    exact_sub(&a, &v[2], &v[0]);
    exact_sub(&b, &v[3], &v[1]);
    exact_cross(&m, &a, &b); /* N, of any length */
    for (int k = 0; k < 4; k++)
        exact_sub(&v[k], &v[k], &rays->eye);
    exact_dot(height, &m, &v[0]);
    int side = mpq_sgn(height); /* < 0: the eye is where N points */
    shape->visible = side < 0 || (side > 0 && !face->one_sided);
    shape->edges = face->vertex_count;
    if (shape->visible) {
        mpq_inv(height, height);
        line_along(&shape->nearness, &m, rays);
        line_scale(&shape->nearness, height);
        mpq_set_si(scale, side, 1);
        for (int k = 0; k < shape->edges; k++) {
            exact_cross(&m, &v[k], &v[(k + 1) % shape->edges]);
            line_along(&shape->inside[k], &m, rays);
            line_scale(&shape->inside[k], scale);
        }
    }
    exact_clear(&a);
    exact_clear(&b);
    exact_clear(&m);
    for (int k = 0; k < 4; k++)
        exact_clear(&v[k]);
    mpq_clears(height, scale, NULL);
}

static void shape_clear(Shape *shape)
{
    for (int k = 0; k < 4; k++)
        line_clear(&shape->inside[k]);
    line_clear(&shape->nearness);
}

/* The shape's edges, for polygon.h. */
static int shape_edges(const Shape *shape, const Line *edges[4])
{
    for (int k = 0; k < shape->edges; k++)
        edges[k] = &shape->inside[k];
    return shape->edges;
}

/* The part of the pixel within the face's edges. */
static Pieces shape_pieces(const Shape *shape)
{
    const Line *edges[4];
    Pieces pieces = pieces_pixel();
    pieces_keep(&pieces, edges, shape_edges(shape, edges));
    return pieces;
}

/* Where `b` is nearer than `a`. */
static void line_nearer(Line *nearer, const Shape *a, const Shape *b)
{
    for (int i = 0; i < 3; i++)
        mpq_sub(nearer->at[i], b->nearness.at[i], a->nearness.at[i]);
}

/* Takes from the pieces of face `a` what face `b` hides; in one plane, the first in the file hides the other. */
static void pieces_hide(Pieces *pieces, const Shape *shapes, int a, int b)
{
    const Line *lines[5];
    Line nearer;
    int count = shape_edges(&shapes[b], lines);
    line_init(&nearer);
    line_nearer(&nearer, &shapes[a], &shapes[b]);
    bool coplanar = line_is_zero(&nearer);
    if (!coplanar)
        lines[count++] = &nearer;
    if (!coplanar || b < a)
        pieces_subtract(pieces, lines, count);
    line_clear(&nearer);
}

/* The lines at which the colour may change. */
static int count_lines(const Shape *shapes, const bool *met, int count)
{
    int lines = 0;
    Line crossing;
    line_init(&crossing);
    for (int a = 0; a < count; a++) {
        for (int k = 0; met[a] && k < shapes[a].edges; k++)
            lines += line_crosses(&shapes[a].inside[k]);
        for (int b = 0; met[a] && b < a; b++) {
            line_nearer(&crossing, &shapes[a], &shapes[b]);
            lines += met[b] && line_crosses(&crossing);
        }
    }
    line_clear(&crossing);
    return lines;
}

/* Fills the shapes, and notes which of them the pixel meets. */
static void see(const Scene *scene, const PixelRays *rays, Shape *shapes, bool *met)
{
    for (int i = 0; i < scene->face_count; i++) {
        shape_init(&shapes[i], &scene->faces[i], rays);
        Pieces all = {0};
        if (shapes[i].visible)
            all = shape_pieces(&shapes[i]);
        met[i] = all.count > 0;
        pieces_free(&all);
    }
}

Coverage coverage_of_pixel(const Scene *scene, int column, int row)
{
    assert(scene->face_count <= COVERAGE_FACES);
    Coverage coverage = {.background = 0};
    PixelRays rays;
    Shape shapes[COVERAGE_FACES];
    bool met[COVERAGE_FACES];
    rays_init(&rays, scene, column, row);
    see(scene, &rays, shapes, met);
    Pieces background = pieces_pixel();
    for (int i = 0; i < scene->face_count; i++) {
        if (!met[i])
            continue;
        const Line *edges[4];
        pieces_subtract(&background, edges, shape_edges(&shapes[i], edges));
        Pieces pieces = shape_pieces(&shapes[i]);
        for (int other = 0; other < scene->face_count; other++)
            if (other != i && met[other])
                pieces_hide(&pieces, shapes, i, other);
        coverage.face[i] = pieces_area(&pieces);
        pieces_free(&pieces);
    }
    coverage.background = pieces_area(&background);
    coverage.lines = count_lines(shapes, met, scene->face_count);
    pieces_free(&background);
    for (int i = 0; i < scene->face_count; i++)
        shape_clear(&shapes[i]);
    rays_clear(&rays);
    return coverage;
}

double coverage_grid_bound(int lines, int n)
{
    return lines * (2.0 * n - 1) / (2.0 * n * n);
}
