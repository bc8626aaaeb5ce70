/* Layer 2. Uniform points of a ball about the origin, and of the shell between two spheres. The
 * sphere itself is in sphere.h.
 */
#ifndef BUFFON_BALL_H
#define BUFFON_BALL_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** The uniform density in a ball.
 *
 *  In:      radius  with radius^3 from 2^-1022 to 2^1020
 *  Law:     r = radius cbrt(u1), direction as buffon_sphere from u2, u3.
 *           g = 3 / (4 pi radius^3). x^2 + y^2 + z^2 <= radius^2 holds for the doubles, and as
 *           computed with them: the outermost 2^-48 of the volume is drawn in to its edge
 *  Draws:   3
 *  Returns: a density of 3 coordinates; it carries BUFFON_E_SHAPE
 *  Exact:   x, y and z within 5 ulp each, g within 5 ulp (tests/test_round.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_ball(double radius);

/** The uniform density between two spheres.
 *
 *  In:      r0, r1  0 <= r0 < r1 with (r1 - r0) (r1^2 + r1 r0 + r0^2) from 2^-1022 to 2^1020;
 *                   r0 = 0 gives the points of buffon_ball(r1)
 *  Law:     r^3 = r0^3 + u1 (r1^3 - r0^3), direction as buffon_sphere from u2, u3.
 *           g = 3 / (4 pi (r1 - r0) (r1^2 + r1 r0 + r0^2)). The edges count as inside, with 2^-50
 *           of the radius to spare for rounding
 *  Draws:   3
 *  Returns: a density of 3 coordinates; it carries BUFFON_E_SHAPE
 *  Exact:   x, y and z within 5 ulp each, g within 5 ulp, of the thinnest shells too
 *           (tests/test_round.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_shell(double r0, double r1);

BUFFON_END

#endif
