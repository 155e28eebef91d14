/* Which faces a path has met, for adaptive sampling. */
#include "shared/layout.h"
#include "plain/scene.cl"

/* A pixel's words in the memory of the device: see TRAIL_COUNT. From one word to the next it is `step`, so that
 * neighbouring work-items write neighbouring words. */
typedef struct Trail {
    global int *words; /* 0: nobody asks */
    size_t step;
} Trail;

static Trail no_trail(void)
{
    Trail none = {0, 0};
    return none;
}

/* That of a pixel of a band. */
static Trail trail_of(global int *trails, int pixel, int pixels)
{
    Trail trail = {trails + pixel, (size_t)pixels};
    return trail;
}

/* Hit number `hit` of the path, from 0 on, was that face; -1: it left the scene. */
static void keep_hit(Trail trail, int hit, int face)
{
    if (trail.words)
        trail.words[(TRAIL_FACES + hit) * trail.step] = face;
}

/* The path has ended. The scene counts its reflections. */
static void end_trail(Trail trail, const Scene *scene)
{
    if (trail.words)
        trail.words[TRAIL_COUNT * trail.step] = 1 + (int)scene->counts[COUNT_REFLECTION];
}
