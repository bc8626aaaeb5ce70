/* Layer 2. Student's law. */
#ifndef BUFFON_STUDENT_H
#define BUFFON_STUDENT_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** Student's t density on the line.
 *
 *  One uniform makes one point, by the inverse of the CDF.
 *
 *  In:      dof  degrees of freedom, from 1e-3 to 1e100; need not be whole
 *  Law:     g = c (1 + x^2 / dof)^(-(dof + 1) / 2), c = Gamma((dof + 1) / 2) / (Gamma(dof / 2)
 *           sqrt(pi dof)). Tails fall as |x|^-dof: points beyond 2^1000 are put there, which is
 *           less than 2^-53 of the law from dof = 0.06 on
 *  Draws:   1
 *  Returns: a density of 1 coordinate; it carries BUFFON_E_SHAPE
 *  Exact:   x within 1e-13 of itself, for u from 1e-300, for dof below 0.03 within 1e-12; g at a
 *           given x within 1e-15 (1 + |log g|) of itself. Points of u and 1 - u are exact mirrors
 *           (tests/test_special.c)
 *  Cost:    0.2 us a point from 20 degrees of freedom on, 0.6 us below, 0.01 us for 1 and 2
 *  Source:  as buffon_beta: x^2 / (dof + x^2) is a beta variable
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_student_t(double dof);

BUFFON_END

#endif
