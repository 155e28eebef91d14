/* Tables of whole processes: scene by scene, and from few faces to many. */
#include "bench/bench_process_report.h"

#include <errno.h>
#include <math.h>
#include <string.h>

void bench_cell(FILE *out, double value)
{
    if (!(value > 0) || !isfinite(value))
        fputs(" - |", out);
    else
        fprintf(out, " %.*f |", value < 9.995 ? 2 : value < 99.95 ? 1 : 0, value);
}

static void print_processes(FILE *out, const BenchProcesses *measured)
{
    fputs("\n| scene | size | cold, ms | warm, ms | POV-Ray, ms | POV-Ray / warm | peak memory, MiB | bytes a face |\n"
          "| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: |\n",
          out);
    for (int i = 0; i < measured->count; i++) {
        const BenchProcess *p = &measured->list[i];
        fprintf(out, "| %s | %d x %d |", p->scene.name, p->scene.columns, p->scene.rows);
        bench_cell(out, p->cold_wall_ms);
        bench_cell(out, p->warm_wall_ms);
        bench_cell(out, p->povray_wall_ms);
        bench_cell(out, p->povray_wall_ms / p->warm_wall_ms);
        bench_cell(out, p->peak_bytes / 1048576);
        bench_cell(out, p->peak_bytes / p->faces);
        fputs("\n", out);
    }
}

static void print_phases(FILE *out, const char *name, const char *state, const BenchPhases *phases)
{
    fprintf(out, "| %s, %s |", name, state);
    const double values[] = {phases->parse, phases->build,    phases->device, phases->compile, phases->upload,
                             phases->trace, phases->readback, phases->encode, phases->total};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++)
        bench_cell(out, values[i]);
    fputs("\n", out);
}

static void print_all_phases(FILE *out, const BenchProcesses *measured)
{
    fputs("\n| phases, ms | parse | build | device | compile | upload | trace | readback | encode | total |\n"
          "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n",
          out);
    for (int i = 0; i < measured->count; i++) {
        char name[BENCH_NAME + 32];
        const BenchProcess *p = &measured->list[i];
        snprintf(name, sizeof name, "%s %d x %d", p->scene.name, p->scene.columns, p->scene.rows);
        print_phases(out, name, "cold", &p->cold);
        print_phases(out, name, "warm", &p->warm);
    }
}

/* From ten faces to ten millions, with kept kernels. */
static void print_curve(FILE *out, const BenchProcesses *measured)
{
    fputs("\n| faces | parse, ms | build | upload | trace | encode | the process | its peak memory, MiB | bytes a face "
          "|\n"
          "| ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n",
          out);
    for (int i = 0; i < measured->curve_count; i++) {
        const BenchProcess *p = &measured->curve[i];
        const double values[] = {p->warm.parse,  p->warm.build,   p->warm.upload,          p->warm.trace,
                                 p->warm.encode, p->warm_wall_ms, p->peak_bytes / 1048576, p->peak_bytes / p->faces};
        fprintf(out, "| %d |", p->faces);
        for (size_t k = 0; k < sizeof values / sizeof *values; k++)
            bench_cell(out, values[k]);
        fputs("\n", out);
    }
}

void bench_print_processes(FILE *out, const BenchProcesses *measured)
{
    if (measured->count > 0) {
        print_processes(out, measured);
        print_all_phases(out, measured);
    }
    if (measured->curve_count > 0)
        print_curve(out, measured);
}

bool bench_write_process_data(const BenchProcesses *measured, const BenchFolder *folder, Error *error)
{
    BenchPath path = bench_path(folder, "", "process.dat");
    FILE *out = fopen(path.text, "w");
    if (!out)
        return error_set(error, ERROR_SYSTEM, "cannot write %s: %s", path.text, strerror(errno));
    fputs("# scene faces parse_ms build_ms upload_ms trace_ms wall_ms peak_bytes\n", out);
    for (int i = 0; i < measured->curve_count; i++) {
        const BenchProcess *p = &measured->curve[i];
        fprintf(out, "%s %d %.4f %.4f %.4f %.4f %.4f %.0f\n", p->scene.name, p->faces, p->warm.parse, p->warm.build,
                p->warm.upload, p->warm.trace, p->warm_wall_ms, p->peak_bytes);
    }
    return fclose(out) == 0 || error_set(error, ERROR_SYSTEM, "cannot write %s", path.text);
}
