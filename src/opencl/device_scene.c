/* A scene as the kernels want it. Every value is computed in double and rounded once. */
#include "opencl/device_scene.h"

#include "base/array.h"
#include "base/parallel.h"
#include "scene/geometry.h"
#include "trace/adaptive.h"

#include <float.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Fewer faces are packed sooner than threads start; a thread takes so many at a time. */
enum { MIN_PARALLEL = 1 << 14, PIECE = 4096, FEW_REALS = 1 << 16 };

/* The longest path has its place on the device. */
typedef char PathMaxIsTheScenes[PATH_MAX == SCENE_MAX_BOUNCES + 1 ? 1 : -1];

size_t device_reals_bytes(const DeviceReals *reals)
{
    return reals->count * (reals->precision == PRECISION_DOUBLE ? sizeof(double) : sizeof(float));
}

/* OpenCL has no buffer of zero bytes, so that rows of nothing get one value. */
static bool reals_allocate(DeviceReals *reals, size_t rows, size_t row, Precision precision, Error *error)
{
    reals->precision = precision;
    reals->count = rows > 0 ? rows * row : 1;
    reals->data = array_aligned(device_reals_bytes(reals));
    if (reals->data && row * rows <= FEW_REALS) /* rows of many faces are filled whole: their memory is touched once */
        memset(reals->data, 0, device_reals_bytes(reals));
    return reals->data || error_memory(error, "the scene for the device");
}

double device_scene_process_bytes(int face_count)
{
    /* What a driver takes for itself; of a face the share in the tree and in the arrays that lead to it. */
    const double driver = 80e6, tree = 72;
    double packed = sizeof(FaceRecord) + FACE_REALS * sizeof(float) + PLANE_REALS * sizeof(double);
    return driver + face_count * (sizeof(Face) + packed + tree);
}

static void put(DeviceReals *reals, size_t index, double value)
{
    if (reals->precision == PRECISION_DOUBLE)
        ((double *)reals->data)[index] = value;
    else
        ((float *)reals->data)[index] = (float)value;
}

static void put_vec3(DeviceReals *reals, size_t index, Vec3 v)
{
    put(reals, index, v.x);
    put(reals, index + 1, v.y);
    put(reals, index + 2, v.z);
}

/* What put() rounded away: zero in double. */
static Vec3 low_part(const DeviceReals *reals, Vec3 v)
{
    if (reals->precision == PRECISION_DOUBLE)
        return vec3(0, 0, 0);
    return vec3(v.x - (double)(float)v.x, v.y - (double)(float)v.y, v.z - (double)(float)v.z);
}

/* The upper half of a float that is no less than the bound, and so large that no device takes it for zero. */
static uint32_t bound_bits(double bound)
{
    float rounded = (float)(bound * (1 + 4 * (double)FLT_EPSILON) + 0x1p-120);
    uint32_t bits;
    memcpy(&bits, &rounded, sizeof bits);
    return bits / 0x10000 + (bits % 0x10000 > 0);
}

/* fmax without the call, for numbers. */
static double larger(double a, double b)
{
    return a > b ? a : b;
}

/* FACE_BITS; the bounds take in their own rounding. */
static uint32_t face_bits(const Face *face, const Plane *plane, bool closed)
{
    double longest = 0, warp = 0;
    for (int k = 0; k < 4; k++) {
        Vec3 v = face_vertex(face, k), from_first = vec3_sub(v, face_vertex(face, 0));
        longest = larger(longest, vec3_magnitudes(vec3_sub(face_vertex(face, (k + 1) % 4), v)));
        warp = larger(warp, fabs(vec3_dot(plane->normal, from_first)) + 0x1p-48 * vec3_magnitudes(from_first));
    }
    uint32_t even_warp = (bound_bits(warp) + 1) & ~FACE_BACK_INSIDE;
    return bound_bits(longest) << 16 | even_warp | (face->vertex_count == 3 ? FACE_TRIANGLE : 0) |
           (face->one_sided ? FACE_ONE_SIDED
            : closed        ? FACE_BACK_INSIDE
                            : 0);
}

static void put_face(DeviceReals *rows, size_t row, const Face *face, const Plane *plane, bool closed)
{
    for (int k = 0; k < 4; k++)
        for (int axis = 0; axis < 3; axis++)
            put(rows, row + FACE_VERTICES + 4 * (size_t)axis + (size_t)k, (double)face->vertices[k][axis]);
    put_vec3(rows, row + FACE_NORMAL, plane->normal);
    uint32_t bits = face_bits(face, plane, closed);
    put(rows, row + FACE_BITS, 0); /* half of a double stays */
    size_t real_size = rows->precision == PRECISION_DOUBLE ? sizeof(double) : sizeof(float);
    memcpy((char *)rows->data + (row + FACE_BITS) * real_size, &bits, sizeof bits);
}

static void put_plane(DeviceReals *planes, size_t row, const Plane *plane)
{
    bool is_double = planes->precision == PRECISION_DOUBLE;
    put_vec3(planes, row + PLANE_NORMAL, plane->normal);
    put_vec3(planes, row + PLANE_NORMAL_LOW, is_double ? plane->normal_low : low_part(planes, plane->normal));
    /* Two floats hold 48 bits; then rounded up, since it is a bound. */
    put(planes, row + PLANE_ERROR, is_double ? plane->error : (plane->error + 0x1p-47) * (1 + 4 * (double)FLT_EPSILON));
    put(planes, row + PLANE_LENGTH, plane->length);
}

static bool is_flat(const Face *face)
{
    for (int axis = 0; axis < 3; axis++) {
        float at = face->vertices[0][axis];
        if (face->vertices[1][axis] == at && face->vertices[2][axis] == at && face->vertices[3][axis] == at)
            return true;
    }
    return false;
}

/* The normal of the face at place i: from its packed plane where that has all of it. */
static Plane normal_of(const DeviceScene *packed, const Scene *scene, int index, int i)
{
    const double *row = (const double *)packed->planes.data + (size_t)i * PLANE_REALS + PLANE_NORMAL;
    if (packed->planes.precision == PRECISION_DOUBLE)
        return (Plane){.normal = vec3(row[0], row[1], row[2])};
    return (Plane){.normal = scene->planes[index].normal};
}

/* Puts face `index` of the scene, whose plane is packed, at place i. */
static void pack_face(DeviceScene *packed, const Scene *scene, const unsigned char *closed, int index, int i)
{
    const Face *face = &scene->faces[index];
    const Plane plane = normal_of(packed, scene, index, i);
    FaceRecord *record = &packed->faces[i];
    record->material = face->material | (is_flat(face) ? FACE_FLAT : 0);
    record->index = index;
    Box box = face_box(face, &plane);
    for (int axis = 0; axis < 3; axis++) {
        record->box[2 * axis] = box.low[axis];
        record->box[2 * axis + 1] = box.high[axis];
    }
    put_face(&packed->face_rows, (size_t)i * FACE_REALS, face, &plane, closed && closed[index]);
}

static void pack_light(DeviceReals *lights, size_t row, const Light *light)
{
    put_vec3(lights, row + LIGHT_POSITION, light->position);
    put_vec3(lights, row + LIGHT_POSITION_LOW, low_part(lights, light->position));
    put_vec3(lights, row + LIGHT_AMBIENT, light->ambient);
    put_vec3(lights, row + LIGHT_DIFFUSE, light->diffuse);
    put_vec3(lights, row + LIGHT_SPECULAR, light->specular);
}

static void pack_material(DeviceReals *materials, size_t row, const Material *material)
{
    put_vec3(materials, row + MATERIAL_AMBIENT, material->ambient);
    put_vec3(materials, row + MATERIAL_DIFFUSE, material->diffuse);
    put_vec3(materials, row + MATERIAL_SPECULAR, material->specular);
    put(materials, row + MATERIAL_EXPONENT, material->shininess / 4);
    put(materials, row + MATERIAL_REFLECTION, material->reflection);
}

static void put_view(DeviceReals *reals, int column, Vec3 value)
{
    put_vec3(reals, (size_t)column, value);
    put_vec3(reals, (size_t)VIEW_REALS + (size_t)column, low_part(reals, value));
}

/* No primary ray's direction is longer. */
static double longest_direction(const View *view)
{
    double x = view->width / 2, y = view->height / 2;
    return sqrt(vec3_dot(view->forward, view->forward) + x * x + y * y);
}

/* No vertex has larger |x|+|y|+|z|. */
static double farthest_vertex(const Scene *scene)
{
    double farthest = 0;
    for (int i = 0; i < scene->face_count; i++)
        for (int k = 0; k < scene->faces[i].vertex_count; k++)
            farthest = larger(farthest, vec3_magnitudes(face_vertex(&scene->faces[i], k)));
    return farthest;
}

static void pack_view(DeviceReals *reals, const Scene *scene)
{
    View view = view_of(scene);
    put_view(reals, VIEW_EYE, view.eye);
    put_view(reals, VIEW_FORWARD, view.forward);
    put_view(reals, VIEW_RIGHT, view.right);
    put_view(reals, VIEW_UP, view.up);
    put_view(reals, VIEW_WIDTH, vec3(view.width, view.height, 0));
    put_view(reals, VIEW_BACKGROUND, scene->shading.background);
    put_view(reals, VIEW_BRIGHTEST, vec3(adaptive_brightest(scene), 0, 0));
    put(reals, VIEW_LENGTH, longest_direction(&view) * (1 + 4 * (double)FLT_EPSILON));
    put(reals, VIEW_FARTHEST, farthest_vertex(scene) * (1 + 4 * (double)FLT_EPSILON));
}

/* What the threads that pack the faces share. */
typedef struct Packing {
    DeviceScene *packed;
    const Scene *scene;
    const DevicePacking *how;
} Packing;

static int end_of(const Packing *packing, int piece)
{
    int count = packing->scene->face_count, first = piece * PIECE;
    return count - first < PIECE ? count : first + PIECE;
}

static void pack_planes(void *data, int piece, int thread)
{
    const Packing *packing = data;
    const int *order = packing->how->order;
    (void)thread;
    for (int i = piece * PIECE, end = end_of(packing, piece); i < end; i++)
        put_plane(&packing->packed->planes, (size_t)i * PLANE_REALS, &packing->scene->planes[order ? order[i] : i]);
}

static void pack_piece(void *data, int piece, int thread)
{
    const Packing *packing = data;
    const int *order = packing->how->order;
    (void)thread;
    for (int i = piece * PIECE, end = end_of(packing, piece); i < end; i++)
        pack_face(packing->packed, packing->scene, packing->how->closed, order ? order[i] : i, i);
}

/* The planes first: where the rest is made of the packed ones, the scene's are spent before its memory is touched. */
static void pack_faces(Packing *packing)
{
    int count = packing->scene->face_count, pieces = count / PIECE + (count % PIECE > 0);
    int threads = count < MIN_PARALLEL ? 1 : packing->how->threads;
    parallel_for(threads, pieces, pack_planes, packing);
    if (packing->packed->planes.precision == PRECISION_DOUBLE && packing->how->spent.planes)
        packing->how->spent.planes(packing->how->spent.user);
    parallel_for(threads, pieces, pack_piece, packing);
}

bool device_scene_pack(DeviceScene *packed, const Scene *scene, const DevicePacking *how, Error *error)
{
    *packed = (DeviceScene){0};
    size_t faces = (size_t)scene->face_count;
    packed->faces = array_aligned((faces > 0 ? faces : 1) * sizeof *packed->faces);
    if (!packed->faces)
        return error_memory(error, "the faces for the device");
    if (!reals_allocate(&packed->face_rows, faces, FACE_REALS, how->precision, error) ||
        !reals_allocate(&packed->planes, faces, PLANE_REALS, how->wide, error) ||
        !reals_allocate(&packed->materials, (size_t)scene->material_count, MATERIAL_REALS, how->precision, error) ||
        !reals_allocate(&packed->lights, (size_t)scene->light_count, LIGHT_REALS, how->precision, error) ||
        !reals_allocate(&packed->view, 2, VIEW_REALS, how->precision, error))
        return false;

    Packing packing = {packed, scene, how};
    pack_faces(&packing);
    for (int i = 0; i < scene->light_count; i++)
        pack_light(&packed->lights, (size_t)i * LIGHT_REALS, &scene->lights[i]);
    for (int i = 0; i < scene->material_count; i++)
        pack_material(&packed->materials, (size_t)i * MATERIAL_REALS, &scene->materials[i]);
    pack_view(&packed->view, scene);
    return true;
}

void device_scene_free(DeviceScene *packed)
{
    free(packed->faces);
    free(packed->face_rows.data);
    free(packed->planes.data);
    free(packed->materials.data);
    free(packed->lights.data);
    free(packed->view.data);
    *packed = (DeviceScene){0};
}
