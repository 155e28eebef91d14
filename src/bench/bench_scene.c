/* Where a scene to measure comes from, and in how many pixels it is measured. */
#include "bench/bench_scene.h"

#include "base/text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

bool bench_scene_of(const char *path, BenchScene *scene, Error *error)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path, *dot = strrchr(name, '.');
    int length = (int)(dot && dot != name ? dot - name : (long)strlen(name));
    *scene = (BenchScene){.columns = 0};
    if (strlen(path) >= sizeof scene->path || length >= BENCH_NAME)
        return error_set(error, ERROR_USAGE, "the path is too long: %s", path);
    snprintf(scene->name, sizeof scene->name, "%.*s", length, name);
    text_make_utf8(scene->name);
    snprintf(scene->path, sizeof scene->path, "%s", path);
    return true;
}

void bench_scene_fit(BenchScene *scene, const Screen *screen, int pixels)
{
    double shrink = sqrt(pixels / ((double)screen->columns * screen->rows));
    scene->columns = (int)fmax(1, floor(screen->columns * shrink + 0.5));
    scene->rows = (int)fmax(1, floor(screen->rows * shrink + 0.5));
}

void bench_tell(const Scene *scene, const BenchPlan *plan)
{
    if (plan->tells)
        notes_print(&scene->notes, stderr, false);
}
