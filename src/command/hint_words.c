/* Hints in words. */
#include "command/hint_words.h"

#include "base/text.h"
#include "scene/geometry.h"
#include "trace/hints_probe.h"
#include "walkthrough/walkthrough_words.h"

#include <stdio.h>
#include <stdlib.h>

const char *const hint_names[HINT_KINDS] = {
    [HINT_SAME_PLANE] = "same-plane",
    [HINT_COLOUR] = "colour",
    [HINT_LIGHT_IN_BOX] = "light-in-box",
    [HINT_LIGHT_OUT_OF_BOX] = "light-out-of-box",
    [HINT_LIGHT_BEHIND] = "light-behind",
    [HINT_LIGHT_HIDDEN] = "light-hidden",
    [HINT_TINY] = "tiny",
    [HINT_NO_FACE_SEEN] = "no-face-seen",
    [HINT_BLACK] = "black",
};

static const char *const why_black[] = {
    [BLACK_NO_FACE_SEEN] = "the camera sees no face, and the background is black",
    [BLACK_NO_LIGHT] = "there is no light",
    [BLACK_LIGHTS_BLACK] = "the colours of all lights are black",
    [BLACK_NO_COLOUR] = "no material has a colour",
    [BLACK_COLOURS_DIFFER] = "the materials reflect nothing of what the lights have: compare their colours",
    [BLACK_TOO_DARK] = "all colours are so dark that they are rounded to black; 1 is full strength",
    [BLACK_LIGHTS_HIDDEN] = "no light reaches what the camera sees",
    [BLACK_UNLIT] = "no light adds a colour to what the camera sees; rectray trace SCENE --pixel X,Y tells why",
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
    HintColour odd = hint_colour_of(scene, hint);
    char owner[160] = "the ";
    if (hint->second == OWNER_MATERIAL)
        snprintf(owner, sizeof owner, "material %s: ", text_quote(scene->materials[hint->first].name).text);
    if (hint->second == OWNER_LIGHT)
        snprintf(owner, sizeof owner, "light %d: ", hint->first);
    snprintf(words->text, sizeof words->text,
             "%s%s [%g, %g, %g] looks like 0 to 255, but 1 is full strength; divide by 255", owner, odd.key,
             odd.colour.x, odd.colour.y, odd.colour.z);
}

static void light_words(HintWords *words, const Scene *scene, const Hint *hint)
{
    Vec3 p = vec3_add(scene->lights[hint->first].position, scene->centre);
    int length = snprintf(words->text, sizeof words->text, "light %d at (%g, %g, %g) ", hint->first, p.x, p.y, p.z);
    char *rest = words->text + length;
    size_t room = sizeof words->text - (size_t)length;
    bool has_solid = hint->kind == HINT_LIGHT_IN_BOX || hint->kind == HINT_LIGHT_OUT_OF_BOX;
    const Object *solid = &scene->objects[has_solid ? hint->second : 0];
    const char *what = solid->face_count == 6 ? "the box" : "the closed object";
    if (hint->kind == HINT_LIGHT_IN_BOX)
        snprintf(rest, room, "is shut in %s %s", what, text_quote(solid->name).text);
    else if (hint->kind == HINT_LIGHT_OUT_OF_BOX)
        snprintf(rest, room, "is outside %s %s, and the camera is in it", what, text_quote(solid->name).text);
    else if (hint->kind == HINT_LIGHT_HIDDEN && hint->second >= 0)
        snprintf(rest, room, "reaches nothing that the camera sees: %s is in the way",
                 walkthrough_face_words(scene, hint->second, 40).text);
    else
        snprintf(rest, room, "is behind every face that the camera sees");
}

/* The camera, and what is wrong with what it sees. */
static void view_words(HintWords *words, const Scene *scene, const Hint *hint)
{
    Vec3 p = vec3_add(scene->camera.position, scene->centre), at = vec3_add(scene->camera.look_at, scene->centre);
    const char *why = hint->kind == HINT_TINY ? "all that the camera sees is less than a pixel wide or high: it may be "
                                                "too far away"
                      : hint->first ? "the camera sees no face: all are beside the picture or between its rays"
                                    : "the camera sees no face: all are behind it, beside the picture or edge on";
    snprintf(words->text, sizeof words->text, "%s; it is at (%g, %g, %g) and looks at (%g, %g, %g)", why, p.x, p.y, p.z,
             at.x, at.y, at.z);
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
    case HINT_LIGHT_OUT_OF_BOX:
    case HINT_LIGHT_BEHIND:
    case HINT_LIGHT_HIDDEN:
        light_words(&words, scene, hint);
        break;
    case HINT_TINY:
    case HINT_NO_FACE_SEEN:
        view_words(&words, scene, hint);
        break;
    case HINT_BLACK:
        snprintf(words.text, sizeof words.text, "the picture is %s: %s",
                 hint->second == 0 ? "black, or nearly so" : "black", why_black[hint->first]);
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

/* The hint that explains a picture of one colour best: the last, but that all is tiny says more than that it is black.
 * NULL: none does. */
static const Hint *blank_hint(const Hints *hints)
{
    for (int i = 0; i < hints->count; i++)
        if (hints->list[i].kind == HINT_TINY)
            return &hints->list[i];
    const Hint *last = &hints->list[hints->count > 0 ? hints->count - 1 : 0];
    return hints->count > 0 && last->kind >= HINT_TINY ? last : NULL;
}

bool hint_blank_picture(const Scene *scene, Error *error)
{
    Scene whole = *scene;
    Hints hints;
    whole.planes = planes_of(scene, error);
    if (!whole.planes)
        return false;
    bool good = hints_find_blank(&hints, &whole, error) && hints_probe(&hints, &whole, true, error);
    const Hint *told = good ? blank_hint(&hints) : NULL;
    if (told)
        fprintf(stderr, "rectray: note: %s\n", hint_words(&whole, told).text);
    hints_free(&hints);
    free(whole.planes);
    return good;
}
