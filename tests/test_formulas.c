/* Every number of an estimate against its formula, written out plainly over the points of the run,
 * which buffon_sample_at gives: value, variance, std_error, covariances, interval and the rest. */
#include <float.h>
#include <stdlib.h>

#include "problems.h"
#include "tap.h"

#define MOST 2048
#define REPLICATES 8

typedef long double real;

/* The values of up to three components (and a weight) at the points of one stratum. */
typedef struct table {
    size_t n, components;
    double y[PROBLEMS_COMPONENTS + 1][MOST];
} table;

static real mean_of(const double *y, size_t n)
{
    real sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += y[i];
    return sum / (real)n;
}

/* sum (a - mean a)(b - mean b) / (n (n - 1)) */
static real cov_independent(const double *a, const double *b, size_t n)
{
    const real ma = mean_of(a, n), mb = mean_of(b, n);
    real sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += (a[i] - ma) * (b[i] - mb);
    return sum / (real)n / (real)(n - 1);
}

static real cov_pairs(const double *a, const double *b, size_t n)
{
    static double pa[MOST], pb[MOST];
    for (size_t p = 0; p < n / 2; p++) {
        pa[p] = 0.5 * (a[2 * p] + a[2 * p + 1]);
        pb[p] = 0.5 * (b[2 * p] + b[2 * p + 1]);
    }
    return cov_independent(pa, pb, n / 2);
}

/* Var(mean) = sum over cells of Var(cell) / (n_cell M^2), by the differences within each pair. */
static real cov_cells(const double *a, const double *b, size_t n)
{
    real sum = 0;
    for (size_t i = 0; i < n; i += 2)
        sum += (real)(a[i] - a[i + 1]) * (b[i] - b[i + 1]);
    return sum / (real)n / (real)n;
}

/* From the means of R replicates; point i is in replicate i mod R. */
static real cov_replicates(const double *a, const double *b, size_t n)
{
    real ra[REPLICATES] = {0}, rb[REPLICATES] = {0}, sum = 0;
    for (size_t i = 0; i < n; i++) {
        ra[i % REPLICATES] += (real)a[i] * REPLICATES / (real)n;
        rb[i % REPLICATES] += (real)b[i] * REPLICATES / (real)n;
    }
    for (size_t r = 0; r < REPLICATES; r++)
        sum += (ra[r] - mean_of(a, n)) * (rb[r] - mean_of(b, n));
    return sum / REPLICATES / (REPLICATES - 1);
}

typedef struct formula {
    const char *name;
    const buffon_points *points;
    real (*cov)(const double *a, const double *b, size_t n);
    double dof; /* for MOST points or `n` */
    size_t n;
} formula;

static int near_to(double x, real y, double relative)
{
    return fabsl((real)x - y) <= relative * fabsl(y);
}

/* ---- one density ---- */

static const double box_lo[] = {0, 0.25}, box_hi[] = {1, 2.25}; /* volume 2 */

static void table_fill(table *t, const buffon_points *points, size_t n)
{
    const buffon_density g = buffon_box(box_lo, box_hi, 2);
    const buffon_run run = {.samples = n, .seed = 8, .points = points};
    t->n = n;
    t->components = 3;
    for (size_t i = 0; i < n; i++) {
        double x[2], f[3];
        if (buffon_sample_at(x, &g, i, &run) != BUFFON_OK || problem_three(f, x, 1, NULL) != 0)
            exit(1);
        for (size_t k = 0; k < 3; k++)
            t->y[k][i] = f[k];
    }
}

static double extreme(const double *y, size_t n, int greatest)
{
    double found = y[0];
    for (size_t i = 1; i < n; i++)
        found = (greatest ? y[i] > found : y[i] < found) ? y[i] : found;
    return found;
}

/* The interval is value -+ t std_error, by the library's own t. */
static int interval_fits(const buffon_estimate *e, double dof, double looks)
{
    const double alpha = (1 - e->confidence) / looks;
    const double half = buffon_student_upper(alpha / 2, dof) * e->std_error;
    return e->interval == BUFFON_INTERVAL_STUDENT && near_to(e->hi - e->value, half, 1e-11) &&
           near_to(e->value - e->lo, half, 1e-11);
}

static void test_uniform(const formula *f)
{
    static table t;
    buffon_partial partial = {0};
    const buffon_integrand three = {.batch = problem_three, .dim = 2, .components = 3};
    const buffon_run run = {.samples = f->n,
                            .seed = 8,
                            .points = f->points,
                            .confidence = 0.9,
                            .covariance = 1,
                            .partial = &partial};
    buffon_estimate e[3];
    double cov[9];
    table_fill(&t, f->points, f->n);
    int good = buffon_uniform(e, &three, box_lo, box_hi, &run) >= 0, fits = 1, matrix = 1;
    good &= buffon_partial_covariance(cov, &partial) == BUFFON_OK;
    for (size_t k = 0; k < 3; k++) {
        const double *y = t.y[k];
        const real square = 4 * f->cov(y, y, f->n);
        good &= e[k].samples == f->n && e[k].ess == (double)f->n && isnan(e[k].acceptance);
        good &= near_to(e[k].value, 2 * mean_of(y, f->n), 1e-13);
        good &= near_to(e[k].std_error, sqrtl(square), 1e-12);
        good &= near_to(e[k].variance, 4 * cov_independent(y, y, f->n) * (real)f->n, 1e-12);
        good &= e[k].min == 2 * extreme(y, f->n, 0) && e[k].max == 2 * extreme(y, f->n, 1);
        fits &= interval_fits(&e[k], f->dof, 1) && e[k].confidence == 0.9;
        for (size_t l = 0; l < 3; l++)
            matrix &= near_to(cov[3 * k + l], 4 * f->cov(y, t.y[l], f->n), 1e-11);
    }
    tap_ok(good, "%s: value, std_error, variance and extremes", f->name);
    tap_ok(fits, "%s: the interval is Student's with %g degrees of freedom", f->name, f->dof);
    tap_ok(matrix, "%s: covariance of the components", f->name);
    buffon_partial_free(&partial);
}

/* The share that the largest deviation has in the squared error. */
static void test_share(void)
{
    static table t;
    const buffon_points pairs = buffon_points_antithetic(), jitter = buffon_points_jitter(5);
    const buffon_integrand three = {.batch = problem_three, .dim = 2, .components = 3};
    buffon_run run = {.samples = 200, .seed = 8};
    buffon_estimate e[3];
    real expected[3] = {0};
    for (int design = 0; design < 3; design++) {
        const size_t n = design == 0 ? 200 : 100;
        real sum = 0, most = 0;
        run.points = design == 0 ? NULL : design == 1 ? &pairs : &jitter;
        table_fill(&t, run.points, 200);
        const real mean = mean_of(t.y[1], 200);
        for (size_t i = 0; i < n; i++) {
            const double *y = t.y[1];
            const real d = design == 0   ? y[i] - mean
                           : design == 1 ? 0.5L * (y[2 * i] + y[2 * i + 1]) - mean
                                         : 0.5L * (y[2 * i] - y[2 * i + 1]);
            sum += d * d;
            most = d * d > most ? d * d : most;
        }
        expected[design] = most / sum;
        tap_ok(buffon_uniform(e, &three, box_lo, box_hi, &run) >= 0 &&
                   near_to(e[1].max_share, expected[design], 1e-12),
               "the share of the largest deviation is %.3Lf", expected[design]);
    }
}

/* ---- ratios ---- */

static void test_ratio(const formula *f)
{
    static table t;
    buffon_partial partial = {0};
    const buffon_density g = buffon_box(box_lo, box_hi, 2);
    const buffon_integrand h = {.batch = problem_three, .dim = 2, .components = 3};
    const buffon_integrand p = {.scalar = problem_weight, .dim = 2};
    const buffon_run run = {
        .samples = f->n, .seed = 8, .points = f->points, .covariance = 1, .partial = &partial};
    static double rest[3][MOST], w[MOST];
    buffon_estimate e[3];
    double cov[9];
    real weight = 0, squares = 0;
    table_fill(&t, f->points, f->n);
    int good = buffon_self_normalised(e, &h, &p, &g, &run) >= 0, matrix = 1;
    good &= buffon_partial_covariance(cov, &partial) == BUFFON_OK;
    for (size_t i = 0; i < f->n; i++) {
        double x[2];
        if (buffon_sample_at(x, &g, i, &run) != BUFFON_OK)
            exit(1);
        w[i] = problem_weight(x, NULL) * 2;
        weight += w[i];
        squares += (real)w[i] * w[i];
    }
    for (size_t k = 0; k < 3; k++) {
        real sum = 0;
        for (size_t i = 0; i < f->n; i++)
            sum += (real)w[i] * t.y[k][i];
        good &= near_to(e[k].value, sum / weight, 1e-14);
        for (size_t i = 0; i < f->n; i++)
            rest[k][i] = (double)(w[i] * (t.y[k][i] - sum / weight) / weight * (real)f->n);
    }
    for (size_t k = 0; k < 3; k++) {
        for (size_t l = 0; l < 3; l++)
            matrix &= near_to(cov[3 * k + l], f->cov(rest[k], rest[l], f->n), 1e-9);
        good &= near_to(e[k].std_error, sqrtl(f->cov(rest[k], rest[k], f->n)), 1e-10);
        good &= near_to(e[k].variance, f->cov(rest[k], rest[k], f->n) * (real)f->n, 1e-10);
        good &= near_to(e[k].ess, weight * weight / squares, 1e-12);
        good &= near_to(e[k].max_share, (real)extreme(w, f->n, 1) * extreme(w, f->n, 1) / squares,
                        1e-13);
        good &= interval_fits(&e[k], f->dof, 1);
    }
    tap_ok(good, "%s: self-normalised by the delta method", f->name);
    tap_ok(matrix, "%s: and the covariances of ratios", f->name);
    buffon_partial_free(&partial);
}

/* ---- strata ---- */

static double parabola(const double *x, void *ctx)
{
    (void)ctx;
    return x[0] * x[0];
}

/* Welch and Satterthwaite, with n_s = max(2, ceil(share N)). */
static void test_strata(void)
{
    static const double lo[] = {0, 1, 2.5}, hi[] = {1, 2.5, 7}, share[] = {0.001, 0.5, 1.5};
    static const double factor[] = {1, -3, 0.5}, n[] = {2, 125, 375};
    buffon_density box[3];
    buffon_stratum list[3];
    const buffon_strata strata = {.stratum = list, .count = 3};
    const buffon_integrand f = {.scalar = parabola, .dim = 1};
    const buffon_run run = {.samples = 499, .seed = 8};
    real value = 0, square = 0, quartic = 0;
    buffon_estimate e;
    for (int s = 0; s < 3; s++) {
        box[s] = buffon_box(&lo[s], &hi[s], 1);
        list[s] = (buffon_stratum){.density = &box[s], .weight = factor[s], .share = share[s]};
    }
    for (int s = 0; s < 3; s++) {
        const real scale = (real)factor[s] * (hi[s] - lo[s]);
        double y[400];
        for (uint64_t i = 0; i < (uint64_t)n[s]; i++) {
            double x;
            if (buffon_stratum_sample_at(&x, &strata, (uint64_t)s, i, &run) != BUFFON_OK)
                exit(1);
            y[i] = x * x;
        }
        const real v = scale * scale * cov_independent(y, y, (size_t)n[s]);
        value += scale * mean_of(y, (size_t)n[s]);
        square += v;
        quartic += v * v / (real)(n[s] - 1);
    }
    const buffon_status status = buffon_stratified(&e, &f, &strata, &run);
    tap_ok(status >= 0 && e.samples == 502 && near_to(e.value, value, 1e-14) &&
               near_to(e.std_error, sqrtl(square), 1e-13) &&
               near_to(e.variance, square * 502, 1e-13),
           "strata: value, std_error and variance");
    tap_ok(interval_fits(&e, (double)(square * square / quartic), 1),
           "strata: Student's interval with %.2Lf degrees of freedom", square * square / quartic);
    tap_ok(near_to(e.max, fmaxl(0.5L * 4.5L * 49, 1), 0.05) && e.min < -3 * 1.5 * 5.9,
           "strata: extremes carry their weights");
}

/* ---- hits ---- */

static void test_hits(void)
{
    const buffon_integrand f = {.scalar = parabola, .dim = 1};
    const double lo = 0, hi = 2;
    const buffon_points pairs = buffon_points_antithetic();
    buffon_run run = {.samples = 2000, .seed = 8, .confidence = 0.99};
    uint64_t hits = 0;
    double under[] = {0, 0}, over[] = {2, 4.5}, x[2], a, b;
    const buffon_density box = buffon_box(under, over, 2);
    buffon_estimate e;
    for (uint64_t i = 0; i < 2000; i++) {
        if (buffon_sample_at(x, &box, i, &run) != BUFFON_OK)
            exit(1);
        hits += x[1] < x[0] * x[0];
    }
    const real p = (real)hits / 2000;
    const buffon_status status = buffon_rejection(&e, &f, &lo, &hi, 4.5, &run);
    tap_ok(
        status == BUFFON_OK && near_to(e.acceptance, p, 1e-13) && near_to(e.value, 9 * p, 1e-13) &&
            near_to(e.std_error, 9 * sqrtl(p * (1 - p) / 1999), 1e-13) &&
            near_to(e.variance, 81 * p * (1 - p) * 2000 / 1999, 1e-13) && e.min == 0 && e.max == 9,
        "hits: %llu of 2000", (unsigned long long)hits);
    tap_ok(buffon_interval_clopper_pearson(&a, &b, hits, 2000, 0.99) == BUFFON_OK &&
               e.interval == BUFFON_INTERVAL_CLOPPER_PEARSON && near_to(e.lo, 9 * a, 1e-12) &&
               near_to(e.hi, 9 * b, 1e-12),
           "their interval is Clopper and Pearson's");
    run.points = &pairs;
    tap_ok(buffon_rejection(&e, &f, &lo, &hi, 4.5, &run) == BUFFON_OK && interval_fits(&e, 999, 1),
           "of pairs, which are not independent, Student's");
}

/* ---- looks ---- */

/* A run that may stop at several counts spends its error probability over them. */
static void test_looks(void)
{
    const buffon_integrand f = {.scalar = parabola, .dim = 1};
    const double lo = 0, hi = 2;
    buffon_run run = {.samples = 100000, .seed = 8, .rel_tol = 0.02, .confidence = 0.96};
    buffon_estimate e, fixed;
    tap_ok(buffon_uniform(&e, &f, &lo, &hi, &run) == BUFFON_OK && e.looks == 5 &&
               e.confidence == 0.96 && e.samples == 16384 && interval_fits(&e, 16383, 5),
           "five looks: alpha / 5 at each");
    run.samples = 16384;
    run.rel_tol = 0;
    tap_ok(buffon_uniform(&fixed, &f, &lo, &hi, &run) == BUFFON_OK && fixed.value == e.value &&
               fixed.std_error == e.std_error && fixed.variance == e.variance && fixed.looks == 1 &&
               interval_fits(&fixed, 16383, 1),
           "one look: alpha");
}

static double tower(const double *x, void *ctx)
{
    return *(const double *)ctx * (1 + x[0] * 1e-11);
}

/* +1 and -1 on the halves, and a little more that is all the integral. */
static double halves(const double *x, void *ctx)
{
    (void)ctx;
    return (x[0] < 0.5 ? 1 : -1) + 1e-14 * x[0];
}

static double least(const double *x, void *ctx)
{
    (void)x;
    (void)ctx;
    return DBL_TRUE_MIN;
}

/* An interval never says more than the doubles can. */
static void test_ends_of_doubles(void)
{
    enum { RUNS = 300 };
    const buffon_points cells = buffon_points_jitter(2), kronecker = problem_kronecker();
    const buffon_integrand two = {.scalar = halves, .dim = 1}, small = {.scalar = least, .dim = 1};
    const double lo = 0, hi = 10, one = 1;
    double high = 1e308;
    const buffon_integrand huge = {.scalar = tower, .dim = 1, .ctx = &high};
    buffon_run run = {.samples = 3000};
    buffon_estimate e;
    tap_ok(buffon_uniform(&e, &huge, &lo, &hi, &run) == BUFFON_W_FEW && e.value == INFINITY &&
               e.lo == -INFINITY && e.hi == INFINITY,
           "a value beyond the doubles is not OK, and has no interval");
    int missed = 0;
    run.points = &cells;
    for (run.seed = 0; run.seed < RUNS; run.seed++) {
        const buffon_status status = buffon_uniform(&e, &two, &lo, &one, &run);
        missed += status != BUFFON_OK || !(e.lo <= 0.5e-14 && 0.5e-14 <= e.hi);
    }
    tap_ok(missed == 0, "cells that cancel: rounding is in the interval, %d missed", missed);
    run.points = &kronecker;
    tap_ok(buffon_rejection(&e, &small, &lo, &hi, DBL_TRUE_MIN, &run) == BUFFON_W_NO_SPREAD &&
               e.acceptance == 1,
           "the smallest height: all below it are hits");
}

int main(void)
{
    const buffon_points pairs = buffon_points_antithetic(), jitter = buffon_points_jitter(4);
    const buffon_points kronecker = problem_kronecker();
    const buffon_points coarse = buffon_points_jitter(16); /* 512 points a sweep */
    const formula formulas[] = {
        {"random points", NULL, cov_independent, 1499, 1500},
        {"five random points", NULL, cov_independent, 4, 5},
        {"two random points", NULL, cov_independent, 1, 2},
        {"antithetic pairs", &pairs, cov_pairs, 749, 1500},
        {"two antithetic pairs", &pairs, cov_pairs, 1, 4},
        {"jittered points", &jitter, cov_cells, 800, 1600},
        {"one sweep", &coarse, cov_cells, 256, 512},
        {"replicates", &kronecker, cov_replicates, 7, 1600},
    };
    for (size_t i = 0; i < sizeof formulas / sizeof *formulas; i++)
        test_uniform(&formulas[i]);
    test_share();
    test_ratio(&formulas[0]);
    test_ratio(&formulas[3]);
    test_ratio(&formulas[5]);
    test_ratio(&formulas[7]);
    test_strata();
    test_hits();
    test_looks();
    test_ends_of_doubles();
    return tap_done();
}
