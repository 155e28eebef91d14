/* The formats of picture files. To add one: its name here and its word in image_format.c, what writes it (image_write.c
 * for rows as they come, image_pfm.c for a whole picture), and what reads it (image_read.c). */
#ifndef RECTRAY_IMAGE_FORMAT_H
#define RECTRAY_IMAGE_FORMAT_H

#include "base/error.h"

typedef enum ImageFormat {
    IMAGE_PNG, /* 8 or 16 bits a channel, compressed */
    IMAGE_PPM, /* Netpbm's P6: 8 or 16 bits a channel, as they are */
    IMAGE_PFM, /* portable float map: linear colours, 32-bit float, not clamped */
    IMAGE_RAW, /* 8 bits a channel and nothing else, for a pipe; no file's ending and no user names it */
} ImageFormat;

/* Their endings and what users call them; the list ends in a NULL. */
extern const char *const image_format_words[];

/* The format that the file's ending names, in small letters or large ones; PNG where there is none: "-", a device.
 * Another ending is an ERROR_USAGE that lists the formats. */
bool image_format_of(const char *path, ImageFormat *format, Error *error);

#endif
