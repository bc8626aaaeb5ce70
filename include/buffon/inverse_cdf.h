/* Layer 3. Importance sampling in one dimension with X = F^-1(u). */
#ifndef BUFFON_INVERSE_CDF_H
#define BUFFON_INVERSE_CDF_H

#include "inversion.h"
#include "run.h"

BUFFON_BEGIN

/** Integrates f over the support of g by the mean of f(X) / g(X), where X = F^-1(u) has density g.
 *
 *  The same as buffon_importance with buffon_inverse(how); here in one call.
 *
 *  Out:     out[components]
 *  In:      f        of one coordinate
 *           how      the quantile function with its pdf, or CDF and pdf, or a table: see
 *                    inversion.h
 *           run      options
 *  Returns: as buffon_importance; what buffon_inverse refuses
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_inverse_cdf(buffon_estimate *out,
                                                         const buffon_integrand *f,
                                                         const buffon_inversion *how,
                                                         const buffon_run *run);

BUFFON_END

#endif
