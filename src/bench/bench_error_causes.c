/* Which causes the error of the default has: one step of its way to a picture is changed at a time. */
#include "bench/bench_error_causes.h"

enum { CAUSE_GRID = 16 };

enum { PLAIN, BYTES, EXACT, SHALLOW, DEEP, PICTURES };

static bool trace_causes(BenchPicture *pictures, const Scene *scene, const BenchPlan *plan, Error *error)
{
    Scene whole = *scene;
    RenderSettings plain = plan->settings, exact = plan->settings;
    whole.shading.max_bounces = SCENE_MAX_BOUNCES;
    plain.precision = PRECISION_FLOAT;
    exact.precision = PRECISION_DOUBLE;
    return bench_picture(&pictures[PLAIN], scene, BACKEND_OPENCL, &plain, error) &&
           bench_picture(&pictures[BYTES], scene, BACKEND_OPENCL, &plain, error) &&
           bench_picture(&pictures[EXACT], scene, BACKEND_OPENCL, &exact, error) &&
           bench_picture_fine(&pictures[SHALLOW], scene, CAUSE_GRID, &exact, error) &&
           bench_picture_fine(&pictures[DEEP], &whole, CAUSE_GRID, &exact, error);
}

bool bench_error_find_causes(ErrorCauses *causes, const Scene *scene, const BenchGroundTruth *truth,
                             const BenchPlan *plan, Error *error)
{
    BenchPicture pictures[PICTURES] = {{0}};
    bool ok = trace_causes(pictures, scene, plan, error);
    if (ok) {
        BenchPicture *deep = &pictures[DEEP];
        bench_picture_quantise(&pictures[BYTES]);
        causes->arithmetic = bench_difference(&pictures[PLAIN], &pictures[EXACT]).rmse;
        causes->sampling = bench_difference(&pictures[EXACT], &truth->picture).rmse;
        causes->truncation = bench_difference(&pictures[SHALLOW], deep).rmse;
        causes->output = bench_difference(&pictures[BYTES], &pictures[PLAIN]).rmse;
        /* The truth of 64 bounces: that of the scene's, and what the others add. */
        for (size_t i = 0; i < (size_t)deep->columns * (size_t)deep->rows * 3; i++)
            deep->rgb[i] += truth->picture.rgb[i] - pictures[SHALLOW].rgb[i];
        causes->all = bench_difference(&pictures[BYTES], deep).rmse;
    }
    for (int i = 0; i < PICTURES; i++)
        bench_picture_free(&pictures[i]);
    return ok;
}
