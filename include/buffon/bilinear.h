/* Layer 2. A density on the unit square that interpolates its corners. */
#ifndef BUFFON_BILINEAR_H
#define BUFFON_BILINEAR_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** The density on the unit square that is bilinear between its corners: such as the cosine over a
 *  small patch, or the product of two ramps.
 *
 *  In:      v00, v10, v01, v11  relative heights at (0,0), (1,0), (0,1), (1,1); finite, >= 0, not
 *                               all 0; those below 2^-1022 of the largest may count as 0
 *  Law:     g = 4 ((1-x) (1-y) v00 + x (1-y) v10 + (1-x) y v01 + x y v11) / (sum of the heights).
 *           y = F^-1(u2) of the marginal, x = F^-1(u1) of the line at y: both are densities that
 *           are straight lines, inverted without cancellation (piecewise.h)
 *  Draws:   2
 *  Returns: a density of 2 coordinates; it carries BUFFON_E_SHAPE
 *  Exact:   y, and x for its y, within 4 ulp below the median and 2^-52 above it; g within 5 ulp
 *           (tests/test_tables.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_bilinear(double v00, double v10, double v01, double v11);

BUFFON_END

#endif
