/* libpng reports an error by longjmp; what must outlive it is in the PartReader. */
#include "picture/part_read.h"

#include "base/text.h"
#include "picture/image.h"

#include <png.h>
#include <stdlib.h>
#include <string.h>

struct PartReader {
    const char *path;
    FILE *file;
    png_structp png;
    png_infop info;
    Error *error; /* of the call that is running */
};

static void on_error(png_structp png, png_const_charp message)
{
    PartReader *reader = png_get_error_ptr(png);
    error_set(reader->error, ERROR_INPUT, "%s: damaged PNG: %s; render this part again", reader->path, message);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

static void on_data(png_structp png, png_bytep data, size_t size)
{
    PartReader *reader = png_get_io_ptr(png);
    if (fread(data, 1, size, reader->file) == size)
        return;
    if (ferror(reader->file))
        text_fail_errno(reader->path, "cannot be read", reader->error);
    png_error(png, "it ends too early");
}

/* --- What the file tells --- */

/* The text of the part's chunk; NULL where there is none. */
static const char *note_of(PartReader *reader)
{
    png_textp texts = NULL;
    int count = 0;
    png_get_text(reader->png, reader->info, &texts, &count);
    for (int i = 0; i < count; i++)
        if (strcmp(texts[i].key, PART_NOTE_KEYWORD) == 0)
            return texts[i].text;
    return NULL;
}

static bool check_file(const PartReader *reader, const PartFile *file, const char *note)
{
    if (!note)
        return error_set(reader->error, ERROR_INPUT,
                         "%s: a picture that is no part of one: only `render --part K/N` makes parts", reader->path);
    bool rgb = png_get_color_type(reader->png, reader->info) == PNG_COLOR_TYPE_RGB && file->depth >= 8 &&
               png_get_interlace_type(reader->png, reader->info) == PNG_INTERLACE_NONE;
    if (rgb && file->note.count > 0 && file->rows <= file->note.picture_rows - file->note.first_row)
        return true;
    return error_set(reader->error, ERROR_INPUT,
                     "%s: what it tells of its place is not what `render --part K/N` writes; render this part again",
                     reader->path);
}

static bool read_head(PartReader *reader, PartFile *file)
{
    if (setjmp(png_jmpbuf(reader->png)))
        return false;
    png_set_read_fn(reader->png, reader, on_data);
    png_set_user_limits(reader->png, IMAGE_MAX_SIDE, IMAGE_MAX_SIDE);
    png_read_info(reader->png, reader->info);
    file->columns = (int)png_get_image_width(reader->png, reader->info);
    file->rows = (int)png_get_image_height(reader->png, reader->info);
    file->depth = png_get_bit_depth(reader->png, reader->info);
    const char *note = note_of(reader);
    if (!note || !part_note_read(&file->note, note))
        file->note.count = 0;
    return check_file(reader, file, note);
}

PartReader *part_reader_open(const char *path, PartFile *file, Error *error)
{
    PartReader *reader = calloc(1, sizeof *reader);
    if (!reader) {
        error_memory(error, "the reader of a part");
        return NULL;
    }
    *reader = (PartReader){.path = path, .file = fopen(path, "rb"), .error = error};
    bool good = reader->file || text_fail_errno(path, "cannot be read", error);
    if (good) {
        reader->png = png_create_read_struct(PNG_LIBPNG_VER_STRING, reader, on_error, on_warning);
        reader->info = reader->png ? png_create_info_struct(reader->png) : NULL;
        good = reader->info ? read_head(reader, file) : error_memory(error, "the reader of a part");
    }
    if (good)
        return reader;
    part_reader_close(reader);
    return NULL;
}

bool part_reader_row(PartReader *reader, unsigned char *row, Error *error)
{
    reader->error = error;
    if (setjmp(png_jmpbuf(reader->png)))
        return false;
    png_read_row(reader->png, row, NULL);
    return true;
}

void part_reader_close(PartReader *reader)
{
    if (!reader)
        return;
    png_destroy_read_struct(&reader->png, &reader->info, NULL);
    if (reader->file)
        fclose(reader->file);
    free(reader);
}
