/* Traces the rays of a tile from face to face.
 *
 *     for each bounce
 *         find the nearest faces; rays that miss all faces bring the background
 *         shade the hits, and add their colours, weighted by the mirrors before them
 *         reflect the rays of the paths that go on
 *
 * Rays from the eye have it for their common apex. Rays that a plane mirror reflects come from the image of the apex
 * in it, so that those of one image are searched together, too. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/apex.cl"
#include "packet/approx.cl"
#include "packet/intersect.cl"
#include "packet/lanes.cl"
#include "packet/light.cl"
#include "packet/nearest.cl"
#include "packet/paths.cl"
#include "packet/planes.cl"
#include "packet/points.cl"
#include "packet/rays.cl"
#include "packet/shade.cl"
#include "packet/tree.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"

/* What the rays of a packet have met, bounce by bounce. Adaptive sampling needs it. */
typedef struct Trail {
    Mask faces[PATH_MAX]; /* -1: the ray left the scene; TRAIL_ENDED: its path had ended before */
    int count;
} Trail;

#define TRAIL_ENDED -2

/* Where the rays from the eye start. */
typedef struct Eye {
    const wide *point;
    const Apex *apex;
    const RayBounds *bounds; /* of all rays of the tile */
} Eye;

/* The lanes of a packet whose rays come from that image of the eye. Rounding moves images a little. Those that lie
 * close together count as one. */
INLINE Mask lanes_of_image(const Path *path, const Ray *ray, WideVec image)
{
    WideVec from = wide_sub(ray->origin, image), apart = wide_sub(path->apex, image);
    Wide same = (256 * WIDE_ROUNDING) * (wide_magnitudes(image) + wide_magnitudes(from));
    return TO_MASK(IS(wide_magnitudes(apart) <= same));
}

/* Where the rays begin, as t from the image. Returns how far their lines pass from it. */
INLINE Lanes begin_after_mirror(const Ray *ray, WideVec image, Nearest *nearest)
{
    WideVec from = wide_sub(ray->origin, image), d = ray->direction;
    Wide begin = wide_dot(from, d) / (ROUNDED_IS_POOR ? (Wide)1 : wide_dot(d, d)); /* in double d is a unit vector */
    nearest->begin = TO_REAL(begin);
    nearest->limit = 1 / nearest->begin;
    WideVec off = wide_sub(from, wide_scale(begin, d));
    Wide rounding = (16 * WIDE_ROUNDING) * (wide_magnitudes(image) + wide_magnitudes(from));
    return TO_REAL(wide_magnitudes(off) + rounding) * (1 + 4 * REAL_ROUNDING);
}

/* Finds the nearest faces of rays that come from images of the eye, one image after another. length: no direction is
 * longer. */
INLINE void find_reflected(const World *world, const Path *paths, real length, const Traversal *resume, const Group *g)
{
    Mask rest[PACKETS];
    EACH_PACKET(p)
        rest[p] = paths[p].active;
    while (any_packet(rest)) {
        int first = first_packet(rest), lane = lowest_bit(mask_bits(rest[first]));
        WideVec apex = paths[first].apex;
        wide image[3] = {wide_at(apex.x, lane), wide_at(apex.y, lane), wide_at(apex.z, lane)};
        Lanes spread = (Lanes)0;
        EACH_PACKET(p) {
            OriginPacket *packet = g->packets + p;
            packet->active = (Mask)0;
            if (!ANY(rest[p]))
                continue;
            packet->active = rest[p] & lanes_of_image(paths + p, g->rays + p, wide_of(image));
            rest[p] &= ~packet->active;
            Lanes s = begin_after_mirror(g->rays + p, wide_of(image), g->nearest + p);
            spread = (packet->active & IS(s > spread)) ? s : spread;
        }
        Apex a = apex_at(image, -lanes_lowest(-spread), length);
        RayBounds bounds = bounds_from(&a, g->packets, PACKETS, 0);
        find_nearest_from(world, &a, g, &bounds, resume, false);
    }
    EACH_PACKET(p)
        g->near_ties[p] = (Mask)-1; /* culling closed boxes is proved for rays from the eye only */
}

/* Finds the nearest faces of all paths. from_eye: the rays come from the eye itself, not from its images. resume: as
 * find_nearest_from. */
INLINE void find_nearest(const World *world, const Eye *eye, bool from_eye, const Path *paths, const Traversal *resume,
                         const Group *g)
{
    EACH_PACKET(p) {
        g->nearest[p] = nothing_yet();
        g->packets[p] = no_origin_packet();
        g->packets[p].active = paths[p].active;
        if (!ANY(paths[p].active))
            continue;
        g->packets[p].from = paths[p].from;
        g->packets[p].ahead = vec_to_real(g->rays[p].direction);
    }
    if (from_eye) {
        find_nearest_from(world, eye->apex, g, eye->bounds, resume, true);
    } else {
        real length = (ROUNDED_IS_POOR ? 1 : eye->apex->length) * (1 + 4 * REAL_ROUNDING);
        find_reflected(world, paths, length, resume, g);
    }
}

/* Adds to each path's total the colours of its hits, each weighted by the mirrors before it. bounces: how many
 * mirrors the rays have met already. resume: for the first search, as find_nearest_from. trails: of each packet, or
 * NULL. */
COMPILED_ONCE void trace_paths(const World *world, const Eye *eye, int bounces, Path *paths, Ray *rays,
                               const Traversal *resume, Trail *trails)
{
    constant const Parameters *parameters = world->parameters;
    Vec background = vec_row(world->view + VIEW_BACKGROUND);
    for (;; bounces++, resume = 0) {
        OriginPacket packets[PACKETS];
        Nearest nearest[PACKETS];
        Mask near_ties[PACKETS];
        Group group = {PACKETS, packets, rays, nearest, near_ties};
        find_nearest(world, eye, bounces == 0, paths, resume, &group);

        Surface surfaces[PACKETS];
        Mask active[PACKETS];
        const wide *apex = bounces == 0 ? eye->point : 0;
        LazyPoints points;
        begin_points(world, &points, rays, nearest, active, bounces == 0);
        EACH_PACKET(p) {
            Path *path = paths + p;
            if (trails)
                trails[p].faces[trails[p].count++] = path->active ? nearest[p].face : (Mask)TRAIL_ENDED;
            Mask missed = path->active & IS(nearest[p].face < (Mask)0);
            path_add(path, missed, background);
            path->active &= ~missed;
            active[p] = path->active;
            if (!ANY(path->active))
                continue;
            Vec ahead = vec_to_real(rays[p].direction), eye_from_apex = from_apexes(eye->point, apex, &path->apex);
            find_surface(world, nearest + p, path->active, ahead, apex, &path->apex, surfaces + p);
            surfaces[p].to_viewer =
                find_viewer(world, eye->point, surfaces + p, ahead, bounces == 0, eye_from_apex, &points, p);
        }
        if (!any_packet(active))
            return;
        Illumination sums[PACKETS];
        shade(world, surfaces, apex, paths, &points, near_ties, sums);

        EACH_PACKET(p) {
            Path *path = paths + p;
            if (!ANY(path->active))
                continue;
            path_add(path, path->active, sums[p].colour);
            if (bounces == parameters->max_bounces)
                continue;
            if (!parameters->shadow_ambient)
                path->active &= sums[p].lit;
            path->active &= IS(surfaces[p].reflection > (Lanes)0);
            drop_weak(world, path, surfaces[p].reflection);
            active[p] = path->active;
        }
        if (bounces == parameters->max_bounces || !any_packet(active))
            return;
        EACH_PACKET(p) {
            Path *path = paths + p;
            if (!ANY(path->active))
                continue;
            world->counters[COUNT_REFLECTION] += mask_count(path->active);
            reflect(&points, p, path->active, rays + p, &path->apex);
            path->weight = path->weight * surfaces[p].reflection;
            path->from = surfaces[p].face;
        }
    }
}
