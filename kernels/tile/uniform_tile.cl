/* Tiles that see the same everywhere, as far as they do: one face, what it mirrors, or nothing. The rays of the four corners stand
 * for all to find the face and the light's way to it (corners.cl), and only shading is done for each. A planar mirror makes of the
 * camera another camera, its image, and the tile goes on with that. What the tile's block has told is not asked again, and what is
 * not the same everywhere is left to render.cl. docs/algorithm.md, section 11. */
#include "shared/skips.h"
#include "shared/layout.h"
#include "packet/lanes.cl"
#include "packet/geometry.cl"
#include "packet/apex.cl"
#include "packet/intersect.cl"
#include "packet/points.cl"
#include "packet/counters.cl"
#include "packet/tree.cl"
#include "packet/search.cl"
#include "packet/shade.cl"
#include "packet/camera.cl"
#include "tile/frustum.cl"
#include "tile/classify.cl"
#include "tile/facet.cl"

#if WHOLE_TILES

/* A tile on its way from mirror to mirror. */
typedef struct Flight {
    const ScreenPlaces *places;
    const Outlook *outlook;
    int mirrors[PATH_MAX];
    bool with_normals[PATH_MAX];
    int bounces;
    Camera camera;      /* the image of the camera in the mirrors so far */
    CornerRays corners; /* the tile's, from there */
    uint lanes;         /* so many of its rays have not ended */
} Flight;

/* The exact rays of a tile after its mirrors. */
NOINLINE void replay(const Geometry *g, const Shading *s, const Flight *flight, Path *paths, Ray *rays)
{
    Camera camera = camera_of(s);
    Nearest nearest[PACKETS];
    Mask all[PACKETS];
    EACH_PACKET(p) {
        rays[p].origin = wide_vec((Wide)camera.eye[0], (Wide)camera.eye[1], (Wide)camera.eye[2]);
        rays[p].direction = camera_direction(&camera, flight->places, p);
        paths[p].apex = rays[p].origin;
        paths[p].left = (Mask)(flight->bounces > 0 ? flight->mirrors[flight->bounces - 1] : -1);
        all[p] = (Mask)-1;
    }
    for (int i = 0; i < flight->bounces; i++) {
        Points points;
        points_of(&points, g, rays, nearest, all, i == 0);
        EACH_PACKET(p) {
            nearest[p].face = (Mask)flight->mirrors[i];
            nearest[p].with_normal = (Mask)(flight->with_normals[i] ? -1 : 0);
            reflect(&points, p, all[p], rays + p, &paths[p].apex);
        }
    }
}

/* The lanes that a light does not reach, where neither all of the facet is in its shadow nor none. stack: leads to what may block
 * them. False: a sketch is too rough. */
NOINLINE bool find_shadow(const Geometry *g, const Shading *s, const Flight *flight, const Facet *f, const wide *position,
                          const Path *asking, const Stack *stack, Mask *blocked, Counters *counters)
{
    Path paths[PACKETS];
    Ray rays[PACKETS];
    Nearest nearest[PACKETS];
    Mask all[PACKETS], close[PACKETS], rest[PACKETS];
    Pencil pencils[PACKETS];
    Vec light = from_apexes(position, flight->camera.eye, 0);
    EACH_PACKET(p) {
        Vec ahead, l;
        Lanes share;
        Sketch drawn = sketch_facet(f, flight->places, p, &ahead);
        rest[p] = asking[p].active;
        if (!sketch_towards(&drawn, light, rest[p], &l, &pencils[p].per_end, &share))
            return false;
        pencils[p].ahead = vec(-l.x, -l.y, -l.z);
        pencils[p].doubt = DOUBT_OF(share);
        pencils[p].active = (Mask)0;
        pencils[p].left = (Mask)f->face;
        all[p] = (Mask)-1;
        close[p] = (Mask)(flight->bounces > 0 ? -1 : 0);
        nearest[p].face = (Mask)f->face;
        nearest[p].with_normal = (Mask)(f->sign < 0 ? -1 : 0);
    }
    replay(g, s, flight, paths, rays);
    Points points;
    points_of(&points, g, rays, nearest, all, flight->bounces == 0);
    find_blocked(g, s->tree, position, pencils, &points, close, rest, stack, blocked, counters);
    return true;
}

/* Adds light i to the facet that the tile sees. paths: those that have not ended are asked. blocked: holds the lanes that it does
 * not reach. False: a sketch is too rough. */
INLINE bool light_facet(const Geometry *g, const Shading *s, const Flight *flight, const Whole *w, const Patch *patch,
                        const Path *paths, int i, Facet *f, Mask *blocked, Counters *counters)
{
    const Outlook *o = flight->outlook;
    int bounce = flight->bounces;
    global const real *light = s->lights + i * LIGHT_REALS;
    wide position[3];
    light_position(light, position);
    bool told = bounce < o->bounces && i < OUTLOOK_LIGHTS;
    bool facing = told ? o->facing[bounce] >> i & 1 : faces_the_light(g, w, position);
    Shade shade = SHADE_ALL;
    if (asks_light(s, light, facing)) {
        Stack stack;
        if (told && o->clear[bounce] >> i & 1)
            shade = SHADE_NONE;
        else if (!told || !(o->dark[bounce] >> i & 1))
            shade = find_shade_on(g, s, w->face, patch, &flight->camera, position, bounce == 0, flight->lanes, &stack, counters);
        /* A light behind the face comes here only where it is to be asked in spite of that. */
        if (shade == SHADE_SOME && !find_shadow(g, s, flight, f, position, paths, &stack, blocked, counters))
            return false;
    }
    facet_add_light(s, light, facing, shade, blocked, f);
    return true;
}

/* Adds what the facet sends to each packet's colours, and the lanes that some light reaches to `lit`. False: a sketch is too
 * rough. */
INLINE bool shade_tile(const Geometry *g, const Shading *s, const Flight *flight, const Whole *w, const Path *paths, Facet *f,
                       Vec *colours, Mask *lit, Counters *counters)
{
    Patch patch = patch_on(g, w->face, &flight->corners, f->height, f->off);
    int lights = s->parameters->light_count;
    for (int i = 0; i < lights;) {
        Mask blocked[OUTLOOK_LIGHTS][PACKETS];
        f->light_count = 0;
        for (int turn = 0; turn < OUTLOOK_LIGHTS && i < lights; turn++, i++)
            if (!light_facet(g, s, flight, w, &patch, paths, i, f, blocked[turn], counters))
                return false;
        EACH_PACKET(p) {
            if (!shade_facet(s, f, flight->places, p, paths[p].active, colours + p, lit + p))
                return false;
            for (int k = 0; k < f->light_count; k++) {
                const FacetLight *light = f->lights + k;
                if (light->blocked && !light->shines)
                    counters->kinds[COUNT_SKIPPED + SKIP_HIGHLIGHT] += mask_count(paths[p].active & ~light->blocked[p]);
            }
        }
    }
    return true;
}

/* Traces the tile as long as it sees the same everywhere; true: to the end. False: paths and rays are as they are where
 * render.cl has to go on, after `bounces`, and `rest` is what is left of their search. */
NOINLINE bool trace_whole(const Geometry *g, const Shading *s, const ScreenPlaces *places, const Window *window,
                          const Outlook *outlook, Path *paths, Ray *rays, int *bounces, Rest *rest, Counters *counters)
{
    constant const Parameters *parameters = s->parameters;
    Flight flight;
    flight.places = places;
    flight.outlook = outlook;
    flight.camera = camera_of(s);
    flight.bounces = 0;
    EACH_PACKET(p) {
        paths[p].total = vec(0, 0, 0);
        paths[p].weight = (Lanes)1;
    }
    for (;; flight.bounces++) {
        const Camera *camera = &flight.camera;
        int from = flight.bounces == 0 ? -1 : flight.mirrors[flight.bounces - 1];
        flight.corners = camera_corners(camera, window);
        flight.lanes = 0;
        EACH_PACKET(p)
            flight.lanes += mask_count(paths[p].active);
        Counters before = *counters;
        Whole w;
        if (flight.bounces < outlook->bounces)
            w = outlook->faces[flight.bounces];
        else {
            Apex a = apex_of_image(s, camera, &flight.corners, flight.bounces);
            *rest = flight.bounces == outlook->bounces ? outlook->rest : rest_of_corners(s->tree, &a, &flight.corners);
            if (!SKIPS(parameters, SKIP_WHOLE_TILE) ||
                !find_whole(g, s->tree, &a, &flight.corners, from, flight.lanes, &w, rest, counters))
                break;
        }
        Facet f;
        Mask lit[PACKETS];
        Vec colours[PACKETS];
        facet_of(g, s, &w, camera, flight.bounces, &f);
        EACH_PACKET(p) {
            colours[p] = w.face < 0 ? vec_row(s->view + VIEW_BACKGROUND) : vec(0, 0, 0);
            lit[p] = (Mask)0;
        }
        if (w.face >= 0 && !shade_tile(g, s, &flight, &w, paths, &f, colours, lit, counters)) {
            before.kinds[COUNT_BOX_TESTS] = counters->kinds[COUNT_BOX_TESTS]; /* they were done, if in vain */
            before.kinds[COUNT_FACE_TESTS] = counters->kinds[COUNT_FACE_TESTS];
            *counters = before;
            Apex a = apex_of_image(s, camera, &flight.corners, flight.bounces);
            *rest = rest_of_corners(s->tree, &a, &flight.corners); /* the search had succeeded, and used it up */
            break;
        }
        count_facet(&f, flight.lanes, counters);
        bool last = w.face < 0 || flight.bounces == parameters->max_bounces || f.reflection == 0;
        uint reflected = 0;
        EACH_PACKET(p) {
            Path *path = paths + p;
            path->total = vec_select(path->active, vec_add(path->total, vec_scale(path->weight, colours[p])), path->total);
            if (last)
                continue;
            if (!parameters->shadow_ambient)
                path->active &= lit[p];
            drop_weak(s, path, (Lanes)f.reflection, counters);
            path->weight = path->weight * f.reflection;
            reflected += mask_count(path->active);
        }
        if (reflected == 0)
            return true;
        counters->kinds[COUNT_REFLECTION] += reflected;
        flight.mirrors[flight.bounces] = w.face;
        flight.with_normals[flight.bounces] = w.with_normal;
        flight.camera = camera_in_mirror(g, w.face, camera);
    }
    replay(g, s, &flight, paths, rays);
    *bounces = flight.bounces;
    return false;
}

#endif
