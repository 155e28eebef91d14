/* The kernels: `render` turns a tile of pixels per work-item into bytes, `cast` intersects a list of rays. */

/* A packet is PACKET_COLUMNS x PACKET_ROWS = LANES pixels; the tile that one work-item renders is PACKETS of them,
 * PACKETS_ACROSS side by side, as the host's build options say.
 * The host says, too, how large it takes the shared structs to be; an array of negative length stops the build. */
enum { TILE_COLUMNS = PACKETS_ACROSS * PACKET_COLUMNS, TILE_ROWS = PACKETS / PACKETS_ACROSS * PACKET_ROWS };

typedef char FaceRecordHasTheHostsSize[sizeof(FaceRecord) == FACE_RECORD_BYTES ? 1 : -1];
typedef char ParametersHasTheHostsSize[sizeof(Parameters) == PARAMETERS_BYTES ? 1 : -1];

static wide view_value(const Shading *s, int column) { return (wide)s->view[column] + (wide)s->view[VIEW_REALS + column]; }

static WideVec view_vec(const Shading *s, int column)
{
    return wide_vec((Wide)view_value(s, column), (Wide)view_value(s, column + 1), (Wide)view_value(s, column + 2));
}

/* Where packet k begins in its tile. */
#define PACKET_COLUMN(k) ((k) % PACKETS_ACROSS * PACKET_COLUMNS)
#define PACKET_ROW(k) ((k) / PACKETS_ACROSS * PACKET_ROWS)

INLINE Apex apex_at_eye(const Shading *s)
{
    wide eye[3] = {view_value(s, VIEW_EYE), view_value(s, VIEW_EYE + 1), view_value(s, VIEW_EYE + 2)};
    return apex_at(eye, 0, s->view[VIEW_LARGEST]);
}

/* The places of the tile's columns and rows on the screen: see view_direction in geometry.c. */
typedef struct ScreenPlaces {
    wide x[TILE_COLUMNS], y[TILE_ROWS];
} ScreenPlaces;

/* For the sub-pixels (i, j) of each pixel's grid. */
INLINE ScreenPlaces screen_places(const Shading *s, int first_column, int first_row, int i, int j)
{
    constant const Parameters *p = s->parameters;
    wide sub_column = (i + (wide)0.5) / p->grid, sub_row = (j + (wide)0.5) / p->grid;
    wide width = view_value(s, VIEW_WIDTH), height = view_value(s, VIEW_HEIGHT);
    ScreenPlaces places;
    for (int column = 0; column < TILE_COLUMNS; column++)
        places.x[column] = ((first_column + column + sub_column) / (wide)p->columns - (wide)0.5) * width;
    for (int row = 0; row < TILE_ROWS; row++)
        places.y[row] = ((wide)0.5 - (first_row + row + sub_row) / (wide)p->rows) * height;
    return places;
}

/* The bundle of all rays of the tile. Each component of a direction rises or falls with either place, and so does its rounding:
 * the corners have the extremes. */
INLINE Bundle screen_bundle(const Shading *s, const Apex *eye, const ScreenPlaces *places)
{
    real low[3], high[3];
    for (int axis = 0; axis < 3; axis++) {
        wide forward = view_value(s, VIEW_FORWARD + axis), right = view_value(s, VIEW_RIGHT + axis), up = view_value(s, VIEW_UP + axis);
        wide left_most = forward + places->x[0] * right, right_most = forward + places->x[TILE_COLUMNS - 1] * right;
        wide top = places->y[0] * up, bottom = places->y[TILE_ROWS - 1] * up;
        low[axis] = (real)(LESSER(left_most, right_most) + LESSER(top, bottom));
        high[axis] = (real)(GREATER(left_most, right_most) + GREATER(top, bottom));
    }
    return bundle_within(eye, low, high);
}

/* The directions R = Q - C of packet k's rays. */
INLINE WideVec view_direction(const Shading *s, const ScreenPlaces *places, int k)
{
    const wide *x = places->x + PACKET_COLUMN(k), *y = places->y + PACKET_ROW(k);
#if LANES == 16
    Wide across = (Wide)(vload4(0, x), vload4(0, x), vload4(0, x), vload4(0, x));
    Wide down = (Wide)((wide4)y[0], (wide4)y[1], (wide4)y[2], (wide4)y[3]);
#elif LANES == 8
    Wide across = (Wide)(vload4(0, x), vload4(0, x)), down = (Wide)((wide4)y[0], (wide4)y[1]);
#elif LANES == 4
    Wide across = (Wide)(x[0], x[1], x[0], x[1]), down = (Wide)(y[0], y[0], y[1], y[1]);
#else
    Wide across = x[0], down = y[0];
#endif
    return wide_add(wide_add(view_vec(s, VIEW_FORWARD), wide_scale(across, view_vec(s, VIEW_RIGHT))),
                    wide_scale(down, view_vec(s, VIEW_UP)));
}

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

static Mask lane_numbers(void)
{
    MaskElement numbers[LANES];
    for (int i = 0; i < LANES; i++)
        numbers[i] = i;
    return LOAD(numbers);
}

/* Which pixels of packet k of the tile are in the band. */
INLINE Mask pixels_inside(const Parameters *p, int first_column, int first_row, int k)
{
    Mask number = lane_numbers();
    Mask column = first_column + PACKET_COLUMN(k) + number % PACKET_COLUMNS;
    Mask row = first_row + PACKET_ROW(k) + number / PACKET_COLUMNS;
    return IS(column < (Mask)p->columns) & IS(row < (Mask)p->band_rows);
}

/* The rays of a packet on their way, and what they have brought so far. */
typedef struct Path {
    WideVec apex; /* the image of the eye in the mirrors so far, from which the rays seem to come */
    Mask active, left;
    Vec total;
    Lanes weight;
} Path;

/* The nearest faces of rays that come from images of the eye: those that share one are searched together. */
INLINE void find_reflected(const Geometry *g, const Tree *tree, const Path *paths, const Ray *rays, Pencil *pencils,
                           Nearest *nearest, Mask *close, Counters *counters)
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
            Wide begin = wide_dot(from, d); /* d is a unit vector */
            WideVec off = wide_sub(from, wide_scale(begin, d));
            Wide rounding = (16 * WIDE_ROUNDING) * (wide_magnitudes(at) + wide_magnitudes(from));
            Lanes s = TO_REAL(wide_magnitudes(off) + rounding) * (1 + 4 * REAL_ROUNDING);
            spread = (pencils[p].active & IS(s > spread)) ? s : spread;
            nearest[p].begin = TO_REAL(begin);
            nearest[p].limit = 1 / nearest[p].begin;
        }
        Apex a = apex_at(image, -lanes_lowest(-spread), 1 + 4 * REAL_ROUNDING); /* reflected directions are unit vectors */
        find_nearest_from(g, tree, &a, pencils, rays, nearest, bundle_from(&a, pencils, PACKETS), false, close, counters);
    }
    EACH_PACKET(p)
        close[p] = (Mask)-1; /* what is left out is proved for rays from the eye only */
}

/* The nearest faces of all paths; first from the eye, then from its images. */
INLINE void find_nearest(const Geometry *g, const Tree *tree, const Apex *eye, const Bundle *seen, const Path *paths,
                         const Ray *rays, bool from_eye, Nearest *nearest, Mask *close, Counters *counters)
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
    if (from_eye)
        find_nearest_from(g, tree, eye, pencils, rays, nearest, *seen, true, close, counters);
    else
        find_reflected(g, tree, paths, rays, pencils, nearest, close, counters);
}

/* floor(255 c + 0.5) of the clamped colour, as in light.c. */
INLINE IntLanes colour_to_byte(Lanes c)
{
    c = c > (Lanes)0 ? c : (Lanes)0;
    c = c < (Lanes)1 ? c : (Lanes)1;
    return TO_INT((real)255 * c + (real)0.5); /* at least 0: cutting off is floor */
}

/* Ends the paths all of whose further hits together could not change a byte of the picture: those whose bytes are the same with
 * the most that can come. That is known where a path is its pixel's only one. */
INLINE void drop_weak(const Shading *s, Path *path, Lanes reflection, Counters *counters)
{
#if defined(LINEAR) || ADAPTIVE
#else
    if (!SKIPS(s->parameters, SKIP_WEAK_BOUNCE) || s->parameters->grid > 1 || !ANY(path->active))
        return;
    Lanes most = path->weight * reflection * (Lanes)s->view[VIEW_BRIGHTEST];
    Vec t = path->total;
    const real rounded = 1 + 256 * REAL_ROUNDING; /* no sum of up to PATH_MAX terms is rounded up by more */
    IntLanes red = IS(colour_to_byte(t.x) == colour_to_byte((t.x + most) * rounded));
    IntLanes green = IS(colour_to_byte(t.y) == colour_to_byte((t.y + most) * rounded));
    IntLanes blue = IS(colour_to_byte(t.z) == colour_to_byte((t.z + most) * rounded));
    Mask same = INTS_TO_MASK(red & green & blue);
    counters->kinds[COUNT_SKIPPED + SKIP_WEAK_BOUNCE] += mask_count(path->active & same);
    path->active &= ~same;
#endif
}

/* Sets each path's total to its hits' illuminations, each weighted by the mirrors before it. All rays start at the eye, the
 * apex, as the bundle `seen`. trails: one per packet, or NULL. */
TRACE void trace_paths(const Geometry *g, const Shading *s, const Apex *apex, const Bundle *seen, Path *paths, Ray *rays, Trail *trails,
                       Counters *counters)
{
    constant const Parameters *parameters = s->parameters;
    WideVec eye = rays[0].origin;
    Vec background = vec_row(s->view + VIEW_BACKGROUND);
    EACH_PACKET(p) {
        paths[p].apex = eye;
        paths[p].left = (Mask)-1;
        paths[p].total = vec(0, 0, 0);
        paths[p].weight = (Lanes)1;
    }
    for (int bounces = 0;; bounces++) {
        Nearest nearest[PACKETS];
        Mask close[PACKETS];
        find_nearest(g, s->tree, apex, seen, paths, rays, bounces == 0, nearest, close, counters);

        Surface surfaces[PACKETS];
        WideVec shifted[PACKETS];
        Vec v[PACKETS], illumination[PACKETS];
        Mask active[PACKETS], lit[PACKETS];
        EACH_PACKET(p) {
            Path *path = paths + p;
            trail_add(trails, p, nearest[p].face, path->active);
            Mask missed = path->active & IS(nearest[p].face < (Mask)0);
            path->total = vec_select(missed, vec_add(path->total, vec_scale(path->weight, background)), path->total);
            path->active &= ~missed;
            active[p] = path->active;
            if (!ANY(path->active))
                continue;
            find_surface(g, s, rays + p, bounces == 0, nearest[p].face, nearest[p].with_normal, path->active, surfaces + p, shifted + p);
            WideVec d = rays[p].direction;
            v[p] = vec_unit(vec_to_real(parameters->viewer_ray ? wide_vec(-d.x, -d.y, -d.z) : wide_sub(eye, surfaces[p].point)));
        }
        if (!any_packet(active))
            return;
        shade(g, s, surfaces, shifted, close, v, active, illumination, lit, counters);

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
            WideVec r = wide_unit(rays[p].direction), n = wide_normal(g, surface, path->active);
            rays[p].direction = wide_sub(r, wide_scale(2 * wide_dot(r, n), n));
            rays[p].origin = shifted[p];
            path->apex = wide_sub(path->apex, wide_scale(2 * wide_dot(wide_sub(path->apex, surface->point), n), n));
            path->weight = path->weight * surface->reflection;
            path->left = surface->face;
        }
    }
}

static void add_counters(volatile global uint *totals, const Counters *counters)
{
    volatile global uint *stripe = totals + (get_global_id(0) % COUNTER_STRIPES) * COUNTER_STRIDE;
    for (int kind = 0; kind < COUNTER_KINDS; kind++)
        if (counters->kinds[kind])
            atomic_add(stripe + kind, counters->kinds[kind]);
}

#ifdef LINEAR
/* Puts a colour at that place of the picture. */
static void store_pixel(global uchar *picture, int place, real red, real green, real blue)
{
    global real *out = (global real *)picture + (size_t)place * 3;
    out[0] = red;
    out[1] = green;
    out[2] = blue;
}

/* With this build option the picture is three reals a pixel, as they are, instead of three bytes. */
static void store_packet(global uchar *picture, const Parameters *p, int first_column, int first_row, Vec colour)
{
    real red[LANES], green[LANES], blue[LANES];
    STORE(colour.x, red);
    STORE(colour.y, green);
    STORE(colour.z, blue);
    for (int lane = 0; lane < LANES; lane++) {
        int column = first_column + lane % PACKET_COLUMNS, row = first_row + lane / PACKET_COLUMNS;
        if (column >= p->columns || row >= p->band_rows)
            continue;
        global real *out = (global real *)picture + ((size_t)row * (size_t)p->columns + (size_t)column) * 3;
        out[0] = red[lane];
        out[1] = green[lane];
        out[2] = blue[lane];
    }
}
#else
INLINE uchar value_to_byte(real c)
{
    c = c > 0 ? c : 0;
    c = c < 1 ? c : 1;
    return (uchar)((real)255 * c + (real)0.5);
}

static void store_pixel(global uchar *rgb, int place, real red, real green, real blue)
{
    global uchar *out = rgb + (size_t)place * 3;
    out[0] = value_to_byte(red);
    out[1] = value_to_byte(green);
    out[2] = value_to_byte(blue);
}

/* Four pixels side by side. */
INLINE void store_four(int4 packed, global uchar *out)
{
    uchar16 bytes = as_uchar16(packed);
    vstore8(bytes.s01245689, 0, out);
    vstore4(bytes.sacde, 0, out + 8);
}

static void store_packet(global uchar *rgb, const Parameters *p, int first_column, int first_row, Vec colour)
{
    /* Red is the lowest byte of a pixel's number. */
    IntLanes packed = colour_to_byte(colour.x) | colour_to_byte(colour.y) << 8 | colour_to_byte(colour.z) << 16;
    int columns = min(PACKET_COLUMNS, p->columns - first_column), rows = min(PACKET_ROWS, p->band_rows - first_row);
#if LANES == 16 && defined(__ENDIAN_LITTLE__)
    if (columns == 4 && rows == 4) {
        global uchar *out = rgb + ((size_t)first_row * (size_t)p->columns + (size_t)first_column) * 3;
        size_t stride = (size_t)p->columns * 3;
        store_four(packed.s0123, out);
        store_four(packed.s4567, out + stride);
        store_four(packed.s89ab, out + 2 * stride);
        store_four(packed.scdef, out + 3 * stride);
        return;
    }
#endif
    int pixels[LANES];
    STORE(packed, pixels);
    for (int row = 0; row < rows; row++) {
        global uchar *out = rgb + ((size_t)(first_row + row) * (size_t)p->columns + (size_t)first_column) * 3;
        const int *in = pixels + row * PACKET_COLUMNS;
        for (int column = 0; column < columns; column++) {
            out[3 * column] = (uchar)in[column];
            out[3 * column + 1] = (uchar)(in[column] >> 8);
            out[3 * column + 2] = (uchar)(in[column] >> 16);
        }
    }
}
#endif

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

/* rgb: band_rows * columns * 3 bytes. One work-item per tile, tiles row by row; surplus work-items do nothing. */
kernel void render(constant Parameters *parameters, global const FaceRecord *faces, global const real *edges,
                   global const wide *planes, global const real *materials, global const real *lights,
                   global const real *view, global uchar *rgb, volatile global uint *totals,
                   global const float *tree_floats, global const int *tree_ints)
{
    Parameters p = *parameters;
    Geometry g = {faces, edges, planes, p.face_count};
    Tree tree = {tree_floats, tree_ints};
    Shading s = {materials, lights, view, parameters, &tree};
    Counters counters = {{0}};
    int tiles_across = (p.columns + TILE_COLUMNS - 1) / TILE_COLUMNS;
    int tile = (int)get_global_id(0);
    int first_column = tile % tiles_across * TILE_COLUMNS, first_row = tile / tiles_across * TILE_ROWS;
    if (first_row >= p.band_rows)
        return;

    Apex apex = apex_at_eye(&s);
    Mask inside[PACKETS];
    Vec sum[PACKETS];
    EACH_PACKET(k) {
        inside[k] = pixels_inside(&p, first_column, first_row, k);
        sum[k] = vec(0, 0, 0);
    }
    for (int j = 0; j < p.grid; j++)
        for (int i = 0; i < p.grid; i++) {
            ScreenPlaces places = screen_places(&s, first_column, p.first_row + first_row, i, j);
            Bundle seen = screen_bundle(&s, &apex, &places);
            if (SKIPS(&p, SKIP_EMPTY_TILE) && misses_all(&tree, &seen)) {
                see_background(&s, inside, sum, &counters);
                continue;
            }
            Path paths[PACKETS];
            Ray rays[PACKETS];
            EACH_PACKET(k) {
                rays[k].origin = view_vec(&s, VIEW_EYE);
                rays[k].direction = view_direction(&s, &places, k);
                paths[k].active = inside[k];
                counters.kinds[COUNT_PRIMARY] += mask_count(inside[k]);
            }
            trace_paths(&g, &s, &apex, &seen, paths, rays, 0, &counters);
            EACH_PACKET(k)
                sum[k] = vec_add(sum[k], paths[k].total);
        }
    real samples = (real)p.grid * (real)p.grid;
    EACH_PACKET(k) {
        Vec mean = samples > 1 ? vec(sum[k].x / samples, sum[k].y / samples, sum[k].z / samples) : sum[k];
        store_packet(rgb, &p, first_column + PACKET_COLUMN(k), first_row + PACKET_ROW(k), mean);
    }
    add_counters(totals, &counters);
}

/* rays: ray_count x (origin, direction); hits_face, hits_t: one per ray, -1 and 0 for a miss. LANES rays per work-item. */
kernel void cast(constant Parameters *parameters, global const FaceRecord *faces, global const real *edges,
                 global const wide *planes, global const wide *rays, global int *hits_face, global wide *hits_t,
                 volatile global uint *totals,
                 global const float *tree_floats, global const int *tree_ints)
{
    Geometry g = {faces, edges, planes, parameters->face_count};
    Tree tree = {tree_floats, tree_ints};
    Counters counters = {{0}};
    int first = (int)get_global_id(0) * LANES, count = min(LANES, parameters->ray_count - first);
    if (count <= 0)
        return;
    wide v[6][LANES];
    for (int i = 0; i < LANES; i++)
        for (int k = 0; k < 6; k++)
            v[k][i] = rays[6 * (size_t)(first + min(i, count - 1)) + k];
    Ray ray = {wide_vec(LOAD(v[0]), LOAD(v[1]), LOAD(v[2])), wide_vec(LOAD(v[3]), LOAD(v[4]), LOAD(v[5]))};
    Mask active = IS(lane_numbers() < (Mask)count);
    Hit nearest = ANY(active & ~same_origin(&ray)) ? find_nearest_apart(&g, &tree, &ray, active, &counters)
                                                   : find_nearest_of_pencil(&g, &tree, &ray, active, &counters);
    MaskElement face[LANES];
    wide t[LANES];
    STORE(nearest.face, face);
    STORE(nearest.t, t);
    for (int i = 0; i < count; i++) {
        hits_face[first + i] = face[i] < 0 ? -1 : faces[face[i]].index;
        hits_t[first + i] = face[i] < 0 ? 0 : t[i];
    }
    counters.kinds[COUNT_PRIMARY] += count;
    add_counters(totals, &counters);
}
