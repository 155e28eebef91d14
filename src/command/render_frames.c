/* Frame after frame: the scene of each, and what is told of all of them together. */
#include "command/render_frames.h"

#include "base/clock.h"
#include "base/output.h"
#include "base/text.h"
#include "command/frame_names.h"
#include "command/part.h"
#include "command/region.h"
#include "command/scene_open.h"
#include "command/scene_override.h"
#include "picture/film.h"
#include "picture/image_whole.h"

#include <stdlib.h>
#include <string.h>

/* What is rendered, and what has been. */
typedef struct Frames {
    const Options *options; /* as for one picture: without --part */
    RenderFrame render;
    OpenFilm opened;
    char *pattern; /* NULL: they become a film */
    Film *film;
    int first, last;
    Scene scene;      /* of the frame that was rendered last */
    BackendFilm held; /* and what of it is on the device */
    int rendered, skipped;
    Stats stats; /* of all frames that were rendered */
} Frames;

/* --- What is asked for --- */

static bool check_options(const Options *options, Error *error)
{
    const struct {
        bool given;
        const char *name, *reason;
    } others[] = {
        {options->frame_given, "--frame", "it is one frame"},
        {options->map_count > 0, "--map", "a map is of one picture; choose it with --frame"},
        {options->mark_given, "--mark", "a pixel is marked in one picture; choose it with --frame"},
        {options->watch, "--watch", "it renders one picture again and again; choose it with --frame"},
    };
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (others[i].given)
            return error_set(error, ERROR_USAGE, "%s does not go with --frames or a film: %s", others[i].name,
                             others[i].reason);
    return true;
}

/* "SCENE-%04d.png" where the user says nothing. The percent signs of the scene's name are no numbers. */
static char *default_pattern(const char *scene_path, Error *error)
{
    const char *slash = strrchr(scene_path, '/'), *name = slash ? slash + 1 : scene_path, *dot = strrchr(name, '.');
    size_t length = dot && dot != name ? (size_t)(dot - name) : strlen(name), used = 0;
    char *pattern = malloc(2 * length + sizeof "-%04d.png");
    if (!pattern) {
        error_memory(error, "the names of frames");
        return NULL;
    }
    for (size_t i = 0; i < length; i++) {
        pattern[used++] = name[i];
        if (name[i] == '%')
            pattern[used++] = '%';
    }
    strcpy(pattern + used, "-%04d.png");
    return pattern;
}

static bool check_film(const Options *options, Error *error)
{
    if (options->resume)
        return error_set(error, ERROR_USAGE, "--resume needs a file for each frame, such as -o 'frame-%%04d.png'");
    return (options->depth == 0 && options->picture_format < 0) ||
           error_set(error, ERROR_USAGE, "--format and --depth are of pictures; a film has 8 bits");
}

/* A film, or names for the frames. */
static bool choose_output(Frames *frames, Error *error)
{
    const char *output = frames->options->output, *scene = frames->options->operands[0];
    if (output && film_is(output))
        return check_film(frames->options, error);
    if (!output && text_is_stream(scene))
        return error_set(error, ERROR_USAGE,
                         "a scene that comes through a pipe has no name for its frames; give -o 'frame-%%04d.png'");
    frames->pattern = output ? text_copy(output, error) : default_pattern(scene, error);
    return frames->pattern && frame_names_check(frames->pattern, error);
}

/* The frames that are asked for, or the part of them. */
static bool choose_frames(Frames *frames, const Options *asked, Error *error)
{
    int count = frames->opened.film.animation.frames;
    frames->first = frames->options->first_frame;
    frames->last = frames->options->last_frame;
    if (!frames->options->frames_given || frames->last < 0)
        frames->last = count - 1;
    if (frames->last >= count)
        return error_set(error, ERROR_USAGE, "there is no frame %d: those of %s are 0 to %d", frames->last,
                         frames->options->operands[0], count - 1);
    if (asked->part.count == 0)
        return true;
    int frames_asked = frames->last - frames->first + 1;
    if (!part_check(asked, frames_asked, "frames", error))
        return false;
    PartRange range = part_range(asked->part, frames_asked);
    frames->first += range.first;
    frames->last = frames->first + range.count - 1;
    return true;
}

/* --- Rendering --- */

/* Whether the frame's picture is there. The screen's size is that of every frame. */
static bool is_there(const Frames *frames, const char *name)
{
    const Options *options = frames->options;
    ImageKind kind = {.depth = options->depth == 1 ? 16 : 8, .format = (ImageFormat)options->picture_format};
    Error unknown = {.kind = ERROR_NONE};
    if (options->picture_format < 0 && !image_format_of(name, &kind.format, &unknown))
        return false;
    const Region region = render_region(&options->settings, &frames->scene);
    return image_is_whole(name, kind, region.columns, region.rows);
}

static bool spare_scene(const Frames *frames, const char *name, Error *error)
{
    if (output_replaces(name, frames->options->operands[0]))
        return error_set(error, ERROR_USAGE, "the picture %s would replace the scene itself; choose another -o", name);
    return true;
}

/* The scene of a frame, as the options want it. What its readers had to say is told once. */
static bool read_frame(Frames *frames, int frame, Error *error)
{
    bool first = !frames->scene.objects;
    double start = clock_ms();
    if (!scene_film_frame(&frames->opened.film, frame, &frames->scene, error))
        return false;
    frames->stats.parse_ms += clock_ms() - start;
    scene_override(&frames->scene, frames->options);
    if (!region_check(frames->options, &frames->scene, error))
        return false;
    return !first || scene_open_tell(&frames->scene.notes, frames->options, false, error);
}

/* Renders the frame into a file or a pipe. */
static bool render_to(Frames *frames, const Options *options, const char *output, Error *error)
{
    Stats stats = stats_begin(&frames->scene, options->backend, options->settings.precision);
    stats.arithmetic = options->settings.arithmetic;
    bool done = frames->render(options, &frames->scene, output, &frames->held, &stats, error);
    stats_add(&frames->stats, &stats);
    frames->rendered++;
    return done;
}

/* Into a file of its own. */
static bool write_picture(Frames *frames, int frame, Error *error)
{
    char *name = frame_name(frames->pattern, frame, error);
    bool done = name != NULL;
    if (done && frames->options->resume && is_there(frames, name))
        frames->skipped++;
    else if (done)
        done = spare_scene(frames, name, error) && render_to(frames, frames->options, name, error);
    free(name);
    return done;
}

/* Into the film, which is opened when its size is known. */
static bool write_film(Frames *frames, Error *error)
{
    const Options *options = frames->options;
    const Region region = render_region(&options->settings, &frames->scene);
    Options own = *options;
    own.picture_format = IMAGE_RAW;
    own.quiet = own.quiet || frames->rendered > 0;
    if (!frames->film && spare_scene(frames, options->output, error))
        frames->film =
            film_open(options->output, region.columns, region.rows, frames->opened.film.animation.fps, error);
    return frames->film && render_to(frames, &own, film_pipe(frames->film), error);
}

static void tell(const Frames *frames)
{
    const Region region = render_region(&frames->options->settings, &frames->scene);
    if (frames->options->quiet)
        return;
    fprintf(stderr, "%s: %d frame%s of %d x %d pixels in %.2f s",
            frames->pattern ? frames->pattern : frames->options->output, frames->rendered,
            frames->rendered == 1 ? "" : "s", region.columns, region.rows, frames->stats.total_ms / 1e3);
    if (frames->options->resume)
        fprintf(stderr, "; %d were there", frames->skipped);
    fputc('\n', stderr);
}

static void sweep(const Frames *frames)
{
    const char *number = strchr(frames->pattern, '%');
    if (!strchr(number, '/')) /* all frames are in one folder */
        output_sweep(frames->pattern);
}

/* The film, where there is one, gets its name; after a fault of ffmpeg itself, that is what is told. */
static bool finish(Frames *frames, bool done, Error *reason, Error *error)
{
    if (done && (!frames->film || film_commit(frames->film, error)))
        return true;
    if (done)
        return false;
    bool pipe_is_broken = frames->film && strstr(reason->text, film_pipe(frames->film));
    film_abort(frames->film, pipe_is_broken, error);
    return error_set(error, reason->kind, "%s", reason->text);
}

static bool render_all(Frames *frames, Error *error)
{
    double start = clock_ms();
    Error reason = {.kind = ERROR_NONE};
    bool done = true;
    frames->held.same_faces = !frames->opened.film.animation.moves_objects;
    options_note_unused(frames->options);
    if (frames->options->resume)
        sweep(frames);
    for (int frame = frames->first; frame <= frames->last && done; frame++)
        done = read_frame(frames, frame, &reason) &&
               (frames->pattern ? write_picture(frames, frame, &reason) : write_film(frames, &reason));
    if (!finish(frames, done, &reason, error))
        return false;
    frames->stats.total_ms = clock_ms() - start;
    tell(frames);
    return stats_print(stdout, frames->options->stats, &frames->stats, error);
}

bool render_frames_wanted(const Options *options)
{
    return options->frames_given || (options->output && film_is(options->output));
}

bool render_frames(const Options *options, RenderFrame render, Error *error)
{
    Options own = *options;
    own.part = (OptionPart){.count = 0};
    Frames frames = {.options = &own, .render = render};
    bool done = check_options(options, error) && options_agree(options, error) &&
                scene_open_film(&frames.opened, options, error) && choose_output(&frames, error) &&
                choose_frames(&frames, options, error) && render_all(&frames, error);
    backend_film_close(&frames.held);
    scene_free(&frames.scene);
    scene_close_film(&frames.opened);
    free(frames.pattern);
    return done;
}
