/* A mark in a picture: a cross-hair around a pixel, and its neighbourhood magnified in the corner that is farthest. */
#ifndef RECTRAY_MARK_H
#define RECTRAY_MARK_H

#include "picture/image.h"

/* Draws the mark. The pixel itself and its eight neighbours stay as they are. A picture that is too small for it gets
 * no magnified part. */
void mark_draw(Image *image, int column, int row);

#endif
