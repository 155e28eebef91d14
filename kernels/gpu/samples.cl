/* A pixel's samples, traced one after another by one work-item. Its sums lie in the memory of the group: registers are
 * for the search. A function that two kernels of a program call is inlined in both: for a call it would take 128 bytes
 * of private memory. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "plain/scene.cl"
#include "gpu/path.cl"
#include "gpu/pixels.cl"

/* Traces the samples of the pixel in that column and row of the picture. trail: of the last one. */
INLINE void sample_pixel(Scene *scene, int column, int row, Trail trail, local PixelSums *sums,
                         volatile local uint *group_counts)
{
    int samples = sample_count(scene->parameters), each = samples_per_share(samples);
    begin_sums(sums);
    for (int k = 0; k < samples; k++) {
        int2 at = place_of_sample(scene->parameters, k);
        int share = k / each;
        if (!trace_path(scene, primary_ray(scene, column, row, at.x, at.y), trail, sums->share))
            doubt_share(sums, share);
        scene->counts[COUNT_PRIMARY]++;
        if (k + 1 < samples && (k + 1) / each == share)
            continue;
        if (is_in_doubt(sums, share))
            forget_rays(scene); /* the exact pass counts its own */
        else
            end_trail(trail, scene);
        end_share(sums, share);
        add_to_group(group_counts, scene);
    }
}
