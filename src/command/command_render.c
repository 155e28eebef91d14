/* rectray render: a scene file in, a picture out. The backend hands bands of rows to a painter. */
#include "base/clock.h"
#include "base/output.h"
#include "base/text.h"
#include "command/command.h"
#include "command/hint_words.h"
#include "command/painter.h"
#include "command/part.h"
#include "command/region.h"
#include "command/render_frames.h"
#include "command/render_maps.h"
#include "command/render_watch.h"
#include "command/scene_open.h"
#include "command/scene_override.h"
#include "command/stats.h"
#include "opencl/backend.h"
#include "reader/stage.h"

#include <stdlib.h>
#include <string.h>

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
    (void)user;
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

/* film: whose frame the scene is, or NULL. */
static bool trace(const Options *options, Scene *scene, BackendFilm *film, Painter *painter, RenderReport *report,
                  Error *error)
{
    BandSink sink = painter_sink(painter);
    painter->progress = progress_start(options->progress, options->quiet);
    RenderSettings settings = options->settings;
    settings.precision = precision_of(options);
    settings.linear = painter->linear;
    settings.notice = (Notice){show_notice, options->quiet ? NULL : tell_foreseen, painter};
    if (options->map_count == 0 && !film) /* maps, and more frames, are made of the scene */
        settings.spent = (Spent){free_planes, scene};
    bool done = film ? backend_film_render(film, options->backend, scene, &settings, sink, report, error)
                     : backend_render(options->backend, scene, &settings, sink, report, error);
    progress_end(&painter->progress);
    return done;
}

/* Traces the scene, which may be a frame of a film, into the file `output`. */
static bool render(const Options *options, Scene *scene, const char *output, BackendFilm *film, Stats *stats,
                   Error *error)
{
    ImageKind kind = {.part = NULL};
    char note[PART_NOTE_ROOM];
    if (!painter_kind(options, output, &kind, error))
        return false;
    if (options->part.count > 0) {
        const PartNote part = part_note(options, scene, precision_of(options));
        part_note_write(note, &part);
        kind.part = note;
    }
    Painter painter;
    if (!painter_begin(&painter, options, output, kind, render_region(&options->settings, scene), error))
        return false;
    if (!trace(options, scene, film, &painter, &stats->report, error)) {
        painter_abort(&painter);
        return false;
    }
    bool done = painter_finish(&painter, options, error);
    stats->encode_ms = painter.encode_ms;
    bool is_part = options->settings.region.columns > 0;
    return done && (painter.varies || is_part || options->quiet || hint_blank_picture(scene, error));
}

/* --- The command --- */

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
