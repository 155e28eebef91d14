/* Reads the scene that a command works on, and tells what reading it had to say. */
#ifndef RECTRAY_SCENE_OPEN_H
#define RECTRAY_SCENE_OPEN_H

#include "command/options.h"
#include "reader/scene_film.h"

/* scene_load for the first operand. Its notes go to standard error, unless --quiet; --strict makes an error of them. */
bool scene_open(Scene *scene, const Options *options, Error *error);

/* The first part of it: the scene with the changes that options ask for; its notes are not told. */
bool scene_open_load(Scene *scene, const Options *options, Error *error);

/* The text of the scene as the options want it, at their frame, as an ordinary scene: scene_frame_text. */
char *scene_open_frame(const Options *options, Error *error);

/* The scene as a film, for its frames one after the other. */
typedef struct OpenFilm {
    SceneFilm film;
    struct Edits *edits;
} OpenFilm;

/* scene_film_open for the first operand, with the changes that options ask for. Close it also after a failure. */
bool scene_open_film(OpenFilm *opened, const Options *options, Error *error);
void scene_close_film(OpenFilm *opened);

/* What scene_open does with a scene's notes; with `every`, tells each place of each. */
bool scene_open_tell(const Notes *notes, const Options *options, bool every, Error *error);

#endif
