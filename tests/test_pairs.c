/* Pairs of floats, which stand for doubles on devices without them: kernels/pairs/ on the device here, against rational
 * numbers. Each bound is the one that the kernel's file states. The hard cases: sums that cancel, low parts of half an
 * ulp, numbers close to the largest and the smallest that a product may have; rays through an edge and just past it. */
#include "opencl/opencl_sources.h"

#include "unity.h"

#include <CL/cl.h>
#include <gmp.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "support/xorshift.h"

enum { CASES = 20000, PAIR_IN = 4, PAIR_OUT = 6, RAY_IN = 18 };

static const char kernels[] =
    "kernel void arithmetic(global const float *in, global float *out)\n"
    "{\n"
    "    int i = (int)get_global_id(0);\n"
    "    Pair a = {in[4 * i], in[4 * i + 1]}, b = {in[4 * i + 2], in[4 * i + 3]};\n"
    "    Pair results[3] = {pair_sum(a, b), pair_product(a, b), pair_quotient(a, b)};\n"
    "    for (int k = 0; k < 3; k++) {\n"
    "        out[6 * i + 2 * k] = results[k].high;\n"
    "        out[6 * i + 2 * k + 1] = results[k].low;\n"
    "    }\n"
    "}\n"
    "INLINE PairVec ray_at(global const float *a)\n"
    "{\n"
    "    return pairs_from((float3)(a[0], a[1], a[2]), (float3)(a[3], a[4], a[5]));\n"
    "}\n"
    "kernel void signs(global const float *in, global int *out)\n"
    "{\n"
    "    int i = (int)get_global_id(0);\n"
    "    global const float *ray = in + 18 * i;\n"
    "    PairVec r = ray_at(ray), o = ray_at(ray + 6);\n"
    "    PairVec p = pairs_from(vload3(0, ray + 12), (float3)0), q = pairs_from(vload3(0, ray + 15), (float3)0);\n"
    "    Difference a = exactly_between(p, o), b = exactly_between(q, o);\n"
    "    out[i] = pair_determinant_sign(&r, &a, &b);\n"
    "}\n";

static cl_context context;
static cl_command_queue queue;
static cl_program program;
static uint64_t state;

static void ok(cl_int status)
{
    TEST_ASSERT_EQUAL_INT(CL_SUCCESS, status);
}

static void open_device(void)
{
    cl_platform_id platform;
    cl_device_id device;
    cl_int status;
    Error error = {.kind = ERROR_NONE};
    ok(clGetPlatformIDs(1, &platform, NULL));
    ok(clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &device, NULL));
    context = clCreateContext(NULL, 1, &device, NULL, NULL, &status);
    ok(status);
    queue = clCreateCommandQueue(context, device, 0, &status);
    ok(status);
    char *arithmetic = opencl_sources("pairs/signs.cl", "all_faces", OPENCL_PAIRS, &error);
    TEST_ASSERT_NOT_NULL_MESSAGE(arithmetic, error.text);
    const char *texts[] = {arithmetic, kernels};
    program = clCreateProgramWithSource(context, 2, texts, NULL, &status);
    ok(status);
    status = clBuildProgram(program, 1, &device, "-DLANES=1 -DREAL_DOUBLE=0 -DHAS_DOUBLE=0", NULL, NULL);
    free(arithmetic);
    char log[8192] = "";
    clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, sizeof log - 1, log, NULL);
    TEST_ASSERT_EQUAL_INT_MESSAGE(CL_SUCCESS, status, log);
}

/* Runs a kernel on so many cases. */
static void run(const char *name, size_t cases, const float *in, size_t in_bytes, void *out, size_t out_bytes)
{
    cl_int status;
    cl_mem from =
        clCreateBuffer(context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, in_bytes, (void *)(size_t)in, &status);
    ok(status);
    cl_mem to = clCreateBuffer(context, CL_MEM_WRITE_ONLY, out_bytes, NULL, &status);
    ok(status);
    cl_kernel kernel = clCreateKernel(program, name, &status);
    ok(status);
    ok(clSetKernelArg(kernel, 0, sizeof from, &from));
    ok(clSetKernelArg(kernel, 1, sizeof to, &to));
    ok(clEnqueueNDRangeKernel(queue, kernel, 1, NULL, &cases, NULL, 0, NULL, NULL));
    ok(clEnqueueReadBuffer(queue, to, CL_TRUE, 0, out_bytes, out, 0, NULL, NULL));
    clReleaseKernel(kernel);
    clReleaseMemObject(from);
    clReleaseMemObject(to);
}

void setUp(void)
{
    state = 20261130;
    if (!program)
        open_device();
}
void tearDown(void) {}

/* --- Cases --- */

static int pick(int count)
{
    return (int)(random_next(&state) >> 33) % count;
}

static float sign(void)
{
    return pick(2) ? 1 : -1;
}

/* A float of 24 random bits, of that size. */
static float random_float(int exponent)
{
    int bits = (int)(random_next(&state) >> 40) | 1 << 23;
    return sign() * ldexpf((float)bits, exponent - 23);
}

/* What rounding took from a number: nothing, half an ulp, nearly half of one, or anything below. */
static float random_low(float high)
{
    int exponent;
    frexpf(high, &exponent);
    float half_ulp = ldexpf(1, exponent - 25);
    bool is_power = fabsf(high) == ldexpf(1, exponent - 1);
    if (is_power) /* below a power of two the next float is half as far */
        half_ulp /= 2;
    bool even = fmodf(ldexpf(fabsf(high), 24 - exponent), 2) == 0;
    switch (pick(5)) {
    case 0:
        return 0;
    case 1:
        return even ? sign() * half_ulp : 0;
    case 2:
        return sign() * nextafterf(half_ulp, 0);
    case 3:
        return random_float(exponent - 27 - pick(40));
    default:
        return random_float(exponent - 27);
    }
}

static void put_pair(float *pair, float high)
{
    pair[0] = high;
    pair[1] = random_low(high);
}

/* Two numbers that a sum, a product or a quotient finds hard. Their product is above 2^-96: its last bit is a float. */
static void put_case(float *in)
{
    put_pair(in, random_float(pick(90) - 45));
    switch (pick(6)) {
    case 0: /* the sum cancels, but for the low parts */
        put_pair(in + 2, -in[0]);
        break;
    case 1: /* the same, an ulp beside it */
        put_pair(in + 2, -nextafterf(in[0], sign() * INFINITY));
        break;
    case 2: /* one is far below the other */
        put_pair(in, random_float(pick(90) - 32));
        put_pair(in + 2, in[0] * ldexpf(1, -22 - pick(8)));
        break;
    case 3: /* close to the largest number */
        put_pair(in, random_float(62));
        put_pair(in + 2, random_float(63));
        break;
    case 4: /* powers of two */
        put_pair(in, sign() * ldexpf(1, pick(60) - 30));
        put_pair(in + 2, sign() * ldexpf(1, pick(60) - 30));
        break;
    default:
        put_pair(in + 2, random_float(pick(90) - 45));
    }
}

/* --- Rational numbers --- */

static void set_pair(mpq_t value, const float *pair)
{
    mpq_t low;
    mpq_init(low);
    mpq_set_d(value, (double)pair[0]);
    mpq_set_d(low, (double)pair[1]);
    mpq_add(value, value, low);
    mpq_clear(low);
}

/* |found - exact| / |exact| in units of u^2 = 2^-48. */
static double error_of(const float *found, mpq_t exact)
{
    mpq_t value;
    mpq_init(value);
    set_pair(value, found);
    mpq_sub(value, value, exact);
    if (mpq_sgn(exact) != 0)
        mpq_div(value, value, exact);
    double error = fabs(mpq_get_d(value)) * 0x1p48;
    mpq_clear(value);
    return error;
}

static void arithmetic_should_meet_its_bounds(void)
{
    static const char *const names[] = {"sum", "product", "quotient"};
    static const double bounds[] = {3.001, 5.001, 64};
    static float in[CASES * PAIR_IN], out[CASES * PAIR_OUT];
    double worst[3] = {0};
    for (int i = 0; i < CASES; i++)
        put_case(in + PAIR_IN * i);
    run("arithmetic", CASES, in, sizeof in, out, sizeof out);
    mpq_t a, b, exact;
    mpq_inits(a, b, exact, NULL);
    for (int i = 0; i < CASES; i++) {
        set_pair(a, in + PAIR_IN * i);
        set_pair(b, in + PAIR_IN * i + 2);
        for (int k = 0; k < 3; k++) {
            const float *found = out + PAIR_OUT * i + 2 * k;
            (k == 0 ? mpq_add : k == 1 ? mpq_mul : mpq_div)(exact, a, b);
            worst[k] = fmax(worst[k], error_of(found, exact));
            TEST_ASSERT_TRUE_MESSAGE(found[0] + found[1] == found[0], names[k]);
        }
    }
    mpq_clears(a, b, exact, NULL);
    for (int k = 0; k < 3; k++) {
        printf("%s %g\n", names[k], worst[k]);
        TEST_ASSERT_TRUE_MESSAGE(worst[k] <= bounds[k], names[k]);
        /* The cases are hard: floats alone, or pairs whose low parts are not added up, are farther off. */
        TEST_ASSERT_TRUE_MESSAGE(worst[k] > 1, names[k]);
    }
}

/* --- Signs --- */

/* det(r, a - o, b - o) in rational numbers. ray: as the kernel takes it. */
static int exact_sign(const float *ray)
{
    mpq_t r[3], o[3], a[3], b[3], sum, product;
    mpq_inits(sum, product, NULL);
    for (int k = 0; k < 3; k++) {
        mpq_inits(r[k], o[k], a[k], b[k], NULL);
        set_pair(r[k], (float[]){ray[k], ray[3 + k]});
        set_pair(o[k], (float[]){ray[6 + k], ray[9 + k]});
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
    int size = pick(3) * 12 - 12, j = pick(9);
    bool parallel = pick(3) == 0;
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
        ray[3 + pick(3)] += sign() * 0x1p-46f;
}

static void signs_should_be_exact_even_on_an_edge(void)
{
    enum { RAYS = 4000 };
    static float in[RAYS * RAY_IN];
    static cl_int found[RAYS];
    int zeros = 0;
    for (int i = 0; i < RAYS; i++)
        put_ray(in + RAY_IN * i, i % 2);
    run("signs", RAYS, in, sizeof in, found, sizeof found);
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
    RUN_TEST(arithmetic_should_meet_its_bounds);
    RUN_TEST(signs_should_be_exact_even_on_an_edge);
    clReleaseProgram(program);
    clReleaseCommandQueue(queue);
    clReleaseContext(context);
    return UNITY_END();
}
