/* Reads and writes portable float maps. A PFM is "PF", a line of columns and rows, a line with a scale whose sign says
 * the order of bytes, and then the rows from the bottom to the top. */
#include "picture/image_linear.h"

#include "base/text.h"
#include "picture/image.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

unsigned image_to_16_bits(double value)
{
    double clamped = value > 0 ? value < 1 ? value : 1 : 0; /* NaN becomes 0 */
    return (unsigned)floor(65535 * clamped + 0.5);
}

bool image_is_pfm(const char *path)
{
    char begin[3] = "";
    if (text_is_stream(path))
        return false;
    FILE *file = fopen(path, "rb");
    if (!file)
        return false;
    bool is = fread(begin, 1, 3, file) == 3 && memcmp(begin, "PF\n", 3) == 0;
    fclose(file);
    return is;
}

/* The bits of a float in four bytes, the least significant first or last. */
static float float_of(const unsigned char bytes[4], bool least_first)
{
    uint32_t bits = 0;
    for (int i = 0; i < 4; i++)
        bits |= (uint32_t)bytes[least_first ? i : 3 - i] << 8 * i;
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static void put_float(double value, unsigned char bytes[4])
{
    float rounded = (float)value;
    uint32_t bits;
    memcpy(&bits, &rounded, sizeof bits);
    for (int i = 0; i < 4; i++)
        bytes[i] = (unsigned char)(bits >> 8 * i);
}

/* --- Reading --- */

static bool read_rows(LinearImage *image, FILE *file, bool least_first)
{
    size_t stride = (size_t)image->columns * 3;
    for (int row = image->rows - 1; row >= 0; row--)
        for (size_t i = 0; i < stride; i++) {
            unsigned char bytes[4];
            if (fread(bytes, 1, 4, file) != 4)
                return false;
            image->rgb[(size_t)row * stride + i] = float_of(bytes, least_first);
        }
    return true;
}

static bool read_file(LinearImage *image, FILE *file, const char *path, Error *error)
{
    float scale;
    if (fscanf(file, "PF %5d %5d %f", &image->columns, &image->rows, &scale) != 3 || fgetc(file) == EOF || scale == 0 ||
        image->columns < 1 || image->rows < 1)
        return error_set(error, ERROR_INPUT, "%s: damaged PFM: its head is not \"PF\", columns, rows and a scale",
                         path);
    if (image->columns > IMAGE_MAX_SIDE || image->rows > IMAGE_MAX_SIDE)
        return error_set(error, ERROR_INPUT, "%s: %d x %d pixels are too many; %d are allowed on a side", path,
                         image->columns, image->rows, IMAGE_MAX_SIDE);
    image->rgb = malloc((size_t)image->columns * (size_t)image->rows * 3 * sizeof *image->rgb);
    if (!image->rgb)
        return error_memory(error, "a picture");
    if (read_rows(image, file, scale < 0))
        return true;
    return ferror(file) ? text_fail_errno(path, "cannot be read", error)
                        : error_set(error, ERROR_INPUT, "%s: damaged PFM: it ends too early", path);
}

bool image_linear_read(LinearImage *image, const char *path, Error *error)
{
    *image = (LinearImage){0};
    FILE *file = fopen(path, "rb");
    if (!file)
        return text_fail_errno(path, "cannot be read", error);
    bool done = read_file(image, file, path, error);
    fclose(file);
    if (!done)
        image_linear_free(image);
    return done;
}

void image_linear_free(LinearImage *image)
{
    free(image->rgb);
    *image = (LinearImage){0};
}

/* --- Writing --- */

bool image_linear_write(FILE *file, const double *rgb, int columns, int rows)
{
    size_t stride = (size_t)columns * 3;
    unsigned char *bytes = malloc(4 * stride);
    bool good = bytes && fprintf(file, "PF\n%d %d\n-1.0\n", columns, rows) > 0;
    for (int row = rows - 1; good && row >= 0; row--) {
        for (size_t i = 0; i < stride; i++)
            put_float(rgb[(size_t)row * stride + i], bytes + 4 * i);
        good = fwrite(bytes, 4, stride, file) == stride;
    }
    free(bytes);
    return good;
}
