/* Random numbers, directions and rotations. */
#include "random.h"

uint64_t random_bits(Random *random)
{
    uint64_t z = (random->state += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

int random_below(Random *random, int count)
{
    return (int)(random_bits(random) % (uint64_t)count);
}

double random_in(Random *random, double low, double high)
{
    return low + (high - low) * ((double)(random_bits(random) >> 11) * 0x1p-53);
}

/* A point of the ball, thrown until it lies in it, then pushed to the sphere. */
Vec3 random_unit(Random *random)
{
    for (;;) {
        Vec3 a = vec3(random_in(random, -1, 1), random_in(random, -1, 1), random_in(random, -1, 1));
        double squared = vec3_dot(a, a);
        if (squared <= 1 && squared > 1e-6)
            return vec3_unit(a);
    }
}

Rotation random_rotation(Random *random)
{
    Vec3 x = random_unit(random);
    Vec3 y = vec3_unit(vec3_cross(random_unit(random), x));
    return (Rotation){x, y, vec3_cross(x, y)};
}

Vec3 rotate(const Rotation *rotation, Vec3 a)
{
    return vec3_add(vec3_add(vec3_scale(a.x, rotation->x), vec3_scale(a.y, rotation->y)), vec3_scale(a.z, rotation->z));
}
