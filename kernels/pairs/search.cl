/* What a ray of pairs meets. The tree is searched in float, as gpu/search.cl does, with the same margins; faces that
 * float surely misses are left out, the others are tested in pairs. */
#include "shared/layout.h"
#include "shared/precision.cl"
#include "plain/scene.cl"
#include "gpu/ray.cl"
#include "gpu/face.cl"
#include GPU_TREE
#include "pairs/face.cl"
#include "pairs/pair.cl"
#include "pairs/vector.cl"

/* A ray in float. A unit of its t is `length` times shorter than that of the ray in pairs. */
typedef struct FloatSearch {
    RaySetup setup;
    float length;
    uint stack[STACK_WORDS];
    Traversal way;
} FloatSearch;

static void begin_search(const Scene *scene, const PairRay *ray, FloatSearch *s)
{
    float3 d = rounded(ray->direction);
    s->length = sqrt(vec3_dot(d, d));
    FloatRay line = {rounded(ray->origin), d / s->length, 2 * sum_of_magnitudes(low_parts(ray->origin)),
                     8 * REAL_ROUNDING, -1};
    s->setup = set_up(scene, &line);
    begin_traversal(&s->way, s->stack);
}

/* t of the ray in pairs, as one of the search that is surely not smaller. */
static float search_t(const FloatSearch *s, float t) { return t * s->length * (1 + 32 * REAL_ROUNDING); }

/* May the ray meet the face at some t from 0 to limit? */
static bool may_meet(const Scene *scene, const FloatSearch *s, int face, float limit)
{
    Meeting at = meet_face(scene, &s->setup, face);
    return at.inside != NO && !(at.high < 0) && !(at.low > limit);
}

/* Step 5: the smaller t; of equal ones, the first in the file. */
static bool is_nearer(const Scene *scene, const PairHit *hit, const PairHit *nearest)
{
    if (nearest->face >= 0 && pair_equal(hit->t_in_box, nearest->t_in_box))
        return scene->faces[hit->face].index < scene->faces[nearest->face].index;
    return pair_less(hit->t_in_box, nearest->t_in_box);
}

/* Steps 3 to 5. */
static PairHit nearest_hit(Scene *scene, const PairRay *ray)
{
    PairHit nearest = {.face = -1, .t_in_box = {INFINITY, 0}}, hit;
    FloatSearch s;
    float limit = INFINITY;
    int first, count;
    begin_search(scene, ray, &s);
    while (next_leaf(scene, &s.setup, limit, &s.way, &first, &count)) {
        scene->counts[COUNT_FACE_TESTS] += (uint)count;
        for (int i = first; i < first + count; i++) {
            int face = face_in_leaf(scene, i);
            if (face == ray->from || !may_meet(scene, &s, face, limit) || !face_test(scene, face, ray, &hit) ||
                !is_nearer(scene, &hit, &nearest))
                continue;
            nearest = hit;
            limit = search_t(&s, nearest.t_in_box.high);
        }
    }
    return nearest;
}

/* Step 6: is any face between the point `from`, which lies beside a face, and `end`? */
static bool is_blocked(Scene *scene, const PairVec *from, const PairVec *end, int beside)
{
    FloatSearch s;
    PairVec way = pairs_difference(*end, *from);
    PairRay ray = pair_ray(*from, way, beside);
    float end_t = ldexp(1.0f, -to_near_one(&way));
    int first, count;
    scene->counts[COUNT_SHADOW]++;
    begin_search(scene, &ray, &s);
    float limit = search_t(&s, end_t);
    while (next_leaf(scene, &s.setup, limit, &s.way, &first, &count)) {
        scene->counts[COUNT_FACE_TESTS] += (uint)count;
        for (int i = first; i < first + count; i++) {
            int face = face_in_leaf(scene, i);
            if (face != beside && may_meet(scene, &s, face, limit) && face_blocks(scene, face, &ray, end, end_t))
                return true;
        }
    }
    return false;
}

/* Adds this work-item's counts to those of all. */
static void add_counts(volatile global uint *totals, const Scene *scene)
{
    for (int kind = 0; kind < COUNTER_KINDS; kind++)
        if (scene->counts[kind])
            atomic_add(totals + get_global_id(0) % COUNTER_STRIPES * COUNTER_STRIDE + kind, scene->counts[kind]);
}
