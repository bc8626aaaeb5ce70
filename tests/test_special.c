/* The gamma, beta and t laws: quantiles against 20-digit references, densities and probabilities
 * in extended precision or by known values, order, ends and refusals. */
#include <buffon/buffon.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "bell.h"
#include "refused.h"
#include "special.h"
#include "tap.h"
#include "wide_gamma.h"

#ifndef BUFFON_TEST_DATA
#define BUFFON_TEST_DATA "tests/data"
#endif

/* ---- tables ---- */

enum { FIELDS = 6 };

static FILE *table_open(const char *name)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", BUFFON_TEST_DATA, name);
    FILE *file = fopen(path, "r");
    if (!file)
        tap_ok(0, "%s can be read", path);
    return file;
}

/* The next row: its name and the numbers after it, NaN where a field is empty. */
static int table_row(char name[32], double value[FIELDS], FILE *file)
{
    char line[512], *at = line;
    if (!file || !fgets(line, sizeof line, file))
        return 0;
    snprintf(name, 32, "%.*s", (int)strcspn(line, ","), line);
    for (int k = 0; k < FIELDS; k++) {
        at += strcspn(at, ",\n");
        at += *at == ',';
        value[k] = *at == ',' || *at == '\n' || *at == '\0' ? NAN : strtod(at, NULL);
    }
    return 1;
}

static double relative(double got, double want)
{
    const double error = want == 0 ? fabs(got) : fabs(got / want - 1);
    return error == error ? error : INFINITY;
}

static double one_x(const buffon_density *g, double u)
{
    double x;
    return buffon_density_sample(&x, NULL, &u, 1, g) == BUFFON_OK ? x : NAN;
}

static double one_pdf(const buffon_density *g, double x)
{
    double pdf;
    return buffon_density_pdf(&pdf, &x, 1, g) == BUFFON_OK ? pdf : NAN;
}

static double one_log_pdf(const buffon_density *g, double x)
{
    double log_pdf;
    return buffon_density_log_pdf(&log_pdf, &x, 1, g) == BUFFON_OK ? log_pdf : NAN;
}

static double one_u(const buffon_density *g, double x)
{
    double u;
    return buffon_density_invert(&u, &x, 1, g) == BUFFON_OK ? u : NAN;
}

static buffon_density law_of(const char *name, double a, double b)
{
    if (strcmp(name, "gamma") == 0)
        return buffon_gamma(a, 1);
    return strcmp(name, "beta") == 0 ? buffon_beta(a, b) : buffon_student_t(a);
}

static void test_quantiles(const char *law, int least, double limit)
{
    FILE *file = table_open("law_reference.csv");
    char name[32];
    double v[FIELDS], worst = 0, at[3] = {0};
    int rows = 0;
    while (table_row(name, v, file)) {
        if (strcmp(name, law) != 0)
            continue;
        const buffon_density g = law_of(law, v[0], v[1]);
        const double error = relative(one_x(&g, v[2]), v[3]);
        rows++;
        if (error > worst) {
            worst = error;
            memcpy(at, v, sizeof at);
        }
    }
    if (file)
        fclose(file);
    tap_ok(rows >= least && worst <= limit, "%s quantiles: %d rows, within %.2g", law, rows, limit);
    tap_note("worst %.3g at %g %g, u = %g", worst, at[0], at[1], at[2]);
}

/* ---- parts of the gamma function ---- */

static void test_parts(void)
{
    double stirling = 0, above = 0, lgamma1p = 0, deviance = 0;
    for (int k = 1; k < 3000; k++) {
        const double z = ldexp(1 + (k % 97) / 97.0, k % 60 - 5);
        const wide exact = wide_stirling(z);
        const double off = fabs((double)(buffon_priv_stirling(z) - exact));
        stirling = fmax(stirling, off);
        above = fmax(above, z >= 1.5 ? off : 0);
        const double a = 1.5 * k / 3000;
        const double error = fabs((double)(buffon_priv_lgamma1p(a) - wide_lgamma1p(a)));
        lgamma1p = fmax(lgamma1p, error / fmax(fabs((double)wide_lgamma1p(a)), 0.01));
        const double d = k % 2 ? -k / 3000.0 : ldexp(k / 3000.0, 4 - k % 40);
        deviance = fmax(deviance, relative(buffon_priv_deviance(d), (double)wide_deviance(d)));
    }
    tap_ok(stirling <= 1e-15 && above <= 1e-16,
           "errors of Stirling's formula: %.2g, %.2g from 3/2 up", stirling, above);
    tap_ok(lgamma1p <= 5e-15, "log Gamma(1 + a): %.2g, relative", lgamma1p);
    tap_ok(relative(buffon_priv_lgamma1p(1e-20), -0.57721566490153286e-20) <= 4e-16 &&
               relative(buffon_priv_lgamma1p(1 + 0x1p-40), 0.42278433509846714 * 0x1p-40) <=
                   1e-12 &&
               buffon_priv_lgamma1p(1) == 0,
           "log Gamma(1 + a) near its zeros");
    tap_ok(deviance <= 2e-15, "d - log(1 + d): %.2g", deviance);
}

/* The coefficients obey s[1] = n (1 - G), which the recursion does not use. */
static void test_bell(void)
{
    static const double n[] = {10, 11.5, 30, 1e3, 1e8};
    double gamma = 0, beta = 0;
    for (size_t k = 0; k < sizeof n / sizeof *n; k++) {
        buffon_priv_bell bell;
        const double log_gain = -buffon_priv_stirling(n[k]);
        buffon_priv_bell_make(&bell, 1, 0, n[k], log_gain, 1, 1);
        gamma = fmax(gamma, fabs(bell.s[1] + n[k] * expm1(log_gain)));
        const double a = n[k], b = 7 * n[k], whole = a + b;
        const double gain =
            buffon_priv_stirling(whole) - buffon_priv_stirling(a) - buffon_priv_stirling(b);
        buffon_priv_bell_make(&bell, (b - a) / whole, a * b / (whole * whole), a * b / whole, gain,
                              b / whole, 1);
        beta = fmax(beta, fabs(bell.s[1] + bell.n * expm1(gain)));
    }
    tap_ok(gamma <= 1e-14 && beta <= 1e-14, "nearly normal laws: s[1] = n (1 - G): %.2g %.2g",
           gamma, beta);
}

/* ---- probabilities ---- */

/* What a row of the table says of P(X <= x): the law and x. A tail is as many times its own size
 * off as it has e-folds. */
static int cdf_row(buffon_density *g, double *x, double *want, const char *name, const double *v)
{
    *want = v[3];
    if (strcmp(name, "gamma_p") == 0) {
        *g = buffon_gamma(v[0], 1);
        *x = v[1];
    } else if (strcmp(name, "beta_inc") == 0) {
        *g = buffon_beta(v[1], v[2]);
        *x = v[0];
    } else if (strcmp(name, "t_sf") == 0) {
        *g = buffon_student_t(v[1]);
        *x = -v[0];
    } else {
        return 0;
    }
    return v[3] > 1e-300;
}

static void test_cdf(const char *table, int least)
{
    FILE *file = table_open("special_reference.csv");
    char name[32];
    double v[FIELDS], worst = 0;
    int rows = 0;
    while (table_row(name, v, file)) {
        buffon_density g;
        double x, want;
        if (strcmp(name, table) != 0 || !cdf_row(&g, &x, &want, name, v))
            continue;
        const double room = 1 + fabs(log(want));
        worst = fmax(worst, relative(one_u(&g, x), fmin(want, 1 - 0x1p-53)) / room);
        rows++;
    }
    if (file)
        fclose(file);
    tap_ok(rows >= least && worst <= 4e-15, "probabilities of %s: %d rows, %.2g (1 + |log u|)",
           table, rows, worst);
}

/* ---- the gamma law ---- */

static wide wide_log_gamma_pdf(wide a, wide x)
{
    if (a < 1)
        return (a - 1) * logl(x) - x - (wide_lgamma1p(a) - logl(a));
    const wide d = (x - a) / a, dev = fabsl(d) < 0.5L ? wide_deviance(d) : d - logl(x / a);
    return 0.5L * (logl(a) - WIDE_LOG_2PI) - wide_stirling(a) - a * dev - logl(x);
}

/* g at a given x; the limit is that of the header. */
static void test_gamma_pdf(void)
{
    static const double shape[] = {1e-10, 1e-3, 0.3, 1, 1.7, 9, 40, 1e3, 1e6, 1e10, 1e15};
    double worst = 0, log_worst = 0;
    for (size_t k = 0; k < sizeof shape / sizeof *shape; k++) {
        const buffon_density g = buffon_gamma(shape[k], 1);
        for (int i = 1; i < 400; i++) {
            const double x = one_x(&g, i < 200 ? i / 200.0 : ldexp(1, (i - 400) * 4));
            const wide exact = wide_log_gamma_pdf(shape[k], x);
            const double room = 1 + fabs((double)(exact + logl(x)));
            if (exact < 700 && exact > -700)
                worst = fmax(worst, fabs((double)(one_pdf(&g, x) / expl(exact) - 1)) / room);
            log_worst =
                fmax(log_worst, fabs((double)(one_log_pdf(&g, x) - exact)) / (room + fabs(log(x))));
        }
    }
    tap_ok(worst <= 4e-15 && log_worst <= 4e-15,
           "gamma pdf and its log: %.2g and %.2g of 1 + |log|", worst, log_worst);
}

static void test_gamma_ends(void)
{
    const buffon_density g = buffon_gamma(1e-3, 1), h = buffon_gamma(1e-100, 1);
    double u = 0.25, x, pdf;
    const int same = buffon_density_sample(&x, &pdf, &u, 1, &g) == BUFFON_OK;
    tap_ok(same && x == DBL_MIN && pdf > 0 && pdf <= DBL_MAX && one_x(&h, 1 - 0x1p-53) == DBL_MIN,
           "points below the normal doubles lie at the least of them");
    tap_ok(one_pdf(&g, 0) == 0 && one_pdf(&g, -1) == 0 && one_pdf(&g, INFINITY) == 0 &&
               one_log_pdf(&g, -1) == -INFINITY && one_log_pdf(&g, NAN) == -INFINITY,
           "gamma: no density outside");
    tap_ok(relative(one_pdf(&h, 0x1p-1074), 2.0240225330731062e+223) < 1e-14,
           "gamma: a density next to 0 whose inverse of x is none");
    const buffon_density chi = buffon_chi_square(3), as = buffon_gamma(1.5, 2);
    tap_ok(one_x(&chi, 0.3) == one_x(&as, 0.3), "chi-square is the gamma law");
    const buffon_density unit = buffon_gamma(1, 1);
    double worst = 0;
    for (int i = 1; i < 100; i++)
        worst = fmax(worst, relative(one_x(&unit, i / 100.0), -log1p(-i / 100.0)));
    tap_ok(worst <= 2e-15, "gamma of shape 1 is exponential: %.2g", worst);
}

/* ---- the beta law ---- */

static wide wide_log_beta_pdf(wide a, wide b, wide x)
{
    const wide n = a + b, y = 1 - x, excess = a == b ? a * (x - y) : x * b - y * a;
    const wide d = excess / a, e = -excess / b;
    const wide peak = 0.5L * (logl(a) + logl(b) - logl(n) - WIDE_LOG_2PI) + wide_stirling(n) -
                      wide_stirling(a) - wide_stirling(b);
    const wide left = d < -0.5L ? d - logl(x * n / a) : wide_deviance(d);
    const wide right = e < -0.5L ? e - logl(y * n / b) : wide_deviance(e);
    return peak - a * left - b * right - logl(x) - logl(y);
}

static void test_beta_pdf(void)
{
    static const double shape[] = {1e-3, 0.2, 1, 3.5, 11, 300, 1e5, 1e8};
    double worst = 0, log_worst = 0;
    for (size_t k = 0; k < 64; k++) {
        const double a = shape[k / 8], b = shape[k % 8];
        const buffon_density g = buffon_beta(a, b);
        for (int i = 1; i < 100; i++) {
            const double x = one_x(&g, i < 80 ? i / 80.0 : ldexp(1, (i - 100) * 40));
            const wide exact = wide_log_beta_pdf(a, b, x);
            const double logs = fabs(log(x)) + fabs(log1p(-x));
            const double room = 1 + fabs((double)(exact + logl(x) + log1pl(-x)));
            if (exact < 700 && exact > -700)
                worst = fmax(worst, fabs((double)(one_pdf(&g, x) / expl(exact) - 1)) / room);
            log_worst = fmax(log_worst, fabs((double)(one_log_pdf(&g, x) - exact)) / (room + logs));
        }
    }
    tap_ok(worst <= 2e-15 && log_worst <= 2e-15, "beta pdf and its log: %.2g and %.2g of 1 + |log|",
           worst, log_worst);
}

/* Where g x is near 1 in a wide law, two logarithms of size 20 cancel. At half the mode of a large
 * shape two of size a do. */
static void test_large_pdf(void)
{
    double gamma = 0, beta = 0, half = 0;
    for (double a = 1e5; a <= 1e15; a *= 10) {
        const buffon_density g = buffon_gamma(a, 1), h = buffon_beta(a, a);
        for (int i = 0; i < 40; i++) {
            const double sign = i % 2 ? 1 : -1, r = sqrt(log(a / 6.28) * (0.9 + i / 200.0) / a);
            const double x = a * (1 + sign * r), y = 0.5 * (1 + sign * sqrt(0.5) * r);
            const wide of_x = wide_log_gamma_pdf(a, x), of_y = wide_log_beta_pdf(a, a, y);
            const double at_x = 1 + fabs((double)(of_x + logl(x)));
            const double at_y = 1 + fabs((double)(of_y + logl(y) + log1pl(-y)));
            gamma = fmax(gamma, fabs((double)(one_pdf(&g, x) / expl(of_x) - 1)) / at_x);
            beta = fmax(beta, fabs((double)(one_pdf(&h, y) / expl(of_y) - 1)) / at_y);
        }
        const wide of_half = wide_log_gamma_pdf(a, 0.49 * a);
        half = fmax(half, fabs((double)(one_log_pdf(&g, 0.49 * a) / of_half - 1)));
    }
    tap_ok(gamma <= 1e-14 && beta <= 2e-14, "large shapes: gamma %.2g, beta %.2g", gamma, beta);
    tap_ok(half <= 2e-15, "log of the gamma pdf at half the mode: %.2g", half);
}

/* Near 0 the CDF is a power of x but for a part x of it. */
static void test_small_shapes(void)
{
    double gamma = 0, beta = 0;
    for (int i = 0; i < 400; i++) {
        const double a = 1e-3 * (1 + i % 20), u = 0.5 + i / 2000.0;
        const buffon_density g = buffon_gamma(a, 1), h = buffon_beta(a, 2);
        const wide x = expl((logl(u) + wide_lgamma1p(a)) / a),
                   y = expl(logl(u / (1 + (wide)a)) / a);
        if (x > 0x1p-1000L && x < 1e-17L)
            gamma = fmax(gamma, relative(one_x(&g, u), (double)x));
        if (y > 0x1p-1000L && y < 1e-17L)
            beta = fmax(beta, relative(one_x(&h, u), (double)y));
    }
    tap_ok(gamma <= 5e-13 && beta <= 1e-12, "quantiles of small shapes: gamma %.2g, beta %.2g",
           gamma, beta);
}

static void test_beta_ends(void)
{
    const buffon_density g = buffon_beta(1e-3, 1e-3), power = buffon_beta(3, 1);
    tap_ok(one_x(&g, 0.1) == DBL_MIN && one_x(&g, 0.9) == 1 - 0x1p-53 && one_pdf(&g, DBL_MIN) > 0 &&
               one_pdf(&g, DBL_MIN) <= DBL_MAX && one_pdf(&g, 1 - 0x1p-53) > 0,
           "beta points next to 0 and 1 lie at the nearest normal doubles");
    tap_ok(one_pdf(&g, 0) == 0 && one_pdf(&g, 1) == 0 && one_pdf(&g, -1) == 0 &&
               one_pdf(&g, 2) == 0 && one_log_pdf(&g, 1) == -INFINITY,
           "beta: no density outside");
    double worst = 0;
    for (int i = 1; i < 100; i++)
        worst = fmax(worst, relative(one_x(&power, i / 100.0), cbrt(i / 100.0)));
    tap_ok(worst <= 1e-15, "beta of 3 and 1 is a power: %.2g", worst);
}

/* ---- Student's law ---- */

static void test_student_pdf(void)
{
    static const double dof[] = {1e-3, 0.3, 1, 2, 4.5, 19, 21, 300, 1e6, 1e15};
    double worst = 0;
    for (size_t k = 0; k < sizeof dof / sizeof *dof; k++) {
        const buffon_density g = buffon_student_t(dof[k]);
        const wide n = dof[k], z = n / 2, half = 0.5L / z;
        const wide ratio = z < 100 ? z * log1pl(half) - 0.5L : -z * wide_deviance(half);
        const wide peak = wide_stirling(z + 0.5L) - wide_stirling(z) + ratio - 0.5L * WIDE_LOG_2PI;
        for (int i = 1; i < 200; i++) {
            const double x = one_x(&g, i < 150 ? i / 150.0 : ldexp(1, (i - 200) * 20));
            const wide fall = 0.5L * (n + 1) * log1pl((wide)x * x / n), exact = peak - fall;
            if (exact > -700)
                worst = fmax(worst, fabs((double)(one_pdf(&g, x) / expl(exact) - 1)) /
                                        (1 + fabs((double)exact)));
        }
    }
    tap_ok(worst <= 1e-15, "t pdf: %.2g of 1 + |log|", worst);
}

static void test_student_known(void)
{
    const buffon_density one = buffon_student_t(1), two = buffon_student_t(2);
    double tangent = 0, algebraic = 0;
    for (int i = 1; i < 400; i++) {
        const double u = i < 200 ? i / 400.0 : ldexp(1, (199 - i) * 4);
        const wide angle = 3.14159265358979323846264338327950288L * u;
        tangent = fmax(tangent, relative(one_x(&one, u), (double)(-cosl(angle) / sinl(angle))));
        const wide q = u, root = sqrtl(2 * q * (1 - q));
        algebraic = fmax(algebraic, relative(one_x(&two, u), (double)((2 * q - 1) / root)));
    }
    tap_ok(tangent <= 1e-15 && algebraic <= 1e-15, "t of 1 and 2 degrees of freedom: %.2g %.2g",
           tangent, algebraic);
}

/* Mirrors of each other, 0 in the middle, no farther than 2^1000. */
static void test_student_ends(void)
{
    static const double dof[] = {1e-3, 0.7, 1, 2, 5, 19.9, 20, 80, 1e9};
    int odd = 1, middle = 1;
    for (size_t k = 0; k < sizeof dof / sizeof *dof; k++) {
        const buffon_density g = buffon_student_t(dof[k]);
        middle &= one_x(&g, 0.5) == 0 && one_u(&g, 0) == 0.5;
        for (int i = 1; i < 60; i++) {
            const double u = i < 50 ? i / 128.0 : ldexp(1, -(i - 48) * 4);
            odd &= one_x(&g, u) == -one_x(&g, 1 - u) && one_x(&g, u) < 0;
        }
    }
    tap_ok(odd && middle, "t points are exact mirrors, and 0 is in the middle");
    const buffon_density far = buffon_student_t(1e-3);
    tap_ok(one_x(&far, 0.1) == -0x1p1000 && one_pdf(&far, 0x1p1000) >= DBL_MIN &&
               one_pdf(&far, INFINITY) == 0 && one_pdf(&far, NAN) == 0 && one_u(&far, 1e300) > 0.5,
           "t points far out lie at 2^1000");
}

/* ---- all of them ---- */

/* Points rise with u, but for rounding, also where one method gives way to another. */
static void test_order(const char *name, const buffon_density *g)
{
    double last = -INFINITY, fall = 0;
    for (int i = 1; i < 4000; i++) {
        const double x = one_x(g, i < 2000 ? i / 2000.0 : 1 - ldexp(1, -1 - (i - 2000) / 40));
        if (i != 2000 && x < last)
            fall = fmax(fall, (last - x) / fabs(x));
        last = x;
    }
    tap_ok(fall <= 4e-15, "%s: in order within %.2g", name, fall);
}

static void test_orders(void)
{
    static const double shape[] = {0.02, 0.7, 3, 9.99, 10, 14, 1e5};
    for (size_t k = 0; k < sizeof shape / sizeof *shape; k++) {
        const double a = shape[k], b = shape[(k + 3) % 7];
        const buffon_density g[] = {buffon_gamma(a, 1), buffon_beta(a, b), buffon_student_t(a)};
        char name[32];
        snprintf(name, sizeof name, "gamma %g", a);
        test_order(name, &g[0]);
        snprintf(name, sizeof name, "beta %g %g", a, b);
        test_order(name, &g[1]);
        snprintf(name, sizeof name, "t %g", a);
        test_order(name, &g[2]);
    }
}

static void test_refusals(void)
{
    static const double bad[] = {0, -1, -INFINITY, INFINITY, NAN, 1e-101, 1e201};
    int wrong = 0;
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        wrong += buffon_gamma(bad[k], 1).status != BUFFON_E_SHAPE;
        wrong += k != 5 && buffon_gamma(1, bad[k]).status != BUFFON_E_SHAPE;
        wrong += buffon_chi_square(bad[k]).status != BUFFON_E_SHAPE;
    }
    wrong += buffon_gamma(1e-100, 1e-200).status != BUFFON_OK;
    wrong += buffon_gamma(1e100, 1e200).status != BUFFON_OK;
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        wrong += buffon_beta(bad[k], 1).status != BUFFON_E_SHAPE;
        wrong += buffon_beta(1, bad[k]).status != BUFFON_E_SHAPE;
        wrong += buffon_student_t(bad[k]).status != BUFFON_E_SHAPE;
    }
    wrong += buffon_beta(1e-3, 1e15).status != BUFFON_OK;
    wrong += buffon_student_t(1e-3).status != BUFFON_OK;
    wrong += buffon_student_t(1e100).status != BUFFON_OK;
    tap_ok(wrong == 0, "parameters outside their range are refused, none inside");
    refused_by_value(buffon_gamma(-1, 1), BUFFON_E_SHAPE, "gamma of a negative shape");
    refused_by_value(buffon_beta(0, 1), BUFFON_E_SHAPE, "beta of no shape");
    refused_by_value(buffon_student_t(NAN), BUFFON_E_SHAPE, "t of no degrees of freedom");
}

int main(void)
{
    if (LDBL_MANT_DIG >= 64) {
        test_parts();
        test_gamma_pdf();
        test_beta_pdf();
        test_large_pdf();
        test_small_shapes();
        test_student_pdf();
        test_student_known();
    }
    test_bell();
    test_quantiles("gamma", 150, 5e-14);
    test_quantiles("beta", 100, 2e-13);
    test_quantiles("t", 90, 1e-13);
    test_cdf("gamma_p", 70);
    test_cdf("beta_inc", 50);
    test_cdf("t_sf", 60);
    test_gamma_ends();
    test_beta_ends();
    test_student_ends();
    test_orders();
    test_refusals();
    return tap_done();
}
