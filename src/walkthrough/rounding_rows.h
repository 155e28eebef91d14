/* What textbook arithmetic finds and what is exactly so, below each other: a value, a hit, a light. */
#ifndef RECTRAY_ROUNDING_ROWS_H
#define RECTRAY_ROUNDING_ROWS_H

#include "walkthrough/rounding_words.h"

typedef struct RoundingRows {
    Ink ink;
    const Rounding *rounding;
} RoundingRows;

/* The name has room for four characters. */
void rounding_vector_rows(const RoundingRows *rows, const char *name, Vec3 textbook, Vec3 exact);

/* Of hit k, from 0: the face that each finds, if `with_face`; where they find the same, t, P and the shifted point. */
void rounding_hit_rows(const RoundingRows *rows, int k, bool with_face);

/* Of a light at hit k. */
void rounding_light_rows(const RoundingRows *rows, int k, int light);

/* The two sentences of rounding_words.h. */
void rounding_part_rows(const RoundingRows *rows, RoundingPart part);

/* The bytes of both. */
void rounding_pixel_row(const RoundingRows *rows);

#endif
