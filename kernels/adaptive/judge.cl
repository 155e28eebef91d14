/* Judges a group of pixels: will the ray through a pixel's centre do for it? As src/trace/adaptive.c, for many pixels
 * at once.
 *
 *     for each hit of the centre's path
 *         the face fills the beam, and no other face is before it;                         otherwise refine
 *         for each light: nothing is between it and the patch, or one face before it all;  otherwise refine
 *                         it shines evenly on the patch;                                   otherwise refine
 *         go on with the beam's image in the mirror, until the weight is too small */
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
#include "adaptive/beam_face.cl"
#include "adaptive/beam_query.cl"
#include "adaptive/beam_tree.cl"
#include "adaptive/linear.cl"
#include "adaptive/point.cl"
#include "adaptive/unevenness.cl"

#define TOLERANCE ((real)0x1p-11f)

/* What the lanes of a group have in common at one of their hits. */
typedef struct Judge {
    const World *world;
    Beam beam;       /* from the eye, or its image in the mirrors so far */
    real weight;     /* of the hit */
    int face;        /* the face that is hit */
    BeamPlane plane; /* its plane */
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

/* Keeps those lanes of the group that see nothing else in their pixel than in its centre. */
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
    bool is_mirrored = q.to >= 0 && from >= 0,
         is_beyond = is_mirrored && farther_plane(q.beam, &q.near, &q.far, &beyond);
    EACH_PACKET(k) {
        q.active[k] = is_mirrored && !is_beyond ? (Mask)0 : group[k];
        q.crossed[k] = q.filled[k] = (Mask)0;
        if (q.to >= 0)
            q.active[k] &= beam_cover(j->world, q.beam, k, &face, (Mask)0).filled;
        if (is_beyond)
            q.active[k] &= is_negative(q.beam->lanes + k, &beyond);
    }
    count_active(&q);
    if (q.active_count)
        traverse_beam(j->world, &q);
    EACH_PACKET(k)
        group[k] = q.active[k];
}

/* Keeps those lanes of the group that the light reaches evenly, or not at all. */
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
    count_active(&q);
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

/* Keeps those lanes of the group whose centre will do for the pixel. The centres of all took the path of that lane. */
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
