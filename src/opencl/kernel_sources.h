/* The OpenCL kernels inside the program, so that it runs from any directory.
 * The Makefile makes the definitions from kernels/, in the order of its variable KERNELS, which is the order in
 * which the texts are to be compiled. */
#ifndef RECTRAY_KERNEL_SOURCES_H
#define RECTRAY_KERNEL_SOURCES_H

#include <stddef.h>

typedef struct KernelSource {
    const char *name; /* the file's name, without its folder */
    const char *text; /* ends in a NUL that length does not count */
    size_t length;
} KernelSource;

extern const KernelSource kernel_sources[];
extern const int kernel_source_count;

#endif
