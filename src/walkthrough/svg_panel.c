/* One view of a walkthrough: faces, rays, hits, lights, and the boxes of a tree. */
#include "walkthrough/svg_panel.h"

#include "walkthrough/ink.h"
#include "walkthrough/svg_screen.h"
#include "walkthrough/svg_strokes.h"
#include "walkthrough/walkthrough_boxes.h"

enum { LIGHTS_MAX = 100 };

#define LIGHT_COLOUR "#a87400"

typedef struct Painter {
    SvgView view;
    const Walkthrough *walk;
    bool lights_marked[LIGHTS_MAX];
    bool marks_cuts, cut;
} Painter;

/* A face that a ray meets. */
static void draw_met(Painter *painter, int face, const char *style, const char *style_of_cut)
{
    svg_face(&painter->view, painter->walk->scene, face, style);
    if (painter->marks_cuts && svg_cut(&painter->view, painter->walk->scene, face, style_of_cut))
        painter->cut = true;
}

static void draw_faces(Painter *painter)
{
    const Walkthrough *walk = painter->walk;
    for (int i = 0; i < walk->scene->face_count && walk->scene->face_count <= SVG_FACES_MAX; i++)
        svg_face(&painter->view, walk->scene, i, "class='face'");
    WalkthroughPlace place = {0};
    for (long i = 0; i < walk->count; i++) {
        const Event *event = &walk->events[i];
        walkthrough_follow(&place, walk, event);
        if (place.told && event->kind == EVENT_HIT)
            draw_met(painter, event->as.hit.face, "class='hit'", "class='hit cut'");
        else if (place.told && event->kind == EVENT_LIGHT_END && event->as.light_end.blocker >= 0)
            draw_met(painter, event->as.light_end.blocker, "class='blocker'", "class='blocker cut'");
    }
}

static void draw_line(void *user, const WalkthroughLine *line)
{
    static const char *const styles[] = {
        [LINE_PRIMARY] = "class='primary' marker-end='url(#to1)'",
        [LINE_REFLECTED] = "class='reflected' marker-end='url(#to2)'",
        [LINE_SHADOW] = "class='shadow'",
        [LINE_BLOCKED] = "class='blocked'",
        [LINE_NORMAL] = "class='normal' marker-end='url(#to3)'",
    };
    Painter *painter = user;
    if (line->kind == LINE_SHIFT)
        return;
    svg_line(&painter->view, line->from, line->to, styles[line->kind]);
    if (line->kind == LINE_BLOCKED)
        svg_cross(&painter->view, line->stop, svg_strokes[LINE_BLOCKED].colour);
}

static void draw_mark(void *user, const WalkthroughLine *line)
{
    Painter *painter = user;
    SvgView *view = &painter->view;
    if (line->kind == LINE_PRIMARY)
        svg_mark(view, line->from, line->from, "C", "#222");
    if (line->kind == LINE_NORMAL && svg_is_seen(view, line->from))
        svg_mark(view, line->from, line->from, ink_text("P%d", line->hit).text, "#222");
    if (line->leaves)
        svg_end_label(view, line->to, line->from, "out", svg_strokes[line->kind].colour);
    if ((line->kind != LINE_SHADOW && line->kind != LINE_BLOCKED) || line->light >= LIGHTS_MAX)
        return;
    if (painter->lights_marked[line->light] && svg_is_seen(view, line->to))
        return; /* from another hit */
    painter->lights_marked[line->light] = true;
    const char *words = svg_is_seen(view, line->to) ? "light %d" : "to light %d";
    svg_mark(view, line->to, line->from, ink_text(words, line->light).text, LIGHT_COLOUR);
    if (!svg_is_seen(view, line->to))
        svg_arrow_out(view, line->from, line->to, "class='shadow' marker-end='url(#to4)'");
}

/* The lights to which no ray goes, since they are behind the faces. */
static void mark_other_lights(Painter *painter)
{
    SvgView *view = &painter->view;
    const Scene *scene = painter->walk->scene;
    WalkthroughPlace place = {0};
    for (long i = 0; i < painter->walk->count; i++) {
        const Event *event = &painter->walk->events[i];
        walkthrough_follow(&place, painter->walk, event);
        if (!place.told || event->kind != EVENT_LIGHT || event->as.light.light >= LIGHTS_MAX ||
            painter->lights_marked[event->as.light.light])
            continue;
        Vec3 light = walkthrough_world(scene, event->as.light.position);
        Vec3 from = walkthrough_world(scene, place.hit->as.hit.point);
        const char *words = svg_is_seen(view, light) ? "light %d" : "to light %d";
        painter->lights_marked[event->as.light.light] = true;
        svg_mark(view, light, from, ink_text(words, event->as.light.light).text, LIGHT_COLOUR);
        if (!svg_is_seen(view, light))
            svg_arrow_out(view, from, light, "class='shadow' marker-end='url(#to4)'");
    }
}

static void draw_node(void *user, const WalkthroughBox *box)
{
    const Painter *painter = user;
    SvgPoint a = svg_flatten(painter->view.projection, box->corners[0]);
    SvgPoint b = svg_flatten(painter->view.projection, box->corners[7]);
    svg_rectangle(&painter->view, (SvgPoint){fmin(a.x, b.x), fmin(a.y, b.y)},
                  (SvgPoint){fmax(a.x, b.x), fmax(a.y, b.y)}, box->entered ? "class='entered'" : "class='passed'");
}

/* A window of the flattened scene. */
typedef struct Window {
    SvgPoint low, high;
} Window;

static Window window_of(SvgProjection projection, const SvgExtent *extent)
{
    SvgPoint a = svg_flatten(projection, extent->low), b = svg_flatten(projection, extent->high);
    return (Window){{fmin(a.x, b.x), fmin(a.y, b.y)}, {fmax(a.x, b.x), fmax(a.y, b.y)}};
}

void svg_panel(SvgSheet *sheet, SvgDirection direction, SvgBox box, bool zoomed)
{
    const Walkthrough *walk = sheet->walk;
    Painter painter = {.walk = walk, .marks_cuts = !zoomed};
    SvgProjection projection = svg_projection(direction, walk->scene);
    Window window = window_of(projection, zoomed ? &sheet->close : &sheet->extent);
    int number = (int)direction + (zoomed ? SVG_DIRECTION_COUNT : 0);
    svg_view_begin(&painter.view, sheet->out, number, projection, box, window.low, window.high);
    draw_faces(&painter);
    svg_screen_outline(&painter.view, walk->scene);
    if (!walkthrough_boxes(walk, draw_node, &painter, sheet->error))
        sheet->failed = true;
    if (sheet->has_zoom && !zoomed) {
        Window part = window_of(projection, &sheet->close);
        svg_rectangle(&painter.view, part.low, part.high, "class='zoom'");
    }
    walkthrough_lines(walk, draw_line, &painter);
    walkthrough_lines(walk, draw_mark, &painter);
    mark_other_lights(&painter);
    svg_view_end(&painter.view);
    sheet->has_cut = sheet->has_cut || painter.cut;
}
