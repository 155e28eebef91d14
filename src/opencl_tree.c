/* A tree as the kernels walk it: two arrays. */
#include "opencl_tree.h"

#include "../kernels/layout.h"

#include <stdlib.h>

enum { MAX_WIDTH = 16, SMALLEST_STACK = 64 };

/* The place in the list of the inner node with the largest box; -1: all are leaves. */
static int largest_inner(const Bvh *bvh, const int *list, int count)
{
    int largest = -1;
    double most = -1;
    for (int i = 0; i < count; i++) {
        const BvhNode *node = &bvh->nodes[list[i]];
        if (node->count == 0 && box_half_area(node->box) > most) {
            most = box_half_area(node->box);
            largest = i;
        }
    }
    return largest;
}

/* The up to `width` nodes of the binary tree that become the children of one wide node. */
static int gather(const Bvh *bvh, int root, int width, int *list)
{
    int count = 1;
    list[0] = root;
    while (count < width) {
        int open = largest_inner(bvh, list, count);
        if (open < 0)
            break;
        int node = list[open];
        list[open] = node + 1;
        list[count++] = bvh->nodes[node].first;
    }
    return count;
}

static void put_box(DeviceTree *tree, int node, int child, const Box *box)
{
    float *boxes = tree->floats + (size_t)node * 6 * (size_t)tree->node_width + child;
    for (int axis = 0; axis < 3; axis++) {
        boxes[(2 * axis) * tree->node_width] = box->low[axis];
        boxes[(2 * axis + 1) * tree->node_width] = box->high[axis];
    }
}

/* How many wide nodes there will be. */
static size_t count_nodes(const Bvh *bvh, int root, int width)
{
    int list[MAX_WIDTH];
    int count = gather(bvh, root, width, list);
    size_t nodes = 1;
    for (int i = 0; i < count; i++)
        if (bvh->nodes[list[i]].count == 0)
            nodes += count_nodes(bvh, list[i], width);
    return nodes;
}

typedef struct Collapse {
    const Bvh *bvh;
    DeviceTree *tree;
    int node_count;
    int depth; /* of the deepest node; the root's is 1 */
} Collapse;

/* Makes the wide node for a node of the binary tree and all below it; returns its number. */
static int collapse(Collapse *c, int root, int depth)
{
    const Box nothing = box_empty();
    int list[MAX_WIDTH], width = c->tree->node_width;
    int count = gather(c->bvh, root, width, list);
    int node = c->node_count++;
    if (depth > c->depth)
        c->depth = depth;
    for (int i = 0; i < width; i++) {
        int *child = &c->tree->ints[(size_t)node * (size_t)width + (size_t)i];
        if (i >= count) {
            put_box(c->tree, node, i, &nothing);
            *child = NO_CHILD;
            continue;
        }
        const BvhNode *inner = &c->bvh->nodes[list[i]];
        put_box(c->tree, node, i, &inner->box);
        *child = inner->count > 0 ? LEAF(inner->first, inner->count) : collapse(c, list[i], depth + 1);
    }
    return node;
}

static bool allocate(DeviceTree *tree, size_t floats, size_t ints, Error *error)
{
    tree->floats = malloc(floats * sizeof *tree->floats);
    tree->ints = malloc(ints * sizeof *tree->ints);
    if (!tree->floats || !tree->ints)
        return error_memory(error, "the tree for the device");
    tree->float_count = floats;
    tree->int_count = ints;
    return true;
}

/* In steps, so that few scenes need kernels of their own. */
static int stack_for(int needed)
{
    int size = SMALLEST_STACK;
    while (size < needed)
        size *= 2;
    return size;
}

/* Collapses the binary tree: a node takes in the children of its largest child until it has `width`. */
static bool pack_bvh(DeviceTree *tree, const Bvh *bvh, int width, Error *error)
{
    size_t places = count_nodes(bvh, 0, width) * (size_t)width;
    tree->node_width = width;
    if (!allocate(tree, 6 * places, places, error))
        return false;
    Collapse c = {.bvh = bvh, .tree = tree};
    collapse(&c, 0, 1);
    tree->stack_size = stack_for(1 + c.depth * (width - 1));
    return true;
}

static bool pack_kdtree(DeviceTree *tree, const KdTree *kdtree, Error *error)
{
    size_t nodes = (size_t)kdtree->node_count, order = (size_t)kdtree->order_count;
    if (!allocate(tree, 6 + nodes, 1 + KD_INTS * nodes + order, error))
        return false;
    for (int axis = 0; axis < 3; axis++) {
        tree->floats[2 * axis] = kdtree->box.low[axis];
        tree->floats[2 * axis + 1] = kdtree->box.high[axis];
    }
    int *list = tree->ints + 1 + KD_INTS * nodes;
    tree->ints[0] = (int)(1 + KD_INTS * nodes);
    for (size_t i = 0; i < nodes; i++) {
        const KdNode *node = &kdtree->nodes[i];
        int *ints = tree->ints + 1 + KD_INTS * i;
        tree->floats[6 + i] = node->axis == KDTREE_LEAF ? 0 : node->split;
        ints[KD_AXIS] = node->axis == KDTREE_LEAF ? KD_LEAF : node->axis;
        ints[KD_FIRST] = node->first;
        ints[KD_COUNT] = node->count;
    }
    for (size_t i = 0; i < order; i++)
        list[i] = kdtree->order[i];
    tree->stack_size = stack_for(KDTREE_MAX_DEPTH + 2);
    return true;
}

bool device_tree_pack(DeviceTree *tree, const Accel *accel, int width, Error *error)
{
    *tree = (DeviceTree){.node_width = 1, .stack_size = 1};
    if (accel->kind == ACCEL_BVH)
        return pack_bvh(tree, &accel->bvh, width, error);
    if (accel->kind == ACCEL_KDTREE)
        return pack_kdtree(tree, &accel->kdtree, error);
    return true;
}

void device_tree_free(DeviceTree *tree)
{
    free(tree->floats);
    free(tree->ints);
    *tree = (DeviceTree){0};
}
