/* What a file's reader tells without refusing the file: what it left out, or took otherwise than it is written. A kind
 * of note is a NoteKind; what is told of one file under one kind is one note, with all its places. To add a kind, see
 * reader/note_kinds.h. */
#ifndef RECTRAY_NOTES_H
#define RECTRAY_NOTES_H

#include "base/error.h"

#include <stdio.h>

typedef struct NoteKind {
    const char *name; /* for programs: "no-area" */
    const char *one;  /* "a face without area is left out" */
    const char *many; /* after a number: "faces without area are left out" */
    const char *cure; /* how to have it otherwise; NULL: there is nothing to say */
} NoteKind;

typedef struct NotePlace {
    long line, column; /* from 1; 0: the file as a whole, or a line as a whole */
    long count;        /* how often it happened there and after, up to the next place */
    char *detail;      /* NULL: none */
} NotePlace;

typedef struct Note {
    const NoteKind *kind;
    char *path;
    long count; /* the sum of its places' */
    NotePlace *places;
    int place_count, place_capacity;
} Note;

/* In the order in which each was first needed. A zeroed one is empty. */
typedef struct Notes {
    Note *items;
    int count, capacity;
} Notes;

/* Adds a place to the note of that kind and file. `place.count` 0 counts as 1; the path and the detail are copied.
 * Fails only for want of memory. */
bool notes_add(Notes *notes, const NoteKind *kind, const char *path, NotePlace place, Error *error);

/* One sentence of a note, passed by value. */
typedef struct NoteText {
    char text[1024];
} NoteText;

/* "12 faces without area are left out, the first at line 64268; CURE". */
NoteText note_summary(const Note *note);

/* Prints "PATH:LINE: note: SUMMARY" for each note, or with `every` a line for each of its places. */
void notes_print(const Notes *notes, FILE *out, bool every);

/* Makes one error of all notes; true where there is none. */
bool notes_refuse(const Notes *notes, Error *error);

void notes_free(Notes *notes);

#endif
