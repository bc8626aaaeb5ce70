/* The elementary functions: errors in units of the last place against long double, special values,
 * and the bits themselves. Needs a long double of 64 bits or more for the first part. */
#include <float.h>
#include <math.h>

#include "elementary.h"
#include "splitmix.h"
#include "tap.h"

#ifndef TEST_ARGUMENTS
#define TEST_ARGUMENTS 40000 /* of each kind, for each function */
#endif

#define PI_L 3.14159265358979323846264338327950288L

/* Random bits: every exponent alike. */
static double test_any(void)
{
    double x;
    do {
        x = buffon_priv_from_bits(splitmix_word());
    } while (!isfinite(x));
    return x;
}

/* A few doubles away from x. */
static double test_near(double x)
{
    const int steps = (int)(splitmix_word() % 7);
    int i;
    for (i = 0; i < steps; i++) {
        x = nextafter(x, splitmix_word() & 1 ? INFINITY : -INFINITY);
    }
    return x;
}

/* |got - want| in units of the last place of want. */
static double test_ulps(double got, long double want)
{
    int exponent;
    if (isnan(got) || isnan(want)) {
        return isnan(got) && isnan(want) ? 0 : HUGE_VAL;
    }
    if (isinf(got) || fabsl(want) > (long double)DBL_MAX) {
        return (double)want == got ? 0 : HUGE_VAL;
    }
    frexpl(want, &exponent);
    exponent = exponent < -1021 ? -1021 : exponent;
    return (double)fabsl(ldexpl((long double)got - want, 53 - exponent));
}

/* Valgrind, for one, computes long doubles in 53 bits. */
static int test_long_double(void)
{
    volatile long double one = 1, tiny = 0x1p-60L;
    return LDBL_MANT_DIG >= 64 && one + tiny > one;
}

/* ---- references --------------------------------------------------------------------------- */

/* sin(pi (x + quarter / 2)). */
static long double test_turnl(double x, int quarter)
{
    const long double r = fmodl((long double)x, 2);
    const int turns = (int)lrintl(2 * r);
    const long double angle = PI_L * (r - turns * 0.5L);
    const long double size = (turns + quarter) & 1 ? cosl(angle) : sinl(angle);
    return (turns + quarter) & 2 ? -size : size;
}

static long double test_sinpil(double x)
{
    return test_turnl(x, 0);
}
static long double test_cospil(double x)
{
    return test_turnl(x, 1);
}

/* One step of Newton's from the value in question. */
static long double test_normall(double u)
{
    const long double x = buffon_priv_normal_quantile(u), root = sqrtl(0.5L), q = u - 0.5L;
    const long double density = expl(-0.5L * x * x) / sqrtl(2 * PI_L);
    if (fabsl(q) < 0.25L) {
        return x - (0.5L * erfl(x * root) - q) / density;
    }
    return q < 0 ? x - (0.5L * erfcl(-x * root) - u) / density
                 : x + (0.5L * erfcl(x * root) - (1 - (long double)u)) / density;
}

/* The exponent is z^2/2, without the rounding of z / sqrt(2): one step from that quotient. */
static long double test_cdfl(double z)
{
    const long double x = -z * sqrtl(0.5L), square = (long double)z * z;
    const long double lost = fmal((long double)z, (long double)z, -square);
    const long double step = (fmal(-x, x, 0.5L * square) + 0.5L * lost) / (2 * x);
    if (!(fabsl(x) > 1e-9L && fabsl(x) < 30)) {
        return 0.5L * erfcl(x);
    }
    return 0.5L * (erfcl(x) - 2 / sqrtl(PI_L) * expl(-x * x) * step);
}

static long double test_cbrtl(double x)
{
    return cbrtl((long double)x);
}
static long double test_acospil(double x)
{
    return acosl((long double)x) / PI_L;
}
static long double test_erfcl(double x)
{
    return erfcl((long double)x);
}
static long double test_logl(double x)
{
    return logl((long double)x);
}
static long double test_log1pl(double x)
{
    return log1pl((long double)x);
}
static long double test_expl(double x)
{
    return expl((long double)x);
}
static long double test_expm1l(double x)
{
    return expm1l((long double)x);
}

/* ---- accuracy ----------------------------------------------------------------------------- */

typedef struct test_function {
    const char *name;
    double (*f)(double);
    long double (*reference)(double);
    double (*argument)(int kind); /* kinds 0, 1, 2 ... */
    int kinds;
    double bound; /* in ulps: what the header says */
} test_function;

static double test_turns(int kind)
{
    switch (kind) {
    case 0:
        return splitmix_uniform(0, 2);
    case 1:
        return splitmix_uniform(-0x1p20, 0x1p20);
    case 2:
        return test_near((double)(int64_t)(splitmix_word() % 41) * 0.25 - 5);
    case 3:
        return test_any();
    default:
        return (double)(int64_t)(splitmix_word() >> 9) - 0x1p54;
    }
}

static double test_positive(int kind)
{
    switch (kind) {
    case 0:
        return splitmix_uniform(0, 1);
    case 1:
        return splitmix_uniform(0.5, 2);
    case 2:
        return fabs(test_any());
    case 3:
        return test_near(1);
    default:
        return buffon_priv_from_bits(splitmix_word() >> 12);
    }
}

static double test_above_minus_one(int kind)
{
    switch (kind) {
    case 0:
        return splitmix_uniform(-1, 1);
    case 1:
        return splitmix_uniform(-0.3, 0.45);
    case 2:
        return fabs(test_any());
    case 3:
        return splitmix_uniform(-1, 1) * splitmix_uniform(0, 0x1p-20);
    default:
        return -1 + splitmix_uniform(0, 0x1p-30);
    }
}

static double test_exponent(int kind)
{
    switch (kind) {
    case 0:
        return splitmix_uniform(-1, 1);
    case 1:
        return splitmix_uniform(-745.2, 709.8);
    case 2:
        return test_any();
    case 3:
        return splitmix_uniform(-746, -707);
    default:
        return splitmix_uniform(-50, 3);
    }
}

static double test_probability(int kind)
{
    switch (kind) {
    case 0:
        return splitmix_uniform(0, 1);
    case 1:
        return test_near(splitmix_word() & 1 ? 0.075 : 0.925);
    case 2:
        return exp(splitmix_uniform(-740, -1));
    case 3:
        return 1 - exp(splitmix_uniform(-36, -1));
    default:
        return 0.5 + splitmix_uniform(-1, 1) * exp(splitmix_uniform(-36, -2));
    }
}

static double test_root(int kind)
{
    switch (kind) {
    case 0:
        return splitmix_uniform(-8, 8);
    case 1:
        return test_any();
    case 2:
        return splitmix_uniform(-1, 1) * 0x1p-1022;
    case 3:
        return test_near(ldexp(1, (int)(splitmix_word() % 2000) - 1000));
    default:
        return test_near(ldexp(sqrt(0.5), (int)(splitmix_word() % 2000) - 1000));
    }
}

static double test_cosine(int kind)
{
    switch (kind) {
    case 0:
        return splitmix_uniform(-1, 1);
    case 1:
        return test_near(splitmix_word() & 1 ? -0.5 : 0.5);
    case 2:
        return 1 - splitmix_uniform(0, 1) * splitmix_uniform(0, 0x1p-20);
    case 3:
        return -1 + splitmix_uniform(0, 1) * splitmix_uniform(0, 0x1p-20);
    default:
        return splitmix_uniform(-1, 1) * splitmix_uniform(0, 0x1p-20);
    }
}

static double test_deviate(int kind)
{
    switch (kind) {
    case 0:
        return splitmix_uniform(-7, 28);
    case 1:
        return splitmix_uniform(-1, 1);
    case 2:
        return splitmix_uniform(-1, 1) * splitmix_uniform(0, 0x1p-20);
    case 3:
        return splitmix_uniform(25.5, 27.3);
    default:
        return test_any();
    }
}

static double test_normal(int kind)
{
    const double x = kind == 3 ? splitmix_uniform(35.5, 38.6) : 1.42 * test_deviate(kind);
    return -x;
}

static const test_function test_functions[] = {
    {"sinpi", buffon_priv_sinpi, test_sinpil, test_turns, 5, 1.4},
    {"cospi", buffon_priv_cospi, test_cospil, test_turns, 5, 1.4},
    {"log", buffon_priv_log, test_logl, test_positive, 5, 0.9},
    {"log1p", buffon_priv_log1p, test_log1pl, test_above_minus_one, 5, 0.9},
    {"exp", buffon_priv_exp, test_expl, test_exponent, 5, 1.0},
    {"expm1", buffon_priv_expm1, test_expm1l, test_exponent, 5, 1.4},
    {"cbrt", buffon_priv_cbrt, test_cbrtl, test_root, 5, 0.6},
    {"acospi", buffon_priv_acospi, test_acospil, test_cosine, 5, 1.8},
    {"erfc", buffon_priv_erfc, test_erfcl, test_deviate, 5, 4},
    {"normal_cdf", buffon_priv_normal_cdf, test_cdfl, test_normal, 5, 5},
    {"normal_quantile", buffon_priv_normal_quantile, test_normall, test_probability, 5, 8},
};

/* Where a reduction, a polynomial or a special case begins. */
static const struct {
    double (*f)(double);
    long double (*reference)(double);
    double at[8], bound;
} test_seams[] = {
    {buffon_priv_sinpi, test_sinpil, {0.25, -0.75, 0x1p-1022, 0x1p20, 0x1p52, 0x1p53}, 1.4},
    {buffon_priv_cospi, test_cospil, {0.25, -0.75, 0x1p-1022, 0x1p20, 0x1p52, 0x1p53}, 1.4},
    {buffon_priv_log,
     test_logl,
     {0x1p-1022, 0x1.6a09e667f3bcdp-1, 0x1.6a09e667f3bcdp0, 0x1.6a09e667f3bcdp-1023, DBL_MAX},
     0.9},
    {buffon_priv_log1p,
     test_log1pl,
     {0x1p-54, -0x1p-54, -0x1.2bec333018866p-2, 0x1.a827999fcef34p-2, 1, -1, 0x1p53},
     0.9},
    {buffon_priv_exp,
     test_expl,
     {0x1.62e42fefa39efp-2, -0x1.62e42fefa39efp-2, 708, -708, 0x1.62e42fefa39efp9, -744.4, 0x1p-54},
     1},
    {buffon_priv_expm1,
     test_expm1l,
     {0x1p-54, -0x1p-54, 0x1.62e42fefa39efp-2, -0x1.62e42fefa39efp-2, 44, -44, 690,
      0x1.62e42fefa39efp9},
     1.4},
    {buffon_priv_cbrt, test_cbrtl, {0x1p-1022, 0x1p-1074, 0x1.6a09e667f3bcdp0, 8, DBL_MAX}, 0.6},
    {buffon_priv_acospi, test_acospil, {0.5, -0.5, 1, -1, 0x1p-54, 0x1p-1022}, 1.8},
    {buffon_priv_erfc, test_erfcl, {0x1p-54, -0x1p-54, 26, -26, 26.543, 27.2, -5.9, 1}, 4},
    {buffon_priv_normal_cdf, test_cdfl, {0x1p-54, -0x1p-54, 36, -36, -37.52, -38.4, 8.3, -1}, 5},
    {buffon_priv_normal_quantile,
     test_normall,
     {0.075, 0.925, 0x1.e8a37a45fc32ep-37 /* exp(-25) */, 0x1p-1022, 0.5, 0.25, 0.75, 0x1p-1070},
     8},
};

static void test_accuracy(const test_function *t)
{
    double worst = 0, where = 0;
    int kind, i;
    splitmix_state = 1;
    for (kind = 0; kind < t->kinds; kind++) {
        for (i = 0; i < TEST_ARGUMENTS; i++) {
            const double x = t->argument(kind);
            const double ulps = test_ulps(t->f(x), t->reference(x));
            if (!(ulps <= worst)) {
                worst = ulps;
                where = x;
            }
        }
    }
    tap_ok(worst <= t->bound, "%s: at most %.2f ulp, of %.1f allowed (at %a)", t->name, worst,
           t->bound, where);
}

static void test_accuracy_at_seams(void)
{
    const size_t n = sizeof test_seams / sizeof *test_seams;
    size_t i, j, wrong = 0;
    int k;
    splitmix_state = 6;
    for (i = 0; i < n; i++) {
        for (j = 0; j < 8; j++) {
            for (k = 0; k < 300; k++) {
                const double seam = test_seams[i].at[j], x = test_near(test_near(seam));
                const double ulps = test_ulps(test_seams[i].f(x), test_seams[i].reference(x));
                if (!(ulps <= test_seams[i].bound)) {
                    tap_note("function %zu: %.2f ulp at %a", i, ulps, x);
                    wrong++;
                }
            }
        }
    }
    tap_ok(wrong == 0, "errors in ulps beside the seams of %zu functions", n);
}

static void test_accuracy_angle(void)
{
    double worst = 0, wx = 0, wy = 0;
    int i;
    splitmix_state = 2;
    for (i = 0; i < 4 * TEST_ARGUMENTS; i++) {
        const double a = i & 1 ? splitmix_uniform(-1, 1) : test_any();
        const double other = i & 1 ? splitmix_uniform(-1, 1) : test_any();
        const double b = i % 4 < 2 ? a * splitmix_uniform(-4, 4) : other;
        const double y = i & 8 ? a : b, x = i & 8 ? b : a;
        const long double want = atan2l((long double)y, (long double)x) / PI_L;
        const double ulps = test_ulps(buffon_priv_atan2pi(y, x), want);
        if (!(ulps <= worst)) {
            worst = ulps;
            wx = x;
            wy = y;
        }
    }
    tap_ok(worst <= 1.8, "atan2pi: at most %.2f ulp, of 1.8 allowed (at %a, %a)", worst, wy, wx);
}

/* ---- exact and special values ------------------------------------------------------------- */

static void test_half_turns(void)
{
    static const double sines[4] = {0, 1, 0, -1}, cosines[4] = {1, 0, -1, 0};
    int wrong = 0;
    double s, c;
    int64_t n;
    for (n = 0; n < 100000; n++) {
        const double start = n < 50000 ? 0 : 0x1p51; /* half turns are doubles up to there */
        const double x = start + 0.5 * (double)n;
        buffon_priv_sincospi(&s, &c, x);
        wrong += tap_bits(s) != tap_bits(sines[n & 3]) || tap_bits(c) != tap_bits(cosines[n & 3]);
        buffon_priv_sincospi(&s, &c, -x);
        wrong += tap_bits(s) != tap_bits(-sines[n & 3]) || tap_bits(c) != tap_bits(cosines[n & 3]);
    }
    tap_ok(wrong == 0, "sincospi of multiples of 1/2 is exact, with the signs of zero");
    wrong = 0;
    for (n = 1; n < 100; n++) {
        buffon_priv_sincospi(&s, &c, 0x1p53 - (double)n);
        wrong += s != 0 || c != (n & 1 ? -1 : 1);
        buffon_priv_sincospi(&s, &c, -0x1p53 * (double)n);
        wrong += s != 0 || c != 1;
    }
    buffon_priv_sincospi(&s, &c, DBL_MAX);
    wrong += s != 0 || c != 1;
    tap_ok(wrong == 0, "sincospi of large numbers sees odd and even");
}

static void test_odd(void)
{
    int wrong = 0, i;
    splitmix_state = 3;
    for (i = 0; i < TEST_ARGUMENTS; i++) {
        const double x = test_turns(i % 4);
        wrong += tap_bits(buffon_priv_sinpi(-x)) != tap_bits(-buffon_priv_sinpi(x));
        wrong += tap_bits(buffon_priv_cospi(-x)) != tap_bits(buffon_priv_cospi(x));
    }
    tap_ok(wrong == 0, "sinpi is odd and cospi is even, to the bit");
    wrong = 0;
    for (i = 0; i < TEST_ARGUMENTS; i++) {
        const double u = ((double)(splitmix_word() >> 12) + 0.5) * 0x1p-52;
        wrong += buffon_priv_normal_quantile(u) != -buffon_priv_normal_quantile(1 - u);
        wrong += u > 0.5 && buffon_priv_normal_quantile(u) != buffon_priv_normal_central(u - 0.5);
    }
    tap_ok(wrong == 0, "the normal quantile of 1 - u is that of u negated, to the bit");
}

static const struct {
    const char *name;
    double (*f)(double);
    double x, want;
} test_special[] = {
    {"log", buffon_priv_log, 0.0, -INFINITY},
    {"log", buffon_priv_log, -0.0, -INFINITY},
    {"log", buffon_priv_log, 1, 0},
    {"log", buffon_priv_log, -0x1p-1074, NAN},
    {"log", buffon_priv_log, 0x1p-1074, -0x1.74385446d71c3p+9},
    {"log", buffon_priv_log, INFINITY, INFINITY},
    {"log", buffon_priv_log, -INFINITY, NAN},
    {"log", buffon_priv_log, NAN, NAN},
    {"log1p", buffon_priv_log1p, 0.0, 0.0},
    {"log1p", buffon_priv_log1p, -0.0, -0.0},
    {"log1p", buffon_priv_log1p, 0x1p-1074, 0x1p-1074},
    {"log1p", buffon_priv_log1p, -1, -INFINITY},
    {"log1p", buffon_priv_log1p, -1 - DBL_EPSILON, NAN},
    {"log1p", buffon_priv_log1p, INFINITY, INFINITY},
    {"log1p", buffon_priv_log1p, -INFINITY, NAN},
    {"log1p", buffon_priv_log1p, NAN, NAN},
    {"exp", buffon_priv_exp, -0.0, 1},
    {"exp", buffon_priv_exp, 0x1p-1074, 1},
    {"exp", buffon_priv_exp, 709.79, INFINITY},
    {"exp", buffon_priv_exp, INFINITY, INFINITY},
    {"exp", buffon_priv_exp, -745, 0x1p-1074},
    {"exp", buffon_priv_exp, -745.14, 0},
    {"exp", buffon_priv_exp, -INFINITY, 0},
    {"exp", buffon_priv_exp, NAN, NAN},
    {"expm1", buffon_priv_expm1, 0.0, 0.0},
    {"expm1", buffon_priv_expm1, -0.0, -0.0},
    {"expm1", buffon_priv_expm1, 0x1p-1074, 0x1p-1074},
    {"expm1", buffon_priv_expm1, 709.79, INFINITY},
    {"expm1", buffon_priv_expm1, INFINITY, INFINITY},
    {"expm1", buffon_priv_expm1, -1e300, -1},
    {"expm1", buffon_priv_expm1, -INFINITY, -1},
    {"expm1", buffon_priv_expm1, NAN, NAN},
    {"sinpi", buffon_priv_sinpi, -INFINITY, NAN},
    {"cospi", buffon_priv_cospi, INFINITY, NAN},
    {"sinpi", buffon_priv_sinpi, NAN, NAN},
    {"cospi", buffon_priv_cospi, NAN, NAN},
    {"cbrt", buffon_priv_cbrt, 0.0, 0.0},
    {"cbrt", buffon_priv_cbrt, -0.0, -0.0},
    {"cbrt", buffon_priv_cbrt, -27, -3},
    {"cbrt", buffon_priv_cbrt, 0x1p-1074, 0x1p-358},
    {"cbrt", buffon_priv_cbrt, DBL_MAX, 0x1.428a2f98d728bp+341},
    {"cbrt", buffon_priv_cbrt, INFINITY, INFINITY},
    {"cbrt", buffon_priv_cbrt, -INFINITY, -INFINITY},
    {"cbrt", buffon_priv_cbrt, NAN, NAN},
    {"acospi", buffon_priv_acospi, 1, 0.0},
    {"acospi", buffon_priv_acospi, -1, 1},
    {"acospi", buffon_priv_acospi, 0.0, 0.5},
    {"acospi", buffon_priv_acospi, -0.0, 0.5},
    {"acospi", buffon_priv_acospi, 0.5, 1.0 / 3},
    {"acospi", buffon_priv_acospi, 1 + DBL_EPSILON, NAN},
    {"acospi", buffon_priv_acospi, -1 - DBL_EPSILON, NAN},
    {"acospi", buffon_priv_acospi, -INFINITY, NAN},
    {"acospi", buffon_priv_acospi, NAN, NAN},
    {"erfc", buffon_priv_erfc, 0.0, 1},
    {"erfc", buffon_priv_erfc, -0.0, 1},
    {"erfc", buffon_priv_erfc, 0x1p-1074, 1},
    {"erfc", buffon_priv_erfc, 27.3, 0.0},
    {"erfc", buffon_priv_erfc, 1e300, 0.0},
    {"erfc", buffon_priv_erfc, -6, 2},
    {"erfc", buffon_priv_erfc, INFINITY, 0.0},
    {"erfc", buffon_priv_erfc, -INFINITY, 2},
    {"erfc", buffon_priv_erfc, NAN, NAN},
    {"normal_cdf", buffon_priv_normal_cdf, 0.0, 0.5},
    {"normal_cdf", buffon_priv_normal_cdf, -0.0, 0.5},
    {"normal_cdf", buffon_priv_normal_cdf, -38.6, 0.0},
    {"normal_cdf", buffon_priv_normal_cdf, 8.5, 1},
    {"normal_cdf", buffon_priv_normal_cdf, -INFINITY, 0.0},
    {"normal_cdf", buffon_priv_normal_cdf, INFINITY, 1},
    {"normal_cdf", buffon_priv_normal_cdf, NAN, NAN},
    {"normal_quantile", buffon_priv_normal_quantile, 0, -INFINITY},
    {"normal_quantile", buffon_priv_normal_quantile, 1, INFINITY},
    {"normal_quantile", buffon_priv_normal_quantile, 0.5, 0},
    {"normal_quantile", buffon_priv_normal_quantile, -0x1p-1074, NAN},
    {"normal_quantile", buffon_priv_normal_quantile, 1 + DBL_EPSILON, NAN},
    {"normal_quantile", buffon_priv_normal_quantile, NAN, NAN},
    {"normal_central", buffon_priv_normal_central, 0.5, INFINITY},
    {"normal_central", buffon_priv_normal_central, -0.5, -INFINITY},
    {"normal_central", buffon_priv_normal_central, NAN, NAN},
};

/* Equal bits, or NaN for NaN. */
static int test_same(double got, double want)
{
    return (isnan(got) && isnan(want)) || tap_bits(got) == tap_bits(want);
}

static void test_specials(void)
{
    const size_t n = sizeof test_special / sizeof *test_special;
    size_t i, wrong = 0;
    for (i = 0; i < n; i++) {
        const double got = test_special[i].f(test_special[i].x);
        if (!test_same(got, test_special[i].want)) {
            tap_note("%s(%a) is %a", test_special[i].name, test_special[i].x, got);
            wrong++;
        }
    }
    tap_ok(wrong == 0, "%zu special values", n);
}

static void test_angles(void)
{
    static const double values[] = {0.0,        -0.0,    1,        -1,       0x1p-1074,
                                    -0x1p-1074, DBL_MAX, -DBL_MAX, INFINITY, -INFINITY};
    size_t i, j;
    int wrong = 0;
    for (i = 0; i < 10; i++) {
        for (j = 0; j < 10; j++) {
            const double want = atan2(values[i], values[j]) / acos(-1);
            const double got = buffon_priv_atan2pi(values[i], values[j]);
            const int exact = fabs(values[i]) == fabs(values[j]) || fmod(want, 0.25) == 0;
            wrong += exact ? tap_bits(got) != tap_bits(want)
                           : !(fabs(got - want) <= 1e-15) || signbit(got) != signbit(want);
        }
        wrong += !isnan(buffon_priv_atan2pi(values[i], NAN));
        wrong += !isnan(buffon_priv_atan2pi(NAN, values[i]));
    }
    tap_ok(wrong == 0, "atan2pi of zeros, infinities and the largest and smallest");
}

/* ---- parts of a double -------------------------------------------------------------------- */

static void test_parts(void)
{
    static const double specials[] = {0.0, -0.0, INFINITY, -INFINITY, NAN};
    int wrong[4] = {0, 0, 0, 0}, i, k, theirs;
    splitmix_state = 4;
    for (i = 0; i < 400000; i++) {
        const double x = i < 5   ? specials[i]
                         : i & 1 ? test_any()
                                 : buffon_priv_from_bits(splitmix_word() >> 12);
        k = (int)(splitmix_word() % 4400) - 2200;
        wrong[0] += !test_same(buffon_priv_ldexp(x, k), ldexp(x, k));
        wrong[1] += !test_same(buffon_priv_frexp(&k, x), frexp(x, &theirs));
        wrong[1] += isfinite(x) ? k != theirs : k != 0;
        wrong[2] += !test_same(buffon_priv_nextup(x), nextafter(x, INFINITY));
        wrong[3] += !test_same(buffon_priv_nextdown(x), nextafter(x, -INFINITY));
    }
    wrong[0] += buffon_priv_ldexp(1, 2000000000) != INFINITY;
    wrong[0] += buffon_priv_ldexp(-DBL_MAX, -2000000000) != 0;
    wrong[0] += buffon_priv_ldexp(0x1p-1074, 2097) != 0x1p1023;
    tap_ok(wrong[0] == 0, "ldexp agrees with libm to the bit");
    tap_ok(wrong[1] == 0, "frexp agrees with libm to the bit");
    tap_ok(wrong[2] == 0 && buffon_priv_nextup(-0x1p-1074) == 0, "nextup agrees with nextafter");
    tap_ok(wrong[3] == 0, "nextdown agrees with nextafter");
    tap_ok(buffon_priv_isfinite(DBL_MAX) && !buffon_priv_isfinite(INFINITY) &&
               !buffon_priv_isfinite(NAN) && buffon_priv_copysign(2, -0.0) == -2 &&
               tap_bits(buffon_priv_abs(-0.0)) == 0,
           "isfinite, copysign and abs");
}

/* ---- frozen bits -------------------------------------------------------------------------- */

/* FNV-1a over words; every NaN counts as one. */
static uint64_t test_hash(uint64_t hash, double x)
{
    return (hash ^ (isnan(x) ? 1 : tap_bits(x))) * UINT64_C(0x100000001b3);
}

static double test_both(double x)
{
    double s, c;
    buffon_priv_sincospi(&s, &c, x);
    return s + c * 0x1p-30;
}

static void test_frozen(const char *name, double (*f)(double), double (*argument)(int),
                        uint64_t want)
{
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    int i;
    splitmix_state = 5;
    for (i = 0; i < 20000; i++) {
        hash = test_hash(hash, f(argument(i % 4)));
    }
    tap_ok(hash == want, "bits of %s: %016llx", name, (unsigned long long)hash);
}

/* Arguments made without libm, whose bits might differ. */
static double test_frozen_unit(int kind)
{
    const double u = ((double)(splitmix_word() >> 12) + 0.5) * 0x1p-52;
    return kind == 0 ? u : kind == 1 ? u * 0.1 : kind == 2 ? 1 - u * 0x1p-20 : u * 0x1p-200;
}

static double test_frozen_signed(int kind)
{
    const double u = splitmix_uniform(-1, 1);
    return kind == 0 ? u : kind == 1 ? u * 30 : kind == 2 ? u * 760 : u * 0x1p-12;
}

static double test_angle(double y)
{
    return buffon_priv_atan2pi(y, test_frozen_signed(1));
}

static void test_bits(void)
{
    test_frozen("sincospi", test_both, test_frozen_signed, UINT64_C(0x73e53b9ec78c48bd));
    test_frozen("log", buffon_priv_log, test_frozen_unit, UINT64_C(0x25f78a12fd9b7fb9));
    test_frozen("log1p", buffon_priv_log1p, test_frozen_signed, UINT64_C(0x1cd0f773f4e7a041));
    test_frozen("exp", buffon_priv_exp, test_frozen_signed, UINT64_C(0xa72a788cc39d5e46));
    test_frozen("expm1", buffon_priv_expm1, test_frozen_signed, UINT64_C(0xa438af50310d0e03));
    test_frozen("atan2pi", test_angle, test_frozen_signed, UINT64_C(0x3b10e62190d21e63));
    test_frozen("cbrt", buffon_priv_cbrt, test_frozen_signed, UINT64_C(0xdd7d5bdf8fa21889));
    test_frozen("acospi", buffon_priv_acospi, test_frozen_signed, UINT64_C(0xd9caccb3a0755428));
    test_frozen("erfc", buffon_priv_erfc, test_frozen_signed, UINT64_C(0x9e0bf41fa8e8270a));
    test_frozen("normal_cdf", buffon_priv_normal_cdf, test_frozen_signed,
                UINT64_C(0xdd8803624c0ebc72));
    test_frozen("normal_quantile", buffon_priv_normal_quantile, test_frozen_unit,
                UINT64_C(0x62cf1e753740baae));
}

/* Along u the normal quantile never falls by more than rounding. */
static void test_monotone(void)
{
    static const double seams[] = {
        0x1p-1060, 1.38879438649640206e-11 /* exp(-25) */, 0.075, 0.3, 0.925, 0.99999};
    int wrong = 0, i, j;
    for (i = 0; i < 6; i++) {
        double u = seams[i], last = -INFINITY;
        for (j = 0; j < 500; j++) {
            u = nextafter(u, 0);
        }
        for (j = 0; j < 1000; j++) {
            const double x = buffon_priv_normal_quantile(u);
            wrong += x < last - fabs(last) * 8 * DBL_EPSILON;
            last = x;
            u = nextafter(u, 1);
        }
    }
    tap_ok(wrong == 0, "the normal quantile does not fall across its seams");
}

int main(void)
{
    size_t i;
    if (test_long_double()) {
        for (i = 0; i < sizeof test_functions / sizeof *test_functions; i++) {
            test_accuracy(&test_functions[i]);
        }
        test_accuracy_at_seams();
        test_accuracy_angle();
    } else {
        tap_ok(1, "errors in ulps # SKIP long double is no wider than double");
    }
    test_half_turns();
    test_odd();
    test_specials();
    test_angles();
    test_parts();
    test_monotone();
    test_bits();
    return tap_done();
}
