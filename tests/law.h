/* Statistics for tests of laws: p-values, and the rule by which they are judged.
 *
 * Every check fails with probability 1e-9 if all is well, half of it in each tail: data that agree
 * too well are as suspicious as data that disagree. With fewer than a thousand checks in the suite
 * a false alarm anywhere has probability below 1e-6; as seeds are fixed, it would be seen once and
 * for all. Nothing is ever drawn again.
 */
#ifndef TESTS_LAW_H
#define TESTS_LAW_H

#include <math.h>
#include <stdlib.h>

#include "tap.h"

#define LAW_ALPHA 1e-9
#define LAW_PI 3.14159265358979323846

#if defined(__GNUC__) || defined(__clang__)
#define LAW_UNUSED __attribute__((unused))
#else
#define LAW_UNUSED
#endif

/* Whether a p-value passes. */
LAW_UNUSED static int law_passes(double p)
{
    return p > LAW_ALPHA / 2 && p < 1 - LAW_ALPHA / 2;
}

/* P(X > x) for X chi-square with df degrees of freedom: the upper incomplete gamma function, by its
 * series below the mean and its continued fraction (Lentz) above. */
LAW_UNUSED static double law_chi_square(double x, double df)
{
    const double a = 0.5 * df, z = 0.5 * x;
    const double front = exp(a * log(z) - z - lgamma(a));
    if (!(x > 0))
        return x <= 0 ? 1 : 0;
    if (z < a + 1) {
        double term = 1 / a, sum = term;
        for (int k = 1; k < 100000 && term > 1e-17 * sum; k++) {
            term *= z / (a + k);
            sum += term;
        }
        return 1 - front * sum;
    }
    double b = z + 1 - a, c = 1e300, d = 1 / b, f = d;
    for (int k = 1; k < 100000; k++) {
        const double n = k * (a - k);
        b += 2;
        d = 1 / (n * d + b);
        c = b + n / c;
        f *= c * d;
        if (fabs(c * d - 1) < 1e-15)
            break;
    }
    return front * f;
}

/* P(|Z| > |z|) for Z standard normal. */
LAW_UNUSED static double law_normal(double z)
{
    return erfc(fabs(z) / sqrt(2.0));
}

/* P(D > d) for the Kolmogorov-Smirnov statistic of n points, n in the hundreds or more: the limit
 * law with Stephens' correction. The second series is for the small d of data that are too even. */
LAW_UNUSED static double law_kolmogorov(double d, double n)
{
    const double root = sqrt(n), x = (root + 0.12 + 0.11 / root) * d;
    double sum = 0;
    if (x < 1) {
        for (int k = 1; k < 20; k += 2)
            sum += exp(-k * k * LAW_PI * LAW_PI / (8 * x * x));
        return 1 - sqrt(2 * LAW_PI) / x * sum;
    }
    for (int k = 1; k < 20; k++)
        sum += (k % 2 ? 2 : -2) * exp(-2.0 * k * k * x * x);
    return sum;
}

LAW_UNUSED static int law_compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The p-value of n numbers (sorted here) that should be uniform on (0, 1). */
LAW_UNUSED static double law_uniform(double *v, size_t n)
{
    double d = 0;
    qsort(v, n, sizeof *v, law_compare);
    for (size_t i = 0; i < n; i++) {
        const double above = (double)(i + 1) / (double)n - v[i];
        const double below = v[i] - (double)i / (double)n;
        d = above > d ? above : d;
        d = below > d ? below : d;
        if (!(v[i] >= 0 && v[i] <= 1))
            return 0;
    }
    return law_kolmogorov(d, (double)n);
}

/* The p-value of counts that should have the given probabilities. Cells that expect fewer than ten
 * are taken together; a count where none can be makes it 0. */
LAW_UNUSED static double law_cells(const uint64_t *count, const double *mass, size_t cells)
{
    double n = 0, chi = 0, df = -1, pool_count = 0, pool_mass = 0;
    for (size_t k = 0; k < cells; k++)
        n += (double)count[k];
    for (size_t k = 0; k < cells; k++) {
        if (mass[k] <= 0 && count[k] > 0)
            return 0;
        pool_count += (double)count[k];
        pool_mass += mass[k];
        if (n * pool_mass >= 10) {
            chi += (pool_count - n * pool_mass) * (pool_count - n * pool_mass) / (n * pool_mass);
            df += 1;
            pool_count = pool_mass = 0;
        }
    }
    if (pool_mass > 0) {
        chi += (pool_count - n * pool_mass) * (pool_count - n * pool_mass) / (n * pool_mass);
        df += 1;
    }
    return law_chi_square(chi, df);
}

/* One check of a p-value, which it shows. */
#define law_ok(p, ...) law_report((p), tap_ok(law_passes(p), __VA_ARGS__))

LAW_UNUSED static int law_report(double p, int good)
{
    if (!good)
        tap_note("p = %.3g", p);
    return good;
}

#endif
