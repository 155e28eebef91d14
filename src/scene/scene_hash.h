/* A number that two scenes share only if every picture of them is the same, as far as chance lets it. */
#ifndef RECTRAY_SCENE_HASH_H
#define RECTRAY_SCENE_HASH_H

#include "scene/scene.h"

#include <stdint.h>

#define HASH_START 14695981039346656037u

/* Continues a hash with a text and its final NUL, or with the scene: all that a pixel depends on, and no names. It is
 * FNV-1a of 64 bits (Fowler, Noll, Vo 1991), the same on every machine. */
uint64_t scene_hash_text(uint64_t hash, const char *text);
uint64_t scene_hash_all(uint64_t hash, const Scene *scene);

#endif
