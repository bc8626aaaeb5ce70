/* The blocks of the engine: their order of summing, their accuracy, products of two components. */
#include "samples.h"

static double other[MANY];

/* The definition of a block, one lane after the other: chunks of 1024, in them groups of 64 values
 * of which a lane takes four, then single ones; lanes added over the chunks and folded in halves.
 */
static void define_about(double *r, double *q, const double *y, size_t n, double m)
{
    double lane_r[16] = {0}, lane_q[16] = {0};
    for (size_t lane = 0; lane < 16; lane++) {
        for (size_t chunk = 0; chunk < n; chunk += 1024) {
            size_t end = n - chunk < 1024 ? n : chunk + 1024, i = chunk + lane;
            double chunk_r = 0.0, chunk_q = 0.0;
            for (; i - lane + 64 <= end; i += 64) {
                double d[4];
                for (size_t k = 0; k < 4; k++)
                    d[k] = y[i + 16 * k] - m;
                chunk_r += (d[0] + d[1]) + (d[2] + d[3]);
                chunk_q += (d[0] * d[0] + d[1] * d[1]) + (d[2] * d[2] + d[3] * d[3]);
            }
            for (; i < end; i += 16) {
                chunk_r += y[i] - m;
                chunk_q += (y[i] - m) * (y[i] - m);
            }
            lane_r[lane] += chunk_r;
            lane_q[lane] += chunk_q;
        }
    }
    for (size_t width = 8; width > 0; width /= 2) {
        for (size_t lane = 0; lane < width; lane++) {
            lane_r[lane] += lane_r[lane + width];
            lane_q[lane] += lane_q[lane + width];
        }
    }
    *r = lane_r[0];
    *q = lane_q[0];
}

static void test_block_definition(void)
{
    int good = 1, again = 0;
    for (size_t n = 1; n <= 5000; n += n < 200 ? 1 : 173) {
        buffon_priv_moments m;
        double r, q;
        for (size_t i = 0; i < n; i++)
            data[i] = i % 100 ? random_unit() : 1e3 * random_unit();
        define_about(&r, &q, data, n, data[0]);
        double centre = data[0], shift = r / (double)n;
        if (q / (double)n < 1.25 * (shift * shift)) {
            again++;
            centre += shift;
            define_about(&r, &q, data, n, centre);
        }
        if (n == 1)
            r = q = 0.0;
        good &= buffon_priv_moments_block(&m, data, n) == n && m.n == n && m.e == 0;
        good &= m.m == centre && m.r == r && m.q == q;
    }
    tap_ok(good && again > 0, "a block is summed in the documented order");
}

/* The block's sum and squares against the exact ones. */
static int block_accurate(const double *y, size_t n)
{
    buffon_priv_moments m;
    buffon_stats s = add_all(y, n), b = {0};
    double spread = 0.0;
    if (buffon_priv_moments_block(&m, y, n) != n)
        return 0;
    for (size_t i = 0; i < n; i++)
        spread += fabs(y[i] - m.m);
    buffon_priv_stats_add_block(&b, &m, y);
    for (size_t i = 0; i < BUFFON_STATS_SUM; i++) /* b - s - 2^-1152 */
        s.sum[i] = ~s.sum[i];
    buffon_priv_limbs_merge(b.sum, s.sum, BUFFON_STATS_SUM);
    buffon_priv_wide error =
        buffon_priv_limbs_over(b.sum, BUFFON_STATS_SUM, 1, BUFFON_PRIV_SUM_UNIT);
    double off = fabs(buffon_priv_wide_to_double(error));
    buffon_stats c = add_blocks(y, n, n), d = add_all(y, n);
    if (off > 1e-15 * spread) {
        tap_note("n %zu: the sum is off by %.2g of sum |y - m|", n, off / spread);
        return 0;
    }
    return close_to(buffon_stats_summary(&c).variance, buffon_stats_summary(&d).variance, 1e-14);
}

static void test_block_accuracy(void)
{
    static const char *const what[] = {"uniform",    "rising",      "two values",
                                       "heavy tail", "offset 1e15", "one unit in the last place"};
    for (int kind = 0; kind < 6; kind++) {
        int good = 1;
        for (size_t n = 2; n <= MANY; n = n < 64 ? n + 1 : 2 * n + (n & 1)) {
            for (size_t i = 0; i < n; i++) {
                double u = random_unit();
                data[i] = kind == 0   ? u - 0.3
                          : kind == 1 ? (double)i / (double)n
                          : kind == 2 ? (u < 0.1 ? 0.7 : 0.1)
                          : kind == 3 ? 1.0 / u
                          : kind == 4 ? 1e15 + u
                                      : 1.0;
            }
            if (kind == 5)
                data[n / 3] = 1.0 + 0x1p-52;
            good &= block_accurate(data, n);
        }
        tap_ok(good, "blocks to %d of %s: sum to 1e-15 of sum |y - m|, variance to 14 digits", MANY,
               what[kind]);
    }
}

/* Any split into these blocks, merged in any order, is one sample. */
static void test_block_order(void)
{
    int good = 1;
    for (int k = 0; k < 20; k++) {
        buffon_stats ahead = {0}, back = {0}, parts[3] = {{0}};
        buffon_priv_moments m[100];
        size_t at[100];
        fill_wild(data, 6400);
        for (size_t i = 0; i < 6400; i++)
            data[i] = isinf(data[i]) ? 1.0 : data[i];
        for (size_t i = 0; i < 100; i++) {
            good &= buffon_priv_moments_block(&m[i], data + 64 * i, 64) == 64;
            buffon_priv_stats_add_block(&ahead, &m[i], data + 64 * i);
            at[i] = i;
        }
        for (size_t i = 100; i > 0; i--) {
            size_t j = random_below(i), pick = at[j];
            at[j] = at[i - 1];
            buffon_priv_stats_add_block(&back, &m[pick], data + 64 * pick);
            buffon_priv_stats_add_block(&parts[random_below(3)], &m[pick], data + 64 * pick);
        }
        buffon_stats_merge(&parts[2], &parts[0]);
        buffon_stats_merge(&parts[1], &parts[2]);
        good &= same_stats(&ahead, &back) && same_stats(&ahead, &parts[1]);
    }
    tap_ok(good, "blocks in any order and grouping: the same bits");
}

static double cross(size_t n, size_t block, const buffon_stats *a, const buffon_stats *b)
{
    uint64_t s_ab[BUFFON_STATS_SQUARES] = {0};
    for (size_t i = 0; i < n; i += block) {
        buffon_priv_moments ma, mb;
        size_t length = n - i < block ? n - i : block;
        if (buffon_priv_moments_block(&ma, data + i, length) != length ||
            buffon_priv_moments_block(&mb, other + i, length) != length)
            return NAN;
        double q = buffon_priv_cross_block(data + i, other + i, length, &ma, &mb);
        buffon_priv_cross_add(s_ab, &ma, &mb, q);
    }
    return buffon_priv_wide_to_double(buffon_priv_cross_covariance(s_ab, a, b));
}

static void test_cross(void)
{
    for (int kind = 0; kind < 6; kind++) {
        size_t n = kind < 2 ? 1000 : 5000;
        uint64_t s_ab[BUFFON_STATS_SQUARES] = {0};
        for (size_t i = 0; i < n; i++) {
            double u = random_unit(), v = random_unit();
            data[i] = kind == 0 ? u : kind == 4 ? 0x1p700 * u : 1e9 + u;
            other[i] = kind == 0   ? u - v
                       : kind == 1 ? 0.1
                       : kind == 4 ? 0x1p-690 * (v - 2.0 * u)
                       : kind == 5 ? 1e9 + v - u
                                   : data[i];
            buffon_priv_squares_add(s_ab, data[i], other[i], 1, 0);
        }
        buffon_stats a = add_all(data, n), b = add_all(other, n);
        double exact = buffon_priv_wide_to_double(buffon_priv_cross_covariance(s_ab, &a, &b));
        int good = kind == 1 || fabs(exact) > 0.01;
        for (size_t block = 16; block < 10000; block *= 4) {
            buffon_stats ka = add_blocks(data, n, block), kb = add_blocks(other, n, block);
            good &= close_to(cross(n, block, &ka, &kb), exact, 2e-14);
        }
        if (kind == 2)
            good &= exact == buffon_stats_summary(&a).variance;
        tap_ok(good, "covariance of blocks against the exact one, kind %d", kind);
    }
    buffon_stats one = add_all(data, 1);
    tap_ok(isnan(buffon_priv_cross_covariance(one.squares, &one, &one).m),
           "one value has no covariance");
}

int main(void)
{
    test_block_definition();
    test_block_accuracy();
    test_block_order();
    test_cross();
    return tap_done();
}
