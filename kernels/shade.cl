/* What a hit looks like: the point, its lights, its colour. The lanes of a packet mostly meet few faces, so
 * what belongs to a face is fetched once per face and blended into its lanes. */

typedef struct Surface {
    WideVec point;
    Vec normal; /* on the ray's side */
    Lanes reflection;
    Mask face, material, with_normal;
    int only;          /* the face of all active lanes; -1: they have several */
    int only_material; /* the same of materials */
} Surface;

typedef struct Shading {
    global const real *materials, *lights, *view;
    constant const Parameters *parameters;
    const Tree *tree;
} Shading;

/* Moves P along n to where it is surely on n's side of the face's plane: see point_shifted in geometry.c. */
static WideVec point_shifted(const Geometry *g, int face, const PlaneRow *plane, WideVec n, WideMask with_normal, WideVec point)
{
    global const FaceRecord *record = g->faces + face;
    Wide height, doubt;
    if (PLAIN_IS_POOR) {
        WidePairs x = from_vertex_exactly(record, point);
        height = normal_dot_accurate(plane, record, &x, (WideMask)-1).high;
        doubt = ACCURATE_ERROR(*plane) * wide_magnitudes(x.high);
    } else {
        WideVec x = from_vertex(record, point);
        height = normal_dot(plane, x);
        doubt = PLAIN_ERROR(*plane) * wide_magnitudes(x);
    }
    height = with_normal ? -height : height;
    Wide margin = 2 * WIDE_ROUNDING * wide_magnitudes(point) + 12 * WIDE_ROUNDING * fabs(height) + doubt;
    margin = margin > (Wide)SHIFT_FLOOR ? margin : (Wide)SHIFT_FLOOR;
    return wide_add(point, wide_scale(margin - height, n));
}

/* Where the rays meet the face. */
INLINE WideVec point_on(const Geometry *g, const Ray *ray, bool from_eye, int face, Mask here)
{
    WideMask wide_here = TO_WIDE_MASK(here);
    Wide t = from_eye ? plane_hit_from_point(g, face, &ray->origin, &ray->direction, wide_here).t
                      : plane_hit(g, face, &ray->origin, &ray->direction, wide_here).t;
    return wide_add(ray->origin, wide_scale(t, ray->direction));
}

/* Where the rays meet their nearest faces, and the points shifted off them. `from_eye`: they have one origin. */
INLINE void find_surface(const Geometry *g, const Shading *s, const Ray *ray, bool from_eye, Mask faces, Mask with_normal,
                         Mask active, Surface *surface, WideVec *shifted)
{
    WideMask wide_with = TO_WIDE_MASK(with_normal);
    surface->face = faces;
    surface->with_normal = with_normal;
    surface->only = first_of(faces, active);
    surface->only_material = g->faces[surface->only].material;
    bool first = true;
    for (Mask rest = active; ANY(rest); first = false) {
        int face = first ? surface->only : first_of(faces, rest), material = g->faces[face].material;
        Mask here = rest & IS(faces == (Mask)face);
        rest &= ~here;
        WideVec point = point_on(g, ray, from_eye, face, here);
        PlaneRow plane = plane_row(g, face);
        WideVec normal = wide_vec((Wide)plane.x, (Wide)plane.y, (Wide)plane.z);
        WideVec turned = wide_select(wide_with, wide_vec(-normal.x, -normal.y, -normal.z), normal);
        WideVec off = point_shifted(g, face, &plane, turned, wide_with, point);
        Lanes reflection = (Lanes)s->materials[(size_t)material * MATERIAL_REALS + MATERIAL_REFLECTION];
        if (first) { /* mostly there is one face */
            surface->point = point;
            *shifted = off;
            surface->normal = vec_to_real(turned);
            surface->reflection = reflection;
            surface->material = (Mask)material;
            continue;
        }
        WideMask wide_here = TO_WIDE_MASK(here);
        surface->point = wide_select(wide_here, point, surface->point);
        *shifted = wide_select(wide_here, off, *shifted);
        surface->normal = vec_select(here, vec_to_real(turned), surface->normal);
        surface->reflection = here ? reflection : surface->reflection;
        surface->material = here ? (Mask)material : surface->material;
        surface->only = -1;
        if (material != surface->only_material)
            surface->only_material = -1;
    }
}

/* N of each lane's face, on the side that the ray came from. */
static WideVec wide_normal(const Geometry *g, const Surface *surface, Mask active)
{
    WideVec normal = wide_vec((Wide)0, (Wide)0, (Wide)0);
    for (Mask rest = active; ANY(rest);) {
        int face = first_of(surface->face, rest);
        Mask here = rest & IS(surface->face == (Mask)face);
        rest &= ~here;
        global const wide *row = g->planes + (size_t)face * PLANE_REALS;
        normal = wide_select(TO_WIDE_MASK(here), wide_vec((Wide)row[0], (Wide)row[1], (Wide)row[2]), normal);
    }
    return wide_select(TO_WIDE_MASK(surface->with_normal), wide_vec(-normal.x, -normal.y, -normal.z), normal);
}

/* On which side of the face that was asked last a light is: neighbours mostly ask for the same face. */
typedef struct LightSide {
    int face;
    wide distance;
} LightSide;

INLINE Mask turned_to_light(const Geometry *g, const Surface *surface, int face, const wide *light, LightSide *side)
{
    if (face != side->face) {
        side->face = face;
        side->distance = plane_distance_of_point(g, face, light);
    }
    return side->distance > 0 ? ~surface->with_normal : side->distance < 0 ? surface->with_normal : (Mask)0;
}

/* The lanes whose surface faces the light: N.L > 0, decided per face by the side of its plane that the light is on. */
static Mask faces_light(const Geometry *g, const Surface *surface, const wide *light, Mask active, LightSide *side)
{
    if (surface->only >= 0)
        return active & turned_to_light(g, surface, surface->only, light, side);
    Mask facing = (Mask)0;
    for (Mask rest = active; ANY(rest);) {
        int face = first_of(surface->face, rest);
        Mask here = rest & IS(surface->face == (Mask)face);
        rest &= ~here;
        facing |= here & turned_to_light(g, surface, face, light, side);
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

/* Blinn-Phong, term by term as light.c: ambient everywhere, the other two where the light reaches. The lanes of a packet
 * mostly have one material. */
INLINE Vec illuminate(const Shading *s, const Surface *surface, global const real *light, Vec l, Vec v, Mask counted, Mask reaches,
                      Counters *counters)
{
    Lanes l_dot_n = at_least_zero(vec_dot(l, surface->normal));
    Lanes n_dot_h = at_least_zero(vec_dot(surface->normal, vec_unit(vec_add(l, v))));
    Vec colour = vec(0, 0, 0);
    for (Mask rest = counted; ANY(rest);) {
        int number = surface->only_material >= 0 ? surface->only_material : first_of(surface->material, rest);
        Mask here = rest & IS(surface->material == (Mask)number), lit = here & reaches;
        rest &= ~here;
        global const real *material = s->materials + (size_t)number * MATERIAL_REALS;
        real3 ambient = coloured(material + MATERIAL_AMBIENT, light + LIGHT_AMBIENT);
        Vec sum = vec((Lanes)ambient.x, (Lanes)ambient.y, (Lanes)ambient.z);
        if (ANY(lit)) {
            Vec all = vec_add(sum, scale_colour(l_dot_n, coloured(material + MATERIAL_DIFFUSE, light + LIGHT_DIFFUSE)));
            real3 shine = coloured(material + MATERIAL_SPECULAR, light + LIGHT_SPECULAR);
            if (SKIPS(s->parameters, SKIP_HIGHLIGHT) && shine.x == 0 && shine.y == 0 && shine.z == 0)
                counters->kinds[COUNT_SKIPPED + SKIP_HIGHLIGHT] += mask_count(lit);
            else
                all = vec_add(all, scale_colour(power(n_dot_h, (Lanes)material[MATERIAL_EXPONENT]), shine));
            sum = vec_select(lit, all, sum);
        }
        colour = vec_select(here, sum, colour);
    }
    return colour;
}

INLINE bool has_only_ambient(global const real *light)
{
    bool only = true;
    for (int i = 0; i < 3; i++)
        only &= light[LIGHT_DIFFUSE + i] == 0 && light[LIGHT_SPECULAR + i] == 0;
    return only;
}

/* colours: the illumination of the active lanes by all lights; `lit` collects the lanes that some light reaches.
 * close: the lanes whose points rounding may have put into a closed box. */
INLINE void shade(const Geometry *g, const Shading *s, const Surface *surfaces, const WideVec *shifted, const Mask *close,
                  const Vec *v, const Mask *active, Vec *colours, Mask *lit, Counters *counters)
{
    EACH_PACKET(p) {
        colours[p] = vec(0, 0, 0);
        lit[p] = (Mask)0;
    }
    for (int i = 0; i < s->parameters->light_count; i++) {
        global const real *light = s->lights + i * LIGHT_REALS;
        wide position[3] = {(wide)light[0] + (wide)light[3], (wide)light[1] + (wide)light[4],
                            (wide)light[2] + (wide)light[5]};
        WideVec at = wide_vec((Wide)position[0], (Wide)position[1], (Wide)position[2]);
        LightSide side = {-1, 0};
        bool only_ambient = SKIPS(s->parameters, SKIP_LIGHT_AMBIENT) && s->parameters->shadow_ambient && has_only_ambient(light);
        Pencil pencils[PACKETS];
        Mask facing[PACKETS], asking[PACKETS], blocked[PACKETS];
        EACH_PACKET(p) {
            facing[p] = asking[p] = (Mask)0;
            pencils[p] = no_pencil();
            if (!ANY(active[p]))
                continue;
            facing[p] = faces_light(g, surfaces + p, position, active[p], &side);
            asking[p] = facing[p];
            if (only_ambient)
                counters->kinds[COUNT_SKIPPED + SKIP_LIGHT_AMBIENT] += mask_count(facing[p]);
            if (SKIPS(s->parameters, SKIP_LIGHT_BEHIND))
                counters->kinds[COUNT_SKIPPED + SKIP_LIGHT_BEHIND] += mask_count(active[p] & ~facing[p]);
            else
                asking[p] = active[p];
            if (only_ambient)
                asking[p] = facing[p] = (Mask)0;
            counters->kinds[COUNT_SHADOW] += mask_count(asking[p]);
            pencils[p].left = surfaces[p].face;
            aim_from_light(pencils + p, at, shifted[p]);
        }
        find_blocked(g, s->tree, position, pencils, shifted, close, asking, blocked, counters);
        EACH_PACKET(p) {
            Mask reaches = facing[p] & ~blocked[p];
            lit[p] |= reaches;
            Mask counted = s->parameters->shadow_ambient ? active[p] : reaches;
            if (!ANY(counted))
                continue;
            /* To a float, the shift is nothing. */
            Vec l = REAL_DOUBLE ? vec_unit(vec_to_real(wide_sub(at, surfaces[p].point))) : vec(-pencils[p].ahead.x, -pencils[p].ahead.y, -pencils[p].ahead.z);
            Vec sum = illuminate(s, surfaces + p, light, l, v[p], counted, reaches, counters);
            colours[p] = vec_add(colours[p], sum);
        }
    }
}
