/* An allocator that counts, and fails on demand: for tests that let memory run out at the first, second, ...
 * call. The linker sends our own calls through here (--wrap, src/setup/tests.cmake). Those of libraries meet
 * malloc, calloc and realloc of this program before libc's, where no sanitizer has put its own. One file of
 * a program includes this. */
#ifndef TESTS_MEMORY_H
#define TESTS_MEMORY_H

#include <stdbool.h>
#include <stddef.h>

static struct {
    bool counting, libraries; /* libraries: their calls are counted and fail as ours do */
    long asked, fail_at;      /* calls so far; the one that fails, 0: none */
    long live;                /* blocks of ours that were not freed: a library may keep its own */
} memory;

static inline bool memory_granted(void)
{
    if (!memory.counting) return true;
    return __atomic_add_fetch(&memory.asked, 1, __ATOMIC_SEQ_CST) != memory.fail_at;
}

static inline void memory_count(int blocks)
{
    if (memory.counting) __atomic_add_fetch(&memory.live, blocks, __ATOMIC_SEQ_CST);
}

/* From here on calls are counted, and call number fail_at fails. */
static inline void memory_begin(long fail_at, bool libraries)
{
    memory.asked = memory.live = 0;
    memory.fail_at = fail_at;
    memory.libraries = libraries;
    memory.counting = true;
}

static inline void memory_end(void)
{
    memory.counting = false;
}

#ifdef __SANITIZE_ADDRESS__
#define BELOW(call) __real_##call
#else
#define BELOW(call) __libc_##call
#endif
void *BELOW(malloc)(size_t size);
void *BELOW(calloc)(size_t count, size_t size);
void *BELOW(realloc)(void *block, size_t size);
void BELOW(free)(void *block);

/* ---- ours ---- */

void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *block, size_t size);
void __wrap_free(void *block);

void *__wrap_malloc(size_t size)
{
    void *block = memory_granted() ? BELOW(malloc)(size) : NULL;
    memory_count(block != NULL);
    return block;
}

void *__wrap_calloc(size_t count, size_t size)
{
    void *block = memory_granted() ? BELOW(calloc)(count, size) : NULL;
    memory_count(block != NULL);
    return block;
}

void *__wrap_realloc(void *old, size_t size)
{
    void *block = memory_granted() ? BELOW(realloc)(old, size) : NULL;
    memory_count(block && !old);
    return block;
}

void __wrap_free(void *block)
{
    memory_count(block ? -1 : 0);
    BELOW(free)(block);
}

/* ---- those of libraries ---- */

#ifndef __SANITIZE_ADDRESS__
void *malloc(size_t size)
{
    return !memory.libraries || memory_granted() ? BELOW(malloc)(size) : NULL;
}

void *calloc(size_t count, size_t size)
{
    return !memory.libraries || memory_granted() ? BELOW(calloc)(count, size) : NULL;
}

void *realloc(void *old, size_t size)
{
    return !memory.libraries || memory_granted() ? BELOW(realloc)(old, size) : NULL;
}
#endif

#endif
