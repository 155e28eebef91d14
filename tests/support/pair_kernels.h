/* Small kernels that ask single functions of kernels/pairs/, on the device here, and pairs as rational numbers. */
#ifndef RECTRAY_TESTS_PAIR_KERNELS_H
#define RECTRAY_TESTS_PAIR_KERNELS_H

#include <gmp.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Builds the kernels. poor_division: each quotient of floats is 2 ulp too large, as OpenCL allows. */
void pair_kernels_open(bool poor_division);
void pair_kernels_close(void);

/* Runs a kernel on so many cases: `arithmetic` takes two pairs and gives sum, product and quotient, `signs` takes a ray
 * of pairs, direction before origin, each its high parts and its low parts, and an edge, and gives the sign of
 * det(R, a - O, b - O). */
void pair_kernels_run(const char *name, size_t cases, const float *in, size_t in_bytes, void *out, size_t out_bytes);

/* high + low. */
void pair_set(mpq_t value, float high, float low);

/* 0 .. count - 1; 1 or -1. The state is that of xorshift.h. */
int pair_pick(uint64_t *state, int count);
float pair_sign(uint64_t *state);

#endif
