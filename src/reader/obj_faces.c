/* The faces of a model. */
#include "reader/obj_faces.h"

#include "base/array.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>

/* --- References --- */

/* Cuts a whole number off the text: the largest one where it is beyond a long long. NULL where there is none. */
static inline char *cut_integer(char *at, long long *value)
{
    bool negative = *at == '-';
    at += negative;
    if (*at < '0' || *at > '9')
        return NULL;
    unsigned long long number = 0;
    for (; *at >= '0' && *at <= '9'; at++)
        number = number < LLONG_MAX / 10 ? 10 * number + (unsigned long long)(*at - '0') : LLONG_MAX;
    *value = negative ? -(long long)number : (long long)number;
    return at;
}

/* Goes past a slash and perhaps a number, of a texture or a normal: they are not used. */
static inline char *skip_index(char *at)
{
    long long unused;
    char *end = *at == '/' ? cut_integer(++at, &unused) : NULL;
    return end ? end : at;
}

static bool fail_reference(LineScan *scan, long line)
{
    return scan_fail(scan, line, "%s is not a reference to a vertex (like 7, -1, 7/1, 7//3, 7/1/3)",
                     scan_quote(scan_word(scan)).text);
}

/* a, a/b, a//c or a/b/c, where b and c may be missing; goes to the next word. The index counts from 0: a counts from 1,
 * or if it is negative back from the last vertex so far. */
static inline bool read_reference(LineScan *scan, int defined, long line, int *index)
{
    long long number;
    char *after = cut_integer(scan->at, &number), *end = after;
    if (!end || number == 0)
        return fail_reference(scan, line);
    end = skip_index(skip_index(end));
    if (!scan_word_ends(end))
        return fail_reference(scan, line);
    if (number < -defined || number > INT_MAX)
        return scan_fail(scan, line, "vertex %.*s does not exist; %d are defined above this line",
                         (int)fmin((double)(after - scan->at), 40), scan->at, defined);
    *index = (int)(number > 0 ? number - 1 : defined + number);
    scan->at = end;
    scan_blanks(scan);
    return true;
}

/* --- Faces --- */

static bool build_face(ObjFaces *faces, const LineScan *scan, const ObjWaiting *face)
{
    SceneBuild *build = faces->build;
    if (face->material < 0 && build->object.material < 0)
        return obj_materials_of_face(faces->materials, -1, face->line) >= 0;
    return scene_build_face(build, faces->vertices + face->first, face->count, face->material, (int)face->line) ||
           scan_fail(scan, face->line, "%s", build->reason);
}

static bool wait_for_end(ObjFaces *faces, ObjWaiting face)
{
    ObjWaiting *grown = array_grown(faces->waiting, faces->waiting_count, &faces->waiting_capacity, sizeof *grown,
                                    "faces", faces->build->error);
    if (!grown)
        return false;
    faces->waiting = grown;
    face.part = faces->part_count - 1;
    grown[faces->waiting_count++] = face;
    return true;
}

bool obj_faces_read(ObjFaces *faces, LineScan *scan)
{
    int defined = scene_build_point_count(faces->build), highest = -1;
    ObjWaiting face = {
        .first = faces->vertex_count, .material = faces->materials->current, .line = scan->line, .part = -1};
    for (; !scan_line_ends(scan); faces->vertex_count++) {
        int *grown = array_grown(faces->vertices, faces->vertex_count, &faces->vertex_capacity, sizeof *grown,
                                 "the vertices of a face", scan->error);
        if (!grown)
            return false;
        faces->vertices = grown;
        if (!read_reference(scan, defined, face.line, &grown[faces->vertex_count]))
            return false;
        highest = grown[faces->vertex_count] > highest ? grown[faces->vertex_count] : highest;
    }
    face.count = faces->vertex_count - face.first;
    if (face.count < 3 && (face.count == 0 || !faces->build->object.skip))
        return scan_fail(scan, face.line, "a face of %d vertices; it needs at least 3", face.count);
    faces->count++;
    if (highest >= defined || faces->waiting_count > 0)
        return wait_for_end(faces, face) && scan_next_line(scan);
    faces->vertex_count = face.first;
    return build_face(faces, scan, &face) && scan_next_line(scan);
}

/* --- Parts --- */

bool obj_faces_part(ObjFaces *faces, const char *name)
{
    Error *error = faces->build->error;
    if (faces->waiting_count == 0)
        return scene_build_part(faces->build, name);
    char **grown =
        array_grown(faces->parts, faces->part_count, &faces->part_capacity, sizeof *grown, "names of parts", error);
    if (!grown)
        return false;
    faces->parts = grown;
    grown[faces->part_count] = text_copy(name, error);
    return grown[faces->part_count] != NULL && ++faces->part_count > 0;
}

/* --- The end --- */

/* The faces that were built with a late material get it. */
static bool settle_materials(ObjFaces *faces)
{
    SceneBuild *build = faces->build;
    if (faces->materials->late_count == 0)
        return true;
    for (int i = build->scene->objects[build->scene->object_count - 1].first_face; i < build->face_count; i++) {
        SceneBuildFace *face = &build->faces[i];
        face->material = obj_materials_of_face(faces->materials, face->material, face->place);
        if (face->material < 0)
            return false;
    }
    return true;
}

static bool build_waiting(ObjFaces *faces, const LineScan *scan)
{
    int defined = scene_build_point_count(faces->build), part = -1;
    for (int i = 0; i < faces->waiting_count; i++) {
        ObjWaiting *face = &faces->waiting[i];
        for (int k = 0; k < face->count; k++)
            if (faces->vertices[face->first + k] >= defined)
                return scan_fail(scan, face->line, "vertex %d does not exist; the file has %d",
                                 faces->vertices[face->first + k] + 1, defined);
        face->material = obj_materials_of_face(faces->materials, face->material, face->line);
        if (face->material < 0 || (face->part > part && !scene_build_part(faces->build, faces->parts[face->part])) ||
            !build_face(faces, scan, face))
            return false;
        part = face->part;
    }
    return true;
}

bool obj_faces_finish(ObjFaces *faces, const LineScan *scan)
{
    return obj_materials_find_late(faces->materials) && settle_materials(faces) && build_waiting(faces, scan);
}

void obj_faces_free(ObjFaces *faces)
{
    for (int i = 0; i < faces->part_count; i++)
        free(faces->parts[i]);
    free(faces->parts);
    free(faces->vertices);
    free(faces->waiting);
    *faces = (ObjFaces){0};
}
