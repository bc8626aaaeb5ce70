/* Layer 2. Laws on the line with a quantile function in closed form.
 *
 * One uniform makes one point, x = F^-1(u), which grows with u, so stratified, antithetic and
 * quasi-random points keep their order. The uniform law is buffon_segment (box.h).
 *
 * Both tails are good to the last digits: u and 1 - u are used as they are, u down to the smallest
 * double. "ulp" is of the exact result; the numbers are the worst met over all legal parameters
 * and uniforms (tests/test_line_laws.c).
 */
#ifndef BUFFON_LAWS_H
#define BUFFON_LAWS_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** The density that runs straight from at_lo at lo to at_hi at hi, up to a factor.
 *
 *  In:      lo, hi        finite, lo < hi, 2^-1020 <= hi - lo < infinity
 *           at_lo, at_hi  finite, not negative, not both 0
 *  Law:     with a = at_lo, b = at_hi and t = (x - lo) / (hi - lo),
 *           t = u (a + b) / (a + sqrt(a^2 (1 - u) + b^2 u)), where nothing cancels whatever a and b
 *           are; from hi in the upper half. g = 2 (a (1 - t) + b t) / ((hi - lo) (a + b))
 *  Draws:   1
 *  Returns: a density of 1 coordinate; it carries BUFFON_E_DOMAIN (lo, hi) or BUFFON_E_SHAPE
 *  Exact:   the distance from the nearer end within 6 ulp, and what x rounds; g at x within 6 ulp
 *           of the larger end; x is strictly inside where a double is
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_linear(double lo, double hi, double at_lo, double at_hi);

/** The triangular density: straight from 0 at lo up to the mode and down to 0 at hi.
 *
 *  In:      lo, mode, hi  finite, lo <= mode <= hi, 2^-1020 <= hi - lo < infinity
 *  Law:     below the mode x = lo + A sqrt(u / s), s = A / (hi - lo) and A = mode - lo, or near the
 *           mode what is the same, mode - A (s - u) / (s + sqrt(s u)); above it the mirror image
 *  Draws:   1
 *  Returns: a density of 1 coordinate; it carries BUFFON_E_DOMAIN
 *  Exact:   the distance from the nearer end within 6 ulp, and what x rounds; g at x within 4 ulp
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_triangular(double lo, double mode, double hi);

/** The tent: the triangular density on centre - radius to centre + radius.
 *
 *  In:      centre  finite
 *           radius  from 2^-1020 to 2^1020, and not lost beside the centre
 *  Law:     x = centre -+ radius (1 - sqrt(2 u)), u and 1 - u in turn. Points of u and 1 - u are
 *           exact mirrors about a centre of 0
 *  Draws:   1
 *  Returns: a density of 1 coordinate; it carries BUFFON_E_DOMAIN or BUFFON_E_SHAPE
 *  Exact:   x - centre within 4 ulp near the centre, the distance from the nearer end within 4 ulp,
 *           and what x rounds; g at x within 4 ulp
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_tent(double centre, double radius);

/** The Laplace density exp(-|x - mean| / scale) / (2 scale): two exponentials back to back.
 *
 *  In:      mean   of size 2^1000 at most
 *           scale  from 2^-900 to 2^900
 *  Law:     x = mean +- scale log(2 min(u, 1 - u))
 *  Draws:   1
 *  Returns: a density of 1 coordinate; it carries BUFFON_E_SHAPE
 *  Exact:   x - mean within 2 ulp and one rounding; g at x within 3 + |x - mean| / scale ulp
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_laplace(double mean, double scale);

/** The logistic density e / (scale (1 + e)^2) with e = exp(-|x - mean| / scale).
 *
 *  In:      mean   of size 2^1000 at most
 *           scale  from 2^-900 to 2^900
 *  Law:     x = mean + scale log(u / (1 - u)); by log1p((2 u - 1) / (1 - u)) near the mean
 *  Draws:   1
 *  Returns: a density of 1 coordinate; it carries BUFFON_E_SHAPE
 *  Exact:   x - mean within 4 ulp and one rounding; g at x within 5 + |x - mean| / scale ulp
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_logistic(double mean, double scale);

/** The Cauchy density 1 / (pi scale (1 + z^2)) with z = (x - centre) / scale. It has no mean: a
 *  density with tails as heavy as they come.
 *
 *  In:      centre  of size 2^1000 at most
 *           scale   from 2^-900 to 2^900
 *  Law:     x = centre - scale cos(pi u) / sin(pi u). Below u = 1e-154 or so g leaves the doubles,
 *           its logarithm does not
 *  Draws:   1
 *  Returns: a density of 1 coordinate; it carries BUFFON_E_SHAPE
 *  Exact:   x - centre within 5 ulp and one rounding; g at x within 6 ulp
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_cauchy(double centre, double scale);

/** The density proportional to x^exponent on lo < x < hi.
 *
 *  In:      exponent  of size 2^20 at most. With lo = 0 above -1; with hi infinite below -1
 *           lo, hi    0 <= lo < hi, not both 0 and infinite
 *  Law:     with a = exponent + 1 the uniform lies between lo^a and hi^a, in ratios to one of them:
 *           x = hi w^(1/a), w = u + (1 - u) (lo/hi)^a for a > 0; x = lo (hi/lo)^u for a = 0
 *  Draws:   1
 *  Returns: a density of 1 coordinate; it carries BUFFON_E_DOMAIN (lo, hi) or BUFFON_E_SHAPE, also
 *           where the points of u = 2^-53 and 1 - 2^-53 or g there are not normal doubles
 *  Exact:   with lo = 0 or hi infinite, and for exponent = -1, x within 3 ulp; else within
 *           4 (1 + L) ulp, L the smaller of 1 / |a| and log(hi / lo). g at x within 6 ulp, and
 *           2 + |exponent| of that at u
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_power(double exponent, double lo, double hi);

/** The Pareto density alpha scale^alpha / x^(alpha + 1) on x > scale.
 *
 *  In:      alpha  from 2^-20 to 2^20
 *           scale  positive
 *  Law:     x = scale (1 - u)^(-1/alpha): buffon_power(-alpha - 1, scale, INFINITY)
 *  Draws:   1
 *  Returns: as buffon_power
 *  Exact:   as buffon_power
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_pareto(double alpha, double scale);

/** The Weibull density (shape / x) E exp(-E) with E = (x / scale)^shape, on x > 0.
 *
 *  In:      shape  from 2^-4 to 2^20; 1 is the exponential, 2 Rayleigh's law
 *           scale  from 2^-1022 to 2^1022
 *  Law:     x = scale (-log(1 - u))^(1/shape)
 *  Draws:   1
 *  Returns: a density of 1 coordinate; it carries BUFFON_E_SHAPE, also where the points of
 *           u = 2^-53 and 1 - 2^-53 or g there are not normal doubles
 *  Exact:   x within 3 ulp; g at x within 8 + 4 E ulp
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_weibull(double shape, double scale);

BUFFON_END

#endif
