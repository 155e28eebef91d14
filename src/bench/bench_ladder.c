/* The ladder of scenes. */
#include "bench/bench_ladder.h"

#include "reader/generate.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

const BenchRung bench_ladder[] = {
    {"original", "scenes/original.json", NULL, 0, true},
    {"cornell", "scenes/cornell.json", NULL, 0, true},
    {"mirrors", "scenes/mirrors.json", NULL, 0, true},
    {"gallery", "scenes/gallery.json", NULL, 0, true},
    {"menger-2", NULL, "menger", 2, true},
    {"menger-3", NULL, "menger", 3, false},
    {"menger-4", NULL, "menger", 4, false},
    {"city-1k", NULL, "city", 1000, true},
    {"city-20k", NULL, "city", 20000, false},
    {"city-200k", NULL, "city", 200000, false},
    {0},
};

const BenchRung bench_lessons[] = {
    {"acne", "scenes/lessons/acne.json", NULL, 0, true},
    {"leak", "scenes/lessons/leak.json", NULL, 0, true},
    {"cracks", "scenes/lessons/cracks.json", NULL, 0, true},
    {"far", "scenes/lessons/far.json", NULL, 0, true},
    {"light_in_the_plane", "scenes/lessons/light_in_the_plane.json", NULL, 0, true},
    {"camera_in_the_plane", "scenes/lessons/camera_in_the_plane.json", NULL, 0, true},
    {0},
};

const BenchRung *bench_rung_named(const char *name)
{
    const BenchRung *rung = bench_ladder;
    while (rung->name && strcmp(rung->name, name) != 0)
        rung++;
    return rung;
}

/* Generates the scene's file, KIND-SIZE.json in the folder. */
static bool generate(BenchScene *scene, const char *kind_name, int size, const BenchFolder *folder, Error *error)
{
    const GenerateKind *kind = generate_find_kind(kind_name, error);
    if (!kind)
        return false;
    snprintf(scene->path, sizeof scene->path, "%s/%s-%d.json", folder->path, kind_name, size);
    FILE *out = fopen(scene->path, "w");
    bool made = out && generate_scene(kind, out, size, 0, error);
    if (out && fclose(out) == 0 && made)
        return true;
    return error_set(error, ERROR_SYSTEM, "cannot write %s: %s", scene->path, strerror(errno));
}

bool bench_rung(const BenchRung *rung, const BenchFolder *folder, BenchScene *scene, Error *error)
{
    *scene = (BenchScene){.columns = 0};
    snprintf(scene->name, sizeof scene->name, "%s", rung->name);
    if (!rung->path)
        return generate(scene, rung->kind, rung->size, folder, error);
    snprintf(scene->path, sizeof scene->path, "%s", rung->path);
    return true;
}
