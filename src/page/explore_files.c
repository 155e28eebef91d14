/* Which files a scene is made of. The readers have found no fault in them: here only their names are looked for. */
#include "page/explore_files.h"

#include "base/array.h"
#include "reader/line_scan.h"
#include "reader/model_library.h"
#include "reader/scene_model.h"
#include "json/json.h"

#include <stdlib.h>
#include <string.h>

/* Takes name and path over. *is_new: it was not in the list before. */
static bool add_file(ExploreFiles *files, ExploreFile file, bool *is_new, Error *error)
{
    *is_new = file.name && file.path;
    for (int i = 0; *is_new && i < files->count; i++)
        *is_new = strcmp(files->items[i].name, file.name) != 0;
    ExploreFile *grown =
        *is_new ? array_grown(files->items, files->count, &files->capacity, sizeof *grown, "the scene's files", error)
                : NULL;
    if (grown) {
        files->items = grown;
        grown[files->count++] = file;
    } else {
        free(file.name);
        free(file.path);
    }
    return error->kind == ERROR_NONE;
}

/* A file whose name is its path. */
static bool add_path(ExploreFiles *files, char *path, bool *is_new, Error *error)
{
    char *copy = path ? text_copy(path, error) : NULL;
    return add_file(files, (ExploreFile){path, copy}, is_new, error);
}

/* The libraries of an mtllib line that are there. */
static bool add_line(ExploreFiles *files, const char *model, char *names, Error *error)
{
    LibraryName library;
    bool good = true, is_new;
    while (good && library_name_next(&library, model, &names, error)) {
        if (library.path) {
            good =
                add_file(files, (ExploreFile){text_beside(model, library.name, error), library.path}, &is_new, error);
            library.path = NULL;
        }
        library_name_free(&library);
    }
    return good && error->kind == ERROR_NONE;
}

/* A model while its mtllib lines are looked for. */
typedef struct ModelLines {
    ExploreFiles *files;
    LineScan scan;
} ModelLines;

static bool read_line(void *user)
{
    ModelLines *model = user;
    LineScan *scan = &model->scan;
    scan_blanks(scan);
    if (scan_word_is(scan_word(scan), "mtllib"))
        return add_line(model->files, scan->path, scan_rest(scan), scan->error);
    return scan_next_line(scan);
}

static bool add_libraries(ExploreFiles *files, const char *model, Error *error)
{
    ModelLines lines = {files, {.line = 1, .path = model, .error = error}};
    return scan_file(&lines.scan, read_line, &lines);
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
        if (good && is_new && scene_model_is_obj(files->items[files->count - 1].path, error))
            good = add_libraries(files, files->items[files->count - 1].path, error);
        good = good && error->kind == ERROR_NONE;
    }
    json_free(&json);
    return good;
}

void explore_free_files(ExploreFiles *files)
{
    for (int i = 0; i < files->count; i++) {
        free(files->items[i].name);
        free(files->items[i].path);
    }
    free(files->items);
    *files = (ExploreFiles){0};
}
