/* Layer 2. The beta law. */
#ifndef BUFFON_BETA_H
#define BUFFON_BETA_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** The beta density on 0 < x < 1.
 *
 *  One uniform makes one point, by the inverse of the CDF.
 *
 *  In:      a, b  from 1e-3 to 1e15
 *  Law:     g = x^(a - 1) (1 - x)^(b - 1) / B(a, b), 0 outside. Small parameters lay much of the
 *           law where no double is: points below 2^-1022 are put there, points above 1 - 2^-53
 *           likewise
 *  Draws:   1
 *  Returns: a density of 1 coordinate; it carries BUFFON_E_SHAPE
 *  Exact:   x within 2e-13 of itself, for u from 1e-300, where a or b is below 0.03 within 1e-12; g
 *           at a given x within 2e-15 (1 + |log(g x (1 - x))|) of itself, where a or b is above
 *           1e4 within 2e-14 of that (tests/test_special.c)
 *  Cost:    0.2 us a point for large parameters, 0.5 to 1 us for small ones, and 3 us a batch
 *  Source:  N. Temme (1982), The uniform asymptotic expansion of a class of integrals; C. Loader
 *           (2000), Fast and accurate computation of binomial probabilities; A. DiDonato, A. Morris
 *           (1992), Algorithm 708
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_beta(double a, double b);

BUFFON_END

#endif
