/* A picture whose rays find their faces by the student's tree. Included by test.c alone, after the student's file. */
#ifndef EXERCISE_TREE_PICTURE_H
#define EXERCISE_TREE_PICTURE_H

#include "exercises/09/cuts.h"
#include "scene/light.h"
#include "trace/kdtree_traverse.h"
#include "trace/reference.h"

enum { MOST_NODES = 512, MOST_ENTRIES = 2048, MOST_DEPTH = 12 };

/* The linker takes this one for the program's: the tracer of the library walks as the student does. */
void kdtree_traverse(const KdTree *tree, Traversal *traversal)
{
    walk(tree, 0, interval_in_box(tree->box, traversal->origin, traversal->direction), traversal);
}

typedef struct Growing {
    KdNode nodes[MOST_NODES];
    int order[MOST_ENTRIES];
    int node_count, order_count;
} Growing;

/* A part of the scene, and which of its faces each box is of. */
typedef struct Numbered {
    Part part;
    int face[MOST_FACES];
} Numbered;

static Numbered side_kept(const Numbered *whole, Cut cut, bool low, bool planar_low)
{
    Numbered kept = {.part = {.box = part_of(whole->part.box, cut.axis, cut.position, low)}};
    for (int i = 0; i < whole->part.count; i++) {
        Part one = {.box = whole->part.box, .count = 1};
        one.faces[0] = whole->part.faces[i];
        keep_side(&one, cut, low, planar_low);
        if (one.count) {
            kept.face[kept.part.count] = whole->face[i];
            kept.part.faces[kept.part.count++] = one.faces[0];
        }
    }
    return kept;
}

/* Cuts where the student's best cut is cheaper than a leaf. */
static void grow(Growing *tree, const Numbered *whole, int depth)
{
    Cut cut = best_cut(whole->part.box, whole->part.faces, whole->part.count);
    int node = tree->node_count++;
    bool good = cut.cost < whole->part.count && depth > 0 && tree->node_count < MOST_NODES - 2 * MOST_DEPTH;
    if (!good) {
        tree->nodes[node] = (KdNode){.axis = KDTREE_LEAF, .first = tree->order_count, .count = whole->part.count};
        for (int i = 0; i < whole->part.count && tree->order_count < MOST_ENTRIES; i++)
            tree->order[tree->order_count++] = whole->face[i];
        return;
    }
    bool planar_low = has_planar_low(&whole->part, cut);
    Numbered low = side_kept(whole, cut, true, planar_low), high = side_kept(whole, cut, false, planar_low);
    tree->nodes[node] = (KdNode){.split = cut.position, .axis = cut.axis};
    grow(tree, &low, depth - 1);
    tree->nodes[node].first = tree->node_count;
    grow(tree, &high, depth - 1);
}

static const Accel *student_tree(const Scene *scene)
{
    static Growing growing;
    static Accel accel;
    if (growing.node_count == 0) {
        Numbered whole = {.part = part_of_scene(CORNELL)};
        for (int i = 0; i < scene->face_count; i++)
            whole.face[i] = i;
        grow(&growing, &whole, MOST_DEPTH);
        accel.kind = ACCEL_KDTREE;
        accel.kdtree = (KdTree){.box = whole.part.box,
                                .nodes = growing.nodes,
                                .order = growing.order,
                                .node_count = growing.node_count,
                                .order_count = growing.order_count};
    }
    return &accel;
}

static Vec3 pixel_with(const Scene *scene, const Accel *accel, int column, int row, unsigned char rgb[3])
{
    RenderReport report = {0};
    Scene plain = *scene;
    plain.grid = 1;
    Tracer tracer = {.scene = &plain, .accel = accel, .report = &report};
    Vec3 colour = reference_pixel(&tracer, column, row);
    rgb[0] = colour_to_byte(colour.x);
    rgb[1] = colour_to_byte(colour.y);
    rgb[2] = colour_to_byte(colour.z);
    return colour;
}

static Vec3 student_pixel(const Textbook *textbook, int column, int row, unsigned char rgb[3])
{
    return pixel_with(textbook->scene, student_tree(textbook->scene), column, row, rgb);
}

static Vec3 our_pixel(const Textbook *textbook, int column, int row, unsigned char rgb[3])
{
    return pixel_with(textbook->scene, NULL, column, row, rgb);
}

#endif
