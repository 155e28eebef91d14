/* The "objects" of a scene file, straight from its text. */
#include "reader/scene_bulk.h"

#include "reader/bulk_shape.h"
#include "reader/scene_objects.h"

#include <stdlib.h>

enum { MOST_MEMBERS = 16 }; /* more than an object has keys */

/* An object while it is read. */
typedef struct BulkReader {
    const Json *json; /* for its name */
    SceneBuild *build;
    BulkShape shape;
    JsonSpan name, material;
    const char *vertices, *faces; /* where their lists begin; NULL: none */
    JsonSpan heads[MOST_MEMBERS]; /* "key": value of all members but vertices, faces and box */
    int head_count;
    bool needs_tree; /* a head is none of the plain ones */
} BulkReader;

/* --- An object --- */

/* A member that says something of the object as a whole. */
static const char *read_head(BulkReader *reader, JsonSpan key, const char *begin, const char *at)
{
    JsonSpan *plain = json_span_is(key, "name")       ? &reader->name
                      : json_span_is(key, "material") ? &reader->material
                                                      : NULL;
    if (reader->head_count == MOST_MEMBERS)
        return NULL;
    const char *end = plain && !plain->begin ? json_bulk_string(at, plain) : NULL;
    reader->needs_tree = reader->needs_tree || !end;
    end = end ? end : json_bulk_skip(at);
    reader->heads[reader->head_count++] = (JsonSpan){begin, end};
    return end;
}

static const char *read_member(BulkReader *reader, const char *at)
{
    JsonSpan key;
    const char *begin = at = json_blanks(at);
    if (!(at = json_bulk_string(at, &key)) || !(at = json_bulk_mark(at, ':')))
        return NULL;
    if (json_span_is(key, "vertices")) {
        bool again = reader->vertices != NULL;
        reader->vertices = at;
        return again ? NULL : bulk_vertices(&reader->shape, at);
    }
    if (json_span_is(key, "faces")) {
        bool again = reader->faces != NULL;
        reader->faces = at;
        return again ? NULL : bulk_faces(&reader->shape, at);
    }
    if (json_span_is(key, "box"))
        return reader->shape.has_box ? NULL : bulk_box(&reader->shape, at);
    return read_head(reader, key, begin, at);
}

/* Begins an object that has a name and a material at most. */
static bool begin_plain(BulkReader *reader, int index)
{
    SceneBuildObject object = {.material = -1, .transform = transform_identity()};
    char name[256];
    size_t length = (size_t)(reader->name.end - reader->name.begin);
    if (length >= sizeof name)
        return false;
    memcpy(name, reader->name.begin ? reader->name.begin : "", length);
    name[length] = '\0';
    if (reader->material.begin && (object.material = bulk_material(&reader->shape, reader->material)) < 0)
        return false;
    return scene_build_object(reader->build, reader->name.begin ? name : scene_objects_unnamed(index).text, object);
}

/* Writes {"key": value, ...} of the members. NULL without memory. */
static char *text_of_heads(const BulkReader *reader, long *length)
{
    size_t size = 3;
    for (int i = 0; i < reader->head_count; i++)
        size += (size_t)(reader->heads[i].end - reader->heads[i].begin) + 1;
    char *text = malloc(size), *at = text;
    if (!text)
        return NULL;
    *at++ = '{';
    for (int i = 0; i < reader->head_count; i++) {
        size_t bytes = (size_t)(reader->heads[i].end - reader->heads[i].begin);
        if (i > 0)
            *at++ = ',';
        memcpy(at, reader->heads[i].begin, bytes);
        at += bytes;
    }
    *at++ = '}';
    *at = '\0';
    *length = at - text;
    return text;
}

/* Begins an object through the tree of its members; adds the model that it may name. */
static bool begin_by_tree(BulkReader *reader, int index)
{
    Json heads;
    long length = 0;
    char *text = text_of_heads(reader, &length);
    if (!text)
        return error_memory(reader->build->error, "an object");
    if (!json_take(&heads, reader->json->name, text, length, reader->build->error))
        return false;
    bool is_model = !reader->vertices && !reader->shape.has_box;
    bool good = scene_objects_begin(&heads, index, is_model, reader->build);
    json_free(&heads);
    return good;
}

/* The object's faces one by one: where those that are not planar are split, and those without area left out, a face may
 * become several or none. */
static bool add_slowly(BulkReader *reader)
{
    SceneBuild *build = reader->build;
    for (int i = 0; i < reader->shape.point_count; i++)
        if (!scene_build_point(build, build->points[build->point_count]))
            return false;
    const char *at = json_bulk_mark(reader->faces, '[');
    bool more = reader->shape.face_count > 0;
    for (int place = 0; more && at; place++) {
        if (!(at = bulk_add_face(&reader->shape, at, place)))
            return false;
        at = bulk_after(at, &more);
    }
    return true;
}

static bool add_shape(BulkReader *reader)
{
    SceneBuild *build = reader->build;
    if (reader->shape.has_box)
        return scene_build_adopt_box(build, reader->shape.low, reader->shape.high);
    if (!reader->vertices)
        return true;
    return reader->shape.has_polygons || build->object.split || build->object.skip
               ? add_slowly(reader)
               : scene_build_adopt(build, reader->shape.point_count, reader->shape.face_count);
}

static const char *read_object(BulkReader *reader, const char *at, int index)
{
    BulkShape *shape = &reader->shape;
    *shape =
        (BulkShape){.build = reader->build, .last_material = shape->last_material, .last_index = shape->last_index};
    *reader = (BulkReader){.json = reader->json, .build = reader->build, .shape = *shape};
    at = json_bulk_mark(at, '{');
    for (bool more = at != NULL; more;) {
        if (!(at = read_member(reader, at)))
            return NULL;
        at = json_blanks(at);
        more = *at == ',';
        at = *at == ',' || *at == '}' ? at + 1 : NULL;
    }
    bool mesh = reader->vertices && reader->faces;
    if (!at || (!mesh && (reader->vertices || reader->faces)) || (mesh && reader->shape.has_box))
        return NULL;
    bool shaped = mesh || reader->shape.has_box;
    bool good = reader->needs_tree ? begin_by_tree(reader, index) : shaped && begin_plain(reader, index);
    return good && add_shape(reader) ? at : NULL;
}

bool scene_bulk_read(const Json *json, JsonSpan objects, SceneBuild *build)
{
    BulkReader reader = {.json = json, .build = build, .shape = {.last_index = -1}};
    const char *at = json_blanks(objects.begin);
    int index = 0;
    if (at == objects.end)
        return true;
    for (bool more = true; more;) {
        if (!(at = read_object(&reader, at, index++)))
            return false;
        at = bulk_after(at, &more);
    }
    return at == objects.end + 1;
}
