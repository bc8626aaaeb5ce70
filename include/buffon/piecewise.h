/* Layer 2. Densities from tables of heights: steps and straight lines, steps of a grid. */
#ifndef BUFFON_PIECEWISE_H
#define BUFFON_PIECEWISE_H

#include "api.h"
#include "density.h"
#include "status.h"
#include "table.h"

BUFFON_BEGIN

/** The bytes of a table for buffon_piecewise_constant.
 *
 *  In:      count  1 to 2^31 - 1; SIZE_MAX is returned for others
 *  Since:   0.1
 */
BUFFON_API size_t buffon_piecewise_constant_size(size_t count);

/** A density of steps: a histogram.
 *
 *  Out:     memory  the table: `size` bytes, at least buffon_piecewise_constant_size(count),
 *                   aligned as malloc's memory is; outlives the density; overlaps no other array
 *  In:      edge[count + 1]  strictly increasing, from first to last 2^-900 to 2^900; NULL: equal
 *                            pieces of [0, 1], edge[k] = k / count
 *           height[count]    finite, >= 0, not all 0; need not be normalised
 *  Law:     g = height[k] / integral for edge[k] <= x < edge[k+1], and at the last edge as before
 *           it; x = F^-1(u), by an index of u: some two pieces are looked at on average. Pieces of
 *           height 0 are never drawn, nor are those with less than 2^-63 of the whole
 *  Draws:   1
 *  Returns: a density of 1 coordinate; it carries BUFFON_E_DIM (count), BUFFON_E_NULL,
 *           BUFFON_E_SIZE (the memory), BUFFON_E_TABLE (the edges, or a g that exceeds 2^1022),
 *           BUFFON_E_SHAPE (the heights)
 *  Exact:   F(x) is u within 2^-51 and 1 ulp of x, g within 3 ulp (tests/test_tables.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_piecewise_constant(void *memory, size_t size, const double *edge,
                                                    const double *height, size_t count);

/** The bytes of a table for buffon_piecewise_linear.
 *
 *  In:      count  2 to 2^31 - 1; SIZE_MAX is returned for others
 *  Since:   0.1
 */
BUFFON_API size_t buffon_piecewise_linear_size(size_t count);

/** A density of straight lines between points.
 *
 *  Out:     memory  as buffon_piecewise_constant; buffon_piecewise_linear_size(count) bytes
 *  In:      knot[count]    strictly increasing, from first to last 2^-900 to 2^900; NULL: from 0
 *                          to 1 in equal steps, knot[k] = k / (count - 1); count >= 2
 *           height[count]  finite, >= 0, not all 0
 *  Law:     g runs straight from height[k] / integral at knot[k] to height[k+1] / integral at
 *           knot[k+1]. Within a piece with heights a and b the part t of its mass lies below the
 *           part s of its width: s = t (a + b) / (a + sqrt((1 - t) a^2 + t b^2)), which cancels
 *           nowhere; beyond the middle 1 - s is found likewise, so that both ends keep their
 *           digits. x grows with u but for rounding
 *  Draws:   1
 *  Returns: as buffon_piecewise_constant
 *  Exact:   F(x) is u within 2^-51 and 2 ulp of x, g within 5 ulp (tests/test_tables.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_piecewise_linear(void *memory, size_t size, const double *knot,
                                                  const double *height, size_t count);

/** The bytes of a table for buffon_piecewise_grid.
 *
 *  In:      columns, rows  1 to 2^31 - 1; SIZE_MAX is returned for others
 *  Cost:    12 to 16 bytes a cell
 *  Since:   0.1
 */
BUFFON_API size_t buffon_piecewise_grid_size(size_t columns, size_t rows);

/** A density of steps on the unit square: an image, or a histogram of two numbers.
 *
 *  Out:     memory  as buffon_piecewise_constant, buffon_piecewise_grid_size(columns, rows) bytes
 *  In:      height[columns * rows]  height[r * columns + c] in row r and column c; finite, >= 0,
 *                                   not all 0
 *  Law:     column c is c / columns <= x < (c + 1) / columns, row r is r / rows <= y < ..., and the
 *           edges at 1 belong to the last. The row is found from u2, then the column within it from
 *           u1: both by inversion, so that stratified points keep their order. g is that of the law
 *           as it is drawn, by whole numbers of 2^-62 of the row and of the whole: a cell with less
 *           than 2^-63 of its row counts as 0
 *  Draws:   2
 *  Returns: a density of 2 coordinates; it carries BUFFON_E_DIM (columns, rows), BUFFON_E_NULL,
 *           BUFFON_E_SIZE (the memory), BUFFON_E_SHAPE (the heights)
 *  Exact:   F is u within 2^-51 for each coordinate; g within 4 ulp of the normalised heights and
 *           what half a unit is of the row in the whole and of the cell in its row
 *           (tests/test_tables.c)
 *  Cost:    some 70 ns a cell to make
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_piecewise_grid(void *memory, size_t size, const double *height,
                                                size_t columns, size_t rows);

BUFFON_END

#endif
