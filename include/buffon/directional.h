/* Layer 2. Directions about a preferred one: scattering by dust and tissue, spread about a mean.
 *
 * On the sphere both laws are carried by w = 1 - cos(angle from the axis), which keeps its digits
 * where they are narrow; the cosine would not. An axis may have any length; directions must be unit
 * vectors.
 */
#ifndef BUFFON_DIRECTIONAL_H
#define BUFFON_DIRECTIONAL_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** The phase function of Henyey and Greenstein: how light goes on after it met a particle.
 *
 *  In:      g        the mean cosine, -1 < g < 1: forward scattering is > 0, 0 is the sphere
 *           axis[3]  finite, not zero: where the light was going
 *  Law:     with v = 1 - u1, a = 1 - g, b = 1 + g and D = a u1 + b v:
 *           w = 2 u1 a^2 (b v + u1) / D^2, 2 - w = 2 v b^2 (a u1 + v) / D^2, angle = 2 pi u2 about
 *           the axis; nothing cancels and nothing is divided by g. The density is
 *           a b / (4 pi (a^2 + 2 g w)^(3/2)) by solid angle, 0 where |x|^2 is further than 2^-20
 *           from 1
 *  Draws:   2
 *  Returns: a density of 3 coordinates; it carries BUFFON_E_SHAPE or BUFFON_E_NULL
 *  Exact:   about +z, for every g up to the last double below 1: x and y within 8 ulp, z within
 *           2^-50, the density along with the point within 10 ulp, at it within 16. About another
 *           axis x within 2^-50, and the density at given points as well as their chord to the
 *           axis is known (tests/test_directional.c)
 *  Source:  L. Henyey, J. Greenstein (1941), Diffuse radiation in the galaxy
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_henyey_greenstein(double g, const double axis[3]);

/** The density of von Mises and Fisher on the sphere, proportional to exp(kappa cos(angle)): the
 *  normal law of directions.
 *
 *  In:      kappa    the concentration, from 0, the sphere, to 2^900; the spread of the angle is
 *                    about 1 / sqrt(kappa)
 *           axis[3]  finite, not zero: the mean direction
 *  Law:     w = -log1p(u1 expm1(-2 kappa)) / kappa, angle = 2 pi u2 about the axis; from the far
 *           side where that is nearer, by the logarithm of (1 - u1) + u1 exp(-2 kappa) where that
 *           is below 1/2. g = kappa exp(-kappa w) / (-2 pi expm1(-2 kappa)) by solid angle, 0 where
 *           |x|^2 is further than 2^-20 from 1
 *  Draws:   2
 *  Returns: a density of 3 coordinates; it carries BUFFON_E_SHAPE or BUFFON_E_NULL
 *  Exact:   about +z, for every kappa: x and y within 4 ulp where u1 and u1 / kappa are 2^-1000 or
 *           more (below that w leaves the normal doubles), z within 2^-51, g along with the point
 *           within 4 ulp, g at it within 8 + 4 kappa w. About another axis x within 2^-50, and g at
 *           given points as well as their chord to the axis is known (tests/test_directional.c)
 *  Source:  R. Fisher (1953), Dispersion on a sphere
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_von_mises_fisher(double kappa, const double axis[3]);

/** The density of von Mises on the circle, proportional to exp(kappa cos(x - mean)): the normal law
 *  of angles.
 *
 *  In:      kappa  the concentration, from 0, all angles alike, to 2^900; the spread is about
 *                  1 / sqrt(kappa)
 *           mean   in radians, of size 2^40 at most
 *  Law:     x is an angle in radians from mean - pi to mean + pi that grows with u1, the inverse
 *           CDF: F is integrated by Gauss's rule from the mean or from the far end, and solved by
 *           Newton's method to third order, each point by itself.
 *           g = exp(-2 kappa sin^2((x - mean) / 2)) / (2 pi exp(-kappa) I0(kappa)); 0 outside
 *  Draws:   1
 *  Returns: a density of 1 coordinate; it carries BUFFON_E_SHAPE
 *  Exact:   with mean 0, x within 2^-48 of itself for every kappa and u1, the smallest too, about
 *           another mean that much of x - mean and one rounding more. g within 8 + 12 y ulp for
 *           y = 2 kappa sin^2((x - mean) / 2) < 700 (tests/test_directional.c)
 *  Cost:    100 to 200 ns a point
 *  Source:  R. von Mises (1918), Ueber die Ganzzahligkeit der Atomgewichte
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_von_mises(double kappa, double mean);

BUFFON_END

#endif
