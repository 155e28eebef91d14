/* Writes a scene around a model. Its middle is looked at from a distance at which the sphere around it fills the
 * picture; y is upwards. */
#include "reader/stage.h"

#include "base/text.h"
#include "reader/scene_json.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* The model alone, as a scene of some picture. */
static const char BARE[] = "{\"camera\": {\"position\": [0, 0, 1], \"look_at\": [0, 0, 0]}, "
                           "\"screen\": {\"columns\": 1, \"rows\": 1}, \"materials\": {\"stage model\": {}}, "
                           "\"objects\": [{\"material\": \"stage model\", \"nonplanar\": \"split\", \"obj\": %s}]}";

static const char STAGE[] =
    "{\n"
    "  \"//\": \"A model on a neutral stage, as rectray makes it; change what you like.\",\n"
    "  \"camera\": { \"position\": [%.9g, %.9g, %.9g], \"look_at\": [%.9g, %.9g, %.9g] },\n"
    "  \"screen\": { \"columns\": 800, \"rows\": 600, \"distance\": 1, \"width\": 0.8 },\n"
    "  \"lights\": [\n"
    "    { \"position\": [%.9g, %.9g, %.9g], \"ambient\": [0.6, 0.6, 0.6], \"diffuse\": [0.8, 0.8, 0.8] },\n"
    "    { \"position\": [%.9g, %.9g, %.9g], \"ambient\": [0.4, 0.4, 0.4], \"diffuse\": [0.35, 0.35, 0.4],"
    " \"specular\": [0, 0, 0] }\n"
    "  ],\n"
    "  \"materials\": {\n"
    "    \"stage model\": { \"ambient\": [0.15, 0.15, 0.15], \"diffuse\": [0.75, 0.72, 0.68] },\n"
    "    \"stage floor\": { \"ambient\": [0.2, 0.2, 0.21], \"diffuse\": [0.5, 0.5, 0.52] }\n"
    "  },\n"
    "  \"objects\": [\n"
    "    { \"name\": %s, \"material\": \"stage model\", \"nonplanar\": \"split\", \"obj\": %s },\n"
    "    { \"name\": \"stage floor\", \"material\": \"stage floor\", \"vertices\": [[%.9g, %.9g, %.9g], [%.9g, %.9g, "
    "%.9g],\n"
    "        [%.9g, %.9g, %.9g], [%.9g, %.9g, %.9g]], \"faces\": [[0, 1, 2, 3]] }\n"
    "  ],\n"
    "  \"shading\": { \"shadow\": \"ambient\", \"viewer\": \"ray\", \"background\": [0.2, 0.21, 0.23] },\n"
    "  \"sampling\": { \"adaptive\": 8 }\n"
    "}\n";

bool stage_is_model(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot && (strcasecmp(dot, ".obj") == 0 || strcasecmp(dot, ".ply") == 0 || strcasecmp(dot, ".stl") == 0);
}

/* A string as JSON writes it; cJSON_free frees it. */
static char *quoted(const char *text)
{
    cJSON *item = cJSON_CreateString(text);
    char *result = item ? cJSON_PrintUnformatted(item) : NULL;
    cJSON_Delete(item);
    return result;
}

/* Around all faces of a scene, in the coordinates of its file. */
static void find_extent(const Scene *scene, Vec3 *low, Vec3 *high)
{
    *low = vec3(HUGE_VAL, HUGE_VAL, HUGE_VAL);
    *high = vec3_negate(*low);
    for (int f = 0; f < scene->face_count; f++)
        for (int k = 0; k < scene->faces[f].vertex_count; k++) {
            const float *v = scene->faces[f].vertices[k];
            Vec3 p = vec3_add(vec3((double)v[0], (double)v[1], (double)v[2]), scene->centre);
            *low = vec3(fmin(low->x, p.x), fmin(low->y, p.y), fmin(low->z, p.z));
            *high = vec3(fmax(high->x, p.x), fmax(high->y, p.y), fmax(high->z, p.z));
        }
}

static bool read_extent(const char *path_text, Vec3 *low, Vec3 *high, Error *error)
{
    size_t size = sizeof BARE + strlen(path_text);
    char *text = malloc(size);
    if (!text)
        return error_memory(error, "a stage");
    Scene scene;
    int length = snprintf(text, size, BARE, path_text);
    bool read = scene_parse(&scene, "stage", text, length, error);
    free(text);
    if (read)
        find_extent(&scene, low, high);
    scene_free(&scene);
    return read;
}

static int print_stage(char *text, size_t size, const char *name, const char *path, Vec3 low, Vec3 high)
{
    Vec3 c = vec3_scale(0.5, vec3_add(low, high));
    double r = vec3_length(vec3_sub(high, low)) / 2, floor = low.y - r / 1000, side = 5 * r;
    Vec3 eye = vec3_add(c, vec3_scale(3.8 * r, vec3(0.62, 0.42, 0.66)));
    Vec3 key = vec3_add(c, vec3_scale(3 * r, vec3(0.2, 1.6, 1.2)));
    Vec3 fill = vec3_add(c, vec3_scale(3 * r, vec3(-1.3, 0.9, 0.6)));
    return snprintf(text, size, STAGE, eye.x, eye.y, eye.z, c.x, c.y, c.z, key.x, key.y, key.z, fill.x, fill.y, fill.z,
                    name, path, c.x - side, floor, c.z + side, c.x + side, floor, c.z + side, c.x + side, floor,
                    c.z - side, c.x - side, floor, c.z - side);
}

char *stage_text(const char *model_path, Error *error)
{
    const char *slash = strrchr(model_path, '/');
    char *path = quoted(model_path), *name = quoted(slash ? slash + 1 : model_path), *text = NULL;
    Vec3 low, high;
    if (!path || !name)
        error_memory(error, "a stage");
    else if (read_extent(path, &low, &high, error)) {
        int length = print_stage(NULL, 0, name, path, low, high);
        text = malloc((size_t)length + 1);
        if (text)
            print_stage(text, (size_t)length + 1, name, path, low, high);
        else
            error_memory(error, "a stage");
    }
    cJSON_free(path);
    cJSON_free(name);
    return text;
}
