/* A tree as the kernels traverse it: two arrays. */
#include "opencl/device_tree.h"

#include "kernels/shared/layout.h"

#include <assert.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

enum { MAX_WIDTH = 16, SMALLEST_STACK = 64 };

/* Which nodes of the binary tree a wide node takes in, so that a random line meets the fewest wide nodes: the sum of
 * their areas is the least there is (Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs Through
 * Compressed Wide BVHs", 2017, section 3.1; all leaves are met as often whatever the cut).
 * A subtree gets some of the `width` places of the wide node above it. Into one place goes its
 * root, as a leaf or a wide node of its own; more are shared between the root's two children.
 * shares: 4 bits for each number of places, from 1 on, how many of them the first child gets,
 * or 0: the root takes one. At `width` places they are the root's own, as a wide node. */
typedef struct Cut {
    const Bvh *bvh;
    uint64_t *shares; /* one per node of the binary tree, set for the inner ones */
    int width;
} Cut;

/* The least areas of the wide nodes in a subtree, by the places that it gets: fewer than the width. From as many as it
 * has leaves on there are none. */
typedef struct CutCosts {
    double area[MAX_WIDTH];
    int leaves; /* up to the width */
} CutCosts;

/* Shares so many places between two children. *first: what the first one gets. */
static double share(const CutCosts *left, const CutCosts *right, int places, int *first)
{
    *first = places - 1 < left->leaves ? places - 1 : left->leaves;
    if (places >= left->leaves + right->leaves)
        return 0;
    double least = HUGE_VAL;
    for (int k = places > right->leaves ? places - right->leaves : 1; k < places && k <= left->leaves; k++) {
        double area = left->area[k] + right->area[places - k];
        if (area < least) {
            least = area;
            *first = k;
        }
    }
    return least;
}

static void cut_subtree(Cut *cut, int node, CutCosts *costs)
{
    const BvhNode *root = &cut->bvh->nodes[node];
    costs->area[1] = 0;
    costs->leaves = 1;
    if (root->count > 0)
        return;
    CutCosts left, right;
    cut_subtree(cut, node + 1, &left);
    cut_subtree(cut, root->first, &right);
    int width = cut->width, first;
    assert(left.leaves >= 1 && right.leaves >= 1 && width >= 2);
    costs->leaves = left.leaves + right.leaves < width ? left.leaves + right.leaves : width;
    double alone = box_half_area(root->box) + share(&left, &right, width, &first);
    costs->area[1] = alone;
    uint64_t shares = (uint64_t)first << 4 * (width - 1);
    for (int places = 2; places < width; places++) {
        double shared = share(&left, &right, places, &first);
        costs->area[places] = shared <= alone ? shared : alone;
        if (shared <= alone)
            shares |= (uint64_t)first << 4 * (places - 1);
    }
    cut->shares[node] = shares;
}

/* Adds to the list the nodes of the binary tree that fill so
 * many places for the subtree; returns how many are in it. */
static int gather(const Cut *cut, int node, int places, int *list, int count)
{
    const BvhNode *root = &cut->bvh->nodes[node];
    int first = root->count > 0 ? 0 : (int)(cut->shares[node] >> 4 * (places - 1) & 15);
    if (first == 0) {
        list[count] = node;
        return count + 1;
    }
    count = gather(cut, node + 1, first, list, count);
    return gather(cut, root->first, places - first, list, count);
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
static size_t count_nodes(const Cut *cut, int root)
{
    int list[MAX_WIDTH];
    int count = gather(cut, root, cut->width, list, 0);
    size_t nodes = 1;
    for (int i = 0; i < count; i++)
        if (cut->bvh->nodes[list[i]].count == 0)
            nodes += count_nodes(cut, list[i]);
    return nodes;
}

typedef struct Collapse {
    const Cut *cut;
    const unsigned char *closed;
    DeviceTree *tree;
    int node_count;
    int depth; /* of the deepest node; the root's is 1 */
} Collapse;

static int leaf(const Collapse *c, const BvhNode *node)
{
    int side = c->closed ? c->closed[c->cut->bvh->order[node->first]] - 1 : -1;
    return node->count == 1 && side >= 0 ? SIDE_LEAF(node->first, side) : LEAF(node->first, node->count);
}

/* Makes the wide node for a node of the binary tree and all below it; returns its number. */
static int collapse(Collapse *c, int root, int depth)
{
    const Box nothing = box_empty();
    int list[MAX_WIDTH], width = c->tree->node_width;
    int count = gather(c->cut, root, width, list, 0);
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
        const BvhNode *inner = &c->cut->bvh->nodes[list[i]];
        put_box(c->tree, node, i, &inner->box);
        *child = inner->count > 0 ? leaf(c, inner) : collapse(c, list[i], depth + 1);
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

static bool pack_cut(DeviceTree *tree, const Cut *cut, const unsigned char *closed, Error *error)
{
    size_t places = count_nodes(cut, 0) * (size_t)cut->width;
    tree->node_width = cut->width;
    if (!allocate(tree, 6 * places, places, error))
        return false;
    Collapse c = {.cut = cut, .closed = closed, .tree = tree};
    collapse(&c, 0, 1);
    tree->stack_size = stack_for(1 + c.depth * (cut->width - 1));
    return true;
}

static bool pack_bvh(DeviceTree *tree, const Bvh *bvh, const unsigned char *closed, int width, Error *error)
{
    Cut cut = {bvh, malloc(2 * (size_t)bvh->face_count * sizeof *cut.shares), width};
    if (!cut.shares)
        return error_memory(error, "the tree for the device");
    CutCosts costs;
    cut_subtree(&cut, 0, &costs);
    bool ok = pack_cut(tree, &cut, closed, error);
    free(cut.shares);
    return ok;
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

bool device_tree_pack(DeviceTree *tree, const Accel *accel, const unsigned char *closed, int width, Error *error)
{
    *tree = (DeviceTree){.node_width = 1, .stack_size = 1};
    if (accel->kind == ACCEL_BVH)
        return pack_bvh(tree, &accel->bvh, closed, width, error);
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
