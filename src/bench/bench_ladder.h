/* The ladder: the scenes on which every figure in docs/ stands.
 * To add a rung: its line in the table in bench_ladder.c. */
#ifndef RECTRAY_BENCH_LADDER_H
#define RECTRAY_BENCH_LADDER_H

#include "bench/bench.h"

typedef struct BenchRung {
    const char *name;
    const char *path; /* from the repository's folder; NULL: generated */
    const char *kind;
    int size;
    bool small; /* bench error measures it, too */
} BenchRung;

extern const BenchRung bench_ladder[]; /* ends in a NULL name */

/* The lessons on rounding, on which exact arithmetic shows; ends in a NULL name. */
extern const BenchRung bench_lessons[];

/* The rung of that name, which must be there. */
const BenchRung *bench_rung_named(const char *name);

/* The rung as a scene, of the size that it says itself; a generated one is written into the folder. */
bool bench_rung(const BenchRung *rung, const BenchFolder *folder, BenchScene *scene, Error *error);

#endif
