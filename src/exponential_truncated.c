/* The exponential law between two bounds. */
#include "guard.h"

#include <float.h>
#include <math.h>

#include <buffon/exponential.h>

#include "density_priv.h"
#include "elementary.h"
#include "pair.h"

/* `param`: the end where the density is greater; the other; 1 where the first is the lower one,
 * else -1; r = |rate|, c = r times the length, the length, the density at the first end; exp(-c),
 * expm1(-c), and expm1(c) where c < 700. */
enum {
    TRUNCATED_BASE,
    TRUNCATED_OTHER,
    TRUNCATED_SIGN,
    TRUNCATED_RATE,
    TRUNCATED_C,
    TRUNCATED_LENGTH,
    TRUNCATED_PEAK,
    TRUNCATED_FALL,
    TRUNCATED_LOSS,
    TRUNCATED_GAIN
};

#define TRUNCATED_EVEN 0x1p-60 /* c, below which the law is uniform */

/* log1p(v e) / r, and expm1(r away) / e, where products may leave the normal doubles that their
 * quotients do not leave. */
static double truncated_log(double v, double e, double r)
{
    if (v < 0x1p-900 && buffon_priv_abs(e) < 0x1p100)
        return v * 0x1p200 * e / r * 0x1p-200;
    return buffon_priv_log1p(v * e) / r;
}

static double truncated_share(double r, double away, double e)
{
    const double c = r * away;
    if (buffon_priv_abs(c) < 0x1p-960)
        return away * (r / e);
    return buffon_priv_expm1(c) / e;
}

/* The distance from the first end, or with *back from the other, of the share v of probability,
 * v + rest = 1, and the density there against that at the first end.
 *
 * Where 1 - v + v exp(-c) is less than 1/2, log1p of its distance from 1 would lose digits. The way
 * back from the other end is taken in its half of the interval. */
static double truncated_away(int *back, double *left, double v, double rest, const double *p)
{
    const double c = p[TRUNCATED_C], r = p[TRUNCATED_RATE], length = p[TRUNCATED_LENGTH];
    double low, high;
    *back = 0;
    *left = 1;
    if (c < TRUNCATED_EVEN) {
        *back = v > 0.5;
        return length * (*back ? rest : v);
    }
    *left = rest + v * p[TRUNCATED_FALL];
    if (*left < 0.5)
        low = -buffon_priv_log(*left) / r;
    else
        low = -truncated_log(v, p[TRUNCATED_LOSS], r);
    if (low <= 0.5 * length)
        return low;
    high = c < 700 ? truncated_log(rest, p[TRUNCATED_GAIN], r) : length;
    if (high > 0.5 * length)
        return low;
    *back = 1;
    return high;
}

/* |x - base| of a point of the support, else -1. */
static double truncated_distance(double x, const double *p)
{
    const double away = p[TRUNCATED_SIGN] * (x - p[TRUNCATED_BASE]);
    const double rest = p[TRUNCATED_SIGN] * (p[TRUNCATED_OTHER] - x);
    return away >= 0 && rest >= 0 && away <= DBL_MAX ? away : -1;
}

/* exp is taken of half the exponent and squared, as the density may be far from 1. */
static int truncated_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++) {
        const double away = truncated_distance(x[i], g->param);
        const double half = buffon_priv_exp(-0.5 * g->param[TRUNCATED_RATE] * away);
        pdf[i] = away >= 0 ? half * g->param[TRUNCATED_PEAK] * half : 0;
    }
    return 0;
}

static int truncated_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    const double peak = buffon_priv_log(g->param[TRUNCATED_PEAK]);
    for (size_t i = 0; i < n; i++) {
        const double away = truncated_distance(x[i], g->param);
        log_pdf[i] = away >= 0 ? peak - g->param[TRUNCATED_RATE] * away : -(double)INFINITY;
    }
    return 0;
}

static int truncated_sample(double *x, double *pdf, const double *u, size_t n,
                            const buffon_density *g)
{
    const double *p = g->param, sign = p[TRUNCATED_SIGN];
    const double lo = sign > 0 ? p[TRUNCATED_BASE] : p[TRUNCATED_OTHER];
    const double hi = sign > 0 ? p[TRUNCATED_OTHER] : p[TRUNCATED_BASE];
    double least, most;
    density_inner(&least, &most, lo, hi);
    for (size_t i = 0; i < n; i++) {
        const double v = sign > 0 ? u[i] : 1 - u[i], rest = sign > 0 ? 1 - u[i] : u[i];
        double left;
        int back;
        const double away = truncated_away(&back, &left, v, rest, p);
        x[i] = back ? p[TRUNCATED_OTHER] - sign * away : p[TRUNCATED_BASE] + sign * away;
        x[i] = density_held(x[i], least, most);
        if (pdf)
            pdf[i] = p[TRUNCATED_PEAK] * left;
    }
    return 0;
}

/* The share between the first end and x is expm1(-r away) / expm1(-c), that beyond x
 * expm1(r rest) / expm1(c). */
static int truncated_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    const double *p = g->param, r = p[TRUNCATED_RATE], c = p[TRUNCATED_C];
    for (size_t i = 0; i < n; i++) {
        const double away = p[TRUNCATED_SIGN] * (x[i] - p[TRUNCATED_BASE]);
        const double rest = p[TRUNCATED_SIGN] * (p[TRUNCATED_OTHER] - x[i]);
        double v, beyond;
        if (c < TRUNCATED_EVEN) {
            v = away / p[TRUNCATED_LENGTH];
            beyond = rest / p[TRUNCATED_LENGTH];
        } else {
            v = truncated_share(-r, away, p[TRUNCATED_LOSS]);
            if (v < 0.5)
                beyond = 1 - v;
            else if (c < 700 && r * rest < 40)
                beyond = truncated_share(r, rest, p[TRUNCATED_GAIN]);
            else
                beyond = buffon_priv_exp(-r * away);
        }
        u[i] = density_inside(p[TRUNCATED_SIGN] > 0 ? v : beyond);
    }
    return 0;
}

static const buffon_density_ops truncated_ops = {.sample = truncated_sample,
                                                 .pdf = truncated_pdf,
                                                 .log_pdf = truncated_log_pdf,
                                                 .invert = truncated_invert,
                                                 .name = "buffon.exponential_truncated"};

static buffon_status truncated_check(double rate, double lo, double hi)
{
    const double size = buffon_priv_abs(rate), length = hi - lo;
    const int open = length > DBL_MAX && (lo < -DBL_MAX || hi > DBL_MAX);
    if (!(lo < hi) || lo == (double)INFINITY || hi == -(double)INFINITY)
        return BUFFON_E_DOMAIN;
    if (!buffon_priv_isfinite(rate))
        return BUFFON_E_SHAPE;
    if ((hi > DBL_MAX && !(rate > 0)) || (lo < -DBL_MAX && !(rate < 0)))
        return BUFFON_E_DOMAIN;
    if (open)
        return size >= 0x1p-1000 && size <= 0x1p1000 ? BUFFON_OK : BUFFON_E_SHAPE;
    return length >= 0x1p-1020 && length <= DBL_MAX ? BUFFON_OK : BUFFON_E_DOMAIN;
}

buffon_density buffon_exponential_truncated(double rate, double lo, double hi)
{
    buffon_density g = {.uniforms = 1, .dim = 1, .ops = &truncated_ops};
    const double r = buffon_priv_abs(rate), length = hi - lo, c = r * length;
    g.status = truncated_check(rate, lo, hi);
    if (g.status != BUFFON_OK)
        return g;
    g.param[TRUNCATED_BASE] = rate >= 0 ? lo : hi;
    g.param[TRUNCATED_OTHER] = rate >= 0 ? hi : lo;
    g.param[TRUNCATED_SIGN] = rate >= 0 ? 1 : -1;
    g.param[TRUNCATED_RATE] = r;
    g.param[TRUNCATED_C] = c;
    g.param[TRUNCATED_LENGTH] = length;
    /* The rounding of c counts in exp(c): it is made good where c and its parts are finite. */
    const double low = c < 700 && c > TRUNCATED_EVEN ? pair_product(r, length).lo : 0;
    const double fall = buffon_priv_exp(-c), gain = c < 700 ? buffon_priv_expm1(c) : 0;
    g.param[TRUNCATED_FALL] = fall - fall * low;
    g.param[TRUNCATED_LOSS] = buffon_priv_expm1(-c) - fall * low;
    g.param[TRUNCATED_GAIN] = gain + (gain + 1) * low;
    g.param[TRUNCATED_PEAK] = c < TRUNCATED_EVEN ? 1 / length : r / -g.param[TRUNCATED_LOSS];
    return g;
}
