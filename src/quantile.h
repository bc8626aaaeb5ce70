/* Private. Quantiles in the forms that intervals need: both tail probabilities are handed over, so
 * that neither is lost in 1 - p. Accuracy as of the public functions (tests/test_interval.c).
 */
#ifndef BUFFON_SRC_QUANTILE_H
#define BUFFON_SRC_QUANTILE_H

#include <stdint.h>

#include "incomplete.h"

/* z with P(|Z| > z) = alpha, for alpha in (0, 1). */
double buffon_priv_normal_two_sided(double alpha);

/* t with P(|T| > t) = alpha, for alpha in (0, 1) and dof > 0. */
double buffon_priv_student_two_sided(double alpha, double dof);

/* t with P(|T| <= t) = inside and P(|T| > t) = outside, where the two add up to 1. */
double buffon_priv_student_central(double inside, double outside, double dof);

/* The same, neither of them 0, from the law of t^2 / (dof + t^2): beta of 1/2 and dof / 2. */
double buffon_priv_student_from(const buffon_priv_beta *law, double inside, double outside);

/* The Clopper-Pearson interval that misses with probability at most alpha / 2 on each side;
 * hits <= n, n >= 1, alpha in (0, 1). */
void buffon_priv_clopper_pearson(double *lo, double *hi, uint64_t hits, uint64_t n, double alpha);

#endif
