/* Tables in markdown, and CSV. Colours run from 0 to 1, errors are in the same unit. */
#include "bench/bench_error_report.h"

#include "bench/bench_arithmetic_report.h"
#include "bench/bench_csv.h"
#include "bench/bench_machine.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

static uint64_t all_rays(const ErrorChoice *choice)
{
    return choice->rays.primary + choice->rays.shadow + choice->rays.reflection;
}

static double psnr(const ErrorChoice *choice)
{
    return -20 * log10(choice->error.rmse);
}

/* --- Markdown --- */

static void print_milliseconds(FILE *out, double ms)
{
    fprintf(out, " %.*f |", ms < 9.995 ? 2 : ms < 99.95 ? 1 : 0, ms);
}

/* The cells that every choice has, without the end of the line. */
static void print_choice(FILE *out, const ErrorChoice *choice)
{
    const BenchDifference *e = &choice->error;
    fprintf(out, "| %s |", choice->name);
    print_milliseconds(out, choice->ms);
    fprintf(out, " %.2g | %.2g | %.2f %% | %.1f | %.2f |", e->rmse, e->most, 100 * e->off, psnr(choice),
            (double)all_rays(choice) / 1e6);
}

#define CHOICE_HEAD "| ms | RMSE | largest error | pixels off by more than 1/255 | PSNR, dB | million rays |"
#define CHOICE_RULE "| --- | ---: | ---: | ---: | ---: | ---: | ---: |"

static void print_front(FILE *out, const BenchError *result)
{
    fputs("| on the front " CHOICE_HEAD "\n" CHOICE_RULE "\n", out);
    for (int i = 0; i < result->choice_count; i++) {
        const ErrorChoice *choice = &result->choices[i];
        if (choice->runs > 0 && choice->better < 0) {
            print_choice(out, choice);
            fputs("\n", out);
        }
    }
}

static void print_dominated(FILE *out, const BenchError *result)
{
    fputs("| dominated " CHOICE_HEAD " by |\n" CHOICE_RULE " --- |\n", out);
    for (int i = 0; i < result->choice_count; i++) {
        const ErrorChoice *choice = &result->choices[i];
        if (choice->runs > 0 && choice->better >= 0) {
            print_choice(out, choice);
            fprintf(out, " %s |\n", result->choices[choice->better].name);
        }
    }
}

/* What would have taken too long. */
static void print_left_out(FILE *out, const BenchError *result)
{
    const char *before = "\nNot measured for their time: ";
    for (int i = 0; i < result->choice_count; i++)
        if (result->choices[i].runs == 0) {
            fprintf(out, "%s%s (some %.0f s)", before, result->choices[i].name, result->choices[i].ms / 1000);
            before = ", ";
        }
    fputs(before[0] == ',' ? ".\n" : "", out);
}

static void print_scene(FILE *out, const BenchError *result)
{
    fprintf(out, "\n### %s\n\n%d faces, %d x %d pixels.\n\n", result->scene.name, result->faces, result->scene.columns,
            result->scene.rows);
    print_front(out, result);
    fputs("\n<details><summary>The dominated choices</summary>\n\n", out);
    print_dominated(out, result);
    print_left_out(out, result);
    fputs("\n</details>\n", out);
}

/* Of the scenes whose choices were measured. */
static void print_truths(FILE *out, const BenchErrors *errors)
{
    fputs("| scene | pixels | error of the truth itself, RMSE | the reference differs from it by at most |\n"
          "| --- | ---: | ---: | ---: |\n",
          out);
    for (int i = 0; i < errors->count; i++) {
        const BenchError *result = &errors->scenes[i];
        if (result->arithmetic_only)
            continue;
        fprintf(out, "| %s | %d x %d | %.1e | %.1e |\n", result->scene.name, result->scene.columns, result->scene.rows,
                result->truth_error, result->truth_check);
    }
}

static void print_causes(FILE *out, const BenchErrors *errors)
{
    fputs("\n| RMSE of the default by cause | arithmetic | sampling | truncation | 8-bit output | all |\n"
          "| --- | ---: | ---: | ---: | ---: | ---: |\n",
          out);
    for (int i = 0; i < errors->count; i++) {
        const BenchError *result = &errors->scenes[i];
        const ErrorCauses *c = &result->causes;
        if (result->arithmetic_only)
            continue;
        fprintf(out, "| %s, %s %d, %d bounces | %.1e | %.1e | %.1e | %.1e | %.1e |\n", result->scene.name,
                result->adaptive ? "adaptive" : "grid", result->scene.grid, result->bounces, c->arithmetic, c->sampling,
                c->truncation, c->output, c->all);
    }
}

void bench_error_print_markdown(FILE *out, const void *data)
{
    const BenchErrors *errors = data;
    char processor[128];
    fprintf(
        out,
        "Measured by `rectray bench error` on %ld cores of an %s; times are medians of %d, the choices of a scene in "
        "turns. Other programs wanted %.1f cores before it began.\n\n",
        sysconf(_SC_NPROCESSORS_ONLN), bench_processor(processor, sizeof processor), errors->plan.repeats,
        errors->load);
    print_truths(out, errors);
    print_causes(out, errors);
    bench_arithmetic_print_markdown(out, errors);
    for (int i = 0; i < errors->count; i++)
        if (!errors->scenes[i].arithmetic_only)
            print_scene(out, &errors->scenes[i]);
}

/* --- CSV --- */

static void write_choice(FILE *out, const BenchError *result, const ErrorChoice *choice)
{
    static const char *const series[] = {
        [SERIES_FLOAT] = "float",
        [SERIES_DOUBLE] = "double",
        [SERIES_REFERENCE] = "reference",
        [SERIES_TEXTBOOK] = "textbook",
        [SERIES_TEXTBOOK_DOUBLE] = "textbook double",
        [SERIES_PLAIN] = "plain",
        [SERIES_PLAIN_DOUBLE] = "plain double",
        [SERIES_ADAPTIVE] = "adaptive",
        [SERIES_ADAPTIVE_DOUBLE] = "adaptive double",
        [SERIES_ADAPTIVE_REFERENCE] = "adaptive reference",
        [SERIES_BOUNCES] = "bounces",
        [SERIES_ACCEL] = "accel",
    };
    bench_csv_text(out, result->scene.name);
    fprintf(out, ",%d,%d,\"%s\",%s,%s,", result->scene.columns, result->scene.rows, choice->name,
            series[choice->series], render_backends[choice->backend]);
    fprintf(out, "%s,%s,%s,%s,%s,%d,%d,%d,", choice->backend == BACKEND_OPENCL ? render_kernels[choice->kernel] : "",
            render_arithmetics[choice->arithmetic], render_precisions[choice->precision], render_accels[choice->accel],
            choice->adaptive ? "adaptive" : "uniform", choice->grid, choice->bounces, choice->runs);
    if (choice->runs == 0) {
        fputs(",,,,,,,,,,\n", out);
        return;
    }
    fprintf(out, "%.4f,%.6e,%.6e,%.6f,%.3f,%" PRIu64 ",%" PRIu64 ",%" PRIu64 ",%d,", choice->ms, choice->error.rmse,
            choice->error.most, choice->error.off, psnr(choice), choice->rays.primary, choice->rays.shadow,
            choice->rays.reflection, choice->better < 0);
    if (choice->better >= 0)
        fprintf(out, "\"%s\"", result->choices[choice->better].name);
    fprintf(out, ",%.3e\n", result->truth_error);
}

bool bench_error_write_csv(const BenchError *result, const BenchFolder *folder, Error *error)
{
    char name[BENCH_NAME + 16];
    snprintf(name, sizeof name, "error-%s.csv", result->scene.name);
    BenchPath path = bench_path(folder, "", name);
    FILE *out = fopen(path.text, "w");
    if (!out)
        return error_set(error, ERROR_SYSTEM, "cannot write %s: %s", path.text, strerror(errno));
    fputs("scene,columns,rows,choice,series,backend,kernel,arithmetic,precision,accel,sampling,grid,bounces,runs,"
          "trace_ms,"
          "rmse,max_error,share_off,psnr_db,primary,shadow,reflection,on_front,better,truth_error\n",
          out);
    for (int i = 0; i < result->choice_count; i++)
        write_choice(out, result, &result->choices[i]);
    return fclose(out) == 0 || error_set(error, ERROR_SYSTEM, "cannot write %s", path.text);
}
