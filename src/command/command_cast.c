/* rectray cast: rays in, one a line, their nearest hits out as CSV. Rays are read, cast and written in batches, so that
 * any number of them passes through, and a device has enough to do at once. */
#include "base/clock.h"
#include "base/words.h"
#include "command/command.h"
#include "command/scene_open.h"
#include "command/stats.h"
#include "opencl/backend.h"
#include "scene/geometry.h"
#include "scene/world_ray.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BATCH = 131072 };

typedef struct Cast {
    const Options *options;
    const Scene *scene;
    BackendCaster caster;
    TextLines lines;
    double *world; /* BATCH rays as they were read: origin and direction, six numbers each */
    double *local; /* the same as they are traced: from the scene's centre, the direction scaled */
    CastHit *hits;
    long long first; /* number of the batch's first ray, from 0 */
    Stats stats;
} Cast;

/* --- Reading --- */

static bool read_ray(const TextLines *lines, char *line, Vec3 centre, double ray[6], Error *error)
{
    int count = 0;
    if (!word_numbers(lines, line, ray, 6, &count, error))
        return false;
    if (count < 6)
        return word_fail(lines, error, "%d numbers where a ray has six: ox oy oz dx dy dz", count);
    if (!world_ray_has_direction(ray))
        return word_fail(lines, error, "the direction is zero");
    if (!world_ray_origin_in_range(ray, centre))
        return word_fail(
            lines, error,
            "the origin is not within %g units of the scene's centre, or a coordinate is not 0 but below %g",
            WORLD_RAY_LARGEST_POSITION, WORLD_RAY_SMALLEST);
    if (!world_ray_direction_in_range(ray))
        return word_fail(lines, error, "a component of the direction is neither 0 nor from %g to %g",
                         WORLD_RAY_SMALLEST, WORLD_RAY_LARGEST_DIRECTION);
    return true;
}

/* Reads up to BATCH rays; their number, or -1 with the error filled. Empty lines are skipped. */
static long read_batch(Cast *cast, Error *error)
{
    long count = 0;
    while (count < BATCH) {
        char *line = text_next_line(&cast->lines, error);
        if (!line)
            return error->kind == ERROR_NONE ? count : -1;
        if (line[strspn(line, " \t\v\f")] == '\0')
            continue;
        if (!read_ray(&cast->lines, line, cast->scene->centre, cast->world + 6 * count, error))
            return -1;
        count++;
    }
    return count;
}

/* --- Casting --- */

static void localise(const Cast *cast, long count)
{
    for (long i = 0; i < count; i++)
        world_ray_localise(cast->world + 6 * i, cast->scene->centre, cast->local + 6 * i);
}

static Vec3 vec3_at(const double *numbers)
{
    return vec3(numbers[0], numbers[1], numbers[2]);
}

/* Adds a batch's report to the whole's, which keeps the last one's names. */
static void add_report(RenderReport *whole, const RenderReport *batch)
{
    RenderReport sum = *batch;
    sum.build_ms += whole->build_ms;
    sum.upload_ms += whole->upload_ms;
    sum.device_ms += whole->device_ms;
    sum.compile_ms += whole->compile_ms;
    sum.trace_ms += whole->trace_ms;
    sum.readback_ms += whole->readback_ms;
    sum.box_tests += whole->box_tests;
    sum.face_tests += whole->face_tests;
    *whole = sum;
}

static bool cast_batch(Cast *cast, long count, Error *error)
{
    RenderReport report = {0};
    localise(cast, count);
    if (!backend_cast(&cast->caster, cast->local, count, cast->hits, &report, error))
        return false;
    add_report(&cast->stats.report, &report);
    cast->stats.report.rays.primary = (uint64_t)(cast->first + count);
    return true;
}

/* --- Writing --- */

/* The face's unit normal on the side that the ray starts from. */
static Vec3 normal_at(const Scene *scene, int face, Vec3 origin)
{
    Vec3 normal = scene->planes[face].normal;
    bool front = plane_side(&scene->faces[face], &scene->planes[face], origin) > 0;
    return front ? normal : vec3_sub(vec3(0, 0, 0), normal); /* a difference, for no one likes to read -0 */
}

static void write_hit(const Cast *cast, long i)
{
    CastHit hit = cast->hits[i];
    long long number = cast->first + i;
    if (hit.face < 0) {
        printf("%lld,-1,,,,,,,\n", number);
        return;
    }
    const double *world = cast->world + 6 * i;
    double local[6], t = world_ray_t(hit.t, world_ray_localise(world, cast->scene->centre, local));
    Vec3 p = vec3_add(vec3_at(world), vec3_scale(t, vec3_at(world + 3)));
    Vec3 n = normal_at(cast->scene, hit.face, vec3_at(cast->local + 6 * i));
    printf("%lld,%d,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", number, cast->scene->faces[hit.face].number, t, p.x,
           p.y, p.z, n.x, n.y, n.z);
}

static bool write_batch(Cast *cast, long count, Error *error)
{
    double start = clock_ms();
    for (long i = 0; i < count && !ferror(stdout); i++)
        write_hit(cast, i);
    if (fflush(stdout) != 0 || ferror(stdout))
        return error_set(error, ERROR_SYSTEM, "cannot write to standard output: %s", strerror(errno));
    cast->first += count;
    cast->stats.encode_ms += clock_ms() - start;
    return true;
}

/* --- The command --- */

static bool cast_all(Cast *cast, Error *error)
{
    printf("ray,face,t,px,py,pz,nx,ny,nz\n");
    for (;;) {
        double start = clock_ms();
        long count = read_batch(cast, error);
        cast->stats.parse_ms += clock_ms() - start;
        if (count <= 0)
            return count == 0;
        if (!cast_batch(cast, count, error) || !write_batch(cast, count, error))
            return false;
    }
}

static bool reads_stdin(const Options *options)
{
    return !options->rays || strcmp(options->rays, "-") == 0;
}

/* Rays may come from a pipe, so this opens more than text_open_lines would. */
static bool open_rays(Cast *cast, Error *error)
{
    const char *path = cast->options->rays;
    bool from_stdin = reads_stdin(cast->options);
    cast->lines = (TextLines){.path = from_stdin ? "standard input" : path};
    cast->lines.file = from_stdin ? stdin : fopen(path, "rb");
    if (!cast->lines.file)
        return text_fail_errno(path, "cannot be opened", error);
    cast->lines.buffer = malloc(TEXT_LINE_MAX + 2);
    cast->world = malloc(6 * sizeof *cast->world * BATCH);
    cast->local = malloc(6 * sizeof *cast->local * BATCH);
    cast->hits = malloc(BATCH * sizeof *cast->hits);
    return cast->lines.buffer && cast->world && cast->local && cast->hits ? true : error_memory(error, "the rays");
}

static void close_rays(Cast *cast)
{
    text_close_lines(&cast->lines);
    free(cast->world);
    free(cast->local);
    free(cast->hits);
}

bool command_cast(const Options *options, Error *error)
{
    double start = clock_ms();
    Scene scene;
    if (strcmp(options->operands[0], "-") == 0 && reads_stdin(options))
        return error_set(error, ERROR_USAGE, "scene and rays cannot both come from standard input; give --rays FILE");
    if (!scene_open(&scene, options, error))
        return false;
    options_note_unused(options);
    Cast cast = {.options = options, .scene = &scene};
    cast.stats = stats_begin(&scene, options->backend, options->settings.precision);
    cast.stats.parse_ms = clock_ms() - start;
    bool done =
        open_rays(&cast, error) &&
        backend_caster_open(&cast.caster, options->backend, &scene, &options->settings, &cast.stats.report, error) &&
        cast_all(&cast, error);
    cast.stats.total_ms = clock_ms() - start;
    if (done) /* stdout holds the hits */
        done = stats_print(stderr, options->stats, &cast.stats, error);
    close_rays(&cast);
    backend_caster_close(&cast.caster);
    scene_free(&scene);
    return done;
}
