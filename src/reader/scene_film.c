/* Of a frame in which no object moves, the camera and the lights are read alone. */
#include "reader/scene_film.h"

#include "base/text.h"
#include "reader/scene_text.h"
#include "json/json_scan.h"

#include <stdlib.h>
#include <string.h>

bool scene_film_open(SceneFilm *film, const char *path, SceneEdits edits, Error *error)
{
    long length = 0;
    const char *name = text_input_name(path);
    char *text = text_read_input(path, JSON_MAX_BYTES, &length, error);
    *film = (SceneFilm){.edits = edits};
    if (!text)
        return false;
    bool is_json = !json_scan(text, length).place;
    if (is_json && !(text = scene_edit_text(text, edits, SCENE_EDIT_ANIMATION, error)))
        return false;
    if (!is_json || scene_animation_is_in(text))
        return scene_animation_open(&film->animation, name, text, error);
    free(text);
    return error_set(error, ERROR_USAGE, "there are no frames: %s has no \"animation\"", name);
}

void scene_film_free(SceneFilm *film)
{
    scene_animation_free(&film->animation);
}

bool scene_film_frame(const SceneFilm *film, int frame, Scene *scene, Error *error)
{
    Error reason = {.kind = ERROR_NONE};
    const SceneAnimation *animation = &film->animation;
    SceneEdits edits = film->edits;
    edits.frame = frame;
    edits.has_frame = true;
    bool same_faces = scene->faces && !animation->moves_objects;
    if (!same_faces)
        scene_free(scene);
    char *text = scene_animation_frame(animation, frame, error);
    text = text ? scene_edit_text(text, edits, SCENE_EDIT_FRAME, error) : NULL;
    if (text &&
        (same_faces ? scene_text_move(scene, animation->json.name, text, &reason)
                    : scene_text_read(SCENE_WAY_ANY, scene, animation->json.name, text, (long)strlen(text), &reason)))
        return true;
    scene_free(scene);
    return text && scene_edit_fail(edits, true, &reason, error);
}
