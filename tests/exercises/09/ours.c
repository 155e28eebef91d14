/* Our own functions of src/trace under the names of exercise 9. */
#include "exercises/09/tree.h"

#define voxel_of_scene our_voxel_of_scene
#define voxel_best_cut our_voxel_best_cut
#define voxel_cut our_voxel_cut
#define voxel_copy our_voxel_copy
#define voxel_free our_voxel_free
#include "src/trace/kdtree_voxel.c"
#define kdtree_traverse our_traverse_all
#include "src/trace/kdtree_traverse.c"
#undef kdtree_traverse

static double cut_cost(Box box, int axis, float position, int low_count, int high_count)
{
    Slices slices = slices_of(&box, axis);
    Choice choice = {.best = {.cost = HUGE_VAL}};
    try_cut(&slices, (VoxelCut){axis, position, true, low_count, high_count, 0}, &choice);
    return choice.best.cost;
}

static Cut best_cut(Box box, const Box *faces, int count)
{
    Voxel voxel = {.box = box};
    VoxelEvent *spare = malloc((2 * (size_t)count + 1) * sizeof *spare);
    if (!spare || !voxel_allocate(&voxel, count))
        abort();
    for (int i = 0; i < count; i++)
        for (int axis = 0; axis < 3; axis++) {
            bool flat = faces[i].low[axis] == faces[i].high[axis];
            add_event(&voxel, axis, faces[i].low[axis], i, flat ? BOX_PLANAR : BOX_BEGINS);
            if (!flat)
                add_event(&voxel, axis, faces[i].high[axis], i, BOX_ENDS);
        }
    for (int axis = 0; axis < 3; axis++)
        sort_events(voxel.events[axis], voxel.event_count[axis], spare);
    VoxelCut best = our_voxel_best_cut(&voxel, NULL, NULL);
    our_voxel_free(&voxel);
    free(spare);
    return (Cut){best.axis, best.position, best.low_count, best.high_count, best.cost};
}

static bool walk(const KdTree *tree, int index, Interval part, Traversal *way)
{
    return traverse_node(tree, index, 0, part, way);
}
