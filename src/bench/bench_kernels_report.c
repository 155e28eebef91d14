/* Tables in markdown, and lines with tabs between their columns. */
#include "bench/bench_kernels_report.h"

#include "bench/bench_machine.h"

#include <errno.h>
#include <inttypes.h>
#include <string.h>
#include <unistd.h>

/* --- Markdown --- */

static void print_ratio(FILE *out, const BenchKernels *result, int row)
{
    double ratio = bench_kernels_ratio(result, row);
    if (ratio > 0)
        fprintf(out, " %.*f x row %d |", ratio < 9.995 ? 2 : 0, ratio, result->rows[row].against + 1);
    else
        fputs(" |", out);
}

/* Counts are told in thousands, with a digit after the point below ten thousand. */
static void print_thousands(FILE *out, uint64_t count)
{
    fprintf(out, " %.*f |", count < 10000 ? 1 : 0, (double)count / 1000);
}

static void print_picture(FILE *out, const KernelRow *row)
{
    if (row->differing == 0)
        fputs(" the same |\n", out);
    else
        fprintf(out, " %zu pixel%s, %zu by more than 1 |\n", row->differing,
                row->differing == 1 ? " differs" : "s differ", row->off);
}

static void print_row(FILE *out, const BenchKernels *result, int index)
{
    const KernelRow *row = &result->rows[index];
    fprintf(out, "| %d | %s |", index + 1, row->name);
    if (row->runs == 0) {
        fputs(" left out | | | | |\n", out);
        return;
    }
    fprintf(out, " %.*f |", row->ms < 9.995 ? 2 : row->ms < 99.95 ? 1 : 0, row->ms);
    print_ratio(out, result, index);
    print_thousands(out, row->face_tests);
    print_thousands(out, row->box_tests);
    print_picture(out, row);
}

static void print_scene(FILE *out, const BenchKernels *result)
{
    fprintf(out,
            "\n**%s**: %d faces, %d x %d pixels, %d x %d rays per pixel.\n\n"
            "| | kernel | ms | as fast as | face tests, thousands | box tests, thousands | picture |\n"
            "| ---: | --- | ---: | ---: | ---: | ---: | --- |\n",
            result->scene.name, result->faces, result->scene.columns, result->scene.rows, result->scene.grid,
            result->scene.grid);
    for (int i = 0; i < result->row_count; i++)
        print_row(out, result, i);
}

void bench_kernels_print_markdown(FILE *out, const void *data)
{
    const BenchKernelScenes *kernels = data;
    char processor[128];
    fprintf(out,
            "Measured by `rectray bench kernels` on %ld cores of an %s, kernels in %s; times are medians of %d, the "
            "rows of a scene in turns; what takes over a second is run once. Other programs wanted %.1f cores before "
            "it began.\n",
            sysconf(_SC_NPROCESSORS_ONLN), bench_processor(processor, sizeof processor),
            render_precisions[kernels->plan.settings.precision], kernels->plan.repeats, kernels->load);
    for (int i = 0; i < kernels->count; i++)
        print_scene(out, &kernels->scenes[i]);
}

/* --- Tabs --- */

static void write_row(FILE *out, const BenchKernels *result, int index)
{
    const KernelRow *row = &result->rows[index];
    fprintf(out, "%d\t%s\t%s\t%s\t%s\t%d\t%d\t%d\t", index + 1, row->name, render_backends[row->backend],
            row->backend == BACKEND_OPENCL ? render_kernels[row->kernel] : "", render_accels[row->accel], row->lanes,
            row->tiles, row->runs);
    if (row->runs == 0)
        fputs("\t\t\t\t\t\t\n", out);
    else
        fprintf(out, "%.4f\t%d\t%.4f\t%" PRIu64 "\t%" PRIu64 "\t%zu\t%zu\n", row->ms, row->against + 1,
                bench_kernels_ratio(result, index), row->face_tests, row->box_tests, row->differing, row->off);
}

bool bench_kernels_write_tsv(const BenchKernels *result, const BenchFolder *folder, Error *error)
{
    char name[BENCH_NAME + 16];
    snprintf(name, sizeof name, "kernels-%s.tsv", result->scene.name);
    BenchPath path = bench_path(folder, "", name);
    FILE *out = fopen(path.text, "w");
    if (!out)
        return error_set(error, ERROR_SYSTEM, "cannot write %s: %s", path.text, strerror(errno));
    fputs("row\tname\tbackend\tkernel\taccel\tlanes\ttiles\truns\ttrace_ms\tagainst\tratio\tface_tests\tbox_tests\t"
          "differing\toff_by_more_than_1\n",
          out);
    for (int i = 0; i < result->row_count; i++)
        write_row(out, result, i);
    return fclose(out) == 0 || error_set(error, ERROR_SYSTEM, "cannot write %s", path.text);
}
