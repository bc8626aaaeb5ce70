/* X = F^-1(u): what is refused, what fails in use, and how near the points come. */
#include <buffon/buffon.h>
#include <float.h>
#include <math.h>

#include "../src/density_priv.h"
#include "grid.h"
#include "refused.h"

typedef long double wide;

static double half(double x, void *ctx)
{
    (void)ctx;
    return 0.5 * x;
}

static double broken(double x, void *ctx)
{
    (void)ctx;
    return x > 0.25 ? NAN : 0.5;
}

static double endless_quantile(double u, void *ctx)
{
    (void)ctx;
    return u > 0.5 ? INFINITY : u;
}

/* Reaches a half only. */
static double short_cdf(double x, void *ctx)
{
    (void)ctx;
    return x < 0 ? 0 : x > 1 ? 0.5 : 0.5 * x;
}

/* Starts at a half. */
static double late_cdf(double x, void *ctx)
{
    (void)ctx;
    return x < 0 ? 0.5 : x > 1 ? 1 : 0.5 + 0.5 * x;
}

/* Ends a rounding short of 1, as the CDF of a sum of many terms may. */
static double rounded_cdf(double x, void *ctx)
{
    (void)ctx;
    return x < 0 ? 0x1p-52 : x > 1 ? 1 - 0x1p-51 : 0x1p-52 + x * (1 - 3 * 0x1p-52);
}

static double one(double x, void *ctx)
{
    (void)ctx;
    return x >= 0 && x <= 1;
}

static void test_refusals(void)
{
    const double x[3] = {0, 1, 2}, F[3] = {0, 1, 3}, same[3] = {0, 1, 1};
    const double broad[2] = {-1e308, 1e308}, steep[2] = {0, 1e-320}, nan[3] = {0, NAN, 2};
    const struct {
        const char *what;
        buffon_status status;
        buffon_inversion how;
    } bad[] = {
        {"no form", BUFFON_E_SHAPE, {.ctx = NULL}},
        {"a table and a quantile", BUFFON_E_SHAPE, {.quantile = half, .x = x, .F = F, .count = 3}},
        {"a CDF without pdf", BUFFON_E_NULL, {.cdf = half}},
        {"a pdf alone", BUFFON_E_NULL, {.pdf = half}},
        {"a table without F", BUFFON_E_NULL, {.x = x, .count = 3}},
        {"a table without x", BUFFON_E_NULL, {.F = F, .count = 3}},
        {"a table of one point", BUFFON_E_TABLE, {.x = x, .F = F, .count = 1}},
        {"a table of none", BUFFON_E_TABLE, {.x = x, .F = F}},
        {"a table with a step", BUFFON_E_TABLE, {.x = same, .F = F, .count = 3}},
        {"a table with a plateau", BUFFON_E_TABLE, {.x = x, .F = same, .count = 3}},
        {"a table with a NaN", BUFFON_E_TABLE, {.x = nan, .F = F, .count = 3}},
        {"a table past DBL_MAX", BUFFON_E_TABLE, {.x = broad, .F = F, .count = 2}},
        {"a slope past DBL_MAX", BUFFON_E_TABLE, {.x = steep, .F = F, .count = 2}},
        {"a support backwards", BUFFON_E_DOMAIN, {.cdf = half, .pdf = half, .lo = 1, .hi = 0}},
        {"a support of NaN", BUFFON_E_DOMAIN, {.cdf = half, .pdf = half, .lo = NAN, .hi = 1}},
        {"a reserved word", BUFFON_E_RESERVED, {.quantile = half, .reserved = {0, 1}}},
    };
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++)
        refused_by_value(buffon_inverse(&bad[k].how), bad[k].status, bad[k].what);
    refused_by_value(buffon_inverse(NULL), BUFFON_E_NULL, "an inversion of NULL");
}

static void test_failures(void)
{
    double x[2] = {0, 0}, pdf[2] = {0, 0}, v;
    const double u[2] = {0.2, 0.7};
    const buffon_inversion endless = {.quantile = endless_quantile};
    buffon_density g = buffon_inverse(&endless);
    tap_ok(buffon_density_sample(x, NULL, u, 2, &g) == BUFFON_E_INVERSION && is_nan(x, 2),
           "a quantile that is not finite is found");
    tap_ok(g.ops->sample(x, NULL, u, 2, &g) != 0 && x[0] == 0.2 && is_nan(x + 1, 1),
           "and leaves NaN at its point alone");
    tap_ok(buffon_density_sample(x, pdf, u, 1, &g) == BUFFON_E_UNSUPPORTED && is_nan(pdf, 1) &&
               buffon_density_pdf(pdf, u, 1, &g) == BUFFON_E_UNSUPPORTED &&
               buffon_density_log_pdf(pdf, u, 1, &g) == BUFFON_E_UNSUPPORTED &&
               !buffon_priv_density_has_pdf(&g),
           "a quantile without pdf has none");
    tap_ok(buffon_density_invert(x, u, 1, &g) == BUFFON_E_UNSUPPORTED && is_nan(x, 1),
           "a quantile without CDF has no way back");
    const struct {
        const char *what;
        buffon_inversion how;
    } bad[] = {
        {"a CDF of NaN", {.cdf = broken, .pdf = one, .lo = 0, .hi = 1}},
        {"a CDF that ends at a half", {.cdf = short_cdf, .pdf = one, .lo = 0, .hi = 1}},
        {"a CDF that ends at a half, on the line", {.cdf = short_cdf, .pdf = one}},
    };
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        v = 0;
        tap_ok(buffon_inverse_sample(&v, pdf, 0.7, &bad[k].how) == BUFFON_E_INVERSION &&
                   is_nan(&v, 1) && is_nan(pdf, 1),
               "%s fails where it does not reach", bad[k].what);
    }
    buffon_inversion late = {.cdf = late_cdf, .pdf = one, .lo = 0, .hi = 1};
    tap_ok(buffon_inverse_sample(&v, NULL, 0.2, &late) == BUFFON_E_INVERSION,
           "a CDF that starts at a half fails below");
    late.lo = late.hi = 0;
    tap_ok(buffon_inverse_sample(&v, NULL, 0.2, &late) == BUFFON_E_INVERSION,
           "a CDF that starts at a half fails below, on the line");
    tap_ok(buffon_inverse_sample(&v, NULL, 0.75, &late) == BUFFON_OK && fabs(v - 0.5) < 1e-15,
           "and works above");
    buffon_inversion rounded = {.cdf = rounded_cdf, .pdf = one, .lo = 0, .hi = 1};
    for (int line = 0; line < 2; line++) {
        double w;
        tap_ok(buffon_inverse_sample(&v, NULL, 1 - 0x1p-53, &rounded) == BUFFON_OK &&
                   fabs(v - 1) < 1e-15 &&
                   buffon_inverse_sample(&w, NULL, 0x1p-53, &rounded) == BUFFON_OK &&
                   w >= -DBL_MAX && w < 1e-15,
               "a CDF a few roundings short of 0 and 1 is no failure%s",
               line ? ", on the line" : "");
        rounded.lo = rounded.hi = 0;
    }
}

/* CDFs of every temper. F crosses u, as computed, within 4 ulp of x. */
static int calls;

static double cauchy_cdf(double x, void *scale)
{
    calls++;
    return x < 0 ? atan(-*(double *)scale / x) / 3.14159265358979323846
                 : 0.5 + atan(x / *(double *)scale) / 3.14159265358979323846;
}

static double cauchy_pdf(double x, void *scale)
{
    const double c = *(double *)scale;
    return 1 / (3.14159265358979323846 * c * (1 + x / c * (x / c)));
}

static double normal_cdf(double x, void *ctx)
{
    (void)ctx;
    calls++;
    return 0.5 * erfc(-x * 0.70710678118654752440);
}

static double normal_pdf(double x, void *ctx)
{
    (void)ctx;
    return 0.39894228040143267794 * exp(-0.5 * x * x);
}

static double exponential_cdf(double x, void *ctx)
{
    (void)ctx;
    calls++;
    return -expm1(-x);
}

static double exponential_pdf(double x, void *ctx)
{
    (void)ctx;
    return exp(-x);
}

static double root_cdf(double x, void *ctx)
{
    (void)ctx;
    calls++;
    return sqrt(x);
}

static double root_pdf(double x, void *ctx)
{
    (void)ctx;
    return 0.5 / sqrt(x);
}

static double power_cdf(double x, void *ctx)
{
    (void)ctx;
    calls++;
    return pow(x, 20);
}

static double power_pdf(double x, void *ctx)
{
    (void)ctx;
    return 20 * pow(x, 19);
}

/* Two plateaus of density with nothing between 1 and 9. */
static double gap_cdf(double x, void *ctx)
{
    (void)ctx;
    calls++;
    return x < 1 ? 0.5 * x : x < 9 ? 0.5 : 0.5 + 0.5 * (x - 9);
}

static double gap_pdf(double x, void *ctx)
{
    (void)ctx;
    return x < 1 || x > 9 ? 0.5 : 0;
}

/* A pdf that lies: the CDF alone must lead to the root. */
static double lying_pdf(double x, void *ctx)
{
    (void)ctx;
    return 1e12 + x;
}

static int crosses(const buffon_inversion *how, double x, double u)
{
    const double far = 0x1p-50 * fabs(x);
    return how->cdf(x - far, how->ctx) <= u && how->cdf(x + far, how->ctx) >= u;
}

static void test_newton(void)
{
    double tiny = 1e-200, one = 1, huge = 1e200;
    const struct {
        const char *name;
        buffon_inversion how;
    } law[] = {
        {"Cauchy", {.cdf = cauchy_cdf, .pdf = cauchy_pdf, .ctx = &one}},
        {"Cauchy of scale 1e-200", {.cdf = cauchy_cdf, .pdf = cauchy_pdf, .ctx = &tiny}},
        {"Cauchy of scale 1e200", {.cdf = cauchy_cdf, .pdf = cauchy_pdf, .ctx = &huge}},
        {"normal", {.cdf = normal_cdf, .pdf = normal_pdf}},
        {"normal on a segment", {.cdf = normal_cdf, .pdf = normal_pdf, .lo = -1e5, .hi = 1e6}},
        {"exponential", {.cdf = exponential_cdf, .pdf = exponential_pdf, .lo = 0, .hi = INFINITY}},
        {"infinite pdf at 0", {.cdf = root_cdf, .pdf = root_pdf, .lo = 0, .hi = 1}},
        {"power of 20", {.cdf = power_cdf, .pdf = power_pdf, .lo = 0, .hi = 1}},
        {"gap", {.cdf = gap_cdf, .pdf = gap_pdf, .lo = 0, .hi = 10}},
        {"normal with a false pdf", {.cdf = normal_cdf, .pdf = lying_pdf}},
    };
    buffon_rng rng = buffon_rng_make(10, 22);
    for (size_t k = 0; k < sizeof law / sizeof *law; k++) {
        int good = 1, most = 0, total = 0;
        for (int i = 0; i < 4000; i++) {
            const double u = i == 4 ? 0.5 : grid(&rng, i);
            double x;
            calls = 0;
            good &= buffon_inverse_sample(&x, NULL, u, &law[k].how) == BUFFON_OK;
            most = calls > most ? calls : most;
            total += calls;
            good &= crosses(&law[k].how, x, u);
        }
        tap_ok(good && most <= 320, "inverse CDF, %s: F crosses u within 4 ulp of x", law[k].name);
        tap_note("%.1f calls of the CDF on average, %d at most", total / 4000.0, most);
    }
}

static double ulp(double x)
{
    const double a = fabs(x);
    return a < DBL_MIN ? 0x1p-1074 : nextafter(a, INFINITY) - a;
}

static void test_table(void)
{
    static double knot[1001], F[1001];
    double error = 0, back = 0;
    buffon_rng rng = buffon_rng_make(11, 22);
    knot[0] = F[0] = -3;
    for (int k = 1; k <= 1000; k++) {
        knot[k] = knot[k - 1] + ldexp(buffon_rng_next(&rng), -(k % 20));
        F[k] = F[k - 1] + ldexp(buffon_rng_next(&rng), -(k % 17));
    }
    const buffon_inversion how = {.x = knot, .F = F, .count = 1001};
    const buffon_density g = buffon_inverse(&how);
    for (int i = 0; i < 100000; i++) {
        const double u = grid(&rng, i);
        double x, v;
        int k = 0;
        if (buffon_density_sample(&x, NULL, &u, 1, &g) != BUFFON_OK ||
            buffon_density_invert(&v, &x, 1, &g) != BUFFON_OK)
            error = INFINITY;
        for (int step = 512; step; step /= 2)
            k += k + step < 1000 && knot[k + step] <= x ? step : 0;
        const wide part = ((wide)x - knot[k]) / ((wide)knot[k + 1] - knot[k]);
        const wide level = (((wide)F[k] - F[0]) + part * ((wide)F[k + 1] - F[k])) /
                           ((wide)F[1000] - F[0]);
        /* What an ulp of x is worth, where the pdf is steep. */
        const double grain = (double)((F[k + 1] - F[k]) / (knot[k + 1] - knot[k]) /
                                      (F[1000] - F[0])) * ulp(x);
        error = fmax(error, fabs((double)(level - u)) / (DBL_EPSILON + grain));
        back = fmax(back, fabs(u - v) / (DBL_EPSILON + grain));
    }
    tap_ok(error <= 2, "table: F(x) is u within 2 ulp of 1 and of x");
    tap_note("up to %.3f", error);
    tap_ok(back <= 4, "table: back to u within 4 of them");
    tap_note("up to %.3f", back);
}

int main(void)
{
    test_refusals();
    test_failures();
    test_newton();
    test_table();
    return tap_done();
}
