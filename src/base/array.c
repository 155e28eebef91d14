/* Arrays that grow. */
#include "base/array.h"

#include <limits.h>
#include <stdint.h>
#include <stdlib.h>

void *array_grown(void *items, int count, int *capacity, size_t size, const char *what, Error *error)
{
    if (count < *capacity)
        return items;
    /* Half as much again: the sum of all copies stays linear, and at most a third of the memory is slack. */
    int64_t larger = *capacity + *capacity / 2 + 16;
    if (larger > INT_MAX)
        larger = INT_MAX;
    void *moved = count < INT_MAX && (uint64_t)larger <= SIZE_MAX / size ? realloc(items, (size_t)larger * size) : NULL;
    if (!moved)
        error_memory(error, what);
    else
        *capacity = (int)larger;
    return moved;
}

void *array_aligned(size_t bytes)
{
    void *memory = NULL;
    return posix_memalign(&memory, ARRAY_ALIGNMENT, bytes > 0 ? bytes : 1) == 0 ? memory : NULL;
}
