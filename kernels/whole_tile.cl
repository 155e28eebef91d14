/* Tiles that see the same everywhere: one face, what it mirrors, or nothing. Rays through a tile lie between its four corner
 * rays, and what decides, edge functions and 1/t, is linear in a ray: what holds at the corners, holds in the tile
 * (Reshetov, Soupikov, Hurley, "Multi-Level Ray Tracing Algorithm", 2005). So four rays stand for all to find the face
 * and the light's way to it, and only shading is done for each. A planar mirror makes of the camera another camera, its image, and the
 * tile goes on with that. What is not the same everywhere is left to render.cl. docs/algorithm.md, section 11. */

#define WHOLE_TILES (SKETCHED && !ADAPTIVE && PACKETS > 1)

#if WHOLE_TILES

enum { WHOLE_BUDGET = 24 }; /* faces that a tile may meet; then it hardly is whole */

typedef enum Cover { COVERS_NONE, COVERS_SOME, COVERS_ALL } Cover;

/* What the rays between the corners may meet of a face. `inside`: they pass inside its edges by more than that. */
INLINE Cover cover(const ApexFace *f, const CornerRays *c, real error, real inside)
{
    if (!(error < (real)1e30f))
        return COVERS_SOME; /* nothing below overflows: there is no NaN */
    real4 x = vload4(0, f->x), y = vload4(0, f->y), z = vload4(0, f->z);
    real4 low = fma((real4)c->x[0], x, fma((real4)c->y[0], y, c->z[0] * z)), high = low;
    for (int i = 1; i < 4; i++) {
        real4 edge = fma((real4)c->x[i], x, fma((real4)c->y[i], y, c->z[i] * z));
        low = LESSER(edge, low);
        high = GREATER(edge, high);
    }
    return least_of(high) < -error ? COVERS_NONE : least_of(low) > inside ? COVERS_ALL : COVERS_SOME;
}

/* 1/t at the corners. */
INLINE real4 corner_depths(const ApexFace *f, const CornerRays *c)
{
    return fma(vload4(0, c->x), (real4)f->nx, fma(vload4(0, c->y), (real4)f->ny, vload4(0, c->z) * f->nz));
}

/* The face that all of a tile sees. */
typedef struct Whole {
    int face; /* -1: none */
    bool with_normal;
    real low, high; /* 1/t is between these */
} Whole;

/* Finds it; false: they may see several. from: the mirror that the rays come from, -1: they come from the eye. */
INLINE bool find_whole(const Geometry *g, const Tree *tree, const Apex *a, const CornerRays *c, int from, uint lanes, Whole *w,
                       Counters *counters)
{
    real4 begin_low = (real4)INFINITY, begin_high = begin_low;
    ApexFace face;
    if (from >= 0) {
        if (see_face(a, face_row(g, from), true, false, &face) != SIGHT_CLEAR)
            return false;
        real4 begin = corner_depths(&face, c);
        begin_low = begin - face.depth_error;
        begin_high = begin + face.depth_error;
    }
    w->face = -1;
    w->low = w->high = 0;
    Bundle b = bundle_of_corners(a, c, 0);
    if (from < 0)
        bundle_leave_out_sides(&b, false);
    Stack stack = stack_of(tree, &b);
    uint asked = 0, backs = 0;
    for (int first, count; next_leaf(g, tree, &b, lanes, &stack, &first, &count, counters);) {
        asked += (uint)count;
        if (asked > WHOLE_BUDGET)
            return false;
        for (int k = first; k < first + count; k++) {
            int i = face_in_leaf(tree, k);
            if (i == from || i == w->face)
                continue;
            Sight sight = see_face(a, face_row(g, i), false, from < 0, &face);
            if (sight == SIGHT_DOUBTFUL)
                return false;
            if (sight == SIGHT_NONE) {
                backs += face.closed;
                continue;
            }
            Cover covers = cover(&face, c, face.edge_error, (face.closed ? 4 : 1) * face.edge_error);
            if (covers == COVERS_NONE)
                continue;
            real4 depths = corner_depths(&face, c), nearer = depths - face.depth_error, farther = depths + face.depth_error;
            if (least_of(nearer - begin_high) > 0)
                continue; /* before the mirror */
            real low = least_of(nearer), high = most_of(farther);
            if (high < w->low)
                continue;
            if (covers != COVERS_ALL || !(low > w->high) || !(least_of(begin_low - farther) > 0))
                return false;
            w->face = i;
            w->with_normal = face.with_normal;
            w->low = low;
            w->high = high;
            bundle_shorten(&b, 1 / low);
        }
    }
    counters->kinds[COUNT_FACE_TESTS] += 4 * asked;
    counters->kinds[COUNT_SKIPPED + SKIP_BACK_FACE] += lanes * backs;
    counters->kinds[COUNT_SKIPPED + SKIP_WHOLE_TILE] += lanes;
    return true;
}

typedef enum Shade { SHADE_NONE, SHADE_SOME, SHADE_ALL } Shade;

INLINE Shade shade_counted(Shade shade, uint asked, uint backs, Counters *counters)
{
    counters->kinds[COUNT_FACE_TESTS] += 4 * asked;
    counters->kinds[COUNT_SKIPPED + SKIP_BACK_FACE] += backs;
    return shade;
}

/* How much of the tile's part of a face lies in the shadow of a light, the apex. c: from the light to the corners; no ray ends
 * farther than `spread` from where it says. */
INLINE Shade find_shade(const Geometry *g, const Tree *tree, const Apex *light, const CornerRays *c, real spread, int from, bool outside,
                        uint lanes, Counters *counters)
{
    Bundle b = bundle_of_corners(light, c, spread);
    bundle_shorten(&b, 1 + 4 * REAL_ROUNDING);
    if (outside)
        bundle_leave_out_sides(&b, true);
    Stack stack = stack_of(tree, &b);
    real doubt = DOUBT_OF(spread / light->length);
    uint asked = 0, backs = 0;
    for (int first, count; next_leaf(g, tree, &b, lanes, &stack, &first, &count, counters);) {
        asked += (uint)count;
        if (asked > WHOLE_BUDGET)
            return shade_counted(SHADE_SOME, asked, 0, counters);
        for (int k = first; k < first + count; k++) {
            int i = face_in_leaf(tree, k);
            if (i == from)
                continue;
            ApexFace face;
            Sight sight = see_face(light, face_row(g, i), true, outside, &face);
            if (sight == SIGHT_DOUBTFUL)
                return shade_counted(SHADE_SOME, asked, 0, counters);
            if (sight == SIGHT_NONE) {
                backs += face.closed;
                continue;
            }
            Cover covers = cover(&face, c, doubt * face.edge_error, doubt * face.edge_error);
            if (covers == COVERS_NONE)
                continue;
            real4 depths = corner_depths(&face, c);
            real error = doubt * face.depth_error;
            if (most_of(depths) + error < 1)
                continue; /* beyond the points */
            if (covers != COVERS_ALL || !(least_of(depths) - error > 1))
                return shade_counted(SHADE_SOME, asked, 0, counters);
            return shade_counted(SHADE_ALL, asked, lanes * backs, counters);
        }
    }
    return shade_counted(SHADE_NONE, asked, lanes * backs, counters);
}

/* A tile on its way from mirror to mirror. */
typedef struct Flight {
    Camera camera; /* the image of the camera in the mirrors so far */
    int mirrors[PATH_MAX];
    bool with_normals[PATH_MAX];
    int bounces;
} Flight;

/* The exact rays of a tile after its mirrors. */
NOINLINE void replay(const Geometry *g, const Shading *s, const ScreenPlaces *places, const Flight *flight, Path *paths, Ray *rays)
{
    Camera camera = camera_of(s);
    Nearest nearest[PACKETS];
    Mask all[PACKETS];
    EACH_PACKET(p) {
        rays[p].origin = wide_vec((Wide)camera.eye[0], (Wide)camera.eye[1], (Wide)camera.eye[2]);
        rays[p].direction = camera_direction(&camera, places, p);
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

/* What shading one bounce of a whole tile works on. */
typedef struct WholeHit {
    Whole face;
    Surface surface; /* the same for all packets */
    Vec ahead[PACKETS], v[PACKETS];
    Sketch sketches[PACKETS];
    CornerRays corners; /* of the face's part, from the camera's image */
    real error;      /* of any point, and of the corners */
} WholeHit;

/* False: a sketch of it is too rough. */
INLINE bool sketch_whole(const Geometry *g, const Shading *s, const ScreenPlaces *places, const Camera *camera, const CornerRays *c,
                         bool from_eye, WholeHit *hit)
{
    int i = hit->face.face;
    global const wide *plane = g->planes + (size_t)i * PLANE_REALS;
    Vec normal = vec((Lanes)(real)plane[0], (Lanes)(real)plane[1], (Lanes)(real)plane[2]);
    real height = sketch_height(g, i, camera->eye), sign = hit->face.with_normal ? -1 : 1;
    Surface *surface = &hit->surface;
    surface->face = (Mask)i;
    surface->only = i;
    surface->only_material = g->faces[i].material;
    surface->material = (Mask)surface->only_material;
    surface->reflection = (Lanes)s->materials[(size_t)surface->only_material * MATERIAL_REALS + MATERIAL_REFLECTION];
    surface->with_normal = (Mask)(hit->face.with_normal ? -1 : 0);
    surface->normal = vec_scale((Lanes)sign, normal);

    real4 x = vload4(0, c->x), y = vload4(0, c->y), z = vload4(0, c->z);
    real4 per_approach = 1 / fma(x, (real4)(real)plane[0], fma(y, (real4)(real)plane[1], z * (real)plane[2])), t = height * per_approach;
    vstore4(t * x, 0, hit->corners.x);
    vstore4(t * y, 0, hit->corners.y);
    vstore4(t * z, 0, hit->corners.z);
    real longest = longest_of(c);
    wide apart = fabs(camera->eye[0]) + fabs(camera->eye[1]) + fabs(camera->eye[2]);
    real off = SKETCH_OFF((real)apart + vertex_magnitudes(g, i));
    hit->error = ((8 * REAL_ROUNDING) * most_of(t) * longest + off) * (1 + longest * most_of(fabs(per_approach)));
    wide eye[3] = {view_value(s, VIEW_EYE), view_value(s, VIEW_EYE + 1), view_value(s, VIEW_EYE + 2)};
    Vec eye_from_apex = from_apexes(eye, camera->eye, 0);
    bool fine = true;
    EACH_PACKET(p) {
        hit->ahead[p] = vec_to_real(camera_direction(camera, places, p));
        hit->sketches[p] = sketch(hit->ahead[p], (Lanes)height, (Lanes)off, normal);
        Lanes per_length, share;
        if (s->parameters->viewer_ray || from_eye)
            hit->v[p] = vec_scale(-1 / hit->sketches[p].length, hit->ahead[p]);
        else
            fine &= sketch_towards(hit->sketches + p, eye_from_apex, (Mask)-1, hit->v + p, &per_length, &share);
    }
    return fine;
}

/* The shadow of a light on a tile whose part of it is no simple one. */
NOINLINE void find_shadow(const Geometry *g, const Shading *s, const ScreenPlaces *places, const Flight *flight, const WholeHit *hit,
                          const wide *position, const Pencil *aimed, Mask *asking, Mask *blocked, Counters *counters)
{
    Path paths[PACKETS];
    Ray rays[PACKETS];
    Nearest nearest[PACKETS];
    Mask all[PACKETS], close[PACKETS];
    Pencil pencils[PACKETS];
    EACH_PACKET(p) {
        pencils[p] = aimed[p];
        all[p] = (Mask)-1;
        close[p] = (Mask)(flight->bounces > 0 ? -1 : 0);
        nearest[p].face = hit->surface.face;
        nearest[p].with_normal = hit->surface.with_normal;
    }
    replay(g, s, places, flight, paths, rays);
    Points points;
    points_of(&points, g, rays, nearest, all, flight->bounces == 0);
    find_blocked(g, s->tree, position, pencils, &points, close, asking, blocked, counters);
}

/* The light that the tile's face sends, as `shade` has it. False: the exact points are needed; nothing is counted then. */
INLINE bool shade_whole(const Geometry *g, const Shading *s, const ScreenPlaces *places, const Flight *flight, const WholeHit *hit,
                        const Path *paths, Vec *colours, Mask *lit, Counters *counters)
{
    const Surface *surface = &hit->surface;
    uint lanes = 0;
    EACH_PACKET(p) {
        colours[p] = vec(0, 0, 0);
        lit[p] = (Mask)0;
        lanes += mask_count(paths[p].active);
    }
    for (int i = 0; i < s->parameters->light_count; i++) {
        global const real *light = s->lights + i * LIGHT_REALS;
        wide position[3] = {(wide)light[0] + (wide)light[3], (wide)light[1] + (wide)light[4], (wide)light[2] + (wide)light[5]};
        Vec at = from_apexes(position, flight->camera.eye, 0);
        LightSide side = {-1, 0};
        bool facing = ANY(turned_to_light(g, surface, surface->only, position, &side)), asking = true;
        if (SKIPS(s->parameters, SKIP_LIGHT_AMBIENT) && s->parameters->shadow_ambient && has_only_ambient(light)) {
            counters->kinds[COUNT_SKIPPED + SKIP_LIGHT_AMBIENT] += facing ? lanes : 0;
            if (SKIPS(s->parameters, SKIP_LIGHT_BEHIND))
                counters->kinds[COUNT_SKIPPED + SKIP_LIGHT_BEHIND] += facing ? 0 : lanes;
            asking = facing = false;
        } else if (!facing && SKIPS(s->parameters, SKIP_LIGHT_BEHIND)) {
            counters->kinds[COUNT_SKIPPED + SKIP_LIGHT_BEHIND] += lanes;
            asking = false;
        }
        Pencil pencils[PACKETS];
        Mask blocked[PACKETS];
        EACH_PACKET(p) {
            Lanes share;
            blocked[p] = (Mask)0;
            pencils[p] = no_pencil();
            if (!asking && !facing)
                continue;
            if (!sketch_towards(hit->sketches + p, at, paths[p].active, &pencils[p].ahead, &pencils[p].per_end, &share))
                return false;
            pencils[p].doubt = DOUBT_OF(share);
        }
        if (asking) {
            CornerRays c;
            real x = (real)(position[0] - flight->camera.eye[0]), y = (real)(position[1] - flight->camera.eye[1]);
            real z = (real)(position[2] - flight->camera.eye[2]);
            for (int k = 0; k < 4; k++) {
                c.x[k] = hit->corners.x[k] - x;
                c.y[k] = hit->corners.y[k] - y;
                c.z[k] = hit->corners.z[k] - z;
            }
            real spread = hit->error + 2 * REAL_ROUNDING * GREATER(fabs(x), GREATER(fabs(y), fabs(z)));
            Apex a = apex_at(position, 0, longest_of(&c) * (1 + 4 * REAL_ROUNDING));
            counters->kinds[COUNT_SHADOW] += lanes;
            uint backs = counters->kinds[COUNT_SKIPPED + SKIP_BACK_FACE];
            Shade shadow = find_shade(g, s->tree, &a, &c, spread, surface->only, flight->bounces == 0, lanes, counters);
            if (shadow == SHADE_ALL)
                facing = false;
            if (shadow == SHADE_SOME) {
                counters->kinds[COUNT_SKIPPED + SKIP_BACK_FACE] = backs; /* they are counted again */
                Mask rest[PACKETS];
                EACH_PACKET(p) {
                    Vec l = pencils[p].ahead;
                    rest[p] = paths[p].active;
                    pencils[p].left = surface->face;
                    pencils[p].ahead = vec(-l.x, -l.y, -l.z);
                }
                find_shadow(g, s, places, flight, hit, position, pencils, rest, blocked, counters);
                EACH_PACKET(p) {
                    Vec d = pencils[p].ahead;
                    pencils[p].ahead = vec(-d.x, -d.y, -d.z);
                }
            }
        }
        EACH_PACKET(p) {
            Mask reaches = facing ? paths[p].active & ~blocked[p] : (Mask)0;
            lit[p] |= reaches;
            Mask counted = s->parameters->shadow_ambient ? paths[p].active : reaches;
            if (ANY(counted))
                colours[p] = vec_add(colours[p], illuminate(s, surface, light, pencils[p].ahead, hit->v[p], counted, reaches, counters));
        }
    }
    return true;
}

/* Traces the tile as long as it sees the same everywhere; true: to the end. False: paths and rays are as they are where render.cl has to
 * go on, after `bounces`. */
NOINLINE bool trace_whole(const Geometry *g, const Shading *s, const ScreenPlaces *places, Path *paths, Ray *rays, int *bounces,
                        Counters *counters)
{
    constant const Parameters *parameters = s->parameters;
    Flight flight;
    flight.camera = camera_of(s);
    flight.bounces = 0;
    EACH_PACKET(p) {
        paths[p].total = vec(0, 0, 0);
        paths[p].weight = (Lanes)1;
    }
    for (;; flight.bounces++) {
        const Camera *camera = &flight.camera;
        bool from_eye = flight.bounces == 0;
        int from = from_eye ? -1 : flight.mirrors[flight.bounces - 1];
        real far = (real)(fabs(camera->eye[0]) + fabs(camera->eye[1]) + fabs(camera->eye[2])) + s->view[VIEW_FARTHEST];
        real spread = (real)flight.bounces * ((real)(256 * WIDE_ROUNDING) * far + 4 * SHIFT_FLOOR);
        CornerRays corners = camera_corners(camera, places);
        Apex a = apex_at(camera->eye, spread, GREATER(s->view[VIEW_LENGTH], longest_of(&corners)) * (1 + 8 * REAL_ROUNDING));
        uint lanes = 0;
        Mask active[PACKETS];
        EACH_PACKET(p) {
            active[p] = paths[p].active;
            lanes += mask_count(active[p]);
        }
        if (!SKIPS(parameters, SKIP_WHOLE_TILE))
            break;
        WholeHit hit;
        Vec colours[PACKETS];
        Mask lit[PACKETS];
        Counters before = *counters;
        bool whole = find_whole(g, s->tree, &a, &corners, from, lanes, &hit.face, counters);
        if (whole && hit.face.face < 0) {
            Vec background = vec_row(s->view + VIEW_BACKGROUND);
            EACH_PACKET(p)
                paths[p].total = vec_select(active[p], vec_add(paths[p].total, vec_scale(paths[p].weight, background)), paths[p].total);
            return true;
        }
        if (!whole || !sketch_whole(g, s, places, camera, &corners, from_eye, &hit) ||
            !shade_whole(g, s, places, &flight, &hit, paths, colours, lit, counters)) {
            before.kinds[COUNT_BOX_TESTS] = counters->kinds[COUNT_BOX_TESTS]; /* they were done, if in vain */
            before.kinds[COUNT_FACE_TESTS] = counters->kinds[COUNT_FACE_TESTS];
            *counters = before;
            break;
        }
        bool last = flight.bounces == parameters->max_bounces;
        EACH_PACKET(p) {
            Path *path = paths + p;
            path->total = vec_select(active[p], vec_add(path->total, vec_scale(path->weight, colours[p])), path->total);
            if (last)
                continue;
            if (!parameters->shadow_ambient)
                path->active &= lit[p];
            path->active &= IS(hit.surface.reflection > (Lanes)0);
            drop_weak(s, path, hit.surface.reflection, counters);
            active[p] = path->active;
        }
        if (last || !any_packet(active))
            return true;
        EACH_PACKET(p) {
            counters->kinds[COUNT_REFLECTION] += mask_count(active[p]);
            paths[p].weight = paths[p].weight * hit.surface.reflection;
        }
        flight.mirrors[flight.bounces] = hit.face.face;
        flight.with_normals[flight.bounces] = hit.face.with_normal;
        flight.camera = camera_in_mirror(g, hit.face.face, camera);
    }
    replay(g, s, places, &flight, paths, rays);
    *bounces = flight.bounces;
    return false;
}

#endif
