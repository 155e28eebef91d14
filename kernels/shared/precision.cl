/* The two types of numbers. Most arithmetic is done in `real`, float or double as the build option REAL_DOUBLE says.
 * Rays, t and hit points are `wide` in both precisions: double wherever the device has it (HAS_DOUBLE).
 * Textbook arithmetic knows one precision: there the host says HAS_DOUBLE=0, so that wide is real. */

#pragma OPENCL FP_CONTRACT OFF /* a * b + c rounds twice, as on the host; fma() stands where we want one rounding */

#if REAL_DOUBLE || HAS_DOUBLE
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
typedef double wide;
typedef double3 wide3;
typedef double4 wide4;
#define WIDE_ROUNDING 0x1p-53
#define WIDE_MIN DBL_MIN
#define WIDE_MAX DBL_MAX
#define PAIRS_LIMIT 0x1p24 /* a value below so many times its error bound has fewer than 24 bits that are sure */
#else
typedef float wide;
typedef float3 wide3;
typedef float4 wide4;
#define WIDE_ROUNDING 0x1p-24f
#define WIDE_MIN FLT_MIN
#define WIDE_MAX FLT_MAX
#define PAIRS_LIMIT 0x1p6f
#endif

/* REAL(0.1) is that number as a real. A plain 0.1 is a double, which a device without double does not know. */
#if REAL_DOUBLE
#define REAL(number) (number)
typedef double real;
typedef double2 real2;
typedef double3 real3;
typedef double4 real4;
typedef double8 real8;
#define REAL_ROUNDING 0x1p-53
#define REAL_FLOOR 0x1p-900
#define SHIFT_FLOOR 0x1p-100
#else
#define REAL(number) (number##f)
typedef float real;
typedef float2 real2;
typedef float3 real3;
typedef float4 real4;
typedef float8 real8;
#define REAL_ROUNDING 0x1p-24f
#define REAL_FLOOR 0x1p-120f
#define SHIFT_FLOOR 0x1p-60f
#endif

#if REAL_DOUBLE || !HAS_DOUBLE
#define TO_REAL4(x) (x)
#else
#define TO_REAL4(x) convert_float4(x)
#endif
