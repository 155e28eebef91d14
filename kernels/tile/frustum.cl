/* What four rays from an apex tell of all rays between them: those are sums of the four with weights between 0 and 1, and edge
 * functions and 1/t are linear in a ray, so what holds at the corners, holds for all (Reshetov, Soupikov, Hurley, "Multi-Level
 * Ray Tracing Algorithm", 2005). docs/algorithm.md, section 11, whole tiles. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "shared/skips.h"
#include "packet/apex.cl"
#include "packet/camera.cl"
#include "packet/faces.cl"
#include "packet/lanes.cl"
#include "packet/nearest.cl"
#include "packet/tree.cl"
#include "packet/world.cl"

INLINE real least_of(real4 a)
{
    real2 b = LESSER(a.lo, a.hi);
    return LESSER(b.x, b.y);
}

INLINE real most_of(real4 a) { return -least_of(-a); }

/* The length of the longest; those between are no longer. Some may be outside of the picture, and longer than all in it. */
INLINE real longest_of(const Frustum *c)
{
    real4 x = vload4(0, c->x), y = vload4(0, c->y), z = vload4(0, c->z);
    return sqrt(most_of(x * x + y * y + z * z));
}

/* The bundle of all rays between the corners. spread: no component of an exact direction is farther from theirs. */
INLINE RayBounds bounds_of_frustum(const Apex *a, const Frustum *c, real spread)
{
    real4 x = vload4(0, c->x), y = vload4(0, c->y), z = vload4(0, c->z);
    real low[3] = {least_of(x) - spread, least_of(y) - spread, least_of(z) - spread};
    real high[3] = {most_of(x) + spread, most_of(y) + spread, most_of(z) + spread};
    return bounds_within(a, low, high);
}

enum { COVERING_BUDGET = 24 }; /* faces that are asked; where there are more, one hardly covers all */

typedef enum Coverage { COVERAGE_NONE, COVERAGE_PARTIAL, COVERAGE_FULL } Coverage;

/* What the rays between the corners may meet of a face. `inside`: they pass inside its edges by more than that. */
INLINE Coverage classify_face(const FaceSetup *f, const Frustum *c, real error, real inside)
{
    if (!(error < (real)1e30f))
        return COVERAGE_PARTIAL; /* nothing below overflows: there is no NaN */
    real4 x = vload4(0, f->x), y = vload4(0, f->y), z = vload4(0, f->z);
    real4 low = fma((real4)c->x[0], x, fma((real4)c->y[0], y, c->z[0] * z)), high = low;
    for (int i = 1; i < 4; i++) {
        real4 edge = fma((real4)c->x[i], x, fma((real4)c->y[i], y, c->z[i] * z));
        low = LESSER(edge, low);
        high = GREATER(edge, high);
    }
    return least_of(high) < -error ? COVERAGE_NONE : least_of(low) > inside ? COVERAGE_FULL : COVERAGE_PARTIAL;
}

/* 1/t at the corners. */
INLINE real4 frustum_depths(const FaceSetup *f, const Frustum *c)
{
    return fma(vload4(0, c->x), (real4)f->nx, fma(vload4(0, c->y), (real4)f->ny, vload4(0, c->z) * f->nz));
}

/* The face that all rays see. */
typedef struct CoveringFace {
    int face; /* -1: none */
    bool with_normal;
    real low, high; /* 1/t is between these */
} CoveringFace;

/* Finds it among the rest. False: they may see several; the rest is then what has not been ruled out. from: the mirror that
 * the rays come from, -1: they come from the eye. */
INLINE bool find_covering_face(const World *world, const Apex *a, const Frustum *c, int from, uint lanes,
                               CoveringFace *w, Traversal *rest)
{
    real4 begin_low = (real4)INFINITY, begin_high = begin_low;
    FaceSetup face;
    if (from >= 0) {
        if (setup_face(a, face_row(world, from), true, false, &face) != VISIBLE)
            return false;
        real4 begin = frustum_depths(&face, c);
        begin_low = begin - face.depth_error;
        begin_high = begin + face.depth_error;
    }
    w->face = -1;
    w->low = w->high = 0;
    RayBounds b = bounds_of_frustum(a, c, 0);
    if (from < 0)
        bounds_cull_sides(&b, false);
    int known = rest->face;
    rest->face = -1;
    uint asked = 0, backs = 0;
    bool stopped = false;
    for (int first, count; !stopped; known = -1) {
        if (known >= 0)
            count = 1;
        else if (!next_leaf(world, &b, lanes, &rest->stack, &first, &count))
            break;
        uint backs_here = 0;
        stopped = asked + (uint)count > COVERING_BUDGET;
        for (int k = 0; k < count && !stopped; k++) {
            int i = known >= 0 ? known : face_in_leaf(world, first + k);
            if (i == from || i == w->face)
                continue;
            asked++;
            Visibility visibility = setup_face(a, face_row(world, i), false, from < 0, &face);
            if (visibility == CULLED) {
                backs_here += face.closed;
                continue;
            }
            if (visibility == UNCERTAIN) {
                stopped = true;
                continue;
            }
            Coverage covers = classify_face(&face, c, face.edge_error, (face.closed ? 4 : 1) * face.edge_error);
            if (covers == COVERAGE_NONE)
                continue;
            real4 depths = frustum_depths(&face, c), nearer = depths - face.depth_error, farther = depths + face.depth_error;
            if (least_of(nearer - begin_high) > 0)
                continue; /* before the mirror */
            real low = least_of(nearer), high = most_of(farther);
            if (high < w->low)
                continue;
            stopped = covers != COVERAGE_FULL || !(low > w->high) || !(least_of(begin_low - farther) > 0);
            if (stopped)
                continue;
            w->face = rest->face = i;
            w->with_normal = face.with_normal;
            w->low = low;
            w->high = high;
            bounds_shorten(&b, 1 / low);
        }
        if (!stopped)
            backs += backs_here;
        else if (known >= 0)
            rest->face = known;
        else
            push_back(&rest->stack);
    }
    world->counters[COUNT_FACE_TESTS] += 4 * asked;
    world->counters[COUNT_SKIPPED + SKIP_BACK_FACE] += lanes * backs;
    return !stopped;
}

typedef enum ShadowClass { LIT, PARTLY_SHADOWED, SHADOWED } ShadowClass;

/* How much of the part of a face between the corners lies in the shadow of a light, the apex. c: from the light to the
 * corners; no ray ends farther than `spread` from where it says. PARTLY_SHADOWED: what may block them is left on the stack. */
INLINE ShadowClass classify_shadow(const World *world, const Apex *light, const Frustum *c, real spread, int from,
                                   bool cull_boxes, uint lanes, Stack *stack)
{
    RayBounds b = bounds_of_frustum(light, c, spread);
    bounds_shorten(&b, 1 + 4 * REAL_ROUNDING);
    if (cull_boxes)
        bounds_cull_sides(&b, true);
    *stack = stack_of(world, &b);
    real doubt = SLACK_OF(spread / light->length);
    uint asked = 0, backs = 0;
    ShadowClass shade = LIT;
    for (int first, count; shade == LIT && next_leaf(world, &b, lanes, stack, &first, &count);) {
        uint backs_here = 0;
        if (asked + (uint)count > COVERING_BUDGET)
            shade = PARTLY_SHADOWED;
        for (int k = first; k < first + count && shade == LIT; k++) {
            int i = face_in_leaf(world, k);
            if (i == from)
                continue;
            asked++;
            FaceSetup face;
            Visibility visibility = setup_face(light, face_row(world, i), true, cull_boxes, &face);
            if (visibility == CULLED) {
                backs_here += face.closed;
                continue;
            }
            if (visibility == UNCERTAIN) {
                shade = PARTLY_SHADOWED;
                continue;
            }
            Coverage covers = classify_face(&face, c, doubt * face.edge_error, doubt * face.edge_error);
            if (covers == COVERAGE_NONE)
                continue;
            real4 depths = frustum_depths(&face, c);
            real error = doubt * face.depth_error;
            if (most_of(depths) + error < 1)
                continue; /* beyond the points */
            bool all = covers == COVERAGE_FULL && least_of(depths) - error > 1;
            shade = all ? SHADOWED : PARTLY_SHADOWED;
        }
        if (shade == PARTLY_SHADOWED)
            push_back(stack);
        else
            backs += backs_here;
    }
    if (shade == PARTLY_SHADOWED)
        forget_distances(stack); /* those were shares of the rays' lengths */
    world->counters[COUNT_FACE_TESTS] += 4 * asked;
    world->counters[COUNT_SKIPPED + SKIP_BACK_FACE] += lanes * backs;
    return shade;
}
