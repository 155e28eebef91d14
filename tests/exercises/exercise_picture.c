/* The student's picture beside ours, with a white stripe between them. */
#include "exercises/exercise_picture.h"

#include "picture/image.h"

#include <stdlib.h>
#include <string.h>

enum { STRIPE = 4, WITHIN = 2 };

static bool far_apart(const unsigned char *a, const unsigned char *b)
{
    for (int k = 0; k < 3; k++)
        if (abs(a[k] - b[k]) > WITHIN)
            return true;
    return false;
}

bool exercise_picture(const Scene *scene, const Exercise *exercise, const char *path, PictureDifference *found,
                      Error *error)
{
    ExercisePixel *ours = exercise->ours ? exercise->ours : textbook_pixel;
    RenderReport report = {0};
    Textbook textbook = {.scene = scene, .shift = SCENE_SHIFT, .report = &report};
    int columns = scene->screen.columns, rows = scene->screen.rows;
    Image both = {.columns = 2 * columns + STRIPE, .rows = rows};
    both.rgb = malloc((size_t)both.columns * (size_t)rows * 3);
    if (!both.rgb)
        return error_set(error, ERROR_SYSTEM, "not enough memory");
    memset(both.rgb, 255, (size_t)both.columns * (size_t)rows * 3);
    *found = (PictureDifference){0};
    for (int row = 0; row < rows; row++)
        for (int column = 0; column < columns; column++) {
            unsigned char *left = both.rgb + 3 * ((size_t)row * (size_t)both.columns + (size_t)column);
            unsigned char *right = left + 3 * (columns + STRIPE);
            exercise->pixel(&textbook, column, row, left);
            ours(&textbook, column, row, right);
            if (far_apart(left, right) && found->differing++ == 0) {
                found->column = column;
                found->row = row;
                memcpy(found->returned, left, 3);
                memcpy(found->expected, right, 3);
            }
        }
    found->wrong = 200 * found->differing > columns * rows;
    bool written = image_write(&both, path, error);
    image_free(&both);
    return written;
}
