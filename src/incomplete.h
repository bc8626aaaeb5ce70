/* Private. The incomplete beta function: probabilities and quantiles of the beta law, for the
 * density of beta.h, Student's t, the binomial law and the intervals of interval.h.
 */
#ifndef BUFFON_SRC_INCOMPLETE_H
#define BUFFON_SRC_INCOMPLETE_H

#include "bell.h"

/* A beta law. The density of log(x / y), y = 1 - x, is D = x^a y^b / B(a, b). */
typedef struct buffon_priv_beta {
    double a, b, n; /* n = a + b */
    double x0, y0;  /* the mean and 1 - mean */
    double unit;    /* a b / n */
    double peak;    /* log(D / unit) at the mean: 0 for tiny parameters */
    double gain;    /* errors of Stirling's formula, for bell.h */
    int nearly_normal;
    int prepared;
    buffon_priv_bell bell; /* of a nearly normal law that is prepared */
} buffon_priv_beta;

/* Both parameters from 1e-16 to 1e30. */
void buffon_priv_beta_make(buffon_priv_beta *law, double a, double b);

/* Spends 1 us at once for faster tails; what quantiles need. */
void buffon_priv_beta_prepare(buffon_priv_beta *law);

/* (a + b) x - a with little error beside its last rounding, for x near the mean too. */
double buffon_priv_beta_excess(double a, double b, double x);

/* log D at x, for x in (0, 1). */
double buffon_priv_beta_log_density(const buffon_priv_beta *law, double x);

/* P(X <= x) or, if `upper`, P(X > x), for x in (0, 1); either keeps its relative accuracy as far as
 * the other is no smaller. */
double buffon_priv_beta_tail(const buffon_priv_beta *law, double x, int upper);

/* P(X > x) at the point of that log((x / y) / (a / b)), relative. */
double buffon_priv_beta_above(const buffon_priv_beta *law, double mu);

/* A point of a beta law: mu = log((x / y) / (a / b)) loses neither a tiny x nor a tiny y. */
typedef struct buffon_priv_beta_point {
    double x, y, mu;
} buffon_priv_beta_point;

/* The point with `lower` of the probability below it and `upper` above, where the two add up to 1
 * and neither is 0. The search starts at `guess` of mu, or where it sees fit if that is NaN. */
buffon_priv_beta_point buffon_priv_beta_quantile(const buffon_priv_beta *law, double lower,
                                                 double upper, double guess);

#endif
