/* Geometry 0 holds the two-sided faces and needs no filter; geometry 1 the others, where a filter lets pass what comes
 * from behind. Embree has no such culling in Debian's build. */
#include "peer_scene.h"

#include "base/clock.h"

#include <stdlib.h>
#include <string.h>

/* Embree hands over N rays and hits field by field: a ray's direction is its fields 4 to 6, a hit's normal 0 to 2. */
static void let_pass_from_behind(const struct RTCFilterFunctionNArguments *a)
{
    float sign = ((const QueryContext *)(const void *)a->context)->sign;
    const float *direction = (const float *)a->ray + 4 * a->N, *normal = (const float *)a->hit;
    for (unsigned i = 0; i < a->N; i++) {
        float n_dot_r = normal[i] * direction[i] + normal[a->N + i] * direction[a->N + i] +
                        normal[2 * a->N + i] * direction[2 * a->N + i];
        a->valid[i] = sign * n_dot_r > 0 ? 0 : a->valid[i];
    }
}

static bool count_bytes(void *user, ssize_t bytes, bool post)
{
    (void)post;
    __atomic_fetch_add((long long *)user, (long long)bytes, __ATOMIC_RELAXED);
    return true;
}

/* --- Geometry --- */

static void fill_quads(const Scene *scene, int one_sided, float *vertices, unsigned *quads, int *material_of)
{
    unsigned vertex = 0;
    for (int i = 0; i < scene->face_count; i++) {
        const Face *face = &scene->faces[i];
        if (face->one_sided != one_sided)
            continue;
        memcpy(vertices + (size_t)vertex * 3, face->vertices, sizeof face->vertices);
        for (unsigned k = 0; k < 4; k++)
            *quads++ = vertex + (k == 3 && face->vertex_count == 3 ? 2 : k);
        *material_of++ = face->material;
        vertex += 4;
    }
}

static bool attach_faces(PeerScene *peer, unsigned count, int one_sided, Error *error)
{
    RTCGeometry geometry = rtcNewGeometry(peer->device, RTC_GEOMETRY_TYPE_QUAD);
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
    float *vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                              3 * sizeof *vertices, (size_t)count * 4);
    unsigned *quads =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof *quads, count);
    bool ok = count == 0 || (vertices && quads);
    if (ok)
        fill_quads(peer->scene, one_sided, vertices, quads, peer->material_of + (one_sided ? peer->both_sided : 0));
    if (one_sided) {
        rtcSetGeometryIntersectFilterFunction(geometry, let_pass_from_behind);
        rtcSetGeometryOccludedFilterFunction(geometry, let_pass_from_behind);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(peer->rtc, geometry, (unsigned)one_sided);
    rtcReleaseGeometry(geometry);
    return ok || error_memory(error, "Embree's quads");
}

/* --- Materials --- */

static void material_rows(MaterialTable *m, float **rows[11])
{
    float **all[11] = {&m->ambient[0],  &m->ambient[1], &m->ambient[2],  &m->diffuse[0],
                       &m->diffuse[1],  &m->diffuse[2], &m->specular[0], &m->specular[1],
                       &m->specular[2], &m->exponent,   &m->reflection};
    memcpy(rows, all, sizeof all);
}

static bool fill_materials(PeerScene *peer, Error *error)
{
    const Scene *scene = peer->scene;
    size_t count = (size_t)scene->material_count + 1;
    float **rows[11];
    material_rows(&peer->materials, rows);
    peer->table = calloc(count * 11, sizeof *peer->table);
    peer->materials.shiny = calloc(count, sizeof *peer->materials.shiny);
    if (!peer->table || !peer->materials.shiny)
        return error_memory(error, "materials");
    for (int k = 0; k < 11; k++)
        *rows[k] = peer->table + (size_t)k * count;
    for (int i = 0; i < scene->material_count; i++) {
        const Material *m = &scene->materials[i];
        double values[11] = {m->ambient.x,  m->ambient.y,  m->ambient.z,  m->diffuse.x,     m->diffuse.y, m->diffuse.z,
                             m->specular.x, m->specular.y, m->specular.z, m->shininess / 4, m->reflection};
        for (int k = 0; k < 11; k++)
            (*rows[k])[i] = (float)values[k];
        peer->materials.shiny[i] = m->specular.x > 0 || m->specular.y > 0 || m->specular.z > 0 ? -1 : 0;
        peer->materials.shines |= peer->materials.shiny[i] != 0;
        peer->materials.mirrors |= m->reflection > 0;
    }
    return true;
}

/* --- The whole --- */

static bool commit(PeerScene *peer, unsigned faces, Error *error)
{
    peer->rtc = rtcNewScene(peer->device);
    rtcSetSceneBuildQuality(peer->rtc, RTC_BUILD_QUALITY_HIGH);
    rtcSetSceneFlags(peer->rtc, RTC_SCENE_FLAG_NONE);
    peer->bytes = 0;
    if (!attach_faces(peer, peer->both_sided, 0, error) || !attach_faces(peer, faces - peer->both_sided, 1, error))
        return false;
    double start = clock_ms();
    rtcCommitScene(peer->rtc);
    peer->build_ms = clock_ms() - start;
    if (rtcGetDeviceError(peer->device) != RTC_ERROR_NONE)
        return error_set(error, ERROR_SYSTEM, "Embree could not build the scene");
    return true;
}

/* A first build pays for starting threads, so a short one is done again. */
static bool build(PeerScene *peer, unsigned faces, Error *error)
{
    if (!commit(peer, faces, error))
        return false;
    if (peer->build_ms > 200)
        return true;
    rtcReleaseScene(peer->rtc);
    return commit(peer, faces, error);
}

bool peer_scene_build(PeerScene *peer, const Scene *scene, Error *error)
{
    *peer = (PeerScene){.scene = scene};
    const char *config = getenv("EMBREE_PEER_CONFIG");
    peer->device = rtcNewDevice(config ? config : "frequency_level=simd512");
    if (!peer->device)
        return error_set(error, ERROR_SYSTEM, "Embree does not start: error %d", (int)rtcGetDeviceError(NULL));
    rtcSetDeviceMemoryMonitorFunction(peer->device, count_bytes, &peer->bytes);
    for (int i = 0; i < scene->face_count; i++)
        peer->both_sided += !scene->faces[i].one_sided;
    peer->material_of = malloc(((size_t)scene->face_count + 1) * sizeof *peer->material_of);
    if (!peer->material_of)
        return error_memory(error, "materials of faces");
    return fill_materials(peer, error) && build(peer, (unsigned)scene->face_count, error);
}

void peer_scene_free(PeerScene *peer)
{
    free(peer->material_of);
    free(peer->table);
    free(peer->materials.shiny);
    if (peer->rtc)
        rtcReleaseScene(peer->rtc);
    if (peer->device)
        rtcReleaseDevice(peer->device);
    *peer = (PeerScene){0};
}
