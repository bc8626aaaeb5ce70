/* Layer 3. The rejection method: to integrate (hit or miss), and to draw from a density. */
#ifndef BUFFON_REJECTION_H
#define BUFFON_REJECTION_H

#include "rng.h"
#include "run.h"

BUFFON_BEGIN

/** Integrates 0 <= f <= height over a box: the share of points (x, y), uniform on the box times
 *  [0, height], that fall under the curve, times the volume.
 *
 *  Out:     out[components]  acceptance = hits / samples. For independent points the interval is
 *                            Clopper and Pearson's: it covers at least as often as stated
 *  In:      f        0 <= f(x) <= height everywhere
 *           lo, hi   [dim], finite, lo < hi
 *           height   finite, > 0
 *           run      options; NULL: 2^20 independent points
 *  Draws:   dim + 1 uniforms a point
 *  Returns: as buffon_uniform; BUFFON_E_HEIGHT; BUFFON_E_BOUND with out->bad_index where f leaves
 *           [0, height]: never clipped, never silent
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_rejection(buffon_estimate *out,
                                                       const buffon_integrand *f, const double *lo,
                                                       const double *hi, double height,
                                                       const buffon_run *run);

/** What buffon_rejection_sample did. */
typedef struct buffon_rejection_report {
    uint64_t accepted;
    uint64_t tries;
    double acceptance; /* accepted / tries: estimates integral f / envelope. NaN without a try */
    double worst;      /* the largest f / (envelope g) met; above 1 the bound does not hold */
} buffon_rejection_report;

/** Draws X ~ f / integral f by accepting X ~ g with probability f / (envelope g).
 *
 *  Out:     x[dim*n]  coordinate-major points. On an error those after the accepted ones are NaN,
 *                     but for BUFFON_E_BOUND the first of them is the point where the bound fails
 *           report    may be NULL
 *  In/Out:  rng       moves on by (uniforms of g + 1) words a try
 *  In:      f         >= 0; need not be normalised; one component; scalar or batch
 *           g         density with a pdf; f <= envelope g everywhere
 *           envelope  finite, > 0
 *           max_tries bound on the tries of the whole call; 0 means 1000 n + 1000
 *  Returns: BUFFON_OK, BUFFON_E_NULL, _DIM, _INTEGRAND, _HEIGHT (envelope), the status of g,
 *           _UNSUPPORTED (g without pdf), _NOMEM; while it runs _BOUND, _NONFINITE, _STOPPED, _PDF,
 *           _TRIES
 *  Source:  J. von Neumann (1951), Various techniques used in connection with random digits
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_rejection_sample(double *x, size_t n,
                                                              buffon_rejection_report *report,
                                                              const buffon_integrand *f,
                                                              const buffon_density *g,
                                                              double envelope, buffon_rng *rng,
                                                              uint64_t max_tries);

BUFFON_END

#endif
