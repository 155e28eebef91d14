/* rectray explore: writes a page in which one clicks a pixel of a scene and reads how it came about. */
#include "base/output.h"
#include "base/process.h"
#include "base/text.h"
#include "command/command.h"
#include "command/scene_open.h"
#include "command/scene_override.h"
#include "page/explore.h"

#include <stdlib.h>
#include <string.h>

static bool check_pixel(const Options *options, const Scene *scene, Error *error)
{
    const Screen *screen = &scene->screen;
    if (!options->pixel_given || (options->pixel_column < screen->columns && options->pixel_row < screen->rows))
        return true;
    return error_set(error, ERROR_USAGE, "--pixel %d,%d is outside the picture, whose pixels are 0,0 to %d,%d",
                     options->pixel_column, options->pixel_row, screen->columns - 1, screen->rows - 1);
}

/* Reads the scene as any command does: a page is made of valid ones only. A pixel is one of the given size, or else of
 * the scene's own, which the page then takes. */
static bool check_scene(const Options *options, ExploreWishes *wishes, Error *error)
{
    Scene scene;
    if (!scene_open(&scene, options, error))
        return false;
    scene_override(&scene, options);
    *wishes = (ExploreWishes){.columns = options->columns,
                              .rows = options->rows,
                              .grid = options->grid,
                              .pixel_given = options->pixel_given,
                              .column = options->pixel_column,
                              .row = options->pixel_row};
    if (options->pixel_given) {
        wishes->columns = scene.screen.columns;
        wishes->rows = scene.screen.rows;
    }
    bool good = check_pixel(options, &scene, error);
    scene_free(&scene);
    return good;
}

/* The scene's name with ".html" for its extension, in the working directory. The caller frees it. */
static char *default_output(const char *scene_path, Error *error)
{
    const char *slash = strrchr(scene_path, '/'), *name = slash ? slash + 1 : scene_path, *dot = strrchr(name, '.');
    int length = (int)(dot && dot != name ? dot - name : (long)strlen(name));
    size_t size = (size_t)length + sizeof ".html";
    char *output = malloc(size);
    if (output)
        snprintf(output, size, "%.*s.html", length, name);
    else
        error_memory(error, "the page's name");
    return output;
}

static bool write_page(const Options *options, const char *path, const ExploreWishes *wishes, Error *error)
{
    Output output;
    if (output_replaces(path, options->operands[0]))
        return error_set(error, ERROR_USAGE, "the page %s would replace the scene itself; choose another -o", path);
    if (!output_open(&output, path, "the page", error))
        return false;
    if (explore_write(output.file, options->operands[0], wishes, error))
        return output_commit(&output, error);
    output_abort(&output);
    return false;
}

static bool open_page(const char *path, Error *error)
{
    const char *const argv[] = {"xdg-open", path, NULL};
    double ms;
    return process_run(argv, NULL, 0, &ms, error);
}

bool command_explore(const Options *options, Error *error)
{
    ExploreWishes wishes;
    if (text_is_stream(options->operands[0]))
        return error_set(error, ERROR_USAGE, "explore reads its scene more than once; give a file, not a pipe");
    if (!explore_check(error) || !check_scene(options, &wishes, error))
        return false;
    char *made = options->output ? NULL : default_output(options->operands[0], error);
    const char *path = options->output ? options->output : made;
    bool is_stream = path && strcmp(path, "-") == 0;
    bool done = path && (!options->open || !is_stream ||
                         error_set(error, ERROR_USAGE, "--open needs a file, not standard output"));
    done = done && write_page(options, path, &wishes, error);
    if (done && !options->quiet && !is_stream)
        fprintf(stderr, "%s: open it in a browser\n", path);
    done = done && (!options->open || open_page(path, error));
    free(made);
    return done;
}
