/* The kernels: `render` turns a tile of pixels per work-item into bytes, `cast` intersects a list of rays. */

/* TILE_COLUMNS x TILE_ROWS = LANES pixels: the tile that one work-item renders, as the host's build options say.
 * The host says, too, how large it takes the shared structs to be; an array of negative length stops the build. */
typedef char FaceRecordHasTheHostsSize[sizeof(FaceRecord) == FACE_RECORD_BYTES ? 1 : -1];
typedef char ParametersHasTheHostsSize[sizeof(Parameters) == PARAMETERS_BYTES ? 1 : -1];

/* The direction R = Q - C to sub-pixel (i, j) of each lane's pixel: see view_direction in geometry.c. */
static Vec view_direction(const Shading *s, Lanes column, Lanes row, int i, int j)
{
    constant const Parameters *p = s->parameters;
    real sub_column = (i + (real)0.5) / p->grid, sub_row = (j + (real)0.5) / p->grid;
    Lanes x = ((column + sub_column) / (real)p->columns - (real)0.5) * s->view[VIEW_WIDTH];
    Lanes y = ((real)0.5 - (row + sub_row) / (real)p->rows) * s->view[VIEW_HEIGHT];
    return vec_add(vec_add(vec_row(s->view + VIEW_FORWARD), vec_scale(x, vec_row(s->view + VIEW_RIGHT))),
                   vec_scale(y, vec_row(s->view + VIEW_UP)));
}

/* The colours of one primary ray per lane: the hits' illuminations, each weighted by the mirrors before it. */
static Vec trace_path(const Geometry *g, const Shading *s, Vec origin, Vec direction, Mask active, Counters *counters)
{
    constant const Parameters *p = s->parameters;
    Vec total = vec(0, 0, 0), background = vec_row(s->view + VIEW_BACKGROUND);
    Lanes weight = (Lanes)1;
    Mask left = (Mask)-1;
    for (int bounces = 0;; bounces++) {
        Nearest nearest = find_nearest(g, s->tree, origin, direction, active, left, bounces == 0, counters);
        Mask missed = active & IS(nearest.face < (Mask)0);
        total = vec_select(missed, vec_add(total, vec_scale(weight, background)), total);
        active &= ~missed;
        if (!ANY(active))
            return total;

        Surface surface = surface_of(g, s, origin, direction, nearest, active);
        Vec r = vec_unit(direction);
        Vec v = p->viewer_ray ? vec(-r.x, -r.y, -r.z) : vec_unit(vec_sub(vec_row(s->view + VIEW_EYE), surface.point));
        Mask lit;
        Vec illumination = shade(g, s, &surface, v, active, &lit, counters);
        total = vec_select(active, vec_add(total, vec_scale(weight, illumination)), total);

        if (!p->shadow_ambient)
            active &= lit;
        active &= IS(surface.reflection > (Lanes)0);
        if (bounces == p->max_bounces || !ANY(active))
            return total;
        counters->kinds[COUNT_REFLECTION] += mask_count(active);
        direction = vec_sub(r, vec_scale(2 * vec_dot(r, surface.normal), surface.normal));
        origin = surface.shifted;
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

/* rgb: band_rows * columns * 3 bytes. One work-item per tile, tiles row by row; surplus work-items do nothing. */
kernel void render(constant Parameters *parameters, global const FaceRecord *faces, global const real *edges,
                   global const wide *planes, global const real *materials, global const real *lights,
                   global const real *view, global uchar *rgb, volatile global uint *totals, global const float *boxes, global const int *children)
{
    Parameters p = *parameters;
    Geometry g = {faces, edges, planes, p.face_count};
    Tree tree = {boxes, children};
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
            Vec direction = view_direction(&s, TO_LANES(column), TO_LANES(row + p.first_row), i, j);
            counters.kinds[COUNT_PRIMARY] += mask_count(active);
            sum = vec_add(sum, trace_path(&g, &s, vec_row(view + VIEW_EYE), direction, active, &counters));
        }
    real samples = (real)p.grid * (real)p.grid;
    store_tile(rgb, &p, first_column, first_row, vec(sum.x / samples, sum.y / samples, sum.z / samples));
    add_counters(totals, &counters);
}

/* rays: ray_count x (origin, direction); hits_face, hits_t: one per ray, -1 and 0 for a miss. LANES rays per work-item. */
kernel void cast(constant Parameters *parameters, global const FaceRecord *faces, global const real *edges,
                 global const wide *planes, global const real *rays, global int *hits_face, global wide *hits_t,
                 volatile global uint *totals, global const float *boxes, global const int *children)
{
    Geometry g = {faces, edges, planes, parameters->face_count};
    Tree tree = {boxes, children};
    Counters counters = {{0}};
    int first = (int)get_global_id(0) * LANES, count = min(LANES, parameters->ray_count - first);
    if (count <= 0)
        return;
    real ray[6][LANES];
    for (int i = 0; i < LANES; i++)
        for (int k = 0; k < 6; k++)
            ray[k][i] = rays[6 * (size_t)(first + min(i, count - 1)) + k];
    Nearest nearest = find_nearest(&g, &tree, vec(LOAD(ray[0]), LOAD(ray[1]), LOAD(ray[2])),
                                   vec(LOAD(ray[3]), LOAD(ray[4]), LOAD(ray[5])), IS(lane_numbers() < (Mask)count),
                                   (Mask)-1, false, &counters);
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
