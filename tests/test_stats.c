/* Samples: NIST's reference data, hostile data, order and grouping, the small and the empty. */
#include "samples.h"

static double other[MANY];

/* ---- NIST StRD --------------------------------------------------- */

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
    return strd_agrees(name, &all, digits) &&
           close_to(within, strd_exact(name, "ss_within"), 1e-14) &&
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

/* ---- hostile data ------------------------------------------------ */

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

/* ---- order and grouping ------------------------------------------ */

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
    tap_ok(close_to(got.ess, 1500.0 * 1500.0 / 3500.0, 1e-15) &&
               close_to(got.max_share, 0.002, 1e-15),
           "weights 0 to 3: (sum w)^2 / sum w^2, though the squares leave the doubles");
    data[7] = 1e10;
    s = add_all(data, 1000);
    got = buffon_stats_summary(&s);
    tap_ok(close_to(got.ess, 1.0, 1e-15) && close_to(got.max_share, 1.0, 1e-15),
           "one weight rules");
    for (size_t i = 0; i < 1000; i++)
        data[i] = -data[i];
    s = add_all(data, 1000);
    tap_ok(buffon_stats_summary(&s).max_share == got.max_share, "shares are positive");
    memset(s.squares, 0, sizeof s.squares);
    got = buffon_stats_summary(&s);
    tap_ok(got.variance == 0.0 && got.std_error == 0.0, "no variance is negative");
}

int main(void)
{
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
    return tap_done();
}
