/* How the values of single options are read: words, and what is no plain word or number. */
#include "command/option_values.h"

#include "reader/scene_track.h"
#include "scene/scene.h"
#include "trace/skip.h"
#include <ctype.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* --- Words --- */

const char *const option_progress_modes[] = {
    [PROGRESS_AUTO] = "auto", [PROGRESS_ALWAYS] = "always", [PROGRESS_NEVER] = "never", NULL};

const char *const option_colour_choices[] = {
    [COLOUR_AUTO] = "auto", [COLOUR_ALWAYS] = "always", [COLOUR_NEVER] = "never", NULL};

static const char *const map_kinds[] = {[MAP_RAYS] = "rays",
                                        [MAP_TIME] = "time",
                                        [MAP_DEPTH] = "depth",
                                        [MAP_NORMAL] = "normal",
                                        [MAP_FACE] = "face",
                                        [MAP_TESTS] = "tests",
                                        NULL};

const char *const option_help_formats[] = {
    [HELP_TEXT] = "text", [HELP_MAN] = "man", [HELP_BASH] = "bash", [HELP_ZSH] = "zsh", [HELP_FISH] = "fish", NULL};

const char *const option_stats_formats[] = {"text", "json", NULL}; /* of STATS_TEXT and what comes after it */
const char *const option_depth_words[] = {"8", "16", NULL};
const char *const option_lane_words[] = {"1", "4", "8", "16", NULL};

/* --- Functions of options whose value is no plain word or number --- */

bool option_set_precision(Options *o, const char *value)
{
    int index = option_word(value, render_precisions);
    o->settings.precision = (Precision)index;
    o->precision_given = true;
    return index >= 0;
}

bool option_set_shift(Options *o, const char *value)
{
    char *end;
    double shift = strtod(value, &end);
    o->settings.shift = (float)shift;
    o->shift_given = true;
    return (isdigit((unsigned char)value[0]) || value[0] == '.') && *end == '\0' && shift <= SCENE_MAX_SHIFT;
}

/* A number that begins with a digit, from 0 on; *end is where it ends. */
static bool read_positive(const char *text, char **end, double *value)
{
    *end = NULL;
    if (!isdigit((unsigned char)text[0]) && text[0] != '.')
        return false;
    *value = strtod(text, end);
    return *end != text && *value <= 1e6;
}

bool option_set_tolerance(Options *o, const char *value)
{
    char *end;
    o->tolerance_given = true;
    if (!read_positive(value, &end, &o->tolerance_absolute))
        return false;
    o->tolerance_relative = 0;
    return *end == '\0' || (*end == ',' && read_positive(end + 1, &end, &o->tolerance_relative) && *end == '\0');
}

/* The number of the skip that the first `length` characters name; SKIP_KINDS where they name none. */
static int skip_number(const char *name, size_t length)
{
    int skip = 0;
    while (skip < SKIP_KINDS &&
           (strncmp(skip_texts[skip].name, name, length) != 0 || skip_texts[skip].name[length] != '\0'))
        skip++;
    return skip;
}

/* "NAME", "NAME,NAME" or "all". */
bool option_set_no_skip(Options *o, const char *value)
{
    if (strcmp(value, "all") == 0) {
        o->settings.no_skip = (1u << SKIP_KINDS) - 1;
        return true;
    }
    for (const char *name = value;; name++) {
        size_t length = strcspn(name, ",");
        int skip = skip_number(name, length);
        if (skip == SKIP_KINDS)
            return false;
        o->settings.no_skip |= 1u << skip;
        name += length;
        if (*name == '\0')
            return true;
    }
}

bool option_set_stats(Options *o, const char *value)
{
    int index = value ? option_word(value, option_stats_formats) : 0;
    o->stats = (StatsFormat)(STATS_TEXT + index);
    return index >= 0;
}

bool option_set_size(Options *o, const char *value)
{
    const char *x = option_read_int(value, 1, SCENE_MAX_PIXELS, 'x', &o->columns);
    return x && option_read_int(x + 1, 1, SCENE_MAX_PIXELS, '\0', &o->rows);
}

/* "COLUMN,ROW": two whole numbers below `limit`. */
static bool read_pair(const char *value, int limit, int *column, int *row)
{
    const char *comma = option_read_int(value, 0, limit - 1, ',', column);
    return comma && option_read_int(comma + 1, 0, limit - 1, '\0', row);
}

bool option_set_pixel(Options *o, const char *value)
{
    o->pixel_given = true;
    if (!read_pair(value, SCENE_MAX_PIXELS, &o->pixel_column, &o->pixel_row) || o->pixel_count == TRACE_PIXELS_MAX)
        return false;
    o->pixels[o->pixel_count++] = (TracePixel){o->pixel_column, o->pixel_row};
    return true;
}

/* "COLUMN,ROW,COLUMNSxROWS" */
bool option_set_region(Options *o, const char *value)
{
    Region *region = &o->settings.region;
    const char *at = option_read_int(value, 0, SCENE_MAX_PIXELS - 1, ',', &region->column);
    at = at ? option_read_int(at + 1, 0, SCENE_MAX_PIXELS - 1, ',', &region->row) : NULL;
    at = at ? option_read_int(at + 1, 1, SCENE_MAX_PIXELS, 'x', &region->columns) : NULL;
    return at && option_read_int(at + 1, 1, SCENE_MAX_PIXELS, '\0', &region->rows);
}

/* "K/N" */
bool option_set_part(Options *o, const char *value)
{
    const char *slash = option_read_int(value, 1, MAX_PARTS, '/', &o->part.number);
    return slash && option_read_int(slash + 1, 1, MAX_PARTS, '\0', &o->part.count) && o->part.number <= o->part.count;
}

bool option_set_mark(Options *o, const char *value)
{
    o->mark_given = true;
    return read_pair(value, SCENE_MAX_PIXELS, &o->mark_column, &o->mark_row);
}

bool option_set_sample(Options *o, const char *value)
{
    return read_pair(value, SCENE_MAX_GRID, &o->sample_i, &o->sample_j);
}

bool option_set_grid(Options *o, const char *value)
{
    o->sampling = SAMPLING_UNIFORM;
    return option_read_int(value, 1, SCENE_MAX_GRID, '\0', &o->grid);
}

/* "uniform" or "adaptive", and perhaps ":N". */
bool option_set_sampling(Options *o, const char *value)
{
    static const char *const words[] = {"uniform", "adaptive"};
    for (int i = 0; i < 2; i++) {
        size_t length = strlen(words[i]);
        if (strncmp(value, words[i], length) != 0)
            continue;
        o->sampling = i == 0 ? SAMPLING_UNIFORM : SAMPLING_ADAPTIVE;
        o->grid = i == 0 ? 0 : SCENE_ADAPTIVE_GRID;
        return value[length] == '\0' ||
               (value[length] == ':' && option_read_int(value + length + 1, 1, SCENE_MAX_GRID, '\0', &o->grid));
    }
    return false;
}

bool option_set_map(Options *o, const char *value)
{
    int index = option_word(value, map_kinds);
    const char *file = o->second_value;
    if (index < 0 || !file || file[0] == '-' || file[0] == '\0' || o->map_count == MAPS_MAX)
        return false;
    o->maps[o->map_count++] = (OptionMap){(MapKind)index, file};
    return true;
}

/* "LOW:HIGH". */
bool option_set_map_scale(Options *o, const char *value)
{
    char *end;
    if (!isdigit((unsigned char)value[0]))
        return false;
    o->map_low = strtod(value, &end);
    if (*end != ':' || !isdigit((unsigned char)end[1]))
        return false;
    o->map_high = strtod(end + 1, &end);
    return *end == '\0' && o->map_low > 0 && o->map_high > o->map_low && o->map_high < 1e30;
}

bool option_set_lanes(Options *o, const char *value)
{
    static const int lanes[] = {1, 4, 8, 16};
    int index = option_word(value, option_lane_words);
    if (index >= 0)
        o->settings.lanes = lanes[index];
    return index >= 0;
}

/* --- Changes of the scene --- */

static bool add_edit(Options *o, const char *option, const char *value)
{
    if (o->edit_count == EDITS_MAX)
        return false;
    o->edits[o->edit_count++] = (OptionEdit){option, value};
    return true;
}

/* "X,Y,Z": three numbers as JSON has them, which the scene's reader judges. */
static bool is_triple(const char *value)
{
    int commas = 0;
    for (const char *c = value; *c; c++)
        commas += *c == ',';
    return commas == 2 && value[strspn(value, "+-.,0123456789eE")] == '\0' && !strstr(value, ",,");
}

bool option_set_camera(Options *o, const char *value)
{
    return is_triple(value) && add_edit(o, "camera", value);
}

bool option_set_look_at(Options *o, const char *value)
{
    return is_triple(value) && add_edit(o, "look-at", value);
}

bool option_set_up(Options *o, const char *value)
{
    return is_triple(value) && add_edit(o, "up", value);
}

/* "K=X,Y,Z" */
bool option_set_light(Options *o, const char *value)
{
    int light;
    const char *equals = option_read_int(value, 0, 999999, '=', &light);
    return equals && is_triple(equals + 1) && add_edit(o, "light", value);
}

bool option_set_value(Options *o, const char *value)
{
    return value[0] != '=' && strchr(value, '=') && add_edit(o, "set", value);
}

/* --- Frames --- */

bool option_set_frame(Options *o, const char *value)
{
    o->frame_given = true;
    return option_read_int(value, 0, TRACK_MAX_FRAMES - 1, '\0', &o->frame);
}

/* "A-B" or "all". */
bool option_set_frames(Options *o, const char *value)
{
    o->frames_given = true;
    o->first_frame = 0;
    o->last_frame = -1;
    if (strcmp(value, "all") == 0)
        return true;
    const char *dash = option_read_int(value, 0, TRACK_MAX_FRAMES - 1, '-', &o->first_frame);
    return dash && option_read_int(dash + 1, 0, TRACK_MAX_FRAMES - 1, '\0', &o->last_frame) &&
           o->first_frame <= o->last_frame;
}
