#include "guard.h"

#include <math.h>

#include <buffon/interval.h>

#include "elementary.h"
#include "quantile.h"

/* Makes the outputs defined, then checks what all intervals share. */
static buffon_status interval_begin(double *lo, double *hi, double confidence)
{
    if (lo) {
        *lo = buffon_priv_from_bits(UINT64_C(0x7ff8000000000000));
    }
    if (hi) {
        *hi = buffon_priv_from_bits(UINT64_C(0x7ff8000000000000));
    }
    if (!lo || !hi) {
        return BUFFON_E_NULL;
    }
    return confidence > 0 && confidence < 1 ? BUFFON_OK : BUFFON_E_CONFIDENCE;
}

/* An infinite number of degrees of freedom is the normal. */
static buffon_status interval_mean(double *lo, double *hi, double mean, double std_error,
                                   double dof, double confidence)
{
    const buffon_status status = interval_begin(lo, hi, confidence);
    double t, half;
    if (status != BUFFON_OK) {
        return status;
    }
    if (!buffon_priv_isfinite(mean) || !(std_error >= 0) || !(dof > 0)) {
        return BUFFON_E_SHAPE;
    }
    t = buffon_priv_student_central(confidence, 1 - confidence, dof);
    /* t may be infinite or 0: then no error stays none, and an infinite one infinite. */
    half = std_error > 0 && buffon_priv_isfinite(std_error) ? t * std_error : std_error;
    *lo = mean - half;
    *hi = mean + half;
    return BUFFON_OK;
}

buffon_status buffon_interval_normal(double *lo, double *hi, double mean, double std_error,
                                     double confidence)
{
    const double infinite = buffon_priv_from_bits(UINT64_C(0x7ff0000000000000));
    return interval_mean(lo, hi, mean, std_error, infinite, confidence);
}

buffon_status buffon_interval_student(double *lo, double *hi, double mean, double std_error,
                                      double dof, double confidence)
{
    return interval_mean(lo, hi, mean, std_error, dof, confidence);
}

buffon_status buffon_interval_clopper_pearson(double *lo, double *hi, uint64_t hits, uint64_t n,
                                              double confidence)
{
    const buffon_status status = interval_begin(lo, hi, confidence);
    if (status != BUFFON_OK) {
        return status;
    }
    if (n == 0 || hits > n) {
        return BUFFON_E_SAMPLES;
    }
    buffon_priv_clopper_pearson(lo, hi, hits, n, 1 - confidence);
    return BUFFON_OK;
}

/* The roots of (n + z^2) p^2 - (2 k + z^2) p + k^2 / n = 0. The upper one is a sum of positive
 * terms, the lower one follows from the product of the two; so neither cancels. */
buffon_status buffon_interval_wilson(double *lo, double *hi, uint64_t hits, uint64_t n,
                                     double confidence)
{
    const buffon_status status = interval_begin(lo, hi, confidence);
    const double k = (double)hits, total = (double)n;
    double z, rest, sum;
    if (status != BUFFON_OK) {
        return status;
    }
    if (n == 0 || hits > n) {
        return BUFFON_E_SAMPLES;
    }
    z = buffon_priv_normal_central(0.5 * confidence);
    rest = (double)(n - hits);
    sum = k + 0.5 * z * z + z * sqrt(k * (rest / total) + 0.25 * z * z);
    *lo = hits == 0 ? 0 : k * (k / total) / sum;
    *hi = sum / (total + z * z);
    *hi = hits == n || *hi > 1 ? 1 : *hi;
    return BUFFON_OK;
}
