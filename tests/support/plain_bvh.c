/* The hierarchy as the surface area heuristic states it, without any haste. */
#include "support/plain_bvh.h"

#include "scene/geometry.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { BINS = 16, MAX_LEAF = 8, MAX_DEPTH = 96, LARGE_RARE = 32 };

#define NODE_COST 0.5
#define LARGE_SHARE 0.5

typedef struct FaceBox {
    Box box;
    int face;
} FaceBox;

typedef struct Plane3 {
    int axis, bin; /* faces whose bin on the axis is <= bin go left */
    double cost;   /* infinite where no plane was found */
} Plane3;

/* The range of the boxes' middles on each axis, and how to turn a middle into a bin. */
typedef struct Middles {
    float low[3], scale[3]; /* scale 0: all middles fall together */
} Middles;

static float middle(const Box *box, int axis)
{
    return box->low[axis] + box->high[axis];
}

static int bin_number(const Middles *middles, const Box *box, int axis)
{
    int bin = (int)((middle(box, axis) - middles->low[axis]) * middles->scale[axis]);
    return bin < BINS ? bin : BINS - 1;
}

static Middles middles_of(const FaceBox *boxes, int count)
{
    Box all = box_empty();
    for (int i = 0; i < count; i++) {
        const Box *box = &boxes[i].box;
        float x = middle(box, 0), y = middle(box, 1), z = middle(box, 2);
        box_grow(&all, &(Box){{x, y, z}, {x, y, z}});
    }
    Middles middles;
    for (int axis = 0; axis < 3; axis++) {
        float scale = (float)BINS / (all.high[axis] - all.low[axis]);
        middles.low[axis] = all.low[axis];
        middles.scale[axis] = scale < FLT_MAX ? scale : 0;
    }
    return middles;
}

/* What the faces of bins first..last cost: area of their box * faces. */
static double side_cost(const FaceBox *boxes, int count, const Middles *middles, int axis, int first, int last)
{
    Box all = box_empty();
    int faces = 0;
    for (int i = 0; i < count; i++) {
        int bin = bin_number(middles, &boxes[i].box, axis);
        if (first <= bin && bin <= last) {
            box_grow(&all, &boxes[i].box);
            faces++;
        }
    }
    return box_half_area(all) * faces;
}

static Plane3 cheapest_plane(const FaceBox *boxes, int count, const Middles *middles)
{
    Plane3 best = {.cost = HUGE_VAL};
    for (int axis = 0; axis < 3; axis++)
        for (int bin = 0; bin < BINS - 1 && middles->scale[axis] > 0; bin++) {
            double cost = side_cost(boxes, count, middles, axis, 0, bin) +
                          side_cost(boxes, count, middles, axis, bin + 1, BINS - 1);
            if (cost < best.cost)
                best = (Plane3){axis, bin, cost};
        }
    return best;
}

static void swap(FaceBox *a, FaceBox *b)
{
    FaceBox swapped = *a;
    *a = *b;
    *b = swapped;
}

static int part_by_plane(FaceBox *boxes, int count, const Middles *middles, Plane3 plane)
{
    int left = 0, right = count;
    while (left < right)
        if (bin_number(middles, &boxes[left].box, plane.axis) <= plane.bin)
            left++;
        else
            swap(&boxes[left], &boxes[--right]);
    return left;
}

/* Puts the large boxes first; returns how many they are, 0 where they are not rare. */
static int part_large(Box node, FaceBox *boxes, int count)
{
    double large_area = LARGE_SHARE * box_half_area(node);
    int large = 0;
    for (int i = 0; i < count; i++)
        large += box_half_area(boxes[i].box) > large_area;
    if (large * LARGE_RARE > count)
        return 0;
    for (int i = 0, place = 0; place < large; i++)
        if (box_half_area(boxes[i].box) > large_area)
            swap(&boxes[i], &boxes[place++]);
    return large;
}

/* Puts the left child's boxes first and returns how many they are; 0: a leaf. */
static int part(Box node, FaceBox *boxes, int count, int depth)
{
    if (count == 1 || depth == MAX_DEPTH - 1)
        return 0;
    int large = count < LARGE_RARE || depth >= MAX_DEPTH - 32 ? 0 : part_large(node, boxes, count);
    if (large > 0)
        return large;
    Middles middles = middles_of(boxes, count);
    Plane3 plane = cheapest_plane(boxes, count, &middles);
    double area = box_half_area(node);
    bool pays = plane.cost + NODE_COST * area < area * count;
    if (plane.cost < HUGE_VAL && (pays || count > MAX_LEAF) && depth < MAX_DEPTH - 32)
        return part_by_plane(boxes, count, &middles, plane);
    return count > MAX_LEAF ? count / 2 : 0;
}

static int compare_faces(const void *a, const void *b)
{
    int x = ((const FaceBox *)a)->face, y = ((const FaceBox *)b)->face;
    return (x > y) - (x < y);
}

/* Builds node `index` over `count` boxes from place `first` on. */
static void build(Bvh *bvh, FaceBox *all, int index, int first, int count, int depth)
{
    BvhNode *node = &bvh->nodes[index];
    FaceBox *boxes = all + first;
    node->box = box_empty();
    for (int i = 0; i < count; i++)
        box_grow(&node->box, &boxes[i].box);
    int left = part(node->box, boxes, count, depth);
    node->count = left == 0 ? count : 0;
    node->first = left == 0 ? first : index + 2 * left;
    if (left == 0) {
        qsort(boxes, (size_t)count, sizeof *boxes, compare_faces);
        for (int i = 0; i < count; i++)
            bvh->order[first + i] = boxes[i].face;
        return;
    }
    build(bvh, all, index + 1, first, left, depth + 1);
    build(bvh, all, node->first, first + left, count - left, depth + 1);
}

Bvh plain_bvh(const Scene *scene)
{
    size_t count = (size_t)scene->face_count;
    Bvh bvh = {malloc(2 * count * sizeof *bvh.nodes), malloc(count * sizeof *bvh.order), scene->face_count};
    FaceBox *boxes = malloc(count * sizeof *boxes);
    if (!bvh.nodes || !bvh.order || !boxes) {
        fputs("no memory for the plain hierarchy\n", stderr);
        exit(1);
    }
    for (size_t i = 0; i < count; i++)
        boxes[i] = (FaceBox){face_box(&scene->faces[i], &scene->planes[i]), (int)i};
    build(&bvh, boxes, 0, 0, scene->face_count, 0);
    free(boxes);
    return bvh;
}
