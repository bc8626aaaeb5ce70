/* Private. Logarithms and exponentials of numbers of twice the digits, for powers.
 *
 * x^y = exp(y log x): an error of log x is magnified by y, in all by |y log x|, which may be 700.
 * So the logarithm is kept as hi + lo with |lo| <= ulp(hi), good to 2^-62 of itself, and so is its
 * product with y; then the power is good to 2 ulp. tests/test_line_laws.c shows it by the laws.
 */
#ifndef BUFFON_SRC_PAIR_MATH_H
#define BUFFON_SRC_PAIR_MATH_H

#include "elementary.h"
#include "pair.h"

/* k ln 2 + log(m) for m near 1: with s = f / (2 + f) and f = m - 1,
 *
 *     log(m) = 2 atanh(s) = 2 s + s (2 z / 3 + 2 z^2 / 5 + ...),   z = s^2 < 0.0295.
 *
 * The terms from z^2 on are so small against 2 s that a double will do for them. */
static inline pair pair_log_core(pair m, double k)
{
    const pair third2 = {0x1.5555555555555p-1, 0x1.5555555555555p-55};
    const pair f = pair_sum(m.hi - 1, m.lo), d = pair_sum(1, m.hi);
    const pair s = pair_over(f, pair_sum(d.hi, d.lo + m.lo));
    const pair square = pair_product(s.hi, s.hi);
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
    const pair first = pair_product(z, third2.hi);
    const pair q = pair_sum(first.hi, rest + (first.lo + z * third2.lo + z_lo * third2.hi));
    const pair sq = pair_product(s.hi, q.hi);
    const pair near = pair_sum(2 * s.hi, sq.hi);
    const double near_lo = near.lo + (2 * s.lo + (sq.lo + s.hi * q.lo + s.lo * q.hi));
    const pair far = pair_product(k, 0x1.a39ef35793c76p-33);
    const pair whole = pair_sum(k * 0x1.62e42feep-1, near.hi);
    const pair sum = pair_sum(whole.hi, far.hi);
    return pair_sum(sum.hi, sum.lo + (whole.lo + (far.lo + near_lo)));
}

/* log(x / y) for positive finite x and y of any size. */
static inline pair pair_log_ratio(double x, double y)
{
    const double root = 0x1.6a09e667f3bcdp-1;
    int k, l;
    const pair a = {buffon_priv_frexp(&k, x), 0}, b = {buffon_priv_frexp(&l, y), 0};
    pair m = pair_over(a, b);
    const double scale = m.hi < root ? 2 : m.hi >= 2 * root ? 0.5 : 1;
    k -= l + (m.hi < root) - (m.hi >= 2 * root);
    m.hi *= scale;
    m.lo *= scale;
    return pair_log_core(m, k);
}

/* log(hi + lo) for hi > 0. */
static inline pair pair_log(pair x)
{
    int k;
    pair m = {buffon_priv_frexp(&k, x.hi), x.lo};
    if (m.hi < 0x1.6a09e667f3bcdp-1) {
        m.hi *= 2;
        k--;
    }
    if (k != 0)
        m.lo = buffon_priv_ldexp(x.lo, -k);
    return pair_log_core(m, k);
}

/* scale 2^up exp(hi + lo), where the exponential alone may leave the doubles: its power of two comes
 * last. */
static inline double pair_exp_up(pair x, double scale, int up)
{
    const double most = 4000, z = x.hi * 0x1.71547652b82fep+0;
    const int k = (int)(z < -most ? -most : z > most ? most : z);
    const pair y = pair_sum(x.hi, k * -0x1.62e42feep-1);
    const pair r = pair_sum(y.hi, y.lo + (x.lo - k * 0x1.a39ef35793c76p-33));
    const double e = buffon_priv_exp(r.hi);
    return buffon_priv_ldexp(scale * (buffon_priv_isfinite(e) ? e + e * r.lo : e), k + up);
}

static inline double pair_exp(pair x, double scale)
{
    return pair_exp_up(x, scale, 0);
}

#endif
