/* Where bench puts its files: in the folder that the user chose, where they stay, or in a temporary one that goes with
 * all that is in it, even where the program is killed. */
#ifndef RECTRAY_BENCH_FOLDER_H
#define RECTRAY_BENCH_FOLDER_H

#include "base/process.h"

typedef struct BenchFolder {
    char path[256];
    Process sweeper; /* removes a temporary folder; zeroed where the folder stays */
} BenchFolder;

/* A path, passed by value. */
typedef struct BenchPath {
    char text[400];
} BenchPath;

/* Makes the folder, and those above it; `wanted` NULL: a temporary one in TMPDIR or /tmp. */
bool bench_folder_open(BenchFolder *folder, const char *wanted, Error *error);

/* Removes the folder if it is temporary. */
void bench_folder_close(BenchFolder *folder);

/* PREFIX FOLDER/NAME: the name of a file in it, behind any words that a program wants before it. */
BenchPath bench_path(const BenchFolder *folder, const char *prefix, const char *name);

#endif
