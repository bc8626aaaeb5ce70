/* Private. Elementary functions of lanes: included by levels.h after lanes.h, once for each level.
 * One lane of them is the scalar function of the same name in elementary.h, which states its
 * accuracy.
 *
 * Each one reduces its argument exactly or with a compensated remainder, evaluates a polynomial,
 * and puts the result together so that only the last step rounds at full size.
 *
 * What only special values need is left out where no lane has one: `plain`. A lane gets the same
 * bits either way, and the branch is one that processors foresee.
 *
 * The polynomials interpolate the named function at Chebyshev nodes of the reduced interval
 * (near-minimax), in 60 digits, and were then rounded; their error is stated beside each.
 */
#ifndef LANES_MATH_CONSTANTS
#define LANES_MATH_CONSTANTS

#define LANES_SHIFT 0x1.8p52 /* added, it rounds to a whole number in the low bits */
#define LANES_SHIFT_BITS UINT64_C(0x4338000000000000)
#define LANES_INF buffon_priv_from_bits(UINT64_C(0x7ff0000000000000))
#define LANES_NAN buffon_priv_from_bits(UINT64_C(0x7ff8000000000000))
#define LANES_TINY 0x1p-54 /* below it, x + x^2 rounds to x */

/* ln 2 in two parts: multiples of the first up to 2^20 are exact. */
#define LANES_LN2_HI 0x1.62e42feep-1
#define LANES_LN2_LO 0x1.a39ef35793c76p-33

#define LANES_NORMAL_MIDDLE 0.425 /* |u - 1/2| up to which the middle function holds */
#define LANES_TILE 256            /* numbers at a time in functions of whole arrays */

#endif

/* 2^k for whole k in -1022 .. 1023, as two's complement. */
LANES_INLINE lanes_d LANES(power2)(lanes_u k)
{
    return lanes_double((k + 1023) << 52);
}

/* y 2^k for y near 1 and |k| < 2000, rounded once: the first product is exact. */
LANES_INLINE lanes_d LANES(scale)(lanes_d y, lanes_u k)
{
    const lanes_u half = ((k + 4096) >> 1) - 2048;
    return y * LANES(power2)(half) * LANES(power2)(k - half);
}

/* ---- sine and cosine ---------------------------------------------------------------------- */

/* sin(pi r) for |r| <= 1/4: pi r + r z S(z) with z = r^2, S to 6.4e-16. The product pi r would
 * round at full size; 4 r does not round, and the rest is small. */
LANES_INLINE lanes_d LANES(sin_core)(lanes_d r)
{
    const lanes_d z = r * r;
    const lanes_d s = -0x1.4abbce625be52p+2 +
                      z * (0x1.466bc6775a476p+1 +
                           z * (-0x1.32d2cce500387p-1 +
                                z * (0x1.50783208843ebp-4 +
                                     z * (-0x1.e3027dea82bd7p-8 + z * 0x1.e4a9d9166f052p-12))));
    return 4.0 * r + r * (-0x1.b7812aeef4b9fp-1 + z * s);
}

/* cos(pi r) for |r| <= 1/4: 1 - z C(z) with z = r^2, C to 2e-18. */
LANES_INLINE lanes_d LANES(cos_core)(lanes_d r)
{
    const lanes_d z = r * r;
    const lanes_d c =
        0x1.3bd3cc9be45dep+2 +
        z * (-0x1.03c1f081b5ac0p+2 +
             z * (0x1.55d3c7e3cb241p+0 +
                  z * (-0x1.e1f5068688d5bp-3 +
                       z * (0x1.a6d1eef479be1p-6 +
                            z * (-0x1.f9ce245cada0bp-10 + z * 0x1.b2f3eb054afcdp-14)))));
    return 1.0 - z * c;
}

/* sin(pi a) and cos(pi a) for |a| <= 2^20: a = n/2 + r with |r| <= 1/4, all of it exact; n mod 4
 * turns and reflects. */
LANES_INLINE void LANES(sincospi_near)(lanes_d *s, lanes_d *c, lanes_d a)
{
    const uint64_t sign = UINT64_C(0x8000000000000000);
    const lanes_d shifted = 2.0 * a + LANES_SHIFT;
    const lanes_u n = lanes_bits(shifted);
    const lanes_d r = a - 0.5 * (shifted - LANES_SHIFT);
    const lanes_d sine = LANES(sin_core)(r), cosine = LANES(cos_core)(r);
    const lanes_m swap = lanes_odd(n);
    const lanes_u turned = lanes_bits(lanes_pick(swap, cosine, sine)) ^ (n << 62 & sign);
    const lanes_u other = lanes_bits(lanes_pick(swap, sine, cosine)) ^ ((n + 1) << 62 & sign);
    *s = lanes_double(turned) + 0.0;
    *c = lanes_double(other) + 0.0;
}

/* First a multiple of 2^20 is taken away, exactly. From 2^53 on x is even, and so is the rest. */
LANES_INLINE void LANES(sincospi)(lanes_d *s, lanes_d *c, lanes_d x)
{
    const uint64_t sign = UINT64_C(0x8000000000000000);
    lanes_d a = lanes_abs(x);
    if (!lanes_every(lanes_less(a, lanes_all(0x1p20))))
        a -= (a + 0x1.8p72) - 0x1.8p72;
    LANES(sincospi_near)(s, c, a);
    *s = lanes_double(lanes_bits(*s) ^ (lanes_bits(x) & sign));
}

/* ---- logarithm ---------------------------------------------------------------------------- */

/* With s = f / (2 + f): log(1 + f) = 2 atanh(s) = f - s (f - R) where R = z P(z), z = s^2 and P is
 * 2 atanh(s)/s less 2, over z. P to 3.2e-16 for |s| <= 3 - 2 sqrt(2). */
LANES_INLINE lanes_d LANES(log_rest)(lanes_d s)
{
    const lanes_d z = s * s;
    const lanes_d w = z * z;
    const lanes_d even =
        0x1.5555555555558p-1 +
        w * (0x1.2492492df281ap-2 + w * (0x1.7462b51cb66b1p-3 + w * 0x1.2b5900de53b32p-3));
    const lanes_d odd =
        0x1.99999999952d7p-2 + w * (0x1.c71c62e3f11e6p-3 + w * 0x1.39fe51a7c18f9p-3);
    return z * (even + z * odd);
}

/* k ln 2 + log(1 + f) + c, for small c. The terms are added from the smallest up; f - s (f - R) is
 * written as f - (f^2/2 - s (f^2/2 + R)), whose first two terms round less. */
LANES_INLINE lanes_d LANES(log_core)(lanes_d k, lanes_d f, lanes_d c)
{
    const lanes_d s = f / (2.0 + f);
    const lanes_d half = 0.5 * f * f;
    const lanes_d low = s * (half + LANES(log_rest)(s)) + (k * LANES_LN2_LO + c);
    return k * LANES_LN2_HI - ((half - low) - f);
}

/* The exponent k of a normal x = m 2^k with m in [sqrt(1/2), sqrt(2)), and m. The exponent becomes
 * a double in the low bits of 2^52. */
LANES_INLINE lanes_d LANES(log_split)(lanes_d *m, lanes_d x)
{
    const uint64_t offset = UINT64_C(0x3ff0000000000000) - UINT64_C(0x3fe6a09e667f3bcd);
    const lanes_u bits = lanes_bits(x), biased = (bits + offset) >> 52;
    *m = lanes_double(bits - ((biased - 1023) << 52));
    return lanes_double(biased | UINT64_C(0x4330000000000000)) - (0x1p52 + 1023);
}

LANES_INLINE lanes_d LANES(log)(lanes_d x)
{
    const lanes_d zero = lanes_all(0), inf = lanes_all(LANES_INF);
    const int plain =
        lanes_every(lanes_and(lanes_less_equal(lanes_all(0x1p-1022), x), lanes_less(x, inf)));
    lanes_d y = x, shift = zero, m, k, result;
    if (!plain) {
        const lanes_m subnormal = lanes_less(x, lanes_all(0x1p-1022));
        const lanes_m positive = lanes_and(lanes_less(zero, x), lanes_less(x, inf));
        y = lanes_pick(positive, lanes_pick(subnormal, x * 0x1p54, x), lanes_all(1));
        shift = lanes_pick(subnormal, lanes_all(54), zero);
    }
    k = LANES(log_split)(&m, y) - shift;
    result = LANES(log_core)(k, m - 1.0, zero);
    if (!plain) {
        result = lanes_pick(lanes_less(x, inf), result, x);
        result = lanes_pick(lanes_equal(x, zero), -inf, result);
        result = lanes_pick(lanes_less(x, zero), lanes_all(LANES_NAN), result);
    }
    return result;
}

/* log of u = 1 + x and of the rounding of that sum, (x - (u - 1)) / u to first order; in the middle
 * u is not used at all. */
LANES_INLINE lanes_d LANES(log1p)(lanes_d x)
{
    const lanes_d u = 1.0 + x, zero = lanes_all(0), inf = lanes_all(LANES_INF);
    const lanes_d lost = lanes_pick(lanes_less(lanes_all(1), x), 1.0 - (u - x), x - (u - 1.0)) / u;
    const lanes_m small = lanes_less(lanes_abs(x), lanes_all(LANES_TINY));
    const lanes_m positive = lanes_and(lanes_less(zero, u), lanes_less(u, inf));
    const int plain = lanes_every(positive);
    lanes_d m, k, result;
    lanes_m middle;
    k = LANES(log_split)(&m, plain ? u : lanes_pick(positive, u, lanes_all(1)));
    middle = lanes_equal(k, zero);
    result = LANES(log_core)(k, lanes_pick(middle, x, m - 1.0), lanes_pick(middle, zero, lost));
    result = lanes_pick(small, x, result);
    if (!plain) {
        result = lanes_pick(lanes_less(u, inf), result, u);
        result = lanes_pick(lanes_equal(u, zero), -inf, result);
        result = lanes_pick(lanes_less(u, zero), lanes_all(LANES_NAN), result);
    }
    return result;
}

/* ---- exponential -------------------------------------------------------------------------- */

/* x + c = k ln 2 + r + low with |r| <= 0.347: returns exp(r + low) - 1 - r, and r and k. x is in
 * the range of the exponents, |c| below 1e-4. The polynomial is (exp(r) - 1 - r) / r^2, to
 * 1.1e-16. */
LANES_INLINE lanes_d LANES(exp_core)(lanes_d *r, lanes_u *k, lanes_d x, lanes_d c)
{
    const lanes_d shifted = x * 0x1.71547652b82fep+0 + LANES_SHIFT;
    const lanes_d n = shifted - LANES_SHIFT;
    const lanes_d high = x - n * LANES_LN2_HI;
    const lanes_d tail = n * LANES_LN2_LO - c;
    const lanes_d y = high - tail;
    const lanes_d low = (high - y) - tail;
    const lanes_d p = 0x1.0000000000001p-1 +
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
    *k = lanes_bits(shifted) - LANES_SHIFT_BITS;
    return y * y * p + low;
}

LANES_INLINE lanes_d LANES(exp)(lanes_d x)
{
    const int plain = lanes_every(lanes_less(lanes_abs(x), lanes_all(708)));
    const lanes_d y = plain ? x : lanes_min(lanes_max(x, lanes_all(-750)), lanes_all(710));
    lanes_d r, rest;
    lanes_u k;
    rest = LANES(exp_core)(&r, &k, y, lanes_all(0));
    if (plain)
        return (1.0 + (r + rest)) * LANES(power2)(k);
    return lanes_pick(lanes_equal(x, x), LANES(scale)(1.0 + (r + rest), k), x);
}

/* 2^k ((1 - 2^-k) + r + rest), where the first sum is exact in two parts. */
LANES_INLINE lanes_d LANES(expm1)(lanes_d x)
{
    const lanes_d size = lanes_abs(x);
    const int plain = lanes_every(
        lanes_and(lanes_less_equal(lanes_all(LANES_TINY), size), lanes_less(size, lanes_all(44))));
    const lanes_d y = plain ? x : lanes_min(lanes_max(x, lanes_all(-44)), lanes_all(710));
    lanes_d r, rest, inverse, first, sum, result;
    lanes_u k;
    rest = LANES(exp_core)(&r, &k, y, lanes_all(0));
    inverse = LANES(power2)(0 - k);
    if (!plain) /* from 2^1000 on the 1 is long gone */
        inverse = lanes_pick(lanes_less(y, lanes_all(690)), inverse, lanes_all(0x1p-1000));
    first = 1.0 - inverse;
    sum = first + r;
    sum += (r - (sum - first)) + rest;
    if (plain)
        return sum * LANES(power2)(k);
    result = LANES(scale)(sum, k);
    result = lanes_pick(lanes_less(size, lanes_all(LANES_TINY)), x, result);
    return lanes_pick(lanes_equal(x, x), result, x);
}

/* ---- cube root ---------------------------------------------------------------------------- */

/* x = m 2^(3 q + r) with m in [sqrt(1/2), sqrt(2)) and r = -1, 0, 1. The quadratics in r are 2^r
 * and its cube root; the polynomial is the cube root of m, to 1.4e-5. The product y of these roots
 * is rounded to 17 bits, so y^3 is exact, and so is a - y^3 for a = m 2^r. With d = (a - y^3) / y^3
 * the root is y (1 + d)^(1/3) = y (1 + d/3 - d^2/9 + 5 d^3/81), to 1e-18. */
LANES_INLINE lanes_d LANES(cbrt)(lanes_d x)
{
    const lanes_d size = lanes_abs(x), inf = lanes_all(LANES_INF);
    const int plain =
        lanes_every(lanes_and(lanes_less_equal(lanes_all(0x1p-1022), size), lanes_less(size, inf)));
    lanes_d v = size, shift = lanes_all(0), m, k, shifted, r, a, y, cube, d, result;
    if (!plain) {
        const lanes_m subnormal = lanes_less(size, lanes_all(0x1p-1022));
        v = lanes_pick(subnormal, size * 0x1p54, size);
        v = lanes_pick(lanes_and(lanes_less(lanes_all(0), v), lanes_less(v, inf)), v, lanes_all(1));
        shift = lanes_pick(subnormal, lanes_all(54), shift);
    }
    k = LANES(log_split)(&m, v) - shift;
    shifted = k * 0x1.5555555555555p-2 + LANES_SHIFT;
    r = k - 3.0 * (shifted - LANES_SHIFT);
    a = m * (1.0 + r * (0.75 + 0.25 * r));
    y = 0x1.d093b879adecep-2 +
        m * (0x1.cb216702c91b8p-1 +
             m * (-0x1.0c2b25ead282dp-1 + m * (0x1.acbd9f5c005f9p-3 + m * -0x1.26e9dff4b8569p-5)));
    y *= 1.0 + r * (0x1.dd68e9bbaedb3p-3 + r * 0x1.b744985853524p-6);
    y = lanes_double((lanes_bits(y) + (UINT64_C(1) << 35)) & ~UINT64_C(0xfffffffff));
    cube = y * y * y;
    d = (a - cube) / cube;
    result =
        y +
        y * (d * (0x1.5555555555555p-2 + d * (-0x1.c71c71c71c71cp-4 + d * 0x1.f9add3c0ca458p-5)));
    result *= LANES(power2)(lanes_bits(shifted) - LANES_SHIFT_BITS);
    if (!plain)
        result = lanes_pick(lanes_and(lanes_less(lanes_all(0), size), lanes_less(size, inf)),
                            result, size);
    return lanes_copysign(result, x);
}

/* ---- angle -------------------------------------------------------------------------------- */

/* atan(t)/pi for |t| <= tan(pi/8): t/pi + t z A(z) with z = t^2, A to 1e-17. Here t/4 is exact. */
LANES_INLINE lanes_d LANES(atan_core)(lanes_d t)
{
    const lanes_d z = t * t;
    const lanes_d w = z * z;
    const lanes_d even = -0x1.b2995e7b7b603p-4 +
                         w * (-0x1.7483758df44fdp-5 +
                              w * (-0x1.da1b9d74cf8f6p-6 +
                                   w * (-0x1.5b911bdea8714p-6 +
                                        w * (-0x1.0936b10a12bebp-6 + w * -0x1.9003719c7c540p-8))));
    const lanes_d odd =
        0x1.04c26be3b02cbp-4 +
        w * (0x1.21bb94285b332p-5 +
             w * (0x1.91297263b094bp-6 + w * (0x1.31835c828f87ap-6 + w * 0x1.99303bd9db106p-7)));
    return 0.25 * t + t * (0x1.17cc1b727220bp-4 + z * (even + z * odd));
}

/* The first octant by t = low / high; above tan(pi/8) its distance from 1/4 by (t - 1)/(t + 1). The
 * other octants are reflections, all about exact numbers. Both zero or both infinite stand for the
 * numbers 0, 1 and 1, 1. Both are halved where low + high could overflow; the only digits lost so
 * are of a t that is zero. */
LANES_INLINE lanes_d LANES(atan2pi)(lanes_d y, lanes_d x)
{
    const lanes_d ax = lanes_abs(x), ay = lanes_abs(y), zero = lanes_all(0), one = lanes_all(1);
    lanes_d high = lanes_max(ax, ay), low = lanes_min(ax, ay), t, turned, angle;
    lanes_m far;
    if (!lanes_every(
            lanes_and(lanes_less(zero, ax + ay), lanes_less(ax + ay, lanes_all(0x1p1000))))) {
        const lanes_m equal = lanes_equal(ax, ay);
        const lanes_m large = lanes_less(lanes_all(0x1p1000), high);
        const lanes_m numbers = lanes_and(lanes_equal(x, x), lanes_equal(y, y));
        const lanes_d scale = lanes_pick(large, lanes_all(0.5), one);
        low = lanes_pick(equal, lanes_pick(lanes_equal(ax, zero), zero, one), low * scale);
        high = lanes_pick(equal, one, high * scale);
        high = lanes_pick(numbers, high, lanes_all(LANES_NAN));
    }
    t = low / high;
    turned = (low - high) / (low + high);
    far = lanes_less(lanes_all(0x1.a827999fcef32p-2), t);
    angle = lanes_pick(far, lanes_all(0.25), zero) + LANES(atan_core)(lanes_pick(far, turned, t));
    angle = lanes_pick(lanes_less(ax, ay), 0.5 - angle, angle);
    angle = lanes_pick(lanes_less(lanes_copysign(one, x), zero), 1.0 - angle, angle);
    return lanes_copysign(angle, y);
}

/* asin(s)/pi for 0 <= s <= 1/2: s/pi + s w A(w) with w = s^2, A to 5e-18. Here s/4 is exact. */
LANES_INLINE lanes_d LANES(asin_core)(lanes_d s, lanes_d w)
{
    const lanes_d v = w * w;
    const lanes_d even =
        0x1.b2995e7b7b604p-5 +
        v * (0x1.d1a452f2a0e7bp-7 +
             v * (0x1.d2b3511ff8b23p-8 +
                  v * (0x1.23733817c23abp-8 +
                       v * (0x1.aeaef5be792a6p-9 +
                            v * (0x1.6afed9e72d4a0p-8 + v * 0x1.2bf48c984f23ep-7)))));
    const lanes_d odd = 0x1.8723a1d588499p-6 +
                        v * (0x1.3ce52a04819f0p-7 +
                             v * (0x1.69fbea396bfafp-8 +
                                  v * (0x1.deedbc4af55d9p-9 +
                                       v * (0x1.c76410ac3621cp-10 + v * -0x1.35d2548eb0149p-8))));
    return 0.25 * s + s * (0x1.17cc1b727220bp-4 + w * (even + w * odd));
}

/* In the middle 1/2 - asin(x)/pi. For |x| > 1/2 twice the arc sine of s = sqrt((1 - |x|)/2), where
 * what is below the root is exact, and negative for |x| > 1; reflected for negative x. */
LANES_INLINE lanes_d LANES(acospi)(lanes_d x)
{
    const lanes_d size = lanes_abs(x), z = 0.5 - 0.5 * size;
    const lanes_m far = lanes_less(lanes_all(0.5), size);
    const lanes_d s = lanes_pick(far, lanes_sqrt(z), size);
    const lanes_d arc = LANES(asin_core)(s, lanes_pick(far, z, size * size));
    const lanes_d twice = arc + arc;
    const lanes_m below = lanes_less(x, lanes_all(0));
    const lanes_d outer = lanes_pick(below, 1.0 - twice, twice);
    return lanes_pick(far, outer, 0.5 - lanes_copysign(arc, x));
}

/* ---- error function, normal probability --------------------------------------------------- */

/* erfc(a) = v 2^k for 0 <= a <= 27.5, where high + low = -a^2, |low| < 1e-4:
 * exp(-a^2) (1 + s Q(s)) / (1 + 2 a) with s = a / (a + 4). That leaves for 1 + s Q a function
 * between 1 and 1.3 that is smooth at infinity too (M. Schonfelder 1978, Chebyshev expansions for
 * the error and related functions, Mathematics of Computation 32). Q is a polynomial in s - 7/16,
 * to 9e-17; its first terms stand alone because even and odd parts cancel where a is large. */
LANES_INLINE lanes_d LANES(erfc_core)(lanes_u *k, lanes_d a, lanes_d high, lanes_d low)
{
    const lanes_d s = a / (a + 4.0);
    const lanes_d t = s - 0.4375;
    const lanes_d w = t * t;
    const lanes_d even = -0x1.ce34221af1165p+2 +
                         w * (-0x1.6a577d4e1dfcbp+3 +
                              w * (-0x1.bd730cfd1299fp+2 +
                                   w * (0x1.8652b58e88843p-3 +
                                        w * (0x1.3a3e9ae4839efp-1 +
                                             w * (-0x1.668a99f7c2bbbp-2 +
                                                  w * (0x1.417d4bab0eae8p-3 +
                                                       w * (-0x1.21bcc5234a623p-4 +
                                                            w * (0x1.0ec44254b4068p-5 +
                                                                 w * -0x1.85a6a58d77c72p-7))))))));
    const lanes_d odd =
        0x1.3fea472c273a8p+3 +
        w * (0x1.484419094803cp+3 +
             w * (0x1.6d7cfae68b65cp+1 +
                  w * (-0x1.2e1d3e4317300p+0 +
                       w * (0x1.797c2eba5c625p-3 +
                            w * (0x1.5180f09188915p-5 +
                                 w * (-0x1.d423208695eb2p-5 +
                                      w * (0x1.29a643afb0c41p-5 + w * -0x1.c5b76dfd7eeddp-7)))))));
    const lanes_d q =
        0x1.2530400ad34ddp-1 +
        t * (-0x1.f228f86702794p+0 + t * (0x1.0ff2daac52c6cp+2 + t * (even + t * odd)));
    const lanes_d g = (1.0 + s * q) / (1.0 + 2.0 * a);
    lanes_d r;
    const lanes_d rest = LANES(exp_core)(&r, k, high, low);
    return g + g * (r + rest);
}

/* The square of a in two parts, the first of them exact: a^2 = h^2 + (a + h) (a - h) with h the
 * upper half of the digits of a. */
LANES_INLINE lanes_d LANES(square)(lanes_d *low, lanes_d a)
{
    const lanes_d h = lanes_double(lanes_bits(a) & ~UINT64_C(0x7ffffff));
    *low = (a + h) * (a - h);
    return h * h;
}

LANES_INLINE lanes_d LANES(erfc)(lanes_d x)
{
    const lanes_d a = lanes_min(lanes_abs(x), lanes_all(27.5));
    const int plain = lanes_every(lanes_less(a, lanes_all(26)));
    lanes_d low, result;
    lanes_u k;
    const lanes_d high = LANES(square)(&low, a);
    const lanes_d v = LANES(erfc_core)(&k, a, -high, -low);
    result = plain ? v * LANES(power2)(k) : LANES(scale)(v, k);
    result = lanes_pick(lanes_less(x, lanes_all(0)), 2.0 - result, result);
    return plain ? result : lanes_pick(lanes_equal(x, x), result, x);
}

/* P(Z <= z) = erfc(-z / sqrt(2)) / 2. The exponent is -z^2/2, not the square of a quotient that was
 * rounded; the rest of erfc hardly changes where its argument does. */
LANES_INLINE lanes_d LANES(normal_cdf)(lanes_d z)
{
    const lanes_d a = lanes_min(lanes_abs(z), lanes_all(38.75));
    const int plain = lanes_every(lanes_less(a, lanes_all(36)));
    lanes_d low, result;
    lanes_u k;
    const lanes_d high = LANES(square)(&low, a);
    const lanes_d v = LANES(erfc_core)(&k, a * 0x1.6a09e667f3bcdp-1, -0.5 * high, -0.5 * low);
    result = plain ? v * LANES(power2)(k - 1) : LANES(scale)(v, k - 1);
    result = lanes_pick(lanes_less(lanes_all(0), z), 1.0 - result, result);
    return plain ? result : lanes_pick(lanes_equal(z, z), result, z);
}

/* ---- normal quantile ---------------------------------------------------------------------- */

/* M. Wichura (1988), Algorithm AS 241: the percentage points of the normal distribution, Applied
 * Statistics 37. Three rational functions of degree 7, PPND16 there: of q = u - 1/2 in the middle,
 * of sqrt(-log p) in the tails. The numbers are those of the paper. They hold for every p that is a
 * double, subnormals too. */

/* The quantile of 1/2 + q, |q| <= LANES_NORMAL_MIDDLE. */
LANES_INLINE lanes_d LANES(normal_middle)(lanes_d q)
{
    const lanes_d r = 0.180625 - q * q;
    const lanes_d above =
        3.3871328727963666080e+0 +
        r * (1.3314166789178437745e+2 +
             r * (1.9715909503065514427e+3 +
                  r * (1.3731693765509461125e+4 +
                       r * (4.5921953931549871457e+4 +
                            r * (6.7265770927008700853e+4 +
                                 r * (3.3430575583588128105e+4 + r * 2.5090809287301226727e+3))))));
    const lanes_d below =
        1.0 +
        r * (4.2313330701600911252e+1 +
             r * (6.8718700749205790830e+2 +
                  r * (5.3941960214247511077e+3 +
                       r * (2.1213794301586595867e+4 +
                            r * (3.9307895800092710610e+4 +
                                 r * (2.8729085735721942674e+4 + r * 5.2264952788528545610e+3))))));
    return q * above / below;
}

/* The same for sqrt(-log p) = 1.6 + r up to 5. */
LANES_INLINE lanes_d LANES(normal_near)(lanes_d r)
{
    const lanes_d above = 1.42343711074968357734e+0 +
                          r * (4.63033784615654529590e+0 +
                               r * (5.76949722146069140550e+0 +
                                    r * (3.64784832476320460504e+0 +
                                         r * (1.27045825245236838258e+0 +
                                              r * (2.41780725177450611770e-1 +
                                                   r * (2.27238449892691845833e-2 +
                                                        r * 7.74545014278341407640e-4))))));
    const lanes_d below = 1.0 + r * (2.05319162663775882187e+0 +
                                     r * (1.67638483018380384940e+0 +
                                          r * (6.89767334985100004550e-1 +
                                               r * (1.48103976427480074590e-1 +
                                                    r * (1.51986665636164571966e-2 +
                                                         r * (5.47593808499534494600e-4 +
                                                              r * 1.05075007164441684324e-9))))));
    return above / below;
}

/* The same for sqrt(-log p) = 5 + r up to 28. */
LANES_INLINE lanes_d LANES(normal_far)(lanes_d r)
{
    const lanes_d above = 6.65790464350110377720e+0 +
                          r * (5.46378491116411436990e+0 +
                               r * (1.78482653991729133580e+0 +
                                    r * (2.96560571828504891230e-1 +
                                         r * (2.65321895265761230930e-2 +
                                              r * (1.24266094738807843860e-3 +
                                                   r * (2.71155556874348757815e-5 +
                                                        r * 2.01033439929228813265e-7))))));
    const lanes_d below = 1.0 + r * (5.99832206555887937690e-1 +
                                     r * (1.36929880922735805310e-1 +
                                          r * (1.48753612908506148525e-2 +
                                               r * (7.86869131145613259100e-4 +
                                                    r * (1.84631831751005468180e-5 +
                                                         r * (1.42151175831644588870e-7 +
                                                              r * 2.04426310338993978564e-15))))));
    return above / below;
}

/* z with P(Z > z) = p, for p up to 1/2 - LANES_NORMAL_MIDDLE. */
LANES_INLINE lanes_d LANES(normal_tail)(lanes_d p)
{
    const lanes_d r = lanes_sqrt(-LANES(log)(p));
    const lanes_m near = lanes_less_equal(r, lanes_all(5));
    lanes_d z = LANES(normal_near)(r - 1.6);
    if (!lanes_every(near))
        z = lanes_pick(near, z, LANES(normal_far)(r - 5.0));
    return lanes_pick(lanes_equal(p, lanes_all(0)), r, z);
}

/* The quantile of u outside the middle. */
LANES_INLINE lanes_d LANES(normal_outer)(lanes_d u)
{
    const lanes_m below = lanes_less(u, lanes_all(0.5));
    const lanes_d z = LANES(normal_tail)(lanes_pick(below, u, 1.0 - u));
    return lanes_pick(below, -z, z);
}

/* The quantiles of u[n]; z may be u. The tails are 15 % of uniforms, but most vectors would have
 * one: they are gathered, computed side by side and put back. */
static inline void LANES(normal_quantiles)(double *z, const double *u, size_t n)
{
    double outer[LANES_TILE + LANES_WIDTH];
    lanes_m tail[LANES_TILE / LANES_WIDTH];
    for (size_t start = 0; start < n; start += LANES_TILE, u += LANES_TILE, z += LANES_TILE) {
        const size_t m = n - start < LANES_TILE ? n - start : LANES_TILE;
        size_t count = 0;
        for (size_t i = 0; i < m; i += LANES_WIDTH) {
            const lanes_d v = lanes_load(u + i, m - i), q = v - 0.5;
            const lanes_m t = lanes_less(lanes_all(LANES_NORMAL_MIDDLE), lanes_abs(q));
            tail[i / LANES_WIDTH] = t;
            lanes_compress(outer + count, v, t);
            count += lanes_count(t);
            lanes_store(z + i, LANES(normal_middle)(q), m - i);
        }
        for (size_t i = 0; i < count; i += LANES_WIDTH) {
            const lanes_d v = lanes_load(outer + i, count - i);
            lanes_store(outer + i, LANES(normal_outer)(v), LANES_WIDTH);
        }
        count = 0;
        for (size_t i = 0; i < m; i += LANES_WIDTH) {
            const lanes_m t = tail[i / LANES_WIDTH];
            lanes_store(z + i, lanes_expand(lanes_load(z + i, m - i), outer + count, t), m - i);
            count += lanes_count(t);
        }
    }
}
