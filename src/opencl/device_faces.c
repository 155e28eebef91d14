/* Eight faces at a time, as in scene/face_lanes.c: the loops over the lanes have no branches, so that a compiler makes
 * vector instructions of them. A scene is packed in 23 ns a face, where one face after the other took 67. */
#include "opencl/device_faces.h"

#include "base/parallel.h"
#include "scene/face_lanes.h"

#include <float.h>
#include <limits.h>
#include <stdint.h>
#include <string.h>

/* Fewer faces are packed sooner than threads start; a thread takes so many at a time. */
enum { MIN_PARALLEL = 1 << 14, PIECE = 4096, LANES = FACE_LANES };

/* What the threads share. */
typedef struct Packing {
    DeviceFaces *packed;
    const Scene *scene;
    const DevicePacking *how;
} Packing;

/* The eight faces. */
typedef struct Faces {
    float at[4][3][LANES]; /* vertex, axis */
    double normal[3][LANES];
} Faces;

/* What is computed of them. */
typedef struct Bounds {
    float low[3][LANES], high[3][LANES]; /* face_box */
    uint32_t words[LANES];               /* FACE_BITS without its flags */
    int flat[LANES];
} Bounds;

size_t device_reals_bytes(const DeviceReals *reals)
{
    return reals->count * (reals->precision == PRECISION_DOUBLE ? sizeof(double) : sizeof(float));
}

/* --- In lanes --- */

/* fmax without the call, for numbers. */
static inline double larger(double a, double b)
{
    return a > b ? a : b;
}

/* The upper half of a float that is no less than the bound, and so large that no device takes it for zero. */
static inline uint32_t bound_bits(double bound)
{
    float rounded = (float)(bound * (1 + 4 * (double)FLT_EPSILON) + 0x1p-120);
    uint32_t bits;
    memcpy(&bits, &rounded, sizeof bits);
    return bits / 0x10000 + (bits % 0x10000 > 0);
}

/* The next float upwards (steps: 1) or downwards (-1), of a finite one that is not the last: nextafterf without the
 * call. As whole numbers floats have their own order, the negative ones turned around. */
static inline float next_float(float a, int steps)
{
    int32_t bits;
    memcpy(&bits, &a, sizeof bits);
    bits = bits < 0 ? INT_MIN - bits : bits;
    bits += steps;
    bits = bits < 0 ? INT_MIN - bits : bits;
    memcpy(&a, &bits, sizeof bits);
    return a;
}

static inline Vec3 vertex(const Faces *faces, int k, int l)
{
    return vec3((double)faces->at[k][0][l], (double)faces->at[k][1][l], (double)faces->at[k][2][l]);
}

/* face_box of the vertices alone. A face is flat where its box has no width. */
static inline void bound_vertices(const Faces *restrict faces, Bounds *restrict bounds)
{
    for (int axis = 0; axis < 3; axis++)
        for (int l = 0; l < LANES; l++) {
            float a = faces->at[0][axis][l], b = faces->at[1][axis][l], c = faces->at[2][axis][l];
            float d = faces->at[3][axis][l], low = b < a ? b : a, high = b > a ? b : a;
            low = c < low ? c : low;
            low = d < low ? d : low;
            high = c > high ? c : high;
            high = d > high ? d : high;
            bounds->low[axis][l] = low;
            bounds->high[axis][l] = high;
            bounds->flat[l] = (axis > 0 && bounds->flat[l]) | (low == high);
        }
}

/* Both bounds of FACE_BITS; they take in their own rounding. box_warp: how far face_box takes a vertex to be from the
 * plane. */
static inline void bound_shapes(const Faces *restrict faces, Bounds *restrict bounds, double *restrict box_warp)
{
    double longest[LANES] = {0}, warp[LANES] = {0};
    for (int l = 0; l < LANES; l++)
        box_warp[l] = 0;
    for (int k = 0; k < 4; k++)
        for (int l = 0; l < LANES; l++) {
            const Vec3 normal = vec3(faces->normal[0][l], faces->normal[1][l], faces->normal[2][l]);
            Vec3 v = vertex(faces, k, l), from_first = vec3_sub(v, vertex(faces, 0, l));
            double height = fabs(vec3_dot(normal, from_first)), magnitudes = vec3_magnitudes(from_first);
            longest[l] = larger(longest[l], vec3_magnitudes(vec3_sub(vertex(faces, (k + 1) % 4, l), v)));
            warp[l] = larger(warp[l], height + 0x1p-48 * magnitudes);
            box_warp[l] = larger(box_warp[l], height + 0x1p-50 * magnitudes);
        }
    for (int l = 0; l < LANES; l++)
        bounds->words[l] = bound_bits(longest[l]) << 16 | ((bound_bits(warp[l]) + 1) & ~FACE_BACK_INSIDE);
}

FOR_EVERY_PROCESSOR
static void bound(const Faces *restrict faces, Bounds *restrict bounds)
{
    double box_warp[LANES];
    bound_vertices(faces, bounds);
    bound_shapes(faces, bounds, box_warp);
    for (int axis = 0; axis < 3; axis++)
        for (int l = 0; l < LANES; l++) { /* as face_box: what is flat stays */
            float low = bounds->low[axis][l], high = bounds->high[axis][l];
            float below = next_float((float)((double)low - 256 * box_warp[l]), -1);
            float above = next_float((float)((double)high + 256 * box_warp[l]), 1);
            bounds->low[axis][l] = bounds->flat[l] ? low : below;
            bounds->high[axis][l] = bounds->flat[l] ? high : above;
        }
}

/* --- One face --- */

/* Where the face at place i is in the scene. */
static int index_of(const Packing *packing, int i)
{
    return packing->how->order ? packing->how->order[i] : i;
}

/* In the tree's order the faces lie scattered: what is needed `AHEAD` places later is fetched now. */
enum { AHEAD = 16 };

static inline void fetch(const void *bytes)
{
#ifdef __GNUC__
    __builtin_prefetch(bytes);
#else
    (void)bytes;
#endif
}

/* Its normal: from its packed plane where that has all of it. */
static Vec3 normal_of(const Packing *packing, int i)
{
    const DeviceReals *planes = &packing->packed->planes;
    const double *row = (const double *)planes->data + (size_t)i * PLANE_REALS + PLANE_NORMAL;
    if (planes->precision == PRECISION_DOUBLE)
        return vec3(row[0], row[1], row[2]);
    return packing->scene->planes[index_of(packing, i)].normal;
}

static void put_record(FaceRecord *record, const Face *face, int index, const Bounds *bounds, int l)
{
    record->material = face->material | (bounds->flat[l] ? FACE_FLAT : 0);
    record->index = index;
    for (int axis = 0; axis < 3; axis++) {
        record->box[2 * axis] = bounds->low[axis][l];
        record->box[2 * axis + 1] = bounds->high[axis][l];
    }
}

static void put_float_row(float *row, const Face *face, Vec3 normal, uint32_t bits)
{
    for (int k = 0; k < 4; k++) {
        row[FACE_VERTICES + k] = face->vertices[k][0];
        row[FACE_VERTICES + 4 + k] = face->vertices[k][1];
        row[FACE_VERTICES + 8 + k] = face->vertices[k][2];
    }
    row[FACE_NORMAL] = (float)normal.x;
    row[FACE_NORMAL + 1] = (float)normal.y;
    row[FACE_NORMAL + 2] = (float)normal.z;
    memcpy(&row[FACE_BITS], &bits, sizeof bits);
}

static void put_double_row(double *row, const Face *face, Vec3 normal, uint32_t bits)
{
    for (int k = 0; k < 4; k++)
        for (int axis = 0; axis < 3; axis++)
            row[FACE_VERTICES + 4 * axis + k] = (double)face->vertices[k][axis];
    row[FACE_NORMAL] = normal.x;
    row[FACE_NORMAL + 1] = normal.y;
    row[FACE_NORMAL + 2] = normal.z;
    row[FACE_BITS] = 0; /* the half that is not used */
    memcpy(&row[FACE_BITS], &bits, sizeof bits);
}

static void put_face(const Packing *packing, int i, const Bounds *bounds, int l)
{
    int index = index_of(packing, i);
    const Face *face = &packing->scene->faces[index];
    bool closed = packing->how->closed && packing->how->closed[index];
    uint32_t sides = face->one_sided ? FACE_ONE_SIDED : closed ? FACE_BACK_INSIDE : 0;
    uint32_t bits = bounds->words[l] | (face->vertex_count == 3 ? FACE_TRIANGLE : 0) | sides;
    DeviceReals *rows = &packing->packed->rows;
    size_t row = (size_t)i * FACE_REALS;
    put_record(&packing->packed->records[i], face, index, bounds, l);
    if (rows->precision == PRECISION_DOUBLE)
        put_double_row((double *)rows->data + row, face, normal_of(packing, i), bits);
    else
        put_float_row((float *)rows->data + row, face, normal_of(packing, i), bits);
}

static void put_wide_plane(double *row, const Plane *plane)
{
    memcpy(row + PLANE_NORMAL, &plane->normal, sizeof plane->normal);
    memcpy(row + PLANE_NORMAL_LOW, &plane->normal_low, sizeof plane->normal_low);
    row[PLANE_ERROR] = plane->error;
    row[PLANE_LENGTH] = plane->length;
}

static void put_float_plane(float *row, const Plane *plane)
{
    const double normal[3] = {plane->normal.x, plane->normal.y, plane->normal.z};
    for (int axis = 0; axis < 3; axis++) {
        row[PLANE_NORMAL + axis] = (float)normal[axis];
        row[PLANE_NORMAL_LOW + axis] = (float)(normal[axis] - (double)row[PLANE_NORMAL + axis]);
    }
    /* Two floats hold 48 bits; then rounded up, since it is a bound. */
    row[PLANE_ERROR] = (float)((plane->error + 0x1p-47) * (1 + 4 * (double)FLT_EPSILON));
    row[PLANE_LENGTH] = (float)plane->length;
}

/* --- All faces --- */

static int end_of(const Packing *packing, int piece)
{
    int count = packing->scene->face_count, first = piece * PIECE;
    return count - first < PIECE ? count : first + PIECE;
}

static void pack_planes(void *data, int piece, int thread)
{
    const Packing *packing = data;
    const DeviceReals *planes = &packing->packed->planes;
    (void)thread;
    for (int i = piece * PIECE, end = end_of(packing, piece); i < end; i++) {
        const Plane *plane = &packing->scene->planes[index_of(packing, i)];
        fetch(&packing->scene->planes[index_of(packing, i + AHEAD < end ? i + AHEAD : i)]);
        if (planes->precision == PRECISION_DOUBLE)
            put_wide_plane((double *)planes->data + (size_t)i * PLANE_REALS, plane);
        else
            put_float_plane((float *)planes->data + (size_t)i * PLANE_REALS, plane);
    }
}

/* Takes up to eight faces from place `first` on; the lanes without one repeat the first. */
static void gather(const Packing *packing, int first, int count, Faces *faces)
{
    for (int l = 0; l < LANES; l++) {
        int i = first + (l < count ? l : 0);
        const Face *face = &packing->scene->faces[index_of(packing, i)];
        Vec3 normal = normal_of(packing, i);
        for (int k = 0; k < 4; k++) {
            faces->at[k][0][l] = face->vertices[k][0];
            faces->at[k][1][l] = face->vertices[k][1];
            faces->at[k][2][l] = face->vertices[k][2];
        }
        faces->normal[0][l] = normal.x;
        faces->normal[1][l] = normal.y;
        faces->normal[2][l] = normal.z;
    }
}

static void pack_piece(void *data, int piece, int thread)
{
    const Packing *packing = data;
    Faces faces;
    Bounds bounds;
    (void)thread;
    for (int i = piece * PIECE, end = end_of(packing, piece); i < end; i += LANES) {
        int count = end - i < LANES ? end - i : LANES;
        for (int k = i + AHEAD; k < i + AHEAD + LANES && k < end; k++)
            fetch(&packing->scene->faces[index_of(packing, k)]);
        gather(packing, i, count, &faces);
        bound(&faces, &bounds);
        for (int l = 0; l < count; l++)
            put_face(packing, i + l, &bounds, l);
    }
}

/* The planes first: where the rest is made of the packed ones, the scene's are spent before its memory is touched. */
void device_faces_pack(DeviceFaces *faces, const Scene *scene, const DevicePacking *how)
{
    Packing packing = {faces, scene, how};
    int count = scene->face_count, pieces = count / PIECE + (count % PIECE > 0);
    int threads = count < MIN_PARALLEL ? 1 : how->threads;
    parallel_for(threads, pieces, pack_planes, &packing);
    if (faces->planes.precision == PRECISION_DOUBLE && how->spent.planes)
        how->spent.planes(how->spent.user);
    parallel_for(threads, pieces, pack_piece, &packing);
}
