#include "guard.h"

#include <float.h>
#include <math.h>

#include <buffon/exponential.h>

#include "density_priv.h"
#include "elementary.h"

#define KERNELS "exponential_lanes.h"
#include "levels.h"

/* `param` is the mean. */

static int exponential_draw(double *x, double *pdf, const double *u, size_t n,
                            const buffon_density *g)
{
    LEVELS_RUN(exponential_map, (x, pdf, u, n, g->param[0]));
    return 0;
}

static int exponential_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    LEVELS_RUN(exponential_at, (pdf, x, n, g->param[0]));
    return 0;
}

static int exponential_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    const double mean = g->param[0], log_mean = buffon_priv_log(mean);
    for (size_t i = 0; i < n; i++)
        log_pdf[i] = x[i] >= 0 ? -x[i] / mean - log_mean : -(double)INFINITY;
    return 0;
}

static int exponential_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    LEVELS_RUN(exponential_level, (u, x, n, g->param[0]));
    for (size_t i = 0; i < n; i++)
        u[i] = density_inside(u[i]);
    return 0;
}

static const buffon_density_ops exponential_ops = {.sample = exponential_draw,
                                                   .pdf = exponential_pdf,
                                                   .log_pdf = exponential_log_pdf,
                                                   .invert = exponential_invert,
                                                   .name = "buffon.exponential"};

buffon_density buffon_exponential(double mean)
{
    buffon_density g = {.uniforms = 1, .dim = 1, .ops = &exponential_ops};
    if (mean >= DBL_MIN && mean <= 0x1p1017)
        g.param[0] = mean;
    else
        g.status = BUFFON_E_SHAPE;
    return g;
}
