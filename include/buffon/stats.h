/* Layer 1. Statistics of a sample that merge exactly.
 *
 * The sum and the sum of squares are kept as whole numbers wide enough for every double, so adding
 * is associative: any order and any grouping of the same numbers gives the same bits, and nothing
 * cancels (mean 1e15 with variance 1/12 is as good as mean 0). A zeroed struct is empty; a copy is
 * a checkpoint; nothing is allocated.
 */
#ifndef BUFFON_STATS_H
#define BUFFON_STATS_H

#include "api.h"
#include "status.h"

BUFFON_BEGIN

#define BUFFON_STATS_SUM 36    /* 64-bit limbs of a sum: bits 2^-1152 to 2^1151, two's complement */
#define BUFFON_STATS_SQUARES 72 /* of a sum of products: bits 2^-2304 to 2^2303 */
#define BUFFON_STATS_TOP 64    /* largest |y| kept, for the tail */

/** A sample: count, exact sums, extremes and the largest magnitudes. The fields are private. */
typedef struct buffon_stats {
    uint64_t count;                         /* finite values */
    uint64_t nonfinite;                     /* values that were NaN or infinite: not added */
    double min, max;                        /* of the finite values; 0 while there is none */
    uint64_t sum[BUFFON_STATS_SUM];         /* in units of 2^-1152 */
    uint64_t squares[BUFFON_STATS_SQUARES]; /* in units of 2^-2304 */
    double top[BUFFON_STATS_TOP];           /* largest |y|, falling; 0 where there are fewer */
} buffon_stats;

/** What a sample says. NaN where the sample is too small to say it. */
typedef struct buffon_summary {
    uint64_t count, nonfinite;
    double mean;
    double variance;   /* unbiased (n - 1); NaN for one value; infinity or 0 outside the doubles */
    double std_error;  /* of the mean, sqrt(variance / n), also where the variance overflows */
    double min, max;
    double ess;        /* (sum y)^2 / sum y^2: for weights, the effective sample size */
    double max_share;  /* max |y| / |sum y|: for weights, the share of the largest */
    double tail_index; /* k-hat of the generalised Pareto tail of |y|: above 0.5 the variance is in
                        * doubt, above 1 the mean. NaN below 320 values or without spread */
} buffon_summary;

/** Adds numbers to a sample, each exactly.
 *
 *  In/Out:  s     merged with the new values
 *  In:      y[n]  any doubles; those not finite are counted apart; n = 0 does nothing
 *  Repeat:  the bits depend on the numbers, not on their order or how calls are cut
 *  Cost:    about 12 ns a number; no allocation
 *  Since:   0.1
 */
BUFFON_API void buffon_stats_add(buffon_stats *s, const double *y, size_t n);

/** Adds one sample to another.
 *
 *  In/Out:  into  the sample of all the numbers of both
 *  In:      from  may be into
 *  Repeat:  associative and commutative to the last bit
 *  Since:   0.1
 */
BUFFON_API void buffon_stats_merge(buffon_stats *into, const buffon_stats *from);

/** Mean, variance and the rest of a sample.
 *
 *  In:      s  may be empty: count 0, the rest NaN
 *  Exact:   mean and standard error to 1e-15 relative, variance to 1e-15, of what the doubles hold
 *           (tests/test_stats.c: NIST StRD, offsets to 2^53, 1e308, subnormals)
 *  Source:  k-hat: J. Zhang, M. Stephens (2009), A new and efficient estimation method for the
 *           generalized Pareto distribution; A. Vehtari et al. (2024), Pareto smoothed importance
 *           sampling
 *  Since:   0.1
 */
BUFFON_API buffon_summary buffon_stats_summary(const buffon_stats *s);

BUFFON_END

#endif
