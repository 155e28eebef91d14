/* The chain of hits that all rays of a window have in common: a face, what it mirrors, what that mirrors, and so on. A
 * plane mirror makes of the camera another camera, its image (Heckbert and Hanrahan, "Beam Tracing Polygonal Objects",
 * 1984). Where the chain ends, the exact rays are made by following the mirrors:
 *
 *     ray = from the camera through the pixel
 *     for each hit of the chain:
 *         point = where the ray meets the face;  ray = mirrored there
 *
 * It costs a mirrored step for each packet and mirror. It buys searches with a common origin behind mirrors: mirrors
 * 83.7 to 34.6 ms, together with the class of the first hit. docs/kernels.md, section 13. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "packet/camera.cl"
#include "packet/intersect.cl"
#include "packet/lanes.cl"
#include "packet/nearest.cl"
#include "packet/paths.cl"
#include "packet/points.cl"
#include "packet/rays.cl"
#include "packet/vectors.cl"
#include "packet/window.cl"
#include "packet/world.cl"
#include "tile/covering_face.cl"

/* A hit that all rays of a window have in common. Bit i stands for light i, of the first FACET_LIGHTS. */
typedef struct UniformHit {
    CoveringFace seen;
    uint lit, shadowed; /* the light reaches all of the window's part of the face; none of it */
} UniformHit;

/* What is known of a window. */
typedef struct Classification {
    int bounces; /* so many hits are known */
    UniformHit hits[PATH_MAX];
    Traversal resume; /* what the search for the next one has not ruled out, where that one is not common to all rays */
} Classification;

INLINE bool has_first_hit(const Classification *c) { return c->bounces > 0; }

/* The rays of a tile that is traced while it is classified. */
typedef struct TileRays {
    const ScreenPlaces *places;
    Path *paths; /* packet by packet */
    Mask (*blocked)[PACKETS]; /* room for the lanes that each light of a facet does not reach */
} TileRays;

/* A window on its way from mirror to mirror. */
typedef struct MirrorChain {
    const Window *window;
    uint rays;                    /* so many go through the window; of a tile, so many have not ended */
    const TileRays *tile;         /* NULL: the window is a block or a quarter, which is classified and not traced */
    const Classification *parent; /* of the window around it, or NULL */
    Classification *found;        /* its own, so far */
    Camera camera;                /* the image of the camera in the mirrors so far */
    Frustum corners;              /* the window's, from there */
    uint backs;                   /* the count of SKIP_BACK_FACE before the hit */
    bool decided; /* of each light on its way: it reaches all rays of the window, or none */
    bool dark;    /* no light reaches any ray, and none goes on */
} MirrorChain;

INLINE MirrorChain begin_chain(const World *world, const Window *window, uint rays, const Classification *parent,
                               Classification *found)
{
    MirrorChain chain;
    chain.window = window;
    chain.rays = rays;
    chain.tile = 0;
    chain.parent = parent;
    chain.found = found;
    chain.camera = camera_of(world);
    chain.decided = true;
    chain.dark = false;
    found->bounces = 0;
    return chain;
}

/* The exact rays of a tile after so many of its hits have mirrored them. */
NOINLINE void rays_after_mirrors(const World *world, const MirrorChain *chain, int bounces, Path *paths, Ray *rays)
{
    Camera camera = camera_of(world);
    const UniformHit *hits = chain->found->hits;
    Nearest nearest[PACKETS];
    Mask all[PACKETS];
    EACH_PACKET(p) {
        rays[p].origin = wide_of(camera.eye);
        rays[p].direction = camera_direction(&camera, chain->tile->places, p);
        paths[p].apex = rays[p].origin;
        paths[p].from = (Mask)(bounces > 0 ? hits[bounces - 1].seen.face : -1);
        all[p] = (Mask)-1;
    }
    for (int i = 0; i < bounces; i++) {
        LazyPoints points;
        begin_points(world, &points, rays, nearest, all, i == 0);
        EACH_PACKET(p) {
            nearest[p].face = (Mask)hits[i].seen.face;
            nearest[p].from_behind = (Mask)(hits[i].seen.from_behind ? -1 : 0);
            reflect(&points, p, all[p], rays + p, &paths[p].apex);
        }
    }
}
