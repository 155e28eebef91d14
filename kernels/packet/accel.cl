/* How faces are found: all of them are tested, or those in the leaves of a tree that the rays meet. */
#include "shared/precision.cl"

/* The values of the build option ACCEL. */
#define ACCEL_NONE 0
#define ACCEL_BVH 1
#define ACCEL_KDTREE 2

/* The reach of rays that have no hit yet. */
#define REACH_ALL ((real)1e30f)

/* The budget of a search that is not interrupted. */
#define NO_BUDGET 0xffffffffu
