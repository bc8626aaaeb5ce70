/* Layer 2. Uniform points of spheres and balls in any number of dimensions.
 *
 * The maps are one to one and use no more uniforms than the points have degrees of freedom, so
 * there is a way back, and evenly spread uniforms make evenly spread points. Normals scaled to
 * length 1 would use one more, and Box and Muller's or the ziggurat's not even a fixed number.
 */
#ifndef BUFFON_SPHERE_N_H
#define BUFFON_SPHERE_N_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** The uniform density on the unit sphere |x| = 1 of `dim` dimensions.
 *
 *  In:      dim  from 2, the circle, to 2^31 - 1
 *  Law:     coordinates come in pairs, each of a random direction in its plane: of what is left of
 *           |x|^2 = 1 when r coordinates are left, a pair takes the share
 *           1 - (1 - u)^(2 / (r - 2)), u the first uniform of two; its direction is 2 pi times the
 *           second. The last two are a circle, the last three a sphere as buffon_sphere.
 *           g = Gamma(dim / 2) / (2 pi^(dim / 2)) by area, 0 where |x|^2 is further than 2^-20
 *           from 1; from 438 dimensions on it is infinite, its logarithm holds
 *  Draws:   dim - 1
 *  Returns: a density of dim coordinates; it carries BUFFON_E_DIM
 *  Exact:   x within 24 + dim / 100 ulp, |x| within (4 + dim) 2^-53 of 1, g within 2 + dim / 20
 *           ulp, log g within 4 of its largest term (tests/test_sphere_n.c)
 *  Source:  A. Voelker, J. Gosmann, T. Stewart (2017), Efficiently sampling vectors and coordinates
 *           from the n-sphere and n-ball: a ball is a sphere without two of its coordinates
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_sphere_n(size_t dim);

/** The uniform density on the unit ball |x| <= 1 of `dim` dimensions.
 *
 *  In:      dim  from 1, the segment from -1 to 1, to 2^31 - 1
 *  Law:     the first dim coordinates of the sphere of dim + 2 dimensions. g =
 *           Gamma(dim / 2 + 1) / pi^(dim / 2), 0 outside; the edge has 2^-50 dim to spare for
 *           rounding; from 432 dimensions on g is infinite, its logarithm holds
 *  Draws:   dim
 *  Returns: a density of dim coordinates; it carries BUFFON_E_DIM
 *  Exact:   x within 24 + dim / 100 ulp, g within 2 + dim / 20 ulp, log g within 4 of its largest
 *           term (tests/test_sphere_n.c)
 *  Source:  as buffon_sphere_n
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_ball_n(size_t dim);

BUFFON_END

#endif
