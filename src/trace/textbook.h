/* The textbook tracer: the taught formulas, steps 1 to 10 of docs/algorithm.md, as they stand. Nothing guards against
 * rounding: reference.h is the same with the guards. Beside each other they show what rounding does to a picture.
 * Each function comes twice, in double and in float: see textbook_float.c. */
#ifndef RECTRAY_TEXTBOOK_H
#define RECTRAY_TEXTBOOK_H

#include "scene/scene.h"
#include "trace/render.h"

/* What happens on a path: a face is hit, or none is, and at a hit each light is looked at, in the scene's order. */
typedef enum TextbookEventKind { TEXTBOOK_HIT, TEXTBOOK_MISS, TEXTBOOK_LIGHT } TextbookEventKind;

typedef struct TextbookEvent {
    TextbookEventKind kind;
    Vec3 origin, direction; /* of the path's ray, or of the shadow ray */
    /* Of a hit: the face, t, P, N turned to the ray, and the shifted point. */
    int face;
    double t;
    Vec3 point, normal, shifted;
    /* Of a light: N.(light - P), which is positive where the light is in front; then a face in its way, or -1. */
    double height;
    int blocker;
} TextbookEvent;

typedef struct TextbookListener {
    void (*tell)(void *user, const TextbookEvent *event);
    void *user;
} TextbookListener;

/* What it works with. */
typedef struct Textbook {
    const Scene *scene;               /* its samples are a grid; adaptive sampling is not in the text */
    float shift;                      /* how far off its face a point is shifted */
    RenderReport *report;             /* counts are added to it */
    const TextbookListener *listener; /* is told what happens; NULL: nobody is */
} Textbook;

/* The colour of one pixel: its average over the grid of samples, not clamped, and its bytes in the picture. */
Vec3 textbook_pixel(const Textbook *textbook, int column, int row, unsigned char rgb[3]);
Vec3 textbook_pixel_float(const Textbook *textbook, int column, int row, unsigned char rgb[3]);

/* The colour of one sample of the pixel: sub-column i and sub-row j of its grid. */
Vec3 textbook_sample(const Textbook *textbook, int column, int row, int i, int j);
Vec3 textbook_sample_float(const Textbook *textbook, int column, int row, int i, int j);

/* Steps 3 and 4: where P(t) = origin + t direction hits the face of that number; 0 if it does not. */
double textbook_hit(const Textbook *textbook, int face, Vec3 origin, Vec3 direction);
double textbook_hit_float(const Textbook *textbook, int face, Vec3 origin, Vec3 direction);

/* The numbers that this is decided by. */
typedef struct TextbookTest {
    double n_dot_r, t;    /* t is 0 where N.R is */
    double edge_value[4]; /* dot(N, cross(e, c)) of each edge */
} TextbookTest;

TextbookTest textbook_test(const Textbook *textbook, int face, Vec3 origin, Vec3 direction);
TextbookTest textbook_test_float(const Textbook *textbook, int face, Vec3 origin, Vec3 direction);

/* Steps 3 and 6: the point of such a hit, and the point shifted off the face on the ray's side. */
void textbook_points(const Textbook *textbook, int face, Vec3 origin, Vec3 direction, double t, Vec3 *point,
                     Vec3 *shifted);
void textbook_points_float(const Textbook *textbook, int face, Vec3 origin, Vec3 direction, double t, Vec3 *point,
                           Vec3 *shifted);

#endif
