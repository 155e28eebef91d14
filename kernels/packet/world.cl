/* The scene as a kernel gets it, and what its work-item counts. Nearly every function takes a pointer to it. */
#include "shared/layout.h"
#include "shared/precision.cl"

/* The host passes the sizes of its own shared structs. If they differ, an array of negative length stops the build. */
typedef char FaceRecordHasTheHostsSize[sizeof(FaceRecord) == FACE_RECORD_BYTES ? 1 : -1];
typedef char ParametersHasTheHostsSize[sizeof(Parameters) == PARAMETERS_BYTES ? 1 : -1];

typedef struct World {
    constant const Parameters *parameters;
    global const FaceRecord *faces;
    global const real *face_rows; /* face_count rows of FACE_REALS */
    global const wide *planes;    /* face_count rows of PLANE_REALS */
    int face_count;
    global const real *materials, *lights, *view; /* NULL in `cast` */
    global const float *tree_floats; /* the tree: bvh.cl and kdtree.cl say what is in it */
    global const int *tree_ints;
    int item;       /* the number of the work-item */
    uint *counters; /* COUNTER_KINDS of them, this work-item's own */
} World;

/* Adds the counters of the work-item to those of all. */
static void add_counters(volatile global uint *totals, const World *world)
{
    /* A processor takes some work-items in a row. They add to the same copy, which stays in its cache. */
    size_t copy = (size_t)world->item / (LANES > 1 ? 4 : 1) % COUNTER_STRIPES;
    volatile global uint *stripe = totals + copy * COUNTER_STRIDE;
    for (int kind = 0; kind < COUNTER_KINDS; kind++)
        if (world->counters[kind])
            atomic_add(stripe + kind, world->counters[kind]);
}
