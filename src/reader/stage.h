/* A neutral stage for a model that has no scene: a floor, two lights, a three-quarter view. */
#ifndef RECTRAY_STAGE_H
#define RECTRAY_STAGE_H

#include "base/error.h"

/* Whether a file is a model by its ending: .obj, .ply or .stl, in small letters or large ones. */
bool stage_is_model(const char *path);

/* The text of a scene file that shows the model; the caller frees it. The model is read for its size. Its path is as
 * given: it counts from the folder of whoever reads the text. NULL with the error of the model, or without memory. */
char *stage_text(const char *model_path, Error *error);

#endif
