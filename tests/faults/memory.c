/* A memory that fails, for LD_PRELOAD: counts what is allocated between the program's main and its return, lets some of
 * it fail, and tells what was not given back. From the environment:
 *   FAULT_AT=N        the N-th allocation fails, from 1; without it none
 *   FAULT_ON=1        and every one after it
 *   FAULT_CALLER=own  only what the program's own code asks for counts; what its libraries ask for never fails
 *   FAULT_LOG=FILE    gets one line in the end: "ALLOCATIONS LEFT", LEFT being how many blocks nobody freed
 * The buffer that the C library would allocate for stdout, and never free, is given to it. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <link.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static atomic_long allocations, left;
static atomic_bool running; /* main is */
static long fault_at;
static bool fault_on, own_only;
static uintptr_t own_begin, own_end; /* the program's code */

static void *(*real_malloc)(size_t);
static void *(*real_calloc)(size_t, size_t);
static void *(*real_realloc)(void *, size_t);
static int (*real_memalign)(void **, size_t, size_t);
static void (*real_free)(void *);

static void find_real(void)
{
    *(void **)&real_calloc = dlsym(RTLD_NEXT, "calloc");
    *(void **)&real_realloc = dlsym(RTLD_NEXT, "realloc");
    *(void **)&real_memalign = dlsym(RTLD_NEXT, "posix_memalign");
    *(void **)&real_free = dlsym(RTLD_NEXT, "free");
    *(void **)&real_malloc = dlsym(RTLD_NEXT, "malloc");
}

/* Whether the allocation that this caller asks for is to fail. */
static bool fails(const void *caller)
{
    if (!atomic_load(&running))
        return false;
    uintptr_t place = (uintptr_t)caller;
    if (own_only && (place < own_begin || place >= own_end))
        return false;
    long number = atomic_fetch_add(&allocations, 1) + 1;
    if (fault_at == 0 || (fault_on ? number < fault_at : number != fault_at))
        return false;
    errno = ENOMEM;
    return true;
}

static void *noted(void *block)
{
    if (block && atomic_load(&running))
        atomic_fetch_add(&left, 1);
    return block;
}

void *malloc(size_t size)
{
    if (!real_malloc)
        find_real();
    return fails(__builtin_return_address(0)) ? NULL : noted(real_malloc(size));
}

void *calloc(size_t count, size_t size)
{
    if (!real_malloc)
        find_real();
    return fails(__builtin_return_address(0)) ? NULL : noted(real_calloc(count, size));
}

void *realloc(void *block, size_t size)
{
    if (!real_malloc)
        find_real();
    if (fails(__builtin_return_address(0)))
        return NULL;
    void *moved = real_realloc(block, size);
    return block ? moved : noted(moved);
}

int posix_memalign(void **block, size_t alignment, size_t size)
{
    if (!real_malloc)
        find_real();
    if (fails(__builtin_return_address(0)))
        return ENOMEM;
    int status = real_memalign(block, alignment, size);
    if (status == 0)
        noted(*block);
    return status;
}

void free(void *block)
{
    if (!real_malloc)
        find_real();
    if (block && atomic_load(&running))
        atomic_fetch_sub(&left, 1);
    real_free(block);
}

/* The program itself is the first object that the linker tells of. */
static int find_own(struct dl_phdr_info *info, size_t size, void *data)
{
    (void)size;
    (void)data;
    for (int i = 0; i < info->dlpi_phnum; i++)
        if (info->dlpi_phdr[i].p_type == PT_LOAD && (info->dlpi_phdr[i].p_flags & PF_X)) {
            own_begin = info->dlpi_addr + info->dlpi_phdr[i].p_vaddr;
            own_end = own_begin + info->dlpi_phdr[i].p_memsz;
        }
    return 1;
}

static int (*real_main)(int, char **, char **);

static int watched_main(int argc, char **argv, char **environment)
{
    static char output_buffer[1 << 16];
    const char *at = getenv("FAULT_AT"), *on = getenv("FAULT_ON"), *caller = getenv("FAULT_CALLER");
    const char *log = getenv("FAULT_LOG");
    fault_at = at ? atol(at) : 0;
    fault_on = on && on[0] == '1';
    own_only = caller && strcmp(caller, "own") == 0;
    dl_iterate_phdr(find_own, NULL);
    setvbuf(stdout, output_buffer, _IOFBF, sizeof output_buffer);
    atomic_store(&running, true);
    int status = real_main(argc, argv, environment);
    atomic_store(&running, false);
    FILE *file = log ? fopen(log, "w") : NULL;
    if (file) {
        fprintf(file, "%ld %ld\n", atomic_load(&allocations), atomic_load(&left));
        fclose(file);
    }
    return status;
}

/* The C library's way into the program, gone by way of watched_main. */
int __libc_start_main(int (*main)(int, char **, char **), int argc, char **argv, void (*init)(void), void (*fini)(void),
                      void (*rtld_fini)(void), void *stack_end)
{
    int (*start)(int (*)(int, char **, char **), int, char **, void (*)(void), void (*)(void), void (*)(void), void *);
    *(void **)&start = dlsym(RTLD_NEXT, "__libc_start_main");
    real_main = main;
    return start(watched_main, argc, argv, init, fini, rtld_fini, stack_end);
}
