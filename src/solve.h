/* Private. Quantiles of laws whose density in a variable t on the line is log-concave, as log x of
 * a gamma law and the log odds of a beta law are.
 */
#ifndef BUFFON_SRC_SOLVE_H
#define BUFFON_SRC_SOLVE_H

enum { SOLVE_ORDER = 8 };

/* What is known of a law at t: its density D, a tail, and d log D / d t as a power series. A unit
 * of the size of D where the tail is 1 keeps its logarithm out of rounding. */
typedef struct buffon_priv_place {
    double unit;
    double density; /* log(D / unit) */
    double ratio;   /* the tail over D / unit */
    double slope[SOLVE_ORDER];
} buffon_priv_place;

/* Fills `at` for the tail below t, or above if `upper`. */
typedef void buffon_priv_law(buffon_priv_place *at, double t, int upper, const void *ctx);

/* The t whose tail is exp(log_p), from a guess of it. */
double buffon_priv_solve(double t, double log_p, int upper, buffon_priv_law *law, const void *ctx);

#endif
