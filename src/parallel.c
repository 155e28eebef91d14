/* The same work on several threads at once. */
#ifdef __linux__
#define _GNU_SOURCE /* sched_getaffinity */
#endif

#include "parallel.h"

#include <pthread.h>
#include <sched.h>
#include <unistd.h>

enum { MAX_THREADS = 256 };

typedef struct Call {
    void (*work)(void *data);
    void *data;
} Call;

static void *run(void *argument)
{
    Call *call = argument;
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
    Call call = {work, data};
    int started = 0;
    while (started < threads - 1 && started < MAX_THREADS && pthread_create(&others[started], 0, run, &call) == 0)
        started++;
    work(data);
    for (int i = 0; i < started; i++)
        pthread_join(others[i], 0);
}
