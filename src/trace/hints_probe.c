/* Follows paths, and counts which lights they reach. */
#include "trace/hints_probe.h"

#include "scene/hints_light.h"
#include "trace/reference.h"
#include "trace/reference_render.h"

#include <stdlib.h>

enum {
    FACES_MOST = 1 << 18, /* of a scene that is probed: a hint is not worth a larger tree */
    PIXELS_MOST = 4096,
    LOOKS_MOST = 1 << 17, /* of all points at all lights, about */
    HITS_FEW = 256        /* tell nothing of a light */
};

/* What the paths have met. */
typedef struct Probe {
    int hits;
    bool coloured; /* some path has a colour that is not rounded to black */
    int *reached;  /* for each light: points that it reaches */
    int *blocker;  /* for each light: the first face in its way, -1: none */
} Probe;

static void watch(void *user, const Event *event)
{
    Probe *probe = user;
    if (event->kind == EVENT_HIT)
        probe->hits++;
    if (event->kind != EVENT_LIGHT_END)
        return;
    int light = event->as.light_end.light;
    if (event->as.light_end.verdict == LIGHT_REACHES)
        probe->reached[light]++;
    else if (probe->blocker[light] < 0)
        probe->blocker[light] = event->as.light_end.blocker;
}

/* Traces so many pixels, one ray each. */
static void follow(Probe *probe, const Scene *scene, const Accel *accel, int pixels)
{
    const Recorder recorder = {watch, probe};
    RenderReport report = {0};
    const Tracer tracer = {.scene = scene, .accel = accel, .report = &report, .recorder = &recorder};
    int columns = scene->screen.columns, all = columns * scene->screen.rows, step = reference_spread(all);
    for (long long i = 0, place = 0; i < pixels; i++, place = (place + step) % all) {
        Vec3 colour = reference_sample(&tracer, (int)(place % columns), (int)(place / columns), 0, 0);
        probe->coloured = probe->coloured || vec3_largest(colour) >= 0.5 / 255;
    }
}

static bool tell_lights(Hints *hints, const Scene *scene, const Probe *probe, Error *error)
{
    for (int i = 0; i < scene->light_count; i++) {
        bool told = hints_have(hints, HINT_LIGHT_IN_BOX, i) || hints_have(hints, HINT_LIGHT_OUT_OF_BOX, i) ||
                    hints_have(hints, HINT_LIGHT_BEHIND, i) || hint_light_is_black(&scene->lights[i]);
        if (!told && probe->reached[i] == 0 &&
            !hint_add(hints, (Hint){HINT_LIGHT_HIDDEN, i, probe->blocker[i], 1}, error))
            return false;
    }
    return true;
}

/* certain: what the probe has not seen is not there. */
static bool tell(Hints *hints, const Scene *scene, const Probe *probe, bool certain, Error *error)
{
    bool told = hints_have(hints, HINT_NO_FACE_SEEN, -1) || hints_have(hints, HINT_TINY, -1);
    if (probe->hits == 0 && certain && !told && !hint_add(hints, (Hint){HINT_NO_FACE_SEEN, 1, -1, 1}, error))
        return false;
    bool many = probe->hits >= HITS_FEW;
    if ((many || (certain && probe->hits > 0)) && !tell_lights(hints, scene, probe, error))
        return false;
    if (probe->coloured || !(many || certain) || hints_have(hints, HINT_BLACK, -1))
        return true;
    return hint_add(hints, (Hint){HINT_BLACK, probe->hits ? BLACK_UNLIT : BLACK_NO_FACE_SEEN, certain, 1}, error);
}

bool hints_probe(Hints *hints, const Scene *scene, bool blank, Error *error)
{
    Scene single = *scene; /* one ray for each pixel */
    single.grid = 1;
    single.adaptive = false;
    int all = scene->screen.columns * scene->screen.rows, lights = scene->light_count;
    int most = LOOKS_MOST / (lights + 1) < PIXELS_MOST ? LOOKS_MOST / (lights + 1) : PIXELS_MOST;
    int pixels = all < most ? all : most;
    if (scene->face_count == 0 || scene->face_count > FACES_MOST || pixels == 0)
        return true;
    Probe probe = {.reached = calloc((size_t)lights + 1, sizeof(int)),
                   .blocker = malloc(((size_t)lights + 1) * sizeof(int))};
    Accel accel = {0};
    bool good = (probe.reached && probe.blocker) || error_memory(error, "the lights of the scene");
    for (int i = 0; good && i < lights; i++)
        probe.blocker[i] = -1;
    good = good && accel_build(&accel, scene, ACCEL_AUTO, 0, error);
    if (good) {
        follow(&probe, &single, &accel, pixels);
        good = tell(hints, scene, &probe, blank || (pixels == all && scene->grid == 1), error);
    }
    accel_free(&accel);
    free(probe.reached);
    free(probe.blocker);
    return good;
}
