/* What a drawing must show. */
#include "walkthrough/svg_extent.h"

#include "walkthrough/walkthrough_lines.h"

#define CLOSE 0.07     /* closer together than this part of the drawing, two hits are shown larger */
#define LARGE_FACE 1.5 /* a face that would make the drawing so many times as large is not shown whole */
#define FAR_LIGHT 1.5  /* farther from the path than so many of its sizes, a light is outside the window */

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
        SvgPoint a = svg_flatten((SvgProjection){.direction = k}, from);
        SvgPoint b = svg_flatten((SvgProjection){.direction = k}, to);
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

/* The face that a shadow ray meets must be seen where it does. */
static void measure_stop(void *user, const WalkthroughLine *line)
{
    SvgExtent *extent = user;
    if (line->kind == LINE_BLOCKED && vec3_length(vec3_sub(line->stop, line->from)) <= extent->farthest_light)
        include(extent, line->stop);
}

static void measure_light(void *user, const WalkthroughLine *line)
{
    SvgExtent *extent = user;
    bool shadow = line->kind == LINE_SHADOW || line->kind == LINE_BLOCKED;
    if (shadow && vec3_length(vec3_sub(line->to, line->from)) <= extent->farthest_light)
        measure_line(extent, line->from, line->to);
}

/* A face that a ray meets, whole, unless it is too large. */
static void include_face(SvgExtent *extent, const Scene *scene, int index)
{
    const Face *face = &scene->faces[index];
    SvgExtent larger = *extent;
    for (int k = 0; k < face->vertex_count; k++)
        include(&larger, walkthrough_world(scene, face_vertex(face, k)));
    double size = vec3_largest(vec3_sub(extent->high, extent->low));
    if (vec3_largest(vec3_sub(larger.high, larger.low)) <= LARGE_FACE * size)
        *extent = larger;
}

static void include_faces(SvgExtent *extent, const Walkthrough *walk)
{
    WalkthroughPlace place = {0};
    for (long i = 0; i < walk->count; i++) {
        const Event *event = &walk->events[i];
        walkthrough_follow(&place, walk, event);
        if (place.told && event->kind == EVENT_HIT)
            include_face(extent, walk->scene, event->as.hit.face);
        else if (place.told && event->kind == EVENT_LIGHT_END && event->as.light_end.blocker >= 0)
            include_face(extent, walk->scene, event->as.light_end.blocker);
    }
}

SvgExtent svg_extent_of(const Walkthrough *walk)
{
    Vec3 camera = walkthrough_world(walk->scene, walk->scene->camera.position);
    SvgExtent extent = {.low = camera, .high = camera};
    walkthrough_lines(walk, measure_path, &extent);
    extent.farthest_light = FAR_LIGHT * vec3_length(vec3_sub(extent.high, extent.low));
    walkthrough_lines(walk, measure_light, &extent);
    walkthrough_lines(walk, measure_stop, &extent);
    include_faces(&extent, walk);
    return extent;
}

/* The two hits in a row that are closest together. */
typedef struct Closest {
    Vec3 previous, from, to;
    int hits;
    double distance;
} Closest;

static void measure_pair(void *user, const WalkthroughLine *line)
{
    Closest *closest = user;
    if (line->kind != LINE_NORMAL)
        return;
    double distance = vec3_length(vec3_sub(line->from, closest->previous));
    if (closest->hits++ > 0 && distance < closest->distance && distance > 0) {
        closest->distance = distance;
        closest->from = closest->previous;
        closest->to = line->from;
    }
    closest->previous = line->from;
}

bool svg_extent_of_close_hits(const Walkthrough *walk, const SvgExtent *all, SvgExtent *close)
{
    Closest closest = {.distance = HUGE_VAL};
    Vec3 size = vec3_sub(all->high, all->low);
    walkthrough_lines(walk, measure_pair, &closest);
    if (!(closest.distance < CLOSE * vec3_largest(size)))
        return false;
    Vec3 middle = vec3_scale(0.5, vec3_add(closest.from, closest.to));
    double half = closest.distance;
    *close = *all;
    close->low = vec3_sub(middle, vec3(half, half, half));
    close->high = vec3_add(middle, vec3(half, half, half));
    return true;
}

SvgDirection svg_extent_least_shown(const SvgExtent *extent)
{
    SvgDirection least = SVG_FROM_FRONT;
    for (SvgDirection k = SVG_FROM_ABOVE; k < SVG_DIRECTION_COUNT; k++)
        if (extent->lengths[k] < extent->lengths[least] * (1 - 1e-9))
            least = k;
    return least;
}
