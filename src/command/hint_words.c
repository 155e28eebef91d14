/* Hints in words. */
#include "command/hint_words.h"

#include "base/text.h"
#include "scene/geometry.h"
#include "walkthrough/walkthrough_words.h"

#include <stdio.h>
#include <stdlib.h>

const char *const hint_names[HINT_KINDS] = {
    [HINT_SAME_PLANE] = "same-plane",     [HINT_COLOUR] = "colour",
    [HINT_LIGHT_IN_BOX] = "light-in-box", [HINT_LIGHT_BEHIND] = "light-behind",
    [HINT_NO_FACE_SEEN] = "no-face-seen", [HINT_BLACK] = "black",
};

static const char *const why_black[] = {
    [BLACK_NO_FACE_SEEN] = "the camera sees no face, and the background is black",
    [BLACK_NO_LIGHT] = "there is no light",
    [BLACK_NO_COLOUR] = "no material has a colour",
    [BLACK_LIGHTS_HIDDEN] = "no light reaches what the camera sees",
};

static void same_plane_words(HintWords *words, const Scene *scene, const Hint *hint)
{
    InkText first = walkthrough_face_words(scene, hint->first, 40);
    InkText second = walkthrough_face_words(scene, hint->second, 40);
    int length =
        snprintf(words->text, sizeof words->text,
                 "faces %d, %.60s, and %d, %.60s, overlap in one plane: the first is seen, or rounding decides",
                 scene->faces[hint->first].number, first.text, scene->faces[hint->second].number, second.text);
    if (hint->count > 1)
        snprintf(words->text + length, sizeof words->text - (size_t)length, " (the first of %d such pairs)",
                 hint->count);
}

static void colour_words(HintWords *words, const Scene *scene, const Hint *hint)
{
    const Material *material = hint->first >= 0 ? &scene->materials[hint->first] : NULL;
    const char *what = !material ? "the background" : vec3_largest(material->diffuse) >= 8 ? "diffuse" : "ambient";
    Vec3 c = !material                              ? scene->shading.background
             : vec3_largest(material->diffuse) >= 8 ? material->diffuse
                                                    : material->ambient;
    if (material)
        snprintf(words->text, sizeof words->text,
                 "material %s: %s [%g, %g, %g] looks like 0 to 255, but 1 is full strength; divide by 255",
                 text_quote(material->name).text, what, c.x, c.y, c.z);
    else
        snprintf(words->text, sizeof words->text,
                 "%s [%g, %g, %g] looks like 0 to 255, but 1 is full strength; divide by 255", what, c.x, c.y, c.z);
}

static void light_words(HintWords *words, const Scene *scene, const Hint *hint)
{
    Vec3 p = vec3_add(scene->lights[hint->first].position, scene->centre);
    int length = snprintf(words->text, sizeof words->text, "light %d at (%g, %g, %g) is ", hint->first, p.x, p.y, p.z);
    char *rest = words->text + length;
    size_t room = sizeof words->text - (size_t)length;
    if (hint->kind == HINT_LIGHT_IN_BOX)
        snprintf(rest, room, "shut in the box %s", text_quote(scene->objects[hint->second].name).text);
    else
        snprintf(rest, room, "behind every face that the camera sees");
}

HintWords hint_words(const Scene *scene, const Hint *hint)
{
    HintWords words = {""};
    switch (hint->kind) {
    case HINT_SAME_PLANE:
        same_plane_words(&words, scene, hint);
        break;
    case HINT_COLOUR:
        colour_words(&words, scene, hint);
        break;
    case HINT_LIGHT_IN_BOX:
    case HINT_LIGHT_BEHIND:
        light_words(&words, scene, hint);
        break;
    case HINT_NO_FACE_SEEN:
        snprintf(words.text, sizeof words.text,
                 "the camera sees no face: all are behind it, beside the picture or edge on");
        break;
    case HINT_BLACK:
        snprintf(words.text, sizeof words.text, "the picture is black: %s", why_black[hint->first]);
        break;
    case HINT_KINDS:
        break;
    }
    return words;
}

/* The planes of the faces, which a renderer may have freed. NULL without memory. */
static Plane *planes_of(const Scene *scene, Error *error)
{
    Plane *planes = malloc((size_t)scene->face_count * sizeof *planes + 1);
    if (!planes)
        error_memory(error, "the planes of the scene");
    for (int i = 0; planes && i < scene->face_count; i++)
        planes[i] = face_plane(&scene->faces[i]);
    return planes;
}

bool hint_blank_picture(const Scene *scene, Error *error)
{
    Scene whole = *scene;
    Hints hints;
    whole.planes = planes_of(scene, error);
    if (!whole.planes)
        return false;
    bool good = hints_find_blank(&hints, &whole, error);
    if (good && hints.count > 0)
        fprintf(stderr, "rectray: note: %s\n", hint_words(&whole, &hints.list[hints.count - 1]).text);
    hints_free(&hints);
    free(whole.planes);
    return good;
}
