/* Which nodes of the binary hierarchy a wide node takes in, so that a random line meets the fewest wide nodes: the sum
 * of their areas is the least there is (Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs Through
 * Compressed Wide BVHs", 2017, section 3.1; all leaves are met as often whatever the cut). */
#ifndef RECTRAY_WIDE_CUT_H
#define RECTRAY_WIDE_CUT_H

#include "trace/bvh.h"

#include <stdint.h>

enum { WIDE_MAX = 16 };

/* A subtree of the binary tree: its root, and the faces below it. */
typedef struct Subtree {
    int node, faces;
} Subtree;

/* A subtree gets some of the `width` places of the wide node above it. Into one place goes its
 * root, as a leaf or a wide node of its own; more are shared between the root's two children.
 * shares: 4 bits for each number of places, from 1 on, how many of them the first child gets,
 * or 0: the root takes one. At `width` places they are the root's own, as a wide node. */
typedef struct WideCut {
    const Bvh *bvh;
    uint64_t *shares; /* one per node of the binary tree, set for the inner ones */
    int width;
} WideCut;

/* Subtrees of so many faces are handed to threads. */
int wide_cut_task(const Bvh *bvh);

/* Finds the cut on `threads` threads; it does not depend on their number. */
bool wide_cut_find(WideCut *cut, const Bvh *bvh, int width, int threads, Error *error);
void wide_cut_free(WideCut *cut);

/* The children of the wide node at `root`: up to `width`. Returns how many they are. */
int wide_cut_children(const WideCut *cut, Subtree root, Subtree *children);

/* How many wide nodes a subtree becomes whose root is one of them. */
int wide_cut_count(const WideCut *cut, int node);

#endif
