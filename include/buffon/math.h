/* Layer 1. Elementary functions of whole arrays, with the same bits everywhere.
 *
 * What libm gives differs from one system to the next, and so would an integrand that calls it.
 * These are made of + - * / sqrt alone. A result is a function of its argument: it does not depend
 * on the instructions in use (cpu.h), the compiler, n, or where in the array it stands.
 *
 * For all of them:
 *
 *   - n may be any number; 0 does nothing and looks at no pointer;
 *   - arrays need the alignment of a double only; a result array may be an argument array, and is
 *     otherwise apart from all others;
 *   - a NaN gives a NaN (which one is not stated); errno is not touched, and which floating-point
 *     flags are raised is not stated;
 *   - "ulp" is the distance of two doubles at the exact result. The errors are those stated or
 *     below for all doubles tried (tests/test_elementary.c), not proven;
 *   - rounding to nearest is asked for: in other rounding modes last bits differ. Where subnormal
 *     numbers are flushed to zero (FTZ, DAZ: what a program linked with -ffast-math does) results
 *     are the same as long as arguments and results are normal, in magnitude above 1e-290.
 *
 * Why "pi": the arguments of sinpi and cospi are in half turns, sin(pi x). So the reduction to one
 * period is exact for every double, multiples of 1/2 give exactly 0 and +-1, and a uniform number
 * needs no factor that rounds. cos(t) of an angle t in radians is cospi(t * (1 / pi)): its error is
 * that of the product, about |t| 1e-16. acos(x) is pi acospi(x).
 */
#ifndef BUFFON_MATH_H
#define BUFFON_MATH_H

#include "api.h"

BUFFON_BEGIN

/** Sines and cosines of half turns: s = sin(pi x), c = cos(pi x).
 *
 *  Out:     s[n], c[n]  zeros are +0, but s has the sign of x where x is a whole number; NaN for
 *                       infinities
 *  In:      x[n]        any
 *  Exact:   1.4 ulp; multiples of 1/2 exactly
 *  Since:   0.1
 */
BUFFON_API void buffon_math_sincospi(double *s, double *c, const double *x, size_t n);

/** The sines alone: y = sin(pi x), the same bits.
 *
 *  Out, In, Exact: as buffon_math_sincospi
 *  Since:   0.1
 */
BUFFON_API void buffon_math_sinpi(double *y, const double *x, size_t n);

/** The cosines alone: y = cos(pi x), the same bits.
 *
 *  Out, In, Exact: as buffon_math_sincospi
 *  Since:   0.1
 */
BUFFON_API void buffon_math_cospi(double *y, const double *x, size_t n);

/** The angle of the point (x, y) in half turns: t = atan2(y, x) / pi.
 *
 *  Out:     t[n]        in [-1, 1]
 *  In:      y[n], x[n]  any; zeros, infinities and signs as in C's atan2
 *  Exact:   1.8 ulp; multiples of 1/4 exactly
 *  Since:   0.1
 */
BUFFON_API void buffon_math_atan2pi(double *t, const double *y, const double *x, size_t n);

/** Arc cosines in half turns: t = acos(x) / pi.
 *
 *  Out:     t[n]  in [0, 1]; NaN outside
 *  In:      x[n]  in [-1, 1]
 *  Exact:   1.8 ulp; 0, 1/2 and 1 exactly
 *  Since:   0.1
 */
BUFFON_API void buffon_math_acospi(double *t, const double *x, size_t n);

/** Natural logarithms: y = log(x).
 *
 *  Out:     y[n]  log(+-0) is -infinity, log(infinity) infinity; NaN below 0
 *  In:      x[n]  any
 *  Exact:   0.9 ulp, of subnormals too
 *  Since:   0.1
 */
BUFFON_API void buffon_math_log(double *y, const double *x, size_t n);

/** Natural logarithms of numbers near 1: y = log(1 + x).
 *
 *  Out:     y[n]  log1p(-1) is -infinity, log1p(+-0) = +-0; NaN below -1
 *  In:      x[n]  any
 *  Exact:   0.9 ulp
 *  Since:   0.1
 */
BUFFON_API void buffon_math_log1p(double *y, const double *x, size_t n);

/** Exponentials: y = exp(x).
 *
 *  Out:     y[n]  infinite where the result is above all doubles, 0 where it is below 2^-1075
 *  In:      x[n]  any
 *  Exact:   1 ulp, of subnormal results too
 *  Since:   0.1
 */
BUFFON_API void buffon_math_exp(double *y, const double *x, size_t n);

/** Exponentials of numbers near 0, less 1: y = exp(x) - 1.
 *
 *  Out:     y[n]  expm1(+-0) = +-0, expm1(-infinity) = -1; infinite where exp is
 *  In:      x[n]  any
 *  Exact:   1.4 ulp
 *  Since:   0.1
 */
BUFFON_API void buffon_math_expm1(double *y, const double *x, size_t n);

/** Cube roots.
 *
 *  Out:     y[n]  of the sign of x; zeros and infinities give themselves
 *  In:      x[n]  any
 *  Exact:   0.6 ulp, of subnormals too
 *  Since:   0.1
 */
BUFFON_API void buffon_math_cbrt(double *y, const double *x, size_t n);

/** The complementary error function: y = 2/sqrt(pi) times the integral of exp(-t^2) from x up.
 *
 *  Out:     y[n]  from 2 at -infinity to 0 from 27.3 on; erfc(0) = 1
 *  In:      x[n]  any
 *  Exact:   4 ulp, of subnormal results too
 *  Source:  M. Schonfelder (1978), Chebyshev expansions for the error and related functions
 *  Since:   0.1
 */
BUFFON_API void buffon_math_erfc(double *y, const double *x, size_t n);

/** Normal probabilities: p = P(Z <= z). P(Z > z) is that of -z, with all its digits.
 *
 *  Out:     p[n]  from 0 below -38.6 to 1; 1/2 for 0
 *  In:      z[n]  any
 *  Exact:   5 ulp, of subnormal results too
 *  Since:   0.1
 */
BUFFON_API void buffon_math_normal_cdf(double *p, const double *z, size_t n);

/** Normal quantiles: z with P(Z <= z) = u. Uniform numbers become normal ones.
 *
 *  Out:     z[n]  -+infinity for 0 and 1; NaN outside. Grows with u but for rounding; the results
 *                 for u and 1 - u are exact opposites where 1 - u is exact
 *  In:      u[n]  any
 *  Exact:   8 ulp, for the smallest u too; the bits of buffon_normal_quantile (interval.h)
 *  Source:  M. Wichura (1988), algorithm AS 241
 *  Since:   0.1
 */
BUFFON_API void buffon_math_normal_quantile(double *z, const double *u, size_t n);

BUFFON_END

#endif
