/* Interruptions: a run that is cancelled at any point and resumed, as often as you like, ends
 * with the bits of a run that was left alone. And what the progress callback is told, when and
 * where.
 *
 * The clock is this file's own (the linker puts it in place of the system's), so rounds of every
 * size occur, and the same ones on every machine. / */
#define _POSIX_C_SOURCE 200809L

#include <pthread.h>
#include <stdlib.h>
#include <time.h>

#include "problems.h"
#include "tap.h"

#define SAMPLES 10000

/* ---- the clock ---- */

static double clock_now;
static double clock_least, clock_most; /* seconds that pass from one look at it to the next */
static buffon_rng clock_rng;

int __wrap_clock_gettime(clockid_t id, struct timespec *t);

int __wrap_clock_gettime(clockid_t id, struct timespec *t)
{
    (void)id;
    clock_now += clock_least + (clock_most - clock_least) * buffon_rng_next(&clock_rng);
    t->tv_sec = (time_t)clock_now;
    t->tv_nsec = (long)((clock_now - (double)t->tv_sec) * 1e9);
    return 0;
}

static void clock_set(double least, double most)
{
    clock_least = least;
    clock_most = most;
    clock_rng = buffon_rng_make(99, 0);
}

/* ---- what a run left ---- */

typedef struct result {
    buffon_status status;
    buffon_estimate e[PROBLEMS_COMPONENTS];
    buffon_partial partial;
} result;

static unsigned char *save(const buffon_partial *partial, size_t *size)
{
    *size = buffon_partial_size(partial);
    unsigned char *bytes = malloc(*size);
    if (bytes == NULL || buffon_partial_save(bytes, *size, partial) != BUFFON_OK)
        exit(1);
    return bytes;
}

static int same_result(const problem *p, const result *a, const result *b)
{
    size_t na, nb;
    unsigned char *const ba = save(&a->partial, &na), *const bb = save(&b->partial, &nb);
    const int same = na == nb && memcmp(ba, bb, na) == 0 && a->status == b->status &&
                     same_estimates(a->e, b->e, p->components);
    free(ba);
    free(bb);
    return same;
}

static void solve(result *r, const problem *p, buffon_run run)
{
    run.partial = &r->partial;
    r->status = p->solve(r->e, run);
}

/* As if the process had ended and another went on. */
static void reload(buffon_partial *partial)
{
    size_t size;
    unsigned char *bytes = save(partial, &size);
    buffon_partial_free(partial);
    if (buffon_partial_load(partial, bytes, size) != BUFFON_OK)
        exit(1);
    free(bytes);
}

/* ---- cancelling ---- */

typedef struct whim {
    buffon_rng rng;
    uint64_t one_in;
    uint64_t done, total; /* points at the last call */
    int calls, wrong;
} whim;

static int cancel_at_whim(const buffon_progress *progress, void *ctx)
{
    whim *w = ctx;
    w->calls++;
    w->wrong |= progress->done < w->done || progress->done > progress->total;
    w->done = progress->done;
    w->total = progress->total;
    return buffon_rng_below(&w->rng, w->one_in) == 0;
}

/* Is this a valid estimate of what is done, and the one that the partial gives but for the
 * status? */
static int is_cancelled(const problem *p, const result *r)
{
    buffon_estimate e[PROBLEMS_COMPONENTS];
    int good = r->status == BUFFON_W_CANCELLED;
    good &= buffon_partial_estimate(e, &r->partial, 0) == BUFFON_W_INCOMPLETE;
    for (size_t k = 0; k < p->components; k++) {
        const buffon_estimate *a = &r->e[k];
        good &= a->status == BUFFON_W_CANCELLED;
        good &= a->doubts == (e[k].doubts | BUFFON_DOUBT(BUFFON_W_CANCELLED));
        good &= same_double(a->value, e[k].value) && same_double(a->std_error, e[k].std_error);
        good &= a->samples == e[k].samples;
        good &= a->samples == 0 || !(a->value < a->lo || a->value > a->hi);
    }
    return good;
}

/* Cancels and resumes until the run is done; by `threads` or by an executor. */
static void test_cancel(const problem *p, buffon_run run, const char *how)
{
    result expected = {.partial = {{0}, NULL}}, r = {.partial = {{0}, NULL}};
    whim w = {.rng = buffon_rng_make(7, 0), .one_in = 3};
    int cancels = 0, good = 1;
    clock_set(0.05, 0.3);
    solve(&expected, p, run);
    run.progress = cancel_at_whim;
    run.progress_ctx = &w;
    do {
        w.done = 0;
        run.threads = (uint32_t)buffon_rng_below(&w.rng, 5);
        solve(&r, p, run);
        if (r.status == BUFFON_W_CANCELLED) {
            cancels++;
            good &= is_cancelled(p, &r);
            if (cancels % 3 == 0)
                reload(&r.partial);
        }
    } while (r.status == BUFFON_W_CANCELLED && cancels < 10000);
    tap_ok(good && !w.wrong && cancels >= 5, "%s%s: a valid estimate each time it is cancelled",
           p->name, how);
    tap_ok(same_result(p, &r, &expected), "%s%s: cancelled %d times, the same bits in the end",
           p->name, how, cancels);
    buffon_partial_free(&r.partial);
    buffon_partial_free(&expected.partial);
}

/* Parts too can be cancelled and resumed, each on its own. */
static void test_cancel_parts(const problem *p, buffon_run run)
{
    result expected = {.partial = {{0}, NULL}}, part[3] = {{.partial = {{0}, NULL}}};
    whim w = {.rng = buffon_rng_make(8, 0), .one_in = 2};
    buffon_estimate e[PROBLEMS_COMPONENTS];
    int good = 1, cancels = 0;
    clock_set(0.05, 0.3);
    solve(&expected, p, run);
    run.progress = cancel_at_whim;
    run.progress_ctx = &w;
    run.parts = 3;
    for (uint32_t i = 0; i < 3; i++) {
        run.part = i;
        do {
            w.done = 0;
            solve(&part[i], p, run);
            cancels++;
        } while (part[i].status == BUFFON_W_CANCELLED && cancels < 10000);
        good &= w.done == w.total && w.total == part[i].e->samples;
        good &= i == 0 || buffon_partial_merge(&part[0].partial, &part[i].partial) == BUFFON_OK;
        buffon_partial_free(&part[i > 0 ? i : 1].partial);
    }
    good &= buffon_partial_estimate(e, &part[0].partial, 0) == expected.status;
    tap_ok(good && !w.wrong && same_estimates(e, expected.e, p->components),
           "%s: three parts, cancelled and resumed", p->name);
    buffon_partial_free(&part[0].partial);
    buffon_partial_free(&expected.partial);
}

/* ---- what the callback sees ---- */

typedef struct witness {
    pthread_t caller;
    const problem *p;
    buffon_run run; /* without progress, to resume from within */
    const result *expected;
    uint64_t done, total;
    double last_call;
    int calls, early, wrong, foreign, resumed, unlike;
    buffon_estimate last[PROBLEMS_COMPONENTS];
} witness;

/* A partial seen under way, saved, loaded and resumed, gives the same bits. */
static void witness_resume(witness *w, const buffon_partial *partial)
{
    result r = {.partial = {{0}, NULL}};
    size_t size;
    unsigned char *bytes = save(partial, &size);
    if (buffon_partial_load(&r.partial, bytes, size) != BUFFON_OK)
        exit(1);
    solve(&r, w->p, w->run);
    w->resumed++;
    w->unlike += !same_result(w->p, &r, w->expected);
    buffon_partial_free(&r.partial);
    free(bytes);
}

static int watch(const buffon_progress *progress, void *ctx)
{
    witness *w = ctx;
    const double now = clock_now;
    w->foreign += !pthread_equal(pthread_self(), w->caller);
    w->wrong += progress->done <= w->done && w->calls > 0 && progress->done < progress->total;
    w->wrong += progress->done > progress->total || progress->components != w->p->components;
    w->wrong += progress->estimate->samples != progress->done;
    w->wrong += w->calls > 0 && progress->total != w->total && progress->done < progress->total;
    w->early += w->calls > 0 && now - w->last_call < 0.0999 && progress->done < progress->total;
    w->done = progress->done;
    w->total = progress->total;
    w->last_call = now;
    memcpy(w->last, progress->estimate, progress->components * sizeof *w->last);
    if (w->calls++ % 4 == 1)
        witness_resume(w, progress->partial);
    return 0;
}

static void run_backward(size_t tasks, void (*task)(size_t, void *), void *arg, void *ctx)
{
    (void)ctx;
    for (size_t i = tasks; i-- > 0;)
        task(i, arg);
}

static void test_watch(const problem *p, buffon_run run, int with_partial, const char *how)
{
    result expected = {.partial = {{0}, NULL}};
    buffon_partial partial = {0};
    buffon_estimate e[PROBLEMS_COMPONENTS];
    solve(&expected, p, run);
    witness w = {.caller = pthread_self(), .p = p, .run = run, .expected = &expected};
    clock_set(0.02, 0.2);
    run.progress = watch;
    run.progress_ctx = &w;
    if (with_partial)
        run.partial = &partial;
    const buffon_status status = p->solve(e, run);
    tap_ok(status == expected.status && same_estimates(e, expected.e, p->components),
           "%s%s: watching changes no bit", p->name, how);
    tap_ok(w.foreign == 0 && w.calls >= 8, "%s%s: %d calls, all on the caller's thread", p->name,
           how, w.calls);
    tap_ok(w.wrong == 0 && w.done == w.total && w.done == e->samples,
           "%s%s: done grows to the total", p->name, how);
    tap_ok(w.early == 0, "%s%s: at most ten calls a second", p->name, how);
    tap_ok(same_estimates(w.last, e, p->components), "%s%s: the last call has the result", p->name,
           how);
    tap_ok(w.resumed > 0 && w.unlike == 0, "%s%s: what it is shown can be saved and resumed",
           p->name, how);
    buffon_partial_free(&partial);
    buffon_partial_free(&expected.partial);
}

/* A quick run is not held up: rounds grow until they take as long as the callback may wait. */
static void test_rounds(void)
{
    const problem *p = &problems[0];
    buffon_estimate e;
    witness w = {.caller = pthread_self(), .p = p, .calls = 2, .last_call = -1};
    clock_set(1e-5, 1e-5);
    const double before = clock_now;
    const buffon_run run = {.samples = 1000000, .progress = watch, .progress_ctx = &w};
    const buffon_status status = p->solve(&e, run);
    const double looks = (clock_now - before) / 1e-5;
    tap_ok(status == BUFFON_OK && looks < 10 && w.calls <= 4,
           "a thousand quick blocks: two calls, and the clock is looked at %.0f times", looks);
}

static int count_calls(const buffon_progress *progress, void *ctx)
{
    (void)progress;
    ++*(int *)ctx;
    return 1;
}

/* More threads than a round has blocks. */
static void test_crowd(void)
{
    const problem *p = &problems[0];
    buffon_estimate e, alone;
    int calls = 0;
    clock_set(1, 1);
    buffon_run run = {.samples = 40000, .block = 16};
    const buffon_status status = p->solve(&alone, run);
    run.threads = UINT32_MAX;
    run.executor = run_backward;
    run.progress = count_calls;
    run.progress_ctx = &calls;
    tap_ok(p->solve(&e, run) == BUFFON_W_CANCELLED && calls == 1 && e.samples == 16 * 1024,
           "2^32 tasks are no more than a round has blocks");
    run.progress = NULL;
    tap_ok(p->solve(&e, run) == status && same_estimate(&e, &alone), "and change no bit");
}

/* Cancelling where nothing is left, or an error, is no cancel. */
static void test_edges(void)
{
    const problem *p = &problems[0];
    buffon_estimate e, alone;
    int calls = 0;
    clock_set(1, 1);
    buffon_run run = {.samples = 900, .progress = count_calls, .progress_ctx = &calls};
    buffon_status status = p->solve(&e, run);
    run.progress = NULL;
    tap_ok(status == BUFFON_OK && p->solve(&alone, run) == BUFFON_OK && same_estimate(&e, &alone),
           "a run that was done when it was cancelled is done");
    calls = 0;
    run.progress = count_calls;
    run.block = 24;
    tap_ok(p->solve(&e, run) == BUFFON_E_BLOCK && calls == 0, "a refused run makes no progress");
    run.block = 0;
    run.samples = 100000;
    tap_ok(p->solve(&e, run) == BUFFON_W_CANCELLED && e.samples == 1024 && calls == 1,
           "without .partial a cancelled run still gives the estimate of what was done");
    run.progress = NULL;
    run.samples = 1024;
    tap_ok(p->solve(&alone, run) == BUFFON_OK && e.value == alone.value &&
               e.std_error == alone.std_error && e.lo == alone.lo && e.hi == alone.hi,
           "which is that of a run of so many samples");
}

int main(void)
{
    for (int i = 0; i < PROBLEMS; i++) {
        const problem *p = &problems[i];
        const buffon_run run = {.samples = SAMPLES, .seed = 42, .block = 64};
        buffon_run tolerant = {.samples = 60000, .seed = 43, .block = 64, .rel_tol = p->rel_tol};
        test_cancel(p, run, "");
        test_cancel(p, tolerant, ", to a tolerance");
        tolerant.executor = run_backward;
        test_cancel(p, tolerant, ", executor");
        test_cancel_parts(p, run);
    }
    buffon_run run = {.samples = 20000, .seed = 44, .block = 64, .threads = 3};
    test_watch(&problems[0], run, 0, "");
    test_watch(&problems[3], run, 1, ", with a partial");
    run.executor = run_backward;
    test_watch(&problems[8], run, 1, ", executor");
    test_rounds();
    test_crowd();
    test_edges();
    return tap_done();
}
