/* All hints on a scene, and those on colours. */
#include "scene/hints.h"

#include "scene/hints_black.h"
#include "scene/hints_light.h"
#include "scene/hints_plane.h"
#include "scene/hints_view.h"

/* Adds a hint if one of the colours of a material or a light looks like bytes. */
static bool find_colour(Hints *hints, const Scene *scene, HintOwner owner, int index, Error *error)
{
    Hint hint = {HINT_COLOUR, index, (int)owner, 1};
    return !hint_looks_like_bytes(owner, hint_colour_of(scene, &hint).colour) || hint_add(hints, hint, error);
}

static bool find_colours(Hints *hints, const Scene *scene, Error *error)
{
    bool good = find_colour(hints, scene, OWNER_BACKGROUND, -1, error);
    for (int i = 0; good && i < scene->material_count; i++)
        good = find_colour(hints, scene, OWNER_MATERIAL, i, error);
    for (int i = 0; good && i < scene->light_count; i++)
        good = find_colour(hints, scene, OWNER_LIGHT, i, error);
    return good;
}

/* The hints on lights come first. */
static bool find_blank(Hints *hints, const Scene *scene, Error *error)
{
    bool hidden, unseen;
    return hints_find_lights(hints, scene, &hidden, error) && hints_find_view(hints, scene, &unseen, error) &&
           hints_find_black(hints, scene, unseen, hidden, error);
}

bool hints_find(Hints *hints, const Scene *scene, Error *error)
{
    *hints = (Hints){0};
    return hints_find_planes(hints, scene, error) && find_colours(hints, scene, error) &&
           find_blank(hints, scene, error);
}

bool hints_find_blank(Hints *hints, const Scene *scene, Error *error)
{
    *hints = (Hints){0};
    return find_blank(hints, scene, error);
}
