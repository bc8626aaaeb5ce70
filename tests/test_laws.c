/* The exponential and the normal density: their formulas against extended precision over the whole
 * range of uniforms and parameters (the numbers behind `Exact:` in the headers), their laws from
 * fixed seeds, and integrals that are known. */
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include <buffon/buffon.h>

#include "law.h"
#include "line.h"
#include "ulps.h"

#define WIDE_SQRT_2PI 2.50662827463100050241576528481104525L
#define COUNT(array) (sizeof(array) / sizeof *(array))
#define LEAST_UNIFORM 0x1p-53
#define MOST_UNIFORM (1 - 0x1p-53)
#define MOST_SCALE 0x1p1017 /* the largest mean of the one, standard deviation of the other */

enum { DRAWS = 20000, POINTS = 1 << 20, SHORT = 1 << 17, CELLS = 1024 };

/* ---- arguments ---------------------------------------------------------------------------- */

/* Where one formula hands over to another, or a number is special. */
static const double seams[] = {0x1p-1074,
                               0x1p-1073,
                               DBL_MIN,
                               1e-300,
                               1e-100,
                               0x1p-54,
                               0x1p-53,
                               1.3887943864964021e-11, /* exp(-25): the far tail of the normal */
                               0.07730474044329974,    /* exp(-1.6^2) */
                               0.075,
                               0.25,
                               0.2928932188134524, /* 1 - sqrt(1/2): log1p */
                               0.5,
                               0.75,
                               0.925,
                               0.9226952595567003,
                               1 - 1.3887943864964021e-11,
                               1 - 0x1p-53};

/* A uniform in (0, 1): of the generator, near its ends, near a seam, or of any size. */
static double argument(buffon_rng *rng, int k)
{
    const double u = grid(rng, k);
    if (k % 3 == 1) {
        double v = seams[buffon_rng_below(rng, COUNT(seams))];
        const double to = buffon_rng_next(rng) < 0.5 ? 0 : 1;
        for (uint64_t steps = buffon_rng_below(rng, 5); steps > 0; steps--)
            v = nextafter(v, to);
        return v > 0 && v < 1 ? v : 0.5;
    }
    if (k % 3 == 2) {
        const double v = ldexp(u, -(int)buffon_rng_below(rng, 1074));
        return v > 0 ? v : 0x1p-1074;
    }
    return u;
}

/* A scale of any size that is taken, now and then one of the outermost. */
static double any_scale(buffon_rng *rng, int k)
{
    const double edge[] = {DBL_MIN, DBL_MIN * (1 + 0x1p-52), MOST_SCALE, MOST_SCALE * (1 - 0x1p-53),
                           1};
    const double v = 1 + buffon_rng_next(rng);
    if (k % 5 == 0)
        return edge[buffon_rng_below(rng, COUNT(edge))];
    return k % 5 < 3 ? v : ldexp(v, (int)buffon_rng_below(rng, 2039) - 1022);
}

/* ---- the exponential against its formulas ------------------------------------------------- */

static void see_exponential(line_errors *w, double mean, double u)
{
    const buffon_density g = buffon_exponential(mean);
    const double at[] = {mean, u, 0, 0};
    double x, pdf;
    if (buffon_density_sample(&x, &pdf, &u, 1, &g) != BUFFON_OK)
        w->x.share = INFINITY;
    ulps_see(&w->x, x, -mean * log1pl(-(wide)u), 2, at);
    ulps_see(&w->drawn, pdf, (1 - (wide)u) / mean, 2, at);
}

/* The pdf at a given x knows x / mean as well as a division does. Beyond 708 its exp leaves the
 * normal doubles. */
static void see_exponential_at(line_errors *w, double mean, double x)
{
    const buffon_density g = buffon_exponential(mean);
    const double at[] = {mean, x, 0, 0};
    const wide q = (wide)x / mean, log_pdf = -q - logl(mean);
    double pdf, got, u = NAN;
    if (buffon_density_pdf(&pdf, &x, 1, &g) != BUFFON_OK ||
        buffon_density_log_pdf(&got, &x, 1, &g) != BUFFON_OK ||
        buffon_density_invert(&u, &x, 1, &g) != BUFFON_OK)
        w->given.share = INFINITY;
    if (q < 708)
        ulps_see(&w->given, pdf, expl(-q) / mean, 3 + (double)q, at);
    if (q < DBL_MAX)
        ulps_see_terms(&w->log_given, got, log_pdf, fmaxl(q, fabsl(logl(mean))), 3, at);
    ulps_see(&w->u, u, line_inside(-expm1l(-q)), 3, at);
}

static void test_exponential_formulas(void)
{
    line_errors w = {0};
    buffon_rng rng = buffon_rng_make(1, 30);
    for (int k = 0; k < 10 * DRAWS; k++) {
        const double mean = any_scale(&rng, k), u = argument(&rng, k);
        see_exponential(&w, mean, u);
        see_exponential_at(&w, mean, (double)(-mean * log1pl(-(wide)u)));
        see_exponential_at(&w, mean, any_scale(&rng, k + 1));
        see_exponential_at(&w, mean, mean * 800 * buffon_rng_next(&rng));
    }
    ulps_report(&w.x, "exponential: x within 2 ulp");
    ulps_report(&w.drawn, "exponential: g at u within 2 ulp");
    ulps_report(&w.given, "exponential: g at x within 3 + x / mean ulp where x < 708 mean");
    ulps_report(&w.log_given, "exponential: log g at x within 3 ulp of its larger term");
    ulps_report(&w.u, "exponential: u of x within 3 ulp");
}

/* ---- the normal against its formulas ------------------------------------------------------ */

/* P(Z <= z) and its logarithm, from the nearer tail. */
static wide wide_cdf(wide z)
{
    return 0.5L * erfcl(-z * sqrtl(0.5L));
}

/* The quantile of 1/2 + q, |q| <= 1/4, and of the tail p < 1/4: Newton's method from afar, for the
 * probability or for its logarithm. It shares nothing with the formulas of the library. */
static wide wide_middle(wide q)
{
    wide z = q * WIDE_SQRT_2PI;
    for (int k = 0; k < 8; k++)
        z -= (0.5L * erfl(z * sqrtl(0.5L)) - q) * WIDE_SQRT_2PI * expl(0.5L * z * z);
    return z;
}

static wide wide_tail(wide p)
{
    const wide target = logl(p);
    wide z = -sqrtl(-2 * target);
    for (int k = 0; k < 8; k++) {
        const wide cdf = wide_cdf(z), density = expl(-0.5L * z * z) / WIDE_SQRT_2PI;
        z -= (logl(cdf) - target) * cdf / density;
    }
    return z;
}

static wide wide_quantile(double u)
{
    if (fabs(u - 0.5) <= 0.25)
        return wide_middle((wide)u - 0.5L);
    return u < 0.5 ? wide_tail(u) : -wide_tail(1 - (wide)u);
}

static wide wide_bell(wide z, double sd)
{
    return expl(-0.5L * z * z) / (sd * WIDE_SQRT_2PI);
}

typedef struct normal_errors {
    ulps_worst z, drawn, given, log_given, u;
    int sums, zero;
} normal_errors;

/* With mean 0 and sd 1 the point is z itself; else it is mean + sd z to the bit, and g is that at
 * this z. From |z| = 40 on the bell is 0. */
static void see_normal(normal_errors *w, double mean, double sd, double u)
{
    const buffon_density g = buffon_normal(mean, sd), standard = buffon_normal(0, 1);
    const double at[] = {mean, sd, u, 0};
    double z = NAN, x, pdf, own = NAN;
    if (buffon_density_sample(&x, &pdf, &u, 1, &g) != BUFFON_OK ||
        buffon_density_sample(&z, &own, &u, 1, &standard) != BUFFON_OK)
        w->z.share = INFINITY;
    ulps_see(&w->z, z, wide_quantile(u), 8, at);
    w->sums &= x == mean + sd * z;
    if (fabs(z) < 40)
        ulps_see(&w->drawn, pdf, wide_bell(z, sd), 4, at);
    else
        w->zero &= pdf == 0;
    ulps_see(&w->drawn, own, wide_bell(z, 1), 4, at);
}

/* At a given x, z = (x - mean) / sd has two roundings. */
static void see_normal_at(normal_errors *w, double mean, double sd, double x)
{
    const buffon_density g = buffon_normal(mean, sd);
    const double at[] = {mean, sd, x, 0};
    const wide z = ((wide)x - mean) / sd, rest = logl(sd * WIDE_SQRT_2PI);
    const double size = (double)fminl(z * z, 1e5L), more = size + (mean != 0) * size;
    double pdf, got, u = NAN;
    if (buffon_density_pdf(&pdf, &x, 1, &g) != BUFFON_OK ||
        buffon_density_log_pdf(&got, &x, 1, &g) != BUFFON_OK ||
        buffon_density_invert(&u, &x, 1, &g) != BUFFON_OK)
        w->given.share = INFINITY;
    if (fabsl(z) < 39.9L)
        ulps_see(&w->given, pdf, wide_bell(z, sd), 4 + more, at);
    else if (fabsl(z) > 40)
        w->zero &= pdf == 0;
    if (fabsl(z) < 0x1p500L)
        ulps_see_terms(&w->log_given, got, -0.5L * z * z - rest,
                       fmaxl(fmaxl(0.5L * z * z, fabsl(logl(sd))), 0.92L), 6, at);
    ulps_see(&w->u, u, line_inside(wide_cdf(z)), 6 + more, at);
}

static void test_normal_formulas(void)
{
    normal_errors w = {.sums = 1, .zero = 1};
    buffon_rng rng = buffon_rng_make(2, 30);
    for (int k = 0; k < 5 * DRAWS; k++) {
        const double sd = any_scale(&rng, k), u = argument(&rng, k), v = buffon_rng_next(&rng);
        const double offset = k % 4 ? 0 : 4 * sd * (v - 0.5);
        const double mean = k % 7 ? offset : (k % 2 ? -0x1p1022 : 0x1p1022);
        see_normal(&w, mean, sd, u);
        see_normal_at(&w, offset, sd, offset + 80 * sd * (buffon_rng_next(&rng) - 0.5));
        see_normal_at(&w, 0, sd, 5 * sd * (v - 0.5));
        see_normal_at(&w, mean, sd, any_scale(&rng, k + 1));
    }
    ulps_report(&w.z, "normal: z within 8 ulp");
    tap_ok(w.sums, "normal: x is mean + sd z to the bit");
    ulps_report(&w.drawn, "normal: g at z within 4 ulp for |z| < 40");
    ulps_report(&w.given, "normal: g at x within 4 + z^2 ulp of mean 0, 4 + 2 z^2 of others");
    tap_ok(w.zero, "normal: g is 0 where |z| is above 40");
    ulps_report(&w.log_given, "normal: log g at x within 6 ulp of its largest term");
    ulps_report(&w.u, "normal: u of x as near as z is known");
}

static void test_formulas(void)
{
    if (!ulps_have_wide()) {
        tap_ok(1, "formulas # SKIP long double is no wider than double");
        return;
    }
    test_exponential_formulas();
    test_normal_formulas();
}

/* ---- values that are special -------------------------------------------------------------- */

static int is_refused(const buffon_density *g)
{
    double x = 1, y = 1, u = 0.5;
    return g->status == BUFFON_E_SHAPE &&
           buffon_density_sample(&x, &y, &u, 1, g) == BUFFON_E_SHAPE && x != x && y != y &&
           buffon_density_pdf(&y, &u, 1, g) == BUFFON_E_SHAPE;
}

static void test_parameters(void)
{
    static const double no_scale[] = {0,        -0.0,      -1,      0x1p-1074, NAN,
                                      INFINITY, -INFINITY, DBL_MAX, -DBL_MIN};
    static const double no_mean[] = {NAN, INFINITY, -INFINITY, DBL_MAX, -DBL_MAX};
    int refused = 1, taken = 1;
    for (size_t k = 0; k < COUNT(no_scale) + 2; k++) {
        const double scale = k < COUNT(no_scale)    ? no_scale[k]
                             : k == COUNT(no_scale) ? nextafter(DBL_MIN, 0)
                                                    : nextafter(MOST_SCALE, INFINITY);
        const buffon_density e = buffon_exponential(scale), n = buffon_normal(1, scale);
        refused &= is_refused(&e) && is_refused(&n);
    }
    for (size_t k = 0; k < COUNT(no_mean) + 1; k++) {
        const buffon_density n =
            buffon_normal(k < COUNT(no_mean) ? no_mean[k] : nextafter(0x1p1022, INFINITY), 1);
        refused &= is_refused(&n);
    }
    tap_ok(refused, "parameters out of range are refused");
    for (int k = 0; k < 4; k++) {
        const double scale = k % 2 ? DBL_MIN : MOST_SCALE, mean = k / 2 ? -0x1p1022 : 0x1p-1074;
        const buffon_density g[] = {buffon_exponential(scale), buffon_normal(mean, scale)};
        for (int j = 0; j < 2; j++) {
            const double u[] = {LEAST_UNIFORM, 0.3, MOST_UNIFORM};
            double x[3], pdf[3];
            taken &= buffon_density_check(&g[j]) == BUFFON_OK && g[j].dim == 1 &&
                     g[j].uniforms == 1 && buffon_density_sample(x, pdf, u, 3, &g[j]) == BUFFON_OK;
            for (int i = 0; i < 3; i++)
                taken &= isfinite(x[i]) && pdf[i] > 0 && isfinite(pdf[i]);
        }
    }
    tap_ok(taken, "the outermost parameters give finite points of positive pdf");
}

/* Points outside the support, infinite ones and NaN. */
static void test_special_points(void)
{
    static const double x[] = {NAN, INFINITY, -INFINITY, -1, -0x1p-1074, -0.0, 0};
    const buffon_density e = buffon_exponential(4), n = buffon_normal(-1, 2);
    double g[7], log_g[7], u[7];
    int good = buffon_density_pdf(g, x, 7, &e) == BUFFON_OK &&
               buffon_density_log_pdf(log_g, x, 7, &e) == BUFFON_OK &&
               buffon_density_invert(u, x + 1, 6, &e) == BUFFON_OK;
    for (int i = 0; i < 7; i++)
        good &= i < 5 ? g[i] == 0 && log_g[i] == -INFINITY
                      : g[i] == 0.25 && fabs(log_g[i] + log(4)) < 1e-15;
    for (int i = 0; i < 6; i++)
        good &= u[i] == (i == 0 ? MOST_UNIFORM : 0x1p-1074);
    tap_ok(good, "exponential: 0 below 0, at infinity and for NaN; 1 / mean at 0");
    good = buffon_density_pdf(g, x, 7, &n) == BUFFON_OK &&
           buffon_density_log_pdf(log_g, x, 7, &n) == BUFFON_OK &&
           buffon_density_invert(u, x + 1, 6, &n) == BUFFON_OK;
    for (int i = 0; i < 3; i++)
        good &= g[i] == 0 && log_g[i] == -INFINITY;
    good &= u[0] == MOST_UNIFORM && u[1] == 0x1p-1074 && u[2] == 0.5;
    good &= fabs(g[3] - 0.5 / sqrt(2 * LAW_PI)) < 1e-16 && g[5] == g[6] && u[4] == u[5];
    tap_ok(good, "normal: 0 at infinity and for NaN, the peak at the mean");
    good = 1;
    for (int k = 0; k < 2; k++) {
        const buffon_density *d = k ? &n : &e;
        good &= buffon_density_sample(NULL, NULL, NULL, 0, d) == BUFFON_OK &&
                buffon_density_pdf(NULL, NULL, 0, d) == BUFFON_OK &&
                buffon_density_log_pdf(NULL, NULL, 0, d) == BUFFON_OK &&
                buffon_density_invert(NULL, NULL, 0, d) == BUFFON_OK;
    }
    tap_ok(good, "no points are no trouble");
}

/* ---- batches and mirrors ------------------------------------------------------------------ */

static double uniform[POINTS], point[POINTS], density[POINTS], again[POINTS];

static void draw(const buffon_density *g, uint64_t seed)
{
    buffon_rng rng = buffon_rng_make(seed, 31);
    buffon_rng_fill(uniform, POINTS, &rng);
    if (buffon_density_sample(point, density, uniform, POINTS, g) != BUFFON_OK)
        tap_ok(0, "points are drawn");
}

/* All calls of a batch of n against as many of one point. */
static int same_one_by_one(const buffon_density *g, size_t n, const double *from)
{
    double u[600], x[600], pdf[600], given[600], log_pdf[600], back[600];
    int same = 1;
    memcpy(u, from, n * sizeof *u);
    for (size_t i = 0; i < n; i += 7)
        u[i] = seams[(i + n) % COUNT(seams)];
    same &= buffon_density_sample(x, pdf, u, n, g) == BUFFON_OK &&
            buffon_density_pdf(given, x, n, g) == BUFFON_OK &&
            buffon_density_log_pdf(log_pdf, x, n, g) == BUFFON_OK &&
            buffon_density_invert(back, x, n, g) == BUFFON_OK;
    for (size_t i = 0; i < n; i++) {
        double y[6];
        same &= buffon_density_sample(&y[0], &y[1], &u[i], 1, g) == BUFFON_OK &&
                buffon_density_sample(&y[2], NULL, &u[i], 1, g) == BUFFON_OK &&
                buffon_density_pdf(&y[3], &x[i], 1, g) == BUFFON_OK &&
                buffon_density_log_pdf(&y[4], &x[i], 1, g) == BUFFON_OK &&
                buffon_density_invert(&y[5], &x[i], 1, g) == BUFFON_OK;
        const double batch[] = {x[i], pdf[i], x[i], given[i], log_pdf[i], back[i]};
        same &= memcmp(y, batch, sizeof y) == 0;
    }
    return same;
}

static void test_batches(void)
{
    const buffon_density g[] = {buffon_exponential(1.3), buffon_exponential(DBL_MIN),
                                buffon_normal(0, 1), buffon_normal(5, 0.3)};
    int same = 1;
    draw(&g[0], 1);
    for (size_t k = 0; k < COUNT(g); k++)
        for (size_t n = 1; n <= 600; n += n < 40 ? 1 : 93)
            same &= same_one_by_one(&g[k], n, uniform + 1000 * k + n);
    tap_ok(same, "a batch is the same as its points one by one");
}

/* Pairs u, 1 - u: exact opposites about a mean of 0, opposite steps from another. */
static void test_mirrors(void)
{
    const double mean[] = {0, 0, 0, 3.7}, sd[] = {1, 0.3, 0x1.7p900, 2.9};
    int good = 1;
    for (int k = 0; k < 4; k++) {
        const buffon_density g = buffon_normal(mean[k], sd[k]);
        const buffon_density about = buffon_normal(0, sd[k]);
        draw(&about, 2);
        for (size_t i = 0; i < 50000; i++) {
            const double u = 1 - uniform[i];
            double x, pdf;
            good &= buffon_density_sample(&x, &pdf, &u, 1, &g) == BUFFON_OK &&
                    x == mean[k] - point[i] && pdf == density[i];
        }
    }
    tap_ok(good, "normal: the points of u and 1 - u are exact mirrors, with the same pdf");
}

/* ---- laws --------------------------------------------------------------------------------- */

static double exponential_level(double x, const double *param)
{
    return -expm1(-x / param[0]);
}

static double normal_level(double x, const double *param)
{
    return 0.5 * erfc((param[0] - x) / param[1] * sqrt(0.5));
}

/* The mean of a power of the points as a p-value; its expectation and second moment are exact. */
static double moment_p(double centre, double scale, int power, double expected, double square)
{
    double sum = 0;
    for (size_t i = 0; i < POINTS; i++)
        sum += pow((point[i] - centre) / scale, power);
    return law_normal((sum / POINTS - expected) * sqrt(POINTS / (square - expected * expected)));
}

static void test_law_of(const char *name, const buffon_density *g, uint64_t seed,
                        double (*level)(double x, const double *param), const double *param)
{
    static uint64_t count[CELLS];
    static double mass[CELLS];
    memset(count, 0, sizeof count);
    draw(g, seed);
    for (size_t i = 0; i < POINTS; i++) {
        const int cell = (int)(CELLS * level(point[i], param));
        count[cell < 0 ? 0 : cell < CELLS ? cell : CELLS - 1]++;
    }
    for (size_t k = 0; k < CELLS; k++)
        mass[k] = 1.0 / CELLS;
    law_ok(law_cells(count, mass, CELLS), "%s: cells of equal probability", name);
    for (size_t i = 0; i < SHORT; i++)
        again[i] = level(point[i], param);
    law_ok(law_uniform(again, SHORT), "%s: its CDF makes uniforms (Kolmogorov, Smirnov)", name);
}

static void test_exponential_law(void)
{
    const double means[] = {1, 0.037, 2e200};
    for (uint64_t k = 0; k < COUNT(means); k++) {
        const buffon_density g = buffon_exponential(means[k]);
        test_law_of("exponential", &g, 10 + k, exponential_level, &means[k]);
        law_ok(moment_p(0, means[k], 1, 1, 2), "exponential: mean");
        law_ok(moment_p(0, means[k], 2, 2, 24), "exponential: second moment");
        law_ok(moment_p(0, means[k], 3, 6, 720), "exponential: third moment");
    }
}

static void test_normal_law(void)
{
    const double param[][2] = {{0, 1}, {-3, 0.5}, {7e100, 3e100}};
    for (uint64_t k = 0; k < COUNT(param); k++) {
        const buffon_density g = buffon_normal(param[k][0], param[k][1]);
        test_law_of("normal", &g, 20 + k, normal_level, param[k]);
        law_ok(moment_p(param[k][0], param[k][1], 1, 0, 1), "normal: mean");
        law_ok(moment_p(param[k][0], param[k][1], 2, 1, 3), "normal: variance");
        law_ok(moment_p(param[k][0], param[k][1], 3, 0, 15), "normal: third moment");
        law_ok(moment_p(param[k][0], param[k][1], 4, 3, 105), "normal: fourth moment");
    }
}

/* The pdf is the derivative of the CDF: a fine sum of it makes the CDF. */
static void test_pdf_is_slope(void)
{
    const double param[] = {1.5, 0.75};
    const buffon_density g[] = {buffon_exponential(param[0]), buffon_normal(param[0], param[1])};
    enum { STEPS = 4000 };
    for (int k = 0; k < 2; k++) {
        const double lo = k ? -4 : 0, hi = 9, h = (hi - lo) / STEPS;
        double sum = 0, off = 0;
        for (int i = 0; i < STEPS; i++) {
            const double at[] = {lo + (i + 0.5 - sqrt(1.0 / 12)) * h,
                                 lo + (i + 0.5 + sqrt(1.0 / 12)) * h};
            double pdf[2];
            if (buffon_density_pdf(pdf, at, 2, &g[k]) != BUFFON_OK)
                off = INFINITY;
            sum += 0.5 * h * (pdf[0] + pdf[1]);
            const double cdf = k ? normal_level(lo + (i + 1) * h, param) - normal_level(lo, param)
                                 : exponential_level(lo + (i + 1) * h, param);
            off = fmax(off, fabs(sum - cdf));
        }
        tap_ok(off < 1e-13, "%s: the pdf integrates to the CDF", k ? "normal" : "exponential");
    }
}

/* ---- estimates ---------------------------------------------------------------------------- */

static double square(const double *x, void *ctx)
{
    (void)ctx;
    return x[0] * x[0];
}

static double falling(const double *x, void *ctx)
{
    (void)ctx;
    return exp(-x[0]);
}

static double gauss(const double *x, void *ctx)
{
    (void)ctx;
    return exp(-x[0] * x[0]);
}

static double gauss_wave(const double *x, void *ctx)
{
    (void)ctx;
    return exp(-x[0] * x[0]) * cos(x[0]);
}

static double gauss_plane(const double *x, void *ctx)
{
    (void)ctx;
    return exp(-x[0] * x[0] - 0.5 * (x[1] - x[0]) * (x[1] - x[0]));
}

static double decay(const double *x, void *ctx)
{
    (void)ctx;
    return x[0] * exp(-x[0]) * sin(x[0]);
}

/* With no doubt about it, and with the error that it says it has. */
static void known(const char *name, buffon_status status, const buffon_estimate *e, double exact)
{
    const int sound = status == BUFFON_OK && e->status == status && e->doubts == 0 &&
                      e->std_error > 0 && e->std_error < 0.02 * fabs(exact);
    const double p = law_normal((e->value - exact) / e->std_error);
    if (!tap_ok(sound && p > LAW_ALPHA, "%s", name))
        tap_note("%.17g +- %.3g, not %.17g; status %d, doubts %lx", e->value, e->std_error, exact,
                 (int)e->status, (unsigned long)e->doubts);
}

typedef struct integral {
    const char *name;
    double (*f)(const double *x, void *ctx);
    buffon_density g;
    double exact;
} integral;

static void test_estimates(void)
{
    const double root = sqrt(LAW_PI);
    const buffon_density normals[] = {buffon_normal(0, 1), buffon_normal(0.2, 1.5)};
    const integral expectation[] = {
        {"E x^2, exponential", square, buffon_exponential(1.5), 4.5},
        {"E exp(-x), exponential", falling, buffon_exponential(1.5), 0.4},
        {"E x^2, normal", square, buffon_normal(-1, 2), 5},
        {"E exp(-x), normal", falling, buffon_normal(1, 0.5), exp(-0.875)}};
    const integral line[] = {
        {"exp(-x^2) over the line", gauss, buffon_normal(0, 1), root},
        {"exp(-x^2), the normal off the middle", gauss, buffon_normal(0.3, 1.2), root},
        {"exp(-x^2) cos x over the line", gauss_wave, buffon_normal(0, 0.9), root * exp(-0.25)},
        {"exp(-x^2) over x > 0", gauss, buffon_exponential(0.8), 0.5 * root},
        {"x exp(-x) sin x over x > 0", decay, buffon_exponential(2), 0.5},
        {"a Gauss function over the plane", gauss_plane, buffon_density_product(normals, 2),
         sqrt(2.0) * LAW_PI}};
    const buffon_points points = buffon_points_antithetic();
    buffon_run run = {.samples = POINTS, .seed = 5};
    buffon_estimate e;
    for (size_t k = 0; k < COUNT(expectation); k++) {
        const buffon_integrand f = {.scalar = expectation[k].f, .dim = 1};
        known(expectation[k].name, buffon_expectation(&e, &f, &expectation[k].g, &run), &e,
              expectation[k].exact);
    }
    for (size_t k = 0; k < COUNT(line); k++) {
        const buffon_integrand f = {.scalar = line[k].f, .dim = line[k].g.dim};
        known(line[k].name, buffon_importance(&e, &f, &line[k].g, &run), &e, line[k].exact);
        run.points = run.points == NULL ? &points : NULL;
    }
}

/* f = g integrates to 1 without error: the pdf of a point is that of the law. */
static double standard_bell(const double *x, void *ctx)
{
    (void)ctx;
    return exp(-0.5 * x[0] * x[0]) / sqrt(2 * LAW_PI);
}

static void test_perfect_density(void)
{
    const buffon_integrand f[] = {{.scalar = falling, .dim = 1},
                                  {.scalar = standard_bell, .dim = 1}};
    const buffon_density g[] = {buffon_exponential(1), buffon_normal(0, 1)};
    for (int k = 0; k < 2; k++) {
        buffon_estimate e;
        const buffon_status status =
            buffon_importance(&e, &f[k], &g[k], &(buffon_run){.samples = POINTS});
        if (!tap_ok(status >= 0 && fabs(e.value - 1) < 1e-15 && e.max - e.min < 1e-14,
                    "%s: f / g is 1 where f is the pdf", k ? "normal" : "exponential"))
            tap_note("%.17g, from %.17g to %.17g", e.value, e.min, e.max);
    }
}

int main(void)
{
    test_formulas();
    test_parameters();
    test_special_points();
    test_batches();
    test_mirrors();
    test_exponential_law();
    test_normal_law();
    test_pdf_is_slope();
    test_estimates();
    test_perfect_density();
    return tap_done();
}
