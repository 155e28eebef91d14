/* The traversal of a k-d tree (Wald and Havran, "On Building Fast kd-Trees for Ray Tracing", 2006).
 *
 *     take the nearest part of the bundle's way from the stack
 *     a leaf: its faces are next
 *     a node: its plane cuts the part in two; push both, the one that comes first on top
 *
 * World.tree_floats has the box of the whole tree (6 planes: low x, high x, low y, ...), then the plane of each node.
 * World.tree_ints has the place of the list of faces, then KD_INTS numbers for each node, then that list. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/accel.cl"
#include "packet/lanes.cl"
#include "packet/ray_bounds.cl"
#include "packet/world.cl"

/* Parts of the bundle's way, the nearest on top: in which node, and between which t. */
typedef struct Stack {
    int node[STACK_SIZE];
    real enter[STACK_SIZE], leave[STACK_SIZE];
    int count;
} Stack;

typedef struct Part {
    real enter, leave;
} Part;

INLINE void stack_push(Stack *stack, int node, Part part)
{
    stack->node[stack->count] = node;
    stack->enter[stack->count] = part.enter;
    stack->leave[stack->count] = part.leave;
    stack->count++;
}

INLINE bool part_is_empty(const RayBounds *b, Part part)
{
    return !(part.enter <= GROWN(part.leave)) || part.enter > b->reach;
}

/* The part on the low side of a plane. As in cross_slab, NaN narrows nothing. */
INLINE Part below_plane(Slab s, real plane, Part part)
{
    real near = (plane - s.origin_low) * s.inverse_low, far = (plane - s.origin_low) * s.inverse_high;
    if (s.sign > 0) {
        far = GREATER(near, far);
        part.leave = far < part.leave ? far : part.leave;
    } else {
        near = s.sign < 0 ? LESSER(near, far) : near;
        part.enter = near > part.enter ? near : part.enter;
    }
    return part;
}

/* The part on its high side. */
INLINE Part above_plane(Slab s, real plane, Part part)
{
    real near = (plane - s.origin_high) * s.inverse_high, far = (plane - s.origin_high) * s.inverse_low;
    if (s.sign < 0) {
        far = GREATER(near, far);
        part.leave = far < part.leave ? far : part.leave;
    } else {
        near = s.sign > 0 ? LESSER(near, far) : near;
        part.enter = near > part.enter ? near : part.enter;
    }
    return part;
}

/* The part in the box of the whole tree. */
INLINE Part part_in_tree(const World *world, const RayBounds *b)
{
    Part part = {0, b->reach};
    for (int axis = 0; axis < 3; axis++) {
        part = above_plane(b->slabs[axis], world->tree_floats[2 * axis], part);
        part = below_plane(b->slabs[axis], world->tree_floats[2 * axis + 1], part);
    }
    return part;
}

/* Does the bundle miss all that is in the tree? */
COMPILED_ONCE bool misses_all(const World *world, const RayBounds *b)
{
    return part_is_empty(b, part_in_tree(world, b));
}

/* A stack that holds the root alone. */
INLINE Stack stack_of(const World *world, const RayBounds *b)
{
    Stack stack;
    stack.count = 0;
    stack_push(&stack, 0, part_in_tree(world, b));
    return stack;
}

/* Puts back the leaf that next_leaf gave last. */
INLINE void push_back(Stack *stack) { stack->count++; }

/* Lets any t enter what is on the stack. Needed where the stack goes to rays whose t has another unit. */
INLINE void forget_distances(Stack *stack)
{
    for (int i = 0; i < stack->count; i++) {
        stack->enter[i] = 0;
        stack->leave[i] = REACH_ALL;
    }
}

/* The face at place i of the leaves. A face may be in several. */
INLINE int face_in_leaf(const World *world, int i) { return world->tree_ints[world->tree_ints[0] + i]; }

/* The next leaf that the bundle may meet, the nearest first: `count` places from `first` on. False: there is none. */
INLINE bool next_leaf(const World *world, const RayBounds *b, uint rays, Stack *stack, int *first, int *count)
{
    while (stack->count > 0) {
        stack->count--;
        int node = stack->node[stack->count];
        Part part = {stack->enter[stack->count], stack->leave[stack->count]};
        world->counters[COUNT_BOX_TESTS]++;
        if (part_is_empty(b, part))
            continue;
        global const int *ints = world->tree_ints + 1 + (size_t)node * KD_INTS;
        int axis = ints[KD_AXIS];
        if (axis == KD_LEAF) {
            *first = ints[KD_FIRST];
            *count = ints[KD_COUNT];
            return true;
        }
        real plane = world->tree_floats[6 + node];
        Slab s = b->slabs[axis];
        Part low = below_plane(s, plane, part), high = above_plane(s, plane, part);
        int below = node + 1, above = ints[KD_FIRST];
        bool low_first = s.sign > 0 || (s.sign == 0 && low.enter <= high.enter);
        stack_push(stack, low_first ? above : below, low_first ? high : low);
        stack_push(stack, low_first ? below : above, low_first ? low : high);
    }
    return false;
}
