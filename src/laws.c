/* Laws of a mean and a scale by inversion: Laplace's, the logistic and Cauchy's. */
#include "guard.h"

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

/* exp(-share z), z = |x - mean| / scale. */
static void laws_fall(double *fall, const double *x, double share, size_t n,
                      const buffon_density *g)
{
    laws_size(fall, x, n, g);
    for (size_t i = 0; i < n; i++)
        fall[i] *= -share;
    buffon_math_exp(fall, fall, n);
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

/* By exp(-z / 2), whose square divided by the scale does not leave the doubles before it must. */
static int laplace_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    laws_fall(pdf, x, 0.5, n, g);
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
    laws_fall(u, x, 1, n, g);
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
    laws_fall(pdf, x, 0.5, n, g);
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
    laws_fall(u, x, 1, n, g);
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
