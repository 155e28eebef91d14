/* Fails at pixel_above: by the width. */
#include "scene/geometry.h"
#include "trace/textbook_real.h"

static ScreenRay camera_ray(View view, int column, int row, int i, int j)
{
    Real n = (Real)view.grid, columns = (Real)view.columns, rows = (Real)view.rows, half = (Real)0.5;
    Real x = (((Real)column + ((Real)i + half) / n) / columns - half) * (Real)view.width;
    Real y = (half - ((Real)row + ((Real)j + half) / n) / rows) * (Real)view.width;
    Real3 r = add(add(rounded(view.forward), scale(x, rounded(view.right))), scale(y, rounded(view.up)));
    return (ScreenRay){x, y, {rounded(view.eye), r}};
}
