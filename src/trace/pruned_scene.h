/* A scene without what no pixel can show. */
#ifndef RECTRAY_PRUNED_SCENE_H
#define RECTRAY_PRUNED_SCENE_H

#include "scene/scene.h"
#include "trace/render.h"

/* A scene without what cannot matter to any pixel, for rendering. It shares the rest with the scene that it was made
 * from, which must outlive it, and which it is a plain copy of where there is nothing to leave out. */
typedef struct PrunedScene {
    Scene scene;
    Light *lights; /* its own, or NULL */
    Face *faces;
    Plane *planes;
} PrunedScene;

/* Makes it, and counts in the report what was left out. False
 * without memory; pruned_scene_free may be called in any case. */
bool pruned_scene_make(PrunedScene *pruned, const Scene *scene, const RenderSettings *settings, RenderReport *report,
                       Error *error);

void pruned_scene_free(PrunedScene *pruned);

#endif
