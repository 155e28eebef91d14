/* The "objects" of a scene file. */
#include "reader/scene_objects.h"

#include "base/text.h"
#include "reader/object_model.h"
#include "reader/scene_mesh.h"
#include "reader/scene_transform.h"
#include "json/json_read.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

static bool fail_build(const Json *json, const cJSON *item, const SceneBuild *build)
{
    return json_fail(json, item, "%s", build->reason);
}

static bool read_box(const Json *json, const cJSON *item, SceneBuild *build)
{
    JsonMember keys[] = {{.name = "min", .required = true}, {.name = "max", .required = true}};
    Vec3 low, high;
    if (!json_members(json, item, keys, JSON_COUNT(keys)) || !json_vec3(json, keys[0].item, -DBL_MAX, DBL_MAX, &low) ||
        !json_vec3(json, keys[1].item, -DBL_MAX, DBL_MAX, &high))
        return false;
    const double lows[] = {low.x, low.y, low.z}, highs[] = {high.x, high.y, high.z};
    for (int i = 0; i < 3; i++)
        if (!(lows[i] < highs[i]))
            return json_fail(json, item,
                             "\"min\" must be below \"max\" on every axis; in %c it is %.15g, and \"max\" %.15g",
                             "xyz"[i], lows[i], highs[i]);
    return scene_build_box(build, low, high) || fail_build(json, item, build);
}

enum { NAME, MATERIAL, VERTICES, FACES, BOX, OBJ, TRANSFORM, NONPLANAR, DEGENERATE, SIDED, OBJECT_KEYS };

static bool read_settings(const Json *json, const JsonMember *keys, SceneBuild *build, SceneBuildObject *object)
{
    static const char *const nonplanar[] = {"error", "split"}, *const degenerate[] = {"error", "skip"};
    static const char *const sided[] = {"both", "front"};
    int is_model = keys[OBJ].item != NULL, split = is_model,
        skip = is_model; /* nobody looks at every face of a model */
    int front = 0;
    object->material = -1;
    if (keys[MATERIAL].item && !scene_mesh_material(json, keys[MATERIAL].item, build, &object->material))
        return false;
    if (keys[NONPLANAR].item && !json_choice(json, keys[NONPLANAR].item, nonplanar, 2, &split))
        return false;
    if (keys[DEGENERATE].item && !json_choice(json, keys[DEGENERATE].item, degenerate, 2, &skip))
        return false;
    if (keys[SIDED].item && !json_choice(json, keys[SIDED].item, sided, 2, &front))
        return false;
    object->split = split == 1;
    object->tell_split = split && !keys[NONPLANAR].item;
    object->skip = skip == 1;
    object->one_sided = front == 1;
    return scene_transform_read(json, keys[TRANSFORM].item, &object->transform);
}

static const JsonMember object_keys[OBJECT_KEYS] = {
    [NAME] = {.name = "name"},
    [MATERIAL] = {.name = "material"},
    [VERTICES] = {.name = "vertices"},
    [FACES] = {.name = "faces"},
    [BOX] = {.name = "box"},
    [OBJ] = {.name = "obj"},
    [TRANSFORM] = {.name = "transform"},
    [NONPLANAR] = {.name = "nonplanar"},
    [DEGENERATE] = {.name = "degenerate"},
    [SIDED] = {.name = "sided"},
};

SceneObjectName scene_objects_unnamed(int index)
{
    SceneObjectName name;
    snprintf(name.text, sizeof name.text, "objects[%d]", index);
    return name;
}

static bool begin_object(const Json *json, const JsonMember *keys, int index, SceneBuild *build)
{
    SceneObjectName unnamed = scene_objects_unnamed(index);
    const char *name = unnamed.text;
    SceneBuildObject object = {.material = -1};
    return (!keys[NAME].item || json_string(json, keys[NAME].item, &name)) &&
           read_settings(json, keys, build, &object) && scene_build_object(build, name, object);
}

static bool read_object(const Json *json, const cJSON *item, int index, SceneBuild *build)
{
    JsonMember keys[OBJECT_KEYS];
    memcpy(keys, object_keys, sizeof keys);
    if (!object_model_check_keys(json, item) || !json_members(json, item, keys, OBJECT_KEYS))
        return false;
    bool mesh = keys[VERTICES].item || keys[FACES].item;
    if (mesh + (keys[BOX].item != NULL) + (keys[OBJ].item != NULL) != 1)
        return json_fail(json, item, "an object has one of \"vertices\" with \"faces\", \"box\" and \"obj\"");
    if (mesh && !(keys[VERTICES].item && keys[FACES].item))
        return json_fail(json, item, "the key \"%s\" is missing", keys[VERTICES].item ? "faces" : "vertices");
    if (!begin_object(json, keys, index, build))
        return false;
    if (mesh)
        return scene_mesh_read(json, keys[VERTICES].item, keys[FACES].item, build);
    return keys[BOX].item ? read_box(json, keys[BOX].item, build)
                          : object_model_read(json, keys[OBJ].item, keys[NAME].item, build);
}

bool scene_objects_begin(const Json *json, int index, bool is_model, SceneBuild *build)
{
    JsonMember keys[OBJECT_KEYS];
    memcpy(keys, object_keys, sizeof keys);
    return json_members(json, json->root, keys, OBJECT_KEYS) && !keys[VERTICES].item && !keys[FACES].item &&
           !keys[BOX].item && (keys[OBJ].item != NULL) == is_model && begin_object(json, keys, index, build) &&
           (!is_model || object_model_read(json, keys[OBJ].item, keys[NAME].item, build));
}

bool scene_objects_read(const Json *json, const cJSON *objects, SceneBuild *build)
{
    if (!json_list(json, objects))
        return false;
    int index = 0;
    for (const cJSON *child = objects->child; child; child = child->next)
        if (!read_object(json, child, index++, build))
            return false;
    return true;
}

bool scene_objects_fail_face(const Json *json, const cJSON *objects, const SceneBuild *build)
{
    const cJSON *object = cJSON_GetArrayItem(objects, build->fault->object);
    const cJSON *faces = cJSON_GetObjectItemCaseSensitive(object, "faces");
    const cJSON *box = cJSON_GetObjectItemCaseSensitive(object, "box");
    const cJSON *obj = cJSON_GetObjectItemCaseSensitive(object, "obj");
    if (obj) {
        char *path = text_beside(json->name, obj->valuestring, json->error);
        if (path)
            error_set(json->error, ERROR_INPUT, build->fault->place > 0 ? "%s:%d: %s" : "%s: face %d: %s", path,
                      abs(build->fault->place), build->reason);
        free(path);
        return false;
    }
    return box ? fail_build(json, box, build) : scene_mesh_fail_face(json, faces, build);
}
