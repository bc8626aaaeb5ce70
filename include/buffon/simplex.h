/* Layer 2. Uniform points of segments, triangles and tetrahedra, and of the standard simplex of any
 * dimension.
 *
 * All use one map from the unit cube to the weights w_1 ... w_dim of the corners but the first,
 * which has the rest. The tails S_j = w_j + w_(j+1) + ... + w_dim are the order statistics of
 * as many uniform numbers:
 *
 *     S_1 = u_1^(1/dim),  S_2 = S_1 u_2^(1/(dim-1)),  ...  S_dim = S_(dim-1) u_dim
 *
 * For a segment w = u; for a triangle w1 = sqrt(u1) (1 - u2), w2 = sqrt(u1) u2; for a tetrahedron
 * cube root, square root and none. It is one-to-one and smooth, and all of it is products of
 * positive numbers. Quasi-random points keep their evenness better than by low-distortion foldings
 * of the cube, whose kinks cost more than their rounder cells save.
 *
 * Corners are finite, up to 2^1000 in size; the longest edge is 2^-1000 at least, and g is from
 * 2^-1022 to 2^1022. What is thinner or shorter is refused, and what has no area or volume at all.
 */
#ifndef BUFFON_SIMPLEX_H
#define BUFFON_SIMPLEX_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** The uniform density by length on the segment between two points of space.
 *
 *  In:      a[3], b[3]  the ends
 *  Law:     x = a + u (b - a). g = 1 / length for points of the segment, 0 for those further off
 *           than 2^-49 of a corner's largest coordinate and edge
 *  Draws:   1
 *  Returns: a density of 3 coordinates; it carries BUFFON_E_SHAPE or BUFFON_E_NULL
 *  Exact:   x within 2^-51 of the size of a corner; g within 2 ulp, also of a short segment far
 *           from the origin (tests/test_simplex.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_segment_between(const double a[3], const double b[3]);

/** The uniform density by area on a triangle in space.
 *
 *  In:      a[3], b[3], c[3]  the corners
 *  Law:     x = a + w1 (b - a) + w2 (c - a) with w as above. g = 1 / area for points of the
 *           triangle, 0 for those further from it than 2^-49 of a corner's largest coordinate and
 *           edges
 *  Draws:   2
 *  Returns: a density of 3 coordinates; it carries BUFFON_E_SHAPE or BUFFON_E_NULL
 *  Exact:   weights within 2^-52, x within 2^-50 of the size of a corner; g within 2 ulp, of
 *           needles and small triangles far from the origin too (tests/test_simplex.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_triangle(const double a[3], const double b[3], const double c[3]);

/** The uniform density on a triangle of the plane.
 *
 *  In:      a[2], b[2], c[2]  the corners
 *  Law, Draws, Exact: as buffon_triangle
 *  Returns: a density of 2 coordinates; it carries BUFFON_E_SHAPE or BUFFON_E_NULL
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_triangle_flat(const double a[2], const double b[2],
                                               const double c[2]);

/** The uniform density by volume on a tetrahedron.
 *
 *  In:      a[3], b[3], c[3], d[3]  the corners
 *  Law:     x = a + w1 (b - a) + w2 (c - a) + w3 (d - a) with w as above. g = 1 / volume for points
 *           of the tetrahedron, 0 for those further from it than 2^-49 of a corner's largest
 *           coordinate and edges
 *  Draws:   3
 *  Returns: a density of 3 coordinates; it carries BUFFON_E_SHAPE or BUFFON_E_NULL
 *  Exact:   weights within 2^-52, x within 2^-50 of the size of a corner; g within 2 ulp, of
 *           slivers and small tetrahedra far from the origin too (tests/test_simplex.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_tetrahedron(const double a[3], const double b[3],
                                             const double c[3], const double d[3]);

/** The uniform density on the standard simplex: x_j > 0 with a sum below 1. With the rest 1 - sum
 *  it is the law of random shares, Dirichlet's with all parameters 1.
 *
 *  In:      dim  1 to 170, where dim! is a double
 *  Law:     x = w as above. g = dim! where no x_j is negative and the sum is at most
 *           1 + dim 2^-52, else 0
 *  Draws:   dim
 *  Returns: a density of `dim` coordinates; it carries BUFFON_E_DIM
 *  Exact:   x within 2^-51, in 3 dimensions and fewer 2^-52; g within 1 ulp
 *           (tests/test_simplex.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_simplex(size_t dim);

BUFFON_END

#endif
