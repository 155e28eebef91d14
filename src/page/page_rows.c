/* Pictures for the page: rows of pixels, coarse ones first, and maps. */
#include "page/page.h"

#include "picture/map.h"
#include "scene/light.h"
#include "trace/reference.h"
#include "trace/textbook.h"

#include <stdlib.h>
#include <string.h>

static bool make_room(Page *page, int columns, int rows)
{
    unsigned char *pixels = realloc(page->pixels, (size_t)columns * (size_t)rows * 4);
    if (pixels)
        page->pixels = pixels;
    return pixels != NULL;
}

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

void page_trace_pixel(const Page *page, PageArithmetic arithmetic, int column, int row, unsigned char rgb[3])
{
    RenderReport report = {0};
    Textbook textbook = {.scene = &page->scene, .shift = SCENE_SHIFT, .report = &report};
    if (arithmetic == PAGE_TEXTBOOK) {
        textbook_pixel(&textbook, column, row, rgb);
        return;
    }
    if (arithmetic == PAGE_TEXTBOOK_FLOAT) {
        textbook_pixel_float(&textbook, column, row, rgb);
        return;
    }
    Tracer tracer = {.scene = &page->scene, .accel = &page->accel, .report = &report};
    Vec3 c = reference_pixel(&tracer, column, row);
    rgb[0] = colour_to_byte(c.x);
    rgb[1] = colour_to_byte(c.y);
    rgb[2] = colour_to_byte(c.z);
}

/* The pixel in the middle of a block stands for all of it. */
static void render_block(Page *page, int first, int count, int row, int column, int step)
{
    int columns = page->scene.screen.columns;
    int width = smaller(columns - column, step), height = smaller(count - row, step);
    unsigned char rgba[4] = {0, 0, 0, 255};
    page_trace_pixel(page, page->arithmetic, column + width / 2, first + row + height / 2, rgba);
    for (int j = row; j < row + height; j++)
        for (int i = column; i < column + width; i++)
            memcpy(page->pixels + 4 * ((size_t)j * (size_t)columns + (size_t)i), rgba, 4);
}

bool page_render_rows(Page *page, int first, int count, int step)
{
    if (!make_room(page, page->scene.screen.columns, count))
        return error_memory(&page->error, "the picture");
    for (int row = 0; row < count; row += step)
        for (int column = 0; column < page->scene.screen.columns; column += step)
            render_block(page, first, count, row, column, step);
    return true;
}

bool page_draw_map(Page *page, MapKind kind)
{
    Image image;
    MapScale scale = {0, 0};
    bool done = map_draw(&image, &page->scene, kind, &(RenderSettings){.threads = 1}, &scale, &page->error);
    if (done && !make_room(page, image.columns, image.rows))
        done = error_memory(&page->error, "the map");
    for (size_t k = 0; done && k < (size_t)image.columns * (size_t)image.rows; k++) {
        memcpy(page->pixels + 4 * k, image.rgb + 3 * k, 3);
        page->pixels[4 * k + 3] = 255;
    }
    if (done) {
        page->low = scale.low;
        page->high = scale.high;
    }
    free(image.rgb);
    return done;
}
