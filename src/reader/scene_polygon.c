/* What becomes of a face that is no good quad or triangle. docs/scene-format.md has the rules in a table. */
#include "reader/scene_polygon.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

static bool fail(SceneBuild *build, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(build->reason, sizeof build->reason, format, arguments);
    va_end(arguments);
    return false;
}

/* The vertex at a corner, as the file counts it. */
static int number_at(const SceneBuild *build, int corner)
{
    return build->corners[corner] + build->object.first_number;
}

static bool note(SceneBuild *build, NoteName name, int place)
{
    return scene_build_note_face(build, name, build->scene->object_count - 1, place);
}

/* --- The corners --- */

static bool reserve(SceneBuild *build, int count)
{
    if (count <= build->corner_capacity)
        return true;
    int *corners = realloc(build->corners, (size_t)count * sizeof *corners);
    build->corners = corners ? corners : build->corners;
    Vec3 *points = realloc(build->corner_points, (size_t)count * sizeof *points);
    build->corner_points = points ? points : build->corner_points;
    if (!corners || !points)
        return error_memory(build->error, "a polygon");
    build->corner_capacity = count;
    return true;
}

static void fetch_points(SceneBuild *build, int count)
{
    for (int i = 0; i < count; i++)
        build->corner_points[i] = build->points[build->object.first_point + build->corners[i]];
}

static bool take_corners(SceneBuild *build, const int *vertices, int count)
{
    if (!reserve(build, count > 4 ? count : 4))
        return false;
    for (int i = 0; i < count; i++)
        build->corners[i] = vertices[i];
    fetch_points(build, count);
    for (int i = 0; i < count; i++)
        if (!vec3_is_finite(build->corner_points[i]))
            return fail(build, "vertex %d of the face is not a finite number", number_at(build, i));
    return true;
}

/* --- Repeated points --- */

static bool fail_repeated(SceneBuild *build, int first, int second)
{
    int a = number_at(build, first), b = number_at(build, second);
    return a == b ? fail(build, "the face uses vertex %d twice", a)
                  : fail(build, "vertices %d and %d of the face are the same point", a, b);
}

/* Of 3 or 4 vertices no two may be one point. In a larger polygon only neighbours may not: it may meet itself. */
static bool check_repeats(SceneBuild *build, int count)
{
    const Vec3 *p = build->corner_points;
    for (int i = 0; i < count; i++)
        for (int k = i + 1; k < count; k++) {
            bool neighbours = count <= 4 || k == i + 1 || (i == 0 && k == count - 1);
            if (neighbours && p[i].x == p[k].x && p[i].y == p[k].y && p[i].z == p[k].z)
                return fail_repeated(build, i, k);
        }
    return true;
}

/* Returns how many corners are left. */
static int drop_repeats(SceneBuild *build, int count)
{
    const Vec3 *points = build->points + build->object.first_point;
    int left = polygon_drop_repeats(points, build->corners, count);
    fetch_points(build, left);
    return left;
}

/* --- Verdicts --- */

static bool fail_not_planar(SceneBuild *build, int count)
{
    const PolygonCut *cut = &build->cut;
    if (count > 4)
        return fail(build,
                    "the face is not planar: vertex %d is %.6g from its plane, and 1e-5 of its size (%.6g) is allowed; "
                    "\"nonplanar\": \"split\" would cut it into triangles",
                    number_at(build, cut->first), cut->distance, 1e-5 * cut->size);
    Shape shape = shape_of(build->corner_points, count);
    return fail(build,
                "the face is not planar: vertex %d is %.6g from its plane, and 1e-5 of the longer diagonal (%.6g) is "
                "allowed; \"nonplanar\": \"split\" would make it two triangles",
                number_at(build, shape.first), shape.distance, 1e-5 * shape.diagonal);
}

static bool fail_crossed(SceneBuild *build, int count)
{
    int first = build->cut.first, second = build->cut.second;
    return fail(build,
                "the face crosses itself: its edges from vertex %d to %d and from %d to %d cross; list its vertices in "
                "order around it",
                number_at(build, first), number_at(build, (first + 1) % count), number_at(build, second),
                number_at(build, (second + 1) % count));
}

static bool leave_out(SceneBuild *build, int place)
{
    build->cut.ring.piece_count = 0;
    if (!build->object.skip)
        return fail(build, "the face has no area: its vertices lie on one line");
    return note(build, NOTE_NO_AREA, place);
}

bool scene_polygon_cut(SceneBuild *build, const int *vertices, int count, int place)
{
    const PolygonCut *cut = &build->cut;
    bool skip = build->object.skip;
    if (!take_corners(build, vertices, count) || (!skip && !check_repeats(build, count)))
        return false;
    int left = drop_repeats(build, count);
    if (left < 3 || (left <= 4 && shape_of(build->corner_points, left).verdict == SHAPE_NO_AREA))
        return leave_out(build, place);
    if (!polygon_cut(&build->cut, build->corner_points, left, build->object.split, build->error))
        return false;
    if (cut->verdict == POLYGON_NO_AREA)
        return leave_out(build, place);
    if (cut->verdict == POLYGON_NOT_PLANAR)
        return fail_not_planar(build, left);
    if (cut->verdict == POLYGON_CROSSED)
        return fail_crossed(build, left);
    if (cut->is_bent && build->object.tell_split && !note(build, NOTE_BENT, place))
        return false;
    bool folds = cut->ring.fold >= 0;
    if (folds && !skip)
        return fail(build, "the face turns back along its own edge at vertex %d", number_at(build, cut->ring.fold));
    return (left == count && !folds) || note(build, folds ? NOTE_FOLDED : NOTE_REPEATED, place);
}
