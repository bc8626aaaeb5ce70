/* The bits of a result depend on what is computed, not on who computes it: threads, executors,
 * parts in any order, and steps give the same estimates, covariances and saved bytes. */
#define _POSIX_C_SOURCE 200809L

#include <pthread.h>
#include <stdlib.h>

#include "leap.h"
#include "problems.h"
#include "tap.h"

#define SAMPLES 20000 /* not whole blocks, nor whole sweeps */

/* What a run leaves: the estimates, the covariance matrix and the saved partial. */
typedef struct result {
    buffon_status status;
    buffon_estimate e[PROBLEMS_COMPONENTS];
    double cov[PROBLEMS_COMPONENTS * PROBLEMS_COMPONENTS];
    unsigned char *bytes;
    size_t size;
} result;

static void result_free(result *r)
{
    free(r->bytes);
    r->bytes = NULL;
}

/* What a partial says, after a run that returned `status`. */
static result result_of(const problem *p, buffon_status status, const buffon_partial *partial)
{
    result r = {.status = status, .size = buffon_partial_size(partial)};
    r.bytes = malloc(r.size);
    if (r.bytes == NULL || buffon_partial_save(r.bytes, r.size, partial) != BUFFON_OK)
        exit(1);
    if (buffon_partial_estimate(r.e, partial, 0) != status)
        r.status = BUFFON_E_CORRUPT;
    const int wanted = p->components > 1 && p->solve != problem_median;
    if (buffon_partial_covariance(r.cov, partial) != BUFFON_OK && wanted)
        r.status = BUFFON_E_CORRUPT;
    return r;
}

static int same_result(const problem *p, const result *a, const result *b)
{
    int same = a->status == b->status && same_estimates(a->e, b->e, p->components);
    for (size_t i = 0; p->components > 1 && i < p->components * p->components; i++)
        same &= same_double(a->cov[i], b->cov[i]);
    return same && a->size == b->size && memcmp(a->bytes, b->bytes, a->size) == 0;
}

/* A run from the start; the estimate it returns must be that of its partial. */
static result solve(const problem *p, buffon_run run)
{
    buffon_partial partial = {0};
    buffon_estimate e[PROBLEMS_COMPONENTS];
    run.partial = &partial;
    const buffon_status status = p->solve(e, run);
    result r = result_of(p, status, &partial);
    if (!same_estimates(e, r.e, p->components))
        r.status = BUFFON_E_CORRUPT;
    buffon_partial_free(&partial);
    return r;
}

static int solves_alike(const problem *p, const result *expected, buffon_run run)
{
    result r = solve(p, run);
    const int same = same_result(p, expected, &r);
    result_free(&r);
    return same;
}

/* ---- threads and executors ---- */

/* Threads start at the first block; after some; or not at all. */
static void test_threads(const problem *p, const result *expected, buffon_run run)
{
    static const uint32_t threads[] = {1, 2, 3, 7, 64};
    static const double leaps[] = {1, 2e-4, 0};
    for (size_t i = 0; i < sizeof threads / sizeof *threads; i++) {
        int good = 1;
        run.threads = threads[i];
        for (size_t k = 0; k < sizeof leaps / sizeof *leaps; k++) {
            leap_seconds = leaps[k];
            good &= solves_alike(p, expected, run);
        }
        tap_ok(good, "%s: %u threads", p->name, (unsigned)threads[i]);
    }
    leap_seconds = 1;
}

static void run_forward(size_t tasks, void (*task)(size_t, void *), void *arg, void *ctx)
{
    *(size_t *)ctx += tasks;
    for (size_t i = 0; i < tasks; i++)
        task(i, arg);
}

static void run_backward(size_t tasks, void (*task)(size_t, void *), void *arg, void *ctx)
{
    *(size_t *)ctx += tasks;
    for (size_t i = tasks; i-- > 0;)
        task(i, arg);
}

static void run_some(size_t tasks, void (*task)(size_t, void *), void *arg, void *ctx)
{
    *(size_t *)ctx += tasks;
    for (size_t i = 1; i < tasks; i += 2)
        task(i, arg);
}

static void run_none(size_t tasks, void (*task)(size_t, void *), void *arg, void *ctx)
{
    *(size_t *)ctx += tasks;
    (void)task;
    (void)arg;
}

typedef struct pool_member {
    void (*task)(size_t, void *);
    size_t i;
    void *arg;
    pthread_t thread;
} pool_member;

static void *pool_main(void *member)
{
    const pool_member *self = member;
    self->task(self->i, self->arg);
    return NULL;
}

static void run_pool(size_t tasks, void (*task)(size_t, void *), void *arg, void *ctx)
{
    pool_member member[16];
    *(size_t *)ctx += tasks;
    if (tasks > 16)
        exit(1);
    for (size_t i = 0; i < tasks; i++) {
        member[i] = (pool_member){.task = task, .i = i, .arg = arg};
        if (pthread_create(&member[i].thread, NULL, pool_main, &member[i]) != 0)
            exit(1);
    }
    for (size_t i = 0; i < tasks; i++)
        pthread_join(member[i].thread, NULL);
}

static void test_executors(const problem *p, const result *expected, buffon_run run)
{
    static const struct {
        const char *name;
        void (*run)(size_t, void (*)(size_t, void *), void *, void *);
    } executors[] = {{"in order", run_forward},
                     {"backwards", run_backward},
                     {"that leaves some out", run_some},
                     {"that does nothing", run_none},
                     {"of threads", run_pool}};
    for (size_t i = 0; i < sizeof executors / sizeof *executors; i++) {
        size_t tasks = 0;
        run.executor = executors[i].run;
        run.executor_ctx = &tasks;
        run.threads = 5;
        const int same = solves_alike(p, expected, run);
        tap_ok(same && tasks > 0, "%s: an executor %s", p->name, executors[i].name);
    }
}

/* ---- parts ---- */

/* The i-th of n in one of several orders. */
static size_t order_at(int order, size_t i, size_t n)
{
    switch (order) {
    case 0:
        return i;
    case 1:
        return n - 1 - i;
    default:
        return (i * 7 + 3) % n; /* n is not a multiple of 7 */
    }
}

/* Merges in the order given, one by one or (order 3) in pairs, pairs of pairs, ... */
static int merge_parts(buffon_partial *part, size_t n, int order)
{
    int good = 1;
    if (order == 3) {
        for (size_t step = 1; step < n; step *= 2) {
            for (size_t i = 0; i + step < n; i += 2 * step)
                good &= buffon_partial_merge(&part[i], &part[i + step]) == BUFFON_OK;
        }
        return good;
    }
    buffon_partial all = {0};
    for (size_t i = 0; i < n; i++)
        good &= buffon_partial_merge(&all, &part[order_at(order, i, n)]) == BUFFON_OK;
    buffon_partial_free(&part[0]);
    part[0] = all;
    return good;
}

/* Does a run in parts say, after merging, what the single run says? The saved bytes differ in
 * that the record is one of parts, until the whole run is asked for again. */
static int parts_alike(const problem *p, const result *expected, buffon_run run, uint32_t parts,
                       int order)
{
    buffon_partial part[64] = {{{0}, NULL}};
    int good = 1;
    size_t size = 0;
    run.parts = parts;
    for (uint32_t i = 0; i < parts; i++) {
        buffon_estimate e[PROBLEMS_COMPONENTS];
        run.part = i;
        run.partial = &part[i];
        run.threads = i % 3;
        const buffon_status status = p->solve(e, run);
        good &= parts == 1 ? status == expected->status : status > 0;
        good &= parts == 1 || (e->doubts & BUFFON_DOUBT(BUFFON_W_INCOMPLETE)) != 0;
        good &= i == 0 || buffon_partial_size(&part[i]) == size;
        size = buffon_partial_size(&part[i]);
    }
    good &= merge_parts(part, parts, order);
    result merged = result_of(p, expected->status, &part[0]);
    good &= merged.status == expected->status;
    good &= same_estimates(merged.e, expected->e, p->components) && merged.size == size;
    result_free(&merged);
    run.part = run.parts = 0;
    run.partial = &part[0];
    buffon_estimate e[PROBLEMS_COMPONENTS];
    merged = result_of(p, p->solve(e, run), &part[0]); /* nothing is left to do */
    good &= same_result(p, &merged, expected);
    result_free(&merged);
    for (uint32_t i = 0; i < parts; i++)
        buffon_partial_free(&part[i]);
    return good;
}

static void test_parts(const problem *p, const result *expected, buffon_run run)
{
    static const uint32_t parts[] = {1, 2, 3, 5, 16, 40};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        int good = 1;
        for (int order = 0; order < 4; order++)
            good &= parts_alike(p, expected, run, parts[i], order);
        tap_ok(good, "%s: %u parts merged in four orders", p->name, (unsigned)parts[i]);
    }
}

/* A whole run takes what parts there are and does the rest, whatever the samples of the second
 * call. */
static void test_parts_then_rest(const problem *p, const result *expected, buffon_run run)
{
    int good = 1;
    for (uint32_t have = 0; have < 3; have++) {
        buffon_partial all = {0}, part = {0};
        buffon_estimate e[PROBLEMS_COMPONENTS];
        run.parts = 3;
        run.part = have;
        run.partial = &all;
        good &= p->solve(e, run) > 0;
        if (have == 1) { /* two of three */
            run.part = 2;
            run.partial = &part;
            good &= p->solve(e, run) > 0;
            good &= buffon_partial_merge(&all, &part) == BUFFON_OK;
            buffon_partial_free(&part);
        }
        run.part = run.parts = 0;
        run.partial = &all;
        if (have == 2) { /* a short call fills the gaps before the blocks that are there */
            buffon_run brief = run;
            brief.samples = 100;
            good &= p->solve(e, brief) >= 0;
        }
        const buffon_status status = p->solve(e, run);
        good &= status == expected->status && same_estimates(e, expected->e, p->components);
        buffon_partial_free(&all);
    }
    tap_ok(good, "%s: a run does what the parts that are there leave", p->name);
}

/* ---- steps ---- */

static void test_steps(const problem *p, const result *expected, buffon_run run)
{
    static const uint64_t steps[] = {1, 100, 5000, 5001, 5001, 12345, SAMPLES, 300, SAMPLES};
    buffon_partial partial = {0};
    buffon_estimate e[PROBLEMS_COMPONENTS];
    buffon_status status = BUFFON_OK;
    int alike = 1;
    run.partial = &partial;
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
        run.samples = steps[i];
        run.threads = (uint32_t)(i % 4);
        status = p->solve(e, run);
        if (i < 6) { /* as far as it is, the same as if it had been asked for at once */
            result once = solve(p, (buffon_run){.samples = steps[i], .seed = run.seed});
            result now = result_of(p, status, &partial);
            alike &= same_result(p, &once, &now);
            result_free(&once);
            result_free(&now);
        }
    }
    result last = result_of(p, status, &partial);
    tap_ok(alike, "%s: each step of a run that goes on is what one call gives", p->name);
    tap_ok(same_result(p, &last, expected), "%s: and so is the last", p->name);
    result_free(&last);
    buffon_partial_free(&partial);
}

/* Parts that are extended each on its own merge into the extended run. */
static void test_extended_parts(const problem *p, const result *expected, buffon_run run)
{
    buffon_partial part[3] = {{{0}, NULL}};
    buffon_estimate e[PROBLEMS_COMPONENTS];
    int good = 1;
    run.parts = 3;
    for (uint32_t i = 0; i < 3; i++) {
        run.part = i;
        run.partial = &part[i];
        run.samples = 1500;
        good &= p->solve(e, run) > 0;
        run.samples = SAMPLES;
        good &= p->solve(e, run) > 0;
    }
    good &= merge_parts(part, 3, 1);
    good &= buffon_partial_estimate(e, &part[0], 0) == expected->status;
    good &= same_estimates(e, expected->e, p->components);
    tap_ok(good, "%s: parts extended one by one", p->name);
    for (int i = 0; i < 3; i++)
        buffon_partial_free(&part[i]);
}

/* ---- blocks ---- */

/* The points are the same ones whatever the block; only roundings differ. */
static void test_blocks(const problem *p, const result *expected, buffon_run run)
{
    static const uint32_t blocks[] = {16, 128, 32768};
    double worst = 0;
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) {
        buffon_estimate e[PROBLEMS_COMPONENTS];
        run.block = blocks[i];
        if (p->solve(e, run) != expected->status)
            worst = INFINITY;
        for (size_t k = 0; k < p->components; k++) {
            const buffon_estimate *a = &expected->e[k];
            const double value = fabs(e[k].value / a->value - 1);
            /* An error far below the value has the value's rounding. */
            const double error =
                fabs(e[k].std_error - a->std_error) / fmax(a->std_error, 1e-3 * fabs(a->value));
            worst = value > worst ? value : worst;
            worst = error > worst ? error : worst;
            if (e[k].samples != a->samples || !same_double(e[k].max, a->max) ||
                !same_double(e[k].min, a->min))
                worst = INFINITY;
        }
    }
    tap_ok(worst < 1e-13, "%s: other blocks give the same but for rounding (%.1g)", p->name, worst);
}

/* ---- two seeds, streams and uses ---- */

static void test_seeds(const problem *p, const result *expected, buffon_run run)
{
    buffon_estimate e[PROBLEMS_COMPONENTS];
    buffon_run seed = run, stream = run, id = run;
    seed.seed ^= UINT64_C(1) << 63;
    stream.stream = 1;
    id.id = 77;
    int good = p->solve(e, seed) >= 0 && e->value != expected->e->value;
    good &= p->solve(e, stream) >= 0 && e->value != expected->e->value;
    tap_ok(good, "%s: another seed or stream gives another value", p->name);
    good = p->solve(e, id) >= 0 && same_estimates(e, expected->e, p->components);
    tap_ok(good, "%s: .id changes no number, nor does the partial", p->name);
}

int main(void)
{
    for (int i = 0; i < PROBLEMS; i++) {
        const problem *p = &problems[i];
        const buffon_run run = {.samples = SAMPLES, .seed = 42};
        result expected = solve(p, run);
        tap_ok(expected.status >= 0, "%s: %.9g +- %.2g (%s)", p->name, expected.e->value,
               expected.e->std_error, buffon_status_string(expected.status));
        test_threads(p, &expected, run);
        test_executors(p, &expected, run);
        test_parts(p, &expected, run);
        test_parts_then_rest(p, &expected, run);
        test_steps(p, &expected, run);
        test_extended_parts(p, &expected, run);
        test_blocks(p, &expected, run);
        test_seeds(p, &expected, run);
        result_free(&expected);
    }
    return tap_done();
}
