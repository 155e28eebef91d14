/* What a hit looks like: the point, its lights, its colour. The lanes of a packet mostly meet few faces, so
 * what belongs to a face is fetched once per face and blended into its lanes. */
#include "shared/skips.h"
#include "shared/layout.h"
#include "packet/lanes.cl"
#include "packet/geometry.cl"
#include "packet/apex.cl"
#include "packet/intersect.cl"
#include "packet/points.cl"
#include "packet/world.cl"
#include "packet/accel.cl"
#include "packet/search.cl"
#include "packet/power.cl"

typedef struct Surface {
    Vec normal; /* on the ray's side */
    Lanes reflection;
    Mask face, material, with_normal;
    int only;          /* the face of all active lanes; -1: they have several */
    int only_material; /* the same of materials */
} Surface;

/* The rays of a packet on their way, and what they have brought so far. */
typedef struct Path {
    WideVec apex; /* the image of the eye in the mirrors so far, from which the rays seem to come */
    Mask active, left;
    Vec total;
    Lanes weight;
} Path;

/* Where rays meet their faces as float can tell it: from their apex, so that it does not matter how far from 0 the scene lies.
 * It serves shading, and shadow rays, where its error is a small enough share of the distance to the light and to the viewer. */
#define HAS_APPROX (!PLAIN_IS_POOR)
#define APPROX_MOST ((real)0x1p-14f)

typedef struct ApproxPoint {
    Vec from_apex;
    Lanes error;  /* the point is not farther from the exact one */
    Lanes length; /* of the ray's direction */
} ApproxPoint;

/* N.(v0 - A), t's numerator, which has no error worth mentioning; of a face seen from one apex, and from each lane's. */
INLINE real approx_height(const World *world, int face, const wide *apex)
{
    global const wide *n = world->planes + (size_t)face * PLANE_REALS;
    global const real *v = face_row(world, face) + FACE_VERTICES;
    return (real)(n[0] * (v[0] - apex[0]) + n[1] * (v[4] - apex[1]) + n[2] * (v[8] - apex[2]));
}

INLINE Lanes approx_heights(const World *world, int face, WideVec apex)
{
    global const wide *n = world->planes + (size_t)face * PLANE_REALS;
    global const real *v = face_row(world, face) + FACE_VERTICES;
    return TO_REAL(n[0] * ((wide)v[0] - apex.x) + n[1] * ((wide)v[4] - apex.y) + n[2] * ((wide)v[8] - apex.z));
}

INLINE real vertex_magnitudes(const World *world, int face)
{
    global const real *v = face_row(world, face) + FACE_VERTICES;
    return fabs(v[0]) + fabs(v[4]) + fabs(v[8]);
}

/* How far t R may be off, for R of that length. */
#define APPROX_ERROR(t, length, per_approach, off) (((8 * REAL_ROUNDING) * (t) * (length) + (off)) * (1 + (length) * (per_approach)))

/* height: N.(v0 - A), and how far it, and A, may be off; normal: N of the lanes' faces. Where rounding may decide the sign of
 * N.R, or that of t, there is no bound. */
INLINE ApproxPoint approx_point(Vec ahead, Lanes height, Lanes off, Vec normal)
{
    ApproxPoint s;
    Lanes approach = FMA(ahead.x, normal.x, FMA(ahead.y, normal.y, ahead.z * normal.z));
    Lanes per_approach = 1 / approach, t = height * per_approach;
    s.length = sqrt(vec_dot(ahead, ahead));
    s.from_apex = vec_scale(t, ahead);
    Mask sure = IS(t > (Lanes)0) & IS(fabs(approach) > (16 * REAL_ROUNDING) * s.length);
    s.error = sure ? APPROX_ERROR(t, s.length, fabs(per_approach), off) : (Lanes)INFINITY;
    return s;
}

/* How far an apex may be off after up to PATH_MAX mirrors, and a height over a plane, for coordinates of that sum of
 * magnitudes. */
#define APPROX_OFF(magnitudes) ((real)0x1p-41f * (magnitudes) + (real)0x1p-52f)

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

/* From the points to a place that lies at `at`, told from the apex: unit vectors, and 1 / their length. False where the sketch
 * is too rough in some active lane. share: the sketch's error as a share of the length. */
INLINE bool approx_towards(const ApproxPoint *approx, Vec at, Mask active, Vec *unit, Lanes *per_length, Lanes *share)
{
    Vec d = vec_sub(at, approx->from_apex);
    *per_length = 1 / sqrt(vec_dot(d, d));
    *unit = vec_scale(*per_length, d);
    *share = (approx->error + 2 * REAL_ROUNDING * vec_largest(at)) * *per_length;
    return !ANY(active & ~IS(*share <= (Lanes)APPROX_MOST));
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

static Lanes at_least_zero(Lanes x) { return x > (Lanes)0 ? x : (Lanes)0; }

/* The colour of a material in the light, row by row of their tables. */
INLINE real3 coloured(global const real *material, global const real *light)
{
    return (real3)(material[0] * light[0], material[1] * light[1], material[2] * light[2]);
}

INLINE Vec scale_colour(Lanes s, real3 c) { return vec(s * c.x, s * c.y, s * c.z); }

/* The terms of Blinn-Phong, as light.c has them, without their colours. */
INLINE Lanes diffuse_of(Vec l, Vec normal) { return at_least_zero(vec_dot(l, normal)); }

INLINE Lanes highlight_of(Vec l, Vec v, Vec normal, real exponent)
{
    return power(at_least_zero(vec_dot(normal, vec_unit(vec_add(l, v)))), exponent);
}

INLINE bool makes_highlight(const World *world, real3 colour)
{
    return !MAY_SKIP(world->parameters, SKIP_HIGHLIGHT) || colour.x != 0 || colour.y != 0 || colour.z != 0;
}

/* Ambient everywhere, the other two where the light reaches. The lanes of a packet mostly have one material. */
INLINE Vec illuminate(const World *world, const Surface *surface, global const real *light, Vec l, Vec v,
                      Mask counted, Mask reaches)
{
    Lanes diffuse = diffuse_of(l, surface->normal);
    Vec colour = vec(0, 0, 0);
    for (Mask rest = counted; ANY(rest);) {
        int number = surface->only_material >= 0 ? surface->only_material : first_of(surface->material, rest);
        Mask here = rest & IS(surface->material == (Mask)number), lit = here & reaches;
        rest &= ~here;
        global const real *material = world->materials + (size_t)number * MATERIAL_REALS;
        real3 ambient = coloured(material + MATERIAL_AMBIENT, light + LIGHT_AMBIENT);
        Vec sum = vec((Lanes)ambient.x, (Lanes)ambient.y, (Lanes)ambient.z);
        if (ANY(lit)) {
            Vec all = vec_add(sum, scale_colour(diffuse, coloured(material + MATERIAL_DIFFUSE, light + LIGHT_DIFFUSE)));
            real3 shine = coloured(material + MATERIAL_SPECULAR, light + LIGHT_SPECULAR);
            if (makes_highlight(world, shine))
                all = vec_add(all, scale_colour(highlight_of(l, v, surface->normal, material[MATERIAL_EXPONENT]), shine));
            else
                world->counters[COUNT_SKIPPED + SKIP_HIGHLIGHT] += mask_count(lit);
            sum = vec_select(lit, all, sum);
        }
        colour = vec_select(here, sum, colour);
    }
    return colour;
}

INLINE void light_position(global const real *light, wide *position)
{
    for (int axis = 0; axis < 3; axis++)
        position[axis] = (wide)light[LIGHT_POSITION + axis] + (wide)light[LIGHT_POSITION_LOW + axis];
}

/* Does it matter what a light reaches? Not if it has an ambient colour only, which counts in its shadow, too. */
INLINE bool wants_light(const World *world, global const real *light)
{
    bool only_ambient = true;
    for (int i = 0; i < 3; i++)
        only_ambient &= light[LIGHT_DIFFUSE + i] == 0 && light[LIGHT_SPECULAR + i] == 0;
    return !(MAY_SKIP(world->parameters, SKIP_LIGHT_AMBIENT) && world->parameters->shadow_ambient && only_ambient);
}

/* A place as it is told from the apex of each lane's ray. */
INLINE Vec from_apexes(const wide *place, const wide *apex, const WideVec *apexes)
{
    if (apex)
        return vec((Lanes)(real)(place[0] - apex[0]), (Lanes)(real)(place[1] - apex[1]), (Lanes)(real)(place[2] - apex[2]));
    return vec(TO_REAL(place[0] - apexes->x), TO_REAL(place[1] - apexes->y), TO_REAL(place[2] - apexes->z));
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

/* floor(255 c + 0.5) of the clamped colour, as in light.c. */
INLINE IntLanes colour_to_byte(Lanes c)
{
    c = c > (Lanes)0 ? c : (Lanes)0;
    c = c < (Lanes)1 ? c : (Lanes)1;
    return TO_INT((real)255 * c + (real)0.5); /* at least 0: cutting off is floor */
}

/* The lanes all of whose further hits together could not change a byte of the picture: those whose bytes are the same with the
 * most that can come, at that weight. That is known where a path is its pixel's only one. */
INLINE Mask too_weak(const World *world, Vec total, Lanes weight)
{
#if defined(LINEAR) || ADAPTIVE
    return (Mask)0;
#else
    if (!MAY_SKIP(world->parameters, SKIP_WEAK_BOUNCE) || world->parameters->grid > 1)
        return (Mask)0;
    Lanes most = weight * (Lanes)world->view[VIEW_BRIGHTEST];
    const real rounded = 1 + 256 * REAL_ROUNDING; /* no sum of up to PATH_MAX terms is rounded up by more */
    IntLanes red = IS(colour_to_byte(total.x) == colour_to_byte((total.x + most) * rounded));
    IntLanes green = IS(colour_to_byte(total.y) == colour_to_byte((total.y + most) * rounded));
    IntLanes blue = IS(colour_to_byte(total.z) == colour_to_byte((total.z + most) * rounded));
    return INTS_TO_MASK(red & green & blue);
#endif
}

/* Ends such paths. reflection: of the faces they are at. */
INLINE void drop_weak(const World *world, Path *path, Lanes reflection)
{
    if (!ANY(path->active))
        return;
    Mask weak = path->active & too_weak(world, path->total, path->weight * reflection);
    world->counters[COUNT_SKIPPED + SKIP_WEAK_BOUNCE] += mask_count(weak);
    path->active &= ~weak;
}
