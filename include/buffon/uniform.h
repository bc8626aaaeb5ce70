/* Layer 3. Basic Monte Carlo: the integral over a box from uniform points. */
#ifndef BUFFON_UNIFORM_H
#define BUFFON_UNIFORM_H

#include "run.h"

BUFFON_BEGIN

/** Integrates f over the box lo < x < hi by the mean of V f at uniform points, V the volume.
 *
 *  Out:     out[components]  one estimate for each component; defined whatever happens
 *  In:      f        dim >= 1 coordinates
 *           lo, hi   [dim], finite, lo < hi in every coordinate
 *           run      options; NULL: 2^20 independent points
 *  Law:     unbiased; variance of the primary estimate V^2 E[f^2] - integral^2, error as 1/sqrt(N)
 *           in every dimension
 *  Draws:   dim uniforms a point
 *  Returns: BUFFON_OK, a reservation, or: BUFFON_E_NULL, _DIM, _DOMAIN, _INTEGRAND, and for the
 *           options _CONFIDENCE, _TOLERANCE, _BLOCK, _SAMPLES, _RESERVED, _PART, _POINTS,
 *           _MISMATCH, _NOMEM; while it runs: _NONFINITE, _STOPPED with out->bad_index
 *  Repeat:  see buffon_run
 *  Cost:    samples evaluations; memory independent of samples
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_uniform(buffon_estimate *out,
                                                     const buffon_integrand *f, const double *lo,
                                                     const double *hi, const buffon_run *run);

BUFFON_END

#endif
