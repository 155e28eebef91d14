/* Why a ray enters a node of a tree or passes it over. */
#include "walkthrough/walkthrough_node.h"

#include <math.h>

static const char axis_names[] = "xyz";

NodeCrossing node_crossing(Box box, Ray ray)
{
    NodeCrossing crossing = {0, HUGE_VAL, -1, -1};
    for (int axis = 0; axis < 3; axis++) {
        double origin = vec3_component(ray.origin, axis), direction = vec3_component(ray.direction, axis);
        double low = (double)box.low[axis], high = (double)box.high[axis];
        if (direction == 0 && low <= origin && origin <= high)
            continue;
        double to_low = (low - origin) / direction, to_high = (high - origin) / direction;
        double enter = direction == 0 ? HUGE_VAL : fmin(to_low, to_high);
        double leave = direction == 0 ? -HUGE_VAL : fmax(to_low, to_high);
        if (enter > crossing.enter)
            crossing.enter = enter, crossing.enter_axis = axis;
        if (leave < crossing.leave)
            crossing.leave = leave, crossing.leave_axis = axis;
    }
    return crossing;
}

double node_plane_t(const AccelNode *shape, Ray ray)
{
    double direction = vec3_component(ray.direction, shape->axis);
    return direction == 0 ? HUGE_VAL : ((double)shape->split - vec3_component(ray.origin, shape->axis)) / direction;
}

int node_near_child(const AccelNode *shape, Ray ray)
{
    return vec3_component(ray.direction, shape->axis) < 0 ? shape->high : shape->low;
}

static InkText miss_reason(const AccelNode *shape, Ray ray)
{
    NodeCrossing crossing = node_crossing(shape->box, ray);
    if (isinf(crossing.leave))
        return ink_text("missed: runs beside it in %c", axis_names[crossing.leave_axis]);
    if (crossing.enter_axis < 0)
        return ink_text("missed: it is behind the ray's start, leaves %c at t = %s", axis_names[crossing.leave_axis],
                        ink_number(crossing.leave, INK_DIGITS).text);
    return ink_text("missed: leaves %c at t = %s, enters %c at t = %s", axis_names[crossing.leave_axis],
                    ink_number(crossing.leave, INK_DIGITS).text, axis_names[crossing.enter_axis],
                    ink_number(crossing.enter, INK_DIGITS).text);
}

InkText node_reason(const Event *event, Ray ray, bool shadow)
{
    const TraversalNode *visit = &event->as.node.visit;
    InkText enter = ink_number(visit->inside.enter, INK_DIGITS), limit = ink_number(visit->limit, INK_DIGITS);
    switch (visit->verdict) {
    case NODE_MISSED:
        return miss_reason(&event->as.node.shape, ray);
    case NODE_BEYOND:
        return shadow ? ink_text("begins at t = %s, beyond the light", enter.text)
                      : ink_text("begins at t = %s, beyond the nearest hit %s", enter.text, limit.text);
    case NODE_UNNEEDED:
        return ink_text("not needed: a face in the way is found");
    default:
        return ink_text("entered, from t = %s to %s", enter.text, ink_number(visit->inside.leave, INK_DIGITS).text);
    }
}
