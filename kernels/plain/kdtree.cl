/* A ray's way through a k-d tree: a node's plane cuts what is left of the ray into a part on its low side and a part on
 * its high side. tree_floats holds the sides of the whole tree's box (low x, high x, low y, ...), then the plane of
 * each node. tree_ints holds the place of the list of faces, then KD_INTS numbers for each node, then that list. */
#include "shared/layout.h"
#include "shared/precision.cl"
#include "plain/scene.cl"
#include "plain/box.cl"

/* Nodes to visit, the nearest on top, each with the part of the ray that lies in it. */
typedef struct Traversal {
    int node[STACK_SIZE];
    Interval part[STACK_SIZE];
    int count;
} Traversal;

static void push_node(Traversal *way, int node, Interval part)
{
    way->node[way->count] = node;
    way->part[way->count] = part;
    way->count++;
}

static void begin_traversal(Scene *scene, Ray ray, Traversal *way)
{
    way->count = 0;
    push_node(way, 0, interval_in_box(scene->tree_floats, 1, ray));
}

static wide component(wide3 a, int axis) { return axis == 0 ? a.x : axis == 1 ? a.y : a.z; }

/* The next leaf that the ray enters before t = limit: its faces are first .. first + count - 1 of the list. False: none
 * is left. */
static bool next_leaf(Scene *scene, Ray ray, wide limit, Traversal *way, int *first, int *count)
{
    while (way->count > 0) {
        int node = way->node[--way->count];
        Interval part = way->part[way->count];
        scene->counts[COUNT_BOX_TESTS]++;
        if (part.enter > part.leave || part.enter > limit)
            continue;
        global const int *ints = scene->tree_ints + 1 + (size_t)node * KD_INTS;
        int axis = ints[KD_AXIS];
        if (axis == KD_LEAF) {
            *first = ints[KD_FIRST];
            *count = ints[KD_COUNT];
            return true;
        }
        wide plane = scene->tree_floats[6 + node], o = component(ray.origin, axis), r = component(ray.direction, axis);
        Interval low = interval_common(part, interval_between(-INFINITY, plane, o, r));
        Interval high = interval_common(part, interval_between(plane, INFINITY, o, r));
        int below = node + 1, above = ints[KD_FIRST];
        push_node(way, r < 0 ? below : above, r < 0 ? low : high);
        push_node(way, r < 0 ? above : below, r < 0 ? high : low); /* the side that the ray comes to first */
    }
    return false;
}

static int face_in_leaf(const Scene *scene, int i) { return scene->tree_ints[scene->tree_ints[0] + i]; }
