/* Quantiles of the beta distribution, good to 1e-12 for parameters from 0.01 up and any tails.
 * Below that the quantile is ill-conditioned: an error of 1e-16 in p is one of 1e-16 / a in x.
 *
 * The variable is mu = log((x / y) / (x0 / y0)) with y = 1 - x, the mean x0 = a / (a + b) and
 * y0 = 1 - x0: the log odds against those of the mean. In it nothing of the size of a or b cancels,
 * x and y have the same rights, and both tails are log-concave, so that Newton's steps on the log
 * of a tail converge from anywhere. The density of mu is
 *
 *     D = x^a y^b / B(a, b) = sqrt(a y0 / 2 pi) exp(d(a + b) - d(a) - d(b) - deviance),
 *     deviance = a log(x0 / x) + b log(y0 / y) >= 0,
 *
 * with d(z) the error of Stirling's formula, as C. Loader (2000), Fast and accurate computation of
 * binomial probabilities, does it for the binomial. A tail is D times a continued fraction.
 * Rejected: log-gammas (they lose log10(a) digits), bisection on the CDF (it loses the far tails).
 */
#include "guard.h"

#include <math.h>

#include <buffon/interval.h>

#include "elementary.h"
#include "quantile.h"
#include "special.h"

#define BETA_LEAST 1e-16 /* below it and above the other the steps do not settle */
#define BETA_MOST 1e30
#define BETA_LOG_SQRT_2PI 0x1.d67f1c864beb5p-1
#define BETA_MANY 1000   /* of min(a, b): from there on the fraction is slow near the mean */
#define BETA_STEPS 20000 /* of the fraction at most */
#define BETA_CLOSE 1e-15 /* when two of its convergents agree */

typedef struct beta_law {
    double a, b;
    double x0, y0; /* the mean and 1 - mean */
    double peak;   /* log D at mu = 0 */
} beta_law;

typedef struct beta_place {
    double x, y;
    double slope;   /* d log D / d mu = a y - b x */
    double density; /* log D */
} beta_place;

static beta_law beta_law_make(double a, double b)
{
    beta_law law;
    law.a = a;
    law.b = b;
    law.x0 = a / (a + b);
    law.y0 = b / (a + b);
    law.peak = 0.5 * buffon_priv_log(a * law.y0) - BETA_LOG_SQRT_2PI + buffon_priv_stirling(a + b) -
               buffon_priv_stirling(a) - buffon_priv_stirling(b);
    return law;
}

/* The deviance, for a <= b: (a + b) log(y0 + x0 e^mu) - a mu. Near the mean the terms cancel, which
 * leaves an error of 1e-16 a mu; but its derivative there is about a mu, so in mu the error is
 * 1e-16. (For a > b the terms would be far larger.) Where e^mu overflows it is divided out. */
static double beta_deviance(double a, double b, double mu)
{
    const double n = a + b;
    if (mu > 700) {
        return b * mu + n * buffon_priv_log(a / n + b / n * buffon_priv_exp(-mu));
    }
    return n * buffon_priv_log1p(a / n * buffon_priv_expm1(mu)) - a * mu;
}

/* a y - b x = (a + b) (x0 - x), where x0 - x is formed without cancellation. Right of the mean all
 * is divided by e^mu, which might overflow. */
static beta_place beta_place_make(const beta_law *law, double mu)
{
    const double fall = buffon_priv_exp(-buffon_priv_abs(mu));
    const double d = buffon_priv_expm1(-buffon_priv_abs(mu));
    const double a = law->a, b = law->b;
    const int right = mu > 0;
    const double whole = right ? law->x0 + law->y0 * fall : law->y0 + law->x0 * fall;
    beta_place at;
    at.x = (right ? law->x0 : law->x0 * fall) / whole;
    at.y = (right ? law->y0 * fall : law->y0) / whole;
    at.slope = a * law->y0 * ((right ? d : -d) / whole);
    at.density = law->peak - (a <= b ? beta_deviance(a, b, mu) : beta_deviance(b, a, -mu));
    return at;
}

/* P(X <= x) / D by the continued fraction of A. DiDonato, A. Morris (1992), Algorithm 708: the
 * inverse of beta_0 + alpha_1 / (beta_1 + alpha_2 / (beta_2 + ...)), with lead = a y - b x >= 0. It
 * is the even part of the classical fraction. From one standard deviation out some hundred steps
 * do, for any a and b. The convergents are q / p, scaled so that p = 1. */
static double beta_fraction(double a, double b, double x, double y, double lead)
{
    double q0 = 0, p0 = 1, q1, p1 = a / (a + 1) * (lead + 1);
    int step;
    q1 = 1 / p1;
    p0 = q1;
    for (step = 1; step < BETA_STEPS; step++) {
        const double m = step, r = 1 / (a + 2 * m - 1), w = m * (b - m) * x * r;
        const double alpha = (a + m - 1) * r * ((a + b + m - 1) * x) * w;
        const double beta = m + w + (a + m) / (a + 2 * m + 1) * (lead + 1 + m * (1 + y));
        const double scale = 1 / (beta + alpha * p0);
        const double q2 = (beta * q1 + alpha * q0) * scale;
        q0 = q1 * scale;
        p0 = scale;
        if (buffon_priv_abs(q2 - q1) <= BETA_CLOSE * q2) {
            return q2;
        }
        q1 = q2;
    }
    return q1;
}

/* log P(X <= x), and its derivative by mu. */
typedef struct beta_tail {
    double log;
    double hazard;
} beta_tail;

/* Left of the mean the fraction gives the tail; right of it, the other tail, which is not near 1
 * there but for tiny a. */
static beta_tail beta_tail_fraction(const beta_law *law, const beta_place *at)
{
    const double density = buffon_priv_exp(at->density);
    beta_tail tail;
    double ratio;
    if (at->slope >= 0) {
        ratio = beta_fraction(law->a, law->b, at->x, at->y, at->slope);
        tail.log = at->density + buffon_priv_log(ratio);
        tail.hazard = 1 / ratio;
    } else {
        ratio = density * beta_fraction(law->b, law->a, at->y, at->x, -at->slope);
        tail.log = buffon_priv_log1p(-ratio);
        tail.hazard = density / (1 - ratio);
    }
    return tail;
}

/* The same within one standard deviation of the mean, for large a and b: the tail at -1 deviation,
 * and from there on an integral of D, which is nearly normal: Gauss's rule with eight points. */
static beta_tail beta_tail_near(const beta_law *law, const beta_place *at, double mu, double sd)
{
    static const double node[4] = {0x1.ebab1cb0acc67p-1, 0x1.97e4ab249f41ep-1, 0x1.0d129583284b4p-1,
                                   0x1.77ac94f3c7345p-3};
    static const double weight[4] = {0x1.9ea1d04ca0374p-4, 0x1.c76fb531d2b96p-3,
                                     0x1.413c50a255615p-2, 0x1.736360b199343p-2};
    const double middle = 0.5 * (mu - sd), half = 0.5 * (mu + sd);
    const beta_place start = beta_place_make(law, -sd);
    double sum = 0, below;
    beta_tail tail;
    int i;
    for (i = 0; i < 4; i++) {
        const beta_place left = beta_place_make(law, middle - half * node[i]);
        const beta_place right = beta_place_make(law, middle + half * node[i]);
        sum += weight[i] * (buffon_priv_exp(left.density) + buffon_priv_exp(right.density));
    }
    below = buffon_priv_exp(beta_tail_fraction(law, &start).log) + half * sum;
    tail.log = buffon_priv_log(below);
    tail.hazard = buffon_priv_exp(at->density) / below;
    return tail;
}

/* Where to start on the way to the lower tail p <= 1/2. Both parameters above 1: M. Abramowitz,
 * I. Stegun (1964), 26.5.22. Otherwise P(X <= x) = x^a / (a B), or the mean if that gives x > 1. */
static double beta_guess(const beta_law *law, double p)
{
    const double a = law->a, b = law->b;
    double log_x;
    if (a > 1 && b > 1) {
        const double z = -buffon_priv_normal_quantile(p);
        const double ra = 1 / (2 * a - 1), rb = 1 / (2 * b - 1);
        const double h = 2 / (ra + rb), lambda = (z * z - 3) / 6;
        const double skew = (rb - ra) * (lambda + 5.0 / 6 - 2 / (3 * h));
        return -2 * (z * sqrt(h + lambda) / h - skew);
    }
    log_x = buffon_priv_log(p) + buffon_priv_log(a) + b * buffon_priv_log(law->y0) - law->peak;
    log_x = buffon_priv_log(law->x0) + log_x / a;
    if (log_x >= 0) {
        return 0;
    }
    return log_x - buffon_priv_log(-buffon_priv_expm1(log_x)) - buffon_priv_log(a / b);
}

/* Halley's steps to f = log P(X <= x) - log p = 0, where f' = hazard and f'' / f' = slope - hazard
 * is negative: a tail is log-concave. They converge cubically, so the last one need not be small.
 * The denominator is kept from stretching a step more than twofold where it sets out from far. */
static double beta_solve(const beta_law *law, double p, double mu)
{
    const double log_p = buffon_priv_log(p);
    const double sd = 1 / sqrt(law->a * law->y0);
    const int many = law->a >= BETA_MANY && law->b >= BETA_MANY;
    int i;
    for (i = 0; i < 200; i++) {
        const beta_place at = beta_place_make(law, mu);
        const int near = many && buffon_priv_abs(mu) < sd;
        const beta_tail tail =
            near ? beta_tail_near(law, &at, mu, sd) : beta_tail_fraction(law, &at);
        const double newton = (tail.log - log_p) / tail.hazard;
        const double bend = 1 - 0.5 * newton * (at.slope - tail.hazard);
        const double step = newton / (bend > 0.5 ? bend : 0.5);
        mu -= step;
        if (buffon_priv_abs(step) * (1 + tail.hazard + buffon_priv_abs(at.slope)) < 1e-5 ||
            buffon_priv_abs(step) <= 1e-15 * buffon_priv_abs(mu)) {
            break;
        }
    }
    return mu;
}

/* log p where q = 1 - p is known too. */
static double beta_log(double p, double q)
{
    return p < 0.5 ? buffon_priv_log(p) : buffon_priv_log1p(-q);
}

/* b = 1: P(X <= x) = x^a. */
static double beta_power(double *x, double *y, double lower, double upper, double a)
{
    const double log_x = beta_log(lower, upper) / a;
    *x = buffon_priv_exp(log_x);
    *y = -buffon_priv_expm1(log_x);
    return log_x - buffon_priv_log(*y) - buffon_priv_log(a);
}

double buffon_priv_beta_point(double *x, double lower, double upper, double a, double b,
                              double guess)
{
    const int left = lower <= upper;
    double mu, y;
    beta_law law;
    if (b == 1) {
        return beta_power(x, &y, lower, upper, a);
    }
    if (a == 1) {
        return -beta_power(&y, x, upper, lower, b);
    }
    law = left ? beta_law_make(a, b) : beta_law_make(b, a);
    mu = guess == guess ? (left ? guess : -guess) : beta_guess(&law, left ? lower : upper);
    mu = beta_solve(&law, left ? lower : upper, mu);
    mu = left ? mu : -mu;
    law = left ? law : beta_law_make(a, b);
    *x = beta_place_make(&law, mu).x;
    return mu;
}

double buffon_beta_quantile(double p, double a, double b)
{
    double x;
    if (!(p >= 0 && p <= 1 && a >= BETA_LEAST && b >= BETA_LEAST && a <= BETA_MOST &&
          b <= BETA_MOST)) {
        return buffon_priv_from_bits(UINT64_C(0x7ff8000000000000));
    }
    if (p == 0 || p == 1) {
        return p;
    }
    buffon_priv_beta_point(&x, p, 1 - p, a, b, buffon_priv_from_bits(UINT64_C(0x7ff8000000000000)));
    return x;
}
