/* Directions about a preferred one: their formulas against extended precision over all parameters,
 * the numbers behind `Exact:` in directional.h; round trips, means that are known, refusals. */
#include <float.h>
#include <math.h>

#include <buffon/buffon.h>

#include "grid.h"
#include "refused.h"

typedef long double wide;

#define WIDE_PI 3.14159265358979323846264338327950288L
#define DIRECTIONAL_MOST 0x1p900

enum { DRAWS = 40000 };

static const double up[3] = {0, 0, 1};

/* Valgrind, for one, computes long doubles in 53 bits. */
static int have_wide(void)
{
    volatile wide one = 1, tiny = 0x1p-60L;
    return LDBL_MANT_DIG >= 64 && one + tiny > one;
}

static double ulp(wide x)
{
    const double a = fabs((double)x);
    return a < DBL_MIN ? 0x1p-1074 : nextafter(a, INFINITY) - a;
}

/* The worst error met, as a share of what is allowed. */
typedef struct worst {
    double share;
} worst;

static void see(worst *w, double x, wide exact, double allowed)
{
    const double share = (double)fabsl(x - exact) / ulp(exact) / allowed;
    if (!(share <= w->share))
        w->share = share;
}

static void see_near(worst *w, double x, wide exact, double allowed)
{
    const double share = (double)fabsl(x - exact) / allowed;
    if (!(share <= w->share))
        w->share = share;
}

static void report(const worst *w, const char *what)
{
    tap_ok(w->share <= 1, "%s", what);
    tap_note("worst %.3f of what is allowed", w->share);
}

/* sin and cos of 2 pi t: the reduction by quarters is exact. */
static void circle(wide *c, wide *s, double t)
{
    const double quarters = floor(4 * t + 0.5), rest = t - 0.25 * quarters;
    const wide sine = sinl(2 * WIDE_PI * rest), cosine = cosl(2 * WIDE_PI * rest);
    const int k = (int)quarters & 3;
    *c = k == 0 ? cosine : k == 1 ? -sine : k == 2 ? -cosine : sine;
    *s = k == 0 ? sine : k == 1 ? cosine : k == 2 ? -sine : -cosine;
}

typedef struct errors {
    worst across, height, drawn, given, back;
} errors;

/* A point drawn about +z against the depth w and 2 - w that it should have. Allowed: ulp of x and
 * y, error of z, ulp of the density drawn and given. */
static void see_point(errors *e, const buffon_density *g, const double u[2], wide w, wide rest,
                      wide pdf, const double allowed[4])
{
    double x[3], v[2] = {NAN, NAN}, got = NAN, again = NAN;
    wide c, s;
    if (buffon_density_sample(x, &got, u, 1, g) != BUFFON_OK ||
        buffon_density_pdf(&again, x, 1, g) != BUFFON_OK ||
        buffon_density_invert(v, x, 1, g) != BUFFON_OK)
        e->across.share = INFINITY;
    circle(&c, &s, u[1]);
    const wide sine = sqrtl(w) * sqrtl(rest);
    see(&e->across, x[0], sine * c, allowed[0]);
    see(&e->across, x[1], sine * s, allowed[0]);
    see_near(&e->height, x[2], w < 1 ? 1 - w : rest - 1, allowed[1]);
    see(&e->drawn, got, pdf, allowed[2]);
    see(&e->given, again, pdf, allowed[3]);
    see_near(&e->back, v[0], u[0], 0x1p-50);
}

/* g of every kind: 0 and near it, and as near to +-1 as doubles are. */
static double any_g(buffon_rng *rng, int k)
{
    static const double special[] = {0, 0x1p-1074, -0x1p-1022, 1 - 0x1p-53, -1 + 0x1p-53};
    const double v = buffon_rng_next(rng), sign = k & 1 ? -1 : 1;
    switch (k % 5) {
    case 0:
        return sign * (1 - ldexp(0.5 + 0.5 * v, -(int)buffon_rng_below(rng, 53)));
    case 1:
        return sign * ldexp(v, -(int)buffon_rng_below(rng, 60));
    case 2:
        return special[buffon_rng_below(rng, 5)];
    default:
        return sign * v;
    }
}

static void test_scatter(void)
{
    errors e = {0};
    buffon_rng rng = buffon_rng_make(1, 70);
    for (int k = 0; k < DRAWS; k++) {
        const double g = any_g(&rng, k);
        const buffon_density at = buffon_henyey_greenstein(g, up);
        double u[2];
        grid_pair(u, &rng, k);
        /* 1 -+ g and sums of positives are all that is rounded. */
        const wide a = 1 - (wide)g, b = 1 + (wide)g, v = 1 - (wide)u[0];
        const wide d = a * u[0] + b * v;
        const wide w = 2 * u[0] * a * a * (b * v + u[0]) / (d * d);
        const wide rest = 2 * v * b * b * (a * u[0] + v) / (d * d);
        const wide pdf = d * d * d / (4 * WIDE_PI * a * a * b * b);
        see_point(&e, &at, u, w, rest, pdf, (const double[]){8, 0x1p-50, 10, 16});
    }
    report(&e.across, "Henyey and Greenstein: x and y within 8 ulp");
    report(&e.height, "Henyey and Greenstein: z within 2^-50");
    report(&e.drawn, "Henyey and Greenstein: g along with the point within 10 ulp");
    report(&e.given, "Henyey and Greenstein: g at it within 16 ulp");
    report(&e.back, "Henyey and Greenstein: back to u1 within 2^-50");
}

/* The law that the map is to have, by another way than the map: the textbook's distribution
 * function of the cosine, the phase function's integral, in the middle range of g. */
static void test_scatter_law(void)
{
    worst law = {0}, shape = {0};
    for (int k = -9; k < 10; k++)
        for (int j = 1; j < 100; j++) {
            if (k == 0)
                continue;
            const double g = 0.1 * k, u[2] = {0.01 * j, 0.25};
            const buffon_density at = buffon_henyey_greenstein(g, up);
            double x[3], pdf;
            if (buffon_density_sample(x, &pdf, u, 1, &at) != BUFFON_OK)
                law.share = INFINITY;
            const wide square = 1 + (wide)g * g - 2 * (wide)g * x[2];
            const wide above =
                (1 - (wide)g * g) / (2 * g) * (1 / (1 - (wide)g) - 1 / sqrtl(square));
            see_near(&law, u[0], above, 1e-14);
            see_near(&shape, pdf, (1 - (wide)g * g) / (4 * WIDE_PI * square * sqrtl(square)),
                     1e-13 * pdf);
        }
    report(&law, "Henyey and Greenstein: the share of directions above a point's height is u1");
    report(&shape, "Henyey and Greenstein: g is the phase function");
}

/* kappa of any size, with those where one formula hands over to another. */
static double any_kappa(buffon_rng *rng, int k)
{
    static const double special[] = {
        0,      0x1p-1074, 0x1p-54, 0x1.fffffffffffffp-55, 0.34657359027997264,
        18,     36.7,      37,      39.999999999999993,    40,
        0x1p900};
    const double v = buffon_rng_next(rng);
    switch (k % 4) {
    case 0:
        return special[buffon_rng_below(rng, sizeof special / sizeof *special)];
    case 1:
        return 50 * v;
    case 2:
        return ldexp(1 + v, (int)buffon_rng_below(rng, 100) - 50);
    default:
        return ldexp(1 + v, (int)buffon_rng_below(rng, 1900) - 1000);
    }
}

/* w from the nearer end, and 2 - w from the other. */
static void wide_fisher(wide *w, wide *rest, double kappa, double u)
{
    const wide v = 1 - (wide)u, y = v + u * expl(-2 * (wide)kappa);
    if (kappa < 0x1p-70) {
        *w = 2 * (wide)u;
        *rest = 2 * v;
        return;
    }
    const wide t = u * expm1l(-2 * (wide)kappa);
    *w = -(y < 0.5L ? logl(y) : log1pl(t)) / kappa;
    *rest = kappa < 1000 ? log1pl(v * expm1l(2 * (wide)kappa)) / kappa : 2 - *w;
    if (*rest < 0.01L)
        *w = 2 - *rest;
}

static void test_fisher(void)
{
    errors e = {0};
    buffon_rng rng = buffon_rng_make(2, 70);
    for (int k = 0; k < DRAWS; k++) {
        const double kappa = any_kappa(&rng, k);
        const buffon_density at = buffon_von_mises_fisher(kappa, up);
        double u[2];
        wide w, rest;
        grid_pair(u, &rng, k);
        const uint64_t room = kappa > 1 ? 940 - (uint64_t)ilogb(kappa) : 940;
        if (k % 5 == 1)
            u[0] = ldexp(u[0], -(int)buffon_rng_below(&rng, room));
        wide_fisher(&w, &rest, kappa, u[0]);
        const wide y = 1 - (wide)u[0] + u[0] * expl(-2 * (wide)kappa);
        const wide top = kappa < 0x1p-70 ? 0.5L : kappa / -expm1l(-2 * (wide)kappa);
        see_point(&e, &at, u, w, rest, y * top / (2 * WIDE_PI),
                  (const double[]){4, 0x1p-51, 4, 8 + 4 * (double)(kappa * w)});
    }
    report(&e.across, "von Mises and Fisher: x and y within 4 ulp");
    report(&e.height, "von Mises and Fisher: z within 2^-51");
    report(&e.drawn, "von Mises and Fisher: g along with the point within 4 ulp");
    report(&e.given, "von Mises and Fisher: g at it within 8 + 4 kappa w ulp");
    report(&e.back, "von Mises and Fisher: back to u1 within 2^-50");
}

/* Points far out, where the density itself is below the doubles. */
static void test_fisher_log(void)
{
    worst far = {0};
    int zero = 1;
    buffon_rng rng = buffon_rng_make(3, 70);
    for (int k = 0; k < 2000; k++) {
        const double kappa = 1 + 0x1p20 * buffon_rng_next(&rng), h = 2 * buffon_rng_next(&rng);
        const buffon_density at = buffon_von_mises_fisher(kappa, up);
        const double x[3] = {sqrt(h * (2 - h)), 0, 1 - h};
        double got, pdf;
        if (buffon_density_log_pdf(&got, x, 1, &at) != BUFFON_OK ||
            buffon_density_pdf(&pdf, x, 1, &at) != BUFFON_OK)
            far.share = INFINITY;
        const wide dx = x[0], dz = x[2] - 1.0L;
        const wide exact = logl(kappa / -expm1l(-2 * (wide)kappa) / (2 * WIDE_PI)) -
                           kappa * (dx * dx + dz * dz) / 2;
        see_near(&far, got, exact, 4 * ulp(fmaxl(fabsl(exact), kappa * (wide)h)) + 0x1p-50);
        zero &= exact > -740 || pdf == 0;
    }
    report(&far, "von Mises and Fisher: log g within 4 ulp of its larger term");
    tap_ok(zero, "and g is 0 where it is below all doubles");
}

/* ---- the circle ---- */

enum { NODES = 32 };

static wide node[NODES], weight[NODES];

/* Gauss's rule on (0, 1): the roots of Legendre's polynomial by Newton's method. */
static void make_nodes(void)
{
    for (int i = 0; i < NODES; i++) {
        wide z = cosl(WIDE_PI * (i + 0.75L) / (NODES + 0.5L)), slope = 1;
        for (int step = 0; step < 8; step++) {
            wide p = 1, before = 0;
            for (int j = 0; j < NODES; j++) {
                const wide next = ((2 * j + 1) * z * p - j * before) / (j + 1);
                before = p;
                p = next;
            }
            slope = NODES * (z * p - before) / (z * z - 1);
            z -= p / slope;
        }
        node[i] = (1 - z) / 2;
        weight[i] = 1 / ((1 - z * z) * slope * slope);
    }
}

static wide half_sine(wide x)
{
    const wide s = sinl(x / 2);
    return s * s;
}

/* The integral of exp(-2 kappa (sin^2(t/2) - square)) from a to b, cut in 12. */
static wide wide_bell(double kappa, wide a, wide b, wide square)
{
    const wide step = (b - a) / 12;
    wide sum = 0;
    for (int piece = 0; piece < 12; piece++)
        for (int j = 0; j < NODES; j++)
            sum += weight[j] * step *
                   expl(-2 * (wide)kappa * (half_sine(a + step * (piece + node[j])) - square));
    return sum;
}

/* The integral over the circle without the factor: by even points, or for large kappa over what is
 * not below exp(-60) of the peak. */
static wide wide_circle(double kappa)
{
    wide sum = 0;
    if (kappa > 100)
        return 2 * wide_bell(kappa, 0, 2 * asinl(sqrtl(30 / (wide)kappa)), 0);
    for (int i = 0; i < 256; i++)
        sum += expl(-2 * (wide)kappa * half_sine(2 * WIDE_PI * i / 256));
    return 2 * WIDE_PI * sum / 256;
}

/* How far x, beyond which lies the share p, is from where it should be: the missing mass over the
 * density. */
static wide mises_miss(double kappa, wide x, double p, wide whole)
{
    const wide square = half_sine(x),
               want = p * expl(kappa * square) * expl(kappa * square) * whole;
    if (p > 0.25)
        return wide_bell(kappa, 0, x, square) - (0.5L - p) / p * want;
    const wide end = square + 30 / (wide)kappa;
    return want - wide_bell(kappa, x, end < 1 ? 2 * asinl(sqrtl(end)) : WIDE_PI, square);
}

static void test_mises(void)
{
    worst found = {0}, density = {0}, back = {0};
    int mirrored = 1;
    buffon_rng rng = buffon_rng_make(6, 70);
    make_nodes();
    for (int k = 0; k < 3000; k++) {
        const double kappa = k % 2 ? any_kappa(&rng, k / 2) : ldexp(1, k % 32 - 8);
        const buffon_density g = buffon_von_mises(kappa, 0);
        const double v = 0.5 * grid(&rng, k),
                     p = k % 5 ? v : ldexp(v, -(int)buffon_rng_below(&rng, 1020));
        const double u[2] = {p, 1 - p};
        const wide whole = wide_circle(kappa);
        double x[2] = {NAN, NAN}, pdf[2] = {NAN, NAN}, again[2] = {NAN, NAN};
        if (buffon_density_sample(x, pdf, u, 2, &g) != BUFFON_OK ||
            buffon_density_invert(again, x, 2, &g) != BUFFON_OK)
            found.share = INFINITY;
        const wide y = 2 * (wide)kappa * half_sine(x[0]);
        see_near(&found, (double)mises_miss(kappa, -(wide)x[0], p, whole), 0, -0x1p-48 * x[0]);
        if (y < 700)
            see(&density, pdf[0], expl(-y) / whole, 8 + 12 * (double)y);
        /* The density of log p by x, times what is off in x. */
        see_near(&back, again[0], p, 0x1p-46 * (p + pdf[0] * -x[0]) + 0x1p-1060);
        see_near(&back, again[1], u[1], 0x1p-51 + 0x1p-46 * pdf[1] * fabs(x[1]));
        mirrored &= 1 - p < 0.5 + p || x[1] == -x[0] || 1 - (1 - p) != p;
    }
    report(&found, "von Mises: x within 2^-48 of itself");
    report(&density, "von Mises: g within 8 + 12 y ulp");
    report(&back, "von Mises: back to u");
    tap_ok(mirrored, "von Mises: points of u and 1 - u are mirrors");
}

/* With kappa = 1: E[cos] = I1(1) / I0(1), and g = exp(1) / (2 pi I0(1)) at the mean. */
static void test_mises_known(void)
{
    enum { POINTS = 4096 };
    static double u[POINTS], x[POINTS];
    const buffon_density g = buffon_von_mises(1, 0), even = buffon_von_mises(0, 5);
    const double mean[2] = {0, 5};
    double sum = 0, pdf[2] = {0};
    for (int i = 0; i < POINTS; i++)
        u[i] = (i + 0.5) / POINTS;
    int good = buffon_density_sample(x, NULL, u, POINTS, &g) == BUFFON_OK &&
               buffon_density_pdf(pdf, mean, 1, &g) == BUFFON_OK &&
               buffon_density_pdf(pdf + 1, mean + 1, 1, &even) == BUFFON_OK;
    for (int i = 0; i < POINTS; i++)
        sum += cos(x[i]);
    good &= fabs(sum / POINTS - 0.44638996589653450) < 1e-6;
    good &= fabs(pdf[0] / 0.34171048862346311 - 1) < 1e-14;
    good &= fabs(pdf[1] * 6.2831853071795865 - 1) < 1e-14;
    tap_ok(good, "von Mises: values that are known");
    tap_note("E[cos] off by %.3g, g by %.3g", sum / POINTS - 0.44638996589653450,
             pdf[0] / 0.34171048862346311 - 1);
}

/* Points keep their order, whatever their neighbours, and stay on the circle. */
static void test_mises_order(void)
{
    enum { POINTS = 4096 };
    static double u[POINTS], x[POINTS];
    int ordered = 1, inside = 1;
    for (int i = 0; i < POINTS; i++)
        u[i] = i == 0 ? 0x1p-1074 : i == POINTS - 1 ? 1 - 0x1p-53 : (double)i / POINTS;
    for (int k = 0; k < 40; k++) {
        const double kappa = k ? ldexp(1, k - 20) : 0, mean = k % 2 ? 1e6 : 0;
        const buffon_density g = buffon_von_mises(kappa, mean);
        if (buffon_density_sample(x, NULL, u, POINTS, &g) != BUFFON_OK)
            ordered = 0;
        for (int i = 0; i < POINTS; i++) {
            double pdf = 0;
            ordered &= i == 0 || x[i] >= x[i - 1];
            inside &= fabs(x[i] - mean) <= 3.1415926535897931 + 0x1p-50 * mean;
            inside &= buffon_density_pdf(&pdf, x + i, 1, &g) == BUFFON_OK && pdf > 0;
        }
    }
    tap_ok(ordered, "von Mises: points keep their order");
    tap_ok(inside, "von Mises: and stay within half a turn of the mean, with a density");
}

/* About any axis: unit vectors at the same angle from it, and back to the uniforms. */
static void test_turned(void)
{
    worst length = {0}, angle = {0}, back = {0};
    buffon_rng rng = buffon_rng_make(4, 70);
    for (int k = 0; k < DRAWS; k++) {
        double axis[3], u[2], x[3], y[3], v[2], scale = 0;
        buffon_rng_fill(axis, 3, &rng);
        for (int j = 0; j < 3; j++) {
            axis[j] = k % 3 ? axis[j] - 0.5 : j == k % 2 + 1 ? (k & 4 ? -1 : 1) : 0;
            scale += axis[j] * axis[j];
        }
        const double g = 2 * buffon_rng_next(&rng) - 1, kappa = 30 * buffon_rng_next(&rng);
        const buffon_density at =
            k & 1 ? buffon_henyey_greenstein(g, axis) : buffon_von_mises_fisher(kappa, axis);
        const buffon_density flat =
            k & 1 ? buffon_henyey_greenstein(g, up) : buffon_von_mises_fisher(kappa, up);
        grid_pair(u, &rng, k);
        if (buffon_density_sample(x, NULL, u, 1, &at) != BUFFON_OK ||
            buffon_density_sample(y, NULL, u, 1, &flat) != BUFFON_OK ||
            buffon_density_invert(v, x, 1, &at) != BUFFON_OK)
            length.share = INFINITY;
        see_near(&length, sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]), 1, 0x1p-49);
        see_near(&angle, (x[0] * axis[0] + x[1] * axis[1] + x[2] * axis[2]) / sqrt(scale), y[2],
                 0x1p-50);
        /* A chord is known to 2^-52; at an angle t from the axis the density of u1 by the angle is
         * at most 2 pi sin t times that by solid angle. */
        double pdf;
        if (buffon_density_pdf(&pdf, x, 1, &at) == BUFFON_OK)
            see_near(&back, v[0], u[0],
                     0x1p-50 * (1 + 2 * 3.15 * pdf * sqrt(1 - fmin(1, y[2] * y[2]))));
    }
    report(&length, "turned points are unit vectors");
    report(&angle, "turned points have their angle from the axis");
    report(&back, "and go back to u1");
}

/* E[cos] is g, and coth(kappa) - 1 / kappa. */
static void test_means(void)
{
    enum { POINTS = 1 << 16 };
    static double u[2 * POINTS], x[3 * POINTS];
    const buffon_points sobol = buffon_points_sobol(BUFFON_SCRAMBLE_NONE);
    buffon_points_block block = {.n = POINTS, .dim = 2};
    static double table[1024];
    worst mean = {0};
    block.table = table;
    tap_ok(sobol.table_size(2, &sobol) <= sizeof table && sobol.prepare(&block, &sobol) == 0 &&
               sobol.fill(u, &block, &sobol) == 0,
           "even points");
    for (int k = 0; k < 12; k++) {
        const double g = -0.95 + 0.17 * k, kappa = ldexp(1, k - 6);
        const buffon_density law[2] = {buffon_henyey_greenstein(g, up),
                                       buffon_von_mises_fisher(kappa, up)};
        const double exact[2] = {g, 1 / tanh(kappa) - 1 / kappa};
        for (int m = 0; m < 2; m++) {
            double sum = 0;
            if (buffon_density_sample(x, NULL, u, POINTS, &law[m]) != BUFFON_OK)
                mean.share = INFINITY;
            for (size_t i = 0; i < POINTS; i++)
                sum += x[2 * POINTS + i];
            see_near(&mean, sum / POINTS, exact[m], 2e-4);
        }
    }
    report(&mean, "mean cosines are g and coth(kappa) - 1 / kappa");
}

/* Without a preference both are the sphere. */
static void test_sphere(void)
{
    const buffon_density sphere = buffon_sphere();
    const buffon_density law[2] = {buffon_henyey_greenstein(0, up), buffon_von_mises_fisher(0, up)};
    int same = 1;
    buffon_rng rng = buffon_rng_make(5, 70);
    for (int k = 0; k < 1000; k++) {
        double u[2], x[3], y[3], p, q;
        grid_pair(u, &rng, k);
        for (int m = 0; m < 2; m++) {
            same &= buffon_density_sample(x, &p, u, 1, &sphere) == BUFFON_OK &&
                    buffon_density_sample(y, &q, u, 1, &law[m]) == BUFFON_OK;
            for (int j = 0; j < 3; j++)
                same &= fabs(x[j] - y[j]) <= 0x1p-52;
            same &= fabs(q - p) <= 0x1p-54;
        }
    }
    tap_ok(same, "with g = 0, or kappa = 0, they are the sphere");
}

static void test_refusals(void)
{
    static const double no_axis[3] = {0, 0, 0}, no_number[3] = {0, NAN, 1};
    static const double no_g[] = {1, -1, 1.5, -7, NAN, INFINITY, -INFINITY};
    static const double no_kappa[] = {-1,       -0x1p-1074, NAN,
                                      INFINITY, -INFINITY,  0x1.0000000000001p900};
    for (size_t k = 0; k < sizeof no_g / sizeof *no_g; k++)
        refused_by_value(buffon_henyey_greenstein(no_g[k], up), BUFFON_E_SHAPE, "g");
    for (size_t k = 0; k < sizeof no_kappa / sizeof *no_kappa; k++)
        refused_by_value(buffon_von_mises_fisher(no_kappa[k], up), BUFFON_E_SHAPE, "kappa");
    for (size_t k = 0; k < sizeof no_kappa / sizeof *no_kappa; k++)
        refused_by_value(buffon_von_mises(no_kappa[k], 0), BUFFON_E_SHAPE, "kappa");
    refused_by_value(buffon_von_mises(1, NAN), BUFFON_E_SHAPE, "a mean of NaN");
    refused_by_value(buffon_von_mises(1, -0x1.0000000000001p40), BUFFON_E_SHAPE, "a mean far off");
    refused_by_value(buffon_henyey_greenstein(0.5, NULL), BUFFON_E_NULL, "no axis");
    refused_by_value(buffon_von_mises_fisher(2, NULL), BUFFON_E_NULL, "no axis");
    refused_by_value(buffon_henyey_greenstein(0.5, no_axis), BUFFON_E_SHAPE, "an axis of 0");
    refused_by_value(buffon_von_mises_fisher(2, no_number), BUFFON_E_SHAPE, "an axis of NaN");
    const buffon_density law[2] = {buffon_henyey_greenstein(0.9, up),
                                   buffon_von_mises_fisher(3, up)};
    const double off[4][3] = {{0, 0, 1.1}, {0, 0, 0}, {NAN, 0, 1}, {0, 0, -1 + 0x1p-10}};
    int outside = 1;
    for (int m = 0; m < 2; m++)
        for (int k = 0; k < 4; k++) {
            double pdf;
            outside &= buffon_density_pdf(&pdf, off[k], 1, &law[m]) == BUFFON_OK && pdf == 0;
        }
    tap_ok(outside, "no density off the sphere");
}

int main(void)
{
    if (have_wide()) {
        test_scatter();
        test_scatter_law();
        test_fisher();
        test_fisher_log();
        test_mises();
    } else {
        tap_ok(1, "formulas # SKIP long double is no wider than double");
    }
    test_mises_known();
    test_mises_order();
    test_turned();
    test_means();
    test_sphere();
    test_refusals();
    return tap_done();
}
