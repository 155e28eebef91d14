/* Where the edge of a panel cuts a face off. The face is clipped to the panel's box (Sutherland and Hodgman 1974); the
 * sides of what is left that lie on the box's edges get a zigzag, as a torn sheet has it. */
#include "scene/geometry.h"
#include "walkthrough/svg_view.h"

#include <math.h>

enum { CORNERS_MAX = 8 }; /* of four, and one more for each edge of the box */

#define TOOTH 5.0  /* pixels along the edge */
#define HEIGHT 4.0 /* of a tooth, into the panel */

typedef struct Polygon {
    SvgPoint corners[CORNERS_MAX];
    int count;
} Polygon;

/* How far a point is inside the box's edge 0, 1, 2 or 3: left, right, top, bottom. */
static double inside(const SvgBox *box, int edge, SvgPoint p)
{
    const double distances[4] = {p.x - box->left, box->right - p.x, p.y - box->top, box->bottom - p.y};
    return distances[edge];
}

static Polygon clipped(const Polygon *polygon, const SvgBox *box, int edge)
{
    Polygon result = {.count = 0};
    for (int k = 0; k < polygon->count; k++) {
        SvgPoint a = polygon->corners[k], b = polygon->corners[(k + 1) % polygon->count];
        double da = inside(box, edge, a), db = inside(box, edge, b);
        if (da >= 0 && result.count < CORNERS_MAX)
            result.corners[result.count++] = a;
        if ((da < 0) != (db < 0) && result.count < CORNERS_MAX) {
            double t = da / (da - db);
            result.corners[result.count++] = (SvgPoint){a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
        }
    }
    return result;
}

/* A face that is seen edge-on is cut in a point: its mark is three teeth wide. */
static void widen(SvgPoint *a, SvgPoint *b, bool upright)
{
    const double half = 1.5 * TOOTH;
    if (hypot(b->x - a->x, b->y - a->y) >= 2 * half)
        return;
    SvgPoint middle = {(a->x + b->x) / 2, (a->y + b->y) / 2};
    *a = (SvgPoint){middle.x - (upright ? 0 : half), middle.y - (upright ? half : 0)};
    *b = (SvgPoint){middle.x + (upright ? 0 : half), middle.y + (upright ? half : 0)};
}

static void draw_zigzag(const SvgView *view, SvgPoint a, SvgPoint b, int edge, const char *style)
{
    static const SvgPoint inwards[4] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    widen(&a, &b, edge < 2);
    int teeth = (int)(hypot(b.x - a.x, b.y - a.y) / TOOTH);
    fprintf(view->out, "<path %s d='M%.1f %.1f", style, a.x, a.y);
    for (int k = 1; k <= teeth; k++) {
        double t = k / (double)teeth, deep = k % 2 ? HEIGHT : 0;
        fprintf(view->out, "L%.1f %.1f", a.x + t * (b.x - a.x) + deep * inwards[edge].x,
                a.y + t * (b.y - a.y) + deep * inwards[edge].y);
    }
    fprintf(view->out, "'/>\n");
}

bool svg_cut(const SvgView *view, const Scene *scene, int face, const char *style)
{
    const double near = 1e-6;
    Polygon polygon = {.count = scene->faces[face].vertex_count};
    for (int k = 0; k < polygon.count; k++)
        polygon.corners[k] = svg_place(view, vec3_add(face_vertex(&scene->faces[face], k), scene->centre));
    for (int edge = 0; edge < 4; edge++)
        polygon = clipped(&polygon, &view->box, edge);
    bool cut = false;
    for (int k = 0; k < polygon.count; k++) {
        SvgPoint a = polygon.corners[k], b = polygon.corners[(k + 1) % polygon.count];
        for (int edge = 0; edge < 4; edge++)
            if (fabs(inside(&view->box, edge, a)) < near && fabs(inside(&view->box, edge, b)) < near) {
                draw_zigzag(view, a, b, edge, style);
                cut = true;
            }
    }
    return cut;
}
