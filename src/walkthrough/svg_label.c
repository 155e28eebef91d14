/* Where the labels of a view stand: each takes the place around its mark that costs least, in the order of the
 * marks. What costs: covering a mark or another label, crossing a line, leaving the panel, standing far off. */
#include "walkthrough/svg_view.h"

#include <math.h>
#include <string.h>

#define LETTER_WIDTH 8.5
#define SPACE 4.0 /* beside a label */
#define LETTER_HEIGHT 14.0

static double overlap(const SvgBox *a, const SvgBox *b)
{
    double width = fmin(a->right, b->right) - fmax(a->left, b->left);
    double height = fmin(a->bottom, b->bottom) - fmax(a->top, b->top);
    return width > 0 && height > 0 ? width * height : 0;
}

/* Narrows [*t0, *t1] to where start + t step lies in [low, high]; false where nothing is left. */
static bool clip(double start, double step, double low, double high, double *t0, double *t1)
{
    if (step == 0)
        return start >= low && start <= high;
    double a = (low - start) / step, b = (high - start) / step;
    *t0 = fmax(*t0, fmin(a, b));
    *t1 = fmin(*t1, fmax(a, b));
    return *t0 <= *t1;
}

/* The length of the line inside the box (Liang and Barsky 1984). */
static double length_inside(const SvgBox *line, const SvgBox *box)
{
    double dx = line->right - line->left, dy = line->bottom - line->top, t0 = 0, t1 = 1;
    if (!clip(line->left, dx, box->left, box->right, &t0, &t1) || !clip(line->top, dy, box->top, box->bottom, &t0, &t1))
        return 0;
    return (t1 - t0) * hypot(dx, dy);
}

/* Places lie on rings around the mark, so many on each. */
enum { RINGS = 4, PLACES_ON_RING = 16 };

static SvgBox label_box(const SvgLabel *label, int ring, int place)
{
    double angle = 2 * 3.14159265358979 * place / PLACES_ON_RING, distance = 10 + 12 * ring;
    double width = LETTER_WIDTH * (double)strlen(label->text) + SPACE, height = LETTER_HEIGHT;
    /* The box touches the circle of that distance: its centre is half its size farther out. */
    double x = label->at.x + cos(angle) * (distance + width / 2);
    double y = label->at.y - sin(angle) * (distance + height / 2);
    return (SvgBox){x - width / 2, y - height / 2, x + width / 2, y + height / 2};
}

static double cost_of(const SvgView *view, const SvgBox *box, int ring)
{
    double area = (box->right - box->left) * (box->bottom - box->top);
    double cost = 8.0 * ring + 20 * (area - overlap(box, &view->box));
    for (int i = 0; i < view->taken_count; i++)
        cost += 10 * overlap(box, &view->taken[i]);
    for (int i = 0; i < view->line_count; i++)
        cost += 2 * length_inside(&view->lines[i], box);
    return cost;
}

static void place_label(SvgView *view, const SvgLabel *label)
{
    SvgBox best = label_box(label, 0, 0);
    double least = HUGE_VAL;
    for (int ring = 0; ring < RINGS; ring++)
        for (int place = 0; place < PLACES_ON_RING; place++) {
            SvgBox box = label_box(label, ring, place);
            double cost = cost_of(view, &box, ring);
            if (cost < least) {
                least = cost;
                best = box;
            }
        }
    view->taken[view->taken_count++] = best;
    fprintf(view->out, "<text class='label' x='%.1f' y='%.1f' text-anchor='middle' fill='%s'>%s</text>\n",
            (best.left + best.right) / 2, best.bottom - 3, label->colour, label->text);
}

void svg_view_end(SvgView *view)
{
    for (int i = 0; i < view->label_count; i++)
        place_label(view, &view->labels[i]);
    fprintf(view->out, "</g>\n<rect class='frame' x='%.1f' y='%.1f' width='%.1f' height='%.1f'/>\n", view->box.left,
            view->box.top, view->box.right - view->box.left, view->box.bottom - view->box.top);
}
