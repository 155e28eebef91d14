/* rectray render: a scene file in, a picture out. The backend hands on bands of rows; each is encoded at once, so
 * that no more than a band of the picture is ever in memory. */
#include "base/clock.h"
#include "base/output.h"
#include "base/text.h"
#include "command/command.h"
#include "command/hint_words.h"
#include "command/part.h"
#include "command/progress.h"
#include "command/region.h"
#include "command/render_frames.h"
#include "command/render_maps.h"
#include "command/render_watch.h"
#include "command/scene_open.h"
#include "command/scene_override.h"
#include "command/stats.h"
#include "opencl/backend.h"
#include "picture/image.h"
#include "picture/mark.h"
#include "reader/stage.h"

#include <stdlib.h>
#include <string.h>

/* What stands at the receiving end of the bands. */
typedef struct Painter {
    ImageWriter *writer;
    Progress progress;
    double encode_ms;
    bool quiet;
    Region region;           /* of the picture: what is painted */
    unsigned char colour[3]; /* of its first pixel */
    bool varies;             /* some pixel has another colour */
    Image marked;            /* the whole region, where a pixel of it is to be marked; else without pixels */
    BackendFilm *film;       /* whose frame the picture is, or NULL */
    double *linear;          /* the whole region in linear colours, where they are written; else NULL */
} Painter;

/* Notes whether the picture has more than one colour: most bands tell at their second pixel. */
static void watch_colours(Painter *painter, int first_row, int rows, const unsigned char *rgb)
{
    size_t bytes = (size_t)rows * (size_t)painter->region.columns * 3;
    if (painter->varies)
        return;
    if (first_row == 0)
        memcpy(painter->colour, rgb, 3);
    painter->varies = memcmp(painter->colour, rgb, 3) != 0 || memcmp(rgb, rgb + 3, bytes - 3) != 0;
}

static bool paint_band(void *user, int first_row, int rows, const unsigned char *rgb, const RenderReport *so_far,
                       Error *error)
{
    Painter *painter = user;
    double start = clock_ms();
    size_t stride = (size_t)painter->marked.columns * 3;
    watch_colours(painter, first_row, rows, rgb);
    if (painter->marked.rgb)
        memcpy(painter->marked.rgb + (size_t)first_row * stride, rgb, (size_t)rows * stride);
    bool ok = painter->marked.rgb || painter->linear || image_writer_rows(painter->writer, rgb, rows, error);
    painter->encode_ms += clock_ms() - start;
    const RayCounts *rays = &so_far->rays;
    progress_step(&painter->progress, (double)(first_row + rows) / painter->region.rows,
                  rays->primary + rays->shadow + rays->reflection,
                  so_far->trace_ms + so_far->readback_ms + painter->encode_ms);
    return ok;
}

/* The scene's name with ".png" for its extension, of a part ".3-of-8.png", in the working directory. The caller frees
 * it. */
static char *default_output(const char *scene_path, OptionPart part, Error *error)
{
    if (text_is_stream(scene_path)) {
        error_set(error, ERROR_USAGE, "a scene that comes through a pipe has no name for its picture; give -o FILE");
        return NULL;
    }
    const char *slash = strrchr(scene_path, '/');
    const char *name = slash ? slash + 1 : scene_path;
    const char *dot = strrchr(name, '.');
    int length = (int)(dot && dot != name ? dot - name : (long)strlen(name));
    char ending[48] = ".png";
    if (part.count > 0)
        snprintf(ending, sizeof ending, ".%d-of-%d.png", part.number, part.count);
    size_t size = (size_t)length + sizeof ending;
    char *output = malloc(size);
    if (output)
        snprintf(output, size, "%.*s%s", length, name, ending);
    else
        error_memory(error, "the picture's name");
    return output;
}

static bool spare_scene(const char *scene_path, const char *output, Error *error)
{
    if (output_replaces(output, scene_path))
        return error_set(error, ERROR_USAGE, "the picture %s would replace the scene itself; choose another -o",
                         output);
    return true;
}

static void show_notice(void *user, const char *text)
{
    Painter *painter = user;
    progress_note(&painter->progress, text);
}

static void tell_foreseen(void *user, double seconds)
{
    Painter *painter = user;
    if (!painter->quiet)
        fprintf(stderr, "rectray: note: the reference will take about %.0f s for this picture; -b opencl is faster\n",
                seconds);
}

/* The reference is double; its textbook arithmetic is, unless the user says float. */
static Precision precision_of(const Options *options)
{
    bool textbook = options->settings.arithmetic == ARITHMETIC_TEXTBOOK;
    bool must_be_double = options->backend == BACKEND_REFERENCE && !(textbook && options->precision_given);
    return must_be_double ? PRECISION_DOUBLE : options->settings.precision;
}

/* The scene's planes are not needed any more. */
static void free_planes(void *user)
{
    Scene *scene = user;
    free(scene->planes);
    scene->planes = NULL;
}

static bool trace(const Options *options, Scene *scene, Painter *painter, RenderReport *report, Error *error)
{
    BandSink sink = {paint_band, painter};
    painter->quiet = options->quiet;
    painter->progress = progress_start(options->progress, options->quiet);
    RenderSettings settings = options->settings;
    settings.precision = precision_of(options);
    settings.linear = painter->linear;
    settings.notice = (Notice){show_notice, tell_foreseen, painter};
    if (options->map_count == 0 && !painter->film) /* maps, and more frames, are made of the scene */
        settings.spent = (Spent){free_planes, scene};
    bool done = painter->film
                    ? backend_film_render(painter->film, options->backend, scene, &settings, sink, report, error)
                    : backend_render(options->backend, scene, &settings, sink, report, error);
    progress_end(&painter->progress);
    return done;
}

/* A marked picture is written when it is complete: what is shown larger may come after its place. */
static bool keep_picture(Painter *painter, Error *error)
{
    painter->marked = (Image){painter->region.columns, painter->region.rows, NULL};
    painter->marked.rgb = malloc((size_t)painter->region.columns * (size_t)painter->region.rows * 3);
    return painter->marked.rgb || error_memory(error, "the picture");
}

/* The bytes around a pixel of the image, which is that region of the picture. */
static void print_around(const Image *image, const Region *region, int column, int row)
{
    for (int y = row - 1; y <= row + 1; y++) {
        if (y < 0 || y >= image->rows)
            continue;
        for (int x = column - 1; x <= column + 1; x++) {
            if (x < 0 || x >= image->columns)
                continue;
            const unsigned char *rgb = image->rgb + ((size_t)y * (size_t)image->columns + (size_t)x) * 3;
            fprintf(stderr, "  (%d, %d) = (%d, %d, %d)", region->column + x, region->row + y, rgb[0], rgb[1], rgb[2]);
        }
        fputc('\n', stderr);
    }
}

/* Marks and writes the picture that was kept; true, too, where none was. */
static bool write_marked(const Options *options, Painter *painter, Error *error)
{
    Image *image = &painter->marked;
    int column = options->mark_column - painter->region.column, row = options->mark_row - painter->region.row;
    if (!image->rgb)
        return true;
    if (!options->quiet)
        print_around(image, &painter->region, column, row);
    mark_draw(image, column, row);
    bool done = image_writer_rows(painter->writer, image->rgb, image->rows, error);
    image_free(image);
    return done;
}

/* --- Formats --- */

static bool choose_kind(const Options *options, const char *output, ImageKind *kind, Error *error)
{
    kind->depth = options->depth == 1 ? 16 : 8;
    kind->format = (ImageFormat)options->picture_format;
    if (options->picture_format < 0 && !image_format_of(output, &kind->format, error))
        return false;
    bool linear = kind->format == IMAGE_PFM || kind->depth == 16;
    if (kind->format == IMAGE_PFM && kind->depth == 16)
        return error_set(error, ERROR_USAGE, "--depth is of png and ppm; a pfm has 32-bit floats");
    if (options->part.count > 0 && kind->format != IMAGE_PNG)
        return error_set(error, ERROR_USAGE,
                         "a part is a PNG, which tells its place; `rectray join` writes other formats");
    if (linear && options->settings.arithmetic == ARITHMETIC_TEXTBOOK && options->backend == BACKEND_REFERENCE)
        return error_set(error, ERROR_USAGE,
                         "textbook arithmetic of the reference gives 8 bits; choose .png or .ppm, or "
                         "--kernel plain");
    return !linear || !options->mark_given ||
           error_set(error, ERROR_USAGE, "--mark draws into a picture of 8 bits; choose .png or .ppm");
}

static bool keep_linear(Painter *painter, Error *error)
{
    painter->linear =
        malloc((size_t)painter->region.columns * (size_t)painter->region.rows * 3 * sizeof *painter->linear);
    return painter->linear || error_memory(error, "the picture in linear colours");
}

/* --- The way from the scene to the file --- */

/* The picture of a painter whose writer is open. */
static bool paint(const Options *options, Scene *scene, ImageKind kind, Painter *painter, RenderReport *report,
                  Error *error)
{
    bool linear = kind.format == IMAGE_PFM || kind.depth == 16;
    if ((options->mark_given && !keep_picture(painter, error)) || (linear && !keep_linear(painter, error)) ||
        !trace(options, scene, painter, report, error))
        return false;
    double start = clock_ms();
    bool written = write_marked(options, painter, error) &&
                   (!linear || image_writer_linear(painter->writer, painter->linear, error));
    painter->encode_ms += clock_ms() - start;
    return written;
}

/* Traces the scene, which may be a frame of a film, into the file `output`. */
static bool render(const Options *options, Scene *scene, const char *output, BackendFilm *film, Stats *stats,
                   Error *error)
{
    ImageKind kind = {.part = NULL};
    char note[PART_NOTE_ROOM];
    if (!choose_kind(options, output, &kind, error))
        return false;
    if (options->part.count > 0) {
        const PartNote part = part_note(options, scene, precision_of(options));
        part_note_write(note, &part);
        kind.part = note;
    }
    double start = clock_ms();
    const Region region = render_region(&options->settings, scene);
    Painter painter = {.film = film,
                       .region = region,
                       .writer = image_writer_open_as(output, kind, region.columns, region.rows, error)};
    if (!painter.writer)
        return false;
    painter.encode_ms = clock_ms() - start;
    bool painted = paint(options, scene, kind, &painter, &stats->report, error);
    image_free(&painter.marked);
    free(painter.linear);
    if (!painted) {
        image_writer_abort(painter.writer);
        return false;
    }
    start = clock_ms();
    bool done = image_writer_commit(painter.writer, error);
    stats->encode_ms = painter.encode_ms + clock_ms() - start;
    bool is_part = options->settings.region.columns > 0;
    return done && (painter.varies || is_part || options->quiet || hint_blank_picture(scene, error));
}

static bool render_scene(const Options *options, Scene *scene, Stats *stats, double start_ms, Error *error)
{
    char *output = options->output ? text_copy(options->output, error)
                                   : default_output(options->operands[0], options->part, error);
    bool to_stdout = output && strcmp(output, "-") == 0;
    bool done = output && spare_scene(options->operands[0], output, error) &&
                render(options, scene, output, NULL, stats, error);
    stats->total_ms = clock_ms() - start_ms;
    const Region region = render_region(&options->settings, scene);
    if (done && !options->quiet && !to_stdout)
        fprintf(stderr, "%s: %d x %d pixels in %.2f s\n", output, region.columns, region.rows, stats->total_ms / 1e3);
    free(output);
    return done && stats_print(to_stdout ? stderr : stdout, options->stats, stats, error);
}

static bool print_stage(const char *path, Error *error)
{
    if (!stage_is_model(path))
        return error_set(error, ERROR_USAGE, "--stage makes a scene for a model; %s does not end in .obj, .ply or .stl",
                         path);
    char *text = stage_text(path, error);
    if (text)
        fputs(text, stdout);
    free(text);
    return text != NULL;
}

/* What --part asks for, as a region. */
static bool choose_part(Options *options, const Scene *scene, Error *error)
{
    if (options->part.count == 0)
        return true;
    if (!part_check(options, scene->screen.rows, "rows", error))
        return false;
    options->settings.region = part_region(options->part, scene);
    return true;
}

static bool render_once(const Options *given, Error *error)
{
    Options own = *given, *options = &own;
    double start = clock_ms();
    Scene scene;
    if (!options_agree(options, error))
        return false;
    if (!scene_open(&scene, options, error))
        return false;
    Stats stats = stats_begin(&scene, options->backend, options->settings.precision);
    stats.arithmetic = options->settings.arithmetic;
    stats.precision = precision_of(options);
    stats.parse_ms = clock_ms() - start;
    options_note_unused(options);
    scene_override(&scene, options);
    bool done = choose_part(options, &scene, error) && region_check(options, &scene, error) &&
                render_maps_check(options, error) && render_scene(options, &scene, &stats, start, error) &&
                render_maps_draw(options, &scene, error);
    scene_free(&scene);
    return done;
}

bool command_render(const Options *options, Error *error)
{
    if (options->stage)
        return print_stage(options->operands[0], error);
    if (render_frames_wanted(options))
        return render_frames(options, render, error);
    if (options->resume)
        return error_set(error, ERROR_USAGE, "--resume goes on with frames; say which with --frames");
    return options->watch ? render_watch(options, render_once, error) : render_once(options, error);
}
