/* Forty laws on the line, for tests and benches of tables of quantile functions: what they have in
 * common is a CDF that can be had from both ends to many digits, in long double. The pdf need not
 * be normalised; `total` is its integral. */
#ifndef TESTS_LAWS40_H
#define TESTS_LAWS40_H

#include <math.h>
#include <stddef.h>

typedef long double law_cdf(long double x, const double *p);

typedef struct law40 {
    const char *name;
    double (*pdf)(double x, void *p);
    law_cdf *lower, *upper; /* P(X <= x) and P(X > x) */
    double lo, hi, centre;
    double p[4];
    double total;
    size_t breaks, poles;
    double at[8]; /* the breaks, then the poles */
    int peers;    /* what UNU.RAN is asked for too: poles are not */
} law40;

#define LAWS_PI 3.141592653589793238462643383279502884L
#define LAWS_SQRT2 1.414213562373095048801688724209698079L

/* ---- pieces of CDFs ---- */

/* The lower incomplete gamma function, relative to the whole, by its series. */
static long double laws_gamma_series(long double a, long double x)
{
    long double term = 1 / a, sum = term;
    for (int n = 1; n < 3000 && term > sum * 1e-22L; n++) {
        term *= x / (a + (long double)n);
        sum += term;
    }
    return sum * expl(a * logl(x) - x - lgammal(a));
}

/* The upper one by its continued fraction (modified Lentz). */
static long double laws_gamma_fraction(long double a, long double x)
{
    long double b = x + 1 - a, c = 1e300L, d = 1 / b, h = d;
    for (int i = 1; i < 3000; i++) {
        const long double k = -(long double)i * ((long double)i - a);
        b += 2;
        d = 1 / (k * d + b);
        c = b + k / c;
        h *= d * c;
        if (fabsl(d * c - 1) < 1e-20L)
            break;
    }
    return h * expl(a * logl(x) - x - lgammal(a));
}

static long double gamma_lower(long double x, const double *p)
{
    return x <= 0         ? 0
           : x < p[0] + 1 ? laws_gamma_series(p[0], x)
                          : 1 - laws_gamma_fraction(p[0], x);
}

static long double gamma_upper(long double x, const double *p)
{
    return x <= 0         ? 1
           : x < p[0] + 1 ? 1 - laws_gamma_series(p[0], x)
                          : laws_gamma_fraction(p[0], x);
}

/* The incomplete beta function by its continued fraction, for x < (a + 1) / (a + b + 2). */
static long double laws_beta_fraction(long double a, long double b, long double x, long double rest)
{
    long double c = 1, d = 1 / (1 - (a + b) * x / (a + 1)), h = d;
    for (int i = 1; i < 3000; i++) {
        const long double m = (long double)i,
                          even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
        const long double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        d = 1 / (1 + even * d);
        c = 1 + even / c;
        h *= d * c;
        d = 1 / (1 + odd * d);
        c = 1 + odd / c;
        h *= d * c;
        if (fabsl(d * c - 1) < 1e-20L)
            break;
    }
    const long double front =
        a * logl(x) + b * logl(rest) + lgammal(a + b) - lgammal(a) - lgammal(b);
    return h * expl(front) / a;
}

static long double laws_beta(long double a, long double b, long double x, long double rest)
{
    if (x <= 0)
        return 0;
    if (rest <= 0)
        return 1;
    return x < (a + 1) / (a + b + 2) ? laws_beta_fraction(a, b, x, rest)
                                     : 1 - laws_beta_fraction(b, a, rest, x);
}

static long double beta_lower(long double x, const double *p)
{
    return laws_beta(p[0], p[1], x, 1 - x);
}

static long double beta_upper(long double x, const double *p)
{
    return laws_beta(p[1], p[0], 1 - x, x);
}

static double beta_pdf(double x, void *ctx)
{
    const double *p = ctx;
    return pow(x, p[0] - 1) * pow(1 - x, p[1] - 1);
}

static double gamma_pdf(double x, void *ctx)
{
    const double *p = ctx;
    return pow(x, p[0] - 1) * exp(-x);
}

/* ---- normals ---- */

static long double normal_lower(long double x, const double *p)
{
    return erfcl((p[0] - x) / p[1] / LAWS_SQRT2) / 2;
}

static long double normal_upper(long double x, const double *p)
{
    return erfcl((x - p[0]) / p[1] / LAWS_SQRT2) / 2;
}

static double normal_bell(double x, void *ctx)
{
    const double *p = ctx, z = (x - p[0]) / p[1];
    return exp(-0.5 * z * z);
}

/* Between a and b, of the standard normal, twice. */
static long double laws_between(long double a, long double b)
{
    a /= LAWS_SQRT2;
    b /= LAWS_SQRT2;
    return a < 0.5L ? erfl(b) - erfl(a) : erfcl(a) - erfcl(b);
}

/* Between p[2] and p[3]. */
static long double cut_lower(long double x, const double *p)
{
    return laws_between(p[2], x) / laws_between(p[2], p[3]);
}

static long double cut_upper(long double x, const double *p)
{
    return laws_between(x, p[3]) / laws_between(p[2], p[3]);
}

/* Two normals: a share p[0] at 0 of width 1, the rest at p[1] of width p[2]. */
static long double two_lower(long double x, const double *p)
{
    const double one[2] = {0, 1}, other[2] = {p[1], p[2]};
    return p[0] * normal_lower(x, one) + (1 - (long double)p[0]) * normal_lower(x, other);
}

static long double two_upper(long double x, const double *p)
{
    const double one[2] = {0, 1}, other[2] = {p[1], p[2]};
    return p[0] * normal_upper(x, one) + (1 - (long double)p[0]) * normal_upper(x, other);
}

static double two_pdf(double x, void *ctx)
{
    const double *p = ctx, z = (x - p[1]) / p[2];
    return p[0] * exp(-0.5 * x * x) + (1 - p[0]) / p[2] * exp(-0.5 * z * z);
}

static long double lognormal_lower(long double x, const double *p)
{
    const double q[2] = {0, p[0]};
    return x <= 0 ? 0 : normal_lower(logl(x), q);
}

static long double lognormal_upper(long double x, const double *p)
{
    const double q[2] = {0, p[0]};
    return x <= 0 ? 1 : normal_upper(logl(x), q);
}

static double lognormal_pdf(double x, void *ctx)
{
    const double *p = ctx, z = log(x) / p[0];
    return exp(-0.5 * z * z) / x;
}

/* ---- heavy tails ---- */

static long double cauchy_lower(long double x, const double *p)
{
    return atan2l(1, -(x - p[0]) / p[1]) / LAWS_PI;
}

static long double cauchy_upper(long double x, const double *p)
{
    return atan2l(1, (x - p[0]) / p[1]) / LAWS_PI;
}

static double cauchy_pdf(double x, void *ctx)
{
    const double *p = ctx, z = (x - p[0]) / p[1];
    return 1 / (1 + z * z);
}

/* Student's t by the beta function of n / (n + x^2) and its complement. */
static long double t_upper(long double x, const double *p)
{
    const long double n = p[0], w = x * x,
                      tail = laws_beta(n / 2, 0.5L, n / (n + w), w / (n + w)) / 2;
    return x > 0 ? tail : 1 - tail;
}

static long double t_lower(long double x, const double *p)
{
    return t_upper(-x, p);
}

static double t_pdf(double x, void *ctx)
{
    const double *p = ctx;
    return pow(1 + x * x / p[0], -0.5 * (p[0] + 1));
}

static long double pareto_upper(long double x, const double *p)
{
    return x <= 1 ? 1 : powl(x, -(long double)p[0]);
}

static long double pareto_lower(long double x, const double *p)
{
    return x <= 1 ? 0 : -expm1l(-p[0] * logl(x));
}

static double pareto_pdf(double x, void *ctx)
{
    const double *p = ctx;
    return pow(x, -p[0] - 1);
}

/* Levy: x = 1 / z^2 of a normal z. */
static long double levy_lower(long double x, const double *p)
{
    (void)p;
    return x <= 0 ? 0 : erfcl(1 / sqrtl(2 * x));
}

static long double levy_upper(long double x, const double *p)
{
    (void)p;
    return x <= 0 ? 1 : erfl(1 / sqrtl(2 * x));
}

static double levy_pdf(double x, void *p)
{
    (void)p;
    return exp(-0.5 / x) / (x * sqrt(x));
}

/* ---- exponential tails ---- */

static long double weibull_lower(long double x, const double *p)
{
    return x <= 0 ? 0 : -expm1l(-powl(x, p[0]));
}

static long double weibull_upper(long double x, const double *p)
{
    return x <= 0 ? 1 : expl(-powl(x, p[0]));
}

static double weibull_pdf(double x, void *ctx)
{
    const double *p = ctx;
    return pow(x, p[0] - 1) * exp(-pow(x, p[0]));
}

static long double laplace_lower(long double x, const double *p)
{
    (void)p;
    return x < 0 ? expl(x) / 2 : 1 - expl(-x) / 2;
}

static long double laplace_upper(long double x, const double *p)
{
    return laplace_lower(-x, p);
}

static double laplace_pdf(double x, void *p)
{
    (void)p;
    return exp(-fabs(x));
}

static long double logistic_lower(long double x, const double *p)
{
    const long double z = (x - p[0]) / p[1];
    return z < 0 ? expl(z) / (1 + expl(z)) : 1 / (1 + expl(-z));
}

static long double logistic_upper(long double x, const double *p)
{
    const long double z = (x - p[0]) / p[1];
    return z > 0 ? expl(-z) / (1 + expl(-z)) : 1 / (1 + expl(z));
}

static double logistic_pdf(double x, void *ctx)
{
    const double *p = ctx, e = exp(-fabs((x - p[0]) / p[1]));
    return e / ((1 + e) * (1 + e));
}

static long double gumbel_lower(long double x, const double *p)
{
    (void)p;
    return expl(-expl(-x));
}

static long double gumbel_upper(long double x, const double *p)
{
    (void)p;
    return -expm1l(-expl(-x));
}

static double gumbel_pdf(double x, void *p)
{
    (void)p;
    return exp(-x - exp(-x));
}

static long double sech_lower(long double x, const double *p)
{
    (void)p;
    return 2 / LAWS_PI * atanl(expl(x));
}

static long double sech_upper(long double x, const double *p)
{
    return sech_lower(-x, p);
}

static double sech_pdf(double x, void *p)
{
    (void)p;
    const double e = exp(-fabs(x));
    return 2 * e / (1 + e * e);
}

/* ---- pieces ---- */

static const double steps_at[4] = {0, 1, 2.5, 4}, steps_height[3] = {1, 5, 0.25};

static long double steps_below(long double x)
{
    long double sum = 0;
    for (int k = 0; k < 3; k++)
        if (x > steps_at[k])
            sum += steps_height[k] * ((x < steps_at[k + 1] ? x : steps_at[k + 1]) - steps_at[k]);
    return sum;
}

static long double steps_lower(long double x, const double *p)
{
    (void)p;
    return steps_below(x) / steps_below(4);
}

static long double steps_upper(long double x, const double *p)
{
    (void)p;
    long double sum = 0;
    for (int k = 0; k < 3; k++)
        if (x < steps_at[k + 1])
            sum += steps_height[k] * (steps_at[k + 1] - (x > steps_at[k] ? x : steps_at[k]));
    return sum / steps_below(4);
}

static double steps_pdf(double x, void *p)
{
    (void)p;
    return steps_height[x < steps_at[1] ? 0 : x < steps_at[2] ? 1 : 2];
}

/* Height 1 on (0, 1), and p[2] between p[0] and p[1]. */
static long double spike_below(long double x, const double *p)
{
    const long double inside = x < p[0] ? 0 : x > p[1] ? p[1] - (long double)p[0] : x - p[0];
    return x + (p[2] - 1) * inside;
}

static long double spike_lower(long double x, const double *p)
{
    return spike_below(x, p) / spike_below(1, p);
}

static long double spike_upper(long double x, const double *p)
{
    return 1 - spike_lower(x, p);
}

static double spike_pdf(double x, void *ctx)
{
    const double *p = ctx;
    return x > p[0] && x < p[1] ? p[2] : 1;
}

static long double triangle_lower(long double x, const double *p)
{
    return x < p[0] ? x * x / p[0] : 1 - (1 - x) * (1 - x) / (1 - (long double)p[0]);
}

static long double triangle_upper(long double x, const double *p)
{
    return x < p[0] ? 1 - x * x / p[0] : (1 - x) * (1 - x) / (1 - (long double)p[0]);
}

static double triangle_pdf(double x, void *ctx)
{
    const double *p = ctx;
    return x < p[0] ? x / p[0] : (1 - x) / (1 - p[0]);
}

/* |x|^(p - 1) on (-1, 1): a pole within. */
static long double cusp_lower(long double x, const double *p)
{
    const long double half = powl(fabsl(x), p[0]) / 2;
    return x <= -1 ? 0 : x >= 1 ? 1 : x < 0 ? 0.5L - half : 0.5L + half;
}

static long double cusp_upper(long double x, const double *p)
{
    return cusp_lower(-x, p);
}

static double cusp_pdf(double x, void *ctx)
{
    const double *p = ctx;
    return pow(fabs(x), p[0] - 1);
}

/* Uniform on (0, 1) and (2, 3), nothing between. */
static long double gap_lower(long double x, const double *p)
{
    (void)p;
    return (x < 1 ? x : x < 2 ? 1 : x - 1) / 2;
}

static long double gap_upper(long double x, const double *p)
{
    return gap_lower(3 - x, p);
}

static double gap_pdf(double x, void *p)
{
    (void)p;
    return x < 1 || x > 2 ? 7 : 0;
}

/* 1 + p sin(20 pi x) on (0, 1). */
static long double waves_lower(long double x, const double *p)
{
    const long double s = sinl(10 * LAWS_PI * x);
    return x + p[0] * s * s / (10 * LAWS_PI);
}

static long double waves_upper(long double x, const double *p)
{
    return 1 - waves_lower(x, p);
}

static double waves_pdf(double x, void *ctx)
{
    const double *p = ctx;
    return 1 + p[0] * sin(20 * (double)LAWS_PI * x);
}

/* -log x on (0, 1): a singularity that is no power. */
static long double minuslog_lower(long double x, const double *p)
{
    (void)p;
    return x <= 0 ? 0 : x * (1 - logl(x));
}

static long double minuslog_upper(long double x, const double *p)
{
    (void)p;
    const long double r = 1 - x;
    if (r > 0.1L)
        return 1 - minuslog_lower(x, p);
    long double sum = 0, power = r;
    for (int k = 2; k < 30; k++) {
        power *= r;
        sum += power / (long double)(k * (k - 1));
    }
    return sum;
}

static double minuslog_pdf(double x, void *p)
{
    (void)p;
    return -log(x);
}

static long double parabola_lower(long double x, const double *p)
{
    (void)p;
    return (x * x * x + 1) / 2;
}

static long double parabola_upper(long double x, const double *p)
{
    return parabola_lower(-x, p);
}

static double parabola_pdf(double x, void *p)
{
    (void)p;
    return x * x;
}

/* ---- the list ---- */

#define LAWS(name) name##_pdf, name##_lower, name##_upper
#define LAWS_NORMAL normal_bell, normal_lower, normal_upper
#define LAWS_CUT normal_bell, cut_lower, cut_upper
#define LAWS_ROOT_2PI 2.50662827463100050242

static const law40 laws40[] = {
    {"normal", LAWS_NORMAL, 0, 0, 0, {0, 1}, LAWS_ROOT_2PI, .peers = 1},
    {"normal (0, 1e-100)", LAWS_NORMAL, 0, 0, 0, {0, 1e-100}, 1e-100 * LAWS_ROOT_2PI, .peers = 0},
    {"normal (1000, 1)", LAWS_NORMAL, 0, 0, 1000, {1000, 1}, LAWS_ROOT_2PI, .peers = 1},
    {"half normal", LAWS_CUT, 0, INFINITY, 0, {0, 1, 0, INFINITY}, LAWS_ROOT_2PI / 2, .peers = 1},
    {"normal on (-1, 2)", LAWS_CUT, -1, 2, 0, {0, 1, -1, 2}, 0, .peers = 1},
    {"normal beyond 5", LAWS_CUT, 5, INFINITY, 5, {0, 1, 5, INFINITY}, 0, .peers = 1},
    {"gamma (0.1)", LAWS(gamma), 0, INFINITY, 0, {0.1}, 9.51350769866873184, .peers = 0},
    {"gamma (0.5)", LAWS(gamma), 0, INFINITY, 0, {0.5}, 1.77245385090551603, .peers = 0},
    {"exponential", LAWS(gamma), 0, INFINITY, 0, {1}, 1, .peers = 1},
    {"gamma (2.5)", LAWS(gamma), 0, INFINITY, 0, {2.5}, 1.32934038817913702, .peers = 1},
    {"gamma (50)", LAWS(gamma), 0, INFINITY, 0, {50}, 0, .peers = 1},
    {"beta (0.5, 0.5)", LAWS(beta), 0, 1, 0, {0.5, 0.5}, 3.14159265358979324, .peers = 0},
    {"beta (0.2, 0.7)", LAWS(beta), 0, 1, 0, {0.2, 0.7}, 0, .peers = 0},
    {"beta (1, 1): uniform", LAWS(beta), 0, 1, 0, {1, 1}, 1, .peers = 1},
    {"beta (2, 5)", LAWS(beta), 0, 1, 0, {2, 5}, 1.0 / 30, .peers = 1},
    {"beta (300, 100)", LAWS(beta), 0, 1, 0, {300, 100}, 0, .peers = 1},
    {"Cauchy", LAWS(cauchy), 0, 0, 0, {0, 1}, 3.14159265358979324, .peers = 1},
    {"Cauchy (-20, 5)", LAWS(cauchy), 0, 0, 0, {-20, 5}, 15.7079632679489662, .peers = 1},
    {"t (0.5)", LAWS(t), 0, 0, 0, {0.5}, 0, .peers = 0},
    {"t (3)", LAWS(t), 0, 0, 0, {3}, 2.72069904635132677, .peers = 1},
    {"t (30)", LAWS(t), 0, 0, 0, {30}, 0, .peers = 1},
    {"Pareto (0.5)", LAWS(pareto), 1, INFINITY, 1, {0.5}, 2, .peers = 0},
    {"Pareto (3)", LAWS(pareto), 1, INFINITY, 1, {3}, 1.0 / 3, .peers = 1},
    {"Levy", LAWS(levy), 0, INFINITY, 0, {0}, LAWS_ROOT_2PI, .peers = 0},
    {"lognormal (1)", LAWS(lognormal), 0, INFINITY, 0, {1}, LAWS_ROOT_2PI, .peers = 1},
    {"lognormal (3)", LAWS(lognormal), 0, INFINITY, 0, {3}, 3 * LAWS_ROOT_2PI, .peers = 0},
    {"two normals, 30 apart",
     LAWS(two),
     0,
     0,
     0,
     {0.3, 30, 1},
     LAWS_ROOT_2PI,
     1,
     0,
     {30},
     .peers = 0},
    {"two normals, 1000:1",
     LAWS(two),
     0,
     0,
     0,
     {0.5, 2, 0.001},
     LAWS_ROOT_2PI,
     1,
     0,
     {2},
     .peers = 0},
    {"Weibull (0.5)", LAWS(weibull), 0, INFINITY, 0, {0.5}, 2, .peers = 0},
    {"Weibull (5)", LAWS(weibull), 0, INFINITY, 0, {5}, 0.2, .peers = 1},
    {"Laplace", LAWS(laplace), 0, 0, 0, {0}, 2, .peers = 1},
    {"logistic (3, 2)", LAWS(logistic), 0, 0, 0, {3, 2}, 2, .peers = 1},
    {"Gumbel", LAWS(gumbel), 0, 0, 0, {0}, 1, .peers = 1},
    {"hyperbolic secant", LAWS(sech), 0, 0, 0, {0}, 3.14159265358979324, .peers = 1},
    {"steps", LAWS(steps), 0, 4, 0, {0}, 8.875, 2, 0, {1, 2.5}, .peers = 0},
    {"spike 1000:1", LAWS(spike), 0, 1, 0, {0.7, 0.701, 1000}, 0, 2, 0, {0.7, 0.701}, .peers = 0},
    {"triangle", LAWS(triangle), 0, 1, 0, {0.3}, 0.5, 1, 0, {0.3}, .peers = 0},
    {"cusp, pole within", LAWS(cusp), -1, 1, 0, {0.25}, 8, 0, 1, {0}, .peers = 0},
    {"two boxes, a gap", LAWS(gap), 0, 3, 0, {0}, 14, 2, 0, {1, 2}, .peers = 0},
    {"waves", LAWS(waves), 0, 1, 0, {0.9}, 1, .peers = 1},
    {"-log x", LAWS(minuslog), 0, 1, 0, {0}, 1, .peers = 0},
    {"parabola, zero within", LAWS(parabola), -1, 1, 0, {0}, 2.0 / 3, .peers = 1},
};

#define LAWS_COUNT (sizeof laws40 / sizeof *laws40)

#endif
