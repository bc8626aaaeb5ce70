/* The exact sums against a naive binary arithmetic, one bit at a time; the wide doubles against the
 * doubles. */
#include "tap.h"

#include <math.h>
#include <stdlib.h>

#include <buffon/stats.h>

#include "exact.h"

static uint64_t random_state = 20260101;

static uint64_t random_word(void)
{
    uint64_t z = random_state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
    return z ^ z >> 31;
}

static int random_below(int n)
{
    return (int)(random_word() % (uint64_t)n);
}

/* Long runs of zeros and ones: carries run far, and edges are common. */
static uint64_t random_runs(void)
{
    uint64_t word = 0;
    int bit = 0;
    while (bit < 64) {
        int run = 1 + random_below(random_below(2) ? 64 : 8);
        uint64_t fill = 0 - (random_word() & 1);
        word = (word & ((UINT64_C(1) << bit) - 1)) | fill << bit;
        bit += run;
    }
    return word;
}

/* A double of any exponent, or of one between lo and hi. */
static double random_double(int lo, int hi)
{
    double m = (double)(random_runs() >> (11 + random_below(2) * random_below(50)));
    double x = ldexp(m, lo + random_below(hi - lo + 1) - 53);
    if (lo < -1000 && random_below(20) == 0)
        x = ldexp((double)(random_runs() >> (12 + random_below(52))), -1074);
    return random_below(2) ? -x : x;
}

static double random_any(void)
{
    static const double edges[] = {0x1.fffffffffffffp1023,  0x1p-1074, 0x1p-1022,
                                   0x0.fffffffffffffp-1022, 1.0,       0.0};
    double x = random_below(10) == 0 ? edges[random_below(6)] : random_double(-1074, 1024);
    return isfinite(x) ? x : 1.0;
}

static uint64_t random_count(void)
{
    int kind = random_below(4);
    return kind == 0   ? 1
           : kind == 1 ? UINT64_MAX - (uint64_t)random_below(3)
           : kind == 2 ? random_runs()
                       : (uint64_t)random_below(1000);
}

/* Naive magnitudes: one bit per byte, little first. */
enum { NAIVE_BITS = 64 * (BUFFON_STATS_SQUARES + 2) };

typedef struct naive {
    unsigned char bit[NAIVE_BITS];
} naive;

static void naive_add_bit(naive *a, int at)
{
    while (at < NAIVE_BITS && a->bit[at])
        a->bit[at++] = 0;
    if (at < NAIVE_BITS)
        a->bit[at] = 1;
}

/* a + or - 2^shift b, modulo 2^NAIVE_BITS; bits that fall below 2^0 are dropped. */
static void naive_add(naive *a, const naive *b, int shift, int minus)
{
    for (int i = 0; i < NAIVE_BITS; i++) {
        if (!b->bit[i] || i + shift < 0 || i + shift >= NAIVE_BITS)
            continue;
        if (!minus) {
            naive_add_bit(a, i + shift);
            continue;
        }
        int at = i + shift;
        while (at < NAIVE_BITS && !a->bit[at])
            a->bit[at++] = 1;
        if (at < NAIVE_BITS)
            a->bit[at] = 0;
    }
}

static void naive_set(naive *a, uint64_t word)
{
    memset(a, 0, sizeof *a);
    for (int i = 0; i < 64; i++)
        a->bit[i] = (unsigned char)(word >> i & 1);
}

static void naive_multiply(naive *out, const naive *a, const naive *b)
{
    memset(out, 0, sizeof *out);
    for (int i = 0; i < NAIVE_BITS; i++) {
        if (b->bit[i])
            naive_add(out, a, i, 0);
    }
}

/* The product of at most 53 by 53 by 64 bits, quickly. */
static void naive_product(naive *out, uint64_t a, uint64_t b, uint64_t n)
{
    naive ab;
    memset(&ab, 0, sizeof ab);
    memset(out, 0, sizeof *out);
    for (int i = 0; i < 64; i++) {
        for (int j = 0; j < 64; j++) {
            if ((a >> i & 1) && (b >> j & 1))
                naive_add_bit(&ab, i + j);
        }
    }
    for (int i = 0; i < 128; i++) {
        for (int j = 0; j < 64; j++) {
            if (ab.bit[i] && (n >> j & 1))
                naive_add_bit(out, i + j);
        }
    }
}

/* |x| = m 2^e with a whole m. */
static uint64_t naive_split(double x, int *e)
{
    double m = frexp(fabs(x), e);
    *e -= 53;
    return (uint64_t)ldexp(m, 53);
}

static int naive_equals(const naive *a, const uint64_t *limbs, size_t count)
{
    for (size_t i = 0; i < 64 * count; i++) {
        if (a->bit[i] != (limbs[i / 64] >> (i % 64) & 1))
            return 0;
    }
    return 1;
}

/* Two's complement to magnitude; returns the sign. */
static int naive_load(naive *a, const uint64_t *limbs, size_t count)
{
    int minus = (int)(limbs[count - 1] >> 63);
    memset(a, 0, sizeof *a);
    for (size_t i = 0; i < 64 * count; i++)
        a->bit[i] = (unsigned char)((limbs[i / 64] >> (i % 64) & 1) ^ (uint64_t)minus);
    if (minus)
        naive_add_bit(a, 0);
    return minus;
}

/* Nearest 53-bit number, ties to even. */
static buffon_priv_wide naive_round(const naive *a, int minus, int unit)
{
    buffon_priv_wide w = {0.0, 0};
    int top = NAIVE_BITS - 1, sticky = 0, half;
    uint64_t m = 0;
    while (top >= 0 && !a->bit[top])
        top--;
    if (top < 0)
        return w;
    for (int i = top; i > top - 53; i--)
        m = m << 1 | (i >= 0 ? a->bit[i] : 0);
    half = top >= 53 ? a->bit[top - 53] : 0;
    for (int i = top - 54; i >= 0; i--)
        sticky |= a->bit[i];
    m += (uint64_t)(half && (sticky || (m & 1)));
    w.m = frexp(minus ? -(double)m : (double)m, &w.e);
    w.e += top - 52 + unit;
    return w;
}

static int wide_same(buffon_priv_wide a, buffon_priv_wide b)
{
    return tap_bits(a.m) == tap_bits(b.m) && a.e == b.e;
}

static void test_sums(void)
{
    uint64_t sum[BUFFON_STATS_SUM] = {0};
    naive expected = {{0}}, term;
    int good = 1;
    for (int k = 0; k < 6000 && good; k++) {
        double m = random_any();
        uint64_t n = random_count();
        int e = random_below(3) ? 0 : random_below(2601) - 1300, at;
        naive_product(&term, naive_split(m, &at), 1, n);
        naive_add(&expected, &term, at + e + 1152, m < 0);
        buffon_priv_sum_add(sum, m, n, e);
        good = naive_equals(&expected, sum, BUFFON_STATS_SUM);
        if (!good)
            tap_note("term %d: %a times %llu, 2^%d", k, m, (unsigned long long)n, e);
    }
    tap_ok(good, "n m 2^e enters a sum exactly: 6000 terms, edges and wraps included");
}

static void test_squares(void)
{
    uint64_t squares[BUFFON_STATS_SQUARES] = {0};
    naive expected = {{0}}, term;
    int good = 1;
    for (int k = 0; k < 5000 && good; k++) {
        double a = random_any(), b = random_below(2) ? a : random_any();
        uint64_t n = random_count();
        int e = random_below(3) ? 0 : random_below(4001) - 2000, a_at, b_at;
        uint64_t a_m = naive_split(a, &a_at), b_m = naive_split(b, &b_at);
        naive_product(&term, a_m, b_m, n);
        naive_add(&expected, &term, a_at + b_at + e + 2304, (a < 0) != (b < 0));
        buffon_priv_squares_add(squares, a, b, n, e);
        good = naive_equals(&expected, squares, BUFFON_STATS_SQUARES);
        if (!good)
            tap_note("term %d: %a %a times %llu, 2^%d", k, a, b, (unsigned long long)n, e);
    }
    tap_ok(good, "n a b 2^e enters a sum of products exactly: 5000 terms");
}

static void test_values(void)
{
    uint64_t sum[BUFFON_STATS_SUM] = {0}, sum2[BUFFON_STATS_SUM] = {0};
    uint64_t squares[BUFFON_STATS_SQUARES] = {0}, squares2[BUFFON_STATS_SQUARES] = {0};
    int good = 1;
    for (int k = 0; k < 100000; k++) {
        double y = random_any();
        buffon_priv_value_add(sum, squares, y);
        buffon_priv_sum_add(sum2, y, 1, 0);
        buffon_priv_squares_add(squares2, y, y, 1, 0);
        if (k % 100 == 0)
            good &= !memcmp(sum, sum2, sizeof sum) && !memcmp(squares, squares2, sizeof squares);
    }
    tap_ok(good, "the fast way for single numbers does the same");
}

static void test_merge(void)
{
    uint64_t parts[8][BUFFON_STATS_SUM] = {{0}}, whole[BUFFON_STATS_SUM] = {0};
    uint64_t twice[BUFFON_STATS_SUM], ones[3], one[3] = {1, 0, 0};
    for (int k = 0; k < 4000; k++) {
        double y = random_any();
        buffon_priv_sum_add(whole, y, 1, 0);
        buffon_priv_sum_add(parts[random_below(8)], y, 1, 0);
    }
    memcpy(twice, whole, sizeof twice);
    buffon_priv_sum_add(twice, 0.0, 1, 0);
    tap_ok(memcmp(twice, whole, sizeof whole) == 0, "adding 0 changes nothing");
    buffon_priv_limbs_merge(twice, twice, BUFFON_STATS_SUM);
    for (int k = 7; k > 0; k--)
        buffon_priv_limbs_merge(parts[k / 2], parts[k], BUFFON_STATS_SUM);
    tap_ok(memcmp(parts[0], whole, sizeof whole) == 0, "parts merge to the whole");
    buffon_priv_limbs_merge(parts[0], whole, BUFFON_STATS_SUM);
    tap_ok(memcmp(parts[0], twice, sizeof whole) == 0, "a sum merges into itself");
    memset(ones, 0xff, sizeof ones);
    buffon_priv_limbs_merge(ones, one, 3);
    tap_ok(ones[0] == 0 && ones[1] == 0 && ones[2] == 0, "carries run through full limbs");
}

/* w = s / n to half a unit in the last place, ties to even: |s - n w| <= n 2^(e - 54). */
static int over_rounds(const uint64_t *sum, uint64_t n, buffon_priv_wide w)
{
    uint64_t rest[BUFFON_STATS_SUM], half[BUFFON_STATS_SUM] = {0};
    memcpy(rest, sum, sizeof rest);
    buffon_priv_sum_add(rest, -w.m, n, w.e);
    if (rest[BUFFON_STATS_SUM - 1] >> 63) {
        for (int i = 0; i < BUFFON_STATS_SUM; i++)
            rest[i] = ~rest[i];
        buffon_priv_sum_add(rest, 0x1p-1000, 1, -152);
    }
    buffon_priv_sum_add(half, 1.0, n, w.e - 54);
    for (int i = BUFFON_STATS_SUM - 1; i >= 0; i--) {
        if (rest[i] != half[i])
            return rest[i] < half[i];
    }
    return ((uint64_t)ldexp(fabs(w.m), 53) & 1) == 0;
}

/* 1 + 2^-53, a tie, and a bit far below that decides it: by both ways of finishing. */
static void test_ties(void)
{
    uint64_t zero[BUFFON_STATS_SUM] = {0};
    int even = 1, above = 1;
    for (int e = -400; e < 400; e++) {
        uint64_t sum[BUFFON_STATS_SUM] = {0}, squares[BUFFON_STATS_SQUARES] = {0};
        buffon_priv_wide one = buffon_priv_wide_make(1.0, e);
        buffon_priv_wide next = buffon_priv_wide_make(1.0 + 0x1p-52, e);
        for (int part = 0; part < 2; part++) {
            buffon_priv_sum_add(sum, part ? 0x1p-53 : 1.0, 1, e);
            buffon_priv_squares_add(squares, part ? 0x1p-53 : 1.0, 1.0, 1, e);
        }
        even &= wide_same(buffon_priv_limbs_over(sum, BUFFON_STATS_SUM, 1, -1152), one);
        even &= wide_same(buffon_priv_limbs_spread(squares, zero, zero, 1), one);
        buffon_priv_sum_add(sum, 1.0, 1, e - 600);
        buffon_priv_squares_add(squares, 1.0, 1.0, 1, e - 600);
        above &= wide_same(buffon_priv_limbs_over(sum, BUFFON_STATS_SUM, 1, -1152), next);
        above &= wide_same(buffon_priv_limbs_spread(squares, zero, zero, 1), next);
    }
    tap_ok(even, "a tie goes to even");
    tap_ok(above, "unless a bit 600 places below says otherwise");
}

static void test_over(void)
{
    int good = 1, small = 1, scaled = 1;
    for (int k = 0; k < 20000 && good; k++) {
        uint64_t sum[BUFFON_STATS_SUM] = {0}, n = random_count() | 1;
        for (int i = random_below(3); i >= 0; i--)
            buffon_priv_sum_add(sum, random_double(-700, 1000), 1, 0);
        if (random_below(4) == 0) { /* an exact quotient, or a tie */
            memset(sum, 0, sizeof sum);
            buffon_priv_sum_add(sum, 0x1.8p53 + (double)random_below(8), n, 0);
            buffon_priv_sum_add(sum, 0.5, n, random_below(2));
        }
        buffon_priv_wide w = buffon_priv_limbs_over(sum, BUFFON_STATS_SUM, n, BUFFON_PRIV_SUM_UNIT);
        good = w.m == 0.0 || over_rounds(sum, n, w);
    }
    tap_ok(good, "a sum over a count is correctly rounded");
    for (int a = -300; a <= 300; a++) {
        for (int n = 1; n <= 300; n++) {
            uint64_t whole[2] = {(uint64_t)(int64_t)a, a < 0 ? UINT64_MAX : 0};
            buffon_priv_wide w = buffon_priv_limbs_over(whole, 2, (uint64_t)n, 0);
            small &= buffon_priv_wide_to_double(w) == (double)a / n;
            w = buffon_priv_limbs_over(whole, 2, (uint64_t)n, -100000);
            scaled &= w.m == 0.0 || wide_same(w, buffon_priv_wide_make((double)a / n, -100000));
        }
    }
    tap_ok(small, "small fractions are those of the doubles");
    tap_ok(scaled, "in any unit");
}

static void test_spread_naive(void)
{
    int good = 1, minus = 0;
    for (int k = 0; k < 60 && good; k++) {
        uint64_t a[BUFFON_STATS_SUM] = {0}, b[BUFFON_STATS_SUM] = {0};
        uint64_t ab[BUFFON_STATS_SQUARES] = {0}, n = random_count();
        naive na, nb, nab, nn, product, total;
        for (int i = random_below(4); i >= 0; i--) {
            buffon_priv_sum_add(a, random_any(), 1, 0);
            buffon_priv_sum_add(b, random_any(), 1, 0);
            buffon_priv_squares_add(ab, random_any(), random_any(), 1, 0);
        }
        if (k % 3 == 0) {
            memset(ab, 0, sizeof ab);
            memcpy(b, a, sizeof b);
        }
        int minus_a = naive_load(&na, a, BUFFON_STATS_SUM);
        int minus_b = naive_load(&nb, b, BUFFON_STATS_SUM);
        int minus_ab = naive_load(&nab, ab, BUFFON_STATS_SQUARES);
        naive_set(&nn, n);
        naive_multiply(&total, &nab, &nn);
        naive_multiply(&product, &na, &nb);
        if (minus_ab) {
            memset(&nab, 0, sizeof nab);
            naive_add(&nab, &total, 0, 1);
            total = nab;
        }
        naive_add(&total, &product, 0, minus_a == minus_b);
        if (total.bit[NAIVE_BITS - 1]) {
            memset(&nab, 0, sizeof nab);
            naive_add(&nab, &total, 0, 1);
            good = wide_same(buffon_priv_limbs_spread(ab, a, b, n), naive_round(&nab, 1, -2304));
            minus++;
        } else {
            good = wide_same(buffon_priv_limbs_spread(ab, a, b, n), naive_round(&total, 0, -2304));
        }
    }
    tap_ok(good && minus > 10 && minus < 50, "n S_ab - S_a S_b against the naive one");
}

static void test_spread_small(void)
{
    int good = 1;
    for (int k = 0; k < 3000; k++) {
        uint64_t a[BUFFON_STATS_SUM] = {0}, b[BUFFON_STATS_SUM] = {0};
        uint64_t ab[BUFFON_STATS_SQUARES] = {0};
        int64_t s_a = 0, s_b = 0, s_ab = 0;
        int n = 1 + random_below(20), shift = random_below(1900) - 1000;
        int range = random_below(2) ? 3 : 1000000;
        for (int i = 0; i < n; i++) {
            int x = random_below(2 * range) - range, y = k % 2 ? x : random_below(range);
            s_a += x;
            s_b += y;
            s_ab += (int64_t)x * y;
            buffon_priv_sum_add(a, ldexp(x, shift), 1, 0);
            buffon_priv_sum_add(b, ldexp(y, shift), 1, 0);
            buffon_priv_squares_add(ab, ldexp(x, shift), ldexp(y, shift), 1, 0);
        }
        buffon_priv_wide expected =
            buffon_priv_wide_make((double)(n * s_ab - s_a * s_b), 2 * shift);
        good &= wide_same(buffon_priv_limbs_spread(ab, a, b, (uint64_t)n), expected);
    }
    tap_ok(good, "n S_ab - S_a S_b of whole numbers, at any scale");
}

static void test_wide_operations(void)
{
    int same[4] = {1, 1, 1, 1}, far = 1;
    for (int k = 0; k < 100000; k++) {
        double a = random_double(-400, 400);
        double b = random_below(2) ? random_double(-400, 400) : ldexp(a, random_below(120) - 60);
        if (random_below(8) == 0)
            b = -nextafter(a, 0.0);
        buffon_priv_wide x = buffon_priv_wide_make(a, 0), y = buffon_priv_wide_make(b, 0);
        buffon_priv_wide z = buffon_priv_wide_make(fabs(a), 5000);
        same[0] &= wide_same(buffon_priv_wide_add(x, y), buffon_priv_wide_make(a + b, 0));
        same[1] &= wide_same(buffon_priv_wide_mul(x, y), buffon_priv_wide_make(a * b, 0));
        if (b != 0.0)
            same[2] &= wide_same(buffon_priv_wide_div(x, y), buffon_priv_wide_make(a / b, 0));
        same[3] &= wide_same(buffon_priv_wide_sqrt(z), buffon_priv_wide_make(sqrt(fabs(a)), 2500));
        x = buffon_priv_wide_make(a, -9000);
        y = buffon_priv_wide_make(b, -9000);
        far &= wide_same(buffon_priv_wide_add(x, y), buffon_priv_wide_make(a + b, -9000));
        far &= wide_same(buffon_priv_wide_mul(x, y), buffon_priv_wide_make(a * b, -18000));
    }
    tap_ok(same[0], "wide sums are those of the doubles");
    tap_ok(same[1], "wide products");
    tap_ok(same[2], "wide quotients");
    tap_ok(same[3], "wide square roots");
    tap_ok(far, "far outside the doubles as inside");
}

static void test_wide_edges(void)
{
    int good = 1;
    for (int k = 0; k < 100000; k++) {
        double m = random_double(0, 1);
        int e = k % 2 ? random_below(120) - 1120 : random_below(4000) - 2000;
        double expected = ldexp(m, e);
        good &= buffon_priv_wide_to_double(buffon_priv_wide_make(m, e)) == expected;
    }
    tap_ok(good, "to a double: rounded once, over- and underflow");
    good = 1;
    for (int k = 0; k < 100000; k++) {
        naive a;
        uint64_t hi = random_below(3) ? random_runs() : 0, lo = random_runs();
        int sticky = hi != 0 && random_below(2);
        naive_set(&a, lo);
        for (int i = 0; i < 64; i++)
            a.bit[64 + i] = (unsigned char)(hi >> i & 1);
        buffon_priv_wide w = buffon_priv_wide_round(hi, lo, sticky, 17);
        if (sticky) { /* one more bit below */
            memmove(a.bit + 1, a.bit, 128);
            a.bit[0] = 1;
        }
        good &= wide_same(w, naive_round(&a, 0, 17 - sticky));
    }
    tap_ok(good, "128 bits and a sticky one are rounded to the nearest, ties to even");
    tap_ok(wide_same(buffon_priv_wide_count(UINT64_MAX), buffon_priv_wide_make(0x1p64, 0)) &&
               wide_same(buffon_priv_wide_count(0), buffon_priv_wide_make(-0.0, 7)),
           "counts");
    buffon_priv_wide one = buffon_priv_wide_make(1.0, 0), none = {0.0, 0};
    buffon_priv_wide infinite = buffon_priv_wide_div(one, none);
    tap_ok(buffon_priv_wide_to_double(infinite) == INFINITY &&
               isnan(buffon_priv_wide_div(none, none).m) &&
               isnan(buffon_priv_wide_add(infinite, buffon_priv_wide_negate(infinite)).m) &&
               isnan(buffon_priv_wide_sqrt(buffon_priv_wide_negate(one)).m),
           "infinities and NaN go as in the doubles");
    tap_ok(wide_same(buffon_priv_wide_add(one, buffon_priv_wide_make(1.0, -100000)), one) &&
               wide_same(buffon_priv_wide_add(none, one), one) &&
               tap_bits(buffon_priv_wide_negate(none).m) == 0 &&
               wide_same(buffon_priv_wide_sqrt(none), none),
           "zero and the negligible");
}

int main(void)
{
    test_sums();
    test_squares();
    test_values();
    test_merge();
    test_over();
    test_ties();
    test_spread_naive();
    test_spread_small();
    test_wide_operations();
    test_wide_edges();
    return tap_done();
}
