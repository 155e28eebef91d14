/* A light is shut off by a closed object that holds either the light or the camera. */
#include "scene/hints_light.h"

#include "scene/geometry.h"
#include "scene/light.h"
#include "scene/solid.h"

bool hint_light_is_black(const Light *light)
{
    return colour_is_black(light->ambient) && colour_is_black(light->diffuse) && colour_is_black(light->specular);
}

/* The closed object that holds the point, and does not hold the other one; -1: none. */
static int object_around(Solids *solids, Vec3 point, Vec3 other)
{
    for (int i = 0; i < solids->scene->object_count; i++)
        if (solid_holds(solids, i, point) && !solid_holds(solids, i, other))
            return i;
    return -1;
}

/* What the camera sees of each face, the light is on the other side of. */
static bool is_behind_all(Solids *solids, const Light *light)
{
    const Scene *scene = solids->scene;
    for (int i = 0; i < scene->face_count; i++) {
        const Face *face = &scene->faces[i];
        int eye = plane_side(face, &scene->planes[i], scene->camera.position);
        int side = plane_side(face, &scene->planes[i], light->position);
        if (eye * side > 0 && !(face->one_sided && eye < 0) && !solid_hides(solids, i))
            return false;
    }
    return scene->face_count > 0;
}

/* A mirror may show faces from their other sides. */
static bool has_mirrors(const Scene *scene)
{
    for (int i = 0; i < scene->face_count; i++)
        if (scene->materials[scene->faces[i].material].reflection > 0)
            return scene->shading.max_bounces > 0;
    return false;
}

/* The hint on a light; HINT_KINDS: it has none. */
static Hint hint_on(Solids *solids, int index, bool mirrors)
{
    const Light *light = &solids->scene->lights[index];
    Vec3 eye = solids->scene->camera.position;
    int around = object_around(solids, light->position, eye);
    if (around >= 0)
        return (Hint){HINT_LIGHT_IN_BOX, index, around, 1};
    around = object_around(solids, eye, light->position);
    if (around >= 0)
        return (Hint){HINT_LIGHT_OUT_OF_BOX, index, around, 1};
    return (Hint){!mirrors && is_behind_all(solids, light) ? HINT_LIGHT_BEHIND : HINT_KINDS, index, -1, 1};
}

bool hints_find_lights(Hints *hints, const Scene *scene, bool *hidden, Error *error)
{
    Solids solids;
    bool good = solids_make(&solids, scene, error), mirrors = has_mirrors(scene);
    *hidden = scene->light_count > 0;
    for (int i = 0; good && i < scene->light_count; i++) {
        if (hint_light_is_black(&scene->lights[i]))
            continue;
        Hint hint = hint_on(&solids, i, mirrors);
        *hidden = *hidden && hint.kind != HINT_KINDS;
        good = error->kind == ERROR_NONE && (hint.kind == HINT_KINDS || hint_add(hints, hint, error));
    }
    solids_free(&solids);
    return good;
}
