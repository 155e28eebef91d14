/* Moving scenes: an animation is a function from a scene file and the number of a frame to an ordinary scene file. It
 * is applied before the scene is read, so that no other part of rectray knows of time. To let something else move, add
 * a kind of track (scene_track.h). */
#ifndef RECTRAY_SCENE_ANIMATION_H
#define RECTRAY_SCENE_ANIMATION_H

#include "reader/scene_orbit.h"
#include "reader/scene_track.h"

typedef struct SceneAnimation {
    Json json; /* of the scene file */
    int frames;
    double fps;
    Track *tracks;
    int track_count, track_capacity;
    Orbit orbit;
    bool moves_objects; /* else all frames have the same faces */
} SceneAnimation;

/* Whether a text that is JSON has the key "animation" at its top. */
bool scene_animation_is_in(const char *text);

/* Reads the animation of a scene file whose text ends in a NUL; takes over the text. Every key is checked, whatever
 * frame is wanted. False with the error filled and nothing to free. */
bool scene_animation_open(SceneAnimation *animation, const char *name, char *text, Error *error);

/* The scene file of a frame, from 0 to frames - 1, on the heap: the text with the values of that frame. The animation
 * still stands in it. NULL with the error filled. */
char *scene_animation_frame(const SceneAnimation *animation, int frame, Error *error);

void scene_animation_free(SceneAnimation *animation);

#endif
