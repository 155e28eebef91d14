/* The OpenCL kernels inside the program, so that it runs from
 * any directory. kernels/embed.sh writes the definitions. */
#ifndef RECTRAY_KERNEL_SOURCES_H
#define RECTRAY_KERNEL_SOURCES_H

#include <stddef.h>

typedef struct KernelSource {
    const char *name; /* its path below kernels/ */
    const char *text; /* ends in a NUL that length does not count */
    size_t length;
} KernelSource;

extern const KernelSource kernel_sources[];
extern const int kernel_source_count;

#endif
