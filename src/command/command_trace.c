/* rectray trace: the walkthrough of one pixel, step by step, in one of several formats. */
#include "base/output.h"
#include "base/text.h"
#include "command/command.h"
#include "command/pager.h"
#include "command/scene_open.h"
#include "command/scene_override.h"
#include "command/trace_picture.h"
#include "trace/accel.h"
#include "trace/adaptive.h"
#include "walkthrough/ink.h"
#include "walkthrough/pixel_search.h"
#include "walkthrough/rounding.h"
#include "walkthrough/walkthrough_diff.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* --- Which pixels --- */

static bool wishes(const Options *options)
{
    return options->face || options->blocked_light >= 0 || options->mirrors > 0 || options->darkest;
}

/* The pixels that are asked for, or the one that a search finds. */
static bool choose_pixels(Options *options, const Scene *scene, Error *error)
{
    const Screen *screen = &scene->screen;
    if (options->pixel_count == 0 && wishes(options)) {
        PixelWish wish = {options->face, options->blocked_light, options->mirrors, options->darkest};
        TracePixel *pixel = &options->pixels[options->pixel_count++];
        if (wish.blocked_light >= scene->light_count)
            return error_set(error, ERROR_USAGE, "--light-blocked %d: the scene has %d light%s, counted from 0",
                             wish.blocked_light, scene->light_count, scene->light_count == 1 ? "" : "s");
        if (!pixel_search(scene, &wish, &pixel->column, &pixel->row, error))
            return false;
        if (!options->quiet)
            fprintf(stderr, "rectray: --pixel %d,%d shows it\n", pixel->column, pixel->row);
    }
    if (options->pixel_count == 0)
        return error_set(
            error, ERROR_USAGE,
            "trace needs --pixel COLUMN,ROW: the pixel to tell, from 0,0 to %d,%d; or an option that looks "
            "for one: --face, --light-blocked, --mirror-depth, --darkest",
            screen->columns - 1, screen->rows - 1);
    for (int i = 0; i < options->pixel_count; i++)
        if (options->pixels[i].column >= screen->columns || options->pixels[i].row >= screen->rows)
            return error_set(error, ERROR_USAGE, "--pixel %d,%d is outside the picture, whose pixels are 0,0 to %d,%d",
                             options->pixels[i].column, options->pixels[i].row, screen->columns - 1, screen->rows - 1);
    return true;
}

static bool check_textbook(const Options *options, Error *error)
{
    if (!options_agree(options, error))
        return false;
    if (options->settings.arithmetic != ARITHMETIC_TEXTBOOK)
        return true;
    if (options->format != WALKTHROUGH_TEXT && options->format != WALKTHROUGH_JSON)
        return error_set(error, ERROR_USAGE, "--arithmetic textbook is told with --format text or json, not %s",
                         walkthrough_format_words[options->format]);
    if (options->diff)
        return error_set(error, ERROR_USAGE, "--diff compares exact walkthroughs; leave out --arithmetic textbook");
    return options->settings.accel <= ACCEL_NONE ||
           error_set(error, ERROR_USAGE, "textbook arithmetic has no tree; leave out --accel");
}

static bool check_request(const Options *options, const Scene *scene, Error *error)
{
    bool text = options->format == WALKTHROUGH_TEXT;
    if (options->pixel_given && wishes(options))
        return error_set(error, ERROR_USAGE, "--pixel says which pixel; --face and its like look for one");
    if (options->diff && (options->pixel_count < 2 || !text))
        return error_set(error, ERROR_USAGE, "--diff needs --pixel twice or more, and --format text");
    if (options->pixel_count > 1 && !text && options->format != WALKTHROUGH_JSON)
        return error_set(error, ERROR_USAGE, "--format %s shows one pixel; leave out the other --pixel",
                         walkthrough_format_words[options->format]);
    int grid = scene->adaptive && scene->grid > 1 ? adaptive_samples(scene->grid) : scene->grid;
    if (options->sample_i >= grid || options->sample_j >= grid)
        return error_set(error, ERROR_USAGE, "--sample %d,%d is outside the grid, whose samples are 0,0 to %d,%d",
                         options->sample_i, options->sample_j, grid - 1, grid - 1);
    return check_textbook(options, error);
}

/* --- Writing --- */

/* Lines as wide as the terminal, within bounds. */
static int columns_of(const Options *options)
{
    int columns = options->width > 0 ? options->width : terminal_size(stdout).columns;
    if (columns == 0)
        return isatty(STDOUT_FILENO) ? INK_LEAST_COLUMNS : INK_COLUMNS;
    columns = columns < INK_LEAST_COLUMNS ? INK_LEAST_COLUMNS : columns;
    return columns > INK_MOST_COLUMNS ? INK_MOST_COLUMNS : columns;
}

static WalkthroughStyle style_of(const Options *options, bool to_stdout, const WalkthroughPicture *picture)
{
    bool colour =
        options->colour == COLOUR_ALWAYS || (options->colour == COLOUR_AUTO && to_stdout && ink_wants_colour(stdout));
    return (WalkthroughStyle){
        .parts = options->summary ? WALKTHROUGH_SUMMARY : WALKTHROUGH_WHOLE,
        .colour = colour ? ink_terminal_colour() : INK_PLAIN,
        .columns = to_stdout ? columns_of(options) : options->width,
        .with_scene = options->with_scene,
        .picture = picture,
    };
}

/* In textbook arithmetic: what it finds, beside the walkthrough. */
static bool write_rounding(FILE *out, const Options *options, const Walkthrough *walk, WalkthroughStyle style,
                           Error *error)
{
    Rounding rounding;
    bool made = rounding_make(&rounding, walk, &options->settings, error);
    bool written = made && (options->format != WALKTHROUGH_JSON || rounding_write_json(out, &rounding, error));
    if (made && options->format == WALKTHROUGH_TEXT)
        rounding_write_text(out, &rounding, style);
    rounding_free(&rounding);
    return written;
}

static bool write_walk(FILE *out, const Options *options, const Walkthrough *walk, WalkthroughStyle style, Error *error)
{
    if (options->settings.arithmetic == ARITHMETIC_TEXTBOOK)
        return write_rounding(out, options, walk, style, error);
    return walkthrough_writer(options->format)(out, walk, style, error);
}

/* One walkthrough, or several: text below text, JSON in an array. */
static bool write_walks(FILE *out, const Options *options, const Walkthrough *walks, WalkthroughStyle style,
                        Error *error)
{
    int count = options->pixel_count;
    bool json = options->format == WALKTHROUGH_JSON && count > 1, done = true;
    if (options->diff)
        return walkthrough_diff(out, walks, count, style, error);
    for (int i = 0; i < count && done; i++) {
        if (count > 1)
            fputs(json ? i > 0 ? "," : "[" : i > 0 ? "\n" : "", out);
        done = write_walk(out, options, &walks[i], style, error);
    }
    if (json)
        fputs("]\n", out);
    return done;
}

static bool write_paged(const Options *options, const Walkthrough *walks, WalkthroughStyle style, Error *error)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    bool written = out && write_walks(out, options, walks, style, error);
    written = out && fclose(out) == 0 && written;
    if (written)
        pager_show(text);
    else if (error->kind == ERROR_NONE)
        error_memory(error, "the walkthrough");
    free(text);
    return written;
}

static bool write_file(const Options *options, const Walkthrough *walks, const WalkthroughPicture *picture,
                       Error *error)
{
    const char *path = options->output;
    bool to_stdout = !path || strcmp(path, "-") == 0;
    WalkthroughStyle style = style_of(options, to_stdout, picture);
    if (to_stdout && options->format == WALKTHROUGH_TEXT && !options->no_pager && isatty(STDOUT_FILENO))
        return write_paged(options, walks, style, error);
    if (to_stdout)
        return write_walks(stdout, options, walks, style, error);
    if (output_replaces(path, options->operands[0]))
        return error_set(error, ERROR_USAGE, "the walkthrough %s would replace the scene itself; choose another -o",
                         path);
    Output output;
    if (!output_open(&output, path, "the walkthrough", error))
        return false;
    if (write_walks(output.file, options, walks, style, error))
        return output_commit(&output, error);
    output_abort(&output);
    return false;
}

/* An option that the format has no use for. */
static void note_unused(const Options *options)
{
    const char *format = walkthrough_format_words[options->format];
    if (options->with_scene && options->format != WALKTHROUGH_OBJ)
        fprintf(stderr, "rectray: note: --with-scene does nothing with --format %s\n", format);
    if (options->verbose && (options->format == WALKTHROUGH_OBJ || options->format == WALKTHROUGH_SVG))
        fprintf(stderr, "rectray: note: --verbose does nothing with --format %s\n", format);
    if (options->summary && (options->format == WALKTHROUGH_OBJ || options->format == WALKTHROUGH_SVG))
        fprintf(stderr, "rectray: note: --summary does nothing with --format %s\n", format);
    if (options->precision_given && options->settings.arithmetic == ARITHMETIC_EXACT)
        fprintf(stderr, "rectray: note: --precision does nothing without --arithmetic textbook; all is in double\n");
}

/* As the algorithm is taught every face is tested; a tree only where the user asks for one. */
static AccelKind accel_kind(const Options *options)
{
    return options->settings.accel == ACCEL_AUTO ? ACCEL_NONE : options->settings.accel;
}

static bool record(const Options *options, const Scene *scene, const Accel *accel, int index, Walkthrough *walk,
                   Error *error)
{
    WalkthroughRequest request = {
        .column = options->pixels[index].column,
        .row = options->pixels[index].row,
        .i = options->sample_i,
        .j = options->sample_j,
        .verbose = options->verbose,
    };
    bool drawn = options->format == WALKTHROUGH_OBJ || options->format == WALKTHROUGH_SVG;
    return walkthrough_record(walk, scene, accel, text_input_name(options->operands[0]), request, error) &&
           (drawn || walkthrough_look_around(walk, error));
}

static bool trace(const Options *options, const Scene *scene, Error *error)
{
    Accel accel = {.kind = ACCEL_NONE};
    Walkthrough walks[TRACE_PIXELS_MAX] = {{0}};
    bool done = accel_build(&accel, scene, accel_kind(options), 1, error);
    for (int i = 0; i < options->pixel_count && done; i++)
        done = record(options, scene, &accel, i, &walks[i], error);
    WalkthroughPicture picture = {.base64 = NULL};
    bool drawn = options->format == WALKTHROUGH_SVG;
    done = done && (!drawn || trace_picture_make(&picture, scene, error));
    done = done && write_file(options, walks, drawn ? &picture : NULL, error);
    trace_picture_free(&picture);
    for (int i = 0; i < options->pixel_count; i++)
        walkthrough_free(&walks[i]);
    accel_free(&accel);
    return done;
}

bool command_trace(const Options *options, Error *error)
{
    Scene scene;
    if (!scene_open(&scene, options, error))
        return false;
    scene_override(&scene, options);
    Options chosen = *options; /* with the pixel that a search has found */
    bool done = check_request(options, &scene, error) && choose_pixels(&chosen, &scene, error);
    if (done && !options->quiet)
        note_unused(options);
    done = done && trace(&chosen, &scene, error);
    scene_free(&scene);
    return done;
}
