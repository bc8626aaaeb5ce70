/* Layer 2. The normal law. */
#ifndef BUFFON_NORMAL_H
#define BUFFON_NORMAL_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** The normal density on the line.
 *
 *  One uniform makes one normal, so stratified, antithetic and quasi-random points keep their
 *  order; Box and Muller's pairs and the ziggurat do not.
 *
 *  In:      mean  of size 2^1022 at most
 *           sd    the standard deviation, from 2^-1022 to 2^1017
 *  Law:     x = mean + sd z, z the normal quantile of u (buffon_math_normal_quantile).
 *           g = exp(-z^2 / 2) / (sd sqrt(2 pi))
 *  Draws:   1
 *  Returns: a density of 1 coordinate; it carries BUFFON_E_SHAPE
 *  Exact:   z within 8 ulp, g within 4 ulp of that at z, and at a given x within 4 + 2 z^2; from
 *           |z| = 40 on g is 0. Points of u and 1 - u are exact mirrors about a mean of 0
 *           (tests/test_laws.c)
 *  Source:  M. Wichura (1988), Algorithm AS 241
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_normal(double mean, double sd);

/** The normal density between two bounds: that of a normal variate known to lie there.
 *
 *  In:      mean, sd  as for buffon_normal
 *           lo, hi    lo < hi; either may be infinite, or both. The one nearer to the mean within
 *                     2^400 sd of it; hi - lo from 2^-1000 sd up; the greatest density at
 *                     most 2^1000
 *  Law:     distances d from the nearer bound, where the density is exp(-a d - d^2 / 2) and a its
 *           distance from the mean in sd, solve D(d) = u D(hi - lo) with
 *           D(d) = integral of that density from 0 to d: a ratio of masses that does not underflow
 *           however far the bounds are, by Mills' ratio or a series. Newton's method on the
 *           logarithm of D or of its complement, the smaller of the two. Where neither bound is
 *           near, x = mean + sd z by quantiles
 *  Draws:   1
 *  Returns: a density of 1 coordinate; it carries BUFFON_E_SHAPE (mean, sd) or BUFFON_E_DOMAIN
 *  Exact:   the distance from the nearest of lo, hi and mean within 2^-48 of it, for
 *           u from 1e-300 up, and what x and the bounds' distances from the mean round; but from a
 *           mean that is not the middle of the bounds within 2^-51 sd, if that is more. g at x
 *           within 16 + 4 e ulp, where e is the exponent of the density against its peak
 *           (tests/test_truncated_laws.c)
 *  Cost:    5 to 60 times that of buffon_normal
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_normal_truncated(double mean, double sd, double lo, double hi);

/** The lognormal density: of the exponential of a normal variate.
 *
 *  In:      mu, sigma  mean and standard deviation of log x; sigma from 2^-60 up,
 *                      |mu| + 9 sigma <= 650
 *  Law:     x = exp(mu + sigma z), z the normal quantile of u;
 *           g = exp(-z^2 / 2) / (x sigma sqrt(2 pi))
 *  Draws:   1
 *  Returns: a density of 1 coordinate; it carries BUFFON_E_SHAPE
 *  Exact:   x within 3 ulp of exp(mu + sigma z), z as of buffon_normal; g at x within 6 + 3 z^2 ulp
 *           for sigma from 0.05 up, below that what the rounding of log x is worth
 *           (tests/test_truncated_laws.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_lognormal(double mu, double sigma);

BUFFON_END

#endif
