/* Looks at the head of a picture, at its checksums, and at where it ends. */
#define _XOPEN_SOURCE 700 /* stat */
#include "picture/image_whole.h"

#include <isa-l/crc.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

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

/* The signature and the first chunk of a PNG of RGB (PNG specification, 11.2.2). The file is left at that chunk. */
static bool has_head(FILE *file, int depth, int columns, int rows)
{
    static const unsigned char begin[16] = "\x89PNG\r\n\x1a\n\0\0\0\rIHDR";
    unsigned char head[33];
    return fread(head, 1, sizeof head, file) == sizeof head && memcmp(head, begin, sizeof begin) == 0 &&
           read_big(head + 16) == (uint32_t)columns && read_big(head + 20) == (uint32_t)rows && head[24] == depth &&
           head[25] == 2 && fseek(file, 8, SEEK_SET) == 0;
}

/* What is left of a chunk whose name has this checksum: so many bytes, and the checksum of name and bytes. */
static bool has_rest(FILE *file, uint32_t checksum, uint32_t length)
{
    unsigned char bytes[8192];
    for (size_t part; length > 0; length -= (uint32_t)part) {
        part = length < sizeof bytes ? length : sizeof bytes;
        if (fread(bytes, 1, part, file) != part)
            return false;
        checksum = crc32_gzip_refl(checksum, bytes, part);
    }
    return fread(bytes, 1, 4, file) == 4 && read_big(bytes) == checksum;
}

/* The chunks: a length, a name, so many bytes, four bytes of checksum. One has pixels; the last is IEND, at the end. */
static bool has_chunks(FILE *file, long size)
{
    unsigned char chunk[8];
    bool has_pixels = false;
    while (fread(chunk, 1, sizeof chunk, file) == sizeof chunk &&
           has_rest(file, crc32_gzip_refl(0, chunk + 4, 4), read_big(chunk))) {
        if (memcmp(chunk + 4, "IEND", 4) == 0)
            return has_pixels && ftell(file) == size;
        has_pixels = has_pixels || memcmp(chunk + 4, "IDAT", 4) == 0;
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
    struct stat status;
    FILE *file = stat(path, &status) == 0 && S_ISREG(status.st_mode) ? fopen(path, "rb") : NULL; /* a pipe would wait */
    if (!file)
        return false;
    long size = size_of(file);
    bool whole = kind.format == IMAGE_PNG ? has_head(file, kind.depth, columns, rows) && has_chunks(file, size)
                                          : is_map(file, size, kind, columns, rows);
    fclose(file);
    return whole;
}
