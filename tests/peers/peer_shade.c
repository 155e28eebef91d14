/* The formulas of docs/algorithm.md, steps 6 to 9, in lanes. -ffast-math lets the compiler use its vector powf. */
#include "peer_shade.h"

#include <math.h>

#ifdef __AVX512F__
#include <immintrin.h>
#endif

/* Hit points lie this far off their faces, relative to the magnitudes that made them: some of Embree's roundings. */
#define SHIFT 4e-6f

/* out[i] = table[index[i]], four bytes each: the one thing here that the compiler makes no vector of by itself. */
static void gather16(void *restrict out, const void *restrict table, const int *restrict index)
{
#ifdef __AVX512F__
    _mm512_storeu_si512(out, _mm512_i32gather_epi32(_mm512_loadu_si512(index), table, 4));
#else
    for (int i = 0; i < WIDTH; i++)
        ((int *)out)[i] = ((const int *)table)[index[i]];
#endif
}

Vec1 vec1(Vec3 a)
{
    return (Vec1){(float)a.x, (float)a.y, (float)a.z};
}

void surface_fill(const PeerScene *peer, Vec1 eye, const struct RTCRayHit16 *restrict ray, const int *restrict hit,
                  Surface *restrict s)
{
    const struct RTCRay16 *r = &ray->ray;
    int faces[WIDTH], both_sided = (int)peer->both_sided;
    bool from_camera = peer->scene->shading.viewer == VIEWER_CAMERA;
    for (int i = 0; i < WIDTH; i++) {
        float dx = r->dir_x[i], dy = r->dir_y[i], dz = r->dir_z[i], t = hit[i] ? r->tfar[i] : 1;
        float nx = ray->hit.Ng_x[i], ny = ray->hit.Ng_y[i], nz = ray->hit.Ng_z[i];
        float px = r->org_x[i] + t * dx, py = r->org_y[i] + t * dy, pz = r->org_z[i] + t * dz;
        float turn = nx * dx + ny * dy + nz * dz > 0 ? -1.0f : 1.0f;
        float scale = turn / sqrtf(nx * nx + ny * ny + nz * nz);
        float off = SHIFT * (fabsf(px) + fabsf(py) + fabsf(pz) + t * (fabsf(dx) + fabsf(dy) + fabsf(dz)));
        float length = 1 / sqrtf(dx * dx + dy * dy + dz * dz);
        float vx = from_camera ? eye.x - px : -dx, vy = from_camera ? eye.y - py : -dy,
              vz = from_camera ? eye.z - pz : -dz;
        float to_viewer = 1 / sqrtf(vx * vx + vy * vy + vz * vz);
        nx *= scale, ny *= scale, nz *= scale;
        s->point.x[i] = px, s->point.y[i] = py, s->point.z[i] = pz;
        s->normal.x[i] = nx, s->normal.y[i] = ny, s->normal.z[i] = nz;
        s->shifted.x[i] = px + off * nx, s->shifted.y[i] = py + off * ny, s->shifted.z[i] = pz + off * nz;
        s->unit.x[i] = dx * length, s->unit.y[i] = dy * length, s->unit.z[i] = dz * length;
        s->viewer.x[i] = vx * to_viewer, s->viewer.y[i] = vy * to_viewer, s->viewer.z[i] = vz * to_viewer;
        int face = (int)ray->hit.primID[i] + (ray->hit.geomID[i] == 1 ? both_sided : 0);
        faces[i] = face & hit[i];
    }
    gather16(s->material, peer->material_of, faces);
}

int shadow_rays(const Surface *restrict s, Vec1 light, bool from_light, const int *restrict on, int *restrict facing,
                struct RTCRay16 *restrict rays)
{
    int count = 0;
    for (int i = 0; i < WIDTH; i++) {
        float ox = s->shifted.x[i], oy = s->shifted.y[i], oz = s->shifted.z[i];
        float lx = light.x - ox, ly = light.y - oy, lz = light.z - oz;
        float l_dot_n = lx * s->normal.x[i] + ly * s->normal.y[i] + lz * s->normal.z[i];
        facing[i] = on[i] & -(l_dot_n > 0);
        count -= facing[i];
        rays->org_x[i] = from_light ? light.x : ox;
        rays->org_y[i] = from_light ? light.y : oy;
        rays->org_z[i] = from_light ? light.z : oz;
        rays->dir_x[i] = from_light ? -lx : lx;
        rays->dir_y[i] = from_light ? -ly : ly;
        rays->dir_z[i] = from_light ? -lz : lz;
        rays->tnear[i] = 0;
        rays->tfar[i] = 1;
        rays->time[i] = 0;
        rays->mask[i] = ~0u;
        rays->id[i] = rays->flags[i] = 0;
    }
    return count;
}

/* The highlight's factor: (N.H)^(alpha/4). */
static void highlights(const PeerScene *peer, const Surface *restrict s, const Vec16 *restrict l,
                       float *restrict highlight)
{
    float exponents[WIDTH];
    gather16(exponents, peer->materials.exponent, s->material);
    for (int i = 0; i < WIDTH; i++) {
        float hx = l->x[i] + s->viewer.x[i], hy = l->y[i] + s->viewer.y[i], hz = l->z[i] + s->viewer.z[i];
        float n_dot_h = (hx * s->normal.x[i] + hy * s->normal.y[i] + hz * s->normal.z[i]) /
                        sqrtf(hx * hx + hy * hy + hz * hz + 1e-30f);
        highlight[i] = powf(n_dot_h > 0 ? n_dot_h : 0, exponents[i]);
    }
}

/* A packet mostly meets one material: then its row is read once for all lanes. */
static bool same16(const int *index)
{
    int other = 0;
    for (int i = 0; i < WIDTH; i++)
        other |= index[i] ^ index[0];
    return other == 0;
}

/* sum += weights * colour of the light * colour of the material. */
static void add_term(Vec16 *restrict sum, const float *restrict weights, Vec1 light, float *const table[3],
                     const int *restrict material, bool same)
{
    float *sums[3] = {sum->x, sum->y, sum->z};
    const float colour[3] = {light.x, light.y, light.z};
    for (int k = 0; k < 3; k++) {
        float here[WIDTH], *restrict out = sums[k];
        if (same) {
            float factor = colour[k] * table[k][material[0]];
            for (int i = 0; i < WIDTH; i++)
                out[i] += weights[i] * factor;
            continue;
        }
        gather16(here, table[k], material);
        for (int i = 0; i < WIDTH; i++)
            out[i] += weights[i] * colour[k] * here[i];
    }
}

/* Whether a lane that the light reaches has a highlight at all. */
static bool shines(const MaterialTable *m, const int *restrict material, const int *restrict reaching, bool same)
{
    if (same || !m->shines)
        return m->shines && m->shiny[material[0]];
    int shiny[WIDTH], any = 0;
    gather16(shiny, m->shiny, material);
    for (int i = 0; i < WIDTH; i++)
        any |= shiny[i] & reaching[i];
    return any != 0;
}

void illuminate16(const PeerScene *peer, const Surface *restrict s, const LightRow *restrict light,
                  const int *restrict reaching, const int *restrict ambient_too, const float *restrict weight,
                  Vec16 *restrict colour)
{
    const MaterialTable *m = &peer->materials;
    Vec16 l;
    float diffuse[WIDTH], highlight[WIDTH], ambient[WIDTH];
    for (int i = 0; i < WIDTH; i++) {
        float lx = light->position.x - s->point.x[i], ly = light->position.y - s->point.y[i],
              lz = light->position.z - s->point.z[i], length = 1 / sqrtf(lx * lx + ly * ly + lz * lz);
        l.x[i] = lx * length, l.y[i] = ly * length, l.z[i] = lz * length;
        float l_dot_n = l.x[i] * s->normal.x[i] + l.y[i] * s->normal.y[i] + l.z[i] * s->normal.z[i];
        diffuse[i] = reaching[i] & -(l_dot_n > 0) ? weight[i] * l_dot_n : 0;
        ambient[i] = ambient_too[i] ? weight[i] : 0;
    }
    bool same = same16(s->material);
    add_term(colour, ambient, light->ambient, m->ambient, s->material, same);
    add_term(colour, diffuse, light->diffuse, m->diffuse, s->material, same);
    if (!shines(m, s->material, reaching, same))
        return;
    highlights(peer, s, &l, highlight);
    for (int i = 0; i < WIDTH; i++)
        highlight[i] = reaching[i] ? weight[i] * highlight[i] : 0;
    add_term(colour, highlight, light->specular, m->specular, s->material, same);
}

int reflect16(const PeerScene *peer, const Surface *restrict s, int *restrict on, float *restrict weight,
              struct RTCRayHit16 *restrict ray)
{
    struct RTCRay16 *r = &ray->ray;
    float reflection[WIDTH];
    int count = 0;
    gather16(reflection, peer->materials.reflection, s->material);
    for (int i = 0; i < WIDTH; i++) {
        float twice =
            2 * (s->unit.x[i] * s->normal.x[i] + s->unit.y[i] * s->normal.y[i] + s->unit.z[i] * s->normal.z[i]);
        on[i] &= -(reflection[i] > 0);
        count -= on[i];
        weight[i] *= reflection[i];
        r->org_x[i] = s->shifted.x[i], r->org_y[i] = s->shifted.y[i], r->org_z[i] = s->shifted.z[i];
        r->dir_x[i] = s->unit.x[i] - twice * s->normal.x[i];
        r->dir_y[i] = s->unit.y[i] - twice * s->normal.y[i];
        r->dir_z[i] = s->unit.z[i] - twice * s->normal.z[i];
        r->tfar[i] = INFINITY;
        ray->hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    return count;
}
