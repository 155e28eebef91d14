/* Random numbers that every machine draws alike: splitmix64 (Steele, Lea and Flood, "Fast splittable pseudorandom
 * number generators", 2014). */
#ifndef RECTRAY_STRESS_RANDOM_H
#define RECTRAY_STRESS_RANDOM_H

#include "base/vec3.h"

#include <stdint.h>

typedef struct Random {
    uint64_t state;
} Random;

uint64_t random_bits(Random *random);
int random_below(Random *random, int count); /* 0 .. count - 1 */
double random_in(Random *random, double low, double high);
Vec3 random_unit(Random *random); /* a direction, all equally likely */

/* A rotation, all equally likely: the images of the three axes. */
typedef struct Rotation {
    Vec3 x, y, z;
} Rotation;

Rotation random_rotation(Random *random);
Vec3 rotate(const Rotation *rotation, Vec3 a);

#endif
