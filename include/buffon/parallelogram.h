/* Layer 2. Uniform points of parallelograms in space, and of boxes on the skew.
 *
 * Corner and edges are finite, up to 2^1000 in size; the longest edge is 2^-1000 at least, and g is
 * from 2^-1022 to 2^1022. Edges that span no area or volume are refused.
 */
#ifndef BUFFON_PARALLELOGRAM_H
#define BUFFON_PARALLELOGRAM_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** The uniform density by area on a parallelogram in space: a rectangle where the edges are
 *  perpendicular.
 *
 *  In:      corner[3], edge1[3], edge2[3]  corner, and from it to its neighbours
 *  Law:     x = corner + u1 edge1 + u2 edge2. g = 1 / |edge1 x edge2| for points of the
 *           parallelogram, 0 for those further from it than 2^-49 of the largest coordinate of
 *           corner and edges
 *  Draws:   2
 *  Returns: a density of 3 coordinates; it carries BUFFON_E_SHAPE or BUFFON_E_NULL
 *  Exact:   x within 2^-50 of the size of a corner; g within 2 ulp, of needles too
 *           (tests/test_simplex.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_parallelogram(const double corner[3], const double edge1[3],
                                               const double edge2[3]);

/** The uniform density by volume on a parallelepiped: a box between edges of any directions.
 *
 *  In:      corner[3], edge1[3], edge2[3], edge3[3]  corner, and from it to its neighbours
 *  Law:     x = corner + u1 edge1 + u2 edge2 + u3 edge3. g = 1 / volume inside, 0 for points
 *           further from it than 2^-49 of the largest coordinate of corner and edges
 *  Draws:   3
 *  Returns: a density of 3 coordinates; it carries BUFFON_E_SHAPE or BUFFON_E_NULL
 *  Exact:   as buffon_parallelogram
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_parallelepiped(const double corner[3], const double edge1[3],
                                                const double edge2[3], const double edge3[3]);

BUFFON_END

#endif
