/* Bands in, a file out. */
#include "command/painter.h"

#include "base/clock.h"
#include "picture/mark.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool is_linear(ImageKind kind)
{
    return kind.format == IMAGE_PFM || kind.depth == 16;
}

bool painter_kind(const Options *options, const char *output, ImageKind *kind, Error *error)
{
    kind->depth = options->depth == 1 ? 16 : 8;
    kind->format = (ImageFormat)options->picture_format;
    if (options->picture_format < 0 && !image_format_of(output, &kind->format, error))
        return false;
    bool linear = is_linear(*kind);
    if (kind->format == IMAGE_PFM && kind->depth == 16)
        return error_set(error, ERROR_USAGE, "--depth is of png and ppm; a pfm has 32-bit floats");
    if (options->part.count > 0 && kind->format != IMAGE_PNG)
        return error_set(error, ERROR_USAGE,
                         "a part is a PNG, which tells its place; `rectray join` writes other formats");
    if (linear && options->settings.arithmetic == ARITHMETIC_TEXTBOOK && options->backend == BACKEND_REFERENCE)
        return error_set(error, ERROR_USAGE,
                         "textbook arithmetic of the reference gives 8 bits; choose .png or .ppm, or "
                         "--kernel plain");
    return !linear || !options->mark_given ||
           error_set(error, ERROR_USAGE, "--mark draws into a picture of 8 bits; choose .png or .ppm");
}

/* --- Bands --- */

/* Notes whether the picture has more than one colour: most bands tell at their second pixel. */
static void watch_colours(Painter *painter, int first_row, int rows, const unsigned char *rgb)
{
    size_t bytes = (size_t)rows * (size_t)painter->region.columns * 3;
    if (painter->varies)
        return;
    if (first_row == 0)
        memcpy(painter->colour, rgb, 3);
    painter->varies = memcmp(painter->colour, rgb, 3) != 0 || memcmp(rgb, rgb + 3, bytes - 3) != 0;
}

static bool paint_band(void *user, int first_row, int rows, const unsigned char *rgb, const RenderReport *so_far,
                       Error *error)
{
    Painter *painter = user;
    double start = clock_ms();
    size_t stride = (size_t)painter->marked.columns * 3;
    watch_colours(painter, first_row, rows, rgb);
    if (painter->marked.rgb)
        memcpy(painter->marked.rgb + (size_t)first_row * stride, rgb, (size_t)rows * stride);
    bool ok = painter->marked.rgb || painter->linear || image_writer_rows(painter->writer, rgb, rows, error);
    painter->encode_ms += clock_ms() - start;
    const RayCounts *rays = &so_far->rays;
    progress_step(&painter->progress, (double)(first_row + rows) / painter->region.rows,
                  rays->primary + rays->shadow + rays->reflection,
                  so_far->trace_ms + so_far->readback_ms + painter->encode_ms);
    return ok;
}

BandSink painter_sink(Painter *painter)
{
    return (BandSink){paint_band, painter};
}

/* --- What is kept as a whole --- */

/* A marked picture is written when it is complete: what is shown larger may come after its place. */
static bool keep_picture(Painter *painter, Error *error)
{
    painter->marked = (Image){painter->region.columns, painter->region.rows, NULL};
    painter->marked.rgb = malloc((size_t)painter->region.columns * (size_t)painter->region.rows * 3);
    return painter->marked.rgb || error_memory(error, "the picture");
}

static bool keep_linear(Painter *painter, Error *error)
{
    painter->linear =
        malloc((size_t)painter->region.columns * (size_t)painter->region.rows * 3 * sizeof *painter->linear);
    return painter->linear || error_memory(error, "the picture in linear colours");
}

/* The bytes around a pixel of the image, which is that region of the picture. */
static void print_around(const Image *image, const Region *region, int column, int row)
{
    for (int y = row - 1; y <= row + 1; y++) {
        if (y < 0 || y >= image->rows)
            continue;
        for (int x = column - 1; x <= column + 1; x++) {
            if (x < 0 || x >= image->columns)
                continue;
            const unsigned char *rgb = image->rgb + ((size_t)y * (size_t)image->columns + (size_t)x) * 3;
            fprintf(stderr, "  (%d, %d) = (%d, %d, %d)", region->column + x, region->row + y, rgb[0], rgb[1], rgb[2]);
        }
        fputc('\n', stderr);
    }
}

/* Marks and writes the picture that was kept; true, too, where none was. */
static bool write_marked(const Options *options, Painter *painter, Error *error)
{
    Image *image = &painter->marked;
    int column = options->mark_column - painter->region.column, row = options->mark_row - painter->region.row;
    if (!image->rgb)
        return true;
    if (!options->quiet)
        print_around(image, &painter->region, column, row);
    mark_draw(image, column, row);
    bool done = image_writer_rows(painter->writer, image->rgb, image->rows, error);
    image_free(image);
    return done;
}

/* --- Begin and end --- */

static void free_kept(Painter *painter)
{
    image_free(&painter->marked);
    free(painter->linear);
    painter->linear = NULL;
}

bool painter_begin(Painter *painter, const Options *options, const char *output, ImageKind kind, Region region,
                   Error *error)
{
    double start = clock_ms();
    *painter =
        (Painter){.writer = image_writer_open_as(output, kind, region.columns, region.rows, error), .region = region};
    if (!painter->writer)
        return false;
    painter->encode_ms = clock_ms() - start;
    if ((options->mark_given && !keep_picture(painter, error)) || (is_linear(kind) && !keep_linear(painter, error))) {
        painter_abort(painter);
        return false;
    }
    return true;
}

bool painter_finish(Painter *painter, const Options *options, Error *error)
{
    double start = clock_ms();
    bool written = write_marked(options, painter, error) &&
                   (!painter->linear || image_writer_linear(painter->writer, painter->linear, error));
    free_kept(painter);
    if (!written) {
        image_writer_abort(painter->writer);
        return false;
    }
    bool done = image_writer_commit(painter->writer, error);
    painter->encode_ms += clock_ms() - start;
    return done;
}

void painter_abort(Painter *painter)
{
    free_kept(painter);
    image_writer_abort(painter->writer);
}
