/* The walkthrough as an SVG drawing: the scene and the path in two orthographic views, the two that show most of it,
 * and the picture on its screen. The hits are P1, P2, ... as in the text. Primary and reflected rays are solid, shadow
 * rays thin, and those that a face stops dashed up to the light that they do not reach. */
#include "walkthrough/ink.h"
#include "walkthrough/svg_panel.h"
#include "walkthrough/svg_screen.h"
#include "walkthrough/svg_strokes.h"
#include "walkthrough/walkthrough_formats.h"
#include "walkthrough/walkthrough_words.h"

enum { WIDTH = 1100, CAPTION_HEIGHT = 19, CAPTIONS_MAX = 12 };

static const SvgBox panels[2] = {{60, 90, 535, 500}, {605, 90, 1080, 500}};

/* Where hits are close together a second row of panels shows them larger. */
static const SvgBox zooms[2] = {{60, 630, 535, 1040}, {605, 630, 1080, 1040}};
enum { ZOOM_HEIGHT = 490 };

/* Below, the picture on its screen. */
enum { SCREEN_TOP = 630, SCREEN_HEIGHT = 290 };

static void draw_head(FILE *out, const Walkthrough *walk, int height)
{
    const unsigned char *rgb = walk->events[walk->count - 1].as.pixel.rgb;
    svg_sheet_begin(out, WIDTH, height, ink_text("Pixel (%d, %d)", walk->request.column, walk->request.row).text);
    fprintf(out, "<style>\n.hit{fill:#3a9a5b;fill-opacity:.18;stroke:#3a9a5b;stroke-width:1.5}\n"
                 ".blocker{fill:#c0392b;fill-opacity:.15;stroke:#c0392b;stroke-width:1.5}\n"
                 ".entered{fill:none;stroke:#1f8fa8;stroke-width:1.2}\n"
                 ".passed{fill:none;stroke:#1f8fa8;stroke-opacity:.55;stroke-dasharray:2 3}\n"
                 ".cut{fill:none}.beyond{stroke-dasharray:5 4}\n"
                 ".screen{fill:none;stroke:#222;stroke-width:1.2}.sight{stroke:#777;stroke-width:.8}\n"
                 ".zoom{fill:none;stroke:#555;stroke-dasharray:5 3}\n");
    for (int k = LINE_PRIMARY; k < LINE_SHIFT; k++)
        fprintf(out, ".%s{stroke:%s;stroke-width:%s}\n", svg_strokes[k].name, svg_strokes[k].colour,
                svg_strokes[k].width);
    fprintf(out, "</style>\n");
    static const WalkthroughLineKind tipped[] = {LINE_PRIMARY, LINE_REFLECTED, LINE_NORMAL, LINE_SHADOW};
    for (int k = 0; k < 4; k++)
        fprintf(out,
                "<marker id='to%d' viewBox='0 0 10 10' refX='9' refY='5' markerWidth='%d' markerHeight='%d' "
                "orient='auto'><path d='M0 0L10 5L0 10z' style='fill:%s'/></marker>\n",
                k + 1, k < 3 ? 5 : 8, k < 3 ? 5 : 8, svg_strokes[tipped[k]].colour);
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

typedef struct LegendEntry {
    int x;
    const char *line, *words;
} LegendEntry;

static void draw_legend_row(FILE *out, const LegendEntry *entries, int count, int y)
{
    for (int k = 0; k < count; k++)
        fprintf(out, "<path class='%s' d='M%d %dh34'/><text x='%d' y='%d'>%s</text>\n", entries[k].line, entries[k].x,
                y - 4, entries[k].x + 42, y, entries[k].words);
}

static void draw_legend(const SvgSheet *sheet)
{
    static const LegendEntry lines[] = {{60, "primary", "primary ray"},
                                        {225, "reflected", "reflected ray"},
                                        {405, "shadow", "to a light that reaches"},
                                        {650, "blocked", "to a light that is blocked"},
                                        {915, "normal", "normal N"}};
    static const LegendEntry nodes[] = {{225, "entered", "box of a node that a ray enters"},
                                        {530, "passed", "of one that all pass over"}};
    static const LegendEntry screen = {60, "screen", "the screen"};
    draw_legend_row(sheet->out, lines, 5, 560);
    draw_legend_row(sheet->out, &screen, 1, 580);
    if (has_nodes(sheet->walk))
        draw_legend_row(sheet->out, nodes, 2, 580);
    if (sheet->has_cut) {
        int x = has_nodes(sheet->walk) ? 790 : 225;
        fprintf(sheet->out,
                "<path class='hit cut' d='M%d 576l5 -4l5 4l5 -4l5 4l5 -4l5 4l5 -4'/>"
                "<text x='%d' y='580'>the face goes on beyond the panel</text>\n",
                x, x + 42);
    }
}

/* A line for each hit, beside the last panel. */
static void draw_captions(FILE *out, const Walkthrough *walk, int top)
{
    const Scene *scene = walk->scene;
    WalkthroughPlace place = {0};
    int hits = 0;
    for (long i = 0; i < walk->count; i++) {
        const Event *event = &walk->events[i];
        walkthrough_follow(&place, walk, event);
        if (!place.told || event->kind != EVENT_HIT || hits++ >= CAPTIONS_MAX)
            continue;
        const Face *face = &scene->faces[event->as.hit.face];
        WalkthroughPiece piece = walkthrough_piece(scene, event->as.hit.face);
        fprintf(out, "<text x='605' y='%d'>P%d: ", top + CAPTION_HEIGHT * hits, hits);
        if (piece.count > 1)
            fprintf(out, "piece %d of %d of ", piece.number, piece.count);
        fprintf(out, "face %d, ", face->number);
        svg_text(out, walkthrough_owner_words(scene, event->as.hit.face, piece.count > 1 ? 12 : 20).text);
        fprintf(out, "/%d, of ", walkthrough_face_in_object(scene, event->as.hit.face));
        svg_text(out, ink_name(scene->materials[face->material].name, 14).text);
        fprintf(out, ", with weight %s</text>\n", ink_number(place.weight, 4).text);
    }
    if (hits > CAPTIONS_MAX)
        fprintf(out, "<text x='605' y='%d'>and %d more</text>\n", top + CAPTION_HEIGHT * (CAPTIONS_MAX + 1),
                hits - CAPTIONS_MAX);
    if (scene->face_count > SVG_FACES_MAX)
        fprintf(out, "<text x='605' y='%d'>Of %d faces only those that are hit or in the way are drawn.</text>\n",
                top + CAPTION_HEIGHT * (CAPTIONS_MAX + 2), scene->face_count);
}

bool walkthrough_write_svg(FILE *out, const Walkthrough *walk, WalkthroughStyle style, Error *error)
{
    SvgSheet sheet = {.out = out, .walk = walk, .extent = svg_extent_of(walk), .error = error};
    SvgDirection left_out = svg_extent_least_shown(&sheet.extent);
    sheet.has_zoom = svg_extent_of_close_hits(walk, &sheet.extent, &sheet.close);
    int top = SCREEN_TOP + (sheet.has_zoom ? ZOOM_HEIGHT : 0), panel = 0;
    draw_head(out, walk, top + SCREEN_HEIGHT + 20);
    for (SvgDirection k = SVG_FROM_ABOVE; k < SVG_DIRECTION_COUNT; k++) {
        if (k == left_out)
            continue;
        svg_panel(&sheet, k, panels[panel], false);
        if (sheet.has_zoom)
            svg_panel(&sheet, k, zooms[panel], true);
        panel++;
    }
    draw_legend(&sheet);
    svg_screen_panel(out, walk, style.picture, (SvgBox){60, top, 535, top + SCREEN_HEIGHT}, 2 * SVG_DIRECTION_COUNT);
    draw_captions(out, walk, top - 8);
    fprintf(out, "</svg>\n");
    return !sheet.failed;
}
