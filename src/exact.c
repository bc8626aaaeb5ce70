#include "guard.h"

#include "exact.h"

#include "buffon/stats.h"
#include "elementary.h"
#include "verify.h"

/* A double as +-m 2^e with a whole m below 2^53. */
typedef struct exact_parts {
    uint64_t m;
    int e, negative;
} exact_parts;

static inline exact_parts exact_split(double x)
{
    uint64_t bits = buffon_priv_bits(x);
    int biased = (int)(bits >> 52 & 0x7ff), normal = biased != 0;
    exact_parts p = {
        .m = (bits & UINT64_C(0x000fffffffffffff)) | (uint64_t)normal << 52,
        .e = biased - 1074 - normal,
        .negative = (int)(bits >> 63),
    };
    return p;
}

/* out[1] 2^64 + out[0] = a b + plus, which cannot overflow. */
static inline void exact_multiply(uint64_t *out, uint64_t a, uint64_t b, uint64_t plus)
{
    uint64_t a0 = a & 0xffffffff, a1 = a >> 32, b0 = b & 0xffffffff, b1 = b >> 32;
    uint64_t low = a0 * b0, cross = a0 * b1, mid = a1 * b0 + (low >> 32) + (cross & 0xffffffff);
    uint64_t product = mid << 32 | (low & 0xffffffff);
    out[0] = product + plus;
    out[1] = a1 * b1 + (cross >> 32) + (mid >> 32) + (out[0] < plus);
}

/* Adds carry to limbs[i] and on, as far as it runs. With mask all ones it subtracts. */
static inline void exact_carry(uint64_t *limbs, size_t count, size_t i, uint64_t carry,
                               uint64_t mask)
{
    for (; carry != 0 && i < count; i++) {
        uint64_t sum = (limbs[i] ^ mask) + carry;
        carry = sum < carry;
        limbs[i] = sum ^ mask;
    }
}

/* limbs += w 2^shift, or -= where negative; w[words] is little first. a - x = ~(~a + x) makes one
 * path of both, so random signs cost no mispredicted branch. */
static inline void exact_add(uint64_t *limbs, size_t count, const uint64_t *w, int words, int shift,
                             int negative)
{
    uint64_t mask = 0 - (uint64_t)negative, carry = 0, below = 0;
    int up = (int)((unsigned)shift & 63);
    int first = (shift - up) / 64;
    for (int j = 0; j <= words; j++) {
        uint64_t word = j < words ? w[j] : 0;
        uint64_t piece = word << up | below >> 1 >> (63 - up);
        below = word;
        if (first + j < 0 || first + j >= (int)count)
            continue;
        uint64_t old = limbs[first + j] ^ mask;
        uint64_t sum = old + piece, full = sum + carry;
        carry = (uint64_t)(sum < old) | (uint64_t)(full < sum);
        limbs[first + j] = full ^ mask;
    }
    if (carry != 0)
        exact_carry(limbs, count, (size_t)(first + words + 1), carry, mask);
}

/* k where n = 2^k, as it mostly is: to multiply by n is to shift then. -1 for other n. */
static inline int exact_shift(uint64_t n)
{
    return (n & (n - 1)) == 0 && n != 0 ? (int)(buffon_priv_bits((double)n) >> 52) - 1023 : -1;
}

void buffon_priv_sum_add(uint64_t *sum, double m, uint64_t n, int e)
{
    BUFFON_PRIV_VERIFY(buffon_priv_isfinite(m));
    exact_parts p = exact_split(m);
    const int unit = p.e + e - BUFFON_PRIV_SUM_UNIT, k = exact_shift(n);
    uint64_t w[2];
    if (k >= 0) {
        exact_add(sum, BUFFON_STATS_SUM, &p.m, 1, unit + k, p.negative);
        return;
    }
    exact_multiply(w, p.m, n, 0);
    exact_add(sum, BUFFON_STATS_SUM, w, 2, unit, p.negative);
}

void buffon_priv_squares_add(uint64_t *squares, double a, double b, uint64_t n, int e)
{
    BUFFON_PRIV_VERIFY(buffon_priv_isfinite(a) && buffon_priv_isfinite(b));
    exact_parts p = exact_split(a), q = exact_split(b);
    const int unit = p.e + q.e + e - BUFFON_PRIV_SQUARES_UNIT, k = exact_shift(n);
    uint64_t ab[2], w[3];
    exact_multiply(ab, p.m, q.m, 0);
    if (k >= 0) {
        exact_add(squares, BUFFON_STATS_SQUARES, ab, 2, unit + k, p.negative ^ q.negative);
        return;
    }
    exact_multiply(w, ab[0], n, 0);
    exact_multiply(w + 1, ab[1], n, w[1]);
    exact_add(squares, BUFFON_STATS_SQUARES, w, 3, unit, p.negative ^ q.negative);
}

void buffon_priv_value_add(uint64_t *sum, uint64_t *squares, double y)
{
    exact_parts p = exact_split(y);
    uint64_t w[2];
    exact_add(sum, BUFFON_STATS_SUM, &p.m, 1, p.e - BUFFON_PRIV_SUM_UNIT, p.negative);
    exact_multiply(w, p.m, p.m, 0);
    exact_add(squares, BUFFON_STATS_SQUARES, w, 2, 2 * p.e - BUFFON_PRIV_SQUARES_UNIT, 0);
}

void buffon_priv_limbs_merge(uint64_t *into, const uint64_t *from, size_t limbs)
{
    uint64_t carry = 0;
    for (size_t i = 0; i < limbs; i++) {
        uint64_t a = into[i], sum = a + from[i], full = sum + carry;
        carry = (uint64_t)(sum < a) | (uint64_t)(full < sum);
        into[i] = full;
    }
}

/* out = |limbs|; true if they were negative. */
static int exact_magnitude(uint64_t *out, const uint64_t *limbs, size_t count)
{
    int negative = (int)(limbs[count - 1] >> 63);
    uint64_t mask = 0 - (uint64_t)negative;
    for (size_t i = 0; i < count; i++)
        out[i] = limbs[i] ^ mask;
    exact_carry(out, count, 0, (uint64_t)negative, 0);
    return negative;
}

/* One more than the index of the last limb that is not zero; 0 if all are. */
static size_t exact_length(const uint64_t *limbs, size_t count)
{
    while (count > 0 && limbs[count - 1] == 0)
        count--;
    return count;
}

buffon_priv_wide buffon_priv_limbs_over(const uint64_t *limbs, size_t count, uint64_t n, int unit)
{
    BUFFON_PRIV_VERIFY(n > 0 && count > 0 && count <= BUFFON_STATS_SQUARES);
    uint64_t a[BUFFON_STATS_SQUARES], rest = 0, q[2] = {0, 0};
    int negative = exact_magnitude(a, limbs, count);
    int bit = 64 * (int)exact_length(a, count);
    if (bit == 0)
        return (buffon_priv_wide){0.0, 0};
    /* Long division, a bit at a time, past the point if need be, until 65 bits of quotient are
     * there or nothing is left. */
    do {
        bit--;
        uint64_t next = bit >= 0 ? a[bit / 64] >> (bit % 64) & 1 : 0, over = rest >> 63;
        rest = rest << 1 | next;
        uint64_t take = over | (uint64_t)(rest >= n);
        rest -= take != 0 ? n : 0;
        q[1] = q[1] << 1 | q[0] >> 63;
        q[0] = q[0] << 1 | take;
    } while (q[1] == 0 && (bit > 0 || rest != 0));
    int sticky = rest != 0;
    if (bit > 0) {
        a[bit / 64] &= (UINT64_C(1) << (bit % 64)) - 1;
        sticky |= exact_length(a, (size_t)bit / 64 + 1) > 0;
    }
    buffon_priv_wide result = buffon_priv_wide_round(q[1], q[0], sticky, unit + bit);
    return negative ? buffon_priv_wide_negate(result) : result;
}

/* Room for n S_ab: one limb more, and one for the sign. */
#define EXACT_SPREAD (BUFFON_STATS_SQUARES + 2)

/* out += a factor 2^(64 at), or -= where negative. */
static void exact_add_row(uint64_t *out, const uint64_t *a, size_t length, uint64_t factor,
                          size_t at, int negative)
{
    uint64_t mask = 0 - (uint64_t)negative, high = 0;
    for (size_t i = 0; i < length; i++) {
        if (a[i] == 0 && high == 0)
            continue;
        uint64_t w[2];
        exact_multiply(w, a[i], factor, high);
        uint64_t sum = (out[at + i] ^ mask) + w[0];
        high = w[1] + (uint64_t)(sum < w[0]);
        out[at + i] = sum ^ mask;
    }
    exact_carry(out, EXACT_SPREAD, at + length, high, mask);
}

buffon_priv_wide buffon_priv_limbs_spread(const uint64_t *s_ab, const uint64_t *s_a,
                                          const uint64_t *s_b, uint64_t n)
{
    uint64_t ab[BUFFON_STATS_SQUARES], a[BUFFON_STATS_SUM], b[BUFFON_STATS_SUM];
    uint64_t signed_d[EXACT_SPREAD] = {0}, d[EXACT_SPREAD + 1];
    int minus_ab = exact_magnitude(ab, s_ab, BUFFON_STATS_SQUARES);
    int minus_a = exact_magnitude(a, s_a, BUFFON_STATS_SUM);
    int minus_b = exact_magnitude(b, s_b, BUFFON_STATS_SUM);
    size_t a_length = exact_length(a, BUFFON_STATS_SUM);
    exact_add_row(signed_d, ab, exact_length(ab, BUFFON_STATS_SQUARES), n, 0, minus_ab);
    for (size_t i = 0; i < BUFFON_STATS_SUM; i++) {
        if (b[i] != 0)
            exact_add_row(signed_d, a, a_length, b[i], i, minus_a == minus_b);
    }
    d[0] = 0; /* so that there is always a limb below the leading one */
    int negative = exact_magnitude(d + 1, signed_d, EXACT_SPREAD);
    size_t length = exact_length(d, EXACT_SPREAD + 1);
    if (length == 0)
        return (buffon_priv_wide){0.0, 0};
    buffon_priv_wide result =
        buffon_priv_wide_round(d[length - 1], d[length - 2], exact_length(d, length - 2) > 0,
                               BUFFON_PRIV_SQUARES_UNIT + 64 * ((int)length - 3));
    return negative ? buffon_priv_wide_negate(result) : result;
}
