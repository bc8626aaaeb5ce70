/* Layer 2. Uniform points of round plane shapes about the origin: disk, circle, annulus, sector,
 * ellipse.
 */
#ifndef BUFFON_DISK_H
#define BUFFON_DISK_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** The uniform density on a disk, by polar coordinates.
 *
 *  In:      radius  finite, > 0
 *  Law:     r = radius sqrt(u1), angle = 2 pi u2: the inverse CDFs of both. g = 1 / (pi radius^2).
 *           x^2 + y^2 <= radius^2 holds for the doubles, and as computed with them: the outermost
 *           2^-49 of the disk's area is drawn in to its edge
 *  Draws:   2
 *  Returns: a density of 2 coordinates; it carries BUFFON_E_SHAPE
 *  Exact:   x and y within 4 ulp each, g within 2 ulp (tests/test_sampler_accuracy.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_disk(double radius);

/** The uniform density on a disk, by the map that takes squares about the middle of the unit square
 *  to circles. Nearby u stay nearby, which suits stratified and quasi-random points.
 *
 *  In:      radius  finite, > 0
 *  Law:     a = 2 u1 - 1, b = 2 u2 - 1; where |a| > |b|: r = radius a, angle = (pi/4) b / a; else
 *           r = radius b, angle = pi/2 - (pi/4) a / b. g, and the edge, as buffon_disk
 *  Draws:   2
 *  Returns: a density of 2 coordinates; it carries BUFFON_E_SHAPE
 *  Exact:   as buffon_disk
 *  Source:  P. Shirley, K. Chiu (1997), A low distortion map between disk and square
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_disk_concentric(double radius);

/** The uniform density on a circle, by its length.
 *
 *  In:      radius  from 2^-1022 to 2^1017
 *  Law:     x = radius cos(2 pi u), y = radius sin(2 pi u). g = 1 / (2 pi radius) where
 *           (x^2 + y^2) / radius^2 is within 2^-20 of 1, 0 elsewhere
 *  Draws:   1
 *  Returns: a density of 2 coordinates; it carries BUFFON_E_SHAPE
 *  Exact:   x and y within 3 ulp each, g within 2 ulp (tests/test_round.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_circle(double radius);

/** The uniform density on the ring between two circles.
 *
 *  In:      r0, r1  0 <= r0 < r1 with (r1 - r0) (r1 + r0) from 2^-1022 to 2^1020; r0 = 0 gives the
 *                   points of buffon_disk(r1)
 *  Law:     r^2 = r0^2 + u1 (r1 - r0) (r1 + r0), angle = 2 pi u2.
 *           g = 1 / (pi (r1 - r0) (r1 + r0)). The edges count as inside, with 2^-50 of the radius
 *           to spare for rounding
 *  Draws:   2
 *  Returns: a density of 2 coordinates; it carries BUFFON_E_SHAPE
 *  Exact:   x and y within 4 ulp each, g within 4 ulp, of the thinnest rings too
 *           (tests/test_round.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_annulus(double r0, double r1);

/** The uniform density on a sector: the part of a ring, or of a disk, between two angles.
 *
 *  In:      r0, r1          as buffon_annulus; 0 for the sector of a disk
 *           angle0, angle1  in radians, counter-clockwise from +x; -2 pi <= angle0 < angle1
 *                           <= 2 pi, at most 2 pi apart
 *  Law:     r as buffon_annulus, angle = angle0 + u2 (angle1 - angle0).
 *           g = 2 / ((angle1 - angle0) (r1 - r0) (r1 + r0)). The edges count as inside, with 2^-50
 *           of radius and of a turn to spare
 *  Draws:   2
 *  Returns: a density of 2 coordinates; it carries BUFFON_E_SHAPE, also where g would exceed the
 *           doubles
 *  Exact:   x and y within 2^-49 r1, g within 4 ulp (tests/test_round.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_disk_sector(double r0, double r1, double angle0, double angle1);

/** The uniform density on the inside of an ellipse, x^2 / a^2 + y^2 / b^2 <= 1.
 *
 *  In:      a, b  the half-axes, 2^-1022 or more each, a b from 2^-1022 to 2^1020
 *  Law:     (x / a, y / b) as buffon_disk_concentric(1). g = 1 / (pi a b). (x / a)^2 + (y / b)^2
 *           <= 1 holds for the doubles, and as computed with them
 *  Draws:   2
 *  Returns: a density of 2 coordinates; it carries BUFFON_E_SHAPE
 *  Exact:   x and y within 4 ulp each, g within 2 ulp (tests/test_round.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_ellipse(double a, double b);

/** One point of the unit disk: the same as from buffon_disk(1).
 *
 *  Out:     x[2]
 *  In:      u1, u2  in (0, 1): radius, angle
 *  Since:   0.1
 */
BUFFON_API void buffon_disk_sample(double x[2], double u1, double u2);

/** One point of the unit disk: the same as from buffon_disk_concentric(1).
 *
 *  Out:     x[2]
 *  In:      u1, u2  in (0, 1)
 *  Since:   0.1
 */
BUFFON_API void buffon_disk_sample_concentric(double x[2], double u1, double u2);

/** The uniforms from which buffon_disk_sample makes a point.
 *
 *  Out:     u[2]  in (0, 1)
 *  In:      x[2]  in the unit disk
 *  Since:   0.1
 */
BUFFON_API void buffon_disk_invert(double u[2], const double x[2]);

/** The uniforms from which buffon_disk_sample_concentric makes a point.
 *
 *  Out:     u[2]  in (0, 1)
 *  In:      x[2]  in the unit disk
 *  Since:   0.1
 */
BUFFON_API void buffon_disk_invert_concentric(double u[2], const double x[2]);

BUFFON_END

#endif
