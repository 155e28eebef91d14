/* Where a scene to measure comes from, and in how many pixels it is measured. */
#ifndef RECTRAY_BENCH_SCENE_H
#define RECTRAY_BENCH_SCENE_H

#include "bench/bench.h"
#include "scene/scene.h"

/* The scene of a path: its name is the file's without its extension. */
bool bench_scene_of(const char *path, BenchScene *scene, Error *error);

/* The screen's own shape in about so many pixels. */
void bench_scene_fit(BenchScene *scene, const Screen *screen, int pixels);

/* Tells the notes on a scene that was read, if the plan says so. */
void bench_tell(const Scene *scene, const BenchPlan *plan);

#endif
