/* Slips of step 9: the mirror, and the sum along the path. */
#include "grade/slip.h"

#include <stddef.h>

/* r plus so much of N. */
static Ray turned(const SlipHit *hit, double factor)
{
    double along = vec3_dot(hit->r, hit->normal);
    return (Ray){hit->shifted, vec3_add(hit->r, vec3_scale(factor * along, hit->normal))};
}

static Ray added(const SlipHit *hit)
{
    return turned(hit, 2);
}

static Ray once(const SlipHit *hit)
{
    return turned(hit, -1);
}

static Ray straight_on(const SlipHit *hit)
{
    return (Ray){hit->shifted, hit->r};
}

static Ray straight_back(const SlipHit *hit)
{
    return (Ray){hit->shifted, vec3_negate(hit->r)};
}

static Ray of_primary(const SlipHit *hit)
{
    Vec3 r = vec3_unit(hit->primary.direction), n = hit->normal;
    return (Ray){hit->shifted, vec3_sub(r, vec3_scale(2 * vec3_dot(r, n), n))};
}

/* The arithmetic is right, but the length of R is kept, in which t is counted. */
static Ray not_unit(const SlipHit *hit)
{
    Vec3 r = hit->ray.direction, n = hit->normal;
    return (Ray){hit->shifted, vec3_sub(r, vec3_scale(2 * vec3_dot(r, n), n))};
}

static Ray along_normal(const SlipHit *hit)
{
    return (Ray){hit->shifted, hit->normal};
}

static Ray from_origin(const SlipHit *hit)
{
    Vec3 direction = vec3_sub(hit->r, vec3_scale(2 * vec3_dot(hit->r, hit->normal), hit->normal));
    return (Ray){hit->ray.origin, direction};
}

static double not_accumulated(double before, double reflection)
{
    (void)before;
    return reflection;
}

static double squared(double before, double reflection)
{
    return before * reflection * reflection;
}

static double unweighted(double before, double reflection)
{
    (void)reflection;
    return before;
}

static double the_rest(double before, double reflection)
{
    return before * (1 - reflection);
}

static double halved(double before, double reflection)
{
    return before * reflection / 2;
}

static Vec3 mixed(double weight, Vec3 illumination, const Material *material)
{
    return vec3_scale(weight * (1 - material->reflection), illumination);
}

static Vec3 times_reflection(double weight, Vec3 illumination, const Material *material)
{
    return vec3_scale(weight * material->reflection, illumination);
}

static Vec3 unweighted_hit(double weight, Vec3 illumination, const Material *material)
{
    (void)weight;
    (void)material;
    return illumination;
}

static Vec3 unweighted_background(double weight, Vec3 background)
{
    (void)weight;
    return background;
}

static Vec3 no_background(double weight, Vec3 background)
{
    (void)background;
    return vec3_scale(weight, vec3(0, 0, 0));
}

static Vec3 last_hit_only(Vec3 total, Vec3 contribution)
{
    (void)total;
    return contribution;
}

static void no_reflection(Scene *scene)
{
    scene->shading.max_bounces = 0;
}

static void one_bounce_more(Scene *scene)
{
    scene->shading.max_bounces++;
}

static void one_bounce_fewer(Scene *scene)
{
    scene->shading.max_bounces -= scene->shading.max_bounces > 0;
}

static void bounces_unlimited(Scene *scene)
{
    scene->shading.max_bounces = SCENE_MAX_BOUNCES;
}

static bool every_face_mirrors(const SlipEnd *end, PathEnd *reason)
{
    bool dark = end->reaching == 0 && end->scene->shading.shadow == SHADOW_BLACK;
    *reason = dark ? PATH_IN_SHADOW : PATH_MAX_BOUNCES;
    return dark || end->bounces == end->scene->shading.max_bounces;
}

#define READ "algorithm.md#9-reflection"
#define REFLECTED "R' = r - 2 (r.N) N"
#define WEIGHT "weight = weight x reflection"

const Slip slip_mirror[] = {
    {"reflection-of-primary", "The reflected ray is made of the camera's ray, not of the one that arrived.",
     REFLECTED ", r of the ray that arrived", REFLECTED ", r of the primary ray", READ,
     .steps = {.reflected = of_primary}},
    {"reflection-sign", "The reflected direction has a plus for a minus.", REFLECTED, "R' = r + 2 (r.N) N", READ,
     .steps = {.reflected = added}},
    {"reflection-once", "The factor 2 is missing: the ray runs along the mirror.", REFLECTED, "R' = r - (r.N) N", READ,
     .steps = {.reflected = once}},
    {"reflection-straight-on", "The ray goes straight on behind the mirror.", REFLECTED, "R' = r", READ,
     .steps = {.reflected = straight_on}},
    {"reflection-back", "The ray goes back to where it came from.", REFLECTED, "R' = -r", READ,
     .steps = {.reflected = straight_back}},
    {"reflection-along-normal", "The reflected ray leaves along the normal.", REFLECTED, "R' = N", READ,
     .steps = {.reflected = along_normal}},
    {"reflection-not-unit", "R is not made a unit vector before it is mirrored, so that t is not a distance.",
     REFLECTED " with r = R / |R|", "R' = R - 2 (R.N) N", READ, .steps = {.reflected = not_unit}},
    {"reflection-origin", "The reflected ray starts where the ray before it started.", "it starts at S",
     "it starts at O", READ, .steps = {.reflected = from_origin}},
    {"no-reflection", "Mirrors are not followed.", "the path goes on where reflection > 0", "one hit only", READ,
     .steps = {.scene = no_reflection}},
    {"weight-not-accumulated", "The weight is the last mirror's, not the product of all.", WEIGHT,
     "weight = reflection", READ, .steps = {.weight = not_accumulated}},
    {"weight-squared", "The reflection counts twice.", WEIGHT, "weight = weight x reflection x reflection", READ,
     .steps = {.weight = squared}},
    {"weight-forgotten", "What a mirror shows counts in full.", WEIGHT, "weight = 1", READ,
     .steps = {.weight = unweighted}},
    {"weight-unused", "The weight is not used where a hit is added.", "weight x illumination", "illumination", READ,
     .steps = {.contribution = unweighted_hit}},
    {"weight-of-the-rest", "The weight is multiplied by 1 - reflection.", WEIGHT, "weight x (1 - reflection)", READ,
     .steps = {.weight = the_rest}},
    {"weight-halved", "The weight is halved at each mirror, too.", WEIGHT, "weight = weight x reflection / 2", READ,
     .steps = {.weight = halved}},
    {"mixed", "A mirror's own light is multiplied by 1 - reflection; in the text it counts in full.",
     "weight x illumination", "weight x (1 - reflection) x illumination", READ, .steps = {.contribution = mixed}},
    {"own-light-reflected", "A face's own light is multiplied by its reflection.", "weight x illumination",
     "weight x reflection x illumination", READ, .steps = {.contribution = times_reflection}},
    {"last-hit-only", "Only the last hit of the path counts: the hits are not added up.",
     "the sum over the hits of the path", "the last hit alone", READ, .steps = {.add_hit = last_hit_only}},
    {"bounce-too-many", "The path has one mirror too many.", "at most max_bounces reflected rays",
     "max_bounces + 1 of them", READ, .steps = {.scene = one_bounce_more}},
    {"bounce-too-few", "The path has one mirror too few.", "at most max_bounces reflected rays",
     "max_bounces - 1 of them", READ, .steps = {.scene = one_bounce_fewer}},
    {"bounces-unlimited", "The path is not ended by max_bounces.", "at most max_bounces reflected rays",
     "any number of them", READ, .steps = {.scene = bounces_unlimited}},
    {"every-face-mirrors", "The path goes on at a face whose reflection is 0.", "it ends where reflection = 0",
     "it goes on with the weight 0", READ, .steps = {.ends = every_face_mirrors}},
    {"background-unweighted", "The background is added without the weight.", "weight x background", "background", READ,
     .steps = {.miss = unweighted_background}},
    {"background-forgotten", "The background is not added.", "weight x background", "(0, 0, 0)", READ,
     .steps = {.miss = no_background}},
    {0},
};
