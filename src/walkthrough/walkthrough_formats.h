/* The formats of a walkthrough, one file each. They write to a stream, whose errors the caller looks at. To add one:
 * its writer's file, and its name here and in the two tables of walkthrough_formats.c. */
#ifndef RECTRAY_WALKTHROUGH_FORMATS_H
#define RECTRAY_WALKTHROUGH_FORMATS_H

#include "walkthrough/ink.h"
#include "walkthrough/walkthrough.h"
#include "walkthrough/walkthrough_step.h"

typedef enum WalkthroughFormat {
    WALKTHROUGH_TEXT,
    WALKTHROUGH_JSON,
    WALKTHROUGH_OBJ,
    WALKTHROUGH_SVG
} WalkthroughFormat;

/* What users call them; ends in a NULL. */
extern const char *const walkthrough_format_words[];

/* Which parts of the text and of the JSON are written: the summary and the steps, or one of them. */
typedef enum WalkthroughParts { WALKTHROUGH_WHOLE, WALKTHROUGH_SUMMARY, WALKTHROUGH_STEPS } WalkthroughParts;

/* The scene's picture, for drawings in which it stands on its screen. */
typedef struct WalkthroughPicture {
    char *base64; /* of its PNG */
    bool reduced; /* it has fewer pixels than the scene asks for */
} WalkthroughPicture;

typedef struct WalkthroughStyle {
    WalkthroughParts parts;
    InkColour colour;                        /* text */
    int columns;                             /* text: of a line; 0: INK_COLUMNS */
    bool with_scene;                         /* OBJ: the scene's faces, too */
    const WalkthroughPicture *picture;       /* SVG; NULL: the screen stays empty */
    const WalkthroughStepListener *listener; /* text: is told of each step; NULL: nobody is */
} WalkthroughStyle;

/* Fails only for want of memory. */
typedef bool WalkthroughWriter(FILE *out, const Walkthrough *walk, WalkthroughStyle style, Error *error);

WalkthroughWriter walkthrough_write_text, walkthrough_write_json, walkthrough_write_obj, walkthrough_write_svg;

/* The writer of a format. */
WalkthroughWriter *walkthrough_writer(WalkthroughFormat format);

/* For the web page: an answer and the steps of the text, as one JSON object. */
WalkthroughWriter walkthrough_write_steps;

#endif
