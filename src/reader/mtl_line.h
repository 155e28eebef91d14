/* A material library while it is read, and its keys but for newmtl. */
#ifndef RECTRAY_MTL_LINE_H
#define RECTRAY_MTL_LINE_H

#include "reader/line_scan.h"
#include "reader/mtl_library.h"

enum { MTL_DETAIL = 128 };

/* What is known of a material only when all its lines are read. */
typedef struct MtlDraft {
    bool has_diffuse;
    unsigned given;           /* bit i: the i-th key of watch_repeats */
    char picture[MTL_DETAIL]; /* map_Kd; empty: none */
    long picture_line;
    int illum; /* -1: none was given */
    long illum_line;
    double opaque, transparent; /* d and Tr; -1: not given */
    long opacity_line;
} MtlDraft;

typedef struct MtlReader {
    MtlLibrary *library;
    Notes *notes;
    LineScan scan;
    bool begun;          /* a newmtl was there */
    MtlMaterial *now;    /* the material of the lines that follow */
    MtlMaterial dropped; /* takes them before the first newmtl, and where the name is taken */
    MtlDraft draft;
} MtlReader;

/* Reads the rest of a line that begins with this key, and goes to the next line. */
bool mtl_read_key(MtlReader *reader, ScanWord key);

/* Says what is known now that all lines of the material are read. */
bool mtl_finish_material(MtlReader *reader);

#endif
