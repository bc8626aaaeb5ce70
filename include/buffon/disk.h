/* Layer 2. Uniform points of a disk about the origin. */
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
