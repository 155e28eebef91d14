/* The same work on several threads at once, by POSIX threads. */
#ifdef __linux__
#define _GNU_SOURCE /* sched_getaffinity and its like */
#endif

#include "base/parallel.h"

#if defined(RECTRAY_NO_THREADS) || defined(__wasi__) || (defined(__EMSCRIPTEN__) && !defined(__EMSCRIPTEN_PTHREADS__))

int parallel_threads(int wanted)
{
    (void)wanted;
    return 1;
}

bool parallel_may_use_all(void)
{
    return false;
}

void parallel_for(int wanted, int count, void (*work)(void *data, int i, int thread), void *data)
{
    (void)wanted;
    for (int i = 0; i < count; i++)
        work(data, i, 0);
}

void parallel_run(int threads, void (*work)(void *data), void *data)
{
    (void)threads;
    work(data);
}

#else

#include <pthread.h>
#include <sched.h>
#include <unistd.h>

enum { MAX_THREADS = 256 };

typedef struct Call {
    void (*work)(void *data);
    void *data;
    int start_on; /* a processor's number, -1: anywhere */
} Call;

#ifdef __linux__
/* The processors that threads 0, 1, ... begin on: those that
 * this one may use, one after the other from the present one. */
static void choose_processors(Call *calls, int count)
{
    cpu_set_t allowed;
    if (sched_getaffinity(0, sizeof allowed, &allowed) != 0)
        return;
    int processor = sched_getcpu(), turns = CPU_COUNT(&allowed);
    for (int i = 0; i < count && i < turns && processor >= 0; i++) {
        calls[i].start_on = processor;
        do
            processor = (processor + 1) % CPU_SETSIZE;
        while (!CPU_ISSET((size_t)processor, &allowed));
    }
}

/* Moves this thread to the processor. It may be moved again. */
static void move_to(int processor)
{
    cpu_set_t allowed, one;
    CPU_ZERO(&one);
    CPU_SET((size_t)processor, &one);
    if (sched_getaffinity(0, sizeof allowed, &allowed) == 0 && sched_setaffinity(0, sizeof one, &one) == 0)
        sched_setaffinity(0, sizeof allowed, &allowed);
}
#else
static void choose_processors(Call *calls, int count)
{
    (void)calls;
    (void)count;
}

static void move_to(int processor)
{
    (void)processor;
}
#endif

static void *run(void *argument)
{
    Call *call = argument;
    if (call->start_on >= 0)
        move_to(call->start_on);
    call->work(call->data);
    return 0;
}

int parallel_threads(int wanted)
{
    long count = wanted > 0 ? wanted : sysconf(_SC_NPROCESSORS_ONLN);
    return count < 1 ? 1 : count > MAX_THREADS ? MAX_THREADS : (int)count;
}

bool parallel_may_use_all(void)
{
#ifdef __linux__
    cpu_set_t allowed;
    long count = sysconf(_SC_NPROCESSORS_ONLN);
    bool all = count > 0 && count <= CPU_SETSIZE && sched_getaffinity(0, sizeof allowed, &allowed) == 0;
    for (int i = 0; all && i < (int)count; i++)
        all = CPU_ISSET((size_t)i, &allowed);
    return all;
#else
    return false;
#endif
}

void parallel_run(int threads, void (*work)(void *data), void *data)
{
    pthread_t others[MAX_THREADS];
    Call calls[MAX_THREADS];
    int started = 0, wanted = threads < 1 ? 1 : threads <= MAX_THREADS ? threads : MAX_THREADS;
    for (int i = 0; i < wanted; i++)
        calls[i] = (Call){work, data, -1};
    if (wanted > 1)
        choose_processors(calls, wanted);
    while (started < wanted - 1 && pthread_create(&others[started], 0, run, &calls[started + 1]) == 0)
        started++;
    work(data);
    for (int i = 0; i < started; i++)
        pthread_join(others[i], 0);
}

/* --- Pieces of work --- */

typedef struct Loop {
    void (*work)(void *data, int i, int thread);
    void *data;
    int count;
    int next, threads; /* guarded by the lock: the next piece, and the threads that have begun */
    pthread_mutex_t lock;
} Loop;

/* The value of one of the loop's counters, which goes on by one. */
static int take(Loop *loop, int *counter)
{
    pthread_mutex_lock(&loop->lock);
    int value = (*counter)++;
    pthread_mutex_unlock(&loop->lock);
    return value;
}

static void take_pieces(void *data)
{
    Loop *loop = data;
    int thread = take(loop, &loop->threads);
    for (int i; (i = take(loop, &loop->next)) < loop->count;)
        loop->work(loop->data, i, thread);
}

void parallel_for(int wanted, int count, void (*work)(void *data, int i, int thread), void *data)
{
    Loop loop = {.work = work, .data = data, .count = count};
    int threads = parallel_threads(wanted);
    pthread_mutex_init(&loop.lock, NULL);
    parallel_run(threads < count ? threads : count, take_pieces, &loop);
    pthread_mutex_destroy(&loop.lock);
}

#endif
