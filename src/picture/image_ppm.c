/* A PPM is "P6", columns, rows and the largest value as words, one blank, and the rows from the top. */
#include "picture/image_ppm.h"

#include "base/text.h"

#include <ctype.h>
#include <stdlib.h>

/* The next whole number of the head; a comment runs from '#' to the end of its line. -1: there is none. */
static int next_number(FILE *file)
{
    int c = fgetc(file), number = 0, digits = 0;
    while (isspace(c) || c == '#') {
        if (c == '#')
            while (c != '\n' && c != EOF)
                c = fgetc(file);
        else
            c = fgetc(file);
    }
    for (; isdigit(c) && digits < 6; digits++, c = fgetc(file))
        number = 10 * number + (c - '0');
    return digits > 0 && isspace(c) ? number : -1;
}

static bool read_values(Image *image, FILE *file, int largest)
{
    size_t values = (size_t)image->columns * (size_t)image->rows * 3;
    for (size_t i = 0; i < values; i++) {
        int high = largest > 255 ? fgetc(file) : 0, low = fgetc(file);
        if (low == EOF)
            return false;
        image->rgb[i] = (unsigned char)(((256 * high + low) * 255 + largest / 2) / largest);
    }
    return true;
}

bool image_ppm_read(Image *image, FILE *file, const char *path, Error *error)
{
    image->columns = next_number(file);
    image->rows = next_number(file);
    int largest = next_number(file);
    if (image->columns < 1 || image->rows < 1 || largest < 1 || largest > 65535)
        return error_set(error, ERROR_INPUT, "%s: damaged PPM: its head is not columns, rows and the largest value",
                         path);
    if (image->columns > IMAGE_MAX_SIDE || image->rows > IMAGE_MAX_SIDE)
        return error_set(error, ERROR_INPUT, "%s: %d x %d pixels are too many; %d are allowed on a side", path,
                         image->columns, image->rows, IMAGE_MAX_SIDE);
    image->rgb = malloc((size_t)image->columns * (size_t)image->rows * 3);
    if (!image->rgb)
        return error_memory(error, "a picture");
    if (read_values(image, file, largest))
        return true;
    return ferror(file) ? text_fail_errno(path, "cannot be read", error)
                        : error_set(error, ERROR_INPUT, "%s: damaged PPM: it ends too early", path);
}
