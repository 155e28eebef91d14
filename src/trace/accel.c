/* How a tracer finds faces: one by one, or through a tree. */
#include "trace/accel.h"

#include "trace/bvh_traverse.h"
#include "trace/kdtree_traverse.h"

static AccelKind kind_for(const Scene *scene, AccelKind wanted)
{
    if (scene->face_count == 0)
        return ACCEL_NONE;
    if (wanted != ACCEL_AUTO)
        return wanted;
    return scene->face_count < ACCEL_AUTO_FACES ? ACCEL_NONE : ACCEL_BVH;
}

bool accel_build(Accel *accel, const Scene *scene, AccelKind kind, int threads, Error *error)
{
    *accel = (Accel){.kind = kind_for(scene, kind)};
    bool built = true;
    if (accel->kind == ACCEL_BVH)
        built = bvh_build(&accel->bvh, scene, threads, error);
    else if (accel->kind == ACCEL_KDTREE)
        built = kdtree_build(&accel->kdtree, scene, threads, error);
    if (!built)
        accel->kind = ACCEL_NONE;
    return built;
}

void accel_free(Accel *accel)
{
    bvh_free(&accel->bvh);
    kdtree_free(&accel->kdtree);
    *accel = (Accel){.kind = ACCEL_NONE};
}

bool accel_has_tree(const Accel *accel)
{
    return accel && (accel->kind == ACCEL_BVH || accel->kind == ACCEL_KDTREE);
}

void accel_traverse(const Accel *accel, Traversal *traversal)
{
    if (accel->kind == ACCEL_BVH)
        bvh_traverse(&accel->bvh, traversal);
    else
        kdtree_traverse(&accel->kdtree, traversal);
}
