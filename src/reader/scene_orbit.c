/* The whole camera turns: where it is, what it looks at, and, about another axis than its own "up", that too. */
#include "reader/scene_orbit.h"

#include "reader/scene_track.h"
#include "scene/transform.h"
#include "json/json_read.h"

#include <float.h>
#include <stdio.h>
#include <stdlib.h>

static bool read_vector(const Json *json, const cJSON *item, Vec3 *v)
{
    return json_vec3(json, item, -DBL_MAX, DBL_MAX, v);
}

static bool read_camera(Orbit *orbit, const Json *json)
{
    JsonMember keys[] = {{.name = "position", .required = true}, {.name = "look_at", .required = true}, {.name = "up"}};
    const cJSON *camera = cJSON_GetObjectItemCaseSensitive(json->root, "camera");
    orbit->up = vec3(0, 1, 0);
    if (!camera)
        return json_fail(json, json->root, "the key \"camera\" is missing");
    return json_members(json, camera, keys, JSON_COUNT(keys)) && read_vector(json, keys[0].item, &orbit->position) &&
           read_vector(json, keys[1].item, &orbit->look_at) &&
           (!keys[2].item || read_vector(json, keys[2].item, &orbit->up));
}

bool scene_orbit_read(Orbit *orbit, const Json *json, const cJSON *item)
{
    JsonMember keys[] = {{.name = "centre", .required = true}, {.name = "degrees", .required = true}, {.name = "axis"}};
    if (!read_camera(orbit, json) || !json_members(json, item, keys, JSON_COUNT(keys)) ||
        !read_vector(json, keys[0].item, &orbit->centre) ||
        !json_number(json, keys[1].item, -DBL_MAX, DBL_MAX, &orbit->degrees))
        return false;
    orbit->given = true;
    orbit->axis = orbit->up;
    orbit->turns_up = keys[2].item != NULL;
    if (keys[2].item && !read_vector(json, keys[2].item, &orbit->axis))
        return false;
    return orbit->axis.x != 0 || orbit->axis.y != 0 || orbit->axis.z != 0 ||
           json_fail(json, keys[2].item ? keys[2].item : item, "the axis has no direction: it is zero");
}

static char *put_vector(char *text, const char *path, Vec3 v, Error *error)
{
    char value[128];
    snprintf(value, sizeof value, "[%s, %s, %s]", scene_track_number(v.x).text, scene_track_number(v.y).text,
             scene_track_number(v.z).text);
    return text ? scene_track_put(text, path, value, error) : NULL;
}

char *scene_orbit_apply(const Orbit *orbit, double way, char *text, Error *error)
{
    if (way == 0)
        return text; /* the scene's own camera, without a rounding */
    Transform turn = transform_rotate(orbit->axis, orbit->degrees * way);
    Vec3 position = transform_point(&turn, vec3_sub(orbit->position, orbit->centre));
    Vec3 look_at = transform_point(&turn, vec3_sub(orbit->look_at, orbit->centre));
    text = put_vector(text, "camera.position", vec3_add(position, orbit->centre), error);
    text = put_vector(text, "camera.look_at", vec3_add(look_at, orbit->centre), error);
    return orbit->turns_up ? put_vector(text, "camera.up", transform_point(&turn, orbit->up), error) : text;
}
