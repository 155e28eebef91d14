/* A scene as the kernels want it. Every value is computed in double and rounded once. */
#include "opencl/device_scene.h"

#include "base/array.h"
#include "scene/geometry.h"
#include "trace/adaptive.h"

#include <float.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { FEW_REALS = 1 << 16 };

/* The longest path has its place on the device. */
typedef char PathMaxIsTheScenes[PATH_MAX == SCENE_MAX_BOUNCES + 1 ? 1 : -1];

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

/* fmax without the call, for numbers. */
static double larger(double a, double b)
{
    return a > b ? a : b;
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
        for (int k = 0; k < 4; k++) {
            const float *v = scene->faces[i].vertices[k];
            farthest = larger(farthest, vec3_magnitudes(vec3((double)v[0], (double)v[1], (double)v[2])));
        }
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

bool device_scene_pack_moving(DeviceScene *packed, const Scene *scene, Precision precision, Error *error)
{
    if (!reals_allocate(&packed->lights, (size_t)scene->light_count, LIGHT_REALS, precision, error) ||
        !reals_allocate(&packed->view, 2, VIEW_REALS, precision, error))
        return false;
    for (int i = 0; i < scene->light_count; i++)
        pack_light(&packed->lights, (size_t)i * LIGHT_REALS, &scene->lights[i]);
    pack_view(&packed->view, scene);
    return true;
}

bool device_scene_pack(DeviceScene *packed, const Scene *scene, const DevicePacking *how, Error *error)
{
    *packed = (DeviceScene){0};
    size_t faces = (size_t)scene->face_count;
    packed->faces.records = array_aligned((faces > 0 ? faces : 1) * sizeof *packed->faces.records);
    if (!packed->faces.records)
        return error_memory(error, "the faces for the device");
    if (!reals_allocate(&packed->faces.rows, faces, FACE_REALS, how->precision, error) ||
        !reals_allocate(&packed->faces.planes, faces, PLANE_REALS, how->wide, error) ||
        !reals_allocate(&packed->materials, (size_t)scene->material_count, MATERIAL_REALS, how->precision, error) ||
        !device_scene_pack_moving(packed, scene, how->precision, error))
        return false;

    device_faces_pack(&packed->faces, scene, how);
    for (int i = 0; i < scene->material_count; i++)
        pack_material(&packed->materials, (size_t)i * MATERIAL_REALS, &scene->materials[i]);
    return true;
}

void device_scene_free(DeviceScene *packed)
{
    free(packed->faces.records);
    free(packed->faces.rows.data);
    free(packed->faces.planes.data);
    free(packed->materials.data);
    free(packed->lights.data);
    free(packed->view.data);
    *packed = (DeviceScene){0};
}
