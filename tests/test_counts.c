/* Discrete laws: probabilities in extended precision and by exact sums, points on the right side of
 * every boundary that can be told, order, ends and refusals. */
#include <buffon/buffon.h>
#include <float.h>
#include <math.h>

#include "grid.h"
#include "refused.h"
#include "tap.h"
#include "wide_gamma.h"

static double one_x(const buffon_density *g, double u)
{
    double x;
    return buffon_density_sample(&x, NULL, &u, 1, g) == BUFFON_OK ? x : NAN;
}

static double one_pdf(const buffon_density *g, double x)
{
    double pdf;
    return buffon_density_pdf(&pdf, &x, 1, g) == BUFFON_OK ? pdf : NAN;
}

static double one_log_pdf(const buffon_density *g, double x)
{
    double log_pdf;
    return buffon_density_log_pdf(&log_pdf, &x, 1, g) == BUFFON_OK ? log_pdf : NAN;
}

/* ---- Bernoulli and geometric ---- */

static void test_bernoulli(void)
{
    int good = 1;
    for (int k = 1; k < 64; k++) {
        const double p = k / 64.0, at = 1 - p;
        const buffon_density g = buffon_bernoulli(p);
        good &= one_x(&g, at) == 0 && one_x(&g, nextafter(at, 1)) == 1;
        good &= one_pdf(&g, 0) == 1 - p && one_pdf(&g, 1) == p && one_pdf(&g, 0.5) == 0;
        good &= one_log_pdf(&g, 2) == -INFINITY && one_log_pdf(&g, NAN) == -INFINITY;
    }
    tap_ok(good, "Bernoulli: one where u is above 1 - p");
    const buffon_density never = buffon_bernoulli(0), always = buffon_bernoulli(1);
    const buffon_density rare = buffon_bernoulli(0x1p-60), often = buffon_bernoulli(0x1p-52);
    tap_ok(one_x(&never, 1 - 0x1p-53) == 0 && one_x(&always, 0x1p-53) == 1 &&
               one_x(&rare, 1 - 0x1p-53) == 0 && one_x(&often, 1 - 0x1p-53) == 1 &&
               one_pdf(&rare, 1) == 0x1p-60,
           "Bernoulli: never, always, and rarely");
}

static void test_geometric(void)
{
    static const double p[] = {1e-14, 1e-9, 0.001, 0.3, 0.5, 0.999, 1};
    double worst = 0;
    int wrong = 0;
    buffon_rng rng = buffon_rng_make(1, 31);
    for (size_t j = 0; j < sizeof p / sizeof *p; j++) {
        const buffon_density g = buffon_geometric(p[j]);
        const wide fail = log1pl(-(wide)p[j]);
        for (int i = 0; i < 2000; i++) {
            const double u = grid(&rng, i), k = one_x(&g, u);
            const wide target = log1pl(-(wide)u), slack = -1e-15L * target;
            wrong += k != floor(k) || k < 0 || !((k + 1) * fail <= target + slack);
            wrong += k > 0 && !(k * fail > target - slack);
            const wide exact = k > 0 ? p[j] * expl(k * fail) : p[j];
            const double room = 1 + fabs((double)logl(exact));
            worst = fmax(worst, fabs((double)(one_pdf(&g, k) / exact - 1)) / room);
        }
    }
    tap_ok(wrong == 0, "geometric: the least k with (1 - p)^(k + 1) <= 1 - u");
    tap_ok(worst <= 2e-15, "geometric pdf: %.2g of 1 + |log|", worst);
    const buffon_density half = buffon_geometric(0.5), sure = buffon_geometric(1);
    tap_ok(one_x(&half, 0.5) == 0 && one_x(&half, 0.75) == 1 && one_x(&half, 0.751) == 2 &&
               fabs(one_pdf(&half, 3) - 0.0625) <= 0x1p-55 && one_pdf(&sure, 0) == 1 &&
               one_pdf(&sure, 1) == 0 && one_pdf(&half, -1) == 0 && one_pdf(&half, 1.5) == 0 &&
               one_log_pdf(&half, NAN) == -INFINITY,
           "geometric: halves, and certainty");
}

/* ---- probabilities ---- */

static wide wide_part(wide x, wide m)
{
    const wide d = (m - x) / x;
    return x * (d < -0.5L ? d - logl(m / x) : wide_deviance(d));
}

static wide wide_log_poisson(wide m, wide k)
{
    if (k == 0)
        return -m;
    return -0.5L * (logl(k) + WIDE_LOG_2PI) - wide_stirling(k) - wide_part(k, m);
}

static wide wide_log_binomial(wide n, wide p, wide k)
{
    const wide left = n - k;
    if (k == 0 || left == 0)
        return k == 0 ? n * log1pl(-p) : n * logl(p);
    return 0.5L * (logl(n / left) - logl(k) - WIDE_LOG_2PI) + wide_stirling(n) - wide_stirling(k) -
           wide_stirling(left) - wide_part(k, n * p) - wide_part(left, n * (1 - p));
}

static void see_pdf(double *worst, double *log_worst, const buffon_density *g, double k, wide exact)
{
    const double room = 1 + fabs((double)exact);
    if (exact > -700)
        *worst = fmax(*worst, fabs((double)(one_pdf(g, k) / expl(exact) - 1)) / room);
    *log_worst = fmax(*log_worst, fabs((double)(one_log_pdf(g, k) - exact)) / room);
}

static void test_poisson_pdf(void)
{
    static const double mean[] = {0x1p-1074, 1e-300, 1e-10, 0.3, 4, 19.5, 150, 1e4, 1e9, 1e15};
    double worst = 0, log_worst = 0;
    for (size_t j = 0; j < sizeof mean / sizeof *mean; j++) {
        const buffon_density g = buffon_poisson(mean[j]);
        for (int i = 0; i < 120; i++) {
            const double z = i % 40 / 4.0 - 5, at = floor(mean[j] + z * sqrt(mean[j]));
            const double k = i < 40 ? at : i < 80 ? i - 40 : floor(mean[j] * (i - 80) / 20);
            if (k >= 0)
                see_pdf(&worst, &log_worst, &g, k, wide_log_poisson(mean[j], k));
        }
    }
    tap_ok(worst <= 4e-15 && log_worst <= 4e-15, "Poisson pdf and its log: %.2g, %.2g of 1 + |log|",
           worst, log_worst);
}

/* n p has no more bits than extended precision. */
static void test_binomial_pdf(void)
{
    static const double n[] = {1, 7, 60, 1000, 0x1p20, 0x1p50};
    static const double p[] = {0x1p-1074, 1e-12, 0x1p-8, 0.3, 0.5, 0.75, 1 - 0x1p-30};
    double worst = 0, log_worst = 0;
    for (size_t j = 0; j < 42; j++) {
        const double tries = n[j / 7], q = p[j % 7], sd = sqrt(tries * q * (1 - q));
        const buffon_density g = buffon_binomial((uint64_t)tries, q);
        for (int i = 0; i < 80; i++) {
            const double at = floor(tries * q + (i / 4.0 - 5) * sd);
            const double k = i < 40 ? at : i < 60 ? i - 40 : tries - (i - 60);
            if (k >= 0 && k <= tries)
                see_pdf(&worst, &log_worst, &g, k, wide_log_binomial(tries, q, k));
        }
    }
    tap_ok(worst <= 4e-15 && log_worst <= 4e-15,
           "binomial pdf and its log: %.2g, %.2g of 1 + |log|", worst, log_worst);
}

/* Binomial coefficients over 2^60, and their sums, which 64 bits hold. */
static void test_exact(void)
{
    const buffon_density g = buffon_binomial(60, 0.5);
    uint64_t choose = 1, sum = 0;
    double worst = 0;
    int good = 1;
    for (int k = 0; k <= 60; k++) {
        const double exact = ldexp((double)choose, -60);
        worst = fmax(worst, fabs(one_pdf(&g, k) / exact - 1));
        sum += choose;
        const double below = ldexp((double)sum, -60);
        if (k < 30)
            good &= one_x(&g, below * (1 - 1e-13)) == k && one_x(&g, below * (1 + 1e-13)) == k + 1;
        if (k >= 20 && k < 30)
            good &= one_x(&g, 1 - below) >= 60 - k - 1 && one_x(&g, 1 - below) <= 60 - k;
        /* 60! / (k! (60 - k)!) without a product that overflows */
        const uint64_t left = (uint64_t)(60 - k), next = (uint64_t)k + 1;
        choose = choose / next * left + choose % next * left / next;
    }
    tap_ok(sum == UINT64_C(1) << 60 && good, "binomial of 60 and 1/2: points by exact sums");
    tap_ok(worst <= 2e-14, "and probabilities: %.2g", worst);
}

/* ---- points by sums ---- */

enum { SUMS = 6000 };

static wide lower[SUMS], upper[SUMS]; /* P(X <= k), P(X > k) for k = first ... */

/* All k from first on; what is below is nothing that a uniform of the generator sees. */
static double sum_up(const buffon_density *g, double first)
{
    wide sum = 0;
    for (int i = 0; i < SUMS; i++) {
        lower[i] = sum += one_pdf(g, first + i);
        upper[i] = i ? upper[i] : 0;
    }
    upper[SUMS - 1] = 0;
    for (int i = SUMS - 1; i > 0; i--)
        upper[i - 1] = upper[i] + one_pdf(g, first + i);
    return (double)sum;
}

static void test_boundaries(const char *name, const buffon_density *g, double first, uint64_t seed)
{
    const wide slack = 2e-13L;
    buffon_rng rng = buffon_rng_make(seed, 32);
    int wrong = 0, same = 1;
    const double sum = sum_up(g, first);
    for (int i = 0; i < 4000; i++) {
        const double u = grid(&rng, i), x = one_x(g, u);
        const int k = (int)(x - first);
        const wide before = k > 0 ? lower[k - 1] : 0, q = 1 - (wide)u;
        if (u <= 0.5)
            wrong += !(lower[k] >= u * (1 - slack)) || !(before <= u * (1 + slack));
        else
            wrong +=
                !(upper[k] <= q * (1 + slack)) || (k > 0 && !(upper[k - 1] >= q * (1 - slack)));
        same &= x == floor(x);
    }
    tap_ok(wrong == 0 && same, "%s: each point is where the sums of probabilities say", name);
    tap_ok(fabs(sum - 1) <= 4e-14, "%s: they add up to 1, but for %.2g", name, sum - 1);
}

static void test_sums(void)
{
    static const double mean[] = {1e-5, 0.7, 8, 40, 199, 201, 2500, 50000};
    static const double p[] = {0x1p-12, 0.03, 0.25, 0.5, 0.9};
    static const uint64_t n[] = {3, 50, 900, 30000};
    char name[64];
    for (size_t k = 0; k < sizeof mean / sizeof *mean; k++) {
        const buffon_density g = buffon_poisson(mean[k]);
        snprintf(name, sizeof name, "Poisson %g", mean[k]);
        test_boundaries(name, &g, fmax(0, floor(mean[k] - 12 * sqrt(mean[k]))), k);
    }
    for (size_t k = 0; k < 20; k++) {
        const double tries = (double)n[k / 5], q = p[k % 5], sd = sqrt(tries * q * (1 - q));
        const buffon_density g = buffon_binomial(n[k / 5], q);
        snprintf(name, sizeof name, "binomial %g %g", tries, q);
        test_boundaries(name, &g, fmax(0, floor(tries * q - 12 * sd)), 100 + k);
    }
}

/* Large laws by the gamma and the beta law: P(X <= k) = P(Y > mean), Y of shape k + 1, and
 * P(X <= k) = P(Y > p), Y of k + 1 and n - k. */
static double below(double tries, double p, double mean, double k)
{
    double u;
    const buffon_density g = tries > 0 ? buffon_beta(k + 1, tries - k) : buffon_gamma(k + 1, 1);
    const double at = tries > 0 ? p : mean;
    return buffon_density_invert(&u, &at, 1, &g) == BUFFON_OK ? u : NAN;
}

static void test_large(void)
{
    static const double mean[] = {1e6, 1e9, 1e12, 1e15};
    buffon_rng rng = buffon_rng_make(7, 33);
    int wrong = 0;
    for (int i = 0; i < 2000; i++) {
        const double u = 0.001 + 0.998 * buffon_rng_next(&rng), m = mean[i / 2 % 4];
        const double tries = i % 2 ? 0x1p49 : 0, p = i % 2 ? m / 0x1p51 : 0;
        const buffon_density g = i % 2 ? buffon_binomial((uint64_t)tries, p) : buffon_poisson(m);
        const double x = one_x(&g, u);
        wrong += !(1 - below(tries, p, m, x) >= u - 1e-12);
        wrong += !(1 - below(tries, p, m, x - 1) <= u + 1e-12);
    }
    tap_ok(wrong == 0, "means of 1e6 to 1e15: points where gamma and beta say");
}

/* ---- ends ---- */

static void test_order(void)
{
    static const double mean[] = {0.1, 12, 190, 210, 1e4, 1e12};
    int ordered = 1, mirrored = 1;
    for (size_t j = 0; j < sizeof mean / sizeof *mean; j++) {
        const uint64_t n = (uint64_t)(3 * mean[j]) + 1;
        const buffon_density g[] = {buffon_poisson(mean[j]), buffon_binomial(n, 0.375),
                                    buffon_binomial(n, 0.625)};
        double last[3] = {-1, -1, -1};
        for (int i = 0; i < 3000; i++) {
            const double u = i < 1000   ? ldexp(1, i - 1074)
                             : i < 2000 ? (i - 999.7) / 1001
                                        : 1 - ldexp(1, -(i - 2000) / 20 - 1);
            for (int k = 0; k < 3; k++) {
                const double x = one_x(&g[k], u);
                ordered &= (i == 1000 || i == 2000 || x >= last[k]) && x >= 0;
                last[k] = x;
            }
            if (i >= 1000 && i < 2000)
                mirrored &= fabs(last[1] + one_x(&g[2], 1 - u) - (double)n) <= (u == 0.5);
        }
    }
    tap_ok(ordered, "points rise with u, from 2^-1074 on");
    tap_ok(mirrored, "failures are counted as successes are");
}

static void test_ends(void)
{
    const buffon_density none = buffon_binomial(0, 0.5), never = buffon_binomial(9, 0),
                         always = buffon_binomial(9, 1), nothing = buffon_poisson(0),
                         five = buffon_binomial(5, 0.25), two = buffon_poisson(2);
    const buffon_density quarter = buffon_binomial(1, 0.25), rest = buffon_binomial(1, 0.75);
    double u = 0.5, x = 1;
    tap_ok(one_x(&quarter, 0.75) == 0 && one_x(&quarter, 0.75 + 0x1p-40) == 1 &&
               one_x(&rest, 0.25) == 0 && one_x(&rest, 0.25 + 0x1p-40) == 1,
           "the least k with P(X <= k) >= u, where that is exact");
    tap_ok(one_x(&none, 0.9) == 0 && one_x(&never, 0.9) == 0 && one_x(&always, 0x1p-53) == 9 &&
               one_x(&nothing, 1 - 0x1p-53) == 0 && one_x(&nothing, 0x1p-1074) == 0 &&
               one_x(&never, 0x1p-1074) == 0 && one_x(&always, 0x1p-1074) == 9,
           "laws of one point");
    tap_ok(one_pdf(&none, 0) == 1 && one_pdf(&never, 0) == 1 && one_pdf(&never, 1) == 0 &&
               one_pdf(&always, 9) == 1 && one_pdf(&always, 8) == 0 && one_pdf(&nothing, 0) == 1 &&
               one_pdf(&nothing, 3) == 0,
           "their probabilities");
    tap_ok(one_pdf(&five, -1) == 0 && one_pdf(&five, 6) == 0 && one_pdf(&five, 0.5) == 0 &&
               one_pdf(&five, NAN) == 0 && one_log_pdf(&five, 6) == -INFINITY &&
               one_pdf(&two, -1) == 0 && one_pdf(&two, 1e300) == 0 &&
               one_pdf(&two, INFINITY) == 0 && one_pdf(&two, 0x1p60) == 0 &&
               one_pdf(&two, NAN) == 0,
           "no probability but at whole numbers in range");
    tap_ok(buffon_density_invert(&u, &x, 1, &two) == BUFFON_E_UNSUPPORTED &&
               buffon_density_invert(&u, &x, 1, &five) == BUFFON_E_UNSUPPORTED,
           "no way back");
}

/* Small means: uniforms next to 0 give 0, at once. */
static void test_least(void)
{
    static const double n[] = {100, 399, 1e5, 0x1p50}, u[] = {0x1p-1074, 1e-300, 1e-100, 1e-20};
    int good = 1;
    for (int k = 0; k < 16; k++) {
        const buffon_density g = buffon_binomial((uint64_t)n[k / 4], 1e-15);
        good &= one_x(&g, u[k % 4]) == 0;
    }
    tap_ok(good, "binomial: the smallest uniforms of small means");
}

static void test_refusals(void)
{
    static const double bad[] = {-0x1p-1074, -1, 1.0000000000000002, INFINITY, -INFINITY, NAN};
    int wrong = 0;
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        wrong += buffon_bernoulli(bad[k]).status != BUFFON_E_SHAPE;
        wrong += buffon_geometric(bad[k]).status != BUFFON_E_SHAPE;
        wrong += buffon_binomial(3, bad[k]).status != BUFFON_E_SHAPE;
        wrong += k != 2 && buffon_poisson(bad[k]).status != BUFFON_E_SHAPE;
    }
    wrong += buffon_geometric(0).status != BUFFON_E_SHAPE;
    wrong += buffon_poisson(1.1e15).status != BUFFON_E_SHAPE;
    wrong += buffon_binomial((UINT64_C(1) << 50) + 1, 0.5).status != BUFFON_E_SHAPE;
    wrong += buffon_binomial(UINT64_C(1) << 50, 0.5).status != BUFFON_OK;
    tap_ok(wrong == 0, "parameters outside their range are refused, none inside");
    refused_by_value(buffon_poisson(-1), BUFFON_E_SHAPE, "Poisson of a negative mean");
    refused_by_value(buffon_binomial(1, 2), BUFFON_E_SHAPE, "binomial of a probability of 2");
}

int main(void)
{
    test_bernoulli();
    if (LDBL_MANT_DIG >= 64) {
        test_geometric();
        test_poisson_pdf();
        test_binomial_pdf();
        test_sums();
    }
    test_exact();
    test_large();
    test_order();
    test_ends();
    test_least();
    test_refusals();
    return tap_done();
}
