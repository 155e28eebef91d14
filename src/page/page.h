/* What the web page asks of the tracer: a scene, rows of its picture, maps, the walkthrough of a pixel, and the
 * numbers that its drawing in space is made of. page_module.c exports these to JavaScript (tracer.js calls them); all
 * else here knows nothing of a browser. One scene at a time. What is returned belongs to the page and lasts until its
 * next call. To add a call: a function here, and its method in tracer.js. */
#ifndef RECTRAY_PAGE_H
#define RECTRAY_PAGE_H

#include "trace/accel.h"
#include "trace/render.h"
#include "walkthrough/walkthrough_formats.h"

/* Exported where the target is a web page; a plain function elsewhere, such as in tests. */
#ifdef __wasm__
#define PAGE_EXPORT(name) __attribute__((export_name(#name)))
#else
#define PAGE_EXPORT(name)
#endif

/* Floats for JavaScript, which grow as they come. */
typedef struct PageNumbers {
    float *values;
    int count, capacity;
} PageNumbers;

/* How a picture is computed: with the guards against rounding, or by the taught formulas as they stand. */
typedef enum PageArithmetic { PAGE_EXACT, PAGE_TEXTBOOK, PAGE_TEXTBOOK_FLOAT } PageArithmetic;

typedef struct Page {
    Scene scene;
    PageArithmetic arithmetic; /* of rows, and of what the textbook finds */
    Accel accel;               /* of rows */
    Accel tree; /* of walkthroughs: none, so that every face is tested as it is taught, or what is asked for */
    Error error;
    char *path;
    char *text; /* the last one written */
    size_t text_length;
    unsigned char *pixels; /* RGBA, of the rows last rendered or the map last drawn */
    double low, high;      /* of that map's scale */
    PageNumbers numbers;   /* the last list */
} Page;

/* --- page_rows.c --- */

/* The bytes of one pixel, in any arithmetic. */
void page_trace_pixel(const Page *page, PageArithmetic arithmetic, int column, int row, unsigned char rgb[3]);

/* Renders the rows [first, first + count); with step > 1 one pixel of each block of step x step. False without
 * memory. */
bool page_render_rows(Page *page, int first, int count, int step);

/* Draws a map of the whole picture. */
bool page_draw_map(Page *page, MapKind kind);

/* --- page_text.c: all write page->text --- */

/* PAGE_TEXT to PAGE_SVG: a WalkthroughFormat; then the answer and the steps, and of textbook arithmetic its text and
 * its steps. */
typedef enum PageFormat {
    PAGE_TEXT,
    PAGE_JSON,
    PAGE_OBJ,
    PAGE_SVG,
    PAGE_STEPS,
    PAGE_TEXTBOOK_TEXT,
    PAGE_TEXTBOOK_STEPS,
    PAGE_FORMAT_COUNT
} PageFormat;

bool page_write_walk(Page *page, PageFormat format, WalkthroughRequest request, WalkthroughStyle style);

/* Where the walkthroughs of two pixels part. */
bool page_write_diff(Page *page, WalkthroughRequest one, WalkthroughRequest other, WalkthroughStyle style);

/* --- page_space.c: lists of numbers, positions as in the scene file --- */

void page_add_number(PageNumbers *numbers, double value);
void page_add_vector(PageNumbers *numbers, Vec3 v);

/* Of each face PAGE_FACE_NUMBERS: how many vertices, which object, whether it is one-sided, four vertices, its colour
 * under white light, its normal. */
enum { PAGE_FACE_NUMBERS = 21 };
void page_list_faces(Page *page);

/* The camera, what it looks at, up, the screen's four corners from the top left clockwise; then each light. */
void page_list_places(Page *page);

/* Where the camera's rays arrive, here and there over the picture: 3 numbers each. They tell how large the view must
 * be. */
void page_list_seen(Page *page);

/* The lines of a walkthrough, PAGE_LINE_NUMBERS each: kind, from, to, stop, hit, light, face, leaves. */
enum { PAGE_LINE_NUMBERS = 14 };
bool page_list_lines(Page *page, WalkthroughRequest request);

/* The faces that one search tested, 2 numbers each: the face, its FaceVerdict. The search is that of the ray that
 * looks for hit `hit`, or with light >= 0 that of the shadow ray from there to this light. */
bool page_list_tested(Page *page, WalkthroughRequest request, int hit, int light);

/* The nodes of page->tree that such a search met, PAGE_NODE_NUMBERS each: NodeVerdict, leaf, level, the box's low and
 * high corner. What the text says of them is page->text, a line each. */
enum { PAGE_NODE_NUMBERS = 9 };
bool page_list_nodes(Page *page, WalkthroughRequest request, int hit, int light);

#endif
