/* The "transform" of an object: its steps, multiplied into one. */
#include "reader/scene_transform.h"

#include "json/json_read.h"

#include <float.h>

static bool read_scale(const Json *json, const cJSON *item, Vec3 *factors)
{
    double factor = 1;
    if (cJSON_IsArray(item)) {
        if (!json_vec3(json, item, -DBL_MAX, DBL_MAX, factors))
            return false;
    } else if (!cJSON_IsNumber(item)) {
        return json_fail_type(json, item, "a number or a list of three");
    } else {
        json_number(json, item, -DBL_MAX, DBL_MAX, &factor);
        *factors = vec3(factor, factor, factor);
    }
    if (factors->x == 0 || factors->y == 0 || factors->z == 0)
        return json_fail(json, item, "a factor of 0 would flatten the object");
    return true;
}

static bool read_rotate(const Json *json, const cJSON *item, Transform *step)
{
    JsonMember keys[] = {{.name = "axis", .required = true}, {.name = "degrees", .required = true}};
    Vec3 axis;
    double degrees;
    if (!json_members(json, item, keys, JSON_COUNT(keys)) || !json_vec3(json, keys[0].item, -DBL_MAX, DBL_MAX, &axis) ||
        !json_number(json, keys[1].item, -DBL_MAX, DBL_MAX, &degrees))
        return false;
    if (axis.x == 0 && axis.y == 0 && axis.z == 0)
        return json_fail(json, keys[0].item, "the axis has no direction: it is zero");
    *step = transform_rotate(axis, degrees);
    return true;
}

static bool read_step(const Json *json, const cJSON *item, Transform *step)
{
    JsonMember keys[] = {{.name = "scale"}, {.name = "rotate"}, {.name = "translate"}};
    Vec3 v = {0, 0, 0};
    if (!json_members(json, item, keys, JSON_COUNT(keys)))
        return false;
    if ((keys[0].item != NULL) + (keys[1].item != NULL) + (keys[2].item != NULL) != 1)
        return json_fail(json, item, "a step is one of \"scale\", \"rotate\" and \"translate\"");
    if (keys[1].item)
        return read_rotate(json, keys[1].item, step);
    if (keys[0].item) {
        if (!read_scale(json, keys[0].item, &v))
            return false;
        *step = transform_scale(v);
    } else {
        if (!json_vec3(json, keys[2].item, -DBL_MAX, DBL_MAX, &v))
            return false;
        *step = transform_translate(v);
    }
    return true;
}

bool scene_transform_read(const Json *json, const cJSON *item, Transform *transform)
{
    *transform = transform_identity();
    if (!item)
        return true;
    if (!json_list(json, item))
        return false;
    for (const cJSON *child = item->child; child; child = child->next) {
        Transform step;
        if (!read_step(json, child, &step))
            return false;
        *transform = transform_then(*transform, step);
    }
    return true;
}
