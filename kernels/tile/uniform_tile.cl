/* Tiles that see the same everywhere, as far as they do: one face, what it mirrors, or nothing. The rays of the four corners stand
 * for all to find the face and the light's way to it (corners.cl), and only shading is done for each. A planar mirror makes of the
 * camera another camera, its image, and the tile goes on with that. What the tile's block has told is not asked again, and what is
 * not the same everywhere is left to render.cl. docs/algorithm.md, section 11. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "shared/skips.h"
#include "packet/apex.cl"
#include "packet/approx.cl"
#include "packet/camera.cl"
#include "packet/intersect.cl"
#include "packet/lanes.cl"
#include "packet/light.cl"
#include "packet/nearest.cl"
#include "packet/paths.cl"
#include "packet/points.cl"
#include "packet/rays.cl"
#include "packet/shadow.cl"
#include "packet/tree.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"
#include "tile/classify.cl"
#include "tile/facet.cl"
#include "tile/frustum.cl"

#if CLASSIFIES_TILES

/* A tile on its way from mirror to mirror. */
typedef struct MirrorChain {
    const ScreenPlaces *places;
    const Classification *classification;
    int mirrors[PATH_MAX];
    bool with_normals[PATH_MAX];
    int bounces;
    Camera camera;      /* the image of the camera in the mirrors so far */
    Frustum corners; /* the tile's, from there */
    uint lanes;         /* so many of its rays have not ended */
} MirrorChain;

/* The exact rays of a tile after its mirrors. */
NOINLINE void rays_after_mirrors(const World *world, const MirrorChain *chain, Path *paths, Ray *rays)
{
    Camera camera = camera_of(world);
    Nearest nearest[PACKETS];
    Mask all[PACKETS];
    EACH_PACKET(p) {
        rays[p].origin = wide_vec((Wide)camera.eye[0], (Wide)camera.eye[1], (Wide)camera.eye[2]);
        rays[p].direction = camera_direction(&camera, chain->places, p);
        paths[p].apex = rays[p].origin;
        paths[p].from = (Mask)(chain->bounces > 0 ? chain->mirrors[chain->bounces - 1] : -1);
        all[p] = (Mask)-1;
    }
    for (int i = 0; i < chain->bounces; i++) {
        LazyPoints points;
        begin_points(world, &points, rays, nearest, all, i == 0);
        EACH_PACKET(p) {
            nearest[p].face = (Mask)chain->mirrors[i];
            nearest[p].with_normal = (Mask)(chain->with_normals[i] ? -1 : 0);
            reflect(&points, p, all[p], rays + p, &paths[p].apex);
        }
    }
}

/* The lanes that a light does not reach, where neither all of the facet is in its shadow nor none. stack: leads to what may block
 * them. False: a sketch is too rough. */
NOINLINE bool find_shadow(const World *world, const MirrorChain *chain, const Facet *f, const wide *position,
                          const Path *asking, const Stack *stack, Mask *blocked)
{
    Path paths[PACKETS];
    Ray rays[PACKETS];
    Nearest nearest[PACKETS];
    Mask all[PACKETS], uncertain[PACKETS], rest[PACKETS];
    OriginPacket packets[PACKETS];
    Vec light = from_apexes(position, chain->camera.eye, 0);
    EACH_PACKET(p) {
        Vec ahead, l;
        Lanes share;
        ApproxPoint approx = approx_on_facet(f, chain->places, p, &ahead);
        rest[p] = asking[p].active;
        if (!approx_towards(&approx, light, rest[p], &l, &packets[p].per_end, &share))
            return false;
        packets[p].ahead = vec(-l.x, -l.y, -l.z);
        packets[p].slack = SLACK_OF(share);
        packets[p].active = (Mask)0;
        packets[p].from = (Mask)f->face;
        all[p] = (Mask)-1;
        uncertain[p] = (Mask)(chain->bounces > 0 ? -1 : 0);
        nearest[p].face = (Mask)f->face;
        nearest[p].with_normal = (Mask)(f->sign < 0 ? -1 : 0);
    }
    rays_after_mirrors(world, chain, paths, rays);
    LazyPoints points;
    begin_points(world, &points, rays, nearest, all, chain->bounces == 0);
    ShadowGroup group = {position, packets, &points, blocked};
    find_blocked(world, &group, rest, uncertain, stack);
    return true;
}

/* Adds light i to the facet that the tile sees. paths: those that have not ended are asked. blocked: holds the lanes that it does
 * not reach. False: a sketch is too rough. */
INLINE bool light_facet(const World *world, const MirrorChain *chain, const CoveringFace *w, const Patch *patch,
                        const Path *paths, int i, Facet *f, Mask *blocked)
{
    const Classification *o = chain->classification;
    int bounce = chain->bounces;
    global const real *light = world->lights + i * LIGHT_REALS;
    wide position[3];
    light_position(light, position);
    bool told = bounce < o->bounces && i < CLASSIFIED_LIGHTS;
    bool facing = told ? o->facing[bounce] >> i & 1 : faces_the_light(world, w, position);
    ShadowClass shade = SHADOWED;
    if (asks_light(world, light, facing)) {
        Stack stack;
        if (told && o->clear[bounce] >> i & 1)
            shade = LIT;
        else if (!told || !(o->dark[bounce] >> i & 1))
            shade = classify_shadow_on(world, w->face, patch, &chain->camera, position, bounce == 0, chain->lanes, &stack);
        /* A light behind the face comes here only where it is to be asked in spite of that. */
        if (shade == PARTLY_SHADOWED && !find_shadow(world, chain, f, position, paths, &stack, blocked))
            return false;
    }
    facet_add_light(world, light, facing, shade, blocked, f);
    return true;
}

/* Adds what the facet sends to each packet's colours, and the lanes that some light reaches to `lit`. False: a sketch is too
 * rough. */
INLINE bool shade_tile(const World *world, const MirrorChain *chain, const CoveringFace *w, const Path *paths,
                       Facet *f, Vec *colours, Mask *lit)
{
    Patch patch = patch_on(world, w->face, &chain->corners, f->height, f->off);
    int lights = world->parameters->light_count;
    for (int i = 0; i < lights;) {
        Mask blocked[CLASSIFIED_LIGHTS][PACKETS];
        f->light_count = 0;
        for (int turn = 0; turn < CLASSIFIED_LIGHTS && i < lights; turn++, i++)
            if (!light_facet(world, chain, w, &patch, paths, i, f, blocked[turn]))
                return false;
        EACH_PACKET(p) {
            if (!shade_facet(world, f, chain->places, p, paths[p].active, colours + p, lit + p))
                return false;
            for (int k = 0; k < f->light_count; k++) {
                const FacetLight *light = f->lights + k;
                if (light->blocked && !light->terms.has_highlight)
                    world->counters[COUNT_SKIPPED + SKIP_HIGHLIGHT] += mask_count(paths[p].active & ~light->blocked[p]);
            }
        }
    }
    return true;
}

/* Traces the tile as long as it sees the same everywhere; true: to the end. False: paths and rays are as they are where
 * render.cl has to go on, after `bounces`, and `rest` is what is left of their search. */
NOINLINE bool trace_uniform_tile(const World *world, const ScreenPlaces *places, const Window *window,
                                 const Classification *classification, Path *paths, Ray *rays, int *bounces,
                                 Traversal *rest)
{
    constant const Parameters *parameters = world->parameters;
    MirrorChain chain;
    chain.places = places;
    chain.classification = classification;
    chain.camera = camera_of(world);
    chain.bounces = 0;
    EACH_PACKET(p) {
        paths[p].total = vec(0, 0, 0);
        paths[p].weight = (Lanes)1;
    }
    for (;; chain.bounces++) {
        const Camera *camera = &chain.camera;
        int from = chain.bounces == 0 ? -1 : chain.mirrors[chain.bounces - 1];
        chain.corners = camera_frustum(camera, window);
        chain.lanes = 0;
        EACH_PACKET(p)
            chain.lanes += mask_count(paths[p].active);
        uint before[COUNTER_KINDS];
        for (int kind = 0; kind < COUNTER_KINDS; kind++)
            before[kind] = world->counters[kind];
        CoveringFace w;
        if (chain.bounces < classification->bounces)
            w = classification->faces[chain.bounces];
        else {
            Apex a = apex_of_image(world, camera, &chain.corners, chain.bounces);
            *rest = chain.bounces == classification->bounces ? classification->rest : begin_in_frustum(world, &a, &chain.corners);
            if (!MAY_SKIP(parameters, SKIP_WHOLE_TILE) ||
                !find_covering_face(world, &a, &chain.corners, from, chain.lanes, &w, rest))
                break;
        }
        Facet f;
        Mask lit[PACKETS];
        Vec colours[PACKETS];
        facet_of(world, &w, camera, chain.bounces, &f);
        EACH_PACKET(p) {
            colours[p] = w.face < 0 ? vec_row(world->view + VIEW_BACKGROUND) : vec(0, 0, 0);
            lit[p] = (Mask)0;
        }
        if (w.face >= 0 && !shade_tile(world, &chain, &w, paths, &f, colours, lit)) {
            for (int kind = 0; kind < COUNTER_KINDS; kind++)
                if (kind != COUNT_BOX_TESTS && kind != COUNT_FACE_TESTS) /* those were done, if in vain */
                    world->counters[kind] = before[kind];
            Apex a = apex_of_image(world, camera, &chain.corners, chain.bounces);
            *rest = begin_in_frustum(world, &a, &chain.corners); /* the search had succeeded, and used it up */
            break;
        }
        count_facet(world, &f, chain.lanes);
        bool last = w.face < 0 || chain.bounces == parameters->max_bounces || f.reflection == 0;
        uint reflected = 0;
        EACH_PACKET(p) {
            Path *path = paths + p;
            path->total = vec_select(path->active, vec_add(path->total, vec_scale(path->weight, colours[p])), path->total);
            if (last)
                continue;
            if (!parameters->shadow_ambient)
                path->active &= lit[p];
            drop_weak(world, path, (Lanes)f.reflection);
            path->weight = path->weight * f.reflection;
            reflected += mask_count(path->active);
        }
        if (reflected == 0)
            return true;
        world->counters[COUNT_REFLECTION] += reflected;
        chain.mirrors[chain.bounces] = w.face;
        chain.with_normals[chain.bounces] = w.with_normal;
        chain.camera = camera_in_mirror(world, w.face, camera);
    }
    rays_after_mirrors(world, &chain, paths, rays);
    *bounces = chain.bounces;
    return false;
}

#endif
