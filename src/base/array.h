/* Arrays that grow: geometrically, and with every size checked before it can overflow. */
#ifndef RECTRAY_ARRAY_H
#define RECTRAY_ARRAY_H

#include "base/error.h"

#include <stddef.h>

/* Makes room for one item more: returns the array, moved where needed, for `count` + 1 items of `size` bytes.
 * NULL with ERROR_SYSTEM when there is no memory, or no int, for them; the old array then stays as it was. */
void *array_grown(void *items, int count, int *capacity, size_t size, const char *what, Error *error);

enum { ARRAY_ALIGNMENT = 128 };

/* Memory for `bytes` at an address that suits any vector instruction and any device, uninitialised; free() frees it.
 * NULL without memory. */
void *array_aligned(size_t bytes);

#endif
