/* The incomplete beta function and its inverse.
 *
 * The variable is mu = log((x / y) / (x0 / y0)) with y = 1 - x, the mean x0 = a / (a + b) and
 * y0 = 1 - x0: the log odds against those of the mean. In it nothing of the size of a or b cancels,
 * x and y have the same rights, and both tails are log-concave. The density of mu is
 *
 *     D = x^a y^b / B(a, b) = sqrt(a y0 / 2 pi) exp(d(a + b) - d(a) - d(b) - deviance),
 *     deviance = a log(x0 / x) + b log(y0 / y) >= 0,
 *
 * with d(z) the error of Stirling's formula, as C. Loader (2000), Fast and accurate computation of
 * binomial probabilities, does it for the binomial. A tail is D times a series or a continued
 * fraction, or that of a nearly normal law.
 * Rejected: log-gammas (they lose log10(a) digits), bisection on the CDF (it loses the far tails).
 */
#include "guard.h"

#include "incomplete.h"

#include <math.h>

#include <buffon/interval.h>

#include "elementary.h"
#include "solve.h"
#include "special.h"

#define INCOMPLETE_LEAST 1e-16 /* below it and above the other the steps do not settle */
#define INCOMPLETE_MOST 1e30
#define INCOMPLETE_LOG_SQRT_2PI 0x1.d67f1c864beb5p-1
#define INCOMPLETE_BELL 10     /* of both parameters: from there on the law is nearly normal */
#define INCOMPLETE_QUICK 0.75  /* the ratio of a series' terms */
#define INCOMPLETE_STEPS 20000 /* of the fraction at most */
#define INCOMPLETE_CLOSE 1e-15 /* when two of its convergents agree */

/* log Gamma(z) as Stirling's formula has it, but for the part that is not small: z from 3/2 up,
 * where it is d(z), and below, where log z / 2 + log(2 pi) / 2 are left out. */
#define INCOMPLETE_SMALL 1.5

static double incomplete_part_of_gamma(double z)
{
    return z < INCOMPLETE_SMALL ? buffon_priv_lgamma1p(z) + (z - z * buffon_priv_log(z))
                                : buffon_priv_stirling(z);
}

/* d(n) - d(a) - d(b), and the peak, in which log a and log(2 pi) cancel for small a. */
void buffon_priv_beta_make(buffon_priv_beta *law, double a, double b)
{
    const double n = a + b, x0 = a / n, y0 = b / n;
    const int small_a = a < INCOMPLETE_SMALL, small_b = b < INCOMPLETE_SMALL;
    const double gain =
        incomplete_part_of_gamma(n) - incomplete_part_of_gamma(a) - incomplete_part_of_gamma(b);
    double peak = gain;
    law->a = a;
    law->b = b;
    law->n = n;
    law->x0 = x0;
    law->y0 = y0;
    law->unit = a * y0;
    if (!small_a && !small_b)
        peak -= 0.5 * buffon_priv_log(law->unit) + INCOMPLETE_LOG_SQRT_2PI;
    else if (!small_a || !small_b)
        peak -= 0.5 * buffon_priv_log1p(small_a ? -x0 : -y0);
    else if (n >= INCOMPLETE_SMALL)
        peak += 0.5 * buffon_priv_log(n) + INCOMPLETE_LOG_SQRT_2PI;
    law->peak = peak;
    law->nearly_normal = a >= INCOMPLETE_BELL && b >= INCOMPLETE_BELL;
    law->gain = gain;
    law->prepared = 0;
}

static double incomplete_radius(const buffon_priv_beta *law)
{
    return law->x0 > law->y0 ? law->x0 : law->y0;
}

static void incomplete_bell(buffon_priv_bell *bell, const buffon_priv_beta *law, double most)
{
    buffon_priv_bell_make(bell, (law->b - law->a) / law->n, law->x0 * law->y0, law->unit, law->gain,
                          incomplete_radius(law), most);
}

void buffon_priv_beta_prepare(buffon_priv_beta *law)
{
    law->prepared = law->nearly_normal;
    if (law->nearly_normal)
        incomplete_bell(&law->bell, law, 2);
}

/* The deviance, for a <= b: (a + b) log(y0 + x0 e^mu) - a mu. Near the mean the terms cancel, which
 * leaves an error of 1e-16 a mu; but its derivative there is about a mu, so in mu the error is
 * 1e-16. (For a > b the terms would be far larger.) Where e^mu overflows it is divided out. */
static double incomplete_deviance(double a, double b, double mu)
{
    const double n = a + b;
    if (mu > 700)
        return b * mu + n * buffon_priv_log(a / n + b / n * buffon_priv_exp(-mu));
    return n * buffon_priv_log1p(a / n * buffon_priv_expm1(mu)) - a * mu;
}

/* D and its slope at mu; x and y as well. The slope is a y - b x = (a + b) (x0 - x), where x0 - x
 * is formed without cancellation. Right of the mean all is divided by e^mu, which might overflow.
 */
typedef struct incomplete_place {
    double x, y, slope, density; /* log(D / unit) */
} incomplete_place;

static incomplete_place incomplete_place_make(const buffon_priv_beta *law, double mu)
{
    const double fall = buffon_priv_exp(-buffon_priv_abs(mu));
    const double d = buffon_priv_expm1(-buffon_priv_abs(mu));
    const double a = law->a, b = law->b;
    const int right = mu > 0;
    const double whole = right ? law->x0 + law->y0 * fall : law->y0 + law->x0 * fall;
    incomplete_place at;
    at.x = (right ? law->x0 : law->x0 * fall) / whole;
    at.y = (right ? law->y0 * fall : law->y0) / whole;
    at.slope = a * law->y0 * ((right ? d : -d) / whole);
    at.density =
        law->peak - (a <= b ? incomplete_deviance(a, b, mu) : incomplete_deviance(b, a, -mu));
    return at;
}

/* P(X <= x) / D by the continued fraction of A. DiDonato, A. Morris (1992), Algorithm 708: the
 * inverse of beta_0 + alpha_1 / (beta_1 + alpha_2 / (beta_2 + ...)), with lead = a y - b x >= 0. It
 * is the even part of the classical fraction. From one standard deviation out some hundred steps
 * do, for any a and b. The convergents are q / p, scaled so that p = 1. */
static double incomplete_fraction(double a, double b, double x, double y, double lead)
{
    double q0 = 0, p0 = 1, p1 = a / (a + 1) * (lead + 1), q1 = 1 / p1;
    p0 = q1;
    for (int step = 1; step < INCOMPLETE_STEPS; step++) {
        const double m = step, r = 1 / (a + 2 * m - 1), w = m * (b - m) * x * r;
        const double alpha = (a + m - 1) * r * ((a + b + m - 1) * x) * w;
        const double beta = m + w + (a + m) / (a + 2 * m + 1) * (lead + 1 + m * (1 + y));
        const double scale = 1 / (beta + alpha * p0);
        const double q2 = (beta * q1 + alpha * q0) * scale;
        q0 = q1 * scale;
        p0 = scale;
        if (buffon_priv_abs(q2 - q1) <= INCOMPLETE_CLOSE * q2)
            return q2;
        q1 = q2;
    }
    return q1;
}

/* The same by its power series, the sum of (n)_k / (a + 1)_k x^k / a with n = a + b: all terms are
 * positive, and fall from the first on by INCOMPLETE_QUICK at least. */
static int incomplete_quick(double a, double n, double x)
{
    return x < INCOMPLETE_QUICK && x * n < INCOMPLETE_QUICK * (a + 1);
}

static double incomplete_series(double a, double n, double x)
{
    double term = 1, sum = 1;
    for (int k = 0; k < 200 && term > 0x1p-56 * sum; k++) {
        term *= x * ((n + k) / (a + 1 + k));
        sum += term;
    }
    return sum / a;
}

static double incomplete_below(double a, double b, double x, double y, double lead)
{
    return incomplete_quick(a, a + b, x) ? incomplete_series(a, a + b, x)
                                         : incomplete_fraction(a, b, x, y, lead);
}

/* A tail over D / unit: by its own series or, away from the mean, its fraction; else as 1 less the
 * other. Near an end of (0, 1) the fraction takes forever, and the other tail's series does not; 1
 * less it is good to 1e-16 / a. */
static double incomplete_ratio(const buffon_priv_beta *law, const incomplete_place *at, int upper)
{
    const double a = law->a, b = law->b;
    const int quick_below = incomplete_quick(a, law->n, at->x);
    const int quick_above = incomplete_quick(b, law->n, at->y);
    const int left = at->slope >= 0;
    const int above =
        upper ? quick_above || (!left && !quick_below) : !(quick_below || (left && !quick_above));
    const double ratio = above ? incomplete_below(b, a, at->y, at->x, -at->slope)
                               : incomplete_below(a, b, at->x, at->y, at->slope);
    return above == upper ? law->unit * ratio : buffon_priv_exp(-at->density) - law->unit * ratio;
}

/* The slope is n (x0 - x) and x' = x (1 - x). */
static void incomplete_law(buffon_priv_place *place, double mu, int upper, const void *ctx)
{
    const buffon_priv_beta *law = ctx;
    const incomplete_place at = incomplete_place_make(law, mu);
    double x[SOLVE_ORDER] = {at.x, at.x * at.y};
    place->unit = law->unit;
    place->density = at.density;
    place->ratio = incomplete_ratio(law, &at, upper);
    place->slope[0] = at.slope;
    place->slope[1] = -law->n * x[1];
    for (int k = 1; k + 1 < SOLVE_ORDER; k++) {
        double sum = x[k] * (at.y - at.x);
        for (int j = 1; j < k; j++)
            sum -= x[j] * x[k - j];
        x[k + 1] = sum / (k + 1);
        place->slope[k + 1] = -law->n * x[k + 1];
    }
}

/* Where to start on the way to the lower tail p <= 1/2. Both parameters above 1: M. Abramowitz,
 * I. Stegun (1964), 26.5.22. Otherwise P(X <= x) = x^a / (a B), or the mean if that gives x > 1. */
static double incomplete_guess(double a, double b, double peak, double log_p, double z)
{
    const double n = a + b, log_y0 = buffon_priv_log1p(-a / n);
    double log_x;
    if (a > 1 && b > 1) {
        const double ra = 1 / (2 * a - 1), rb = 1 / (2 * b - 1);
        const double h = 2 / (ra + rb), lambda = (z * z - 3) / 6;
        const double skew = (rb - ra) * (lambda + 5.0 / 6 - 2 / (3 * h));
        return 2 * (z * sqrt(h + lambda) / h + skew);
    }
    log_x = (log_p + (b - 1) * log_y0 - peak) / a + buffon_priv_log(a / n);
    if (log_x >= 0)
        return 0;
    return log_x - buffon_priv_log(-buffon_priv_expm1(log_x)) - buffon_priv_log(a / b);
}

/* log p where q = 1 - p is known too. */
static double incomplete_log(double p, double q)
{
    return p < 0.5 ? buffon_priv_log(p) : buffon_priv_log1p(-q);
}

/* b = 1: P(X <= x) = x^a. */
static buffon_priv_beta_point incomplete_power(double lower, double upper, double a)
{
    const double log_x = incomplete_log(lower, upper) / a;
    buffon_priv_beta_point at;
    at.x = buffon_priv_exp(log_x);
    at.y = -buffon_priv_expm1(log_x);
    at.mu = log_x - buffon_priv_log(at.y) - buffon_priv_log(a);
    return at;
}

buffon_priv_beta_point buffon_priv_beta_quantile(const buffon_priv_beta *law, double lower,
                                                 double upper, double guess)
{
    const double a = law->a, b = law->b;
    const int above = lower > upper;
    const double p = above ? upper : lower, z = buffon_priv_normal_quantile(p);
    buffon_priv_beta_point point;
    incomplete_place at;
    double log_p;
    if (b == 1)
        return incomplete_power(lower, upper, a);
    if (a == 1) {
        point = incomplete_power(upper, lower, b);
        return (buffon_priv_beta_point){.x = point.y, .y = point.x, .mu = -point.mu};
    }
    if (law->prepared) {
        const double zeta = buffon_priv_bell_quantile(&law->bell, above ? -z : z);
        if (zeta == zeta) {
            const double w = buffon_priv_bell_distance(&law->bell, zeta);
            const double right = law->y0 * w, left = law->x0 * w;
            point.x = law->x0 * (1 + right);
            point.y = law->y0 * (1 - left);
            point.mu = buffon_priv_log1p(right) - buffon_priv_log1p(-left);
            return point;
        }
    }
    log_p = buffon_priv_log(p);
    if (!(guess == guess))
        guess = above ? -incomplete_guess(b, a, law->peak, log_p, z)
                      : incomplete_guess(a, b, law->peak, log_p, z);
    point.mu = buffon_priv_solve(guess, log_p, above, incomplete_law, law);
    at = incomplete_place_make(law, point.mu);
    point.x = at.x;
    point.y = at.y;
    return point;
}

/* a + b as the unrounded sum of a high and a low part, a b likewise: T. Dekker (1971). */
static double incomplete_sum(double *rest, double a, double b)
{
    const double sum = a + b, part = sum - a;
    *rest = (a - (sum - part)) + (b - part);
    return sum;
}

static double incomplete_product(double *rest, double a, double b)
{
    const double ca = a * 0x1.0000002p27, cb = b * 0x1.0000002p27;
    const double a1 = ca - (ca - a), b1 = cb - (cb - b), a2 = a - a1, b2 = b - b1;
    const double product = a * b;
    *rest = ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2;
    return product;
}

double buffon_priv_beta_excess(double a, double b, double x)
{
    double rest_a, rest_b, rest;
    const double sum =
        incomplete_sum(&rest, incomplete_product(&rest_a, a, x), incomplete_product(&rest_b, b, x));
    return (sum - a) + (rest + (rest_a + rest_b));
}

/* log(x0 / x) + (x - x0) / x0, from d = (x - x0) / x0 and, where x is far less than x0, their
 * quotient. */
static double incomplete_part(double d, double quotient)
{
    return d < -0.5 ? d - buffon_priv_log(quotient) : buffon_priv_deviance(d);
}

/* The deviance at x is the sum of two that are not negative, as a d + b e = 0; `excess` is
 * n (x - x0). */
static double incomplete_deviance_at(const buffon_priv_beta *law, double x, double excess)
{
    const double a = law->a, b = law->b;
    return a * incomplete_part(excess / a, x / law->x0) +
           b * incomplete_part(-excess / b, (1 - x) / law->y0);
}

double buffon_priv_beta_log_density(const buffon_priv_beta *law, double x)
{
    const double excess = buffon_priv_beta_excess(law->a, law->b, x);
    return buffon_priv_log(law->unit) + (law->peak - incomplete_deviance_at(law, x, excess));
}

double buffon_priv_beta_tail(const buffon_priv_beta *law, double x, int upper)
{
    const double excess = buffon_priv_beta_excess(law->a, law->b, x);
    const double deviance = incomplete_deviance_at(law, x, excess);
    const incomplete_place at = {
        .x = x, .y = 1 - x, .slope = -excess, .density = law->peak - deviance};
    if (law->nearly_normal) {
        const double size = sqrt(2 * deviance / law->unit);
        const double zeta = at.slope > 0 ? -size : size;
        buffon_priv_bell bell;
        if (law->prepared && size <= law->bell.reach)
            return buffon_priv_bell_tail(&law->bell, zeta, upper);
        if (!law->prepared && size <= buffon_priv_bell_reach(incomplete_radius(law))) {
            incomplete_bell(&bell, law, size);
            return buffon_priv_bell_tail(&bell, zeta, upper);
        }
    }
    return buffon_priv_exp(at.density) * incomplete_ratio(law, &at, upper);
}

double buffon_priv_beta_above(const buffon_priv_beta *law, double mu)
{
    const incomplete_place at = incomplete_place_make(law, mu);
    return buffon_priv_exp(at.density) * incomplete_ratio(law, &at, 1);
}

double buffon_beta_quantile(double p, double a, double b)
{
    buffon_priv_beta law;
    if (!(p >= 0 && p <= 1 && a >= INCOMPLETE_LEAST && b >= INCOMPLETE_LEAST &&
          a <= INCOMPLETE_MOST && b <= INCOMPLETE_MOST))
        return (double)NAN;
    if (p == 0 || p == 1)
        return p;
    buffon_priv_beta_make(&law, a, b);
    buffon_priv_beta_prepare(&law);
    return buffon_priv_beta_quantile(&law, p, 1 - p, (double)NAN).x;
}
