/* A pool of threads that share out numbered tasks. Which thread takes which task is not determined; tasks
 * must therefore write only what belongs to their own index, and then results do not depend on the number of
 * threads. */
#ifndef VES_BASE_POOL_H
#define VES_BASE_POOL_H

#include "vesica/status.h"

typedef struct ves_pool ves_pool;

/* workers >= 1; with one worker tasks run in the caller, in order. NULL when out of memory or threads. */
ves_pool *ves_pool_create(int workers);
void ves_pool_destroy(ves_pool *pool);
int ves_pool_workers(const ves_pool *pool);

/* Runs task(data, worker, index) for index 0 .. count-1 and waits for all. worker: 0 .. workers-1, never the
 * same for two tasks at a time. */
void ves_pool_run(ves_pool *pool, int count, void (*task)(void *data, int worker, int index), void *data);

/* One task at a time, for what they must share. */
void ves_pool_lock(ves_pool *pool);
void ves_pool_unlock(ves_pool *pool);

#endif
