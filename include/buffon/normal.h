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

BUFFON_END

#endif
