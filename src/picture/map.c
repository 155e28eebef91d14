/* Maps. Numbers are found first, for the whole picture, and become colours when their range is known. */
#include "picture/map.h"

#include "base/clock.h"
#include "base/parallel.h"
#include "picture/heat.h"
#include "trace/reference.h"

#include <float.h>
#include <stdlib.h>

#define NOTHING (-1.0) /* the value of a pixel whose ray leaves the scene; all others are >= 0 */

typedef struct Map {
    const Scene *scene;
    const Accel *accel;
    MapKind kind;
    Region region;
    float *values;      /* one per pixel, but for normals and faces */
    unsigned char *rgb; /* at once, for normals and faces */
} Map;

/* --- One pixel --- */

static double cost_of(const Map *map, int column, int row)
{
    RenderReport report = {0};
    double start = clock_ms();
    reference_pixel(&(Tracer){.scene = map->scene, .accel = map->accel, .report = &report}, column, row);
    double ms = clock_ms() - start;
    if (map->kind == MAP_TIME)
        return ms;
    return (double)(map->kind == MAP_TESTS ? report.face_tests + report.box_tests
                                           : report.rays.primary + report.rays.shadow + report.rays.reflection);
}

/* The ray through the pixel's centre, and what it hits. */
static CastHit centre_hit(const Map *map, int column, int row, Ray *ray)
{
    View view = view_of(map->scene);
    RenderReport report = {0};
    view.grid = 1;
    *ray = (Ray){view.eye, view_direction(&view, column, row, 0, 0)};
    return reference_nearest(&(Tracer){.scene = map->scene, .accel = map->accel, .report = &report}, *ray, -1);
}

static void put_colour(unsigned char *rgb, Vec3 c)
{
    rgb[0] = (unsigned char)floor(255 * c.x + 0.5);
    rgb[1] = (unsigned char)floor(255 * c.y + 0.5);
    rgb[2] = (unsigned char)floor(255 * c.z + 0.5);
}

/* Colours that differ for neighbouring numbers, none of them dark:
 * three bytes of a multiplicative hash (Knuth 1997, section 6.4). */
static Vec3 colour_of_number(int number)
{
    uint32_t hash = (uint32_t)number * 2654435769u;
    hash = (hash ^ hash >> 15) * 2246822519u;
    hash ^= hash >> 13;
    return vec3(0.25 + 0.75 * (hash & 255) / 255, 0.25 + 0.75 * (hash >> 8 & 255) / 255,
                0.25 + 0.75 * (hash >> 16 & 255) / 255);
}

/* The pixel of the region that is `at` by its rows. */
static void map_pixel(const Map *map, size_t at)
{
    int column = map->region.column + (int)(at % (size_t)map->region.columns);
    int row = map->region.row + (int)(at / (size_t)map->region.columns);
    if (map->kind == MAP_RAYS || map->kind == MAP_TIME || map->kind == MAP_TESTS) {
        map->values[at] = (float)cost_of(map, column, row);
        return;
    }
    Ray ray;
    CastHit hit = centre_hit(map, column, row, &ray);
    if (map->kind == MAP_DEPTH) {
        map->values[at] = (float)(hit.face < 0 ? NOTHING : hit.t * vec3_length(ray.direction));
    } else if (hit.face >= 0) {
        Vec3 n = map->scene->planes[hit.face].normal;
        if (vec3_dot(n, ray.direction) > 0)
            n = vec3_negate(n);
        put_colour(map->rgb + 3 * at, map->kind == MAP_FACE ? colour_of_number(map->scene->faces[hit.face].number)
                                                            : vec3(0.5 + 0.5 * n.x, 0.5 + 0.5 * n.y, 0.5 + 0.5 * n.z));
    }
}

/* --- All of them --- */

static void map_row(void *data, int row, int thread)
{
    const Map *map = data;
    (void)thread;
    size_t columns = (size_t)map->region.columns, first = (size_t)row * columns;
    for (size_t column = 0; column < columns; column++)
        map_pixel(map, first + column);
}

static MapScale range_of(const float *values, size_t count)
{
    MapScale scale = {HUGE_VAL, 0};
    for (size_t i = 0; i < count; i++)
        if (values[i] >= 0) {
            scale.low = fmin(scale.low, (double)values[i]);
            scale.high = fmax(scale.high, (double)values[i]);
        }
    return scale.low <= scale.high ? scale : (MapScale){0, 0};
}

/* Where a value stands between the lowest (0) and the highest (1), by its logarithm: equal ratios look equal. Beyond
 * them it counts as they do. */
static double place_of(double value, MapScale scale)
{
    if (!(scale.low > 0 && scale.high > scale.low))
        return 0;
    return fmin(fmax(log(fmax(value, DBL_MIN) / scale.low) / log(scale.high / scale.low), 0), 1);
}

/* Rays and time are hot where they are many; depth is grey, and bright where it is near. */
static void colour_value(unsigned char *rgb, MapKind kind, double value, MapScale scale)
{
    double place = place_of(value, scale), near = 1 - 0.85 * place;
    if (kind != MAP_DEPTH)
        heat_colour(place, rgb);
    else if (value >= 0)
        put_colour(rgb, vec3(near, near, near));
}

/* By the given scale, or by the range of the values where there is none. */
static MapScale colour_values(Map *map, size_t count, MapScale given)
{
    MapScale scale = given.high > 0 ? given : range_of(map->values, count);
    for (size_t i = 0; i < count; i++)
        colour_value(map->rgb + 3 * i, map->kind, (double)map->values[i], scale);
    return scale;
}

bool map_has_scale(MapKind kind)
{
    return kind != MAP_NORMAL && kind != MAP_FACE;
}

bool map_draw(Image *image, const Scene *scene, MapKind kind, const RenderSettings *settings, MapScale *scale,
              Error *error)
{
    const Region region = render_region(settings, scene);
    size_t count = (size_t)region.columns * (size_t)region.rows;
    bool colours = !map_has_scale(kind);
    *image = (Image){region.columns, region.rows, calloc(count, 3)};
    Map map = {.scene = scene,
               .kind = kind,
               .region = region,
               .rgb = image->rgb,
               .values = colours ? NULL : calloc(count, sizeof(float))};
    if (!map.rgb || (!colours && !map.values)) {
        free(map.values);
        return error_memory(error, "the map");
    }
    Accel accel;
    bool ok = accel_build(&accel, scene, settings->accel, settings->threads, error);
    if (ok) {
        map.accel = &accel;
        parallel_for(settings->threads, region.rows, map_row, &map);
        *scale = colours ? (MapScale){0, 0} : colour_values(&map, count, *scale);
    }
    accel_free(&accel);
    free(map.values);
    return ok;
}
