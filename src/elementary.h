/* Private. Elementary functions whose bits are the same everywhere.
 *
 * Only + - * / sqrt, comparisons, integer operations and exact conversions, in round to nearest and
 * without contraction, so that a vectorised form can repeat each step bit for bit. No call of libm
 * but sqrt. tests/test_elementary.c checks every statement of accuracy and freezes the bits.
 */
#ifndef BUFFON_SRC_ELEMENTARY_H
#define BUFFON_SRC_ELEMENTARY_H

#include <stdint.h>
#include <string.h>

static inline uint64_t buffon_priv_bits(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline double buffon_priv_from_bits(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* |x|, of a NaN too. */
static inline double buffon_priv_abs(double x)
{
    return buffon_priv_from_bits(buffon_priv_bits(x) & UINT64_C(0x7fffffffffffffff));
}

/* The magnitude of x with the sign of y. */
static inline double buffon_priv_copysign(double x, double y)
{
    const uint64_t sign = UINT64_C(0x8000000000000000);
    return buffon_priv_from_bits((buffon_priv_bits(x) & ~sign) | (buffon_priv_bits(y) & sign));
}

/* Neither infinite nor NaN. */
static inline int buffon_priv_isfinite(double x)
{
    return x - x == 0;
}

/* sin(pi x) and cos(pi x) of any finite x, within 1.4 ulp. The reduction is exact: multiples of 1/2
 * give exactly 0 and +-1. Zeros are +0, but sin(pi x) has the sign of x where x is a whole number.
 * NaN for infinities. */
void buffon_priv_sincospi(double *s, double *c, double x);
double buffon_priv_sinpi(double x);
double buffon_priv_cospi(double x);

/* The natural logarithm, within 0.9 ulp, of subnormals too. log(+-0) is -infinity; NaN below 0. */
double buffon_priv_log(double x);

/* log(1 + x), within 0.9 ulp. log1p(-1) is -infinity; NaN below -1. */
double buffon_priv_log1p(double x);

/* exp(x), within 1 ulp, rounded once where it is subnormal. */
double buffon_priv_exp(double x);

/* exp(x) - 1, within 1.4 ulp. */
double buffon_priv_expm1(double x);

/* The angle of the point (x, y) in units of pi, from -1 to 1, within 1.8 ulp; multiples of 1/4 are
 * exact. Zeros and infinities go as in C's atan2; NaN for a NaN. */
double buffon_priv_atan2pi(double y, double x);

/* The cube root, within 0.6 ulp, of subnormals too. Zeros and infinities give themselves. */
double buffon_priv_cbrt(double x);

/* acos(x)/pi, from 0 to 1, within 1.8 ulp; NaN outside [-1, 1]. */
double buffon_priv_acospi(double x);

/* 2/sqrt(pi) times the integral of exp(-t^2) from x to infinity, within 4 ulp, of subnormal results
 * too. */
double buffon_priv_erfc(double x);

/* P(Z <= z) of a normal Z, within 5 ulp, of subnormal results too. */
double buffon_priv_normal_cdf(double z);

/* x 2^k for any k, rounded once. */
double buffon_priv_ldexp(double x, int k);

/* f in [1/2, 1) in magnitude and k with x = f 2^k; 0, infinity, NaN give themselves and k = 0. */
double buffon_priv_frexp(int *k, double x);

/* The next double above, or below. The infinity of that side and NaN give themselves. */
double buffon_priv_nextup(double x);
double buffon_priv_nextdown(double x);

/* The normal quantile of u, within 8 ulp; 0 and 1 give -+infinity, NaN outside. It grows with u but
 * for rounding, and the values for u and 1 - u are exact opposites where 1 - u is exact. */
double buffon_priv_normal_quantile(double u);

/* The same of 1/2 + q with |q| <= 1/2, which does not lose a small q. */
double buffon_priv_normal_central(double q);

#endif
