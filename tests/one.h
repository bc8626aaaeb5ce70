/* One point at a time: what a density says of it, NaN where it fails. */
#ifndef TESTS_ONE_H
#define TESTS_ONE_H

#include <math.h>

#include <buffon/density.h>

static inline double one_x(const buffon_density *g, double u)
{
    double x;
    return buffon_density_sample(&x, NULL, &u, 1, g) == BUFFON_OK ? x : (double)NAN;
}

static inline double one_pdf(const buffon_density *g, double x)
{
    double pdf;
    return buffon_density_pdf(&pdf, &x, 1, g) == BUFFON_OK ? pdf : (double)NAN;
}

static inline double one_log_pdf(const buffon_density *g, double x)
{
    double log_pdf;
    return buffon_density_log_pdf(&log_pdf, &x, 1, g) == BUFFON_OK ? log_pdf : (double)NAN;
}

static inline double one_u(const buffon_density *g, double x)
{
    double u;
    return buffon_density_invert(&u, &x, 1, g) == BUFFON_OK ? u : (double)NAN;
}

#endif
