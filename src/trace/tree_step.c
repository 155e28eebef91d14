/* How a tree is built, step by step, level by level. */
#include "trace/tree_step.h"

#include "base/array.h"
#include "scene/geometry.h"
#include "trace/bvh_split.h"
#include "trace/kdtree_voxel.h"

#include <stdlib.h>

/* A node whose step is still to be shown. */
typedef struct Waiting {
    int node, level;
    Voxel voxel; /* of a k-d tree */
} Waiting;

typedef struct Walker {
    const Scene *scene;
    const Accel *accel;
    Waiting *queue;
    int first, end; /* of those in the queue */
    TreeCandidate *candidates;
    int candidate_count, candidate_capacity;
    bool failed;
} Walker;

static void add_candidate(Walker *walker, TreeCandidate candidate)
{
    Error unused = {.kind = ERROR_NONE};
    if (walker->candidate_count == walker->candidate_capacity) {
        TreeCandidate *grown = array_grown(walker->candidates, walker->candidate_count, &walker->candidate_capacity,
                                           sizeof *grown, "the planes", &unused);
        walker->failed = walker->failed || !grown;
        if (!grown)
            return;
        walker->candidates = grown;
    }
    walker->candidates[walker->candidate_count++] = candidate;
}

static int cheapest(const Walker *walker)
{
    int best = -1;
    for (int i = 0; i < walker->candidate_count; i++)
        if (best < 0 || walker->candidates[i].cost < walker->candidates[best].cost)
            best = i;
    return best;
}

/* --- The k-d tree: its voxels are cut again --- */

static void take_cut(void *user, const VoxelCut *cut)
{
    add_candidate(user, (TreeCandidate){cut->axis, (double)cut->position, cut->low_count, cut->high_count, cut->cost});
}

/* Cuts the waiting voxel as the tree did: it becomes the high side. */
static bool cut_voxel(Waiting *waiting, const VoxelCut *cut, Voxel *low)
{
    VoxelPlaces *places = malloc((size_t)waiting->voxel.face_count * sizeof *places);
    bool done = places && voxel_cut(&waiting->voxel, cut, places, low);
    free(places);
    return done;
}

static void step_kdtree(Walker *walker, Waiting *waiting, TreeStep *step)
{
    VoxelCut cut = voxel_best_cut(&waiting->voxel, take_cut, walker);
    step->faces = waiting->voxel.face_count;
    step->low = cut.low_count;
    step->high = cut.high_count;
    if (step->shape.leaf)
        return;
    Voxel low;
    if (!cut_voxel(waiting, &cut, &low)) {
        walker->failed = true;
        return;
    }
    walker->queue[walker->end++] = (Waiting){step->shape.low, step->level + 1, low};
    walker->queue[walker->end++] = (Waiting){step->shape.high, step->level + 1, waiting->voxel};
    waiting->voxel = (Voxel){.face_count = 0};
}

/* --- The BVH: the faces below a node are put into bins again --- */

static int collect(const Walker *walker, int index, Bounds *boxes, int count)
{
    AccelNode node = accel_node(walker->accel, index);
    const Scene *scene = walker->scene;
    if (!node.leaf)
        return collect(walker, node.high, boxes, collect(walker, node.low, boxes, count));
    for (int i = 0; i < node.faces; i++) {
        int face = node.order[i];
        boxes[count++] = bounds_of(face_box(&scene->faces[face], &scene->planes[face]));
    }
    return count;
}

/* Whether the node's first faces are those that fill most of it, and no others do: see part_large in bvh_split.c. */
static int count_set_apart(Box node, const Bounds *boxes, int low, int count)
{
    for (int i = 0; i < count; i++)
        if ((bounds_half_area(&boxes[i]) > box_half_area(node) / 2) != (i < low))
            return 0;
    return low;
}

static void step_bvh(Walker *walker, const Waiting *waiting, TreeStep *step)
{
    Bounds *boxes = malloc((size_t)walker->scene->face_count * sizeof *boxes);
    if (!boxes) {
        walker->failed = true;
        return;
    }
    step->faces = collect(walker, waiting->node, boxes, 0);
    BvhCandidates tried = bvh_split_candidates(step->shape.box, boxes, step->faces);
    for (int axis = 0; axis < 3; axis++)
        for (int i = 0; i < BVH_BINS - 1; i++)
            if (tried.cost[axis][i] < HUGE_VAL)
                add_candidate(walker, (TreeCandidate){axis, (double)tried.plane[axis][i], tried.low[axis][i],
                                                      step->faces - tried.low[axis][i], tried.cost[axis][i]});
    if (!step->shape.leaf) {
        step->low = collect(walker, step->shape.low, boxes, 0);
        step->high = collect(walker, step->shape.high, boxes, step->low) - step->low;
        step->set_apart = step->faces >= 32 ? count_set_apart(step->shape.box, boxes, step->low, step->faces) : 0;
        walker->queue[walker->end++] = (Waiting){.node = step->shape.low, .level = step->level + 1};
        walker->queue[walker->end++] = (Waiting){.node = step->shape.high, .level = step->level + 1};
    }
    free(boxes);
}

bool tree_steps(const Scene *scene, const Accel *accel, int count, void (*show)(void *user, const TreeStep *step),
                void *user, Error *error)
{
    Walker walker = {.scene = scene, .accel = accel, .queue = calloc(2 * (size_t)count + 1, sizeof(Waiting)), .end = 1};
    walker.failed = !walker.queue || (accel->kind == ACCEL_KDTREE && !voxel_of_scene(&walker.queue[0].voxel, scene));
    for (; !walker.failed && walker.first < walker.end && walker.first < count; walker.first++) {
        Waiting *waiting = &walker.queue[walker.first];
        TreeStep step = {.number = walker.first + 1, .node = waiting->node, .level = waiting->level};
        step.shape = accel_node(accel, waiting->node);
        walker.candidate_count = 0;
        if (accel->kind == ACCEL_KDTREE)
            step_kdtree(&walker, waiting, &step);
        else
            step_bvh(&walker, waiting, &step);
        step.candidates = walker.candidates;
        step.candidate_count = walker.candidate_count;
        step.chosen = cheapest(&walker);
        if (!walker.failed)
            show(user, &step);
    }
    for (int i = 0; walker.queue && i < walker.end; i++)
        voxel_free(&walker.queue[i].voxel);
    free(walker.queue);
    free(walker.candidates);
    return !walker.failed || error_memory(error, "the steps of the tree");
}
