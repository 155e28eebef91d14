/* The textbook tracer: the taught formulas, steps 1 to 10 of docs/algorithm.md, as they stand. Nothing guards against
 * rounding: reference.h is the same with the guards. Beside each other they show what rounding does to a picture.
 * Each function comes twice, in double and in float: see textbook_float.c. */
#ifndef RECTRAY_TEXTBOOK_H
#define RECTRAY_TEXTBOOK_H

#include "scene/scene.h"
#include "trace/render.h"

/* What it works with. */
typedef struct Textbook {
    const Scene *scene;   /* its samples are a grid; adaptive sampling is not in the text */
    float shift;          /* how far off its face a point is shifted */
    RenderReport *report; /* counts are added to it */
} Textbook;

/* The colour of one pixel: its average over the grid of samples, not clamped, and its bytes in the picture. */
Vec3 textbook_pixel(const Textbook *textbook, int column, int row, unsigned char rgb[3]);
Vec3 textbook_pixel_float(const Textbook *textbook, int column, int row, unsigned char rgb[3]);

/* Steps 3 and 4: where P(t) = origin + t direction hits the face of that number; 0 if it does not. */
double textbook_hit(const Textbook *textbook, int face, Vec3 origin, Vec3 direction);
double textbook_hit_float(const Textbook *textbook, int face, Vec3 origin, Vec3 direction);

/* Steps 3 and 6: the point of such a hit, and the point shifted off the face on the ray's side. */
void textbook_points(const Textbook *textbook, int face, Vec3 origin, Vec3 direction, double t, Vec3 *point,
                     Vec3 *shifted);
void textbook_points_float(const Textbook *textbook, int face, Vec3 origin, Vec3 direction, double t, Vec3 *point,
                           Vec3 *shifted);

#endif
