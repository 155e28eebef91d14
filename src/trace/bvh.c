/* A bounding volume hierarchy, built from the top: split where the surface area heuristic says, recurse.
 * A subtree over n faces owns 2n places in the array of nodes, so that threads can build subtrees side by side
 * and the tree comes out the same whoever built what. */
#include "trace/bvh.h"

#include "base/parallel.h"
#include "scene/geometry.h"

#include <stdlib.h>
#include <string.h>

enum { MIN_TASK = 4096, TASKS = 32 };

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
    int left = bvh_split(node->box, boxes, task.count, task.depth);
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
