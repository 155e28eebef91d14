/* A tree as the kernels traverse it: two arrays. */
#include "opencl/device_tree.h"

#include "base/array.h"
#include "base/parallel.h"
#include "opencl/wide_cut.h"

#include "kernels/shared/layout.h"

#include <stdlib.h>

enum { SMALLEST_STACK = 64 };

static void put_box(DeviceTree *tree, int node, int child, const Box *box)
{
    float *boxes = tree->floats + (size_t)node * 6 * (size_t)tree->node_width + child;
    for (int axis = 0; axis < 3; axis++) {
        boxes[(2 * axis) * tree->node_width] = box->low[axis];
        boxes[(2 * axis + 1) * tree->node_width] = box->high[axis];
    }
}

/* Wide nodes below one root, which one thread makes. They are numbered from the root down, child after child. */
typedef struct Piece {
    Subtree root;
    int level; /* of its root; the root of all is on level 1 */
    int first; /* the number of its root */
    int nodes; /* how many they are */
    int depth; /* the deepest level */
} Piece;

typedef struct Collapse {
    const WideCut *cut;
    const unsigned char *closed;
    DeviceTree *tree;
    Piece *pieces;
    int piece_count;
    int task; /* subtrees of up to so many faces are pieces */
} Collapse;

static int leaf(const Collapse *c, const BvhNode *node)
{
    int side = c->closed ? c->closed[c->cut->bvh->order[node->first]] - 1 : -1;
    return node->count == 1 && side >= 0 ? SIDE_LEAF(node->first, side) : LEAF(node->first, node->count);
}

/* Counts the wide nodes above the pieces, and lists the pieces where there is a list. */
static int count_top(Collapse *c, Subtree root)
{
    if (root.faces <= c->task) {
        if (c->pieces)
            c->pieces[c->piece_count] = (Piece){.root = root};
        c->piece_count++;
        return 0;
    }
    Subtree children[WIDE_MAX];
    int count = wide_cut_children(c->cut, root, children), nodes = 1;
    for (int i = 0; i < count; i++)
        if (c->cut->bvh->nodes[children[i].node].count == 0)
            nodes += count_top(c, children[i]);
    return nodes;
}

/* Makes the wide node for a subtree and all below it as nodes of the piece; returns its number. With `pieces`, which
 * are the next ones in the list, it leaves a place for each piece that it comes to. */
static int collapse(const Collapse *c, Piece *piece, Subtree root, int level, Piece **pieces)
{
    if (pieces && root.faces <= c->task) {
        Piece *below = (*pieces)++;
        below->level = level;
        below->first = piece->first + piece->nodes;
        piece->nodes += below->nodes;
        return below->first;
    }
    const Box nothing = box_empty();
    Subtree children[WIDE_MAX];
    int count = wide_cut_children(c->cut, root, children), width = c->tree->node_width;
    int node = piece->first + piece->nodes++;
    piece->depth = level > piece->depth ? level : piece->depth;
    for (int i = 0; i < width; i++) {
        int *child = &c->tree->ints[(size_t)node * (size_t)width + (size_t)i];
        if (i >= count) {
            put_box(c->tree, node, i, &nothing);
            *child = NO_CHILD;
            continue;
        }
        const BvhNode *inner = &c->cut->bvh->nodes[children[i].node];
        put_box(c->tree, node, i, &inner->box);
        *child = inner->count > 0 ? leaf(c, inner) : collapse(c, piece, children[i], level + 1, pieces);
    }
    return node;
}

static void count_piece(void *data, int i, int thread)
{
    const Collapse *c = data;
    (void)thread;
    c->pieces[i].nodes = wide_cut_count(c->cut, c->pieces[i].root.node);
}

static void collapse_piece(void *data, int i, int thread)
{
    const Collapse *c = data;
    Piece *piece = &c->pieces[i];
    (void)thread;
    piece->nodes = 0;
    collapse(c, piece, piece->root, piece->level, NULL);
}

static bool allocate(DeviceTree *tree, size_t floats, size_t ints, Error *error)
{
    tree->floats = array_aligned(floats * sizeof *tree->floats);
    tree->ints = array_aligned(ints * sizeof *tree->ints);
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

static bool pack_cut(Collapse *c, int threads, Error *error)
{
    Subtree all = {0, c->cut->bvh->face_count};
    count_top(c, all);
    c->pieces = malloc(((size_t)c->piece_count + 1) * sizeof *c->pieces);
    if (!c->pieces)
        return error_memory(error, "the tree for the device");
    c->piece_count = 0;
    size_t nodes = (size_t)count_top(c, all);
    parallel_for(threads, c->piece_count, count_piece, c);
    for (int i = 0; i < c->piece_count; i++)
        nodes += (size_t)c->pieces[i].nodes;
    size_t places = nodes * (size_t)c->cut->width;
    c->tree->node_width = c->cut->width;
    if (!allocate(c->tree, 6 * places, places, error))
        return false;
    Piece top = {.depth = 1}, *next = c->pieces;
    collapse(c, &top, all, 1, &next);
    parallel_for(threads, c->piece_count, collapse_piece, c);
    for (int i = 0; i < c->piece_count; i++)
        top.depth = c->pieces[i].depth > top.depth ? c->pieces[i].depth : top.depth;
    c->tree->stack_size = stack_for(1 + top.depth * (c->cut->width - 1));
    return true;
}

static bool pack_bvh(DeviceTree *tree, const Bvh *bvh, const DevicePlan *plan, Error *error)
{
    WideCut cut;
    bool ok = wide_cut_find(&cut, bvh, plan->width, plan->threads, error);
    Collapse c = {.cut = &cut, .closed = plan->closed, .tree = tree, .task = wide_cut_task(bvh)};
    ok = ok && pack_cut(&c, plan->threads, error);
    free(c.pieces);
    wide_cut_free(&cut);
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

bool device_tree_pack(DeviceTree *tree, const Accel *accel, const DevicePlan *plan, Error *error)
{
    *tree = (DeviceTree){.node_width = 1, .stack_size = 1};
    if (accel->kind == ACCEL_BVH)
        return pack_bvh(tree, &accel->bvh, plan, error);
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
