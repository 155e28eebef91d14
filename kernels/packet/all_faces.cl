/* No tree: one leaf holds all faces, and a bundle needs no bounds. The functions are those of bvh.cl. */
#include "shared/compiler.cl"
#include "shared/precision.cl"
#include "packet/apex.cl"
#include "packet/lanes.cl"
#include "packet/rays.cl"
#include "packet/world.cl"

typedef int Stack;
typedef int RayBounds;

INLINE RayBounds bounds_from(const Apex *a, const OriginPacket *packets, int packet_count, real spread) { return 0; }
INLINE RayBounds bounds_within(const Apex *a, const real *low, const real *high) { return 0; }
INLINE RayBounds bounds_of(const RealRay *l, Mask active) { return 0; }
INLINE void bounds_shorten(RayBounds *b, real reach) {}
INLINE void bounds_cull_sides(RayBounds *b, bool reversed) {}
INLINE Stack stack_of(const World *world, const RayBounds *b) { return 1; }
INLINE bool misses_all(const World *world, const RayBounds *b) { return false; }
INLINE void push_back(Stack *stack) { *stack = 1; }
INLINE void forget_distances(Stack *stack) {}
INLINE int face_in_leaf(const World *world, int i) { return i; }

INLINE bool next_leaf(const World *world, const RayBounds *b, uint rays, Stack *stack, int *first, int *count)
{
    *first = 0;
    *count = world->face_count;
    return (*stack)-- > 0;
}
