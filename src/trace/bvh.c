/* A bounding volume hierarchy, built from the top: split where the surface area heuristic says, recurse.
 * A subtree over n faces owns 2n places in the array of nodes, so that threads can build subtrees side by side
 * and the tree comes out the same whoever built what. */
#include "trace/bvh.h"

#include "base/parallel.h"
#include "scene/geometry.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

/* What a step into a node costs, in face tests; the leaf size from which on a split is made even if it does not pay. */
#define NODE_COST 0.5
enum { BINS = 16, MAX_LEAF = 8, MIN_TASK = 4096, TASKS = 32 };

typedef struct FaceBox {
    Box box;
    int face;
} FaceBox;

/* A subtree to be built: node `node` over the face boxes [first, first + count). */
typedef struct Task {
    int node, first, count, depth;
} Task;

typedef struct Builder {
    Bvh *bvh;
    FaceBox *boxes;
    Task *tasks;
    int task_count;
    int task_size; /* faces of a subtree small enough to be built by one thread */
} Builder;

typedef struct Split {
    int axis, bin; /* faces whose bin on the axis is <= bin go left */
    double cost;   /* infinite where no split was found */
} Split;

/* Twice the middle of a box on an axis; where it is rounded matters to no picture. */
static float box_middle(const Box *box, int axis)
{
    return box->low[axis] + box->high[axis];
}

/* The range of the boxes' middles on each axis, and how to turn a middle into a bin. */
typedef struct Binning {
    float low[3], scale[3]; /* scale 0: all middles fall together */
} Binning;

static int bin_of(const Binning *binning, const Box *box, int axis)
{
    int bin = (int)((box_middle(box, axis) - binning->low[axis]) * binning->scale[axis]);
    return bin < BINS ? bin : BINS - 1;
}

static Binning binning_of(const FaceBox *boxes, int count)
{
    Box middles = box_empty();
    for (int i = 0; i < count; i++) {
        const Box *box = &boxes[i].box;
        float x = box_middle(box, 0), y = box_middle(box, 1), z = box_middle(box, 2);
        box_grow(&middles, &(Box){{x, y, z}, {x, y, z}});
    }
    Binning binning;
    for (int axis = 0; axis < 3; axis++) {
        float scale = (float)BINS / (middles.high[axis] - middles.low[axis]);
        binning.low[axis] = middles.low[axis];
        binning.scale[axis] = scale < FLT_MAX ? scale : 0;
    }
    return binning;
}

typedef struct Bin {
    Box box;
    int count;
} Bin;

/* The cheapest of the BINS - 1 planes of one axis: cost = sum over sides of area * faces. */
static void try_axis(const Bin *bins, int axis, Split *best)
{
    double right_cost[BINS];
    Box box = box_empty();
    int count = 0;
    for (int i = BINS - 1; i > 0; i--) {
        box_grow(&box, &bins[i].box);
        count += bins[i].count;
        right_cost[i] = box_half_area(box) * count;
    }
    box = box_empty();
    count = 0;
    for (int i = 0; i < BINS - 1; i++) {
        box_grow(&box, &bins[i].box);
        count += bins[i].count;
        double cost = box_half_area(box) * count + right_cost[i + 1];
        if (cost < best->cost)
            *best = (Split){axis, i, cost};
    }
}

static Split best_split(const Binning *binning, const FaceBox *boxes, int count)
{
    Bin bins[3][BINS];
    for (int axis = 0; axis < 3; axis++)
        for (int i = 0; i < BINS; i++)
            bins[axis][i] = (Bin){box_empty(), 0};
    for (int i = 0; i < count; i++)
        for (int axis = 0; axis < 3; axis++) {
            Bin *bin = &bins[axis][bin_of(binning, &boxes[i].box, axis)];
            box_grow(&bin->box, &boxes[i].box);
            bin->count++;
        }
    Split best = {.cost = HUGE_VAL};
    for (int axis = 0; axis < 3; axis++)
        if (binning->scale[axis] > 0)
            try_axis(bins[axis], axis, &best);
    return best;
}

/* Puts the left side's boxes first; returns how many they are. */
static int partition(FaceBox *boxes, int count, const Binning *binning, Split split)
{
    int left = 0, right = count;
    while (left < right) {
        if (bin_of(binning, &boxes[left].box, split.axis) <= split.bin) {
            left++;
        } else {
            FaceBox swapped = boxes[--right];
            boxes[right] = boxes[left];
            boxes[left] = swapped;
        }
    }
    return left;
}

/* Faces that fill more than this share of a node's surface, where they are at most
 * one in so many, are set apart from the others, whose boxes would grow to the
 * node's all the way down if they held one of them: the floor below a city. */
#define LARGE_SHARE 0.5
enum { LARGE_RARE = 32 };

/* Puts the large boxes first; returns how many they are, 0 where they are not rare. */
static int part_large(const BvhNode *node, FaceBox *boxes, int count)
{
    double large_area = LARGE_SHARE * box_half_area(node->box);
    int large = 0;
    for (int i = 0; i < count; i++)
        large += box_half_area(boxes[i].box) > large_area;
    if (large * LARGE_RARE > count)
        return 0;
    for (int i = 0, place = 0; place < large; i++)
        if (box_half_area(boxes[i].box) > large_area) {
            FaceBox swapped = boxes[place];
            boxes[place++] = boxes[i];
            boxes[i] = swapped;
        }
    return large;
}

/* How many of the boxes go left; 0: this is a leaf. */
static int split_node(const BvhNode *node, FaceBox *boxes, int count, int depth)
{
    if (count == 1 || depth == BVH_MAX_DEPTH - 1)
        return 0;
    int large = count < LARGE_RARE || depth >= BVH_MAX_DEPTH - 32 ? 0 : part_large(node, boxes, count);
    if (large > 0)
        return large;
    Binning binning = binning_of(boxes, count);
    Split split = best_split(&binning, boxes, count);
    double area = box_half_area(node->box);
    bool pays = split.cost + NODE_COST * area < area * count;
    if (split.cost < HUGE_VAL && (pays || count > MAX_LEAF) && depth < BVH_MAX_DEPTH - 32)
        return partition(boxes, count, &binning, split);
    /* Middles that fall together, or a tree that grows too deep: halve what is still too much for a leaf. */
    return count > MAX_LEAF ? count / 2 : 0;
}

static int compare_faces(const void *a, const void *b)
{
    int x = ((const FaceBox *)a)->face, y = ((const FaceBox *)b)->face;
    return (x > y) - (x < y);
}

static void make_leaf(Builder *builder, BvhNode *node, Task task)
{
    FaceBox *boxes = builder->boxes + task.first;
    qsort(boxes, (size_t)task.count, sizeof *boxes, compare_faces);
    for (int i = 0; i < task.count; i++)
        builder->bvh->order[task.first + i] = boxes[i].face;
    node->first = task.first;
    node->count = task.count;
}

static void build_subtree(Builder *builder, Task task, bool set_aside);

/* Builds a child, or sets it aside for the threads: while the top is built, when it has become small enough. */
static void build_child(Builder *builder, Task task, bool set_aside)
{
    if (set_aside && task.count <= builder->task_size)
        builder->tasks[builder->task_count++] = task;
    else
        build_subtree(builder, task, set_aside);
}

static void build_subtree(Builder *builder, Task task, bool set_aside)
{
    BvhNode *node = &builder->bvh->nodes[task.node];
    FaceBox *boxes = builder->boxes + task.first;
    node->box = box_empty();
    for (int i = 0; i < task.count; i++)
        box_grow(&node->box, &boxes[i].box);
    int left = split_node(node, boxes, task.count, task.depth);
    if (left == 0) {
        make_leaf(builder, node, task);
        return;
    }
    node->count = 0;
    node->first = task.node + 2 * left;
    build_child(builder, (Task){task.node + 1, task.first, left, task.depth + 1}, set_aside);
    build_child(builder, (Task){node->first, task.first + left, task.count - left, task.depth + 1}, set_aside);
}

static void build_task(void *data, int i, int thread)
{
    Builder *builder = data;
    (void)thread;
    build_subtree(builder, builder->tasks[i], false);
}

bool bvh_build(Bvh *bvh, const Scene *scene, int threads, Error *error)
{
    size_t count = (size_t)scene->face_count;
    *bvh = (Bvh){.face_count = scene->face_count};
    bvh->nodes = malloc(2 * count * sizeof *bvh->nodes);
    bvh->order = malloc(count * sizeof *bvh->order);
    Builder builder = {
        .bvh = bvh, .boxes = malloc(count * sizeof *builder.boxes), .tasks = malloc(count * sizeof(Task))};
    bool ok = bvh->nodes && bvh->order && builder.boxes && builder.tasks;
    if (ok) {
        for (size_t i = 0; i < count; i++)
            builder.boxes[i] = (FaceBox){face_box(&scene->faces[i], &scene->planes[i]), (int)i};
        builder.task_size = scene->face_count / TASKS > MIN_TASK ? scene->face_count / TASKS : MIN_TASK;
        build_child(&builder, (Task){0, 0, scene->face_count, 0}, true);
        parallel_for(threads, builder.task_count, build_task, &builder);
    }
    free(builder.boxes);
    free(builder.tasks);
    if (!ok) {
        bvh_free(bvh);
        return error_memory(error, "the bounding volume hierarchy");
    }
    return true;
}

void bvh_free(Bvh *bvh)
{
    free(bvh->nodes);
    free(bvh->order);
    *bvh = (Bvh){0};
}
