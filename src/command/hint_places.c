/* From a hint to a value of the scene file. To place a new kind of hint, add it to find. */
#include "command/hint_places.h"

#include "base/text.h"

enum { BYTES_MOST = 1 << 24 };

bool hint_places_read(HintPlaces *places, const char *path, Error *error)
{
    Error reason = {.kind = ERROR_NONE};
    long length = 0;
    *places = (HintPlaces){.json = {.root = NULL}};
    char *text = text_read(path, BYTES_MOST, &length, &reason);
    if (text && json_take(&places->json, path, text, length, &reason))
        return true;
    places->json = (Json){.root = NULL};
    return reason.kind != ERROR_SYSTEM || error_set(error, reason.kind, "%s", reason.text);
}

void hint_places_free(HintPlaces *places)
{
    json_free(&places->json);
}

/* The member, or where there is none the object itself. */
static const cJSON *member(const cJSON *object, const char *key)
{
    const cJSON *found = cJSON_GetObjectItemCaseSensitive(object, key);
    return found ? found : object;
}

static const cJSON *item(const cJSON *list, int index)
{
    const cJSON *found = cJSON_IsArray(list) ? cJSON_GetArrayItem(list, index) : NULL;
    return found ? found : list;
}

static const cJSON *find_face(const cJSON *root, const Scene *scene, int index)
{
    const Face *face = &scene->faces[index];
    const cJSON *object = item(member(root, "objects"), face->object);
    const cJSON *faces = cJSON_GetObjectItemCaseSensitive(object, "faces");
    return faces ? item(faces, face->number - scene->objects[face->object].first_number) : object;
}

static const cJSON *find_colour(const cJSON *root, const Scene *scene, const Hint *hint)
{
    const char *key = hint_colour_of(scene, hint).key;
    if (hint->second == OWNER_BACKGROUND)
        return member(member(root, "shading"), key);
    if (hint->second == OWNER_LIGHT)
        return member(item(member(root, "lights"), hint->first), key);
    const cJSON *material = cJSON_GetObjectItemCaseSensitive(cJSON_GetObjectItemCaseSensitive(root, "materials"),
                                                             scene->materials[hint->first].name);
    return material ? member(material, key) : NULL;
}

static const cJSON *find_black(const cJSON *root, HintBlack reason)
{
    switch (reason) {
    case BLACK_NO_FACE_SEEN:
        return member(member(root, "camera"), "position");
    case BLACK_NO_COLOUR:
        return member(root, "materials");
    default:
        return member(root, "lights");
    }
}

static const cJSON *find(const cJSON *root, const Scene *scene, const Hint *hint)
{
    switch (hint->kind) {
    case HINT_SAME_PLANE:
        return find_face(root, scene, hint->first);
    case HINT_COLOUR:
        return find_colour(root, scene, hint);
    case HINT_LIGHT_IN_BOX:
    case HINT_LIGHT_OUT_OF_BOX:
    case HINT_LIGHT_BEHIND:
    case HINT_LIGHT_HIDDEN:
        return member(item(member(root, "lights"), hint->first), "position");
    case HINT_TINY:
    case HINT_NO_FACE_SEEN:
        return member(member(root, "camera"), "position");
    case HINT_BLACK:
        return find_black(root, (HintBlack)hint->first);
    case HINT_KINDS:
        break;
    }
    return NULL;
}

JsonPlace hint_place(const HintPlaces *places, const Scene *scene, const Hint *hint)
{
    const cJSON *value = places->json.root ? find(places->json.root, scene, hint) : NULL;
    return value ? json_place(&places->json, value) : (JsonPlace){.line = 0};
}
