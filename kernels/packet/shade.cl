/* What a hit looks like: the point, its lights, its colour. The lanes of a packet mostly meet few faces, so
 * what belongs to a face is fetched once per face and blended into its lanes. */
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

typedef struct Surface {
    Vec normal; /* on the ray's side */
    Lanes reflection;
    Mask face, material, with_normal;
    int only;          /* the face of all active lanes; -1: they have several */
    int only_material; /* the same of materials */
} Surface;

/* What the rays' nearest faces are made of, and the sketch of their points. apex: of all rays, or NULL: then of each. */
INLINE void find_surface(const World *world, const Nearest *nearest, Mask active, Vec ahead, const wide *apex,
                         const WideVec *apexes, Surface *surface, ApproxPoint *approx)
{
    Mask faces = nearest->face;
    surface->face = faces;
    surface->with_normal = nearest->with_normal;
    surface->only = first_of(faces, active);
    surface->only_material = face_material(world, surface->only);
    Lanes height = (Lanes)0, off = (Lanes)0, apart = (Lanes)0;
    if (HAS_APPROX)
        apart = apex ? (Lanes)(real)(fabs(apex[0]) + fabs(apex[1]) + fabs(apex[2])) : TO_REAL(wide_magnitudes(*apexes));
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
        if (first) { /* mostly there is one face */
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
        *approx = approx_point(ahead, height, off, surface->normal);
    Vec n = surface->normal;
    surface->normal = vec_select(surface->with_normal, vec(-n.x, -n.y, -n.z), n);
}

/* On which side of the face that was asked last a light is: neighbours mostly ask for the same face. */
typedef struct LightSide {
    int face;
    wide distance;
} LightSide;

INLINE Mask turned_to_light(const World *world, const Surface *surface, int face, const wide *light, LightSide *side)
{
    if (face != side->face) {
        side->face = face;
        side->distance = plane_distance_of_point(world, face, light);
    }
    return side->distance > 0 ? ~surface->with_normal : side->distance < 0 ? surface->with_normal : (Mask)0;
}

/* The lanes whose surface faces the light: N.L > 0, decided per face by the side of its plane that the light is on. */
static Mask faces_light(const World *world, const Surface *surface, const wide *light, Mask active, LightSide *side)
{
    if (surface->only >= 0)
        return active & turned_to_light(world, surface, surface->only, light, side);
    Mask facing = (Mask)0;
    for (Mask rest = active; ANY(rest);) {
        int face = first_of(surface->face, rest);
        Mask here = rest & IS(surface->face == (Mask)face);
        rest &= ~here;
        facing |= here & turned_to_light(world, surface, face, light, side);
    }
    return facing;
}

/* Ambient everywhere, the other two where the light reaches. The lanes of a packet mostly have one material. */
INLINE Vec illuminate(const World *world, const Surface *surface, global const real *light, Vec l, Vec v,
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
            sum = vec_select(lit, shine(&terms, l, v, surface->normal), sum);
            if (!terms.has_highlight)
                world->counters[COUNT_SKIPPED + SKIP_HIGHLIGHT] += mask_count(lit);
        }
        colour = vec_select(here, sum, colour);
    }
    return colour;
}

/* Tells the shadow rays of packet p from the light: by the sketch, or else by the exact points. */
INLINE void aim_shadow_rays(OriginPacket *pencil, const wide *light, const ApproxPoint *approx, Vec light_from_apex, LazyPoints *points, int p)
{
    Lanes share;
    if (HAS_APPROX && approx_towards(approx, light_from_apex, points->active[p], &pencil->ahead, &pencil->per_end, &share)) {
        pencil->ahead = vec(-pencil->ahead.x, -pencil->ahead.y, -pencil->ahead.z);
        pencil->doubt = DOUBT_OF(share);
        return;
    }
    aim_from_light(pencil, light, *shifted_point(points, p, points->active[p]));
}

/* The unit vectors to the viewer: back along the ray, or from the point to the eye. */
INLINE Vec look_back(const World *world, const wide *eye, const ApproxPoint *approx, Vec ahead, bool from_eye,
                     Vec eye_from_apex, LazyPoints *points, int p)
{
    bool along_ray = world->parameters->viewer_ray || (from_eye && HAS_APPROX);
    Vec unit;
    Lanes per_length, share;
    if (HAS_APPROX && along_ray)
        return vec_scale(-1 / approx->length, ahead);
    if (HAS_APPROX && approx_towards(approx, eye_from_apex, points->active[p], &unit, &per_length, &share))
        return unit;
    need_points(points, p, points->active[p]);
    WideVec d = points->rays[p].direction, at = wide_vec((Wide)eye[0], (Wide)eye[1], (Wide)eye[2]);
    return vec_unit(vec_to_real(along_ray ? wide_vec(-d.x, -d.y, -d.z) : wide_sub(at, points->point[p])));
}

/* colours: the illumination of the active lanes by all lights; `lit` collects the lanes that some light reaches.
 * close: the lanes whose points rounding may have put into a closed box. apex: of all rays, or NULL: then of each. */
INLINE void shade(const World *world, const Surface *surfaces, const ApproxPoint *approx, const wide *apex,
                  const Path *paths, LazyPoints *points, const Mask *close, const Vec *v, const Mask *active,
                  Vec *colours, Mask *lit)
{
    EACH_PACKET(p) {
        colours[p] = vec(0, 0, 0);
        lit[p] = (Mask)0;
    }
    for (int i = 0; i < world->parameters->light_count; i++) {
        global const real *light = world->lights + i * LIGHT_REALS;
        wide position[3];
        light_position(light, position);
        LightSide side = {-1, 0};
        bool only_ambient = !wants_light(world, light);
        OriginPacket pencils[PACKETS];
        Mask facing[PACKETS], asking[PACKETS], blocked[PACKETS];
        EACH_PACKET(p) {
            facing[p] = asking[p] = (Mask)0;
            pencils[p] = no_origin_packet();
            if (!ANY(active[p]))
                continue;
            facing[p] = faces_light(world, surfaces + p, position, active[p], &side);
            asking[p] = facing[p];
            if (only_ambient)
                world->counters[COUNT_SKIPPED + SKIP_LIGHT_AMBIENT] += mask_count(facing[p]);
            if (MAY_SKIP(world->parameters, SKIP_LIGHT_BEHIND))
                world->counters[COUNT_SKIPPED + SKIP_LIGHT_BEHIND] += mask_count(active[p] & ~facing[p]);
            else
                asking[p] = active[p];
            if (only_ambient)
                asking[p] = facing[p] = (Mask)0;
            world->counters[COUNT_SHADOW] += mask_count(asking[p]);
            pencils[p].left = surfaces[p].face;
            aim_shadow_rays(pencils + p, position, approx + p, from_apexes(position, apex, &paths[p].apex), points, p);
        }
        find_blocked(world, position, pencils, points, close, asking, 0, blocked);
        EACH_PACKET(p) {
            Mask reaches = facing[p] & ~blocked[p];
            lit[p] |= reaches;
            Mask counted = world->parameters->shadow_ambient ? active[p] : reaches;
            if (!ANY(counted))
                continue;
            /* To a float, the shift is nothing. */
            Vec l = vec(-pencils[p].ahead.x, -pencils[p].ahead.y, -pencils[p].ahead.z);
            if (REAL_DOUBLE) {
                WideVec at = wide_vec((Wide)position[0], (Wide)position[1], (Wide)position[2]);
                l = vec_unit(vec_to_real(wide_sub(at, points->point[p])));
            }
            Vec sum = illuminate(world, surfaces + p, light, l, v[p], counted, reaches);
            colours[p] = vec_add(colours[p], sum);
        }
    }
}
