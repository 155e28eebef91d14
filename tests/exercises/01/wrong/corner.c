/* Fails at middle_of_the_picture: through the corner. */
#include "scene/geometry.h"
#include "trace/textbook_real.h"

static ScreenRay camera_ray(View view, int column, int row, int i, int j)
{
    Real n = (Real)view.grid, columns = (Real)view.columns, rows = (Real)view.rows, half = 0;
    Real x = (((Real)column + ((Real)i + half) / n) / columns - 0.5) * (Real)view.width;
    Real y = (0.5 - ((Real)row + ((Real)j + half) / n) / rows) * (Real)view.height;
    Real3 r = add(add(rounded(view.forward), scale(x, rounded(view.right))), scale(y, rounded(view.up)));
    return (ScreenRay){x, y, {rounded(view.eye), r}};
}
