/* The format of a picture by its file's ending. */
#include "picture/image_format.h"

#include <stddef.h>
#include <string.h>
#include <strings.h>

const char *const image_format_words[] = {[IMAGE_PNG] = "png", [IMAGE_PPM] = "ppm", [IMAGE_PFM] = "pfm", NULL};

bool image_format_of(const char *path, ImageFormat *format, Error *error)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path, *dot = strrchr(name, '.');
    *format = IMAGE_PNG;
    if (!dot || dot == name)
        return true;
    for (int i = 0; image_format_words[i]; i++)
        if (strcasecmp(dot + 1, image_format_words[i]) == 0) {
            *format = (ImageFormat)i;
            return true;
        }
    return error_set(error, ERROR_USAGE,
                     "%s: pictures end in .png, .ppm or .pfm; choose one of them, or say --format NAME", path);
}
