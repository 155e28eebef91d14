/* The picture of a scene, small, for the drawing of `rectray trace`. */
#include "command/trace_picture.h"

#include "picture/image.h"
#include "trace/reference_render.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool take_band(void *user, int first_row, int rows, const unsigned char *rgb, const RenderReport *so_far,
                      Error *error)
{
    Image *image = user;
    size_t row = (size_t)image->columns * 3;
    (void)so_far;
    (void)error;
    memcpy(image->rgb + (size_t)first_row * row, rgb, (size_t)rows * row);
    return true;
}

/* The scene with at most TRACE_PICTURE_MAX pixels along a side of its picture. */
static Scene reduced(const Scene *scene)
{
    Scene small = *scene;
    Screen *screen = &small.screen;
    int longest = screen->columns > screen->rows ? screen->columns : screen->rows;
    if (longest <= TRACE_PICTURE_MAX)
        return small;
    double scale = TRACE_PICTURE_MAX / (double)longest;
    screen->height = screen_height(&scene->screen);
    screen->columns = (int)fmax(1, round(scale * screen->columns));
    screen->rows = (int)fmax(1, round(scale * screen->rows));
    small.adaptive = false;
    small.grid = 2;
    return small;
}

/* Base 64 (RFC 4648). NULL without memory. */
static char *base64_of(const char *bytes, size_t size)
{
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    char *text = malloc((size + 2) / 3 * 4 + 1), *at = text;
    if (!text)
        return NULL;
    for (size_t i = 0; i < size; i += 3) {
        unsigned left = size - i > 2 ? 3 : (unsigned)(size - i), group = 0;
        for (unsigned k = 0; k < 3; k++)
            group = group << 8 | (k < left ? (unsigned char)bytes[i + k] : 0);
        for (unsigned k = 0; k < 4; k++)
            *at++ = k <= left ? letters[group >> (18 - 6 * k) & 63] : '=';
    }
    *at = '\0';
    return text;
}

static bool render(Image *image, const Scene *scene, Error *error)
{
    *image = (Image){.columns = scene->screen.columns, .rows = scene->screen.rows};
    image->rgb = malloc((size_t)image->columns * (size_t)image->rows * 3);
    if (!image->rgb)
        return error_memory(error, "the picture");
    RenderSettings settings = {.device = -1, .threads = 1};
    RenderReport report = {0};
    return reference_render(scene, &settings, (BandSink){take_band, image}, &report, error);
}

bool trace_picture_make(WalkthroughPicture *picture, const Scene *scene, Error *error)
{
    Scene small = reduced(scene);
    Image image;
    char *png = NULL;
    size_t size = 0;
    *picture = (WalkthroughPicture){.reduced = small.screen.columns != scene->screen.columns};
    bool done = render(&image, &small, error) && image_encode(&image, &png, &size, error);
    if (done)
        picture->base64 = base64_of(png, size);
    if (done && !picture->base64)
        done = error_memory(error, "the picture");
    free(png);
    image_free(&image);
    return done;
}

void trace_picture_free(WalkthroughPicture *picture)
{
    free(picture->base64);
    *picture = (WalkthroughPicture){0};
}
