/* What exact arithmetic costs and buys, as tables and as CSV. */
#include "bench/bench_arithmetic_report.h"

#include "bench/bench_csv.h"

#include <errno.h>
#include <string.h>

static void print_milliseconds(FILE *out, double ms)
{
    fprintf(out, " %.*f |", ms < 9.995 ? 2 : ms < 99.95 ? 1 : 0, ms);
}

static void print_ratio(FILE *out, double ms, double against)
{
    fprintf(out, " %.2f |", against > 0 ? ms / against : 0);
}

static void print_costs(FILE *out, const BenchErrors *errors)
{
    fputs("\n| time in ms, one ray per pixel | pixels | plain/textbook/float | plain/exact/float | times as long | "
          "plain/textbook/double | plain/exact/double | times as long | packet/exact/float | packet/exact/double |\n"
          "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n",
          out);
    for (int i = 0; i < errors->count; i++) {
        const ErrorArithmetic *a = &errors->scenes[i].arithmetic;
        fprintf(out, "| %s | %d x %d |", errors->scenes[i].scene.name, a->columns, a->rows);
        for (int k = 0; k < ARITHMETIC_ROWS; k++) {
            print_milliseconds(out, a->row[k].ms);
            if (k == ROW_EXACT_FLOAT || k == ROW_EXACT_DOUBLE)
                print_ratio(out, a->row[k].ms, a->row[k - 1].ms);
        }
        fputc('\n', out);
    }
}

static void print_gains(FILE *out, const BenchErrors *errors)
{
    fputs("\n| pixels off by more than 1/255 of the exact picture; RMSE |", out);
    for (int k = 0; k < ARITHMETIC_ROWS; k++)
        fprintf(out, " %s |", bench_arithmetic_name(&errors->scenes[0].arithmetic.row[k]).text);
    fputs("\n| --- | ---: | ---: | ---: | ---: | ---: | ---: |\n", out);
    for (int i = 0; i < errors->count; i++) {
        const ErrorArithmetic *a = &errors->scenes[i].arithmetic;
        fprintf(out, "| %s |", errors->scenes[i].scene.name);
        for (int k = 0; k < ARITHMETIC_ROWS; k++) {
            const BenchDifference *e = &a->row[k].error;
            if (e->most == 0)
                fputs(" none |", out);
            else
                fprintf(out, " %.0f; %.1e |", e->off * a->columns * a->rows, e->rmse);
        }
        fputc('\n', out);
    }
}

void bench_arithmetic_print_markdown(FILE *out, const BenchErrors *errors)
{
    print_costs(out, errors);
    print_gains(out, errors);
}

bool bench_arithmetic_write_csv(const BenchErrors *errors, const BenchFolder *folder, Error *error)
{
    BenchPath path = bench_path(folder, "", "arithmetic.csv");
    FILE *out = fopen(path.text, "w");
    if (!out)
        return error_set(error, ERROR_SYSTEM, "cannot write %s: %s", path.text, strerror(errno));
    fputs("scene,columns,rows,choice,kernel,arithmetic,precision,runs,trace_ms,rmse,max_error,pixels_off\n", out);
    for (int i = 0; i < errors->count; i++) {
        const ErrorArithmetic *a = &errors->scenes[i].arithmetic;
        for (int k = 0; k < ARITHMETIC_ROWS; k++) {
            const ArithmeticRow *row = &a->row[k];
            bench_csv_text(out, errors->scenes[i].scene.name);
            fprintf(out, ",%d,%d,%s,%s,%s,%s,%d,%.4f,%.6e,%.6e,%.0f\n", a->columns, a->rows,
                    bench_arithmetic_name(row).text, render_kernels[row->kernel], render_arithmetics[row->arithmetic],
                    render_precisions[row->precision], row->runs, row->ms, row->error.rmse, row->error.most,
                    row->error.off * a->columns * a->rows);
        }
    }
    return fclose(out) == 0 || error_set(error, ERROR_SYSTEM, "cannot write %s", path.text);
}
