/* Layer 1. Quantiles and confidence intervals.
 *
 * All are computed by the library's own elementary functions, so that the same input gives the same
 * bits everywhere.
 */
#ifndef BUFFON_INTERVAL_H
#define BUFFON_INTERVAL_H

#include "api.h"
#include "status.h"

BUFFON_BEGIN

/** The normal quantile: x with P(X <= x) = p.
 *
 *  In:      p  in [0, 1]: 0 and 1 give -+infinity; NaN or outside gives NaN
 *  Exact:   1e-12 relative, down to p = 1e-300 (tests/test_interval.c)
 *  Source:  M. Wichura (1988), algorithm AS 241
 *  Since:   0.1
 */
BUFFON_API double buffon_normal_quantile(double p);

/** The upper quantile of Student's t: x with P(T > x) = q.
 *
 *  In:      q    in [0, 1]; by symmetry the lower quantile of q is minus this
 *           dof  degrees of freedom, > 0, need not be whole; infinity gives the normal
 *  Returns: NaN for arguments outside
 *  Exact:   1e-12 relative for dof from 0.01 (tests/test_interval.c); below, about 1e-16 / dof, and
 *           below 1e-15 infinite but for q = 1/2
 *  Since:   0.1
 */
BUFFON_API double buffon_student_upper(double q, double dof);

/** The quantile of the beta distribution: x with P(X <= x) = p.
 *
 *  In:      p     in [0, 1]
 *           a, b  1e-16 to 1e30
 *  Returns: NaN for arguments outside
 *  Exact:   1e-12 relative for a and b from 0.01 to 1e12 (tests/test_interval.c); below, about
 *           1e-16 / a
 *  Since:   0.1
 */
BUFFON_API double buffon_beta_quantile(double p, double a, double b);

/** The interval mean -+ z std_error of a mean that is normal.
 *
 *  Out:     lo, hi      NaN on error
 *  In:      mean        finite
 *           std_error   >= 0
 *           confidence  in (0, 1): the two sides miss equally often
 *  Returns: BUFFON_OK, BUFFON_E_NULL, BUFFON_E_CONFIDENCE, BUFFON_E_SHAPE (mean or std_error)
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_interval_normal(double *lo, double *hi, double mean,
                                                             double std_error, double confidence);

/** The interval mean -+ t std_error of a mean whose error was estimated.
 *
 *  Out:     lo, hi      NaN on error
 *  In:      dof         degrees of freedom of std_error: n - 1 for n independent values; > 0
 *           the rest    as for buffon_interval_normal
 *  Returns: as buffon_interval_normal
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_interval_student(double *lo, double *hi, double mean,
                                                              double std_error, double dof,
                                                              double confidence);

/** The Clopper-Pearson interval of a probability: covers at least as often as stated, for every p.
 *
 *  Out:     lo, hi      in [0, 1]; NaN on error
 *  In:      hits, n     0 <= hits <= n, n >= 1
 *           confidence  in (0, 1)
 *  Returns: BUFFON_OK, BUFFON_E_NULL, BUFFON_E_CONFIDENCE, BUFFON_E_SAMPLES (hits or n)
 *  Exact:   1e-12 relative, n up to 1e12 (tests/test_interval.c)
 *  Source:  C. Clopper, E. Pearson (1934), The use of confidence or fiducial limits
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_interval_clopper_pearson(double *lo, double *hi,
                                                                      uint64_t hits, uint64_t n,
                                                                      double confidence);

/** Wilson's score interval of a probability: covers as stated on average over p, not for every p.
 *
 *  Out, In, Returns: as buffon_interval_clopper_pearson
 *  Source:  E. Wilson (1927), Probable inference, the law of succession, and statistical inference
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_interval_wilson(double *lo, double *hi, uint64_t hits,
                                                             uint64_t n, double confidence);

BUFFON_END

#endif
