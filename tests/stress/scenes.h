/* Scenes made in memory: faces given in double and rounded once, as the readers do, but not moved to their centre, so
 * that the arithmetic gets no help. */
#ifndef RECTRAY_STRESS_SCENES_H
#define RECTRAY_STRESS_SCENES_H

#include "random.h"
#include "scene/scene.h"

/* A scene without faces, with one dull material. scene_free frees it. */
Scene scene_empty(void);

/* Adds a quad, or a triangle (count 3), and returns its index. */
int scene_add(Scene *scene, const Vec3 *corners, int count);

void scene_add_light(Scene *scene, Vec3 position);

/* The six sides of a box: corner + a, b, c edges. */
void scene_add_box(Scene *scene, Vec3 corner, Vec3 a, Vec3 b, Vec3 c);

/* A grid of cells x cells squares of the given spacing in a rotated plane around `centre`; sheet_vertex gives a corner,
 * i along the rows, as rounded. */
typedef struct Sheet {
    Scene scene;
    int cells;
    double spacing;
    Vec3 centre;
    Rotation rotation;
} Sheet;

Sheet sheet_make(Random *random, int cells, double spacing, Vec3 centre);
Vec3 sheet_vertex(const Sheet *sheet, int i, int j);

/* Writes the scene as JSON such that loading it changes no vertex and no number of a face. */
void scene_write(const Scene *scene, const char *path);

/* vec3 <-> three doubles */
Vec3 vec3_at(const double *numbers);
void vec3_put(double *numbers, Vec3 a);
Vec3 vec3_rounded(Vec3 a); /* to floats */

#endif
