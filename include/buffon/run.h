/* Layer 3. The options that every estimator takes: all zero is the default, NULL is all zero. */
#ifndef BUFFON_RUN_H
#define BUFFON_RUN_H

#include "api.h"
#include "density.h"
#include "estimate.h"
#include "integrand.h"
#include "partial.h"
#include "points.h"
#include "status.h"

BUFFON_BEGIN

/** What a value that is not finite does to a run. */
typedef enum buffon_nonfinite {
    BUFFON_NONFINITE_ERROR = 0, /* the run fails with BUFFON_E_NONFINITE and the first such point */
    BUFFON_NONFINITE_ZERO = 1   /* it counts as zero and is counted: BUFFON_W_NONFINITE */
} buffon_nonfinite;

/** How far a run is. */
typedef struct buffon_progress {
    uint64_t done, total;            /* points; total is what .samples allows, or this part of it */
    const buffon_estimate *estimate; /* of the points done: [components] */
    size_t components;
    const buffon_partial *partial;   /* what is done: may be saved, and resumed to the same bits */
} buffon_progress;

/** Options of a run.
 *
 *  The bits of the result depend on samples, seed, stream, block, points and the tolerances (and of
 *  course on the problem); never on threads, executor, part and parts, progress, or how often the
 *  run was cancelled and resumed.
 */
typedef struct buffon_run {
    uint64_t samples; /* points to use, at most; 0 means 2^20. A point set may round it up */
    uint64_t seed;    /* same seed, same bits */
    uint64_t stream;  /* independent sequences of one seed */
    uint32_t threads; /* 0 and 1: the caller's thread alone; with an executor: tasks to hand it.
                       * Threads are started when a run has taken a millisecond: a shorter one
                       * stays on the caller's thread, and of slow integrands the first block
                       * does. Each thread needs memory for a block, whatever .samples */
    uint32_t block;   /* points evaluated at a time: a power of two from 16 to 2^20; 0 means 1024.
                       * Part of what the bits depend on. Small for integrands that take seconds */
    double abs_tol;   /* stop once the interval's half width is at most abs_tol ... */
    double rel_tol;   /* ... or rel_tol |value|; 0: that tolerance is not asked for. Looks happen
                       * at 2^13, 2^14, ... samples and at the end; the interval covers as stated
                       * all the same. Every component must meet it */
    double confidence;           /* of the interval, in (0, 1); 0 means 0.95 */
    const buffon_points *points; /* NULL: independent random points */
    uint32_t part, parts;        /* do only part 0 .. parts - 1 of the run, and leave it in
                                  * .partial; 0, 0: all of it */
    buffon_partial *partial;     /* in: what is done and is skipped; out: all that is done */
    uint64_t id;                 /* the caller's name for the problem: partials of others are
                                  * refused */
    int on_nonfinite;            /* a buffon_nonfinite */
    int constant;                /* non-zero: f/g is known to be constant, so that zero spread is
                                  * certainty */
    int covariance;              /* non-zero: keep what buffon_partial_covariance needs; needs
                                  * .partial */
    int reserved_int;            /* must be zero */
    /* Called on the thread that called the estimator, between blocks, at most ten times a second
     * and once at the end. It changes no number. Non-zero: cancel, leaving the estimate of a
     * prefix. */
    int (*progress)(const buffon_progress *progress, void *ctx);
    void *progress_ctx;
    /* Runs task(0, arg) ... task(tasks - 1, arg), in any order, at once or one by one, and returns
     * when all are done: a host's own thread pool in place of ours. */
    void (*executor)(size_t tasks, void (*task)(size_t i, void *arg), void *arg, void *ctx);
    void *executor_ctx;
    uint64_t reserved[8]; /* must be zero */
} buffon_run;

/** The point that a run with these options draws at an index: the one that `bad_index` names.
 *
 *  Out:     x[g->dim]  NaN on error
 *  In:      g          the density of the run; buffon_box(lo, hi, dim) for buffon_uniform. For
 *                      buffon_rejection the box has one side more, from 0 to the height
 *           index      any, below the limit of the points
 *           run        as given to the estimator
 *  Returns: BUFFON_OK; as the estimator for bad arguments; BUFFON_E_SAMPLES (index)
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_sample_at(double *x, const buffon_density *g,
                                                       uint64_t index, const buffon_run *run);

BUFFON_END

#endif
