/* What a hit looks like: the point, its lights, its colour. The lanes of a packet mostly meet few faces, so
 * what belongs to a face is fetched once per face and blended into its lanes. */

typedef struct Surface {
    WideVec point;
    Vec normal; /* on the ray's side */
    Vec ambient, diffuse, specular;
    Lanes exponent, reflection;
    Mask face, with_normal;
    int only; /* the face of all active lanes; -1: they have several */
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
INLINE Surface surface_on(const Geometry *g, const Shading *s, const Ray *ray, bool from_eye, int face, Mask here,
                          Mask with_normal, WideVec *shifted)
{
    PlaneRow plane = plane_row(g, face);
    WideMask wide_here = TO_WIDE_MASK(here);
    Wide t = from_eye ? plane_hit_from_point(g, face, &ray->origin, &ray->direction, wide_here).t
                      : plane_hit(g, face, &ray->origin, &ray->direction, wide_here).t;
    WideVec normal = wide_vec((Wide)plane.x, (Wide)plane.y, (Wide)plane.z);
    WideVec turned = wide_select(TO_WIDE_MASK(with_normal), wide_vec(-normal.x, -normal.y, -normal.z), normal);
    global const real *material = s->materials + (size_t)g->faces[face].material * MATERIAL_REALS;
    Surface surface;
    surface.point = wide_add(ray->origin, wide_scale(t, ray->direction));
    *shifted = point_shifted(g, face, &plane, turned, TO_WIDE_MASK(with_normal), surface.point);
    surface.normal = vec_to_real(turned);
    surface.ambient = vec_row(material + MATERIAL_AMBIENT);
    surface.diffuse = vec_row(material + MATERIAL_DIFFUSE);
    surface.specular = vec_row(material + MATERIAL_SPECULAR);
    surface.exponent = (Lanes)material[MATERIAL_EXPONENT];
    surface.reflection = (Lanes)material[MATERIAL_REFLECTION];
    return surface;
}

/* Where the rays meet their nearest faces, and the points shifted off them. `from_eye`: they have one origin. */
static void find_surface(const Geometry *g, const Shading *s, const Ray *ray, bool from_eye, Mask faces, Mask with_normal,
                         Mask active, Surface *surface, WideVec *shifted)
{
    surface->face = faces;
    surface->with_normal = with_normal;
    surface->only = -1;
    bool first = true;
    for (Mask rest = active; ANY(rest); first = false) {
        int face = first_of(faces, rest);
        Mask here = rest & IS(faces == (Mask)face);
        rest &= ~here;
        if (first && !ANY(rest))
            surface->only = face;
        WideVec off;
        Surface on = surface_on(g, s, ray, from_eye, face, here, with_normal, &off);
        Mask there = first ? (Mask)0 : ~here; /* mostly there is one face */
        WideMask wide_there = TO_WIDE_MASK(there);
        surface->point = first ? on.point : wide_select(wide_there, surface->point, on.point);
        *shifted = first ? off : wide_select(wide_there, *shifted, off);
        surface->normal = first ? on.normal : vec_select(there, surface->normal, on.normal);
        surface->ambient = first ? on.ambient : vec_select(there, surface->ambient, on.ambient);
        surface->diffuse = first ? on.diffuse : vec_select(there, surface->diffuse, on.diffuse);
        surface->specular = first ? on.specular : vec_select(there, surface->specular, on.specular);
        surface->exponent = first ? on.exponent : there ? surface->exponent : on.exponent;
        surface->reflection = first ? on.reflection : there ? surface->reflection : on.reflection;
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

/* Blinn-Phong, term by term as light.c: ambient everywhere, the other two where the light reaches. */
static Vec illuminate(const Surface *surface, global const real *light, Vec l, Vec v, Mask reaches)
{
    Vec normal = surface->normal;
    Vec ambient = vec_multiply(surface->ambient, vec_row(light + LIGHT_AMBIENT));
    Lanes l_dot_n = at_least_zero(vec_dot(l, normal));
    Vec halfway = vec_unit(vec_add(l, v));
    Lanes n_dot_h = at_least_zero(vec_dot(normal, halfway));
    Vec diffuse = vec_scale(l_dot_n, vec_multiply(surface->diffuse, vec_row(light + LIGHT_DIFFUSE)));
    Vec shine = vec_multiply(surface->specular, vec_row(light + LIGHT_SPECULAR));
    Vec specular = vec(0, 0, 0);
    if (ANY(reaches & (IS(shine.x > (Lanes)0) | IS(shine.y > (Lanes)0) | IS(shine.z > (Lanes)0))))
        specular = vec_scale(power(n_dot_h, surface->exponent), shine);
    return vec_select(reaches, vec_add(vec_add(ambient, diffuse), specular), ambient);
}

/* colours: the illumination of the active lanes by all lights; `lit` collects the lanes that some light reaches. */
INLINE void shade(const Geometry *g, const Shading *s, const Surface *surfaces, const WideVec *shifted, const Vec *v,
                  const Mask *active, Vec *colours, Mask *lit, Counters *counters)
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
        Pencil pencils[PACKETS];
        Mask facing[PACKETS], asking[PACKETS], blocked[PACKETS];
        EACH_PACKET(p) {
            facing[p] = asking[p] = (Mask)0;
            if (!ANY(active[p]))
                continue;
            facing[p] = faces_light(g, surfaces + p, position, active[p], &side);
            asking[p] = facing[p];
            counters->kinds[COUNT_LIGHT_BEHIND] += mask_count(active[p] & ~facing[p]);
            counters->kinds[COUNT_SHADOW] += mask_count(facing[p]);
            pencils[p].left = surfaces[p].face;
            aim_from_light(pencils + p, at, shifted[p]);
        }
        find_blocked(g, s->tree, position, pencils, shifted, asking, blocked, counters);
        EACH_PACKET(p) {
            Mask reaches = facing[p] & ~blocked[p];
            lit[p] |= reaches;
            Mask counted = s->parameters->shadow_ambient ? active[p] : reaches;
            if (!ANY(counted))
                continue;
            /* To a float, the shift is nothing. */
            Vec l = REAL_DOUBLE ? vec_unit(vec_to_real(wide_sub(at, surfaces[p].point))) : vec(-pencils[p].ahead.x, -pencils[p].ahead.y, -pencils[p].ahead.z);
            Vec sum = illuminate(surfaces + p, light, l, v[p], reaches);
            colours[p] = vec_select(counted, vec_add(colours[p], sum), colours[p]);
        }
    }
}
