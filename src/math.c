/* The functions of lanes_math.h, as batches of the level in use and as scalars. */
#include "guard.h"

#include <buffon/interval.h>
#include <buffon/math.h>

#include "elementary.h"
#include "quantile.h"

#define KERNELS "math_lanes.h"
#include "levels.h"

/* ---- batches ---- */

void buffon_math_sincospi(double *s, double *c, const double *x, size_t n)
{
    LEVELS_RUN(math_sincospi, (s, c, x, n));
}

void buffon_math_sinpi(double *y, const double *x, size_t n)
{
    LEVELS_RUN(math_sinpi, (y, x, n));
}

void buffon_math_cospi(double *y, const double *x, size_t n)
{
    LEVELS_RUN(math_cospi, (y, x, n));
}

void buffon_math_atan2pi(double *t, const double *y, const double *x, size_t n)
{
    LEVELS_RUN(math_atan2pi, (t, y, x, n));
}

void buffon_math_log(double *y, const double *x, size_t n)
{
    LEVELS_RUN(math_log, (y, x, n));
}

void buffon_math_log1p(double *y, const double *x, size_t n)
{
    LEVELS_RUN(math_log1p, (y, x, n));
}

void buffon_math_exp(double *y, const double *x, size_t n)
{
    LEVELS_RUN(math_exp, (y, x, n));
}

void buffon_math_expm1(double *y, const double *x, size_t n)
{
    LEVELS_RUN(math_expm1, (y, x, n));
}

void buffon_math_cbrt(double *y, const double *x, size_t n)
{
    LEVELS_RUN(math_cbrt, (y, x, n));
}

void buffon_math_acospi(double *t, const double *x, size_t n)
{
    LEVELS_RUN(math_acospi, (t, x, n));
}

void buffon_math_erfc(double *y, const double *x, size_t n)
{
    LEVELS_RUN(math_erfc, (y, x, n));
}

void buffon_math_normal_cdf(double *p, const double *z, size_t n)
{
    LEVELS_RUN(math_normal_cdf, (p, z, n));
}

void buffon_math_normal_quantile(double *z, const double *u, size_t n)
{
    LEVELS_RUN(math_normal_quantile, (z, u, n));
}

/* ---- scalars: one lane of the same ---- */

void buffon_priv_sincospi(double *s, double *c, double x)
{
    sincospi_scalar(s, c, x);
}

double buffon_priv_sinpi(double x)
{
    return sinpi_scalar(x);
}

double buffon_priv_cospi(double x)
{
    return cospi_scalar(x);
}

double buffon_priv_log(double x)
{
    return log_scalar(x);
}

double buffon_priv_log1p(double x)
{
    return log1p_scalar(x);
}

double buffon_priv_exp(double x)
{
    return exp_scalar(x);
}

double buffon_priv_expm1(double x)
{
    return expm1_scalar(x);
}

double buffon_priv_atan2pi(double y, double x)
{
    return atan2pi_scalar(y, x);
}

double buffon_priv_cbrt(double x)
{
    return cbrt_scalar(x);
}

double buffon_priv_acospi(double x)
{
    return acospi_scalar(x);
}

double buffon_priv_erfc(double x)
{
    return erfc_scalar(x);
}

double buffon_priv_normal_cdf(double z)
{
    return normal_cdf_scalar(z);
}

double buffon_priv_normal_quantile(double u)
{
    const double q = u - 0.5;
    return buffon_priv_abs(q) <= LANES_NORMAL_MIDDLE ? normal_middle_scalar(q)
                                                     : normal_outer_scalar(u);
}

double buffon_priv_normal_central(double q)
{
    const double size = buffon_priv_abs(q);
    if (size <= LANES_NORMAL_MIDDLE)
        return normal_middle_scalar(q);
    return buffon_priv_copysign(normal_tail_scalar(0.5 - size), q);
}

double buffon_priv_normal_two_sided(double alpha)
{
    const double p = 0.5 * alpha;
    return p < 0.5 - LANES_NORMAL_MIDDLE ? normal_tail_scalar(p) : normal_middle_scalar(0.5 - p);
}

double buffon_normal_quantile(double p)
{
    return buffon_priv_normal_quantile(p);
}
