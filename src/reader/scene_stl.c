/* STL models. */
#include "reader/scene_stl.h"

#include "base/text.h"
#include "reader/bytes.h"
#include "reader/line_scan.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { HEADER = 84, TRIANGLE = 50 }; /* bytes */

bool scene_stl_is_text(const char *text)
{
    return strncasecmp(text, "solid", 5) == 0 && (text[5] == '\0' || strchr(" \t\r\n", text[5]));
}

bool scene_stl_is_binary(const char *bytes, long length, long size)
{
    return length >= HEADER && size == HEADER + TRIANGLE * (long)bytes_value(bytes + 80, BYTES_UINT32, false);
}

/* Adds the triangle of the three vertices that were added last. */
static bool add_triangle(SceneBuild *build, int place)
{
    int count = scene_build_point_count(build);
    return scene_build_face(build, (int[]){count - 3, count - 2, count - 1}, 3, -1, place);
}

typedef struct StlText {
    SceneBuild *build;
    LineScan scan;
    int vertices; /* of the facet so far */
} StlText;

static bool read_vertex(StlText *stl, long line)
{
    double c[3];
    int count;
    if (!scan_numbers(&stl->scan, c, 3, &count))
        return false;
    if (count != 3)
        return scan_fail(&stl->scan, line, "a vertex needs three coordinates, not %d", count);
    if (++stl->vertices > 3)
        return scan_fail(&stl->scan, line, "a facet of more than 3 vertices");
    return (scene_build_point(stl->build, vec3(c[0], c[1], c[2])) &&
            (stl->vertices < 3 || add_triangle(stl->build, (int)line)))
               ? scan_next_line(&stl->scan)
               : scan_fail(&stl->scan, line, "%s", stl->build->reason);
}

static bool read_line(void *user)
{
    static const char *const others[] = {"", "facet", "outer", "endloop", "endsolid"};
    StlText *stl = user;
    scan_blanks(&stl->scan);
    long line = stl->scan.line;
    ScanWord key = scan_word(&stl->scan);
    if (scan_word_is(key, "vertex"))
        return read_vertex(stl, line);
    if (scan_word_is(key, "solid"))
        return scene_build_part(stl->build, scan_rest(&stl->scan));
    if (scan_word_is(key, "endfacet")) {
        if (stl->vertices != 3)
            return scan_fail(&stl->scan, line, "a facet of %d vertices; it needs 3", stl->vertices);
        stl->vertices = 0;
        return scan_next_line(&stl->scan);
    }
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (scan_word_is(key, others[i]))
            return scan_next_line(&stl->scan);
    return scan_fail(&stl->scan, line, "%s is no word of STL (solid, facet, vertex, ...)", scan_quote(key).text);
}

static Vec3 binary_point(const char *bytes)
{
    return vec3(bytes_value(bytes, BYTES_FLOAT32, false), bytes_value(bytes + 4, BYTES_FLOAT32, false),
                bytes_value(bytes + 8, BYTES_FLOAT32, false));
}

static bool read_binary(SceneBuild *build, const char *path)
{
    long length = 0;
    char *bytes = text_read(path, LONG_MAX - 1, &length, build->error);
    bool good = bytes != NULL;
    for (long at = HEADER, number = 1; good && at + TRIANGLE <= length; at += TRIANGLE, number++) {
        const char *points = bytes + at + 12; /* after the normal */
        good = scene_build_point(build, binary_point(points)) && scene_build_point(build, binary_point(points + 12)) &&
               scene_build_point(build, binary_point(points + 24)) && add_triangle(build, -(int)number);
        if (!good)
            error_set(build->error, ERROR_INPUT, "%s: face %ld: %s", path, number, build->reason);
    }
    free(bytes);
    return good;
}

bool scene_stl_read(SceneBuild *build, const char *path, bool is_binary)
{
    StlText stl = {.build = build, .scan = {.line = 1, .path = path, .error = build->error}};
    int before = build->next_number;
    if (!scene_build_model(build, path) ||
        !(is_binary ? read_binary(build, path) : scan_file(&stl.scan, read_line, &stl)))
        return false;
    scene_build_end_parts(build);
    return build->next_number > before || scene_build_fail_empty(build, path, "holds no face");
}
