/* A list of hints, and the colours that some of them are about. */
#include "scene/hint.h"

#include "base/array.h"

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

bool hints_have(const Hints *hints, HintKind kind, int first)
{
    for (int i = 0; i < hints->count; i++)
        if (hints->list[i].kind == kind && (first < 0 || hints->list[i].first == first))
            return true;
    return false;
}

static bool is_whole(Vec3 c)
{
    return c.x == floor(c.x) && c.y == floor(c.y) && c.z == floor(c.z);
}

/* A strong light may be meant; it is told only if it is written in whole numbers, as bytes are. */
bool hint_looks_like_bytes(HintOwner owner, Vec3 colour)
{
    double largest = vec3_largest(colour);
    return largest <= 255 && (owner == OWNER_LIGHT ? largest >= 32 && is_whole(colour) : largest >= 8);
}

HintColour hint_colour_of(const Scene *scene, const Hint *hint)
{
    HintOwner owner = (HintOwner)hint->second;
    if (owner == OWNER_BACKGROUND)
        return (HintColour){"background", scene->shading.background};
    const Light *light = &scene->lights[owner == OWNER_LIGHT ? hint->first : 0];
    const Material *material = &scene->materials[owner == OWNER_MATERIAL ? hint->first : 0];
    bool of_light = owner == OWNER_LIGHT;
    HintColour colours[] = {
        {"diffuse", of_light ? light->diffuse : material->diffuse},
        {"ambient", of_light ? light->ambient : material->ambient},
        {"specular", of_light ? light->specular : material->specular},
    };
    int i = 0;
    while (i < 2 && !hint_looks_like_bytes(owner, colours[i].colour))
        i++;
    return colours[i];
}
