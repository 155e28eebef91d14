/* The picture on its screen. */
#include "walkthrough/svg_screen.h"

#include "walkthrough/svg_strokes.h"

#define PATH_SIZE 2.5 /* the path is shown as far as the panel's window grows by this factor at most */
#define RAY_SIZE 2.0  /* a ray is drawn for so many times that size at most */

enum { TOP_LEFT, TOP_RIGHT, BOTTOM_RIGHT, BOTTOM_LEFT, CORNERS };

/* All as in the scene file. */
typedef struct Screenful {
    Vec3 eye, corners[CORNERS];
} Screenful;

static Screenful screenful_of(const Scene *scene)
{
    View view = view_of(scene);
    Screenful screen = {.eye = walkthrough_world(scene, view.eye)};
    Vec3 middle = vec3_add(screen.eye, view.forward);
    Vec3 right = vec3_scale(view.width / 2, view.right), up = vec3_scale(view.height / 2, view.up);
    screen.corners[TOP_LEFT] = vec3_add(vec3_sub(middle, right), up);
    screen.corners[TOP_RIGHT] = vec3_add(vec3_add(middle, right), up);
    screen.corners[BOTTOM_RIGHT] = vec3_sub(vec3_add(middle, right), up);
    screen.corners[BOTTOM_LEFT] = vec3_sub(vec3_sub(middle, right), up);
    return screen;
}

void svg_screen_outline(SvgView *view, const Scene *scene)
{
    Screenful screen = screenful_of(scene);
    fprintf(view->out, "<path class='screen' d='M");
    for (int k = 0; k < CORNERS; k++) {
        SvgPoint at = svg_place(view, screen.corners[k]);
        fprintf(view->out, "%.1f %.1f%s", at.x, at.y, k < CORNERS - 1 ? "L" : "Z'/>\n");
    }
}

/* --- What the panel shows --- */

typedef struct Window {
    SvgPoint low, high;
} Window;

static Window window_with(Window window, SvgPoint p)
{
    return (Window){{fmin(window.low.x, p.x), fmin(window.low.y, p.y)},
                    {fmax(window.high.x, p.x), fmax(window.high.y, p.y)}};
}

static double size_of(Window window)
{
    return fmax(window.high.x - window.low.x, window.high.y - window.low.y);
}

typedef struct Painter {
    SvgView view;
    SvgProjection projection;
    Window window;
    double size_most;      /* of the window */
    int hits, hits_of_all; /* so many are in the window, and so many there are */
    Vec3 q;                /* on the screen */
    Vec3 last;             /* of the path in the window: Q, or a hit */
} Painter;

static void see_hit(void *user, const WalkthroughLine *line)
{
    Painter *painter = user;
    if (line->kind != LINE_NORMAL)
        return;
    bool follows = line->hit == painter->hits + 1;
    painter->hits_of_all++;
    Window larger = window_with(painter->window, svg_flatten(painter->projection, line->from));
    if (!follows || size_of(larger) > painter->size_most)
        return;
    painter->window = larger;
    painter->last = line->from;
    painter->hits++;
}

static Vec3 find_q(const Walkthrough *walk)
{
    WalkthroughPlace place = {0};
    for (long i = 0; i < walk->count && !place.told; i++)
        walkthrough_follow(&place, walk, &walk->events[i]);
    return walkthrough_world(walk->scene, place.sample->as.sample.q);
}

/* --- Drawing it --- */

/* The way to a position that may be far outside the panel: all of it, or its first part. */
static Vec3 first_part(const Painter *painter, Vec3 from, Vec3 to)
{
    Vec3 way = vec3_sub(to, from);
    double length = vec3_length(way), longest = RAY_SIZE * painter->size_most;
    return length > longest ? vec3_add(from, vec3_scale(longest / length, way)) : to;
}

/* What lies beyond the screen is dashed, as hidden edges are in technical drawings. */
static void draw_ray(void *user, const WalkthroughLine *line)
{
    Painter *painter = user;
    bool primary = line->kind == LINE_PRIMARY;
    int first_hit = line->leaves ? painter->hits_of_all : line->hit - 1;
    if ((!primary && line->kind != LINE_REFLECTED) || painter->hits < first_hit)
        return;
    Vec3 from = primary ? painter->q : line->from;
    svg_line(&painter->view, from, first_part(painter, from, line->to),
             primary ? "class='primary beyond' marker-end='url(#to1)'"
                     : "class='reflected beyond' marker-end='url(#to2)'");
}

static void draw_mark(void *user, const WalkthroughLine *line)
{
    Painter *painter = user;
    bool next = line->kind == LINE_NORMAL && line->hit == painter->hits + 1;
    if (line->kind == LINE_NORMAL && line->hit <= painter->hits)
        svg_mark(&painter->view, line->from, line->from, ink_text("P%d", line->hit).text, "#222");
    else if (next)
        svg_end_label(&painter->view, first_part(painter, painter->last, line->from), painter->last,
                      ink_text("to P%d", line->hit).text, "#222");
    else if (line->leaves && painter->hits == painter->hits_of_all)
        svg_end_label(&painter->view, first_part(painter, painter->last, line->to), painter->last, "out",
                      svg_strokes[line->kind].colour);
}

static void draw_picture(const SvgView *view, const Screenful *screen, const WalkthroughPicture *picture)
{
    SvgPoint origin = svg_place(view, screen->corners[TOP_LEFT]), right = svg_place(view, screen->corners[TOP_RIGHT]);
    SvgPoint down = svg_place(view, screen->corners[BOTTOM_LEFT]);
    fprintf(view->out, "<image width='1' height='1' preserveAspectRatio='none'%s ",
            picture->reduced ? "" : " style='image-rendering:pixelated'");
    fprintf(view->out, "transform='matrix(%.3f %.3f %.3f %.3f %.3f %.3f)' href='data:image/png;base64,%s'/>\n",
            right.x - origin.x, right.y - origin.y, down.x - origin.x, down.y - origin.y, origin.x, origin.y,
            picture->base64);
}

void svg_screen_panel(FILE *out, const Walkthrough *walk, const WalkthroughPicture *picture, SvgBox box, int number)
{
    const Scene *scene = walk->scene;
    Screenful screen = screenful_of(scene);
    Painter painter = {.projection = svg_projection(SVG_FROM_BEHIND, scene), .q = find_q(walk)};
    SvgPoint eye = svg_flatten(painter.projection, screen.eye);
    painter.window = (Window){eye, eye};
    for (int k = 0; k < CORNERS; k++)
        painter.window = window_with(painter.window, svg_flatten(painter.projection, screen.corners[k]));
    painter.size_most = PATH_SIZE * size_of(painter.window);
    painter.last = painter.q;
    walkthrough_lines(walk, see_hit, &painter);
    svg_view_begin(&painter.view, out, number, painter.projection, box, painter.window.low, painter.window.high);
    if (picture)
        draw_picture(&painter.view, &screen, picture);
    walkthrough_lines(walk, draw_ray, &painter);
    svg_screen_outline(&painter.view, scene);
    for (int k = 0; k < CORNERS; k++)
        svg_line(&painter.view, screen.eye, screen.corners[k], "class='sight'");
    svg_line(&painter.view, screen.eye, painter.q, "class='primary'");
    svg_mark(&painter.view, screen.eye, screen.eye, "C", "#222");
    svg_mark(&painter.view, painter.q, painter.q, "Q", "#222");
    walkthrough_lines(walk, draw_mark, &painter);
    svg_view_end(&painter.view);
}
