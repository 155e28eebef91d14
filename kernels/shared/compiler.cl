/* Hints to the compiler. */

/* A function that is called instead passes its vectors through memory: that pays where it is long and seldom needed. */
#define INLINE static inline __attribute__((always_inline))
#define NOINLINE static __attribute__((noinline))

/* A function that is long, or stands in several places, and runs once for a tile or a bundle, not for each face.
 * Inlined, it would be compiled in each place, and a compiler's time grows faster than the function it works on. With
 * these, with kernels that only call a function, and with all small functions INLINE, a first start takes 0.93 of its
 * time, with adaptive sampling 0.75. Tracing takes as long as before. */
#if LANES > 1
#define COMPILED_ONCE NOINLINE
#else
#define COMPILED_ONCE static
#endif

/* Loops that are not unrolled: their code is long. */
#define EACH_OF(p, count) __attribute__((opencl_unroll_hint(1))) for (int p = 0; p < (count); p++)

/* Scalars that are read from memory at each use. Left alone, the compiler makes a vector of each one before a loop.
 * Those are more than there are registers, and so it reads whole vectors from memory instead. */
#if LANES > 1
#define REREAD volatile
#else
#define REREAD
#endif

#ifndef __has_builtin
#define __has_builtin(x) 0
#endif

/* Only processors are asked for it: compilers that translate to SPIR-V know the builtin, but fail on its use. */
#if (defined(__x86_64__) || defined(__aarch64__)) && __has_builtin(__builtin_prefetch)
#define PREFETCHES 1
#endif

/* Asks for cache lines ahead of their use. Fetching nodes and faces when they are put on the stack took 12 and 16 %
 * from the time of city-1k and city-200k; fetching lists of children and records of faces, too, 9 % from that of
 * menger-4. */
INLINE void fetch(global const void *p, uint bytes)
{
#if defined(PREFETCHES) && LANES > 1
    for (uint i = 0; i < bytes; i += 64)
        __builtin_prefetch((const void *)((size_t)p + i));
#endif
}
