/* Blocks of 8 x 8 pixels, four packets of 4 x 4, go through primary ray, surface, shadow rays and mirrors together;
 * threads take squares of 32 x 32. */
#define _GNU_SOURCE /* pthread_setaffinity_np */
#include "peer_trace.h"

#include "base/clock.h"
#include "base/parallel.h"
#include "peer_shade.h"
#include "scene/geometry.h"

#include <immintrin.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK = 8, SQUARE = 32, MAX_LIGHTS = 64 };

/* What all threads read, and the number of the next square. */
typedef struct Job {
    const PeerScene *peer;
    PeerModes modes;
    bool timed;
    unsigned char *rgb;
    Vec1 eye, forward, right, up, background;
    float width, height;
    LightRow lights[MAX_LIGHTS];
    int next_square, next_processor; /* atomic */
    bool all_processors;
    PeerReport report;
    int lock;
} Job;

typedef struct Block {
    Lanes active, lit;
    float weight[PACKETS][WIDTH] __attribute__((aligned(64)));
    Vec16 colour[PACKETS];
    Surface surface[PACKETS];
    struct RTCRayHit16 rays[PACKETS];
    struct RTCRay16 shadow[PACKETS];
    PeerReport report;
} Block;

/* --- Queries, with the clock --- */

static void nearest(const Job *job, Block *b, const QueryMode *mode)
{
    double start = job->timed ? clock_ms() : 0;
    query_nearest(job->peer, mode, &b->active, b->rays);
    if (job->timed)
        b->report.query_ms += clock_ms() - start;
}

static void occluded(const Job *job, Block *b, const Lanes *asking)
{
    double start = job->timed ? clock_ms() : 0;
    query_occluded(job->peer, job->modes.shadow, job->modes.from_light ? -1 : 1, asking, b->shadow);
    if (job->timed)
        b->report.query_ms += clock_ms() - start;
}

/* --- One block --- */

/* The rays to sub-pixel (i, j) of each pixel: see view_direction in geometry.c. */
static void primary_rays(const Job *job, Block *b, int first_column, int first_row, int i, int j)
{
    const Screen *screen = &job->peer->scene->screen;
    float grid = (float)job->peer->scene->grid, columns = (float)screen->columns, rows = (float)screen->rows;
    float sub_column = ((float)i + 0.5f) / grid, sub_row = ((float)j + 0.5f) / grid;
    for (int p = 0; p < PACKETS; p++) {
        struct RTCRay16 *r = &b->rays[p].ray;
        for (int k = 0; k < WIDTH; k++) {
            int column = first_column + p % 2 * 4 + k % 4, row = first_row + p / 2 * 4 + k / 4;
            float x = (((float)column + sub_column) / columns - 0.5f) * job->width;
            float y = (0.5f - ((float)row + sub_row) / rows) * job->height;
            r->org_x[k] = job->eye.x, r->org_y[k] = job->eye.y, r->org_z[k] = job->eye.z;
            r->dir_x[k] = job->forward.x + x * job->right.x + y * job->up.x;
            r->dir_y[k] = job->forward.y + x * job->right.y + y * job->up.y;
            r->dir_z[k] = job->forward.z + x * job->right.z + y * job->up.z;
            r->tnear[k] = 0, r->tfar[k] = INFINITY, r->time[k] = 0;
            r->mask[k] = ~0u, r->id[k] = r->flags[k] = 0;
            b->rays[p].hit.geomID[k] = b->rays[p].hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
            b->active.on[p][k] = -((column < screen->columns) & (row < screen->rows));
            b->report.rays.primary += (uint64_t)-b->active.on[p][k];
            b->weight[p][k] = 1;
        }
    }
}

/* Misses take the background and end; hits get their surfaces. Returns whether any lane goes on. */
static bool surfaces(const Job *job, Block *b)
{
    int left = 0;
    for (int p = 0; p < PACKETS; p++) {
        int here = 0;
        for (int k = 0; k < WIDTH; k++) {
            int hit = -(b->rays[p].hit.geomID[k] != RTC_INVALID_GEOMETRY_ID);
            float missed = b->active.on[p][k] & ~hit ? b->weight[p][k] : 0;
            b->colour[p].x[k] += missed * job->background.x;
            b->colour[p].y[k] += missed * job->background.y;
            b->colour[p].z[k] += missed * job->background.z;
            b->active.on[p][k] &= hit;
            here |= b->active.on[p][k];
            b->lit.on[p][k] = 0;
        }
        left |= here;
        if (here)
            surface_fill(job->peer, job->eye, &b->rays[p], b->active.on[p], &b->surface[p]);
    }
    return left != 0;
}

static void shade_by(const Job *job, Block *b, const LightRow *light)
{
    bool always_ambient = job->peer->scene->shading.shadow == SHADOW_AMBIENT;
    Lanes asking;
    int asked = 0;
    for (int p = 0; p < PACKETS; p++)
        asked += shadow_rays(&b->surface[p], light->position, job->modes.from_light, b->active.on[p], asking.on[p],
                             &b->shadow[p]);
    b->report.rays.shadow += (uint64_t)asked;
    if (asked > 0)
        occluded(job, b, &asking);
    else if (!always_ambient)
        return;
    for (int p = 0; p < PACKETS; p++) {
        int reaching[WIDTH], counted[WIDTH], any = 0;
        for (int k = 0; k < WIDTH; k++) {
            reaching[k] = asking.on[p][k] & -(b->shadow[p].tfar[k] > 0);
            b->lit.on[p][k] |= reaching[k];
            counted[k] = always_ambient ? b->active.on[p][k] : reaching[k];
            any |= counted[k];
        }
        if (any)
            illuminate16(job->peer, &b->surface[p], light, reaching, counted, b->weight[p], &b->colour[p]);
    }
}

/* Ends the paths in shadow, where that is the rule, and those on surfaces that are no mirrors. */
static bool bounce(const Job *job, Block *b)
{
    int on = 0;
    for (int p = 0; p < PACKETS; p++) {
        if (job->peer->scene->shading.shadow == SHADOW_BLACK)
            for (int k = 0; k < WIDTH; k++)
                b->active.on[p][k] &= b->lit.on[p][k];
        on += reflect16(job->peer, &b->surface[p], b->active.on[p], b->weight[p], &b->rays[p]);
    }
    b->report.rays.reflection += (uint64_t)on;
    return on > 0;
}

static void trace_paths(const Job *job, Block *b)
{
    const Scene *scene = job->peer->scene;
    nearest(job, b, job->modes.primary);
    for (int bounces = 0; surfaces(job, b); bounces++) {
        for (int i = 0; i < scene->light_count; i++)
            shade_by(job, b, &job->lights[i]);
        if (bounces == scene->shading.max_bounces || !job->peer->materials.mirrors || !bounce(job, b))
            return;
        nearest(job, b, job->modes.reflection);
    }
}

/* A row of four pixels, 0x00BBGGRR each, as twelve bytes (little-endian, as all that Embree runs on). */
static void store_four(unsigned char *out, const uint32_t *pixel)
{
    uint32_t words[3] = {pixel[0] | pixel[1] << 24, pixel[1] >> 8 | pixel[2] << 16, pixel[2] >> 16 | pixel[3] << 8};
    memcpy(out, words, sizeof words);
}

static void store(const Job *job, const Block *b, int first_column, int first_row)
{
    const Screen *screen = &job->peer->scene->screen;
    float scale = 1 / ((float)job->peer->scene->grid * (float)job->peer->scene->grid);
    for (int p = 0; p < PACKETS; p++) {
        const float *from[3] = {b->colour[p].x, b->colour[p].y, b->colour[p].z};
        uint32_t pixels[WIDTH] = {0};
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < WIDTH; k++) {
                float value = from[c][k] * scale;
                value = value > 0 ? value : 0;
                pixels[k] |= (uint32_t)(int)(255 * (value < 1 ? value : 1) + 0.5f) << 8 * c;
            }
        int column = first_column + p % 2 * 4, row = first_row + p / 2 * 4;
        for (int k = 0; k < 4 && row + k < screen->rows && column < screen->columns; k++) {
            unsigned char bytes[12];
            unsigned char *out = job->rgb + ((size_t)(row + k) * (size_t)screen->columns + (size_t)column) * 3;
            int inside = screen->columns - column;
            store_four(inside < 4 ? bytes : out, pixels + 4 * k);
            if (inside < 4)
                memcpy(out, bytes, (size_t)inside * 3);
        }
    }
}

static void render_block(const Job *job, Block *b, int first_column, int first_row)
{
    memset(b->colour, 0, sizeof b->colour);
    for (int j = 0; j < job->peer->scene->grid; j++)
        for (int i = 0; i < job->peer->scene->grid; i++) {
            primary_rays(job, b, first_column, first_row, i, j);
            trace_paths(job, b);
        }
    store(job, b, first_column, first_row);
}

/* --- All blocks --- */

/* Each thread has a processor of its own, as ours have. */
static void take_processor(Job *job)
{
    cpu_set_t own;
    CPU_ZERO(&own);
    CPU_SET((size_t)__atomic_fetch_add(&job->next_processor, 1, __ATOMIC_RELAXED), &own);
    pthread_setaffinity_np(pthread_self(), sizeof own, &own);
}

static void render_squares(void *argument)
{
    Job *job = argument;
    if (job->all_processors)
        take_processor(job);
    const Screen *screen = &job->peer->scene->screen;
    int across = (screen->columns + SQUARE - 1) / SQUARE, down = (screen->rows + SQUARE - 1) / SQUARE;
    Block *block;
    if (posix_memalign((void **)&block, 64, sizeof *block) != 0)
        abort(); /* a measurement without memory measures nothing */
    memset(block, 0, sizeof *block);
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON); /* as Embree's manual advises */
    _mm_setcsr(_mm_getcsr() | 0x40);            /* denormals are zero */
    for (int square; (square = __atomic_fetch_add(&job->next_square, 1, __ATOMIC_RELAXED)) < across * down;)
        for (int row = square / across * SQUARE; row < (square / across + 1) * SQUARE && row < screen->rows;
             row += BLOCK)
            for (int column = square % across * SQUARE;
                 column < (square % across + 1) * SQUARE && column < screen->columns; column += BLOCK)
                render_block(job, block, column, row);
    while (__atomic_exchange_n(&job->lock, 1, __ATOMIC_ACQUIRE))
        ;
    job->report.rays.primary += block->report.rays.primary;
    job->report.rays.shadow += block->report.rays.shadow;
    job->report.rays.reflection += block->report.rays.reflection;
    job->report.query_ms += block->report.query_ms;
    __atomic_store_n(&job->lock, 0, __ATOMIC_RELEASE);
    free(block);
}

PeerReport peer_trace(const PeerScene *peer, PeerModes modes, int threads, bool timed, unsigned char *rgb)
{
    static int all_processors = -1; /* asked before any thread has taken one */
    if (all_processors < 0)
        all_processors = parallel_may_use_all();
    double start = clock_ms();
    const Scene *scene = peer->scene;
    View view = view_of(scene);
    Job job = {.peer = peer, .modes = modes, .timed = timed, .rgb = rgb, .all_processors = all_processors};
    job.eye = vec1(view.eye), job.forward = vec1(view.forward), job.right = vec1(view.right), job.up = vec1(view.up);
    job.background = vec1(scene->shading.background);
    job.width = (float)view.width, job.height = (float)view.height;
    for (int i = 0; i < scene->light_count && i < MAX_LIGHTS; i++) {
        const Light *light = &scene->lights[i];
        job.lights[i] =
            (LightRow){vec1(light->position), vec1(light->ambient), vec1(light->diffuse), vec1(light->specular)};
    }
    parallel_run(threads, render_squares, &job);
    job.report.trace_ms = clock_ms() - start;
    return job.report;
}
