/* A bounding volume hierarchy, built from the top: split where the surface area heuristic says, recurse.
 * A subtree over n faces owns 2n places in the array of nodes, so that threads can build subtrees side by side
 * and the tree comes out the same whoever built what. */
#include "trace/bvh.h"

#include "base/parallel.h"
#include "trace/bvh_boxes.h"

#include <stdlib.h>

/* A subtree of fewer faces, or less than such a part of all, is built by one thread. */
enum { MIN_TASK = 4096, TASKS = 32 };

/* A subtree to be built: node `node` over the faces [first, first + count). */
typedef struct Task {
    int node, first, count, depth;
    BoundsRange range;
} Task;

/* On each level fewer than TASKS subtrees are larger than a task, and each of them has two children. */
enum { MAX_TASKS = 2 * TASKS * BVH_MAX_DEPTH };

typedef struct Builder {
    Bvh *bvh;
    Bounds *boxes;
    Task *tasks;
} Builder;

void bvh_make_leaf(Bvh *bvh, int node, int first, int count)
{
    int *faces = bvh->order + first;
    for (int i = 1; i < count; i++) {
        int face = faces[i], place = i;
        for (; place > 0 && faces[place - 1] > face; place--)
            faces[place] = faces[place - 1];
        faces[place] = face;
    }
    bvh->nodes[node].first = first;
    bvh->nodes[node].count = count;
}

/* Makes the subtree's root. True where it is an inner node: then these are the subtrees of its children. */
static bool make_node(const Builder *builder, const Task *task, Task children[2])
{
    BvhNode *node = &builder->bvh->nodes[task->node];
    BvhFaces faces = {builder->boxes + task->first, builder->bvh->order + task->first, task->count};
    BoundsRange sides[2];
    int left = bvh_split(faces, task->depth, &task->range, sides);
    node->box = bounds_box(task->range.boxes);
    if (left == 0) {
        bvh_make_leaf(builder->bvh, task->node, task->first, task->count);
        return false;
    }
    node->count = 0;
    node->first = task->node + 2 * left;
    children[0] = (Task){task->node + 1, task->first, left, task->depth + 1, sides[0]};
    children[1] = (Task){node->first, task->first + left, task->count - left, task->depth + 1, sides[1]};
    return true;
}

static void build_subtree(const Builder *builder, const Task *task)
{
    Task children[2];
    if (!make_node(builder, task, children))
        return;
    build_subtree(builder, &children[0]);
    build_subtree(builder, &children[1]);
}

static void build_task(void *data, int i, int thread)
{
    const Builder *builder = data;
    (void)thread;
    build_subtree(builder, &builder->tasks[i]);
}

/* --- The top of the tree --- */

/* The subtrees of one level that are too large for one thread, and their children. */
typedef struct Level {
    const Builder *builder;
    Task large[TASKS], children[TASKS][2];
    bool inner[TASKS];
    int count;
} Level;

static void split_large(void *data, int i, int thread)
{
    Level *level = data;
    (void)thread;
    level->inner[i] = make_node(level->builder, &level->large[i], level->children[i]);
}

/* Sorts the subtrees by size: the large ones become the next level, the others tasks. */
static int sort_out(Level *level, int task_size, Task *tasks, int task_count)
{
    int count = level->count;
    level->count = 0;
    for (int i = 0; i < 2 * count; i++) {
        const Task *child = &level->children[i / 2][i % 2];
        if (level->inner[i / 2] && child->count > task_size)
            level->large[level->count++] = *child;
        else if (level->inner[i / 2])
            tasks[task_count++] = *child;
    }
    return task_count;
}

static void build_tree(Builder *builder, BoundsRange all, int threads)
{
    int faces = builder->bvh->face_count, task_count = 0;
    int task_size = faces / TASKS > MIN_TASK ? faces / TASKS : MIN_TASK;
    Task root = {0, 0, faces, 0, all};
    Level level = {.builder = builder, .count = faces > task_size};
    if (level.count == 0)
        builder->tasks[task_count++] = root;
    level.large[0] = root;
    while (level.count > 0) {
        parallel_for(threads, level.count, split_large, &level);
        task_count = sort_out(&level, task_size, builder->tasks, task_count);
    }
    parallel_for(threads, task_count, build_task, builder);
}

bool bvh_allocate(Bvh *bvh, int face_count)
{
    size_t count = (size_t)face_count;
    *bvh = (Bvh){malloc(2 * count * sizeof *bvh->nodes), malloc(count * sizeof *bvh->order), face_count};
    return bvh->nodes && bvh->order;
}

bool bvh_build(Bvh *bvh, const Scene *scene, int threads, Error *error)
{
    BvhBoxes boxes = {0};
    Builder builder = {.bvh = bvh, .tasks = malloc(MAX_TASKS * sizeof *builder.tasks)};
    bool ok = bvh_allocate(bvh, scene->face_count) && builder.tasks && bvh_boxes_make(&boxes, scene, threads);
    if (ok) {
        builder.boxes = boxes.boxes;
        for (int i = 0; i < scene->face_count; i++)
            bvh->order[i] = i;
        build_tree(&builder, boxes.all, threads);
    }
    bvh_boxes_free(&boxes);
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
