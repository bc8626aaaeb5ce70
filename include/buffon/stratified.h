/* Layer 3. Stratification: Omega = gamma + rest, each region estimated on its own. */
#ifndef BUFFON_STRATIFIED_H
#define BUFFON_STRATIFIED_H

#include "run.h"

BUFFON_BEGIN

/** One stratum: a region or component of the problem, with the density that samples it. */
typedef struct buffon_stratum {
    const buffon_density *density; /* with its pdf */
    const buffon_integrand *f;     /* this stratum's integrand; NULL: the common one */
    double weight;                 /* factor of its estimate in the sum; 0 means 1 */
    double share;                  /* of the samples, relative to the other strata; 0 means 1 */
    uint64_t reserved[2];          /* must be zero */
} buffon_stratum;

/** How samples are given to strata. */
typedef enum buffon_allocation {
    /* In proportion to .share. With the measure of each stratum as its share this is proportional
     * allocation, which is never worse than no strata at all. */
    BUFFON_ALLOCATION_SHARE = 0,
    /* In proportion to |weight| times the standard deviation that a pilot found, but at least a
     * tenth of what .share would give. */
    BUFFON_ALLOCATION_NEYMAN = 1
} buffon_allocation;

/** The strata of a problem. */
typedef struct buffon_strata {
    const buffon_stratum *stratum; /* [count] */
    size_t count;                  /* 1 to 65536 */
    int allocation;                /* a buffon_allocation */
    uint32_t pilot;                /* points of the pilot in each stratum; 0 means 1024. They have
                                    * numbers of their own and do not enter the estimate */
    uint64_t reserved[4];          /* must be zero */
} buffon_strata;

/** Estimates the sum over strata of weight times the integral of f: independent estimates added,
 *  errors too.
 *
 *  Out:     out[components]  std_error^2 is the sum of weight^2 variance / n; the interval is
 *                            Student's with Welch and Satterthwaite's degrees of freedom. Of
 *                            several strata, variance is n std_error^2: that of one sample if
 *                            samples are given as they were
 *  In:      f        the common integrand; may be NULL where every stratum has its own
 *           strata   densities of one dimension; run.samples is the total, each stratum's part is
 *                    rounded up and at least 2
 *           run      options; a point set serves each stratum on its own
 *  Returns: as buffon_importance; BUFFON_E_STRATA; a failing point's stratum in out->bad_stratum
 *  Cost:    samples evaluations, and count * pilot for Neyman allocation
 *  Source:  J. Neyman (1934), On the two different aspects of the representative method
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_stratified(buffon_estimate *out,
                                                        const buffon_integrand *f,
                                                        const buffon_strata *strata,
                                                        const buffon_run *run);

/** The point of a stratum that a run draws at an index: see buffon_sample_at.
 *
 *  Out:     x[dim]   NaN on error
 *  In:      strata, stratum, index, run  as the estimate named them
 *  Returns: as buffon_sample_at; BUFFON_E_STRATA
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_stratum_sample_at(double *x,
                                                               const buffon_strata *strata,
                                                               uint64_t stratum, uint64_t index,
                                                               const buffon_run *run);

BUFFON_END

#endif
