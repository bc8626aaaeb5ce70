/* Layer 2. Densities on the unit square that interpolate: its corners, or the nodes of a grid. */
#ifndef BUFFON_BILINEAR_H
#define BUFFON_BILINEAR_H

#include "api.h"
#include "density.h"
#include "status.h"
#include "table.h"

BUFFON_BEGIN

/** The density on the unit square that is bilinear between its corners: such as the cosine over a
 *  small patch, or the product of two ramps.
 *
 *  In:      v00, v10, v01, v11  relative heights at (0,0), (1,0), (0,1), (1,1); finite, >= 0, not
 *                               all 0; those below 2^-1022 of the largest may count as 0
 *  Law:     g = 4 ((1-x) (1-y) v00 + x (1-y) v10 + (1-x) y v01 + x y v11) / (sum of the heights).
 *           y = F^-1(u2) of the marginal, x = F^-1(u1) of the line at y: both are densities that
 *           are straight lines, inverted without cancellation (piecewise.h)
 *  Draws:   2
 *  Returns: a density of 2 coordinates; it carries BUFFON_E_SHAPE
 *  Exact:   y, and x for its y, within 4 ulp below the median and 2^-52 above it; g within 5 ulp
 *           (tests/test_tables.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_bilinear(double v00, double v10, double v01, double v11);

/** The bytes of a table for buffon_bilinear_grid.
 *
 *  In:      columns, rows  of nodes; 2 to 2^31 - 1; SIZE_MAX is returned for others
 *  Cost:    16 bytes a node
 *  Since:   0.1
 */
BUFFON_API size_t buffon_bilinear_grid_size(size_t columns, size_t rows);

/** The density on the unit square that is bilinear between the nodes of a grid: an image without
 *  steps.
 *
 *  Out:     memory  the table: `size` bytes, at least buffon_bilinear_grid_size(columns, rows),
 *                   aligned as malloc's memory is; outlives the density; overlaps no other array
 *  In:      height[columns * rows]  height[r * columns + c] at x = c / (columns - 1),
 *                                   y = r / (rows - 1); finite, >= 0, not all 0
 *  Law:     the marginal of y is straight between rows: its strip is found by an index, its place
 *           in it by a root. At that y the density of x is straight between columns, and its CDF is
 *           that of the two rows mixed: the piece is found by halving. Heights below 2^-1022 of the
 *           largest count as 0
 *  Draws:   2
 *  Returns: a density of 2 coordinates; it carries BUFFON_E_DIM (columns, rows), BUFFON_E_NULL,
 *           BUFFON_E_SIZE (the memory), BUFFON_E_SHAPE (the heights)
 *  Exact:   F is u for each coordinate within 2^-51 and 2 ulp of x; g within 5 ulp
 *           (tests/test_tables.c)
 *  Cost:    the logarithm of columns; some 70 ns a node to make
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_bilinear_grid(void *memory, size_t size, const double *height,
                                               size_t columns, size_t rows);

BUFFON_END

#endif
