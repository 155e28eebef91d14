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

static const SvgBox panels[2] = {{60, 90, 535, 500}, {605, 90, 1080, 500}};

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
    SvgPoint a = svg_flatten(painter->view.projection, box->corners[0]);
    SvgPoint b = svg_flatten(painter->view.projection, box->corners[7]);
    svg_rectangle(&painter->view, (SvgPoint){fmin(a.x, b.x), fmin(a.y, b.y)},
                  (SvgPoint){fmax(a.x, b.x), fmax(a.y, b.y)}, ink_text("class='level%d'", painter->level).text);
}

static void draw_panel(FILE *out, const Scene *scene, const Accel *accel, SvgDirection direction, int number)
{
    Painter painter = {.boxes = 0};
    AccelNode root = accel_node(accel, 0);
    WalkthroughBox box = walkthrough_box(scene, &root.box);
    SvgProjection projection = svg_projection(direction, scene);
    SvgPoint a = svg_flatten(projection, box.corners[0]), b = svg_flatten(projection, box.corners[7]);
    svg_view_begin(&painter.view, out, number, projection, panels[number], (SvgPoint){fmin(a.x, b.x), fmin(a.y, b.y)},
                   (SvgPoint){fmax(a.x, b.x), fmax(a.y, b.y)});
    for (int i = 0; i < scene->face_count && scene->face_count <= FACES_MAX; i++)
        svg_face(&painter.view, scene, i, "class='face'");
    for (painter.level = LEVELS_COLOURED - 1; painter.level >= 0; painter.level--)
        each_box(scene, accel, 0, 0, draw_box, &painter);
    svg_view_end(&painter.view);
}

void tree_drawing_svg(FILE *out, const Scene *scene, const Accel *accel, const char *scene_name)
{
    svg_sheet_begin(out, 1100, 580, "The boxes of a tree");
    fprintf(out, "<style>\n");
    for (int i = 0; i < LEVELS_COLOURED; i++)
        fprintf(out, ".level%d{fill:none;stroke:%s;stroke-width:%.1f}\n", i, colours[i], i == 0 ? 2.4 : 1.6 - 0.12 * i);
    fprintf(out, "</style>\n<text class='big' x='60' y='40'>The %s of ", accel->kind == ACCEL_BVH ? "BVH" : "k-d tree");
    svg_text(out, ink_name(scene_name, 50).text);
    fprintf(out, "</text>\n");
    draw_panel(out, scene, accel, SVG_FROM_ABOVE, 0);
    draw_panel(out, scene, accel, SVG_FROM_FRONT, 1);
    for (int i = 0; i < LEVELS_COLOURED; i++)
        fprintf(out, "<path class='level%d' d='M%d 556h24'/><text x='%d' y='560'>level %d%s</text>\n", i, 60 + 125 * i,
                90 + 125 * i, i, i == LEVELS_COLOURED - 1 ? " and on" : "");
    fprintf(out, "</svg>\n");
}
