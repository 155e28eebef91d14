/* The kernels: `render` turns a tile of pixels per work-item into bytes, `cast` intersects a list of rays. */

/* TILE_COLUMNS x TILE_ROWS = LANES pixels: the tile that one work-item renders, as the host's build options say.
 * The host says, too, how large it takes the shared structs to be; an array of negative length stops the build. */
typedef char FaceRecordHasTheHostsSize[sizeof(FaceRecord) == FACE_RECORD_BYTES ? 1 : -1];
typedef char ParametersHasTheHostsSize[sizeof(Parameters) == PARAMETERS_BYTES ? 1 : -1];

static wide view_value(const Shading *s, int column) { return (wide)s->view[column] + (wide)s->view[VIEW_REALS + column]; }

static WideVec view_vec(const Shading *s, int column)
{
    return wide_vec((Wide)view_value(s, column), (Wide)view_value(s, column + 1), (Wide)view_value(s, column + 2));
}

/* The direction R = Q - C to sub-pixel (i, j) of each lane's pixel: see view_direction in geometry.c. */
static WideVec view_direction(const Shading *s, Wide column, Wide row, Wide i, Wide j)
{
    constant const Parameters *p = s->parameters;
    Wide sub_column = (i + (wide)0.5) / (wide)p->grid, sub_row = (j + (wide)0.5) / (wide)p->grid;
    Wide x = ((column + sub_column) / (wide)p->columns - (wide)0.5) * view_value(s, VIEW_WIDTH);
    Wide y = ((wide)0.5 - (row + sub_row) / (wide)p->rows) * view_value(s, VIEW_HEIGHT);
    return wide_add(wide_add(view_vec(s, VIEW_FORWARD), wide_scale(x, view_vec(s, VIEW_RIGHT))),
                    wide_scale(y, view_vec(s, VIEW_UP)));
}

/* The faces that each lane's ray met, in order, kept for adaptive sampling: -1 where it left the scene, PATH_ENDED where its
 * path had ended before. */
#define PATH_ENDED -2

#if ADAPTIVE
#define TRACE NOINLINE /* called twice, but compiled once */

typedef struct Path {
    Mask faces[PATH_MAX];
    int count;
} Path;

INLINE void path_add(Path *path, Mask faces, Mask active)
{
    if (path)
        path->faces[path->count++] = active ? faces : (Mask)PATH_ENDED;
}

INLINE int path_face(const Path *path, int hit, int lane)
{
    MaskElement faces[LANES];
    STORE(path->faces[hit], faces);
    return (int)faces[lane];
}
#else
#define TRACE static

typedef int Path;

INLINE void path_add(Path *path, Mask faces, Mask active) {}
#endif

/* The colours of one primary ray per lane: the hits' illuminations, each weighted by the mirrors before it. */
TRACE Vec trace_path(const Geometry *g, const Shading *s, Ray ray, Mask active, Path *path, Counters *counters)
{
    constant const Parameters *p = s->parameters;
    WideVec eye = ray.origin;
    Vec total = vec(0, 0, 0), background = vec_row(s->view + VIEW_BACKGROUND);
    Lanes weight = (Lanes)1;
    Mask left = (Mask)-1;
    for (int bounces = 0;; bounces++) {
        Nearest nearest = find_nearest(g, s->tree, ray, active, left, bounces == 0, counters);
        path_add(path, nearest.face, active);
        Mask missed = active & IS(nearest.face < (Mask)0);
        total = vec_select(missed, vec_add(total, vec_scale(weight, background)), total);
        active &= ~missed;
        if (!ANY(active))
            return total;

        Surface surface = surface_of(g, s, ray, nearest, active);
        Vec ahead = vec_unit(vec_to_real(ray.direction));
        Vec v = p->viewer_ray ? vec(-ahead.x, -ahead.y, -ahead.z) : vec_unit(vec_to_real(wide_sub(eye, surface.point)));
        Mask lit;
        Vec illumination = shade(g, s, &surface, v, active, &lit, counters);
        total = vec_select(active, vec_add(total, vec_scale(weight, illumination)), total);

        if (!p->shadow_ambient)
            active &= lit;
        active &= IS(surface.reflection > (Lanes)0);
        if (bounces == p->max_bounces || !ANY(active))
            return total;
        counters->kinds[COUNT_REFLECTION] += mask_count(active);
        WideVec r = wide_unit(ray.direction);
        ray.direction = wide_sub(r, wide_scale(2 * wide_dot(r, surface.normal), surface.normal));
        ray.origin = surface.shifted;
        weight = weight * surface.reflection;
        left = surface.face;
    }
}

static Mask lane_numbers(void)
{
    MaskElement numbers[LANES];
    for (int i = 0; i < LANES; i++)
        numbers[i] = i;
    return LOAD(numbers);
}

static void add_counters(volatile global uint *totals, const Counters *counters)
{
    volatile global uint *stripe = totals + (get_global_id(0) % COUNTER_STRIPES) * COUNTER_STRIDE;
    for (int kind = 0; kind < COUNTER_KINDS; kind++)
        if (counters->kinds[kind])
            atomic_add(stripe + kind, counters->kinds[kind]);
}

/* floor(255 c + 0.5) of the clamped colours, as in light.c. */
static void colour_to_bytes(Lanes c, int *bytes)
{
    c = c > (Lanes)0 ? c : (Lanes)0;
    c = c < (Lanes)1 ? c : (Lanes)1;
    c = floor((real)255 * c + (real)0.5);
#if LANES == 1
    bytes[0] = (int)c;
#else
    PASTE(vstore, LANES)(PASTE(convert_int, LANES)(c), 0, bytes);
#endif
}

#ifdef LINEAR
/* Puts the first lane's colour at that place of the picture. */
static void store_pixel(global uchar *picture, int place, Vec colour)
{
    global real *out = (global real *)picture + (size_t)place * 3;
    out[0] = first_lane(colour.x);
    out[1] = first_lane(colour.y);
    out[2] = first_lane(colour.z);
}

/* With this build option the picture is three reals a pixel, as they are, instead of three bytes. */
static void store_tile(global uchar *picture, const Parameters *p, int first_column, int first_row, Vec colour)
{
    real red[LANES], green[LANES], blue[LANES];
    STORE(colour.x, red);
    STORE(colour.y, green);
    STORE(colour.z, blue);
    for (int lane = 0; lane < LANES; lane++) {
        int column = first_column + lane % TILE_COLUMNS, row = first_row + lane / TILE_COLUMNS;
        if (column >= p->columns || row >= p->band_rows)
            continue;
        global real *out = (global real *)picture + ((size_t)row * (size_t)p->columns + (size_t)column) * 3;
        out[0] = red[lane];
        out[1] = green[lane];
        out[2] = blue[lane];
    }
}
#else
static void store_pixel(global uchar *rgb, int place, Vec colour)
{
    int red[LANES], green[LANES], blue[LANES];
    colour_to_bytes(colour.x, red);
    colour_to_bytes(colour.y, green);
    colour_to_bytes(colour.z, blue);
    global uchar *out = rgb + (size_t)place * 3;
    out[0] = (uchar)red[0];
    out[1] = (uchar)green[0];
    out[2] = (uchar)blue[0];
}

static void store_tile(global uchar *rgb, const Parameters *p, int first_column, int first_row, Vec colour)
{
    int red[LANES], green[LANES], blue[LANES];
    colour_to_bytes(colour.x, red);
    colour_to_bytes(colour.y, green);
    colour_to_bytes(colour.z, blue);
    int columns = min(TILE_COLUMNS, p->columns - first_column), rows = min(TILE_ROWS, p->band_rows - first_row);
    for (int row = 0; row < rows; row++) {
        global uchar *out = rgb + ((size_t)(first_row + row) * (size_t)p->columns + (size_t)first_column) * 3;
        for (int column = 0; column < columns; column++) {
            int lane = row * TILE_COLUMNS + column;
            out[3 * column] = (uchar)red[lane];
            out[3 * column + 1] = (uchar)green[lane];
            out[3 * column + 2] = (uchar)blue[lane];
        }
    }
}
#endif

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

    Mask number = lane_numbers();
    Mask column = first_column + number % TILE_COLUMNS, row = first_row + number / TILE_COLUMNS;
    Mask active = IS(column < (Mask)p.columns) & IS(row < (Mask)p.band_rows);
    Vec sum = vec(0, 0, 0);
    for (int j = 0; j < p.grid; j++)
        for (int i = 0; i < p.grid; i++) {
            Ray ray = {view_vec(&s, VIEW_EYE),
                       view_direction(&s, MASK_TO_WIDE(column), MASK_TO_WIDE(row + p.first_row), (Wide)i, (Wide)j)};
            counters.kinds[COUNT_PRIMARY] += mask_count(active);
            sum = vec_add(sum, trace_path(&g, &s, ray, active, 0, &counters));
        }
    real samples = (real)p.grid * (real)p.grid;
    store_tile(rgb, &p, first_column, first_row, vec(sum.x / samples, sum.y / samples, sum.z / samples));
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
    Nearest nearest = find_nearest(&g, &tree, ray, IS(lane_numbers() < (Mask)count), (Mask)-1, false, &counters);
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
