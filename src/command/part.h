/* --part K/N: the K-th of N parts of what is to be rendered, of the rows of a picture or of the frames of a film, so
 * that N runs share the work without knowing of one another. */
#ifndef RECTRAY_PART_H
#define RECTRAY_PART_H

#include "command/option.h"
#include "picture/part_note.h"
#include "scene/scene.h"

/* A run of things, counted from 0: rows, frames. */
typedef struct PartRange {
    int first, count;
} PartRange;

/* The part of `count` things. Parts are as equal as can be and none is empty, where there are N things. */
PartRange part_range(OptionPart part, int count);

/* False, with an ERROR_USAGE, where --part makes no sense beside another option, or there are too few things (called
 * `things`: "rows", "frames") for so many parts. */
bool part_check(const Options *options, int count, const char *things, Error *error);

/* The rows of a picture of so many that are in the part: whole blocks of the kernels, where there are enough. */
PartRange part_rows(OptionPart part, int rows);
Region part_region(OptionPart part, const Scene *scene);

/* What the part's file tells of it. precision: the one that is used. */
PartNote part_note(const Options *options, const Scene *scene, Precision precision);

#endif
