/* One orthographic view of a scene as a panel of an SVG drawing: axes, faces, lines, marks, and labels that keep out of
 * each other's way. */
#ifndef RECTRAY_SVG_VIEW_H
#define RECTRAY_SVG_VIEW_H

#include "scene/scene.h"

#include <stdbool.h>
#include <stdio.h>

enum { SVG_LABELS_MAX = 200, SVG_LINES_MAX = 400 };

typedef struct SvgPoint {
    double x, y;
} SvgPoint;

/* Along the axes, and from behind the camera, to its right and above it. */
typedef enum SvgDirection {
    SVG_FROM_ABOVE,
    SVG_FROM_SIDE,
    SVG_FROM_FRONT,
    SVG_DIRECTION_COUNT,
    SVG_FROM_BEHIND = SVG_DIRECTION_COUNT
} SvgDirection;

/* From where a view is taken. One along an axis can be turned about the vertical by half a turn, so that the camera
 * looks the way in which the picture shows it: away from the reader, or to the right. */
typedef struct SvgProjection {
    SvgDirection direction;
    bool turned;
    Vec3 across, upwards; /* from behind: unit vectors along the paper */
} SvgProjection;

/* A box of the paper, in pixels, y downwards. */
typedef struct SvgBox {
    double left, top, right, bottom;
} SvgBox;

typedef struct SvgLabel {
    SvgPoint at; /* of the mark it belongs to */
    char text[24];
    const char *colour;
} SvgLabel;

typedef struct SvgView {
    FILE *out;
    SvgProjection projection;
    SvgBox box;
    double left, bottom; /* of the window, in the scene's units */
    double scale;        /* pixels per unit */
    SvgLabel labels[SVG_LABELS_MAX];
    int label_count;
    SvgBox taken[2 * SVG_LABELS_MAX]; /* by marks and labels, where no label should be */
    int taken_count;
    SvgBox lines[SVG_LINES_MAX]; /* from (left, top) to (right, bottom), which labels should not cross */
    int line_count;
} SvgView;

SvgProjection svg_projection(SvgDirection direction, const Scene *scene);

/* What a view shows of a position: x to the right, y upwards, in the scene's units. */
SvgPoint svg_flatten(SvgProjection projection, Vec3 p);

/* Where a position is on the paper. */
SvgPoint svg_place(const SvgView *view, Vec3 p);

/* Begins a drawing of so many pixels with its title and the style of text, axes and faces. */
void svg_sheet_begin(FILE *out, int width, int height, const char *title);

/* Prints text with the characters that mean something to XML put in their own words. */
void svg_text(FILE *out, const char *text);

/* Begins a panel that shows the window from low to high (flattened) with a margin, its units square. No other panel of
 * the drawing has its number. */
void svg_view_begin(SvgView *view, FILE *out, int number, SvgProjection projection, SvgBox box, SvgPoint low,
                    SvgPoint high);

/* A face with an SVG style. Faces that are wholly outside the window are left out. */
void svg_face(const SvgView *view, const Scene *scene, int face, const char *style);

/* Marks where the panel's edge cuts a face off: a zigzag along that edge (svg_cut.c). Returns whether there is one. */
bool svg_cut(const SvgView *view, const Scene *scene, int face, const char *style);

/* A rectangle of the window, in the scene's units. */
void svg_rectangle(const SvgView *view, SvgPoint low, SvgPoint high, const char *style);

/* Labels keep off the line. */
void svg_line(SvgView *view, Vec3 from, Vec3 to, const char *style);

/* Whether the panel's window holds the position. */
bool svg_is_seen(const SvgView *view, Vec3 p);

/* A filled dot, and the label that will stand beside it; marks at the same place share one. Of a position outside the
 * window only the label is shown, where the line from `seen_from` leaves. */
void svg_mark(SvgView *view, Vec3 p, Vec3 seen_from, const char *label, const char *colour);

/* The label alone, of the end of a ray that goes on beyond what is drawn. */
void svg_end_label(SvgView *view, Vec3 p, Vec3 seen_from, const char *label, const char *colour);

/* A short arrow at the panel's edge, on the way from a position that is seen to one that is not. */
void svg_arrow_out(const SvgView *view, Vec3 seen_from, Vec3 p, const char *style);

/* A small cross where a shadow ray is stopped. */
void svg_cross(const SvgView *view, Vec3 p, const char *colour);

/* Places the labels (svg_label.c) and ends the panel. */
void svg_view_end(SvgView *view);

#endif
