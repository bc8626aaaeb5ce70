#include "guard.h"

#include "shares.h"

#include "elementary.h"

/* Of a + b what the rounded sum leaves out (D. Knuth 1969), for any a and b. */
static double shares_sum_rest(double sum, double a, double b)
{
    const double c = sum - a;
    return (a - (sum - c)) + (b - c);
}

/* The upper half of the digits of x: products of such halves are exact (T. Dekker 1971). */
static double shares_half(double x)
{
    const double c = 0x8000001 * x;
    return c - (c - x);
}

/* Of a b what the rounded product leaves out. */
static double shares_product_rest(double product, double a, double b)
{
    const double a1 = shares_half(a), a2 = a - a1, b1 = shares_half(b), b2 = b - b1;
    return ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2;
}

/* Powers of two in two steps, as 2^1074, which lifts the least double to 1, is none. */
static void shares_scale(buffon_priv_shares *sum, double most)
{
    int e;
    buffon_priv_frexp(&e, most);
    sum->exponent = e;
    sum->scale = buffon_priv_ldexp(1, e < -1000 ? 1000 : -e);
    sum->more = buffon_priv_ldexp(1, e < -1000 ? -e - 1000 : 0);
}

static double shares_scaled(const buffon_priv_shares *sum, uint64_t bits)
{
    return buffon_priv_from_bits(bits) * sum->scale * sum->more;
}

/* The largest mass, or -1 where one is not usable. */
static double shares_largest(const uint64_t *mass, size_t count)
{
    double most = 0;
    for (size_t k = 0; k < count; k++) {
        const double m = buffon_priv_from_bits(mass[k]);
        if (!(m >= 0) || !buffon_priv_isfinite(m))
            return -1;
        most = m > most ? m : most;
    }
    return most;
}

/* total += x 2^64 for x from 0 to 2^63, cut to a whole number, as two words. */
static void shares_add(uint64_t total[2], double x, int minus)
{
    const uint64_t whole = (uint64_t)x, part = (uint64_t)((x - (double)whole) * 0x1p64);
    if (minus) {
        total[1] -= whole + (total[0] < part);
        total[0] -= part;
    } else {
        total[0] += part;
        total[1] += whole + (total[0] < part);
    }
}

/* The sum S of the scaled masses is kept to 104 bits, and so is 2^63 / S. Then each mass times that
 * is exact to 2^-40 of a unit, however many there are, and enters a sum of whole 2^-64 of a unit,
 * which loses less than a unit's 2^-32 in all. So the last sum is 2^63 before it is rounded to
 * units, and as no term is negative, the bounds never fall. A mass of 0 adds nothing at all. */
buffon_status buffon_priv_shares_make(uint64_t *bound, size_t count, buffon_priv_shares *sum)
{
    const double most = shares_largest(bound + 1, count);
    uint64_t total[2] = {UINT64_C(1) << 63, 0}; /* half a unit: cutting the sum rounds it */
    double hi = 0, lo = 0;
    if (!(most > 0))
        return BUFFON_E_SHAPE;
    shares_scale(sum, most);
    for (size_t k = 1; k <= count; k++) {
        const double mass = shares_scaled(sum, bound[k]), s = hi + mass;
        lo += shares_sum_rest(s, hi, mass);
        hi = s + lo;
        lo -= hi - s;
    }
    sum->hi = hi;
    sum->lo = lo;
    const double f = 0x1p63 / hi, p = f * hi;
    const double g = (((0x1p63 - p) - shares_product_rest(p, f, hi)) - f * lo) / hi;
    bound[0] = 0;
    for (size_t k = 1; k <= count; k++) {
        const double mass = shares_scaled(sum, bound[k]), product = mass * f;
        const double rest = shares_product_rest(product, mass, f) + mass * g;
        shares_add(total, product, 0);
        shares_add(total, buffon_priv_abs(rest), rest < 0);
        bound[k] = total[1];
    }
    return BUFFON_OK;
}

unsigned buffon_priv_guide_bits(size_t count)
{
    unsigned bits = 0;
    while ((size_t)1 << bits < count)
        bits++;
    return bits;
}

void buffon_priv_guide_make(uint32_t *first, unsigned bits, const uint64_t *bound, size_t count)
{
    const size_t cells = (size_t)1 << bits;
    uint32_t k = 0;
    for (size_t j = 0; j < cells; j++) {
        const uint64_t begin = (uint64_t)j << (63 - bits);
        while (bound[k + 1] <= begin)
            k++;
        first[j] = k;
    }
    while (count > 0 && bound[count - 1] == SHARES_WHOLE)
        count--;
    first[cells] = (uint32_t)(count - 1);
}
