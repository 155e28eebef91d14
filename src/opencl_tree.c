/* A bounding volume hierarchy as the kernels walk it. */
#include "opencl_tree.h"

#include "../kernels/layout.h"

#include <float.h>
#include <stdlib.h>

enum { MAX_WIDTH = 16 };

typedef struct Collapse {
    const Bvh *bvh;
    WideTree *tree;
} Collapse;

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

static void put_box(WideTree *tree, int node, int child, const Box *box)
{
    float *boxes = tree->boxes + (size_t)node * 6 * (size_t)tree->width + child;
    for (int axis = 0; axis < 3; axis++) {
        boxes[(2 * axis) * tree->width] = box->low[axis];
        boxes[(2 * axis + 1) * tree->width] = box->high[axis];
    }
}

/* Makes the wide node for a node of the binary tree and all below it; returns its number. */
static int collapse(Collapse *c, int root, int depth)
{
    int list[MAX_WIDTH], width = c->tree->width;
    int count = gather(c->bvh, root, width, list);
    int node = c->tree->node_count++;
    if (depth > c->tree->depth)
        c->tree->depth = depth;
    for (int i = 0; i < width; i++) {
        int *child = &c->tree->children[(size_t)node * (size_t)width + (size_t)i];
        if (i >= count) {
            Box nothing = {{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}};
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

bool wide_tree_build(WideTree *tree, const Bvh *bvh, int width, Error *error)
{
    size_t nodes = count_nodes(bvh, 0, width), wide = (size_t)width;
    *tree = (WideTree){.width = width};
    tree->boxes = malloc(nodes * 6 * wide * sizeof *tree->boxes);
    tree->children = malloc(nodes * wide * sizeof *tree->children);
    if (!tree->boxes || !tree->children) {
        wide_tree_free(tree);
        return error_memory(error, "the tree for the device");
    }
    Collapse c = {bvh, tree};
    collapse(&c, 0, 1);
    return true;
}

void wide_tree_free(WideTree *tree)
{
    free(tree->boxes);
    free(tree->children);
    *tree = (WideTree){0};
}
