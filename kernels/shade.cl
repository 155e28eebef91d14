/* What a hit looks like: the point, its lights, its colour. The lanes of a packet mostly meet few faces, so
 * what belongs to a face is fetched once per face and blended into its lanes. */

typedef struct Surface {
    WideVec point, normal, shifted; /* P, N on the ray's side, P moved off the face */
    Vec ambient, diffuse, specular;
    Lanes exponent, reflection;
    Mask face, with_normal;
} Surface;

typedef struct Shading {
    global const real *materials, *lights, *view;
    constant const Parameters *parameters;
    const Tree *tree;
} Shading;

/* The number in the first lane that is set in the mask. */
static int first_of(Mask numbers, Mask mask)
{
    MaskElement n[LANES];
    STORE(numbers, n);
    return (int)n[lowest_bit(mask_bits(mask))];
}

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

static Surface surface_of(const Geometry *g, const Shading *s, Ray ray, Nearest nearest, Mask active)
{
    Surface surface;
    surface.face = nearest.face;
    surface.with_normal = nearest.with_normal;
    surface.point = wide_add(ray.origin, wide_scale(nearest.t, ray.direction));
    surface.normal = surface.shifted = wide_vec((Wide)0, (Wide)0, (Wide)0);
    surface.ambient = surface.diffuse = surface.specular = vec(0, 0, 0);
    surface.exponent = surface.reflection = (Lanes)0;
    WideMask with_normal = TO_WIDE_MASK(nearest.with_normal);
    for (Mask rest = active; ANY(rest);) {
        int face = first_of(nearest.face, rest);
        Mask here = rest & IS(nearest.face == (Mask)face);
        rest &= ~here;
        WideMask wide_here = TO_WIDE_MASK(here);
        PlaneRow plane = plane_row(g, face);
        WideVec normal = wide_vec((Wide)plane.x, (Wide)plane.y, (Wide)plane.z);
        WideVec turned = wide_select(with_normal, wide_vec(-normal.x, -normal.y, -normal.z), normal);
        surface.normal = wide_select(wide_here, turned, surface.normal);
        surface.shifted = wide_select(wide_here, point_shifted(g, face, &plane, turned, with_normal, surface.point),
                                      surface.shifted);
        global const real *material = s->materials + (size_t)g->faces[face].material * MATERIAL_REALS;
        surface.ambient = vec_select(here, vec_row(material + MATERIAL_AMBIENT), surface.ambient);
        surface.diffuse = vec_select(here, vec_row(material + MATERIAL_DIFFUSE), surface.diffuse);
        surface.specular = vec_select(here, vec_row(material + MATERIAL_SPECULAR), surface.specular);
        surface.exponent = here ? (Lanes)material[MATERIAL_EXPONENT] : surface.exponent;
        surface.reflection = here ? (Lanes)material[MATERIAL_REFLECTION] : surface.reflection;
    }
    return surface;
}

/* The lanes whose surface faces the light: N.L > 0, decided per face by the side of its plane that the light is on. */
static Mask faces_light(const Geometry *g, const Surface *surface, const wide *light, Mask active)
{
    Mask facing = (Mask)0;
    for (Mask rest = active; ANY(rest);) {
        int face = first_of(surface->face, rest);
        Mask here = rest & IS(surface->face == (Mask)face);
        rest &= ~here;
        wide distance = plane_distance_of_point(g, face, light);
        facing |= here & (distance > 0 ? ~surface->with_normal : distance < 0 ? surface->with_normal : (Mask)0);
    }
    return facing;
}

static Lanes at_least_zero(Lanes x) { return x > (Lanes)0 ? x : (Lanes)0; }

/* Blinn-Phong, term by term as light.c: ambient everywhere, the other two where the light reaches. */
static Vec illuminate(const Surface *surface, global const real *light, Vec l, Vec v, Mask reaches)
{
    Vec normal = vec_to_real(surface->normal);
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

/* The illumination of the active lanes by all lights; *lit collects the lanes that some light reaches. */
static Vec shade(const Geometry *g, const Shading *s, const Surface *surface, Vec v, Mask active, Mask *lit, Counters *counters)
{
    Vec colour = vec(0, 0, 0);
    *lit = (Mask)0;
    for (int i = 0; i < s->parameters->light_count; i++) {
        global const real *light = s->lights + i * LIGHT_REALS;
        wide position[3] = {(wide)light[0] + (wide)light[3], (wide)light[1] + (wide)light[4],
                            (wide)light[2] + (wide)light[5]};
        Mask facing = faces_light(g, surface, position, active);
        counters->kinds[COUNT_LIGHT_BEHIND] += mask_count(active & ~facing);
        Mask reaches = facing;
        if (ANY(facing)) {
            counters->kinds[COUNT_SHADOW] += mask_count(facing);
            reaches &= ~find_blocked(g, s->tree, surface->shifted, position, facing, surface->face, counters);
        }
        *lit |= reaches;
        Mask counted = s->parameters->shadow_ambient ? active : reaches;
        if (!ANY(counted))
            continue;
        WideVec at = wide_vec((Wide)position[0], (Wide)position[1], (Wide)position[2]);
        Vec l = vec_unit(vec_to_real(wide_sub(at, surface->point)));
        Vec sum = illuminate(surface, light, l, v, reaches);
        colour = vec_select(counted, vec_add(colour, sum), colour);
    }
    return colour;
}
