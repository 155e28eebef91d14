/* The functions of rectray.h, each a few calls of what the program itself uses. */
#include "library/rectray.h"

#include "base/number.h"
#include "opencl/backend.h"
#include "reader/scene_json.h"
#include "scene/world_ray.h"
#include "walkthrough/walkthrough_formats.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct RectrayScene {
    Scene scene;
};

#ifdef __GNUC__
/* The table of powers for long texts is made when the library is loaded: two threads must not make it at once. */
static void __attribute__((constructor)) prepare(void)
{
    number_prepare();
}
#endif

/* Hands the error on. Returns 0. */
static int tell(const Error *from, RectrayError *to)
{
    if (to) {
        to->kind = (int)from->kind;
        snprintf(to->text, sizeof to->text, "%s", from->text);
    }
    return 0;
}

static int refuse(RectrayError *to, const char *reason)
{
    Error error = {.kind = ERROR_NONE};
    error_set(&error, ERROR_USAGE, "%s", reason);
    return tell(&error, to);
}

static RenderSettings settings_of(const RectraySettings *given)
{
    static const RectraySettings defaults = {0};
    given = given ? given : &defaults;
    return (RenderSettings){
        .precision = given->in_double || given->reference ? PRECISION_DOUBLE : PRECISION_FLOAT,
        .threads = given->threads,
        .device = given->device - 1,
    };
}

static Backend backend_of(const RectraySettings *given)
{
    return given && given->reference ? BACKEND_REFERENCE : BACKEND_OPENCL;
}

/* --- Scenes --- */

/* Takes over a scene that was read, or the error. */
static RectrayScene *scene_kept(bool read, Scene *scene, Error *error, RectrayError *told)
{
    RectrayScene *kept = read ? malloc(sizeof *kept) : NULL;
    if (kept)
        kept->scene = *scene;
    else if (read) {
        scene_free(scene);
        error_memory(error, "a scene");
    }
    if (!kept)
        tell(error, told);
    return kept;
}

RectrayScene *rectray_scene_load(const char *path, RectrayError *error)
{
    Scene scene;
    Error fault = {.kind = ERROR_NONE};
    bool read = scene_load(&scene, path, &fault);
    return scene_kept(read, &scene, &fault, error);
}

RectrayScene *rectray_scene_parse(const char *name, const char *text, long length, RectrayError *error)
{
    Scene scene;
    Error fault = {.kind = ERROR_NONE};
    bool read = scene_parse(&scene, name, text, length, &fault);
    return scene_kept(read, &scene, &fault, error);
}

void rectray_scene_free(RectrayScene *scene)
{
    if (!scene)
        return;
    scene_free(&scene->scene);
    free(scene);
}

void rectray_scene_size(const RectrayScene *scene, int *columns, int *rows)
{
    *columns = scene->scene.screen.columns;
    *rows = scene->scene.screen.rows;
}

int rectray_scene_resize(RectrayScene *scene, int columns, int rows)
{
    if (columns < 1 || columns > SCENE_MAX_PIXELS || rows < 1 || rows > SCENE_MAX_PIXELS)
        return 0;
    scene->scene.screen.columns = columns;
    scene->scene.screen.rows = rows;
    return 1;
}

/* --- Pictures --- */

typedef struct Receiver {
    RectrayBand band;
    void *user;
} Receiver;

static bool hand_on(void *user, int first_row, int rows, const unsigned char *rgb, const RenderReport *so_far,
                    Error *error)
{
    const Receiver *receiver = user;
    (void)so_far;
    return receiver->band(receiver->user, first_row, rows, rgb) ||
           error_set(error, ERROR_USAGE, "the receiver of the picture stopped it");
}

int rectray_render(const RectrayScene *scene, const RectraySettings *settings, RectrayBand band, void *user,
                   RectrayError *error)
{
    Error fault = {.kind = ERROR_NONE};
    Receiver receiver = {band, user};
    RenderReport report;
    RenderSettings wanted = settings_of(settings);
    return backend_render(backend_of(settings), &scene->scene, &wanted, (BandSink){hand_on, &receiver}, &report,
                          &fault) ||
           tell(&fault, error);
}

/* --- Rays --- */

static bool are_rays(const Scene *scene, const double *rays, long count)
{
    for (long i = 0; i < count; i++) {
        const double *ray = rays + 6 * i;
        if (!world_ray_origin_in_range(ray, scene->centre) || !world_ray_direction_in_range(ray) ||
            !world_ray_has_direction(ray))
            return false;
    }
    return true;
}

/* `local` has room for the rays, `found` for the hits. */
static bool cast(const Scene *scene, const RectraySettings *settings, const double *rays, long count, RectrayHit *hits,
                 double *local, CastHit *found, Error *error)
{
    RenderSettings wanted = settings_of(settings);
    RenderReport report = {0};
    BackendCaster caster;
    for (long i = 0; i < count; i++)
        world_ray_localise(rays + 6 * i, scene->centre, local + 6 * i);
    bool done = backend_caster_open(&caster, backend_of(settings), scene, &wanted, &report, error) &&
                backend_cast(&caster, local, count, found, &report, error);
    backend_caster_close(&caster);
    for (long i = 0; i < count && done; i++) {
        double ray[6];
        int exponent = world_ray_localise(rays + 6 * i, scene->centre, ray);
        hits[i].face = found[i].face < 0 ? -1 : scene->faces[found[i].face].number;
        hits[i].t = found[i].face < 0 ? 0 : world_ray_t(found[i].t, exponent);
    }
    return done;
}

int rectray_cast(const RectrayScene *scene, const RectraySettings *settings, const double *rays, long count,
                 RectrayHit *hits, RectrayError *error)
{
    if (count < 0 || !are_rays(&scene->scene, rays, count))
        return refuse(
            error,
            "a ray is six finite numbers: an origin within 1e12 of the scene's centre, and a direction that is not "
            "zero; each component is 0 or at least 1e-60, of the direction at most 1e60");
    if (count == 0)
        return 1;
    Error fault = {.kind = ERROR_NONE};
    double *local = malloc((size_t)count * 6 * sizeof *local);
    CastHit *found = malloc((size_t)count * sizeof *found);
    bool done = local && found ? cast(&scene->scene, settings, rays, count, hits, local, found, &fault)
                               : error_memory(&fault, "the rays");
    free(local);
    free(found);
    return done || tell(&fault, error);
}

/* --- Walkthroughs --- */

char *rectray_trace(const RectrayScene *scene, int column, int row, RectrayError *error)
{
    const Screen *screen = &scene->scene.screen;
    if (column < 0 || column >= screen->columns || row < 0 || row >= screen->rows) {
        refuse(error, "the pixel is outside the picture");
        return NULL;
    }
    Error fault = {.kind = ERROR_NONE};
    Walkthrough walk;
    char *text = NULL;
    size_t size = 0;
    WalkthroughRequest request = {.column = column, .row = row};
    bool done = walkthrough_record(&walk, &scene->scene, NULL, "scene", request, &fault);
    FILE *out = done ? open_memstream(&text, &size) : NULL;
    done = out && walkthrough_write_json(out, &walk, (WalkthroughStyle){.parts = WALKTHROUGH_WHOLE}, &fault);
    if (out)
        done = fclose(out) == 0 && done;
    walkthrough_free(&walk);
    if (done)
        return text;
    error_memory(&fault, "the walkthrough"); /* unless another fault is told */
    free(text);
    tell(&fault, error);
    return NULL;
}

void rectray_free(char *text)
{
    free(text);
}
