/* The functions that the page's JavaScript calls, with the one page that they are about. Each is a line or two: what
 * it does is told in page.h. A function that can fail returns 0 or NULL, and page_error has the message. */
#include "page/page.h"

#include "reader/scene_json.h"
#include "walkthrough/walkthrough_formats.h"
#include "walkthrough/walkthrough_words.h"

#include <stdlib.h>
#include <string.h>

static Page page;

PAGE_EXPORT(page_alloc) void *page_alloc(int bytes);
PAGE_EXPORT(page_free) void page_free(void *block);
PAGE_EXPORT(page_error) const char *page_error(void);
PAGE_EXPORT(page_open) int page_open(const char *path);
PAGE_EXPORT(page_set) void page_set(int columns, int rows, int grid, int adaptive, int arithmetic, int tree);
PAGE_EXPORT(page_bytes) int page_bytes(int column, int row, int arithmetic);
PAGE_EXPORT(page_value) double page_value(int which);
PAGE_EXPORT(page_rows) const unsigned char *page_rows(int first, int count, int step);
PAGE_EXPORT(page_map) const unsigned char *page_map(int kind);
PAGE_EXPORT(page_trace) const char *page_trace(int column, int row, int sample, int format, int flags, int columns);
PAGE_EXPORT(page_diff) const char *page_diff(int column, int row, int other_column, int other_row, int columns);
PAGE_EXPORT(page_numbers) const float *page_numbers(void);
PAGE_EXPORT(page_faces) int page_faces(void);
PAGE_EXPORT(page_places) int page_places(void);
PAGE_EXPORT(page_seen) int page_seen(void);
PAGE_EXPORT(page_lines) int page_lines(int column, int row, int sample);
PAGE_EXPORT(page_tested) int page_tested(int column, int row, int sample, int hit, int light);
PAGE_EXPORT(page_nodes) int page_nodes(int column, int row, int hit, int light);
PAGE_EXPORT(page_text) const char *page_text(void);
PAGE_EXPORT(page_node_verdict) const char *page_node_verdict(int verdict);
PAGE_EXPORT(page_face_name) const char *page_face_name(int face);
PAGE_EXPORT(page_verdict) const char *page_verdict(int verdict);

void *page_alloc(int bytes)
{
    return malloc((size_t)bytes);
}

void page_free(void *block)
{
    free(block);
}

const char *page_error(void)
{
    return page.error.text;
}

/* Reads the scene of that name, and builds its tree. The scene before stays where this one is wrong. */
int page_open(const char *path)
{
    Scene scene = {0};
    Accel accel = {.kind = ACCEL_NONE};
    char *copy = strdup(path);
    page.error = (Error){.kind = ERROR_NONE};
    if (!copy || !scene_load(&scene, copy, &page.error) || !accel_build(&accel, &scene, ACCEL_AUTO, 1, &page.error)) {
        accel_free(&accel);
        scene_free(&scene);
        free(copy);
        return 0;
    }
    accel_free(&page.accel);
    accel_free(&page.tree);
    scene_free(&page.scene);
    free(page.path);
    page.scene = scene;
    page.accel = accel;
    page.tree = (Accel){.kind = ACCEL_NONE};
    page.path = copy;
    return 1;
}

/* Other pixels and rays than the scene's; 0 leaves them. tree: an AccelKind, of walkthroughs; without memory there is
 * none. */
void page_set(int columns, int rows, int grid, int adaptive, int arithmetic, int tree)
{
    page.arithmetic = (PageArithmetic)arithmetic;
    if (columns > 0) {
        page.scene.screen.columns = columns;
        page.scene.screen.rows = rows;
    }
    if (grid > 0) {
        page.scene.grid = grid;
        page.scene.adaptive = adaptive != 0;
    }
    if (page.tree.kind == (AccelKind)tree)
        return;
    accel_free(&page.tree);
    if (!accel_build(&page.tree, &page.scene, (AccelKind)tree, 1, &page.error))
        page.tree = (Accel){.kind = ACCEL_NONE};
}

/* In the order of tracer.js. */
double page_value(int which)
{
    const double values[] = {page.scene.screen.columns, page.scene.screen.rows, page.scene.grid, page.scene.adaptive,
                             page.scene.face_count,     page.scene.light_count, page.low,        page.high,
                             (double)page.text_length};
    return which >= 0 && which < (int)(sizeof values / sizeof *values) ? values[which] : 0;
}

const unsigned char *page_rows(int first, int count, int step)
{
    return page_render_rows(&page, first, count, step) ? page.pixels : NULL;
}

/* A pixel's bytes as one number, red first. */
int page_bytes(int column, int row, int arithmetic)
{
    unsigned char rgb[3];
    page_trace_pixel(&page, (PageArithmetic)arithmetic, column, row, rgb);
    return rgb[0] << 16 | rgb[1] << 8 | rgb[2];
}

const unsigned char *page_map(int kind)
{
    return page_draw_map(&page, (MapKind)kind) ? page.pixels : NULL;
}

/* A sample's number counts along the rows of the pixel's grid. */
static WalkthroughRequest request_of(int column, int row, int sample)
{
    int n = page.scene.grid < 1 ? 1 : page.scene.grid;
    return (WalkthroughRequest){.column = column, .row = row, .i = sample % n, .j = sample / n};
}

/* format: a PageFormat. flags: 1 verbose, 2 colour. columns: of a line; 0: the usual. */
const char *page_trace(int column, int row, int sample, int format, int flags, int columns)
{
    WalkthroughRequest request = request_of(column, row, sample);
    WalkthroughStyle style = {.colour = flags & 2 ? INK_TRUE : INK_PLAIN, .columns = columns};
    request.verbose = (flags & 1) != 0;
    return page_write_walk(&page, (PageFormat)format, request, style) ? page.text : NULL;
}

const char *page_diff(int column, int row, int other_column, int other_row, int columns)
{
    WalkthroughStyle style = {.columns = columns};
    bool done = page_write_diff(&page, request_of(column, row, 0), request_of(other_column, other_row, 0), style);
    return done ? page.text : NULL;
}

/* --- Lists of numbers: each call returns how many there are --- */

const float *page_numbers(void)
{
    return page.numbers.values;
}

int page_faces(void)
{
    page_list_faces(&page);
    return page.numbers.count;
}

int page_places(void)
{
    page_list_places(&page);
    return page.numbers.count;
}

int page_seen(void)
{
    page_list_seen(&page);
    return page.numbers.count;
}

int page_lines(int column, int row, int sample)
{
    return page_list_lines(&page, request_of(column, row, sample)) ? page.numbers.count : 0;
}

int page_tested(int column, int row, int sample, int hit, int light)
{
    return page_list_tested(&page, request_of(column, row, sample), hit, light) ? page.numbers.count : 0;
}

/* Of sample 0. */
int page_nodes(int column, int row, int hit, int light)
{
    return page_list_nodes(&page, request_of(column, row, 0), hit, light) ? page.numbers.count : 0;
}

/* What the program says of these nodes, a line each. */
const char *page_text(void)
{
    return page.text;
}

/* --- Names --- */

const char *page_face_name(int face)
{
    static InkText name;
    name = walkthrough_face_words(&page.scene, face, 40);
    return name.text;
}

const char *page_verdict(int verdict)
{
    return verdict >= 0 && verdict < FACE_VERDICT_COUNT ? walkthrough_face_verdicts[verdict] : "";
}

const char *page_node_verdict(int verdict)
{
    return verdict >= 0 && verdict < NODE_VERDICT_COUNT ? walkthrough_node_verdicts[verdict] : "";
}
