/* Tables in markdown. Each says in its head what its figures are; a dash stands for what was not measured. */
#include "bench/bench_report.h"

#include "bench/bench_machine.h"
#include "bench/bench_process_report.h"
#include "trace/skip.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static uint64_t all_rays(const RenderReport *report)
{
    return report->rays.primary + report->rays.shadow + report->rays.reflection;
}

static void print_trace_times(FILE *out, const Bench *bench)
{
    double product = 1;
    int ratios = 0;
    fputs(
        "| scene | faces | ours, ms | fastest to slowest | Embree, ms | Embree / ours | our Mrays/s | outside Embree | "
        "pixels that differ, by more than 1 |\n"
        "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n",
        out);
    for (int i = 0; i < bench->trace_count; i++) {
        const BenchTrace *t = &bench->traces[i];
        fprintf(out, "| %s | %d |", t->scene.name, t->faces);
        bench_cell(out, t->trace_ms);
        fprintf(out, " %.1f to %.1f |", t->fastest_ms, t->slowest_ms);
        bench_cell(out, t->peer_trace_ms);
        bench_cell(out, t->peer_trace_ms / t->trace_ms);
        bench_cell(out, (double)all_rays(&t->report) / t->trace_ms / 1e3);
        if (t->has_peer)
            fprintf(out, " %.0f %% | %lld, %lld |\n", 100 * (1 - t->peer_share), t->differing, t->far_off);
        else
            fputs(" - | - |\n", out);
        product *= t->has_peer ? t->peer_trace_ms / t->trace_ms : 1;
        ratios += t->has_peer;
    }
    if (ratios > 0)
        fprintf(out, "\nThe geometric mean of the ratios is **%.2f**.\n", pow(product, 1.0 / ratios));
}

static void print_kinds(FILE *out, const Bench *bench)
{
    fputs("\n| scene | primary | shadow | reflection | Mrays/s: primary | shadow | reflection | Embree asks for "
          "primary, shadow, reflection "
          "in |\n"
          "| --- | ---: | ---: | ---: | ---: | ---: | ---: | --- |\n",
          out);
    for (int i = 0; i < bench->trace_count; i++) {
        const BenchTrace *t = &bench->traces[i];
        const RayCounts *rays = &t->report.rays;
        fprintf(out, "| %s | %" PRIu64 " | %" PRIu64 " | %" PRIu64 " |", t->scene.name, rays->primary, rays->shadow,
                rays->reflection);
        double mirrored = (double)(rays->reflection + rays->shadow - t->unmirrored_shadow);
        bench_cell(out, (double)rays->primary / t->primary_ms / 1e3);
        bench_cell(out, (double)t->unmirrored_shadow / (t->unmirrored_ms - t->primary_ms) / 1e3);
        bench_cell(out, mirrored / (t->trace_ms - t->unmirrored_ms) / 1e3);
        if (t->has_peer)
            fprintf(out, " %s; %s; %s |\n", t->peer_modes[0], t->peer_modes[1], t->peer_modes[2]);
        else
            fputs(" - |\n", out);
    }
    fputs("\nThe rate of shadow rays comes from the time that the picture takes longer with its lights; that of "
          "reflected rays,\n"
          "their shadow rays included, from the time that it takes longer with its mirrors.\n",
          out);
}

static void print_builds(FILE *out, const Bench *bench)
{
    fputs("\n| scene | faces | our build, ms | Embree's, ms | ours / Embree's | our memory on the device, bytes per "
          "face | Embree's |\n"
          "| --- | ---: | ---: | ---: | ---: | ---: | ---: |\n",
          out);
    for (int i = 0; i < bench->trace_count; i++) {
        const BenchTrace *t = &bench->traces[i];
        fprintf(out, "| %s | %d |", t->scene.name, t->faces);
        bench_cell(out, t->build_ms);
        bench_cell(out, t->peer_build_ms);
        bench_cell(out, t->build_ms / t->peer_build_ms);
        bench_cell(out, (double)t->report.device_bytes / t->faces);
        bench_cell(out, t->peer_bytes / t->faces);
        fputs("\n", out);
    }
}

/* What is left out, scene by scene. */
static void print_skips(FILE *out, const Bench *bench)
{
    fputs("\n| scene | left out | how much of it | with it left out, ms | with it done, ms | done / left out | the "
          "picture |\n"
          "| --- | --- | ---: | ---: | ---: | ---: | --- |\n",
          out);
    for (int i = 0; i < bench->trace_count; i++)
        for (int skip = 0; skip < SKIP_KINDS; skip++) {
            const BenchSkip *s = &bench->traces[i].skips[skip];
            if (s->count == 0)
                continue;
            fprintf(out, "| %s | `%s` | %" PRIu64 " |", bench->traces[i].scene.name, skip_texts[skip].name, s->count);
            bench_cell(out, s->left_ms);
            bench_cell(out, s->done_ms);
            bench_cell(out, s->done_ms / s->left_ms);
            fprintf(out, " %s |\n", s->same ? "the same" : "**differs**");
        }
}

static void print_scaling(FILE *out, const Bench *bench)
{
    fputs("\n| faces of a city | ours, ms | Embree, ms | Embree / ours | our build, ms | Embree's build, ms |\n"
          "| ---: | ---: | ---: | ---: | ---: | ---: |\n",
          out);
    for (int i = 0; i < bench->scaling_count; i++) {
        const BenchTrace *t = &bench->scaling[i];
        fprintf(out, "| %d |", t->faces);
        bench_cell(out, t->trace_ms);
        bench_cell(out, t->peer_trace_ms);
        bench_cell(out, t->peer_trace_ms / t->trace_ms);
        bench_cell(out, t->build_ms);
        bench_cell(out, t->peer_build_ms);
        fputs("\n", out);
    }
}

static BenchProcesses processes_of(const Bench *bench)
{
    return (BenchProcesses){bench->processes, bench->curve, bench->process_count, bench->curve_count};
}

void bench_print_markdown(FILE *out, const void *data)
{
    const Bench *bench = data;
    char processor[128];
    fprintf(out, "Measured by `rectray bench` on %ld cores of an %s; times are medians of %d",
            sysconf(_SC_NPROCESSORS_ONLN), bench_processor(processor, sizeof processor), bench->plan.repeats);
    fputs(bench->trace_count > 0 && bench->traces[0].has_peer ? ", ours and Embree's turn by turn. " : ". ", out);
    fprintf(out, "Other programs wanted %.1f cores before it began.\n\n", bench->load);
    if (bench->trace_count > 0) {
        print_trace_times(out, bench);
        print_kinds(out, bench);
        print_builds(out, bench);
        print_skips(out, bench);
    }
    BenchProcesses processes = processes_of(bench);
    bench_print_processes(out, &processes);
    if (bench->scaling_count > 0)
        print_scaling(out, bench);
}

/* --- Columns for gnuplot --- */

static bool write_columns(const BenchFolder *folder, const char *name, const BenchTrace *traces, int count,
                          Error *error)
{
    BenchPath path = bench_path(folder, "", name);
    FILE *out = fopen(path.text, "w");
    if (!out)
        return error_set(error, ERROR_SYSTEM, "cannot write %s: %s", path.text, strerror(errno));
    fputs("# scene faces ours_ms peer_ms our_build_ms peer_build_ms; -1: not measured\n", out);
    for (int i = 0; i < count; i++) {
        const BenchTrace *t = &traces[i];
        fprintf(out, "%s %d %.4f %.4f %.4f %.4f\n", t->scene.name, t->faces, t->trace_ms,
                t->has_peer ? t->peer_trace_ms : -1, t->build_ms, t->has_peer ? t->peer_build_ms : -1);
    }
    return fclose(out) == 0 || error_set(error, ERROR_SYSTEM, "cannot write %s", path.text);
}

bool bench_write_plot_data(const Bench *bench, Error *error)
{
    const BenchFolder *folder = &bench->plan.folder;
    BenchProcesses processes = processes_of(bench);
    return write_columns(folder, "ladder.dat", bench->traces, bench->trace_count, error) &&
           write_columns(folder, "scaling.dat", bench->scaling, bench->scaling_count, error) &&
           bench_write_process_data(&processes, folder, error);
}
