/* What a scene can do without. What is left out here is certain for every ray, however it is rounded: sides of planes are
 * exact (geometry.h), and the sides of a box are compared as the numbers that they are. */
#include "trace/skip.h"

#include "scene/survey.h"

#include <stdlib.h>
#include <string.h>

const SkipText skip_texts[SKIPS] = {
    [SKIP_LIGHT_BEHIND] = {"light_behind", "skipped: light behind"},
    [SKIP_LIGHT_AMBIENT] = {"light_ambient", "skipped: ambient light"},
    [SKIP_HIGHLIGHT] = {"highlight", "skipped: no highlight"},
    [SKIP_WEAK_BOUNCE] = {"weak_bounce", "skipped: weak bounce"},
    [SKIP_EMPTY_TILE] = {"empty_tile", "skipped: empty tile"},
    [SKIP_WHOLE_TILE] = {"whole_tile", "skipped: whole tile"},
    [SKIP_BACK_FACE] = {"back_face", "skipped: back face"},
    [SKIP_LIGHT_BLACK] = {"light_black", "skipped: black light"},
    [SKIP_IDLE_FACE] = {"idle_face", "skipped: idle face"},
    [SKIP_MIRRORS] = {"mirrors", "skipped: mirrors"},
    [SKIP_TREE] = {"tree", "skipped: tree"},
};

bool skip_wanted(const RenderSettings *settings, int skip) { return !(settings->no_skip & 1u << skip); }

/* --- Lights and faces --- */

/* Idle faces are looked for in scenes of up to so many: in larger ones the search would cost more than it could save. */
enum { IDLE_FACES_MOST = 10000 };

static bool is_black(Vec3 colour) { return colour.x == 0 && colour.y == 0 && colour.z == 0; }

static bool light_is_black(const Light *light)
{
    return is_black(light->ambient) && is_black(light->diffuse) && is_black(light->specular);
}

/* The lights that have a colour. */
static bool keep_lights(LeanScene *lean, const Scene *scene, Error *error)
{
    lean->lights = malloc(((size_t)scene->light_count + 1) * sizeof *lean->lights);
    if (!lean->lights)
        return error_memory(error, "the lights");
    int kept = 0;
    for (int i = 0; i < scene->light_count; i++)
        if (!light_is_black(&scene->lights[i]))
            lean->lights[kept++] = scene->lights[i];
    lean->scene.lights = lean->lights;
    lean->scene.light_count = kept;
    return true;
}

/* The faces that a ray can hit. */
static bool keep_faces(LeanScene *lean, const Scene *scene, Error *error)
{
    size_t room = (size_t)scene->face_count + 1;
    lean->faces = malloc(room * sizeof *lean->faces);
    lean->planes = malloc(room * sizeof *lean->planes);
    if (!lean->faces || !lean->planes)
        return error_memory(error, "the faces");
    int kept = 0;
    for (int i = 0; i < scene->face_count; i++)
        if (!survey_face_is_idle(scene, i)) {
            lean->faces[kept] = scene->faces[i];
            lean->planes[kept++] = scene->planes[i];
        }
    lean->scene.faces = lean->faces;
    lean->scene.planes = lean->planes;
    lean->scene.face_count = kept;
    return true;
}

bool lean_scene_make(LeanScene *lean, const Scene *scene, const RenderSettings *settings, RenderReport *report, Error *error)
{
    *lean = (LeanScene){.scene = *scene};
    Survey survey;
    if (!survey_materials(&survey, scene, error))
        return false;
    bool reflections = survey.reflections;
    int black = survey.lights_black;
    survey_free(&survey);
    /* No path goes on after its first hit. */
    if (!reflections && !scene->adaptive && skip_wanted(settings, SKIP_MIRRORS)) {
        lean->scene.shading.max_bounces = 0;
        report->skipped[SKIP_MIRRORS] = 1;
    }
    /* Adaptive sampling looks at faces that no ray hits and at shadows of black lights, too: they may make it cast more rays.
     * Under the black rule a path goes on from where a light reaches, be it black. */
    bool black_adds_nothing = !reflections || scene->shading.shadow == SHADOW_AMBIENT;
    if (black > 0 && black_adds_nothing && !scene->adaptive && skip_wanted(settings, SKIP_LIGHT_BLACK)) {
        if (!keep_lights(lean, scene, error))
            return false;
        report->skipped[SKIP_LIGHT_BLACK] = (uint64_t)black;
    }
    if (!reflections && !scene->adaptive && scene->face_count <= IDLE_FACES_MOST && skip_wanted(settings, SKIP_IDLE_FACE)) {
        if (!keep_faces(lean, scene, error))
            return false;
        report->skipped[SKIP_IDLE_FACE] = (uint64_t)(scene->face_count - lean->scene.face_count);
    }
    return true;
}

void lean_scene_free(LeanScene *lean)
{
    free(lean->lights);
    free(lean->faces);
    free(lean->planes);
    *lean = (LeanScene){.lights = NULL};
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

/* The axis that the face is across, if it is a whole side of the extent with its normal outwards: 2 axis for the low side, one
 * more for the high one; -1 if it is none. */
static int side_of(const Extent *e, const Face *face, const Plane *plane)
{
    unsigned corners = 0;
    if (face->vertex_count != 4 || face->front_only)
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
    static const unsigned sides[BOX_FACES] = {0x55, 0xaa, 0x33, 0xcc, 0x0f, 0xf0}; /* the corners with that coordinate */
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

static double largest_coordinate(Vec3 a) { return fmax(fabs(a.x), fmax(fabs(a.y), fabs(a.z))); }

/* sides: gets 1 + side_of each of the six faces. */
static bool is_closed_box(const Scene *scene, int first, unsigned char *sides)
{
    const Face *faces = &scene->faces[first];
    Extent e = extent_of(faces);
    Vec3 eye = scene->camera.position;
    double scale = largest_coordinate(eye);
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

void skip_closed_boxes(const Scene *scene, unsigned char *closed)
{
    unsigned char sides[BOX_FACES];
    for (int i = 0; i + BOX_FACES <= scene->face_count; i++)
        if (is_closed_box(scene, i, sides)) {
            memcpy(closed + i, sides, BOX_FACES);
            i += BOX_FACES - 1;
        }
}
