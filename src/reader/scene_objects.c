/* The "objects" of a scene file. */
#include "reader/scene_objects.h"

#include "base/suggest.h"
#include "base/text.h"
#include "reader/object_model.h"
#include "reader/scene_transform.h"
#include "json/json_read.h"

#include <float.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

static bool fail_build(const Json *json, const cJSON *item, const SceneBuild *build)
{
    return json_fail(json, item, "%s", build->reason);
}

/* Says that a material does not exist, with the nearest one that does. */
static bool fail_material(const Json *json, const cJSON *item, const SceneBuild *build)
{
    const char **known = calloc((size_t)build->materials.count + 1, sizeof *known);
    if (!known)
        return error_memory(json->error, "names");
    int count = 0;
    for (int i = 0; i < build->materials.capacity; i++)
        if (build->materials.slots[i].text)
            known[count++] = build->materials.slots[i].text;
    const char *nearest = suggest_word(item->valuestring, known);
    free(known);
    Quoted name = text_quote(item->valuestring);
    if (!nearest)
        return json_fail(json, item, "the material %s does not exist", name.text);
    return json_fail(json, item, "the material %s does not exist; did you mean %s?", name.text,
                     text_quote(nearest).text);
}

static bool find_material(const Json *json, const cJSON *item, const SceneBuild *build, int *material)
{
    const char *name = NULL;
    if (!json_string(json, item, &name))
        return false;
    *material = names_find(&build->materials, name);
    return *material >= 0 || fail_material(json, item, build);
}

static bool read_indices(const Json *json, const cJSON *face, const cJSON *list, const SceneBuild *build, int *vertices)
{
    int i = 0;
    for (const cJSON *child = list->child; child; child = child->next, i++) {
        if (!json_integer(json, child, INT_MIN, INT_MAX, &vertices[i]))
            return false;
        if (vertices[i] < 0 || vertices[i] >= scene_build_point_count(build))
            return json_fail(json, face, "vertex %d does not exist; the object has %d vertices", vertices[i],
                             scene_build_point_count(build));
    }
    return true;
}

static bool read_face(const Json *json, const cJSON *item, SceneBuild *build, int place)
{
    JsonMember keys[] = {{.name = "vertices", .required = true}, {.name = "material"}};
    const cJSON *list = item;
    int material = -1;
    if (cJSON_IsObject(item)) {
        if (!json_members(json, item, keys, JSON_COUNT(keys)))
            return false;
        list = keys[0].item;
        if (keys[1].item && !find_material(json, keys[1].item, build, &material))
            return false;
    } else if (!cJSON_IsArray(item))
        return json_fail_type(json, item, "a list of vertices or an object");
    if (!json_list(json, list))
        return false;
    int count = cJSON_GetArraySize(list), few[4] = {0};
    if (count < 3)
        return json_fail(json, item, "a face has at least 3 vertices, not %d", count);
    int *vertices = count <= 4 ? few : calloc((size_t)count, sizeof *vertices);
    if (!vertices)
        return error_memory(json->error, "a face");
    bool good = read_indices(json, item, list, build, vertices) &&
                (scene_build_face(build, vertices, count, material, place) || fail_build(json, item, build));
    if (vertices != few)
        free(vertices);
    return good;
}

static bool read_faces(const Json *json, const cJSON *vertices, const cJSON *faces, SceneBuild *build)
{
    if (!json_list(json, vertices) || !json_list(json, faces))
        return false;
    for (const cJSON *child = vertices->child; child; child = child->next) {
        Vec3 point;
        if (!json_vec3(json, child, -DBL_MAX, DBL_MAX, &point))
            return false;
        if (!scene_build_point(build, point))
            return fail_build(json, child, build);
    }
    int place = 0;
    for (const cJSON *child = faces->child; child; child = child->next)
        if (!read_face(json, child, build, place++))
            return false;
    return true;
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
    if (keys[MATERIAL].item && !find_material(json, keys[MATERIAL].item, build, &object->material))
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
        return read_faces(json, keys[VERTICES].item, keys[FACES].item, build);
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
    return fail_build(json, box ? box : cJSON_GetArrayItem(faces, build->fault->place), build);
}
