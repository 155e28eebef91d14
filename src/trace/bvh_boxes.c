/* The boxes of all faces, made on several threads. */
#include "trace/bvh_boxes.h"

#include "base/parallel.h"
#include "scene/geometry.h"

#include <stdlib.h>

typedef struct Making {
    BvhBoxes *boxes;
    const Scene *scene;
} Making;

static void make_piece(void *data, int piece, int thread)
{
    const Making *making = data;
    const Scene *scene = making->scene;
    BvhBoxes *boxes = making->boxes;
    int first = piece * BVH_PIECE, end = bvh_boxes_end(boxes, piece);
    (void)thread;
    for (int i = first; i < end; i++)
        boxes->boxes[i] = bounds_of(face_box(&scene->faces[i], &scene->planes[i]));
    boxes->pieces[piece] = bounds_range_of(boxes->boxes + first, end - first);
}

BoundsRange bvh_boxes_join(const BvhBoxes *boxes)
{
    BoundsRange all = boxes->pieces[0];
    for (int i = 1; i < boxes->piece_count; i++) {
        bounds_grow(&all.boxes, &boxes->pieces[i].boxes);
        bounds_grow(&all.middles, &boxes->pieces[i].middles);
    }
    return all;
}

bool bvh_boxes_make(BvhBoxes *boxes, const Scene *scene, int threads)
{
    int count = scene->face_count, pieces = (count + BVH_PIECE - 1) / BVH_PIECE;
    *boxes = (BvhBoxes){malloc((size_t)count * sizeof *boxes->boxes), malloc((size_t)pieces * sizeof *boxes->pieces),
                        bounds_range_empty(), count, pieces};
    if (!boxes->boxes || !boxes->pieces)
        return false;
    Making making = {boxes, scene};
    parallel_for(threads, pieces, make_piece, &making);
    boxes->all = bvh_boxes_join(boxes);
    return true;
}

void bvh_boxes_free(BvhBoxes *boxes)
{
    free(boxes->boxes);
    free(boxes->pieces);
    *boxes = (BvhBoxes){0};
}
