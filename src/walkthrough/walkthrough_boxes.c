/* The boxes of a tree that the rays of a walkthrough met. */
#include "walkthrough/walkthrough_boxes.h"

#include <stdlib.h>

const int walkthrough_box_edges[BOX_EDGES][2] = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3},
                                                 {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

WalkthroughBox walkthrough_box(const Scene *scene, const Box *box)
{
    WalkthroughBox result = {.node = 0};
    for (int k = 0; k < 8; k++) {
        const float *x = k & 1 ? box->high : box->low, *y = k & 2 ? box->high : box->low;
        const float *z = k & 4 ? box->high : box->low;
        result.corners[k] = walkthrough_world(scene, vec3((double)x[0], (double)y[1], (double)z[2]));
    }
    return result;
}

bool walkthrough_boxes(const Walkthrough *walk, void (*draw)(void *user, const WalkthroughBox *box), void *user,
                       Error *error)
{
    enum { UNSEEN, MET, ENTERED };
    int nodes = 1;
    for (long i = 0; i < walk->count; i++)
        if (walk->events[i].kind == EVENT_NODE && walk->events[i].as.node.visit.node >= nodes)
            nodes = walk->events[i].as.node.visit.node + 1;
    unsigned char *seen = calloc((size_t)nodes, 1);
    if (!seen)
        return error_memory(error, "the boxes of the tree");
    for (long i = 0; i < walk->count; i++)
        if (walk->events[i].kind == EVENT_NODE && walk->events[i].as.node.visit.verdict == NODE_ENTERED)
            seen[walk->events[i].as.node.visit.node] = ENTERED;
    for (long i = 0; i < walk->count; i++) {
        const Event *event = &walk->events[i];
        if (event->kind != EVENT_NODE || seen[event->as.node.visit.node] == MET)
            continue;
        bool entered = seen[event->as.node.visit.node] == ENTERED;
        seen[event->as.node.visit.node] = MET;
        WalkthroughBox box = walkthrough_box(walk->scene, &event->as.node.shape.box);
        box.node = event->as.node.visit.node;
        box.level = event->as.node.visit.level;
        box.leaf = event->as.node.shape.leaf;
        box.entered = entered;
        draw(user, &box);
    }
    free(seen);
    return true;
}
