/* For tests of densities: what a refused one does wherever it is used. */
#ifndef TESTS_REFUSED_H
#define TESTS_REFUSED_H

#include <buffon/density.h>

#include "tap.h"

static inline int is_nan(const double *x, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (x[i] == x[i])
            return 0;
    return 1;
}

static inline void refused(const buffon_density *g, buffon_status status, const char *what)
{
    double u[8] = {0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5}, x[8] = {0}, pdf = 0;
    const int as_told = g->status == status && buffon_density_check(g) == status &&
                        buffon_density_sample(x, &pdf, u, 1, g) == status &&
                        is_nan(x, g->dim) && is_nan(&pdf, 1);
    pdf = 0;
    tap_ok(as_told && buffon_density_pdf(&pdf, u, 1, g) == status && is_nan(&pdf, 1),
           "%s is refused: %s", what, buffon_status_name(status));
}

static inline void refused_by_value(buffon_density g, buffon_status status, const char *what)
{
    refused(&g, status, what);
}

#endif
