/* Wavefront OBJ models: one pass over the text, line by line. Vertices are read here. */
#include "reader/scene_obj.h"

#include "reader/obj_faces.h"

#include <math.h>

typedef struct ObjReader {
    SceneBuild *build;
    LineScan scan;
    ObjMaterials materials;
    ObjFaces faces;
    NotePlace colours; /* of vertices */
} ObjReader;

/* x y z, then a weight w or a colour, with or without alpha. */
static bool read_vertex(ObjReader *reader)
{
    LineScan *scan = &reader->scan;
    double c[7];
    int count;
    long line = scan->line;
    if (!scan_numbers(scan, c, 7, &count))
        return false;
    if (count < 3 || count == 5)
        return scan_fail(scan, line, "a vertex needs three coordinates, not %d", count);
    if (count >= 6) {
        reader->colours.line = reader->colours.count++ > 0 ? reader->colours.line : line;
    } else if (count == 4 && c[3] != 1) {
        for (int i = 0; i < 3; i++)
            c[i] /= c[3];
    }
    return scene_build_point(reader->build, vec3(c[0], c[1], c[2]))
               ? scan_next_line(scan)
               : scan_fail(scan, line, "%s", reader->build->reason);
}

/* Lines that are left out: by their keywords. NOTE_NAMES: without a note. */
static const struct {
    const char *key;
    NoteName note;
} left_out[] = {
    {"vn", NOTE_NAMES},          {"vt", NOTE_NAMES},         {"l", NOTE_LINES},
    {"p", NOTE_POINTS},          {"vp", NOTE_CURVES},        {"cstype", NOTE_CURVES},
    {"deg", NOTE_CURVES},        {"bmat", NOTE_CURVES},      {"step", NOTE_CURVES},
    {"curv", NOTE_CURVES},       {"curv2", NOTE_CURVES},     {"surf", NOTE_CURVES},
    {"parm", NOTE_CURVES},       {"trim", NOTE_CURVES},      {"hole", NOTE_CURVES},
    {"scrv", NOTE_CURVES},       {"sp", NOTE_CURVES},        {"end", NOTE_CURVES},
    {"con", NOTE_CURVES},        {"mg", NOTE_DISPLAY},       {"bevel", NOTE_DISPLAY},
    {"c_interp", NOTE_DISPLAY},  {"d_interp", NOTE_DISPLAY}, {"lod", NOTE_DISPLAY},
    {"usemap", NOTE_DISPLAY},    {"maplib", NOTE_DISPLAY},   {"shadow_obj", NOTE_DISPLAY},
    {"trace_obj", NOTE_DISPLAY}, {"ctech", NOTE_DISPLAY},    {"stech", NOTE_DISPLAY},
};

static bool leave_out(ObjReader *reader, ScanWord key, long line)
{
    NoteName note = NOTE_UNKNOWN;
    for (size_t i = 0; i < sizeof left_out / sizeof *left_out && note == NOTE_UNKNOWN; i++)
        if (scan_word_is(key, left_out[i].key))
            note = left_out[i].note;
    Quoted word = scan_quote(key);
    NotePlace place = {.line = line, .detail = note == NOTE_UNKNOWN ? word.text : NULL};
    if (note != NOTE_NAMES && !scene_build_note(reader->build, note, reader->scan.path, place))
        return false;
    return scan_next_line(&reader->scan);
}

/* Reads a line that begins with some other word than v and f. */
static bool read_key(ObjReader *reader, ScanWord key, long line)
{
    LineScan *scan = &reader->scan;
    if (scan_word_is(key, "v")) /* in capitals, as the next */
        return read_vertex(reader);
    if (scan_word_is(key, "f"))
        return obj_faces_read(&reader->faces, scan);
    if (scan_word_is(key, "usemtl"))
        return obj_materials_use(&reader->materials, scan_rest(scan), line);
    if (scan_word_is(key, "mtllib"))
        return obj_materials_add(&reader->materials, scan_rest(scan), line);
    if (scan_word_is(key, "o") || scan_word_is(key, "g"))
        return obj_faces_part(&reader->faces, scan_rest(scan));
    if (scan_word_is(key, "s")) {
        ScanWord group = scan_word(scan);
        bool off = group.length == 0 || scan_word_is(group, "off") || scan_word_is(group, "0");
        if (!off && !scene_build_note(reader->build, NOTE_SMOOTHING, scan->path, (NotePlace){.line = line}))
            return false;
        return scan_next_line(scan);
    }
    return leave_out(reader, key, line);
}

static bool read_line(void *user)
{
    ObjReader *reader = user;
    LineScan *scan = &reader->scan;
    scan_blanks(scan);
    char key = *scan->at;
    if (scan_line_ends(scan))
        return scan_next_line(scan);
    long line = scan->line;
    if ((key == 'v' || key == 'f') && scan_word_ends(scan->at + 1)) {
        scan->at++;
        scan_blanks(scan);
        return key == 'v' ? read_vertex(reader) : obj_faces_read(&reader->faces, scan);
    }
    return read_key(reader, scan_word(scan), line);
}

bool scene_obj_read(SceneBuild *build, const char *path)
{
    ObjReader reader = {
        .build = build,
        .scan = {.line = 1, .path = path, .error = build->error},
        .materials = {.build = build, .path = path, .current = -1},
        .faces = {.build = build, .materials = &reader.materials},
    };
    bool good = scene_build_model(build, path) && scan_file(&reader.scan, read_line, &reader) &&
                obj_faces_finish(&reader.faces, &reader.scan);
    if (good && reader.faces.count == 0)
        good = scene_build_fail_empty(build, path, "holds no face");
    if (good && reader.colours.count > 0)
        good = scene_build_note(build, NOTE_VERTEX_COLOURS, path, reader.colours);
    scene_build_end_parts(build);
    obj_faces_free(&reader.faces);
    obj_materials_free(&reader.materials);
    return good;
}
