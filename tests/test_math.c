/* Batches of elementary functions: on every level of this machine the bits of the scalar functions,
 * for any length, alignment and place in the array. The scalars are tests/test_elementary.c's. */
#include <buffon/cpu.h>
#include <buffon/interval.h>
#include <buffon/math.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "elementary.h"
#include "splitmix.h"
#include "tap.h"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#define TEST_SHORT 40  /* lengths up to there, all of them */
#define TEST_LONG 5000 /* several tiles, and a remainder for every width */
#define TEST_GUARD 0x1.badbadp-3

/* ---- the functions ------------------------------------------------------------------------ */

/* Functions of two arguments or results in the form of the others: the second argument depends on
 * the first, and results come one by one. */
static double test_abscissa(double y)
{
    static const double factors[] = {1, -1, 0.375, -3, 0, INFINITY, 0x1p-600, -0x1p600};
    return y * factors[buffon_priv_bits(y) >> 3 & 7];
}

static double test_angle(double y)
{
    return buffon_priv_atan2pi(y, test_abscissa(y));
}

static void test_angles(double *t, const double *y, size_t n)
{
    double *x = malloc((n + 1) * sizeof *x);
    size_t i;
    for (i = 0; i < n; i++) {
        x[i] = test_abscissa(y[i]);
    }
    buffon_math_atan2pi(t, y, x, n);
    free(x);
}

/* The result may be the other argument too. */
static void test_angles_over_x(double *t, const double *y, size_t n)
{
    double *own = malloc((n + 1) * sizeof *own);
    size_t i;
    memcpy(own, y, n * sizeof *own);
    for (i = 0; i < n; i++) {
        t[i] = test_abscissa(own[i]);
    }
    buffon_math_atan2pi(t, own, t, n);
    free(own);
}

static void test_sines(double *s, const double *x, size_t n)
{
    double *c = malloc((n + 1) * sizeof *c);
    buffon_math_sincospi(s, c, x, n);
    free(c);
}

static void test_cosines(double *c, const double *x, size_t n)
{
    double *s = malloc((n + 1) * sizeof *s);
    buffon_math_sincospi(s, c, x, n);
    free(s);
}

static const struct {
    const char *name;
    void (*batch)(double *, const double *, size_t);
    double (*scalar)(double);
    double lo, hi; /* where ordinary arguments are */
} test_functions[] = {
    {"sinpi", buffon_math_sinpi, buffon_priv_sinpi, -4, 4},
    {"cospi", buffon_math_cospi, buffon_priv_cospi, -4, 4},
    {"sincospi, s", test_sines, buffon_priv_sinpi, -0x1p21, 0x1p21},
    {"sincospi, c", test_cosines, buffon_priv_cospi, -0x1p21, 0x1p21},
    {"atan2pi", test_angles, test_angle, -2, 2},
    {"atan2pi over x", test_angles_over_x, test_angle, -2, 2},
    {"acospi", buffon_math_acospi, buffon_priv_acospi, -1, 1},
    {"log", buffon_math_log, buffon_priv_log, 0, 1},
    {"log1p", buffon_math_log1p, buffon_priv_log1p, -1, 3},
    {"exp", buffon_math_exp, buffon_priv_exp, -20, 20},
    {"expm1", buffon_math_expm1, buffon_priv_expm1, -30, 30},
    {"cbrt", buffon_math_cbrt, buffon_priv_cbrt, -8, 8},
    {"erfc", buffon_math_erfc, buffon_priv_erfc, -6, 27},
    {"normal_cdf", buffon_math_normal_cdf, buffon_priv_normal_cdf, -38, 9},
    {"normal_quantile", buffon_math_normal_quantile, buffon_priv_normal_quantile, 0, 1},
};

#define TEST_FUNCTIONS (sizeof test_functions / sizeof *test_functions)

/* Ends of what a vector computes as a whole, and what no formula holds for. */
static const double test_special[] = {
    0.0,
    -0.0,
    1,
    -1,
    INFINITY,
    -INFINITY,
    NAN,
    -NAN,
    DBL_MAX,
    -DBL_MAX,
    DBL_MIN,
    -DBL_MIN,
    0x1p-1074,
    -0x1p-1074,
    0x1.8p-1030,
    0x1p-54,
    -0x1p-54,
    0x1p-60,
    0.5,
    -0.5,
    0.25,
    0.075,
    0.925,
    0x1p20,
    0x1.00001p20,
    0x1p53,
    0x1p60,
    0x1p1000,
    1 - DBL_EPSILON / 2,
    1 + DBL_EPSILON,
    -1 - DBL_EPSILON,
    26,
    27,
    28,
    -26,
    36,
    -36,
    -37.6,
    -39,
    44,
    -44,
    690,
    708,
    709.5,
    711,
    -708,
    -744,
    -746,
    1e-11,
    1e-300,
};

#define TEST_SPECIALS (sizeof test_special / sizeof *test_special)

/* Equal bits, or NaN for NaN. */
static int test_same(double got, double want)
{
    return (isnan(got) && isnan(want)) || tap_bits(got) == tap_bits(want);
}

/* How many of y[n] are not the scalar results; the first one is noted. */
static size_t test_wrong(size_t f, const double *y, const double *x, size_t n)
{
    size_t i, wrong = 0;
    for (i = 0; i < n; i++) {
        const double want = test_functions[f].scalar(x[i]);
        if (!test_same(y[i], want) && wrong++ == 0) {
            tap_note("%s of %zu, at %zu: %a gives %a, not %a", test_functions[f].name, n, i, x[i],
                     y[i], want);
        }
    }
    return wrong;
}

/* ---- on one level ------------------------------------------------------------------------- */

/* Into another array and in place, from every offset; what lies behind is not touched. The arrays
 * are as long as they must be, so that a sanitizer sees what goes beyond. */
static size_t test_length(size_t f, size_t n, size_t offset)
{
    double *x = malloc((offset + n + 1) * sizeof *x), *y = malloc((offset + n + 1) * sizeof *y);
    double *tight = malloc(n * sizeof *tight + (n == 0));
    size_t i, wrong = 0;
    for (i = 0; i < n; i++) {
        tight[i] = x[offset + i] = splitmix_uniform(test_functions[f].lo, test_functions[f].hi);
    }
    y[offset + n] = TEST_GUARD;
    test_functions[f].batch(y + offset, x + offset, n);
    wrong += test_wrong(f, y + offset, x + offset, n) + (y[offset + n] != TEST_GUARD);
    test_functions[f].batch(tight, tight, n);
    wrong += test_wrong(f, tight, x + offset, n);
    free(tight);
    free(y);
    free(x);
    return wrong;
}

static void test_lengths(const char *level)
{
    size_t f, n, wrong = 0;
    splitmix_state = 1;
    for (f = 0; f < TEST_FUNCTIONS; f++) {
        for (n = 0; n <= TEST_SHORT; n++) {
            wrong += test_length(f, n, n % 9);
        }
        for (n = 250; n <= 264; n++) {
            wrong += test_length(f, n, n % 9);
        }
    }
    tap_ok(wrong == 0, "%s: lengths to %d and about a tile, offsets, in place", level, TEST_SHORT);
    buffon_math_log(NULL, NULL, 0);
    buffon_math_sincospi(NULL, NULL, NULL, 0);
    buffon_math_atan2pi(NULL, NULL, NULL, 0);
    buffon_math_normal_quantile(NULL, NULL, 0);
}

/* Ordinary arguments, then the same with any bits among them. */
static void test_long(const char *level)
{
    static double x[TEST_LONG], y[TEST_LONG];
    size_t f, i, wrong = 0;
    splitmix_state = 2;
    for (f = 0; f < TEST_FUNCTIONS; f++) {
        for (i = 0; i < TEST_LONG; i++) {
            x[i] = splitmix_uniform(test_functions[f].lo, test_functions[f].hi);
        }
        test_functions[f].batch(y, x, TEST_LONG);
        wrong += test_wrong(f, y, x, TEST_LONG);
        for (i = 0; i < TEST_LONG; i += 1 + splitmix_word() % 20) {
            x[i] = buffon_priv_from_bits(splitmix_word());
        }
        test_functions[f].batch(y, x, TEST_LONG);
        wrong += test_wrong(f, y, x, TEST_LONG);
    }
    tap_ok(wrong == 0, "%s: %d arguments, ordinary and any bits", level, TEST_LONG);
}

/* One among ordinary ones, in every lane; and with its neighbours. */
static void test_special_lanes(const char *level)
{
    double x[16], y[16];
    size_t f, i, k, lane, wrong = 0;
    splitmix_state = 3;
    for (f = 0; f < TEST_FUNCTIONS; f++) {
        for (k = 0; k < TEST_SPECIALS; k++) {
            for (lane = 0; lane < 16; lane++) {
                for (i = 0; i < 16; i++) {
                    x[i] = splitmix_uniform(test_functions[f].lo, test_functions[f].hi);
                }
                x[lane] = test_special[k];
                x[lane ^ 1] = nextafter(test_special[k], lane & 2 ? 2000 : -2000);
                test_functions[f].batch(y, x, 16);
                wrong += test_wrong(f, y, x, 16);
            }
        }
    }
    tap_ok(wrong == 0, "%s: %zu special values in every lane", level, TEST_SPECIALS);
}

static void test_two_results(const char *level)
{
    double x[37], s[37], c[37], both[37];
    size_t i, wrong = 0;
    splitmix_state = 4;
    for (i = 0; i < 37; i++) {
        both[i] = x[i] = splitmix_uniform(-9, 9);
    }
    buffon_math_sincospi(s, both, both, 37);
    wrong += test_wrong(0, s, x, 37) + test_wrong(1, both, x, 37);
    memcpy(both, x, sizeof both);
    buffon_math_sincospi(both, c, both, 37);
    wrong += test_wrong(0, both, x, 37) + test_wrong(1, c, x, 37);
    tap_ok(wrong == 0, "%s: sine and cosine, either over the argument", level);
}

/* ---- where subnormal numbers count as zero ------------------------------------------------ */

#if defined(__SSE2__)

#define TEST_FLUSH 0x8040 /* FTZ and DAZ of MXCSR */

static int test_is_normal(double x)
{
    return x == 0 || fabs(x) > 1e-290; /* infinities and NaN too */
}

static void test_flushed(const char *level)
{
    static double x[TEST_LONG], y[TEST_LONG], want[TEST_LONG];
    const unsigned control = _mm_getcsr();
    size_t f, i, wrong = 0, seen = 0;
    splitmix_state = 5;
    for (f = 0; f < TEST_FUNCTIONS; f++) {
        for (i = 0; i < TEST_LONG; i++) {
            x[i] = i & 1 ? splitmix_uniform(test_functions[f].lo, test_functions[f].hi)
                         : buffon_priv_from_bits(splitmix_word());
            x[i] = test_is_normal(x[i]) ? x[i] : 0.75;
            want[i] = test_functions[f].scalar(x[i]);
        }
        _mm_setcsr(control | TEST_FLUSH);
        test_functions[f].batch(y, x, TEST_LONG);
        _mm_setcsr(control);
        for (i = 0; i < TEST_LONG; i++) {
            seen += test_is_normal(want[i]) ? 1 : 0;
            if (test_is_normal(want[i]) && !test_same(y[i], want[i]) && wrong++ == 0) {
                tap_note("%s: %a gives %a, not %a", test_functions[f].name, x[i], y[i], want[i]);
            }
        }
    }
    tap_ok(wrong == 0, "%s: the same bits under FTZ and DAZ where all is normal", level);
    tap_ok(seen > TEST_FUNCTIONS * TEST_LONG / 2, "which it is for %zu results", seen);
}

#else

static void test_flushed(const char *level)
{
    tap_ok(1, "%s: FTZ and DAZ # SKIP they are of x86", level);
}

#endif

int main(void)
{
    const buffon_level best = buffon_cpu_level();
    size_t i, wrong = 0;
    int level;
    for (level = BUFFON_LEVEL_SCALAR; level <= BUFFON_LEVEL_AVX512; level++) {
        const char *name = buffon_level_string((buffon_level)level);
        if (buffon_cpu_limit((buffon_level)level) != (buffon_level)level) {
            tap_ok(1, "%s # SKIP this machine has none", name);
            continue;
        }
        test_lengths(name);
        test_long(name);
        test_special_lanes(name);
        test_two_results(name);
        test_flushed(name);
    }
    buffon_cpu_limit(best);
    for (i = 0; i < 1000; i++) {
        const double u = (double)i / 1000;
        double z;
        buffon_math_normal_quantile(&z, &u, 1);
        wrong += !test_same(z, buffon_normal_quantile(u));
    }
    tap_ok(wrong == 0, "normal quantiles are those of interval.h");
    return tap_done();
}
