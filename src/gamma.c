#include "guard.h"

#include <float.h>
#include <math.h>

#include <buffon/gamma.h>

#include "bell.h"
#include "density_priv.h"
#include "elementary.h"
#include "solve.h"
#include "special.h"

#define GAMMA_LOG_2PI 0x1.d67f1c864beb5p+0
#define GAMMA_BELL 10       /* shapes from which the law is nearly normal */
#define GAMMA_NEAR 1.5      /* y up to which the alternating series cancels little */
#define GAMMA_NOWHERE -2000 /* a log y whose y is 0 at any scale: P(Y <= y) is y^a */
enum { GAMMA_TERMS = 90, GAMMA_ALTERNATING = 26, GAMMA_STEPS = 1000 };

/* The variable is t = log(y / unit), unit = max(a, 1), in which the density is
 *
 *     D = y^a exp(-y) / Gamma(a) = exp(peak - a (exp(t) - 1 - t))  or  a exp(peak + a t - exp(t)).
 *
 * Far from the mode of a large shape nothing of the size of a cancels. `param`: shape, scale, and
 * what follows from them. */
typedef struct gamma_law {
    double a, unit, log_unit, scale, log_scale;
    double size;        /* min(a, 1), which is kept out of log D */
    double peak;        /* as above */
    double log_gamma1p; /* log Gamma(1 + a), of a < 1 */
    double alternating[GAMMA_ALTERNATING];
    buffon_priv_bell bell;
} gamma_law;

static double gamma_peak(double a)
{
    return a < 1 ? -buffon_priv_lgamma1p(a)
                 : 0.5 * (buffon_priv_log(a) - GAMMA_LOG_2PI) - buffon_priv_stirling(a);
}

/* What density and CDF need. */
static void gamma_law_at(gamma_law *law, const buffon_density *g)
{
    law->a = g->param[0];
    law->scale = g->param[1];
    law->log_scale = g->param[2];
    law->peak = g->param[3];
    law->log_gamma1p = g->param[4];
    law->unit = law->a < 1 ? 1 : law->a;
    law->size = law->a < 1 ? law->a : 1;
    law->log_unit = law->a < 1 ? 0 : g->param[5];
}

/* And what points need: the nearly normal law, or for small a the series with terms
 * (-y)^k / (k! (a + k)). */
static void gamma_law_make(gamma_law *law, const buffon_density *g)
{
    double factorial = 1;
    gamma_law_at(law, g);
    for (int k = 1; k <= GAMMA_ALTERNATING && law->a < 1; k++) {
        factorial *= -k;
        law->alternating[k - 1] = 1 / (factorial * (law->a + k));
    }
    if (law->a >= GAMMA_BELL)
        buffon_priv_bell_make(&law->bell, 1, 0, law->a, -g->param[6], 1, 1);
}

/* log(D / size) */
static double gamma_log_density(const gamma_law *law, double t, double y)
{
    const double a = law->a;
    return a < 1 ? law->peak + (a * t - y) : law->peak - a * (buffon_priv_expm1(t) - t);
}

/* P(Y <= y) size / D for y at most a little above a: 1 / a times
 * 1 + y / (a + 1) + y^2 / ((a + 1) (a + 2)) + ... */
static double gamma_lower(const gamma_law *law, double y)
{
    const double a = law->a;
    double term = 1, sum = 1;
    for (int k = 1; k < GAMMA_TERMS && term > 0x1p-56 * sum; k++) {
        term *= y / (a + k);
        sum += term;
    }
    return sum * (law->size / a);
}

/* P(Y > y) / D for y above a: Legendre's continued fraction, its convergents by Steed's method. */
static double gamma_fraction(double a, double y)
{
    double b = y + 1 - a, d = 1 / b, step = d, sum = d;
    for (int k = 1; k < GAMMA_STEPS; k++) {
        const double c = k * (a - k);
        b += 2;
        d = 1 / (b + c * d);
        step *= b * d - 1;
        sum += step;
        if (buffon_priv_abs(step) < 0x1p-54 * sum)
            break;
    }
    return sum;
}

/* P(Y > y) for a < 1 and small y: P(Y <= y) is e^l (1 + a R), l = log(y^a / Gamma(1 + a)), where 1
 * is taken off before it can cancel. */
static double gamma_upper_small(const gamma_law *law, double t, double y)
{
    const double l = law->a * t - law->log_gamma1p;
    double sum = 0;
    for (int k = GAMMA_ALTERNATING - 1; k >= 0; k--)
        sum = law->alternating[k] + y * sum;
    return -buffon_priv_expm1(l) - buffon_priv_exp(l) * law->a * (y * sum);
}

static double gamma_upper(const gamma_law *law, double t, double y, double log_density)
{
    const double a = law->a;
    if (a < 1 && y < GAMMA_NEAR)
        return gamma_upper_small(law, t, y) * buffon_priv_exp(-log_density);
    if (y < a + 1 && y < GAMMA_BELL + 1)
        return buffon_priv_exp(-log_density) - gamma_lower(law, y);
    return law->size * gamma_fraction(a, y);
}

static void gamma_place(buffon_priv_place *at, double t, int upper, const void *ctx)
{
    const gamma_law *law = ctx;
    const double y = law->unit * buffon_priv_exp(t);
    double s = -y;
    at->unit = law->size;
    at->density = gamma_log_density(law, t, y);
    at->ratio = upper ? gamma_upper(law, t, y, at->density) : gamma_lower(law, y);
    at->slope[0] = law->a - y;
    for (int k = 1; k < SOLVE_ORDER; k++) {
        at->slope[k] = s;
        s *= 1.0 / (k + 1);
    }
}

/* Where to start. Near 0, from P(Y <= y) = v^a (1 - a v / (a + 1) + ...) with
 * v = y / Gamma(1 + a)^(1/a).
 * In the upper tail of a small shape, from Q = y^(a-1) exp(-y) / Gamma(a). Else (y / a)^(1/3) is
 * nearly normal: E. Wilson, M. Hilferty (1931). */
static double gamma_guess(const gamma_law *law, double log_p, double log_q, double z)
{
    const double a = law->a, r = 1 / (9 * a);
    const double log_gamma =
        a < 1 ? law->log_gamma1p : -law->peak + a * (law->log_unit - 1) + law->log_unit;
    const double t = (log_p + log_gamma) / a;
    const double tail = a < 1 ? buffon_priv_log(a) - log_q - log_gamma : 0;
    double cube;
    if (t < buffon_priv_log(0.35 * (a + 1))) {
        const double v = buffon_priv_exp(t), b = 1 / (a + 1);
        return t - law->log_unit + v * b * (1 + v * b * (a + 3) / (2 * (a + 2)));
    }
    if (tail > 1) {
        const double y = tail - (1 - a) * buffon_priv_log(tail);
        const double v = y > 0.5 ? y : 0.5;
        return buffon_priv_log(v + (1 - a) * (buffon_priv_log(tail / v) - 1 / (1 + v)));
    }
    cube = 1 - r + z * sqrt(r);
    if (!(cube > 0.1))
        return t - law->log_unit;
    return 3 * buffon_priv_log(cube) + (a < 1 ? buffon_priv_log(a) : 0);
}

/* y, and log y where that is too small. */
static double gamma_quantile(const gamma_law *law, double u, double *log_y)
{
    const int upper = u > 0.5;
    const double z = buffon_priv_normal_quantile(u);
    double t, log_p, log_q;
    if (law->a >= GAMMA_BELL) {
        const double zeta = buffon_priv_bell_quantile(&law->bell, z);
        if (zeta == zeta)
            return law->a * (1 + buffon_priv_bell_distance(&law->bell, zeta));
    }
    log_p = upper ? buffon_priv_log1p(-(1 - u)) : buffon_priv_log(u);
    log_q = upper ? buffon_priv_log(1 - u) : buffon_priv_log1p(-u);
    t = gamma_guess(law, log_p, log_q, z);
    if (t > GAMMA_NOWHERE)
        t = buffon_priv_solve(t, upper ? log_q : log_p, upper, gamma_place, law);
    *log_y = t + law->log_unit;
    return law->unit * buffon_priv_exp(t);
}

/* scale y, where either may be tiny. */
static double gamma_point(const gamma_law *law, double u)
{
    double log_y = 0, y = gamma_quantile(law, u, &log_y), x = law->scale * y;
    if (y < 0x1p-900)
        x = buffon_priv_exp(log_y + law->log_scale);
    return x > DBL_MIN ? x : DBL_MIN;
}

/* log(g x / size) = log(D / size) */
static double gamma_log_at(const gamma_law *law, double x)
{
    const double a = law->a, y = x / law->scale;
    if (a >= 1 && y > 0.5 * a)
        return law->peak - a * buffon_priv_deviance((y - a) / a);
    const double log_y = y > DBL_MIN ? buffon_priv_log(y) : buffon_priv_log(x) - law->log_scale;
    if (a < 1)
        return law->peak + (a * log_y - y);
    return law->peak +
           (a * (y / a > DBL_MIN ? buffon_priv_log(y / a) : log_y - law->log_unit) - (y - a));
}

static double gamma_pdf_at(const gamma_law *law, double x)
{
    if (!(x > 0 && x <= DBL_MAX))
        return 0;
    const double log_d = gamma_log_at(law, x);
    if (x < DBL_MIN) /* where 1 / x may not be a double */
        return law->size * buffon_priv_exp(log_d) / x;
    return law->size * (log_d > -700 ? buffon_priv_exp(log_d) / x
                                     : buffon_priv_exp(log_d - buffon_priv_log(x)));
}

static int gamma_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    gamma_law law;
    gamma_law_make(&law, g);
    for (size_t i = 0; i < n; i++) {
        x[i] = gamma_point(&law, density_inside(u[i]));
        if (pdf)
            pdf[i] = gamma_pdf_at(&law, x[i]);
    }
    return 0;
}

static int gamma_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    gamma_law law;
    gamma_law_at(&law, g);
    for (size_t i = 0; i < n; i++)
        pdf[i] = gamma_pdf_at(&law, x[i]);
    return 0;
}

static int gamma_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    gamma_law law;
    gamma_law_at(&law, g);
    const double log_size = law.a < 1 ? g->param[5] : 0;
    for (size_t i = 0; i < n; i++)
        log_pdf[i] = x[i] > 0 && x[i] <= DBL_MAX
                         ? log_size + (gamma_log_at(&law, x[i]) - buffon_priv_log(x[i]))
                         : -(double)INFINITY;
    return 0;
}

/* The zeta of y: its square is twice the deviance over n. */
static double gamma_zeta(double d)
{
    return buffon_priv_copysign(sqrt(2 * buffon_priv_deviance(d)), d);
}

static double gamma_cdf(const gamma_law *law, double x)
{
    const double a = law->a, y = x / law->scale;
    if (!(x > 0))
        return 0;
    if (!(y <= DBL_MAX))
        return 1;
    if (a >= GAMMA_BELL) {
        const double zeta = gamma_zeta((y - a) / a);
        if (buffon_priv_abs(zeta) <= law->bell.reach) {
            const int upper = zeta > 0;
            const double tail = buffon_priv_bell_tail(&law->bell, zeta, upper);
            return upper ? 1 - tail : tail;
        }
    }
    const double log_d = gamma_log_at(law, x), d = buffon_priv_exp(log_d);
    if (a < 1 && y > 0.1) {
        const double t = y > DBL_MIN ? buffon_priv_log(y) : buffon_priv_log(x) - law->log_scale;
        return 1 - d * gamma_upper(law, t, y, log_d);
    }
    return y > a + 1 ? 1 - d * law->size * gamma_fraction(a, y) : d * gamma_lower(law, y);
}

static int gamma_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    gamma_law law;
    gamma_law_make(&law, g);
    for (size_t i = 0; i < n; i++)
        u[i] = density_inside(gamma_cdf(&law, x[i]));
    return 0;
}

static const buffon_density_ops gamma_ops = {.sample = gamma_draw,
                                             .pdf = gamma_pdf,
                                             .log_pdf = gamma_log_pdf,
                                             .invert = gamma_invert,
                                             .name = "buffon.gamma"};

buffon_density buffon_gamma(double shape, double scale)
{
    buffon_density g = {.uniforms = 1, .dim = 1, .ops = &gamma_ops};
    if (!(shape >= 1e-100 && shape <= 1e100 && scale >= 1e-200 && scale <= 1e200)) {
        g.status = BUFFON_E_SHAPE;
        return g;
    }
    g.param[0] = shape;
    g.param[1] = scale;
    g.param[2] = buffon_priv_log(scale);
    g.param[3] = gamma_peak(shape);
    g.param[4] = shape < 1 ? buffon_priv_lgamma1p(shape) : 0;
    g.param[5] = buffon_priv_log(shape);
    g.param[6] = shape < 1 ? 0 : buffon_priv_stirling(shape);
    return g;
}

buffon_density buffon_chi_square(double dof)
{
    return buffon_gamma(0.5 * dof, 2);
}
