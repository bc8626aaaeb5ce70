/* Layer 2. Uniform points of the unit sphere: directions. */
#ifndef BUFFON_SPHERE_H
#define BUFFON_SPHERE_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** The uniform density on the unit sphere, by solid angle.
 *
 *  Law:     Archimedes: slices of equal height have equal area. z = 1 - 2 u1, angle = 2 pi u2 about
 *           z, and the distance from the axis is 2 sqrt(u1 (1 - u1)), which keeps its digits at the
 *           poles. g = 1 / (4 pi) for unit vectors, 0 where |x|^2 is further than 2^-20 from 1
 *  Draws:   2
 *  Returns: a density of 3 coordinates
 *  Exact:   x, y, z within 3 ulp each (tests/test_sampler_accuracy.c)
 *  Source:  Archimedes, On the sphere and cylinder I
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_sphere(void);

/** One point of the unit sphere: the same as from buffon_sphere.
 *
 *  Out:     x[3]
 *  In:      u1, u2  in (0, 1): height, angle
 *  Since:   0.1
 */
BUFFON_API void buffon_sphere_sample(double x[3], double u1, double u2);

/** The uniforms from which buffon_sphere_sample makes a point.
 *
 *  Out:     u[2]  in (0, 1)
 *  In:      x[3]  a unit vector
 *  Since:   0.1
 */
BUFFON_API void buffon_sphere_invert(double u[2], const double x[3]);

BUFFON_END

#endif
