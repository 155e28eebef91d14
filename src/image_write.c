/* Writes PNG files. libpng reports an error by longjmp; here it never leaves a function of this file, and
 * no variable that is read after the jump is changed after setjmp. */
#include "image.h"

#include "output.h"

#include <errno.h>
#include <png.h>
#include <stdlib.h>
#include <string.h>

struct ImageWriter {
    Output output;
    png_structp png;
    png_infop info;
    int columns, rows_left;
    int reason; /* errno of the write that failed, 0 where libpng itself complained */
    char complaint[128];
};

/* --- What libpng calls --- */

static void on_error(png_structp png, png_const_charp message)
{
    ImageWriter *writer = png_get_error_ptr(png);
    snprintf(writer->complaint, sizeof writer->complaint, "%s", message);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

static void on_data(png_structp png, png_bytep data, size_t size)
{
    ImageWriter *writer = png_get_io_ptr(png);
    if (fwrite(data, 1, size, writer->output.file) != size) {
        writer->reason = errno;
        png_error(png, "write error");
    }
}

static void on_flush(png_structp png)
{
    (void)png;
}

/* --- The writer --- */

static bool cannot_write(const ImageWriter *writer, Error *error)
{
    return output_failed(&writer->output, writer->reason ? strerror(writer->reason) : writer->complaint, error);
}

static ImageWriter *writer_new(int columns, int rows)
{
    ImageWriter *writer = calloc(1, sizeof *writer);
    if (!writer)
        return NULL;
    writer->columns = columns;
    writer->rows_left = rows;
    writer->png = png_create_write_struct(PNG_LIBPNG_VER_STRING, writer, on_error, on_warning);
    if (writer->png)
        writer->info = png_create_info_struct(writer->png);
    if (writer->info)
        return writer;
    image_writer_abort(writer);
    return NULL;
}

static bool write_header(ImageWriter *writer, Error *error)
{
    if (setjmp(png_jmpbuf(writer->png)))
        return cannot_write(writer, error);
    png_set_write_fn(writer->png, writer, on_data, on_flush);
    png_set_IHDR(writer->png, writer->info, (png_uint_32)writer->columns, (png_uint_32)writer->rows_left, 8,
                 PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    /* Flat faces without texture repeat the same bytes in row after row, which zlib finds best unfiltered. Measured on our
     * scenes at 1920x1080: 20 ms; any filter costs more time or space, level 6 halves the size for twice the time. */
    png_set_filter(writer->png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
    png_set_compression_level(writer->png, 3);
    png_write_info(writer->png, writer->info);
    return true;
}

ImageWriter *image_writer_open(const char *path, int columns, int rows, Error *error)
{
    ImageWriter *writer = writer_new(columns, rows);
    if (!writer) {
        error_memory(error, "the picture's writer");
        return NULL;
    }
    if (!output_open(&writer->output, path, "the picture", error) || !write_header(writer, error)) {
        image_writer_abort(writer);
        return NULL;
    }
    return writer;
}

bool image_writer_rows(ImageWriter *writer, const unsigned char *rgb, int rows, Error *error)
{
    if (setjmp(png_jmpbuf(writer->png)))
        return cannot_write(writer, error);
    writer->rows_left -= rows;
    for (int row = 0; row < rows; row++)
        png_write_row(writer->png, rgb + (size_t)row * (size_t)writer->columns * 3);
    return true;
}

static bool write_end(ImageWriter *writer, Error *error)
{
    if (setjmp(png_jmpbuf(writer->png)))
        return cannot_write(writer, error);
    png_write_end(writer->png, NULL);
    return true;
}

bool image_writer_commit(ImageWriter *writer, Error *error)
{
    bool done = write_end(writer, error) && output_commit(&writer->output, error);
    image_writer_abort(writer);
    return done;
}

void image_writer_abort(ImageWriter *writer)
{
    if (!writer)
        return;
    output_abort(&writer->output);
    png_destroy_write_struct(&writer->png, &writer->info);
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
