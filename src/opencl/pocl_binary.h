/* Kept binaries of PoCL without what a warm start does not need.
 *
 * A binary of PoCL holds the kernel twice: as machine code, and in the compiler's own form, `program.bc`, from which
 * PoCL would compile more machine code. PoCL parses that form at each start, which takes as long as all the rest of a
 * small picture. A trimmed binary has a file of one byte in its place.
 *
 * PoCL aborts the process if it misses the form after all. So a binary is trimmed only where the driver is one that was
 * tried, and each field has the value that is known to work; and a program that was built from a trimmed binary is used
 * only if PoCL has unpacked its machine code. In all other cases the whole binary is used. */
#ifndef RECTRAY_POCL_BINARY_H
#define RECTRAY_POCL_BINARY_H

#include <stdbool.h>
#include <stddef.h>

enum { POCL_CODE_PATH_BYTES = 256 };

typedef struct PoclBinary {
    unsigned char *bytes; /* the caller frees them */
    size_t size;
    char code_path[POCL_CODE_PATH_BYTES]; /* where PoCL unpacks the machine code, below the folder of its own cache */
    size_t code_size;                     /* the code is the last so many bytes */
} PoclBinary;

/* Is that a driver whose binaries may be trimmed, and is PoCL not told to work in another way by its environment? */
bool pocl_binary_is_known(const char *platform, const char *driver);

/* Trims a binary. False: it is not exactly of the known form, or memory is short; then there is nothing to free. */
bool pocl_binary_trim(const unsigned char *whole, size_t size, PoclBinary *trimmed);

/* Puts the machine code of a trimmed binary where PoCL would unpack it, whole or not at all: PoCL leaves a file that it
 * finds there, but two processes of PoCL that unpack at once write into each other's file. */
bool pocl_binary_unpack(const PoclBinary *trimmed);

/* After PoCL has built the program: is the machine code there, and is that the folder to which PoCL has unpacked? */
bool pocl_binary_is_unpacked(const PoclBinary *trimmed);

#endif
