/* A ray in float, and how far float may be from the ray that is meant. Whatever is compared has a bound of its error:
 *
 *     beyond the bound: the answer is certain
 *     within it: the ray is in doubt, and plain.cl traces it once more, exactly
 *
 * So the bounds decide how often the exact pass is needed, and not what the picture shows. docs/gpu.md derives them. */
#include "shared/layout.h"
#include "shared/precision.cl"
#include "plain/scene.cl"

/* P(t) = origin + t direction; the direction has length 1. No component is farther off than the errors say. */
typedef struct FloatRay {
    float3 origin, direction;
    float origin_error, direction_error;
    int from; /* the face that it leaves, -1: none */
} FloatRay;

/* What a ray's tests have in common. x, y and z are axes, turned so that the direction is longest in z. Along the
 * direction, a point is sheared to (x - shear_x z, y - shear_y z): Woop, Benthin, Wald, "Watertight Ray/Triangle
 * Intersection", 2013. */
typedef struct RaySetup {
    int x, y, z;
    float origin_x, origin_y, origin_z, shear_x, shear_y, along; /* the direction is along (shear_x, shear_y, 1) */
    float origin_error, approach_error;                          /* of the origin; of N.R */
    float error, slope; /* a sheared point that is m away is off by less than error + m slope */
    int from_x, from_y, from_z; /* where a node has the planes of entry: NODE_WIDTH farther if the ray goes backwards */
    float3 per_direction, near_side, far_side; /* of boxes: the ray enters at side * per_direction + near_side */
} RaySetup;

static float component(float3 a, int axis) { return axis == 0 ? a.x : axis == 1 ? a.y : a.z; }

static float sum_of_magnitudes(float3 a) { return fabs(a.x) + fabs(a.y) + fabs(a.z); }

/* How far the farthest point of the scene may be from a point, at most. */
static float farthest_from(const Scene *scene, float3 point)
{
    return scene->view[VIEW_FARTHEST] + sum_of_magnitudes(point);
}

/* 1 / a, and a large number for 1 / 0. */
static float3 inverses(float3 a)
{
    return 1 / select(copysign((float3)0x1p-60f, a), a, fabs(a) > 0x1p-60f);
}

/* The components along the axes z + 1, z + 2 and z. */
static float3 turned(float3 a, int z) { return z == 2 ? a : z == 0 ? a.yzx : a.zxy; }

static RaySetup set_up(const Scene *scene, const FloatRay *ray)
{
    RaySetup s;
    float3 o = ray->origin, d = ray->direction;
    float x = fabs(d.x), y = fabs(d.y), z = fabs(d.z);
    s.z = x > y ? (x > z ? 0 : 2) : (y > z ? 1 : 2);
    s.x = s.z == 2 ? 0 : s.z + 1;
    s.y = s.x == 2 ? 0 : s.x + 1;
    s.per_direction = inverses(d);
    float3 origin = turned(o, s.z), direction = turned(d, s.z);
    float per_along = turned(s.per_direction, s.z).z;
    s.along = direction.z;
    s.origin_error = 1.75f * ray->origin_error;
    s.approach_error = 1.75f * ray->direction_error + 6 * REAL_ROUNDING;
    s.origin_x = origin.x;
    s.origin_y = origin.y;
    s.origin_z = origin.z;
    s.shear_x = direction.x * per_along;
    s.shear_y = direction.y * per_along;
    float farthest = farthest_from(scene, o);
    s.error = farthest < 0x1p50f ? 2 * ray->origin_error : INFINITY; /* products must not overflow */
    s.slope = 3.5f * ray->direction_error + 7 * REAL_ROUNDING;
    s.from_x = s.per_direction.x < 0 ? NODE_WIDTH : 0;
    s.from_y = s.per_direction.y < 0 ? NODE_WIDTH : 0;
    s.from_z = s.per_direction.z < 0 ? NODE_WIDTH : 0;
    float margin = ray->origin_error + farthest * (2 * ray->direction_error + 8 * REAL_ROUNDING);
    float3 from = -o * s.per_direction, margins = margin * fabs(s.per_direction);
    s.near_side = from - margins;
    s.far_side = from + margins;
    return s;
}
