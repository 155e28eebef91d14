/* The walkthrough as an SVG drawing: the scene and the path in two orthographic views, the two that show most of it.
 * The hits are P1, P2, ... as in the text. Primary and reflected rays are solid, shadow rays thin, and those that a
 * face stops dashed up to the light that they do not reach. */
#include "walkthrough/ink.h"
#include "walkthrough/svg_extent.h"
#include "walkthrough/svg_view.h"
#include "walkthrough/walkthrough_boxes.h"
#include "walkthrough/walkthrough_formats.h"
#include "walkthrough/walkthrough_lines.h"

#include <string.h>

enum { WIDTH = 1100, LIGHTS_MAX = 100, FACES_MAX = 5000, CAPTIONS_TOP = 606, CAPTION_HEIGHT = 19, CAPTIONS_MAX = 8 };

#define LIGHT_COLOUR "#a87400"

static const SvgBox panels[2] = {{60, 90, 535, 500}, {605, 90, 1080, 500}};

/* Where hits are close together a second row of panels shows them larger. */
static const SvgBox zooms[2] = {{60, 620, 535, 1030}, {605, 620, 1080, 1030}};
enum { ZOOM_HEIGHT = 490 };

/* How each kind of line is drawn. Shifts are far too short to be. */
static const struct {
    const char *name, *colour, *width;
} strokes[] = {
    [LINE_PRIMARY] = {"primary", "#1f5fa8", "2.4"}, [LINE_REFLECTED] = {"reflected", "#b5449a", "2.4"},
    [LINE_SHADOW] = {"shadow", "#c98a00", "1.4"},   [LINE_BLOCKED] = {"blocked", "#c0392b", "1.4;stroke-dasharray:6 5"},
    [LINE_NORMAL] = {"normal", "#3a9a5b", "1.6"},
};

/* --- A panel --- */

typedef struct Painter {
    SvgView view;
    const Walkthrough *walk;
    bool lights_marked[LIGHTS_MAX];
} Painter;

static void draw_faces(const Painter *painter)
{
    const Walkthrough *walk = painter->walk;
    for (int i = 0; i < walk->scene->face_count && walk->scene->face_count <= FACES_MAX; i++)
        svg_face(&painter->view, walk->scene, i, "class='face'");
    WalkthroughPlace place = {0};
    for (long i = 0; i < walk->count; i++) {
        const Event *event = &walk->events[i];
        walkthrough_follow(&place, walk, event);
        if (place.told && event->kind == EVENT_HIT)
            svg_face(&painter->view, walk->scene, event->as.hit.face, "class='hit'");
        else if (place.told && event->kind == EVENT_LIGHT_END && event->as.light_end.blocker >= 0)
            svg_face(&painter->view, walk->scene, event->as.light_end.blocker, "class='blocker'");
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
        svg_cross(&painter->view, line->stop, strokes[LINE_BLOCKED].colour);
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
        svg_end_label(view, line->to, line->from, "out", strokes[line->kind].colour);
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

/* A panel, and in it the outline of what another one shows larger; zoom: NULL where none does. */
static bool draw_panel(FILE *out, const Walkthrough *walk, SvgDirection direction, SvgBox box, int number,
                       const SvgExtent *extent, const SvgExtent *zoom, Error *error)
{
    Painter painter = {.walk = walk};
    SvgProjection projection = svg_projection(direction, walk->scene);
    Window window = window_of(projection, extent);
    svg_view_begin(&painter.view, out, number, projection, box, window.low, window.high);
    draw_faces(&painter);
    bool done = walkthrough_boxes(walk, draw_node, &painter, error);
    if (zoom) {
        Window part = window_of(projection, zoom);
        svg_rectangle(&painter.view, part.low, part.high, "class='zoom'");
    }
    walkthrough_lines(walk, draw_line, &painter);
    walkthrough_lines(walk, draw_mark, &painter);
    mark_other_lights(&painter);
    svg_view_end(&painter.view);
    return done;
}

/* --- The sheet --- */

static int count_captions(const Walkthrough *walk)
{
    WalkthroughPlace place = {0};
    int count = 0;
    for (long i = 0; i < walk->count; i++) {
        walkthrough_follow(&place, walk, &walk->events[i]);
        count += place.told && walk->events[i].kind == EVENT_HIT && count < CAPTIONS_MAX;
    }
    return count;
}

static void draw_head(FILE *out, const Walkthrough *walk, int more)
{
    const unsigned char *rgb = walk->events[walk->count - 1].as.pixel.rgb;
    int height = CAPTIONS_TOP + CAPTION_HEIGHT * count_captions(walk) + 4 + more;
    svg_sheet_begin(out, WIDTH, height, ink_text("Pixel (%d, %d)", walk->request.column, walk->request.row).text);
    fprintf(out, "<style>\n.hit{fill:#3a9a5b;fill-opacity:.18;stroke:#3a9a5b;stroke-width:1.5}\n"
                 ".blocker{fill:#c0392b;fill-opacity:.15;stroke:#c0392b;stroke-width:1.5}\n"
                 ".entered{fill:none;stroke:#1f8fa8;stroke-width:1.2}\n"
                 ".passed{fill:none;stroke:#1f8fa8;stroke-opacity:.55;stroke-dasharray:2 3}\n"
                 ".zoom{fill:none;stroke:#555;stroke-dasharray:5 3}\n");
    for (int k = LINE_PRIMARY; k < LINE_SHIFT; k++)
        fprintf(out, ".%s{stroke:%s;stroke-width:%s}\n", strokes[k].name, strokes[k].colour, strokes[k].width);
    fprintf(out, "</style>\n");
    static const WalkthroughLineKind tipped[] = {LINE_PRIMARY, LINE_REFLECTED, LINE_NORMAL, LINE_SHADOW};
    for (int k = 0; k < 4; k++)
        fprintf(out,
                "<marker id='to%d' viewBox='0 0 10 10' refX='9' refY='5' markerWidth='%d' markerHeight='%d' "
                "orient='auto'><path d='M0 0L10 5L0 10z' style='fill:%s'/></marker>\n",
                k + 1, k < 3 ? 5 : 8, k < 3 ? 5 : 8, strokes[tipped[k]].colour);
    fprintf(out, "<text class='big' x='60' y='40'>Pixel (%d, %d) of ", walk->request.column, walk->request.row);
    svg_text(out, ink_name(walk->scene_name, 50).text);
    fprintf(out, "</text>\n<text x='1050' y='40' text-anchor='end'>(%d, %d, %d)</text>\n", rgb[0], rgb[1], rgb[2]);
    fprintf(out, "<rect x='1058' y='24' width='22' height='22' stroke='#999' fill='rgb(%d,%d,%d)'/>\n", rgb[0], rgb[1],
            rgb[2]);
}

static bool has_nodes(const Walkthrough *walk)
{
    for (long i = 0; i < walk->count; i++)
        if (walk->events[i].kind == EVENT_NODE)
            return true;
    return false;
}

static void draw_legend(FILE *out, const Walkthrough *walk)
{
    static const struct {
        int x;
        const char *line, *words;
    } entries[] = {{60, "primary", "primary ray"},
                   {225, "reflected", "reflected ray"},
                   {405, "shadow", "to a light that reaches"},
                   {650, "blocked", "to a light that is blocked"},
                   {915, "normal", "normal N"}};
    for (int k = 0; k < 5; k++)
        fprintf(out, "<path class='%s' d='M%d 556h34'/><text x='%d' y='560'>%s</text>\n", entries[k].line, entries[k].x,
                entries[k].x + 42, entries[k].words);
    if (has_nodes(walk))
        fprintf(out,
                "<path class='entered' d='M60 576h34'/><text x='102' y='580'>box of a node that a ray enters</text>\n"
                "<path class='passed' d='M405 576h34'/><text x='447' y='580'>of one that all pass over</text>\n");
}

static void draw_captions(FILE *out, const Walkthrough *walk, int top)
{
    const Scene *scene = walk->scene;
    WalkthroughPlace place = {0};
    int lines = 0;
    for (long i = 0; i < walk->count; i++) {
        const Event *event = &walk->events[i];
        walkthrough_follow(&place, walk, event);
        if (!place.told || event->kind != EVENT_HIT || lines == CAPTIONS_MAX)
            continue;
        const Face *face = &scene->faces[event->as.hit.face];
        InkText text = ink_text("P%d", walkthrough_hit_number(&place));
        fprintf(out, "<text x='60' y='%d'>%s: face %d, ", top + CAPTION_HEIGHT * lines++, text.text, face->number);
        svg_text(out, ink_name(scene->objects[face->object].name, 40).text);
        fprintf(out, "/%d, of ", walkthrough_face_in_object(scene, event->as.hit.face));
        svg_text(out, ink_name(scene->materials[face->material].name, 40).text);
        fprintf(out, ", with weight %s</text>\n", ink_number(place.weight, 6).text);
    }
    if (scene->face_count > FACES_MAX)
        fprintf(out,
                "<text x='1080' y='%d' text-anchor='end'>Of %d faces only those that are hit or in the way.</text>\n",
                top, scene->face_count);
}

bool walkthrough_write_svg(FILE *out, const Walkthrough *walk, WalkthroughStyle style, Error *error)
{
    (void)style;
    SvgExtent extent = svg_extent_of(walk), close;
    SvgDirection left_out = svg_extent_least_shown(&extent);
    bool zoom = svg_extent_of_close_hits(walk, &extent, &close), done = true;
    draw_head(out, walk, zoom ? ZOOM_HEIGHT : 0);
    int panel = 0;
    for (SvgDirection k = SVG_FROM_ABOVE; k < SVG_DIRECTION_COUNT; k++) {
        if (k == left_out)
            continue;
        done = done && draw_panel(out, walk, k, panels[panel], (int)k, &extent, zoom ? &close : NULL, error);
        if (zoom)
            done = done && draw_panel(out, walk, k, zooms[panel], (int)(SVG_DIRECTION_COUNT + k), &close, NULL, error);
        panel++;
    }
    draw_legend(out, walk);
    draw_captions(out, walk, CAPTIONS_TOP + (zoom ? ZOOM_HEIGHT : 0));
    fprintf(out, "</svg>\n");
    return done;
}
