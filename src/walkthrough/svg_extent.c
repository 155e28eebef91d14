/* What a drawing must show. */
#include "walkthrough/svg_extent.h"

#include "walkthrough/walkthrough_lines.h"

#define FAR_LIGHT 1.5 /* farther from the path than so many of its sizes, a light is outside the window */

static void include(SvgExtent *extent, Vec3 p)
{
    extent->low = vec3(fmin(extent->low.x, p.x), fmin(extent->low.y, p.y), fmin(extent->low.z, p.z));
    extent->high = vec3(fmax(extent->high.x, p.x), fmax(extent->high.y, p.y), fmax(extent->high.z, p.z));
}

static void measure_line(SvgExtent *extent, Vec3 from, Vec3 to)
{
    include(extent, from);
    include(extent, to);
    for (SvgDirection k = SVG_FROM_ABOVE; k < SVG_DIRECTION_COUNT; k++) {
        SvgPoint a = svg_flatten((SvgProjection){k, false}, from), b = svg_flatten((SvgProjection){k, false}, to);
        extent->lengths[k] += hypot(b.x - a.x, b.y - a.y);
    }
}

/* The path itself; of a ray that leaves the scene the first part. */
static void measure_path(void *user, const WalkthroughLine *line)
{
    Vec3 way = vec3_sub(line->to, line->from);
    if (line->kind == LINE_PRIMARY || line->kind == LINE_REFLECTED)
        measure_line(user, line->from, vec3_add(line->from, vec3_scale(line->leaves ? 0.4 : 1, way)));
}

static void measure_light(void *user, const WalkthroughLine *line)
{
    SvgExtent *extent = user;
    bool shadow = line->kind == LINE_SHADOW || line->kind == LINE_BLOCKED;
    if (shadow && vec3_length(vec3_sub(line->to, line->from)) <= extent->farthest_light)
        measure_line(extent, line->from, line->to);
}

SvgExtent svg_extent_of(const Walkthrough *walk)
{
    Vec3 camera = walkthrough_world(walk->scene, walk->scene->camera.position);
    SvgExtent extent = {.low = camera, .high = camera};
    walkthrough_lines(walk, measure_path, &extent);
    extent.farthest_light = FAR_LIGHT * vec3_length(vec3_sub(extent.high, extent.low));
    walkthrough_lines(walk, measure_light, &extent);
    return extent;
}

SvgDirection svg_extent_least_shown(const SvgExtent *extent)
{
    SvgDirection least = SVG_FROM_FRONT;
    for (SvgDirection k = SVG_FROM_ABOVE; k < SVG_DIRECTION_COUNT; k++)
        if (extent->lengths[k] < extent->lengths[least] * (1 - 1e-9))
            least = k;
    return least;
}
