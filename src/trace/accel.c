/* How a tracer finds faces: one by one, or through a tree. */
#include "trace/accel.h"

#include "trace/bvh_morton.h"
#include "trace/bvh_traverse.h"
#include "trace/kdtree_traverse.h"

/* A picture of fewer primary rays than so many per face is done sooner with the tree that is made by sorting. In small
 * scenes either tree is there in a millisecond. */
enum { LBVH_RAYS = 64, LBVH_FACES = 4096 };

static AccelKind kind_for(const Scene *scene, AccelKind wanted)
{
    if (scene->face_count == 0)
        return ACCEL_NONE;
    if (wanted != ACCEL_AUTO)
        return wanted;
    return scene->face_count < ACCEL_AUTO_FACES ? ACCEL_NONE : ACCEL_BVH;
}

bool accel_build(Accel *accel, const Scene *scene, AccelKind kind, int threads, Error *error)
{
    *accel = (Accel){.kind = kind_for(scene, kind)};
    bool built = true;
    accel->sorted = accel->kind == ACCEL_LBVH && scene->face_count <= BVH_MORTON_MAX_FACES;
    if (accel->kind == ACCEL_LBVH)
        accel->kind = ACCEL_BVH;
    if (accel->sorted)
        built = bvh_morton_build(&accel->bvh, scene, threads, error);
    else if (accel->kind == ACCEL_BVH)
        built = bvh_build(&accel->bvh, scene, threads, error);
    else if (accel->kind == ACCEL_KDTREE)
        built = kdtree_build(&accel->kdtree, scene, threads, error);
    if (!built)
        accel->kind = ACCEL_NONE;
    return built;
}

void accel_free(Accel *accel)
{
    bvh_free(&accel->bvh);
    kdtree_free(&accel->kdtree);
    *accel = (Accel){.kind = ACCEL_NONE};
}

AccelKind accel_name(const Accel *accel)
{
    return accel->sorted ? ACCEL_LBVH : accel->kind;
}

bool accel_sorting_pays(const Scene *scene, const RenderSettings *settings)
{
    const Region region = render_region(settings, scene);
    double rays = (double)region.columns * region.rows * scene->grid * scene->grid;
    return scene->face_count >= LBVH_FACES && rays < (double)LBVH_RAYS * scene->face_count;
}

bool accel_has_tree(const Accel *accel)
{
    return accel && (accel->kind == ACCEL_BVH || accel->kind == ACCEL_KDTREE);
}

static AccelNode bvh_node(const Bvh *bvh, int index)
{
    const BvhNode *node = &bvh->nodes[index];
    AccelNode result = {.box = node->box, .leaf = node->count > 0, .faces = node->count, .axis = -1};
    if (result.leaf)
        result.order = bvh->order + node->first;
    else
        result.low = index + 1, result.high = node->first;
    return result;
}

/* Cuts the box of the whole tree on the way down from the root: the nodes of a low side have the smaller numbers. */
static Box kdtree_box(const KdTree *tree, int index)
{
    Box box = tree->box;
    for (int at = 0; at != index;) {
        const KdNode *node = &tree->nodes[at];
        bool high = index >= node->first;
        if (high)
            box.low[node->axis] = node->split;
        else
            box.high[node->axis] = node->split;
        at = high ? node->first : at + 1;
    }
    return box;
}

static AccelNode kdtree_node(const KdTree *tree, int index)
{
    const KdNode *node = &tree->nodes[index];
    AccelNode result = {.box = kdtree_box(tree, index), .leaf = node->axis == KDTREE_LEAF, .axis = -1};
    if (result.leaf) {
        result.faces = node->count;
        result.order = tree->order + node->first;
    } else {
        result.axis = node->axis, result.split = node->split;
        result.low = index + 1, result.high = node->first;
    }
    return result;
}

AccelNode accel_node(const Accel *accel, int index)
{
    return accel->kind == ACCEL_BVH ? bvh_node(&accel->bvh, index) : kdtree_node(&accel->kdtree, index);
}

void accel_traverse(const Accel *accel, Traversal *traversal)
{
    if (accel->kind == ACCEL_BVH)
        bvh_traverse(&accel->bvh, traversal);
    else
        kdtree_traverse(&accel->kdtree, traversal);
}
