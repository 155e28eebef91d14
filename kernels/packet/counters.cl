/* What a work-item counts, and how the counts of all come together. */
#include "shared/layout.h"

typedef struct Counters {
    uint kinds[COUNTER_KINDS];
} Counters;

static void add_counters(volatile global uint *totals, const Counters *counters)
{
    /* A processor takes some work-items in a row: they add to the same copy, which stays in its cache. */
    size_t copy = get_global_id(0) / (LANES > 1 ? 4 : 1) % COUNTER_STRIPES;
    volatile global uint *stripe = totals + copy * COUNTER_STRIDE;
    for (int kind = 0; kind < COUNTER_KINDS; kind++)
        if (counters->kinds[kind])
            atomic_add(stripe + kind, counters->kinds[kind]);
}
