/* Camera, screen, lights, materials and rules of a scene file; the objects are read in scene_objects.c or, in bulk, in
 * scene_bulk.c. */
#include "reader/scene_values.h"

#include "reader/scene_objects.h"
#include "json/json_read.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

/* The screen's measures: no smaller, so that a ray's direction keeps away from the smallest doubles, and no larger. */
static const double SMALLEST_LENGTH = 1e-12, LARGEST_LENGTH = 1e12;

static bool read_point(const Json *json, const cJSON *item, Vec3 *point)
{
    return json_vec3(json, item, -DBL_MAX, DBL_MAX, point);
}

static bool read_colour(const Json *json, const cJSON *item, Vec3 *colour)
{
    return !item || json_vec3(json, item, 0, SCENE_MAX_COLOUR, colour);
}

/* A vector of any length to one whose largest component is about 1, by a power of two: the direction stays exact, and
 * its square neither overflows nor vanishes. Zero stays zero. */
static Vec3 tamed(Vec3 a)
{
    return vec3_ldexp(a, -vec3_exponent(a));
}

static bool read_camera(const Json *json, const cJSON *item, Camera *camera)
{
    JsonMember keys[] = {{.name = "position", .required = true}, {.name = "look_at", .required = true}, {.name = "up"}};
    camera->up = vec3(0, 1, 0);
    if (!json_members(json, item, keys, JSON_COUNT(keys)) || !read_point(json, keys[0].item, &camera->position) ||
        !read_point(json, keys[1].item, &camera->look_at) ||
        (keys[2].item && !read_point(json, keys[2].item, &camera->up)))
        return false;
    Vec3 view = vec3_sub(camera->look_at, camera->position);
    if (!vec3_is_finite(view))
        return json_fail(json, item, "\"position\" and \"look_at\" are too far apart");
    view = tamed(view);
    camera->up = tamed(camera->up);
    if (vec3_length(view) == 0)
        return json_fail(json, keys[1].item, "the camera looks at its own position: there is no direction");
    if (vec3_length(camera->up) == 0)
        return json_fail(json, keys[2].item, "\"up\" has no direction: it is zero");
    if (vec3_length(vec3_cross(vec3_unit(view), vec3_unit(camera->up))) < 1e-9)
        return keys[2].item
                   ? json_fail(json, keys[2].item, "\"up\" is parallel to the view; give another direction")
                   : json_fail(json, item, "the view is parallel to \"up\", which is [0, 1, 0] unless given; give one");
    return true;
}

static bool read_screen(const Json *json, const cJSON *item, Screen *screen)
{
    JsonMember keys[] = {
        {.name = "columns", .required = true},
        {.name = "rows", .required = true},
        {.name = "distance"},
        {.name = "width"},
        {.name = "height"},
    };
    *screen = (Screen){.distance = 1, .width = 2, .height = 0};
    double *const lengths[] = {&screen->distance, &screen->width, &screen->height};
    if (!json_members(json, item, keys, JSON_COUNT(keys)) ||
        !json_integer(json, keys[0].item, 1, SCENE_MAX_PIXELS, &screen->columns) ||
        !json_integer(json, keys[1].item, 1, SCENE_MAX_PIXELS, &screen->rows))
        return false;
    for (int i = 0; i < 3; i++)
        if (keys[2 + i].item && !json_number(json, keys[2 + i].item, SMALLEST_LENGTH, LARGEST_LENGTH, lengths[i]))
            return false;
    return true;
}

static bool read_light(const Json *json, const cJSON *item, Light *light)
{
    JsonMember keys[] = {
        {.name = "position", .required = true}, {.name = "ambient"}, {.name = "diffuse"}, {.name = "specular"}};
    light->ambient = light->diffuse = light->specular = vec3(1, 1, 1);
    return json_members(json, item, keys, JSON_COUNT(keys)) && read_point(json, keys[0].item, &light->position) &&
           read_colour(json, keys[1].item, &light->ambient) && read_colour(json, keys[2].item, &light->diffuse) &&
           read_colour(json, keys[3].item, &light->specular);
}

static bool read_lights(const Json *json, const cJSON *list, Scene *scene)
{
    if (!list)
        return true;
    if (!json_list(json, list))
        return false;
    scene->lights = calloc((size_t)cJSON_GetArraySize(list) + 1, sizeof *scene->lights);
    if (!scene->lights)
        return error_memory(json->error, "lights");
    for (const cJSON *child = list->child; child; child = child->next)
        if (!read_light(json, child, &scene->lights[scene->light_count++]))
            return false;
    return true;
}

static bool read_material(const Json *json, const cJSON *item, Material *material)
{
    JsonMember keys[] = {
        {.name = "ambient"}, {.name = "diffuse"}, {.name = "specular"}, {.name = "shininess"}, {.name = "reflection"}};
    *material = (Material){.name = item->string};
    return json_members(json, item, keys, JSON_COUNT(keys)) && read_colour(json, keys[0].item, &material->ambient) &&
           read_colour(json, keys[1].item, &material->diffuse) &&
           read_colour(json, keys[2].item, &material->specular) &&
           (!keys[3].item || json_number(json, keys[3].item, 0, SCENE_MAX_SHININESS, &material->shininess)) &&
           (!keys[4].item || json_number(json, keys[4].item, 0, 1, &material->reflection));
}

static bool read_materials(const Json *json, const cJSON *object, SceneBuild *build)
{
    if (!object)
        return true;
    if (!cJSON_IsObject(object))
        return json_fail_type(json, object, "an object");
    for (const cJSON *child = object->child; child; child = child->next) {
        Material material;
        if (json_is_comment(child)) {
            if (!json_check_comment(json, child))
                return false;
            continue;
        }
        if (!read_material(json, child, &material))
            return false;
        int index = scene_build_material(build, material);
        if (index < 0 || !names_add(&build->materials, build->scene->materials[index].name, index, json->error))
            return false;
    }
    return true;
}

static bool read_shading(const Json *json, const cJSON *item, Shading *shading)
{
    JsonMember keys[] = {{.name = "shadow"}, {.name = "viewer"}, {.name = "max_bounces"}, {.name = "background"}};
    int shadow = SHADOW_BLACK, viewer = VIEWER_CAMERA;
    *shading = (Shading){.max_bounces = 5};
    if (!item)
        return true;
    if (!json_members(json, item, keys, JSON_COUNT(keys)) ||
        (keys[0].item && !json_choice(json, keys[0].item, scene_shadow_rules, 2, &shadow)) ||
        (keys[1].item && !json_choice(json, keys[1].item, scene_viewer_rules, 2, &viewer)) ||
        (keys[2].item && !json_integer(json, keys[2].item, 0, SCENE_MAX_BOUNCES, &shading->max_bounces)) ||
        !read_colour(json, keys[3].item, &shading->background))
        return false;
    shading->shadow = (ShadowRule)shadow;
    shading->viewer = (ViewerRule)viewer;
    return true;
}

static bool read_sampling(const Json *json, const cJSON *item, Scene *scene)
{
    JsonMember keys[] = {{.name = "grid"}, {.name = "adaptive"}};
    scene->grid = 1;
    if (!item)
        return true;
    if (!json_members(json, item, keys, JSON_COUNT(keys)))
        return false;
    const cJSON *grid = keys[0].item, *adaptive = keys[1].item;
    if (grid && adaptive)
        return json_fail(json, adaptive,
                         "\"grid\" and \"adaptive\" exclude each other: every pixel gets the grid, or only "
                         "those that need it");
    scene->adaptive = adaptive != NULL;
    const cJSON *finest = grid ? grid : adaptive;
    return !finest || json_integer(json, finest, 1, SCENE_MAX_GRID, &scene->grid);
}

enum { CAMERA, SCREEN, LIGHTS, MATERIALS, OBJECTS, SHADING, SAMPLING, ANIMATION, SCHEMA, SCENE_KEYS };

/* Gives the reason of scene_build_finish its place. */
static bool fail_finish(const Json *json, const JsonMember *keys, const SceneBuild *build)
{
    if (build->fault)
        return scene_objects_fail_face(json, keys[OBJECTS].item, build);
    if (build->fault_light >= 0)
        return json_fail(json, cJSON_GetArrayItem(keys[LIGHTS].item, build->fault_light), "%s", build->reason);
    return json_fail(json, keys[CAMERA].item, "%s", build->reason);
}

static bool check_schema(const Json *json, const cJSON *item)
{
    return !item || cJSON_IsString(item) || json_fail_type(json, item, "a string");
}

/* bulk NULL: the tree has the objects. */
static bool read_objects(const Json *json, const cJSON *list, const JsonSpan *bulk, SceneBuild *build)
{
    if (bulk)
        return scene_bulk_read(json, *bulk, build);
    return !list || scene_objects_read(json, list, build);
}

static const JsonMember scene_keys[SCENE_KEYS] = {
    [CAMERA] = {.name = "camera", .required = true},
    [SCREEN] = {.name = "screen", .required = true},
    [LIGHTS] = {.name = "lights"},
    [MATERIALS] = {.name = "materials"},
    [OBJECTS] = {.name = "objects"},
    [SHADING] = {.name = "shading"},
    [SAMPLING] = {.name = "sampling"},
    [ANIMATION] = {.name = "animation"}, /* the text is already that of a frame: scene_animation.h */
    [SCHEMA] = {.name = "$schema"},      /* for editors */
};

static bool read_scene(const Json *json, const JsonSpan *bulk, Scene *scene, SceneBuild *build)
{
    JsonMember keys[SCENE_KEYS];
    memcpy(keys, scene_keys, sizeof keys);
    if (!json_members(json, json->root, keys, SCENE_KEYS) || !check_schema(json, keys[SCHEMA].item) ||
        !read_camera(json, keys[CAMERA].item, &scene->camera) ||
        !read_screen(json, keys[SCREEN].item, &scene->screen) || !read_lights(json, keys[LIGHTS].item, scene) ||
        !read_materials(json, keys[MATERIALS].item, build) || !read_objects(json, keys[OBJECTS].item, bulk, build) ||
        !read_shading(json, keys[SHADING].item, &scene->shading) || !read_sampling(json, keys[SAMPLING].item, scene))
        return false;
    return scene_build_finish(build) || (!bulk && fail_finish(json, keys, build));
}

bool scene_values_read(Scene *scene, Json *json, const JsonSpan *objects)
{
    SceneBuild build = {.scene = scene, .error = json->error, .path = json->name};
    bool good = read_scene(json, objects, scene, &build);
    scene_build_free(&build);
    json_free(json);
    if (!good)
        scene_free(scene);
    return good;
}

bool scene_values_move(Scene *scene, Json *json)
{
    JsonMember keys[SCENE_KEYS];
    Scene moved = {.centre = scene->centre};
    SceneBuild build = {.scene = &moved, .error = json->error};
    memcpy(keys, scene_keys, sizeof keys);
    bool good = json_members(json, json->root, keys, SCENE_KEYS) &&
                read_camera(json, keys[CAMERA].item, &moved.camera) && read_lights(json, keys[LIGHTS].item, &moved) &&
                (scene_build_place(&build) || fail_finish(json, keys, &build));
    json_free(json);
    if (good) {
        free(scene->lights);
        scene->camera = moved.camera;
        scene->lights = moved.lights;
        scene->light_count = moved.light_count;
    } else
        scene_free(&moved);
    return good;
}
