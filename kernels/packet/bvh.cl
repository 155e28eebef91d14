/* The traversal of a bounding volume hierarchy (Wald, "On Fast Construction of SAH-Based Bounding Volume Hierarchies",
 * 2007) with wide nodes (Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide
 * BVHs", 2017).
 *
 *     take the nearest node from the stack
 *     a leaf: its faces are next
 *     a node: test the boxes of its NODE_WIDTH children, LANES at a time
 *             push those that the bundle may meet, the nearest on top
 *
 * World.tree_floats has 6 planes for each node (low x, high x, low y, ...), each of all children side by side.
 * World.tree_ints has the children: NO_CHILD and LEAF in layout.h. The device has the faces in the order of the
 * leaves. With this tree instead of every face, `gallery` took 1.5 s instead of 13.4. docs/kernels.md, section 7. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "shared/skips.h"
#include "packet/lanes.cl"
#include "packet/ray_bounds.cl"
#include "packet/world.cl"

/* Nodes and leaves to visit, the nearest on top. enter: the t at which the bundle enters it. */
typedef struct Stack {
    int node[STACK_SIZE];
    real enter[STACK_SIZE];
    int count;
} Stack;

/* Puts a child on the stack, below those that the bundle enters sooner. What lies below `floor` stays where it is. */
INLINE void stack_insert(Stack *stack, int floor, int node, real enter)
{
    int i = stack->count++;
    for (; i > floor && stack->enter[i - 1] < enter; i--) {
        stack->node[i] = stack->node[i - 1];
        stack->enter[i] = stack->enter[i - 1];
    }
    stack->node[i] = node;
    stack->enter[i] = enter;
}

/* Which of LANES children, from number `part` on, the bundle may meet, as bits; and where it enters them. culled: the
 * children that it may meet, but that are culled sides of boxes. */
INLINE uint children_met(const World *world, const RayBounds *b, int node, int part, Lanes *enter, uint *culled)
{
    IntLanes children = LOAD(world->tree_ints + (size_t)node * NODE_WIDTH + part), key = LEAF_KEY(children);
    Mask back = INTS_TO_MASK(IS(key == (IntLanes)b->culled_sides[0]) | IS(key == (IntLanes)b->culled_sides[1]) |
                             IS(key == (IntLanes)b->culled_sides[2]));
    Mask none = INTS_TO_MASK(IS(children == (IntLanes)NO_CHILD));
    global const float *boxes = world->tree_floats + (size_t)node * (6 * NODE_WIDTH) + part;
    Lanes leave = (Lanes)b->reach;
    *enter = (Lanes)0;
    for (int axis = 0; axis < 3; axis++)
        cross_slab(b->slabs[axis], LOAD_FLOATS(boxes + 2 * axis * NODE_WIDTH),
                   LOAD_FLOATS(boxes + (2 * axis + 1) * NODE_WIDTH), enter, &leave);
    Mask met = IS(*enter <= GROWN(leave)) & ~none;
    *culled = mask_bits(met & back);
    return mask_bits(met & ~back);
}

/* Does the bundle miss all that is in the tree? */
COMPILED_ONCE bool misses_all(const World *world, const RayBounds *b)
{
    for (int part = 0; part < NODE_WIDTH; part += LANES) {
        Lanes enter;
        uint culled;
        if (children_met(world, b, 0, part, &enter, &culled) != 0)
            return false;
    }
    return true;
}

INLINE void fetch_leaf(const World *world, int leaf)
{
    fetch(world->face_rows + (size_t)LEAF_FIRST(leaf) * FACE_REALS, (uint)LEAF_COUNT(leaf) * FACE_REALS * sizeof(real));
}

INLINE void fetch_node(const World *world, int node)
{
    fetch(world->tree_floats + (size_t)node * (6 * NODE_WIDTH), 6 * NODE_WIDTH * sizeof(float));
    fetch(world->tree_ints + (size_t)node * NODE_WIDTH, NODE_WIDTH * sizeof(int));
}

/* Puts the children that the bundle may meet on the stack. Returns how many faces it culled. */
INLINE uint push_children(const World *world, const RayBounds *b, int node, Stack *stack)
{
    global const int *children = world->tree_ints + (size_t)node * NODE_WIDTH;
    int floor = stack->count;
    uint faces_culled = 0;
    for (int part = 0; part < NODE_WIDTH; part += LANES) {
        Lanes enter;
        uint culled, met = children_met(world, b, node, part, &enter, &culled);
        faces_culled += popcount(culled);
        if (!met)
            continue;
        real enters[LANES];
        STORE(enter, enters);
        for (; met; met &= met - 1) {
            int i = lowest_bit(met);
            int child = children[part + i];
            if (child < 0)
                fetch_leaf(world, child);
            else
                fetch_node(world, child);
            stack_insert(stack, floor, child, enters[i]);
        }
    }
    return faces_culled;
}

/* A stack that holds the root alone. */
INLINE Stack stack_of(const World *world, const RayBounds *b)
{
    Stack stack;
    stack.node[0] = 0;
    stack.enter[0] = 0;
    stack.count = 1;
    return stack;
}

/* Puts back the leaf that next_leaf gave last. */
INLINE void push_back(Stack *stack) { stack->count++; }

/* Lets any t enter what is on the stack. Needed where the stack goes to rays whose t has another unit. */
INLINE void forget_distances(Stack *stack)
{
    for (int i = 0; i < stack->count; i++)
        stack->enter[i] = 0;
}

/* The face at place i of the leaves. */
INLINE int face_in_leaf(const World *world, int i) { return i; }

/* The next leaf that the bundle of so many rays may meet, roughly the nearest first: `count` places from `first` on.
 * False: there is none. */
INLINE bool next_leaf(const World *world, const RayBounds *b, uint rays, Stack *stack, int *first, int *count)
{
    while (stack->count > 0) {
        int node = stack->node[--stack->count];
        if (stack->enter[stack->count] > b->reach)
            continue;
        if (node < 0) {
            *first = LEAF_FIRST(node);
            *count = LEAF_COUNT(node);
            return true;
        }
        world->counters[COUNT_BOX_TESTS] += NODE_WIDTH;
        world->counters[COUNT_SKIPPED + SKIP_BACK_FACE] += rays * push_children(world, b, node, stack);
    }
    return false;
}
