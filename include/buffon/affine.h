/* Layer 2. Densities moved, stretched and turned. */
#ifndef BUFFON_AFFINE_H
#define BUFFON_AFFINE_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** The density of x = A y + b, where y has density g.
 *
 *      const double a[] = {2, 0, 1, 3}, b[] = {5, 5};
 *      const buffon_density x = buffon_affine(&disk, a, b);    an ellipse
 *
 *  In:      g       of 1 to 12 coordinates, which fills its space: points of a surface keep their
 *                   areas only in buffon_turned. Must outlive the result
 *           matrix  [dim*dim], A by rows, of finite numbers, not singular. Up to dim = 3 it is
 *                   copied; else it must outlive the density
 *           shift   [dim], b, finite; NULL: 0
 *  Law:     the density at x is g(y) / |det A| at y = A^-1 (x - b), by elimination with pivots: of
 *           a diagonal A one subtraction and one division a coordinate
 *  Draws:   as g
 *  Returns: a density; it carries BUFFON_E_NULL, the status of g, BUFFON_E_DIM, or BUFFON_E_SHAPE
 *           (numbers that are not finite, or det A = 0). A |det A| beyond the doubles makes a pdf
 *           of 0 or infinity; buffon_density_log_pdf holds all the same
 *  Exact:   x within dim + 1 ulp of its largest term; g at the u of y within 4 ulp of that of y, at
 *           x what the errors of y are worth (tests/test_combinators.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_affine(const buffon_density *g, const double *matrix,
                                        const double *shift);

/** A density in space, or of directions, turned by a quaternion.
 *
 *  In:      g  of 3 coordinates: points of space, of the sphere, or of any surface. Must outlive
 *              the result
 *           q  [4], w + x i + y j + z k, w first, finite and not 0; of any length
 *  Law:     x = R y, R the rotation y -> q y q* / |q|^2; the density at x is g(R^-1 x)
 *  Draws:   as g
 *  Returns: a density; it carries BUFFON_E_NULL, the status of g, BUFFON_E_DIM (not 3 coordinates)
 *           or BUFFON_E_SHAPE (q)
 *  Exact:   x within 2^-50 |y| (tests/test_combinators.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_turned(const buffon_density *g, const double q[4]);

/** A density in space, or of directions, turned so that its z axis is another.
 *
 *  In:      g     as for buffon_turned
 *           axis  [3], finite and not 0; of any length
 *  Law:     as buffon_turned. How it is turned about the axis is not stated, only that it is always
 *           the same
 *  Draws, Returns, Exact: as buffon_turned
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_turned_to(const buffon_density *g, const double axis[3]);

BUFFON_END

#endif
