/* Layer 2. Uniform points of the side of a cylinder: a tube, a wire, a lamp. */
#ifndef BUFFON_CYLINDER_H
#define BUFFON_CYLINDER_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** The uniform density on the side of a right circular cylinder, by its area.
 *
 *  In:      from[3], to[3]  the middles of its ends, of size 2^1000 at most, not the same
 *           radius          > 0, 2^1000 at most; 2 pi radius |to - from| is a normal double
 *  Law:     x = from + u1 (to - from) + radius (cos(2 pi u2) t + sin(2 pi u2) b), where t and b
 *           complete the axis to a frame. g = 1 / (2 pi radius |to - from|). The ends count as
 *           inside, with 2^-50 of the largest coordinate to spare for rounding; across the axis
 *           2^-20 of the radius is spared
 *  Draws:   2
 *  Returns: a density of 3 coordinates; it carries BUFFON_E_NULL or BUFFON_E_SHAPE
 *  Exact:   x within 2^-50 of the largest coordinate, |to - from| or the radius, g within 5 ulp
 *           (tests/test_round.c)
 *  Source:  T. Duff et al. (2017), Building an orthonormal basis, revisited
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_cylinder(const double from[3], const double to[3], double radius);

BUFFON_END

#endif
