/* A device against the reference, kernel by kernel. */
#include "command/device_check.h"

#include "command/device_check_scenes.h"
#include "opencl/backend.h"
#include "reader/scene_json.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What is compiled. */
typedef struct CheckedKernel {
    const char *name;
    Precision precision;
    KernelKind kernel;
    bool adaptive, casts;
} CheckedKernel;

static const CheckedKernel kernels[] = {
    {"packet, float", PRECISION_FLOAT, KERNEL_PACKET, false, false},
    {"packet, double", PRECISION_DOUBLE, KERNEL_PACKET, false, false},
    {"plain, float", PRECISION_FLOAT, KERNEL_PLAIN, false, false},
    {"gpu, float", PRECISION_FLOAT, KERNEL_GPU, false, false},
    {"adaptive, float", PRECISION_FLOAT, KERNEL_PACKET, true, false},
    {"gpu adaptive, float", PRECISION_FLOAT, KERNEL_GPU, true, false},
    {"cast, float", PRECISION_FLOAT, KERNEL_PACKET, false, true},
};

enum { KERNELS = sizeof kernels / sizeof kernels[0], ADAPTIVE_GRID = 4 };

/* A device of its own number, or of no number, and what is asked of it now. */
typedef struct Check {
    int number;
    const CheckedKernel *kernel;
    const Scene *scene;
    AccelKind accel;
    DeviceCheckStep *step;
} Check;

/* --- Pictures --- */

/* Copies bands into a whole picture. */
typedef struct Picture {
    const Scene *scene;
    unsigned char *rgb;
} Picture;

static bool take_band(void *user, int first_row, int rows, const unsigned char *rgb, const RenderReport *so_far,
                      Error *error)
{
    (void)so_far;
    (void)error;
    const Picture *picture = user;
    size_t row = 3 * (size_t)picture->scene->screen.columns;
    memcpy(picture->rgb + (size_t)first_row * row, rgb, (size_t)rows * row);
    return true;
}

/* By how much two pixels differ in the channel that differs most. */
static int pixel_difference(const unsigned char *a, const unsigned char *b)
{
    int most = 0;
    for (int i = 0; i < 3; i++)
        most = abs(a[i] - b[i]) > most ? abs(a[i] - b[i]) : most;
    return most;
}

/* Double gives the reference's bytes. Float may be off by 1 anywhere. */
static void compare_pictures(const Check *check, const unsigned char *expected, const unsigned char *picture)
{
    DeviceCheckStep *step = check->step;
    int allowed = check->kernel->precision == PRECISION_DOUBLE ? 0 : 1;
    step->compared = (long)check->scene->screen.columns * check->scene->screen.rows;
    for (long i = 0; i < step->compared; i++) {
        int difference = pixel_difference(expected + 3 * i, picture + 3 * i);
        step->off += difference > allowed;
        step->most_off = difference > step->most_off ? difference : step->most_off;
    }
}

static RenderSettings settings_of(const Check *check)
{
    return (RenderSettings){.precision = check->kernel->precision,
                            .kernel = check->kernel->kernel,
                            .accel = check->accel,
                            .device = check->number};
}

/* Renders on both and compares; false with what failed on the device, or memory. */
static bool render_both(const Check *check, RenderReport *report, Error *error)
{
    size_t bytes = 3 * (size_t)check->scene->screen.columns * (size_t)check->scene->screen.rows;
    Picture expected = {check->scene, calloc(bytes, 1)}, picture = {check->scene, calloc(bytes, 1)};
    RenderSettings settings = settings_of(check), plain = {.accel = ACCEL_NONE};
    RenderReport unused = {0};
    bool ok = (expected.rgb && picture.rgb) || error_memory(error, "a picture");
    ok = ok &&
         backend_render(BACKEND_REFERENCE, check->scene, &plain, (BandSink){take_band, &expected}, &unused, error) &&
         backend_render(BACKEND_OPENCL, check->scene, &settings, (BandSink){take_band, &picture}, report, error);
    if (ok)
        compare_pictures(check, expected.rgb, picture.rgb);
    free(expected.rgb);
    free(picture.rgb);
    return ok;
}

/* --- Rays --- */

enum { RAYS_ACROSS = 64, RAYS_DOWN = 48, RAYS = RAYS_ACROSS * RAYS_DOWN };

/* A fan of rays from the camera. */
static void make_rays(const Scene *scene, double *rays)
{
    Vec3 eye = scene->camera.position, ahead = vec3_sub(scene->camera.look_at, eye);
    for (int i = 0; i < RAYS; i++, rays += 6) {
        int column = i % RAYS_ACROSS, row = i / RAYS_ACROSS;
        Vec3 aside = vec3((column - 0.5 * RAYS_ACROSS) / 16, (row - 0.5 * RAYS_DOWN) / 16, (i * 7 % 16 - 8) / 8.0);
        Vec3 direction = vec3_add(ahead, aside);
        const double six[] = {eye.x, eye.y, eye.z, direction.x / 64, direction.y / 64, direction.z / 64};
        memcpy(rays, six, sizeof six);
    }
}

static bool cast_with(const Check *check, Backend backend, const double *rays, CastHit *hits, RenderReport *report,
                      Error *error)
{
    BackendCaster caster;
    RenderReport opened = {0};
    RenderSettings settings = settings_of(check);
    bool ok = backend_caster_open(&caster, backend, check->scene, &settings, &opened, error) &&
              backend_cast(&caster, rays, RAYS, hits, report, error);
    backend_caster_close(&caster);
    return ok;
}

static bool is_same_hit(CastHit a, CastHit b)
{
    return a.face == b.face && fabs(a.t - b.t) <= 1e-5 * fabs(a.t);
}

static bool cast_both(const Check *check, RenderReport *report, Error *error)
{
    double *rays = calloc(RAYS, 6 * sizeof *rays);
    CastHit *expected = calloc(RAYS, sizeof *expected), *hits = calloc(RAYS, sizeof *hits);
    RenderReport unused = {0};
    bool ok = (rays && expected && hits) || error_memory(error, "the rays");
    if (ok)
        make_rays(check->scene, rays);
    ok = ok && cast_with(check, BACKEND_REFERENCE, rays, expected, &unused, error) &&
         cast_with(check, BACKEND_OPENCL, rays, hits, report, error);
    check->step->compared = ok ? RAYS : 0;
    for (int i = 0; ok && i < RAYS; i++)
        check->step->off += !is_same_hit(expected[i], hits[i]);
    free(rays);
    free(expected);
    free(hits);
    return ok;
}

/* --- Steps --- */

/* Float may miss an edge: one pixel or ray of a picture as small as these. Double may not. */
static long most_allowed(const CheckedKernel *kernel)
{
    return kernel->precision == PRECISION_DOUBLE ? 0 : 1;
}

static void run_step(const Check *check)
{
    DeviceCheckStep *step = check->step;
    RenderReport report = {0};
    Error error = {0};
    step->ran = check->kernel->casts ? cast_both(check, &report, &error) : render_both(check, &report, &error);
    step->right = step->ran && step->off <= most_allowed(check->kernel);
    if (step->ran) {
        step->compile_ms = report.compile_ms;
        step->trace_ms = report.trace_ms;
    } else {
        snprintf(step->message, sizeof step->message, "%.*s", (int)sizeof step->message - 1, error.text);
    }
}

static bool check_scene(DeviceCheck *check, const DeviceCheckScene *scene, const CheckedKernel *kernel, int number,
                        DeviceCheckListener listener, Error *error)
{
    Scene read;
    if (!scene_parse(&read, scene->name, scene->text, (long)strlen(scene->text), error))
        return false;
    read.adaptive = kernel->adaptive;
    read.grid = kernel->adaptive ? ADAPTIVE_GRID : 1;
    DeviceCheckStep *step = &check->steps[check->count++];
    *step = (DeviceCheckStep){.kernel = kernel->name, .scene = scene->name};
    listener.before(listener.user, step);
    run_step(&(Check){number, kernel, &read, scene->accel, step});
    check->wrong += !step->right;
    listener.after(listener.user, step);
    scene_free(&read);
    return true;
}

bool device_check(DeviceCheck *check, int number, DeviceCheckListener listener, Error *error)
{
    cl_device_id device;
    *check = (DeviceCheck){.count = 0};
    if (!opencl_find_device(number, 0, &device, &check->device, error))
        return false;
    setenv("RECTRAY_CACHE_DIR", "", 1); /* what compiles now is what counts */
    for (int k = 0; k < KERNELS; k++)
        for (const DeviceCheckScene *scene = device_check_scenes; scene->name; scene++)
            if ((kernels[k].precision == PRECISION_FLOAT || check->device.has_double) &&
                !check_scene(check, scene, &kernels[k], number, listener, error))
                return false;
    return true;
}
