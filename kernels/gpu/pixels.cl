/* Which pixel a work-item renders, what it leaves to the exact pass, and its counts. A group renders 8 x 8 pixels:
 * their rays meet the same faces. */
#include "shared/layout.h"
#include "shared/precision.cl"
#include "plain/scene.cl"

enum { GROUP_ACROSS = 8, GROUP_ITEMS = GROUP_ACROSS * GROUP_ACROSS };

/* The work-item's pixel. */
static int2 pixel_of_item(int columns)
{
    int across = (columns + GROUP_ACROSS - 1) / GROUP_ACROSS, group = (int)get_group_id(0), item = (int)get_local_id(0);
    return (int2)(group % across * GROUP_ACROSS + item % GROUP_ACROSS,
                  group / across * GROUP_ACROSS + item / GROUP_ACROSS);
}

/* The samples of a pixel: a grid of them, or the lattice of render_adaptive, which has a generator. */
static int sample_count(constant const Parameters *p) { return p->generator ? p->grid : p->grid * p->grid; }

/* The sub-pixel of sample k. */
static int2 place_of_sample(constant const Parameters *p, int k)
{
    return p->generator ? (int2)(k, k * p->generator % p->grid) : (int2)(k % p->grid, k / p->grid);
}

/* Samples of a pixel, in turn: as many shares as DOUBT_SHARES, or one for each sample where there are fewer. A share
 * with a sample in doubt is traced exactly as a whole. */
static int samples_per_share(int samples) { return (samples + DOUBT_SHARES - 1) / DOUBT_SHARES; }

/* What a pixel's samples have summed up to. */
typedef struct PixelSums {
    float sum[3];   /* of the shares that are sure */
    float share[3]; /* of the samples of the share that is being traced */
    uint doubts[2]; /* a bit for each share in doubt */
} PixelSums;

static void begin_sums(local PixelSums *sums)
{
    vstore3((float3)0, 0, sums->sum);
    vstore3((float3)0, 0, sums->share);
    sums->doubts[0] = sums->doubts[1] = 0;
}

static void doubt_share(local PixelSums *sums, int share) { sums->doubts[share / 32] |= 1u << share % 32; }

static bool is_in_doubt(local const PixelSums *sums, int share) { return sums->doubts[share / 32] >> share % 32 & 1; }

/* Adds the share to the sum, unless it is in doubt. */
static void end_share(local PixelSums *sums, int share)
{
    if (!is_in_doubt(sums, share))
        vstore3(vload3(0, sums->sum) + vload3(0, sums->share), 0, sums->sum);
    vstore3((float3)0, 0, sums->share);
}

/* A list with the number of its entries. */
typedef struct DoubtList {
    volatile global uint *count;
    global uint *entries;
} DoubtList;

/* Puts a pixel on the list of those in doubt. */
static void store_doubt(DoubtList list, int pixel, local const PixelSums *sums)
{
    global uint *entry = list.entries + (size_t)atomic_inc(list.count) * DOUBT_WORDS;
    entry[DOUBT_PIXEL] = (uint)pixel;
    entry[DOUBT_SHARE_BITS] = sums->doubts[0];
    entry[DOUBT_SHARE_BITS + 1] = sums->doubts[1];
    vstore3(as_uint3(vload3(0, sums->sum)), 0, entry + DOUBT_SUM);
}

/* Forgets the rays of a share in doubt. */
static void forget_rays(Scene *scene)
{
    scene->counts[COUNT_PRIMARY] = scene->counts[COUNT_SHADOW] = scene->counts[COUNT_REFLECTION] = 0;
    scene->counts[COUNT_SKIPPED + SKIP_LIGHT_BEHIND] = 0;
}

static void add_kind(volatile local uint *group, Scene *scene, int kind)
{
    if (scene->counts[kind])
        atomic_add(group + kind, scene->counts[kind]);
    scene->counts[kind] = 0;
}

/* Adds the counts of this work-item to those of its group, and forgets them. Named one by one, they can be kept in
 * registers. */
static void add_to_group(volatile local uint *group, Scene *scene)
{
    add_kind(group, scene, COUNT_PRIMARY);
    add_kind(group, scene, COUNT_SHADOW);
    add_kind(group, scene, COUNT_REFLECTION);
    add_kind(group, scene, COUNT_FACE_TESTS);
    add_kind(group, scene, COUNT_BOX_TESTS);
    add_kind(group, scene, COUNT_SKIPPED + SKIP_LIGHT_BEHIND);
}

/* Step 10: the colour as three bytes, or, with the build option LINEAR, as three numbers. */
static void store_colour(global uchar *picture, int pixel, float3 colour)
{
    float rgb[3] = {colour.x, colour.y, colour.z};
    for (int i = 0; i < 3; i++)
#ifdef LINEAR
        ((global float *)picture)[3 * (size_t)pixel + i] = rgb[i];
#else
        picture[3 * (size_t)pixel + i] = (uchar)(255 * clamp(rgb[i], 0.0f, 1.0f) + 0.5f); /* rounded down */
#endif
}

/* Stores what the pixel's samples have summed up to, or leaves it to the exact pass. */
static void store_sums(const Scene *scene, int pixel, local const PixelSums *sums, DoubtList list,
                       global uchar *picture)
{
    if (sums->doubts[0] | sums->doubts[1])
        store_doubt(list, pixel, sums);
    else
        store_colour(picture, pixel, vload3(0, sums->sum) / sample_count(scene->parameters));
}

/* Adds the counts of a group to those of all. To be called when its work-items are done. */
static void add_group(volatile global uint *totals, volatile local uint *group)
{
    int item = (int)get_local_id(0);
    if (item < COUNTER_KINDS && group[item])
        atomic_add(totals + get_group_id(0) % COUNTER_STRIPES * COUNTER_STRIDE + item, group[item]);
}
