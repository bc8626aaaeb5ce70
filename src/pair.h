/* Private. Numbers of twice the digits, as unevaluated sums hi + lo of two doubles, for what
 * must not be lost to cancellation: areas, volumes, solid angles, exponents of powers.
 *
 * Errors are a few 2^-105 of the operands, as long as no product of low parts underflows: callers
 * bring their numbers near 1 by an exact power of two. T. Dekker (1971), A floating-point technique
 * for extending the available precision; D. Knuth, The art of computer programming, volume 2.
 */
#ifndef BUFFON_SRC_PAIR_H
#define BUFFON_SRC_PAIR_H

#include <math.h>

#include "elementary.h"

typedef struct pair {
    double hi, lo;
} pair;

static inline pair pair_of(double x)
{
    return (pair){x, 0};
}

/* a + b, exactly. */
static inline pair pair_sum(double a, double b)
{
    const double s = a + b, t = s - a;
    return (pair){s, (a - (s - t)) + (b - t)};
}

static inline pair pair_difference(double a, double b)
{
    return pair_sum(a, -b);
}

/* The upper 26 digits of x: those of both parts multiply without rounding. */
static inline double pair_upper(double x)
{
    return buffon_priv_from_bits((buffon_priv_bits(x) + 0x4000000) & ~UINT64_C(0x7ffffff));
}

/* a b, exactly. */
static inline pair pair_product(double a, double b)
{
    const double p = a * b, c = pair_upper(a), d = pair_upper(b), e = a - c, f = b - d;
    return (pair){p, ((c * d - p) + c * f + e * d) + e * f};
}

static inline pair pair_add(pair a, pair b)
{
    const pair s = pair_sum(a.hi, b.hi), t = pair_sum(a.lo, b.lo);
    const pair v = pair_sum(s.hi, s.lo + t.hi);
    return pair_sum(v.hi, v.lo + t.lo);
}

static inline pair pair_negate(pair a)
{
    return (pair){-a.hi, -a.lo};
}

static inline pair pair_subtract(pair a, pair b)
{
    return pair_add(a, pair_negate(b));
}

static inline pair pair_multiply(pair a, pair b)
{
    const pair p = pair_product(a.hi, b.hi);
    return pair_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

/* a b, a / b, to some 2^-100. */
static inline pair pair_times(pair a, double b)
{
    const pair p = pair_product(a.hi, b);
    return pair_sum(p.hi, p.lo + a.lo * b);
}

static inline pair pair_over(pair a, pair b)
{
    const double q = a.hi / b.hi;
    const pair p = pair_product(q, b.hi);
    return pair_sum(q, (((a.hi - p.hi) - p.lo) + (a.lo - q * b.lo)) / b.hi);
}

static inline pair pair_scale(pair a, double power_of_two)
{
    return (pair){a.hi * power_of_two, a.lo * power_of_two};
}

/* The root, by one step of Newton's from that of the upper part. */
static inline pair pair_sqrt(pair a)
{
    if (!(a.hi > 0))
        return pair_of(0);
    const double s = sqrt(a.hi);
    const pair rest = pair_subtract(a, pair_product(s, s));
    return pair_sum(s, rest.hi / (2 * s));
}

static inline double pair_value(pair a)
{
    return a.hi + a.lo;
}

/* ---- vectors ---- */

static inline pair pair_dot(const pair a[3], const pair b[3])
{
    const pair xy = pair_add(pair_multiply(a[0], b[0]), pair_multiply(a[1], b[1]));
    return pair_add(xy, pair_multiply(a[2], b[2]));
}

static inline void pair_cross(pair out[3], const pair a[3], const pair b[3])
{
    for (int j = 0; j < 3; j++) {
        const int k = (j + 1) % 3, l = (j + 2) % 3;
        out[j] = pair_subtract(pair_multiply(a[k], b[l]), pair_multiply(a[l], b[k]));
    }
}

static inline pair pair_length(const pair a[3])
{
    return pair_sqrt(pair_dot(a, a));
}

#endif
