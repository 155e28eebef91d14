/* Numbers in binary files, of either order of bytes. */
#ifndef RECTRAY_BYTES_H
#define RECTRAY_BYTES_H

#include <stdbool.h>

typedef enum BytesType {
    BYTES_INT8,
    BYTES_UINT8,
    BYTES_INT16,
    BYTES_UINT16,
    BYTES_INT32,
    BYTES_UINT32,
    BYTES_FLOAT32,
    BYTES_FLOAT64,
    BYTES_INT64,
    BYTES_UINT64,
    BYTES_TYPES
} BytesType;

int bytes_size(BytesType type);

/* The number that begins there. */
double bytes_value(const char *bytes, BytesType type, bool big_endian);

#endif
