/* Which files a scene is made of. The readers have found no fault in them: here only their names are looked for. */
#include "page/explore_files.h"

#include "base/array.h"
#include "base/words.h"
#include "json/json.h"

#include <stdlib.h>
#include <string.h>

/* Takes the path over. *is_new: it was not in the list before. */
static bool add_path(ExploreFiles *files, char *path, bool *is_new, Error *error)
{
    *is_new = false;
    if (!path)
        return false;
    for (int i = 0; i < files->count; i++)
        if (strcmp(files->paths[i], path) == 0) {
            free(path);
            return true;
        }
    char **paths = array_grown(files->paths, files->count, &files->capacity, sizeof *paths, "the scene's files", error);
    if (!paths) {
        free(path);
        return false;
    }
    files->paths = paths;
    files->paths[files->count++] = path;
    return *is_new = true;
}

static bool add_libraries(ExploreFiles *files, const char *model, Error *error)
{
    TextLines lines;
    bool good = text_open_lines(&lines, model, error), is_new;
    for (char *line; good && (line = text_next_line(&lines, error));) {
        char *rest = line;
        if (strcmp(word_next(&rest), "mtllib") != 0)
            continue;
        for (char *name = word_next(&rest); good && *name; name = word_next(&rest))
            good = add_path(files, text_beside(model, name, error), &is_new, error);
    }
    text_close_lines(&lines);
    return good && error->kind == ERROR_NONE;
}

bool explore_find_files(ExploreFiles *files, const char *scene_path, Error *error)
{
    Json json;
    bool is_new;
    *files = (ExploreFiles){0};
    if (!add_path(files, text_copy(scene_path, error), &is_new, error) || !json_load(&json, scene_path, error))
        return false;
    const cJSON *objects = cJSON_GetObjectItemCaseSensitive(json.root, "objects");
    bool good = true;
    for (const cJSON *object = objects ? objects->child : NULL; good && object; object = object->next) {
        const cJSON *obj = cJSON_GetObjectItemCaseSensitive(object, "obj");
        if (!cJSON_IsString(obj))
            continue;
        good = add_path(files, text_beside(scene_path, obj->valuestring, error), &is_new, error);
        if (good && is_new)
            good = add_libraries(files, files->paths[files->count - 1], error);
    }
    json_free(&json);
    return good;
}

void explore_free_files(ExploreFiles *files)
{
    for (int i = 0; i < files->count; i++)
        free(files->paths[i]);
    free(files->paths);
    *files = (ExploreFiles){0};
}
