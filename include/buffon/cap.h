/* Layer 2. Uniform points of a cap: the part of the unit sphere within an angle of an axis. What a
 * light source that is a sphere, the sun or a cone of directions looks like from a point.
 *
 * All constructors make the same density from its height h = 1 - cos(half angle), which keeps its
 * digits when the cap is small; the cosine would not. They differ in what is given.
 *
 * An axis may have any length; directions must be unit vectors.
 */
#ifndef BUFFON_CAP_H
#define BUFFON_CAP_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** The uniform density on the top of the unit sphere: the part above the plane z = cut.
 *
 *  In:      cut  -1 <= cut < 1; 0 is the hemisphere, -1 the whole sphere
 *  Law:     z = 1 - h u1 with h = 1 - cut, angle = 2 pi u2 about z. g = 1 / (2 pi h) by solid angle
 *           for unit vectors of the cap, 0 for others and where |x|^2 is further than 2^-20 from 1.
 *           The edge counts as inside, with 2^-50 to spare for rounding
 *  Draws:   2
 *  Returns: a density of 3 coordinates; it carries BUFFON_E_SHAPE
 *  Exact:   about +z: x and y within 4 ulp, z within 2^-52, at any height; about another axis |x|
 *           within 2^-49 of 1 and the height along it within 2^-50. g within 2 ulp, of an angle 6
 *           (tests/test_sampler_accuracy.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_cap(double cut);

/** The cap above the plane at `cut` along an axis: directions d with d . axis > cut |axis|.
 *
 *  In:      cut      -1 <= cut < 1
 *           axis[3]  finite, not zero
 *  Law, Draws, Exact: as buffon_cap, turned from +z to the axis
 *  Returns: a density of 3 coordinates; it carries BUFFON_E_SHAPE or BUFFON_E_NULL
 *  Source:  T. Duff et al. (2017), Building an orthonormal basis, revisited
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_cap_about(double cut, const double axis[3]);

/** The cap within an angle of an axis: h = 2 sin^2(half_angle / 2).
 *
 *  In:      half_angle  in radians, 0 < half_angle <= pi
 *           axis[3]     finite, not zero
 *  Law, Draws, Returns: as buffon_cap_about. An angle below 2.2e-154, whose g would exceed the
 *           doubles, is refused too
 *  Exact:   as buffon_cap_about. From 1e-9 to pi, about +z: g, the height, the sine of a point and,
 *           absolutely, its coordinates within 2^-50 (tests/test_cap.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_cap_angle(double half_angle, const double axis[3]);

/** The cap of a given height about an axis.
 *
 *  In:      one_minus_cos  h = 1 - cos(half angle), 0 < h <= 2
 *           axis[3]        finite, not zero
 *  Law, Draws, Exact, Returns: as buffon_cap_about. A height below 2^-1022, whose g would exceed
 *           the doubles, is refused too
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_cap_height(double one_minus_cos, const double axis[3]);

/** The directions in which a sphere is seen from a point outside it.
 *
 *  In:      from[3]    the eye, or the point to be lit
 *           centre[3]  of the sphere
 *           radius     of the sphere, finite, > 0
 *  Law:     a cap about centre - from with sin(half angle) = radius / distance
 *  Draws:   2
 *  Returns: a density of 3 coordinates; it carries BUFFON_E_NULL, or BUFFON_E_SHAPE: also when
 *           `from` lies in or on the sphere, or so far off that g would exceed the doubles
 *  Exact:   g within 8 ulp where the distance is 1.1 radii or more; nearer, as far as distance
 *           minus radius is known (tests/test_sampler_accuracy.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_cap_of_sphere(const double from[3], const double centre[3],
                                               double radius);

/** The uniform density on a zone: the part of the unit sphere between two planes z = z0 and z = z1.
 *
 *  In:      z0, z1   -1 <= z0 < z1 <= 1, along the axis
 *           axis[3]  finite, not zero
 *  Law:     1 - z = h0 + h u1 with h0 = 1 - z1 and h = z1 - z0, angle = 2 pi u2 about the axis.
 *           g = 1 / (2 pi h) for unit vectors of the zone, 0 for others and where |x|^2 is further
 *           than 2^-20 from 1. The edges count as inside, with 2^-50 to spare for rounding
 *  Draws:   2
 *  Returns: a density of 3 coordinates; it carries BUFFON_E_SHAPE or BUFFON_E_NULL. A height h
 *           below 2^-1022, whose g would exceed the doubles, is refused too
 *  Exact:   about +z: x and y within 5 ulp, z within 2^-51, at any height and depth; about another
 *           axis |x| within 2^-49 of 1 and the depth within 2^-50. g within 2^-51 of itself
 *           (tests/test_cap.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_zone(double z0, double z1, const double axis[3]);

/** The zone between two angles from an axis: h = 2 sin((angle1 - angle0) / 2) sin((angle1 +
 *  angle0) / 2), which keeps the digits of thin zones and of zones near a pole.
 *
 *  In:      angle0, angle1  in radians, 0 <= angle0 < angle1 <= pi
 *           axis[3]         finite, not zero
 *  Law, Draws, Returns: as buffon_zone
 *  Exact:   about +z: x and y within 6 ulp, z within 2^-50; g within 2^-50 of itself, of the
 *           thinnest zones and near both poles too (tests/test_cap.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_zone_angles(double angle0, double angle1, const double axis[3]);

/** The zone between two depths below the pole of an axis: z from 1 - h1 to 1 - h0.
 *
 *  In:      h0, h1   1 - cos of the angles from the axis, 0 <= h0 < h1 <= 2
 *           axis[3]  finite, not zero
 *  Law, Draws, Returns, Exact: as buffon_zone
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_zone_heights(double h0, double h1, const double axis[3]);

/** All of the sphere but a cap of a given half angle.
 *
 *  In:      half_angle  of what is left out, in radians, 0 < half_angle <= pi
 *           axis[3]     of what is left out
 *  Law:     the zone from the edge of the cap to the opposite pole
 *  Draws, Returns: as buffon_zone
 *  Exact:   as buffon_zone_angles; the smallest cap is left out, and so is all but the smallest
 *           (tests/test_cap.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_cap_complement_angle(double half_angle, const double axis[3]);

/** All of the sphere but a cap of a given height.
 *
 *  In:      one_minus_cos  h = 1 - cos(half angle) of what is left out, 0 < h < 2
 *           axis[3]        of what is left out
 *  Law, Draws, Returns: as buffon_cap_complement_angle
 *  Exact:   as buffon_zone
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_cap_complement_height(double one_minus_cos,
                                                       const double axis[3]);

/** One point of the cap above z = cut: the same as from buffon_cap.
 *
 *  Out:     x[3]    NaN unless -1 <= cut < 1
 *  In:      u1, u2  in (0, 1): depth below the top, angle
 *  Since:   0.1
 */
BUFFON_API void buffon_cap_sample(double x[3], double u1, double u2, double cut);

/** The uniforms from which buffon_cap_sample makes a point.
 *
 *  Out:     u[2]  in (0, 1); NaN unless -1 <= cut < 1
 *  In:      x[3]  a unit vector of the cap
 *  Since:   0.1
 */
BUFFON_API void buffon_cap_invert(double u[2], const double x[3], double cut);

BUFFON_END

#endif
