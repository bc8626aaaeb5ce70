/* Private. Numbers as sums of two doubles, and logarithms of them, for powers.
 *
 * x^y = exp(y log x): an error of log x is magnified by y, in all by |y log x|, which may be 700.
 * So the logarithm is kept as hi + lo with |lo| <= ulp(hi), good to 2^-62 of itself, and so is its
 * product with y; then the power is good to 2 ulp. tests/test_line_laws.c shows it by the laws.
 */
#ifndef BUFFON_SRC_TWOFOLD_H
#define BUFFON_SRC_TWOFOLD_H

#include "elementary.h"

typedef struct twofold {
    double hi, lo;
} twofold;

/* a + b exactly (D. Knuth, The Art of Computer Programming 2, 4.2.2). */
static inline twofold twofold_sum(double a, double b)
{
    const double sum = a + b, part = sum - a;
    const twofold s = {sum, (a - (sum - part)) + (b - part)};
    return s;
}

/* a b to 2^-105 of itself, by the upper half of the digits of each. */
static inline twofold twofold_product(double a, double b)
{
    const double p = a * b;
    const double ah = buffon_priv_from_bits(buffon_priv_bits(a) & ~UINT64_C(0x7ffffff));
    const double bh = buffon_priv_from_bits(buffon_priv_bits(b) & ~UINT64_C(0x7ffffff));
    const double al = a - ah, bl = b - bh;
    const twofold s = {p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
    return s;
}

/* a b, a / b, to some 2^-100. */
static inline twofold twofold_times(twofold a, double b)
{
    const twofold p = twofold_product(a.hi, b);
    return twofold_sum(p.hi, p.lo + a.lo * b);
}

static inline twofold twofold_over(twofold a, twofold b)
{
    const double q = a.hi / b.hi;
    const twofold p = twofold_product(q, b.hi);
    return twofold_sum(q, (((a.hi - p.hi) - p.lo) + (a.lo - q * b.lo)) / b.hi);
}

/* k ln 2 + log(m) for m near 1: with s = f / (2 + f) and f = m - 1,
 *
 *     log(m) = 2 atanh(s) = 2 s + s (2 z / 3 + 2 z^2 / 5 + ...),   z = s^2 < 0.0295.
 *
 * The terms from z^2 on are so small against 2 s that a double will do for them. */
static inline twofold twofold_log_core(twofold m, double k)
{
    const twofold third2 = {0x1.5555555555555p-1, 0x1.5555555555555p-55};
    const twofold f = twofold_sum(m.hi - 1, m.lo), d = twofold_sum(1, m.hi);
    const twofold s = twofold_over(f, twofold_sum(d.hi, d.lo + m.lo));
    const twofold square = twofold_product(s.hi, s.hi);
    const double z = square.hi, z_lo = square.lo + 2 * s.hi * s.lo;
    const double rest =
        z * z *
        (2. / 5 +
         z * (2. / 7 +
              z * (2. / 9 +
                   z * (2. / 11 +
                        z * (2. / 13 +
                             z * (2. / 15 +
                                  z * (2. / 17 + z * (2. / 19 + z * (2. / 21 + z * 2. / 23)))))))));
    const twofold first = twofold_product(z, third2.hi);
    const twofold q = twofold_sum(first.hi, rest + (first.lo + z * third2.lo + z_lo * third2.hi));
    const twofold sq = twofold_product(s.hi, q.hi);
    const twofold near = twofold_sum(2 * s.hi, sq.hi);
    const double near_lo = near.lo + (2 * s.lo + (sq.lo + s.hi * q.lo + s.lo * q.hi));
    const twofold far = twofold_product(k, 0x1.a39ef35793c76p-33);
    const twofold whole = twofold_sum(k * 0x1.62e42feep-1, near.hi);
    const twofold sum = twofold_sum(whole.hi, far.hi);
    return twofold_sum(sum.hi, sum.lo + (whole.lo + (far.lo + near_lo)));
}

/* log(x / y) for positive finite x and y of any size. */
static inline twofold twofold_log_ratio(double x, double y)
{
    const double root = 0x1.6a09e667f3bcdp-1;
    int k, l;
    const twofold a = {buffon_priv_frexp(&k, x), 0}, b = {buffon_priv_frexp(&l, y), 0};
    twofold m = twofold_over(a, b);
    const double scale = m.hi < root ? 2 : m.hi >= 2 * root ? 0.5 : 1;
    k -= l + (m.hi < root) - (m.hi >= 2 * root);
    m.hi *= scale;
    m.lo *= scale;
    return twofold_log_core(m, k);
}

/* log(hi + lo) for hi > 0. */
static inline twofold twofold_log(twofold x)
{
    int k;
    twofold m = {buffon_priv_frexp(&k, x.hi), x.lo};
    if (m.hi < 0x1.6a09e667f3bcdp-1) {
        m.hi *= 2;
        k--;
    }
    if (k != 0)
        m.lo = buffon_priv_ldexp(x.lo, -k);
    return twofold_log_core(m, k);
}

/* scale 2^up exp(hi + lo), where the exponential alone may leave the doubles: its power of two comes
 * last. */
static inline double twofold_exp_up(twofold x, double scale, int up)
{
    const double most = 4000, z = x.hi * 0x1.71547652b82fep+0;
    const int k = (int)(z < -most ? -most : z > most ? most : z);
    const twofold y = twofold_sum(x.hi, k * -0x1.62e42feep-1);
    const twofold r = twofold_sum(y.hi, y.lo + (x.lo - k * 0x1.a39ef35793c76p-33));
    const double e = buffon_priv_exp(r.hi);
    return buffon_priv_ldexp(scale * (buffon_priv_isfinite(e) ? e + e * r.lo : e), k + up);
}

static inline double twofold_exp(twofold x, double scale)
{
    return twofold_exp_up(x, scale, 0);
}

#endif
