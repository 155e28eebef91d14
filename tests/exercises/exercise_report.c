/* The report of the tests. */
#include "exercises/exercise_report.h"

#include "exercises/exercise.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

bool report_failed;

static FILE *report;

bool report_open(const char *path)
{
    report = fopen(path, "w");
    return report != NULL;
}

void report_line(const char *key, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    fprintf(report, "%s\t", key);
    vfprintf(report, format, values);
    fputc('\n', report);
    fflush(report);
    va_end(values);
}

void report_broken(const char *why)
{
    report_line("broken", "%s", why);
    exit(EXERCISE_BROKEN);
}
