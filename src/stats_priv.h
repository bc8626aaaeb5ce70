/* Private. What a sample says, in numbers whose exponent cannot overflow. NaN where it is too small
 * to say it.
 */
#ifndef BUFFON_SRC_STATS_PRIV_H
#define BUFFON_SRC_STATS_PRIV_H

#include "buffon/stats.h"

#include "wide.h"

/* Sum / n, correctly rounded; NaN for none. Constant data give their value exactly. */
buffon_priv_wide buffon_priv_stats_mean_wide(const buffon_stats *s);
double buffon_priv_stats_mean(const buffon_stats *s);

/* The unbiased variance; exactly 0 for constant data, NaN below two values. */
buffon_priv_wide buffon_priv_stats_variance(const buffon_stats *s);

/* Sum of squares / n, correctly rounded; NaN for none. */
buffon_priv_wide buffon_priv_stats_mean_square(const buffon_stats *s);

/* The unbiased covariance of two samples of the same count, from the exact sum of a b. */
buffon_priv_wide buffon_priv_cross_covariance(const uint64_t *s_ab, const buffon_stats *a,
                                              const buffon_stats *b);

/* Keeps the largest of the |y[n]|, all finite, among top[BUFFON_STATS_TOP]. */
void buffon_priv_top_add(double *top, const double *y, size_t n);

/* k-hat from the largest magnitudes of `count` values, top[BUFFON_STATS_TOP] falling. NaN below 320
 * values, or where fewer than 32 of the largest exceed the last of them. */
double buffon_priv_tail_index(const double *top, uint64_t count);

#endif
