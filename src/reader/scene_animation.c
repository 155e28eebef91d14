/* The "animation" of a scene file: its tracks and the orbit are read once, and give the text of any frame. */
#include "reader/scene_animation.h"

#include "base/array.h"
#include "base/number.h"
#include "base/text.h"
#include "reader/scene_objects.h"
#include "json/json_edit.h"
#include "json/json_read.h"

#include <stdlib.h>
#include <string.h>

bool scene_animation_is_in(const char *text)
{
    /* A letter of the key may be written as an escape, but then there is one in the text. */
    return (strstr(text, "\"animation\"") || strstr(text, "\\u")) && json_has(text, "animation");
}

/* --- Reading --- */

/* How the keys' values move where they do not say it. */
typedef struct Reading {
    SceneAnimation *animation;
    const Json *json;
    bool smooth;
} Reading;

/* Reads keys for the target, into which the index goes. */
static bool add_track(Reading *reading, TrackKind kind, const char *target, int index, const cJSON *keys)
{
    SceneAnimation *animation = reading->animation;
    Track *grown = array_grown(animation->tracks, animation->track_count, &animation->track_capacity,
                               sizeof *animation->tracks, "an animation", reading->json->error);
    if (!grown)
        return false;
    animation->tracks = grown;
    Track *track = &grown[animation->track_count++];
    *track = (Track){.kind = kind};
    snprintf(track->target, sizeof track->target, index < 0 ? "%s" : "%s[%d]", target, index);
    return scene_track_read(track, reading->json, keys, reading->smooth);
}

/* An orbit, or a list of keys. */
static bool read_camera(Reading *reading, const cJSON *item)
{
    JsonMember keys[] = {{.name = "orbit", .required = true}};
    if (!item || cJSON_IsArray(item))
        return !item || add_track(reading, TRACK_CAMERA, "camera", -1, item);
    if (!cJSON_IsObject(item))
        return json_fail_type(reading->json, item, "a list of keys, or an object with \"orbit\"");
    return json_members(reading->json, item, keys, JSON_COUNT(keys)) &&
           scene_orbit_read(&reading->animation->orbit, reading->json, keys[0].item);
}

static bool read_lights(Reading *reading, const cJSON *item)
{
    const cJSON *lights = cJSON_GetObjectItemCaseSensitive(reading->json->root, "lights");
    int count = cJSON_IsArray(lights) ? cJSON_GetArraySize(lights) : 0;
    if (item && !cJSON_IsObject(item))
        return json_fail_type(reading->json, item, "an object");
    for (const cJSON *child = item ? item->child : NULL; child; child = child->next) {
        char *end;
        long index = number_is_digit(child->string[0]) ? strtol(child->string, &end, 10) : -1;
        if (json_is_comment(child)) {
            if (!json_check_comment(reading->json, child))
                return false;
        } else if (index < 0 || *end || (child->string[0] == '0' && child->string[1] != '\0') || index >= count)
            return json_fail_key(
                reading->json, child,
                "there is no such light; lights are named by their numbers, from \"0\", and the scene has %d", count);
        else if (!add_track(reading, TRACK_LIGHT, "lights", (int)index, child))
            return false;
    }
    return true;
}

/* The name of an object that is valid so far. */
static const char *name_of(const cJSON *object, int index, SceneObjectName *unnamed)
{
    const cJSON *name = cJSON_GetObjectItemCaseSensitive(object, "name");
    *unnamed = scene_objects_unnamed(index);
    return cJSON_IsString(name) ? name->valuestring : unnamed->text;
}

/* Adds a track for each object that has the name. */
static bool add_objects(Reading *reading, const cJSON *keys)
{
    const cJSON *objects = cJSON_GetObjectItemCaseSensitive(reading->json->root, "objects");
    int index = 0, before = reading->animation->track_count;
    SceneObjectName unnamed;
    for (const cJSON *object = cJSON_IsArray(objects) ? objects->child : NULL; object; object = object->next, index++)
        if (cJSON_IsObject(object) && strcmp(name_of(object, index, &unnamed), keys->string) == 0 &&
            !add_track(reading, TRACK_OBJECT, "objects", index, keys))
            return false;
    return reading->animation->track_count > before ||
           json_fail_key(reading->json, keys, "no object has this name; one without a name is \"objects[INDEX]\"");
}

static bool read_objects(Reading *reading, const cJSON *item)
{
    if (item && !cJSON_IsObject(item))
        return json_fail_type(reading->json, item, "an object");
    for (const cJSON *child = item ? item->child : NULL; child; child = child->next)
        if (!(json_is_comment(child) ? json_check_comment(reading->json, child) : add_objects(reading, child)))
            return false;
    return true;
}

static bool read_animation(SceneAnimation *animation, const cJSON *item)
{
    enum { FRAMES, FPS, INTERPOLATION, CAMERA, OBJECTS, LIGHTS, KEYS };
    static const char *const words[] = {"linear", "smooth"};
    JsonMember keys[KEYS] = {
        [FRAMES] = {.name = "frames", .required = true},
        [FPS] = {.name = "fps"},
        [INTERPOLATION] = {.name = "interpolation"},
        [CAMERA] = {.name = "camera"},
        [OBJECTS] = {.name = "objects"},
        [LIGHTS] = {.name = "lights"},
    };
    const Json *json = &animation->json;
    int smooth = 0;
    animation->fps = 30;
    if (!json_members(json, item, keys, KEYS) ||
        !json_integer(json, keys[FRAMES].item, 1, TRACK_MAX_FRAMES, &animation->frames) ||
        (keys[FPS].item && !json_number(json, keys[FPS].item, 0.01, 1000, &animation->fps)) ||
        (keys[INTERPOLATION].item && !json_choice(json, keys[INTERPOLATION].item, words, 2, &smooth)))
        return false;
    Reading reading = {animation, json, smooth == 1};
    if (!read_objects(&reading, keys[OBJECTS].item))
        return false;
    animation->moves_objects = animation->track_count > 0;
    return read_lights(&reading, keys[LIGHTS].item) && read_camera(&reading, keys[CAMERA].item);
}

bool scene_animation_open(SceneAnimation *animation, const char *name, char *text, Error *error)
{
    *animation = (SceneAnimation){.frames = 0};
    if (!json_take(&animation->json, name, text, (long)strlen(text), error))
        return false;
    if (read_animation(animation, cJSON_GetObjectItemCaseSensitive(animation->json.root, "animation")))
        return true;
    scene_animation_free(animation);
    return false;
}

void scene_animation_free(SceneAnimation *animation)
{
    for (int i = 0; i < animation->track_count; i++)
        scene_track_free(&animation->tracks[i]);
    free(animation->tracks);
    json_free(&animation->json);
    *animation = (SceneAnimation){.frames = 0};
}

/* --- Frames --- */

char *scene_animation_frame(const SceneAnimation *animation, int frame, Error *error)
{
    char *text = text_copy(animation->json.text, error);
    for (int i = 0; i < animation->track_count && text; i++)
        text = scene_track_apply(&animation->tracks[i], frame, text, error);
    if (animation->orbit.given && text)
        text = scene_orbit_apply(&animation->orbit, (double)frame / animation->frames, text, error);
    return text;
}
