/* Reads PNG files of any kind, and PPM files, as RGB, 8 bits each. libpng reports an error by longjmp; what must be
 * freed then lives in a Reader that the caller of setjmp only points to: no changed local variable is read after it. */
#include "picture/image.h"

#include "base/text.h"
#include "picture/image_ppm.h"

#include <png.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct Reader {
    const char *path;
    FILE *file;
    png_structp png;
    png_infop info;
    png_bytep *rows;
    bool no_memory; /* libpng asked for some and got none; its complaint does not tell that from a damaged picture */
    Error *error;
} Reader;

static void on_error(png_structp png, png_const_charp message)
{
    Reader *reader = png_get_error_ptr(png);
    if (reader->no_memory)
        error_memory(reader->error, reader->path);
    error_set(reader->error, ERROR_INPUT, "%s: damaged PNG: %s", reader->path, message);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

static png_voidp on_malloc(png_structp png, png_alloc_size_t size)
{
    Reader *reader = png_get_mem_ptr(png);
    png_voidp block = malloc(size);
    reader->no_memory = reader->no_memory || !block;
    return block;
}

static void on_free(png_structp png, png_voidp block)
{
    (void)png;
    free(block);
}

static void on_data(png_structp png, png_bytep data, size_t size)
{
    Reader *reader = png_get_io_ptr(png);
    if (fread(data, 1, size, reader->file) == size)
        return;
    if (ferror(reader->file))
        text_fail_errno(reader->path, "cannot be read", reader->error);
    png_error(png, "it ends too early");
}

static bool open_file(Reader *reader, unsigned char signature[8])
{
    reader->file = fopen(reader->path, "rb");
    if (!reader->file || (fread(signature, 1, 8, reader->file) != 8 && ferror(reader->file)))
        return text_fail_errno(reader->path, "cannot be read", reader->error);
    return true;
}

static bool begin_png(Reader *reader, const unsigned char signature[8])
{
    if (png_sig_cmp(signature, 0, 8) != 0)
        return error_set(reader->error, ERROR_INPUT, "%s: neither a PNG nor a PPM picture", reader->path);
    reader->png =
        png_create_read_struct_2(PNG_LIBPNG_VER_STRING, reader, on_error, on_warning, reader, on_malloc, on_free);
    if (reader->png)
        reader->info = png_create_info_struct(reader->png);
    return reader->info ? true : error_memory(reader->error, "the reader of a picture");
}

/* Everything becomes RGB, 8 bits each. */
static void set_conversions(Reader *reader)
{
    png_set_scale_16(reader->png);
    png_set_palette_to_rgb(reader->png);
    png_set_expand_gray_1_2_4_to_8(reader->png);
    png_set_gray_to_rgb(reader->png);
    png_set_strip_alpha(reader->png);
    png_set_interlace_handling(reader->png);
    png_read_update_info(reader->png, reader->info);
}

static bool allocate(Reader *reader, Image *image)
{
    size_t row_bytes = png_get_rowbytes(reader->png, reader->info);
    size_t rows = (size_t)image->rows;
    if (row_bytes != (size_t)image->columns * 3)
        return error_set(reader->error, ERROR_INPUT, "%s: a kind of PNG that is not understood", reader->path);
    image->rgb = row_bytes <= SIZE_MAX / rows ? malloc(row_bytes * rows) : NULL;
    reader->rows = calloc(rows, sizeof *reader->rows);
    if (!image->rgb || !reader->rows)
        return error_memory(reader->error, "a picture");
    for (size_t row = 0; row < rows; row++)
        reader->rows[row] = image->rgb + row * row_bytes;
    return true;
}

static bool read_pixels(Reader *reader, Image *image)
{
    if (setjmp(png_jmpbuf(reader->png)))
        return false;
    png_set_read_fn(reader->png, reader, on_data);
    png_set_sig_bytes(reader->png, 8);
    png_set_user_limits(reader->png, IMAGE_MAX_SIDE, IMAGE_MAX_SIDE);
    png_read_info(reader->png, reader->info);
    image->columns = (int)png_get_image_width(reader->png, reader->info);
    image->rows = (int)png_get_image_height(reader->png, reader->info);
    set_conversions(reader);
    if (!allocate(reader, image))
        return false;
    png_read_image(reader->png, reader->rows);
    png_read_end(reader->png, NULL);
    return true;
}

bool image_read(Image *image, const char *path, Error *error)
{
    Reader reader = {.path = path, .error = error};
    unsigned char signature[8] = {0};
    memset(image, 0, sizeof *image);
    bool done = open_file(&reader, signature);
    if (done && memcmp(signature, "P6", 2) == 0 && fseek(reader.file, 2, SEEK_SET) == 0)
        done = image_ppm_read(image, reader.file, path, error);
    else
        done = done && begin_png(&reader, signature) && read_pixels(&reader, image);
    if (!done)
        image_free(image);
    png_destroy_read_struct(&reader.png, &reader.info, NULL);
    free(reader.rows);
    if (reader.file)
        fclose(reader.file);
    return done;
}

void image_free(Image *image)
{
    free(image->rgb);
    memset(image, 0, sizeof *image);
}
