/* Work that a scene does not need and that is left out: each kind has a name, a count and a switch, so that what it
 * buys can be measured. None changes a byte of a picture. docs/performance.md has the figures. */
#ifndef RECTRAY_SKIP_H
#define RECTRAY_SKIP_H

#include "scene/scene.h"
#include "trace/render.h"

typedef struct SkipText {
    const char *name;  /* of --no-skip and in the JSON of --stats */
    const char *words; /* in the table of --stats */
} SkipText;

extern const SkipText skip_texts[SKIP_KINDS]; /* by SKIP_... of kernels/shared/skips.h */

/* Is that work to be left out? */
bool skip_wanted(const RenderSettings *settings, int skip);

/* Marks the faces of closed boxes: six two-sided faces in a row in the scene, flat across the axes, that enclose a box
 * which the camera and all lights are outside of. A ray from outside meets a front of it before, or at, any back.
 * closed: one per face, zeroed by the caller: 1 + 2 axis for the low side of a box, one more for the high one.
 * threads: as parallel_threads wants them; the marks do not depend on them.
 * docs/bounds.md has the proof that backs need not be asked. */
void skip_closed_boxes(const Scene *scene, unsigned char *closed, int threads);

#endif
