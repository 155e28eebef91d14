/* A scene that moves, frame after frame: what is the same in all of them is read once. */
#ifndef RECTRAY_SCENE_FILM_H
#define RECTRAY_SCENE_FILM_H

#include "reader/scene_animation.h"
#include "reader/scene_edit.h"
#include "scene/scene.h"

typedef struct SceneFilm {
    SceneEdits edits; /* borrowed */
    SceneAnimation animation;
} SceneFilm;

/* Reads a scene file with an animation; `path` and the edits must outlive the film. Errors: those of scene_load_edited
 * up to the choice of the frame; a scene without an animation (ERROR_USAGE). Free it also after a failure. */
bool scene_film_open(SceneFilm *film, const char *path, SceneEdits edits, Error *error);
void scene_film_free(SceneFilm *film);

/* Makes the scene that of a frame: what scene_load_edited gives for it. The scene is zeroed, or that of another frame
 * of the film; then its faces stay in their place where no object moves. After a failure it is zeroed. */
bool scene_film_frame(const SceneFilm *film, int frame, Scene *scene, Error *error);

#endif
