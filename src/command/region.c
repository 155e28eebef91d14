#include "command/region.h"

static bool check_region(const Options *options, const Scene *scene, Error *error)
{
    const Region *r = &options->settings.region;
    int columns = scene->screen.columns - r->column, rows = scene->screen.rows - r->row; /* from its corner on */
    if (r->columns <= columns && r->rows <= rows)
        return true;
    if (columns < 1 || rows < 1)
        return error_set(error, ERROR_USAGE,
                         "--region begins at %d,%d, outside the picture, whose pixels are 0,0 to %d,%d", r->column,
                         r->row, scene->screen.columns - 1, scene->screen.rows - 1);
    return error_set(error, ERROR_USAGE,
                     "--region reaches beyond the picture of %d x %d pixels; from %d,%d on there are %dx%d",
                     scene->screen.columns, scene->screen.rows, r->column, r->row, columns, rows);
}

static bool check_mark(const Options *options, const Scene *scene, Error *error)
{
    const Region r = render_region(&options->settings, scene);
    int column = options->mark_column - r.column, row = options->mark_row - r.row;
    if (!options->mark_given || (column >= 0 && row >= 0 && column < r.columns && row < r.rows))
        return true;
    return error_set(error, ERROR_USAGE, "--mark %d,%d is outside the %s, whose pixels are %d,%d to %d,%d",
                     options->mark_column, options->mark_row,
                     options->settings.region.columns > 0 ? "region" : "picture", r.column, r.row,
                     r.column + r.columns - 1, r.row + r.rows - 1);
}

bool region_check(const Options *options, const Scene *scene, Error *error)
{
    return check_region(options, scene, error) && check_mark(options, scene, error);
}
