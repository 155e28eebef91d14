/* The names of what is left out, and the closed boxes of a scene. They are certain for every ray, however it is
 * rounded: the sides of a box are compared as the numbers that they are. */
#include "trace/skip.h"

#include "base/parallel.h"

#include <string.h>

const SkipText skip_texts[SKIP_KINDS] = {
    [SKIP_LIGHT_BEHIND] = {"light_behind", "skipped: light behind"},
    [SKIP_LIGHT_AMBIENT] = {"light_ambient", "skipped: ambient light"},
    [SKIP_HIGHLIGHT] = {"highlight", "skipped: no highlight"},
    [SKIP_WEAK_BOUNCE] = {"weak_bounce", "skipped: weak bounce"},
    [SKIP_EMPTY_TILE] = {"empty_tile", "skipped: empty tile"},
    [SKIP_WHOLE_TILE] = {"whole_tile", "skipped: whole tile"},
    [SKIP_BACK_FACE] = {"back_face", "skipped: back face"},
    [SKIP_LIGHT_BLACK] = {"light_black", "skipped: black light"},
    [SKIP_UNREACHABLE_FACE] = {"idle_face", "skipped: idle face"},
    /* Buys no time that could be measured; it stays because statistics say by it that nothing reflects. */
    [SKIP_MIRRORS] = {"mirrors", "skipped: mirrors"},
    /* Buys no time that could be measured; it stays because it spares the tree's memory and its building. */
    [SKIP_TREE] = {"tree", "skipped: tree"},
};

bool skip_wanted(const RenderSettings *settings, int skip)
{
    return !(settings->no_skip & 1u << skip);
}

/* --- Closed boxes --- */

enum { BOX_FACES = 6 };

/* Sides of a box that differ by less than this share of the coordinates might be confused by rounding. */
#define LEAST_THICKNESS 0x1p-16

typedef struct Extent {
    float low[3], high[3];
} Extent;

static Extent extent_of(const Face *faces)
{
    Extent e;
    memcpy(e.low, faces[0].vertices[0], sizeof e.low);
    memcpy(e.high, faces[0].vertices[0], sizeof e.high);
    for (int i = 0; i < BOX_FACES; i++)
        for (int k = 0; k < 4; k++)
            for (int axis = 0; axis < 3; axis++) {
                float at = faces[i].vertices[k][axis];
                e.low[axis] = at < e.low[axis] ? at : e.low[axis];
                e.high[axis] = at > e.high[axis] ? at : e.high[axis];
            }
    return e;
}

/* The axis that the face is across, if it is a whole side of the extent with its normal outwards: 2 axis for the low
 * side, one more for the high one; -1 if it is none. */
static int side_of(const Extent *e, const Face *face, const Plane *plane)
{
    unsigned corners = 0;
    if (face->vertex_count != 4 || face->one_sided)
        return -1;
    for (int k = 0; k < 4; k++) {
        unsigned corner = 0;
        for (int axis = 0; axis < 3; axis++) {
            float at = face->vertices[k][axis];
            if (at != e->low[axis] && at != e->high[axis])
                return -1;
            corner |= at == e->high[axis] ? 1u << axis : 0;
        }
        corners |= 1u << corner;
    }
    /* For each side the corners with its coordinate. */
    static const unsigned sides[BOX_FACES] = {0x55, 0xaa, 0x33, 0xcc, 0x0f, 0xf0};
    const double normal[3] = {plane->normal.x, plane->normal.y, plane->normal.z};
    for (int side = 0; side < BOX_FACES; side++)
        if (corners == sides[side])
            return (side % 2 ? normal[side / 2] : -normal[side / 2]) > 0.5 ? side : -1;
    return -1;
}

static bool is_outside(const Extent *e, Vec3 point)
{
    return point.x < (double)e->low[0] || point.x > (double)e->high[0] || point.y < (double)e->low[1] ||
           point.y > (double)e->high[1] || point.z < (double)e->low[2] || point.z > (double)e->high[2];
}

/* sides: gets 1 + side_of each of the six faces. */
static bool is_closed_box(const Scene *scene, int first, unsigned char *sides)
{
    const Face *faces = &scene->faces[first];
    Extent e = extent_of(faces);
    Vec3 eye = scene->camera.position;
    double scale = vec3_largest(eye);
    for (int axis = 0; axis < 3; axis++)
        scale = fmax(scale, fmax(fabs((double)e.low[axis]), fabs((double)e.high[axis])));
    for (int axis = 0; axis < 3; axis++)
        if (!((double)e.high[axis] - (double)e.low[axis] > LEAST_THICKNESS * scale))
            return false;
    unsigned all = 0;
    for (int i = 0; i < BOX_FACES; i++) {
        int side = side_of(&e, &faces[i], &scene->planes[first + i]);
        if (side < 0)
            return false;
        sides[i] = (unsigned char)(1 + side);
        all |= 1u << side;
    }
    if (all != 0x3f || !is_outside(&e, eye))
        return false;
    for (int i = 0; i < scene->light_count; i++)
        if (!is_outside(&e, scene->lights[i].position))
            return false;
    return true;
}

/* Threads search pieces of so many faces. */
enum { PIECE = 2048 * BOX_FACES };

typedef struct Search {
    const Scene *scene;
    unsigned char *closed;
} Search;

/* Marks the boxes that lie within the faces [first, end) and share no face with a box that is marked. */
static void mark_boxes(const Search *search, int first, int end)
{
    static const unsigned char unmarked[BOX_FACES];
    unsigned char sides[BOX_FACES];
    for (int i = first; i + BOX_FACES <= end; i++) {
        unsigned char *closed = search->closed + i;
        if (memcmp(closed, unmarked, BOX_FACES) == 0 && is_closed_box(search->scene, i, sides)) {
            memcpy(closed, sides, BOX_FACES);
            i += BOX_FACES - 1;
        }
    }
}

static void search_piece(void *data, int piece, int thread)
{
    const Search *search = data;
    int first = piece * PIECE, left = search->scene->face_count - first;
    (void)thread;
    mark_boxes(search, first, first + (left < PIECE ? left : PIECE));
}

void skip_closed_boxes(const Scene *scene, unsigned char *closed, int threads)
{
    Search search = {scene, closed};
    int pieces = scene->face_count / PIECE + 1;
    parallel_for(threads, pieces, search_piece, &search);
    for (int piece = 1; piece < pieces; piece++) { /* boxes of which two pieces have a part each */
        int left = scene->face_count - piece * PIECE, after = left < BOX_FACES - 1 ? left : BOX_FACES - 1;
        mark_boxes(&search, piece * PIECE - (BOX_FACES - 1), piece * PIECE + after);
    }
}
