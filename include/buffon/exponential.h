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

BUFFON_END

#endif
