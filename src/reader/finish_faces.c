/* Each piece of the faces is finished by one thread, eight faces at a time. What the eight leave in doubt, and faces
 * that are not alike, are looked at one by one with the functions for a single face. */
#include "reader/finish_faces.h"

#include "base/parallel.h"
#include "reader/finish_lost.h"
#include "scene/face_lanes.h"
#include "scene/geometry.h"

#include <stdio.h>
#include <stdlib.h>

/* Fewer faces are finished sooner than threads start; a thread takes so many at a time. */
enum { MIN_PARALLEL = 1 << 14, PIECE = 1 << 13, NONE = -1 };

typedef struct Piece {
    Vec3 low, high; /* of its vertices */
    int fault;      /* its first face that is not valid, or NONE */
    bool lost;      /* some face has lost its area: finish_lost.h */
} Piece;

typedef struct Pieces {
    SceneBuild *build;
    Piece *pieces;
    int count;
} Pieces;

static int end_of(const Pieces *pieces, int piece)
{
    int count = pieces->build->face_count;
    return count - piece * PIECE < PIECE ? count : (piece + 1) * PIECE;
}

/* Which of the face's vertices are its vertices 0 to 3; a triangle's vertex 3 is its vertex 0. as_in_file: before a
 * mirror turned it over. */
static const unsigned char *corners_of(const SceneBuildFace *face, bool as_in_file)
{
    static const unsigned char corners[2][2][4] = {{{0, 1, 2, 0}, {0, 2, 1, 0}}, {{0, 1, 2, 3}, {0, 3, 2, 1}}};
    return corners[face->vertex_count == 4][as_in_file && face->shape == BUILD_SHAPE_UNCHECKED_TURNED];
}

/* Takes up to eight faces from `first` on; the lanes without one repeat the first. False where triangles and
 * quads are mixed. */
static bool gather(const SceneBuild *build, int first, int count, bool as_in_file, FaceLanes *lanes)
{
    lanes->count = build->faces[first].vertex_count;
    for (int l = 0; l < FACE_LANES; l++) {
        const SceneBuildFace *face = &build->faces[first + (l < count ? l : 0)];
        if (face->vertex_count != lanes->count)
            return false;
        const unsigned char *corners = corners_of(face, as_in_file);
        for (int k = 0; k < FACE_VERTICES_MOST; k++) {
            const Vec3 *p = &build->points[face->points[corners[k]]];
            lanes->x[k][l] = p->x;
            lanes->y[k][l] = p->y;
            lanes->z[k][l] = p->z;
        }
    }
    return true;
}

/* --- Shapes and the box --- */

static bool has_good_shape(const SceneBuild *build, const SceneBuildFace *face)
{
    Vec3 points[4];
    for (int k = 0; k < face->vertex_count; k++)
        points[k] = build->points[face->points[corners_of(face, true)[k]]];
    return face->shape == BUILD_SHAPE_CHECKED || shape_of(points, face->vertex_count).verdict == SHAPE_GOOD;
}

/* Grows the box to hold another one, which may be empty. */
static void grow(Piece *piece, Vec3 low, Vec3 high)
{
    piece->low = vec3(fmin(piece->low.x, low.x), fmin(piece->low.y, low.y), fmin(piece->low.z, low.z));
    piece->high = vec3(fmax(piece->high.x, high.x), fmax(piece->high.y, high.y), fmax(piece->high.z, high.z));
}

static bool needs_check(const SceneBuild *build, int first, int count)
{
    bool needs = false;
    for (int i = first; i < first + count; i++)
        needs = needs || build->faces[i].shape != BUILD_SHAPE_CHECKED;
    return needs;
}

static void check_faces(Pieces *pieces, Piece *piece, int first, int count, BoundLanes *bounds)
{
    const SceneBuild *build = pieces->build;
    FaceLanes lanes;
    bool alike = gather(build, first, count, true, &lanes);
    unsigned doubt = 0xFF;
    if (alike) {
        face_lanes_grow(&lanes, bounds);
        doubt = needs_check(build, first, count) ? face_lanes_shapes(&lanes) : 0;
    }
    for (int l = 0; l < count && (doubt || !alike); l++) {
        const SceneBuildFace *face = &build->faces[first + l];
        for (int k = 0; k < face->vertex_count && !alike; k++)
            grow(piece, build->points[face->points[k]], build->points[face->points[k]]);
        if (doubt >> l & 1 && piece->fault == NONE && !has_good_shape(build, face))
            piece->fault = first + l;
    }
}

static void check_piece(void *data, int index, int thread)
{
    Pieces *pieces = data;
    Piece *piece = &pieces->pieces[index];
    BoundLanes bounds;
    (void)thread;
    for (int i = 0; i < 3 * FACE_LANES; i++) {
        bounds.low[i / FACE_LANES][i % FACE_LANES] = HUGE_VAL;
        bounds.high[i / FACE_LANES][i % FACE_LANES] = -HUGE_VAL;
    }
    *piece = (Piece){vec3(HUGE_VAL, HUGE_VAL, HUGE_VAL), vec3(-HUGE_VAL, -HUGE_VAL, -HUGE_VAL), NONE, false};
    for (int i = index * PIECE, end = end_of(pieces, index); i < end; i += FACE_LANES)
        check_faces(pieces, piece, i, end - i < FACE_LANES ? end - i : FACE_LANES, &bounds);
    for (int l = 0; l < FACE_LANES; l++)
        grow(piece, vec3(bounds.low[0][l], bounds.low[1][l], bounds.low[2][l]),
             vec3(bounds.high[0][l], bounds.high[1][l], bounds.high[2][l]));
}

/* --- Rounding and planes --- */

/* Written so that a NaN is out of range, too. */
static bool in_range(Vec3 a)
{
    return fabs(a.x) <= BUILD_MAX_COORDINATE && fabs(a.y) <= BUILD_MAX_COORDINATE && fabs(a.z) <= BUILD_MAX_COORDINATE;
}

static void put_face(const SceneBuildFace *from, Face *face)
{
    face->vertex_count = from->vertex_count;
    face->number = from->number;
    face->object = from->object;
    face->material = from->material;
    face->one_sided = from->one_sided;
}

static Shape shape_as_rounded(const Face *face)
{
    Vec3 rounded[4];
    for (int k = 0; k < 4; k++)
        rounded[k] = face_vertex(face, k);
    return shape_of_rounded(rounded, face->vertex_count);
}

/* One face. Returns why it cannot be; NULL where it can, or where it is lost: then it has no vertices. */
static const char *round_face(const SceneBuild *build, int index)
{
    const SceneBuildFace *from = &build->faces[index];
    Face *face = &build->scene->faces[index];
    put_face(from, face);
    for (int k = 0; k < 4; k++) {
        Vec3 p = vec3_sub(build->points[from->points[corners_of(from, false)[k]]], build->scene->centre);
        if (!in_range(p))
            return "the face reaches more than 1e12 units from the centre of the scene";
        face->vertices[k][0] = (float)p.x;
        face->vertices[k][1] = (float)p.y;
        face->vertices[k][2] = (float)p.z;
    }
    Shape shape = shape_as_rounded(face);
    bool may_be_lost = shape.verdict && finish_lost_may_be(build, index);
    bool repeats = shape.verdict == SHAPE_REPEATED;
    if (may_be_lost && (repeats || shape.verdict == SHAPE_CONCAVE) && face->vertex_count == 4) {
        finish_lost_point(face, repeats ? shape.second : shape.first);
        shape = shape_as_rounded(face);
    }
    if (shape.verdict) {
        face->vertex_count = 0;
        return may_be_lost ? NULL : finish_lost_reason;
    }
    build->scene->planes[index] = face_plane(face);
    return NULL;
}

static void put_lane(const FaceLanes *lanes, const PlaneLanes *planes, int l, Face *face, Plane *plane)
{
    for (int k = 0; k < FACE_VERTICES_MOST; k++) {
        face->vertices[k][0] = (float)lanes->x[k][l];
        face->vertices[k][1] = (float)lanes->y[k][l];
        face->vertices[k][2] = (float)lanes->z[k][l];
    }
    *plane = (Plane){
        .normal = vec3(planes->normal[0][l], planes->normal[1][l], planes->normal[2][l]),
        .normal_low = vec3(planes->normal_low[0][l], planes->normal_low[1][l], planes->normal_low[2][l]),
        .d = planes->d[l],
        .error = planes->error[l],
        .length = planes->length[l],
    };
}

static void round_faces(Pieces *pieces, Piece *piece, int first, int count)
{
    SceneBuild *build = pieces->build;
    FaceLanes lanes;
    PlaneLanes planes;
    unsigned doubt = 0xFF;
    if (gather(build, first, count, false, &lanes)) {
        doubt = face_lanes_round(&lanes, build->scene->centre, BUILD_MAX_COORDINATE);
        doubt |= face_lanes_planes(&lanes, &planes);
    }
    for (int l = 0; l < count && piece->fault == NONE; l++)
        if (doubt >> l & 1) {
            if (round_face(build, first + l))
                piece->fault = first + l;
            piece->lost = piece->lost || build->scene->faces[first + l].vertex_count == 0;
        } else {
            put_face(&build->faces[first + l], &build->scene->faces[first + l]);
            put_lane(&lanes, &planes, l, &build->scene->faces[first + l], &build->scene->planes[first + l]);
        }
}

static void round_piece(void *data, int index, int thread)
{
    Pieces *pieces = data;
    (void)thread;
    for (int i = index * PIECE, end = end_of(pieces, index); i < end; i += FACE_LANES)
        round_faces(pieces, &pieces->pieces[index], i, end - i < FACE_LANES ? end - i : FACE_LANES);
}

/* --- All pieces --- */

/* Does the work on each piece. Without memory the pieces are NULL, and the error is filled. */
static Pieces do_pieces(SceneBuild *build, void (*work)(void *data, int index, int thread))
{
    Pieces pieces = {.build = build, .count = build->face_count / PIECE + (build->face_count % PIECE > 0)};
    pieces.pieces = malloc(((size_t)pieces.count + 1) * sizeof *pieces.pieces);
    if (!pieces.pieces) {
        error_memory(build->error, "faces");
        return pieces;
    }
    for (int i = 0; i < pieces.count; i++)
        pieces.pieces[i] = (Piece){.fault = NONE};
    parallel_for(build->face_count < MIN_PARALLEL ? 1 : 0, pieces.count, work, &pieces);
    return pieces;
}

/* The first face that is not valid, or NONE. */
static int first_fault(const Pieces *pieces)
{
    for (int i = 0; pieces->pieces && i < pieces->count; i++)
        if (pieces->pieces[i].fault != NONE)
            return pieces->pieces[i].fault;
    return NONE;
}

/* Frees the pieces. True where no face is at fault; else the build gets the face. */
static bool judge(SceneBuild *build, Pieces *pieces)
{
    int fault = first_fault(pieces);
    bool made = pieces->pieces != NULL;
    free(pieces->pieces);
    build->fault = fault == NONE ? NULL : &build->faces[fault];
    return made && fault == NONE;
}

bool finish_faces_check(SceneBuild *build, Vec3 *low, Vec3 *high)
{
    Pieces pieces = do_pieces(build, check_piece);
    for (int i = 0; pieces.pieces && i < pieces.count; i++) {
        Piece *all = &pieces.pieces[0];
        grow(all, pieces.pieces[i].low, pieces.pieces[i].high);
        *low = all->low;
        *high = all->high;
    }
    return judge(build, &pieces);
}

bool finish_faces_round(SceneBuild *build)
{
    Pieces pieces = do_pieces(build, round_piece);
    bool lost = false;
    for (int i = 0; pieces.pieces && i < pieces.count; i++)
        lost = lost || pieces.pieces[i].lost;
    bool good = judge(build, &pieces);
    if (build->fault)
        snprintf(build->reason, sizeof build->reason, "%s", round_face(build, (int)(build->fault - build->faces)));
    build->scene->face_count = build->face_count;
    return good && (!lost || finish_lost_drop(build));
}
