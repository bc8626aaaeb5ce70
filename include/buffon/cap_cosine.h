/* Layer 2. Directions of a cap as a surface sees them: with density proportional to the cosine from
 * the surface's normal, above its horizon. What a light that is a sphere, the sun or a cone of
 * directions brings to a surface: f / g is constant where it is not hidden.
 */
#ifndef BUFFON_CAP_COSINE_H
#define BUFFON_CAP_COSINE_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** The integral of max(0, cosine from the normal) over a cap, by solid angle: the irradiance of a
 *  surface from a cap of radiance 1.
 *
 *  In:      half_angle  of the cap in radians, 0 < half_angle <= pi/2
 *           axis[3]     of the cap: any length but zero, finite
 *           normal[3]   of the surface: any length but zero, finite
 *  Law:     with b the angle of the axis above the horizon and t the half angle: pi sin^2(t) sin(b)
 *           where the whole cap is above, b >= t; 0 where none of it is, b <= -t; in between the
 *           part of the unit disk that the cap's projection and the horizon enclose
 *  Returns: the integral, from 0 to pi; NaN where the density would be refused for its arguments
 *  Exact:   within 2^-49 of itself above the horizon, within 2^-48 (1 + t / (b + t)) across it: as
 *           far as rounding of b lets it be known, where only the rim is above. About axes other
 *           than +z, b is known within 2^-51 (tests/test_cap_cosine.c)
 *  Source:  J. Snyder (1996), Area light sources for real-time graphics
 *  Since:   0.1
 */
BUFFON_API double buffon_cap_irradiance(double half_angle, const double axis[3],
                                        const double normal[3]);

/** The density max(0, cosine from the normal) / irradiance on a cap.
 *
 *  In:      half_angle, axis[3], normal[3]  as buffon_cap_irradiance, which must be 2^-960 or more
 *  Law:     the cap is seen from above along the normal: there its points are uniform. Where the
 *           whole cap is above the horizon they fill an ellipse: those of buffon_disk_concentric(1)
 *           on the cap's base, lifted to the sphere along the normal. Where the horizon cuts the
 *           cap, u1 chooses a plane that holds the normal's direction by the area on either side of
 *           it, and u2, at least 2^-60, the place in it, from the horizon up and over. g is 0 below
 *           the horizon, off the cap and where |x|^2 is further than 2^-20 from 1
 *  Draws:   2
 *  Returns: a density of 3 coordinates; it carries BUFFON_E_NULL, or BUFFON_E_SHAPE: also where no
 *           part of the cap is above the horizon
 *  Exact:   |x| within 2^-49 of 1. About +z: points of a cap above the horizon within 2^-48 of its
 *           size; across the horizon the areas that u1 and u2 divide are met within 2^-48 and 2^-46
 *           of themselves, times 1 + t / (b + t); the cosine at the point within 2^-48 of the
 *           highest, so g at a point that is nearer than rounding to the horizon may be 0. Where
 *           the normal is a coordinate axis the cosine has all its digits, however low
 *           (tests/test_cap_cosine.c)
 *  Cost:    where the horizon cuts the cap, an equation is solved for each point: about a
 *           microsecond, a hundred times as long
 *  Source:  T. Malley (1988) for the projection; C. Urena, I. Georgiev (2018), Stratified sampling
 *           of projected spherical caps, for the aim
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_cap_cosine(double half_angle, const double axis[3],
                                            const double normal[3]);

/** The irradiance of a surface from a sphere of radiance 1 that nothing hides.
 *
 *  In:      from[3]    the place on the surface
 *           centre[3]  of the sphere; coordinates up to 2^1000
 *           radius     of the sphere, > 0, 2^1000 at most
 *           normal[3]  of the surface: any length but zero, finite
 *  Law:     buffon_cap_irradiance of the cap that buffon_cap_of_sphere makes
 *  Returns: the integral, from 0 to pi; NaN where buffon_cap_of_sphere would refuse its arguments:
 *           also when `from` lies in or on the sphere
 *  Exact:   as buffon_cap_irradiance, where the distance is 1.1 radii or more; nearer, as far as
 *           distance minus radius is known (tests/test_cap_cosine.c)
 *  Since:   0.1
 */
BUFFON_API double buffon_cap_irradiance_of_sphere(const double from[3], const double centre[3],
                                                  double radius, const double normal[3]);

/** The density max(0, cosine from the normal) / irradiance on the directions of a sphere.
 *
 *  In:      from[3], centre[3], radius, normal[3]  as buffon_cap_irradiance_of_sphere
 *  Law:     buffon_cap_cosine on the cap that buffon_cap_of_sphere makes
 *  Draws:   2
 *  Returns: a density of 3 coordinates; it carries BUFFON_E_NULL, or BUFFON_E_SHAPE: also when
 *           `from` lies in or on the sphere, or all of the sphere below the horizon
 *  Exact:   as buffon_cap_cosine and buffon_cap_irradiance_of_sphere (tests/test_cap_cosine.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_cap_cosine_of_sphere(const double from[3], const double centre[3],
                                                      double radius, const double normal[3]);

BUFFON_END

#endif
