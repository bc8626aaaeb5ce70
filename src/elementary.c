/* Elementary functions: each one reduces its argument exactly or with a compensated remainder,
 * evaluates a polynomial, and puts the result together so that only the last step rounds at full
 * size. Special values are chosen at the end, never branched to, so that lanes can follow.
 *
 * The polynomials interpolate the named function at Chebyshev nodes of the reduced interval
 * (near-minimax), in 60 digits, and were then rounded; their error is stated beside each.
 */
#include "guard.h"

#include <math.h>

#include "elementary.h"

#define ELEMENTARY_SHIFT 0x1.8p52 /* added, it rounds to a whole number in the low bits */
#define ELEMENTARY_INF buffon_priv_from_bits(UINT64_C(0x7ff0000000000000))
#define ELEMENTARY_NAN buffon_priv_from_bits(UINT64_C(0x7ff8000000000000))
#define ELEMENTARY_TINY 0x1p-54 /* below it, x + x^2 rounds to x */

/* ln 2 in two parts: multiples of the first up to 2^20 are exact. */
#define ELEMENTARY_LN2_HI 0x1.62e42feep-1
#define ELEMENTARY_LN2_LO 0x1.a39ef35793c76p-33

/* 2^k for k in -1022 .. 1023. */
static inline double elementary_power2(int k)
{
    return buffon_priv_from_bits((uint64_t)(k + 1023) << 52);
}

/* y 2^k for y near 1 and |k| < 2000, rounded once: the first product is exact. */
static inline double elementary_scale(double y, int k)
{
    const int half = (k + 4096) / 2 - 2048;
    return y * elementary_power2(half) * elementary_power2(k - half);
}

/* ---- sine and cosine ---------------------------------------------------------------------- */

/* sin(pi r) for |r| <= 1/4: pi r + r z S(z) with z = r^2, S to 6.4e-16. The product pi r would
 * round at full size; 4 r does not round, and the rest is small. */
static inline double elementary_sin_core(double r)
{
    const double z = r * r;
    const double s =
        -0x1.4abbce625be52p+2 +
        z * (0x1.466bc6775a476p+1 +
             z * (-0x1.32d2cce500387p-1 +
                  z * (0x1.50783208843ebp-4 +
                       z * (-0x1.e3027dea82bd7p-8 + z * 0x1.e4a9d9166f052p-12))));
    return 4 * r + r * (-0x1.b7812aeef4b9fp-1 + z * s);
}

/* cos(pi r) for |r| <= 1/4: 1 - z C(z) with z = r^2, C to 2e-18. */
static inline double elementary_cos_core(double r)
{
    const double z = r * r;
    const double c =
        0x1.3bd3cc9be45dep+2 +
        z * (-0x1.03c1f081b5ac0p+2 +
             z * (0x1.55d3c7e3cb241p+0 +
                  z * (-0x1.e1f5068688d5bp-3 +
                       z * (0x1.a6d1eef479be1p-6 +
                            z * (-0x1.f9ce245cada0bp-10 + z * 0x1.b2f3eb054afcdp-14)))));
    return 1 - z * c;
}

/* x = n/2 + r with |r| <= 1/4, all of it exact; n mod 4 turns and reflects. The first step takes
 * away a multiple of 2^20, so that the second sees a small number; from 2^53 on every x is even. */
void buffon_priv_sincospi(double *s, double *c, double x)
{
    const double magnitude = buffon_priv_abs(x);
    double a = magnitude < 0x1p53 ? magnitude : magnitude - magnitude;
    double shifted, r, sine, cosine;
    uint64_t n;
    a -= (a + 0x1.8p72) - 0x1.8p72;
    shifted = 2 * a + ELEMENTARY_SHIFT;
    n = buffon_priv_bits(shifted);
    r = a - 0.5 * (shifted - ELEMENTARY_SHIFT);
    sine = n & 1 ? elementary_cos_core(r) : elementary_sin_core(r);
    cosine = n & 1 ? elementary_sin_core(r) : elementary_cos_core(r);
    sine = n & 2 ? -sine : sine;
    cosine = (n + 1) & 2 ? -cosine : cosine;
    *s = (sine + 0.0) * buffon_priv_copysign(1, x);
    *c = cosine + 0.0;
}

double buffon_priv_sinpi(double x)
{
    double s, c;
    buffon_priv_sincospi(&s, &c, x);
    return s;
}

double buffon_priv_cospi(double x)
{
    double s, c;
    buffon_priv_sincospi(&s, &c, x);
    return c;
}

/* ---- logarithm ---------------------------------------------------------------------------- */

/* With s = f / (2 + f): log(1 + f) = 2 atanh(s) = f - s (f - R) where R = z P(z), z = s^2 and P is
 * 2 atanh(s)/s less 2, over z. P to 3.2e-16 for |s| <= 3 - 2 sqrt(2). */
static inline double elementary_log_rest(double s)
{
    const double z = s * s;
    const double w = z * z;
    const double even = 0x1.5555555555558p-1 +
                        w * (0x1.2492492df281ap-2 +
                             w * (0x1.7462b51cb66b1p-3 + w * 0x1.2b5900de53b32p-3));
    const double odd =
        0x1.99999999952d7p-2 + w * (0x1.c71c62e3f11e6p-3 + w * 0x1.39fe51a7c18f9p-3);
    return z * (even + z * odd);
}

/* k ln 2 + log(1 + f) + c, for small c. The terms are added from the smallest up; f - s (f - R) is
 * written as f - (f^2/2 - s (f^2/2 + R)), whose first two terms round less. */
static inline double elementary_log_core(double k, double f, double c)
{
    const double s = f / (2 + f);
    const double half = 0.5 * f * f;
    const double low = s * (half + elementary_log_rest(s)) + (k * ELEMENTARY_LN2_LO + c);
    return k * ELEMENTARY_LN2_HI - ((half - low) - f);
}

/* The exponent k of a normal x = m 2^k with m in [sqrt(1/2), sqrt(2)), and m. */
static inline int elementary_log_split(double *m, double x)
{
    const uint64_t bits = buffon_priv_bits(x);
    const uint64_t offset = UINT64_C(0x3ff0000000000000) - UINT64_C(0x3fe6a09e667f3bcd);
    const int k = (int)((bits + offset) >> 52) - 1023;
    *m = buffon_priv_from_bits(bits - ((uint64_t)k << 52));
    return k;
}

double buffon_priv_log(double x)
{
    const int subnormal = x < 0x1p-1022;
    const double y = subnormal ? x * 0x1p54 : x;
    double m, result;
    int k = elementary_log_split(&m, y > 0 && y < ELEMENTARY_INF ? y : 1);
    k -= subnormal ? 54 : 0;
    result = elementary_log_core((double)k, m - 1, 0);
    result = y < ELEMENTARY_INF ? result : y;
    result = y == 0 ? -ELEMENTARY_INF : result;
    return y < 0 ? ELEMENTARY_NAN : result;
}

/* log of u = 1 + x and of the rounding of that sum, (x - (u - 1)) / u to first order; in the middle
 * u is not used at all. */
double buffon_priv_log1p(double x)
{
    const double u = 1 + x;
    const double lost = (x > 1 ? 1 - (u - x) : x - (u - 1)) / u;
    double m, f, result;
    const int k = elementary_log_split(&m, u > 0 && u < ELEMENTARY_INF ? u : 1);
    f = k == 0 ? x : m - 1;
    result = elementary_log_core((double)k, f, k == 0 ? 0 : lost);
    result = buffon_priv_abs(x) < ELEMENTARY_TINY ? x : result;
    result = u < ELEMENTARY_INF ? result : u;
    result = u == 0 ? -ELEMENTARY_INF : result;
    return u < 0 ? ELEMENTARY_NAN : result;
}

/* ---- exponential -------------------------------------------------------------------------- */

/* x = k ln 2 + r + low with |r| <= 0.347: returns exp(r + low) - 1 - r, and r and k. x is in the
 * range of the exponents. The polynomial is (exp(r) - 1 - r) / r^2, to 1.1e-16. */
static inline double elementary_exp_core(double *r, int *k, double x)
{
    const double shifted = x * 0x1.71547652b82fep+0 + ELEMENTARY_SHIFT;
    const double n = shifted - ELEMENTARY_SHIFT;
    const double high = x - n * ELEMENTARY_LN2_HI;
    const double tail = n * ELEMENTARY_LN2_LO;
    const double y = high - tail;
    const double low = (high - y) - tail;
    const double p =
        0x1.0000000000001p-1 +
        y * (0x1.5555555555556p-3 +
             y * (0x1.5555555553d56p-5 +
                  y * (0x1.11111111109afp-7 +
                       y * (0x1.6c16c17890eb4p-10 +
                            y * (0x1.a01a01a7c73c0p-13 +
                                 y * (0x1.a019b8f9792eep-16 +
                                      y * (0x1.71de0da24602dp-19 +
                                           y * (0x1.28919ccaf9211p-22 +
                                                y * 0x1.af38c67fbb53ep-26))))))));
    *r = y;
    *k = (int)n;
    return y * y * p + low;
}

double buffon_priv_exp(double x)
{
    double r, rest, y, result;
    int k;
    y = x > -750 ? x : -750;
    y = y < 710 ? y : 710;
    rest = elementary_exp_core(&r, &k, y);
    result = elementary_scale(1 + (r + rest), k);
    return x == x ? result : x;
}

/* 2^k ((1 - 2^-k) + r + rest), where the first sum is exact in two parts. */
double buffon_priv_expm1(double x)
{
    double r, rest, y, first, sum, lost, result;
    int k;
    y = x > -44 ? x : -44;
    y = y < 710 ? y : 710;
    rest = elementary_exp_core(&r, &k, y);
    first = 1 - elementary_power2(k < 1000 ? -k : -1000);
    sum = first + r;
    lost = r - (sum - first);
    result = elementary_scale(sum + (lost + rest), k);
    result = buffon_priv_abs(x) < ELEMENTARY_TINY ? x : result;
    return x == x ? result : x;
}

/* ---- angle -------------------------------------------------------------------------------- */

/* atan(t)/pi for |t| <= tan(pi/8): t/pi + t z A(z) with z = t^2, A to 1e-17. Here t/4 is exact. */
static inline double elementary_atan_core(double t)
{
    const double z = t * t;
    const double w = z * z;
    const double even =
        -0x1.b2995e7b7b603p-4 +
        w * (-0x1.7483758df44fdp-5 +
             w * (-0x1.da1b9d74cf8f6p-6 +
                  w * (-0x1.5b911bdea8714p-6 +
                       w * (-0x1.0936b10a12bebp-6 + w * -0x1.9003719c7c540p-8))));
    const double odd =
        0x1.04c26be3b02cbp-4 +
        w * (0x1.21bb94285b332p-5 +
             w * (0x1.91297263b094bp-6 +
                  w * (0x1.31835c828f87ap-6 + w * 0x1.99303bd9db106p-7)));
    return 0.25 * t + t * (0x1.17cc1b727220bp-4 + z * (even + z * odd));
}

/* The first octant by t = low / high; above tan(pi/8) its distance from 1/4 by (t - 1)/(t + 1). The
 * other octants are reflections, all about exact numbers. */
double buffon_priv_atan2pi(double y, double x)
{
    const double ax = buffon_priv_abs(x), ay = buffon_priv_abs(y);
    const int equal = ax == ay;
    const double high = equal ? 1 : (ax < ay ? ay : ax);
    const double low = equal ? (ax == 0 ? 0 : 1) : (ax < ay ? ax : ay);
    const double scale = high > 0x1p1000 ? 0.5 : 1; /* so that low + high does not overflow */
    const double t = low / high;
    const int far = t > 0x1.a827999fcef32p-2;
    const double turned = (low * scale - high * scale) / (low * scale + high * scale);
    double angle = (far ? 0.25 : 0) + elementary_atan_core(far ? turned : t);
    angle = ay > ax ? 0.5 - angle : angle;
    angle = buffon_priv_bits(x) >> 63 ? 1 - angle : angle;
    angle = x == x && y == y ? angle : ELEMENTARY_NAN;
    return buffon_priv_copysign(angle, y);
}

/* ---- the parts of a double ---------------------------------------------------------------- */

/* Factors that keep the value normal until the last one: a first product that is already subnormal
 * becomes zero whatever it rounded to. */
double buffon_priv_ldexp(double x, int k)
{
    int i;
    for (i = 0; i < 2 && k > 1023; i++) {
        x *= 0x1p1023;
        k -= 1023;
    }
    for (i = 0; i < 2 && k < -1022; i++) {
        x *= 0x1p-969;
        k += 969;
    }
    k = k > 1023 ? 1023 : k;
    return x * elementary_power2(k < -1022 ? -1022 : k);
}

double buffon_priv_frexp(int *k, double x)
{
    const int subnormal = buffon_priv_abs(x) < 0x1p-1022;
    const uint64_t bits = buffon_priv_bits(subnormal ? x * 0x1p54 : x);
    const uint64_t mantissa = bits & UINT64_C(0x800fffffffffffff);
    const int exponent = (int)(bits >> 52 & 0x7ff) - 1022;
    if (x == 0 || !buffon_priv_isfinite(x)) {
        *k = 0;
        return x;
    }
    *k = exponent - (subnormal ? 54 : 0);
    return buffon_priv_from_bits(mantissa | UINT64_C(0x3fe0000000000000));
}

double buffon_priv_nextup(double x)
{
    const uint64_t bits = buffon_priv_bits(x);
    const double next = buffon_priv_from_bits(x < 0 ? bits - 1 : bits + 1);
    const double result = x == 0 ? 0x1p-1074 : next;
    return x < ELEMENTARY_INF ? result : x;
}

double buffon_priv_nextdown(double x)
{
    return -buffon_priv_nextup(-x);
}
