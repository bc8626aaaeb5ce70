/* Laws that need powers: x^p on an interval, Pareto's and Weibull's. */
#include "guard.h"

#include <float.h>
#include <math.h>

#include <buffon/laws.h>

#include "density_priv.h"
#include "elementary.h"
#include "pair_math.h"

#define POWER_LEAST 0x1p-1074
#define POWER_SMALL 0x1p-60 /* of a log(hi / lo), below which the law is x = lo (hi / lo)^u */

/* Whether the outermost points of the generator and their pdf are normal doubles. */
static buffon_status power_check(buffon_density *g)
{
    const double u[] = {0x1p-53, 1 - 0x1p-53};
    double x[2], pdf[2];
    g->ops->sample(x, pdf, u, 2, g);
    for (int i = 0; i < 2; i++)
        if (!(x[i] >= DBL_MIN && x[i] < DBL_MAX && pdf[i] >= DBL_MIN && pdf[i] < DBL_MAX))
            return BUFFON_E_SHAPE;
    return BUFFON_OK;
}

/* 1 - u to all its digits. */
static pair power_rest(double u)
{
    return pair_sum(1, -u);
}

/* n w / x, where a small w must not lose digits in n w. */
static double power_slope(double n, double w, double x)
{
    const double up = w < 0x1p-900 ? 0x1p200 : 1;
    return n * (w * up) / x / up;
}

/* n exp(log_w) / x for n up to 2^53, where 1 / x may not be a double. */
static double power_density(double n, pair log_w, double x)
{
    const int up = x < DBL_MIN ? 104 : 0;
    return pair_exp_up(log_w, n / buffon_priv_ldexp(x, up), up);
}

/* ---- x^p ---------------------------------------------------------------------------------- */

/* With a = p + 1 and w = (x / ref)^a, where ref is the end at which w is 1: hi for a > 0, else lo.
 * w runs from r = (lo / hi)^|a| to 1 evenly. `param`: a in two parts, lo, hi, ref; log(hi / lo) in
 * two parts; c = |a| log(hi / lo), r, and the factor N of g = N w / x, which is |a| / (1 - r). */
enum {
    POWER_A,
    POWER_A_LO,
    POWER_LO,
    POWER_HI,
    POWER_REF,
    POWER_LENGTH,
    POWER_LENGTH_LO,
    POWER_C,
    POWER_R,
    POWER_N
};

/* w of one uniform, and log(x / ref) of it.
 *
 * A relative error e of w is one of e / |a| in x. Where |a| is so small that log(hi / lo) is less
 * than 1 / |a|, the logarithm log(x / lo) is found as a fraction of log(hi / lo). */
static double power_place(double *w, double u, const double *p)
{
    const pair a = {p[POWER_A], p[POWER_A_LO]};
    const pair length = {p[POWER_LENGTH], p[POWER_LENGTH_LO]}, rest = power_rest(u);
    const double c = p[POWER_C], near = a.hi > 0 ? rest.hi : u, far = a.hi > 0 ? u : rest.hi;
    *w = far + near * p[POWER_R];
    if (c < POWER_SMALL)
        return pair_exp(pair_times(length, u), p[POWER_LO]);
    if (c < 1) {
        const double signed_c = a.hi > 0 ? c : -c;
        const double share = buffon_priv_log1p(u * buffon_priv_expm1(signed_c)) / signed_c;
        return pair_exp(pair_times(length, share), p[POWER_LO]);
    }
    if (p[POWER_R] == 0) {
        const pair all = {u, 0};
        return pair_exp(pair_over(pair_log(a.hi > 0 ? all : rest), a), p[POWER_REF]);
    }
    if (*w > 0.5) {
        const pair log_w = {buffon_priv_log1p(near * buffon_priv_expm1(-c)), 0};
        return pair_exp(pair_over(log_w, a), p[POWER_REF]);
    }
    const pair only = {*w, 0};
    return pair_exp(pair_over(pair_log(only), a), p[POWER_REF]);
}

/* log(x / ref) a, where x is in the support. */
static pair power_exponent(double x, const double *p)
{
    const pair a = {p[POWER_A], p[POWER_A_LO]};
    const pair y = pair_log_ratio(x, p[POWER_REF]), product = pair_times(y, a.hi);
    return pair_sum(product.hi, product.lo + y.hi * a.lo);
}

static int power_holds(double x, const double *p)
{
    return x >= p[POWER_LO] && x <= p[POWER_HI] && x > 0 && x <= DBL_MAX;
}

static double power_at(double x, const double *p)
{
    return power_holds(x, p) ? power_density(p[POWER_N], power_exponent(x, p), x) : 0;
}

/* Where digits of x are lost, g is that at x. */
static int power_sample(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    const double *p = g->param;
    const double least = p[POWER_LO] > 0 ? p[POWER_LO] : POWER_LEAST;
    const double most = p[POWER_HI] < DBL_MAX ? p[POWER_HI] : DBL_MAX;
    for (size_t i = 0; i < n; i++) {
        double w;
        const double y = power_place(&w, u[i], p);
        x[i] = density_held(y, least, most);
        if (pdf)
            pdf[i] = x[i] < DBL_MIN ? power_at(x[i], p) : power_slope(p[POWER_N], w, x[i]);
    }
    return 0;
}

static int power_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const double *p = g->param;
    for (size_t i = 0; i < n; i++)
        pdf[i] = power_at(x[i], p);
    return 0;
}

static int power_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    const double *p = g->param, log_n = buffon_priv_log(p[POWER_N]);
    for (size_t i = 0; i < n; i++)
        log_pdf[i] = power_holds(x[i], p)
                         ? power_exponent(x[i], p).hi - buffon_priv_log(x[i]) + log_n
                         : -(double)INFINITY;
    return 0;
}

/* u = (w - r) / (1 - r) for a > 0, and near lo (e - 1) r / (1 - r) with e = (x / lo)^a; 1 less that
 * for a < 0, where e is w. */
static double power_level(double x, const double *p)
{
    const double a = p[POWER_A], c = p[POWER_C], r = p[POWER_R], lo = p[POWER_LO];
    if (lo == 0)
        return pair_exp(power_exponent(x, p), 1);
    const pair y = pair_log_ratio(x, lo);
    if (c < POWER_SMALL)
        return y.hi / p[POWER_LENGTH];
    if (a < 0)
        return buffon_priv_expm1(a * y.hi) / buffon_priv_expm1(-c);
    if (a * y.hi < 1)
        return buffon_priv_expm1(a * y.hi) * r / -buffon_priv_expm1(-c);
    return (pair_exp(power_exponent(x, p), 1) - r) / (1 - r);
}

static int power_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++) {
        const int holds = x[i] > 0 && x[i] >= g->param[POWER_LO] && x[i] <= DBL_MAX;
        u[i] = density_inside(holds ? power_level(x[i], g->param) : x[i] > 0);
    }
    return 0;
}

static const buffon_density_ops power_ops = {.sample = power_sample,
                                             .pdf = power_pdf,
                                             .log_pdf = power_log_pdf,
                                             .invert = power_invert,
                                             .name = "buffon.power"};

static buffon_density power_make(pair a, double lo, double hi)
{
    buffon_density g = {.uniforms = 1, .dim = 1, .ops = &power_ops};
    const int bounded = lo > 0 && hi <= DBL_MAX;
    if (!(lo >= 0 && lo < hi && lo <= DBL_MAX) || (lo == 0 && hi > DBL_MAX)) {
        g.status = BUFFON_E_DOMAIN;
        return g;
    }
    if (!(buffon_priv_abs(a.hi) <= 0x1p20 + 1) || (lo == 0 && !(a.hi > 0)) ||
        (hi > DBL_MAX && !(a.hi < 0))) {
        g.status = BUFFON_E_SHAPE;
        return g;
    }
    const double size = buffon_priv_abs(a.hi), infinite = (double)INFINITY;
    const pair none = {infinite, 0}, length = bounded ? pair_log_ratio(hi, lo) : none;
    const pair signed_c = bounded ? pair_times(length, -size) : none;
    const double c = bounded ? -signed_c.hi : infinite;
    g.param[POWER_A] = a.hi;
    g.param[POWER_A_LO] = a.lo;
    g.param[POWER_LO] = lo;
    g.param[POWER_HI] = hi;
    g.param[POWER_REF] = a.hi > 0 ? hi : lo;
    g.param[POWER_LENGTH] = length.hi;
    g.param[POWER_LENGTH_LO] = length.lo;
    g.param[POWER_C] = c;
    g.param[POWER_R] = bounded ? pair_exp(signed_c, 1) : 0;
    g.param[POWER_N] = c < POWER_SMALL ? 1 / length.hi
                       : bounded       ? size / -buffon_priv_expm1(-c)
                                       : size;
    g.status = power_check(&g);
    return g;
}

buffon_density buffon_power(double exponent, double lo, double hi)
{
    return power_make(pair_sum(exponent, 1), lo, hi);
}

buffon_density buffon_pareto(double alpha, double scale)
{
    const pair a = {-alpha, 0};
    buffon_density g = power_make(a, scale, (double)INFINITY);
    if (!(alpha >= 0x1p-20 && alpha <= 0x1p20) || !(scale > 0 && scale <= DBL_MAX))
        g.status = BUFFON_E_SHAPE;
    return g;
}

/* ---- Weibull ------------------------------------------------------------------------------ */

/* `param`: shape, scale. E = (x / scale)^shape = -log(1 - u). */

static pair weibull_energy(double u)
{
    const pair log_rest = pair_log(power_rest(u));
    const pair energy = {-log_rest.hi, -log_rest.lo}, small = {u, 0.5 * u * u};
    return u < 0x1p-60 ? small : energy;
}

static pair weibull_log_energy(double x, const buffon_density *g)
{
    return pair_times(pair_log_ratio(x, g->param[1]), g->param[0]);
}

/* slope exp(-e), in two steps so that the exponential does not leave the doubles before g does. */
static double weibull_fall(double slope, double e)
{
    const double half = buffon_priv_exp(-0.5 * e);
    return slope * half * half;
}

/* (E shape / x) exp(-E). */
static double weibull_at(double x, const buffon_density *g)
{
    if (!(x > 0 && x <= DBL_MAX))
        return 0;
    const pair log_e = weibull_log_energy(x, g);
    const double e = pair_exp(log_e, 1);
    return e < 1500 ? weibull_fall(power_density(g->param[0], log_e, x), e) : 0;
}

static int weibull_sample(double *x, double *pdf, const double *u, size_t n,
                          const buffon_density *g)
{
    const double shape = g->param[0], scale = g->param[1];
    const pair k = {shape, 0};
    for (size_t i = 0; i < n; i++) {
        const pair e = weibull_energy(u[i]);
        const double y = pair_exp(pair_over(pair_log(e), k), scale);
        x[i] = density_held(y, POWER_LEAST, DBL_MAX);
        if (pdf)
            pdf[i] =
                x[i] < DBL_MIN ? weibull_at(x[i], g) : power_slope(shape * (1 - u[i]), e.hi, x[i]);
    }
    return 0;
}

static int weibull_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++)
        pdf[i] = weibull_at(x[i], g);
    return 0;
}

static int weibull_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    const double log_shape = buffon_priv_log(g->param[0]);
    for (size_t i = 0; i < n; i++) {
        log_pdf[i] = -(double)INFINITY;
        if (x[i] > 0 && x[i] <= DBL_MAX) {
            const pair log_e = weibull_log_energy(x[i], g);
            log_pdf[i] = log_shape + (log_e.hi - buffon_priv_log(x[i])) - pair_exp(log_e, 1);
        }
    }
    return 0;
}

static int weibull_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++) {
        const int inside = x[i] > 0 && x[i] <= DBL_MAX;
        const double e = inside ? pair_exp(weibull_log_energy(x[i], g), 1) : 0;
        u[i] = density_inside(x[i] > DBL_MAX ? 1 : -buffon_priv_expm1(-e));
    }
    return 0;
}

static const buffon_density_ops weibull_ops = {.sample = weibull_sample,
                                               .pdf = weibull_pdf,
                                               .log_pdf = weibull_log_pdf,
                                               .invert = weibull_invert,
                                               .name = "buffon.weibull"};

buffon_density buffon_weibull(double shape, double scale)
{
    buffon_density g = {.uniforms = 1, .dim = 1, .ops = &weibull_ops};
    if (!(shape >= 0x1p-4 && shape <= 0x1p20 && scale >= DBL_MIN && scale <= 0x1p1022)) {
        g.status = BUFFON_E_SHAPE;
        return g;
    }
    g.param[0] = shape;
    g.param[1] = scale;
    g.status = power_check(&g);
    return g;
}
