/* rectray join: the parts of a picture, put together row by row. Each is opened twice: first for its head alone, so
 * that nothing is written before all are known to fit, then for its rows. */
#include "base/output.h"
#include "command/command.h"
#include "command/part.h"
#include "picture/image.h"
#include "picture/part_read.h"

#include <stdlib.h>
#include <string.h>

typedef struct Part {
    const char *path;
    PartFile file;
} Part;

typedef struct Parts {
    Part *items; /* from the top */
    int count;
} Parts;

/* --- Do they fit? --- */

static int by_place(const void *a, const void *b)
{
    const Part *p = a, *q = b;
    return (p->file.note.first_row > q->file.note.first_row) - (p->file.note.first_row < q->file.note.first_row);
}

static bool read_heads(Parts *parts, const Options *options, Error *error)
{
    parts->count = options->operand_count;
    parts->items = calloc((size_t)parts->count, sizeof *parts->items);
    if (!parts->items)
        return error_memory(error, "the parts");
    for (int i = 0; i < parts->count; i++) {
        Part *part = &parts->items[i];
        part->path = options->operands[i];
        PartReader *reader = part_reader_open(part->path, &part->file, error);
        if (!reader)
            return false;
        part_reader_close(reader);
    }
    qsort(parts->items, (size_t)parts->count, sizeof *parts->items, by_place);
    return true;
}

static int end_of(const Part *part)
{
    return part->file.note.first_row + part->file.rows;
}

/* Whether the part is one of the same picture as the first. */
static bool check_kinship(const Part *first, const Part *part, Error *error)
{
    const PartFile *a = &first->file, *b = &part->file;
    if (a->depth != b->depth)
        return error_set(error, ERROR_INPUT,
                         "%s: has %d bits a channel, and %s has %d; render both with the same --depth", part->path,
                         b->depth, first->path, a->depth);
    if (a->note.hash == b->note.hash && a->columns == b->columns && a->note.picture_rows == b->note.picture_rows)
        return true;
    return error_set(
        error, ERROR_INPUT,
        "%s: a part of another picture than %s; render both from the same scene, with the same options and "
        "the same version of rectray",
        part->path, first->path);
}

/* Whether no row is missing from `row` on, up to row `next`. */
static bool check_gap(const Parts *parts, int row, int next, Error *error)
{
    if (row == next)
        return true;
    const PartNote *note = &parts->items[0].file.note;
    int number = 1; /* of the part that has the row, where the first file is one of so many */
    for (PartRange r; number < note->count; number++) {
        r = part_rows((OptionPart){number, note->count}, note->picture_rows);
        if (row < r.first + r.count)
            break;
    }
    return error_set(
        error, ERROR_INPUT,
        "%s: part %d/%d of its picture is missing (rows %d to %d are); render it with --part %d/%d, or name "
        "its file",
        parts->items[0].path, number, note->count, row, next - 1, number, note->count);
}

static bool check_overlap(const Part *above, const Part *below, Error *error)
{
    const PartNote *a = &above->file.note, *b = &below->file.note;
    if (end_of(above) <= b->first_row)
        return true;
    if (a->number == b->number && a->count == b->count)
        return error_set(error, ERROR_INPUT, "%s: is part %d/%d, as %s is; leave one of them out", below->path,
                         b->number, b->count, above->path);
    return error_set(error, ERROR_INPUT,
                     "%s: is part %d/%d, and has rows that %s, part %d/%d, has, too; leave one of them out",
                     below->path, b->number, b->count, above->path, a->number, a->count);
}

static bool check_parts(const Parts *parts, Error *error)
{
    int row = 0;
    for (int i = 0; i < parts->count; i++) {
        const Part *part = &parts->items[i];
        if (!check_kinship(&parts->items[0], part, error) ||
            (i > 0 && !check_overlap(&parts->items[i - 1], part, error)) ||
            !check_gap(parts, row, part->file.note.first_row, error))
            return false;
        row = end_of(part);
    }
    return check_gap(parts, row, parts->items[0].file.note.picture_rows, error);
}

/* --- Joining --- */

static bool same_file(const PartFile *a, const PartFile *b)
{
    return a->note.hash == b->note.hash && a->note.first_row == b->note.first_row && a->rows == b->rows &&
           a->columns == b->columns && a->depth == b->depth;
}

static bool copy_part(ImageWriter *writer, const Part *part, unsigned char *row, Error *error)
{
    PartFile now;
    PartReader *reader = part_reader_open(part->path, &now, error);
    bool good = reader != NULL;
    if (good && !same_file(&now, &part->file))
        good = error_set(error, ERROR_INPUT, "%s: has changed while it was read; join the parts again", part->path);
    for (int i = 0; good && i < now.rows; i++)
        good = part_reader_row(reader, row, error) && image_writer_rows(writer, row, 1, error);
    part_reader_close(reader);
    return good;
}

static bool write_whole(const Parts *parts, const char *output, ImageKind kind, Error *error)
{
    const PartFile *first = &parts->items[0].file;
    unsigned char *row = malloc((size_t)first->columns * 6);
    if (!row)
        return error_memory(error, "a row of the picture");
    ImageWriter *writer = image_writer_open_as(output, kind, first->columns, first->note.picture_rows, error);
    bool good = writer != NULL;
    for (int i = 0; good && i < parts->count; i++)
        good = copy_part(writer, &parts->items[i], row, error);
    if (good)
        good = image_writer_commit(writer, error);
    else
        image_writer_abort(writer);
    free(row);
    return good;
}

static bool choose_output(const Parts *parts, const Options *options, ImageKind *kind, Error *error)
{
    if (!options->output)
        return error_set(error, ERROR_USAGE, "join needs the name of the whole picture; give -o FILE");
    for (int i = 0; i < parts->count; i++)
        if (output_replaces(options->output, parts->items[i].path))
            return error_set(error, ERROR_USAGE, "the picture %s would replace one of its parts; choose another -o",
                             options->output);
    *kind = (ImageKind){.depth = parts->items[0].file.depth};
    if (!image_format_of(options->output, &kind->format, error))
        return false;
    return kind->format != IMAGE_PFM ||
           error_set(error, ERROR_USAGE, "%s: parts have 8 or 16 bits a channel; choose .png or .ppm", options->output);
}

bool command_join(const Options *options, Error *error)
{
    Parts parts = {.count = 0};
    ImageKind kind;
    bool done = read_heads(&parts, options, error) && choose_output(&parts, options, &kind, error) &&
                check_parts(&parts, error) && write_whole(&parts, options->output, kind, error);
    if (done && !options->quiet && strcmp(options->output, "-") != 0)
        fprintf(stderr, "%s: %d x %d pixels of %d parts\n", options->output, parts.items[0].file.columns,
                parts.items[0].file.note.picture_rows, parts.count);
    free(parts.items);
    return done;
}
