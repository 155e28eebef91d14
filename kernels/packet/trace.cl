/* A tile of rays followed from face to face, in packets. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/apex.cl"
#include "packet/approx.cl"
#include "packet/intersect.cl"
#include "packet/lanes.cl"
#include "packet/nearest.cl"
#include "packet/paths.cl"
#include "packet/planes.cl"
#include "packet/points.cl"
#include "packet/rays.cl"
#include "packet/shade.cl"
#include "packet/tree.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"

/* The faces that each lane's ray met, in order, kept for adaptive sampling: -1 where it left the scene, TRAIL_ENDED where its
 * path had ended before. */
#if ADAPTIVE
#define TRACE NOINLINE /* called twice, but compiled once */
#define TRAIL_ENDED -2

typedef struct Trail {
    Mask faces[PATH_MAX];
    int count;
} Trail;

INLINE void trail_add(Trail *trails, int p, Mask faces, Mask active)
{
    if (trails)
        trails[p].faces[trails[p].count++] = active ? faces : (Mask)TRAIL_ENDED;
}
#else
#define TRACE static

typedef int Trail;

INLINE void trail_add(Trail *trails, int p, Mask faces, Mask active) {}
#endif

/* The nearest faces of rays that come from images of the eye: those that share one are searched together. */
INLINE void find_reflected(const World *world, const Path *paths, const Ray *rays, real length, const Traversal *left,
                           OriginPacket *pencils, Nearest *nearest, Mask *close)
{
    Mask rest[PACKETS];
    EACH_PACKET(p)
        rest[p] = paths[p].active;
    while (any_packet(rest)) {
        int first = 0;
        while (!ANY(rest[first]))
            first++;
        wide x[LANES], y[LANES], z[LANES];
        STORE(paths[first].apex.x, x);
        STORE(paths[first].apex.y, y);
        STORE(paths[first].apex.z, z);
        int lane = lowest_bit(mask_bits(rest[first]));
        wide image[3] = {x[lane], y[lane], z[lane]};
        WideVec at = wide_vec((Wide)image[0], (Wide)image[1], (Wide)image[2]);
        Lanes spread = (Lanes)0;
        EACH_PACKET(p) {
            pencils[p].active = (Mask)0;
            if (!ANY(rest[p]))
                continue;
            /* What one image is, rounding tells apart; the bundle's spread covers it. */
            WideVec origin = rays[p].origin, from = wide_sub(origin, at), apart = wide_sub(paths[p].apex, at);
            Wide same = (256 * WIDE_ROUNDING) * (wide_magnitudes(at) + wide_magnitudes(from));
            pencils[p].active = rest[p] & TO_MASK(IS(wide_magnitudes(apart) <= same));
            rest[p] &= ~pencils[p].active;
            WideVec d = rays[p].direction;
            Wide begin = wide_dot(from, d) / (PLAIN_IS_POOR ? (Wide)1 : wide_dot(d, d)); /* in double d is a unit vector */
            WideVec off = wide_sub(from, wide_scale(begin, d));
            Wide rounding = (16 * WIDE_ROUNDING) * (wide_magnitudes(at) + wide_magnitudes(from));
            Lanes s = TO_REAL(wide_magnitudes(off) + rounding) * (1 + 4 * REAL_ROUNDING);
            spread = (pencils[p].active & IS(s > spread)) ? s : spread;
            nearest[p].begin = TO_REAL(begin);
            nearest[p].limit = 1 / nearest[p].begin;
        }
        Apex a = apex_at(image, -lanes_lowest(-spread), length);
        RayBounds all = bounds_from(&a, pencils, PACKETS, 0);
        find_nearest_from(world, &a, pencils, rays, nearest, &all, left, false, close);
    }
    EACH_PACKET(p)
        close[p] = (Mask)-1; /* what is left out is proved for rays from the eye only */
}

/* The nearest faces of all paths; first from the eye, then from its images. left: what is left to be asked, or NULL: all. */
INLINE void find_nearest(const World *world, const Apex *eye, const RayBounds *seen, const Path *paths,
                         const Ray *rays, bool from_eye, const Traversal *left, Nearest *nearest, Mask *close)
{
    OriginPacket pencils[PACKETS];
    EACH_PACKET(p) {
        nearest[p] = nothing_yet();
        pencils[p] = no_origin_packet();
        pencils[p].active = paths[p].active;
        if (!ANY(paths[p].active))
            continue;
        pencils[p].left = paths[p].left;
        pencils[p].ahead = vec_to_real(rays[p].direction);
    }
    if (from_eye) {
        find_nearest_from(world, eye, pencils, rays, nearest, seen, left, true, close);
    } else {
        real length = (PLAIN_IS_POOR ? 1 : eye->length) * (1 + 4 * REAL_ROUNDING);
        find_reflected(world, paths, rays, length, left, pencils, nearest, close);
    }
}

/* Adds to each path's total its hits' illuminations, each weighted by the mirrors before it. The rays have been mirrored so
 * many times as `bounces` says; those from the eye, an apex, are the bundle `seen`. left: of the first search, as
 * find_nearest. trails: one per packet, or NULL. */
TRACE void trace_paths(const World *world, const wide *eye, const Apex *apex, const RayBounds *seen, int bounces,
                       Path *paths, Ray *rays, const Traversal *left, Trail *trails)
{
    constant const Parameters *parameters = world->parameters;
    Vec background = vec_row(world->view + VIEW_BACKGROUND);
    for (;; bounces++, left = 0) {
        Nearest nearest[PACKETS];
        Mask close[PACKETS];
        find_nearest(world, apex, seen, paths, rays, bounces == 0, left, nearest, close);

        Surface surfaces[PACKETS];
        ApproxPoint approx[PACKETS];
        Vec v[PACKETS], illumination[PACKETS];
        Mask active[PACKETS], lit[PACKETS];
        const wide *one_apex = bounces == 0 ? eye : 0;
        LazyPoints points;
        begin_points(world, &points, rays, nearest, active, bounces == 0);
        EACH_PACKET(p) {
            Path *path = paths + p;
            trail_add(trails, p, nearest[p].face, path->active);
            Mask missed = path->active & IS(nearest[p].face < (Mask)0);
            path->total = vec_select(missed, vec_add(path->total, vec_scale(path->weight, background)), path->total);
            path->active &= ~missed;
            active[p] = path->active;
            if (!ANY(path->active))
                continue;
            Vec ahead = vec_to_real(rays[p].direction);
            find_surface(world, nearest + p, path->active, ahead, one_apex, &path->apex, surfaces + p, approx + p);
            v[p] = look_back(world, eye, approx + p, ahead, bounces == 0, from_apexes(eye, one_apex, &path->apex), &points, p);
        }
        if (!any_packet(active))
            return;
        shade(world, surfaces, approx, one_apex, paths, &points, close, v, active, illumination, lit);

        EACH_PACKET(p) {
            Path *path = paths + p;
            if (!ANY(path->active))
                continue;
            path->total = vec_select(path->active, vec_add(path->total, vec_scale(path->weight, illumination[p])), path->total);
            if (bounces == parameters->max_bounces)
                continue;
            if (!parameters->shadow_ambient)
                path->active &= lit[p];
            path->active &= IS(surfaces[p].reflection > (Lanes)0);
            drop_weak(world, path, surfaces[p].reflection);
            active[p] = path->active;
        }
        if (bounces == parameters->max_bounces || !any_packet(active))
            return;
        EACH_PACKET(p) {
            Path *path = paths + p;
            const Surface *surface = surfaces + p;
            if (!ANY(path->active))
                continue;
            world->counters[COUNT_REFLECTION] += mask_count(path->active);
            reflect(&points, p, path->active, rays + p, &path->apex);
            path->weight = path->weight * surface->reflection;
            path->left = surface->face;
        }
    }
}
