/* Layer 2. The exponential law: waiting times, distances between collisions. */
#ifndef BUFFON_EXPONENTIAL_H
#define BUFFON_EXPONENTIAL_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** The exponential density on x > 0.
 *
 *  In:      mean  from 2^-1022 to 2^1017; the rate is 1 / mean
 *  Law:     x = -mean log(1 - u), the inverse CDF, which grows with u; by log1p, so that small u
 *           keep their digits. g = exp(-x / mean) / mean, 0 below 0
 *  Draws:   1
 *  Returns: a density of 1 coordinate; it carries BUFFON_E_SHAPE
 *  Exact:   x within 2 ulp, g within 2 ulp of that at u; g at a given x within 3 + x / mean ulp as
 *           far as x < 708 mean, where exp leaves the normal doubles (tests/test_laws.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_exponential(double mean);

/** The exponential density on an interval: proportional to exp(-rate x) on lo < x < hi.
 *
 *  In:      rate    of any sign and size, 0 too: the uniform law
 *           lo, hi  lo < hi. hi may be infinite where rate > 0, lo where rate < 0; hi - lo is
 *                   otherwise from 2^-1020 up and finite. An infinite side has |rate| from 2^-1000
 *                   to 2^1000
 *  Law:     from the end where the density is greater, the distance is
 *           -log1p(v expm1(-c)) / |rate| with c = |rate| (hi - lo), and v the share of the
 *           probability on the way there; from the other end log1p((1 - v) expm1(c)) / |rate|. So
 *           distances from both ends keep their digits
 *  Draws:   1
 *  Returns: a density of 1 coordinate; it carries BUFFON_E_DOMAIN (lo, hi) or BUFFON_E_SHAPE (rate)
 *  Exact:   the distance from the nearer end within 4 ulp, and what x rounds; g at x within
 *           5 + 2 e ulp, e = |rate| times the distance from the greater end
 *           (tests/test_truncated_laws.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_exponential_truncated(double rate, double lo, double hi);

BUFFON_END

#endif
