/* Looks at the head of a picture, and at where it ends. */
#include "picture/image_whole.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

static uint32_t read_big(const unsigned char bytes[4])
{
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

/* The size of an open file, or -1. It is left at its beginning. */
static long size_of(FILE *file)
{
    long size = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
    rewind(file);
    return size;
}

/* The signature and the first chunk of a PNG of RGB (PNG specification, 11.2.2). */
static bool has_head(FILE *file, int depth, int columns, int rows)
{
    static const unsigned char begin[16] = "\x89PNG\r\n\x1a\n\0\0\0\rIHDR";
    unsigned char head[33];
    return fread(head, 1, sizeof head, file) == sizeof head && memcmp(head, begin, sizeof begin) == 0 &&
           read_big(head + 16) == (uint32_t)columns && read_big(head + 20) == (uint32_t)rows && head[24] == depth &&
           head[25] == 2;
}

/* The other chunks: a length, a name, so many bytes, four bytes of checksum. The last one is IEND, at the end. */
static bool has_chunks(FILE *file, long size)
{
    unsigned char chunk[8];
    while (fread(chunk, 1, sizeof chunk, file) == sizeof chunk) {
        long end = ftell(file) + (long)read_big(chunk) + 4;
        if (memcmp(chunk + 4, "IEND", 4) == 0)
            return end == size;
        if (end > size || fseek(file, end, SEEK_SET) != 0)
            return false;
    }
    return false;
}

/* The head that image_write.c and image_linear.c write, and the pixels. */
static bool is_map(FILE *file, long size, ImageKind kind, int columns, int rows)
{
    char wanted[64], head[64];
    bool floats = kind.format == IMAGE_PFM;
    size_t length = (size_t)snprintf(wanted, sizeof wanted, "P%c\n%d %d\n%s\n", floats ? 'F' : '6', columns, rows,
                                     floats             ? "-1.0"
                                     : kind.depth == 16 ? "65535"
                                                        : "255");
    long value_bytes = floats ? 4 : kind.depth / 8;
    return size == (long)length + 3 * value_bytes * columns * rows && fread(head, 1, length, file) == length &&
           memcmp(head, wanted, length) == 0;
}

bool image_is_whole(const char *path, ImageKind kind, int columns, int rows)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        return false;
    long size = size_of(file);
    bool whole = kind.format == IMAGE_PNG ? has_head(file, kind.depth, columns, rows) && has_chunks(file, size)
                                          : is_map(file, size, kind, columns, rows);
    fclose(file);
    return whole;
}
