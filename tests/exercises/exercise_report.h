/* The report of the tests: what `run` reads. A line is a key, a tab and values with tabs between them. Each is flushed,
 * so that after a crash or in an endless loop the report names the test and its input. */
#ifndef EXERCISE_REPORT_H
#define EXERCISE_REPORT_H

#include <stdbool.h>

/* A test has failed and has been reported. The rest only tells apart what may have caused it. */
extern bool report_failed;

bool report_open(const char *path);

void report_line(const char *key, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The exercise itself is at fault: says why, and ends the program. */
void report_broken(const char *why);

/* Reports the slips that explain the failure, each as a line with that key. */
void exercise_tell_slips(const char *key);

#endif
