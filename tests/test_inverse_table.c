/* Tables of quantile functions: the error in u and in the tails, against CDFs in long double, for
 * the laws of laws40.h; the pdf and the way back; refusals; memory; the same bits at all levels;
 * importance sampling without bias from a coarse table. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <buffon/buffon.h>

#include "laws40.h"
#include "refused.h"
#include "tap.h"

#define N 1000
#define COUNT(array) (sizeof(array) / sizeof *(array))

static double u[N], x[N], pdf[N], back[N];

static buffon_inverse_law law_of(const law40 *l)
{
    return (buffon_inverse_law){.pdf = l->pdf,
                                .ctx = (void *)(uintptr_t)l->p,
                                .lo = l->lo,
                                .hi = l->hi,
                                .centre = l->centre,
                                .breaks = l->at,
                                .breaks_count = l->breaks,
                                .poles = l->at + l->breaks,
                                .poles_count = l->poles};
}

static buffon_inverse_table *make(buffon_inverse_report *report, const buffon_inverse_law *law)
{
    buffon_inverse_table *table;
    const buffon_status status = buffon_inverse_table_new(&table, report, law);
    if (status != BUFFON_OK)
        tap_note("%s: %s at %g", buffon_status_name(status), report->why ? report->why : "",
                 report->where);
    return status == BUFFON_OK ? table : NULL;
}

static double worse(double worst, double value)
{
    return value <= worst ? worst : value;
}

/* ---- accuracy ---- */

/* The largest |F(x) - u| over uniforms of all kinds. */
static double error_in_u(const law40 *l, const buffon_density *g)
{
    double worst = 0;
    for (int i = 0; i < N; i++)
        u[i] = i % 4   ? (i + 0.37) / N
               : i % 8 ? ldexp(i + 1, -i / 20) / N
                       : 1 - ldexp(i + 1, -i / 20) / N;
    if (buffon_density_sample(x, pdf, u, N, g) != BUFFON_OK)
        return 1;
    for (int i = 0; i < N; i++) {
        const long double off = u[i] < 0.5 ? l->lower(x[i], l->p) - u[i]
                                           : (1 - (long double)u[i]) - l->upper(x[i], l->p);
        /* But for what the rounding of x is worth. */
        worst = worse(worst, (double)fabsl(off) - 2 * DBL_EPSILON * fabs(x[i]) * pdf[i]);
    }
    return worst;
}

/* Whether x resolves the distance from the end that the tail hangs on. */
static int resolves(double at, double end)
{
    const double size = fabs(at);
    return size > 1e-290 && size < 1e290 &&
           (end == 0 || !isfinite(end) || fabs(at - end) > 1e-6 * fabs(end));
}

/* The largest relative error of p, from 1e-3 down to `least`. */
static double error_of_tail(const law40 *l, const buffon_inverse_table *table, int upper,
                            double least)
{
    const buffon_density g = buffon_inverse_table_density(table);
    const int line = l->lo == 0 && l->hi == 0;
    double worst = 0;
    for (int i = 0; i < N; i++)
        u[i] = 1e-3 * pow(least / 1e-3, (double)i / (N - 1));
    const buffon_status status = upper ? buffon_inverse_table_upper(x, NULL, u, N, table)
                                       : buffon_density_sample(x, NULL, u, N, &g);
    if (status != BUFFON_OK)
        return 1;
    for (int i = 0; i < N; i++) {
        if (!resolves(x[i], line ? INFINITY : upper ? l->hi : l->lo))
            continue;
        const long double p = upper ? l->upper(x[i], l->p) : l->lower(x[i], l->p);
        worst = worse(worst, (double)fabsl(p / u[i] - 1));
    }
    return worst;
}

static void test_accuracy(const law40 *l)
{
    const buffon_inverse_law law = law_of(l);
    buffon_inverse_report r;
    buffon_inverse_table *table = make(&r, &law);
    if (!tap_ok(table != NULL, "%s: a table", l->name))
        return;
    const buffon_density g = buffon_inverse_table_density(table);
    const double error = error_in_u(l, &g), lower = error_of_tail(l, table, 0, 2 * r.lower);
    const double upper = error_of_tail(l, table, 1, 2 * r.upper);
    if (!tap_ok(error <= 1e-12 && r.u_error <= 1e-12 && lower <= 1e-6 && upper <= 1e-6 &&
                    r.lower < 1e-200 && r.upper < 1e-200,
                "%s: u within 1e-12, tails within 1e-6", l->name))
        tap_note("u %.2g, said to be %.2g; tails %.2g to %.2g, %.2g to %.2g", error, r.u_error,
                 lower, r.lower, upper, r.upper);
    if (l->total > 0)
        tap_ok(fabs(r.total / l->total - 1) < 1e-12, "%s: the integral", l->name);
    buffon_inverse_table_free(table);
}

/* ---- the pdf, the way back ---- */

static void test_density(const law40 *l)
{
    const buffon_inverse_law law = law_of(l);
    buffon_inverse_report r;
    buffon_inverse_table *table = make(&r, &law);
    if (table == NULL)
        return;
    const buffon_density g = buffon_inverse_table_density(table);
    double off_u = 0, off_pdf = 0, off_law = 0;
    int order = 1;
    for (int i = 0; i < N; i++)
        u[i] = (i + 0.5) / N;
    tap_ok(buffon_density_sample(x, pdf, u, N, &g) == BUFFON_OK &&
               buffon_density_invert(back, x, N, &g) == BUFFON_OK,
           "%s: points and back", l->name);
    for (int i = 0; i < N; i++) {
        /* What an ulp of x is worth, twice. */
        const double slack = 1e-13 + 4 * DBL_EPSILON * fabs(x[i]) * pdf[i];
        off_u = worse(off_u, fabs(back[i] - u[i]) / slack);
        off_law = worse(off_law, fabs(pdf[i] * r.total / l->pdf(x[i], law.ctx) - 1));
        order &= i == 0 || x[i] > x[i - 1];
    }
    tap_ok(buffon_density_pdf(back, x, N, &g) == BUFFON_OK, "%s: the pdf at points", l->name);
    for (int i = 0; i < N; i++)
        off_pdf = worse(off_pdf, fabs(back[i] / pdf[i] - 1));
    if (!tap_ok(off_u <= 1 && off_pdf < 1e-9 && off_law < 1e-6 && order,
                "%s: the pdf is that of the points, in order", l->name))
        tap_note("u %.2g, pdf %.2g, law's pdf %.2g", off_u, off_pdf, off_law);
    buffon_inverse_table_free(table);
}

/* The pdf is the derivative of what is drawn, not of what was asked for: a coarse table shows. */
static void test_own_pdf(void)
{
    const buffon_inverse_law law = {.pdf = normal_bell, .ctx = (double[]){0, 1}, .u_error = 1e-3};
    buffon_inverse_report r;
    buffon_inverse_table *table = make(&r, &law);
    const buffon_density g = buffon_inverse_table_density(table);
    double worst = 0, off = 0;
    for (int i = 0; i < N; i++) {
        const double h = 1e-7, at = (i + 0.5) / N;
        double ends[2] = {at - h, at + h}, y[2], slope;
        if (buffon_density_sample(y, NULL, ends, 2, &g) ||
            buffon_density_sample(&x[i], &pdf[i], &at, 1, &g))
            break;
        slope = 2 * h / (y[1] - y[0]);
        worst = worse(worst, fabs(slope / pdf[i] - 1));
        off = worse(off, fabs(pdf[i] * r.total / normal_bell(x[i], law.ctx) - 1));
    }
    tap_ok(worst < 1e-5 && off > 1e-4, "1 / Q' within %.1g, where the law's pdf is off by %.1g",
           worst, off);
    buffon_inverse_table_free(table);
}

static double square(const double *at, void *ctx)
{
    (void)ctx;
    return at[0] * at[0] * exp(-0.5 * at[0] * at[0]) / LAWS_ROOT_2PI;
}

static void test_unbiased(void)
{
    const buffon_inverse_law law = {.pdf = normal_bell, .ctx = (double[]){0, 1}, .u_error = 1e-3};
    const buffon_points points = buffon_points_sobol(BUFFON_SCRAMBLE_OWEN);
    buffon_inverse_report r;
    buffon_inverse_table *table = make(&r, &law);
    const buffon_density g = buffon_inverse_table_density(table);
    buffon_estimate e;
    const buffon_status status =
        buffon_importance(&e, &(buffon_integrand){.scalar = square, .dim = 1}, &g,
                          &(buffon_run){.samples = 1 << 16, .seed = 5, .points = &points});
    tap_ok(status == BUFFON_OK && e.std_error < 1e-3 && fabs(e.value - 1) < 5 * e.std_error,
           "importance sampling from %zu cells is unbiased: %.7f +- %.7f", r.cells, e.value,
           e.std_error);
    buffon_inverse_table_free(table);
}

/* ---- edges ---- */

static void test_edges(const law40 *l)
{
    static const double edges[] = {0x1p-1074, 1e-310, 1e-305, 0x1p-53, 0.5, 1 - 0x1p-53};
    const buffon_inverse_law law = law_of(l);
    buffon_inverse_table *table = make(&(buffon_inverse_report){0}, &law);
    const buffon_density g = buffon_inverse_table_density(table);
    double at[COUNT(edges)], value[COUNT(edges)], outside[3] = {-INFINITY, INFINITY, NAN}, zero[3];
    int good = buffon_density_sample(at, value, edges, COUNT(edges), &g) == BUFFON_OK;
    for (size_t i = 0; i < COUNT(edges) && good; i++)
        good = isfinite(at[i]) && value[i] > 0 && isfinite(value[i]) &&
               (i == 0 || at[i] >= at[i - 1]) &&
               (l->lo >= l->hi || (at[i] >= l->lo && at[i] <= l->hi));
    good &= buffon_density_pdf(zero, outside, 3, &g) == BUFFON_OK;
    tap_ok(good && zero[0] == 0 && zero[1] == 0 && zero[2] == 0, "%s: edges", l->name);
    buffon_inverse_table_free(table);
}

static void test_both_ends(void)
{
    const buffon_inverse_law law = {.pdf = normal_bell, .ctx = (double[]){0, 1}};
    buffon_inverse_table *table = make(&(buffon_inverse_report){0}, &law);
    const double q[4] = {1e-200, 1e-20, 0.25, 0.75};
    double at[4], lower[4], upper[4], worst = 0;
    tap_ok(buffon_inverse_table_upper(at, NULL, q, 4, table) == BUFFON_OK &&
               buffon_inverse_table_cdf(lower, upper, at, 4, table) == BUFFON_OK &&
               buffon_inverse_table_cdf(NULL, upper, at, 4, table) == BUFFON_OK,
           "points from above and their CDF");
    for (int i = 0; i < 4; i++)
        worst = worse(worst, fabs(upper[i] / q[i] - 1) + fabs(lower[i] - (1 - q[i])));
    tap_ok(worst < 1e-12 && at[0] > 30 && at[0] < 31, "the upper tail keeps its digits: %.2g",
           worst);
    buffon_inverse_table_free(table);
}

/* ---- refusals ---- */

static double negative(double at, void *p)
{
    (void)p;
    return at - 0.5;
}

static double not_a_number(double at, void *p)
{
    (void)p;
    return at < 0.25 ? NAN : 1;
}

static double hyperbola(double at, void *p)
{
    (void)p;
    return 1 / at;
}

static double slow(double at, void *p)
{
    (void)p;
    return 1 / (1 + fabs(at));
}

static double nought(double at, void *p)
{
    (void)p;
    return 0 * at;
}

static double pole_inside(double at, void *p)
{
    (void)p;
    return 1 / sqrt(fabs(at - 0.5));
}

static double constant(double at, void *p)
{
    (void)at;
    (void)p;
    return 1;
}

static void refuse(buffon_inverse_law law, buffon_status status, const char *what)
{
    buffon_inverse_report r;
    buffon_inverse_table *table = (buffon_inverse_table *)(uintptr_t)&r;
    const buffon_status got = buffon_inverse_table_new(&table, &r, &law);
    if (!tap_ok(got == status && r.status == status && table == NULL &&
                    (status != BUFFON_E_PDF || r.why != NULL),
                "%s is refused: %s%s%s", what, buffon_status_name(status), r.why ? ", " : "",
                r.why ? r.why : ""))
        tap_note("%s", buffon_status_name(got));
}

static void test_refusals(void)
{
    const double nan = NAN, wrong = 2;
    refuse((buffon_inverse_law){.lo = 0, .hi = 1}, BUFFON_E_NULL, "no pdf");
    refuse((buffon_inverse_law){.pdf = constant, .lo = 1, .hi = 1}, BUFFON_E_DOMAIN, "lo = hi");
    refuse((buffon_inverse_law){.pdf = constant, .lo = nan, .hi = 1}, BUFFON_E_DOMAIN, "lo NaN");
    refuse((buffon_inverse_law){.pdf = constant, .lo = -DBL_MAX, .hi = DBL_MAX}, BUFFON_E_DOMAIN,
           "too wide a domain");
    refuse((buffon_inverse_law){.pdf = constant, .hi = 1, .centre = INFINITY}, BUFFON_E_DOMAIN,
           "centre infinite");
    refuse((buffon_inverse_law){.pdf = constant, .hi = 1, .breaks = &wrong, .breaks_count = 1},
           BUFFON_E_DOMAIN, "a break outside");
    refuse((buffon_inverse_law){.pdf = constant, .hi = 1, .poles = &nan, .poles_count = 1},
           BUFFON_E_DOMAIN, "a pole NaN");
    refuse((buffon_inverse_law){.pdf = constant, .hi = 1, .poles_count = 1}, BUFFON_E_NULL,
           "poles that are not there");
    refuse((buffon_inverse_law){.pdf = constant, .hi = 1, .u_error = 1e-14}, BUFFON_E_TOLERANCE,
           "u_error too small");
    refuse((buffon_inverse_law){.pdf = constant, .hi = 1, .u_error = nan}, BUFFON_E_TOLERANCE,
           "u_error NaN");
    refuse((buffon_inverse_law){.pdf = constant, .hi = 1, .tail = 0.5}, BUFFON_E_TOLERANCE,
           "tail too large");
    refuse((buffon_inverse_law){.pdf = constant, .hi = 1, .reserved = {1}}, BUFFON_E_RESERVED,
           "a reserved word");
    refuse((buffon_inverse_law){.pdf = negative, .hi = 1}, BUFFON_E_PDF, "a negative pdf");
    refuse((buffon_inverse_law){.pdf = not_a_number, .hi = 1}, BUFFON_E_PDF, "a pdf that is NaN");
    refuse((buffon_inverse_law){.pdf = hyperbola, .hi = 1}, BUFFON_E_PDF, "1 / x on (0, 1)");
    refuse((buffon_inverse_law){.pdf = hyperbola, .lo = 1, .hi = INFINITY}, BUFFON_E_PDF,
           "1 / x beyond 1");
    refuse((buffon_inverse_law){.pdf = slow}, BUFFON_E_PDF, "1 / (1 + |x|)");
    refuse((buffon_inverse_law){.pdf = constant}, BUFFON_E_PDF, "a constant on the line");
    refuse((buffon_inverse_law){.pdf = nought, .hi = 1}, BUFFON_E_PDF, "a pdf that is nought");
    buffon_inverse_report r;
    buffon_inverse_table *table;
    const buffon_inverse_law below = {.pdf = negative, .hi = 1};
    const buffon_inverse_law heavy = {.pdf = hyperbola, .lo = 1, .hi = INFINITY};
    buffon_status status = buffon_inverse_table_new(&table, &r, &below);
    tap_ok(status == BUFFON_E_PDF && negative(r.where, NULL) < 0 &&
               strstr(r.why, "negative") != NULL,
           "the place is told: %g, %s", r.where, r.why);
    status = buffon_inverse_table_new(&table, &r, &heavy);
    tap_ok(status == BUFFON_E_PDF && r.where > DBL_MAX, "the place is told: %g, %s", r.where,
           r.why);
    tap_ok(buffon_inverse_table_new(NULL, NULL, NULL) == BUFFON_E_NULL, "no place for the table");
    refused_by_value(buffon_inverse_table_density(NULL), BUFFON_E_NULL, "no table");
    const double words[64] = {0};
    refused_by_value(
        buffon_inverse_table_density((const buffon_inverse_table *)(const void *)words),
        BUFFON_E_TABLE, "what is no table");
}

/* What should have been told, and was not: a pole within said to be a break, jumps, a kink. */
static void test_untold(void)
{
    const double half = 0.5;
    const struct {
        const char *what;
        buffon_inverse_law law;
    } laws[] = {{"a pole told as a break",
                 {.pdf = pole_inside, .hi = 1, .breaks = &half, .breaks_count = 1}},
                {"steps without breaks", {.pdf = steps_pdf, .hi = 4}},
                {"Laplace off its centre", {.pdf = laplace_pdf, .centre = 0.3}}};
    for (size_t k = 0; k < COUNT(laws); k++) {
        buffon_inverse_report r;
        buffon_inverse_table *table = make(&r, &laws[k].law);
        tap_ok(table != NULL && r.u_error <= 1e-12, "%s: %zu cells, %u calls", laws[k].what,
               r.cells, (unsigned)r.calls);
        buffon_inverse_table_free(table);
    }
}

/* ---- memory ---- */

static void test_memory(void)
{
    const buffon_inverse_law law = {.pdf = normal_bell, .ctx = (double[]){0, 1}, .tail = 1e-20};
    static double memory[1 << 14], elsewhere[1 << 14];
    buffon_inverse_report r;
    int refusals = 0, wild = 0;
    for (size_t bytes = 0; bytes < sizeof memory - 8; bytes += 1000) {
        memset(memory, 0x5a, sizeof memory);
        const buffon_status got = buffon_inverse_table_build(memory, bytes, &r, &law);
        refusals += got == BUFFON_E_NOMEM;
        wild += got != BUFFON_E_NOMEM && got != BUFFON_OK;
        for (size_t k = bytes; k < sizeof memory; k++)
            wild += ((const unsigned char *)memory)[k] != 0x5a;
    }
    tap_ok(refusals > 5 && wild == 0, "memory too small is refused, and nothing written beyond it");
    const buffon_status status = buffon_inverse_table_build(memory, sizeof memory, &r, &law);
    tap_ok(status == BUFFON_OK, "a table in the caller's memory: %zu bytes", r.bytes);
    const buffon_inverse_table *table = (const buffon_inverse_table *)(const void *)memory;
    tap_ok(buffon_inverse_table_bytes(table) == r.bytes && r.bytes <= sizeof elsewhere, "its size");
    memcpy(elsewhere, memory, r.bytes);
    const buffon_density g = buffon_inverse_table_density(table);
    const buffon_density h =
        buffon_inverse_table_density((const buffon_inverse_table *)(const void *)elsewhere);
    for (int i = 0; i < N; i++)
        u[i] = (i + 0.5) / N;
    tap_ok(buffon_density_sample(x, NULL, u, N, &g) == BUFFON_OK &&
               buffon_density_sample(back, NULL, u, N, &h) == BUFFON_OK &&
               memcmp(x, back, sizeof x) == 0,
           "a copy draws the same");
}

static void test_levels(void)
{
    const buffon_inverse_law law = law_of(&laws40[9]);
    buffon_inverse_table *table = make(&(buffon_inverse_report){0}, &law);
    const buffon_density g = buffon_inverse_table_density(table);
    static double first[N], first_pdf[N];
    int same = 1;
    for (int i = 0; i < N; i++)
        u[i] = i % 5 ? (i + 0.5) / N : ldexp(i + 1, -11 - i / 3);
    for (int level = 0; level <= (int)BUFFON_LEVEL_AVX512; level++) {
        buffon_cpu_limit((buffon_level)level);
        for (size_t n = N - 7; n <= N; n++) {
            same &= buffon_density_sample(x, pdf, u, n, &g) == BUFFON_OK;
            if (level == 0 && n == N - 7) {
                buffon_status s = buffon_density_sample(first, first_pdf, u, N, &g);
                same &= s == BUFFON_OK;
            }
            same &=
                memcmp(x, first, n * sizeof *x) == 0 && memcmp(pdf, first_pdf, n * sizeof *x) == 0;
        }
    }
    buffon_cpu_limit(BUFFON_LEVEL_AVX512);
    for (int i = 0; i < N; i++)
        same &= buffon_density_sample(&x[i], NULL, &u[i], 1, &g) == BUFFON_OK && x[i] == first[i];
    tap_ok(same, "the same bits at all levels and for any n");
    buffon_inverse_table_free(table);
}

int main(void)
{
    for (size_t k = 0; k < LAWS_COUNT; k++) {
        if (LDBL_MANT_DIG > 60)
            test_accuracy(&laws40[k]);
        test_density(&laws40[k]);
        test_edges(&laws40[k]);
    }
    test_own_pdf();
    test_unbiased();
    test_both_ends();
    test_refusals();
    test_untold();
    test_memory();
    test_levels();
    return tap_done();
}
