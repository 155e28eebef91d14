/* Writes PNG files. Rows are gathered and compressed by ISA-L, libpng writes the chunks.
 * libpng reports an error by longjmp; here it never leaves a function of this file, and no variable that is read after
 * the jump is changed after setjmp. */
#include "picture/image_png.h"

#include "picture/part_note.h"

#include <assert.h>
#include <errno.h>
#include <isa-l/igzip_lib.h>
#include <png.h>
#include <stdlib.h>
#include <string.h>

/* Rows are compressed when there are so many bytes of them, or one row if that is longer, and written in chunks of at
 * most so many. Both are fixed: they decide where the compressor begins a block. */
enum { ROWS_BYTES = 256 * 1024, CHUNK_BYTES = 64 * 1024 };

/* Measured on our scenes as unfiltered rows at 1920x1080: level 2 takes as long as level 1 and makes files 1 to 4 %
 * smaller; a larger table gains nothing. docs/experiments.md compares it with zlib. */
enum { LEVEL = 2, LEVEL_BYTES = ISAL_DEF_LVL2_SMALL };

/* Pictures of few bytes are compressed at level 3. Levels 1 and 2 of ISA-L 2.30 compress a stream of some 300 bytes or
 * less to other bytes in about 1 of 100 runs: the result depends on the address of the compressor. */
enum { SHORT_LEVEL = 3, SHORT_LEVEL_BYTES = ISAL_DEF_LVL3_SMALL, SHORT_BYTES = 4096 };

struct PngWriter {
    Output *output; /* borrowed */
    png_structp png;
    png_infop info;
    struct isal_zstream compressor;
    unsigned char *level_room, *rows, *chunk;
    size_t rows_bytes, filled; /* of rows: how many are compressed at a time, and how many there are */
    int columns, rows_left, depth;
    int reason; /* errno of the write that failed, 0 where libpng itself complained */
    char complaint[128];
};

/* --- What libpng calls --- */

static void on_error(png_structp png, png_const_charp message)
{
    PngWriter *writer = png_get_error_ptr(png);
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
    PngWriter *writer = png_get_io_ptr(png);
    if (fwrite(data, 1, size, writer->output->file) != size) {
        writer->reason = errno;
        png_error(png, "write error");
    }
}

static void on_flush(png_structp png)
{
    (void)png;
}

/* --- The writer --- */

static bool cannot_write(const PngWriter *writer, Error *error)
{
    return output_failed(writer->output, writer->reason ? strerror(writer->reason) : writer->complaint, error);
}

static size_t pixel_bytes(const PngWriter *writer)
{
    return writer->depth == 16 ? 6 : 3;
}

/* A row's first byte is its filter. */
static size_t row_bytes(const PngWriter *writer)
{
    return 1 + (size_t)writer->columns * pixel_bytes(writer);
}

/* All rows together are fewer than SHORT_BYTES. Asked before the first row. */
static bool is_short(const PngWriter *writer)
{
    return row_bytes(writer) < SHORT_BYTES && row_bytes(writer) * (size_t)writer->rows_left < SHORT_BYTES;
}

static bool get_memory(PngWriter *writer)
{
    size_t row = row_bytes(writer);
    writer->rows_bytes = row < ROWS_BYTES ? ROWS_BYTES / row * row : row;
    writer->level_room = malloc(is_short(writer) ? SHORT_LEVEL_BYTES : LEVEL_BYTES);
    writer->rows = malloc(writer->rows_bytes);
    writer->chunk = malloc(CHUNK_BYTES);
    return writer->level_room && writer->rows && writer->chunk;
}

/* A zlib stream (RFC 1950), as PNG wants it. */
static void begin_stream(PngWriter *writer)
{
    struct isal_zstream *compressor = &writer->compressor;
    isal_deflate_init(compressor);
    compressor->level = is_short(writer) ? SHORT_LEVEL : LEVEL;
    compressor->level_buf = writer->level_room;
    compressor->level_buf_size = is_short(writer) ? SHORT_LEVEL_BYTES : LEVEL_BYTES;
    compressor->gzip_flag = IGZIP_ZLIB;
    compressor->next_out = writer->chunk;
    compressor->avail_out = CHUNK_BYTES;
}

static PngWriter *writer_new(Output *output, int columns, int rows, int depth)
{
    PngWriter *writer = calloc(1, sizeof *writer);
    if (!writer)
        return NULL;
    writer->output = output;
    writer->columns = columns;
    writer->rows_left = rows;
    writer->depth = depth;
    writer->png = png_create_write_struct(PNG_LIBPNG_VER_STRING, writer, on_error, on_warning);
    if (writer->png)
        writer->info = png_create_info_struct(writer->png);
    if (writer->info && get_memory(writer)) {
        begin_stream(writer);
        return writer;
    }
    png_writer_free(writer);
    return NULL;
}

/* The note of a part stands before its rows, so that it is read without them. */
static void set_part(PngWriter *writer, char *note)
{
    png_text text = {.compression = PNG_TEXT_COMPRESSION_NONE, .key = PART_NOTE_KEYWORD, .text = note};
    png_set_text(writer->png, writer->info, &text, 1);
}

static bool write_header(PngWriter *writer, const char *part, Error *error)
{
    char note[PART_NOTE_ROOM];
    snprintf(note, sizeof note, "%s", part ? part : "");
    if (setjmp(png_jmpbuf(writer->png)))
        return cannot_write(writer, error);
    png_set_write_fn(writer->png, writer, on_data, on_flush);
    png_set_IHDR(writer->png, writer->info, (png_uint_32)writer->columns, (png_uint_32)writer->rows_left, writer->depth,
                 PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (part)
        set_part(writer, note);
    png_write_info(writer->png, writer->info);
    return true;
}

PngWriter *png_writer_open(Output *output, int columns, int rows, int depth, const char *part, Error *error)
{
    PngWriter *writer = writer_new(output, columns, rows, depth);
    if (!writer) {
        error_memory(error, "the picture's writer");
        return NULL;
    }
    if (write_header(writer, part, error))
        return writer;
    png_writer_free(writer);
    return NULL;
}

/* What is compressed, as one chunk. */
static bool write_chunk(PngWriter *writer, Error *error)
{
    struct isal_zstream *compressor = &writer->compressor;
    if (setjmp(png_jmpbuf(writer->png)))
        return cannot_write(writer, error);
    png_write_chunk(writer->png, (png_const_bytep) "IDAT", writer->chunk, CHUNK_BYTES - compressor->avail_out);
    compressor->next_out = writer->chunk;
    compressor->avail_out = CHUNK_BYTES;
    return true;
}

/* Compresses the rows that were gathered; `last` ends the stream. */
static bool compress_rows(PngWriter *writer, bool last, Error *error)
{
    struct isal_zstream *compressor = &writer->compressor;
    compressor->next_in = writer->rows;
    compressor->avail_in = (uint32_t)writer->filled;
    compressor->end_of_stream = last;
    writer->filled = 0;
    bool done = false;
    while (!done) {
        int status = isal_deflate(compressor);
        assert(status == COMP_OK);
        (void)status;
        bool ended = compressor->internal_state.state == ZSTATE_END;
        if ((ended || compressor->avail_out == 0) && !write_chunk(writer, error))
            return false;
        done = last ? ended : compressor->avail_in == 0;
    }
    return true;
}

bool png_writer_rows(PngWriter *writer, const unsigned char *rgb, int rows, Error *error)
{
    size_t row = row_bytes(writer);
    assert(rows <= writer->rows_left);
    for (; rows > 0; rows--, rgb += row - 1) {
        /* Flat faces without texture repeat the same bytes in row after row, which are found unfiltered. Filter Up
         * takes as long and makes rooms up to 20 % smaller, but large cities 50 % larger. */
        writer->rows[writer->filled] = PNG_FILTER_VALUE_NONE;
        memcpy(writer->rows + writer->filled + 1, rgb, row - 1);
        writer->filled += row;
        bool last = --writer->rows_left == 0;
        if ((last || writer->filled == writer->rows_bytes) && !compress_rows(writer, last, error))
            return false;
    }
    return true;
}

bool png_writer_end(PngWriter *writer, Error *error)
{
    if (setjmp(png_jmpbuf(writer->png)))
        return cannot_write(writer, error);
    if (writer->rows_left > 0)
        png_error(writer->png, "rows are missing");
    png_write_chunk(writer->png, (png_const_bytep) "IEND", NULL, 0);
    return true;
}

void png_writer_free(PngWriter *writer)
{
    if (!writer)
        return;
    free(writer->level_room);
    free(writer->rows);
    free(writer->chunk);
    png_destroy_write_struct(&writer->png, &writer->info);
    free(writer);
}
