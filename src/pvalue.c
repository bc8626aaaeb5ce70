#include "guard.h"

#include <math.h>

#include "elementary.h"
#include "pvalue.h"

#define PVALUE_LEAST 10 /* expected in a cell */

double buffon_priv_p_normal(double z)
{
    return buffon_priv_erfc(buffon_priv_abs(z) * 0x1.6a09e667f3bcdp-1);
}

/* log Gamma(a) for a >= 1/2: Stirling's series from a + 8 on, and down again. */
static double pvalue_log_gamma(double a)
{
    double product = 1, x = a;
    for (; x < 8.5; x++)
        product *= x;
    const double r = 1 / x, r2 = r * r;
    const double series = r * (1.0 / 12 - r2 * (1.0 / 360 - r2 * (1.0 / 1260 - r2 / 1680)));
    return (x - 0.5) * buffon_priv_log(x) - x + 0x1.d67f1c864beb5p-1 + series -
           buffon_priv_log(product);
}

/* The upper incomplete gamma function: by the series of the lower one below the mean, and by its
 * continued fraction, after Lentz, above. */
double buffon_priv_p_chi_square(double x, double dof)
{
    const double a = 0.5 * dof, z = 0.5 * x;
    if (!(z > 0))
        return 1;
    if (!(z < 0x1p+60))
        return 0;
    const double front = buffon_priv_exp(a * buffon_priv_log(z) - z - pvalue_log_gamma(a));
    if (z < a + 1) {
        double term = 1 / a, sum = term;
        for (int k = 1; k < 100000 && term > 0x1p-56 * sum; k++) {
            term *= z / (a + k);
            sum += term;
        }
        return 1 - front * sum;
    }
    double b = z + 1 - a, c = 0x1p+1000, d = 1 / b, f = d;
    for (int k = 1; k < 100000; k++) {
        const double n = k * (a - k);
        b += 2;
        d = 1 / (n * d + b);
        c = b + n / c;
        f *= c * d;
        if (buffon_priv_abs(c * d - 1) < 0x1p-50)
            break;
    }
    return front * f;
}

double buffon_priv_p_kolmogorov(double d, double n)
{
    const double pi = 0x1.921fb54442d18p+1, root = sqrt(n), x = (root + 0.12 + 0.11 / root) * d;
    double sum = 0;
    if (!(x > 0.04))
        return 1;
    for (int k = 1; k < 20 && x < 1; k += 2)
        sum += buffon_priv_exp(-k * k * pi * pi / (8 * x * x));
    if (x < 1)
        return 1 - sqrt(2 * pi) / x * sum;
    for (int k = 1; k < 20; k++)
        sum += (k % 2 ? 2 : -2) * buffon_priv_exp(-2.0 * k * k * x * x);
    return sum;
}

/* Moves x down from the root k of a heap until it is no less than what is below it. */
static void pvalue_sink(double *v, size_t k, size_t n, double x)
{
    for (size_t child = 2 * k + 1; child < n; child = 2 * k + 1) {
        child += child + 1 < n && v[child + 1] > v[child];
        if (!(v[child] > x))
            break;
        v[k] = v[child];
        k = child;
    }
    v[k] = x;
}

/* Heapsort: qsort may allocate memory, and is not the same everywhere. */
void buffon_priv_sort(double *v, size_t n)
{
    for (size_t k = n / 2; k-- > 0;)
        pvalue_sink(v, k, n, v[k]);
    for (size_t end = n; end-- > 1;) {
        const double x = v[end];
        v[end] = v[0];
        pvalue_sink(v, 0, end, x);
    }
}

double buffon_priv_kolmogorov(double *v, size_t n)
{
    double d = 0;
    buffon_priv_sort(v, n);
    for (size_t i = 0; i < n; i++) {
        const double above = (double)(i + 1) / (double)n - v[i];
        const double below = v[i] - (double)i / (double)n;
        d = above > d ? above : d;
        d = below > d ? below : d;
    }
    return d;
}

/* What is left at the end and expects too few joins the cell before it. */
double buffon_priv_p_cells(const double *count, const double *expected, const double *variance,
                           size_t cells)
{
    double chi = 0, dof = -1, c = 0, e = 0, v = 0, last = 0;
    double before[3] = {0, 0, 0};
    for (size_t k = 0; k < cells; k++) {
        c += count[k];
        e += expected[k];
        v += variance[k];
        const int rest = k + 1 == cells && e < PVALUE_LEAST && dof >= 0;
        if (rest) {
            c += before[0];
            e += before[1];
            v += before[2];
            chi -= last;
            dof -= 1;
        }
        if (e >= PVALUE_LEAST && v > 0) {
            last = (c - e) * (c - e) / v;
            chi += last;
            dof += 1;
            before[0] = c;
            before[1] = e;
            before[2] = v;
            c = e = v = 0;
        }
    }
    return dof >= 1 ? buffon_priv_p_chi_square(chi, dof) : 1;
}
