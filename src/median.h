/* The median of the estimates of replicates (BUFFON_DESIGN_MEDIAN), and what its error is: order
 * statistics, which ask nothing of the law of the replicates but that half of them fall on either
 * side.
 */
#ifndef BUFFON_MEDIAN_H
#define BUFFON_MEDIAN_H

#include "record.h"

/** The estimates of a component, one from each replicate that has points in every stratum. */
typedef struct buffon_priv_median {
    size_t n;
    double x[BUFFON_PRIV_REPLICATES]; /* rising; all NaN if one is */
} buffon_priv_median;

void buffon_priv_median_make(buffon_priv_median *median, const buffon_priv_record *record,
                             size_t k);

/** The median; NaN of none. */
double buffon_priv_median_value(const buffon_priv_median *median);

/** Its standard error; NaN below two. */
double buffon_priv_median_error(const buffon_priv_median *median);

/** The interval that misses the true median with probability alpha at most: 0 if there is none. */
int buffon_priv_median_interval(double *lo, double *hi, const buffon_priv_median *median,
                                double alpha);

#endif
