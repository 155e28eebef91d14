/* Compiled kernels kept from one run to the next: building them again, even from the compiler's own cache, takes longer
 * than tracing a small picture. One file per device, set of build options and kernel; a file that was made from other
 * sources, or is damaged, counts as none. Nothing here is an error: without a cache the kernels are compiled. */
#ifndef RECTRAY_KERNEL_CACHE_H
#define RECTRAY_KERNEL_CACHE_H

#include <stddef.h>
#include <stdint.h>

/* What a kept binary depends on, as hashes of 64 bits (in the manner of FNV-1a: Fowler, Noll, Vo 1991). */
typedef struct KernelCacheKey {
    uint64_t place;   /* device, driver, options, kernel: names the file */
    uint64_t sources; /* must be those that the file was made from */
} KernelCacheKey;

enum { KERNEL_CACHE_FILE_MAX = 64 << 20 }; /* bytes */

#define KERNEL_CACHE_HASH_START 14695981039346656037u

/* Continues a hash with a text and its final NUL. */
uint64_t kernel_cache_hash(uint64_t hash, const char *text);

/* The kept binary, *size bytes that the caller frees; NULL if there is none to be trusted. */
unsigned char *kernel_cache_load(KernelCacheKey key, size_t *size);

/* Keeps a binary in the folder that RECTRAY_CACHE_DIR names (empty: nowhere), else in rectray/ of XDG_CACHE_HOME, else
 * in .cache/rectray/ of HOME. The file appears whole or not at all. */
void kernel_cache_store(KernelCacheKey key, const unsigned char *binary, size_t size);

#endif
