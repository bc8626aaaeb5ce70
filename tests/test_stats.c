/* Samples: exact merging, NIST's reference data, hostile data, the blocks of the engine, the tail. */
#include "tap.h"

#include <math.h>
#include <stdlib.h>

#include <buffon/stats.h>

#include "exact.h"
#include "moments.h"
#include "stats_priv.h"

enum { MANY = 1 << 17 };

static double data[MANY], other[MANY];
static uint64_t random_state;

static uint64_t random_word(void)
{
    uint64_t z = random_state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
    return z ^ z >> 31;
}

static double random_unit(void)
{
    return ((double)(random_word() >> 12) + 0.5) * 0x1p-52;
}

static size_t random_below(size_t n)
{
    return (size_t)(random_word() % n);
}

static int close_to(double x, double expected, double relative)
{
    if (!(fabs(x - expected) <= relative * fabs(expected))) {
        tap_note("got %.17g, expected %.17g: %.2g", x, expected, fabs(x / expected - 1.0));
        return 0;
    }
    return 1;
}

static buffon_stats add_all(const double *y, size_t n)
{
    buffon_stats s = {0};
    buffon_stats_add(&s, y, n);
    return s;
}

/* As the engine does it. */
static buffon_stats add_blocks(const double *y, size_t n, size_t block)
{
    buffon_stats s = {0};
    for (size_t i = 0; i < n; i += block) {
        buffon_priv_moments m;
        size_t length = n - i < block ? n - i : block;
        if (buffon_priv_moments_block(&m, y + i, length) != length)
            tap_ok(0, "finite data were refused");
        buffon_priv_stats_add_block(&s, &m, y + i);
    }
    return s;
}

static int same_stats(const buffon_stats *a, const buffon_stats *b)
{
    return memcmp(a, b, sizeof *a) == 0;
}

/* ---- NIST StRD ---------------------------------------------------------------------------------- */

static size_t strd_read(const char *name)
{
    char path[100];
    size_t n = 0;
    snprintf(path, sizeof path, "tests/data/strd/%s.txt", name);
    FILE *file = fopen(path, "r");
    while (file && n < MANY && fscanf(file, "%lf", &data[n]) == 1)
        n++;
    if (file)
        fclose(file);
    return n;
}

/* The exact value for the data as the doubles hold them: the last column. */
static double strd_exact(const char *name, const char *statistic)
{
    char line[200], key[60];
    double value = NAN;
    FILE *file = fopen("tests/data/strd/strd_reference.csv", "r");
    snprintf(key, sizeof key, "%s,%s,", name, statistic);
    while (file && fgets(line, sizeof line, file)) {
        if (strncmp(line, key, strlen(key)) == 0)
            value = strtod(strrchr(line, ',') + 1, NULL);
    }
    if (file)
        fclose(file);
    return value;
}

static int strd_agrees(const char *name, const buffon_stats *s, double digits)
{
    buffon_summary got = buffon_stats_summary(s);
    return (double)got.count == strd_exact(name, "n") &&
           close_to(got.mean, strd_exact(name, "mean"), digits) &&
           close_to(got.variance, strd_exact(name, "var"), digits) &&
           close_to(got.std_error * sqrt((double)got.count), sqrt(strd_exact(name, "var")), digits);
}

static void test_strd_univariate(void)
{
    static const char *const names[] = {"Lew",     "Lottery", "Mavro",   "Michelso", "NumAcc1",
                                        "NumAcc2", "NumAcc3", "NumAcc4", "PiDigits"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        size_t n = strd_read(names[k]), blocks[] = {1, 16, 50, 64, 1024, MANY};
        buffon_stats s = add_all(data, n);
        buffon_summary got = buffon_stats_summary(&s);
        tap_ok(n > 0 && strd_agrees(names[k], &s, 4e-16) &&
                   close_to(sqrt(got.variance), strd_exact(names[k], "sd"), 4e-16) &&
                   got.min == strd_exact(names[k], "min") && got.max == strd_exact(names[k], "max"),
               "NIST %s", names[k]);
        int good = 1;
        for (size_t b = 0; b < sizeof blocks / sizeof *blocks; b++) {
            s = add_blocks(data, n, blocks[b]);
            good &= strd_agrees(names[k], &s, 1e-14);
        }
        tap_ok(good, "NIST %s in blocks of 1, 16, 50 ... to 14 digits", names[k]);
    }
}

/* Nine groups: the whole by merging them, the sums of squares within and between. */
static int strd_groups(const char *name, size_t n, size_t block, double digits)
{
    buffon_stats all = {0};
    double within = 0.0;
    size_t rows = n / 9;
    for (size_t g = 0; g < 9; g++) {
        for (size_t i = 0; i < rows; i++)
            other[i] = data[9 * i + g];
        buffon_stats s = block ? add_blocks(other, rows, block) : add_all(other, rows);
        within += buffon_stats_summary(&s).variance * (double)(rows - 1);
        buffon_stats_merge(&all, &s);
    }
    double between = buffon_stats_summary(&all).variance * (double)(n - 1) - within;
    double f = between / 8.0 / (within / (double)(n - 9));
    return strd_agrees(name, &all, digits) && close_to(within, strd_exact(name, "ss_within"), 1e-14) &&
           close_to(between, strd_exact(name, "ss_between"), 1e-14) &&
           close_to(f, strd_exact(name, "F"), 1e-14);
}

static void test_strd_anova(void)
{
    for (int k = 1; k <= 9; k++) {
        char name[10];
        snprintf(name, sizeof name, "SmLs0%d", k);
        size_t n = strd_read(name);
        tap_ok(n > 0 && strd_groups(name, n, 0, 4e-16), "NIST %s, nine groups merged", name);
        tap_ok(strd_groups(name, n, 16, 1e-14) && strd_groups(name, n, 1024, 1e-14),
               "NIST %s in blocks", name);
    }
}

/* ---- hostile data ------------------------------------------------------------------------------- */

/* The summary of data[n] by both ways, against exact values. */
static void check_data(size_t n, double mean, double variance, double std_error, const char *what)
{
    buffon_stats s = add_all(data, n);
    for (size_t block = 0; block <= 4096; block = block ? 16 * block : 16) {
        if (block)
            s = add_blocks(data, n, block);
        buffon_summary got = buffon_stats_summary(&s);
        double digits = block ? 1e-14 : 4e-16;
        int centred = block && fabs(got.mean - mean) <= 1e-15 * std_error;
        tap_ok(got.count == n && (centred || close_to(got.mean, mean, digits)) &&
                   (got.variance == variance || close_to(got.variance, variance, digits)) &&
                   close_to(got.std_error, std_error, digits),
               "%s, blocks of %zu", what, block);
    }
}

static void test_offsets(void)
{
    size_t n = 10000;
    for (size_t i = 0; i < n; i++)
        data[i] = 0x1p53 + 2.0 * (double)(i % 5);
    double v = 8.0 * (double)n / (double)(n - 1);
    check_data(n, 0x1p53 + 4.0, v, sqrt(v / (double)n), "offset 2^53");
    /* mean 1e15, variance 1/12: of what the doubles hold, by whole eighths */
    int64_t sum = 0, squares = 0, count = (int64_t)n;
    for (size_t i = 0; i < n; i++) {
        data[i] = 1e15 + (random_unit() - 0.5);
        int64_t eighths = (int64_t)((data[i] - 1e15) * 8.0);
        sum += eighths;
        squares += eighths * eighths;
    }
    v = (double)(count * squares - sum * sum) / (double)(64 * count * (count - 1));
    check_data(n, 1e15 + (double)sum / (double)(8 * count), v, sqrt(v / (double)n),
               "mean 1e15, variance 1/12");
    tap_ok(fabs(v - 1.0 / 12.0) < 0.01, "that variance is near 1/12");
}

static void test_constant(void)
{
    static const double values[] = {0.1, -1e308, 0x1p-1074, 1e15, 0.0, 1.0 / 3.0};
    for (size_t k = 0; k < sizeof values / sizeof *values; k++) {
        double c = values[k];
        for (size_t i = 0; i < 100000; i++)
            data[i] = c;
        buffon_stats a = {0}, b = {0};
        for (int i = 0; i < 10; i++) {
            buffon_stats block = add_blocks(data, 100000, (size_t)17 << i);
            buffon_stats_add(&a, data, 100000);
            buffon_stats_merge(&b, &block);
        }
        buffon_summary got = buffon_stats_summary(&b);
        tap_ok(same_stats(&a, &b) && got.count == 1000000 && tap_bits(got.mean) == tap_bits(c) &&
                   got.variance == 0.0 && got.std_error == 0.0 && got.min == c && got.max == c,
               "a million times %g: mean that, variance exactly 0, by both ways", c);
    }
}

static void test_extremes(void)
{
    const double huge = 0x1.fffffffffffffp1023;
    data[0] = huge;
    data[1] = -huge;
    check_data(2, 0.0, INFINITY, huge, "the largest double and its opposite");
    for (size_t i = 0; i < 1000; i++)
        data[i] = i % 2 ? huge : -huge;
    double se = huge / 31.606961258558218; /* sqrt(999) */
    check_data(1000, 0.0, INFINITY, se, "500 times each");
    for (size_t i = 0; i < 999; i++)
        data[i] = (double)(1 + i % 3) * 0x1p-1074;
    buffon_stats s = add_all(data, 999), b = add_blocks(data, 999, 64);
    buffon_summary got = buffon_stats_summary(&s), blocks = buffon_stats_summary(&b);
    tap_ok(got.mean == 0x2p-1074 && got.variance == 0.0 && blocks.mean == got.mean,
           "the smallest subnormals: the mean");
    tap_ok(buffon_priv_stats_variance(&s).e == -2148 && buffon_priv_stats_variance(&b).e == -2148 &&
               close_to(buffon_priv_stats_variance(&s).m, 999.0 * 2.0 / 3.0 / 998.0, 4e-16) &&
               close_to(buffon_priv_stats_variance(&b).m, 999.0 * 2.0 / 3.0 / 998.0, 1e-14),
           "and their variance, which is no double");
}

/* y -> 2^k y must scale every result exactly, whether or not the squares leave the doubles. */
static void test_scales(void)
{
    static const int shifts[] = {1020, 1000, 500, 499, 450, 2, -3, -398, -402, -500, -900, -1000};
    size_t n = 5000;
    for (size_t i = 0; i < n; i++)
        other[i] = 1.0 + floor(random_unit() * 0x1p20) * 0x1p-20;
    for (size_t k = 0; k < sizeof shifts / sizeof *shifts; k++) {
        int e = shifts[k], good = 1;
        for (size_t i = 0; i < n; i++)
            data[i] = ldexp(other[i], e);
        for (size_t block = 1024; block <= 1025; block++) {
            buffon_stats s = block % 2 ? add_all(data, n) : add_blocks(data, n, block);
            buffon_stats t = block % 2 ? add_all(other, n) : add_blocks(other, n, block);
            buffon_summary a = buffon_stats_summary(&s), b = buffon_stats_summary(&t);
            good &= a.mean == ldexp(b.mean, e) && a.std_error == ldexp(b.std_error, e) &&
                    a.ess == b.ess && a.max_share == b.max_share &&
                    tap_bits(a.tail_index) == tap_bits(b.tail_index) &&
                    a.variance == ldexp(b.variance, 2 * e);
        }
        tap_ok(good, "scaled by 2^%d: everything scales exactly", e);
    }
}

static void test_outliers(void)
{
    size_t n = 3000;
    for (int k = 0; k < 6; k++) {
        double outlier = k % 2 ? 1e10 : 1e100;
        for (size_t i = 0; i < n; i++)
            data[i] = random_unit();
        data[k < 2 ? 0 : k < 4 ? n - 1 : n / 2] = outlier;
        buffon_stats s = add_all(data, n), b;
        buffon_summary exact = buffon_stats_summary(&s);
        int good = close_to(exact.std_error, outlier / (double)n, 1e-6);
        for (size_t block = 16; block < 10000; block *= 2) {
            b = add_blocks(data, n, block);
            buffon_summary got = buffon_stats_summary(&b);
            good &= close_to(got.mean, exact.mean, 1e-15) &&
                    close_to(got.variance, exact.variance, 2e-15) &&
                    close_to(got.std_error, exact.std_error, 1e-15);
        }
        tap_ok(good, "an outlier of %g in place %d", outlier, k / 2);
    }
    data[0] = 1e100;
    data[1] = 1.0;
    data[2] = -1e100;
    buffon_stats s = add_all(data, 3);
    tap_ok(buffon_stats_summary(&s).mean == 1.0 / 3.0, "1e100 + 1 - 1e100 is 1");
}

static void test_nonfinite(void)
{
    double y[] = {1.0, NAN, 2.0, INFINITY, -INFINITY, 6.0};
    buffon_stats s = add_all(y, 6), t = add_all(y + 1, 1);
    buffon_summary got = buffon_stats_summary(&s), none = buffon_stats_summary(&t);
    tap_ok(got.count == 3 && got.nonfinite == 3 && got.mean == 3.0 && got.variance == 7.0 &&
               got.min == 1.0 && got.max == 6.0,
           "values that are not finite are counted apart");
    tap_ok(none.count == 0 && none.nonfinite == 1 && isnan(none.mean) && isnan(none.min),
           "and a sample of nothing else is empty");
    buffon_stats_merge(&t, &s);
    tap_ok(t.count == 3 && t.nonfinite == 4 && t.min == 1.0, "and merge");
    int good = 1;
    for (size_t n = 1; n < 3000; n = 3 * n / 2 + 1) {
        for (size_t at = 0; at < n; at += 1 + n / 50) {
            buffon_priv_moments m;
            for (size_t i = 0; i < n; i++)
                data[i] = i % 3 ? 0x1.fffffffffffffp1023 : (double)i;
            good &= buffon_priv_moments_block(&m, data, n) == n;
            data[at] = at % 3 == 0 ? NAN : at % 3 == 1 ? INFINITY : -INFINITY;
            data[n - 1] = at == n - 1 ? data[at] : NAN;
            good &= buffon_priv_moments_block(&m, data, n) == at;
        }
    }
    tap_ok(good, "a block names its first value that is not finite, huge ones are none");
}

/* ---- order and grouping ------------------------------------------------------------------------- */

static void fill_wild(double *y, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        y[i] = ldexp(random_unit() - 0.5, (int)random_below(2000) - 1000);
        if (random_below(10) == 0)
            y[i] = i % 2 ? INFINITY : -0.0;
    }
}

static void shuffle(double *y, size_t n)
{
    for (size_t i = n; i > 1; i--) {
        size_t j = random_below(i);
        double swap = y[i - 1];
        y[i - 1] = y[j];
        y[j] = swap;
    }
}

/* The sample of y[n] by a random tree of merges, each leaf filled by random cuts. */
static buffon_stats random_tree(const double *y, size_t n)
{
    buffon_stats s = {0};
    if (n > 20 && random_below(10) > 0) {
        size_t cut = random_below(n + 1);
        buffon_stats a = random_tree(y, cut), b = random_tree(y + cut, n - cut);
        buffon_stats_merge(&a, &b);
        return a;
    }
    for (size_t i = 0; i < n;) {
        size_t length = random_below(n - i + 1);
        buffon_stats_add(&s, y + i, length);
        i += length;
    }
    return s;
}

static void test_order(void)
{
    int good = 1;
    for (int k = 0; k < 300; k++) {
        size_t n = 1 + random_below(500);
        fill_wild(data, n);
        buffon_stats s = add_all(data, n);
        shuffle(data, n);
        buffon_stats t = random_tree(data, n);
        good &= same_stats(&s, &t);
    }
    tap_ok(good, "any order, cuts and tree of merges: the same bits");
}

static void test_merge(void)
{
    int commutes = 1, associates = 1, twice = 1, neutral = 1;
    for (int k = 0; k < 200; k++) {
        buffon_stats part[3], ab, ba, left, right, bc, none = {0};
        for (int p = 0; p < 3; p++) { /* samples of numbers, and of blocks */
            size_t n = random_below(200);
            for (size_t i = 0; i < n; i++)
                data[i] = ldexp(random_unit() - 0.3, (int)random_below(40));
            part[p] = random_below(2) ? add_all(data, n) : add_blocks(data, n, 64);
        }
        ab = part[0];
        buffon_stats_merge(&ab, &part[1]);
        ba = part[1];
        buffon_stats_merge(&ba, &part[0]);
        commutes &= same_stats(&ab, &ba);
        left = ab;
        buffon_stats_merge(&left, &part[2]);
        bc = part[1];
        buffon_stats_merge(&bc, &part[2]);
        right = part[0];
        buffon_stats_merge(&right, &bc);
        associates &= same_stats(&left, &right);
        bc = left;
        buffon_stats_merge(&bc, &left);
        buffon_stats_merge(&left, &left);
        twice &= same_stats(&bc, &left);
        buffon_stats_merge(&right, &none);
        buffon_stats_merge(&none, &right);
        neutral &= same_stats(&none, &right);
    }
    tap_ok(commutes, "merging commutes");
    tap_ok(associates, "and associates");
    tap_ok(twice, "a sample merges into itself");
    tap_ok(neutral, "an empty sample changes nothing");
}

static int falling(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x < y) - (x > y);
}

static void test_top(void)
{
    int good = 1;
    for (int k = 0; k < 100; k++) {
        size_t n = random_below(300);
        for (size_t i = 0; i < n; i++)
            data[i] = floor(100.0 * random_unit()) - 60.0;
        buffon_stats s = add_all(data, n), b = add_blocks(data, n, 16);
        for (size_t i = 0; i < n; i++)
            data[i] = fabs(data[i]);
        qsort(data, n, sizeof *data, falling);
        for (size_t i = 0; i < BUFFON_STATS_TOP; i++)
            good &= s.top[i] == (i < n ? data[i] : 0.0) && s.top[i] == b.top[i];
        good &= n == 0 || (s.min == b.min && s.max == b.max);
    }
    tap_ok(good, "the 64 largest magnitudes, ties kept, 0 where there are fewer");
}

static void test_small(void)
{
    buffon_stats s = {0};
    buffon_stats_add(&s, NULL, 0);
    buffon_summary got = buffon_stats_summary(&s);
    tap_ok(got.count == 0 && got.nonfinite == 0 && isnan(got.mean) && isnan(got.variance) &&
               isnan(got.std_error) && isnan(got.min) && isnan(got.max) && isnan(got.ess) &&
               isnan(got.max_share) && isnan(got.tail_index),
           "an empty sample says nothing");
    double zeros[] = {-0.0, 0.0};
    buffon_stats_add(&s, zeros, 1);
    got = buffon_stats_summary(&s);
    tap_ok(got.count == 1 && tap_bits(got.mean) == 0 && tap_bits(got.min) == 0 &&
               tap_bits(got.max) == 0 && isnan(got.variance) && isnan(got.std_error),
           "one value has no variance; -0 is 0");
    buffon_stats t = add_all(zeros + 1, 1), b = add_blocks(zeros, 1, 16);
    tap_ok(same_stats(&s, &t) && same_stats(&s, &b), "-0 and 0 leave the same bits");
}

static void test_weights(void)
{
    for (size_t i = 0; i < 1000; i++)
        data[i] = 1e300;
    buffon_stats s = add_all(data, 1000);
    buffon_summary got = buffon_stats_summary(&s);
    tap_ok(close_to(got.ess, 1000.0, 4e-16) && close_to(got.max_share, 0.001, 4e-16),
           "equal weights: all effective");
    for (size_t i = 0; i < 1000; i++)
        data[i] = 1e-170 * (double)(i % 4);
    s = add_all(data, 1000);
    got = buffon_stats_summary(&s);
    tap_ok(close_to(got.ess, 1500.0 * 1500.0 / 3500.0, 1e-15) && close_to(got.max_share, 0.002, 1e-15),
           "weights 0 to 3: (sum w)^2 / sum w^2, though the squares leave the doubles");
    data[7] = 1e10;
    s = add_all(data, 1000);
    got = buffon_stats_summary(&s);
    tap_ok(close_to(got.ess, 1.0, 1e-15) && close_to(got.max_share, 1.0, 1e-15), "one weight rules");
}

/* ---- blocks ------------------------------------------------------------------------------------- */

/* The definition of a block, one lane after the other: chunks of 1024, in them groups of 64 values of
 * which a lane takes four, then single values; lanes added over the chunks and folded in halves. */
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
    static const char *const what[] = {"uniform", "rising", "two values", "heavy tail",
                                       "offset 1e15", "one unit in the last place"};
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

/* ---- two components ----------------------------------------------------------------------------- */

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

/* ---- the tail ----------------------------------------------------------------------------------- */

/* Zhang and Stephens' estimate with the prior of Vehtari et al., computed apart from these sources
 * from the formulas of the papers. */
static void test_tail_values(void)
{
    double top[5][BUFFON_STATS_TOP];
    static const double expected[] = {-0.7466923996334539, 0.8228092140114632, 11.42564289291079,
                                      1.608165840475453, -0.6361999899446521};
    for (int i = 0; i < BUFFON_STATS_TOP; i++) {
        top[0][i] = 64.0 - i;
        top[1][i] = 64.0 / (i + 1);
        top[2][i] = ldexp(1.0, -i);
        top[3][i] = top[1][i] * top[1][i];
        top[4][i] = i < 40 ? 40.0 - i : 0.0;
    }
    for (int k = 0; k < 5; k++) {
        double got = buffon_priv_tail_index(top[k], 1000);
        tap_ok(close_to(got, expected[k], 1e-12), "k-hat of tail %d", k);
        for (int i = 0; i < BUFFON_STATS_TOP; i++)
            top[k][i] = ldexp(top[k][i], 950);
        tap_ok(buffon_priv_tail_index(top[k], 320) == got, "and of 2^950 times it");
    }
    tap_ok(isnan(buffon_priv_tail_index(top[0], 319)), "NaN below 320 values");
    for (int i = 0; i < BUFFON_STATS_TOP; i++)
        top[0][i] = i < 32 ? 3.0 + i % 2 : 1.0;
    qsort(top[0], BUFFON_STATS_TOP, sizeof(double), falling);
    tap_ok(isfinite(buffon_priv_tail_index(top[0], 320)), "32 values above the rest are enough");
    top[0][31] = 1.0;
    tap_ok(isnan(buffon_priv_tail_index(top[0], 320)), "31 are not");
    for (int i = 0; i < BUFFON_STATS_TOP; i++)
        top[0][i] = 1.0;
    tap_ok(isnan(buffon_priv_tail_index(top[0], 1000)), "NaN for a tail without spread");
    for (int i = 0; i < BUFFON_STATS_TOP; i++)
        top[0][i] = ldexp(1.0, 1000 - 32 * i);
    tap_ok(buffon_priv_tail_index(top[0], 1000) > 50.0, "a tail over 2000 powers of two is heavy");
}

/* Generalised Pareto samples of index k: so are their tails. The mean of k-hat over replicates is
 * (63 k + 5) / 73 but for a small bias. The likelihood gives its standard deviation as 63 / 73 of
 * (1 + k) / sqrt(63) for k > -1/2; at -1/2 it is larger. */
static void test_tail_samples(void)
{
    static const double shapes[] = {-0.5, 0.0, 0.5, 1.0, 2.0};
    enum { REPLICATES = 400, SIZE = 3000 };
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++) {
        double k = shapes[s], sum = 0.0, squares = 0.0;
        for (int r = 0; r < REPLICATES; r++) {
            for (size_t i = 0; i < SIZE; i++) {
                double u = random_unit(), x = k == 0.0 ? -log(u) : (pow(u, -k) - 1.0) / k;
                data[i] = i % 2 ? x : -x;
            }
            buffon_stats sample = add_all(data, SIZE);
            double got = buffon_stats_summary(&sample).tail_index;
            sum += got;
            squares += got * got;
        }
        double mean = sum / REPLICATES, sd = sqrt(squares / REPLICATES - mean * mean);
        double expected = (63.0 * k + 5.0) / 73.0;
        double scatter = (1.0 + k) / sqrt(63.0) * 63.0 / 73.0 * (k == -0.5 ? 2.0 : 1.0);
        tap_note("k = %g: mean %.4f, expected %.4f; sd %.4f, asymptotically %.4f", k, mean, expected,
                 sd, scatter);
        tap_ok(fabs(mean - expected) < 6.0 * scatter / sqrt(REPLICATES) + 0.02 &&
                   sd < 1.25 * scatter && sd > 0.75 * scatter,
               "k-hat of 400 samples with k = %g", k);
    }
}

int main(void)
{
    random_state = 1;
    test_strd_univariate();
    test_strd_anova();
    test_offsets();
    test_constant();
    test_extremes();
    test_scales();
    test_outliers();
    test_nonfinite();
    test_order();
    test_merge();
    test_top();
    test_small();
    test_weights();
    test_block_definition();
    test_block_accuracy();
    test_block_order();
    test_cross();
    test_tail_values();
    test_tail_samples();
    return tap_done();
}
