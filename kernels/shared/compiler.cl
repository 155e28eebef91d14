/* What we tell the compiler beside the code itself. */

/* Some functions the compiler would rather call; a call passes its vectors through memory. */
#define INLINE static inline __attribute__((always_inline))
#define NOINLINE static __attribute__((noinline))

/* What is read from memory at every use: the compiler would make a vector of each value before a loop, more than there are
 * registers, and read those from memory instead. */
#if LANES > 1
#define REREAD volatile
#else
#define REREAD
#endif

#ifndef __has_builtin
#define __has_builtin(x) 0
#endif

/* Asks for cache lines ahead of their use. */
INLINE void fetch(global const void *p, uint bytes)
{
#if __has_builtin(__builtin_prefetch) && LANES > 1
    for (uint i = 0; i < bytes; i += 64)
        __builtin_prefetch((const void *)((size_t)p + i));
#endif
}
