/* Tiles that see the same everywhere, as far as they do: one face, what it mirrors, or nothing. The rays of the four corners stand
 * for all to find the face and the light's way to it (corners.cl), and only shading is done for each. A planar mirror makes of the
 * camera another camera, its image, and the tile goes on with that. What the tile's block has told is not asked again, and what is
 * not the same everywhere is left to render.cl. docs/algorithm.md, section 11. */

#if WHOLE_TILES

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

/* The lanes that a light does not reach, where neither all of the facet is in its shadow nor none. stack: leads to what may block
 * them. False: a sketch is too rough. */
NOINLINE bool find_shadow(const Geometry *g, const Shading *s, const ScreenPlaces *places, const Flight *flight, const Facet *f,
                          bool with_normal, const wide *position, const Path *asking, const Stack *stack, Mask *blocked,
                          Counters *counters)
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
        Sketch drawn = sketch_facet(f, places, p, &ahead);
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
        nearest[p].with_normal = (Mask)(with_normal ? -1 : 0);
    }
    replay(g, s, places, flight, paths, rays);
    Points points;
    points_of(&points, g, rays, nearest, all, flight->bounces == 0);
    find_blocked(g, s->tree, position, pencils, &points, close, rest, stack, blocked, counters);
    return true;
}

/* Adds the lights to a facet of the tile. blocked: holds the lanes that they do not reach. False: a sketch is too rough. */
INLINE bool light_facet(const Geometry *g, const Shading *s, const ScreenPlaces *places, const CornerRays *corners,
                        const Outlook *outlook, const Flight *flight, const Whole *w, const Path *paths, uint lanes, Facet *f,
                        Mask (*blocked)[PACKETS], Counters *counters)
{
    int bounce = flight->bounces;
    bool told = bounce < outlook->bounces;
    Patch patch = patch_on(g, w->face, corners, f->height, f->off);
    for (int i = 0; i < s->parameters->light_count; i++) {
        global const real *light = s->lights + i * LIGHT_REALS;
        wide position[3];
        light_position(light, position);
        bool facing = told ? outlook->facing[bounce] >> i & 1 : faces_the_light(g, w, position);
        Shade shade = SHADE_ALL;
        Stack stack;
        if (facet_asks(s, light, facing, f)) {
            if (told && outlook->clear[bounce] >> i & 1)
                shade = SHADE_NONE;
            else if (!told || !(outlook->dark[bounce] >> i & 1))
                shade = find_shade_on(g, s, w->face, &patch, &flight->camera, position, bounce == 0, lanes, &stack, counters);
            if (!facing)
                shade = SHADE_ALL;
        }
        if (shade == SHADE_SOME &&
            !find_shadow(g, s, places, flight, f, w->with_normal, position, paths, &stack, blocked[i], counters))
            return false;
        facet_add_light(s, light, shade, shade == SHADE_SOME ? blocked[i] : 0, f);
        if (shade == SHADE_SOME && !f->lights[f->light_count - 1].shines)
            EACH_PACKET(p)
                counters->kinds[COUNT_SKIPPED + SKIP_HIGHLIGHT] += mask_count(paths[p].active & ~blocked[i][p]);
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
    flight.camera = camera_of(s);
    flight.bounces = 0;
    EACH_PACKET(p) {
        paths[p].total = vec(0, 0, 0);
        paths[p].weight = (Lanes)1;
    }
    for (;; flight.bounces++) {
        const Camera *camera = &flight.camera;
        int from = flight.bounces == 0 ? -1 : flight.mirrors[flight.bounces - 1];
        CornerRays corners = camera_corners(camera, window);
        uint lanes = 0;
        EACH_PACKET(p)
            lanes += mask_count(paths[p].active);
        Counters before = *counters;
        Whole w;
        if (flight.bounces < outlook->bounces)
            w = outlook->faces[flight.bounces];
        else {
            Apex a = apex_of_image(s, camera, &corners, flight.bounces);
            *rest = flight.bounces == outlook->bounces ? outlook->rest : rest_of_corners(s->tree, &a, &corners);
            if (!can_look_out(s) || !find_whole(g, s->tree, &a, &corners, from, lanes, &w, rest, counters))
                break;
        }
        Facet f;
        Mask blocked[OUTLOOK_LIGHTS][PACKETS], lit[PACKETS];
        Vec colours[PACKETS];
        facet_of(g, s, &w, camera, flight.bounces, &f);
        bool fine = w.face < 0 || light_facet(g, s, places, &corners, outlook, &flight, &w, paths, lanes, &f, blocked, counters);
        EACH_PACKET(p) {
            colours[p] = vec_row(s->view + VIEW_BACKGROUND);
            if (w.face >= 0 && fine)
                fine = shade_facet(s, &f, places, p, paths[p].active, colours + p, lit + p);
        }
        if (!fine) {
            before.kinds[COUNT_BOX_TESTS] = counters->kinds[COUNT_BOX_TESTS]; /* they were done, if in vain */
            before.kinds[COUNT_FACE_TESTS] = counters->kinds[COUNT_FACE_TESTS];
            *counters = before;
            Apex a = apex_of_image(s, camera, &corners, flight.bounces);
            *rest = rest_of_corners(s->tree, &a, &corners); /* the search had succeeded, and used it up */
            break;
        }
        count_facet(&f, lanes, counters);
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
    replay(g, s, places, &flight, paths, rays);
    *bounces = flight.bounces;
    return false;
}

#endif
