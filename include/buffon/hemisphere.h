/* Layer 2. Directions above a plane: uniform, and with density proportional to the cosine or to a
 * power of it.
 */
#ifndef BUFFON_HEMISPHERE_H
#define BUFFON_HEMISPHERE_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** The uniform density on the hemisphere z > 0: buffon_cap(0).
 *
 *  Law:     z = 1 - u1, angle = 2 pi u2; g = 1 / (2 pi) by solid angle
 *  Draws:   2
 *  Returns: a density of 3 coordinates
 *  Exact:   as buffon_cap
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_hemisphere(void);

/** The uniform density on the hemisphere about an axis.
 *
 *  In:      axis[3]  any length but zero, finite: the normal of a surface
 *  Law, Draws, Exact: as buffon_hemisphere, turned from +z to the axis
 *  Returns: a density of 3 coordinates; it carries BUFFON_E_NULL or BUFFON_E_SHAPE
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_hemisphere_about(const double axis[3]);

/** The density cos(theta) / pi on the hemisphere z > 0, theta the angle from +z.
 *
 *  Points of the unit disk are projected upwards: equal areas of the disk below are equal shares of
 *  cos(theta) times solid angle.
 *
 *  Law:     x, y as buffon_disk_concentric(1), z = sqrt(1 - x^2 - y^2); g = z / pi for unit vectors
 *           with z > 0, 0 elsewhere and where |x|^2 is further than 2^-20 from 1
 *  Draws:   2
 *  Returns: a density of 3 coordinates
 *  Exact:   x and y within 4 ulp each, z and g within 3; z > 0 always, since it is
 *           2 sqrt(v (1 - v)) with v the uniform that determines the radius
 *           (tests/test_sampler_accuracy.c)
 *  Source:  T. Malley (1988), A shading method for computer generated images
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_hemisphere_cosine(void);

/** The density cos(theta) / pi on the hemisphere about an axis, theta the angle from it.
 *
 *  In:      axis[3]  any length but zero, finite: the normal of a surface
 *  Law, Draws: as buffon_hemisphere_cosine, turned from +z to the axis
 *  Returns: a density of 3 coordinates; it carries BUFFON_E_NULL or BUFFON_E_SHAPE
 *  Exact:   |x| within 2^-49 of 1; g along with the point as buffon_hemisphere_cosine, g at a given
 *           point within 2^-51 (tests/test_sampler_accuracy.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_hemisphere_cosine_about(const double axis[3]);

/** The density (n + 1) / (2 pi) cos^n(theta) on the hemisphere z > 0, theta the angle from +z: the
 *  lobe of Phong's model, a spot of light. n = 0 is uniform, n = 1 the cosine.
 *
 *  In:      exponent  n from 0 to 1e15; it need not be whole
 *  Law:     cos(theta) = (1 - u1)^(1 / (n + 1)), the inverse CDF of depth below the pole; angle
 *           2 pi u2 about it. g is 0 where z <= 0 and where |x|^2 is further than 2^-20 from 1
 *  Draws:   2
 *  Returns: a density of 3 coordinates; it carries BUFFON_E_SHAPE
 *  Exact:   x and y within 5 ulp each where u1 / (n + 1) is 2^-1000 or more (below that the depth
 *           under the pole leaves the normal doubles), z and g along with the point within 4; g at
 *           a given point within 5 + 3 n |log z| ulp where it is a normal double.
 *           buffon_density_log_pdf holds everywhere (tests/test_cap.c)
 *  Source:  B. Phong (1975), Illumination for computer generated pictures
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_hemisphere_power(double exponent);

/** The density (n + 1) / (2 pi) cos^n(theta) on the hemisphere about an axis.
 *
 *  In:      exponent  n from 0 to 1e15
 *           axis[3]   any length but zero, finite
 *  Law, Draws: as buffon_hemisphere_power, turned from +z to the axis
 *  Returns: a density of 3 coordinates; it carries BUFFON_E_NULL or BUFFON_E_SHAPE
 *  Exact:   |x| within 2^-49 of 1; g along with the point as buffon_hemisphere_power, g at a given
 *           point as far as its angle is known (tests/test_cap.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_hemisphere_power_about(double exponent, const double axis[3]);

/** One point of the uniform hemisphere: the same as from buffon_hemisphere.
 *
 *  Out:     x[3]
 *  In:      u1, u2  in (0, 1): depth below the top, angle
 *  Since:   0.1
 */
BUFFON_API void buffon_hemisphere_sample(double x[3], double u1, double u2);

/** One point of the cosine hemisphere: the same as from buffon_hemisphere_cosine. Its density is
 *  x[2] / pi.
 *
 *  Out:     x[3]
 *  In:      u1, u2  in (0, 1)
 *  Since:   0.1
 */
BUFFON_API void buffon_hemisphere_sample_cosine(double x[3], double u1, double u2);

/** The uniforms from which buffon_hemisphere_sample makes a point.
 *
 *  Out:     u[2]  in (0, 1)
 *  In:      x[3]  a unit vector, x[2] > 0
 *  Since:   0.1
 */
BUFFON_API void buffon_hemisphere_invert(double u[2], const double x[3]);

/** The uniforms from which buffon_hemisphere_sample_cosine makes a point.
 *
 *  Out:     u[2]  in (0, 1)
 *  In:      x[3]  a unit vector, x[2] > 0
 *  Since:   0.1
 */
BUFFON_API void buffon_hemisphere_invert_cosine(double u[2], const double x[3]);

BUFFON_END

#endif
