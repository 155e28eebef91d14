/* What a measurement says of the machine that it was made on. */
#ifndef RECTRAY_BENCH_MACHINE_H
#define RECTRAY_BENCH_MACHINE_H

#include <stddef.h>

/* The processor's name as the system tells it; "unknown processor" where it does not. */
const char *bench_processor(char *name, size_t size);

/* How many programs wanted a core in the last minute, on average; 0 where the system does not tell. */
double bench_load(void);

#endif
