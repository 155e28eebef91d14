#include "support/pair_kernels.h"

#include "opencl/opencl_sources.h"
#include "support/xorshift.h"

#include "unity.h"

#include <CL/cl.h>
#include <stdlib.h>
#include <string.h>

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

static void ok(cl_int status)
{
    TEST_ASSERT_EQUAL_INT(CL_SUCCESS, status);
}

static void build(cl_device_id device, const char *const *texts, cl_uint count)
{
    cl_int status;
    char log[8192] = "";
    program = clCreateProgramWithSource(context, count, (const char **)(size_t)texts, NULL, &status);
    ok(status);
    status = clBuildProgram(program, 1, &device, "-DLANES=1 -DREAL_DOUBLE=0 -DHAS_DOUBLE=0", NULL, NULL);
    clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, sizeof log - 1, log, NULL);
    TEST_ASSERT_EQUAL_INT_MESSAGE(CL_SUCCESS, status, log);
}

/* Puts 2 ulp onto each quotient of the text: "a.high / b.high" becomes "two_ulp(a.high / b.high)". Returns a copy. */
static char *with_poor_division(const char *text)
{
    static const char *const quotients[] = {"a.high / b.high", "rest.high / b.high"};
    char *poor = calloc(strlen(text) + 64, 1);
    const char *from = text;
    for (int i = 0; i < 2; i++) {
        const char *at = strstr(from, quotients[i]);
        TEST_ASSERT_NOT_NULL_MESSAGE(at, quotients[i]);
        strncat(poor, from, (size_t)(at - from));
        strcat(strcat(strcat(poor, "two_ulp("), quotients[i]), ")");
        from = at + strlen(quotients[i]);
    }
    return strcat(poor, from);
}

void pair_kernels_open(bool poor_division)
{
    static const char two_ulp[] = "float two_ulp(float x)\n{\n    return as_float(as_int(x) + 2);\n}\n";
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
    char *text = opencl_sources("pairs/signs.cl", "all_faces", OPENCL_PAIRS, &error);
    TEST_ASSERT_NOT_NULL_MESSAGE(text, error.text);
    char *poor = poor_division ? with_poor_division(text) : NULL;
    build(device, (const char *const[]){two_ulp, poor ? poor : text, kernels}, 3);
    free(poor);
    free(text);
}

void pair_kernels_close(void)
{
    clReleaseProgram(program);
    clReleaseCommandQueue(queue);
    clReleaseContext(context);
}

void pair_kernels_run(const char *name, size_t cases, const float *in, size_t in_bytes, void *out, size_t out_bytes)
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

void pair_set(mpq_t value, float high, float low)
{
    mpq_t rest;
    mpq_init(rest);
    mpq_set_d(value, (double)high);
    mpq_set_d(rest, (double)low);
    mpq_add(value, value, rest);
    mpq_clear(rest);
}

int pair_pick(uint64_t *state, int count)
{
    return (int)(random_next(state) >> 33) % count;
}

float pair_sign(uint64_t *state)
{
    return pair_pick(state, 2) ? 1 : -1;
}
