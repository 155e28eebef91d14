/* What the textbook tracer and each of its steps work with. */
#ifndef RECTRAY_TEXTBOOK_INPUT_H
#define RECTRAY_TEXTBOOK_INPUT_H

#include "scene/scene.h"
#include "trace/recorder.h"
#include "trace/render.h"

typedef struct Textbook {
    const Scene *scene;       /* its samples are a grid; adaptive sampling is not in the text */
    float shift;              /* how far off its face a point is shifted */
    RenderReport *report;     /* counts are added to it */
    const Recorder *recorder; /* is told the events of the reference; NULL: nobody is */
} Textbook;

#endif
