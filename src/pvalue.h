/* Private. Probabilities of statistics as large as those seen, if all is well. */
#ifndef BUFFON_SRC_PVALUE_H
#define BUFFON_SRC_PVALUE_H

#include <stddef.h>

/** P(|Z| > |z|) of a normal Z. */
double buffon_priv_p_normal(double z);

/** P(X > x) of a chi-square X with dof >= 1 degrees of freedom. */
double buffon_priv_p_chi_square(double x, double dof);

/** P(D > d) of the Kolmogorov-Smirnov statistic of n points, n in the hundreds or more: the limit
 *  law with M. Stephens' correction (1970). */
double buffon_priv_p_kolmogorov(double d, double n);

/** Sorts n numbers, none of them NaN. */
void buffon_priv_sort(double *v, size_t n);

/** The Kolmogorov-Smirnov statistic of n numbers, which are sorted, against the uniform law. */
double buffon_priv_kolmogorov(double *v, size_t n);

/** P of counts that differ so much from the expected ones, which have these variances: chi-square
 *  over cells. Those that expect fewer than ten are taken together. */
double buffon_priv_p_cells(const double *count, const double *expected, const double *variance,
                           size_t cells);

#endif
