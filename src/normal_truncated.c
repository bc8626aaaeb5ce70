/* The normal law between two bounds.
 *
 * In units of the standard deviation, seen from the bound nearer to the mean, "near": the distance
 * d of a point from it has the density exp(-a d - d^2 / 2) up to a factor, a the distance of near
 * from the mean, negative where the mean lies within. Its mass up to d,
 *
 *     D(a, d) = integral from 0 to d of exp(-a t - t^2 / 2) dt,
 *
 * is all that is needed, and is had without cancellation and without underflow for any a: by a
 * series where it is small, else by Mills' ratio R(x) = P(Z > x) / phi(x),
 *
 *     D = R(a) - exp(-a d - d^2 / 2) R(a + d)                       for a >= 0,
 *     D = exp(-a d - d^2 / 2) R(-a - d) - R(-a)                     for a + d <= 0.
 *
 * From the far bound the same holds with minus its distance from the mean. */
#include "guard.h"

#include <float.h>
#include <math.h>

#include <buffon/normal.h>

#include "density_priv.h"
#include "elementary.h"

#define NORMAL_SQRT_2PI 0x1.40d931ff62706p+1
#define NORMAL_FAR 25 /* from where Mills' ratio is an asymptotic series */

/* exp(x^2 / 2) for |x| <= 25: the square in two parts. */
static double normal_lift(double x)
{
    const double h = buffon_priv_from_bits(buffon_priv_bits(x) & ~UINT64_C(0x7ffffff));
    const double low = 0.5 * (x + h) * (x - h), e = buffon_priv_exp(0.5 * h * h);
    return e + e * low * (1 + low * (0.5 + low * (1. / 6)));
}

/* R(x) for x >= 0. */
static double normal_mills(double x)
{
    if (x < NORMAL_FAR)
        return buffon_priv_normal_cdf(-x) * normal_lift(x) * NORMAL_SQRT_2PI;
    const double r = 1 / x, z = r * r;
    return r *
           (1 -
            z * (1 -
                 3 * z * (1 - 5 * z * (1 - 7 * z * (1 - 9 * z * (1 - 11 * z * (1 - 13 * z)))))));
}

/* m exp(s): masses may be above all doubles. */
typedef struct normal_mass {
    double m, s;
} normal_mass;

/* With d = 2 h and c = a + h the distance of the middle, the integral is exp(-h (a + h / 2)) times
 * that of exp(-c t - t^2 / 2), the generating function of Hermite's polynomials, from -h to h:
 *
 *     2 h (1 + He_2(c) h^2 / 3! + He_4(c) h^4 / 5! + ...),
 *
 * where t_n = He_n(c) h^n follows from t_(n+1) = c h t_n - n h^2 t_(n-1). For h <= 1/2, |c h| <= 2
 * twelve terms leave 1e-18. */
static double normal_series(double a, double d)
{
    const double h = 0.5 * d, ch = (a + h) * h, hh = h * h;
    double even = 1, odd = ch, sum = 1, factorial = 1;
    for (int n = 1; n < 24; n += 2) {
        even = ch * odd - n * hh * even;
        odd = ch * even - (n + 1) * hh * odd;
        factorial *= (n + 1) * (n + 2);
        sum += even / factorial;
    }
    return d * buffon_priv_exp(-h * (a + 0.5 * h)) * sum;
}

/* The integral of exp(-t^2 / 2) from 0 to x >= 0. */
static double normal_middle_mass(double x)
{
    return x < 0.7 ? normal_series(0, x) : NORMAL_SQRT_2PI * (0.5 - buffon_priv_normal_cdf(-x));
}

static normal_mass normal_mass_of(double a, double d)
{
    const double end = a + d, fall = d * (a + 0.5 * d);
    normal_mass mass = {0, 0};
    if (d <= 1 && buffon_priv_abs(a + 0.5 * d) * d <= 4) {
        mass.m = normal_series(a, d);
    } else if (a >= 0) {
        mass.m = normal_mills(a) - buffon_priv_exp(-fall) * normal_mills(end);
    } else if (end <= 0) {
        mass.m = normal_mills(-end) - buffon_priv_exp(fall) * normal_mills(-a);
        mass.s = -fall;
    } else {
        mass.m = normal_middle_mass(-a) + normal_middle_mass(end);
        mass.s = 0.5 * a * a;
    }
    return mass;
}

static double normal_ratio(normal_mass a, normal_mass b)
{
    return a.m / b.m * buffon_priv_exp(a.s - b.s);
}

/* `param`: mean, sd; the two bounds, 1 where near is the lower one, else -1; their distances from
 * the mean, and from each other; the whole mass seen from each; whether near is beyond the mean.
 * For quantiles: the probability of the interval, that below near less 1/2, those outside. */
enum {
    NORMAL_MEAN,
    NORMAL_SD,
    NORMAL_NEAR,
    NORMAL_OTHER,
    NORMAL_SIGN,
    NORMAL_ALPHA,
    NORMAL_BETA,
    NORMAL_LENGTH,
    NORMAL_NEAR_M,
    NORMAL_NEAR_S,
    NORMAL_OTHER_M,
    NORMAL_OTHER_S,
    NORMAL_SHARE,
    NORMAL_CENTRAL,
    NORMAL_BELOW,
    NORMAL_ABOVE
};

/* Newton's steps from d to D(a, d) = v D(a, length), by logarithms of it, or where v > 1/2 of what
 * is beyond: exp(-fall) D(a + d, length - d) = rest D(a, length). Both are concave, so the steps
 * are safe; they end when the next one is below rounding. */
static double normal_settle(double d, double a, double length, normal_mass whole, double v,
                            double rest)
{
    for (int k = 0; k < 12; k++) {
        const double fall = d * (a + 0.5 * d);
        double step, next;
        if (v <= 0.5) {
            const normal_mass mass = normal_mass_of(a, d);
            const double off = buffon_priv_log(mass.m / whole.m / v) + (mass.s - whole.s);
            step = -off * mass.m * buffon_priv_exp(mass.s + fall);
        } else {
            const normal_mass mass = normal_mass_of(a + d, length - d);
            const double off =
                buffon_priv_log(mass.m / whole.m / rest) + ((mass.s - fall) - whole.s);
            step = off * mass.m * buffon_priv_exp(mass.s);
        }
        next = d + step;
        next = next > 0 ? next : 0.5 * d;
        next = next < length ? next : d + 0.5 * (length - d);
        if (!(buffon_priv_abs(next - d) > 0x1p-30 * d))
            return next;
        d = next;
    }
    return d;
}

/* A distance from a bound whose share is v, to start from where it is small: the density near the
 * bound is exp(-a t). NaN where it is not small. */
static double normal_start(double a, normal_mass whole, double v)
{
    const double e = v * whole.m * buffon_priv_exp(whole.s);
    if (!(e * (1 + buffon_priv_abs(a)) < 0.25))
        return (double)NAN;
    return buffon_priv_abs(a * e) < 0x1p-60 ? e : -buffon_priv_log1p(-a * e) / a;
}

/* The same in the tail, a >= 5, for any v: with R(x) about 1 / x the share beyond d is
 * exp(-fall) a / (a + d). */
static double normal_tail_start(const double *p, double v, double rest)
{
    const double a = p[NORMAL_ALPHA], length = p[NORMAL_LENGTH];
    const double all = buffon_priv_exp(-length * (a + 0.5 * length)) * (a / p[NORMAL_BETA]);
    const double left = rest + v * all;
    const double size = left < 0.5 ? -buffon_priv_log(left) : -buffon_priv_log1p(v * (all - 1));
    const double first = 2 * size / (a + sqrt(a * a + 2 * size));
    const double fall = size - buffon_priv_log1p(first / a);
    return fall > 0.5 * size ? 2 * fall / (a + sqrt(a * a + 2 * fall)) : first;
}

/* z by quantiles, near not far from the mean. */
static double normal_between(const double *p, double v, double rest)
{
    const double share = p[NORMAL_SHARE];
    const double q =
        p[NORMAL_ALPHA] == -p[NORMAL_BETA] ? (v - 0.5) * share : v * share + p[NORMAL_CENTRAL];
    if (q < -0.4)
        return buffon_priv_normal_quantile(p[NORMAL_BELOW] + v * share);
    if (q <= 0.4)
        return buffon_priv_normal_central(q);
    return -buffon_priv_normal_quantile(p[NORMAL_ABOVE] + rest * share);
}

/* The point of v, as counted from near, and its distance z from the mean and d from near. Which
 * distance is used is the least of those from near, other and the mean, or up to 8 times it. */
static double normal_point(double *z, double *d, double v, double rest, const double *p)
{
    const double a = p[NORMAL_ALPHA], b = p[NORMAL_BETA], length = p[NORMAL_LENGTH];
    const double sd = p[NORMAL_SIGN] * p[NORMAL_SD];
    const normal_mass near = {p[NORMAL_NEAR_M], p[NORMAL_NEAR_S]};
    const normal_mass other = {p[NORMAL_OTHER_M], p[NORMAL_OTHER_S]};
    double e, start;
    if (a < 5) {
        *z = normal_between(p, v, rest);
        *d = *z - a;
        e = b - *z;
        if (8 * *d >= buffon_priv_abs(*z) && 8 * e >= buffon_priv_abs(*z))
            return p[NORMAL_MEAN] + sd * *z;
        start = normal_start(a, near, v);
        *d = start == start ? start : *d;
    } else {
        *d = normal_tail_start(p, v, rest);
        e = length - *d;
    }
    if (*d <= e) {
        *d = normal_settle(*d, a, length, near, v, rest);
        *z = a + *d;
        return p[NORMAL_NEAR] + sd * *d;
    }
    start = normal_start(-b, other, rest);
    e = start == start ? start : e > 0 ? e : 0x1p-20 * length;
    e = normal_settle(e, -b, length, other, rest, v);
    *d = length - e;
    *z = b - e;
    return p[NORMAL_OTHER] - sd * e;
}

/* The density is exp(-fall) over this, fall by z where the mean is within, else by d. */
static double normal_whole(const double *p)
{
    const double whole = p[NORMAL_ALPHA] < 0 ? p[NORMAL_SHARE] * NORMAL_SQRT_2PI : p[NORMAL_NEAR_M];
    return whole * p[NORMAL_SD];
}

static double normal_fall(double z, double d, const double *p)
{
    return p[NORMAL_ALPHA] < 0 ? 0.5 * z * z : d * (p[NORMAL_ALPHA] + 0.5 * d);
}

static int normal_truncated_sample(double *x, double *pdf, const double *u, size_t n,
                                   const buffon_density *g)
{
    const double *p = g->param;
    const int up = p[NORMAL_SIGN] > 0;
    const double lo = up ? p[NORMAL_NEAR] : p[NORMAL_OTHER];
    const double hi = up ? p[NORMAL_OTHER] : p[NORMAL_NEAR], whole = normal_whole(p);
    double least, most;
    density_inner(&least, &most, lo, hi);
    for (size_t i = 0; i < n; i++) {
        double z, d;
        const double y =
            up ? normal_point(&z, &d, u[i], 1 - u[i], p) : normal_point(&z, &d, 1 - u[i], u[i], p);
        x[i] = density_held(y, least, most);
        if (pdf)
            pdf[i] = buffon_priv_exp(-normal_fall(z, d, p)) / whole;
    }
    return 0;
}

/* d and z of x; 0 where x is not in the support. */
static int normal_place(double *z, double *d, double x, const double *p)
{
    const double sign = p[NORMAL_SIGN];
    *d = sign * (x - p[NORMAL_NEAR]) / p[NORMAL_SD];
    *z = sign * (x - p[NORMAL_MEAN]) / p[NORMAL_SD];
    return sign * (x - p[NORMAL_NEAR]) >= 0 && sign * (p[NORMAL_OTHER] - x) >= 0 &&
           buffon_priv_isfinite(x);
}

static int normal_truncated_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const double *p = g->param, whole = normal_whole(p);
    for (size_t i = 0; i < n; i++) {
        double z, d;
        const int holds = normal_place(&z, &d, x[i], p);
        pdf[i] = holds ? buffon_priv_exp(-normal_fall(z, d, p)) / whole : 0;
    }
    return 0;
}

static int normal_truncated_log_pdf(double *log_pdf, const double *x, size_t n,
                                    const buffon_density *g)
{
    const double *p = g->param, rest = buffon_priv_log(normal_whole(p));
    for (size_t i = 0; i < n; i++) {
        double z, d;
        const int holds = normal_place(&z, &d, x[i], p);
        log_pdf[i] = holds ? -normal_fall(z, d, p) - rest : -(double)INFINITY;
    }
    return 0;
}

/* The share on this side of x and that beyond it; the larger is 1 less the smaller. */
static int normal_truncated_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    const double *p = g->param, a = p[NORMAL_ALPHA];
    const normal_mass near = {p[NORMAL_NEAR_M], p[NORMAL_NEAR_S]};
    const normal_mass other = {p[NORMAL_OTHER_M], p[NORMAL_OTHER_S]};
    for (size_t i = 0; i < n; i++) {
        double z, d = 0, v = 0, rest = 1;
        const double e = p[NORMAL_SIGN] * (p[NORMAL_OTHER] - x[i]) / p[NORMAL_SD];
        if (normal_place(&z, &d, x[i], p)) {
            v = normal_ratio(normal_mass_of(a, d), near);
            rest = 1 - v;
        }
        if (v > 0.5 && e < d) {
            rest = normal_ratio(normal_mass_of(-p[NORMAL_BETA], e), other);
            v = 1 - rest;
        } else if (v > 0.5) {
            normal_mass beyond = normal_mass_of(a + d, p[NORMAL_LENGTH] - d);
            beyond.s -= d * (a + 0.5 * d);
            rest = normal_ratio(beyond, near);
            v = 1 - rest;
        }
        u[i] = density_inside(p[NORMAL_SIGN] > 0 ? v : rest);
    }
    return 0;
}

static const buffon_density_ops normal_truncated_ops = {.sample = normal_truncated_sample,
                                                        .pdf = normal_truncated_pdf,
                                                        .log_pdf = normal_truncated_log_pdf,
                                                        .invert = normal_truncated_invert,
                                                        .name = "buffon.normal_truncated"};

buffon_density buffon_normal_truncated(double mean, double sd, double lo, double hi)
{
    buffon_density g = buffon_normal(mean, sd);
    const double a = (lo - mean) / sd, b = (hi - mean) / sd, width = hi - lo;
    const double length = buffon_priv_isfinite(width) ? width / sd : b - a;
    const int up = a >= 0 || (b > 0 && -a <= b);
    const double alpha = up ? a : -b, beta = up ? b : -a;
    if (g.status != BUFFON_OK || (lo == -(double)INFINITY && hi == (double)INFINITY))
        return g;
    g.ops = &normal_truncated_ops;
    if (!(lo < hi) || !(buffon_priv_abs(alpha) <= 0x1p400) || !(length >= 0x1p-1000)) {
        g.status = BUFFON_E_DOMAIN;
        return g;
    }
    const normal_mass near = normal_mass_of(alpha, length), none = {0, 0};
    const normal_mass other = beta <= DBL_MAX ? normal_mass_of(-beta, length) : none;
    g.param[NORMAL_NEAR] = up ? lo : hi;
    g.param[NORMAL_OTHER] = up ? hi : lo;
    g.param[NORMAL_SIGN] = up ? 1 : -1;
    g.param[NORMAL_ALPHA] = alpha;
    g.param[NORMAL_BETA] = beta;
    g.param[NORMAL_LENGTH] = length;
    g.param[NORMAL_NEAR_M] = near.m;
    g.param[NORMAL_NEAR_S] = near.s;
    g.param[NORMAL_OTHER_M] = other.m;
    g.param[NORMAL_OTHER_S] = other.s;
    g.param[NORMAL_SHARE] =
        near.m * DENSITY_INV_SQRT_2PI * buffon_priv_exp(near.s - 0.5 * alpha * alpha);
    g.param[NORMAL_CENTRAL] = buffon_priv_copysign(
        normal_middle_mass(buffon_priv_abs(alpha)) * DENSITY_INV_SQRT_2PI, alpha);
    if (!(normal_whole(g.param) >= 0x1p-1000)) /* its greatest density is not a double */
        g.status = BUFFON_E_DOMAIN;
    g.param[NORMAL_BELOW] = buffon_priv_normal_cdf(alpha);
    g.param[NORMAL_ABOVE] = buffon_priv_normal_cdf(-beta);
    return g;
}
