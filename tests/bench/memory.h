/* Memory of a run: the most that is allocated at once, counted by functions that the linker puts in
 * place of malloc, calloc and free. Stacks of threads are not among it. */
#ifndef TESTS_BENCH_MEMORY_H
#define TESTS_BENCH_MEMORY_H

#include <stdatomic.h>
#include <stddef.h>

#include "integrals.h"

void *__real_malloc(size_t size);
void __real_free(void *p);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t n, size_t size);
void __wrap_free(void *p);

/* Before each piece stands its size. */
#define MEMORY_HEAD sizeof(max_align_t)
static atomic_size_t memory_live, memory_most;

void *__wrap_malloc(size_t size)
{
    char *head = size < SIZE_MAX - MEMORY_HEAD ? __real_malloc(size + MEMORY_HEAD) : NULL;
    if (head == NULL)
        return NULL;
    memcpy(head, &size, sizeof size);
    const size_t live = atomic_fetch_add(&memory_live, size) + size;
    size_t most = memory_most;
    while (live > most && !atomic_compare_exchange_weak(&memory_most, &most, live))
        continue;
    return head + MEMORY_HEAD;
}

void *__wrap_calloc(size_t n, size_t size)
{
    void *p = size == 0 || n < SIZE_MAX / size ? __wrap_malloc(n * size) : NULL;
    return p != NULL ? memset(p, 0, n * size) : NULL;
}

void __wrap_free(void *p)
{
    size_t size;
    if (p == NULL)
        return;
    memcpy(&size, (char *)p - MEMORY_HEAD, sizeof size);
    memory_live -= size;
    __real_free((char *)p - MEMORY_HEAD);
}

/* KiB that a run of the sum of squares takes. */
static double memory_of_run(uint64_t samples, uint32_t threads)
{
    const buffon_integrand f = {.batch = squares_plain, .dim = dim};
    const buffon_run run = {.samples = samples, .threads = threads};
    const size_t before = memory_live;
    buffon_estimate e;
    memory_most = before;
    bench_must(buffon_uniform(&e, &f, zeros, ones, &run));
    return (double)(memory_most - before) / 1024;
}

/* A run of less than a round of blocks may take less; from there on nothing grows. */
static void memory_line(uint32_t threads)
{
    const double few = memory_of_run(1 << 14, threads), more = memory_of_run(1 << 21, threads),
                 most = memory_of_run(1 << 24, threads);
    /* A block of 1024 doubles for each uniform, coordinate and component. */
    bench_target target = {.where = "any", .unit = "KiB", .reached = most, .most = 1};
    target.wanted = threads * (8.0 * (double)(dim + dim + 1) + 64);
    snprintf(target.what, sizeof target.what, "memory of a run, d = %zu, threads = %u", dim,
             threads);
    bench_want(&target);
    target.wanted = 0;
    target.reached = most - more;
    snprintf(target.what, sizeof target.what, "2^24 samples over 2^21, d = %zu, threads = %u", dim,
             threads);
    bench_want(&target);
    printf("  d = %zu, threads = %-22u %8.1f %8.1f   %8.1f\n", dim, threads, few, more, most);
}

static void bench_memory(void)
{
    printf("\n%-40s %8s %8s   %8s\n", "KiB of a run, by the number of samples", "2^14", "2^21",
           "2^24");
    for (dim = 1; dim <= 8; dim *= 8) {
        memory_line(1);
        memory_line(4);
    }
}

#endif
