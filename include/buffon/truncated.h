/* Layer 2. Any density on the line, between two bounds. */
#ifndef BUFFON_TRUNCATED_H
#define BUFFON_TRUNCATED_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** A density on the line between two bounds: g over its probability there.
 *
 *  In:      g       of one coordinate and one uniform, with a way back that is monotone and holds,
 *                   by the nearest end, for points outside the support too, as that of all
 *                   densities of the library; must outlive the result
 *           lo, hi  lo < hi; may be infinite
 *  Law:     x of the uniform F(lo) + u (F(hi) - F(lo)); the density is g / (F(hi) - F(lo)) from lo
 *           to hi. The upper tail has the digits of 1 - F, that is 2^-53: for the far tails of the
 *           normal there is buffon_normal_truncated, for the exponential
 *           buffon_exponential_truncated
 *  Draws:   1
 *  Returns: a density; it carries BUFFON_E_NULL, the status of g, BUFFON_E_DIM, BUFFON_E_DOMAIN
 *           (lo, hi, or too little of g between them: fewer than some 2^20 doubles from F(lo) to
 *           F(hi)), or BUFFON_E_UNSUPPORTED (no way back)
 *  Exact:   as g is, and what an error of F(lo) and F(hi) is worth (tests/test_combinators.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_truncated(const buffon_density *g, double lo, double hi);

BUFFON_END

#endif
