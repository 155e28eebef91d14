/* Numbers in binary files. */
#include "reader/bytes.h"

#include <stdint.h>
#include <string.h>

int bytes_size(BytesType type)
{
    static const int sizes[BYTES_TYPES] = {1, 1, 2, 2, 4, 4, 4, 8, 8, 8};
    return sizes[type];
}

double bytes_value(const char *bytes, BytesType type, bool big_endian)
{
    uint64_t bits = 0;
    int size = bytes_size(type);
    for (int i = 0; i < size; i++)
        bits = bits << 8 | (unsigned char)bytes[big_endian ? i : size - 1 - i];
    uint32_t half = (uint32_t)bits;
    float single;
    double value;
    switch (type) {
    case BYTES_INT8:
        return (int8_t)bits;
    case BYTES_INT16:
        return (int16_t)bits;
    case BYTES_INT32:
        return (int32_t)bits;
    case BYTES_FLOAT32:
        memcpy(&single, &half, sizeof single);
        return (double)single;
    case BYTES_FLOAT64:
        memcpy(&value, &bits, sizeof value);
        return value;
    case BYTES_INT64:
        return (double)(int64_t)bits;
    default:
        return (double)bits;
    }
}
