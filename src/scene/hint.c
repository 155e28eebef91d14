/* A list of hints, and the boxes that some of them ask for. */
#include "scene/hint.h"

#include "base/array.h"
#include "scene/geometry.h"

#include <stdlib.h>

bool hint_add(Hints *hints, Hint hint, Error *error)
{
    Hint *grown = array_grown(hints->list, hints->count, &hints->capacity, sizeof *grown, "hints", error);
    if (!grown)
        return false;
    hints->list = grown;
    grown[hints->count++] = hint;
    return true;
}

void hints_free(Hints *hints)
{
    free(hints->list);
    *hints = (Hints){0};
}

/* --- Boxes --- */

enum { BOX_FACES = 6, BOX_CORNERS = 8 };

static bool is_same(Vec3 a, Vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

bool hint_is_box(const Scene *scene, int object)
{
    const Object *box = &scene->objects[object];
    Vec3 corners[BOX_FACES * 4];
    int count = 0;
    if (box->face_count != BOX_FACES)
        return false;
    for (int i = box->first_face; i < box->first_face + BOX_FACES; i++) {
        if (scene->faces[i].vertex_count != 4 || scene->faces[i].one_sided)
            return false;
        for (int k = 0; k < 4; k++) {
            Vec3 v = face_vertex(&scene->faces[i], k);
            int known = 0;
            while (known < count && !is_same(corners[known], v))
                known++;
            if (known == count)
                corners[count++] = v;
        }
    }
    return count == BOX_CORNERS;
}

bool hint_is_in_box(const Scene *scene, int object, Vec3 point)
{
    const Object *box = &scene->objects[object];
    int first = 0;
    for (int i = box->first_face; i < box->first_face + box->face_count; i++) {
        int side = plane_side(&scene->faces[i], &scene->planes[i], point);
        first = i == box->first_face ? side : first;
        if (side == 0 || side != first)
            return false;
    }
    return box->face_count == BOX_FACES;
}
