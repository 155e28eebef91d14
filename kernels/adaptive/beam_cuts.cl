/* Cuts: planes that bound where the faces lie that matter to the beams of a group. A box of the tree that lies beyond
 * one of them is left out. */
#include "shared/compiler.cl"
#include "shared/precision.cl"
#include "packet/accel.cl"
#include "packet/world.cl"
#include "adaptive/beam_query.cl"
#include "adaptive/group_beam.cl"
#include "adaptive/point.cl"

/* On the positive side of a cut, where w.x > limit, no face matters. Cuts are the sides of the group's beam, and the
 * planes that the beams go between. */
enum { CUTS_MAX = 6 };
typedef struct Cuts {
    real w[CUTS_MAX][3], limit[CUTS_MAX], slack[CUTS_MAX];
    int lowest[CUTS_MAX][3]; /* which plane of a box has the lowest w.x: of low x, high x, low y, ... */
    int count;
} Cuts;

/* The plane goes through o; slack: how far off w.(x - o) may be, for each unit of |x|1 + size. */
INLINE void add_cut(Cuts *cuts, Point w, Point o, wide slack, wide size)
{
    int i = cuts->count++;
    real_row(w, cuts->w[i]);
    cuts->limit[i] = (real)(point_dot(w, o) + slack * (size + point_magnitudes(o)));
    cuts->slack[i] = (real)slack;
    for (int axis = 0; axis < 3; axis++)
        cuts->lowest[i][axis] = 2 * axis + (cuts->w[i][axis] > 0 ? 0 : 1);
}

/* What is on the positive side of a face's plane. */
INLINE void cut_plane(const World *world, Cuts *cuts, int face, int side)
{
    Point n = point_scale(side, face_normal(world, face)), corner = face_point(world, face, 0);
    add_cut(cuts, n, corner, BOX_SLACK * point_magnitudes(n), point_magnitudes(corner));
}

static void make_cuts(const World *world, const BeamQuery *q, const GroupBeam *b, Cuts *cuts)
{
    Point l = point(b->l[0], b->l[1], b->l[2]);
    cuts->count = 0;
    for (int k = 0; k < 4; k++) {
        const real *across = k < 2 ? b->la : b->lb;
        Point w = point_scale(k % 2 ? -1 : 1, point(across[0], across[1], across[2]));
        add_cut(cuts, point_sub(w, l), q->beam->apex, b->side_slack, q->beam->size);
    }
#if ACCEL == ACCEL_BVH /* a box of a k-d tree may hold but a part of a face, of which another part may be elsewhere */
    if (q->to >= 0)
        cut_plane(world, cuts, q->to, -q->far.side);
    if (q->from >= 0)
        cut_plane(world, cuts, q->from, q->near.side);
#endif
}
