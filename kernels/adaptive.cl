/* Adaptive sampling: which pixels need more than the ray through their centre (src/adaptive.c says why), and the two kernels
 * that render with it: `render_centres` and `refine`. Built only where adaptive sampling is asked for. */

#if ADAPTIVE

#define TOLERANCE ((real)0x1p-11f)
#define WIDEST ((real)0.25f)

/* What the lanes of a group have in common at one of their hits. */
typedef struct Judge {
    const Geometry *g;
    const Shading *s;
    Beam beam;
    real weight;
    int face;
    BeamPlane plane;
    Counters *counters;
} Judge;

INLINE int trail_face(const Trail *trail, int hit, int lane)
{
    MaskElement faces[LANES];
    STORE(trail->faces[hit], faces);
    return (int)faces[lane];
}

INLINE real largest_of(global const real *a, global const real *b)
{
    real x = a[0] * b[0], y = a[1] * b[1], z = a[2] * b[2];
    return x > y ? (x > z ? x : z) : (y > z ? y : z);
}

/* --- How evenly light changes over a face --- */

INLINE Lanes curved(Lanes square) { return (real)0.35 * square; }

INLINE Lanes power_bound(Lanes x, real power)
{
    Lanes y = power * (1 - x);
    Lanes sum = 1 + y * (1 + y * ((real)0.5 + y * ((real)1 / 6 + y * ((real)1 / 24))));
    return y > (Lanes)0 ? 1 / sum : (Lanes)1;
}

static Lanes power_uneven(Lanes x, real k, Lanes off, Lanes change)
{
    Lanes high = x + change < (Lanes)1 ? x + change : (Lanes)1, low = x - change;
    if (k == 0)
        return (Lanes)0;
    Lanes uneven;
    if (k >= 2)
        uneven = power_bound(high, k - 2) * k * (off + (real)0.2 * (k - 1) * change * change);
    else
        uneven = low > (Lanes)0 ? (2 * off + (real)0.5 * change * change / low) / low : (Lanes)1;
    return high <= (Lanes)0 ? (Lanes)0 : uneven;
}

INLINE Vec vec_point(Point p) { return vec((Lanes)(real)p.x, (Lanes)(real)p.y, (Lanes)(real)p.z); }

INLINE real point_length(Point p) { return (real)sqrt(point_dot(p, p)); }

INLINE real beam_square(const Beam *b) { return (real)(point_dot(b->u, b->u) + point_dot(b->v, b->v)); }

static Lanes unevenness(real diffuse, real specular, real exponent, Vec normal, const Beam *to_light, const Beam *to_viewer)
{
    Lanes l_length = sqrt(vec_dot(to_light->real_c, to_light->real_c));
    Lanes v_length = sqrt(vec_dot(to_viewer->real_c, to_viewer->real_c));
    Lanes l_turn = (point_length(to_light->u) + point_length(to_light->v)) / l_length;
    Lanes v_turn = (point_length(to_viewer->u) + point_length(to_viewer->v)) / v_length;
    Mask follow = IS(l_turn <= (Lanes)WIDEST) & IS(v_turn <= (Lanes)WIDEST);
    Lanes l_square = beam_square(to_light) / (l_length * l_length), v_square = beam_square(to_viewer) / (v_length * v_length);
    Lanes uneven = diffuse * curved(l_square);
    if (specular == 0)
        return follow ? uneven : (Lanes)(diffuse + specular);

    Vec sum = vec_add(vec_scale(1 / l_length, to_light->real_c), vec_scale(1 / v_length, to_viewer->real_c));
    Lanes length = sqrt(vec_dot(sum, sum)), h_turn = (l_turn / (1 - l_turn) + v_turn / (1 - v_turn)) / length;
    Mask follow_h = IS(h_turn <= (Lanes)WIDEST);
    Lanes n_dot_h = -vec_dot(normal, sum) / length, square = 1 - n_dot_h * n_dot_h, angle = (real)1.1 * h_turn / (1 - h_turn);
    Lanes change = sqrt(square > (Lanes)0 ? square : (Lanes)0) * angle + (real)0.5 * angle * angle;
    Lanes off = (real)4 / 3 * (curved(l_square) + curved(v_square)) / length +
                (real)1.25 * (l_square + v_square) / (length * length);
    Lanes highlight = uneven + specular * power_uneven(n_dot_h, exponent, off, change);
    highlight = follow_h ? highlight : uneven + specular;
    return follow ? highlight : (Lanes)(diffuse + specular);
}

/* --- Along the path --- */

/* The lanes to which something else shows than to their centres. */
static Mask judge_hit(Judge *j, int from, Mask active)
{
    BeamQuery q;
    q.beam = j->beam;
    q.from = from;
    q.to = j->face;
    q.near.error = q.far.error = 0;
    q.near.q = q.far.q = point(0, 0, 0);
    if (from >= 0)
        q.near = beam_plane(j->g, &q.beam, from);
    if (q.to >= 0)
        q.far = beam_plane(j->g, &q.beam, q.to);
    j->plane = q.far;
    q.shadow = false;
    q.active = active;
    q.crossed = q.filled = (Mask)0;
    if (q.to >= 0)
        q.active &= beam_cover(j->g, &q.beam, q.to, q.far.side).filled;
    if (q.to >= 0 && from >= 0)
        q.active &= beam_is_farther(&q.beam, &q.near, &q.far);
    if (ANY(q.active))
        walk_beam(j->g, j->s->tree, &q, j->counters);
    return active & ~q.active;
}

static Mask judge_light(const Judge *j, int index, Mask active)
{
    constant const Parameters *p = j->s->parameters;
    global const real *light = j->s->lights + index * LIGHT_REALS;
    global const real *material = j->s->materials + (size_t)j->g->faces[j->face].material * MATERIAL_REALS;
    wide at[3] = {(wide)light[0] + (wide)light[3], (wide)light[1] + (wide)light[4], (wide)light[2] + (wide)light[5]};
    wide distance = plane_distance_of_point(j->g, j->face, at);
    if ((distance > 0 ? j->plane.side : distance < 0 ? -j->plane.side : 0) <= 0)
        return (Mask)0;
    real diffuse = largest_of(material + MATERIAL_DIFFUSE, light + LIGHT_DIFFUSE);
    real specular = largest_of(material + MATERIAL_SPECULAR, light + LIGHT_SPECULAR);
    real most = diffuse + specular;
    if (!p->shadow_ambient)
        most = most + largest_of(material + MATERIAL_AMBIENT, light + LIGHT_AMBIENT);
    if (j->weight * most < TOLERANCE && (p->shadow_ambient || material[MATERIAL_REFLECTION] == 0))
        return (Mask)0;

    BeamQuery q;
    q.beam = beam_from_point(j->g, &j->beam, j->face, point(at[0], at[1], at[2]));
    q.from = -1;
    q.to = j->face;
    q.far = beam_plane(j->g, &q.beam, j->face);
    q.shadow = true;
    q.active = active;
    q.crossed = q.filled = (Mask)0;
    walk_beam(j->g, j->s->tree, &q, j->counters);
    Mask reaches = active & ~q.crossed, mixed = active & q.crossed & ~q.filled;
    if (!ANY(reaches))
        return mixed;
    Beam to_viewer = j->beam;
    if (!p->viewer_ray)
        to_viewer = beam_from_point(j->g, &j->beam, j->face,
                                    point(view_value(j->s, VIEW_EYE), view_value(j->s, VIEW_EYE + 1),
                                          view_value(j->s, VIEW_EYE + 2)));
    Point n = face_normal(j->g, j->face);
    Lanes uneven = unevenness(diffuse, specular, material[MATERIAL_EXPONENT],
                              vec_point(point_scale(j->plane.side, n)), &q.beam, &to_viewer);
    return mixed | (reaches & ~IS(j->weight * uneven < (Lanes)TOLERANCE));
}

/* Judges lanes whose centres took the same path. */
static Mask judge_group(Judge *j, const Trail *trail, int lane, Mask group)
{
    constant const Parameters *p = j->s->parameters;
    Mask refined = (Mask)0;
    real brightest = (real)view_value(j->s, VIEW_BRIGHTEST);
    int from = -1;
    for (int hit = 0; hit < trail->count && ANY(group & ~refined) && j->weight * brightest >= TOLERANCE; hit++) {
        j->face = trail_face(trail, hit, lane);
        if (j->face == TRAIL_ENDED)
            break;
        refined |= judge_hit(j, from, group & ~refined);
        if (j->face < 0)
            break;
        for (int i = 0; i < p->light_count && ANY(group & ~refined); i++)
            refined |= judge_light(j, i, group & ~refined);
        j->weight *= j->s->materials[(size_t)j->g->faces[j->face].material * MATERIAL_REALS + MATERIAL_REFLECTION];
        j->beam = beam_mirrored(j->g, &j->beam, j->face);
        from = j->face;
    }
    return refined;
}

/* The lanes that took the path of that lane. */
INLINE Mask same_trail(const Trail *trail, int lane, Mask active)
{
    for (int hit = 0; hit < trail->count; hit++)
        active &= IS(trail->faces[hit] == (Mask)trail_face(trail, hit, lane));
    return active;
}

/* The beams of a group's pixels, told from the lane's one. */
static Beam beam_of_pixels(const Shading *s, WideVec c, Wide columns, Wide rows, int lane, Mask group)
{
    constant const Parameters *p = s->parameters;
    Beam b;
    wide x[LANES], y[LANES], z[LANES], across[LANES], down[LANES];
    MaskElement in[LANES];
    STORE(c.x, x);
    STORE(c.y, y);
    STORE(c.z, z);
    STORE(columns, across);
    STORE(rows, down);
    STORE(group, in);
    b.c = c;
    b.c0 = point(x[lane], y[lane], z[lane]);
    b.apex = point(view_value(s, VIEW_EYE), view_value(s, VIEW_EYE + 1), view_value(s, VIEW_EYE + 2));
    b.u = point_scale(view_value(s, VIEW_WIDTH) / p->columns / 2,
                      point(view_value(s, VIEW_RIGHT), view_value(s, VIEW_RIGHT + 1), view_value(s, VIEW_RIGHT + 2)));
    b.v = point_scale(view_value(s, VIEW_HEIGHT) / p->rows / 2,
                      point(view_value(s, VIEW_UP), view_value(s, VIEW_UP + 1), view_value(s, VIEW_UP + 2)));
    b.size = point_magnitudes(b.apex);
    b.mirrored = false;
    beam_bounds(&b);
    /* From one pixel's middle to the next it is 2 u, or -2 v. */
    wide low[2] = {0, 0}, high[2] = {0, 0};
    for (int i = 0; i < LANES; i++)
        if (in[i]) {
            wide a[2] = {2 * (across[i] - across[lane]), -2 * (down[i] - down[lane])};
            for (int k = 0; k < 2; k++) {
                low[k] = a[k] < low[k] ? a[k] : low[k];
                high[k] = a[k] > high[k] ? a[k] : high[k];
            }
        }
    for (int k = 0; k < 2; k++) {
        b.middle[k] = (low[k] + high[k]) / 2;
        b.extent[k] = (high[k] - low[k]) / 2 + 1;
    }
    return b;
}

/* The lanes whose pixels need more than their centre, whose ray took the path. */
static Mask judge_pixels(const Geometry *g, const Shading *s, const Trail *trail, WideVec c, Wide columns, Wide rows, Mask active,
                         Counters *counters)
{
    Mask refined = (Mask)0;
    for (Mask rest = active; ANY(rest);) {
        int lane = lowest_bit(mask_bits(rest));
        Mask group = same_trail(trail, lane, rest);
        rest &= ~group;
        Judge j;
        j.g = g;
        j.s = s;
        j.counters = counters;
        j.weight = 1;
        j.beam = beam_of_pixels(s, c, columns, rows, lane, group);
        refined |= judge_group(&j, trail, lane, group);
    }
    return refined;
}

/* --- The kernel --- */

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
    Wide columns[PACKETS], rows[PACKETS];
    Mask inside[PACKETS];
    WideVec directions[PACKETS];
    EACH_PACKET(k) {
        Mask number = lane_numbers();
        columns[k] = MASK_TO_WIDE(first_column + PACKET_COLUMN(k) + number % PACKET_COLUMNS);
        rows[k] = MASK_TO_WIDE(p.first_row + first_row + PACKET_ROW(k) + number / PACKET_COLUMNS);
        rays[k].origin = view_vec(s, VIEW_EYE);
        rays[k].direction = directions[k] = direction_to(s, columns[k], rows[k], (Wide)0, (Wide)0);
        paths[k].active = inside[k] = pixels_inside(&p, first_column, first_row, k);
        trails[k].count = 0;
        counters->kinds[COUNT_PRIMARY] += mask_count(inside[k]);
    }
    trace_paths(g, s, &apex, paths, rays, trails, counters);
    EACH_PACKET(k) {
        int column = first_column + PACKET_COLUMN(k), row = first_row + PACKET_ROW(k);
        store_packet(rgb, &p, column, row, paths[k].total);
        MaskElement refined[LANES];
        STORE(judge_pixels(g, s, trails + k, directions[k], columns[k], rows[k], inside[k], counters), refined);
        for (int i = 0; i < LANES; i++) {
            int c = column + i % PACKET_COLUMNS, r = row + i / PACKET_COLUMNS;
            if (c < p.columns && r < p.band_rows)
                flags[(size_t)r * (size_t)p.columns + (size_t)c] = refined[i] ? 1 : 0;
        }
    }
}

/* Gives a pixel the whole grid: the lanes are its samples. list: the places of the pixels in the band. */
static void refine(const Geometry *g, const Shading *s, global uchar *rgb, global const int *list, Counters *counters)
{
    constant const Parameters *p = s->parameters;
    int item = (int)get_global_id(0);
    if (item >= p->refine_count)
        return;
    int pixel = list[p->refine_first + item], samples = p->grid * p->grid;
    Wide column = (Wide)(wide)(pixel % p->columns), row = (Wide)(wide)(pixel / p->columns + p->first_row);
    Apex apex = apex_at_eye(s);
    real red = 0, green = 0, blue = 0;
    for (int first = 0; first < samples; first += PACKETS * LANES) {
        Path paths[PACKETS];
        Ray rays[PACKETS];
        EACH_PACKET(k) {
            Mask number = lane_numbers() + (first + k * LANES);
            Wide i = MASK_TO_WIDE(number % (Mask)p->grid), j = MASK_TO_WIDE(number / (Mask)p->grid);
            rays[k].origin = view_vec(s, VIEW_EYE);
            rays[k].direction = direction_to(s, column, row, i, j);
            paths[k].active = IS(number < (Mask)samples);
        }
        int count = min(samples - first, PACKETS * LANES);
        counters->kinds[COUNT_PRIMARY] += (uint)count;
        trace_paths(g, s, &apex, paths, rays, 0, counters);
        for (int k = 0; k * LANES < count; k++) {
            real r[LANES], gr[LANES], b[LANES];
            STORE(paths[k].total.x, r);
            STORE(paths[k].total.y, gr);
            STORE(paths[k].total.z, b);
            for (int i = 0; i < min(count - k * LANES, LANES); i++) { /* in the order of `render` */
                red += r[i];
                green += gr[i];
                blue += b[i];
            }
        }
    }
    store_pixel(rgb, pixel, red / samples, green / samples, blue / samples);
}

/* A work-item for each tile of the band; where refine_count says that there are pixels to refine, one for each of them. Both
 * in one kernel, for tracing a path is the most of it, and takes the longest to compile. */
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
