/* A tree's boxes, level by level. */
#include "walkthrough/tree_drawing.h"

#include "walkthrough/ink.h"
#include "walkthrough/svg_view.h"
#include "walkthrough/walkthrough_boxes.h"

enum { LEVELS_COLOURED = 8, FACES_MAX = 5000, BOXES_MAX = 4000 };

static const char *const colours[LEVELS_COLOURED] = {"#222222", "#c0392b", "#d9822b", "#b59b00",
                                                     "#3a9a5b", "#1f8fa8", "#1f5fa8", "#8e44ad"};

typedef void DrawBox(void *user, const WalkthroughBox *box);

static void each_box(const Scene *scene, const Accel *accel, int index, int level, DrawBox *draw, void *user)
{
    AccelNode node = accel_node(accel, index);
    WalkthroughBox box = walkthrough_box(scene, &node.box);
    box.node = index;
    box.level = level;
    box.leaf = node.leaf;
    draw(user, &box);
    if (node.leaf)
        return;
    each_box(scene, accel, node.low, level + 1, draw, user);
    each_box(scene, accel, node.high, level + 1, draw, user);
}

/* --- OBJ --- */

typedef struct ObjFile {
    FILE *out;
    long vertices;
} ObjFile;

static void write_box(void *user, const WalkthroughBox *box)
{
    ObjFile *file = user;
    fprintf(file->out, "g level_%d\n# node %d%s\n", box->level, box->node, box->leaf ? ", a leaf" : "");
    for (int k = 0; k < 8; k++)
        fprintf(file->out, "v %.17g %.17g %.17g\n", box->corners[k].x, box->corners[k].y, box->corners[k].z);
    for (int k = 0; k < BOX_EDGES; k++)
        fprintf(file->out, "l %ld %ld\n", file->vertices + 1 + walkthrough_box_edges[k][0],
                file->vertices + 1 + walkthrough_box_edges[k][1]);
    file->vertices += 8;
}

void tree_drawing_obj(FILE *out, const Scene *scene, const Accel *accel, const char *scene_name)
{
    ObjFile file = {.out = out};
    fprintf(out, "# The %s of %s, level by level, in the coordinates of that file.\n",
            accel->kind == ACCEL_BVH ? "bounding volume hierarchy" : "k-d tree", ink_name(scene_name, 60).text);
    each_box(scene, accel, 0, 0, write_box, &file);
}

/* --- SVG --- */

enum { PANEL_WIDTH = 475, PANEL_HEIGHT = 410, ROW_HEIGHT = 470, ZOOM_LEAST = 3 };

static const double panel_left[2] = {60, 605};

/* A rectangle of a view, in the scene's units. */
typedef struct Window {
    SvgPoint low, high;
} Window;

static Window window_of(SvgProjection projection, const WalkthroughBox *box)
{
    SvgPoint a = svg_flatten(projection, box->corners[0]), b = svg_flatten(projection, box->corners[7]);
    return (Window){{fmin(a.x, b.x), fmin(a.y, b.y)}, {fmax(a.x, b.x), fmax(a.y, b.y)}};
}

/* The scale at which a panel can show it. */
static double scale_of(Window window)
{
    return fmin(PANEL_WIDTH / (window.high.x - window.low.x), PANEL_HEIGHT / (window.high.y - window.low.y));
}

static double longest_side(const WalkthroughBox *box)
{
    Vec3 size = vec3_sub(box->corners[7], box->corners[0]);
    return fmax(fmax(size.x, size.y), size.z);
}

/* The window of the small leaves: those whose sides have up to a tenth of the whole box's longest one. */
typedef struct Smalls {
    SvgProjection projection;
    double most;
    Window window;
    int small, leaves; /* how many */
} Smalls;

static void add_leaf(void *user, const WalkthroughBox *box)
{
    Smalls *smalls = user;
    smalls->leaves += box->leaf;
    if (!box->leaf || longest_side(box) > smalls->most)
        return;
    Window leaf = window_of(smalls->projection, box), *window = &smalls->window;
    *window = smalls->small++ == 0 ? leaf
                                   : (Window){{fmin(window->low.x, leaf.low.x), fmin(window->low.y, leaf.low.y)},
                                              {fmax(window->high.x, leaf.high.x), fmax(window->high.y, leaf.high.y)}};
}

static WalkthroughBox whole_box(const Scene *scene, const Accel *accel)
{
    AccelNode root = accel_node(accel, 0);
    return walkthrough_box(scene, &root.box);
}

/* The part of a view where most leaves are, if it is so small that it needs a panel of its own; else the whole. */
static Window crowded_window(const Scene *scene, const Accel *accel, SvgProjection projection)
{
    WalkthroughBox box = whole_box(scene, accel);
    Window whole = window_of(projection, &box);
    Smalls smalls = {.projection = projection, .most = longest_side(&box) / 10};
    each_box(scene, accel, 0, 0, add_leaf, &smalls);
    double scale = scale_of(smalls.window);
    bool pays = 2 * smalls.small > smalls.leaves && isfinite(scale) && scale > ZOOM_LEAST * scale_of(whole);
    return pays ? smalls.window : whole;
}

typedef struct Painter {
    SvgView view;
    int level; /* that is drawn now */
    int boxes;
} Painter;

static int colour_of(int level)
{
    return level < LEVELS_COLOURED ? level : LEVELS_COLOURED - 1;
}

static void draw_box(void *user, const WalkthroughBox *box)
{
    Painter *painter = user;
    if (colour_of(box->level) != painter->level || painter->boxes++ >= BOXES_MAX)
        return;
    Window window = window_of(painter->view.projection, box);
    svg_rectangle(&painter->view, window.low, window.high, ink_text("class='level%d'", painter->level).text);
}

/* The panel of a direction in a row. */
static void draw_panel(FILE *out, const Scene *scene, const Accel *accel, SvgDirection direction, int row)
{
    Painter painter = {.boxes = 0};
    int column = direction == SVG_FROM_ABOVE ? 0 : 1;
    double left = panel_left[column], top = 90 + row * ROW_HEIGHT;
    SvgProjection projection = svg_projection(direction, scene);
    WalkthroughBox box = whole_box(scene, accel);
    Window whole = window_of(projection, &box), crowd = crowded_window(scene, accel, projection);
    Window window = row == 0 ? whole : crowd;
    svg_view_begin(&painter.view, out, 2 * row + column, projection,
                   (SvgBox){left, top, left + PANEL_WIDTH, top + PANEL_HEIGHT}, window.low, window.high);
    for (int i = 0; i < scene->face_count && scene->face_count <= FACES_MAX; i++)
        svg_face(&painter.view, scene, i, "class='face'");
    for (painter.level = LEVELS_COLOURED - 1; painter.level >= 0; painter.level--)
        each_box(scene, accel, 0, 0, draw_box, &painter);
    if (row == 0 && scale_of(crowd) > scale_of(whole))
        svg_rectangle(&painter.view, crowd.low, crowd.high, "class='zoom'");
    svg_view_end(&painter.view);
}

static bool is_crowded(const Scene *scene, const Accel *accel, SvgDirection direction)
{
    SvgProjection projection = svg_projection(direction, scene);
    WalkthroughBox box = whole_box(scene, accel);
    return scale_of(crowded_window(scene, accel, projection)) > scale_of(window_of(projection, &box));
}

void tree_drawing_svg(FILE *out, const Scene *scene, const Accel *accel, const char *scene_name)
{
    int rows = is_crowded(scene, accel, SVG_FROM_ABOVE) || is_crowded(scene, accel, SVG_FROM_FRONT) ? 2 : 1;
    int legend = 86 + rows * ROW_HEIGHT;
    svg_sheet_begin(out, 1100, legend + 24, "The boxes of a tree");
    fprintf(out, "<style>\n");
    for (int i = 0; i < LEVELS_COLOURED; i++)
        fprintf(out, ".level%d{fill:none;stroke:%s;stroke-width:%.1f}\n", i, colours[i], i == 0 ? 2.4 : 1.6 - 0.12 * i);
    if (rows > 1)
        fprintf(out, ".zoom{fill:none;stroke:#555;stroke-dasharray:5 3}\n");
    fprintf(out, "</style>\n<text class='big' x='60' y='40'>The %s of ", accel->kind == ACCEL_BVH ? "BVH" : "k-d tree");
    svg_text(out, ink_name(scene_name, 50).text);
    fprintf(out, "</text>\n");
    for (int row = 0; row < rows; row++) {
        draw_panel(out, scene, accel, SVG_FROM_ABOVE, row);
        draw_panel(out, scene, accel, SVG_FROM_FRONT, row);
    }
    for (int i = 0; i < LEVELS_COLOURED; i++)
        fprintf(out, "<path class='level%d' d='M%d %dh24'/><text x='%d' y='%d'>level %d%s</text>\n", i, 60 + 125 * i,
                legend, 90 + 125 * i, legend + 4, i, i == LEVELS_COLOURED - 1 ? " and on" : "");
    fprintf(out, "</svg>\n");
}
