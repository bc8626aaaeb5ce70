/* Layer 2. Random rotations of space, as unit quaternions.
 *
 * A quaternion q = (w, x, y, z) is the rotation by 2 acos(w) about the axis (x, y, z). So is -q;
 * the one with w > 0 stands for it here.
 */
#ifndef BUFFON_ROTATION_H
#define BUFFON_ROTATION_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** The uniform density on all rotations: what is turned points anywhere, with any twist.
 *
 *  Law:     q = (b sin(pi u3), a cos(2 pi u2), a sin(2 pi u2), b cos(pi u3)) with a = sqrt(1 - u1),
 *           b = sqrt(u1). By area on the unit sphere of four dimensions g = 1 / pi^2 for unit
 *           vectors with w >= 0, 0 for others and where |q|^2 is further than 2^-20 from 1. The
 *           mean of f is the mean over all rotations by the one measure that rotations leave
 *           alone (Haar's)
 *  Draws:   3
 *  Returns: a density of 4 coordinates
 *  Exact:   q within 3 ulp each, |q| within 2^-51 of 1 (tests/test_rotation.c)
 *  Source:  K. Shoemake (1992), Uniform random rotations; a half turn for u3 instead of a whole one
 *           leaves one quaternion for each rotation
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_rotation(void);

/** Turns a vector.
 *
 *  Out:     y[3]  may be x
 *  In:      x[3]
 *           q[4]  not zero, of any length; NaN comes out for zero
 *  Exact:   2^-50 |x| (tests/test_rotation.c)
 *  Since:   0.1
 */
BUFFON_API void buffon_rotation_apply(double y[3], const double x[3], const double q[4]);

/** The matrix of a rotation: y_i = sum over j of m[3*i + j] x_j.
 *
 *  Out:     m[9]  row by row
 *  In:      q[4]  not zero, of any length; NaN comes out for zero
 *  Exact:   2^-50 (tests/test_rotation.c)
 *  Since:   0.1
 */
BUFFON_API void buffon_rotation_matrix(double m[9], const double q[4]);

BUFFON_END

#endif
