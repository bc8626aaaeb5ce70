/* Estimates from Sobol' points: intervals that cover, errors that fall fast, numbers of points that
 * are powers of two, and the same bits whatever the threads, parts, looks and interruptions. */
#include <stdlib.h>

#include <buffon/buffon.h>

#include "binomial.h"
#include "integrands.h"
#include "problems.h"
#include "record.h"

#define COUNT(array) (sizeof(array) / sizeof *(array))

static const double lo[] = {0, 0, 0, 0, 0, 0}, hi[] = {1, 1, 1, 1, 1, 1};

static int is_power(uint64_t n)
{
    return n > 0 && (n & (n - 1)) == 0;
}

static void must_run(buffon_status status, const char *name)
{
    if (status < 0) {
        printf("Bail out! %s: %s\n", name, buffon_status_string(status));
        exit(1);
    }
}

/* ---- intervals ---------------------------------------------------------------------------- */

enum { GENZ_DIM = 5, GENZ = 6 };

/* The families of Genz, from exact_values.csv: the discontinuous one in two dimensions, the others
 * in five. */
static const struct {
    const char *name;
    double (*f)(const double *x, size_t dim);
    size_t dim;
    double exact;
} genz[GENZ] = {{"oscillatory", genz_oscillatory, 5, 0.56673906320480859508},
                {"product peak", genz_product_peak, 5, 3901.7486263338889417},
                {"corner peak", genz_corner_peak, 5, 0.019907420523996069575},
                {"Gaussian", genz_gaussian, 5, 0.028306726720449704941},
                {"C0", genz_c0, 5, 0.018404913546477759913},
                {"discontinuous", genz_discontinuous, 2, 5.7875210945361465302}};

static int genz_batch(double *f, const double *x, size_t n, void *ctx)
{
    (void)ctx;
    for (size_t i = 0; i < n; i++) {
        double point[GENZ_DIM];
        for (size_t j = 0; j < GENZ_DIM; j++)
            point[j] = x[j * n + i];
        for (size_t k = 0; k < GENZ; k++)
            f[k * n + i] = genz[k].f(point, genz[k].dim);
    }
    return 0;
}

/* Intervals of 8 replicates of 64 points cover as stated, estimates are unbiased, and the squared
 * standard error has the variance of the estimates for its mean. */
static void test_coverage(void)
{
    enum { SEEDS = 4000, POINTS = 64, REPLICATES = 8 };
    const buffon_points sobol = buffon_points_sobol(BUFFON_SCRAMBLE_OWEN);
    const buffon_integrand f = {.batch = genz_batch, .dim = GENZ_DIM, .components = GENZ};
    uint64_t covered[GENZ] = {0};
    double sum[GENZ] = {0}, sum2[GENZ] = {0}, sum4[GENZ] = {0}, se2[GENZ] = {0}, plain[GENZ] = {0};
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        buffon_estimate e[GENZ];
        const buffon_run run = {.samples = REPLICATES * POINTS, .seed = seed, .points = &sobol};
        must_run(buffon_uniform(e, &f, lo, hi, &run), "coverage");
        for (size_t k = 0; k < GENZ; k++) {
            const double d = e[k].value - genz[k].exact;
            covered[k] += e[k].lo <= genz[k].exact && genz[k].exact <= e[k].hi;
            sum[k] += d;
            sum2[k] += d * d;
            sum4[k] += d * d * d * d;
            se2[k] += e[k].std_error * e[k].std_error;
            plain[k] += e[k].variance / (double)e[k].samples;
        }
    }
    for (size_t k = 0; k < GENZ; k++) {
        const double share = (double)covered[k] / SEEDS, variance = sum2[k] / SEEDS;
        const double excess = sum4[k] / SEEDS / (variance * variance) - 1;
        tap_ok(share > 0.925 && share < 0.975, "%s: intervals of 95 %% cover %.2f %%", genz[k].name,
               100 * share);
        tap_ok(fabs(sum[k] / SEEDS) < BINOMIAL_SIGMAS * sqrt(variance / SEEDS),
               "%s: unbiased (%.2f sigma)", genz[k].name, sum[k] / SEEDS / sqrt(variance / SEEDS));
        /* A squared error of 7 degrees of freedom has a variance of 2/7 of its square. */
        tap_ok(fabs(se2[k] / sum2[k] - 1) < BINOMIAL_SIGMAS * sqrt((excess + 1) / SEEDS),
               "%s: std_error^2 is %.3f of the variance", genz[k].name, se2[k] / sum2[k]);
        tap_ok(plain[k] > 1.5 * sum2[k], "%s: the variance is %.1f times below that of Monte Carlo",
               genz[k].name, plain[k] / sum2[k]);
    }
}

static int square_batch(double *f, const double *x, size_t n, void *ctx)
{
    (void)ctx;
    for (size_t i = 0; i < n; i++)
        f[i] = x[i] * x[i] / (1 + x[n + i]);
    return 0;
}

/* Runs that stop at a tolerance cover it, with a power of two of points in each replicate. */
static void test_stopping(uint32_t replicates)
{
    enum { SEEDS = 300 };
    const double exact = 0.69314718055994530942 / 3;
    const buffon_integrand f = {.batch = square_batch, .dim = 2};
    buffon_points sobol = buffon_points_sobol(BUFFON_SCRAMBLE_OWEN);
    uint64_t covered = 0, missed = 0, odd = 0, early = 0;
    sobol.replicates = replicates;
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        buffon_estimate e;
        const buffon_run run = {
            .samples = 1 << 16, .seed = seed, .points = &sobol, .abs_tol = 6e-6};
        must_run(buffon_uniform(&e, &f, lo, hi, &run), "stopping");
        covered += e.lo <= exact && exact <= e.hi;
        missed += e.status == BUFFON_OK && !((e.hi - e.lo) / 2 <= 6e-6);
        odd += e.samples % replicates != 0 || !is_power(e.samples / replicates);
        early += e.status == BUFFON_OK && e.samples < 1 << 16;
    }
    tap_ok(odd == 0 && missed == 0 && early > SEEDS / 2,
           "%u replicates: %llu of %d runs stop before the end, at powers of two",
           (unsigned)replicates, (unsigned long long)early, SEEDS);
    binomial_ok(covered, SEEDS, 0.95, 1, "a stopped run covers");
}

/* ---- convergence -------------------------------------------------------------------------- */

static int product_batch(double *f, const double *x, size_t n, void *ctx)
{
    (void)ctx;
    for (size_t i = 0; i < n; i++) {
        f[i] = 1;
        for (size_t j = 0; j < 6; j++)
            f[i] *= 1 + (x[j * n + i] - 0.5) / 2;
    }
    return 0;
}

/* The root mean square of the errors over seeds. */
static double product_error(const buffon_points *points, uint64_t samples)
{
    enum { SEEDS = 24 };
    const buffon_integrand f = {.batch = product_batch, .dim = 6};
    double sum2 = 0;
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        buffon_estimate e;
        const buffon_run run = {.samples = samples, .seed = seed, .points = points};
        must_run(buffon_uniform(&e, &f, lo, hi, &run), "convergence");
        sum2 += (e.value - 1) * (e.value - 1);
    }
    return sqrt(sum2 / SEEDS);
}

static void test_convergence(void)
{
    const uint64_t few = 8 << 6, many = 8 << 13;
    const buffon_points owen = buffon_points_sobol(BUFFON_SCRAMBLE_OWEN);
    const buffon_points linear = buffon_points_sobol(BUFFON_SCRAMBLE_LINEAR);
    const double nested = log(product_error(&owen, many) / product_error(&owen, few)) / log(128);
    const double matrix =
        log(product_error(&linear, many) / product_error(&linear, few)) / log(128);
    const double plain = log(product_error(NULL, many) / product_error(NULL, few)) / log(128);
    tap_ok(nested < -1.3, "six dimensions, smooth: the error falls as N^%.2f (Owen)", nested);
    tap_ok(matrix < -1.3, "as N^%.2f (linear)", matrix);
    tap_ok(plain > -0.8, "as N^%.2f with random points", plain);
}

/* ---- numbers of points -------------------------------------------------------------------- */

static double first_coordinate(const double *x, void *ctx)
{
    (void)ctx;
    return x[0];
}

static void test_rounding(void)
{
    static const uint64_t asked[] = {1, 8, 9, 16, 1000, 4096, 4097, 100000};
    static const uint64_t wanted[] = {8, 8, 16, 16, 1024, 4096, 8192, 131072};
    const buffon_integrand f = {.scalar = first_coordinate, .dim = 1};
    buffon_points sobol = buffon_points_sobol(BUFFON_SCRAMBLE_OWEN);
    buffon_estimate e;
    buffon_run run = {.points = &sobol};
    for (size_t k = 0; k < COUNT(asked); k++) {
        run.samples = asked[k];
        must_run(buffon_uniform(&e, &f, lo, hi, &run), "rounding");
        tap_ok(e.samples == wanted[k], "%llu samples asked for: %llu", (unsigned long long)asked[k],
               (unsigned long long)e.samples);
    }
    run.samples = 100;
    sobol.replicates = 16;
    tap_ok(buffon_uniform(&e, &f, lo, hi, &run) == BUFFON_OK && e.samples == 128, "16 replicates");
    sobol.replicates = 3;
    tap_ok(buffon_uniform(&e, &f, lo, hi, &run) == BUFFON_OK && e.samples == 192, "3 replicates");
    sobol.replicates = 1;
    tap_ok(buffon_uniform(&e, &f, lo, hi, &run) == BUFFON_W_FEW && e.samples == 128 &&
               e.std_error == INFINITY,
           "one replicate alone has no standard error");
    sobol = buffon_points_sobol(BUFFON_SCRAMBLE_NONE);
    tap_ok(buffon_uniform(&e, &f, lo, hi, &run) == BUFFON_W_NO_ERROR && e.samples == 128 &&
               e.std_error != e.std_error && e.value == 0.5 - 1.0 / 256 + 0x1p-53,
           "points that are not scrambled: no standard error, and the value of the sequence");
    sobol = buffon_points_random();
    sobol.doubling = 1;
    tap_ok(buffon_uniform(&e, &f, lo, hi, &run) == BUFFON_OK && e.samples == 128,
           "any point set may ask for a power of two");
    run.samples = UINT64_C(1) << 62;
    sobol.limit = UINT64_C(1) << 61;
    tap_ok(buffon_uniform(&e, &f, lo, hi, &run) == BUFFON_E_SAMPLES, "more than the limit");
}

static void test_strata(void)
{
    buffon_estimate e;
    const buffon_points sobol = buffon_points_sobol(BUFFON_SCRAMBLE_OWEN);
    buffon_partial partial = {{0}, NULL};
    const buffon_status status =
        problem_strata(&e, (buffon_run){.samples = 5000, .points = &sobol, .partial = &partial},
                       BUFFON_ALLOCATION_SHARE);
    const buffon_priv_record *record = buffon_priv_partial_record(&partial);
    size_t odd = 0;
    for (size_t c = 0; c < buffon_priv_shape_cells(&record->shape); c++)
        odd += !is_power(buffon_priv_cell_count(&record->whole, c, &record->shape) +
                         buffon_priv_cell_count(&record->tail, c, &record->shape));
    tap_ok(status == BUFFON_OK && odd == 0 && e.samples == 8 * (256 + 128 + 512),
           "strata: a power of two in each cell (%llu)", (unsigned long long)e.samples);
    buffon_partial_free(&partial);
}

static double sum_of_all(const double *x, void *ctx)
{
    double sum = 0;
    for (size_t j = 0; j < *(const size_t *)ctx; j++)
        sum += x[j];
    return sum;
}

static void test_dimensions(void)
{
    enum { MOST = BUFFON_SOBOL_DIMENSIONS };
    static double ones[MOST + 1], zeros[MOST + 1];
    const buffon_points sobol = buffon_points_sobol(BUFFON_SCRAMBLE_OWEN);
    const buffon_run run = {.samples = 2048, .points = &sobol};
    buffon_estimate e;
    size_t dim = MOST;
    for (size_t j = 0; j <= MOST; j++)
        ones[j] = 1;
    buffon_integrand f = {.scalar = sum_of_all, .dim = MOST, .ctx = &dim};
    must_run(buffon_uniform(&e, &f, zeros, ones, &run), "all dimensions");
    tap_ok(e.status == BUFFON_OK && fabs(e.value - MOST / 2.0) < 8 * e.std_error &&
               e.std_error < 0.01,
           "%d dimensions: %.4f +- %.4f", MOST, e.value, e.std_error);
    dim = f.dim = MOST + 1;
    tap_ok(buffon_uniform(&e, &f, zeros, ones, &run) == BUFFON_E_POINTS &&
               is_refusal(&e, BUFFON_E_POINTS),
           "%d dimensions are refused", MOST + 1);
}

/* ---- the same bits ------------------------------------------------------------------------- */

static buffon_status qmc_strata(buffon_estimate *out, buffon_run run)
{
    return problem_strata(out, run, BUFFON_ALLOCATION_SHARE);
}

static buffon_status qmc_self_normalised(buffon_estimate *out, buffon_run run)
{
    const buffon_density g = buffon_box(lo, hi, 2);
    const buffon_integrand h = {.batch = problem_three, .dim = 2, .components = 3};
    const buffon_integrand p = {.scalar = problem_weight, .dim = 2};
    return buffon_self_normalised(out, &h, &p, &g, &run);
}

/* Every estimator, with the points of the run. */
static const problem solved[] = {{"uniform", 1, 0, problem_plain},
                                 {"three components", 3, 0, problem_components},
                                 {"rejection", 1, 0, problem_rejection},
                                 {"importance on a cap", 1, 0, problem_cap},
                                 {"strata", 1, 0, qmc_strata},
                                 {"strata, Neyman", 1, 0, problem_neyman},
                                 {"self-normalised", 3, 0, qmc_self_normalised},
                                 {"expectation on a disk", 1, 0, problem_expectation},
                                 {"inverse CDF of a table", 1, 0, problem_table},
                                 {"values that are not finite", 1, 0, problem_nonfinite}};

/* In three parts, the last first. */
static void solve_parts(buffon_estimate *out, const problem *p, buffon_run run)
{
    buffon_partial all = {{0}, NULL};
    for (uint32_t part = 3; part-- > 0;) {
        buffon_partial one = {{0}, NULL};
        run.part = part;
        run.parts = 3;
        run.partial = &one;
        must_run(p->solve(out, run), p->name);
        must_run(buffon_partial_merge(&all, &one), p->name);
        buffon_partial_free(&one);
    }
    must_run(buffon_partial_estimate(out, &all, 0), p->name);
    buffon_partial_free(&all);
}

static void test_same(const problem *p, const buffon_points *points, const char *name)
{
    const buffon_level best = buffon_cpu_limit(BUFFON_LEVEL_AVX512);
    buffon_estimate once[PROBLEMS_COMPONENTS], again[PROBLEMS_COMPONENTS];
    buffon_run run = {.samples = 8000, .seed = 5, .points = points, .block = 64};
    size_t wrong = 0;
    must_run(p->solve(once, run), p->name);
    run.threads = 3;
    must_run(p->solve(again, run), p->name);
    wrong += !same_estimates(once, again, p->components);
    run.threads = 0;
    for (int level = 0; level <= (int)best; level++) {
        buffon_cpu_limit((buffon_level)level);
        must_run(p->solve(again, run), p->name);
        wrong += !same_estimates(once, again, p->components);
    }
    buffon_cpu_limit(BUFFON_LEVEL_AVX512);
    solve_parts(again, p, run);
    wrong += !same_estimates(once, again, p->components);
    buffon_partial partial = {{0}, NULL};
    run.partial = &partial;
    for (run.samples = 30; run.samples < 8192; run.samples *= 4) /* cut within a block at first */
        must_run(p->solve(again, run), p->name);
    run.samples = 8000;
    must_run(p->solve(again, run), p->name);
    wrong += !same_estimates(once, again, p->components);
    buffon_partial_free(&partial);
    tap_ok(wrong == 0, "%s, %s: the same bits by threads, levels, parts and doubling", p->name,
           name);
}

static int counting_batch(double *f, const double *x, size_t n, void *ctx)
{
    *(size_t *)ctx += n;
    return square_batch(f, x, n, NULL);
}

/* To go from 2^m to 2^(m+1) points evaluates only the new ones. */
static void test_reuse(void)
{
    const buffon_points sobol = buffon_points_sobol(BUFFON_SCRAMBLE_OWEN);
    size_t calls = 0;
    const buffon_integrand f = {.batch = counting_batch, .dim = 2, .ctx = &calls};
    buffon_partial partial = {{0}, NULL};
    buffon_estimate e, once;
    buffon_run run = {.samples = 8 << 11, .points = &sobol, .partial = &partial};
    must_run(buffon_uniform(&e, &f, lo, hi, &run), "half");
    run.samples *= 2;
    must_run(buffon_uniform(&e, &f, lo, hi, &run), "all");
    tap_ok(calls == 8 << 12, "from 2^11 to 2^12 points a replicate: %zu evaluations", calls);
    run.partial = NULL;
    must_run(buffon_uniform(&once, &f, lo, hi, &run), "at once");
    tap_ok(same_estimate(&once, &e), "the same bits");
    buffon_partial_free(&partial);
}

static int cancel(const buffon_progress *progress, void *ctx)
{
    (void)progress;
    (void)ctx;
    return 1;
}

static void one_after_the_other(size_t tasks, void (*task)(size_t i, void *arg), void *arg,
                                void *ctx)
{
    (void)ctx;
    for (size_t i = 0; i < tasks; i++)
        task(i, arg);
}

/* A run that was cancelled after three blocks of each replicate, and is then said to be as short as
 * one: it has no odd number of points without a reservation. */
static void test_cancelled(void)
{
    const buffon_points sobol = buffon_points_sobol(BUFFON_SCRAMBLE_OWEN);
    const buffon_integrand f = {.batch = square_batch, .dim = 2};
    buffon_partial partial = {{0}, NULL};
    buffon_estimate e, once;
    buffon_run run = {.samples = 8 << 10,
                      .block = 64,
                      .points = &sobol,
                      .partial = &partial,
                      .threads = 24,
                      .executor = one_after_the_other,
                      .progress = cancel};
    buffon_status status = buffon_uniform(&e, &f, lo, hi, &run);
    tap_ok(status == BUFFON_W_CANCELLED && e.samples == 24 * 64,
           "cancelled after %llu points, with a reservation", (unsigned long long)e.samples);
    run.samples = 8 << 6;
    run.progress = NULL;
    status = buffon_uniform(&e, &f, lo, hi, &run);
    tap_ok(status == BUFFON_OK && e.samples == 8 << 8, "made shorter: %llu points",
           (unsigned long long)e.samples);
    run.samples = 8 << 8;
    run.partial = NULL;
    must_run(buffon_uniform(&once, &f, lo, hi, &run), "at once");
    tap_ok(same_estimate(&once, &e), "the same bits as at once");
    buffon_partial_free(&partial);
}

/* bad_index names the point that failed. */
static void test_sample_at(void)
{
    const buffon_points sobol = buffon_points_sobol(BUFFON_SCRAMBLE_OWEN);
    const buffon_density box = buffon_box(lo, hi, 2);
    const buffon_run run = {.samples = 8 << 6, .seed = 3, .points = &sobol};
    double mean = 0;
    buffon_estimate e;
    for (uint64_t i = 0; i < 8 << 6; i++) {
        double x[2];
        must_run(buffon_sample_at(x, &box, i, &run), "sample_at");
        mean += x[0] / (8 << 6);
    }
    const buffon_integrand f = {.scalar = first_coordinate, .dim = 2};
    must_run(buffon_uniform(&e, &f, lo, hi, &run), "uniform");
    tap_ok(fabs(mean - e.value) < 1e-14, "buffon_sample_at gives the points of the run");
}

int main(void)
{
    const buffon_points owen = buffon_points_sobol(BUFFON_SCRAMBLE_OWEN);
    const buffon_points linear = buffon_points_sobol(BUFFON_SCRAMBLE_LINEAR);
    const buffon_points none = buffon_points_sobol(BUFFON_SCRAMBLE_NONE);
    const buffon_points median = buffon_points_sobol_median();
    const buffon_points net = buffon_points_sobol_net(BUFFON_SCRAMBLE_OWEN);
    test_coverage();
    test_stopping(8);
    test_stopping(16);
    test_convergence();
    test_rounding();
    test_strata();
    test_dimensions();
    for (size_t k = 0; k < COUNT(solved); k++) {
        test_same(&solved[k], &owen, "Owen");
        test_same(&solved[k], &linear, "linear");
        test_same(&solved[k], &net, "net");
        if (solved[k].solve != problem_components) /* it asks for covariances */
            test_same(&solved[k], &median, "median");
    }
    test_same(&solved[0], &none, "none");
    test_reuse();
    test_cancelled();
    test_sample_at();
    return tap_done();
}
