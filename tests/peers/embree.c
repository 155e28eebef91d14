/* The peer: our scenes, by our rules, with Embree. It tries Embree's ways of asking for each kind of ray, keeps the
 * fastest, and measures that. One JSON object goes to stdout; with --serve, every line that then comes in on stdin is
 * answered by the milliseconds of one more picture, so that two programs can be measured turn by turn.
 * Usage: embree SCENE [--size COLUMNSxROWS] [--grid N] [--repeats N] [--serve] [-o PICTURE.png] */
#include "base/clock.h"
#include "base/parallel.h"
#include "peer_trace.h"
#include "picture/image.h"
#include "reader/scene_json.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_REPEATS = 1000, TRIES = 2 };

typedef struct Arguments {
    const char *scene, *output;
    int columns, rows, grid, repeats; /* 0: as the scene says */
    bool serve;
} Arguments;

static bool read_arguments(Arguments *arguments, int argc, char **argv)
{
    *arguments = (Arguments){.repeats = 5};
    for (int i = 1; i < argc; i++) {
        bool more = i + 1 < argc;
        if (strcmp(argv[i], "--serve") == 0)
            arguments->serve = true;
        else if (strcmp(argv[i], "--size") == 0 && more) {
            if (sscanf(argv[++i], "%dx%d", &arguments->columns, &arguments->rows) != 2)
                return false;
        } else if (strcmp(argv[i], "--repeats") == 0 && more)
            arguments->repeats = atoi(argv[++i]);
        else if (strcmp(argv[i], "--grid") == 0 && more)
            arguments->grid = atoi(argv[++i]);
        else if (strcmp(argv[i], "-o") == 0 && more)
            arguments->output = argv[++i];
        else if (!arguments->scene && argv[i][0] != '-')
            arguments->scene = argv[i];
        else
            return false;
    }
    return arguments->scene && arguments->repeats >= 0 && arguments->repeats <= MAX_REPEATS;
}

/* --- The fastest modes --- */

typedef struct Trial {
    const PeerScene *peer;
    int threads;
    unsigned char *rgb;
    PeerModes best;
    double best_ms;
} Trial;

static void try_modes(Trial *trial, PeerModes modes)
{
    for (int i = 0; i < TRIES; i++) {
        double ms = peer_trace(trial->peer, modes, trial->threads, false, trial->rgb).trace_ms;
        if (ms < trial->best_ms) {
            trial->best_ms = ms;
            trial->best = modes;
        }
    }
}

/* One kind of ray after the other, the best of the others kept. */
static void find_modes(Trial *trial)
{
    trial->best = (PeerModes){query_modes, query_modes, query_modes, false};
    PeerReport first = peer_trace(trial->peer, trial->best, trial->threads, false, trial->rgb);
    trial->best_ms = first.trace_ms;
    for (const QueryMode *mode = query_modes; mode->name; mode++) {
        PeerModes modes = trial->best;
        modes.primary = mode;
        try_modes(trial, modes);
    }
    for (const QueryMode *mode = query_modes; mode->name && first.rays.shadow > 0; mode++)
        for (int from_light = 0; from_light < 2; from_light++) {
            PeerModes modes = trial->best;
            modes.shadow = mode;
            modes.from_light = from_light;
            try_modes(trial, modes);
        }
    for (const QueryMode *mode = query_modes; mode->name && first.rays.reflection > 0; mode++) {
        PeerModes modes = trial->best;
        modes.reflection = mode;
        try_modes(trial, modes);
    }
}

/* --- Measuring --- */

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median_ms(Trial *trial, int repeats)
{
    static double times[MAX_REPEATS];
    for (int i = 0; i < repeats; i++)
        times[i] = peer_trace(trial->peer, trial->best, trial->threads, false, trial->rgb).trace_ms;
    qsort(times, (size_t)repeats, sizeof *times, by_size);
    return repeats == 0 ? 0 : (times[(repeats - 1) / 2] + times[repeats / 2]) / 2;
}

static void print_report(Trial *trial, int repeats)
{
    const PeerScene *peer = trial->peer;
    PeerReport timed = peer_trace(peer, trial->best, trial->threads, true, trial->rgb);
    printf("{\"peer\": \"Embree %s\", \"faces\": %d, \"threads\": %d, \"build_ms\": %.3f, \"build_bytes\": %lld, ",
           RTC_VERSION_STRING, peer->scene->face_count, trial->threads, peer->build_ms, peer->bytes);
    printf("\"trace_ms\": %.3f, \"repeats\": %d, ", median_ms(trial, repeats), repeats);
    printf("\"rays\": {\"primary\": %" PRIu64 ", \"shadow\": %" PRIu64 ", \"reflection\": %" PRIu64 "}, ",
           timed.rays.primary, timed.rays.shadow, timed.rays.reflection);
    printf("\"modes\": {\"primary\": \"%s\", \"shadow\": \"%s, from the %s\", \"reflection\": \"%s\"}, ",
           trial->best.primary->name, trial->best.shadow->name, trial->best.from_light ? "light" : "point",
           trial->best.reflection->name);
    printf("\"share_inside_embree\": %.3f}\n", timed.query_ms / (timed.trace_ms * trial->threads));
    fflush(stdout);
}

static void serve(Trial *trial)
{
    char line[16];
    while (fgets(line, sizeof line, stdin)) {
        printf("%.4f\n", peer_trace(trial->peer, trial->best, trial->threads, false, trial->rgb).trace_ms);
        fflush(stdout);
    }
}

static bool run(const Arguments *arguments, Scene *scene, PeerScene *peer, Image *image, Error *error)
{
    if (!scene_load(scene, arguments->scene, error))
        return false;
    if (arguments->columns > 0 && arguments->rows > 0) {
        scene->screen.columns = arguments->columns;
        scene->screen.rows = arguments->rows;
    }
    if (arguments->grid > 0)
        scene->grid = arguments->grid;
    if (!peer_scene_build(peer, scene, error))
        return false;
    *image = (Image){scene->screen.columns, scene->screen.rows, NULL};
    image->rgb = calloc((size_t)image->columns * (size_t)image->rows, 3);
    if (!image->rgb)
        return error_memory(error, "the picture");
    Trial trial = {.peer = peer, .threads = parallel_threads(0), .rgb = image->rgb};
    find_modes(&trial);
    print_report(&trial, arguments->serve ? 0 : arguments->repeats);
    if (arguments->serve)
        serve(&trial);
    return !arguments->output || image_write(image, arguments->output, error);
}

int main(int argc, char **argv)
{
    Arguments arguments;
    if (!read_arguments(&arguments, argc, argv)) {
        fprintf(stderr,
                "usage: embree SCENE [--size COLUMNSxROWS] [--grid N] [--repeats N] [--serve] [-o PICTURE.png]\n");
        return ERROR_USAGE;
    }
    Error error = {0};
    Scene scene = {0};
    PeerScene peer = {0};
    Image image = {0};
    if (!run(&arguments, &scene, &peer, &image, &error))
        fprintf(stderr, "%s\n", error.text);
    image_free(&image);
    peer_scene_free(&peer);
    scene_free(&scene);
    return (int)error.kind;
}
