/* One orthographic view of a scene as a panel of an SVG drawing. */
#include "walkthrough/svg_view.h"

#include "scene/geometry.h"

#include <string.h>

#define MARGIN 0.12 /* of the window, around what must be seen */

static const struct {
    const char *title, *x, *y;
} directions[] = {
    {"seen from above", "x", "z"}, /* z runs downwards, as on a map whose reader stands in front */
    {"seen from the side", "z", "y"},
    {"seen from the front", "x", "y"},
    {"the picture on its screen; dashed: beyond it", "", ""},
};

SvgProjection svg_projection(SvgDirection direction, const Scene *scene)
{
    View view = view_of(scene);
    if (direction == SVG_FROM_BEHIND) {
        Vec3 gaze = vec3_sub(vec3_sub(vec3_unit(view.forward), view.right), vec3_scale(0.6, view.up));
        Vec3 across = vec3_unit(vec3_cross(gaze, view.up));
        return (SvgProjection){direction, false, across, vec3_unit(vec3_cross(across, gaze))};
    }
    bool along_z = fabs(view.forward.z) >= fabs(view.forward.x);
    /* Along its own axis a view must not be mirrored against the picture; across it the camera looks to the right. */
    if (direction == SVG_FROM_SIDE)
        return (SvgProjection){.direction = direction, .turned = along_z ? view.forward.z < 0 : view.right.z < 0};
    return (SvgProjection){.direction = direction, .turned = along_z ? view.right.x < 0 : view.forward.x < 0};
}

SvgPoint svg_flatten(SvgProjection projection, Vec3 p)
{
    double sign = projection.turned ? -1 : 1;
    if (projection.direction == SVG_FROM_BEHIND)
        return (SvgPoint){vec3_dot(projection.across, p), vec3_dot(projection.upwards, p)};
    if (projection.direction == SVG_FROM_ABOVE)
        return (SvgPoint){sign * p.x, -sign * p.z};
    return (SvgPoint){sign * (projection.direction == SVG_FROM_SIDE ? p.z : p.x), p.y};
}

SvgPoint svg_place(const SvgView *view, Vec3 p)
{
    SvgPoint flat = svg_flatten(view->projection, p);
    double x = view->box.left + (flat.x - view->left) * view->scale;
    double y = view->box.bottom - (flat.y - view->bottom) * view->scale;
    /* Far outside the panel a smaller number does as well, and drawing programs can read it. */
    return (SvgPoint){fmin(fmax(x, -1e5), 1e5), fmin(fmax(y, -1e5), 1e5)};
}

/* --- Axes --- */

/* The smallest of 1, 2, 5, 10, 20, ... (or 0.5, 0.2, ...) that is not below the given number. */
static double round_step(double at_least)
{
    double power = pow(10, floor(log10(at_least)));
    double m = at_least / power;
    return (m <= 1 ? 1 : m <= 2 ? 2 : m <= 5 ? 5 : 10) * power;
}

/* Far from the origin the numbers need more digits, so that no two are the same. */
static int digits_of(double value, double step)
{
    double digits = value == 0 ? 0 : ceil(log10(fabs(value) / step)) + 1;
    return digits > 17 ? 17 : digits > 6 ? (int)digits : 6;
}

/* A line of the grid with its number: `along` is its place along the axis, on the paper. */
static void draw_tick(const SvgView *view, bool vertical, double along, double value, int digits)
{
    const SvgBox *box = &view->box;
    if (vertical)
        fprintf(view->out,
                "<path class='grid' d='M%.1f %.1fV%.1f'/><text class='tick' x='%.1f' y='%.1f' "
                "text-anchor='middle'>%.*g</text>\n",
                along, box->top, box->bottom, along, box->bottom + 14, digits, value);
    else
        fprintf(view->out,
                "<path class='grid' d='M%.1f %.1fH%.1f'/><text class='tick' x='%.1f' y='%.1f' "
                "text-anchor='end'>%.*g</text>\n",
                box->left, along, box->right, box->left - 5, along + 4, digits, value);
}

/* Whether the numbers of an axis become smaller to the right (that whose lines are vertical) or upwards. */
static bool runs_back(const SvgView *view, bool vertical)
{
    if (vertical)
        return view->projection.turned;
    return view->projection.direction == SVG_FROM_ABOVE && !view->projection.turned;
}

static void draw_axis(const SvgView *view, bool vertical)
{
    const SvgBox *box = &view->box;
    double length = (vertical ? box->right - box->left : box->bottom - box->top) / view->scale;
    double start = vertical ? view->left : view->bottom;
    double step = round_step(length / 8);
    bool flipped = runs_back(view, vertical);
    double first = ceil(start / step) * step;
    for (int k = 0; first + k * step <= start + length; k++) {
        double pixels = (first + k * step - start) * view->scale;
        double value = round(first / step + k) * step * (flipped ? -1 : 1);
        draw_tick(view, vertical, vertical ? box->left + pixels : box->bottom - pixels, value == 0 ? 0 : value,
                  digits_of(value, step));
    }
}

static void draw_axes(const SvgView *view)
{
    const SvgBox *box = &view->box;
    draw_axis(view, true);
    draw_axis(view, false);
    const char *x = directions[view->projection.direction].x, *y = directions[view->projection.direction].y;
    bool left = runs_back(view, true), down = runs_back(view, false);
    fprintf(view->out, "<text class='axis' x='%.1f' y='%.1f' text-anchor='%s'>%s%s%s</text>\n",
            left ? box->left : box->right, box->bottom + 30, left ? "start" : "end", left ? "\xE2\x86\x90 " : "", x,
            left ? "" : " \xE2\x86\x92");
    fprintf(view->out, "<text class='axis' x='%.1f' y='%.1f' text-anchor='end'>%s %s</text>\n", box->left - 5,
            down ? box->bottom + 30 : box->top - 10, y, down ? "\xE2\x86\x93" : "\xE2\x86\x91");
}

static void draw_title(const SvgView *view)
{
    fprintf(view->out, "<text class='title' x='%.1f' y='%.1f'>%s</text>\n", view->box.left + 4, view->box.top - 10,
            directions[view->projection.direction].title);
}

void svg_view_begin(SvgView *view, FILE *out, int number, SvgProjection projection, SvgBox box, SvgPoint low,
                    SvgPoint high)
{
    double width = high.x - low.x, height = high.y - low.y, larger = fmax(width, height);
    double least = larger > 0 ? larger : 1;
    width = fmax(width, least / 1e3) + 2 * MARGIN * least;
    height = fmax(height, least / 1e3) + 2 * MARGIN * least;
    double scale = fmin((box.right - box.left) / width, (box.bottom - box.top) / height);
    *view = (SvgView){.out = out, .projection = projection, .box = box, .scale = scale};
    view->left = (low.x + high.x) / 2 - (box.right - box.left) / scale / 2;
    view->bottom = (low.y + high.y) / 2 - (box.bottom - box.top) / scale / 2;
    fprintf(out, "<clipPath id='panel%d'><rect x='%.1f' y='%.1f' width='%.1f' height='%.1f'/></clipPath>\n", number,
            box.left, box.top, box.right - box.left, box.bottom - box.top);
    fprintf(out, "<rect class='paper' x='%.1f' y='%.1f' width='%.1f' height='%.1f'/>\n", box.left, box.top,
            box.right - box.left, box.bottom - box.top);
    if (projection.direction != SVG_FROM_BEHIND)
        draw_axes(view);
    draw_title(view);
    fprintf(out, "<g clip-path='url(#panel%d)'>\n", number);
}

/* --- What is in it --- */

void svg_face(const SvgView *view, const Scene *scene, int face, const char *style)
{
    SvgPoint corners[4];
    SvgBox around = {1e9, 1e9, -1e9, -1e9};
    int count = scene->faces[face].vertex_count;
    for (int k = 0; k < count; k++) {
        corners[k] = svg_place(view, vec3_add(face_vertex(&scene->faces[face], k), scene->centre));
        around.left = fmin(around.left, corners[k].x);
        around.right = fmax(around.right, corners[k].x);
        around.top = fmin(around.top, corners[k].y);
        around.bottom = fmax(around.bottom, corners[k].y);
    }
    if (around.right < view->box.left || around.left > view->box.right || around.bottom < view->box.top ||
        around.top > view->box.bottom)
        return;
    fprintf(view->out, "<path %s d='M", style);
    for (int k = 0; k < count; k++)
        fprintf(view->out, "%.1f %.1f%s", corners[k].x, corners[k].y, k < count - 1 ? "L" : "Z'/>\n");
}

void svg_rectangle(const SvgView *view, SvgPoint low, SvgPoint high, const char *style)
{
    double left = view->box.left + (low.x - view->left) * view->scale;
    double top = view->box.bottom - (high.y - view->bottom) * view->scale;
    fprintf(view->out, "<rect %s x='%.1f' y='%.1f' width='%.1f' height='%.1f'/>\n", style, fmax(left, -1e5),
            fmax(top, -1e5), fmin((high.x - low.x) * view->scale, 2e5), fmin((high.y - low.y) * view->scale, 2e5));
}

void svg_line(SvgView *view, Vec3 from, Vec3 to, const char *style)
{
    SvgPoint a = svg_place(view, from), b = svg_place(view, to);
    fprintf(view->out, "<path %s d='M%.1f %.1fL%.1f %.1f'/>\n", style, a.x, a.y, b.x, b.y);
    if (view->line_count < SVG_LINES_MAX)
        view->lines[view->line_count++] = (SvgBox){a.x, a.y, b.x, b.y};
}

void svg_cross(const SvgView *view, Vec3 p, const char *colour)
{
    SvgPoint at = svg_place(view, p);
    fprintf(view->out, "<path stroke='%s' stroke-width='2' d='M%.1f %.1fl10 10m0 -10l-10 10'/>\n", colour, at.x - 5,
            at.y - 5);
}

/* Adds a name to a label that another mark has already. */
static void join_label(SvgLabel *label, const char *text)
{
    const char *same = strstr(label->text, text);
    if (same && (same[strlen(text)] == '\0' || same[strlen(text)] == ','))
        return;
    size_t used = strlen(label->text), room = sizeof label->text - 4;
    if (used + 2 + strlen(text) < room)
        snprintf(label->text + used, sizeof label->text - used, ", %s", text);
    else if (!strchr(label->text, '.'))
        snprintf(label->text + used, sizeof label->text - used, "...");
}

bool svg_is_seen(const SvgView *view, Vec3 p)
{
    SvgPoint at = svg_place(view, p);
    return at.x >= view->box.left && at.x <= view->box.right && at.y >= view->box.top && at.y <= view->box.bottom;
}

/* Where the way from a point that is seen to one that is not leaves the panel, but for some pixels. */
static SvgPoint way_out(const SvgBox *box, SvgPoint from, SvgPoint to)
{
    const double inset = 8;
    double dx = to.x - from.x, dy = to.y - from.y, t = 1;
    if (dx != 0)
        t = fmin(t, ((dx > 0 ? box->right - inset : box->left + inset) - from.x) / dx);
    if (dy != 0)
        t = fmin(t, ((dy > 0 ? box->bottom - inset : box->top + inset) - from.y) / dy);
    return (SvgPoint){from.x + t * dx, from.y + t * dy};
}

static void add_label(SvgView *view, SvgPoint at, const char *text, const char *colour)
{
    for (int i = 0; i < view->label_count; i++)
        if (hypot(view->labels[i].at.x - at.x, view->labels[i].at.y - at.y) <= 6) {
            join_label(&view->labels[i], text);
            return;
        }
    if (view->label_count == SVG_LABELS_MAX)
        return;
    SvgLabel *label = &view->labels[view->label_count++];
    *label = (SvgLabel){.at = at, .colour = colour};
    snprintf(label->text, sizeof label->text - 4, "%s", text);
    view->taken[view->taken_count++] = (SvgBox){at.x - 6, at.y - 6, at.x + 6, at.y + 6};
}

void svg_mark(SvgView *view, Vec3 p, Vec3 seen_from, const char *text, const char *colour)
{
    if (svg_is_seen(view, p)) {
        SvgPoint at = svg_place(view, p);
        fprintf(view->out, "<circle cx='%.1f' cy='%.1f' r='4' fill='%s' stroke='#fff'/>\n", at.x, at.y, colour);
    }
    svg_end_label(view, p, seen_from, text, colour);
}

void svg_end_label(SvgView *view, Vec3 p, Vec3 seen_from, const char *text, const char *colour)
{
    SvgPoint at = svg_place(view, p);
    if (!svg_is_seen(view, p) && !svg_is_seen(view, seen_from))
        return; /* in a zoom: neither end is in it */
    add_label(view, svg_is_seen(view, p) ? at : way_out(&view->box, svg_place(view, seen_from), at), text, colour);
}

void svg_arrow_out(const SvgView *view, Vec3 seen_from, Vec3 p, const char *style)
{
    const double length = 24;
    SvgPoint from = svg_place(view, seen_from), at = way_out(&view->box, from, svg_place(view, p));
    double distance = hypot(at.x - from.x, at.y - from.y);
    double part = distance > length ? length / distance : 1;
    if (svg_is_seen(view, seen_from) && distance > 0)
        fprintf(view->out, "<path %s d='M%.1f %.1fL%.1f %.1f'/>\n", style, at.x - part * (at.x - from.x),
                at.y - part * (at.y - from.y), at.x, at.y);
}
