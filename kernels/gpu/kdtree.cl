/* One ray's way through a k-d tree, in float: plain/kdtree.cl with margins for float. */
#include "shared/layout.h"
#include "shared/precision.cl"
#include "plain/scene.cl"
#include "gpu/ray.cl"

enum { STACK_WORDS = 3 * STACK_SIZE };

/* Nodes to visit, the nearest on top, each with the part of the ray that lies in it, from t to t. */
typedef struct Traversal {
    uint *stack;
    int count;
    bool begun;
} Traversal;

static void begin_traversal(Traversal *way, uint *stack)
{
    way->stack = stack;
    way->count = 0;
    way->begun = false;
}

static void push_part(Traversal *way, int node, float enter, float leave)
{
    vstore3((uint3)((uint)node, as_uint(enter), as_uint(leave)), way->count, way->stack);
    way->count += enter <= leave;
}

/* The part of the ray in the box of the whole tree. */
static void push_root(const Scene *scene, const RaySetup *s, Traversal *way)
{
    float enter = 0, leave = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        int back = component(s->per_direction, axis) < 0;
        float per = component(s->per_direction, axis);
        enter = max(enter, fma(scene->tree_floats[2 * axis + back], per, component(s->near_side, axis)));
        leave = min(leave, fma(scene->tree_floats[2 * axis + 1 - back], per, component(s->far_side, axis)));
    }
    push_part(way, 0, enter, leave);
}

/* The next leaf that the ray enters before t = limit: its faces are first .. first + count - 1 of the list. False: none
 * is left. */
static bool next_leaf(Scene *scene, const RaySetup *s, float limit, Traversal *way, int *first,
                      int *count)
{
    if (!way->begun)
        push_root(scene, s, way);
    way->begun = true;
    while (way->count > 0) {
        uint3 top = vload3(--way->count, way->stack);
        int node = (int)top.x;
        float2 part = as_float2(top.yz);
        scene->counts[COUNT_BOX_TESTS]++;
        if (part.x > limit)
            continue;
        global const int *ints = scene->tree_ints + 1 + (size_t)node * KD_INTS;
        int axis = ints[KD_AXIS];
        if (axis == KD_LEAF) {
            *first = ints[KD_FIRST];
            *count = ints[KD_COUNT];
            return true;
        }
        float plane = scene->tree_floats[6 + node], per = component(s->per_direction, axis);
        float sooner = fma(plane, per, component(s->near_side, axis));
        float later = fma(plane, per, component(s->far_side, axis));
        int below = node + 1, above = ints[KD_FIRST];
        push_part(way, per < 0 ? below : above, max(part.x, sooner), part.y);
        push_part(way, per < 0 ? above : below, part.x, min(part.y, later)); /* the side that the ray comes to first */
    }
    return false;
}

static int face_in_leaf(const Scene *scene, int i) { return scene->tree_ints[scene->tree_ints[0] + i]; }
