/* The receiving end of a render: bands of rows come in and are encoded at once, so that no more than a band of the
 * picture is in memory. The whole is kept only where a pixel is to be marked, or colours are linear. */
#ifndef RECTRAY_PAINTER_H
#define RECTRAY_PAINTER_H

#include "command/options.h"
#include "command/progress.h"
#include "opencl/backend.h"
#include "picture/image.h"

typedef struct Painter {
    ImageWriter *writer;
    Progress progress; /* the caller starts and ends it */
    double encode_ms;
    Region region;           /* of the picture: what is painted */
    bool varies;             /* some pixel has another colour than the first */
    unsigned char colour[3]; /* of the first pixel */
    Image marked;            /* the whole region, where a pixel of it is to be marked; else without pixels */
    double *linear;          /* the whole region in linear colours, where they are written; else NULL */
} Painter;

/* What the picture will be by its name and the options. Errors: formats and options that exclude each other. */
bool painter_kind(const Options *options, const char *output, ImageKind *kind, Error *error);

/* Opens the file. Errors: those of image_writer_open_as, memory; then the file is as it was, nothing is to be freed. */
bool painter_begin(Painter *painter, const Options *options, const char *output, ImageKind kind, Region region,
                   Error *error);

/* Takes the bands. */
BandSink painter_sink(Painter *painter);

/* The picture is traced: writes what was kept and completes the file. Errors: those of writing; then the file is as
 * it was before. Frees what the painter holds. */
bool painter_finish(Painter *painter, const Options *options, Error *error);

/* Leaves the file as it was, and frees what the painter holds. */
void painter_abort(Painter *painter);

#endif
