/* A ray's way through a bounding volume hierarchy: a box that the ray misses is left out with all that is in it, and
 * the nearest box comes first. A node has NODE_WIDTH children. tree_floats holds, for each node, the sides of all
 * their boxes (low x of each, high x of each, low y, ...), tree_ints the children themselves: NO_CHILD, another node's
 * number, or a LEAF of layout.h. On the device the faces stand in the order of the leaves. */
#include "shared/layout.h"
#include "shared/precision.cl"
#include "plain/scene.cl"
#include "plain/box.cl"

/* Nodes and leaves to visit, the nearest on top, and where the ray enters them. */
typedef struct Traversal {
    int node[STACK_SIZE];
    wide enter[STACK_SIZE];
    int count;
} Traversal;

static void begin_traversal(Scene *scene, Ray ray, Traversal *way)
{
    way->node[0] = 0;
    way->enter[0] = 0;
    way->count = 1;
}

/* Puts a child on the stack, below those entered sooner, but above the first `floor`, which are not its siblings. */
static void push_child(Traversal *way, int floor, int child, wide enter)
{
    int i = way->count++;
    for (; i > floor && way->enter[i - 1] < enter; i--) {
        way->node[i] = way->node[i - 1];
        way->enter[i] = way->enter[i - 1];
    }
    way->node[i] = child;
    way->enter[i] = enter;
}

/* The next leaf that the ray enters before t = limit: its faces are first .. first + count - 1. False: none is left. */
static bool next_leaf(Scene *scene, Ray ray, wide limit, Traversal *way, int *first, int *count)
{
    while (way->count > 0) {
        int node = way->node[--way->count];
        if (way->enter[way->count] > limit)
            continue;
        if (node < 0) {
            *first = LEAF_FIRST(node);
            *count = LEAF_COUNT(node);
            return true;
        }
        int floor = way->count;
        for (int i = 0; i < NODE_WIDTH; i++) {
            int child = scene->tree_ints[(size_t)node * NODE_WIDTH + i];
            if (child == NO_CHILD)
                break; /* no more of them */
            scene->counts[COUNT_BOX_TESTS]++;
            global const float *box = scene->tree_floats + (size_t)node * (6 * NODE_WIDTH) + i;
            Interval inside = interval_in_box(box, NODE_WIDTH, ray);
            if (inside.enter <= inside.leave && inside.enter <= limit)
                push_child(way, floor, child, inside.enter);
        }
    }
    return false;
}

static int face_in_leaf(const Scene *scene, int i) { return i; }
