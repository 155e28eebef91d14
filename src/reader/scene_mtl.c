/* Material libraries (MTL) of Wavefront OBJ models: their files, and where a material begins. */
#include "reader/scene_mtl.h"

#include "base/array.h"
#include "reader/mtl_line.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

static bool begin_material(MtlReader *reader)
{
    MtlLibrary *library = reader->library;
    Error *error = reader->scan.error;
    long line = reader->scan.line;
    const char *name = scan_rest(&reader->scan);
    if (!mtl_finish_material(reader))
        return false;
    reader->draft = (MtlDraft){.illum = -1, .opaque = -1, .transparent = -1};
    reader->begun = true;
    reader->now = &reader->dropped;
    if (!*name) {
        NotePlace place = {.line = line, .detail = "newmtl without a name"};
        return notes_add(reader->notes, &note_kinds[NOTE_UNKNOWN], reader->scan.path, place, error);
    }
    if (names_find(&library->names, name) >= 0) {
        Quoted quoted = text_quote(name);
        NotePlace place = {.line = line, .detail = quoted.text};
        return notes_add(reader->notes, &note_kinds[NOTE_MATERIAL_TWICE], reader->scan.path, place, error);
    }
    reader->now = mtl_library_add(library, name, reader->scan.path, error);
    return reader->now != NULL;
}

/* What cannot be read stops only a model that uses the material. */
static bool read_value(MtlReader *reader, ScanWord key)
{
    LineScan *scan = &reader->scan;
    Error *error = scan->error, reason = {.kind = ERROR_NONE};
    MtlMaterial *now = reader->now;
    long line = scan->line;
    scan->error = &reason;
    scan->bare = true;
    bool good = mtl_read_key(reader, key);
    scan->error = error;
    scan->bare = false;
    if (good)
        return true;
    if (reason.kind != ERROR_INPUT)
        return error_set(error, reason.kind, "%s", reason.text);
    if (now != &reader->dropped && !now->fault) {
        now->fault = text_copy(reason.text, error);
        now->fault_line = line;
    }
    return (now == &reader->dropped || now->fault) && scan_next_line(scan);
}

/* Reads a line, and goes to the next one. */
static bool read_line(void *user)
{
    MtlReader *reader = user;
    LineScan *scan = &reader->scan;
    scan_blanks(scan);
    long line = scan->line;
    ScanWord key = scan_word(scan);
    if (key.length == 0)
        return scan_next_line(scan);
    if (scan_word_is(key, "newmtl"))
        return begin_material(reader);
    bool is_meant = tolower((unsigned char)key.text[0]) == 'k' || scan_word_is(key, "Ns");
    if (is_meant && !reader->begun)
        return scan_fail(scan, line, "%.*s before the first newmtl", key.length, key.text);
    return read_value(reader, key);
}

static bool read_file(MtlLibrary *library, const char *path, Notes *notes, Error *error)
{
    MtlReader reader = {.library = library, .notes = notes, .scan = {.line = 1, .path = path, .error = error}};
    reader.now = &reader.dropped;
    reader.draft = (MtlDraft){.illum = -1, .opaque = -1, .transparent = -1};
    return scan_file(&reader.scan, read_line, &reader) && mtl_finish_material(&reader);
}

bool scene_mtl_read(MtlLibrary *library, char *path, Notes *notes, Error *error)
{
    for (int i = 0; i < library->file_count; i++)
        if (strcmp(library->files[i], path) == 0) {
            free(path);
            return true;
        }
    char **files =
        array_grown(library->files, library->file_count, &library->file_capacity, sizeof *files, "paths", error);
    if (!files) {
        free(path);
        return false;
    }
    library->files = files;
    library->files[library->file_count++] = path;
    return read_file(library, path, notes, error);
}
