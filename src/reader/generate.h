/* Seeded scenes of any size, as the text of a scene file: what speed is measured on, from a few faces to a million.
 * The same kind, size and seed give the same bytes on every machine: only +, -, *, / and sqrt make the numbers.
 * To add a kind: its writer, and its line in generate.c's table. */
#ifndef RECTRAY_GENERATE_H
#define RECTRAY_GENERATE_H

#include "base/error.h"

#include <stdint.h>
#include <stdio.h>

typedef struct GenerateKind {
    const char *name;
    int max_size; /* the smallest is 1 */
    const char *size_means;
    /* Fails only for want of memory; writing errors stay in `out`. */
    bool (*write)(FILE *out, int size, uint64_t seed, Error *error);
} GenerateKind;

extern const GenerateKind scene_kinds[]; /* ends in a NULL name */

/* The kind of that name; NULL, with an ERROR_USAGE that suggests the nearest one, where there is none. */
const GenerateKind *generate_find_kind(const char *name, Error *error);

/* Writes a scene, size from 1 to max_size. */
bool generate_scene(const GenerateKind *kind, FILE *out, int size, uint64_t seed, Error *error);

/* The writers. menger: the unit squares of a Menger sponge's surface after `level` steps, 2 20^level + 4 8^level of
 * them. city: `boxes` boxes on a floor box, 6 faces each. grid: a rotated sheet of `side` x `side` quads. */
bool generate_menger(FILE *out, int level, uint64_t seed, Error *error);
bool generate_city(FILE *out, int boxes, uint64_t seed, Error *error);
bool generate_grid(FILE *out, int side, uint64_t seed, Error *error);

#endif
