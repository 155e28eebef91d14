/* The text of an OpenCL program: a kernel file with all that it includes. */
#ifndef RECTRAY_OPENCL_SOURCES_H
#define RECTRAY_OPENCL_SOURCES_H

#include "base/error.h"

#include <stdbool.h>

#define OPENCL_PAIRS "pairs"

/* Returns the text of a kernel file and of all that it includes. The caller frees it.
 *   root   "tile/render.cl" and the like
 *   tree   "bvh", "kdtree" or "all_faces"
 *   arithmetic   "exact" or "textbook", of the plain kernel; OPENCL_PAIRS: exact, without double
 * Each #include is replaced by the file that it names, the first time; #line directives keep the places of errors.
 * `#include TREE` stands for the file packet/NAME.cl of the tree, `#include BEAM_TREE` for adaptive/beam_NAME.cl and
 * `#include PLAIN_TREE` for plain/NAME.cl, `#include GPU_TREE` for gpu/NAME.cl; `#include ARITHMETIC` for
 * plain/NAME_arithmetic.cl. `#include PLAIN` stands for plain.cl, `#include FOLLOW` for follow_plain.cl; with
 * OPENCL_PAIRS for pairs.cl and follow_pairs.cl.
 * The files are those inside the program, or those of the folder that the environment variable RECTRAY_KERNELS names.
 * NULL, with the error filled: a file cannot be read, there is none of that name, or files include one another. The
 * error names the line that includes the file. */
char *opencl_sources(const char *root, const char *tree, const char *arithmetic, Error *error);

#endif
