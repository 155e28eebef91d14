/* Paths through a tile, and the kernel `render`, which turns a block of pixels per work-item into bytes. */

/* The host says how large it takes the shared structs to be; an array of negative length stops the build. */
typedef char FaceRecordHasTheHostsSize[sizeof(FaceRecord) == FACE_RECORD_BYTES ? 1 : -1];
typedef char ParametersHasTheHostsSize[sizeof(Parameters) == PARAMETERS_BYTES ? 1 : -1];

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
INLINE void find_reflected(const Geometry *g, const Tree *tree, const Path *paths, const Ray *rays, real length, const Rest *left,
                           Pencil *pencils, Nearest *nearest, Mask *close, Counters *counters)
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
        Bundle all = bundle_from(&a, pencils, PACKETS, 0);
        find_nearest_from(g, tree, &a, pencils, rays, nearest, &all, left, false, close, counters);
    }
    EACH_PACKET(p)
        close[p] = (Mask)-1; /* what is left out is proved for rays from the eye only */
}

/* The nearest faces of all paths; first from the eye, then from its images. left: what is left to be asked, or NULL: all. */
INLINE void find_nearest(const Geometry *g, const Tree *tree, const Apex *eye, const Bundle *seen, const Path *paths,
                         const Ray *rays, bool from_eye, const Rest *left, Nearest *nearest, Mask *close, Counters *counters)
{
    Pencil pencils[PACKETS];
    EACH_PACKET(p) {
        nearest[p] = nothing_yet();
        pencils[p] = no_pencil();
        pencils[p].active = paths[p].active;
        if (!ANY(paths[p].active))
            continue;
        pencils[p].left = paths[p].left;
        pencils[p].ahead = vec_to_real(rays[p].direction);
    }
    if (from_eye) {
        find_nearest_from(g, tree, eye, pencils, rays, nearest, seen, left, true, close, counters);
    } else {
        real length = (PLAIN_IS_POOR ? 1 : eye->length) * (1 + 4 * REAL_ROUNDING);
        find_reflected(g, tree, paths, rays, length, left, pencils, nearest, close, counters);
    }
}

/* Paths at their beginning, in the eye. */
INLINE void begin_paths(Path *paths, const Ray *rays)
{
    EACH_PACKET(p) {
        paths[p].apex = rays[p].origin;
        paths[p].left = (Mask)-1;
        paths[p].total = vec(0, 0, 0);
        paths[p].weight = (Lanes)1;
    }
}

/* Adds to each path's total its hits' illuminations, each weighted by the mirrors before it. The rays have been mirrored so
 * many times as `bounces` says; those from the eye, an apex, are the bundle `seen`. left: of the first search, as
 * find_nearest. trails: one per packet, or NULL. */
TRACE void trace_paths(const Geometry *g, const Shading *s, const wide *eye, const Apex *apex, const Bundle *seen, int bounces,
                       Path *paths, Ray *rays, const Rest *left, Trail *trails, Counters *counters)
{
    constant const Parameters *parameters = s->parameters;
    Vec background = vec_row(s->view + VIEW_BACKGROUND);
    for (;; bounces++, left = 0) {
        Nearest nearest[PACKETS];
        Mask close[PACKETS];
        find_nearest(g, s->tree, apex, seen, paths, rays, bounces == 0, left, nearest, close, counters);

        Surface surfaces[PACKETS];
        Sketch sketches[PACKETS];
        Vec v[PACKETS], illumination[PACKETS];
        Mask active[PACKETS], lit[PACKETS];
        const wide *one_apex = bounces == 0 ? eye : 0;
        Points points;
        points_of(&points, g, rays, nearest, active, bounces == 0);
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
            find_surface(g, s, nearest + p, path->active, ahead, one_apex, &path->apex, surfaces + p, sketches + p);
            v[p] = look_back(s, eye, sketches + p, ahead, bounces == 0, from_apexes(eye, one_apex, &path->apex), &points, p);
        }
        if (!any_packet(active))
            return;
        shade(g, s, surfaces, sketches, one_apex, paths, &points, close, v, active, illumination, lit, counters);

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
            drop_weak(s, path, surfaces[p].reflection, counters);
            active[p] = path->active;
        }
        if (bounces == parameters->max_bounces || !any_packet(active))
            return;
        EACH_PACKET(p) {
            Path *path = paths + p;
            const Surface *surface = surfaces + p;
            if (!ANY(path->active))
                continue;
            counters->kinds[COUNT_REFLECTION] += mask_count(path->active);
            reflect(&points, p, path->active, rays + p, &path->apex);
            path->weight = path->weight * surface->reflection;
            path->left = surface->face;
        }
    }
}

static void add_counters(volatile global uint *totals, const Counters *counters)
{
    /* A processor takes some work-items in a row: they add to the same copy, which stays in its cache. */
    size_t copy = get_global_id(0) / (LANES > 1 ? 4 : 1) % COUNTER_STRIPES;
    volatile global uint *stripe = totals + copy * COUNTER_STRIDE;
    for (int kind = 0; kind < COUNTER_KINDS; kind++)
        if (counters->kinds[kind])
            atomic_add(stripe + kind, counters->kinds[kind]);
}

/* What rays see that miss all faces. */
INLINE void see_background(const Shading *s, const Mask *inside, Vec *sum, Counters *counters)
{
    Vec background = vec_row(s->view + VIEW_BACKGROUND);
    EACH_PACKET(k) {
        uint rays = mask_count(inside[k]);
        sum[k] = vec_add(sum[k], background);
        counters->kinds[COUNT_PRIMARY] += rays;
        counters->kinds[COUNT_SKIPPED + SKIP_EMPTY_TILE] += rays;
    }
}

/* An area that misses all faces. */
INLINE void render_background(const Shading *s, const Area *area, uint rays, global uchar *rgb, Counters *counters)
{
    constant const Parameters *p = s->parameters;
    Vec background = vec_row(s->view + VIEW_BACKGROUND), sum = vec(0, 0, 0);
    int samples = p->grid * p->grid;
    for (int i = 0; i < samples; i++)
        sum = vec_add(sum, background);
    Vec mean = samples > 1 ? vec(sum.x / samples, sum.y / samples, sum.z / samples) : sum;
    for (int row = 0; row < area->rows; row += PACKET_ROWS)
        for (int column = 0; column < area->columns; column += PACKET_COLUMNS)
            store_packet(rgb, p, area->column + column, area->row + row, mean);
    counters->kinds[COUNT_PRIMARY] += rays;
    counters->kinds[COUNT_SKIPPED + SKIP_EMPTY_TILE] += rays;
}

/* The tile that begins there; rgb: band_rows * columns * 3 bytes. */
INLINE void render_tile(const Geometry *g, const Shading *s, const Apex *apex, const Camera *camera, const Outlook *outlook,
                        int first_column, int first_row, global uchar *rgb, Counters *counters)
{
    constant const Parameters *p = s->parameters;
    Mask inside[PACKETS];
    Vec sum[PACKETS];
    EACH_PACKET(k) {
        inside[k] = pixels_inside(p, first_column, first_row, k);
        sum[k] = vec(0, 0, 0);
    }
    for (int j = 0; j < p->grid; j++)
        for (int i = 0; i < p->grid; i++) {
            ScreenPlaces places = screen_places(s, first_column, p->first_row + first_row, i, j);
            Window window = window_of_tile(p, &places, first_column, first_row);
            CornerRays corners = camera_corners(camera, &window);
            if (SKIPS(p, SKIP_EMPTY_TILE) && !is_told(outlook)) {
                Bundle seen = bundle_of_corners(apex, &corners, 0);
                if (misses_all(s->tree, &seen)) {
                    see_background(s, inside, sum, counters);
                    continue;
                }
            }
            Path paths[PACKETS];
            Ray rays[PACKETS];
            EACH_PACKET(k) {
                paths[k].active = inside[k];
                counters->kinds[COUNT_PRIMARY] += mask_count(inside[k]);
            }
            int bounces = 0;
#if WHOLE_TILES
            Rest rest;
            bool done = trace_whole(g, s, &places, &window, outlook, paths, rays, &bounces, &rest, counters);
            const Rest *left = &rest;
#else
            EACH_PACKET(k) {
                rays[k].origin = wide_vec((Wide)camera->eye[0], (Wide)camera->eye[1], (Wide)camera->eye[2]);
                rays[k].direction = camera_direction(camera, &places, k);
            }
            begin_paths(paths, rays);
            bool done = false;
            const Rest *left = 0;
#endif
            if (!done) {
                Bundle seen = bundle_of_corners(apex, &corners, 0);
                trace_paths(g, s, camera->eye, apex, &seen, bounces, paths, rays, left, 0, counters);
            }
            EACH_PACKET(k)
                sum[k] = vec_add(sum[k], paths[k].total);
        }
    store_tile(p, first_column, first_row, sum, rgb);
}

/* What the corners of an area tell of what it sees: not all of it, all of it, or that it is nothing. */
typedef enum Tidings { TELLS_SOME, TELLS_ALL, TELLS_EMPTY } Tidings;

/* parent: as look_out. outlook: filled but where it is empty, told: where all is told. */
INLINE Tidings ask_corners(const Geometry *g, const Shading *s, const Apex *apex, const Camera *camera, const Area *area,
                           uint rays, const Outlook *parent, Outlook *outlook, Told *told, Counters *counters)
{
    Window window = window_of_area(s, area);
    CornerRays corners = camera_corners(camera, &window);
    Bundle seen = bundle_of_corners(apex, &corners, 0);
    bool may_be_empty = SKIPS(s->parameters, SKIP_EMPTY_TILE) && !(parent && is_told(parent));
    if (may_be_empty && misses_all(s->tree, &seen))
        return TELLS_EMPTY;
    return look_out(g, s, &window, rays, parent, outlook, counters) && tell(g, s, outlook, told) ? TELLS_ALL : TELLS_SOME;
}

/* Renders a block of tiles: at once if its corners tell all, or else quarter by quarter, and a quarter whose corners do not tell
 * all tile by tile. */
INLINE void render_block(const Geometry *g, const Shading *s, const Apex *apex, const Camera *camera, int block, global uchar *rgb,
                         Counters *counters)
{
    constant const Parameters *p = s->parameters;
    Outlook outlooks[2]; /* the block's, its quarter's */
    Told told;
    for (int k = 0; k < BLOCK_AREAS; k++) {
        Area area = area_of_block(p, block, k);
        if (area.columns <= 0 || area.rows <= 0)
            continue;
        uint rays = (uint)(area.columns * area.rows) * (uint)(p->grid * p->grid);
        Outlook *outlook = outlooks + (k > 0);
        Tidings tidings = TELLS_SOME;
        if (BLOCK_AREAS > 1) {
            tidings = ask_corners(g, s, apex, camera, &area, rays, k > 0 ? outlooks : 0, outlook, &told, counters);
            if (k == 0 && tidings == TELLS_SOME)
                continue;
        }
        if (tidings == TELLS_EMPTY)
            render_background(s, &area, rays, rgb, counters);
        else
            for (int row = area.row; row < area.row + area.rows; row += TILE_ROWS)
                for (int column = area.column; column < area.column + area.columns; column += TILE_COLUMNS)
                    if (tidings != TELLS_ALL || !render_told(s, &told, column, row, rgb, counters))
                        render_tile(g, s, apex, camera, outlook, column, row, rgb, counters);
        if (k == 0)
            return;
    }
}

#if !ADAPTIVE && !CASTS
/* One work-item per block of the band; surplus work-items do nothing. */
kernel void render(constant Parameters *parameters, global const FaceRecord *faces, global const real *edges,
                   global const wide *planes, global const real *materials, global const real *lights,
                   global const real *view, global uchar *rgb, volatile global uint *totals,
                   global const float *tree_floats, global const int *tree_ints)
{
    Geometry g = {faces, edges, planes, parameters->face_count};
    Tree tree = {tree_floats, tree_ints};
    Shading s = {materials, lights, view, parameters, &tree};
    Counters counters = {{0}};
    Apex apex = apex_at_eye(&s);
    Camera camera = camera_of(&s);
    render_block(&g, &s, &apex, &camera, (int)get_global_id(0), rgb, &counters);
    add_counters(totals, &counters);
}
#endif
