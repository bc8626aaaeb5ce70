/* Laws on the line by inversion: straight lines, and laws of a mean and a scale. */
#include "guard.h"

#include <float.h>
#include <math.h>

#include <buffon/laws.h>
#include <buffon/math.h>

#include "density_priv.h"
#include "elementary.h"

#define LAWS_MOST_MEAN 0x1p1000
#define LAWS_LEAST_SCALE 0x1p-900
#define LAWS_MOST_SCALE 0x1p900
#define LAWS_LOG_PI 0x1.250d048e7a1bdp+0
#define LAWS_LOG_2 0x1.62e42fefa39efp-1

static buffon_status laws_check_interval(double lo, double hi)
{
    const double width = hi - lo;
    return width >= 0x1p-1020 && buffon_priv_isfinite(width) ? BUFFON_OK : BUFFON_E_DOMAIN;
}

/* The nearest point of an interval, from which points outside are taken back. */
static double laws_held(double x, double lo, double hi)
{
    return x < lo ? lo : x > hi ? hi : x;
}

/* ---- straight lines ----------------------------------------------------------------------- */

/* `param`: lo, hi, the heights at the ends as shares of their sum, hi - lo. */
enum { LINEAR_LO, LINEAR_HI, LINEAR_A, LINEAR_B, LINEAR_WIDTH };

/* The distance of the point of u from an end, for heights a there and b at the other with
 * a + b = 1. Squares of small heights and small u are kept in range by a power of two. */
static double laws_linear_place(double u, double rest, double a, double b, double width)
{
    const double up = u < 0x1p-500 ? 0x1p400 : 1, c = a * up, d = b * up;
    const double t = u * up / (a + sqrt(c * c * rest + d * d * u) / up);
    return width < 1 ? t * width / up : width / up * t;
}

static int linear_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const double *p = g->param, width = p[LINEAR_WIDTH];
    for (size_t i = 0; i < n; i++) {
        const double low = x[i] - p[LINEAR_LO], high = p[LINEAR_HI] - x[i];
        const double height = 2 * (p[LINEAR_A] * (high / width) + p[LINEAR_B] * (low / width));
        pdf[i] = low >= 0 && high >= 0 ? height / width : 0;
    }
    return 0;
}

/* The pdf is that of the point as it was rounded, so that f / g is smooth where f goes to zero with
 * g at an end. */
static int linear_sample(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    const double *p = g->param, lo = p[LINEAR_LO], hi = p[LINEAR_HI], width = p[LINEAR_WIDTH];
    for (size_t i = 0; i < n; i++) {
        const double low = laws_linear_place(u[i], 1 - u[i], p[LINEAR_A], p[LINEAR_B], width);
        const double high = laws_linear_place(1 - u[i], u[i], p[LINEAR_B], p[LINEAR_A], width);
        x[i] = density_between(low < high ? lo + low : hi - high, lo, hi);
    }
    return pdf ? linear_pdf(pdf, x, n, g) : 0;
}

static int linear_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    const double *p = g->param, width = p[LINEAR_WIDTH];
    for (size_t i = 0; i < n; i++) {
        const double at = laws_held(x[i], p[LINEAR_LO], p[LINEAR_HI]);
        const double low = (at - p[LINEAR_LO]) / width, high = (p[LINEAR_HI] - at) / width;
        u[i] = density_inside(low * (p[LINEAR_A] * (1 + high) + p[LINEAR_B] * low));
    }
    return 0;
}

static const buffon_density_ops linear_ops = {
    .sample = linear_sample, .pdf = linear_pdf, .invert = linear_invert, .name = "buffon.linear"};

buffon_density buffon_linear(double lo, double hi, double at_lo, double at_hi)
{
    buffon_density g = {.uniforms = 1, .dim = 1, .ops = &linear_ops};
    const double most = at_lo > at_hi ? at_lo : at_hi;
    g.status = laws_check_interval(lo, hi);
    if (g.status == BUFFON_OK && !(at_lo >= 0 && at_hi >= 0 && most > 0 && most <= DBL_MAX))
        g.status = BUFFON_E_SHAPE;
    if (g.status == BUFFON_OK) {
        const double a = at_lo / most, b = at_hi / most;
        g.param[LINEAR_LO] = lo;
        g.param[LINEAR_HI] = hi;
        g.param[LINEAR_A] = a / (a + b);
        g.param[LINEAR_B] = b / (a + b);
        g.param[LINEAR_WIDTH] = hi - lo;
    }
    return g;
}

/* ---- triangles ---------------------------------------------------------------------------- */

/* `param`: the corners; the widths of the two sides and of the whole; the probability of each. */
enum {
    TRIANGLE_LO,
    TRIANGLE_MODE,
    TRIANGLE_HI,
    TRIANGLE_A,
    TRIANGLE_B,
    TRIANGLE_WIDTH,
    TRIANGLE_BELOW,
    TRIANGLE_ABOVE
};

static int triangular_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const double *p = g->param, peak = 2 / p[TRIANGLE_WIDTH];
    for (size_t i = 0; i < n; i++) {
        const int below = x[i] < p[TRIANGLE_MODE];
        const double side = below ? p[TRIANGLE_A] : p[TRIANGLE_B];
        const double away = below ? x[i] - p[TRIANGLE_LO] : p[TRIANGLE_HI] - x[i];
        const double share = side > 0 ? away / side : 1;
        pdf[i] = away >= 0 ? peak * (share < 1 ? share : 1) : 0;
    }
    return 0;
}

/* How far from its outer end, or with *inner from the mode, a side of width `side` and probability
 * `all` has its share v: v / all = (away / side)^2. `short_of` is all - v. */
static double triangular_away(int *inner, double v, double short_of, double side, double all)
{
    const double root = v < 0x1p-900 ? 0x1p-100 * sqrt(v * 0x1p200 / all) : sqrt(v / all);
    *inner = root > 0.5;
    return *inner ? side * (short_of / (all * (1 + root))) : side * root;
}

static int triangular_sample(double *x, double *pdf, const double *u, size_t n,
                             const buffon_density *g)
{
    const double *p = g->param, lo = p[TRIANGLE_LO], mode = p[TRIANGLE_MODE], hi = p[TRIANGLE_HI];
    for (size_t i = 0; i < n; i++) {
        const double gap = p[TRIANGLE_BELOW] - u[i];
        int inner;
        double away;
        if (gap > 0) {
            away = triangular_away(&inner, u[i], gap, p[TRIANGLE_A], p[TRIANGLE_BELOW]);
            x[i] = density_between(inner ? mode - away : lo + away, lo, hi);
        } else {
            away = triangular_away(&inner, 1 - u[i], -gap, p[TRIANGLE_B], p[TRIANGLE_ABOVE]);
            x[i] = density_between(inner ? mode + away : hi - away, lo, hi);
        }
    }
    return pdf ? triangular_pdf(pdf, x, n, g) : 0;
}

static int triangular_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    const double *p = g->param;
    for (size_t i = 0; i < n; i++) {
        const double at = laws_held(x[i], p[TRIANGLE_LO], p[TRIANGLE_HI]);
        const double low = (at - p[TRIANGLE_LO]) / p[TRIANGLE_A];
        const double past = (at - p[TRIANGLE_MODE]) / p[TRIANGLE_B];
        const double high = (p[TRIANGLE_HI] - at) / p[TRIANGLE_B];
        const double above = p[TRIANGLE_B] > 0 ? p[TRIANGLE_ABOVE] * (past * (1 + high)) : 0;
        const double v =
            at < p[TRIANGLE_MODE] ? p[TRIANGLE_BELOW] * low * low : p[TRIANGLE_BELOW] + above;
        u[i] = density_inside(v);
    }
    return 0;
}

static const buffon_density_ops triangular_ops = {.sample = triangular_sample,
                                                  .pdf = triangular_pdf,
                                                  .invert = triangular_invert,
                                                  .name = "buffon.triangular"};

buffon_density buffon_triangular(double lo, double mode, double hi)
{
    buffon_density g = {.uniforms = 1, .dim = 1, .ops = &triangular_ops};
    g.status = laws_check_interval(lo, hi);
    if (!(lo <= mode && mode <= hi))
        g.status = BUFFON_E_DOMAIN;
    if (g.status == BUFFON_OK) {
        g.param[TRIANGLE_LO] = lo;
        g.param[TRIANGLE_MODE] = mode;
        g.param[TRIANGLE_HI] = hi;
        g.param[TRIANGLE_A] = mode - lo;
        g.param[TRIANGLE_B] = hi - mode;
        g.param[TRIANGLE_WIDTH] = hi - lo;
        g.param[TRIANGLE_BELOW] = (mode - lo) / (hi - lo);
        g.param[TRIANGLE_ABOVE] = (hi - mode) / (hi - lo);
    }
    return g;
}

buffon_density buffon_tent(double centre, double radius)
{
    const double lo = centre - radius, hi = centre + radius;
    buffon_density g = buffon_triangular(lo, centre, hi);
    if (!(radius >= 0x1p-1020 && radius <= 0x1p1020)) {
        g.status = BUFFON_E_SHAPE;
    } else if (g.status == BUFFON_OK && lo < centre && centre < hi) {
        g.param[TRIANGLE_A] = g.param[TRIANGLE_B] = radius;
        g.param[TRIANGLE_WIDTH] = 2 * radius;
        g.param[TRIANGLE_BELOW] = g.param[TRIANGLE_ABOVE] = 0.5;
    } else {
        g.status = BUFFON_E_DOMAIN;
    }
    return g;
}

/* ---- laws of a mean and a scale ----------------------------------------------------------- */

static buffon_density laws_make(double mean, double scale, const buffon_density_ops *ops)
{
    buffon_density g = {.uniforms = 1, .dim = 1, .ops = ops};
    if (buffon_priv_abs(mean) <= LAWS_MOST_MEAN && scale >= LAWS_LEAST_SCALE &&
        scale <= LAWS_MOST_SCALE) {
        g.param[0] = mean;
        g.param[1] = scale;
    } else {
        g.status = BUFFON_E_SHAPE;
    }
    return g;
}

/* |x - mean| / scale. */
static void laws_size(double *z, const double *x, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++)
        z[i] = buffon_priv_abs(x[i] - g->param[0]) / g->param[1];
}

/* exp(-z / 2), whose square divided by the scale does not leave the doubles before it must. */
static void laws_halves(double *z, size_t n)
{
    for (size_t i = 0; i < n; i++)
        z[i] *= -0.5;
    buffon_math_exp(z, z, n);
}

/* 0 for a NaN. */
static double laws_number(double pdf)
{
    return pdf == pdf ? pdf : 0;
}

/* The smaller of u and 1 - u, which is exact there. */
static double laws_nearer(double u)
{
    return u < 0.5 ? u : 1 - u;
}

static int laplace_sample(double *x, double *pdf, const double *u, size_t n,
                          const buffon_density *g)
{
    const double mean = g->param[0], scale = g->param[1];
    for (size_t i = 0; i < n; i++)
        x[i] = 2 * laws_nearer(u[i]);
    buffon_math_log(x, x, n);
    for (size_t i = 0; i < n; i++)
        x[i] = u[i] < 0.5 ? mean + scale * x[i] : mean - scale * x[i];
    for (size_t i = 0; pdf && i < n; i++)
        pdf[i] = laws_nearer(u[i]) / scale;
    return 0;
}

static int laplace_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    laws_size(pdf, x, n, g);
    laws_halves(pdf, n);
    for (size_t i = 0; i < n; i++)
        pdf[i] = laws_number(0.5 * pdf[i] * (pdf[i] / g->param[1]));
    return 0;
}

static int laplace_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    const double rest = LAWS_LOG_2 + buffon_priv_log(g->param[1]);
    laws_size(log_pdf, x, n, g);
    for (size_t i = 0; i < n; i++)
        log_pdf[i] = log_pdf[i] == log_pdf[i] ? -log_pdf[i] - rest : -(double)INFINITY;
    return 0;
}

static int laplace_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    laws_size(u, x, n, g);
    for (size_t i = 0; i < n; i++)
        u[i] = -u[i];
    buffon_math_exp(u, u, n);
    for (size_t i = 0; i < n; i++)
        u[i] = density_inside(x[i] < g->param[0] ? 0.5 * u[i] : 1 - 0.5 * u[i]);
    return 0;
}

static const buffon_density_ops laplace_ops = {.sample = laplace_sample,
                                               .pdf = laplace_pdf,
                                               .log_pdf = laplace_log_pdf,
                                               .invert = laplace_invert,
                                               .name = "buffon.laplace"};

buffon_density buffon_laplace(double mean, double scale)
{
    return laws_make(mean, scale, &laplace_ops);
}

/* With v the smaller of u and 1 - u: log((1 - v) / v) = log1p((1 - 2 v) / v), whose argument is
 * good to 1 ulp; the quotient must not overflow. */
static int logistic_sample(double *x, double *pdf, const double *u, size_t n,
                           const buffon_density *g)
{
    const double mean = g->param[0], scale = g->param[1];
    for (size_t i = 0; i < n; i++) {
        const double v = laws_nearer(u[i]), held = v < 0x1p-1000 ? 0x1p-1000 : v;
        x[i] = (1 - 2 * held) / held;
    }
    buffon_math_log1p(x, x, n);
    for (size_t i = 0; i < n; i++) {
        const double z = u[i] < 0x1p-1000 ? -buffon_priv_log(u[i]) : x[i];
        x[i] = u[i] < 0.5 ? mean - scale * z : mean + scale * z;
    }
    for (size_t i = 0; pdf && i < n; i++)
        pdf[i] = u[i] * (1 - u[i]) / scale;
    return 0;
}

static int logistic_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    laws_size(pdf, x, n, g);
    laws_halves(pdf, n);
    for (size_t i = 0; i < n; i++) {
        const double one = 1 + pdf[i] * pdf[i];
        pdf[i] = laws_number(pdf[i] * (pdf[i] / g->param[1]) / (one * one));
    }
    return 0;
}

static int logistic_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    const double rest = buffon_priv_log(g->param[1]);
    laws_size(log_pdf, x, n, g);
    for (size_t i = 0; i < n; i++) {
        const double z = log_pdf[i], far = 2 * buffon_priv_log1p(buffon_priv_exp(-z));
        log_pdf[i] = z == z ? -z - far - rest : -(double)INFINITY;
    }
    return 0;
}

static int logistic_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    laws_size(u, x, n, g);
    for (size_t i = 0; i < n; i++)
        u[i] = -u[i];
    buffon_math_exp(u, u, n);
    for (size_t i = 0; i < n; i++)
        u[i] = density_inside((x[i] < g->param[0] ? u[i] : 1) / (1 + u[i]));
    return 0;
}

static const buffon_density_ops logistic_ops = {.sample = logistic_sample,
                                                .pdf = logistic_pdf,
                                                .log_pdf = logistic_log_pdf,
                                                .invert = logistic_invert,
                                                .name = "buffon.logistic"};

buffon_density buffon_logistic(double mean, double scale)
{
    return laws_make(mean, scale, &logistic_ops);
}

/* ---- Cauchy ------------------------------------------------------------------------------- */

/* sin and cos of pi u keep their digits near their zeros, at 0, 1/2 and 1. A tile of cosines. */
enum { CAUCHY_TILE = 256 };

static int cauchy_sample(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    const double centre = g->param[0], scale = g->param[1], peak = DENSITY_INV_PI / scale;
    double c[CAUCHY_TILE];
    for (size_t i = 0; i < n; i += CAUCHY_TILE) {
        const size_t m = n - i < CAUCHY_TILE ? n - i : CAUCHY_TILE;
        buffon_math_sincospi(x + i, c, u + i, m);
        for (size_t k = 0; k < m; k++) {
            const double s = x[i + k], v = u[i + k];
            const double far = v < 0x1p-900 ? scale * DENSITY_INV_PI / v : scale * c[k] / s;
            const double y = centre - far;
            if (pdf)
                pdf[i + k] = peak * s * s;
            x[i + k] = y < -0x1p1023 ? -0x1p1023 : y;
        }
    }
    return 0;
}

/* Far out with r = scale / |x - centre|, where z^2 might overflow. */
static int cauchy_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const double scale = g->param[1], peak = DENSITY_INV_PI / scale;
    for (size_t i = 0; i < n; i++) {
        const double d = buffon_priv_abs(x[i] - g->param[0]);
        const double z = d / scale, r = scale / d;
        const double far = DENSITY_INV_PI * (r / d) / (1 + r * r);
        pdf[i] = laws_number(d <= scale ? peak / (1 + z * z) : far);
    }
    return 0;
}

static int cauchy_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    const double scale = g->param[1], log_scale = buffon_priv_log(scale);
    for (size_t i = 0; i < n; i++) {
        const double d = buffon_priv_abs(x[i] - g->param[0]), z = d / scale, r = scale / d;
        if (d <= scale)
            log_pdf[i] = -buffon_priv_log1p(z * z) - (log_scale + LAWS_LOG_PI);
        else if (d > scale)
            log_pdf[i] =
                log_scale - 2 * buffon_priv_log(d) - LAWS_LOG_PI - buffon_priv_log1p(r * r);
        else
            log_pdf[i] = -(double)INFINITY;
    }
    return 0;
}

/* The angle of (-(x - centre), scale): pi u. */
static int cauchy_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++)
        u[i] = density_inside(buffon_priv_atan2pi(g->param[1], g->param[0] - x[i]));
    return 0;
}

static const buffon_density_ops cauchy_ops = {.sample = cauchy_sample,
                                              .pdf = cauchy_pdf,
                                              .log_pdf = cauchy_log_pdf,
                                              .invert = cauchy_invert,
                                              .name = "buffon.cauchy"};

buffon_density buffon_cauchy(double centre, double scale)
{
    return laws_make(centre, scale, &cauchy_ops);
}
