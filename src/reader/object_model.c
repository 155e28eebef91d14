/* The "obj" of an object in a scene file. */
#include "reader/object_model.h"

#include "base/text.h"
#include "reader/model_library.h"
#include "reader/scene_model.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* An object without a name of its own, whose parts have names: the name of the model's file. False without memory. */
static bool name_after_file(SceneBuild *build, const char *path)
{
    Object *object = &build->scene->objects[build->scene->object_count - 1];
    const char *slash = strrchr(path, '/');
    char *name = text_copy(slash ? slash + 1 : path, build->error);
    if (!name)
        return false;
    free(object->name);
    object->name = name;
    return true;
}

/* A path that cannot be read, with one that can, where the name was written on Windows or in another case. */
static bool fail_path(const Json *json, const cJSON *item, const char *reason)
{
    bool as_written;
    char *path = library_path(json->name, item->valuestring, &as_written, json->error);
    const char *name = path ? path + strlen(path) - strlen(item->valuestring) : "";
    if (path && !as_written)
        json_fail(json, item, "%s; did you mean %s?", reason, text_quote(name).text);
    else
        json_fail(json, item, "%s%s", reason, strchr(item->valuestring, '\\') ? "; write / for each \\" : "");
    free(path);
    return false;
}

/* A model's own faults say their line; that there is no such file is told at the place that names it. */
bool object_model_read(const Json *json, const cJSON *item, bool is_named, SceneBuild *build)
{
    const char *name = NULL;
    if (!json_string(json, item, &name))
        return false;
    if (!*name)
        return json_fail(json, item, "must be the name of a file, not \"\"");
    char *path = text_beside(json->name, name, json->error);
    if (!path)
        return false;
    Error reason = {.kind = ERROR_NONE};
    bool good = text_check(path, &reason);
    if (good)
        good = scene_model_read(build, path) &&
               (is_named || build->scene->part_count == build->first_part || name_after_file(build, path));
    else if (reason.kind == ERROR_INPUT)
        fail_path(json, item, reason.text);
    else
        error_set(json->error, reason.kind, "%s", reason.text);
    free(path);
    return good;
}

bool object_model_check_keys(const Json *json, const cJSON *object)
{
    static const char *const meant[] = {"ply", "stl", "model", "mesh", "file", "path", "filename", "src"};
    for (const cJSON *member = cJSON_IsObject(object) ? object->child : NULL; member; member = member->next)
        for (size_t i = 0; i < sizeof meant / sizeof *meant; i++)
            if (strcasecmp(member->string, meant[i]) == 0)
                return json_fail_key(json, member, "unknown key; \"obj\" names a model, in OBJ, PLY or STL");
    return true;
}
