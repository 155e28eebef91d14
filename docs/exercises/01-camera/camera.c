/* Exercise 1: the ray from the camera through a sample of a pixel. The README beside this file tells the task.
 *
 * What you may use, all of it short, in src/trace/textbook_real.h:
 *     Real                                     a number, a double here
 *     Real3                                    a point or a vector, with .x, .y and .z
 *     RealRay                                  a ray from the point .o in the direction .r
 *     ScreenRay                                what you give back: .x and .y on the screen, and the .ray through there
 *     add(a, b), subtract(a, b), scale(s, a)   a + b, a - b, s a
 *     rounded(a)                               a vector of the view as a Real3: rounded(view.right)
 *
 * The view has
 *     eye                   C, where the camera is
 *     forward               the way from the camera to the middle of the screen
 *     right, up             unit vectors along the rows of the screen and up its columns
 *     width, height         of the screen
 *     columns, rows         of the picture
 *     grid                  n: a pixel has n x n samples
 */
#include "scene/geometry.h"
#include "trace/textbook_real.h"

/* The ray through sample (i, j) of the pixel in that column and row.
 *
 * Column 0 is on the left, row 0 at the top. Cut the pixel into n x n equal parts. Part (i, j) is in column i and row j
 * of them, counted from 0 at the top left, too. The ray goes through the middle of that part.
 * x is the distance of that point from the middle of the screen to the right, y upwards.
 * The ray starts at C. Its direction is R = Q - C, where Q is the point of the screen: t = 1 is on the screen. */
static ScreenRay camera_ray(View view, int column, int row, int i, int j)
{
    ScreenRay sample = {0};
    /* Your lines. */
    return sample;
}
