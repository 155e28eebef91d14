/* Wavefront OBJ models: the geometry, line by line, so that a model of ten million faces needs no copy of its text. */
#include "reader/scene_obj.h"

#include "base/words.h"
#include "reader/scene_mtl.h"

#include <stdlib.h>
#include <string.h>

typedef struct ObjReader {
    SceneBuild *build;
    TextLines lines;
    MtlLibrary library;
    int material;   /* of the faces that follow; -1: the object's own */
    Quoted missing; /* what usemtl asked for in vain; empty where it did not */
    int face_count;
} ObjReader;

static bool read_vertex(ObjReader *reader, char *rest)
{
    SceneBuild *build = reader->build;
    double c[8];
    int count;
    if (!word_numbers(&reader->lines, rest, c, 7, &count, build->error))
        return false;
    if (count < 3 || count == 5)
        return word_fail(&reader->lines, build->error, "a vertex needs three coordinates, not %d", count);
    if ((count == 4 || count == 7) && c[3] != 1)
        return word_fail(&reader->lines, build->error, "a vertex with the weight %g; only 1 is supported", c[3]);
    /* 6 or 7 numbers: a colour follows, which says nothing about the shape */
    return scene_build_point(build, vec3(c[0], c[1], c[2])) ||
           word_fail(&reader->lines, build->error, "%s", build->reason);
}

/* Cuts a whole number that is not 0 off the text. */
static bool cut_integer(const char **at, long long *value)
{
    const char *digits = *at + (**at == '-');
    if (*digits < '0' || *digits > '9')
        return false;
    char *end;
    *value = strtoll(*at, &end, 10);
    *at = end;
    return *value != 0;
}

/* a, a/b, a//c or a/b/c. b and c (texture, normal) must be numbers, but are not used. */
static bool parse_reference(const char *at, long long *vertex)
{
    long long unused;
    if (!cut_integer(&at, vertex))
        return false;
    if (*at == '/' && at[1] != '/') {
        at++;
        if (!cut_integer(&at, &unused))
            return false;
        if (*at == '/') {
            at++;
            return cut_integer(&at, &unused) && !*at;
        }
    } else if (*at == '/') {
        at += 2;
        return cut_integer(&at, &unused) && !*at;
    }
    return !*at;
}

/* The referred vertex as an index from 0 within the object.
 * Negative references count back from the last vertex so far. */
static bool read_reference(const ObjReader *reader, const char *word, int *vertex)
{
    Error *error = reader->build->error;
    int defined = scene_build_point_count(reader->build);
    long long number;
    if (!parse_reference(word, &number))
        return word_fail(&reader->lines, error, "%s is not a reference to a vertex (like 7, -1, 7/1, 7//3, 7/1/3)",
                         text_quote(word).text);
    if (number > defined || number < -defined)
        return word_fail(&reader->lines, error, "vertex %lld does not exist; %d are defined above this line", number,
                         defined);
    *vertex = (int)(number > 0 ? number - 1 : defined + number);
    return true;
}

static bool read_face(ObjReader *reader, char *rest)
{
    SceneBuild *build = reader->build;
    int vertices[4], count = 0;
    for (char *word = word_next(&rest); *word; word = word_next(&rest), count++)
        if (count < 4 && !read_reference(reader, word, &vertices[count]))
            return false;
    if (count < 3 || count > 4)
        return word_fail(&reader->lines, build->error, "a face of %d vertices; 3 or 4 are supported", count);
    reader->face_count++;
    if (reader->material < 0 && build->object.material < 0 && reader->missing.text[0])
        return word_fail(&reader->lines, build->error,
                         "the face has no material: %s is not in the scene nor in a library, and the object names none",
                         reader->missing.text);
    return scene_build_face(build, vertices, count, reader->material, (int)reader->lines.line) ||
           word_fail(&reader->lines, build->error, "%s", build->reason);
}

/* The scene's material of that name, then the libraries', else the object's own. */
static bool use_material(ObjReader *reader, const char *name)
{
    SceneBuild *build = reader->build;
    if (!*name)
        return word_fail(&reader->lines, build->error, "usemtl without a name");
    reader->material = names_find(&build->materials, name);
    int own = reader->material < 0 ? names_find(&reader->library.names, name) : -1;
    reader->missing = reader->material < 0 && own < 0 ? text_quote(name) : (Quoted){""};
    if (own < 0)
        return true;
    int *used_as = &reader->library.used_as[own];
    if (*used_as < 0)
        *used_as = scene_build_material(build, reader->library.materials[own]);
    reader->material = *used_as;
    return *used_as >= 0;
}

static bool read_libraries(ObjReader *reader, char *rest)
{
    Error *error = reader->build->error;
    char *name = word_next(&rest);
    if (!*name)
        return word_fail(&reader->lines, error, "mtllib without a file");
    for (; *name; name = word_next(&rest)) {
        char *path = text_beside(reader->lines.path, name, error);
        Error reason = {.kind = ERROR_NONE};
        if (!path)
            return false;
        if (!scene_mtl_read(&reader->library, path, &reason))
            return reason.kind == ERROR_INPUT ? word_fail(&reader->lines, error, "mtllib: %s", reason.text)
                                              : error_set(error, reason.kind, "%s", reason.text);
    }
    return true;
}

static bool is_continued(const char *line)
{
    size_t length = strlen(line);
    return length > 0 && line[length - 1] == '\\';
}

static bool read_line(ObjReader *reader, char *line)
{
    char *rest = line;
    bool continued = is_continued(line);
    const char *key = word_next(&rest);
    if (continued && (strcmp(key, "v") == 0 || strcmp(key, "f") == 0))
        return word_fail(&reader->lines, reader->build->error,
                         "the line goes on after its '\\', which is not supported; join it with the next one");
    if (strcmp(key, "v") == 0)
        return read_vertex(reader, rest);
    if (strcmp(key, "f") == 0)
        return read_face(reader, rest);
    if (strcmp(key, "usemtl") == 0)
        return use_material(reader, word_rest(&rest));
    if (strcmp(key, "mtllib") == 0)
        return read_libraries(reader, rest);
    if (strcmp(key, "l") == 0)
        return scene_build_note(reader->build, NOTE_LINES, reader->lines.path, (NotePlace){.line = reader->lines.line});
    return true;
}

bool scene_obj_read(SceneBuild *build, const char *path)
{
    ObjReader reader = {.build = build, .material = -1};
    build->object.first_number = 1;
    bool good = text_open_lines(&reader.lines, path, build->error);
    for (char *line; good && (line = text_next_line(&reader.lines, build->error));)
        good = read_line(&reader, line);
    good = good && build->error->kind == ERROR_NONE;
    if (good && reader.face_count == 0)
        good = error_set(build->error, ERROR_INPUT, "%s: holds no face", path);
    text_close_lines(&reader.lines);
    scene_mtl_free(&reader.library);
    return good;
}
