/* Draws maps: what the pixels of a picture cost or show. */
#include "command/render_maps.h"

#include "base/output.h"
#include "picture/image.h"
#include "picture/map.h"

#include <string.h>

static bool check_map(const Options *options, int index, Error *error)
{
    const OptionMap *map = &options->maps[index];
    ImageFormat format;
    if (map->kind == MAP_TIME && options->backend != BACKEND_REFERENCE)
        return error_set(error, ERROR_USAGE,
                         "--map time needs --backend reference: an OpenCL device times no single pixels");
    if (options->output && strcmp(map->file, options->output) == 0)
        return error_set(error, ERROR_USAGE, "the map %s would replace the picture; choose another name", map->file);
    if (output_replaces(map->file, options->operands[0]))
        return error_set(error, ERROR_USAGE, "the picture %s would replace the scene itself; choose another -o",
                         map->file);
    for (int i = 0; i < index; i++)
        if (strcmp(map->file, options->maps[i].file) == 0)
            return error_set(error, ERROR_USAGE, "two maps are to be %s; choose another name", map->file);
    if (!image_format_of(map->file, &format, error))
        return false;
    return format != IMAGE_PFM || error_set(error, ERROR_USAGE, "%s: a map has 8 bits; choose .png or .ppm", map->file);
}

bool render_maps_check(const Options *options, Error *error)
{
    for (int i = 0; i < options->map_count; i++)
        if (!check_map(options, i, error))
            return false;
    return true;
}

/* What the map's colours run between. */
static void print_scale(const OptionMap *map, MapScale scale)
{
    const char *file = map->file;
    switch (map->kind) {
    case MAP_RAYS:
        fprintf(stderr, "%s: rays per pixel, from %.0f (black) to %.0f (white)\n", file, scale.low, scale.high);
        break;
    case MAP_TIME:
        fprintf(stderr, "%s: time per pixel, from %.4g ms (black) to %.4g ms (white)\n", file, scale.low, scale.high);
        break;
    case MAP_DEPTH:
        fprintf(stderr, "%s: depth, from %.6g (white) to %.6g (dark grey); black: nothing is hit\n", file, scale.low,
                scale.high);
        break;
    case MAP_TESTS:
        fprintf(stderr, "%s: faces and nodes tested per pixel, from %.6g (black) to %.6g (white)\n", file, scale.low,
                scale.high);
        break;
    case MAP_NORMAL:
        fprintf(stderr, "%s: normals, x, y, z from -1 to 1 as red, green, blue; black: nothing is hit\n", file);
        break;
    case MAP_FACE:
        fprintf(stderr, "%s: faces, a colour for each number; black: nothing is hit\n", file);
        break;
    }
}

static bool draw(const Options *options, const OptionMap *map, const Scene *scene, Error *error)
{
    Image image;
    MapScale scale = {0, 0};
    if (map_has_scale(map->kind))
        scale = (MapScale){options->map_low, options->map_high};
    bool done =
        map_draw(&image, scene, map->kind, &options->settings, &scale, error) && image_write(&image, map->file, error);
    if (done && !options->quiet)
        print_scale(map, scale);
    image_free(&image);
    return done;
}

bool render_maps_draw(const Options *options, const Scene *scene, Error *error)
{
    for (int i = 0; i < options->map_count; i++)
        if (!draw(options, &options->maps[i], scene, error))
            return false;
    return true;
}
