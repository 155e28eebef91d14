/* The vertices and faces of an object. */
#include "reader/scene_mesh.h"

#include "base/suggest.h"
#include "base/text.h"
#include "reader/bulk_shape.h"
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

bool scene_mesh_material(const Json *json, const cJSON *item, const SceneBuild *build, int *material)
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
        if (keys[1].item && !scene_mesh_material(json, keys[1].item, build, &material))
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

static bool read_vertex(const Json *json, const cJSON *item, SceneBuild *build, int place)
{
    Vec3 point;
    (void)place;
    return json_vec3(json, item, -DBL_MAX, DBL_MAX, &point) &&
           (scene_build_point(build, point) || fail_build(json, item, build));
}

/* Reads the element that begins at `at`, of a list that the tree lacks: straight from the text, or if that does not
 * add it, through a tree of its own, which does or tells why not. Returns its end, NULL on failure. */
static const char *read_element(const Json *json, const cJSON *list, BulkShape *shape, const char *at, int place)
{
    Json element;
    bool is_vertex = strcmp(list->string, "vertices") == 0;
    const char *end = is_vertex ? bulk_add_vertex(shape, at) : bulk_add_face(shape, at, place);
    if (end)
        return end;
    if (json->error->kind || !json_take_element(&element, json, list, at, place))
        return NULL;
    bool good = (is_vertex ? read_vertex : read_face)(&element, element.root, shape->build, place);
    json_free(&element);
    return good ? json_bulk_skip(at) : NULL;
}

/* Reads the vertices or the faces of an object. */
static bool read_rows(const Json *json, const cJSON *list, SceneBuild *build)
{
    BulkShape shape = {.build = build, .last_index = -1};
    JsonSpan inside;
    bool is_vertices = strcmp(list->string, "vertices") == 0, is_cut = json_is_cut(json, list, &inside);
    int place = 0;
    for (const cJSON *child = is_cut ? NULL : list->child; child; child = child->next)
        if (!(is_vertices ? read_vertex : read_face)(json, child, build, place++))
            return false;
    const char *at = is_cut ? json_blanks(inside.begin) : NULL;
    for (bool more = is_cut && at < inside.end; more;) {
        if (!(at = read_element(json, list, &shape, at, place++)))
            return false;
        at = json_blanks(bulk_after(at, &more));
    }
    return true;
}

bool scene_mesh_read(const Json *json, const cJSON *vertices, const cJSON *faces, SceneBuild *build)
{
    return json_list(json, vertices) && json_list(json, faces) && read_rows(json, vertices, build) &&
           read_rows(json, faces, build);
}

bool scene_mesh_fail_face(const Json *json, const cJSON *faces, const SceneBuild *build)
{
    Json face;
    JsonSpan inside;
    if (!json_is_cut(json, faces, &inside))
        return fail_build(json, cJSON_GetArrayItem(faces, build->fault->place), build);
    const char *at = json_blanks(inside.begin);
    for (int i = 0; i < build->fault->place; i++)
        at = json_blanks(json_bulk_mark(json_bulk_skip(at), ','));
    if (json_take_element(&face, json, faces, at, build->fault->place))
        fail_build(&face, face.root, build);
    json_free(&face);
    return false;
}
