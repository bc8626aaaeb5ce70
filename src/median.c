#include "guard.h"

#include "median.h"

#include <math.h>

#include "quantile.h"
#include "spread.h"

/* Puts x where it belongs among the n numbers before. */
static void median_insert(double *sorted, size_t n, double x)
{
    for (; n > 0 && sorted[n - 1] > x; n--)
        sorted[n] = sorted[n - 1];
    sorted[n] = x;
}

void buffon_priv_median_make(buffon_priv_median *median, const buffon_priv_record *record, size_t k)
{
    const buffon_priv_shape *shape = &record->shape;
    int lost = 0;
    median->n = 0;
    for (size_t r = 0; r < shape->per_stratum; r++) {
        size_t empty = 0;
        for (size_t s = 0; s < shape->strata; s++)
            empty += buffon_priv_record_count(record, s * (size_t)shape->per_stratum + r) == 0;
        if (empty > 0)
            continue;
        const double x = buffon_priv_wide_to_double(buffon_priv_spread_replicate(record, r, k));
        lost |= x != x;
        median_insert(median->x, median->n++, x);
    }
    for (size_t i = 0; i < median->n && lost; i++)
        median->x[i] = NAN;
}

double buffon_priv_median_value(const buffon_priv_median *median)
{
    const size_t n = median->n;
    return n > 0 ? 0.5 * median->x[(n - 1) / 2] + 0.5 * median->x[n / 2] : NAN;
}

/* Order statistics j and n + 1 - j, 0 < j <= n / 2, miss the median if fewer than j of n fair coins
 * show heads, or fewer than j tails. The largest j for which that is no more probable than alpha,
 * or 1; then on to where the two differ, if they do: the middle may agree to the last bit, and the
 * error show farther out. Returns the probability. */
static double median_rank(size_t *j, const buffon_priv_median *median, double alpha)
{
    const size_t n = median->n;
    double miss[BUFFON_PRIV_REPLICATES / 2 + 2], mass = 2; /* of both sides */
    for (size_t i = 0; i < n; i++)
        mass /= 2;
    miss[0] = 0;
    for (size_t i = 0; i < n / 2; i++) {
        miss[i + 1] = miss[i] + mass;
        mass *= (double)(n - i) / (double)(i + 1);
    }
    for (*j = n / 2; *j > 1 && (miss[*j] > alpha || median->x[*j - 1] == median->x[n - *j]);)
        --*j;
    return miss[*j];
}

/* Half the interval of 95 % over what it is in standard errors by the normal law. */
double buffon_priv_median_error(const buffon_priv_median *median)
{
    size_t j;
    if (median->n < 2)
        return NAN;
    const double miss = median_rank(&j, median, 0.05);
    return (median->x[median->n - j] - median->x[j - 1]) / 2 / buffon_priv_normal_two_sided(miss);
}

int buffon_priv_median_interval(double *lo, double *hi, const buffon_priv_median *median,
                                double alpha)
{
    size_t j;
    if (median->n < 2 || median_rank(&j, median, alpha) > alpha)
        return 0;
    *lo = median->x[j - 1];
    *hi = median->x[median->n - j];
    return 1;
}
