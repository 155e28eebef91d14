/* Notes: what a reader tells without refusing the file. */
#include "base/notes.h"

#include "base/array.h"
#include "base/text.h"

#include <stdlib.h>
#include <string.h>

/* The note of that kind and file, a new one where there is none. NULL without memory. */
static Note *note_of(Notes *notes, const NoteKind *kind, const char *path, Error *error)
{
    for (int i = 0; i < notes->count; i++)
        if (notes->items[i].kind == kind && strcmp(notes->items[i].path, path) == 0)
            return &notes->items[i];
    Note *grown = array_grown(notes->items, notes->count, &notes->capacity, sizeof *grown, "notes", error);
    if (!grown)
        return NULL;
    notes->items = grown;
    char *copy = text_copy(path, error);
    if (!copy)
        return NULL;
    grown[notes->count] = (Note){.kind = kind, .path = copy};
    return &grown[notes->count++];
}

bool notes_add(Notes *notes, const NoteKind *kind, const char *path, NotePlace place, Error *error)
{
    Note *note = note_of(notes, kind, path, error);
    if (!note)
        return false;
    NotePlace *grown =
        array_grown(note->places, note->place_count, &note->place_capacity, sizeof *grown, "notes", error);
    if (!grown)
        return false;
    note->places = grown;
    if (place.detail && !(place.detail = text_copy(place.detail, error)))
        return false;
    place.count = place.count > 0 ? place.count : 1;
    note->count += place.count;
    note->places[note->place_count++] = place;
    return true;
}

/* ": DETAIL", or nothing. */
static const char *colon_before(const char *detail)
{
    return detail ? ": " : "";
}

static NoteText place_text(const Note *note, const NotePlace *place)
{
    NoteText result;
    const char *detail = place->detail ? place->detail : "";
    if (place->count == 1)
        snprintf(result.text, sizeof result.text, "%s%s%s", note->kind->one, colon_before(place->detail), detail);
    else
        snprintf(result.text, sizeof result.text, "%ld %s%s%s", place->count, note->kind->many,
                 colon_before(place->detail), detail);
    return result;
}

NoteText note_summary(const Note *note)
{
    const NotePlace *first = &note->places[0];
    const char *cure = note->kind->cure;
    NoteText text = place_text(note, first), result;
    if (note->count > 1) {
        char where[48] = "";
        if (first->line > 0)
            snprintf(where, sizeof where, ", the first at line %ld", first->line);
        snprintf(text.text, sizeof text.text, "%ld %s%s%s%s", note->count, note->kind->many, where,
                 colon_before(first->detail), first->detail ? first->detail : "");
    }
    snprintf(result.text, sizeof result.text, "%.700s%s%.300s", text.text, cure ? "; " : "", cure ? cure : "");
    return result;
}

/* "PATH:LINE:COLUMN: WORDTEXT", where a place of 0 is left out. As an Error, since its text cannot steer a terminal. */
static Error line_of(const Note *note, const NotePlace *place, const char *word, const char *text)
{
    char at[64] = "";
    Error line = {.kind = ERROR_NONE};
    if (place->line > 0 && place->column > 0)
        snprintf(at, sizeof at, "%ld:%ld:", place->line, place->column);
    else if (place->line > 0)
        snprintf(at, sizeof at, "%ld:", place->line);
    error_set(&line, ERROR_INPUT, "%s:%s %s%s", note->path, at, word, text);
    return line;
}

void notes_print(const Notes *notes, FILE *out, bool every)
{
    for (int i = 0; i < notes->count; i++) {
        const Note *note = &notes->items[i];
        if (!every || note->place_count == 1) {
            fprintf(out, "%s\n", line_of(note, &note->places[0], "note: ", note_summary(note).text).text);
            continue;
        }
        for (int k = 0; k < note->place_count; k++)
            fprintf(out, "%s\n",
                    line_of(note, &note->places[k], "note: ", place_text(note, &note->places[k]).text).text);
        if (note->kind->cure)
            fprintf(out, "%s: note: %s\n", note->path, note->kind->cure);
    }
}

bool notes_refuse(const Notes *notes, Error *error)
{
    char all[sizeof error->text - 100] = "";
    size_t length = 0;
    for (int i = 0; i < notes->count; i++) {
        const Note *note = &notes->items[i];
        Error line = line_of(note, &note->places[0], "", note_summary(note).text);
        if (length + strlen(line.text) + 2 > sizeof all)
            break;
        length += (size_t)snprintf(all + length, sizeof all - length, "%s\n", line.text);
    }
    return notes->count == 0 || error_set(error, ERROR_INPUT, "%sWithout --strict %s", all,
                                          notes->count == 1 ? "this is a note." : "these are notes.");
}

void notes_free(Notes *notes)
{
    for (int i = 0; i < notes->count; i++) {
        for (int k = 0; k < notes->items[i].place_count; k++)
            free(notes->items[i].places[k].detail);
        free(notes->items[i].places);
        free(notes->items[i].path);
    }
    free(notes->items);
    *notes = (Notes){0};
}
