/* Slips of step 1, the ray through the pixel, and of step 2. */
#include "grade/slip.h"

#include <stddef.h>

static double fraction(int pixel, int sub_pixel, double offset, int grid, int pixels)
{
    return (pixel + (sub_pixel + offset) / grid) / pixels;
}

static ScreenPoint corner(const View *view, const Event *sample)
{
    return (ScreenPoint){
        (fraction(sample->as.sample.column, sample->as.sample.i, 0, view->grid, view->columns) - 0.5) * view->width,
        (0.5 - fraction(sample->as.sample.row, sample->as.sample.j, 0, view->grid, view->rows)) * view->height};
}

static ScreenPoint to_the_last(const View *view, const Event *sample)
{
    int columns = view->columns > 1 ? view->columns - 1 : 1, rows = view->rows > 1 ? view->rows - 1 : 1;
    return (ScreenPoint){((double)sample->as.sample.column / columns - 0.5) * view->width,
                         (0.5 - (double)sample->as.sample.row / rows) * view->height};
}

static ScreenPoint centre(const View *view, const Event *sample)
{
    return view_screen_point(view, sample->as.sample.column, sample->as.sample.row, sample->as.sample.i,
                             sample->as.sample.j);
}

static ScreenPoint upside_down(const View *view, const Event *sample)
{
    ScreenPoint at = centre(view, sample);
    return (ScreenPoint){at.x, -at.y};
}

static ScreenPoint mirrored(const View *view, const Event *sample)
{
    ScreenPoint at = centre(view, sample);
    return (ScreenPoint){-at.x, at.y};
}

static ScreenPoint transposed(const View *view, const Event *sample)
{
    return (ScreenPoint){
        (fraction(sample->as.sample.row, sample->as.sample.j, 0.5, view->grid, view->columns) - 0.5) * view->width,
        (0.5 - fraction(sample->as.sample.column, sample->as.sample.i, 0.5, view->grid, view->rows)) * view->height};
}

static View without_aspect(const Scene *scene)
{
    View view = view_of(scene);
    view.height = view.width;
    return view;
}

static View square_pixels(const Scene *scene)
{
    View view = view_of(scene);
    view.height = view.width * view.rows / view.columns;
    return view;
}

static View wide_by_rows(const Scene *scene)
{
    View view = view_of(scene);
    view.height = view.width * view.columns / view.rows;
    return view;
}

static View widened(const Scene *scene, double factor)
{
    View view = view_of(scene);
    view.width *= factor;
    view.height *= factor;
    return view;
}

static View half_width(const Scene *scene)
{
    return widened(scene, 0.5);
}

static View double_width(const Scene *scene)
{
    return widened(scene, 2);
}

static View at_distance_one(const Scene *scene)
{
    View view = view_of(scene);
    view.forward = vec3_unit(view.forward);
    return view;
}

static View look_at_not_unit(const Scene *scene)
{
    View view = view_of(scene);
    Vec3 way = vec3_sub(scene->camera.look_at, scene->camera.position);
    view.forward = vec3_scale(scene->screen.distance, way);
    view.up = vec3_cross(view.right, way);
    return view;
}

static View up_as_given(const Scene *scene)
{
    View view = view_of(scene);
    view.up = vec3_unit(scene->camera.up); /* the reader has scaled it */
    return view;
}

static View right_not_unit(const Scene *scene)
{
    View view = view_of(scene);
    Vec3 forward = vec3_unit(view.forward);
    view.right = vec3_cross(forward, vec3_unit(scene->camera.up));
    view.up = vec3_cross(view.right, forward);
    return view;
}

static View eye_at_origin(const Scene *scene)
{
    View view = view_of(scene);
    view.eye = vec3_negate(scene->centre); /* the file's origin, as seen from the scene's centre */
    return view;
}

static Vec3 unit_direction(const View *view, ScreenPoint at)
{
    Vec3 q = vec3_add(vec3_add(view->forward, vec3_scale(at.x, view->right)), vec3_scale(at.y, view->up));
    return vec3_unit(q);
}

static Vec3 backwards(const View *view, ScreenPoint at)
{
    Vec3 q = vec3_add(vec3_add(view->forward, vec3_scale(at.x, view->right)), vec3_scale(at.y, view->up));
    return vec3_negate(q);
}

static ScreenPoint centre_of_pixel(const View *view, const Event *sample)
{
    View whole = *view;
    whole.grid = 1;
    return view_screen_point(&whole, sample->as.sample.column, sample->as.sample.row, 0, 0);
}

#define READ "algorithm.md#1-camera-and-screen"

const Slip slip_camera[] = {
    {"pixel-corner", "The ray goes through the corner of the pixel, not through its centre.",
     "x = ((column + 0.5)/columns - 0.5) width", "x = (column/columns - 0.5) width", READ,
     .steps = {.screen_point = corner}},
    {"pixels-less-one", "The pixels are counted as if the first and the last one lay on the rim of the screen.",
     "x = ((column + 0.5)/columns - 0.5) width", "x = (column/(columns - 1) - 0.5) width", READ,
     .steps = {.screen_point = to_the_last}},
    {"upside-down", "Rows are counted from below: the picture is upside down.", "y = (0.5 - (row + 0.5)/rows) height",
     "y = ((row + 0.5)/rows - 0.5) height", READ, .steps = {.screen_point = upside_down}},
    {"mirror-image", "Left and right are exchanged.", "r = unit(f x up)", "r = unit(up x f)", READ,
     .steps = {.screen_point = mirrored}},
    {"column-for-row", "Column and row are exchanged.", "x from the column, y from the row",
     "x from the row, y from the column", READ, .steps = {.screen_point = transposed}},
    {"aspect-forgotten", "The screen is as high as it is wide: the aspect ratio is forgotten.",
     "y = (0.5 - (row + 0.5)/rows) height", "y = (0.5 - (row + 0.5)/rows) width", READ,
     .steps = {.view = without_aspect}},
    {"aspect-inverted", "The aspect ratio is upside down.", "height = width rows/columns",
     "height = width columns/rows", READ, .steps = {.view = wide_by_rows}},
    {"height-not-read", "The scene's own height of the screen is not read.", "height as the scene gives it",
     "height = width rows/columns", READ, .steps = {.view = square_pixels}},
    {"view-halved", "The screen is half as wide: the whole width is taken for half of it.",
     "x = ((column + 0.5)/columns - 0.5) width", "x = ((column + 0.5)/columns - 0.5) width/2", READ,
     .steps = {.view = half_width}},
    {"view-doubled", "The screen is twice as wide: half the width is taken for all of it.",
     "x = ((column + 0.5)/columns - 0.5) width", "x = (2 (column + 0.5)/columns - 1) width", READ,
     .steps = {.view = double_width}},
    {"distance-forgotten", "The screen stands at distance 1, whatever the scene says.",
     "Q = C + distance f + x r + y u", "Q = C + f + x r + y u", READ, .steps = {.view = at_distance_one}},
    {"forward-not-unit", "The forward direction is not made a unit vector.", "f = unit(look_at - position)",
     "f = look_at - position", READ, .steps = {.view = look_at_not_unit}},
    {"up-as-given", "The scene's `up` is taken as it is, and not made perpendicular to the view.", "u = r x f",
     "u = up", READ, .steps = {.view = up_as_given}},
    {"right-not-unit", "The direction to the right is not made a unit vector.", "r = unit(f x up)", "r = f x up", READ,
     .steps = {.view = right_not_unit}},
    {"camera-at-origin", "The rays start at the origin, not at the camera.", "O = C", "O = (0, 0, 0)", READ,
     .steps = {.view = eye_at_origin}},
    {"direction-unit", "R is made a unit vector, so that t is a distance; in the text t = 1 is the screen.",
     "R = Q - C", "R = unit(Q - C)", READ, .steps = {.direction = unit_direction}},
    {"direction-backwards", "The ray goes away from the screen.", "R = Q - C", "R = C - Q", READ,
     .steps = {.direction = backwards}},
    {"one-sample", "Each pixel has one ray, where the scene asks for several.", "grid x grid rays",
     "one ray through the centre", "algorithm.md#10-colour", .steps = {.screen_point = centre_of_pixel}},
    {0},
};
