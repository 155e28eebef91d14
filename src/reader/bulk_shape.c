/* The rows of an object: straight from the text into the arrays of the build. */
#include "reader/bulk_shape.h"

#include <stdlib.h>

int bulk_material(BulkShape *shape, JsonSpan name)
{
    char text[256];
    size_t length = (size_t)(name.end - name.begin);
    JsonSpan last = shape->last_material;
    if (last.begin && length == (size_t)(last.end - last.begin) && memcmp(name.begin, last.begin, length) == 0)
        return shape->last_index;
    if (length >= sizeof text)
        return -1;
    memcpy(text, name.begin, length);
    text[length] = '\0';
    shape->last_material = name;
    shape->last_index = names_find(&shape->build->materials, text);
    return shape->last_index;
}

const char *bulk_after(const char *at, bool *more)
{
    at = json_blanks(at);
    *more = *at == ',';
    return *at == ',' || *at == ']' ? at + 1 : NULL;
}

const char *bulk_vertices(BulkShape *shape, const char *at)
{
    at = json_bulk_mark(at, '[');
    if (at && *json_blanks(at) == ']')
        return json_blanks(at) + 1;
    for (bool more = at != NULL; more;) {
        double c[3];
        Vec3 *point = scene_build_next_point(shape->build, shape->point_count++);
        if (!point || !(at = json_bulk_triple(at, c)))
            return NULL;
        *point = vec3(c[0], c[1], c[2]);
        at = bulk_after(at, &more);
    }
    return at;
}

/* [a, b, c, ...] */
static const char *read_indices(const char *at, BulkRow *row)
{
    int unused;
    row->count = 0;
    at = json_bulk_mark(at, '[');
    for (bool more = at != NULL; more; row->count++) {
        if (!(at = json_bulk_index(at, row->count < row->room ? &row->vertices[row->count] : &unused)))
            return NULL;
        at = bulk_after(at, &more);
    }
    return row->count >= 3 ? at : NULL;
}

/* {"vertices": [a, b, c], "material": "name"} */
static const char *read_face_object(BulkShape *shape, const char *at, BulkRow *row)
{
    bool has_vertices = false, has_material = false;
    at = json_bulk_mark(at, '{');
    for (bool more = at != NULL; more;) {
        JsonSpan key, name;
        if (!(at = json_bulk_string(at, &key)) || !(at = json_bulk_mark(at, ':')))
            return NULL;
        if (!has_vertices && json_span_is(key, "vertices")) {
            has_vertices = true;
            at = read_indices(at, row);
        } else if (!has_material && json_span_is(key, "material")) {
            has_material = true;
            at = json_bulk_string(at, &name);
            row->material = at ? bulk_material(shape, name) : -1;
            at = row->material >= 0 ? at : NULL;
        } else
            return NULL;
        if (!at)
            return NULL;
        at = json_blanks(at);
        more = *at == ',';
        at = *at == ',' || *at == '}' ? at + 1 : NULL;
    }
    return has_vertices ? at : NULL;
}

const char *bulk_face(BulkShape *shape, const char *at, BulkRow *row)
{
    row->material = -1;
    at = json_blanks(at);
    return *at == '[' ? read_indices(at, row) : read_face_object(shape, at, row);
}

const char *bulk_faces(BulkShape *shape, const char *at)
{
    at = json_bulk_mark(at, '[');
    if (at && *json_blanks(at) == ']')
        return json_blanks(at) + 1;
    for (bool more = at != NULL; more;) {
        SceneBuildFace *face = scene_build_next_face(shape->build, shape->face_count);
        if (!face)
            return NULL;
        BulkRow row = {.vertices = face->points, .room = 4};
        if (!(at = bulk_face(shape, at, &row)))
            return NULL;
        shape->has_polygons = shape->has_polygons || row.count > 4;
        face->vertex_count = row.count == 3 ? 3 : 4;
        face->material = row.material;
        face->place = shape->face_count++;
        at = bulk_after(at, &more);
    }
    return at;
}

const char *bulk_add_vertex(BulkShape *shape, const char *at)
{
    double c[3];
    at = json_bulk_triple(at, c);
    return at && scene_build_point(shape->build, vec3(c[0], c[1], c[2])) ? at : NULL;
}

const char *bulk_add_face(BulkShape *shape, const char *at, int place)
{
    int few[8];
    BulkRow row = {.vertices = few, .room = sizeof few / sizeof *few};
    const char *end = bulk_face(shape, at, &row);
    if (end && row.count > row.room) {
        row.room = row.count;
        row.vertices = malloc((size_t)row.room * sizeof *row.vertices);
        if (!row.vertices) {
            error_memory(shape->build->error, "a face");
            return NULL;
        }
        bulk_face(shape, at, &row);
    }
    bool good = end != NULL;
    for (int i = 0; good && i < row.count; i++)
        good = row.vertices[i] < scene_build_point_count(shape->build);
    good = good && scene_build_face(shape->build, row.vertices, row.count, row.material, place);
    if (row.vertices != few)
        free(row.vertices);
    return good ? end : NULL;
}

const char *bulk_box(BulkShape *shape, const char *at)
{
    static const char *const words[] = {"min", "max"};
    double c[2][3];
    JsonSpan key;
    at = json_bulk_mark(at, '{');
    for (int i = 0; i < 2; i++)
        if (!at || !(at = json_bulk_string(at, &key)) || !json_span_is(key, words[i]) ||
            !(at = json_bulk_mark(at, ':')) || !(at = json_bulk_triple(at, c[i])) ||
            !(at = json_bulk_mark(at, i == 0 ? ',' : '}')))
            return NULL;
    for (int axis = 0; axis < 3; axis++)
        if (!(c[0][axis] < c[1][axis]))
            return NULL;
    shape->has_box = true;
    shape->low = vec3(c[0][0], c[0][1], c[0][2]);
    shape->high = vec3(c[1][0], c[1][1], c[1][2]);
    return at;
}
