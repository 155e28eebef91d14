/* Renders scenes on both backends and compares. From stdin it reads lines "PATH LANES ACCEL" (lanes as --lanes takes
 * them, or 0, or "plain", the plain kernel; accel none, bvh or kdtree), and answers each with one line:
 *     equal PIXELS OFF                            the double kernel gives the reference's picture and counts of rays;
 *                                                 OFF pixels of the float kernel's are off by more than 1/255
 *     double COLUMN ROW DIFFERENCE                the worst pixel where the double kernel's picture differs
 *     tree COLUMN ROW DIFFERENCE                  the same of the reference's own picture with a tree
 *     textbook-PRECISION COLUMN ROW DIFFERENCE    the same of both textbook arithmetics, the plain kernel's and the
 *                                                 reference's
 *     rays WHAT EXPECTED FOUND                    the pictures are equal, a count of rays or refined pixels is not; of
 *                                                 the kernel for GPUs, adaptively, against the packet kernel's in float
 *     float PIXELS OFF AWAY COLUMN ROW DIFFERENCE too many pixels are off in float: how many, how many of them are away
 *                                                 from any edge, and the worst (of those, where there are any)
 *     failed MESSAGE                              the scene does not load, or a backend fails
 * All in one process, for starting a device's driver takes longer than a small picture. */
#include "opencl/opencl.h"
#include "reader/scene_json.h"
#include "support/near_edge.h"
#include "trace/reference_render.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SMALL_PICTURE = 10000 }; /* pixels; below, 0.01 % is less than one */

typedef struct Picture {
    int columns, rows;
    unsigned char *rgb;
    RenderReport report;
} Picture;

static bool take_band(void *user, int first_row, int rows, const unsigned char *rgb, const RenderReport *so_far,
                      Error *error)
{
    (void)so_far;
    (void)error;
    Picture *picture = user;
    size_t row_bytes = (size_t)picture->columns * 3;
    memcpy(picture->rgb + (size_t)first_row * row_bytes, rgb, (size_t)rows * row_bytes);
    return true;
}

static bool render(const Scene *scene, Backend backend, RenderSettings settings, Picture *picture, Error *error)
{
    picture->columns = scene->screen.columns;
    picture->rows = scene->screen.rows;
    picture->rgb = calloc((size_t)picture->columns * (size_t)picture->rows, 3);
    if (!picture->rgb)
        return error_memory(error, "a picture");
    BandSink sink = {take_band, picture};
    settings.device = -1;
    return backend == BACKEND_OPENCL ? opencl_render(scene, &settings, sink, &picture->report, error)
                                     : reference_render(scene, &settings, sink, &picture->report, error);
}

/* The largest difference of a pixel's three channels, in steps of 1/255. */
static int pixel_difference(const Picture *a, const Picture *b, int pixel)
{
    int most = 0;
    for (int i = 3 * pixel; i < 3 * pixel + 3; i++)
        most = abs(a->rgb[i] - b->rgb[i]) > most ? abs(a->rgb[i] - b->rgb[i]) : most;
    return most;
}

/* The pixels that are off by more than `allowed`, and the first of the worst ones. */
typedef struct Off {
    int count, worst, difference;
} Off;

static void off_add(Off *off, int pixel, int difference)
{
    off->count++;
    if (difference > off->difference) {
        off->difference = difference;
        off->worst = pixel;
    }
}

static Off compare_pictures(const Picture *expected, const Picture *picture, int allowed)
{
    Off off = {0};
    for (int i = 0; i < expected->columns * expected->rows; i++)
        if (pixel_difference(expected, picture, i) > allowed)
            off_add(&off, i, pixel_difference(expected, picture, i));
    return off;
}

/* Those among them where no edge is near. */
static Off away_from_edges(const Scene *scene, const Picture *expected, const Picture *picture, int allowed)
{
    Off off = {0};
    for (int i = 0; i < expected->columns * expected->rows; i++)
        if (pixel_difference(expected, picture, i) > allowed &&
            !is_near_edge(scene, i % expected->columns, i / expected->columns))
            off_add(&off, i, pixel_difference(expected, picture, i));
    return off;
}

/* Where every face is asked, all other work is done, too, that could be left out, but for what the reference leaves
 * out; then all counts are equal. With a tree, work is left out. */
enum { DOES_ALL = ((1 << SKIP_KINDS) - 1) & ~(1 << SKIP_LIGHT_BEHIND) };

static bool same_counts(const RenderReport *expected, const RenderReport *found, bool all)
{
    const struct {
        const char *what;
        uint64_t expected, found;
    } counts[] = {
        {"primary", expected->rays.primary, found->rays.primary},
        {"refined", expected->refined_pixels, found->refined_pixels},
        {"shadow", expected->rays.shadow, found->rays.shadow},
        {"reflection", expected->rays.reflection, found->rays.reflection},
        {"light-behind", expected->skipped[SKIP_LIGHT_BEHIND], found->skipped[SKIP_LIGHT_BEHIND]},
    };
    size_t count = all ? sizeof counts / sizeof *counts : 2;
    for (size_t i = 0; i < count; i++)
        if (counts[i].expected != counts[i].found) {
            printf("rays %s %" PRIu64 " %" PRIu64 "\n", counts[i].what, counts[i].expected, counts[i].found);
            return false;
        }
    return true;
}

/* Float by tiles as wholes and ray by ray; after a mirror the last bits of a double may differ. */
static bool same_by_whole_tiles(const Picture *apart, const Picture *whole)
{
    Off off = compare_pictures(apart, whole, 1);
    if (off.count > 0)
        printf("whole %d %d %d\n", off.worst % apart->columns, off.worst / apart->columns, off.difference);
    return off.count == 0;
}

/* All pixels and counts, or a line that says what is not equal. */
static bool same_pictures(const Picture *expected, const Picture *picture, const char *which, bool all_counts)
{
    Off off = compare_pictures(expected, picture, 0);
    if (off.count > 0)
        printf("%s %d %d %d\n", which, off.worst % expected->columns, off.worst / expected->columns, off.difference);
    return off.count == 0 && same_counts(&expected->report, &picture->report, all_counts);
}

static void judge_float(const Scene *scene, const Picture *expected, const Picture *in_float)
{
    int columns = expected->columns, pixels = columns * expected->rows;
    Off off = compare_pictures(expected, in_float, 1);
    Off away = away_from_edges(scene, expected, in_float, 1);
    const Off *told = away.count > 0 ? &away : &off;
    if (away.count > 0 || off.count > (pixels < SMALL_PICTURE ? 1 : pixels / SMALL_PICTURE))
        printf("float %d %d %d %d %d %d\n", pixels, off.count, away.count, told->worst % columns, told->worst / columns,
               told->difference);
    else
        printf("equal %d %d\n", pixels, off.count);
}

/* The plain kernel's textbook arithmetic against textbook.c, in both precisions: all pixels and counts are equal. */
static bool same_textbooks(const Scene *scene, Error *error)
{
    static const char *const names[] = {[PRECISION_FLOAT] = "textbook-float", [PRECISION_DOUBLE] = "textbook-double"};
    RenderSettings settings = {.kernel = KERNEL_PLAIN,
                               .arithmetic = ARITHMETIC_TEXTBOOK,
                               .shift = SCENE_SHIFT,
                               .accel = ACCEL_NONE,
                               .threads = 1};
    bool same = true;
    for (int i = PRECISION_FLOAT; same && i <= PRECISION_DOUBLE; i++) {
        Picture expected = {0}, found = {0};
        settings.precision = (Precision)i;
        bool ok = render(scene, BACKEND_REFERENCE, settings, &expected, error) &&
                  render(scene, BACKEND_OPENCL, settings, &found, error);
        if (!ok)
            printf("failed %s\n", error->text);
        same = ok && same_pictures(&expected, &found, names[i], true);
        free(expected.rgb);
        free(found.rgb);
    }
    return same;
}

/* The kernel for GPUs has no double: the kernel that does the same in double and in float. */
static RenderSettings twin_of(RenderSettings settings, bool adaptive)
{
    if (settings.kernel != KERNEL_GPU)
        return settings;
    settings.kernel = adaptive ? KERNEL_PACKET : KERNEL_PLAIN;
    settings.lanes = adaptive ? 1 : 0;
    return settings;
}

static bool compare(const char *path, RenderSettings settings, Error *error)
{
    bool plain = settings.kernel == KERNEL_PLAIN, gpu = settings.kernel == KERNEL_GPU;
    Scene scene;
    Picture expected = {0}, by_tree = {0}, in_double = {0}, in_float = {0}, apart = {0}, packets = {0};
    bool ok = scene_load(&scene, path, error);
    scene.adaptive = scene.adaptive && !plain;
    ok = ok &&
         render(&scene, BACKEND_REFERENCE, (RenderSettings){.accel = ACCEL_NONE, .threads = 1}, &expected, error) &&
         render(&scene, BACKEND_REFERENCE, (RenderSettings){.accel = settings.accel, .threads = 1}, &by_tree, error);
    settings.no_skip = settings.accel == ACCEL_NONE ? DOES_ALL : 0;
    RenderSettings twin = twin_of(settings, scene.adaptive);
    bool by_packets = gpu && scene.adaptive;
    ok = ok && (!by_packets || render(&scene, BACKEND_OPENCL, twin, &packets, error));
    twin.precision = PRECISION_DOUBLE;
    ok = ok && render(&scene, BACKEND_OPENCL, twin, &in_double, error) &&
         render(&scene, BACKEND_OPENCL, settings, &in_float, error);
    bool by_tiles = settings.accel != ACCEL_NONE && settings.lanes > 1; /* else every ray went its own way already */
    settings.no_skip |= 1u << SKIP_WHOLE_TILE;
    ok = ok && (!by_tiles || render(&scene, BACKEND_OPENCL, settings, &apart, error));
    if (ok && same_pictures(&expected, &by_tree, "tree", true) &&
        same_pictures(&expected, &in_double, "double", plain || settings.accel == ACCEL_NONE) &&
        (!by_packets || same_counts(&packets.report, &in_float.report, settings.accel == ACCEL_NONE)) &&
        (!by_tiles || same_by_whole_tiles(&apart, &in_float)) && (!plain || same_textbooks(&scene, error)))
        judge_float(&scene, &expected, &in_float);
    free(expected.rgb);
    free(by_tree.rgb);
    free(in_double.rgb);
    free(in_float.rgb);
    free(apart.rgb);
    free(packets.rgb);
    scene_free(&scene);
    return ok;
}

int main(void)
{
    static char path[4096], lanes[16], accel[16];
    static Error error;
    while (scanf("%4095s %15s %15s", path, lanes, accel) == 3) {
        RenderSettings settings = {.kernel = strcmp(lanes, "plain") == 0 ? KERNEL_PLAIN
                                             : strcmp(lanes, "gpu") == 0 ? KERNEL_GPU
                                                                         : KERNEL_PACKET,
                                   .lanes = (int)strtol(lanes, NULL, 10),
                                   .accel = strcmp(accel, "none") == 0  ? ACCEL_NONE
                                            : strcmp(accel, "bvh") == 0 ? ACCEL_BVH
                                                                        : ACCEL_KDTREE};
        error.kind = ERROR_NONE;
        if (!compare(path, settings, &error)) {
            error.text[strcspn(error.text, "\n")] = '\0';
            printf("failed %s\n", error.text);
        }
        fflush(stdout);
    }
    return 0;
}
