/* A run that meets a bad point says which: the lowest index, whoever computes; and buffon_sample_at
 * gives that point back. */
#define _POSIX_C_SOURCE 200809L

#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <time.h>

#include "leap.h"
#include "problems.h"
#include "tap.h"

#define TRAPS 3

/* An integrand that misbehaves at given points. */
typedef struct trap {
    size_t dim, count;
    double x[TRAPS][4];
    double value[TRAPS]; /* what it says there */
} trap;

/* Which trap is at point i of n? */
static int trap_at(const trap *t, const double *x, size_t n, size_t i)
{
    for (size_t k = 0; k < t->count; k++) {
        int equal = 1;
        for (size_t j = 0; j < t->dim; j++)
            equal &= x[j * n + i] == t->x[k][j];
        if (equal)
            return (int)k;
    }
    return -1;
}

static double trap_scalar(const double *x, void *ctx)
{
    const trap *t = ctx;
    const int k = trap_at(t, x, 1, 0);
    return k < 0 ? 0.5 + x[0] / 8 : t->value[k];
}

/* Component 1 of 2 misbehaves. */
static int trap_batch(double *f, const double *x, size_t n, void *ctx)
{
    const trap *t = ctx;
    for (size_t i = 0; i < n; i++) {
        const int k = trap_at(t, x, n, i);
        f[i] = x[i];
        f[n + i] = k < 0 ? 1 - x[i] : t->value[k];
    }
    return 0;
}

static int trap_stop(double *f, const double *x, size_t n, void *ctx)
{
    int stop = 0;
    for (size_t i = 0; i < n; i++) {
        stop |= trap_at(ctx, x, n, i) >= 0;
        f[i] = 1;
    }
    return stop;
}

static void run_backward(size_t tasks, void (*task)(size_t, void *), void *arg, void *ctx)
{
    (void)ctx;
    for (size_t i = tasks; i-- > 0;)
        task(i, arg);
}

/* The n-th way to run: one thread, several, an executor. */
static void vary(buffon_run *run, int n)
{
    static const uint32_t threads[] = {0, 2, 3, 7, 7};
    run->threads = threads[n];
    run->executor = n == 4 ? run_backward : NULL;
}

enum { WAYS = 5 };

static int is_failure(const buffon_estimate *e, size_t components, buffon_status status,
                      uint64_t index, uint64_t stratum)
{
    int good = 1;
    for (size_t k = 0; k < components; k++)
        good &= is_refusal(&e[k], status) && e[k].bad_index == index && e[k].bad_stratum == stratum;
    return good;
}

/* ---- uniform ---- */

static void trap_set(trap *t, const buffon_density *g, const uint64_t *index, double value,
                     const buffon_run *run)
{
    for (size_t k = 0; k < t->count; k++) {
        t->value[k] = value;
        if (buffon_sample_at(t->x[k], g, index[k], run) != BUFFON_OK)
            exit(1);
    }
}

static void test_nonfinite(const char *name, const buffon_points *points, const uint64_t *index,
                           uint64_t lowest)
{
    const double lo[] = {0, -1}, hi[] = {3, 1};
    const buffon_density box = buffon_box(lo, hi, 2);
    trap t = {.dim = 2, .count = TRAPS};
    const buffon_integrand scalar = {.scalar = trap_scalar, .dim = 2, .ctx = &t};
    const buffon_integrand batch = {.batch = trap_batch, .dim = 2, .components = 2, .ctx = &t};
    static const double values[] = {NAN, INFINITY, -INFINITY};
    buffon_run run = {.samples = 20000, .seed = 3, .stream = 9, .points = points};
    buffon_estimate e[2];
    for (int v = 0; v < 3; v++) {
        int good = 1;
        trap_set(&t, &box, index, values[v], &run);
        for (int n = 0; n < WAYS; n++) {
            vary(&run, n);
            good &= buffon_uniform(e, &scalar, lo, hi, &run) == BUFFON_E_NONFINITE;
            good &= is_failure(e, 1, BUFFON_E_NONFINITE, lowest, 0);
            good &= buffon_uniform(e, &batch, lo, hi, &run) == BUFFON_E_NONFINITE;
            good &= is_failure(e, 2, BUFFON_E_NONFINITE, lowest, 0);
        }
        tap_ok(good, "%s: %g is met first at index %llu", name, values[v],
               (unsigned long long)lowest);
        vary(&run, 0);
        run.on_nonfinite = BUFFON_NONFINITE_ZERO;
        good = buffon_uniform(e, &batch, lo, hi, &run) == BUFFON_W_NONFINITE;
        good &= e[0].nonfinite == 0 && e[1].nonfinite == TRAPS && e[0].status != BUFFON_W_NONFINITE;
        trap_set(&t, &box, index, 0, &run);
        buffon_estimate zero[2];
        run.on_nonfinite = BUFFON_NONFINITE_ERROR;
        good &= buffon_uniform(zero, &batch, lo, hi, &run) >= 0;
        good &= zero[1].value == e[1].value && zero[1].std_error == e[1].std_error;
        tap_ok(good && same_estimate(&e[0], &zero[0]),
               "%s: by option it counts as zero, and is counted", name);
    }
}

static void test_uniform(void)
{
    static const uint64_t index[TRAPS] = {19999, 2777, 12345}, ends[TRAPS] = {19999, 19998, 17000};
    static const uint64_t first[TRAPS] = {0, 1, 2}, last[TRAPS] = {19999, 19999, 19999};
    const buffon_points pairs = buffon_points_antithetic(), jitter = buffon_points_jitter(10);
    const buffon_points kronecker = problem_kronecker();
    test_nonfinite("random points", NULL, index, 2777);
    test_nonfinite("random points, the short block", NULL, ends, 17000);
    test_nonfinite("random points, the first", NULL, first, 0);
    test_nonfinite("antithetic pairs", &pairs, index, 2777);
    test_nonfinite("jittered points", &jitter, index, 2777);
    /* A block holds points of one replicate: index 12345 is point 1543 of replicate 1, 2777 is
     * point 347 of replicate 1, in an earlier block. */
    test_nonfinite("replicates", &kronecker, index, 2777);
    trap t = {.dim = 1, .count = 1};
    const double lo = 0, hi = 1;
    const buffon_density box = buffon_box(&lo, &hi, 1);
    const buffon_integrand f = {.scalar = trap_scalar, .dim = 1, .ctx = &t};
    buffon_run run = {.samples = 20000};
    buffon_estimate e;
    trap_set(&t, &box, last, NAN, &run);
    tap_ok(buffon_uniform(&e, &f, &lo, &hi, &run) == BUFFON_E_NONFINITE && e.bad_index == 19999,
           "the last point of all");
    run.samples = 19999;
    tap_ok(buffon_uniform(&e, &f, &lo, &hi, &run) == BUFFON_OK && e.bad_index == UINT64_MAX &&
               e.nonfinite == 0,
           "one point fewer, and there is no failure");
}

static void test_stopped(void)
{
    static const uint64_t index[TRAPS] = {19999, 2777, 12345};
    const double lo[] = {0, -1}, hi[] = {3, 1};
    const buffon_density box = buffon_box(lo, hi, 2);
    trap t = {.dim = 2, .count = TRAPS};
    const buffon_integrand f = {.batch = trap_stop, .dim = 2, .ctx = &t};
    buffon_run run = {.samples = 20000, .seed = 4};
    buffon_estimate e;
    int good = 1;
    trap_set(&t, &box, index, 0, &run);
    for (int n = 0; n < WAYS; n++) {
        vary(&run, n);
        good &= buffon_uniform(&e, &f, lo, hi, &run) == BUFFON_E_STOPPED;
        good &= is_failure(&e, 1, BUFFON_E_STOPPED, 2048, 0);
    }
    tap_ok(good, "a batch that asks to stop: the first point of the first such block");
}

/* Two threads fail, the one with the lower index after the other, and in a block that it begins
 * after that: in the block before it waits until the other is at its trap, or two seconds where
 * there is no other thread. */
typedef struct race {
    double wait, first, second; /* x of the point to wait at, and of the traps */
    atomic_int seen;
} race;

static double race_scalar(const double *x, void *ctx)
{
    race *r = ctx;
    if (x[0] == r->second)
        atomic_store(&r->seen, 1);
    if (x[0] != r->wait)
        return x[0] == r->first || x[0] == r->second ? NAN : 1;
    const time_t start = time(NULL);
    while (!atomic_load(&r->seen) && time(NULL) <= start + 1)
        sched_yield();
    for (int i = 0; i < 1000; i++) /* until the other has ended */
        sched_yield();
    return 1;
}

static void test_race(void)
{
    const double lo = 0, hi = 1;
    const buffon_density box = buffon_box(&lo, &hi, 1);
    race r = {0, 0, 0, 0};
    const buffon_integrand f = {.scalar = race_scalar, .dim = 1, .ctx = &r};
    const buffon_run run = {.samples = 40000, .seed = 3, .threads = 2};
    buffon_estimate e;
    if (buffon_sample_at(&r.wait, &box, 1000, &run) != BUFFON_OK ||
        buffon_sample_at(&r.first, &box, 1500, &run) != BUFFON_OK ||
        buffon_sample_at(&r.second, &box, 20480, &run) != BUFFON_OK)
        exit(1);
    tap_ok(buffon_uniform(&e, &f, &lo, &hi, &run) == BUFFON_E_NONFINITE && e.bad_index == 1500,
           "of two failures the one that came later has the lower index, and counts");
}

/* ---- rejection ---- */

static void test_bound(void)
{
    static const uint64_t index[TRAPS] = {19999, 2777, 12345};
    const double lo[] = {0, -1}, hi[] = {3, 1}, under[] = {0, -1, 0}, over[] = {3, 1, 1.5};
    const buffon_density box = buffon_box(under, over, 3);
    trap t = {.dim = 2, .count = TRAPS};
    const buffon_integrand f = {.scalar = trap_scalar, .dim = 2, .ctx = &t};
    static const double values[] = {1.5000000000000002, -0x1p-1074, 1e300, NAN};
    buffon_run run = {.samples = 20000, .seed = 4};
    buffon_estimate e;
    for (int v = 0; v < 4; v++) {
        const buffon_status status = v < 3 ? BUFFON_E_BOUND : BUFFON_E_NONFINITE;
        int good = 1;
        trap_set(&t, &box, index, values[v], &run); /* t.x holds the coordinates but the last */
        for (int n = 0; n < WAYS; n++) {
            vary(&run, n);
            good &= buffon_rejection(&e, &f, lo, hi, 1.5, &run) == status;
            good &= is_failure(&e, 1, status, 2777, 0);
        }
        tap_ok(good, "rejection: f = %g is seen at index 2777", values[v]);
    }
    trap_set(&t, &box, index, 1.5, &run);
    tap_ok(buffon_rejection(&e, &f, lo, hi, 1.5, &run) == BUFFON_OK, "f = h is within the bound");
    trap_set(&t, &box, index, 0.0, &run);
    tap_ok(buffon_rejection(&e, &f, lo, hi, 1.5, &run) == BUFFON_OK, "so is f = 0");
    t.value[0] = 9;   /* index 19999 */
    t.value[1] = 1;   /* index 2777: none */
    t.value[2] = NAN; /* index 12345 */
    tap_ok(buffon_rejection(&e, &f, lo, hi, 1.5, &run) == BUFFON_E_NONFINITE &&
               e.bad_index == 12345,
           "of different failures the lowest counts");
}

/* ---- densities ---- */

/* Uniform on (0, 1)^2 but for a pdf that is wrong at a trap. ctx: the trap. */
static int trap_sample(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    const trap *t = g->ctx;
    memcpy(x, u, 2 * n * sizeof *x);
    for (size_t i = 0; pdf != NULL && i < n; i++) {
        const int k = trap_at(t, x, n, i);
        pdf[i] = k < 0 ? 1 : t->value[k];
    }
    return 0;
}

static int trap_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    (void)x;
    (void)g;
    for (size_t i = 0; i < n; i++)
        pdf[i] = 1;
    return 0;
}

/* Fails where it meets a trap, and makes that point NaN. */
static int trap_fail(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    int result = 0;
    memcpy(x, u, 2 * n * sizeof *x);
    for (size_t i = 0; i < n; i++) {
        if (pdf != NULL)
            pdf[i] = 1;
        if (trap_at(g->ctx, u, n, i) >= 0) {
            x[n + i] = NAN;
            result = 1;
        }
    }
    return result;
}

static const buffon_density_ops trap_ops = {.sample = trap_sample, .pdf = trap_pdf};
static const buffon_density_ops trap_fail_ops = {.sample = trap_fail, .pdf = trap_pdf};

static double sum_scalar(const double *x, void *ctx)
{
    (void)ctx;
    return x[0] + x[1];
}

static double zero_scalar(const double *x, void *ctx)
{
    (void)x;
    (void)ctx;
    return 0;
}

static void test_pdf(void)
{
    static const uint64_t index[TRAPS] = {19999, 2777, 12345};
    const double lo[] = {0, 0}, hi[] = {1, 1};
    const buffon_density box = buffon_box(lo, hi, 2);
    trap t = {.dim = 2, .count = TRAPS};
    const buffon_density g = {.uniforms = 2, .dim = 2, .ops = &trap_ops, .ctx = &t};
    const buffon_density failing = {.uniforms = 2, .dim = 2, .ops = &trap_fail_ops, .ctx = &t};
    const buffon_integrand f = {.scalar = sum_scalar, .dim = 2};
    const buffon_integrand zero = {.scalar = zero_scalar, .dim = 2};
    static const double values[] = {0, NAN, -1, INFINITY};
    buffon_run run = {.samples = 20000, .seed = 4};
    buffon_estimate e;
    for (int v = 0; v < 4; v++) {
        int good = 1;
        trap_set(&t, &box, index, values[v], &run);
        for (int n = 0; n < WAYS; n++) {
            vary(&run, n);
            good &= buffon_importance(&e, &f, &g, &run) == BUFFON_E_PDF;
            good &= is_failure(&e, 1, BUFFON_E_PDF, 2777, 0);
            good &= buffon_self_normalised(&e, &f, &f, &g, &run) == BUFFON_E_PDF;
            good &= is_failure(&e, 1, BUFFON_E_PDF, 2777, 0);
        }
        tap_ok(good, "importance: g = %g where f is not zero is seen at index 2777", values[v]);
    }
    trap_set(&t, &box, index, 0, &run);
    tap_ok(buffon_importance(&e, &zero, &g, &run) == BUFFON_W_NO_SPREAD && e.value == 0,
           "0 / 0 counts as zero");
    trap_set(&t, &box, index, NAN, &run);
    tap_ok(buffon_importance(&e, &zero, &g, &run) == BUFFON_E_PDF, "0 / NaN does not");
    int good = 1;
    for (int n = 0; n < WAYS; n++) {
        vary(&run, n);
        good &= buffon_importance(&e, &f, &failing, &run) == BUFFON_E_PDF;
        good &= is_failure(&e, 1, BUFFON_E_PDF, 2777, 0);
    }
    tap_ok(good, "a density that fails, at the point that it made NaN");
}

static double negative_weight(const double *x, void *ctx)
{
    return trap_at(ctx, x, 1, 0) >= 0 ? -1e-300 : 1;
}

static void test_negative_weight(void)
{
    static const uint64_t index[TRAPS] = {19999, 2777, 12345};
    const double lo[] = {0, 0}, hi[] = {1, 1};
    const buffon_density box = buffon_box(lo, hi, 2);
    trap t = {.dim = 2, .count = TRAPS};
    const buffon_integrand h = {.scalar = sum_scalar, .dim = 2};
    const buffon_integrand p = {.scalar = negative_weight, .dim = 2, .ctx = &t};
    const buffon_integrand none = {.scalar = zero_scalar, .dim = 2};
    const buffon_run run = {.samples = 20000, .threads = 3};
    buffon_partial partial = {0};
    buffon_run keep = run;
    buffon_estimate e;
    trap_set(&t, &box, index, 0, &run);
    tap_ok(buffon_self_normalised(&e, &h, &p, &box, &run) == BUFFON_E_BOUND &&
               is_failure(&e, 1, BUFFON_E_BOUND, 2777, 0),
           "a negative weight");
    keep.partial = &partial;
    tap_ok(buffon_self_normalised(&e, &h, &none, &box, &keep) == BUFFON_E_EMPTY &&
               is_failure(&e, 1, BUFFON_E_EMPTY, UINT64_MAX, 0),
           "no weight at all");
    tap_ok(buffon_partial_estimate(&e, &partial, 0) == BUFFON_E_EMPTY &&
               is_failure(&e, 1, BUFFON_E_EMPTY, UINT64_MAX, 0),
           "its partial says the same");
    buffon_partial_free(&partial);
}

/* ---- strata ---- */

static void test_strata(void)
{
    const double lo[3] = {0, 1, 2}, hi[3] = {1, 2, 4};
    const buffon_density box[3] = {buffon_box(&lo[0], &hi[0], 1), buffon_box(&lo[1], &hi[1], 1),
                                   buffon_box(&lo[2], &hi[2], 1)};
    const buffon_stratum list[] = {
        {.density = &box[0]}, {.density = &box[1]}, {.density = &box[2]}};
    buffon_strata strata = {.stratum = list, .count = 3};
    trap t = {.dim = 1, .count = 2, .value = {NAN, NAN}};
    const buffon_integrand f = {.scalar = trap_scalar, .dim = 1, .ctx = &t};
    buffon_run run = {.samples = 30000, .seed = 11};
    buffon_estimate e;
    int good = buffon_stratum_sample_at(t.x[0], &strata, 2, 5000, &run) == BUFFON_OK;
    good &= buffon_stratum_sample_at(t.x[1], &strata, 1, 8000, &run) == BUFFON_OK;
    good &= t.x[0][0] > 2 && t.x[1][0] > 1 && t.x[1][0] < 2;
    for (int n = 0; n < WAYS; n++) {
        vary(&run, n);
        good &= buffon_stratified(&e, &f, &strata, &run) == BUFFON_E_NONFINITE;
        good &= is_failure(&e, 1, BUFFON_E_NONFINITE, 5000, 2);
    }
    tap_ok(good, "a point of a stratum, which is named");
    strata.allocation = BUFFON_ALLOCATION_NEYMAN;
    tap_ok(buffon_stratified(&e, &f, &strata, &run) == BUFFON_E_NONFINITE && e.bad_index == 5000 &&
               e.bad_stratum == 2,
           "the same with a pilot, whose points are others");
}

/* The pilot has points of its own: a trap at the first of the run is none for it. And a pilot
 * that is stopped names no point. */
static void test_pilot(void)
{
    const buffon_density box = buffon_segment(0, 1);
    const buffon_stratum list[] = {{.density = &box}, {.density = &box}};
    const buffon_strata strata = {
        .stratum = list, .count = 2, .allocation = BUFFON_ALLOCATION_NEYMAN, .pilot = 100};
    trap t = {.dim = 1, .count = 1};
    const buffon_integrand f = {.batch = trap_stop, .dim = 1, .ctx = &t};
    const buffon_run run = {.samples = 4000, .seed = 12, .block = 16};
    buffon_estimate e;
    if (buffon_stratum_sample_at(t.x[0], &strata, 1, 20, &run) != BUFFON_OK)
        exit(1);
    tap_ok(buffon_stratified(&e, &f, &strata, &run) == BUFFON_E_STOPPED &&
               is_failure(&e, 1, BUFFON_E_STOPPED, 16, 1),
           "a pilot does not meet the points of the run");
    const buffon_rng_key key = {
        .seed = 12, .purpose = BUFFON_PURPOSE_PILOT, .replicate = 0, .stratum = 1};
    buffon_rng_uniforms_at(t.x[0], 1, &key, 0, 20);
    tap_ok(buffon_stratified(&e, &f, &strata, &run) == BUFFON_E_STOPPED &&
               is_failure(&e, 1, BUFFON_E_STOPPED, UINT64_MAX, 0),
           "a failure of the pilot names no point of the run");
}

/* ---- what is left ---- */

/* A run that fails late leaves what was done; when the cause is mended it goes on from there. */
static void test_resume(void)
{
    static const uint64_t index[1] = {30000};
    const double lo[] = {0, -1}, hi[] = {3, 1};
    const buffon_density box = buffon_box(lo, hi, 2);
    trap t = {.dim = 2, .count = 1};
    const buffon_integrand f = {.scalar = trap_scalar, .dim = 2, .ctx = &t};
    buffon_partial partial = {0};
    buffon_run run = {.samples = 40000, .block = 16, .threads = 3, .partial = &partial};
    buffon_estimate e, kept, alone;
    trap_set(&t, &box, index, NAN, &run);
    tap_ok(buffon_uniform(&e, &f, lo, hi, &run) == BUFFON_E_NONFINITE && e.bad_index == 30000,
           "a failure in the second round of blocks");
    tap_ok(buffon_partial_estimate(&kept, &partial, 0) == BUFFON_W_INCOMPLETE &&
               kept.samples == 16 * 1024,
           "what was done before is kept");
    t.count = 0;
    buffon_status status = buffon_uniform(&e, &f, lo, hi, &run);
    run.partial = NULL;
    tap_ok(status == buffon_uniform(&alone, &f, lo, hi, &run) && same_estimate(&e, &alone),
           "and gone on from");
    buffon_partial_free(&partial);
}

int main(void)
{
    test_uniform();
    test_stopped();
    test_race();
    test_bound();
    test_pdf();
    test_negative_weight();
    test_strata();
    test_pilot();
    test_resume();
    return tap_done();
}
