/* Shading: the surface that each ray has hit, and the colour that the lights give it.
 *
 *     for each light
 *         for each packet: which lanes face the light; their shadow rays, from the light to the points
 *         find the blocked ones, for all packets together
 *         for each packet: add the light's terms, all of them or the ambient one alone
 *
 * The lanes of a packet mostly meet one face of one material: what belongs to a face is fetched once per face and
 * blended into its lanes. A packet that meets one face blends nothing, and one unit vector per light serves both the
 * shadow ray and the shading: cornell took 108, then 92, then 86 ms. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "shared/skips.h"
#include "packet/apex.cl"
#include "packet/approx.cl"
#include "packet/faces.cl"
#include "packet/intersect.cl"
#include "packet/lanes.cl"
#include "packet/light.cl"
#include "packet/paths.cl"
#include "packet/planes.cl"
#include "packet/points.cl"
#include "packet/shadow.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"

/* What a packet's rays have hit. */
typedef struct Surface {
    Vec normal;    /* on the side that the ray came from */
    Vec to_viewer; /* unit vectors */
    ApproxPoint approx;
    Lanes reflection;
    Mask face, material, from_behind;
    int only;          /* the face of all active lanes; -1: they have several */
    int only_material; /* the same of materials */
} Surface;

/* Fills in all but to_viewer. ahead: the rays' directions. apex: of all rays; NULL: each lane has its own of
 * `apexes`. */
INLINE void find_surface(const World *world, const Nearest *nearest, Mask active, Vec ahead, const wide *apex,
                         const WideVec *apexes, Surface *surface)
{
    Mask faces = nearest->face;
    surface->face = faces;
    surface->from_behind = nearest->from_behind;
    surface->only = first_of(faces, active);
    surface->only_material = face_material(world, surface->only);
    Lanes height = (Lanes)0, off = (Lanes)0, apart = (Lanes)0;
    if (HAS_APPROX)
        apart = apex ? (Lanes)(real)magnitudes_of(apex) : TO_REAL(wide_magnitudes(*apexes));
    bool first = true;
    for (Mask rest = active; ANY(rest); first = false) {
        int face = first ? surface->only : first_of(faces, rest), material = face_material(world, face);
        Mask here = rest & IS(faces == (Mask)face);
        rest &= ~here;
        global const wide *plane = world->planes + (size_t)face * PLANE_REALS;
        Vec normal = vec((Lanes)(real)plane[0], (Lanes)(real)plane[1], (Lanes)(real)plane[2]);
        Lanes reflection = (Lanes)world->materials[(size_t)material * MATERIAL_REALS + MATERIAL_REFLECTION];
        Lanes its_height = (Lanes)0, its_off = (Lanes)0;
        if (HAS_APPROX) {
            its_height = apex ? (Lanes)approx_height(world, face, apex) : approx_heights(world, face, *apexes);
            its_off = APPROX_OFF(apart + vertex_magnitudes(world, face));
        }
        if (first) { /* mostly there is one face: nothing to blend */
            surface->normal = normal;
            surface->reflection = reflection;
            surface->material = (Mask)material;
            height = its_height;
            off = its_off;
            continue;
        }
        surface->normal = vec_select(here, normal, surface->normal);
        surface->reflection = here ? reflection : surface->reflection;
        surface->material = here ? (Mask)material : surface->material;
        height = here ? its_height : height;
        off = here ? its_off : off;
        surface->only = -1;
        if (material != surface->only_material)
            surface->only_material = -1;
    }
    if (HAS_APPROX)
        surface->approx = approx_point(ahead, height, off, surface->normal);
    surface->normal = vec_select(surface->from_behind, vec_minus(surface->normal), surface->normal);
}

/* The unit vectors to the viewer: back along the ray, or from the point to the eye. eye_from_apex: as from_apexes. */
INLINE Vec find_viewer(const World *world, const wide *eye, const Surface *surface, Vec ahead, bool from_eye,
                       Vec eye_from_apex, LazyPoints *points, int p)
{
    const ApproxPoint *approx = &surface->approx;
    bool along_ray = world->parameters->viewer_ray || (from_eye && HAS_APPROX);
    Vec unit;
    Lanes per_length, share;
    if (HAS_APPROX && along_ray)
        return vec_scale(-1 / approx->length, ahead);
    if (HAS_APPROX && approx_towards(approx, eye_from_apex, points->active[p], &unit, &per_length, &share))
        return unit;
    need_points(points, p, points->active[p]);
    WideVec d = points->rays[p].direction, at = wide_of(eye);
    return vec_unit(vec_to_real(along_ray ? wide_minus(d) : wide_sub(at, points->point[p])));
}

/* On which side of a face a light is. It is kept, since neighbouring packets mostly hit the same face. */
typedef struct LightSide {
    int face; /* -1: none yet */
    wide distance;
} LightSide;

INLINE Mask turned_to_light(const World *world, const Surface *surface, int face, const wide *light, LightSide *side)
{
    if (face != side->face) {
        side->face = face;
        side->distance = plane_distance_of_point(world, face, light);
    }
    return side->distance > 0 ? ~surface->from_behind : side->distance < 0 ? surface->from_behind : (Mask)0;
}

/* The lanes whose surface faces the light: N.L > 0, decided per face by the side of its plane that the light is on. */
static Mask faces_light(const World *world, const Surface *surface, const wide *light, Mask active, LightSide *side)
{
    if (surface->only >= 0)
        return active & turned_to_light(world, surface, surface->only, light, side);
    Mask facing = (Mask)0;
    for (Mask rest = active; ANY(rest);) {
        int face;
        Mask here = take_same(surface->face, &rest, &face);
        facing |= here & turned_to_light(world, surface, face, light, side);
    }
    return facing;
}

/* The lanes that want a shadow ray to the light, and counts those that are skipped. facing: the lanes that face the
 * light; none is left where the light does not matter. */
INLINE Mask shadow_rays_wanted(const World *world, global const real *light, Mask active, Mask *facing)
{
    uint *skipped = world->counters + COUNT_SKIPPED;
    bool matters = wants_light(world, light);
    Mask wanted = *facing;
    if (!matters)
        skipped[SKIP_LIGHT_AMBIENT] += mask_count(*facing);
    if (MAY_SKIP(world->parameters, SKIP_LIGHT_BEHIND))
        skipped[SKIP_LIGHT_BEHIND] += mask_count(active & ~*facing);
    else
        wanted = active;
    if (!matters)
        wanted = *facing = (Mask)0;
    world->counters[COUNT_SHADOW] += mask_count(wanted);
    return wanted;
}

/* The shadow rays of packet p, from the light to its points: approximate points, or the exact ones where those are too
 * rough. */
INLINE void aim_shadow_rays(OriginPacket *packet, const wide *light, const ApproxPoint *approx, Vec light_from_apex,
                            LazyPoints *points, int p)
{
    Vec unit;
    Lanes share;
    if (HAS_APPROX && approx_towards(approx, light_from_apex, points->active[p], &unit, &packet->per_end, &share)) {
        packet->ahead = vec_minus(unit);
        packet->slack = SLACK_OF(share);
        return;
    }
    aim_from_light(packet, light, *shifted_point(points, p, points->active[p]));
}

/* The unit vectors to the light. They are those of the shadow rays, turned round: to a float, the shift of a point is
 * nothing. */
INLINE Vec find_light(const OriginPacket *packet, const wide *light, const LazyPoints *points, int p)
{
    if (REAL_DOUBLE)
        return vec_unit(vec_to_real(wide_sub(wide_of(light), points->point[p])));
    return vec_minus(packet->ahead);
}

/* What a light adds. counted: the lanes that get its ambient term; reaches: those that get its other terms, too. */
INLINE Vec illuminate(const World *world, const Surface *surface, global const real *light, Vec to_light,
                      Mask counted, Mask reaches)
{
    Vec colour = vec(0, 0, 0);
    for (Mask rest = counted; ANY(rest);) {
        int number = surface->only_material >= 0 ? surface->only_material : first_of(surface->material, rest);
        Mask here = rest & IS(surface->material == (Mask)number), lit = here & reaches;
        rest &= ~here;
        LightTerms terms = light_terms(world, world->materials + (size_t)number * MATERIAL_REALS, light);
        Vec sum = shine_in_shadow(&terms);
        if (ANY(lit)) {
            sum = vec_select(lit, shine(&terms, to_light, surface->to_viewer, surface->normal), sum);
            if (!terms.has_highlight)
                world->counters[COUNT_SKIPPED + SKIP_HIGHLIGHT] += mask_count(lit);
        }
        colour = vec_select(here, sum, colour);
    }
    return colour;
}

/* The illumination of the active lanes of `points` by all lights. apex: as find_surface. near_ties: the lanes whose
 * points rounding may have put into a closed box. */
COMPILED_ONCE void shade(const World *world, const Surface *surfaces, const wide *apex, const Path *paths,
                         LazyPoints *points, const Mask *near_ties, Illumination *sums)
{
    const Mask *active = points->active;
    EACH_PACKET(p) {
        sums[p].colour = vec(0, 0, 0);
        sums[p].lit = (Mask)0;
    }
    for (int i = 0; i < world->parameters->light_count; i++) {
        global const real *light = world->lights + i * LIGHT_REALS;
        wide position[3];
        light_position(light, position);
        LightSide side = {-1, 0};
        OriginPacket packets[PACKETS];
        Mask facing[PACKETS], wanted[PACKETS], blocked[PACKETS];
        EACH_PACKET(p) {
            facing[p] = wanted[p] = (Mask)0;
            packets[p] = no_origin_packet();
            if (!ANY(active[p]))
                continue;
            facing[p] = faces_light(world, surfaces + p, position, active[p], &side);
            wanted[p] = shadow_rays_wanted(world, light, active[p], facing + p);
            packets[p].from = surfaces[p].face;
            Vec from_apex = from_apexes(position, apex, &paths[p].apex);
            aim_shadow_rays(packets + p, position, &surfaces[p].approx, from_apex, points, p);
        }
        ShadowGroup group = {position, packets, points, blocked};
        find_blocked(world, &group, wanted, near_ties, 0);
        EACH_PACKET(p) {
            Mask reaches = facing[p] & ~blocked[p];
            sums[p].lit |= reaches;
            Mask counted = world->parameters->shadow_ambient ? active[p] : reaches;
            if (!ANY(counted))
                continue;
            Vec to_light = find_light(packets + p, position, points, p);
            Vec sum = illuminate(world, surfaces + p, light, to_light, counted, reaches);
            sums[p].colour = vec_add(sums[p].colour, sum);
        }
    }
}
