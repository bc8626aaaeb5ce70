/* Layer 2. Any density on the line by its inverse CDF: X = F^-1(u) has the CDF F, because
 * P(X <= x) = P(u <= F(x)) = F(x).
 */
#ifndef BUFFON_INVERSION_H
#define BUFFON_INVERSION_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** A distribution on the line, in one of three forms:
 *
 *    quantile             F^-1 in closed form. With pdf the density can be used as g in f / g,
 *                         without it for expectations; with cdf points can be taken back to
 *                         uniforms
 *    cdf, pdf             F and its derivative, from which F^-1 is found by Newton's method inside
 *                         a bracket; lo and hi bound the support
 *    x[count], F[count]   a table of the CDF, both strictly increasing, count >= 2: between its
 *                         points F is linear and the pdf constant. F need not run from 0 to 1: what
 *                         lies between F[0] and F[count-1] counts as the whole
 *
 *  Functions may be called by several threads at once with the same ctx.
 */
typedef struct buffon_inversion {
    double (*quantile)(double u, void *ctx); /* finite for 0 < u < 1 */
    double (*cdf)(double x, void *ctx);      /* continuous, from 0 to 1 over the support */
    double (*pdf)(double x, void *ctx);      /* >= 0, integrates to 1 */
    void *ctx;                               /* handed through */
    double lo, hi; /* support, with cdf and pdf: lo < hi, infinite ends allowed; both 0: the line */
    const double *x, *F;
    size_t count;
    uint64_t reserved[4]; /* must be zero */
} buffon_inversion;

/** The density of X = F^-1(u).
 *
 *  In:      how  must outlive the density, its tables too
 *  Law:     P(X <= x) = F(x)
 *  Draws:   1
 *  Returns: a density of 1 coordinate; it carries BUFFON_E_NULL (how, or the half of a pair),
 *           BUFFON_E_SHAPE (not exactly one form), BUFFON_E_DOMAIN (lo, hi), BUFFON_E_TABLE (also
 *           if the range or a slope of the table exceeds the doubles), BUFFON_E_RESERVED. In use,
 *           BUFFON_E_INVERSION where a quantile is not finite, or a CDF is not a number or does not
 *           reach u within the support (those x are NaN); BUFFON_E_UNSUPPORTED where a pdf or cdf
 *           is wanted and not there. The values of pdf are passed on as they are
 *  Exact:   quantile: what the function gives. cdf: F(x) crosses u, as computed, at x or within
 *           4 ulp of it. Table: F(x), relative to the whole, is u within 2^-51 and what 2 ulp of x
 *           are worth (tests/test_inversion.c)
 *  Repeat:  each x depends on its u alone
 *  Cost:    cdf: some 5 to 15 calls of each function a point, never more than 320; table: the
 *           logarithm of count
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_inverse(const buffon_inversion *how);

/** One point X = F^-1(u), and the pdf there: the same as from buffon_inverse.
 *
 *  Out:     x    NaN on error
 *           pdf  may be NULL; NaN on error
 *  In:      u    in (0, 1)
 *           how
 *  Returns: BUFFON_OK; as buffon_inverse
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_inverse_sample(double *x, double *pdf, double u,
                                                            const buffon_inversion *how);

BUFFON_END

#endif
