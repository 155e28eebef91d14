/* One ray's way through a bounding volume hierarchy, in float: plain/bvh.cl without distances on the stack. The four
 * boxes of a node are tested side by side (Kay and Kajiya 1986). The nearest child is visited next, the others go on
 * the stack, the nearest on top. */
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

#define ORDER(a, b)              \
    {                            \
        uint least = min(a, b);  \
        b = max(a, b);           \
        a = least;               \
    }

/* The children that the ray meets before t = limit, the nearest first: bits of t, the lowest two the child's number. */
INLINE uint4 children_met(const Scene *scene, const RaySetup *s, int node, float limit)
{
    global const float4 *box = (global const float4 *)(scene->tree_floats + (size_t)node * (6 * NODE_WIDTH));
    int x = s->per_direction.x < 0, y = s->per_direction.y < 0, z = s->per_direction.z < 0;
    float4 enter = fma(box[x], s->per_direction.x, s->near_side.x);
    float4 leave = fma(box[1 - x], s->per_direction.x, s->far_side.x);
    float4 enter_y = fma(box[2 + y], s->per_direction.y, s->near_side.y);
    float4 leave_y = fma(box[3 - y], s->per_direction.y, s->far_side.y);
    float4 enter_z = fma(box[4 + z], s->per_direction.z, s->near_side.z);
    float4 leave_z = fma(box[5 - z], s->per_direction.z, s->far_side.z);
    enter = max(max(enter, enter_y), max(enter_z, 0.0f));
    leave = min(min(leave, leave_y), min(leave_z, limit));
    uint4 met = (as_uint4(enter) & ~3u) | (uint4)(0, 1, 2, 3);
    met = enter <= leave ? met : (uint4)NOT_MET;
    ORDER(met.x, met.y)
    ORDER(met.z, met.w)
    ORDER(met.x, met.z)
    ORDER(met.y, met.w)
    ORDER(met.y, met.z)
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
