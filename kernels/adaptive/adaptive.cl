/* Adaptive sampling: which pixels need more than the ray through their centre; src/trace/adaptive.c says why. Built
 * only where adaptive sampling is asked for. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/camera.cl"
#include "packet/faces.cl"
#include "packet/lanes.cl"
#include "packet/planes.cl"
#include "packet/trace.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"
#include "adaptive/beam.cl"
#include "adaptive/beam_query.cl"
#include "adaptive/beam_tree.cl"

#define TOLERANCE ((real)0x1p-11f)
#define WIDEST ((real)0.25f)

/* What the lanes of a group have in common at one of their hits. */
typedef struct Judge {
    const World *world;
    Beam beam;
    real weight;
    int face;
    BeamPlane plane;
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

static Lanes unevenness(real diffuse, real specular, real exponent, Vec normal, const Beam *to_light,
                        const Beam *to_viewer, int packet)
{
    Vec l = to_light->lanes[packet].real_c, v = to_viewer->lanes[packet].real_c;
    Lanes l_length = sqrt(vec_dot(l, l)), v_length = sqrt(vec_dot(v, v));
    Lanes l_turn = (point_length(to_light->u) + point_length(to_light->v)) / l_length;
    Lanes v_turn = (point_length(to_viewer->u) + point_length(to_viewer->v)) / v_length;
    Mask follow = IS(l_turn <= (Lanes)WIDEST) & IS(v_turn <= (Lanes)WIDEST);
    Lanes l_square = beam_square(to_light) / (l_length * l_length),
          v_square = beam_square(to_viewer) / (v_length * v_length);
    Lanes uneven = diffuse * curved(l_square);
    if (specular == 0)
        return follow ? uneven : (Lanes)(diffuse + specular);

    Vec sum = vec_add(vec_scale(1 / l_length, l), vec_scale(1 / v_length, v));
    Lanes length = sqrt(vec_dot(sum, sum)), h_turn = (l_turn / (1 - l_turn) + v_turn / (1 - v_turn)) / length;
    Mask follow_h = IS(h_turn <= (Lanes)WIDEST);
    Lanes n_dot_h = -vec_dot(normal, sum) / length, square = 1 - n_dot_h * n_dot_h,
          angle = (real)1.1 * h_turn / (1 - h_turn);
    Lanes change = sqrt(square > (Lanes)0 ? square : (Lanes)0) * angle + (real)0.5 * angle * angle;
    Lanes off = (real)4 / 3 * (curved(l_square) + curved(v_square)) / length +
                (real)1.25 * (l_square + v_square) / (length * length);
    Lanes highlight = uneven + specular * power_uneven(n_dot_h, exponent, off, change);
    highlight = follow_h ? highlight : uneven + specular;
    return follow ? highlight : (Lanes)(diffuse + specular);
}

/* --- Along the path --- */

/* Leaves in the group those lanes to which nothing else shows than to their centres. */
static void judge_hit(Judge *j, int from, Mask *group)
{
    BeamQuery q;
    q.beam = &j->beam;
    q.from = from;
    q.to = j->face;
    q.near.error = q.far.error = 0;
    q.near.q = q.far.q = point(0, 0, 0);
    if (from >= 0)
        q.near = beam_plane(j->world, q.beam, from);
    if (q.to >= 0)
        q.far = beam_plane(j->world, q.beam, q.to);
    j->plane = q.far;
    q.shadow = false;
    BeamFace face;
    if (q.to >= 0)
        beam_edges(j->world, q.beam, q.to, q.far.side, &face);
    Linear beyond;
    bool asks_beyond = q.to >= 0 && from >= 0,
         is_beyond = asks_beyond && farther_plane(q.beam, &q.near, &q.far, &beyond);
    EACH_PACKET(k) {
        q.active[k] = asks_beyond && !is_beyond ? (Mask)0 : group[k];
        q.crossed[k] = q.filled[k] = (Mask)0;
        if (q.to >= 0)
            q.active[k] &= beam_cover(j->world, q.beam, k, &face, (Mask)0).filled;
        if (is_beyond)
            q.active[k] &= is_negative(q.beam->lanes + k, &beyond);
    }
    count_asking(&q);
    if (q.asking)
        traverse_beam(j->world, &q);
    EACH_PACKET(k)
        group[k] = q.active[k];
}

/* Leaves in the group those lanes that the light reaches evenly or not at all. */
static void judge_light(const Judge *j, int index, Mask *group)
{
    constant const Parameters *p = j->world->parameters;
    global const real *light = j->world->lights + index * LIGHT_REALS;
    global const real *material = j->world->materials + (size_t)face_material(j->world, j->face) * MATERIAL_REALS;
    wide at[3] = {(wide)light[0] + (wide)light[3], (wide)light[1] + (wide)light[4], (wide)light[2] + (wide)light[5]};
    wide distance = plane_distance_of_point(j->world, j->face, at);
    if ((distance > 0 ? j->plane.side : distance < 0 ? -j->plane.side : 0) <= 0)
        return;
    real diffuse = largest_of(material + MATERIAL_DIFFUSE, light + LIGHT_DIFFUSE);
    real specular = largest_of(material + MATERIAL_SPECULAR, light + LIGHT_SPECULAR);
    real most = diffuse + specular;
    if (!p->shadow_ambient)
        most = most + largest_of(material + MATERIAL_AMBIENT, light + LIGHT_AMBIENT);
    if (j->weight * most < TOLERANCE && (p->shadow_ambient || material[MATERIAL_REFLECTION] == 0))
        return;

    Beam to_light, to_eye;
    BeamQuery q;
    beam_from_point(j->world, &j->beam, j->face, point(at[0], at[1], at[2]), &to_light);
    q.beam = &to_light;
    q.from = -1;
    q.to = j->face;
    q.far = beam_plane(j->world, q.beam, j->face);
    q.shadow = true;
    EACH_PACKET(k) {
        q.active[k] = group[k];
        q.crossed[k] = q.filled[k] = (Mask)0;
    }
    count_asking(&q);
    traverse_beam(j->world, &q);
    Mask reached[PACKETS];
    EACH_PACKET(k) {
        reached[k] = group[k] & ~q.crossed[k];
        group[k] &= ~q.crossed[k] | q.filled[k];
    }
    if (!any_packet(reached))
        return;
    if (!p->viewer_ray)
        beam_from_point(j->world, &j->beam, j->face,
                        point(view_value(j->world, VIEW_EYE), view_value(j->world, VIEW_EYE + 1),
                              view_value(j->world, VIEW_EYE + 2)),
                        &to_eye);
    Vec normal = vec_point(point_scale(j->plane.side, face_normal(j->world, j->face)));
    EACH_PACKET(k) {
        if (!ANY(reached[k]))
            continue;
        Lanes uneven = unevenness(diffuse, specular, material[MATERIAL_EXPONENT], normal, q.beam,
                                  p->viewer_ray ? &j->beam : &to_eye, k);
        group[k] &= ~reached[k] | IS(j->weight * uneven < (Lanes)TOLERANCE);
    }
}

/* Leaves in the group, whose centres took the path of a lane, those lanes for which the centre will do. */
static void judge_group(Judge *j, const Trail *trail, int lane, Mask *group)
{
    constant const Parameters *p = j->world->parameters;
    real brightest = (real)view_value(j->world, VIEW_BRIGHTEST);
    int from = -1;
    for (int hit = 0; hit < trail->count && any_packet(group) && j->weight * brightest >= TOLERANCE; hit++) {
        j->face = trail_face(trail, hit, lane);
        if (j->face == TRAIL_ENDED)
            break;
        judge_hit(j, from, group);
        if (j->face < 0)
            break;
        for (int i = 0; i < p->light_count && any_packet(group); i++)
            judge_light(j, i, group);
        j->weight *=
            j->world->materials[(size_t)face_material(j->world, j->face) * MATERIAL_REALS + MATERIAL_REFLECTION];
        beam_mirror(j->world, &j->beam, j->face);
        from = j->face;
    }
}

/* The lanes whose trail is that of one lane of `first`. */
INLINE Mask same_trail(const Trail *trail, const Trail *first, int lane, Mask active)
{
    for (int hit = 0; hit < trail->count; hit++)
        active &= IS(trail->faces[hit] == (Mask)trail_face(first, hit, lane));
    return active;
}

/* A tile's pixels, packet by packet: the directions to their middles, and where they are. */
typedef struct Tile {
    WideVec directions[PACKETS];
    Wide columns[PACKETS], rows[PACKETS];
} Tile;

/* The beams of a group's pixels, told from that of a lane of a packet. */
static void beam_of_pixels(const World *world, const Tile *tile, int packet, int lane, const Mask *group, Beam *b)
{
    constant const Parameters *p = world->parameters;
    WideVec c = tile->directions[packet];
    b->c0 = point(wide_at(c.x, lane), wide_at(c.y, lane), wide_at(c.z, lane));
    b->apex = point(view_value(world, VIEW_EYE), view_value(world, VIEW_EYE + 1), view_value(world, VIEW_EYE + 2));
    b->u = point_scale(
        view_value(world, VIEW_WIDTH) / p->columns / 2,
        point(view_value(world, VIEW_RIGHT), view_value(world, VIEW_RIGHT + 1), view_value(world, VIEW_RIGHT + 2)));
    b->v =
        point_scale(view_value(world, VIEW_HEIGHT) / p->rows / 2,
                    point(view_value(world, VIEW_UP), view_value(world, VIEW_UP + 1), view_value(world, VIEW_UP + 2)));
    b->size = point_magnitudes(b->apex);
    b->mirrored = false;
    /* From one pixel's middle to the next it is 2 u, or -2 v. */
    wide column = wide_at(tile->columns[packet], lane), row = wide_at(tile->rows[packet], lane);
    wide low[2] = {0, 0}, high[2] = {0, 0};
    EACH_PACKET(k) {
        b->lanes[k].c = tile->directions[k];
        wide across[LANES], down[LANES];
        STORE(2 * (tile->columns[k] - column), across);
        STORE(-2 * (tile->rows[k] - row), down);
        for (uint in = mask_bits(group[k]); in; in &= in - 1) {
            wide a[2] = {across[lowest_bit(in)], down[lowest_bit(in)]};
            for (int i = 0; i < 2; i++) {
                low[i] = a[i] < low[i] ? a[i] : low[i];
                high[i] = a[i] > high[i] ? a[i] : high[i];
            }
        }
    }
    for (int i = 0; i < 2; i++) {
        b->middle[i] = (low[i] + high[i]) / 2;
        b->extent[i] = (high[i] - low[i]) / 2 + 1;
    }
    beam_bounds(b);
}

/* Leaves in `active` the lanes for whose pixels the centre will do. */
static void judge_pixels(const World *world, const Trail *trails, const Tile *tile, Mask *active)
{
    Mask rest[PACKETS];
    EACH_PACKET(k) {
        rest[k] = active[k];
        active[k] = (Mask)0;
    }
    for (int first = 0; first < PACKETS; first++)
        while (ANY(rest[first])) {
            int lane = lowest_bit(mask_bits(rest[first]));
            Mask group[PACKETS];
            EACH_PACKET(k) {
                group[k] = same_trail(trails + k, trails + first, lane, rest[k]);
                rest[k] &= ~group[k];
            }
            Judge j;
            j.world = world;
            j.weight = 1;
            beam_of_pixels(world, tile, first, lane, group, &j.beam);
            judge_group(&j, trails + first, lane, group);
            EACH_PACKET(k)
                active[k] |= group[k];
        }
}
