/* Adaptive sampling: the beam of a pixel follows the path of its centre, hit by hit, light by light, until something
 * may change within the pixel. */
#include "trace/adaptive.h"

#define WIDEST 0.25 /* a direction that turns by more than this within a pixel is not followed */

/* What is known of the path at one of its hits. */
typedef struct Judge {
    const Scene *scene;
    const Accel *accel;
    RenderReport *report;
    Beam beam;       /* from the eye, or its image in the mirrors so far */
    double weight;   /* of the hit */
    int face;        /* the face that is hit */
    BeamPlane plane; /* its plane */
} Judge;

static double largest(Vec3 a)
{
    return a.x > a.y ? (a.x > a.z ? a.x : a.z) : (a.y > a.z ? a.y : a.z);
}

static const Material *material_of(const Scene *scene, int face)
{
    return &scene->materials[scene->faces[face].material];
}

/* --- The samples of a refined pixel --- */

int adaptive_samples(int n)
{
    int samples = 2;
    while (samples < 2 * n || 4 * samples < n * n)
        samples *= 2;
    return samples;
}

/* Of the odd generators those whose lattices have the longest shortest vector (the spectral test: Knuth, The Art of
 * Computer Programming 2, 3.3.4); of these the one with the least error at straight edges of all directions. */
int adaptive_generator(int samples)
{
    static const int generators[] = {1, 3, 5, 13, 25, 19, 105, 119, 405, 271};
    int power = 1;
    while (samples >> power > 1)
        power++;
    return generators[power - 1];
}

/* --- How much light there can be --- */

double adaptive_brightest(const Scene *scene)
{
    double brightest = largest(scene->shading.background), reflection = 0;
    for (int i = 0; i < scene->material_count; i++) {
        const Material *m = &scene->materials[i];
        double sum = 0;
        for (int k = 0; k < scene->light_count; k++) {
            const Light *light = &scene->lights[k];
            sum = sum + (largest(vec3_multiply(m->ambient, light->ambient)) +
                         largest(vec3_multiply(m->diffuse, light->diffuse)) +
                         largest(vec3_multiply(m->specular, light->specular)));
        }
        brightest = sum > brightest ? sum : brightest;
        reflection = m->reflection > reflection ? m->reflection : reflection;
    }
    double hits = scene->shading.max_bounces + 1;
    return brightest * (hits * (1 - reflection) < 1 ? hits : 1 / (1 - reflection));
}

/* --- How evenly light changes over a face --- */

/* The directions of a beam made unit vectors are a linear function of a and b but for a rest whose average is at most
 * this: 2/sqrt(3) bounds the second derivative of x/|x| at |x| = 1, (1 - 1/4)^-2 what |x| changes, and (a u + b v)^2
 * has the average (u^2 + v^2) / 3. `square` is (u^2 + v^2) / c^2. */
static double curved(double square)
{
    return 0.35 * square;
}

/* A bound of x^power for 0 <= x <= 1 without a power in it: x^p <= exp(-p (1 - x)). */
static double power_bound(double x, double power)
{
    double y = power * (1 - x);
    return y > 0 ? 1 / (1 + y * (1 + y * (0.5 + y * (1.0 / 6 + y * (1.0 / 24))))) : 1;
}

/* How far the average of x^k may be from its value at the middle, x, where the average of x is off by at most `off` and
 * x changes by at most `change`: the first two terms of Taylor's series. */
static double power_uneven(double x, double k, double off, double change)
{
    double high = x + change < 1 ? x + change : 1, low = x - change;
    if (k == 0 || high <= 0)
        return 0;
    if (k >= 2) {
        double bound = power_bound(high, k - 2);
        return bound * k * (off + 0.2 * (k - 1) * change * change);
    }
    return low > 0 ? (2 * off + 0.5 * change * change / low) / low : 1;
}

/* The most by which the colour at the middle of the beam may differ from its average, for one light that reaches all of
 * it. `to_light` and `to_viewer` are the same beam as the two see it. */
static double unevenness(const Material *material, const Light *light, Vec3 normal, const Beam *to_light,
                         const Beam *to_viewer)
{
    double diffuse = largest(vec3_multiply(material->diffuse, light->diffuse));
    double specular = largest(vec3_multiply(material->specular, light->specular));
    double l_length = vec3_length(to_light->c), v_length = vec3_length(to_viewer->c);
    double l_turn = (vec3_length(to_light->u) + vec3_length(to_light->v)) / l_length;
    double v_turn = (vec3_length(to_viewer->u) + vec3_length(to_viewer->v)) / v_length;
    if (!(l_turn <= WIDEST && v_turn <= WIDEST))
        return diffuse + specular;
    double l_square = (vec3_dot(to_light->u, to_light->u) + vec3_dot(to_light->v, to_light->v)) / (l_length * l_length);
    double v_square =
        (vec3_dot(to_viewer->u, to_viewer->u) + vec3_dot(to_viewer->v, to_viewer->v)) / (v_length * v_length);
    double uneven = diffuse * curved(l_square);
    if (specular == 0)
        return uneven;

    Vec3 sum = vec3_add(vec3_scale(1 / l_length, to_light->c), vec3_scale(1 / v_length, to_viewer->c));
    double length = vec3_length(sum), h_turn = (l_turn / (1 - l_turn) + v_turn / (1 - v_turn)) / length;
    if (!(h_turn <= WIDEST))
        return uneven + specular;
    double n_dot_h = -vec3_dot(normal, sum) / length, square = 1 - n_dot_h * n_dot_h,
           angle = 1.1 * h_turn / (1 - h_turn);
    double change = sqrt(square > 0 ? square : 0) * angle + 0.5 * angle * angle;
    double off =
        4.0 / 3 * (curved(l_square) + curved(v_square)) / length + 1.25 * (l_square + v_square) / (length * length);
    return uneven + specular * power_uneven(n_dot_h, material->shininess / 4, off, change);
}

/* --- Along the path --- */

static bool run(const Judge *judge, BeamQuery *query)
{
    beam_query_run(query, judge->accel);
    judge->report->box_tests += query->box_tests;
    judge->report->face_tests += query->face_tests;
    return query->crossed_by < 0;
}

/* Is what the centre sees, from the plane of face `from` on, what the whole beam sees? */
static AdaptiveReason judge_hit(Judge *judge, int from, int *other)
{
    const Scene *scene = judge->scene;
    int face = judge->face;
    BeamQuery query = beam_query(scene, &judge->beam, from, face);
    *other = face;
    judge->plane = query.far;
    if (face >= 0 && (beam_cover(&judge->beam, &scene->faces[face], &query.far) != BEAM_FILLED ||
                      (from >= 0 && !beam_is_farther(&judge->beam, &query.near, &query.far))))
        return ADAPTIVE_EDGE;
    if (run(judge, &query))
        return ADAPTIVE_SAME;
    *other = query.crossed_by;
    return ADAPTIVE_FACE;
}

/* Does the light reach all of the beam's hit, or nothing of it, and evenly? */
static AdaptiveReason judge_light(const Judge *judge, int index, int *other)
{
    const Scene *scene = judge->scene;
    const Face *face = &scene->faces[judge->face];
    const Plane *plane = &scene->planes[judge->face];
    const Light *light = &scene->lights[index];
    const Material *material = material_of(scene, judge->face);
    if (plane_side(face, plane, light->position) * judge->plane.side <= 0)
        return ADAPTIVE_SAME;
    bool black = scene->shading.shadow == SHADOW_BLACK;
    double most = largest(vec3_multiply(material->diffuse, light->diffuse)) +
                  largest(vec3_multiply(material->specular, light->specular));
    if (black)
        most = most + largest(vec3_multiply(material->ambient, light->ambient));
    if (judge->weight * most < ADAPTIVE_TOLERANCE && !(black && material->reflection > 0))
        return ADAPTIVE_SAME;

    Beam to_light = beam_from_point(&judge->beam, face, plane, light->position);
    BeamQuery query = beam_query(scene, &to_light, -1, judge->face);
    query.shadow = true;
    bool clear = run(judge, &query);
    *other = query.crossed_by;
    if (!clear)
        return query.filled_by >= 0 ? ADAPTIVE_SAME : ADAPTIVE_SHADOW;
    Beam to_viewer = scene->shading.viewer == VIEWER_RAY
                         ? judge->beam
                         : beam_from_point(&judge->beam, face, plane, scene->camera.position);
    Vec3 normal = judge->plane.side < 0 ? vec3_negate(plane->normal) : plane->normal;
    double uneven = unevenness(material, light, normal, &to_light, &to_viewer);
    return judge->weight * uneven < ADAPTIVE_TOLERANCE ? ADAPTIVE_SAME : ADAPTIVE_HIGHLIGHT;
}

static AdaptiveVerdict judge_lights(const Judge *judge)
{
    AdaptiveVerdict verdict = {.reason = ADAPTIVE_SAME};
    for (int i = 0; i < judge->scene->light_count && verdict.reason == ADAPTIVE_SAME; i++) {
        verdict.light = i;
        verdict.reason = judge_light(judge, i, &verdict.face);
    }
    return verdict;
}

AdaptiveVerdict adaptive_judge(const Scene *scene, const Accel *accel, const Path *path, int column, int row,
                               RenderReport *report)
{
    View view = view_of(scene);
    Judge judge = {
        .scene = scene, .accel = accel, .report = report, .beam = beam_of_pixel(&view, column, row), .weight = 1};
    double brightest = adaptive_brightest(scene);
    for (int hit = 0; hit < path->count && judge.weight * brightest >= ADAPTIVE_TOLERANCE; hit++) {
        int from = hit > 0 ? path->faces[hit - 1] : -1;
        judge.face = path->faces[hit];
        AdaptiveVerdict verdict = {.light = -1};
        verdict.reason = judge_hit(&judge, from, &verdict.face);
        if (verdict.reason == ADAPTIVE_SAME && judge.face >= 0)
            verdict = judge_lights(&judge);
        verdict.hit = hit;
        if (verdict.reason != ADAPTIVE_SAME)
            return verdict;
        if (judge.face >= 0) {
            judge.weight *= material_of(scene, judge.face)->reflection;
            judge.beam = beam_mirrored(&judge.beam, &scene->faces[judge.face], &scene->planes[judge.face]);
        }
    }
    return (AdaptiveVerdict){.reason = ADAPTIVE_SAME};
}
