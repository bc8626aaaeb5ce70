/* Layer 2. The gamma and the chi-square law. */
#ifndef BUFFON_GAMMA_H
#define BUFFON_GAMMA_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** The gamma density on x > 0.
 *
 *  One uniform makes one point, by the inverse of the CDF, so stratified, antithetic and
 *  quasi-random points keep their order; Marsaglia and Tsang's rejection does not.
 *
 *  In:      shape  from 1e-100 to 1e100
 *           scale  from 1e-200 to 1e200; the mean is shape * scale
 *  Law:     x = scale y, where y has P(Y <= y) = u.
 *           g = y^(shape - 1) exp(-y) / (Gamma(shape) scale), 0 below 0.
 *           Small shapes lay much of the law where no double is: P(Y <= y) is about y^shape. Points
 *           below 2^-1022 are put there, so that g stays finite
 *  Draws:   1
 *  Returns: a density of 1 coordinate; it carries BUFFON_E_SHAPE
 *  Exact:   x within 5e-14 of itself, for shapes from 0.03 to 1e15 and u from 1e-300, for smaller
 *           shapes within 5e-13; g at a given x within 4e-15 (1 + |log(g x)|) of itself, for
 *           shapes above 1e8 within 1e-14 of that (tests/test_special.c)
 *  Cost:    0.1 us a point for large shapes, 0.5 us for small ones, and 2 us a batch
 *  Source:  N. Temme (1982), The uniform asymptotic expansion of a class of integrals; A. DiDonato,
 *           A. Morris (1986), Computation of the incomplete gamma function ratios and their inverse
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_gamma(double shape, double scale);

/** The chi-square density on x > 0: the sum of the squares of `dof` standard normals.
 *
 *  In:      dof  degrees of freedom, from 2e-100 to 2e100; need not be whole
 *  Law:     buffon_gamma(dof / 2, 2)
 *  Draws:   1
 *  Returns: a density of 1 coordinate; it carries BUFFON_E_SHAPE
 *  Exact, Cost, Source: as buffon_gamma
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_chi_square(double dof);

BUFFON_END

#endif
