/* Layer 3. Importance sampling: integrals and expectations over any density. */
#ifndef BUFFON_IMPORTANCE_H
#define BUFFON_IMPORTANCE_H

#include "run.h"

BUFFON_BEGIN

/** Integrates f by the mean of f(X) / g(X), X ~ g.
 *
 *  Over a disk, sphere or cap, g is the uniform density on it and the integral is by area or solid
 *  angle. The nearer g is to f in shape, the smaller the variance; g = f / integral f has none.
 *
 *  Out:     out[components]
 *  In:      f        of g->dim coordinates
 *           g        density with its pdf, positive wherever f is not zero
 *           run      options; NULL: 2^20 independent points
 *  Law:     unbiased; variance of the primary estimate: integral of f^2 / g - integral^2
 *  Draws:   g->uniforms a point
 *  Returns: as buffon_uniform; the status of g; BUFFON_E_UNSUPPORTED (no pdf); BUFFON_E_PDF with
 *           out->bad_index where g is zero or not a number but f is not zero
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_importance(buffon_estimate *out,
                                                        const buffon_integrand *f,
                                                        const buffon_density *g,
                                                        const buffon_run *run);

/** The expectation E[h(X)], X ~ g: the mean of h at points of g. No pdf is needed.
 *
 *  Out, In, Returns: as buffon_importance, without a pdf
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_expectation(buffon_estimate *out,
                                                         const buffon_integrand *h,
                                                         const buffon_density *g,
                                                         const buffon_run *run);

/** The expectation of h under a density p that is known up to a factor only:
 *  sum of w h / sum of w with w = p(X) / g(X), X ~ g (self-normalised importance sampling).
 *
 *  Out:     out[components of h]  ess = (sum w)^2 / sum w^2; max_share and tail_index are those of
 *                                 w. variance is n std_error^2
 *  In:      h        of g->dim coordinates
 *           p        >= 0, one component, of g->dim coordinates; any factor
 *           g        density with its pdf (any factor too), positive wherever p is
 *           run      options
 *  Law:     consistent; the bias is O(1/N). The error is the first-order (delta method) one
 *  Returns: as buffon_importance; BUFFON_E_BOUND where p is negative; BUFFON_E_EMPTY if all weights
 *           are zero
 *  Source:  A. Owen (2013), Monte Carlo theory, methods and examples, section 9.2
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_self_normalised(buffon_estimate *out,
                                                             const buffon_integrand *h,
                                                             const buffon_integrand *p,
                                                             const buffon_density *g,
                                                             const buffon_run *run);

BUFFON_END

#endif
