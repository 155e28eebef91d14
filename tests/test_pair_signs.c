/* Exact signs of points that are pairs of floats: kernels/pairs/signs.cl on the device here, against rational numbers.
 * Half of the rays pass exactly through an edge, the others a last bit beside it. */
#include "support/pair_kernels.h"
#include "support/xorshift.h"

#include "unity.h"

#include <CL/cl.h>
#include <math.h>

enum { RAY_IN = 18 };

static uint64_t state;

void setUp(void)
{
    state = 20261130;
    pair_kernels_open(false);
}
void tearDown(void)
{
    pair_kernels_close();
}

/* det(r, a - o, b - o) in rational numbers. ray: as the kernel takes it. */
static int exact_sign(const float *ray)
{
    mpq_t r[3], o[3], a[3], b[3], sum, product;
    mpq_inits(sum, product, NULL);
    for (int k = 0; k < 3; k++) {
        mpq_inits(r[k], o[k], a[k], b[k], NULL);
        pair_set(r[k], ray[k], ray[3 + k]);
        pair_set(o[k], ray[6 + k], ray[9 + k]);
        mpq_set_d(a[k], (double)ray[12 + k]);
        mpq_set_d(b[k], (double)ray[15 + k]);
        mpq_sub(a[k], a[k], o[k]);
        mpq_sub(b[k], b[k], o[k]);
    }
    for (int k = 0; k < 6; k++) {
        int x = k % 3, y = (k + (k < 3 ? 1 : 2)) % 3, z = 3 - x - y;
        mpq_mul(product, r[x], a[y]);
        mpq_mul(product, product, b[z]);
        (k < 3 ? mpq_add : mpq_sub)(sum, sum, product);
    }
    int sign = mpq_sgn(sum);
    for (int k = 0; k < 3; k++)
        mpq_clears(r[k], o[k], a[k], b[k], NULL);
    mpq_clears(sum, product, NULL);
    return sign;
}

/* A ray through an edge: to a + (b - a) j / 8, which floats and pairs hold exactly; or a last bit beside it. Every
 * third one is parallel to the edge, and comes from so close to 0 that a - o is three floats long. */
static void put_ray(float *ray, bool beside)
{
    static const int sizes[] = {-60, -12, 0, 12};
    int size = sizes[pair_pick(&state, 4)], j = pair_pick(&state, 9);
    bool parallel = pair_pick(&state, 3) == 0;
    for (int k = 0; k < 3; k++) {
        double a = (double)random_integer(&state, 1 << 20), b = (double)random_integer(&state, 1 << 20);
        double o = (double)random_integer(&state, 1 << 20) + (double)random_integer(&state, 1 << 20) * 0x1p-24;
        o = parallel ? o * 0x1p-34 : o;
        double r = parallel ? b - a : a + (b - a) * j / 8 - o;
        ray[k] = ldexpf((float)r, -20);
        ray[3 + k] = ldexpf((float)(r - (double)(float)r), -20);
        ray[6 + k] = ldexpf((float)o, size);
        ray[9 + k] = ldexpf((float)(o - (double)(float)o), size);
        ray[12 + k] = ldexpf((float)a, size);
        ray[15 + k] = ldexpf((float)b, size);
    }
    if (beside)
        ray[3 + pair_pick(&state, 3)] += pair_sign(&state) * 0x1p-46f;
}

static void signs_should_be_exact_even_on_an_edge(void)
{
    enum { RAYS = 4000 };
    static float in[RAYS * RAY_IN];
    static cl_int found[RAYS];
    int zeros = 0;
    for (int i = 0; i < RAYS; i++)
        put_ray(in + RAY_IN * i, i % 2);
    pair_kernels_run("signs", RAYS, in, sizeof in, found, sizeof found);
    for (int i = 0; i < RAYS; i++) {
        int sign = exact_sign(in + RAY_IN * i);
        TEST_ASSERT_EQUAL_INT(sign, found[i]);
        zeros += sign == 0;
    }
    TEST_ASSERT_TRUE(zeros > RAYS / 3 && zeros < RAYS * 2 / 3);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(signs_should_be_exact_even_on_an_edge);
    return UNITY_END();
}
