/* A bounding volume hierarchy made by sorting the faces along a curve. A key holds, from its highest bit down: whether
 * the face is one of many, the cell of its middle on a Morton curve, and its number. All keys differ, so that the
 * highest bit in which the first and the last key of a node differ parts its faces. */
#include "trace/bvh_morton.h"

#include "base/parallel.h"
#include "trace/bvh_boxes.h"

#include <math.h>

#include <stdint.h>
#include <stdlib.h>

/* Cells have the same length along all axes, so that a flat scene is not cut into flat cells. */
enum { AXIS_BITS = 11, CELL_BITS = 3 * AXIS_BITS, NUMBER_BITS = 28 };

#define ONE_OF_MANY ((uint64_t)1 << (CELL_BITS + NUMBER_BITS))
#define NUMBER_MASK (((uint64_t)1 << NUMBER_BITS) - 1)

/* Faces that fill more than this share of the scene's surface are set
 * apart where they are at most one in so many: the floor below a city. */
#define LARGE_SHARE 0.001
enum { LARGE_RARE = 32 };

/* The leaf size from which on there is no leaf, whatever it costs. */
enum { MAX_LEAF = 8 };

/* Fewer faces are sorted by one thread sooner than several start. */
enum { MIN_PARALLEL = 1 << 16 };

/* A subtree of fewer faces, or less than such a part of all, is built by one thread. */
enum { MIN_TASK = 4096, TASKS = 32 };

/* A subtree over the faces of the keys [first, first + count), and its box when it is built. */
typedef struct Task {
    int node, first, count;
    Bounds box;
} Task;

typedef struct Morton {
    Bvh *bvh;
    BvhBoxes boxes;
    double large_area;   /* of a face that is set apart */
    int *large;          /* how many of these are in each piece */
    float low[3], cells; /* the corner of the first cell; cells per unit of length */
    uint64_t *keys, *spare;
    Task *tasks;
    int task_size, task_count;
} Morton;

/* --- Keys --- */

static bool is_large(const Morton *morton, int i)
{
    return bounds_half_area(&morton->boxes.boxes[i]) > morton->large_area;
}

/* The range of a piece without its large faces, and how many these are. */
static void find_large(void *data, int piece, int thread)
{
    const Morton *morton = data;
    BoundsRange rest = bounds_range_empty();
    int end = bvh_boxes_end(&morton->boxes, piece), large = 0;
    (void)thread;
    for (int i = piece * BVH_PIECE; i < end; i++)
        if (is_large(morton, i))
            large++;
        else
            bounds_range_grow(&rest, &morton->boxes.boxes[i]);
    morton->boxes.pieces[piece] = rest;
    morton->large[piece] = large;
}

/* Chooses the cells; with no faces to be set apart the area becomes infinite. */
static void choose_cells(Morton *morton, int threads)
{
    BoundsRange rest = morton->boxes.all;
    morton->large_area = LARGE_SHARE * bounds_half_area(&rest.boxes);
    parallel_for(threads, morton->boxes.piece_count, find_large, morton);
    int large = 0;
    for (int i = 0; i < morton->boxes.piece_count; i++)
        large += morton->large[i];
    if (large <= morton->boxes.count / LARGE_RARE)
        rest = bvh_boxes_join(&morton->boxes);
    else
        morton->large_area = HUGE_VAL;
    float longest = 0;
    for (int axis = 0; axis < 3; axis++) {
        float length = -rest.middles.least[4 + axis] - rest.middles.least[axis];
        morton->low[axis] = rest.middles.least[axis];
        longest = length > longest ? length : longest;
    }
    float cells = (float)(1 << AXIS_BITS) / longest;
    morton->cells = cells < FLT_MAX ? cells : 0;
}

/* The lowest bits of x, with two zeros after each. */
static uint64_t spread(uint64_t x)
{
    x = (x | x << 16) & 0x001f0000ff0000ffu;
    x = (x | x << 8) & 0x100f00f00f00f00fu;
    x = (x | x << 4) & 0x10c30c30c30c30c3u;
    return (x | x << 2) & 0x1249249249249249u;
}

static uint64_t cell_of(const Morton *morton, const Bounds *box)
{
    const float last = (1 << AXIS_BITS) - 1;
    uint64_t cell = 0;
    for (int axis = 0; axis < 3; axis++) {
        float at = (box->least[axis] - box->least[4 + axis] - morton->low[axis]) * morton->cells;
        at = at > 0 ? at : 0;
        cell |= spread((uint64_t)(at < last ? at : last)) << (2 - axis);
    }
    return cell;
}

static void make_keys(void *data, int piece, int thread)
{
    const Morton *morton = data;
    int end = bvh_boxes_end(&morton->boxes, piece);
    (void)thread;
    for (int i = piece * BVH_PIECE; i < end; i++) {
        uint64_t many = is_large(morton, i) ? 0 : ONE_OF_MANY;
        morton->keys[i] = many | cell_of(morton, &morton->boxes.boxes[i]) << NUMBER_BITS | (uint64_t)i;
    }
}

/* --- Sorting, digit by digit from the lowest (radix sort); the numbers are in order from the start --- */

enum { DIGIT_BITS = 12, DIGITS = 1 << DIGIT_BITS, SORT_PIECES = 16 };

typedef struct Sorting {
    const uint64_t *from;
    uint64_t *to;
    int count, pieces, shift;
    int (*places)[DIGITS]; /* per piece, for each digit: how many keys have it, then the place of the next one */
} Sorting;

static int piece_begin(const Sorting *sorting, int piece)
{
    return (int)((int64_t)sorting->count * piece / sorting->pieces);
}

static int digit_of(const Sorting *sorting, int i)
{
    return (int)(sorting->from[i] >> sorting->shift & (DIGITS - 1));
}

static void count_digits(void *data, int piece, int thread)
{
    const Sorting *sorting = data;
    int *counts = sorting->places[piece], end = piece_begin(sorting, piece + 1);
    (void)thread;
    for (int digit = 0; digit < DIGITS; digit++)
        counts[digit] = 0;
    for (int i = piece_begin(sorting, piece); i < end; i++)
        counts[digit_of(sorting, i)]++;
}

static void move_keys(void *data, int piece, int thread)
{
    const Sorting *sorting = data;
    int *places = sorting->places[piece], end = piece_begin(sorting, piece + 1);
    (void)thread;
    for (int i = piece_begin(sorting, piece); i < end; i++)
        sorting->to[places[digit_of(sorting, i)]++] = sorting->from[i];
}

static bool sort_keys(Morton *morton, int threads)
{
    int count = morton->boxes.count, pieces = morton->boxes.piece_count < SORT_PIECES ? 1 : SORT_PIECES;
    Sorting sorting = {.count = count, .pieces = pieces, .places = malloc((size_t)pieces * sizeof *sorting.places)};
    if (!sorting.places)
        return false;
    for (int shift = NUMBER_BITS; shift <= NUMBER_BITS + CELL_BITS; shift += DIGIT_BITS) {
        sorting.from = morton->keys;
        sorting.to = morton->spare;
        sorting.shift = shift;
        parallel_for(threads, pieces, count_digits, &sorting);
        int place = 0;
        for (int digit = 0; digit < DIGITS; digit++)
            for (int piece = 0; piece < pieces; piece++) {
                int keys = sorting.places[piece][digit];
                sorting.places[piece][digit] = place;
                place += keys;
            }
        parallel_for(threads, pieces, move_keys, &sorting);
        morton->spare = morton->keys;
        morton->keys = sorting.to;
    }
    free(sorting.places);
    return true;
}

/* --- The tree --- */

/* How many of the keys [first, first + count), at least two, belong to the left child: those whose bit is not set, the
 * highest in which the first and the last differ. */
static int left_count(const Morton *morton, int first, int count)
{
    const uint64_t *keys = morton->keys + first;
    uint64_t last = keys[count - 1];
    int low = 0, high = count - 1;
    while (high - low > 1) {
        int middle = low + (high - low) / 2;
        /* A key differs more from that one of the two which has another bit there. */
        if ((keys[middle] ^ last) < (keys[middle] ^ keys[0]))
            high = middle;
        else
            low = middle;
    }
    return high;
}

/* Builds a subtree; returns what it costs, in face tests times area. */
static double build_subtree(const Morton *morton, int node, int first, int count, Bounds *box)
{
    Bvh *bvh = morton->bvh;
    if (count == 1) {
        int face = (int)(morton->keys[first] & NUMBER_MASK);
        bvh->order[first] = face;
        *box = morton->boxes.boxes[face];
        bvh->nodes[node] = (BvhNode){bounds_box(*box), first, 1};
        return bounds_half_area(box);
    }
    Bounds right;
    int left = left_count(morton, first, count), second = node + 2 * left;
    double cost = build_subtree(morton, node + 1, first, left, box) +
                  build_subtree(morton, second, first + left, count - left, &right);
    bounds_grow(box, &right);
    double area = bounds_half_area(box);
    cost += BVH_NODE_COST * area;
    bvh->nodes[node] = (BvhNode){bounds_box(*box), second, 0};
    if (count > MAX_LEAF || cost < area * count)
        return cost;
    bvh_make_leaf(bvh, node, first, count);
    return area * count;
}

static void build_task(void *data, int i, int thread)
{
    const Morton *morton = data;
    Task *task = &morton->tasks[i];
    (void)thread;
    build_subtree(morton, task->node, task->first, task->count, &task->box);
}

/* Counts the subtrees for the threads, and lists them where there is a list. */
static void find_tasks(Morton *morton, int node, int first, int count)
{
    if (count <= morton->task_size) {
        if (morton->tasks)
            morton->tasks[morton->task_count] = (Task){.node = node, .first = first, .count = count};
        morton->task_count++;
        return;
    }
    int left = left_count(morton, first, count);
    find_tasks(morton, node + 1, first, left);
    find_tasks(morton, node + 2 * left, first + left, count - left);
}

/* Makes the nodes above the tasks, of which `next` is the first below this one. */
static Bounds build_top(const Morton *morton, int node, int first, int count, const Task **next)
{
    if (count <= morton->task_size)
        return (*next)++->box;
    int left = left_count(morton, first, count), second = node + 2 * left;
    Bounds box = build_top(morton, node + 1, first, left, next);
    Bounds right = build_top(morton, second, first + left, count - left, next);
    bounds_grow(&box, &right);
    morton->bvh->nodes[node] = (BvhNode){bounds_box(box), second, 0};
    return box;
}

static bool build_tree(Morton *morton, int threads)
{
    int count = morton->boxes.count;
    morton->task_size = count / TASKS > MIN_TASK ? count / TASKS : MIN_TASK;
    find_tasks(morton, 0, 0, count);
    morton->tasks = malloc((size_t)morton->task_count * sizeof *morton->tasks);
    if (!morton->tasks)
        return false;
    morton->task_count = 0;
    find_tasks(morton, 0, 0, count);
    parallel_for(threads, morton->task_count, build_task, morton);
    const Task *next = morton->tasks;
    build_top(morton, 0, 0, count, &next);
    return true;
}

static bool make_tree(Morton *morton, const Scene *scene, int threads)
{
    size_t count = (size_t)scene->face_count;
    if (!bvh_allocate(morton->bvh, scene->face_count) || !bvh_boxes_make(&morton->boxes, scene, threads))
        return false;
    morton->large = malloc((size_t)morton->boxes.piece_count * sizeof *morton->large);
    morton->keys = malloc(count * sizeof *morton->keys);
    morton->spare = malloc(count * sizeof *morton->spare);
    if (!morton->large || !morton->keys || !morton->spare)
        return false;
    choose_cells(morton, threads);
    parallel_for(threads, morton->boxes.piece_count, make_keys, morton);
    return sort_keys(morton, threads) && build_tree(morton, threads);
}

bool bvh_morton_build(Bvh *bvh, const Scene *scene, int threads, Error *error)
{
    Morton morton = {.bvh = bvh};
    bool ok = make_tree(&morton, scene, scene->face_count < MIN_PARALLEL ? 1 : threads);
    bvh_boxes_free(&morton.boxes);
    free(morton.large);
    free(morton.keys);
    free(morton.spare);
    free(morton.tasks);
    if (!ok) {
        bvh_free(bvh);
        return error_memory(error, "the bounding volume hierarchy");
    }
    return true;
}
