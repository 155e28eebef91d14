/* A mark in a picture. */
#include "picture/mark.h"

#include <stdbool.h>
#include <string.h>

enum { RADIUS = 4, SIDE = 2 * RADIUS + 1, LARGEST = 16, MARGIN = 4, GAP = 2 };

static unsigned char *pixel_of(const Image *image, int column, int row)
{
    bool inside = column >= 0 && column < image->columns && row >= 0 && row < image->rows;
    return inside ? image->rgb + ((size_t)row * (size_t)image->columns + (size_t)column) * 3 : NULL;
}

/* Black on what is bright, white on what is dark. */
static void contrast(const Image *image, int column, int row)
{
    unsigned char *rgb = pixel_of(image, column, row);
    if (rgb)
        memset(rgb, 30 * rgb[0] + 59 * rgb[1] + 11 * rgb[2] > 100 * 127 ? 0 : 255, 3);
}

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

static void draw_cross(const Image *image, int column, int row)
{
    int length = smaller(image->columns, image->rows) / 12;
    length = length < 4 ? 4 : length;
    for (int k = GAP; k < GAP + length; k++) {
        contrast(image, column + k, row);
        contrast(image, column - k, row);
        contrast(image, column, row + k);
        contrast(image, column, row - k);
    }
}

/* The neighbourhood before the mark was drawn; pixels outside the picture are grey. */
typedef struct Patch {
    unsigned char rgb[SIDE][SIDE][3];
} Patch;

static Patch patch_of(const Image *image, int column, int row)
{
    Patch patch;
    memset(&patch, 128, sizeof patch);
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            const unsigned char *rgb = pixel_of(image, column + x - RADIUS, row + y - RADIUS);
            if (rgb)
                memcpy(patch.rgb[y][x], rgb, 3);
        }
    return patch;
}

/* The patch, each pixel of it `scale` pixels wide, in a frame of one white and one black line. */
static void draw_patch(const Image *image, const Patch *patch, int scale, int left, int top)
{
    int size = SIDE * scale, middle = RADIUS * scale;
    for (int y = -2; y < size + 2; y++)
        for (int x = -2; x < size + 2; x++) {
            unsigned char *rgb = pixel_of(image, left + x, top + y);
            bool inside = x >= 0 && x < size && y >= 0 && y < size;
            bool white = x >= -1 && x <= size && y >= -1 && y <= size;
            if (rgb && inside)
                memcpy(rgb, patch->rgb[y / scale][x / scale], 3);
            else if (rgb)
                memset(rgb, white ? 255 : 0, 3);
        }
    for (int k = -1; k <= scale; k++) {
        contrast(image, left + middle + k, top + middle - 1);
        contrast(image, left + middle + k, top + middle + scale);
        if (k >= 0 && k < scale) {
            contrast(image, left + middle - 1, top + middle + k);
            contrast(image, left + middle + scale, top + middle + k);
        }
    }
}

void mark_draw(Image *image, int column, int row)
{
    Patch patch = patch_of(image, column, row);
    int scale = smaller(smaller(image->columns, image->rows) / (3 * SIDE), LARGEST), size = SIDE * scale;
    draw_cross(image, column, row);
    if (scale >= 2)
        draw_patch(image, &patch, scale, column < image->columns / 2 ? image->columns - size - MARGIN : MARGIN,
                   row < image->rows / 2 ? image->rows - size - MARGIN : MARGIN);
}
