/* Checks rays, and moves them to where a scene is traced. */
#include "scene/world_ray.h"

#include <math.h>

static bool in_range(double x, double largest)
{
    return x == 0 || (fabs(x) >= WORLD_RAY_SMALLEST && fabs(x) <= largest);
}

bool world_ray_origin_in_range(const double ray[6], Vec3 centre)
{
    return in_range(ray[0] - centre.x, WORLD_RAY_LARGEST_POSITION) &&
           in_range(ray[1] - centre.y, WORLD_RAY_LARGEST_POSITION) &&
           in_range(ray[2] - centre.z, WORLD_RAY_LARGEST_POSITION);
}

bool world_ray_direction_in_range(const double ray[6])
{
    return in_range(ray[3], WORLD_RAY_LARGEST_DIRECTION) && in_range(ray[4], WORLD_RAY_LARGEST_DIRECTION) &&
           in_range(ray[5], WORLD_RAY_LARGEST_DIRECTION);
}

bool world_ray_has_direction(const double ray[6])
{
    return ray[3] != 0 || ray[4] != 0 || ray[5] != 0;
}

int world_ray_localise(const double ray[6], Vec3 centre, double local[6])
{
    int exponent = vec3_exponent(vec3(ray[3], ray[4], ray[5]));
    local[0] = ray[0] - centre.x;
    local[1] = ray[1] - centre.y;
    local[2] = ray[2] - centre.z;
    for (int k = 3; k < 6; k++)
        local[k] = ldexp(ray[k], -exponent);
    return exponent;
}

double world_ray_t(double local_t, int exponent)
{
    return ldexp(local_t, -exponent);
}
