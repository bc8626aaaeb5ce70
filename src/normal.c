#include "guard.h"

#include <float.h>
#include <math.h>

#include <buffon/math.h>
#include <buffon/normal.h>

#include "density_priv.h"
#include "elementary.h"

#define KERNELS "normal_lanes.h"
#include "levels.h"

/* `param`: the mean and the standard deviation. */

static int normal_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    buffon_math_normal_quantile(x, u, n);
    LEVELS_RUN(normal_map, (x, pdf, n, g->param[0], g->param[1]));
    return 0;
}

static int normal_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    LEVELS_RUN(normal_at, (pdf, x, n, g->param[0], g->param[1]));
    return 0;
}

static int normal_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    const double rest = DENSITY_LOG_SQRT_2PI + buffon_priv_log(g->param[1]);
    for (size_t i = 0; i < n; i++) {
        const double z = (x[i] - g->param[0]) / g->param[1];
        log_pdf[i] = z == z ? -0.5 * z * z - rest : -(double)INFINITY;
    }
    return 0;
}

static int normal_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++)
        u[i] = (x[i] - g->param[0]) / g->param[1];
    buffon_math_normal_cdf(u, u, n);
    for (size_t i = 0; i < n; i++)
        u[i] = density_inside(u[i]);
    return 0;
}

static const buffon_density_ops normal_ops = {.sample = normal_draw,
                                              .pdf = normal_pdf,
                                              .log_pdf = normal_log_pdf,
                                              .invert = normal_invert,
                                              .name = "buffon.normal"};

buffon_density buffon_normal(double mean, double sd)
{
    buffon_density g = {.uniforms = 1, .dim = 1, .ops = &normal_ops};
    if (buffon_priv_abs(mean) <= 0x1p1022 && sd >= DBL_MIN && sd <= 0x1p1017) {
        g.param[0] = mean;
        g.param[1] = sd;
    } else {
        g.status = BUFFON_E_SHAPE;
    }
    return g;
}
