/* Errors in ulp against long doubles, and arguments that try a formula everywhere. */
#ifndef TESTS_ULPS_H
#define TESTS_ULPS_H

#include <float.h>
#include <math.h>

#include <buffon/rng.h>

#include "grid.h"
#include "tap.h"

typedef long double wide;

#define WIDE_PI 3.14159265358979323846264338327950288L

#if defined(__GNUC__) || defined(__clang__)
#define ULPS_UNUSED __attribute__((unused))
#else
#define ULPS_UNUSED
#endif

/* Valgrind, for one, computes long doubles in 53 bits. */
ULPS_UNUSED static int ulps_have_wide(void)
{
    volatile wide one = 1, tiny = 0x1p-60L;
    return LDBL_MANT_DIG >= 64 && one + tiny > one;
}

ULPS_UNUSED static wide ulps_of(wide x)
{
    const double a = fabs((double)x);
    return a < DBL_MIN ? 0x1p-1074L : (wide)nextafter(a, INFINITY) - a;
}

/* The worst error met, in units of what is allowed and in ulp. */
typedef struct ulps_worst {
    double share, ulps;
    double at[4]; /* what gave it */
} ulps_worst;

ULPS_UNUSED static void ulps_see_error(ulps_worst *w, double error, double allowed,
                                       const double *at)
{
    if (error != error)
        error = INFINITY;
    if (error > w->ulps)
        w->ulps = error;
    if (!(error / allowed <= w->share)) {
        w->share = error / allowed;
        for (int k = 0; at && k < 4; k++)
            w->at[k] = at[k];
    }
}

/* In ulp of the true value. */
ULPS_UNUSED static void ulps_see(ulps_worst *w, double x, wide exact, double allowed,
                                 const double *at)
{
    ulps_see_error(w, (double)(fabsl(x - exact) / ulps_of(exact)), allowed, at);
}

/* In units of what is allowed, which is no number of ulp. */
ULPS_UNUSED static void ulps_see_near(ulps_worst *w, double x, wide exact, wide allowed,
                                      const double *at)
{
    const wide error = fabsl(x - exact);
    ulps_see_error(w, error == 0 ? 0 : (double)(error / allowed), 1, at);
}

/* x = base + offset: an error of the offset, and the rounding of the sum. */
ULPS_UNUSED static void ulps_see_sum(ulps_worst *w, double x, wide base, wide offset,
                                     double allowed, const double *at)
{
    const wide sum = base + offset, error = fabsl(x - sum);
    const wide round = base != 0 ? ulps_of(fabsl(sum) > fabsl(base) ? sum : base) : 0;
    ulps_see_error(w, error <= round ? 0 : (double)((error - round) / ulps_of(offset)), allowed,
                   at);
}

/* In ulp of the largest of several terms, which may cancel. */
ULPS_UNUSED static void ulps_see_terms(ulps_worst *w, double x, wide exact, wide largest,
                                       double allowed, const double *at)
{
    ulps_see_error(w, (double)(fabsl(x - exact) / ulps_of(largest)), allowed, at);
}

ULPS_UNUSED static void ulps_report(const ulps_worst *w, const char *what)
{
    if (!tap_ok(w->share <= 1, "%s", what))
        tap_note("at %.17g %.17g %.17g %.17g", w->at[0], w->at[1], w->at[2], w->at[3]);
    tap_note("worst %.3f of what is allowed, %.3f ulp", w->share, w->ulps);
}

/* sin and cos of 2 pi t: the reduction by quarters is exact. */
ULPS_UNUSED static void ulps_circle(wide *c, wide *s, wide t)
{
    const wide quarters = floorl(4 * t + 0.5L), rest = t - 0.25L * quarters;
    const wide sine = sinl(2 * WIDE_PI * rest), cosine = cosl(2 * WIDE_PI * rest);
    const int k = (int)quarters & 3;
    *c = k == 0 ? cosine : k == 1 ? -sine : k == 2 ? -cosine : sine;
    *s = k == 0 ? sine : k == 1 ? cosine : k == 2 ? -sine : -cosine;
}

/* A uniform in (0, 1): of the generator, near its ends, or of any size down to 2^-1074. */
ULPS_UNUSED static double ulps_uniform(buffon_rng *rng, int k)
{
    const double u = grid(rng, k);
    if (k % 3 == 0) {
        const double v = ldexp(u, -(int)buffon_rng_below(rng, 1074));
        return v > 0 ? v : 0x1p-1074;
    }
    if (k % 7 == 1)
        return 0.5 + ldexp(u - 0.5, -(int)buffon_rng_below(rng, 50));
    return u;
}

/* 2^e (1 + v) with e between two bounds, often one of the outermost or near 1. */
ULPS_UNUSED static double ulps_scale(buffon_rng *rng, int k, int least, int most)
{
    const double v = 1 + buffon_rng_next(rng);
    if (k % 5 == 0)
        return ldexp(1, k % 2 ? least : most);
    if (k % 5 < 3)
        return v;
    return ldexp(v, least + (int)buffon_rng_below(rng, (uint64_t)(most - least)));
}

#endif
