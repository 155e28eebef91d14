/* Comma-separated values. */
#include "bench/bench_csv.h"

void bench_csv_text(FILE *out, const char *text)
{
    fputc('"', out);
    for (const char *c = text; *c; c++)
        fputs(*c == '"' ? "\"\"" : (const char[]){*c, '\0'}, out);
    fputc('"', out);
}
