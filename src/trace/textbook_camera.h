/* Step 1 of the textbook tracer: the ray through a pixel. */
#ifndef RECTRAY_TEXTBOOK_CAMERA_H
#define RECTRAY_TEXTBOOK_CAMERA_H

#include "scene/geometry.h"
#include "trace/textbook_real.h"

/* The ray from the camera C through sub-pixel (i, j) of a pixel: R = Q - C. Row 0 is at the top. */
static ScreenRay camera_ray(View view, int column, int row, int i, int j)
{
    Real n = (Real)view.grid, columns = (Real)view.columns, rows = (Real)view.rows, half = (Real)0.5;
    Real x = (((Real)column + ((Real)i + half) / n) / columns - half) * (Real)view.width;
    Real y = (half - ((Real)row + ((Real)j + half) / n) / rows) * (Real)view.height;
    Real3 r = add(add(rounded(view.forward), scale(x, rounded(view.right))), scale(y, rounded(view.up)));
    return (ScreenRay){x, y, {rounded(view.eye), r}};
}

#endif
