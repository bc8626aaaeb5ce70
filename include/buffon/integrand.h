/* Layer 1. The user's function. */
#ifndef BUFFON_INTEGRAND_H
#define BUFFON_INTEGRAND_H

#include "api.h"

BUFFON_BEGIN

/** A function to integrate, one point or a whole batch at a time.
 *
 *  Set exactly one of:
 *    scalar  the value at x[dim]
 *    batch   f[k*n + i] = component k at point i, whose coordinate j is x[j*n + i]; returns 0, or
 *            non-zero to stop the run with BUFFON_E_STOPPED. n is at most the block of the run.
 *
 *  With threads, both are called by several threads at once with the same ctx. They may call the
 *  library. They must not leave by longjmp or an exception.
 */
typedef struct buffon_integrand {
    double (*scalar)(const double *x, void *ctx);
    int (*batch)(double *f, const double *x, size_t n, void *ctx);
    size_t dim;        /* coordinates of a point: that of the domain or density */
    size_t components; /* 0 means 1; more need batch */
    void *ctx;         /* handed through */
    uint64_t reserved[4]; /* must be zero */
} buffon_integrand;

BUFFON_END

#endif
