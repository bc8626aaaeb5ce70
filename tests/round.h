/* For tests of shapes: errors against one limit, arguments from one end of the doubles to the
 * other, points there and back. */
#ifndef TESTS_ROUND_H
#define TESTS_ROUND_H

#include <math.h>

#include <buffon/density.h>

#include "ulps.h"

/* ---- errors ------------------------------------------------------------------------------- */

/* In the unit of the check. */
static inline void see_error(ulps_worst *w, wide error)
{
    ulps_see_error(w, (double)error, 1, NULL);
}

/* In ulp of the true value. */
static inline void see(ulps_worst *w, double x, wide exact)
{
    ulps_see(w, x, exact, 1, NULL);
}

/* Relative, in units of 2^-52. */
static inline void see_share(ulps_worst *w, double x, wide exact)
{
    see_error(w, fabsl(x - exact) / fabsl(exact) * 0x1p52L);
}

/* Of the size of the shape, in units of 2^-52. */
static inline void see_part(ulps_worst *w, double x, wide exact, double size)
{
    see_error(w, fabsl(x - exact) / size * 0x1p52L);
}

static inline void report(const ulps_worst *w, double limit, const char *what)
{
    tap_ok(w->ulps <= limit, "%s: at most %g", what, limit);
    tap_note("worst %.3f", w->ulps);
}

/* ---- arguments ---------------------------------------------------------------------------- */

/* Of any size from 2^low to 2^high. */
static inline double any(buffon_rng *rng, int low, int high)
{
    const double v = 1 + buffon_rng_next(rng);
    return ldexp(v, low + (int)buffon_rng_below(rng, (uint64_t)(high - low)));
}

/* In [0, top), now and then as near to it, or to 0, as may be. */
static inline double below(buffon_rng *rng, double top)
{
    const double v = buffon_rng_next(rng), small = ldexp(v, -(int)buffon_rng_below(rng, 52));
    switch (buffon_rng_below(rng, 5)) {
    case 0:
        return 0;
    case 1:
        return top * small;
    case 2:
        return fmin(top * (1 - small), nextafter(top, 0));
    case 3:
        return nextafter(top, 0);
    default:
        return top * v;
    }
}

/* ---- one point ---------------------------------------------------------------------------- */

/* A point, g along with it and at it, its uniforms; whether all could be had. */
static inline int round_trip(double *x, double *pdf, double *again, double *v, const double *u,
                             const buffon_density *g)
{
    return buffon_density_sample(x, pdf, u, 1, g) == BUFFON_OK &&
           buffon_density_pdf(again, x, 1, g) == BUFFON_OK &&
           buffon_density_invert(v, x, 1, g) == BUFFON_OK;
}

/* `lost` is how many times further apart the uniforms may be than rounding leaves points. */
static inline void check_back(const buffon_density *g, double lost, const char *what)
{
    double worst_u = 0;
    int same = g->status == BUFFON_OK;
    buffon_rng rng = buffon_rng_make(50, 40);
    for (int k = 0; same && k < 2000; k++) {
        double u[3], v[3] = {0}, x[3], pdf, again;
        for (size_t j = 0; j < g->uniforms; j++)
            u[j] = grid(&rng, k / (int)(j + 1));
        same &= round_trip(x, &pdf, &again, v, u, g) && pdf > 0 && again > 0 && isfinite(pdf);
        for (size_t j = 0; j < g->uniforms; j++) {
            /* An angle means nothing at the middle, and next to nothing near it. */
            const double off = fabs(u[j] - v[j]), turn = fmin(off, 1 - off);
            same &= v[j] > 0 && v[j] < 1;
            if (u[0] > 1e-4 && u[0] < 1 - 1e-4 && u[1 % g->uniforms] > 1e-4 &&
                u[1 % g->uniforms] < 1 - 1e-4)
                worst_u = fmax(worst_u, turn);
        }
    }
    tap_ok(same && worst_u <= lost * 0x1p-50, "%s: there and back", what);
    if (!(same && worst_u <= lost * 0x1p-50))
        tap_note("uniforms differ by up to %.3g", worst_u);
}

static inline double pdf_at(const buffon_density *g, double x, double y, double z)
{
    double pdf = NAN;
    const double point[3] = {x, y, z};
    return buffon_density_pdf(&pdf, point, 1, g) == BUFFON_OK ? pdf : (double)NAN;
}

#endif
