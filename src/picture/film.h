/* Films: frames go as raw pixels through a pipe to ffmpeg, which makes a file of them. No frame becomes a file on the
 * way. To add a format: its ending and its options in film.c. */
#ifndef RECTRAY_FILM_H
#define RECTRAY_FILM_H

#include "base/error.h"

typedef struct Film Film;

/* Whether a file is a film by its ending: .mp4, .webm or .gif, in small letters or large ones. */
bool film_is(const char *path);

/* Starts ffmpeg, for frames of that size and so many in a second. NULL, with an ERROR_SYSTEM, where it is not installed
 * or the file cannot be written. */
Film *film_open(const char *path, int columns, int rows, double fps, Error *error);

/* The path of the pipe: each frame is written there, rows from the top, 3 bytes a pixel. */
const char *film_pipe(const Film *film);

/* All frames are there: waits for ffmpeg, gives the film its name and frees it, also where that fails. An ERROR_SYSTEM
 * has ffmpeg's own words. */
bool film_commit(Film *film, Error *error);

/* Leaves what was under the film's name as it was, stops ffmpeg and frees the film, which may be NULL. Where the pipe
 * is broken, ffmpeg has ended by itself, and the error gets its words. */
void film_abort(Film *film, bool pipe_is_broken, Error *error);

#endif
