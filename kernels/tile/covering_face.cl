/* The one face that all rays of a frustum hit first.
 *
 *     for each leaf that the frustum's bounds meet, nearest first
 *         for each of its faces
 *             no ray hits it, or it lies behind the covering face, or before the mirror:
 *                 go on
 *             it covers the frustum, wholly before the covering face so far:
 *                 it is the covering face now
 *             otherwise:
 *                 stop, rays may hit different faces
 *
 * A search that stops has not been in vain: its caller goes on with what it has not ruled out. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "shared/skips.h"
#include "packet/apex.cl"
#include "packet/faces.cl"
#include "packet/nearest.cl"
#include "packet/tree.cl"
#include "packet/window.cl"
#include "packet/world.cl"
#include "tile/frustum.cl"

/* What all rays hit first. */
typedef struct CoveringFace {
    int face; /* -1: none, they see the background */
    bool from_behind;
} CoveringFace;

typedef struct CoverSearch {
    const Apex *apex;
    const Frustum *corners;
    int from;                    /* the mirror that the rays come from; -1: they come from the eye */
    real4 begin_low, begin_high; /* 1/t at the mirror is between these */
    CoveringFace nearest;        /* so far */
    real low, high;              /* its 1/t is between these */
    uint backs;                  /* so many faces of the leaf were left out as backs of closed boxes */
} CoverSearch;

/* False: the mirror's depths are uncertain. */
INLINE bool begin_at_mirror(const World *world, CoverSearch *s)
{
    s->begin_low = s->begin_high = (real4)INFINITY;
    if (s->from < 0)
        return true;
    FaceSetup face;
    if (setup_face(s->apex, face_row(world, s->from), true, false, &face) != VISIBLE)
        return false;
    real4 begin = frustum_depths(&face, s->corners);
    s->begin_low = begin - face.depth_error;
    s->begin_high = begin + face.depth_error;
    return true;
}

/* Tests face i. False: some rays may hit it first, and others not. nearer: it is the nearest now. */
INLINE bool test_covering_face(const World *world, CoverSearch *s, int i, bool *nearer)
{
    FaceSetup face;
    *nearer = false;
    Visibility visibility = setup_face(s->apex, face_row(world, i), false, s->from < 0, &face);
    if (visibility == CULLED) {
        s->backs += face.closed;
        return true;
    }
    if (visibility == UNCERTAIN)
        return false;
    Coverage coverage = classify_face(&face, s->corners, face.edge_error, (face.closed ? 4 : 1) * face.edge_error);
    if (coverage == OUTSIDE)
        return true;
    real4 depths = frustum_depths(&face, s->corners);
    real4 closest = depths + face.depth_error, farthest = depths - face.depth_error;
    if (least_of(farthest - s->begin_high) > 0)
        return true; /* it lies before the mirror */
    real low = least_of(farthest), high = most_of(closest);
    if (high < s->low)
        return true;
    if (coverage != COVERS || !(low > s->high) || !(least_of(s->begin_low - closest) > 0))
        return false;
    s->nearest.face = i;
    s->nearest.from_behind = face.from_behind;
    s->low = low;
    s->high = high;
    *nearer = true;
    return true;
}

/* Finds the covering face in a search that goes on from `resume`. False: the rays may hit different faces first; then
 * `resume` leads to all faces that have not been ruled out. rays: so many the frustum stands for. */
COMPILED_ONCE bool find_covering_face(const World *world, const Apex *a, const Frustum *corners, int from, uint rays,
                                      CoveringFace *found, Traversal *resume)
{
    CoverSearch s;
    s.apex = a;
    s.corners = corners;
    s.from = from;
    s.nearest.face = -1;
    s.low = s.high = 0;
    if (!begin_at_mirror(world, &s))
        return false;
    RayBounds b = bounds_of_frustum(a, corners, 0);
    if (from < 0)
        bounds_cull_sides(&b, false);
    int single = resume->face; /* it comes before the first leaf */
    resume->face = -1;
    uint tested = 0, backs = 0;
    bool stopped = false;
    for (int first, count; !stopped; single = -1) {
        if (single >= 0)
            count = 1;
        else if (!next_leaf(world, &b, rays, &resume->stack, &first, &count))
            break;
        s.backs = 0;
        stopped = tested + (uint)count > FRUSTUM_BUDGET;
        for (int k = 0; k < count && !stopped; k++) {
            int i = single >= 0 ? single : face_in_leaf(world, first + k);
            if (i == from || i == s.nearest.face)
                continue;
            tested++;
            bool nearer;
            stopped = !test_covering_face(world, &s, i, &nearer);
            if (nearer) {
                resume->face = i;
                bounds_shorten(&b, 1 / s.low);
            }
        }
        if (!stopped)
            backs += s.backs;
        else if (single >= 0)
            resume->face = single;
        else
            push_back(&resume->stack);
    }
    *found = s.nearest;
    world->counters[COUNT_FACE_TESTS] += 4 * tested;
    world->counters[COUNT_SKIPPED + SKIP_BACK_FACE] += rays * backs;
    return !stopped;
}
