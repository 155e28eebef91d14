/* The same work on several threads at once. */
#include "parallel.h"

#include <pthread.h>
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
