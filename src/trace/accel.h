/* How a tracer finds faces: one by one, or through a tree. To add a
 * tree, add a kind in render.h and a case to each function here. */
#ifndef RECTRAY_ACCEL_H
#define RECTRAY_ACCEL_H

#include "trace/bvh.h"
#include "trace/kdtree.h"
#include "trace/render.h"
#include "trace/traversal.h"

/* Scenes of fewer faces than this are traced face by face unless the user says otherwise. At twelve faces a tree makes
 * a ray a quarter faster, at forty four times as fast; below, there is nothing to win. */
enum { ACCEL_AUTO_FACES = 12 };

typedef struct Accel {
    AccelKind kind; /* what was built: ACCEL_AUTO only before */
    Bvh bvh;
    KdTree kdtree;
} Accel;

/* Builds what `kind` asks for; ACCEL_AUTO is a BVH, and none for small scenes. A scene without faces gets none. */
bool accel_build(Accel *accel, const Scene *scene, AccelKind kind, int threads, Error *error);
void accel_free(Accel *accel);

/* NULL, ACCEL_NONE and an Accel that was never built have none. */
bool accel_has_tree(const Accel *accel);

/* Traverses the tree that there is. */
void accel_traverse(const Accel *accel, Traversal *traversal);

#endif
