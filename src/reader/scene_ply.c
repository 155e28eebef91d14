/* PLY models, as text and binary (Turk, "The PLY Polygon File Format", 1994). A header names the elements of the file
 * and their properties; their values follow in that order. */
#include "reader/scene_ply.h"

#include "base/array.h"
#include "base/number.h"
#include "base/text.h"
#include "reader/bytes.h"

#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_ELEMENTS = 16, MAX_PROPERTIES = 64, NAME = 40, TEXT = 0, BIG_ENDIAN_BYTES = 2 };

/* Each type has an old and a new name. */
static const char *const type_names[] = {"char",   "int8",    "uchar", "uint8", "short",  "int16", "ushort",
                                         "uint16", "int",     "int32", "uint",  "uint32", "float", "float32",
                                         "double", "float64", "long",  "int64", "ulong",  "uint64"};
static const char *const formats[] = {"ascii", "binary_little_endian", "binary_big_endian"};

typedef struct Property {
    char name[NAME];
    int type, count_type; /* count_type: of a list; -1: it is none */
} Property;

typedef struct Element {
    char name[NAME];
    long count;
    Property properties[MAX_PROPERTIES];
    int property_count;
} Element;

typedef struct PlyReader {
    SceneBuild *build;
    const char *path, *at, *end;
    int format;
    long line; /* of a text, and of the header */
    Element elements[MAX_ELEMENTS];
    int element_count;
    const Element *element; /* that is read, and how many of its kind were */
    long done;
    int *vertices; /* of a face */
    int vertex_capacity;
} PlyReader;

static bool fail(const PlyReader *ply, const char *format, ...)
{
    char reason[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(reason, sizeof reason, format, arguments);
    va_end(arguments);
    if (ply->format == TEXT || !ply->element)
        return error_set(ply->build->error, ERROR_INPUT, "%s:%ld: %s", ply->path, ply->line, reason);
    return error_set(ply->build->error, ERROR_INPUT, "%s: %s %ld: %s", ply->path, ply->element->name, ply->done + 1,
                     reason);
}

/* The place of a word in a list; -1 where it is not there. */
static int find(const char *word, const char *const *words, int count)
{
    while (count > 0 && strcmp(word, words[count - 1]) != 0)
        count--;
    return count - 1;
}

/* --- The header --- */

/* What has no part in the picture is told. */
static bool note(PlyReader *ply, NoteName name, const char *what, const char *word, long count)
{
    char detail[2 * NAME];
    Quoted quoted = text_quote(word); /* used without its quotation marks */
    snprintf(detail, sizeof detail, "%s %.*s", what, (int)strlen(quoted.text) - 2, quoted.text + 1);
    return scene_build_note(ply->build, name, ply->path,
                            (NotePlace){.line = ply->line, .count = count, .detail = detail});
}

static bool add_element(PlyReader *ply, const char *name, const char *count)
{
    static const char *const used[] = {"vertex", "face"};
    char *end;
    if (ply->element_count == MAX_ELEMENTS)
        return fail(ply, "more than %d elements", MAX_ELEMENTS);
    Element *element = &ply->elements[ply->element_count++];
    *element = (Element){.count = strtol(count, &end, 10)};
    snprintf(element->name, NAME, "%s", name);
    if (*end || element->count < 0 || element->count > INT_MAX)
        return fail(ply, "%s is no number of elements", text_quote(count).text);
    return find(name, used, 2) >= 0 || note(ply, NOTE_UNKNOWN, "element", name, 1);
}

static bool add_property(PlyReader *ply, const char *name, const char *type, const char *count_type)
{
    static const char *const used[] = {"x", "y", "z", "vertex_indices", "vertex_index", "nx",    "ny",   "nz",   "s",
                                       "t", "u", "v", "texture_u",      "texture_v",    "green", "blue", "alpha"};
    Element *element = ply->elements + (ply->element_count > 0 ? ply->element_count - 1 : 0);
    if (ply->element_count == 0 || element->property_count == MAX_PROPERTIES)
        return fail(ply, "a property of no element, or more than %d of one", MAX_PROPERTIES);
    Property *property = &element->properties[element->property_count++];
    *property = (Property){.type = find(type, type_names, 2 * BYTES_TYPES), .count_type = -1};
    snprintf(property->name, NAME, "%s", name);
    if (count_type)
        property->count_type = find(count_type, type_names, 2 * BYTES_TYPES);
    if (property->type < 0 || (count_type && property->count_type < 0))
        return fail(ply, "the property %s has an unknown type", text_quote(name).text);
    property->type /= 2;
    property->count_type = count_type ? property->count_type / 2 : -1;
    bool of_vertex = strcmp(element->name, "vertex") == 0, of_face = strcmp(element->name, "face") == 0;
    if (of_vertex && strcmp(name, "red") == 0)
        return note(ply, NOTE_VERTEX_COLOURS, "property", name, element->count);
    return (!of_vertex && !of_face) || /* told with its element */
           find(name, used, sizeof used / sizeof *used) >= 0 || note(ply, NOTE_UNKNOWN, "property", name, 1);
}

/* Reads the line that begins at ply->at, and goes to the next one. */
static bool read_header_line(PlyReader *ply, bool *ended)
{
    char line[256], w[5][NAME] = {""};
    size_t length = strcspn(ply->at, "\r\n");
    snprintf(line, sizeof line, "%.*s", (int)(length < 255 ? length : 255), ply->at);
    ply->at += length + (ply->at[length] != '\0') + (ply->at[length] == '\r' && ply->at[length + 1] == '\n');
    ply->line++;
    int count = sscanf(line, "%39s %39s %39s %39s %39s", w[0], w[1], w[2], w[3], w[4]);
    *ended = strcmp(w[0], "end_header") == 0;
    if (strcmp(w[0], "format") == 0 && (ply->format = find(w[1], formats, 3)) >= 0 && strcmp(w[2], "1.0") == 0)
        return true;
    if (strcmp(w[0], "element") == 0 && count == 3)
        return add_element(ply, w[1], w[2]);
    if (strcmp(w[0], "property") == 0 && count == 3)
        return add_property(ply, w[2], w[1], NULL);
    if (strcmp(w[0], "property") == 0 && count == 5 && strcmp(w[1], "list") == 0)
        return add_property(ply, w[4], w[3], w[2]);
    static const char *const other[] = {"", "ply", "comment", "obj_info", "end_header"};
    return find(w[0], other, 5) >= 0 || fail(ply, "%s is no line of a PLY header", text_quote(line).text);
}

/* --- Values --- */

static bool read_text(PlyReader *ply, double *value)
{
    for (; *ply->at && strchr(" \t\r\n", *ply->at); ply->at++)
        ply->line += *ply->at == '\n' || (*ply->at == '\r' && ply->at[1] != '\n');
    const char *end = number_read(ply->at, NUMBER_C, value);
    size_t length = strcspn(ply->at, " \t\r\n");
    char *stop = NULL;
    if (length > 0 && end != ply->at + length && !isnan(*value = strtod(ply->at, &stop)) && !isinf(*value))
        stop = NULL;
    if (length == 0 || (end != ply->at + length && stop != ply->at + length))
        return fail(ply, length ? "a word that is no number" : "the file ends before its elements do");
    ply->at += length;
    return true;
}

static bool read_value(PlyReader *ply, int type, double *value)
{
    if (ply->format == TEXT)
        return read_text(ply, value);
    if (ply->end - ply->at < bytes_size((BytesType)type))
        return fail(ply, "the file ends before its elements do");
    *value = bytes_value(ply->at, (BytesType)type, ply->format == BIG_ENDIAN_BYTES);
    ply->at += bytes_size((BytesType)type);
    return true;
}

/* Reads a whole number below the limit. */
static bool read_whole(PlyReader *ply, int type, int limit, const char *what, int *value)
{
    double number;
    if (!read_value(ply, type, &number))
        return false;
    if (!(number >= 0 && number < limit && number == floor(number)))
        return fail(ply, "%s %.15g does not exist; there are %d", what, number, limit);
    *value = (int)number;
    return true;
}

/* --- Elements --- */

/* Reads a list as the vertices of a face, or past it. */
static bool read_list(PlyReader *ply, const Property *list, bool is_face)
{
    SceneBuild *build = ply->build;
    int count, room = scene_build_point_count(build);
    double unused;
    if (!read_whole(ply, list->count_type, INT_MAX, "a list of length", &count))
        return false;
    for (int i = 0; i < count; i++) {
        int *grown =
            array_grown(ply->vertices, is_face ? i : 0, &ply->vertex_capacity, sizeof *grown, "a face", build->error);
        if (!grown)
            return false;
        ply->vertices = grown;
        if (is_face ? !read_whole(ply, list->type, room, "vertex", &grown[i]) : !read_value(ply, list->type, &unused))
            return false;
    }
    if (is_face && count < 3 && (count == 0 || !build->object.skip))
        return fail(ply, "a face of %d vertices; it needs at least 3", count);
    int place = (int)(ply->format == TEXT ? ply->line : -(ply->done + 1));
    return !is_face || scene_build_face(build, ply->vertices, count, -1, place) || fail(ply, "%s", build->reason);
}

static bool read_element(PlyReader *ply, bool is_vertex, bool is_face)
{
    static const char *const axes[] = {"x", "y", "z", "none"};
    const double none = (double)NAN;
    double c[4] = {none, none, none, 0};
    for (int i = 0; i < ply->element->property_count; i++) {
        const Property *property = &ply->element->properties[i];
        bool is_list = property->count_type >= 0, indices = strncmp(property->name, "vertex_ind", 10) == 0;
        int axis = find(property->name, axes, 3);
        if (is_list ? !read_list(ply, property, is_face && indices)
                    : !read_value(ply, property->type, &c[axis >= 0 ? axis : 3]))
            return false;
    }
    return !is_vertex || scene_build_point(ply->build, vec3(c[0], c[1], c[2])) || fail(ply, "%s", ply->build->reason);
}

/* What follows the last element, but for blanks. */
static bool note_the_rest(PlyReader *ply)
{
    char size[NAME];
    for (; ply->at < ply->end && strchr(" \t\r\n", *ply->at); ply->at++) /* true of a NUL, too */
        ply->line += *ply->at == '\n' || (*ply->at == '\r' && ply->at[1] != '\n');
    snprintf(size, sizeof size, "%ld", (long)(ply->end - ply->at));
    ply->line = ply->format == TEXT ? ply->line : 0;
    return ply->at == ply->end || note(ply, NOTE_UNKNOWN, "bytes behind the last element:", size, 1);
}

static bool read_file(PlyReader *ply)
{
    for (bool ended = false; !ended;)
        if (!read_header_line(ply, &ended) || (!ended && !*ply->at && !fail(ply, "the header has no end")))
            return false;
    int before = ply->build->next_number;
    ply->line++;
    for (int i = 0; i < ply->element_count; i++) {
        ply->element = &ply->elements[i];
        bool is_vertex = strcmp(ply->element->name, "vertex") == 0, is_face = strcmp(ply->element->name, "face") == 0;
        long count = ply->element->property_count > 0 ? ply->element->count : 0;
        for (ply->done = 0; ply->done < count; ply->done++)
            if (!read_element(ply, is_vertex, is_face))
                return false;
    }
    if (ply->build->next_number == before)
        return scene_build_fail_empty(ply->build, ply->path, "this PLY file holds no face (a list vertex_indices)");
    return note_the_rest(ply);
}

bool scene_ply_read(SceneBuild *build, const char *path)
{
    long length = 0;
    PlyReader *ply = calloc(1, sizeof *ply);
    char *text = ply ? text_read(path, LONG_MAX - 1, &length, build->error) : NULL;
    bool good = text != NULL;
    if (!ply)
        return error_memory(build->error, path);
    if (good) {
        *ply = (PlyReader){.build = build, .path = path, .at = text, .end = text + length};
        ply->at += strncmp(text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0; /* a byte order mark */
        number_prepare();
        good = scene_build_model(build, path);
        build->object.first_number = 0;
        good = good && read_file(ply);
    }
    free(text);
    free(ply->vertices);
    free(ply);
    return good;
}
