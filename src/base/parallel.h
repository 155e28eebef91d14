/* The same work on several threads at once. Only parallel.c knows how threads are made: where there are none, such as
 * in a browser, or with -DRECTRAY_NO_THREADS, the caller's thread does all the work. */
#ifndef RECTRAY_PARALLEL_H
#define RECTRAY_PARALLEL_H

#include <stdbool.h>

/* Threads to use when `wanted` are asked for: that many, or one
 * per processor where wanted is 0; at least 1, at most 256. */
int parallel_threads(int wanted);

/* May this process run on every processor there is, numbered from 0? False also where that cannot be known. */
bool parallel_may_use_all(void);

/* Calls work(data, i, thread) once for each i in [0, count), on parallel_threads(wanted)
 * threads. A thread takes the next i as soon as it is free. `thread` is its number, from
 * 0: what two threads may not share can stand in an array of as many places. */
void parallel_for(int wanted, int count, void (*work)(void *data, int i, int thread), void *data);

/* Calls work(data) on `threads` threads, the caller's among them, and returns when all have
 * returned. Each begins on a processor of its own, as far as there are so many: left alone,
 * a new thread often shares its parent's for milliseconds. A thread that cannot be started
 * is done without: the work must share itself out by taking pieces until none is left. */
void parallel_run(int threads, void (*work)(void *data), void *data);

#endif
