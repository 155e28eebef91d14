/* The pixels around the one that a walkthrough tells. */
#include "walkthrough/walkthrough.h"

#include "trace/reference.h"

#include <string.h>

bool walkthrough_look_around(Walkthrough *walk, Error *error)
{
    const Scene *scene = walk->scene;
    Accel accel; /* finds the same faces, and sooner */
    if (!accel_build(&accel, scene, ACCEL_AUTO, 1, error))
        return false;
    RenderReport report = {0};
    Tracer tracer = {.scene = scene, .accel = &accel, .report = &report};
    for (int k = 0; k < 9; k++) {
        int column = walk->request.column + k % 3 - 1, row = walk->request.row + k / 3 - 1;
        bool there = column >= 0 && column < scene->screen.columns && row >= 0 && row < scene->screen.rows;
        unsigned char *rgb = walk->around.rgb[k];
        walk->around.there[k] = there;
        if (k == AROUND_SELF) {
            memcpy(rgb, walk->events[walk->count - 1].as.pixel.rgb, 3);
        } else if (there) {
            Vec3 colour = reference_pixel(&tracer, column, row);
            rgb[0] = colour_to_byte(colour.x);
            rgb[1] = colour_to_byte(colour.y);
            rgb[2] = colour_to_byte(colour.z);
        }
    }
    accel_free(&accel);
    return true;
}
