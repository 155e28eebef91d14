/* No tree: one leaf with all faces. */
#include "packet/lanes.cl"
#include "packet/geometry.cl"
#include "packet/apex.cl"
#include "packet/counters.cl"
#include "packet/accel.cl"

typedef int Stack;
typedef int Bundle;

INLINE Bundle bundle_from(const Apex *a, const Pencil *pencils, int packets, real spread) { return 0; }
INLINE Bundle bundle_within(const Apex *a, const real *low, const real *high) { return 0; }
INLINE Bundle bundle_of(const Line *l, Mask active) { return 0; }
INLINE void bundle_shorten(Bundle *b, real reach) {}
INLINE void bundle_leave_out_sides(Bundle *b, bool towards) {}
INLINE Stack stack_of(const Tree *tree, const Bundle *b) { return 1; }
INLINE bool misses_all(const Tree *tree, const Bundle *b) { return false; }
INLINE void put_back(Stack *stack) { *stack = 1; }
INLINE void forget_distances(Stack *stack) {}
INLINE int face_in_leaf(const Tree *tree, int i) { return i; }

INLINE bool next_leaf(const Geometry *g, const Tree *tree, const Bundle *b, uint rays, Stack *stack, int *first, int *count,
                      Counters *c)
{
    *first = 0;
    *count = g->face_count;
    return (*stack)-- > 0;
}
