/* Writes PNG files. libpng reports an error by longjmp; here it never leaves a function of this file, and
 * no variable that is read after the jump is changed after setjmp. The file is not forced to the disk (fsync):
 * a rename is whole after any crash of the program; after a power cut the file system decides. */
#define _XOPEN_SOURCE 700 /* realpath */
#include "image.h"

#include "interrupt.h"

#include <errno.h>
#include <fcntl.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct ImageWriter {
    char *path;      /* as messages name it */
    char *target;    /* what the temporary file will be called: the path with its links followed */
    char *temporary; /* NULL where the output is written in place: stdout, a device, a pipe */
    FILE *file;
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
    if (fwrite(data, 1, size, writer->file) != size) {
        writer->reason = errno;
        png_error(png, "write error");
    }
}

static void on_flush(png_structp png)
{
    (void)png;
}

/* --- The file --- */

static bool cannot_write(const ImageWriter *writer, int reason, Error *error)
{
    const char *path = strcmp(writer->path, "-") == 0 ? "the picture to standard output" : writer->path;
    return error_set(error, ERROR_SYSTEM, "cannot write %s: %s", path, reason ? strerror(reason) : writer->complaint);
}

/* "FOLDER/.rectray-PROCESS-ATTEMPT.part": its length does not depend on the picture's name, which may be as long as
 * the file system allows. */
static char *temporary_name(const char *target, int attempt)
{
    const char *slash = strrchr(target, '/');
    int folder = slash ? (int)(slash - target) + 1 : 0;
    size_t size = (size_t)folder + 64;
    char *name = malloc(size);
    if (name)
        snprintf(name, size, "%.*s.rectray-%ld-%d.part", folder, target, (long)getpid(), attempt);
    return name;
}

/* Creates the temporary file beside the target; the descriptor, or -1 with the error filled. */
static int create_temporary(ImageWriter *writer, Error *error)
{
    for (int attempt = 0;; attempt++) {
        char *name = temporary_name(writer->target, attempt);
        if (!name) {
            error_memory(error, "the name of the picture");
            return -1;
        }
        int descriptor = interrupt_create_guarded(name);
        if (descriptor >= 0) {
            writer->temporary = name;
            return descriptor;
        }
        int reason = errno;
        free(name);
        if (reason != EEXIST || attempt == 100) {
            cannot_write(writer, reason, error);
            return -1;
        }
    }
}

/* Where the output goes: stdout, a device or pipe as it is, or a new file beside the target. */
static bool open_file(ImageWriter *writer, Error *error)
{
    int descriptor;
    struct stat there;
    if (strcmp(writer->path, "-") == 0) {
        descriptor = dup(STDOUT_FILENO);
    } else if (stat(writer->path, &there) != 0 || S_ISREG(there.st_mode)) {
        /* A rename needs no right to the file that it replaces; we do not take a file that is marked read-only. */
        if (access(writer->path, W_OK) != 0 && errno != ENOENT)
            return cannot_write(writer, errno, error);
        descriptor = create_temporary(writer, error);
    } else {
        descriptor = open(writer->path, O_WRONLY | O_CLOEXEC); /* a folder fails here */
    }
    if (descriptor < 0)
        return cannot_write(writer, errno, error); /* an error that is already set stays */
    writer->file = fdopen(descriptor, "wb");
    if (!writer->file) { /* no memory, or a stdout that is not open for writing */
        cannot_write(writer, errno == EINVAL ? EBADF : errno, error);
        close(descriptor);
    }
    return writer->file != NULL;
}

/* --- The writer --- */

static ImageWriter *writer_new(const char *path, int columns, int rows)
{
    ImageWriter *writer = calloc(1, sizeof *writer);
    if (!writer)
        return NULL;
    writer->columns = columns;
    writer->rows_left = rows;
    writer->path = strdup(path);
    writer->target = realpath(path, NULL); /* NULL where there is nothing yet */
    if (!writer->target)
        writer->target = strdup(path);
    writer->png = png_create_write_struct(PNG_LIBPNG_VER_STRING, writer, on_error, on_warning);
    if (writer->png)
        writer->info = png_create_info_struct(writer->png);
    if (writer->path && writer->target && writer->info)
        return writer;
    image_writer_abort(writer);
    return NULL;
}

static bool write_header(ImageWriter *writer, Error *error)
{
    if (setjmp(png_jmpbuf(writer->png)))
        return cannot_write(writer, writer->reason, error);
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
    ImageWriter *writer = writer_new(path, columns, rows);
    if (!writer) {
        error_memory(error, "the picture's writer");
        return NULL;
    }
    if (!open_file(writer, error) || !write_header(writer, error)) {
        image_writer_abort(writer);
        return NULL;
    }
    return writer;
}

bool image_writer_rows(ImageWriter *writer, const unsigned char *rgb, int rows, Error *error)
{
    if (setjmp(png_jmpbuf(writer->png)))
        return cannot_write(writer, writer->reason, error);
    writer->rows_left -= rows;
    for (int row = 0; row < rows; row++)
        png_write_row(writer->png, rgb + (size_t)row * (size_t)writer->columns * 3);
    return true;
}

static bool write_end(ImageWriter *writer, Error *error)
{
    if (setjmp(png_jmpbuf(writer->png)))
        return cannot_write(writer, writer->reason, error);
    png_write_end(writer->png, NULL);
    return true;
}

static bool close_file(ImageWriter *writer, Error *error)
{
    FILE *file = writer->file;
    writer->file = NULL;
    if (fclose(file) != 0) /* writes what is still buffered, and learns what a network file system put off */
        return cannot_write(writer, errno, error);
    if (writer->temporary && rename(writer->temporary, writer->target) != 0)
        return cannot_write(writer, errno, error);
    return true;
}

bool image_writer_commit(ImageWriter *writer, Error *error)
{
    bool done = write_end(writer, error) && close_file(writer, error);
    if (done && writer->temporary) {
        interrupt_release();
        free(writer->temporary);
        writer->temporary = NULL;
    }
    image_writer_abort(writer);
    return done;
}

void image_writer_abort(ImageWriter *writer)
{
    if (!writer)
        return;
    if (writer->file)
        fclose(writer->file);
    if (writer->temporary) {
        unlink(writer->temporary);
        interrupt_release();
    }
    png_destroy_write_struct(&writer->png, &writer->info);
    free(writer->temporary);
    free(writer->target);
    free(writer->path);
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
