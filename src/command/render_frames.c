/* Frame after frame: the scene of each, and what is told of all of them together. */
#include "command/render_frames.h"

#include "base/clock.h"
#include "base/output.h"
#include "base/text.h"
#include "command/frame_names.h"
#include "command/scene_open.h"
#include "command/scene_override.h"
#include "picture/image_whole.h"

#include <stdlib.h>
#include <string.h>

/* What is rendered, and what has been. */
typedef struct Frames {
    const Options *options;
    RenderFrame render;
    OpenFilm opened;
    char *pattern;
    int first, last;
    Scene scene; /* of the frame that was rendered last */
    int rendered, skipped;
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
        {options->stats != STATS_NONE, "--stats", "they are of one picture; choose it with --frame"},
    };
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (others[i].given)
            return error_set(error, ERROR_USAGE, "%s does not go with --frames: %s", others[i].name, others[i].reason);
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

static bool choose_pattern(Frames *frames, Error *error)
{
    const char *output = frames->options->output, *scene = frames->options->operands[0];
    if (!output && text_is_stream(scene))
        return error_set(error, ERROR_USAGE,
                         "a scene that comes through a pipe has no name for its frames; give -o 'frame-%%04d.png'");
    frames->pattern = output ? text_copy(output, error) : default_pattern(scene, error);
    return frames->pattern && frame_names_check(frames->pattern, error);
}

static bool choose_frames(Frames *frames, Error *error)
{
    int count = frames->opened.film.animation.frames;
    frames->first = frames->options->first_frame;
    frames->last = frames->options->last_frame < 0 ? count - 1 : frames->options->last_frame;
    return frames->last < count || error_set(error, ERROR_USAGE, "there is no frame %d: those of %s are 0 to %d",
                                             frames->last, frames->options->operands[0], count - 1);
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
    return image_is_whole(name, kind, frames->scene.screen.columns, frames->scene.screen.rows);
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
    if (!scene_film_frame(&frames->opened.film, frame, &frames->scene, error))
        return false;
    scene_override(&frames->scene, frames->options);
    return !first || scene_open_tell(&frames->scene.notes, frames->options, false, error);
}

static bool render_frame(Frames *frames, int frame, Error *error)
{
    const Options *options = frames->options;
    Stats stats = {.total_ms = 0};
    char *name = frame_name(frames->pattern, frame, error);
    bool done = name && read_frame(frames, frame, error);
    if (done && options->resume && is_there(frames, name)) {
        frames->skipped++;
    } else if (done) {
        done = spare_scene(frames, name, error) && frames->render(options, &frames->scene, name, &stats, error);
        frames->rendered++;
    }
    free(name);
    return done;
}

static void tell(const Frames *frames, double ms)
{
    const Screen *screen = &frames->scene.screen;
    if (frames->options->quiet)
        return;
    fprintf(stderr, "%s: %d frame%s of %d x %d pixels in %.2f s", frames->pattern, frames->rendered,
            frames->rendered == 1 ? "" : "s", screen->columns, screen->rows, ms / 1e3);
    if (frames->options->resume)
        fprintf(stderr, "; %d were there", frames->skipped);
    fputc('\n', stderr);
}

static bool render_all(Frames *frames, Error *error)
{
    options_note_unused(frames->options);
    double start = clock_ms();
    const char *number = strchr(frames->pattern, '%');
    if (frames->options->resume && !strchr(number, '/')) /* all frames are in one folder */
        output_sweep(frames->pattern);
    for (int frame = frames->first; frame <= frames->last; frame++)
        if (!render_frame(frames, frame, error))
            return false;
    tell(frames, clock_ms() - start);
    return true;
}

bool render_frames(const Options *options, RenderFrame render, Error *error)
{
    Frames frames = {.options = options, .render = render};
    bool done = check_options(options, error) && options_agree(options, error) &&
                scene_open_film(&frames.opened, options, error) && choose_pattern(&frames, error) &&
                choose_frames(&frames, error) && render_all(&frames, error);
    scene_free(&frames.scene);
    scene_close_film(&frames.opened);
    free(frames.pattern);
    return done;
}
