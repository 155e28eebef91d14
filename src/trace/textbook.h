/* The textbook tracer: the taught formulas, steps 1 to 10 of docs/algorithm.md, as they stand. Nothing guards against
 * rounding: reference.h is the same with the guards. Beside each other they show what rounding does to a picture.
 * Each function comes twice, in double and in float: see textbook_float.c. */
#ifndef RECTRAY_TEXTBOOK_H
#define RECTRAY_TEXTBOOK_H

#include "trace/textbook_input.h"

/* The colour of one pixel: its average over the grid of samples, not clamped, and its bytes in the picture. */
Vec3 textbook_pixel(const Textbook *textbook, int column, int row, unsigned char rgb[3]);
Vec3 textbook_pixel_float(const Textbook *textbook, int column, int row, unsigned char rgb[3]);

typedef struct TextbookTest {
    bool hit;
    FaceTest test;       /* edges after the first that the point is outside of are not looked at */
    Vec3 point, shifted; /* of a hit */
} TextbookTest;

/* Steps 3, 4 and 6: how that face is tested against a ray. */
TextbookTest textbook_test(const Textbook *textbook, int face, Ray ray);
TextbookTest textbook_test_float(const Textbook *textbook, int face, Ray ray);

#endif
