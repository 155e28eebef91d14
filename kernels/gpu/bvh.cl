/* One ray's way through a bounding volume hierarchy, in float: plain/bvh.cl without distances on the stack. The four
 * boxes of a node are tested side by side (Kay and Kajiya 1986). The nearest child is visited next, the others go on
 * the stack, the farthest one first. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "plain/scene.cl"
#include "gpu/ray.cl"

enum { STACK_WORDS = STACK_SIZE };

/* Nodes and leaves to visit. The stack lies apart, so that their number can be kept in a register. */
typedef struct Traversal {
    uint *stack;
    int count;
} Traversal;

static void begin_traversal(Traversal *way, uint *stack)
{
    way->stack = stack;
    way->stack[0] = 0;
    way->count = 1;
}

#define NOT_MET 0xffffffffu

/* Of each two numbers the smaller one, and the larger one where the mask is set. Comparing all four at once takes half
 * of the instructions on a processor, and no more on a GPU. */
static uint4 in_pairs(uint4 a, uint4 b, uint4 larger) { return (min(a, b) & ~larger) | (max(a, b) & larger); }

static float4 planes_at(global const float *box, int i) { return *(global const float4 *)(box + i); }

/* The children that the ray meets before t = limit: bits of t, the lowest two the child's number. The nearest comes
 * first and the farthest last. To sort the two between them, too, would cost more than it saves. */
INLINE uint4 children_met(const Scene *scene, const RaySetup *s, int node, float limit)
{
    global const float *box = scene->tree_floats + (size_t)node * (6 * NODE_WIDTH);
    int x = s->from_x, y = s->from_y, z = s->from_z;
    float4 enter = fma(planes_at(box, x), s->per_direction.x, s->near_side.x);
    float4 leave = fma(planes_at(box, NODE_WIDTH - x), s->per_direction.x, s->far_side.x);
    float4 enter_y = fma(planes_at(box, 2 * NODE_WIDTH + y), s->per_direction.y, s->near_side.y);
    float4 leave_y = fma(planes_at(box, 3 * NODE_WIDTH - y), s->per_direction.y, s->far_side.y);
    float4 enter_z = fma(planes_at(box, 4 * NODE_WIDTH + z), s->per_direction.z, s->near_side.z);
    float4 leave_z = fma(planes_at(box, 5 * NODE_WIDTH - z), s->per_direction.z, s->far_side.z);
    enter = max(max(enter, enter_y), max(enter_z, 0.0f));
    leave = min(min(leave, leave_y), min(leave_z, limit));
    uint4 met = (as_uint4(enter) & ~3u) | (uint4)(0, 1, 2, 3);
    met = enter <= leave ? met : (uint4)NOT_MET;
    met = in_pairs(met, met.yxwz, (uint4)(0, ~0u, 0, ~0u));
    met = in_pairs(met, met.zwxy, (uint4)(0, 0, ~0u, ~0u));
    return met;
}

/* The next leaf that the ray enters before t = limit: its faces are first .. first + count - 1. False: none is left. */
INLINE bool next_leaf(Scene *scene, const RaySetup *s, float limit, Traversal *way, int *first,
                      int *count)
{
    while (way->count > 0) {
        int node = (int)way->stack[--way->count];
        while (node >= 0) {
            uint4 met = children_met(scene, s, node, limit);
            global const int *children = scene->tree_ints + (size_t)node * NODE_WIDTH;
            scene->counts[COUNT_BOX_TESTS] += NODE_WIDTH;
            if (met.x == NOT_MET)
                break;
            if (met.w != NOT_MET)
                way->stack[way->count++] = children[met.w & 3];
            if (met.z != NOT_MET)
                way->stack[way->count++] = children[met.z & 3];
            if (met.y != NOT_MET)
                way->stack[way->count++] = children[met.y & 3];
            node = children[met.x & 3];
        }
        if (node < 0) {
            *first = LEAF_FIRST(node);
            *count = LEAF_COUNT(node);
            return true;
        }
    }
    return false;
}

static int face_in_leaf(const Scene *scene, int i) { return i; }
