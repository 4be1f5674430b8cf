#include "base/pool.h"

#include <pthread.h>
#include <stdbool.h>

#include "base/arena.h"

typedef struct worker {
    ves_pool *pool;
    int index;
    pthread_t thread;
} worker;

struct ves_pool {
    int workers;
    pthread_mutex_t lock, shared;
    pthread_cond_t begin, end;
    void (*task)(void *, int, int);
    void *data;
    int count, next, busy;
    bool quit;
    worker helper[]; /* workers - 1: the caller is worker 0 */
};

/* Takes tasks until none is left. Called, and returns, with the lock held. */
static void work(ves_pool *pool, int index)
{
    while (pool->next < pool->count) {
        int task = pool->next++;
        pthread_mutex_unlock(&pool->lock);
        pool->task(pool->data, index, task);
        pthread_mutex_lock(&pool->lock);
    }
}

static void *help(void *data)
{
    worker *self = data;
    ves_pool *pool = self->pool;
    pthread_mutex_lock(&pool->lock);
    while (!pool->quit) {
        if (pool->next < pool->count) {
            pool->busy++;
            work(pool, self->index);
            if (--pool->busy == 0) pthread_cond_signal(&pool->end);
        } else {
            pthread_cond_wait(&pool->begin, &pool->lock);
        }
    }
    pthread_mutex_unlock(&pool->lock);
    return NULL;
}

ves_pool *ves_pool_create(int workers)
{
    if (workers < 1) workers = 1;
    ves_pool *pool = ves_memory_take(sizeof *pool + (size_t)(workers - 1) * sizeof(worker));
    if (!pool) return NULL;
    pool->workers = 1;
    pthread_mutex_init(&pool->lock, NULL);
    pthread_mutex_init(&pool->shared, NULL);
    pthread_cond_init(&pool->begin, NULL);
    pthread_cond_init(&pool->end, NULL);
    for (int k = 0; k < workers - 1; k++) {
        pool->helper[k] = (worker){.pool = pool, .index = k + 1};
        if (pthread_create(&pool->helper[k].thread, NULL, help, &pool->helper[k])) {
            ves_pool_destroy(pool);
            return NULL;
        }
        pool->workers++;
    }
    return pool;
}

void ves_pool_destroy(ves_pool *pool)
{
    if (!pool) return;
    pthread_mutex_lock(&pool->lock);
    pool->quit = true;
    pthread_cond_broadcast(&pool->begin);
    pthread_mutex_unlock(&pool->lock);
    for (int k = 0; k < pool->workers - 1; k++) pthread_join(pool->helper[k].thread, NULL);
    pthread_cond_destroy(&pool->end);
    pthread_cond_destroy(&pool->begin);
    pthread_mutex_destroy(&pool->lock);
    pthread_mutex_destroy(&pool->shared);
    ves_memory_free(pool);
}

void ves_pool_lock(ves_pool *pool)
{
    pthread_mutex_lock(&pool->shared);
}

void ves_pool_unlock(ves_pool *pool)
{
    pthread_mutex_unlock(&pool->shared);
}

int ves_pool_workers(const ves_pool *pool)
{
    return pool->workers;
}

void ves_pool_run(ves_pool *pool, int count, void (*task)(void *data, int worker, int index), void *data)
{
    pthread_mutex_lock(&pool->lock);
    pool->task = task;
    pool->data = data;
    pool->next = 0;
    pool->count = count;
    if (pool->workers > 1 && count > 1) pthread_cond_broadcast(&pool->begin);
    work(pool, 0);
    while (pool->busy) pthread_cond_wait(&pool->end, &pool->lock);
    pool->count = 0;
    pthread_mutex_unlock(&pool->lock);
}
