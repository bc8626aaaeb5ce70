/* Laws on the line whose densities are straight lines: from end to end, or up and down again. */
#include "guard.h"

#include <float.h>
#include <math.h>

#include <buffon/laws.h>

#include "density_priv.h"
#include "elementary.h"
#include "ramp.h"

static buffon_status linear_check(double lo, double hi)
{
    const double width = hi - lo;
    return width >= 0x1p-1020 && buffon_priv_isfinite(width) ? BUFFON_OK : BUFFON_E_DOMAIN;
}

/* ---- from end to end ---------------------------------------------------------------------- */

/* `param`: lo, hi, the heights at the ends as shares of their sum, hi - lo. */
enum { LINEAR_LO, LINEAR_HI, LINEAR_A, LINEAR_B, LINEAR_WIDTH };

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

/* With heights of the sum 1: low = t / (a + h) and high = (1 - t) / (b + h), h the height at the
 * point of t. Squares of small heights and small u are kept in range by a power of two.
 *
 * The pdf is that of the point as it was rounded, so that f / g is smooth where f goes to zero with
 * g at an end. */
static int linear_sample(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    const double *p = g->param, lo = p[LINEAR_LO], hi = p[LINEAR_HI], width = p[LINEAR_WIDTH];
    const double a = p[LINEAR_A], b = p[LINEAR_B], base[] = {lo, hi};
    double least, most;
    density_inner(&least, &most, lo, hi);
    for (size_t i = 0; i < n; i++) {
        const double up = u[i] < 0x1p-500 ? 0x1p400 : 1, rest = 1 - u[i];
        const double height = ramp_height(a * up, b * up, u[i], rest) / up;
        const double s = u[i] * up / (a + height), c = rest / (b + height);
        const double low = width < 1 ? s * width / up : width / up * s, high = c * width;
        double way;
        const size_t end = ramp_end(&way, low, high);
        x[i] = density_held(base[end] + way, least, most);
    }
    return pdf ? linear_pdf(pdf, x, n, g) : 0;
}

static int linear_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    const double *p = g->param, width = p[LINEAR_WIDTH];
    for (size_t i = 0; i < n; i++) {
        const double at = density_held(x[i], p[LINEAR_LO], p[LINEAR_HI]);
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
    g.status = linear_check(lo, hi);
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
    double least, most;
    density_inner(&least, &most, lo, hi);
    for (size_t i = 0; i < n; i++) {
        const double gap = p[TRIANGLE_BELOW] - u[i];
        int inner;
        double away;
        if (gap > 0) {
            away = triangular_away(&inner, u[i], gap, p[TRIANGLE_A], p[TRIANGLE_BELOW]);
            x[i] = density_held(inner ? mode - away : lo + away, least, most);
        } else {
            away = triangular_away(&inner, 1 - u[i], -gap, p[TRIANGLE_B], p[TRIANGLE_ABOVE]);
            x[i] = density_held(inner ? mode + away : hi - away, least, most);
        }
    }
    return pdf ? triangular_pdf(pdf, x, n, g) : 0;
}

static int triangular_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    const double *p = g->param;
    for (size_t i = 0; i < n; i++) {
        const double at = density_held(x[i], p[TRIANGLE_LO], p[TRIANGLE_HI]);
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
    g.status = linear_check(lo, hi);
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
