/* Every option of every command. To add one: its field in Options (option.h), and a line in the table with the commands
 * that take it and the way its value is read. */
#include "command/option_table.h"

#include "scene/scene.h"
#include "trace/skip.h"

#include <ctype.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* --- Words --- */

static const char *const progress_modes[] = {
    [PROGRESS_AUTO] = "auto", [PROGRESS_ALWAYS] = "always", [PROGRESS_NEVER] = "never", NULL};

static const char *const colour_choices[] = {
    [COLOUR_AUTO] = "auto", [COLOUR_ALWAYS] = "always", [COLOUR_NEVER] = "never", NULL};

static const char *const map_kinds[] = {[MAP_RAYS] = "rays",
                                        [MAP_TIME] = "time",
                                        [MAP_DEPTH] = "depth",
                                        [MAP_NORMAL] = "normal",
                                        [MAP_FACE] = "face",
                                        [MAP_TESTS] = "tests",
                                        NULL};

static const char *const help_formats[] = {
    [HELP_TEXT] = "text", [HELP_MAN] = "man", [HELP_BASH] = "bash", [HELP_ZSH] = "zsh", [HELP_FISH] = "fish", NULL};

static const char *const stats_formats[] = {"text", "json", NULL}; /* of STATS_TEXT and what comes after it */
static const char *const depth_words[] = {"8", "16", NULL};
static const char *const lane_words[] = {"1", "4", "8", "16", NULL};

/* --- Functions of options whose value is no plain word or number --- */

static bool set_precision(Options *o, const char *value)
{
    int index = option_word(value, render_precisions);
    o->settings.precision = (Precision)index;
    o->precision_given = true;
    return index >= 0;
}

static bool set_shift(Options *o, const char *value)
{
    char *end;
    double shift = strtod(value, &end);
    o->settings.shift = (float)shift;
    o->shift_given = true;
    return (isdigit((unsigned char)value[0]) || value[0] == '.') && *end == '\0' && shift <= SCENE_MAX_SHIFT;
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
static bool set_no_skip(Options *o, const char *value)
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

static bool set_stats(Options *o, const char *value)
{
    int index = value ? option_word(value, stats_formats) : 0;
    o->stats = (StatsFormat)(STATS_TEXT + index);
    return index >= 0;
}

static bool set_size(Options *o, const char *value)
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

static bool set_pixel(Options *o, const char *value)
{
    o->pixel_given = true;
    if (!read_pair(value, SCENE_MAX_PIXELS, &o->pixel_column, &o->pixel_row) || o->pixel_count == TRACE_PIXELS_MAX)
        return false;
    o->pixels[o->pixel_count++] = (TracePixel){o->pixel_column, o->pixel_row};
    return true;
}

static bool set_mark(Options *o, const char *value)
{
    o->mark_given = true;
    return read_pair(value, SCENE_MAX_PIXELS, &o->mark_column, &o->mark_row);
}

static bool set_sample(Options *o, const char *value)
{
    return read_pair(value, SCENE_MAX_GRID, &o->sample_i, &o->sample_j);
}

static bool set_grid(Options *o, const char *value)
{
    o->sampling = SAMPLING_UNIFORM;
    return option_read_int(value, 1, SCENE_MAX_GRID, '\0', &o->grid);
}

/* "uniform" or "adaptive", and perhaps ":N". */
static bool set_sampling(Options *o, const char *value)
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

static bool set_map(Options *o, const char *value)
{
    int index = option_word(value, map_kinds);
    const char *file = o->second_value;
    if (index < 0 || !file || file[0] == '-' || file[0] == '\0' || o->map_count == MAPS_MAX)
        return false;
    o->maps[o->map_count++] = (OptionMap){(MapKind)index, file};
    return true;
}

/* "LOW:HIGH". */
static bool set_map_scale(Options *o, const char *value)
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

static bool set_lanes(Options *o, const char *value)
{
    static const int lanes[] = {1, 4, 8, 16};
    int index = option_word(value, lane_words);
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

static bool set_camera(Options *o, const char *value)
{
    return is_triple(value) && add_edit(o, "camera", value);
}

static bool set_look_at(Options *o, const char *value)
{
    return is_triple(value) && add_edit(o, "look-at", value);
}

static bool set_up(Options *o, const char *value)
{
    return is_triple(value) && add_edit(o, "up", value);
}

/* "K=X,Y,Z" */
static bool set_light(Options *o, const char *value)
{
    int light;
    const char *equals = option_read_int(value, 0, 999999, '=', &light);
    return equals && is_triple(equals + 1) && add_edit(o, "light", value);
}

static bool set_value(Options *o, const char *value)
{
    return value[0] != '=' && strchr(value, '=') && add_edit(o, "set", value);
}

/* --- The table, in the order of --help --- */

#define FLAG(name) .kind = OPTION_FLAG, .field = (int)offsetof(Options, name)
#define TEXT(name) .kind = OPTION_TEXT, .field = (int)offsetof(Options, name)
#define NUMBER(name, least, most) \
    .kind = OPTION_NUMBER, .field = (int)offsetof(Options, name), .low = (least), .high = (most)
#define WORD(name, list) .kind = OPTION_WORD, .field = (int)offsetof(Options, name), .words = (list)
#define OWN(function) .kind = OPTION_OWN, .set = (function)

/* clang-format off */
const Option option_table[] = {
    {"output", 'o', "FILE", "render trace explore compare generate bench tree",
     "write the output there; - is standard output",
     TEXT(output), .expects = "the name of a file, or - for standard output"},
    {"size", 's', "COLUMNSxROWS", "render trace explore bench", "pixels of the picture, instead of the scene's",
     OWN(set_size), .expects = "two whole numbers from 1 to 16384, such as 640x480"},
    {"grid", 'g', "N", "render trace explore bench", "N x N rays per pixel, instead of the scene's",
     OWN(set_grid), .expects = "a whole number from 1 to 16"},
    {"sampling", 0, "HOW", "render trace", "uniform:N as --grid; adaptive[:N]: 16 rays (N = 8) where needed",
     OWN(set_sampling), .expects = "uniform, uniform:N, adaptive or adaptive:N, N from 1 to 16"},
    {"format", 0, "NAME", "render", "png, ppm or pfm (linear colours), whatever the file's ending",
     WORD(picture_format, image_format_words)},
    {"depth", 0, "N", "render", "8 (default) or 16 bits a channel (png, ppm)", WORD(depth, depth_words)},
    {"map", 0, "KIND FILE", "render", "what the pixels cost or show: rays, time, tests, depth, normal or face",
     OWN(set_map), .expects = "rays, time, depth, normal, face or tests, and the name of a file"},
    {"mark", 0, "COLUMN,ROW", "render", "mark a pixel, show what is around it larger, and print the bytes there",
     OWN(set_mark), .expects = "two whole numbers, such as 320,240"},
    {"map-scale", 0, "LOW:HIGH", "render", "the numbers that the map shows black and white, for maps side by side",
     OWN(set_map_scale), .expects = "two numbers above 0, the lower one first, such as 1:2000"},
    {"stage", 0, NULL, "render", "of a model: print the scene that is made for it, and render nothing", FLAG(stage)},
    {"watch", 0, NULL, "render", "render again whenever the scene, a model or a kernel file changes", FLAG(watch)},
    {"bounces", 0, "N", "render trace", "at most N reflected rays in a row, instead of the scene's",
     NUMBER(bounces, 0, SCENE_MAX_BOUNCES)},
    {"camera", 0, "X,Y,Z", "render trace cast check tree", "where the camera is, instead of the scene's",
     OWN(set_camera), .expects = "three numbers, such as 0,1.5,4"},
    {"look-at", 0, "X,Y,Z", "render trace cast check tree", "the point that it looks at", OWN(set_look_at),
     .expects = "three numbers, such as 0,1.5,4"},
    {"up", 0, "X,Y,Z", "render trace cast check tree", "what is upwards in the picture", OWN(set_up),
     .expects = "three numbers, such as 0,0,1"},
    {"light", 0, "K=X,Y,Z", "render trace cast check tree", "where light K is, counted from 0", OWN(set_light),
     .expects = "a light's number and three numbers, such as 0=1,2,3"},
    {"set", 0, "PATH=VALUE", "render trace cast check tree", "any value of the file, such as lights[0].diffuse[2]=1",
     OWN(set_value), .expects = "a path and a value, such as materials.pink.reflection=0.5"},
    {"size", 0, "N", "generate", "menger: steps; city: boxes; grid: quads along a side. Must be given",
     NUMBER(scene_size, 1, 2000000)},
    {"seed", 0, "N", "generate", "another number, another scene of that kind (default 0)", NUMBER(seed, 0, 2147483647)},
    {"pixel", 0, "COLUMN,ROW", "trace", "a pixel to tell, up to 16 times; 0,0 is the one at the top left",
     OWN(set_pixel), .expects = "two whole numbers, such as 320,240"},
    {"pixel", 0, "COLUMN,ROW", "explore", "the pixel that is chosen first; 0,0 is the one at the top left",
     OWN(set_pixel), .expects = "two whole numbers, such as 320,240"},
    {"open", 0, NULL, "explore", "open the page, with xdg-open", FLAG(open)},
    {"diff", 0, NULL, "trace", "of several --pixel: tell only what differs from the first", FLAG(diff)},
    {"face", 0, "NAME/K", "trace", "look for a pixel that shows this face, or any of an object", TEXT(face),
     .expects = "an object's name, or its name and a face's number, such as floor/5"},
    {"light-blocked", 0, "K", "trace", "look for a pixel where something is before light K",
     NUMBER(blocked_light, 0, 1000000)},
    {"mirror-depth", 0, "N", "trace", "look for a pixel whose path has N mirrors",
     NUMBER(mirrors, 1, SCENE_MAX_BOUNCES)},
    {"darkest", 0, NULL, "trace", "look for the darkest pixel, of those that are looked for", FLAG(darkest)},
    {"sample", 0, "I,J", "trace", "the sample to tell, of a pixel that has several (default 0,0)",
     OWN(set_sample), .expects = "two whole numbers from 0 to 15, such as 0,1"},
    {"format", 'f', "NAME", "trace", "text (default); json: every number; obj: for a 3D viewer; svg: a drawing",
     WORD(format, walkthrough_format_words)},
    {"summary", 0, NULL, "trace", "only the answer, in at most 20 lines (text, json)", FLAG(summary)},
    {"width", 0, "N", "trace", "columns of the text, 80 to 160 (default: the terminal's, else 100)",
     NUMBER(width, INK_LEAST_COLUMNS, INK_MOST_COLUMNS)},
    {"color", 0, "WHEN", "trace", "auto (default: on a terminal), always or never", WORD(colour, colour_choices)},
    {"no-pager", 0, NULL, "trace", "show a long text on a terminal without $PAGER", FLAG(no_pager)},
    {"verbose", 'v', NULL, "trace", "tell every face that was tested (text, json)", FLAG(verbose)},
    {"verbose", 'v', NULL, "check", "tell every place of each note", FLAG(verbose)},
    {"with-scene", 0, NULL, "trace", "write the scene's faces, too (obj)", FLAG(with_scene)},
    {"rays", 'r', "FILE", "cast", "read the rays there instead of from standard input",
     TEXT(rays), .expects = "the name of a file, or - for standard input"},
    {"geometry", 0, NULL, "check", "print every face as it is traced, exactly", FLAG(geometry)},
    {"tolerance", 0, "N", "compare", "accept pictures that differ by up to N of 255 (default 0)",
     NUMBER(tolerance, 0, 255)},
    {"heatmap", 0, "FILE", "compare", "draw where they differ, from black (equal) to white (255)",
     TEXT(heatmap), .expects = "the name of a file, or - for standard output"},
    {"ladder", 0, NULL, "bench", "measure the scenes that docs/performance.md stands on", FLAG(ladder)},
    {"folder", 0, "FOLDER", "bench", "keep scenes, data of plots and pictures there; it is made",
     TEXT(folder), .expects = "the name of a folder"},
    {"repeats", 0, "N", "bench", "pictures to take the median of (default 5)", NUMBER(repeats, 1, 99)},
    {"check", 0, NULL, "devices", "compile every kernel, render two scenes, compare with the reference",
     FLAG(check)},
    {"json", 0, NULL, "bench devices check", "print one JSON object instead of text", FLAG(json)},
    {"backend", 'b', "NAME", "render cast", "opencl (default), or reference: plain C in double",
     WORD(backend, render_backends)},
    {"device", 'd', "N", "render cast bench", "the OpenCL device, as `rectray devices` numbers them",
     NUMBER(settings.device, 0, 9999), .expects = "a number that `rectray devices` lists"},
    {"precision", 'p', "NAME", "render trace cast bench", "of kernel and textbook: float (default) or double",
     OWN(set_precision), .words = render_precisions},
    {"kernel", 'k', "NAME", "render bench", "packet (default), or plain: one ray per work-item, to be read",
     WORD(settings.kernel, render_kernels)},
    {"arithmetic", 0, "NAME", "render trace bench", "exact (default), or textbook: the taught formulas as they stand",
     WORD(settings.arithmetic, render_arithmetics)},
    {"shift", 0, "LENGTH", "render trace bench", "of points off their faces in textbook arithmetic (default 1e-5)",
     OWN(set_shift), .expects = "a number from 0 to 1e6, such as 1e-5"},
    {"accel", 'a', "NAME", "render trace cast bench tree", "auto (default), none, kdtree, bvh, lbvh: how to find faces",
     WORD(settings.accel, render_accels)},
    {"step", 0, "N", "tree", "show the first N nodes with the planes that were tried and their costs",
     NUMBER(steps, 1, 1000)},
    {"verbose", 'v', NULL, "tree", "with --step: every plane, not only the 8 cheapest across each axis", FLAG(verbose)},
    {"lanes", 0, "N", "render cast bench", "rays that an OpenCL work-item traces: 1, 4, 8 or 16",
     OWN(set_lanes), .words = lane_words},
    {"no-skip", 0, "NAMES", "render", "do work that the scene needs not: all, or names such as tree,mirrors",
     OWN(set_no_skip),
     .expects = "all, or names of \"skipped\" in --stats=json with commas between them, such as tree,mirrors"},
    {"threads", 't', "N", "render bench", "processors to use (default: all)", NUMBER(settings.threads, 1, 256)},
    {"stats", 0, "[=FORMAT]", "render cast", "tell what was done and how long it took: text or json",
     OWN(set_stats), .words = stats_formats},
    {"progress", 0, "WHEN", "render", "auto (default: on a terminal), always or never", WORD(progress, progress_modes)},
    {"strict", 0, NULL, "render trace explore cast check tree", "make errors of the notes on the scene", FLAG(strict)},
    {"export", 0, "FOLDER", "kernels", "write the files there; the folder is made", TEXT(export_folder),
     .expects = "the name of a folder"},
    {"as", 0, "FORMAT", "help", "text (default); man: a manual page; bash, zsh, fish: completion",
     WORD(help_format, help_formats)},
    {"quiet", 'q', NULL, "render trace explore cast check compare bench generate devices tree kernels",
     "no messages but errors", FLAG(quiet)},
    {"help", 'h', NULL, "", "show this help", FLAG(help)},
    {"version", 'V', NULL, "", "show the version", FLAG(version)},
    {0},
};
/* clang-format on */
