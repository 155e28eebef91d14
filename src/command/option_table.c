/* Every option of every command. To add one: a line in the table with the commands that take it, and the
 * function that sets its field in Options. Numbers are read strictly: digits, nothing before or after. */
#include "command/option_table.h"

#include "scene/scene.h"
#include "trace/skip.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

/* --- Values --- */

/* Reads a whole number in [low, high] that ends at the character `end`. Returns where it ended, or NULL. */
static const char *read_int(const char *text, int low, int high, char end, int *value)
{
    long number = 0;
    const char *at = text;
    for (; isdigit((unsigned char)*at); at++) {
        number = number * 10 + (*at - '0');
        if (number > high)
            return NULL;
    }
    if (at == text || *at != end || number < low)
        return NULL;
    *value = (int)number;
    return at;
}

/* The place of a word in a list that ends in NULL; -1 where it is not there. */
static int word_index(const char *word, const char *const *words)
{
    for (int i = 0; words[i]; i++)
        if (strcmp(words[i], word) == 0)
            return i;
    return -1;
}

static bool set_path(const char *value, const char **field)
{
    *field = value;
    return value[0] != '\0';
}

/* --- One function per option. After false the field may hold anything. --- */

static bool set_output(Options *o, const char *value)
{
    return set_path(value, &o->output);
}

static bool set_rays(Options *o, const char *value)
{
    return set_path(value, &o->rays);
}

static bool set_heatmap(Options *o, const char *value)
{
    return set_path(value, &o->heatmap);
}

static bool set_folder(Options *o, const char *value)
{
    return set_path(value, &o->folder);
}

static bool set_backend(Options *o, const char *value)
{
    static const char *const words[] = {"opencl", "reference", NULL};
    int index = word_index(value, words);
    o->backend = (Backend)index;
    return index >= 0;
}

static bool set_precision(Options *o, const char *value)
{
    static const char *const words[] = {"float", "double", NULL};
    int index = word_index(value, words);
    o->settings.precision = (Precision)index;
    o->precision_given = true;
    return index >= 0;
}

static bool set_accel(Options *o, const char *value)
{
    static const char *const words[] = {"auto", "none", "kdtree", "bvh", NULL};
    int index = word_index(value, words);
    o->settings.accel = (AccelKind)index;
    return index >= 0;
}

/* The number of the skip that the first `length` characters name; SKIP_KINDS where they name none. */
static int skip_number(const char *name, size_t length)
{
    int skip = 0;
    while (skip < SKIP_KINDS && (strncmp(skip_texts[skip].name, name, length) != 0 || skip_texts[skip].name[length] != '\0'))
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

static bool set_progress(Options *o, const char *value)
{
    static const char *const words[] = {"auto", "always", "never", NULL};
    int index = word_index(value, words);
    o->progress = (ProgressMode)index;
    return index >= 0;
}

static bool set_stats(Options *o, const char *value)
{
    static const char *const words[] = {"text", "json", NULL};
    int index = value ? word_index(value, words) : 0;
    o->stats = index == 0 ? STATS_TEXT : STATS_JSON;
    return index >= 0;
}

static bool set_size(Options *o, const char *value)
{
    const char *x = read_int(value, 1, SCENE_MAX_PIXELS, 'x', &o->columns);
    return x && read_int(x + 1, 1, SCENE_MAX_PIXELS, '\0', &o->rows);
}

/* "COLUMN,ROW": two whole numbers below `limit`. */
static bool read_pair(const char *value, int limit, int *column, int *row)
{
    const char *comma = read_int(value, 0, limit - 1, ',', column);
    return comma && read_int(comma + 1, 0, limit - 1, '\0', row);
}

static bool set_pixel(Options *o, const char *value)
{
    o->pixel_given = true;
    return read_pair(value, SCENE_MAX_PIXELS, &o->pixel_column, &o->pixel_row);
}

static bool set_sample(Options *o, const char *value)
{
    return read_pair(value, SCENE_MAX_GRID, &o->sample_i, &o->sample_j);
}

static bool set_format(Options *o, const char *value)
{
    static const char *const words[] = {"text", "json", "obj", "svg", NULL};
    int index = word_index(value, words);
    o->format = (WalkthroughFormat)index;
    return index >= 0;
}

static bool set_grid(Options *o, const char *value)
{
    o->sampling = SAMPLING_UNIFORM;
    return read_int(value, 1, SCENE_MAX_GRID, '\0', &o->grid);
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
               (value[length] == ':' && read_int(value + length + 1, 1, SCENE_MAX_GRID, '\0', &o->grid));
    }
    return false;
}

static bool set_map(Options *o, const char *value)
{
    static const char *const words[] = {"rays", "time", "depth", "normal", "face", NULL};
    int index = word_index(value, words);
    o->map = (MapKind)index;
    o->map_file = o->second_value;
    return index >= 0 && o->map_file && o->map_file[0] != '-' && o->map_file[0] != '\0';
}

static bool set_bounces(Options *o, const char *value)
{
    return read_int(value, 0, SCENE_MAX_BOUNCES, '\0', &o->bounces);
}

static bool set_threads(Options *o, const char *value)
{
    return read_int(value, 1, 256, '\0', &o->settings.threads);
}

static bool set_device(Options *o, const char *value)
{
    return read_int(value, 0, 9999, '\0', &o->settings.device);
}

static bool set_lanes(Options *o, const char *value)
{
    static const char *const words[] = {"1", "4", "8", "16", NULL};
    static const int lanes[] = {1, 4, 8, 16};
    int index = word_index(value, words);
    if (index >= 0)
        o->settings.lanes = lanes[index];
    return index >= 0;
}

static bool set_tolerance(Options *o, const char *value)
{
    int tolerance = 0;
    bool ok = read_int(value, 0, 255, '\0', &tolerance) != NULL;
    o->tolerance = tolerance;
    return ok;
}

static bool set_scene_size(Options *o, const char *value)
{
    return read_int(value, 1, 1000000, '\0', &o->scene_size);
}

static bool set_seed(Options *o, const char *value)
{
    return read_int(value, 0, 2147483647, '\0', &o->seed);
}

static bool set_verbose(Options *o, const char *value)
{
    (void)value;
    return o->verbose = true;
}

static bool set_with_scene(Options *o, const char *value)
{
    (void)value;
    return o->with_scene = true;
}

static bool set_repeats(Options *o, const char *value)
{
    return read_int(value, 1, 99, '\0', &o->repeats);
}

static bool set_ladder(Options *o, const char *value)
{
    (void)value;
    return o->ladder = true;
}

static bool set_json(Options *o, const char *value)
{
    (void)value;
    return o->json = true;
}

static bool set_geometry(Options *o, const char *value)
{
    (void)value;
    return o->geometry = true;
}

static bool set_quiet(Options *o, const char *value)
{
    (void)value;
    return o->quiet = true;
}

static bool set_help(Options *o, const char *value)
{
    (void)value;
    return o->help = true;
}

static bool set_version(Options *o, const char *value)
{
    (void)value;
    return o->version = true;
}

/* --- The table, in the order of --help --- */

const Option option_table[] = {
    {"output", 'o', "FILE", "render trace compare generate bench", set_output, "the name of a file, or - for standard output",
     "write the output there; - is standard output"},
    {"size", 's', "COLUMNSxROWS", "render trace bench", set_size, "two whole numbers from 1 to 16384, such as 640x480",
     "pixels of the picture, instead of the scene's"},
    {"grid", 'g', "N", "render trace bench", set_grid, "a whole number from 1 to 16",
     "N x N rays per pixel, instead of the scene's"},
    {"sampling", 0, "HOW", "render trace", set_sampling, "uniform, uniform:N, adaptive or adaptive:N, N from 1 to 16",
     "uniform:N as --grid; adaptive[:N]: 16 rays (N = 8) where needed"},
    {"map", 0, "KIND FILE", "render", set_map, "rays, time, depth, normal or face, and the name of a file",
     "draw what the pixels cost or show: rays, time, depth, normal or face"},
    {"bounces", 0, "N", "render trace", set_bounces, "a whole number from 0 to 64",
     "at most N reflected rays in a row, instead of the scene's"},
    {"size", 0, "N", "generate", set_scene_size, "a whole number from 1 to 1000000",
     "menger: steps; city: boxes; grid: quads along a side. Must be given"},
    {"seed", 0, "N", "generate", set_seed, "a whole number from 0 to 2147483647",
     "another number, another scene of that kind (default 0)"},
    {"pixel", 0, "COLUMN,ROW", "trace", set_pixel, "two whole numbers, such as 320,240",
     "the pixel to tell; 0,0 is the one at the top left. Must be given"},
    {"sample", 0, "I,J", "trace", set_sample, "two whole numbers from 0 to 15, such as 0,1",
     "the sample to tell, of a pixel that has several (default 0,0)"},
    {"format", 'f', "NAME", "trace", set_format, "text, json, obj or svg",
     "text (default); json: every number; obj: for a 3D viewer; svg: a drawing"},
    {"verbose", 'v', NULL, "trace", set_verbose, NULL, "tell every face that was tested (text, json)"},
    {"with-scene", 0, NULL, "trace", set_with_scene, NULL, "write the scene's faces, too (obj)"},
    {"rays", 'r', "FILE", "cast", set_rays, "the name of a file, or - for standard input",
     "read the rays there instead of from standard input"},
    {"geometry", 0, NULL, "check", set_geometry, NULL, "print every face as it is traced, exactly"},
    {"tolerance", 0, "N", "compare", set_tolerance, "a whole number from 0 to 255",
     "accept pictures that differ by up to N of 255 (default 0)"},
    {"heatmap", 0, "FILE", "compare", set_heatmap, "the name of a file, or - for standard output",
     "draw where they differ, from black (equal) to white (255)"},
    {"ladder", 0, NULL, "bench", set_ladder, NULL, "measure the scenes that docs/performance.md stands on"},
    {"folder", 0, "FOLDER", "bench", set_folder, "the name of a folder",
     "keep scenes, data of plots and pictures there; it is made"},
    {"repeats", 0, "N", "bench", set_repeats, "a whole number from 1 to 99", "pictures to take the median of (default 5)"},
    {"json", 0, NULL, "bench", set_json, NULL, "print one JSON object instead of tables"},
    {"backend", 'b', "NAME", "render cast", set_backend, "opencl or reference",
     "opencl (default), or reference: plain C in double"},
    {"device", 'd', "N", "render cast bench", set_device, "a number that `rectray devices` lists",
     "the OpenCL device, as `rectray devices` numbers them"},
    {"precision", 'p', "NAME", "render cast bench", set_precision, "float or double",
     "of the OpenCL kernel: float (default) or double"},
    {"accel", 'a', "NAME", "render trace cast bench", set_accel, "auto, none, kdtree or bvh",
     "auto (default), none, kdtree or bvh: how to find faces"},
    {"lanes", 0, "N", "render cast bench", set_lanes, "1, 4, 8 or 16", "rays that an OpenCL work-item traces: 1, 4, 8 or 16"},
    {"no-skip", 0, "NAMES", "render", set_no_skip, "all, or names of \"skipped\" in --stats=json with commas between them, such as tree,mirrors",
     "do work that the scene needs not: all, or names such as tree,mirrors"},
    {"threads", 't', "N", "render bench", set_threads, "a whole number from 1 to 256", "processors to use (default: all)"},
    {"stats", 0, "[=FORMAT]", "render cast", set_stats, "text or json",
     "tell what was done and how long it took: text or json"},
    {"progress", 0, "WHEN", "render", set_progress, "auto, always or never",
     "auto (default: on a terminal), always or never"},
    {"quiet", 'q', NULL, "render trace cast check compare bench generate devices", set_quiet, NULL, "no messages but errors"},
    {"help", 'h', NULL, "", set_help, NULL, "show this help"},
    {"version", 'V', NULL, "", set_version, NULL, "show the version"},
    {0},
};

bool option_belongs(const Option *option, const char *command)
{
    size_t length = strlen(command);
    for (const char *at = option->commands; (at = strstr(at, command)) != NULL; at += length)
        if ((at == option->commands || at[-1] == ' ') && (at[length] == ' ' || at[length] == '\0'))
            return true;
    return option->commands[0] == '\0';
}
