/* A surface is closed if each of its edges belongs to two faces, or to four where it touches itself, and so on. */
#include "scene/solid.h"

#include "scene/geometry.h"

#include <stdlib.h>
#include <string.h>

/* Larger objects count as open: a hint is not worth more time. Of mixed ones each face takes a look at all others. */
enum { FACES_MOST = 1 << 18, MIXED_MOST = 1000 };

/* --- Edges --- */

typedef struct Edge {
    float ends[2][3];
    bool turned; /* the face lists them the other way round */
} Edge;

static Edge edge_of(const float a[3], const float b[3])
{
    Edge edge;
    for (int axis = 0; axis < 3; axis++) {
        edge.ends[0][axis] = a[axis] + 0.0f; /* makes 0 of -0 */
        edge.ends[1][axis] = b[axis] + 0.0f;
    }
    edge.turned = memcmp(edge.ends[0], edge.ends[1], sizeof edge.ends[0]) > 0;
    if (edge.turned) {
        float first[3];
        memcpy(first, edge.ends[0], sizeof first);
        memcpy(edge.ends[0], edge.ends[1], sizeof first);
        memcpy(edge.ends[1], first, sizeof first);
    }
    return edge;
}

static int compare_edges(const void *a, const void *b)
{
    return memcmp(((const Edge *)a)->ends, ((const Edge *)b)->ends, sizeof((const Edge *)a)->ends);
}

/* The edges of the object, sorted. NULL without memory. */
static Edge *edges_of(const Scene *scene, const Object *object, int *count, Error *error)
{
    Edge *edges = malloc((size_t)object->face_count * 4 * sizeof *edges + 1);
    *count = 0;
    if (!edges)
        error_memory(error, "the edges of an object");
    for (int i = object->first_face; edges && i < object->first_face + object->face_count; i++) {
        const Face *face = &scene->faces[i];
        for (int k = 0; k < face->vertex_count; k++)
            edges[(*count)++] = edge_of(face->vertices[k], face->vertices[(k + 1) % face->vertex_count]);
    }
    if (edges)
        qsort(edges, (size_t)*count, sizeof *edges, compare_edges);
    return edges;
}

/* --- Inside and outside --- */

/* Six times the volume, negative where the normals point inward: of tetrahedra from the origin to each face. */
static double volume_of(const Scene *scene, const Object *object)
{
    double volume = 0;
    for (int i = object->first_face; i < object->first_face + object->face_count; i++) {
        const Face *face = &scene->faces[i];
        Vec3 a = face_vertex(face, 0);
        for (int k = 1; k + 1 < face->vertex_count; k++)
            volume += vec3_dot(a, vec3_cross(face_vertex(face, k), face_vertex(face, k + 1)));
    }
    return volume;
}

static SolidKind kind_of(const Scene *scene, const Object *object, Error *error)
{
    if (object->face_count < 4 || object->face_count > FACES_MOST)
        return SOLID_OPEN;
    for (int i = object->first_face; i < object->first_face + object->face_count; i++)
        if (scene->faces[i].one_sided)
            return SOLID_OPEN;
    int count;
    Edge *edges = edges_of(scene, object, &count, error);
    bool closed = edges != NULL, mixed = false;
    for (int i = 0, next; closed && i < count; i = next) {
        int turned = 0;
        for (next = i; next < count && compare_edges(&edges[i], &edges[next]) == 0; next++)
            turned += edges[next].turned;
        closed = (next - i) % 2 == 0;
        mixed = mixed || 2 * turned != next - i;
    }
    free(edges);
    if (!closed || (mixed && object->face_count > MIXED_MOST))
        return SOLID_OPEN;
    return mixed ? SOLID_MIXED : volume_of(scene, object) > 0 ? SOLID_OUTWARD : SOLID_INWARD;
}

static SolidKind find_kind(Solids *solids, int object)
{
    if (solids->kinds[object] == SOLID_UNKNOWN)
        solids->kinds[object] = (unsigned char)kind_of(solids->scene, &solids->scene->objects[object], solids->error);
    return (SolidKind)solids->kinds[object];
}

/* Is the ray's origin inside, where it leaves out one face? A ray from inside crosses the surface an odd number of
 * times. */
static bool begins_inside(const Scene *scene, const Object *object, Ray ray, int left_out)
{
    bool inside = false;
    for (int i = object->first_face; i < object->first_face + object->face_count; i++)
        if (i != left_out &&
            face_test(&scene->faces[i], &scene->planes[i], ray, HUGE_VAL, false).verdict == FACE_INSIDE)
            inside = !inside;
    return inside;
}

static bool is_in_box(const Box *box, Vec3 point)
{
    for (int axis = 0; axis < 3; axis++)
        if (!(vec3_component(point, axis) > (double)box->low[axis] &&
              vec3_component(point, axis) < (double)box->high[axis]))
            return false;
    return true;
}

bool solid_holds(Solids *solids, int object, Vec3 point)
{
    const Vec3 askew = {0.5377, 0.6131, 0.5789}; /* so that it seldom meets an edge */
    return is_in_box(&solids->boxes[object], point) && find_kind(solids, object) >= SOLID_OUTWARD &&
           begins_inside(solids->scene, &solids->scene->objects[object], (Ray){point, askew}, -1);
}

/* Does the normal of a face of a mixed object point outward? */
static bool points_outward(const Solids *solids, int index)
{
    const Face *face = &solids->scene->faces[index];
    Vec3 middle = vec3_scale(0.5, vec3_add(face_vertex(face, 0), face_vertex(face, 2)));
    if (face->vertex_count == 3)
        middle = vec3_add(vec3_scale(2.0 / 3, middle), vec3_scale(1.0 / 3, face_vertex(face, 1)));
    Ray ray = {middle, solids->scene->planes[index].normal};
    return !begins_inside(solids->scene, &solids->scene->objects[face->object], ray, index);
}

bool solid_hides(Solids *solids, int face)
{
    int object = solids->scene->faces[face].object;
    Vec3 eye = solids->scene->camera.position;
    SolidKind kind = find_kind(solids, object);
    if (kind == SOLID_OPEN || solid_holds(solids, object, eye))
        return false;
    int side = plane_side(&solids->scene->faces[face], &solids->scene->planes[face], eye);
    bool outward = kind == SOLID_MIXED ? points_outward(solids, face) : kind == SOLID_OUTWARD;
    return outward ? side <= 0 : side >= 0;
}

/* --- All objects --- */

bool solids_make(Solids *solids, const Scene *scene, Error *error)
{
    *solids = (Solids){.scene = scene, .error = error};
    size_t count = (size_t)scene->object_count + 1;
    solids->kinds = calloc(count, sizeof *solids->kinds);
    solids->boxes = malloc(count * sizeof *solids->boxes);
    if (!solids->kinds || !solids->boxes)
        return error_memory(error, "the objects of the scene");
    for (int i = 0; i < scene->object_count; i++)
        solids->boxes[i] = box_empty();
    for (int i = 0; i < scene->face_count; i++) {
        Box *box = &solids->boxes[scene->faces[i].object];
        for (int k = 0; k < scene->faces[i].vertex_count; k++)
            for (int axis = 0; axis < 3; axis++) {
                float x = scene->faces[i].vertices[k][axis];
                box->low[axis] = fminf(box->low[axis], x);
                box->high[axis] = fmaxf(box->high[axis], x);
            }
    }
    return true;
}

void solids_free(Solids *solids)
{
    free(solids->kinds);
    free(solids->boxes);
    *solids = (Solids){0};
}
