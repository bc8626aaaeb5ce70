/* The median of linear scrambles: which of the replicates' estimates are its value, its interval
 * and its error, how often the interval covers, and what it is good for. */
#include <stdlib.h>

#include <buffon/buffon.h>

#include "binomial.h"
#include "integrands.h"
#include "problems.h"

#define COUNT(array) (sizeof(array) / sizeof *(array))

static const double lo[] = {0, 0, 0, 0, 0}, hi[] = {1, 1, 1, 1, 1};

static void must_run(buffon_status status, const char *name)
{
    if (status < 0) {
        printf("Bail out! %s: %s\n", name, buffon_status_string(status));
        exit(1);
    }
}

/* ---- replicates of known estimates ---------------------------------------------------------- */

/* Replicate r has one point over and over: coordinate j is number r of row j. */
static int known_fill(double *u, const buffon_points_block *block, const buffon_points *self)
{
    const double *numbers = self->ctx;
    for (size_t j = 0; j < block->dim; j++) {
        for (size_t i = 0; i < block->n; i++)
            u[j * block->n + i] = numbers[j * self->replicates + block->key.replicate];
    }
    return 0;
}

static buffon_points known_points(double *numbers, uint32_t replicates)
{
    return (buffon_points){.fill = known_fill,
                           .design = BUFFON_DESIGN_MEDIAN,
                           .replicates = replicates,
                           .ctx = numbers};
}

static double first(const double *x, void *ctx)
{
    (void)ctx;
    return x[0];
}

static const buffon_integrand first_f = {.scalar = first, .dim = 1};

static buffon_estimate known_estimate(double *numbers, uint32_t replicates, double confidence)
{
    const buffon_points points = known_points(numbers, replicates);
    const buffon_run run = {.samples = 2 * replicates, .points = &points, .confidence = confidence};
    buffon_estimate e;
    must_run(buffon_uniform(&e, &first_f, lo, hi, &run), "known replicates");
    return e;
}

/* The estimates 1/1000, 2/1000, ..., in an order of their own. */
static void shuffled(double *numbers, uint32_t n)
{
    for (uint32_t r = 0; r < n; r++)
        numbers[r] = (double)(1 + r * 7 % n) / 1000; /* no n here is a multiple of 7 */
}

/* Order statistics by rank; the probabilities to miss are sums of binomial coefficients. */
static void test_ranks(void)
{
    static const struct {
        uint32_t n;
        double confidence;
        uint32_t j;  /* 0: no interval */
        double miss; /* that interval's */
    } cases[] = {{15, 0.95, 4, 2 * 576 / 32768.0},
                 {15, 0.965, 3, 2 * 121 / 32768.0},
                 {15, 0.9648, 4, 2 * 576 / 32768.0},
                 {15, 0.99, 3, 2 * 121 / 32768.0},
                 {15, 0.999, 2, 2 * 16 / 32768.0},
                 {15, 0.9999, 1, 2 / 32768.0},
                 {15, 0.99994, 0, 0},
                 {15, 0.5, 6, 2 * 4944 / 32768.0},
                 {15, 0.01, 7, 2 * 9949 / 32768.0},
                 {5, 0.95, 0, 0},
                 {5, 0.9375, 1, 2 / 32.0},
                 {9, 0.95, 2, 2 * 10 / 512.0},
                 {11, 0.98, 2, 2 * 12 / 2048.0},
                 {255, 0.95, 112, 0}};
    double numbers[255];
    for (size_t k = 0; k < COUNT(cases); k++) {
        const uint32_t n = cases[k].n, j = cases[k].j;
        shuffled(numbers, n);
        const buffon_estimate e = known_estimate(numbers, n, cases[k].confidence);
        int good = fabs(e.value - (n + 1) / 2 / 1000.0) < 1e-12;
        if (j == 0)
            good &= e.interval == BUFFON_INTERVAL_NONE && e.status == BUFFON_W_FEW &&
                    e.lo == -INFINITY && e.hi == INFINITY && e.std_error > 0;
        else
            good &= e.interval == BUFFON_INTERVAL_ORDER && e.status == BUFFON_OK &&
                    fabs(e.lo - j / 1000.0) < 1e-12 && fabs(e.hi - (n + 1 - j) / 1000.0) < 1e-12;
        if (cases[k].miss > 0) /* the error is that of 95 %, whatever the confidence */
            good &= n != 15 ||
                    fabs(e.std_error * -buffon_normal_quantile(576 / 32768.0) / 0.004 - 1) < 1e-9;
        tap_ok(good, "%u replicates, %g: from order statistic %u", (unsigned)n, cases[k].confidence,
               (unsigned)j);
    }
    shuffled(numbers, 5);
    tap_ok(
        fabs(known_estimate(numbers, 5, 0.9).std_error * -buffon_normal_quantile(1 / 32.0) / 0.002 -
             1) < 1e-9,
        "5 replicates: the error from the widest interval there is");
}

/* After a tolerance the interval is for all looks together. */
static void test_looks(void)
{
    double numbers[15];
    const buffon_points points = known_points(numbers, 15);
    const buffon_run run = {.samples = 100000, .points = &points, .abs_tol = 0.1};
    buffon_estimate e;
    shuffled(numbers, 15);
    const buffon_status status = buffon_uniform(&e, &first_f, lo, hi, &run);
    tap_ok(status == BUFFON_OK && e.looks == 5 && e.samples < 100000 &&
               fabs(e.lo - 0.003) < 1e-12 && fabs(e.hi - 0.013) < 1e-12,
           "five looks: the interval of 99 %%");
}

/* Where the middle agrees to the last bit, the interval reaches farther out. */
static void test_ties(void)
{
    double numbers[15];
    for (size_t r = 0; r < 15; r++)
        numbers[r] = 0.5;
    buffon_estimate e = known_estimate(numbers, 15, 0.95);
    tap_ok(e.status == BUFFON_W_NO_SPREAD && e.value == 0.5 && e.std_error == 0 &&
               e.interval == BUFFON_INTERVAL_NONE,
           "estimates that all agree are no spread");
    numbers[3] = 0.25;
    e = known_estimate(numbers, 15, 0.95);
    tap_ok(e.status == BUFFON_OK && e.value == 0.5 && e.std_error > 0 &&
               fabs(e.lo - 0.25) < 1e-15 && fabs(e.hi - 0.5) < 1e-15 && e.hi > 0.5,
           "one does not: from it to the rest, and the rounding");
    numbers[8] = 0.75;
    numbers[9] = 0.875;
    numbers[2] = 0.125;
    e = known_estimate(numbers, 15, 0.95);
    tap_ok(fabs(e.lo - 0.25) < 1e-15 && fabs(e.hi - 0.75) < 1e-15, "the next that differ");
}

static int pair_batch(double *f, const double *x, size_t n, void *ctx)
{
    (void)ctx;
    memcpy(f, x, n * sizeof *f);
    return 0;
}

static double weight(const double *x, void *ctx)
{
    (void)ctx;
    return x[1] < 0.1 ? 0 : x[1];
}

/* The ratio of each replicate, not the ratio of medians; a replicate without weight has none. */
static void test_ratio(void)
{
    double numbers[10] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.5, 0.25, 0.125, 0.75, 0.875};
    const buffon_points points = known_points(numbers, 5);
    const buffon_density g = buffon_box(lo, hi, 2);
    const buffon_integrand h = {.batch = pair_batch, .dim = 2, .components = 1};
    const buffon_integrand p = {.scalar = weight, .dim = 2};
    buffon_partial partial = {{0}, NULL};
    const buffon_run run = {.samples = 10, .points = &points, .partial = &partial};
    buffon_estimate e;
    double cov;
    must_run(buffon_self_normalised(&e, &h, &p, &g, &run), "ratio");
    /* With one point each the weight cancels. */
    tap_ok(fabs(e.value - 0.3) < 1e-15, "the median of the ratios");
    tap_ok(buffon_partial_covariance(&cov, &partial) == BUFFON_E_UNSUPPORTED && isnan(cov),
           "a median has no covariance");
    buffon_partial_free(&partial);
    numbers[7] = 0.05;
    const buffon_run again = {.samples = 10, .points = &points};
    const buffon_status status = buffon_self_normalised(&e, &h, &p, &g, &again);
    tap_ok(status == BUFFON_W_FEW && isnan(e.value) && e.std_error == INFINITY &&
               e.interval == BUFFON_INTERVAL_NONE,
           "a replicate without weight: no estimate, and a reservation");
}

static void test_refused(void)
{
    static const uint32_t wrong[] = {0, 1, 2, 3, 4, 6, 16, 256};
    buffon_points median = buffon_points_sobol_median();
    buffon_partial partial = {{0}, NULL};
    buffon_estimate e;
    buffon_run run = {.samples = 1000, .points = &median};
    int refused = 1;
    for (size_t k = 0; k < COUNT(wrong); k++) {
        median.replicates = wrong[k];
        refused &= buffon_uniform(&e, &first_f, lo, hi, &run) == BUFFON_E_POINTS &&
                   is_refusal(&e, BUFFON_E_POINTS);
    }
    tap_ok(refused, "an even number of replicates is refused, and one below 5");
    median.replicates = 15;
    run.covariance = 1;
    run.partial = &partial;
    tap_ok(buffon_uniform(&e, &first_f, lo, hi, &run) == BUFFON_E_POINTS && partial.more == NULL,
           "covariances are refused");
    run.covariance = 0;
    tap_ok(buffon_uniform(&e, &first_f, lo, hi, &run) >= 0 && e.samples == 15 * 128,
           "1000 samples: 15 times 128");
    buffon_partial_free(&partial);
}

/* ---- strata, and what is not whole ----------------------------------------------------------- */

static double bump(const double *x, void *ctx)
{
    (void)ctx;
    return 1 / (0.1 + x[0] * x[0]);
}

/* The median over replicates of the sum over strata. */
static void test_strata(void)
{
    static const double a[] = {0, 0.25}, b[] = {0.25, 1};
    const buffon_points median = buffon_points_sobol_median();
    const buffon_density box[2] = {buffon_box(&a[0], &b[0], 1), buffon_box(&a[1], &b[1], 1)};
    const buffon_stratum list[] = {{.density = &box[0]}, {.density = &box[1], .weight = 2}};
    const buffon_strata strata = {.stratum = list, .count = 2};
    const buffon_integrand f = {.scalar = bump, .dim = 1};
    const buffon_run run = {.samples = 15 * 16 * 2, .seed = 4, .points = &median};
    double replicate[15] = {0};
    buffon_estimate e;
    int below = 0, above = 0, beyond = 0;
    for (uint64_t i = 0; i < 15 * 16; i++) {
        for (uint64_t s = 0; s < 2; s++) {
            double x;
            must_run(buffon_stratum_sample_at(&x, &strata, s, i, &run), "sample");
            replicate[i % 15] += (s == 0 ? 0.25 : 2 * 0.75) * bump(&x, NULL) / 16;
        }
    }
    must_run(buffon_stratified(&e, &f, &strata, &run), "strata");
    for (size_t r = 0; r < 15; r++) {
        below += replicate[r] < e.value - 1e-13;
        above += replicate[r] > e.value + 1e-13;
        beyond += replicate[r] < e.lo - 1e-13;
        beyond += replicate[r] > e.hi + 1e-13;
    }
    tap_ok(below == 7 && above == 7 && beyond == 6 && e.samples == 15 * 16 * 2,
           "strata: the median of the replicates' sums");
}

/* Of a run of which parts are missing: the replicates that have points everywhere. */
static void test_incomplete(void)
{
    double numbers[15];
    buffon_estimate e;
    buffon_partial partial = {{0}, NULL};
    const buffon_points points = known_points(numbers, 15);
    const buffon_run run = {.samples = 15 * 16,
                            .block = 16,
                            .points = &points,
                            .partial = &partial,
                            .part = 1,
                            .parts = 3};
    shuffled(numbers, 15);
    must_run(buffon_uniform(&e, &first_f, lo, hi, &run), "part");
    /* Block 0 of replicates 1, 4, 7, 10, 13: the estimates 8, 14, 5, 11, 2. */
    tap_ok(e.status == BUFFON_W_INCOMPLETE && fabs(e.value - 0.008) < 1e-12 &&
               (e.doubts & BUFFON_DOUBT(BUFFON_W_FEW)) != 0 && e.samples == 80,
           "a part: the median of the replicates that are there");
    buffon_partial_free(&partial);
}

/* ---- coverage -------------------------------------------------------------------------------- */

enum { GENZ_DIM = 5, GENZ = 6 };

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

/* The interval is for the median of the law of a replicate: 96.5 % for 95. That it covers the
 * integral as often has to be seen. */
static void test_coverage(void)
{
    enum { SEEDS = 600 };
    const buffon_points median = buffon_points_sobol_median();
    const buffon_integrand f = {.batch = genz_batch, .dim = GENZ_DIM, .components = GENZ};
    uint64_t covered[GENZ] = {0};
    double sum2[GENZ] = {0}, se2[GENZ] = {0};
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        buffon_estimate e[GENZ];
        const buffon_run run = {.samples = 15 * 128, .seed = seed, .points = &median};
        must_run(buffon_uniform(e, &f, lo, hi, &run), "coverage");
        for (size_t k = 0; k < GENZ; k++) {
            covered[k] += e[k].lo <= genz[k].exact && genz[k].exact <= e[k].hi;
            sum2[k] += pow(e[k].value - genz[k].exact, 2);
            se2[k] += e[k].std_error * e[k].std_error;
        }
    }
    for (size_t k = 0; k < GENZ; k++) {
        const double share = (double)covered[k] / SEEDS, ratio = sqrt(se2[k] / sum2[k]);
        tap_ok(share > 0.93 && share < 0.99, "%s: intervals of 95 %% cover %.2f %%", genz[k].name,
               100 * share);
        tap_ok(ratio > 0.8 && ratio < 1.4, "%s: the standard error is %.2f times the error",
               genz[k].name, ratio);
    }
}

/* ---- what it is good for -------------------------------------------------------------------- */

static double exp_of_sum(const double *x, void *ctx)
{
    double sum = 0;
    for (size_t j = 0; j < *(const size_t *)ctx; j++)
        sum += x[j];
    return exp(sum);
}

/* The root mean square over seeds of the errors, and the share of intervals that cover. */
static double error_of(double *covered, const buffon_points *points, size_t dim, uint64_t samples)
{
    enum { SEEDS = 40 };
    const buffon_integrand f = {.scalar = exp_of_sum, .dim = dim, .ctx = &dim};
    const double exact = pow(1.71828182845904523536, (double)dim);
    double sum2 = 0;
    *covered = 0;
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        buffon_estimate e;
        const buffon_run run = {.samples = samples, .seed = seed, .points = points};
        must_run(buffon_uniform(&e, &f, lo, hi, &run), "exp");
        sum2 += (e.value - exact) * (e.value - exact) / SEEDS;
        *covered += (double)(e.lo <= exact && exact <= e.hi) / SEEDS;
    }
    return sqrt(sum2);
}

static void test_smooth(void)
{
    static const double least[] = {500, 3};
    const buffon_points median = buffon_points_sobol_median();
    const buffon_points strict = buffon_points_sobol(BUFFON_SCRAMBLE_OWEN);
    for (size_t dim = 1; dim <= 2; dim++) {
        double covered, other;
        const double mine = error_of(&covered, &median, dim, 15 << 10);
        const double gain = error_of(&other, &strict, dim, 8 << 11) / mine;
        tap_ok(gain > least[dim - 1] && covered >= 0.85,
               "exp of %zu coordinates: %.0f times nearer than 8 replicates, covered %.0f %%", dim,
               gain, 100 * covered);
    }
}

int main(void)
{
    test_ranks();
    test_looks();
    test_ties();
    test_ratio();
    test_refused();
    test_strata();
    test_incomplete();
    test_coverage();
    test_smooth();
    return tap_done();
}
