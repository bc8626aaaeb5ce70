/* The one sampling loop. An estimator describes its problem; the engine runs it.
 *
 *     points fill u  ->  density maps u to x  ->  integrand gives f  ->  weigh gives y  ->  cells
 */
#ifndef BUFFON_ENGINE_H
#define BUFFON_ENGINE_H

#include <buffon/run.h>

#include "record.h"

struct buffon_priv_problem;

/** What `weigh` sees of a block of n points. */
typedef struct buffon_priv_batch {
    size_t n;
    const double *x;     /* [dim * n] */
    const double *pdf;   /* [n], if the problem asks for it */
    const double *extra; /* [extra * n] uniforms beyond those of the density */
    const double *f;     /* [components * n] */
    const double *p;     /* [n] the second integrand */
    double *point;       /* [dim] for weigh's own use */
    const buffon_density *g;
} buffon_priv_batch;

/** One region with its density. */
typedef struct buffon_priv_stratum {
    const buffon_density *g;
    const buffon_integrand *f;
    double weight; /* factor of its estimate */
    double share;  /* of the samples, > 0 */
    double asked;  /* the share before any reallocation: what tells runs apart */
} buffon_priv_stratum;

/** A problem: all that makes one estimator differ from another. */
typedef struct buffon_priv_problem {
    const char *name;
    const buffon_priv_stratum *stratum;
    size_t strata;
    const buffon_integrand *p; /* a second integrand, of one component; NULL without */
    size_t extra;              /* uniforms a point needs beyond its density's */
    int pdf;                   /* does weigh read the pdf? */
    enum buffon_priv_kind kind;
    double scale_m; /* the estimate is scale_m 2^scale_e times the mean of y */
    int scale_e;
    double param;    /* for weigh */
    uint8_t purpose; /* a buffon_purpose */
    /* y[outputs * n] of a block; NULL: y is f. Returns BUFFON_OK, or an error and the lowest point
     * it holds for in *bad. A y that is not finite is the engine's business. */
    buffon_status (*weigh)(double *y, size_t *bad, const buffon_priv_batch *batch,
                           const struct buffon_priv_problem *problem);
} buffon_priv_problem;

/** What a run would refuse before it draws anything, but for lack of memory. */
buffon_status buffon_priv_engine_check(const buffon_priv_problem *problem, const buffon_run *run);

/** Runs a problem and fills out[components of the first stratum's integrand], whatever happens. */
buffon_status buffon_priv_engine_run(buffon_estimate *out, const buffon_priv_problem *problem,
                                     const buffon_run *run);

/** Fills out for a refused call; components may be 0, which counts as 1. Returns the status. */
buffon_status buffon_priv_refuse(buffon_estimate *out, const buffon_integrand *f,
                                 buffon_status status);

/** The point of a stratum at an index, as a run of purpose MAIN draws it. */
buffon_status buffon_priv_run_point(double *x, const buffon_density *g, uint64_t stratum,
                                    uint64_t index, const buffon_run *run);

#endif
