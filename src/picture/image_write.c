/* Writes pictures in each format: PNG through image_png.h, PPM as the rows come, PFM through image_linear.h. */
#include "picture/image.h"

#include "base/output.h"
#include "picture/image_linear.h"
#include "picture/image_png.h"

#include <assert.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

struct ImageWriter {
    Output output;
    ImageKind kind;
    PngWriter *png; /* NULL in other formats */
    int columns, rows_left;
};

/* Of a call that has just failed. */
static bool cannot_write(const ImageWriter *writer, Error *error)
{
    return output_failed(&writer->output, strerror(errno), error);
}

/* Begins the picture in its file. The head of a PFM comes with its rows. */
static bool begin(ImageWriter *writer, Error *error)
{
    int largest = writer->kind.depth == 16 ? 65535 : 255;
    if (writer->kind.format == IMAGE_PNG) {
        writer->png = png_writer_open(&writer->output, writer->columns, writer->rows_left, writer->kind.depth,
                                      writer->kind.part, error);
        return writer->png != NULL;
    }
    return writer->kind.format == IMAGE_PFM || writer->kind.format == IMAGE_RAW ||
           fprintf(writer->output.file, "P6\n%d %d\n%d\n", writer->columns, writer->rows_left, largest) > 0 ||
           cannot_write(writer, error);
}

ImageWriter *image_writer_open_as(const char *path, ImageKind kind, int columns, int rows, Error *error)
{
    ImageWriter *writer = calloc(1, sizeof *writer);
    if (!writer) {
        error_memory(error, "the picture's writer");
        return NULL;
    }
    *writer = (ImageWriter){.kind = kind, .columns = columns, .rows_left = rows};
    if (output_open(&writer->output, path, "the picture", error) && begin(writer, error))
        return writer;
    image_writer_abort(writer);
    return NULL;
}

ImageWriter *image_writer_open(const char *path, int columns, int rows, Error *error)
{
    ImageKind kind = {.depth = 8};
    if (!image_format_of(path, &kind.format, error))
        return NULL;
    if (kind.format != IMAGE_PFM)
        return image_writer_open_as(path, kind, columns, rows, error);
    error_set(error, ERROR_USAGE, "%s: a PFM holds linear colours, and these are of 8 bits; choose .png or .ppm", path);
    return NULL;
}

bool image_writer_rows(ImageWriter *writer, const unsigned char *rgb, int rows, Error *error)
{
    size_t bytes = (size_t)writer->columns * (size_t)rows * (writer->kind.depth == 16 ? 6 : 3);
    assert(rows <= writer->rows_left && writer->kind.format != IMAGE_PFM);
    writer->rows_left -= rows;
    if (writer->kind.format == IMAGE_PNG)
        return png_writer_rows(writer->png, rgb, rows, error);
    return fwrite(rgb, 1, bytes, writer->output.file) == bytes || cannot_write(writer, error);
}

static bool write_16_bits(ImageWriter *writer, const double *rgb, Error *error)
{
    size_t values = (size_t)writer->columns * 3;
    unsigned char *row = malloc(2 * values);
    bool good = row || error_memory(error, "a row of the picture");
    for (int left = writer->rows_left; good && left > 0; left--, rgb += values) {
        for (size_t i = 0; i < values; i++) {
            unsigned value = image_to_16_bits(rgb[i]);
            row[2 * i] = (unsigned char)(value >> 8);
            row[2 * i + 1] = (unsigned char)value;
        }
        good = image_writer_rows(writer, row, 1, error);
    }
    free(row);
    return good;
}

bool image_writer_linear(ImageWriter *writer, const double *rgb, Error *error)
{
    assert(writer->kind.format == IMAGE_PFM || writer->kind.depth == 16);
    if (writer->kind.format != IMAGE_PFM)
        return write_16_bits(writer, rgb, error);
    int rows = writer->rows_left;
    writer->rows_left = 0;
    return image_linear_write(writer->output.file, rgb, writer->columns, rows) || cannot_write(writer, error);
}

static bool end(ImageWriter *writer, Error *error)
{
    if (writer->png)
        return png_writer_end(writer->png, error);
    return writer->rows_left == 0 || output_failed(&writer->output, "rows are missing", error);
}

bool image_writer_commit(ImageWriter *writer, Error *error)
{
    bool done = end(writer, error) && output_commit(&writer->output, error);
    image_writer_abort(writer);
    return done;
}

void image_writer_abort(ImageWriter *writer)
{
    if (!writer)
        return;
    output_abort(&writer->output);
    png_writer_free(writer->png);
    free(writer);
}

bool image_write(const Image *image, const char *path, Error *error)
{
    ImageWriter *writer = image_writer_open(path, image->columns, image->rows, error);
    if (!writer)
        return false;
    if (image_writer_rows(writer, image->rgb, image->rows, error))
        return image_writer_commit(writer, error);
    image_writer_abort(writer);
    return false;
}

bool image_encode(const Image *image, char **png, size_t *size, Error *error)
{
    Output output = {.file = open_memstream(png, size), .what = "the picture", .path = strdup("-")};
    if (!output.file || !output.path) {
        output_abort(&output);
        return error_memory(error, "the picture");
    }
    PngWriter *writer = png_writer_open(&output, image->columns, image->rows, 8, NULL, error);
    bool done = writer && png_writer_rows(writer, image->rgb, image->rows, error) && png_writer_end(writer, error);
    png_writer_free(writer);
    if (!done)
        output_abort(&output);
    else if (output_commit(&output, error) && *png) /* closing the stream may want memory, too */
        return true;
    return error->kind != ERROR_NONE ? false : error_memory(error, "the picture");
}
