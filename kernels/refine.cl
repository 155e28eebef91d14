/* Adaptive sampling renders in two steps: the centres of all pixels, judged by adaptive.cl; then as much of the grid as they need
 * for those pixels that a centre does not tell. Built only where adaptive sampling is asked for. */

#if ADAPTIVE

/* The directions R = Q - C to sub-pixels (i, j) of the pixels at (column, row), lane by lane: see view_direction in geometry.c. */
static WideVec direction_to(const Shading *s, Wide column, Wide row, Wide i, Wide j)
{
    constant const Parameters *p = s->parameters;
    Wide sub_column = (i + (wide)0.5) / (wide)p->grid, sub_row = (j + (wide)0.5) / (wide)p->grid;
    Wide x = ((column + sub_column) / (wide)p->columns - (wide)0.5) * view_value(s, VIEW_WIDTH);
    Wide y = ((wide)0.5 - (row + sub_row) / (wide)p->rows) * view_value(s, VIEW_HEIGHT);
    return wide_add(wide_add(view_vec(s, VIEW_FORWARD), wide_scale(x, view_vec(s, VIEW_RIGHT))),
                    wide_scale(y, view_vec(s, VIEW_UP)));
}

/* The bundle of the active rays, which start at the apex. */
static Bundle bundle_of_rays(const Apex *a, const Path *paths, const Ray *rays)
{
    Pencil pencils[PACKETS];
    EACH_PACKET(k) {
        pencils[k].active = paths[k].active;
        pencils[k].ahead = vec_to_real(rays[k].direction);
    }
    return bundle_from(a, pencils, PACKETS);
}

/* As `render` does with a grid of 1; flags: band_rows * columns bytes, 1 where a pixel needs more. */
static void render_centres(const Geometry *g, const Shading *s, global uchar *rgb, global uchar *flags, Counters *counters)
{
    Parameters p = *s->parameters;
    int tiles_across = (p.columns + TILE_COLUMNS - 1) / TILE_COLUMNS;
    int tile = (int)get_global_id(0);
    int first_column = tile % tiles_across * TILE_COLUMNS, first_row = tile / tiles_across * TILE_ROWS;
    if (first_row >= p.band_rows)
        return;

    Apex apex = apex_at_eye(s);
    Path paths[PACKETS];
    Ray rays[PACKETS];
    Trail trails[PACKETS];
    Tile pixels;
    Mask even[PACKETS];
    EACH_PACKET(k) {
        Mask number = lane_numbers();
        pixels.columns[k] = MASK_TO_WIDE(first_column + PACKET_COLUMN(k) + number % PACKET_COLUMNS);
        pixels.rows[k] = MASK_TO_WIDE(p.first_row + first_row + PACKET_ROW(k) + number / PACKET_COLUMNS);
        rays[k].origin = view_vec(s, VIEW_EYE);
        rays[k].direction = pixels.directions[k] = direction_to(s, pixels.columns[k], pixels.rows[k], (Wide)0, (Wide)0);
        paths[k].active = even[k] = pixels_inside(&p, first_column, first_row, k);
        trails[k].count = 0;
        counters->kinds[COUNT_PRIMARY] += mask_count(even[k]);
    }
    Bundle seen = bundle_of_rays(&apex, paths, rays);
    trace_paths(g, s, &apex, &seen, paths, rays, trails, counters);
    judge_pixels(g, s, trails, &pixels, even, counters);
    EACH_PACKET(k) {
        int column = first_column + PACKET_COLUMN(k), row = first_row + PACKET_ROW(k);
        store_packet(rgb, &p, column, row, paths[k].total);
        MaskElement even_lanes[LANES];
        STORE(even[k], even_lanes);
        for (int i = 0; i < LANES; i++) {
            int c = column + i % PACKET_COLUMNS, r = row + i / PACKET_COLUMNS;
            if (c < p.columns && r < p.band_rows)
                flags[(size_t)r * (size_t)p.columns + (size_t)c] = even_lanes[i] ? 0 : 1;
        }
    }
}

/* --- Refining --- */

/* A refined pixel's samples come in parts, after some of which they may be enough: see adaptive_sample and adaptive_is_enough. */
enum { PARTS_MAX = 4, REFINED_EACH = REFINED_PER_PACKET * PACKETS };
#define QUARTER_SPREAD ((real)1 / 16)
#define HALF_SPREAD ((real)1 / 8)

INLINE int parts_of(int grid) { return grid >= 6 && grid % 2 == 0 ? PARTS_MAX : 1; }

/* The direction to samples of a part of the pixel at (column, row): the lanes are samples `number`. */
static WideVec direction_to_samples(const Shading *s, int column, int row, int part, Mask number)
{
    int grid = s->parameters->grid, last = grid / 2 - 1;
    Mask i = number % (Mask)grid, j = number / (Mask)grid;
    if (parts_of(grid) > 1) {
        Mask a = number % (Mask)(last + 1), b = number / (Mask)(last + 1);
        Mask a_is_last = IS(a == (Mask)last), b_is_last = IS(b == (Mask)last);
        Mask corner = (IS(a == (Mask)0) | a_is_last) & (IS(b == (Mask)0) | b_is_last);
        i = 2 * a + (((corner ? a_is_last : b) ^ (Mask)(part == 1 || part == 2)) & (Mask)1);
        j = 2 * b + (((corner ? b_is_last : a) ^ (Mask)(part == 1 || part == 3)) & (Mask)1);
    }
    return direction_to(s, (Wide)(wide)column, (Wide)(wide)row, MASK_TO_WIDE(i), MASK_TO_WIDE(j));
}

/* What a pixel's samples have brought so far. */
typedef struct Refined {
    int place, column, row; /* in the band; in the picture */
    int samples;
    real sum[3], low[3], high[3];
    bool open; /* it needs more */
} Refined;

/* Adds the first `count` lanes, in their order. */
static void add_samples(Refined *pixel, Vec colour, int count)
{
    real lanes[3][LANES];
    STORE(colour.x, lanes[0]);
    STORE(colour.y, lanes[1]);
    STORE(colour.z, lanes[2]);
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < count; i++) {
            real value = lanes[c][i];
            pixel->sum[c] += value;
            pixel->low[c] = LESSER(pixel->low[c], value);
            pixel->high[c] = GREATER(pixel->high[c], value);
        }
    pixel->samples += count;
}

INLINE bool is_enough(const Refined *pixel, int parts)
{
    real spread = 0;
    for (int c = 0; c < 3; c++)
        spread = GREATER(spread, pixel->high[c] - pixel->low[c]);
    return (parts == 1 && spread < QUARTER_SPREAD) || (parts == 2 && spread < HALF_SPREAD);
}

/* Traces a part of the samples of each open pixel. A packet holds samples of one pixel; the pixels take turns, so that the packets
 * that one does not need are the next one's. */
static void trace_part(const Geometry *g, const Shading *s, const Apex *apex, Refined *pixels, int part, Counters *counters)
{
    int grid = s->parameters->grid, samples = grid * grid / parts_of(grid);
    for (int pixel = 0, next = 0;;) {
        int of[PACKETS], count[PACKETS], used = 0;
        Path paths[PACKETS];
        Ray rays[PACKETS];
        EACH_PACKET(k) {
            while (pixel < REFINED_EACH && !pixels[pixel].open)
                pixel++;
            rays[k].origin = view_vec(s, VIEW_EYE);
            rays[k].direction = view_vec(s, VIEW_FORWARD);
            paths[k].active = (Mask)0;
            if (pixel == REFINED_EACH)
                continue;
            Mask lane = lane_numbers();
            of[k] = pixel;
            count[k] = min(samples - next, LANES);
            rays[k].direction = direction_to_samples(s, pixels[pixel].column, pixels[pixel].row, part, lane + next);
            paths[k].active = IS(lane < (Mask)count[k]);
            counters->kinds[COUNT_PRIMARY] += (uint)count[k];
            used++;
            next += count[k];
            if (next == samples) {
                pixel++;
                next = 0;
            }
        }
        if (used == 0)
            return;
        Bundle seen = bundle_of_rays(apex, paths, rays);
        trace_paths(g, s, apex, &seen, paths, rays, 0, counters);
        for (int k = 0; k < used; k++)
            add_samples(pixels + of[k], paths[k].total, count[k]);
    }
}

/* Gives REFINED_EACH neighbours in the list of pixels as much of the grid as they need. list: places in the band. */
static void refine(const Geometry *g, const Shading *s, global uchar *rgb, global const int *list, Counters *counters)
{
    constant const Parameters *p = s->parameters;
    int first = (int)get_global_id(0) * REFINED_EACH;
    if (first >= p->refine_count)
        return;
    Apex apex = apex_at_eye(s);
    Refined pixels[REFINED_EACH];
    EACH_OF(k, REFINED_EACH) {
        Refined *pixel = pixels + k;
        pixel->open = first + k < p->refine_count;
        pixel->place = list[p->refine_first + min(first + k, p->refine_count - 1)];
        pixel->column = pixel->place % p->columns;
        pixel->row = pixel->place / p->columns + p->first_row;
        pixel->samples = 0;
        for (int c = 0; c < 3; c++) {
            pixel->sum[c] = 0;
            pixel->low[c] = REACH_ALL;
            pixel->high[c] = -REACH_ALL;
        }
    }
    for (int part = 0; part < parts_of(p->grid); part++) {
        trace_part(g, s, &apex, pixels, part, counters);
        EACH_OF(k, REFINED_EACH)
            pixels[k].open &= !is_enough(pixels + k, part + 1);
    }
    EACH_OF(k, REFINED_EACH) {
        Refined *pixel = pixels + k;
        real samples = pixel->samples;
        if (first + k < p->refine_count)
            store_pixel(rgb, pixel->place, pixel->sum[0] / samples, pixel->sum[1] / samples, pixel->sum[2] / samples);
    }
}

/* A work-item for each tile of the band; where refine_count says that there are pixels to refine, one for
 * REFINED_EACH of them. Both in one kernel, for tracing a path is the most of it, and takes the longest to compile. */
kernel void render_adaptive(constant Parameters *parameters, global const FaceRecord *faces, global const real *edges,
                            global const wide *planes, global const real *materials, global const real *lights,
                            global const real *view, global uchar *rgb, volatile global uint *totals,
                            global const float *tree_floats, global const int *tree_ints, global uchar *flags,
                            global const int *list)
{
    Geometry g = {faces, edges, planes, parameters->face_count};
    Tree tree = {tree_floats, tree_ints};
    Shading s = {materials, lights, view, parameters, &tree};
    Counters counters = {{0}};
    if (parameters->refine_count > 0)
        refine(&g, &s, rgb, list, &counters);
    else
        render_centres(&g, &s, rgb, flags, &counters);
    add_counters(totals, &counters);
}

#endif
