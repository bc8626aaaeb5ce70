/* Runs that stop at a tolerance: the interval that comes back covers as stated although the run
 * chose when to end, and what is called done is as near as was asked for.
 *
 * A run that looks when it pleases fails the same checks: see check_naive.
 */
#include "binomial.h"

#include <buffon/buffon.h>

enum { SEEDS = 4096, NAIVE_SEEDS = 256, NAIVE_STEP = 1000, NAIVE_MOST = 32 };

/* The share of the squared error that one sample may have where a tolerance is met (Lindeberg). */
#define SHARE_MOST 0.02

/* A run to repeat. */
typedef struct stopping {
    const char *name;
    buffon_status (*run)(buffon_estimate *out, const buffon_run *run);
    double exact;
    double abs_tol, rel_tol, confidence;
    uint64_t samples, seeds;
    const buffon_points *points;
} stopping;

/* ---- integrands on (0, 1) ---- */

static const double unit_lo[] = {0, 0}, unit_hi[] = {1, 1};

static buffon_status unit_uniform(buffon_estimate *out, const buffon_run *run,
                                  int (*batch)(double *f, const double *x, size_t n, void *ctx))
{
    const buffon_integrand f = {.batch = batch, .dim = 1};
    return buffon_uniform(out, &f, unit_lo, unit_hi, run);
}

static int smooth_batch(double *f, const double *x, size_t n, void *ctx)
{
    (void)ctx;
    for (size_t i = 0; i < n; i++)
        f[i] = 1 / (1 + x[i]);
    return 0;
}

static buffon_status smooth_run(buffon_estimate *out, const buffon_run *run)
{
    return unit_uniform(out, run, smooth_batch);
}

/* Exponentially distributed: skewness 2, kurtosis 9. */
static int skewed_batch(double *f, const double *x, size_t n, void *ctx)
{
    (void)ctx;
    for (size_t i = 0; i < n; i++)
        f[i] = -log(x[i]);
    return 0;
}

static buffon_status skewed_run(buffon_estimate *out, const buffon_run *run)
{
    return unit_uniform(out, run, skewed_batch);
}

static int rare_batch(double *f, const double *x, size_t n, void *ctx)
{
    (void)ctx;
    for (size_t i = 0; i < n; i++)
        f[i] = x[i] < 1e-3;
    return 0;
}

static buffon_status rare_run(buffon_estimate *out, const buffon_run *run)
{
    return unit_uniform(out, run, rare_batch);
}

/* Its integral is zero: with a relative tolerance of 1, a run stops when its interval excludes the
 * truth, so every look is a chance to be wrong. */
static int zero_batch(double *f, const double *x, size_t n, void *ctx)
{
    (void)ctx;
    for (size_t i = 0; i < n; i++)
        f[i] = x[i] - 0.5;
    return 0;
}

static buffon_status zero_run(buffon_estimate *out, const buffon_run *run)
{
    return unit_uniform(out, run, zero_batch);
}

static int square_batch(double *f, const double *x, size_t n, void *ctx)
{
    (void)ctx;
    for (size_t i = 0; i < n; i++)
        f[i] = x[i] * x[n + i];
    return 0;
}

static buffon_status square_run(buffon_estimate *out, const buffon_run *run)
{
    const buffon_integrand f = {.batch = square_batch, .dim = 2};
    return buffon_uniform(out, &f, unit_lo, unit_hi, run);
}

static buffon_status square_rejection(buffon_estimate *out, const buffon_run *run)
{
    const buffon_integrand f = {.batch = square_batch, .dim = 2};
    return buffon_rejection(out, &f, unit_lo, unit_hi, 1, run);
}

/* The same again, over (0, 1/4): one point in 250 hits. */
static buffon_status rare_rejection(buffon_estimate *out, const buffon_run *run)
{
    const buffon_integrand f = {.batch = rare_batch, .dim = 1};
    return buffon_rejection(out, &f, unit_lo, (const double[]){0.25}, 1, run);
}

/* ---- the check ---- */

static double tolerance_of(const stopping *t, const buffon_estimate *e)
{
    const double relative = t->rel_tol * fabs(e->value);
    return relative > t->abs_tol ? relative : t->abs_tol;
}

/* Two levels are read off each run, the second from its partial result: 0.6827 of those that
 * stopped at 0.95, or the other way round. `wrong` are those that stopped further off than they
 * may. */
static void check_stopping(const stopping *t)
{
    const double other = t->confidence == 0.95 ? 0.6827 : 0.95;
    uint64_t covered = 0, covered_other = 0, done = 0, wrong = 0, points = 0;
    int consistent = 1;
    char what[100];
    for (uint64_t seed = 0; seed < t->seeds; seed++) {
        buffon_partial partial = {{0}, NULL};
        const buffon_run run = {.samples = t->samples,
                                .seed = seed,
                                .abs_tol = t->abs_tol,
                                .rel_tol = t->rel_tol,
                                .confidence = t->confidence,
                                .points = t->points,
                                .partial = &partial};
        buffon_estimate e, o;
        const buffon_status status = t->run(&e, &run);
        const int late = (e.doubts & BUFFON_DOUBT(BUFFON_W_TOLERANCE)) != 0;
        const double tolerance = tolerance_of(t, &e);
        covered += e.lo <= t->exact && t->exact <= e.hi;
        done += status == BUFFON_OK;
        wrong += !late && !(fabs(e.value - t->exact) <= tolerance);
        points += e.samples;
        consistent &= status >= 0 && (late || (e.hi - e.lo) / 2 <= tolerance);
        consistent &= late || e.interval != BUFFON_INTERVAL_STUDENT || !(e.max_share > SHARE_MOST);
        consistent &= buffon_partial_estimate(&o, &partial, other) >= 0 && o.value == e.value;
        covered_other += o.lo <= t->exact && t->exact <= o.hi;
        buffon_partial_free(&partial);
    }
    tap_ok(consistent, "%s: %.3f are done, at %.0f points on average, and look it", t->name,
           (double)done / (double)t->seeds, (double)points / (double)t->seeds);
    snprintf(what, sizeof what, "%s: covers", t->name);
    binomial_ok(covered, t->seeds, t->confidence, 1, what);
    snprintf(what, sizeof what, "%s: covers at %.4f", t->name, other);
    binomial_ok(covered_other, t->seeds, other, 1, what);
    snprintf(what, sizeof what, "%s: is not wrong", t->name);
    binomial_ok(t->seeds - wrong, t->seeds, t->confidence, 1, what);
}

/* Tolerances are chosen such that some runs stop at their first look and others go on. */
static void check_tolerances(void)
{
    const buffon_points jitter = buffon_points_jitter(5);
    buffon_points replicates = buffon_points_random();
    replicates.design = BUFFON_DESIGN_REPLICATES;
    replicates.replicates = 8;
    const stopping list[] = {
        {"smooth", smooth_run, log(2), 0.0037, 0, 0.95, 1 << 15, SEEDS, NULL},
        {"skewed", skewed_run, 1, 0.0265, 0, 0.95, 1 << 15, SEEDS, NULL},
        {"p = 1e-3 to 30 %", rare_run, 1e-3, 0, 0.3, 0.95, 1 << 17, SEEDS, NULL},
        {"p = 1e-3 to 10 %", rare_run, 1e-3, 0, 0.1, 0.95, 1 << 20, SEEDS / 16, NULL},
        {"zero", zero_run, 0, 0, 1, 0.6827, 1 << 15, SEEDS, NULL},
        {"rejection", square_rejection, 0.25, 0, 0.045, 0.95, 1 << 15, SEEDS, NULL},
        {"rejection, p = 4e-3", rare_rejection, 1e-3, 0, 0.2, 0.6827, 1 << 15, SEEDS, NULL},
        {"replicates", smooth_run, log(2), 0.005, 0, 0.95, 1 << 15, SEEDS, &replicates},
        {"jitter, within a sweep", square_run, 0.25, 0.0073, 0, 0.95, 1 << 14, SEEDS / 8, &jitter}};
    for (size_t i = 0; i < sizeof list / sizeof *list; i++)
        check_stopping(&list[i]);
}

/* Where nothing was hit, nothing is known to any tolerance; unless the caller knows it. */
static void check_no_spread(void)
{
    const uint32_t doubts = BUFFON_DOUBT(BUFFON_W_NO_SPREAD) | BUFFON_DOUBT(BUFFON_W_TOLERANCE);
    for (uint64_t seed = 0; seed < 4; seed++) {
        buffon_run run = {.samples = 20000, .seed = seed, .abs_tol = 1e9, .rel_tol = 1};
        const buffon_integrand f = {.batch = rare_batch, .dim = 1};
        const double hi[] = {1e9}; /* so no point of these seeds is below 1e-3 */
        buffon_estimate e;
        buffon_status status = buffon_uniform(&e, &f, unit_lo, hi, &run);
        tap_ok(status == BUFFON_W_NO_SPREAD && e.doubts == doubts && e.samples == 20000,
               "no hit, no tolerance: average");
        status = buffon_rejection(&e, &f, unit_lo, hi, 1, &run);
        tap_ok(status == BUFFON_W_NO_SPREAD && e.doubts == doubts && e.samples == 20000,
               "no hit, no tolerance: rejection");
        run.constant = 1;
        status = buffon_uniform(&e, &f, unit_lo, hi, &run);
        tap_ok(status == BUFFON_OK && e.samples == 8192, "a known constant is done at once");
    }
}

/* What the check above would say of a run that looks after every thousand points, with an interval
 * that takes no account of it, at the same integrand and tolerance as "zero". */
static void check_naive(void)
{
    uint64_t covered = 0;
    for (uint64_t seed = 0; seed < NAIVE_SEEDS; seed++) {
        buffon_rng rng = buffon_rng_make(seed, 0);
        buffon_stats s = {0};
        buffon_estimate e = {.value = 0};
        int done = 0;
        for (unsigned look = 0; look < NAIVE_MOST && !done; look++) {
            double u[NAIVE_STEP];
            buffon_rng_fill(u, NAIVE_STEP, &rng);
            for (size_t i = 0; i < NAIVE_STEP; i++)
                u[i] -= 0.5;
            buffon_stats_add(&s, u, NAIVE_STEP);
            done = buffon_stats_estimate(&e, &s, 0.95) == BUFFON_OK &&
                   (e.hi - e.lo) / 2 <= fabs(e.value);
        }
        covered += e.lo <= 0 && 0 <= e.hi;
    }
    tap_ok(binomial_between(0, covered, NAIVE_SEEDS, 0.95) < LAW_ALPHA,
           "looking as one pleases covers %.3f, and the check sees that it is not 0.95",
           (double)covered / NAIVE_SEEDS);
}

static int cancel_always(const buffon_progress *progress, void *ctx)
{
    (void)progress;
    (void)ctx;
    return 1;
}

/* A stratum so small that its only block, a short one, is done at the first look: the looks after
 * it take place all the same, and a run that was cancelled finds them again. */
static void check_small_stratum(double abs_tol, uint64_t samples)
{
    const buffon_density box = buffon_box(unit_lo, unit_hi, 2);
    const buffon_stratum stratum[] = {{.density = &box, .weight = 1e-3, .share = 1e-3},
                                      {.density = &box}};
    const buffon_strata strata = {.stratum = stratum, .count = 2};
    const buffon_integrand f = {.batch = square_batch, .dim = 2};
    buffon_partial partial = {{0}, NULL};
    buffon_run run = {.samples = 200000, .abs_tol = abs_tol};
    buffon_estimate whole, e;
    buffon_status status = buffon_stratified(&whole, &f, &strata, &run);
    tap_ok(status == BUFFON_OK && whole.samples == samples + 200,
           "a small stratum: stops at %llu samples", (unsigned long long)whole.samples);
    run.partial = &partial;
    run.progress = cancel_always;
    for (int k = 0; k < 4; k++)
        status = buffon_stratified(&e, &f, &strata, &run);
    run.progress = NULL;
    status = buffon_stratified(&e, &f, &strata, &run);
    tap_ok(status == BUFFON_OK && e.samples == whole.samples && e.value == whole.value &&
               e.lo == whole.lo && e.hi == whole.hi,
           "and where it was cancelled too");
    buffon_partial_free(&partial);
}

int main(void)
{
    check_tolerances();
    check_small_stratum(0.0075, 8192);
    check_small_stratum(0.005, 16384);
    check_no_spread();
    check_naive();
    return tap_done();
}
