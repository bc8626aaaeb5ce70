#include "guard.h"

#include <float.h>
#include <math.h>

#include <buffon/beta.h>

#include "density_priv.h"
#include "elementary.h"
#include "incomplete.h"

/* `param`: a, b. The law in its working form is made once for each batch. */

static int beta_inside(double x)
{
    return x > 0 && x < 1;
}

static double beta_pdf_at(const buffon_priv_beta *law, double x)
{
    if (!beta_inside(x))
        return 0;
    const double log_d = buffon_priv_beta_log_density(law, x), y = 1 - x;
    return log_d > -700 ? buffon_priv_exp(log_d) / (x * y)
                        : buffon_priv_exp(log_d - (buffon_priv_log(x) + buffon_priv_log1p(-x)));
}

static double beta_point(const buffon_priv_beta *law, double u)
{
    const double x = buffon_priv_beta_quantile(law, u, 1 - u, (double)NAN).x;
    return x < DBL_MIN ? DBL_MIN : x > 1 - 0x1p-53 ? 1 - 0x1p-53 : x;
}

static int beta_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    buffon_priv_beta law;
    buffon_priv_beta_make(&law, g->param[0], g->param[1]);
    buffon_priv_beta_prepare(&law);
    for (size_t i = 0; i < n; i++) {
        x[i] = beta_point(&law, density_inside(u[i]));
        if (pdf)
            pdf[i] = beta_pdf_at(&law, x[i]);
    }
    return 0;
}

static int beta_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    buffon_priv_beta law;
    buffon_priv_beta_make(&law, g->param[0], g->param[1]);
    for (size_t i = 0; i < n; i++)
        pdf[i] = beta_pdf_at(&law, x[i]);
    return 0;
}

static int beta_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    buffon_priv_beta law;
    buffon_priv_beta_make(&law, g->param[0], g->param[1]);
    for (size_t i = 0; i < n; i++)
        log_pdf[i] = beta_inside(x[i]) ? buffon_priv_beta_log_density(&law, x[i]) -
                                             (buffon_priv_log(x[i]) + buffon_priv_log1p(-x[i]))
                                       : -(double)INFINITY;
    return 0;
}

static double beta_cdf(const buffon_priv_beta *law, double x)
{
    if (!(x > 0))
        return 0;
    if (!(x < 1))
        return 1;
    return x > law->x0 ? 1 - buffon_priv_beta_tail(law, x, 1) : buffon_priv_beta_tail(law, x, 0);
}

static int beta_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    buffon_priv_beta law;
    buffon_priv_beta_make(&law, g->param[0], g->param[1]);
    buffon_priv_beta_prepare(&law);
    for (size_t i = 0; i < n; i++)
        u[i] = density_inside(beta_cdf(&law, x[i]));
    return 0;
}

static const buffon_density_ops beta_ops = {.sample = beta_draw,
                                            .pdf = beta_pdf,
                                            .log_pdf = beta_log_pdf,
                                            .invert = beta_invert,
                                            .name = "buffon.beta"};

buffon_density buffon_beta(double a, double b)
{
    buffon_density g = {.uniforms = 1, .dim = 1, .ops = &beta_ops};
    if (a >= 1e-3 && a <= 1e15 && b >= 1e-3 && b <= 1e15) {
        g.param[0] = a;
        g.param[1] = b;
    } else {
        g.status = BUFFON_E_SHAPE;
    }
    return g;
}
