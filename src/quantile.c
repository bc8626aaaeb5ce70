/* Quantiles of Student's t, and of the binomial as Clopper and Pearson invert it. */
#include "guard.h"

#include <buffon/interval.h>

#include "elementary.h"
#include "incomplete.h"
#include "quantile.h"

#define QUANTILE_NAN buffon_priv_from_bits(UINT64_C(0x7ff8000000000000))
#define QUANTILE_INF buffon_priv_from_bits(UINT64_C(0x7ff0000000000000))

#define QUANTILE_LEAST 1e-15 /* degrees of freedom: below it, P(|T| <= 1e308) is less than 1e-12 */
#define QUANTILE_FAR 800     /* log T that no double has, with some to spare */

/* t from the normal quantile z of the same tails: the first terms of the Cornish-Fisher series in
 * 1 / dof, M. Abramowitz, I. Stegun (1964), 26.7.5. The first term left out is about
 * z (1/20 + z^10 / 14000) / dof^5. */
static double quantile_student_series(double z, double dof)
{
    const double w = z * z, r = 1 / dof;
    const double g1 = (1 + w) / 4;
    const double g2 = (3 + w * (16 + w * 5)) / 96;
    const double g3 = (-15 + w * (17 + w * (19 + w * 3))) / 384;
    const double g4 = (-945 + w * (-1920 + w * (1482 + w * (776 + w * 79)))) / 92160;
    return z + z * r * (g1 + r * (g2 + r * (g3 + r * g4)));
}

/* z with P(|Z| <= z) = inside, P(|Z| > z) = outside. */
static double quantile_normal(double inside, double outside)
{
    return inside < 0.5 ? buffon_priv_normal_central(0.5 * inside)
                        : buffon_priv_normal_two_sided(outside);
}

/* T^2 / (dof + T^2) is beta with parameters 1/2 and dof / 2, so T^2 is its odds against those of
 * the mean, and log T^2 mu of buffon_priv_beta_quantile. */
double buffon_priv_student_from(const buffon_priv_beta *law, double inside, double outside)
{
    const double z = quantile_normal(inside, outside), dof = 2 * law->b;
    const double guess =
        z * z < 2 * dof ? 2 * buffon_priv_log(quantile_student_series(z, dof)) : QUANTILE_NAN;
    return buffon_priv_exp(0.5 * buffon_priv_beta_quantile(law, inside, outside, guess).mu);
}

double buffon_priv_student_central(double inside, double outside, double dof)
{
    const double z = quantile_normal(inside, outside);
    buffon_priv_beta law;
    if (z == 0) {
        return 0;
    }
    if (outside == 0 || dof < QUANTILE_LEAST) {
        return QUANTILE_INF;
    }
    /* Far out, P(|T| > t) is t^-dof but for a factor that tends to 1 with dof. */
    if (dof < 1e-6 && -buffon_priv_log1p(-inside) > QUANTILE_FAR * dof) {
        return QUANTILE_INF;
    }
    if (dof >= 1000 && z * z <= 0.01 * dof) {
        return quantile_student_series(z, dof);
    }
    buffon_priv_beta_make(&law, 0.5, 0.5 * dof);
    return buffon_priv_student_from(&law, inside, outside);
}

double buffon_priv_student_two_sided(double alpha, double dof)
{
    return buffon_priv_student_central(1 - alpha, alpha, dof);
}

double buffon_student_upper(double q, double dof)
{
    const double tail = q > 0.5 ? 1 - q : q;
    double t;
    if (!(q >= 0 && q <= 1 && dof > 0)) {
        return QUANTILE_NAN;
    }
    t = buffon_priv_student_central(1 - 2 * tail, 2 * tail, dof);
    return q > 0.5 ? -t : t;
}

/* The x of a beta law with `lower` of the probability below it. */
static double quantile_beta(double lower, double upper, double a, double b)
{
    buffon_priv_beta law;
    buffon_priv_beta_make(&law, a, b);
    buffon_priv_beta_prepare(&law);
    return buffon_priv_beta_quantile(&law, lower, upper, QUANTILE_NAN).x;
}

void buffon_priv_clopper_pearson(double *lo, double *hi, uint64_t hits, uint64_t n, double alpha)
{
    const double miss = 0.5 * alpha, k = (double)hits, rest = (double)(n - hits);
    *lo = hits > 0 ? quantile_beta(miss, 1 - miss, k, rest + 1) : 0;
    *hi = hits < n ? quantile_beta(1 - miss, miss, k + 1, rest) : 1;
}
