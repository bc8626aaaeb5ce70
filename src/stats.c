#include "guard.h"

#include "buffon/stats.h"

#include <math.h>
#include <string.h>

#include "elementary.h"
#include "exact.h"
#include "stats_priv.h"

#define STATS_ROW 32 /* values that are held against the list at once */

/* Moves the smaller ones down by one place; a list that is not full ends in zeros. */
static inline void stats_top_insert(double *top, double size)
{
    size_t i = BUFFON_STATS_TOP - 1;
    if (!(size > top[i]))
        return;
    for (; i > 0 && top[i - 1] < size; i--)
        top[i] = top[i - 1];
    top[i] = size;
}

#define KERNELS "stats_lanes.h"
#include "levels.h"

void buffon_priv_top_add(double *top, const double *y, size_t n)
{
    LEVELS_RUN(stats_top, (top, y, n));
}

void buffon_stats_add(buffon_stats *s, const double *y, size_t n)
{
    double min = s->count > 0 ? s->min : INFINITY, max = s->count > 0 ? s->max : -INFINITY;
    uint64_t added = 0;
    for (size_t i = 0; i < n; i++) {
        if (!buffon_priv_isfinite(y[i]))
            continue;
        buffon_priv_value_add(s->sum, s->squares, y[i]);
        min = y[i] < min ? y[i] : min;
        max = y[i] > max ? y[i] : max;
        stats_top_insert(s->top, buffon_priv_abs(y[i]));
        added++;
    }
    s->count += added;
    s->nonfinite += n - added;
    s->min = s->count > 0 ? min + 0.0 : 0.0; /* -0 becomes 0 */
    s->max = s->count > 0 ? max + 0.0 : 0.0;
}

/* top = the largest of both, which fall. */
static void stats_merge_top(double *top, const double *from)
{
    double both[BUFFON_STATS_TOP];
    for (size_t i = 0, j = 0; i + j < BUFFON_STATS_TOP;) {
        int first = top[i] > from[j];
        both[i + j] = first ? top[i] : from[j];
        i += (size_t)first;
        j += (size_t)!first;
    }
    memcpy(top, both, sizeof both);
}

void buffon_stats_merge(buffon_stats *into, const buffon_stats *from)
{
    if (from->count == 0) {
        into->nonfinite += from->nonfinite;
        return;
    }
    if (into->count == 0) {
        const uint64_t nonfinite = into->nonfinite;
        *into = *from;
        into->nonfinite += nonfinite;
        return;
    }
    into->min = from->min < into->min ? from->min : into->min;
    into->max = from->max > into->max ? from->max : into->max;
    into->count += from->count;
    into->nonfinite += from->nonfinite;
    buffon_priv_limbs_merge(into->sum, from->sum, BUFFON_STATS_SUM);
    buffon_priv_limbs_merge(into->squares, from->squares, BUFFON_STATS_SQUARES);
    stats_merge_top(into->top, from->top);
}

static buffon_priv_wide stats_over(const uint64_t *limbs, size_t size, uint64_t n, int unit)
{
    return n > 0 ? buffon_priv_limbs_over(limbs, size, n, unit) : (buffon_priv_wide){NAN, 0};
}

buffon_priv_wide buffon_priv_stats_mean_wide(const buffon_stats *s)
{
    return stats_over(s->sum, BUFFON_STATS_SUM, s->count, BUFFON_PRIV_SUM_UNIT);
}

double buffon_priv_stats_mean(const buffon_stats *s)
{
    return buffon_priv_wide_to_double(buffon_priv_stats_mean_wide(s));
}

buffon_priv_wide buffon_priv_stats_mean_square(const buffon_stats *s)
{
    return stats_over(s->squares, BUFFON_STATS_SQUARES, s->count, BUFFON_PRIV_SQUARES_UNIT);
}

buffon_priv_wide buffon_priv_cross_covariance(const uint64_t *s_ab, const buffon_stats *a,
                                              const buffon_stats *b)
{
    uint64_t n = a->count;
    buffon_priv_wide d = buffon_priv_limbs_spread(s_ab, a->sum, b->sum, n);
    d = buffon_priv_wide_div(d, buffon_priv_wide_count(n)); /* 0 / 0 for none, below for one */
    return buffon_priv_wide_div(d, buffon_priv_wide_count(n - 1));
}

buffon_priv_wide buffon_priv_stats_variance(const buffon_stats *s)
{
    buffon_priv_wide variance = buffon_priv_cross_covariance(s->squares, s, s);
    if (s->count < 2) /* the same NaN on every machine */
        return buffon_priv_wide_of(NAN);
    if (variance.m < 0.0) /* no values give this, but a sample is only as sound as its memory */
        variance = (buffon_priv_wide){0.0, 0};
    return variance;
}

buffon_summary buffon_stats_summary(const buffon_stats *s)
{
    uint64_t n = s->count;
    buffon_summary out = {.count = n, .nonfinite = s->nonfinite};
    buffon_priv_wide count = buffon_priv_wide_count(n);
    buffon_priv_wide variance = buffon_priv_stats_variance(s);
    buffon_priv_wide sum = stats_over(s->sum, BUFFON_STATS_SUM, n > 0, BUFFON_PRIV_SUM_UNIT);
    buffon_priv_wide squares =
        stats_over(s->squares, BUFFON_STATS_SQUARES, n > 0, BUFFON_PRIV_SQUARES_UNIT);
    buffon_priv_wide share = buffon_priv_wide_div(buffon_priv_wide_make(s->top[0], 0), sum);
    out.mean = buffon_priv_stats_mean(s);
    out.variance = buffon_priv_wide_to_double(variance);
    out.std_error =
        buffon_priv_wide_to_double(buffon_priv_wide_sqrt(buffon_priv_wide_div(variance, count)));
    out.min = n > 0 ? s->min : NAN;
    out.max = n > 0 ? s->max : NAN;
    out.ess =
        buffon_priv_wide_to_double(buffon_priv_wide_div(buffon_priv_wide_mul(sum, sum), squares));
    out.max_share = buffon_priv_abs(buffon_priv_wide_to_double(share));
    out.tail_index = buffon_priv_tail_index(s->top, n);
    return out;
}
