/* Layer 1. The result of every estimator. */
#ifndef BUFFON_ESTIMATE_H
#define BUFFON_ESTIMATE_H

#include "api.h"
#include "stats.h"
#include "status.h"

BUFFON_BEGIN

/** How lo and hi were found. */
typedef enum buffon_interval_kind {
    BUFFON_INTERVAL_NONE = 0,            /* nothing is known: -infinity to infinity */
    BUFFON_INTERVAL_STUDENT = 1,         /* value -+ t std_error */
    BUFFON_INTERVAL_CLOPPER_PEARSON = 2, /* exact for hits of independent points */
    BUFFON_INTERVAL_EXACT = 3,           /* the caller said that f/g is constant */
    BUFFON_INTERVAL_ORDER = 4            /* a median's: between two replicates' estimates */
} buffon_interval_kind;

/** An estimate with its error and its doubts. Written whole by the library; copy freely.
 *
 *  The interval covers the true value with the stated confidence, to the accuracy of the central
 *  limit theorem (the Clopper-Pearson one: always; for a net and a median see points.h). After a
 *  run that could stop early it covers all the looks together, so it is wider than value -+ 2
 *  std_error. What no sample saw, nothing here can show.
 *
 *  bad_index is the first failure in the order of evaluation, whatever the threads. That is the
 *  lowest index, but with strata or replicates the first in (block, cell) order; and where a
 *  density fails, no earlier failure of the integrand in the same block is looked for. A batch that
 *  stops, or a density that fails without making a point NaN, is named by the first point of its
 *  block.
 */
typedef struct buffon_estimate {
    double value;       /* NaN if there is no estimate */
    double std_error;   /* of value; infinity if there is none, NaN if the points allow none */
    double variance;    /* of one primary estimate (one sample) */
    double lo, hi;      /* the interval */
    double confidence;  /* that the interval was asked for */
    uint64_t samples;   /* points used */
    uint64_t nonfinite; /* values counted as zero by the option on_nonfinite */
    uint64_t bad_index; /* after an error of the integrand or density: the point, as
                         * buffon_sample_at takes it; else UINT64_MAX */
    uint64_t bad_stratum; /* and its stratum; else 0 */
    buffon_status status; /* as returned */
    uint32_t doubts;      /* all reservations: BUFFON_DOUBT(BUFFON_W_...) */
    buffon_interval_kind interval;
    uint32_t looks;       /* sample counts at which the run may have stopped; 1: only the end */
    double min, max;      /* of the primary estimates; NaN for self-normalised ones */
    double max_share;     /* of the squared error, what its largest term carries: 1/n at best.
                           * Self-normalised: largest squared weight over their sum */
    double tail_index;    /* k-hat of the primary estimates: see buffon_summary */
    double ess;           /* self-normalised estimates: effective sample size; else samples */
    double acceptance;    /* rejection: hits / samples; else NaN */
    uint64_t reserved[8];
} buffon_estimate;

/** The estimate of the mean of numbers that the caller gathered.
 *
 *  Out:     out         value = mean, interval by Student's t, doubts as for every estimate
 *  In:      s           independent values of one quantity
 *           confidence  in (0, 1); 0 means 0.95
 *  Returns: BUFFON_OK or a reservation; BUFFON_E_NULL, BUFFON_E_CONFIDENCE, BUFFON_E_EMPTY
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_stats_estimate(buffon_estimate *out,
                                                            const buffon_stats *s,
                                                            double confidence);

BUFFON_END

#endif
