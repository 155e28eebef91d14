/* Tiles that see the same everywhere: one face, what it mirrors, or nothing. The rays of the four corners stand for all to
 * find the face and the light's way to it (corners.cl), and only shading is done for each. A planar mirror makes of the camera
 * another camera, its image, and the tile goes on with that. The corners of a block of tiles are asked first: what they tell, its
 * tiles need not ask. What is not the same everywhere is left to render.cl. docs/algorithm.md, section 11. */

#define WHOLE_TILES (SKETCHED && !ADAPTIVE && PACKETS > 1)

#if !WHOLE_TILES

typedef int Outlook;

INLINE bool is_told(const Outlook *o) { return false; }

#else

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

/* The part of a face that a window shows. */
typedef struct Patch {
    CornerRays corners; /* from the apex */
    real error;         /* of the corners, and of any point between them */
} Patch;

/* height, off: as sketch. */
INLINE Patch patch_on(const Geometry *g, int face, const CornerRays *c, real height, real off)
{
    global const wide *plane = g->planes + (size_t)face * PLANE_REALS;
    real4 x = vload4(0, c->x), y = vload4(0, c->y), z = vload4(0, c->z);
    real4 per_approach = 1 / fma(x, (real4)(real)plane[0], fma(y, (real4)(real)plane[1], z * (real)plane[2]));
    real4 t = height * per_approach;
    Patch patch;
    vstore4(t * x, 0, patch.corners.x);
    vstore4(t * y, 0, patch.corners.y);
    vstore4(t * z, 0, patch.corners.z);
    patch.error = SKETCH_ERROR(most_of(t), longest_of(c), most_of(fabs(per_approach)), off);
    return patch;
}

/* How far a face's height may be off. */
INLINE real patch_off(const Geometry *g, int face, const Camera *camera)
{
    wide apart = fabs(camera->eye[0]) + fabs(camera->eye[1]) + fabs(camera->eye[2]);
    return SKETCH_OFF((real)apart + vertex_magnitudes(g, face));
}

/* How much of it lies in the shadow of a light. outside, lanes, stack: as find_shade. */
INLINE Shade find_shade_on(const Geometry *g, const Shading *s, int face, const Patch *patch, const Camera *camera,
                           const wide *light, bool outside, uint lanes, Stack *stack, Counters *counters)
{
    CornerRays c;
    real x = (real)(light[0] - camera->eye[0]), y = (real)(light[1] - camera->eye[1]), z = (real)(light[2] - camera->eye[2]);
    for (int k = 0; k < 4; k++) {
        c.x[k] = patch->corners.x[k] - x;
        c.y[k] = patch->corners.y[k] - y;
        c.z[k] = patch->corners.z[k] - z;
    }
    real spread = patch->error + 2 * REAL_ROUNDING * GREATER(fabs(x), GREATER(fabs(y), fabs(z)));
    Apex a = apex_at(light, 0, longest_of(&c) * (1 + 4 * REAL_ROUNDING));
    return find_shade(g, s->tree, &a, &c, spread, face, outside, lanes, stack, counters);
}

/* The apex of rays between corners after so many bounces. */
INLINE Apex apex_of_image(const Shading *s, const Camera *camera, const CornerRays *corners, int bounces)
{
    real far = (real)(fabs(camera->eye[0]) + fabs(camera->eye[1]) + fabs(camera->eye[2])) + s->view[VIEW_FARTHEST];
    real spread = (real)bounces * ((real)(256 * WIDE_ROUNDING) * far + 4 * SHIFT_FLOOR);
    return apex_at(camera->eye, spread, GREATER(s->view[VIEW_LENGTH], longest_of(corners)) * (1 + 8 * REAL_ROUNDING));
}

INLINE Rest rest_of_corners(const Tree *tree, const Apex *a, const CornerRays *corners)
{
    Bundle all = bundle_of_corners(a, corners, 0);
    return rest_of_all(tree, &all);
}

enum { OUTLOOK_BOUNCES = 4, OUTLOOK_LIGHTS = 32 };

/* What the corners of a block of tiles tell of all of them, bounce by bounce. */
typedef struct Outlook {
    int bounces; /* so many are told; of the next one `rest` is left to be searched */
    Whole faces[OUTLOOK_BOUNCES];
    uint facing[OUTLOOK_BOUNCES]; /* bit i: the face is turned to light i */
    uint clear[OUTLOOK_BOUNCES];  /* nothing is between */
    uint dark[OUTLOOK_BOUNCES];   /* something is, everywhere */
    Rest rest;
} Outlook;

/* Is it known what the tiles of the block see first? */
INLINE bool is_told(const Outlook *o) { return o->bounces > 0; }

/* Is the side of the face that is seen turned to the light? As turned_to_light. */
INLINE bool faces_the_light(const Geometry *g, const Whole *w, const wide *light)
{
    wide side = plane_distance_of_point(g, w->face, light);
    return w->with_normal ? side < 0 : side > 0;
}

/* The lights of a bounce. */
INLINE void look_at_lights(const Geometry *g, const Shading *s, const Camera *camera, const CornerRays *corners, int bounce,
                           uint rays, Outlook *o, Counters *counters)
{
    const Whole *w = o->faces + bounce;
    Patch patch = patch_on(g, w->face, corners, sketch_height(g, w->face, camera->eye), patch_off(g, w->face, camera));
    uint facing = 0, clear = 0, dark = 0;
    for (int i = 0; i < min(s->parameters->light_count, (int)OUTLOOK_LIGHTS); i++) {
        global const real *light = s->lights + i * LIGHT_REALS;
        wide position[3];
        light_position(light, position);
        if (!faces_the_light(g, w, position))
            continue;
        facing |= 1u << i;
        if (!wants_light(s, light))
            continue;
        Stack stack;
        uint backs = counters->kinds[COUNT_SKIPPED + SKIP_BACK_FACE];
        Shade shade = find_shade_on(g, s, w->face, &patch, camera, position, bounce == 0, rays, &stack, counters);
        clear |= shade == SHADE_NONE ? 1u << i : 0;
        dark |= shade == SHADE_ALL ? 1u << i : 0;
        if (shade == SHADE_SOME)
            counters->kinds[COUNT_SKIPPED + SKIP_BACK_FACE] = backs; /* each tile asks them again */
    }
    o->facing[bounce] = facing;
    o->clear[bounce] = clear;
    o->dark[bounce] = dark;
}

/* Fills the outlook of a window of so many rays. */
NOINLINE void look_out(const Geometry *g, const Shading *s, const Window *window, uint rays, Outlook *o, Counters *counters)
{
    Camera camera = camera_of(s);
    int from = -1;
    for (int bounce = 0;; bounce++) {
        CornerRays corners = camera_corners(&camera, window);
        Apex a = apex_of_image(s, &camera, &corners, bounce);
        o->bounces = bounce;
        o->rest = rest_of_corners(s->tree, &a, &corners);
        Whole *w = o->faces + bounce;
        if (bounce == OUTLOOK_BOUNCES || !SKIPS(s->parameters, SKIP_WHOLE_TILE) ||
            !find_whole(g, s->tree, &a, &corners, from, rays, w, &o->rest, counters))
            return;
        o->bounces = bounce + 1;
        from = w->face;
        if (from < 0)
            return;
        look_at_lights(g, s, &camera, &corners, bounce, rays, o, counters);
        real reflection = s->materials[(size_t)face_material(g, from) * MATERIAL_REALS + MATERIAL_REFLECTION];
        if (reflection == 0 || bounce == s->parameters->max_bounces)
            return;
        camera = camera_in_mirror(g, from, &camera);
    }
}

/* What shading one bounce of a whole tile works on. */
typedef struct WholeHit {
    Whole face;
    Surface surface; /* the same for all packets */
    Vec v[PACKETS];
    Sketch sketches[PACKETS];
    Patch patch;
} WholeHit;

/* False: a sketch of it is too rough. */
INLINE bool sketch_whole(const Geometry *g, const Shading *s, const ScreenPlaces *places, const Camera *camera, const CornerRays *c,
                         bool from_eye, WholeHit *hit)
{
    int i = hit->face.face;
    global const wide *plane = g->planes + (size_t)i * PLANE_REALS;
    Vec normal = vec((Lanes)(real)plane[0], (Lanes)(real)plane[1], (Lanes)(real)plane[2]);
    real height = sketch_height(g, i, camera->eye), off = patch_off(g, i, camera), sign = hit->face.with_normal ? -1 : 1;
    Surface *surface = &hit->surface;
    surface->face = (Mask)i;
    surface->only = i;
    surface->only_material = face_material(g, i);
    surface->material = (Mask)surface->only_material;
    surface->reflection = (Lanes)s->materials[(size_t)surface->only_material * MATERIAL_REALS + MATERIAL_REFLECTION];
    surface->with_normal = (Mask)(hit->face.with_normal ? -1 : 0);
    surface->normal = vec_scale((Lanes)sign, normal);
    hit->patch = patch_on(g, i, c, height, off);
    wide eye[3] = {view_value(s, VIEW_EYE), view_value(s, VIEW_EYE + 1), view_value(s, VIEW_EYE + 2)};
    Vec eye_from_apex = from_apexes(eye, camera->eye, 0);
    bool fine = true;
    EACH_PACKET(p) {
        Vec ahead = vec_to_real(camera_direction(camera, places, p));
        hit->sketches[p] = sketch(ahead, (Lanes)height, (Lanes)off, normal);
        Lanes per_length, share;
        if (s->parameters->viewer_ray || from_eye)
            hit->v[p] = vec_scale(-1 / hit->sketches[p].length, ahead);
        else
            fine &= sketch_towards(hit->sketches + p, eye_from_apex, (Mask)-1, hit->v + p, &per_length, &share);
    }
    return fine;
}

/* The lanes that a light does not reach, where neither all are in its shadow nor none. to_light: the pencils turned round;
 * stack: leads to what may block them. */
NOINLINE void find_shadow(const Geometry *g, const Shading *s, const ScreenPlaces *places, const Flight *flight,
                          const WholeHit *hit, const wide *position, const Pencil *to_light, const Path *asking,
                          const Stack *stack, Mask *blocked, Counters *counters)
{
    Path paths[PACKETS];
    Ray rays[PACKETS];
    Nearest nearest[PACKETS];
    Mask all[PACKETS], close[PACKETS], rest[PACKETS];
    Pencil pencils[PACKETS];
    EACH_PACKET(p) {
        Vec l = to_light[p].ahead;
        pencils[p] = to_light[p];
        pencils[p].ahead = vec(-l.x, -l.y, -l.z);
        pencils[p].left = hit->surface.face;
        rest[p] = asking[p].active;
        all[p] = (Mask)-1;
        close[p] = (Mask)(flight->bounces > 0 ? -1 : 0);
        nearest[p].face = hit->surface.face;
        nearest[p].with_normal = hit->surface.with_normal;
    }
    replay(g, s, places, flight, paths, rays);
    Points points;
    points_of(&points, g, rays, nearest, all, flight->bounces == 0);
    find_blocked(g, s->tree, position, pencils, &points, close, rest, stack, blocked, counters);
}

/* The light that the tile's face sends, as `shade` has it. False: the exact points are needed; the caller takes back what was
 * counted. */
INLINE bool shade_whole(const Geometry *g, const Shading *s, const ScreenPlaces *places, const Outlook *outlook,
                        const Flight *flight, const WholeHit *hit, const Path *paths, Vec *colours, Mask *lit, Counters *counters)
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
        wide position[3];
        light_position(light, position);
        Vec at = from_apexes(position, flight->camera.eye, 0);
        int bounce = flight->bounces;
        bool told = bounce < outlook->bounces && i < OUTLOOK_LIGHTS, asking = true;
        bool facing = told ? outlook->facing[bounce] >> i & 1 : faces_the_light(g, &hit->face, position);
        if (!wants_light(s, light)) {
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
            counters->kinds[COUNT_SHADOW] += lanes;
            Stack stack;
            Shade shadow;
            if (told && outlook->clear[bounce] >> i & 1)
                shadow = SHADE_NONE;
            else if (told && outlook->dark[bounce] >> i & 1)
                shadow = SHADE_ALL;
            else
                shadow = find_shade_on(g, s, surface->only, &hit->patch, &flight->camera, position, bounce == 0, lanes, &stack,
                                       counters);
            if (shadow == SHADE_ALL)
                facing = false;
            if (shadow == SHADE_SOME)
                find_shadow(g, s, places, flight, hit, position, pencils, paths, &stack, blocked, counters);
        }
        EACH_PACKET(p) {
            Mask reaches = facing ? paths[p].active & ~blocked[p] : (Mask)0;
            lit[p] |= reaches;
            Mask counted = s->parameters->shadow_ambient ? paths[p].active : reaches;
            if (!ANY(counted))
                continue;
            Vec sum = illuminate(s, surface, light, pencils[p].ahead, hit->v[p], counted, reaches, counters);
            colours[p] = vec_add(colours[p], sum);
        }
    }
    return true;
}

/* Traces the tile as long as it sees the same everywhere; true: to the end. False: paths and rays are as they are where
 * render.cl has to go on, after `bounces`, and `rest` is what is left of their search. */
NOINLINE bool trace_whole(const Geometry *g, const Shading *s, const ScreenPlaces *places, const Outlook *outlook, Path *paths,
                          Ray *rays, int *bounces, Rest *rest, Counters *counters)
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
        Window window = window_of_tile(places);
        CornerRays corners = camera_corners(camera, &window);
        uint lanes = 0;
        Mask active[PACKETS];
        EACH_PACKET(p) {
            active[p] = paths[p].active;
            lanes += mask_count(active[p]);
        }
        WholeHit hit;
        Vec colours[PACKETS];
        Mask lit[PACKETS];
        Counters before = *counters;
        if (flight.bounces < outlook->bounces)
            hit.face = outlook->faces[flight.bounces];
        else {
            Apex a = apex_of_image(s, camera, &corners, flight.bounces);
            *rest = flight.bounces == outlook->bounces ? outlook->rest : rest_of_corners(s->tree, &a, &corners);
            if (!SKIPS(parameters, SKIP_WHOLE_TILE) ||
                !find_whole(g, s->tree, &a, &corners, from, lanes, &hit.face, rest, counters))
                break;
        }
        counters->kinds[COUNT_SKIPPED + SKIP_WHOLE_TILE] += lanes;
        if (hit.face.face < 0) {
            Vec background = vec_row(s->view + VIEW_BACKGROUND);
            EACH_PACKET(p) {
                Vec total = vec_add(paths[p].total, vec_scale(paths[p].weight, background));
                paths[p].total = vec_select(active[p], total, paths[p].total);
            }
            return true;
        }
        if (!sketch_whole(g, s, places, camera, &corners, from_eye, &hit) ||
            !shade_whole(g, s, places, outlook, &flight, &hit, paths, colours, lit, counters)) {
            before.kinds[COUNT_BOX_TESTS] = counters->kinds[COUNT_BOX_TESTS]; /* they were done, if in vain */
            before.kinds[COUNT_FACE_TESTS] = counters->kinds[COUNT_FACE_TESTS];
            *counters = before;
            Apex a = apex_of_image(s, camera, &corners, flight.bounces);
            *rest = rest_of_corners(s->tree, &a, &corners); /* the search had succeeded, and used it up */
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
