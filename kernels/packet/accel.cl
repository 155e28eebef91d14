/* How faces are found: the tree of a scene, as the host has built it. */
#include "shared/precision.cl"

/* How faces are found, a build option: all are asked, or those in the leaves of a tree. */
#define ACCEL_NONE 0
#define ACCEL_BVH 1
#define ACCEL_KDTREE 2

#define REACH_ALL ((real)1e30f)

/* Of a search that is not cut. */
#define NO_BUDGET 0xffffffffu
