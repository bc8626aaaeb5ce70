/* Memory that runs out and threads that do not start, at every place where they can: nothing leaks,
 * the status says so, what was done before stays, and the same call made again succeeds. And how
 * much memory and which threads a run asks for at all.
 *
 * The linker puts this file's allocation functions and clock in place of the system's.
 */
#define _POSIX_C_SOURCE 200809L

#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "leap.h"
#include "problems.h"
#include "tap.h"

/* ---- the functions that fail ---- */

static atomic_long live, allocations, fail_at, fail_all; /* fail_at 0: never */
static atomic_llong bytes;                               /* asked for, those freed included */
static atomic_long threads_started, thread_fails_at;

void *__real_malloc(size_t size);
void *__real_calloc(size_t n, size_t size);
void __real_free(void *p);
int __real_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *),
                          void *arg);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t n, size_t size);
void __wrap_free(void *p);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *),
                          void *arg);

static int fails(void)
{
    const long n = atomic_fetch_add(&allocations, 1) + 1;
    return fail_at > 0 && (fail_all ? n >= fail_at : n == fail_at);
}

static void *counted(void *p)
{
    live += p != NULL;
    return p;
}

void *__wrap_malloc(size_t size)
{
    bytes += (long long)size;
    return fails() ? NULL : counted(__real_malloc(size));
}

void *__wrap_calloc(size_t n, size_t size)
{
    bytes += (long long)(n * size);
    return fails() ? NULL : counted(__real_calloc(n, size));
}

void __wrap_free(void *p)
{
    live -= p != NULL;
    __real_free(p);
}

int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *),
                          void *arg)
{
    const long n = atomic_fetch_add(&threads_started, 1) + 1;
    if (thread_fails_at > 0 && n >= thread_fails_at)
        return EAGAIN;
    return __real_pthread_create(thread, attributes, run, arg);
}

static void arm(long at, int all)
{
    allocations = 0;
    fail_all = all;
    fail_at = at;
}

/* ---- runs ---- */

#define SAMPLES 6000
#define FEWER 1500

typedef struct saved {
    unsigned char bytes[400000];
    size_t size;
} saved;

static void save(saved *s, const buffon_partial *partial)
{
    s->size = buffon_partial_size(partial);
    if (s->size > sizeof s->bytes || buffon_partial_save(s->bytes, s->size, partial) != BUFFON_OK)
        exit(1);
}

static int same_saved(const saved *a, const saved *b)
{
    return a->size == b->size && memcmp(a->bytes, b->bytes, a->size) == 0;
}

/* The whole of it without faults. */
static buffon_status solve(buffon_partial *partial, buffon_estimate *e, const problem *p,
                           uint64_t samples, uint32_t threads)
{
    buffon_run run = {.samples = samples, .seed = 3, .threads = threads, .partial = partial};
    return p->solve(e, run);
}

/* After a fault: is it told, and does the same call then give what it should? A team that cannot be
 * made is done without, so a fault may also do no harm at all. */
static int recovers(const problem *p, buffon_partial *partial, const buffon_estimate *got,
                    buffon_status status, const buffon_estimate *expected, const saved *end)
{
    static saved now;
    buffon_estimate e[PROBLEMS_COMPONENTS];
    int good = status == expected->status ? same_estimates(got, expected, p->components)
                                          : status == BUFFON_E_NOMEM;
    for (size_t k = 0; status < 0 && k < p->components; k++)
        good &= is_refusal(&got[k], status) && got[k].bad_index == UINT64_MAX;
    good &= solve(partial, e, p, SAMPLES, 2) == expected->status;
    good &= same_estimates(e, expected, p->components);
    save(&now, partial);
    return good && same_saved(&now, end);
}

/* Fails the n-th allocation, or all from the n-th on, of a run from nothing or of one that goes
 * on. */
static void test_problem(const problem *p, int going_on, int all)
{
    static saved end, begin, now;
    buffon_estimate expected[PROBLEMS_COMPONENTS], e[PROBLEMS_COMPONENTS];
    buffon_partial partial = {0};
    int good = 1, kept = 1, leaks = 0;
    long n = 0, most, refused = 0;
    arm(0, 0);
    buffon_status status = solve(&partial, expected, p, SAMPLES, 3);
    expected->status = status; /* one component's may be less than the status of all */
    most = allocations;
    save(&end, &partial);
    buffon_partial_free(&partial);
    leaks |= live != 0;
    for (n = 1; n <= most; n++) {
        memset(&partial, 0, sizeof partial);
        if (going_on && solve(&partial, e, p, FEWER, 1) < 0)
            exit(1);
        save(&begin, &partial);
        arm(n, all);
        status = solve(&partial, e, p, SAMPLES, 3);
        arm(0, 0);
        e->status = status;
        if (status < 0) {
            refused++;
            save(&now, &partial);
            /* Non-finite values need memory under way: some blocks may have been done by then. */
            kept &= p->solve == problem_nonfinite || same_saved(&now, &begin);
        }
        good &= recovers(p, &partial, e, status, expected, &end);
        buffon_partial_free(&partial);
        leaks |= live != 0;
    }
    const char *how = going_on ? "going on" : "from nothing", *which = all ? "all from the" : "the";
    tap_ok(good && refused > 5, "%s, %s: %s n-th of %ld allocations fails, and then it succeeds",
           p->name, how, which, most);
    tap_ok(kept, "%s, %s: a refused run leaves the partial as it was", p->name, how);
    tap_ok(!leaks, "%s, %s: nothing leaks", p->name, how);
}

#ifdef BUFFON_NO_THREADS
enum { THREADED = 0 };
#else
enum { THREADED = 1 };
#endif

static void test_threads(const problem *p)
{
    buffon_estimate expected[PROBLEMS_COMPONENTS], e[PROBLEMS_COMPONENTS];
    buffon_status status = solve(NULL, expected, p, SAMPLES, 1);
    int same = 1;
    for (long n = 1; n <= 5; n++) {
        threads_started = 0;
        thread_fails_at = n;
        same &= solve(NULL, e, p, SAMPLES, 5) == status;
        same &= same_estimates(e, expected, p->components) && (threads_started > 0) == THREADED;
        thread_fails_at = 0;
    }
    tap_ok(same && live == 0, "%s: threads that do not start are done without", p->name);
}

/* Memory that is short for helpers is asked for once, not again in each of many rounds. */
static void test_helpers(void)
{
    const problem *p = &problems[1];
    const buffon_run run = {.samples = 40000, .block = 16, .threads = 4};
    buffon_estimate expected[PROBLEMS_COMPONENTS], e[PROBLEMS_COMPONENTS];
    int good = 1, less = 0;
    arm(0, 0);
    const buffon_status status = p->solve(expected, run);
    const long most = allocations;
    for (long n = 1; n <= most; n++) {
        arm(n, 0);
        const buffon_status now = p->solve(e, run);
        less += now >= 0 && allocations < most;
        good &= live == 0 && allocations <= most;
        good &=
            now == BUFFON_E_NOMEM || (now == status && same_estimates(e, expected, p->components));
    }
    arm(0, 0);
    tap_ok(good && less > 5 * THREADED, "helpers without memory are done without");
}

/* ---- what a run asks for ---- */

/* Threads that a run of the first problem starts when the clock goes on by `step` between looks. */
static long starts(double step, buffon_run run)
{
    buffon_estimate e[PROBLEMS_COMPONENTS];
    leap_seconds = step;
    threads_started = 0;
    if (problems[0].solve(e, run) < 0)
        exit(1);
    leap_seconds = 1;
    return threads_started;
}

static void test_short(void)
{
    const buffon_run one = {.samples = 8 * 1024, .threads = 8};
    const buffon_run most = {.samples = 200 * 1024, .threads = 8};
    const buffon_run looks = {.samples = 16 * 1024, .threads = 8, .abs_tol = 1e-300};
    tap_ok(starts(0, most) == 0, "where no time passes no thread is started");
    tap_ok(starts(0x1p-13, one) == 0, "nor for the first 0.98 ms");
    tap_ok(starts(0x1p-12, one) == 7 * THREADED, "but after more than 1 ms");
    tap_ok(starts(0x1p-13, most) == 7 * THREADED, "and when there is still much to do then");
    tap_ok(starts(0x1p-13, looks) == 7 * THREADED, "all looks of a run count together");
}

/* x0, 2 x0, ... */
static int multiples(double *f, const double *x, size_t n, void *ctx)
{
    for (size_t k = 0; k < *(const size_t *)ctx; k++) {
        for (size_t i = 0; i < n; i++)
            f[k * n + i] = (double)(k + 1) * x[i];
    }
    return 0;
}

/* For each thread 8 KiB times uniforms, coordinates and components, and 64 KiB, are enough,
 * whatever the number of samples. */
static void test_memory(size_t dim, size_t components, uint32_t threads)
{
    static const uint64_t samples[] = {1, 1000, 1 << 16, 1 << 20, 3 << 20};
    enum { COUNT = sizeof samples / sizeof *samples };
    const double lo[32] = {0}, hi[] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1,
                                       1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
    const buffon_integrand f = {
        .batch = multiples, .dim = dim, .components = components, .ctx = &components};
    const long long most = (long long)threads * (long long)(8192 * (2 * dim + components) + 65536);
    long long asked[COUNT], largest = 0;
    for (size_t i = 0; i < COUNT; i++) {
        buffon_estimate e[4];
        bytes = 0;
        if (buffon_uniform(e, &f, lo, hi,
                           &(buffon_run){.samples = samples[i], .threads = threads}) < 0)
            exit(1);
        asked[i] = bytes;
        largest = asked[i] > largest ? asked[i] : largest;
    }
    tap_ok(largest <= most && asked[COUNT - 1] == asked[COUNT - 2],
           "%zu coordinates, %zu components, %u threads: %lld bytes at most, of %lld", dim,
           components, (unsigned)threads, largest, most);
}

/* ---- single calls ---- */

static void test_partial_calls(void)
{
    static saved part[2], whole, now;
    const problem *p = &problems[1];
    buffon_partial a = {0}, b = {0}, both = {0};
    buffon_run run = {.samples = SAMPLES, .parts = 2, .partial = &a};
    buffon_estimate e[PROBLEMS_COMPONENTS];
    int load = 1, merge = 1;
    if (p->solve(e, run) < 0)
        exit(1);
    run.part = 1;
    run.partial = &b;
    if (p->solve(e, run) < 0)
        exit(1);
    save(&part[0], &a);
    save(&part[1], &b);
    arm(0, 0);
    if (buffon_partial_merge(&both, &a) != BUFFON_OK)
        exit(1);
    const long most = allocations;
    save(&whole, &both);
    buffon_partial_free(&both);
    const long before = live;
    for (long n = 1; n <= most; n++) {
        arm(n, 0);
        merge &= buffon_partial_merge(&both, &a) == BUFFON_E_NOMEM && both.more == NULL;
        arm(n, 0);
        load &= buffon_partial_load(&b, part[0].bytes, part[0].size) == BUFFON_E_NOMEM;
        arm(0, 0);
        save(&now, &b);
        load &= same_saved(&now, &part[1]) && live == before;
    }
    tap_ok(most > 3 && merge, "merge: %ld allocations", most);
    tap_ok(load, "load: what was there stays");
    load = buffon_partial_load(&b, part[1].bytes, part[1].size) == BUFFON_OK;
    tap_ok(load && live == before, "loading frees what it replaces");
    arm(1, 1);
    tap_ok(buffon_partial_merge(&a, &b) == BUFFON_OK, "merging into a partial needs no memory");
    tap_ok(buffon_partial_estimate(e, &a, 0) == BUFFON_OK, "nor does estimating");
    arm(0, 0);
    buffon_partial_free(&a);
    buffon_partial_free(&b);
    tap_ok(live == 0, "nothing leaks");
}

static void test_other_calls(void)
{
    const buffon_density g = buffon_segment(0, 1);
    size_t dim = 1;
    const buffon_integrand f = {.scalar = problem_hill, .dim = 1, .ctx = &dim};
    buffon_rng rng = buffon_rng_make(1, 0);
    const buffon_rng was = rng;
    double x[8] = {0};
    arm(1, 0);
    tap_ok(buffon_rejection_sample(x, 8, NULL, &f, &g, 1, &rng, 0) == BUFFON_E_NOMEM &&
               isnan(x[7]) && memcmp(&rng, &was, sizeof rng) == 0,
           "the rejection sampler draws nothing without memory");
    for (long n = 1; n <= 2; n++) {
        arm(n, 0);
        tap_ok(buffon_sample_at(x, &g, 5, NULL) == BUFFON_E_NOMEM && isnan(x[0]),
               "sample_at: allocation %ld", n);
    }
    arm(0, 0);
    tap_ok(buffon_sample_at(x, &g, 5, NULL) == BUFFON_OK && live == 0, "nothing leaks");
}

int main(void)
{
    /* An estimate with its status is compared as a whole: that of the run stands in the first. */
    for (int i = 0; i < PROBLEMS; i++) {
        test_problem(&problems[i], 0, 0);
        test_problem(&problems[i], 1, i % 2);
        test_threads(&problems[i]);
    }
    test_helpers();
    test_short();
    for (uint32_t threads = 1; threads < 5; threads += 3) {
        test_memory(1, 1, threads);
        test_memory(2, 4, threads);
        test_memory(32, 1, threads);
    }
    test_partial_calls();
    test_other_calls();
    return tap_done();
}
