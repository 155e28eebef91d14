/* What the file of a part tells of it: a text in a chunk of its PNG. docs/cluster.md describes it. */
#ifndef RECTRAY_PART_NOTE_H
#define RECTRAY_PART_NOTE_H

#include <stdbool.h>
#include <stdint.h>

/* The keyword of the chunk, a tEXt. */
#define PART_NOTE_KEYWORD "rectray part"

enum { PART_NOTE_ROOM = 160 };

/* Part `number` of `count`, from 1: the rows of a picture from first_row on, as many as the PNG has. */
typedef struct PartNote {
    int number, count;
    int first_row, picture_rows; /* of the whole picture */
    uint64_t hash;               /* of the scene and the settings */
} PartNote;

void part_note_write(char text[PART_NOTE_ROOM], const PartNote *note);

/* False where the text is none that part_note_write writes, or its numbers make no sense. */
bool part_note_read(PartNote *note, const char *text);

#endif
