/* How runs end and what they say of it: tolerances, looks, every reservation; callbacks that call
 * the library; and what scaling, shifting or permuting a problem does to its estimate. */
#include <stdlib.h>

#include "problems.h"
#include "tap.h"

static const double zero = 0, one = 1;

static double constant(const double *x, void *ctx)
{
    (void)x;
    return *(const double *)ctx;
}

static double identity(const double *x, void *ctx)
{
    (void)ctx;
    return x[0];
}

/* 1 where x < ctx. */
static double below(const double *x, void *ctx)
{
    return x[0] < *(const double *)ctx;
}

/* ---- tolerances ---- */

static int meets(const buffon_estimate *e, double abs_tol, double rel_tol)
{
    const double relative = rel_tol * fabs(e->value);
    return (e->hi - e->lo) / 2 <= (relative > abs_tol ? relative : abs_tol);
}

/* Every tolerance stops the run at the first look that meets it. */
static void test_tolerance(const problem *p)
{
    static const uint64_t looks[] = {8192, 16384, 32768, 65536, 100000};
    static const double factors[] = {8, 4, 2, 1.5, 1, 0.7, 0.5, 0.25};
    uint64_t least = 0;
    int good = 1, places = 0;
    for (size_t i = 0; i < sizeof factors / sizeof *factors; i++) {
        const double tol = p->rel_tol * factors[i];
        buffon_run run = {.samples = 100000, .seed = 5, .rel_tol = tol};
        buffon_estimate e[PROBLEMS_COMPONENTS], shorter[PROBLEMS_COMPONENTS];
        const buffon_status status = p->solve(e, run);
        int met = 1, late = 1;
        size_t j = 0;
        for (size_t k = 0; k < p->components; k++)
            met &= meets(&e[k], 0, tol);
        while (j < 4 && looks[j + 1] <= e->samples)
            j++;
        good &=
            e->looks == 5 && (met || status == BUFFON_W_TOLERANCE || status == BUFFON_W_NONFINITE);
        good &= met == ((e->doubts & BUFFON_DOUBT(BUFFON_W_TOLERANCE)) == 0);
        /* Point sets and strata round up, then blocks do; never beyond the next look. Powers of two
         * of points in each of some strata or replicates are up to twice as many. */
        const int doubling = p->solve == problem_net || p->solve == problem_median;
        good &= j == 4 || e->samples < looks[j] + looks[j] / 2 || doubling;
        good &= e->samples >= least;
        places += e->samples > least;
        least = e->samples;
        /* One look earlier it was not met. (A short run of jittered points ends its sweep and does
         * better than a look within one.) */
        if (j > 0 && p->solve != problem_jitter && p->solve != problem_stratified) {
            run.samples = looks[j - 1];
            run.rel_tol = 0;
            run.confidence = 1 - 0.05 / 5;
            good &= p->solve(shorter, run) >= 0;
            for (size_t k = 0; k < p->components; k++)
                late &= meets(&shorter[k], 0, tol * 0.98);
            good &= !late;
        }
    }
    tap_ok(good && places >= 2, "%s: stops at the first look that meets the tolerance (%d of 5)",
           p->name, places);
}

static void test_tolerances(void)
{
    const buffon_integrand f = {.scalar = identity, .dim = 1};
    buffon_run run = {.samples = 1000000, .abs_tol = 3e-3};
    buffon_estimate e;
    tap_ok(buffon_uniform(&e, &f, &zero, &one, &run) == BUFFON_OK && meets(&e, 3e-3, 0) &&
               e.samples < 1000000,
           "an absolute tolerance");
    run.rel_tol = 1e-9;
    tap_ok(buffon_uniform(&e, &f, &zero, &one, &run) == BUFFON_OK && meets(&e, 3e-3, 0),
           "of two tolerances the wider one is enough");
    run.samples = 5000;
    run.abs_tol = 0.1;
    tap_ok(buffon_uniform(&e, &f, &zero, &one, &run) == BUFFON_OK && e.looks == 1 &&
               e.samples == 5000,
           "below 2^13 samples there is one look");
    run.samples = 8193;
    tap_ok(buffon_uniform(&e, &f, &zero, &one, &run) == BUFFON_OK && e.looks == 2 &&
               e.samples == 8192,
           "just above there are two");
    run.samples = 8192;
    tap_ok(buffon_uniform(&e, &f, &zero, &one, &run) == BUFFON_OK && e.looks == 1,
           "at 2^13 there is one");
}

/* What looks like no error at all, and what rests on a few points, meets no tolerance. */
static void test_rare(void)
{
    double p = 1e-7;
    const buffon_integrand rare = {.scalar = below, .dim = 1, .ctx = &p};
    const buffon_run run = {.samples = 100000, .seed = 1, .rel_tol = 0.5, .abs_tol = 0.01};
    buffon_estimate e;
    tap_ok(buffon_uniform(&e, &rare, &zero, &one, &run) == BUFFON_W_NO_SPREAD && e.value == 0 &&
               e.samples == 100000 && e.lo == -INFINITY && e.hi == INFINITY &&
               e.doubts == (BUFFON_DOUBT(BUFFON_W_NO_SPREAD) | BUFFON_DOUBT(BUFFON_W_TOLERANCE)),
           "zero hits meet no tolerance");
    tap_ok(buffon_rejection(&e, &rare, &zero, &one, 1, &run) == BUFFON_W_NO_SPREAD &&
               e.samples == 100000 && e.lo == 0 && e.hi < 1e-4 && e.hi > 1e-7,
           "nor do they by rejection, whose interval is still true");
    p = 1e-3;
    const buffon_status status = buffon_uniform(&e, &rare, &zero, &one, &run);
    tap_ok(status == BUFFON_OK && e.samples >= 65536 && e.max_share <= 0.02,
           "a hit in a thousand: not before fifty hits (%.3g)", e.max_share);
}

static void test_constant(void)
{
    double value = 1.0 / 3;
    const buffon_integrand f = {.scalar = constant, .dim = 1, .ctx = &value};
    buffon_run run = {.samples = 100000, .rel_tol = 1e-3};
    const double lo = 0, hi = 8;
    buffon_estimate e;
    tap_ok(buffon_uniform(&e, &f, &lo, &hi, &run) == BUFFON_W_NO_SPREAD && e.samples == 100000 &&
               e.value == 8.0 / 3 && e.std_error == 0 && e.interval == BUFFON_INTERVAL_NONE,
           "a constant is not certain");
    run.constant = 1;
    tap_ok(buffon_uniform(&e, &f, &lo, &hi, &run) == BUFFON_OK && e.samples == 8192 &&
               e.value == 8.0 / 3 && e.lo == e.value && e.hi == e.value &&
               e.interval == BUFFON_INTERVAL_EXACT,
           "unless the caller says so: .constant");
    const buffon_integrand other = {.scalar = identity, .dim = 1};
    run.rel_tol = 0;
    tap_ok(buffon_uniform(&e, &other, &lo, &hi, &run) == BUFFON_OK && e.std_error > 0 &&
               e.interval == BUFFON_INTERVAL_STUDENT,
           "which does no harm where it is wrong");
}

/* ---- reservations ---- */

static int cancel(const buffon_progress *progress, void *ctx)
{
    (void)progress;
    (void)ctx;
    return 1;
}

static double spike(const double *x, void *ctx)
{
    (void)ctx;
    return x[0] < 0.004 ? 1e6 + x[0] : x[0];
}

static double heavy(const double *x, void *ctx)
{
    (void)ctx;
    return 1 / (x[0] * sqrt(sqrt(x[0])));
}

static int has(const buffon_estimate *e, buffon_status status)
{
    return e->status == status && (e->doubts & BUFFON_DOUBT(status)) != 0;
}

static void test_reservations(void)
{
    const buffon_integrand f = {.scalar = identity, .dim = 1};
    const buffon_integrand peaked = {.scalar = spike, .dim = 1},
                           tailed = {.scalar = heavy, .dim = 1};
    const buffon_integrand pole = {.scalar = problem_pole, .dim = 1};
    static const double u[] = {0.125, 0.375, 0.625, 0.875};
    const buffon_points fixed = buffon_points_replay(u, 1, 4, BUFFON_DESIGN_NONE);
    buffon_partial partial = {0};
    buffon_estimate e;
    tap_ok(
        buffon_uniform(&e, &f, &zero, &one, &(buffon_run){.samples = 5000, .progress = cancel}) ==
                BUFFON_W_CANCELLED &&
            has(&e, BUFFON_W_CANCELLED) && e.samples == 1024,
        "cancelled");
    tap_ok(buffon_uniform(
               &e, &f, &zero, &one,
               &(buffon_run){.samples = 5000, .part = 1, .parts = 2, .partial = &partial}) ==
                   BUFFON_W_INCOMPLETE &&
               has(&e, BUFFON_W_INCOMPLETE) && e.samples == 2048,
           "incomplete");
    buffon_partial_free(&partial);
    tap_ok(buffon_uniform(&e, &pole, &zero, &one,
                          &(buffon_run){.samples = 500, .on_nonfinite = BUFFON_NONFINITE_ZERO}) ==
                   BUFFON_W_NONFINITE &&
               has(&e, BUFFON_W_NONFINITE) && e.nonfinite > 0,
           "not finite");
    tap_ok(buffon_uniform(&e, &f, &zero, &one, &(buffon_run){.samples = 4, .points = &fixed}) ==
                   BUFFON_W_NO_ERROR &&
               has(&e, BUFFON_W_NO_ERROR) && e.value == 0.5 && isnan(e.std_error) &&
               e.lo == -INFINITY && e.hi == INFINITY,
           "points without an error");
    tap_ok(buffon_uniform(&e, &f, &zero, &one, &(buffon_run){.samples = 1}) == BUFFON_W_FEW &&
               has(&e, BUFFON_W_FEW) && e.samples == 1 && e.value > 0 && e.lo == -INFINITY,
           "one sample has no error");
    double value = 2;
    const buffon_integrand flat = {.scalar = constant, .dim = 1, .ctx = &value};
    tap_ok(buffon_uniform(&e, &flat, &zero, &one, &(buffon_run){.samples = 500}) ==
                   BUFFON_W_NO_SPREAD &&
               has(&e, BUFFON_W_NO_SPREAD) && e.value == 2,
           "no spread");
    buffon_status status =
        buffon_uniform(&e, &peaked, &zero, &one, &(buffon_run){.samples = 300, .seed = 5});
    tap_ok(status == BUFFON_W_DOMINATED && has(&e, status) && e.max_share > 0.9,
           "one sample carries the variance (%.2f)", e.max_share);
    status = buffon_uniform(&e, &tailed, &zero, &one, &(buffon_run){.samples = 100000});
    tap_ok(status > 0 && (e.doubts & BUFFON_DOUBT(BUFFON_W_HEAVY_TAIL)) != 0 && e.tail_index > 0.7,
           "a heavy tail (k = %.2f)", e.tail_index);
    tap_ok(buffon_uniform(&e, &f, &zero, &one, &(buffon_run){.samples = 9000, .abs_tol = 1e-9}) ==
                   BUFFON_W_TOLERANCE &&
               has(&e, BUFFON_W_TOLERANCE) && e.samples == 9000,
           "a tolerance that is not reached");
    tap_ok(buffon_uniform(&e, &f, &zero, &one, &(buffon_run){.samples = 9000}) == BUFFON_OK &&
               e.doubts == 0 && e.status == BUFFON_OK,
           "and none");
    tap_ok(buffon_uniform(&e, &f, &zero, &one, NULL) == BUFFON_OK && e.samples == 1u << 20 &&
               e.confidence == 0.95,
           "no options: 2^20 samples, 0.95");
}

/* ---- callbacks that call the library ---- */

/* The integral over y in (0, x) of y: x^2 / 2. ctx: threads of the inner run. */
static double inner(const double *x, void *ctx)
{
    const buffon_integrand f = {.scalar = identity, .dim = 1};
    const buffon_run run = {
        .samples = 64, .seed = 1, .threads = *(const uint32_t *)ctx, .block = 16};
    buffon_estimate e;
    return buffon_uniform(&e, &f, &zero, x, &run) >= 0 ? e.value : NAN;
}

static void test_nested(void)
{
    uint32_t threads = 0;
    const buffon_integrand f = {.scalar = inner, .dim = 1, .ctx = &threads};
    buffon_run run = {.samples = 300, .block = 32};
    buffon_estimate e, threaded;
    const buffon_status status = buffon_uniform(&e, &f, &zero, &one, &run);
    threads = 2;
    run.threads = 3;
    tap_ok(status == BUFFON_OK && buffon_uniform(&threaded, &f, &zero, &one, &run) == status &&
               same_estimate(&e, &threaded) && fabs(e.value - 1.0 / 6) < 6 * e.std_error + 0.05,
           "an integrand may integrate, threads within threads");
}

/* ---- equivariance ---- */

typedef struct scaled {
    double factor, shift;
} scaled;

static int scaled_three(double *f, const double *x, size_t n, void *ctx)
{
    const scaled *s = ctx;
    problem_three(f, x, n, NULL);
    for (size_t i = 0; i < 3 * n; i++)
        f[i] = s->factor * f[i] + s->shift;
    return 0;
}

/* One of several estimators of the three functions. */
static buffon_status estimate_three(buffon_estimate *e, const buffon_integrand *f, int way,
                                    buffon_run run)
{
    const double lo[] = {0.125, 0.25}, hi[] = {1, 2};
    const buffon_density box = buffon_box(lo, hi, 2);
    const buffon_integrand p = {.scalar = problem_weight, .dim = 2};
    const buffon_stratum list[] = {{.density = &box}, {.density = &box, .weight = 3}};
    const buffon_strata strata = {
        .stratum = list, .count = 2, .allocation = BUFFON_ALLOCATION_NEYMAN};
    const buffon_points pairs = buffon_points_antithetic(), jitter = buffon_points_jitter(4);
    const buffon_points kronecker = problem_kronecker();
    switch (way) {
    case 1:
        run.points = &pairs;
        break;
    case 2:
        run.points = &jitter;
        break;
    case 3:
        run.points = &kronecker;
        break;
    case 4:
        return buffon_importance(e, f, &box, &run);
    case 5:
        return buffon_self_normalised(e, f, &p, &box, &run);
    case 6:
        return buffon_stratified(e, f, &strata, &run);
    default:
        break;
    }
    return buffon_uniform(e, f, lo, hi, &run);
}

static const char *const ways[] = {"uniform",    "pairs",           "jitter", "replicates",
                                   "importance", "self-normalised", "strata"};

static void test_scaling(void)
{
    static const int powers[] = {1, -1, 60, -300, 900, -900};
    for (int way = 0; way < 7; way++) {
        scaled s = {1, 0};
        const buffon_integrand f = {.batch = scaled_three, .dim = 2, .components = 3, .ctx = &s};
        const buffon_run run = {.samples = 5000, .seed = 6};
        buffon_estimate e[3], big[3];
        int good = estimate_three(e, &f, way, run) == BUFFON_OK;
        for (size_t i = 0; i < sizeof powers / sizeof *powers; i++) {
            const int k = powers[i];
            s.factor = ldexp(1, k);
            good &= estimate_three(big, &f, way, run) == BUFFON_OK;
            for (int c = 0; c < 3; c++) {
                buffon_estimate expected = e[c];
                expected.value = ldexp(e[c].value, k);
                expected.std_error = ldexp(e[c].std_error, k);
                expected.lo = ldexp(e[c].lo, k);
                expected.hi = ldexp(e[c].hi, k);
                expected.min = ldexp(e[c].min, k);
                expected.max = ldexp(e[c].max, k);
                expected.variance = ldexp(e[c].variance, 2 * k);
                good &= same_estimate(&big[c], &expected);
            }
        }
        tap_ok(good, "%s: 2^k f gives 2^k times the estimate, exactly", ways[way]);
    }
}

static void test_shift(void)
{
    for (int way = 0; way < 7; way++) {
        scaled s = {1, 0};
        const buffon_integrand f = {.batch = scaled_three, .dim = 2, .components = 3, .ctx = &s};
        const buffon_run run = {.samples = 5000, .seed = 6};
        const double measure = way == 5 ? 1 : way == 6 ? 4 : 1.53125;
        buffon_estimate e[3], high[3];
        int good = estimate_three(e, &f, way, run) == BUFFON_OK;
        if (way == 6)
            continue; /* the pilot sees other roundings: other allocation */
        /* The error of a ratio is a difference of terms as large as the square of the shift. */
        s.shift = way == 5 ? 1 << 10 : 1 << 20;
        good &= estimate_three(high, &f, way, run) == BUFFON_OK;
        for (int c = 0; c < 3; c++) {
            const double moved = high[c].value - s.shift * measure - e[c].value;
            good &= fabs(moved) < 1e-9 && fabs(high[c].std_error / e[c].std_error - 1) < 1e-7;
        }
        tap_ok(good, "%s: f + c moves the value by c and leaves the error", ways[way]);
    }
}

/* Coordinates in another order, at points in the same order. ctx: where each coordinate is. */
static double permuted(const double *x, void *ctx)
{
    const int *at = ctx;
    return x[at[0]] / (4 + x[at[1]] * x[at[2]]) - x[at[2]];
}

static void test_permuted(void)
{
    enum { N = 2000 };
    static double u[3 * N], v[3 * N];
    static const double lo[] = {0, 1, -1}, hi[] = {2, 1.5, 3};
    int plain[] = {0, 1, 2}, turned[] = {1, 2, 0};
    buffon_rng rng = buffon_rng_make(12, 0);
    double tlo[3], thi[3];
    buffon_rng_fill(u, 3 * N, &rng);
    for (int j = 0; j < 3; j++) {
        memcpy(v + turned[j] * N, u + j * N, N * sizeof *u);
        tlo[turned[j]] = lo[j];
        thi[turned[j]] = hi[j];
    }
    const buffon_points a = buffon_points_replay(u, 3, N, BUFFON_DESIGN_INDEPENDENT);
    const buffon_points b = buffon_points_replay(v, 3, N, BUFFON_DESIGN_INDEPENDENT);
    const buffon_integrand f = {.scalar = permuted, .dim = 3, .ctx = plain};
    const buffon_integrand g = {.scalar = permuted, .dim = 3, .ctx = turned};
    buffon_estimate e, t;
    tap_ok(buffon_uniform(&e, &f, lo, hi, &(buffon_run){.samples = N, .points = &a}) == BUFFON_OK &&
               buffon_uniform(&t, &g, tlo, thi, &(buffon_run){.samples = N, .points = &b}) ==
                   BUFFON_OK &&
               same_estimate(&e, &t),
           "coordinates in another order: the same bits");
}

/* ---- the point at an index ---- */

static void test_sample_at(void)
{
    static const double u[] = {0.25, 0.75};
    const buffon_points points = buffon_points_replay(u, 1, 2, BUFFON_DESIGN_NONE);
    const buffon_run run = {.points = &points};
    const buffon_density box = buffon_segment(0, 4);
    double x = 0;
    tap_ok(buffon_sample_at(NULL, &box, 0, NULL) == BUFFON_E_NULL, "sample_at: NULL");
    tap_ok(buffon_sample_at(&x, &box, 1, &run) == BUFFON_OK && x == 3, "sample_at: the last point");
    tap_ok(buffon_sample_at(&x, &box, 2, &run) == BUFFON_E_SAMPLES && isnan(x),
           "sample_at: beyond the points");
    tap_ok(buffon_sample_at(&x, &box, UINT64_MAX, NULL) == BUFFON_OK && x > 0 && x < 4,
           "sample_at: random points have no end");
}

int main(void)
{
    for (int i = 0; i < PROBLEMS; i++)
        test_tolerance(&problems[i]);
    test_tolerances();
    test_rare();
    test_constant();
    test_reservations();
    test_nested();
    test_scaling();
    test_shift();
    test_permuted();
    test_sample_at();
    return tap_done();
}
