/* The lognormal law: that of exp(mu + sigma z), z a normal variate. */
#include "guard.h"

#include <float.h>
#include <math.h>

#include <buffon/math.h>
#include <buffon/normal.h>

#include "density_priv.h"
#include "elementary.h"
#include "pair_math.h"

/* `param`: mu, sigma. */

/* z of x, and log x. */
static double lognormal_place(double *log_x, double x, const buffon_density *g)
{
    const pair only = {x, 0}, log_of = pair_log(only);
    *log_x = log_of.hi;
    return ((log_of.hi - g->param[0]) + log_of.lo) / g->param[1];
}

static int lognormal_holds(double x)
{
    return x > 0 && x <= DBL_MAX;
}

static double lognormal_at(double x, double z, const buffon_density *g)
{
    return buffon_priv_exp(-0.5 * z * z) * DENSITY_INV_SQRT_2PI / g->param[1] / x;
}

/* Tiny u may lead below the doubles, and where x has lost digits g is that at x. */
static int lognormal_sample(double *x, double *pdf, const double *u, size_t n,
                            const buffon_density *g)
{
    const double mu = g->param[0], sigma = g->param[1];
    buffon_math_normal_quantile(x, u, n);
    for (size_t i = 0; i < n; i++) {
        const pair shift = pair_product(sigma, x[i]), sum = pair_sum(mu, shift.hi);
        const pair all = pair_sum(sum.hi, sum.lo + shift.lo);
        const double z = x[i];
        double log_x;
        x[i] = pair_exp(all, 1);
        x[i] = x[i] > 0 ? x[i] : 0x1p-1074;
        if (pdf)
            pdf[i] = lognormal_at(x[i], x[i] < DBL_MIN ? lognormal_place(&log_x, x[i], g) : z, g);
    }
    return 0;
}

static int lognormal_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++) {
        double log_x;
        pdf[i] =
            lognormal_holds(x[i]) ? lognormal_at(x[i], lognormal_place(&log_x, x[i], g), g) : 0;
    }
    return 0;
}

static int lognormal_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    const double rest = DENSITY_LOG_SQRT_2PI + buffon_priv_log(g->param[1]);
    for (size_t i = 0; i < n; i++) {
        log_pdf[i] = -(double)INFINITY;
        if (lognormal_holds(x[i])) {
            double log_x;
            const double z = lognormal_place(&log_x, x[i], g);
            log_pdf[i] = -0.5 * z * z - log_x - rest;
        }
    }
    return 0;
}

static int lognormal_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++) {
        double log_x;
        u[i] = lognormal_holds(x[i]) ? buffon_priv_normal_cdf(lognormal_place(&log_x, x[i], g))
                                     : x[i] > 0;
        u[i] = density_inside(u[i]);
    }
    return 0;
}

static const buffon_density_ops lognormal_ops = {.sample = lognormal_sample,
                                                 .pdf = lognormal_pdf,
                                                 .log_pdf = lognormal_log_pdf,
                                                 .invert = lognormal_invert,
                                                 .name = "buffon.lognormal"};

buffon_density buffon_lognormal(double mu, double sigma)
{
    buffon_density g = {.uniforms = 1, .dim = 1, .ops = &lognormal_ops};
    if (sigma >= 0x1p-60 && buffon_priv_abs(mu) + 9 * sigma <= 650) {
        g.param[0] = mu;
        g.param[1] = sigma;
    } else {
        g.status = BUFFON_E_SHAPE;
    }
    return g;
}
