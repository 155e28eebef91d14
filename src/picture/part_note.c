#include "picture/part_note.h"

#include "picture/image.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

void part_note_write(char text[PART_NOTE_ROOM], const PartNote *note)
{
    snprintf(text, PART_NOTE_ROOM, "part %d/%d, from row %d of %d, hash %016" PRIx64, note->number, note->count,
             note->first_row, note->picture_rows, note->hash);
}

bool part_note_read(PartNote *note, const char *text)
{
    char again[PART_NOTE_ROOM];
    *note = (PartNote){0};
    if (strlen(text) >= sizeof again ||
        sscanf(text, "part %9d/%9d, from row %9d of %9d, hash %16" SCNx64, &note->number, &note->count,
               &note->first_row, &note->picture_rows, &note->hash) != 5)
        return false;
    part_note_write(again, note);
    return strcmp(again, text) == 0 && note->number >= 1 && note->number <= note->count && note->first_row >= 0 &&
           note->first_row < note->picture_rows && note->picture_rows <= IMAGE_MAX_SIDE;
}
