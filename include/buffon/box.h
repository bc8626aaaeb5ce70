/* Layer 2. Uniform points of an interval or of a box in any dimension. */
#ifndef BUFFON_BOX_H
#define BUFFON_BOX_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** The uniform density on the box lo < x < hi.
 *
 *  In:      lo, hi  [dim], finite, lo < hi. Up to dim = 8 they are copied; with more coordinates
 *                   they must outlive the density
 *  Law:     x = lo + u (hi - lo), g = 1 / volume. x stays strictly between lo and hi wherever a
 *           double lies between them, and hi - lo may exceed the largest double. A volume beyond
 *           the doubles leaves g zero or infinite; buffon_density_log_pdf holds all the same
 *  Draws:   dim
 *  Returns: a density; it carries BUFFON_E_NULL, BUFFON_E_DIM (dim = 0) or BUFFON_E_DOMAIN
 *  Exact:   x within 2^-51 max(|lo|, |hi|), and 1 ulp where lo = 0; g within dim + 1 ulp
 *           (tests/test_sampler_accuracy.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_box(const double *lo, const double *hi, size_t dim);

/** The uniform density on the interval lo < x < hi: a box of one dimension, its bounds by value.
 *
 *  In, Law, Returns, Exact: as buffon_box
 *  Draws:   1
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_segment(double lo, double hi);

/** One point of an interval: the same as from buffon_segment.
 *
 *  In:      u  in (0, 1)
 *  Returns: x, strictly inside where a double is; NaN for bounds that buffon_segment refuses
 *  Since:   0.1
 */
BUFFON_API double buffon_segment_sample(double u, double lo, double hi);

/** One point of a box: the same as from buffon_box.
 *
 *  Out:     x[dim]  NaN for bounds that buffon_box refuses
 *  In:      u[dim]  in (0, 1); may be x
 *           lo, hi  [dim]
 *  Since:   0.1
 */
BUFFON_API void buffon_box_sample(double *x, const double *u, const double *lo, const double *hi,
                                  size_t dim);

BUFFON_END

#endif
